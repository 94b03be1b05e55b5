//! `linkproof new`: the first steps of a newcomer in an empty directory.

use std::f64::consts::TAU;
use std::fs;

use linkage::math::KeepNan;
use scenario::Scenario;
use scenario::templates::TEMPLATES;

use super::tools::{Place, Table};
use crate::common::assert_within;

#[test]
fn every_template_is_proven_for_its_whole_motion() {
    let place = Place::empty();
    let mut claims = 0;
    for template in TEMPLATES {
        let said = place.ok(&format!("new {}", template.name));
        let file = format!("{}.toml", template.scenario_name());
        assert!(said.starts_with(&format!("{file}: {}", template.title())), "{said}");
        let text = fs::read_to_string(place.path(&file)).unwrap();
        let scenario = Scenario::parse(&text, place.path(&file)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((scenario.name, scenario.title), (template.scenario_name(), template.title()));
        let (drive, inputs) = (scenario.case.crank(), &scenario.case.grid.inputs);
        let whole = match drive.end() {
            _ if drive.is_free() => {
                assert_eq!(template.name, "pendulum");
                None
            }
            Some(end) => Some(drive.at(end).value - drive.at(0.0).value),
            // With transmissions, such as gears, the grid may cover several whole revolutions.
            None if !scenario.case.mechanism.transmissions().is_empty() => {
                Some(((inputs.last().unwrap() - inputs[0]) / TAU).round().larger(1.0) * TAU)
            }
            None => Some(TAU),
        };
        if let Some(whole) = whole {
            assert_within!((inputs.last().unwrap() - inputs[0] - whole).abs(), 1e-12, "{}", template.name);
        }
        let told = place.run(&format!("run {file} --no-record --quiet"));
        assert!(told.code == 0 && told.stdout.contains(": AGREE"), "{}{}", told.stdout, told.stderr);
        if text.contains("channel = ") {
            let judged = place.run(&format!("check {file}"));
            assert!(judged.code == 0, "{}{}", judged.stdout, judged.stderr);
            claims += 1;
        }
    }
    assert!(claims >= 9, "{claims}");
}

#[test]
fn templates_are_listed_and_unknown_ones_refused() {
    let place = Place::empty();
    let list = place.ok("new");
    assert_eq!(list, place.ok("new --list"));
    for template in TEMPLATES {
        assert!(
            list.lines().any(|line| line.starts_with(template.name) && line.ends_with(&template.title())),
            "{list}"
        );
    }
    place.refused("new fourbar", &["no template \"fourbar\"", "did you mean \"four-bar\"?", "class-iv"]);
    place.refused(
        "new four-bar --set crank=30",
        &["no dimension `crank`", "did you mean `crank_mm`?", "rocker_mm = 80"],
    );
    place.refused("new four-bar --set crank_mm=much", &["crank_mm"]);
    place.refused("new four-bar -o nowhere/four_bar.toml", &["nowhere"]);
    assert_eq!(fs::read_dir(place.path("")).unwrap().count(), 0);
}

#[test]
fn a_file_is_replaced_only_with_force() {
    let place = Place::empty();
    assert!(place.ok("new klann -o -").starts_with("# A leg of Klann's spider"));
    place.ok("new four-bar -o mine.toml --set crank_mm=30");
    let mine = fs::read_to_string(place.path("mine.toml")).unwrap();
    assert!(mine.contains("name = \"mine\"") && mine.contains("\ncrank_mm = 30 #"), "{mine}");
    place.refused("new watt -o mine.toml", &["mine.toml already exists", "--force"]);
    assert_eq!(fs::read_to_string(place.path("mine.toml")).unwrap(), mine);
    place.ok("new watt -o mine.toml --force");
    assert!(fs::read_to_string(place.path("mine.toml")).unwrap().starts_with("# A Watt six-bar"));
}

#[test]
fn lengths_that_do_not_fit_are_written_and_reported() {
    let place = Place::empty();
    for (file, set, words) in [
        ("a.toml", "crank_mm=400", "cannot be assembled"),
        ("b.toml", "coupler_mm=55", "are"),
        ("c.toml", "ground_mm=0", "links"),
    ] {
        let told = place.run(&format!("new four-bar -o {file} --set {set}"));
        assert_eq!(told.code, 2, "{set}: {}", told.stdout);
        for word in [words, "written anyway", "crank_mm = 40, coupler_mm = 120"] {
            assert!(told.stderr.contains(word), "{set}: `{word}` is not in: {}", told.stderr);
        }
        assert!(fs::read_to_string(place.path(file)).unwrap().contains(&set.replace('=', " = ")));
    }
}

/// `new --shipped` writes the files that examples in the help texts need.
#[test]
fn help_examples_run_in_an_empty_directory() {
    let place = Place::empty();
    place.ok("new --shipped");
    place.refused("new --shipped", &["already exists", "--force"]);
    place.ok("new --shipped again");
    for command in [
        "list",
        "inspect scenarios/ov7_base.toml",
        "bearings scenarios/ov7_new_tabulated.toml --lever-mm 10 --stress-mpa 200",
        "check scenarios/formulas/slider_crank_centric.toml",
        "drive scenarios/crank_rocker.toml --catalogue catalogues/motors.toml --efficiency 0.92",
        "solve scenarios/ov7_base.toml --with assur --crank-deg 0:-360:-30",
        "docs findings#crank_rocker-steady-speed",
        "docs scenario",
        "docs",
    ] {
        assert!(!place.ok(command).is_empty(), "{command}");
    }
    place.refused("docs scenaro", &["no page", "did you mean \"scenario\"?"]);
    place.refused("docs scenario#rule", &["no section", "rules"]);
    place.refused("inspect catalogues/motors.toml", &["linkproof docs scenario"]);
}

/// Coordinates of the foot (m) at every degree of a revolution.
fn steps(template: &str, foot: &str) -> (Vec<f64>, Vec<f64>) {
    let place = Place::empty();
    place.ok(&format!("new {template}"));
    let table =
        Table::of(&place.ok(&format!("solve {template}.toml --with assur --crank-deg 0:360:1 --only point.{foot}")));
    (table.column(&format!("point.{foot}.x_m")), table.column(&format!("point.{foot}.y_m")))
}

/// Number of crank degrees at which the foot is on the ground, and the part of its stride that the foot covers during
/// these degrees.
/// The foot is on the ground if its height is at most `share` of its stride.
fn on_the_ground(x: &[f64], y: &[f64], share: f64) -> (usize, f64) {
    let lowest = |values: &[f64]| values.iter().copied().reduce(KeepNan::smaller).unwrap();
    let span = |values: &[f64]| values.iter().copied().reduce(KeepNan::larger).unwrap() - lowest(values);
    let ground = lowest(y);
    let flat: Vec<f64> = x.iter().zip(y).filter(|(_, y)| **y <= ground + share * span(x)).map(|(x, _)| *x).collect();
    (flat.len(), span(&flat) / span(x))
}

/// Jansen's foot is on the ground for almost half a revolution, and covers most of its stride during this time.
#[test]
fn jansens_leg_walks() {
    let (x, y) = steps("jansen", "S");
    let (degrees, stride) = on_the_ground(&x, &y, 0.02);
    assert!(degrees > 150 && stride > 0.85, "{degrees} {stride}");
}

/// In the pose of the patent's table, at a crank angle of 180 degrees, the foot is at (0, 0).
/// Half a revolution earlier, the foot is one unit of the table (100 mm) further along x.
/// Between these two poses the foot is on the ground.
#[test]
fn klanns_leg_walks() {
    let (x, y) = steps("klann", "P33");
    for (crank, [x_wanted, y_wanted]) in [(0, [0.1, 0.0]), (90, [0.05, 0.0]), (180, [0.0, 0.0])] {
        assert_within!((x[crank] - x_wanted).abs(), 6e-4);
        assert_within!((y[crank] - y_wanted).abs(), 6e-4);
    }
    assert!(y[270] > 0.04, "{}", y[270]);
}
