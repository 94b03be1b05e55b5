//! `linkproof graph`: the tests read curves and texts back from the drawings and compare them with `linkproof solve`.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::cli::tools::Place;
use crate::common::assert_within;
use linkage::math::KeepNan;

const ROCKER: &str = "scenarios/crank_rocker.toml";

/// A table: the columns by name, and the names in the order of the columns.
struct Table {
    names: Vec<String>,
    columns: BTreeMap<String, Vec<f64>>,
}

fn table(text: &str) -> Table {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = reader.headers().unwrap().iter().map(String::from).collect();
    let mut columns: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for record in reader.records() {
        for (name, cell) in names.iter().zip(record.unwrap().iter()) {
            columns.entry(name.clone()).or_default().push(if cell.is_empty() {
                f64::NAN
            } else {
                cell.parse().unwrap()
            });
        }
    }
    Table { names, columns }
}

impl Table {
    fn of(&self, name: &str) -> &[f64] {
        self.columns.get(name).unwrap_or_else(|| panic!("no column {name} in {:?}", self.names))
    }
}

/// Exit code, standard output and standard error of a command whose arguments may contain blanks.
fn given(place: &Place, arguments: &[&str]) -> (i32, String, String) {
    let outcome = place.given(arguments);
    (outcome.code, outcome.stdout, outcome.stderr)
}

fn graph(arguments: &str) -> String {
    Place::new().ok(&format!("graph {arguments}"))
}

/// Curves, texts and size of an SVG.
struct Seen {
    /// Dash pattern and corners of every curve.
    curves: Vec<(String, Vec<[f64; 2]>)>,
    /// Texts with their positions on the sheet, and whether they are vertical.
    texts: Vec<(String, [f64; 2], bool)>,
    size: [f64; 2],
}

fn seen(svg: &str) -> Seen {
    let document = roxmltree::Document::parse(svg).unwrap();
    let number = |node: &roxmltree::Node, key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
    let curve = |node: roxmltree::Node| {
        let path = node.attribute("d").filter(|path| !path.ends_with('Z'))?;
        (node.attribute("stroke-width") == Some("0.45")).then(|| {
            let pair = |pair: &str| {
                let (x, y) = pair.split_once(' ').unwrap();
                [x.parse().unwrap(), y.parse().unwrap()]
            };
            (node.attribute("stroke-dasharray").unwrap_or("").to_string(), path[1..].split('L').map(pair).collect())
        })
    };
    let text = |node: roxmltree::Node| {
        let words: String = node.descendants().filter(|part| part.is_text()).filter_map(|part| part.text()).collect();
        (words, [number(&node, "x"), number(&node, "y")], node.attribute("transform").is_some())
    };
    let root = document.root_element();
    Seen {
        curves: document.descendants().filter(|node| node.has_tag_name("path")).filter_map(curve).collect(),
        texts: document.descendants().filter(|node| node.has_tag_name("text")).map(text).collect(),
        size: ["width", "height"].map(|key| root.attribute(key).unwrap().trim_end_matches("mm").parse().unwrap()),
    }
}

impl Seen {
    fn upright(&self) -> Vec<&str> {
        self.texts.iter().filter(|(.., upward)| !upward).map(|(text, ..)| text.as_str()).collect()
    }

    /// The names of vertical axes. The lines of a long name are joined: a name ends with a comma and the unit.
    fn upward(&self) -> Vec<String> {
        let (mut names, mut name) = (Vec::new(), String::new());
        for (text, ..) in self.texts.iter().filter(|(.., upward)| *upward) {
            name = if name.is_empty() { text.clone() } else { format!("{name} {text}") };
            if name.contains(", ") {
                names.push(std::mem::take(&mut name));
            }
        }
        names
    }

    /// Millimetres on the sheet per unit of an axis, from the numbers at the ticks of the axis.
    /// The numbers of the horizontal axis are in one row, those of the vertical axis in one column.
    fn scale(&self, axis: usize) -> f64 {
        let numbers: Vec<(f64, [f64; 2])> = self
            .texts
            .iter()
            .filter_map(|(text, at, _)| Some((text.replace('−', "-").parse::<f64>().ok()?, *at)))
            .collect();
        let other = 1 - axis;
        let first = match axis {
            // The numbers of the horizontal axis are the lowest numbers on the sheet.
            // The numbers of the vertical axis are the leftmost.
            0 => numbers.iter().map(|(_, at)| at[1]).fold(0.0, f64::larger),
            _ => numbers.iter().map(|(_, at)| at[0]).fold(f64::INFINITY, f64::smaller),
        };
        let row: Vec<_> = numbers.iter().filter(|(_, at)| (at[other] - first).abs() < 0.02).collect();
        let (low, high) = (row[0], row[row.len() - 1]);
        assert!(row.len() >= 3, "{numbers:?}");
        ((high.1[axis] - low.1[axis]) / (high.0 - low.0)).abs()
    }
}

fn span(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().fold(f64::NEG_INFINITY, f64::larger) - values.fold(f64::INFINITY, f64::smaller)
}

#[test]
fn the_numbers_are_those_of_solve() {
    let place = Place::new();
    let solved = table(&place.ok(&format!("solve {ROCKER} --crank-deg 0:360:7.5")));
    let shown = "--show link.rocker.angle_deg,link.rocker.omega_rad_s --show joint.A.f_N,point.B.v_m_s \
                 --show point.B.x_mm-1000*point.B.y_m";
    let text = place.ok(&format!("graph {ROCKER} --crank-deg 0:360:7.5 {shown} -o -.csv"));
    let found = table(&text);
    let wanted = ["crank_deg", "link.rocker.angle_deg", "link.rocker.omega_rad_s", "joint.A.f_N", "point.B.v_m_s"]
        .map(String::from);
    assert_eq!(found.names[..5], wanted);
    let rows = solved.of("t_s").len();
    let pair = |subject: &str, row: usize| {
        ["fx_N", "fy_N", "vx_m_s", "vy_m_s"]
            .map(|end| solved.columns.get(&format!("{subject}.{end}")).map_or(0.0, |column| column[row]))
    };
    assert_eq!((rows, found.of("crank_deg").len()), (49, 49));
    for row in 0..rows {
        let close = |name: &str, right: f64| {
            let own = found.of(name)[row];
            assert_within!((own - right).abs(), 1e-12 * right.abs().larger(1.0), "{name} in row {row}: {own} {right}");
        };
        close("crank_deg", solved.of("crank_rad")[row].to_degrees());
        close("link.rocker.angle_deg", solved.of("link.rocker.angle_rad")[row].to_degrees());
        close("link.rocker.omega_rad_s", solved.of("link.rocker.omega_rad_s")[row]);
        let [fx, fy, ..] = pair("joint.A", row);
        close("joint.A.f_N", fx.hypot(fy));
        let [.., vx, vy] = pair("point.B", row);
        close("point.B.v_m_s", vx.hypot(vy));
        close(&found.names[5], 1e3 * (solved.of("point.B.x_m")[row] - solved.of("point.B.y_m")[row]));
    }
}

#[test]
fn charts_have_their_curves_axes_and_numbers() {
    let place = Place::new();
    let shown = "--show link.rocker.omega_rad_s --show joint.A.f_N,joint.B.f_N,joint.C.f_N";
    let found = seen(&place.ok(&format!("graph {ROCKER} {shown} -o -")));
    assert_eq!(found.curves.len(), 4);
    assert_eq!(found.upward(), ["angular velocity of rocker, rad/s", "reaction, N"]);
    let words = found.upright();
    assert_eq!(words.iter().filter(|word| **word == "crank angle, deg").count(), 2);
    for number in ["0", "30", "180", "360"] {
        assert!(words.iter().filter(|word| **word == number).count() >= 2, "{number}: {words:?}");
    }
    // A single curve needs no legend. Three curves have a legend, and differ in their dashes.
    assert!(["A", "B", "C"].iter().all(|name| words.contains(name)) && !words.contains(&"rocker"), "{words:?}");
    let dashes: std::collections::BTreeSet<&str> = found.curves[1..].iter().map(|(dash, _)| dash.as_str()).collect();
    assert_eq!(dashes.len(), 3);
    // Everything lies on the sheet.
    for at in found.texts.iter().map(|(_, at, _)| at).chain(found.curves.iter().flat_map(|(_, corners)| corners)) {
        assert!((0..2).all(|axis| at[axis] >= 0.0 && at[axis] <= found.size[axis]), "{at:?} {:?}", found.size);
    }
}

/// The height of a drawn curve is the range of its values, at the scale that the numbers on the axis state.
#[test]
fn curves_are_true_to_the_scale_of_their_axes() {
    let place = Place::new();
    for (file, what) in [
        (ROCKER, "drive.torque_N_m"),
        (ROCKER, "link.rocker.alpha_rad_s2"),
        ("scenarios/ov7_base.toml", "link.rocker_87.omega_rad_s"),
        ("scenarios/scotch_yoke.toml", "drive.torque_N_m"),
    ] {
        let found = seen(&place.ok(&format!("graph {file} --show {what} -o -")));
        let numbers = table(&place.ok(&format!("graph {file} --show {what} -o -.csv")));
        let corners = &found.curves[0].1;
        let high = span(corners.iter().map(|at| at[1])) / found.scale(1);
        let right = span(numbers.of(what).iter().copied());
        assert_within!((high - right).abs(), 0.03 / found.scale(1), "{file} {what}: {high} {right}");
        let wide = span(corners.iter().map(|at| at[0])) / found.scale(0);
        let right = span(numbers.of(&numbers.names[0]).iter().copied());
        assert_within!((wide - right).abs(), 0.03 / found.scale(0), "{file} {what}: {wide} {right}");
    }
}

/// A unit has the same length on both axes of a hodograph, twelve positions are labelled, and arrows show the sense.
#[test]
fn hodographs_have_equal_scales_and_labelled_positions() {
    let place = Place::new();
    let file = format!("{ROCKER} --crank-deg 0:360:1");
    let svg = place.ok(&format!("graph {file} --show hodograph:joint.A -o -"));
    let found = seen(&svg);
    assert_within!((found.scale(0) / found.scale(1) - 1.0).abs(), 2e-3, "{} {}", found.scale(0), found.scale(1));
    let words = found.upright();
    assert!((0..12).all(|k| words.contains(&format!("{}°", 30 * k).as_str())) && !words.contains(&"360°"), "{words:?}");
    assert_eq!(svg.matches("<g>").count(), 2, "two arrows");
    assert!(words.contains(&"reaction along x in A, N") && found.upward() == ["reaction along y in A, N"], "{words:?}");
    let numbers = table(&place.ok(&format!("graph {file} --show hodograph:joint.A -o -.csv")));
    assert_eq!(numbers.names, ["joint.A.fx_N", "joint.A.fy_N"]);
    let corners = &found.curves[0].1;
    for (axis, name) in ["joint.A.fx_N", "joint.A.fy_N"].iter().enumerate() {
        let drawn = span(corners.iter().map(|at| at[axis])) / found.scale(axis);
        let right = span(numbers.of(name).iter().copied());
        assert_within!((drawn / right - 1.0).abs(), 3e-3, "{name}: {drawn} {right}");
    }
    let several = seen(&graph(&format!("{file} --show hodograph:point.B.v,hodograph:point.B.a -o -")));
    assert_eq!(several.curves.len(), 2);
}

#[test]
fn pdf_and_png_hold_the_same_charts() {
    let place = Place::new();
    place.ok(&format!("graph {ROCKER} --show reactions -o r.pdf -o r.png -o r.svg"));
    let pdf = fs::read(place.path("r.pdf")).unwrap();
    let text = String::from_utf8_lossy(&pdf);
    assert!(pdf.starts_with(b"%PDF-") && text.trim_end().ends_with("%%EOF"));
    assert_eq!((text.matches("/Type /Page\n").count(), text.matches("/Count 1").count()), (1, 1), "{}", &text[..300]);
    // The PDF contains four curves, their four line samples in the legend, and the outlines of letters.
    // Only curves and line samples have the line width 0.45 mm.
    assert!(text.matches("0.45 w").count() >= 8 && text.matches("\nf\n").count() > 20);
    let size = seen(&fs::read_to_string(place.path("r.svg")).unwrap()).size;
    let stated = text.split("/MediaBox [0 0 ").nth(1).unwrap().split(']').next().unwrap();
    for (stated, size) in stated.split(' ').map(|own| own.parse::<f64>().unwrap()).zip(size) {
        assert_within!((stated * 25.4 / 72.0 - size).abs(), 1e-3);
    }
    let png = fs::read(place.path("r.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png.len() > 10_000);
    let pixels = u32::from_be_bytes(png[16..20].try_into().unwrap());
    assert_eq!(f64::from(pixels), 12.0 * size[0]);
}

/// Further commands that write drawings also write them as PDF and as PNG.
#[test]
fn drawings_of_other_commands_are_written_as_pdf_too() {
    let place = Place::new();
    for command in [
        format!("draw {ROCKER} --loads"),
        format!("plan {ROCKER}"),
        format!("diagram {ROCKER} --channel point.B.x_m"),
        format!("drive {ROCKER}"),
        "clearance scenarios/crankcase.toml".into(),
    ] {
        let _ = place.run(&format!("{command} -o own.pdf"));
        let pdf = fs::read(place.path("own.pdf")).unwrap_or_else(|error| panic!("{command}: {error}"));
        assert!(pdf.starts_with(b"%PDF-") && pdf.len() > 5_000, "{command}");
        fs::remove_file(place.path("own.pdf")).unwrap();
        let _ = place.run(&format!("{command} -o own.png"));
        assert!(fs::read(place.path("own.png")).unwrap().starts_with(b"\x89PNG"), "{command}");
        fs::remove_file(place.path("own.png")).unwrap();
    }
}

/// Cyrillic letters are drawn. If the font lacks letters, boxes are drawn, and one warning names the letters.
#[test]
fn letters_are_drawn_or_named() {
    let place = Place::new();
    let names = [
        "--title",
        "Реакції в кінематичних парах",
        "--x-label",
        "кут повороту кривошипа φ, град",
        "--y-label",
        "реакція R, Н",
        "--legend",
        "R₀₁,R₁₂,R₂₃,R₀₃",
    ];
    for to in ["r.svg", "r.pdf", "r.png"] {
        let mut arguments = vec!["graph", ROCKER, "--show", "reactions"];
        arguments.extend(names);
        arguments.extend(["-o", to]);
        let (code, _, told) = given(&place, &arguments);
        assert_eq!(code, 0, "{to}: {told}");
    }
    let found = seen(&fs::read_to_string(place.path("r.svg")).unwrap());
    let upright = found.upright();
    assert!(upright.contains(&names[1]) && upright.contains(&names[3]) && upright.contains(&"R₁₂"), "{upright:?}");
    assert_eq!(found.upward(), [names[5]]);
    for to in ["x.png", "x.pdf"] {
        let (code, _, told) =
            given(&place, &["graph", ROCKER, "--show", "reactions", "--title", "力力 of 図", "-o", to]);
        assert!(code == 0 && told.contains("\"力\" (U+529B)") && told.contains("\"図\" (U+56F3)"), "{to}: {told}");
        assert!(told.matches("warning").count() == 1 && told.contains("write an SVG"), "{to}: {told}");
        assert!(place.path(to).exists());
    }
    let (code, _, told) = given(&place, &["graph", ROCKER, "--show", "reactions", "--title", "力", "-o", "x.svg"]);
    assert!(code == 0 && !told.contains("warning"), "{told}");
}

#[test]
fn mistakes_are_placed_and_answered() {
    for (arguments, told) in [
        (&["--show", "link.rokcer.angle_deg"][..], "did you mean"),
        (&["--show", "link.rocker.angle_deg, joint.A.f_M"], "joint.A.f_N"),
        (&["--show", "link.rocker.angle_deg *"], "link.rocker.angle_deg *"),
        (&["--show", "joint.*.f_M"], "no channel fits"),
        (&["--show", "hodograph:joint.Q"], "there is no vector joint.Q"),
        (&["--show", "hodograph:joint.A,joint.A.f_N"], "cannot have further curves"),
        (&["--show", "run-up,joint.A.f_N"], "cannot have further curves"),
        (&["--show", "joint.A.f_N", "--over", "links"], "--over"),
        (&["--show", "joint.A.f_N", "--legend", "a,b"], "2 names are given, but 1 curves"),
        (&["--show", "joint.A.f_N", "--size-mm", "160"], "160,70"),
        (&["--show", "joint.A.f_N", "--size-mm", "1,70"], "160,70"),
        (&["--show", "joint.A.f_N", "--both", "--with", "newton"], "analytic side"),
        (&["--show", "joint.A.f_N", "--sweeps", "4"], "--sweeps"),
        (&["--show", "hodograph:joint.A", "--difference"], "no hodograph"),
        (&["--show", ""], "error"),
    ] {
        let (code, out, error) = given(&Place::new(), &[&["graph", ROCKER, "-o", "-"], arguments].concat());
        assert!(code == 2 && out.is_empty() && error.contains(told), "{arguments:?}: {code} {error}");
    }
    // The position of a mistake is counted from the beginning of the option's text.
    let (_, _, error) = given(&Place::new(), &["graph", ROCKER, "-o", "-", "--show", "joint.A.f_N,joint.Z.f_N"]);
    assert!(error.contains("--show:1:13") || error.contains("--show:1:12"), "{error}");
}

/// The engine is drawn beside the reference.
/// The difference between engine and reference is small, but not zero.
#[test]
fn an_engine_is_drawn_beside_the_reference_or_as_a_difference() {
    let place = Place::new();
    let asked = format!("graph {ROCKER} --crank-deg 0:30:1 --show link.rocker.omega_rad_s");
    let both = table(&place.ok(&format!("{asked} --both -o -.csv")));
    let [first, second] = ["assur", "rapier"].map(|who| both.of(&format!("link.rocker.omega_rad_s, {who}")));
    let apart = table(&place.ok(&format!("{asked} --difference -o -.csv")));
    let apart = apart.of("link.rocker.omega_rad_s, rapier minus assur");
    let size = span(first.iter().copied());
    for ((one, other), own) in first.iter().zip(second).zip(apart) {
        assert_within!((other - one - own).abs(), 1e-12 * size);
    }
    let most = apart.iter().fold(0.0f64, |most, own| most.larger(own.abs()));
    assert!(most > 0.0 && most < 0.05 * size, "{most} {size}");
    let found = seen(&place.ok(&format!("{asked} --both -o -")));
    assert!(found.upright().contains(&"rapier") && found.upright().contains(&"assur"));
}

#[test]
fn a_formula_is_drawn_beside_its_claim() {
    let place = Place::new();
    let (file, name) = first_with_claim();
    let numbers = table(&place.ok(&format!("graph {file} --show {name} -o -.csv")));
    let [_, mechanism, formula] = numbers.names.as_slice() else { panic!("{:?}", numbers.names) };
    assert!(mechanism.ends_with("mechanism") && formula.contains(&name), "{:?}", numbers.names);
    let size = span(numbers.of(mechanism).iter().copied());
    for (one, other) in numbers.of(mechanism).iter().zip(numbers.of(formula)) {
        assert!(other.is_nan() || (one - other).abs() <= 1e-6 * size, "{file} {name}: {one} {other}");
    }
}

/// The first shipped scenario with a formula that claims a channel.
fn first_with_claim() -> (String, String) {
    let files = ["scenarios", "scenarios/formulas"].iter().flat_map(|folder| scenario::files_in(folder).unwrap());
    files
        .into_iter()
        .find_map(|path| {
            let own = linkproof::Scenario::load(&path).ok()?;
            let (formula, _) = own.formulas.claims().find(|(_, claim)| !claim.channels.is_empty())?;
            Some((path.display().to_string(), formula.name.clone()))
        })
        .expect("a scenario with formulas is shipped")
}

/// In the run-up of the design course, both curves start at rest, and the curve of the averaged model rises throughout.
#[test]
fn the_run_up_stands_beside_the_averaged_model() {
    let numbers = table(&graph("scenarios/crank_rocker_runup.toml --show run-up -o -.csv"));
    let name = |shaft: &str, who: &str| format!("{shaft}_omega_rad_s, {who}");
    let [exact, closed] = ["equation of motion", "averaged, closed form"].map(|who| numbers.of(&name("crank", who)));
    assert_eq!((exact[0], closed[0]), (0.0, 0.0));
    let motor = numbers.of(&name("motor", "equation of motion"));
    let ratio = motor[motor.len() - 1] / exact[exact.len() - 1];
    assert!(ratio > 5.0, "{ratio}");
    for (one, other) in exact.iter().zip(motor) {
        assert_within!((ratio * one - other).abs(), 1e-9 * other.abs().larger(1e-9));
    }
    let rising = closed.windows(2).all(|pair| pair[1] >= pair[0]);
    assert!(rising && span(closed.iter().copied()) > 5.0);
    let found = seen(&graph("scenarios/crank_rocker.toml --show run-up -o -"));
    assert_eq!((found.curves.len(), found.upward().len()), (4, 2));
    let (code, _, error) =
        given(&Place::new(), &["graph", "scenarios/scotch_yoke.toml", "--show", "run-up", "-o", "-"]);
    assert!(code == 2 && error.contains("has no motor"), "{error}");
}

/// The balancing moments from equilibrium and from powers agree up to rounding errors.
#[test]
fn the_difference_of_both_balancing_moments_is_rounding() {
    let numbers = table(&graph(&format!("{ROCKER} --show delta -o -.csv")));
    let most = numbers.of("delta").iter().fold(0.0f64, |most, own| most.larger(own.abs()));
    assert!(most > 0.0 && most < 1e-11, "{most:e}");
    let found = seen(&graph(&format!("{ROCKER} --show delta -o -")));
    assert!(found.upward()[0].starts_with("relative difference of the balancing moment, 10−"), "{:?}", found.upward());
}

/// Constant and zero quantities, a single instant, slides, a free motion and several drives are drawn. Constant curves
/// are straight: their rounding errors are not drawn.
#[test]
fn unusual_quantities_are_drawn() {
    let place = Place::new();
    let svg = |arguments: &str| {
        let text = place.ok(&format!("graph {arguments} -o -"));
        assert!(!text.contains("NaN") && !text.contains("inf"), "{arguments}");
        text
    };
    let constant = seen(&svg(&format!("{ROCKER} --show link.crank.omega_rad_s")));
    assert_eq!(span(constant.curves[0].1.iter().map(|at| at[1])), 0.0);
    let zero = seen(&svg(&format!("{ROCKER} --show link.crank.alpha_rad_s2")));
    assert_eq!(span(zero.curves[0].1.iter().map(|at| at[1])), 0.0);
    assert!(zero.upward()[0].ends_with(", rad/s²"), "{:?}", zero.upward());
    let one = svg(&format!("{ROCKER} --crank-deg 30 --show joint.A.f_N"));
    assert!(seen(&one).curves.is_empty() && one.contains("<circle"));
    let slide = seen(&svg("scenarios/boom_lift.toml"));
    assert!(slide.upright().contains(&"slide, mm"), "{:?}", slide.upright());
    let free = seen(&svg("scenarios/double_pendulum.toml"));
    assert!(free.upright().contains(&"time, s"), "{:?}", free.upright());
    svg("scenarios/five_bar.toml");
    svg("scenarios/robot_arm.toml --show drive.*");
    let phase = seen(&svg(&format!("{ROCKER} --over link.rocker.angle_deg --show link.rocker.omega_rad_s")));
    assert!(phase.upright().contains(&"angle of rocker, deg"), "{:?}", phase.upright());
    let (code, _, error) =
        given(&place, &["graph", ROCKER, "scenarios/boom_lift.toml", "--show", "reactions", "-o", "-"]);
    assert!(code == 2 && error.contains("the horizontal axes differ"), "{error}");
}

/// The usual charts of every shipped scenario are drawn: no scenario is left out.
#[test]
fn every_shipped_scenario_has_its_usual_charts() {
    let place = Place::new();
    for path in scenario::files_in("scenarios").unwrap() {
        let text = place.ok(&format!("graph {} -o -", path.display()));
        let found = seen(&text);
        assert!(!found.curves.is_empty() && !text.contains("NaN"), "{}", path.display());
    }
}

/// The picture leaves out some of many instants, but keeps the range of values. The table has all instants.
#[test]
fn many_instants_are_thinned_without_losing_extremes() {
    let place = Place::new();
    let asked = format!("graph {ROCKER} --crank-deg 0:3600:0.1 --show joint.A.f_N");
    let svg = place.ok(&format!("{asked} -o -"));
    let numbers = table(&place.ok(&format!("{asked} -o -.csv")));
    assert_eq!(numbers.of("joint.A.f_N").len(), 36_001);
    let found = seen(&svg);
    let corners = &found.curves[0].1;
    assert!(corners.len() < 7_000 && corners.len() > 1_000, "{}", corners.len());
    let high = span(corners.iter().map(|at| at[1])) / found.scale(1);
    let right = span(numbers.of("joint.A.f_N").iter().copied());
    assert_within!((high - right).abs(), 0.03 / found.scale(1), "{high} {right}");
}

/// Curves of several scenarios are in one chart, and have the names of their scenarios.
#[test]
fn several_scenarios_share_a_chart() {
    let asked = "scenarios/ov7_base.toml scenarios/ov7_new.toml --show drive.torque_N_m";
    let found = seen(&graph(&format!("{asked} -o -")));
    assert_eq!(found.curves.len(), 2);
    assert!(["ov7_base", "ov7_new"].iter().all(|name| found.upright().contains(name)), "{:?}", found.upright());
    let numbers = table(&graph(&format!("{asked} -o -.csv")));
    assert!(numbers.names.iter().any(|name| name == "drive.torque_N_m, ov7_new"), "{:?}", numbers.names);
}

#[test]
fn without_output_the_picture_is_made_beside_its_name() {
    let place = Place::new();
    let told = place.ok(&format!("graph {ROCKER}"));
    assert_eq!(told.trim(), "crank_rocker_graph.svg");
    assert!(Path::new(&place.path("crank_rocker_graph.svg")).exists());
    let found = seen(&fs::read_to_string(place.path("crank_rocker_graph.svg")).unwrap());
    // Angles, angular velocities and accelerations of three links, four reactions, one torque.
    assert_eq!((found.curves.len(), found.upward().len()), (14, 5));
}

#[test]
fn curves_without_values_and_surplus_labels_are_refused() {
    let place = Place::new();
    let refused = |arguments: &str, words: &[&str]| {
        place.refused(&format!("graph {ROCKER} {arguments} -o a.svg"), words);
        assert!(!place.path("a.svg").exists(), "{arguments}");
    };
    refused("--show link.rocker.omega_rad_s/0", &["link.rocker.omega_rad_s/0", "no value at any instant"]);
    refused("--show drive.torque_N_m --y-label a --y-label b", &["2 labels", "charts is 1"]);
}
