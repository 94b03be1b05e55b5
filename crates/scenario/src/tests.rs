//! Checks the repository's scenarios with printed first rows, hand computation and random damage.

use std::path::{Path, PathBuf};

use proptest::prelude::*;

use super::*;
use linkage::math::Vec2;
use linkage::mechanism::{AssemblyMode, JointSide, LinkId};
use linkage::trajectory::Channel;

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

fn load(name: &str) -> Scenario {
    Scenario::load(scenarios().join(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// World position of a named point in the first pose (m).
fn start_point(scenario: &Scenario, name: &str) -> Vec2 {
    let case = &scenario.case;
    let (_, side) = case.mechanism.moving_points().find(|&(point, _)| point == name).unwrap();
    case.start.0[side.link].point(side.local)
}

#[test]
fn val_ov7_base_first_pose() {
    let scenario = load("ov7_base.toml");
    let positions = scenario.oracles.iter().find(|oracle| oracle.name == "positions.csv").unwrap();
    for point in ["2", "3", "5", "7", "9"] {
        let found = start_point(&scenario, point);
        for (axis, found) in [("x", found.x), ("y", found.y)] {
            let column = format!("P{point}{axis}_mm");
            let printed = positions.series.iter().find(|series| series.name == column).unwrap().points[0];
            assert_eq!(printed.at, When::Crank(0.0));
            assert!((found - printed.value).abs() <= 0.005e-3, "{column}: {found} against {}", printed.value);
        }
    }
    let angles = scenario.oracles.iter().find(|oracle| oracle.name == "angles.csv").unwrap();
    for series in &angles.series {
        let link = scenario.case.mechanism.link_named(&series.channel.of).unwrap();
        let away = linkage::math::angle::wrapped(scenario.case.start.0[link].angle - series.points[0].value);
        assert!(away.abs() <= series.points[0].bound, "{}: {away} rad away", series.name);
    }
    assert_eq!(scenario.case.modes, [AssemblyMode::Right; 3]);
    assert!(scenario.case.start.closure(&scenario.case.mechanism) < 1e-15);
}

#[test]
fn ov7_base_is_read_completely() {
    let scenario = load("ov7_base.toml");
    let case = &scenario.case;
    let formula = "I(ground, crank) -> II.2 RRR(rod_23, rocker_43) -> II.2 RRR(rod_35, rocker_65) \
                   -> II.2 RRR(rod_57, rocker_87)";
    assert_eq!(case.structure.formula(&case.mechanism), formula);
    assert_eq!((case.grid.len(), case.grid.inputs[90]), (361, -90f64.to_radians()));
    assert!(case.grid.times.iter().all(|&time| time >= 0.0));
    assert_eq!(scenario.engine, EngineSettings::default());
    let columns: Vec<usize> = scenario.oracles.iter().map(|oracle| oracle.series.len()).collect();
    // The last two oracles come from a separate program: a distance at the start, and one pose.
    assert_eq!(columns, [10, 10, 10, 7, 7, 7, 0, 84]);
    let rows = scenario.oracles[..6].iter().flat_map(|oracle| &oracle.series).map(|series| series.points.len());
    assert!(rows.into_iter().all(|rows| rows == 13));
    let angles = &scenario.oracles[3].series;
    assert_eq!(angles[6].channel, Channel::named("link.rocker_87.angle_rad").unwrap());
    let (eight_nine, eight_seven) = (angles[6].points[0], angles[5].points[0]);
    assert!((eight_nine.value - eight_seven.value).abs() < 1e-14);
    assert!((eight_nine.bound / 0.005f64.to_radians() - 1.0).abs() < 2e-9 && eight_nine.digits == 2);
}

#[test]
fn crank_rocker_starts_where_two_circles_meet() {
    let scenario = load("crank_rocker.toml");
    // Lengths computed by hand: |B - A| = 0.34707193189181 and |B - C| = 0.25 for A = (0.025995627740337, 0), C =
    // (0.15, 0.015).
    let (a, c) = (Vec2::new(0.025_995_627_740_337, 0.0), Vec2::new(0.15, 0.015));
    let b = start_point(&scenario, "B");
    assert!(((b - a).norm() - 0.347_071_931_891_81).abs() < 1e-15 && ((b - c).norm() - 0.25).abs() < 1e-15);
    assert!(linkage::math::cross(c - a, b - a) > 0.0, "B lies left of the line from A to C");
    let d = start_point(&scenario, "D");
    assert!((d - c - (b - c) * (4.0 / 3.0)).norm() < 1e-15);
    let crank = &scenario.case.mechanism.links()[LinkId(1)];
    let about_pivot = crank.inertia + crank.mass * crank.mass_centre.norm_squared();
    assert!((about_pivot - 2.6 * a.norm_squared() / 3.0).abs() < 1e-18, "I_O = m l^2 / 3");
    assert_eq!((scenario.engine.step.get(), scenario.engine_rel, scenario.case.grid.len()), (None, 1e-2, 361));
    let names: Vec<&str> = scenario.oracles.iter().map(|oracle| oracle.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "extreme position, stretched",
            "extreme position, folded",
            "reduced model",
            "steady speed",
            "lengths",
            "reduced model as printed",
            "steady speed as printed",
            "start",
            "Newton and Euler at 70 deg"
        ]
    );
    assert_eq!(scenario.oracles[2].figures[0].figure, MechanismFigure::ReducedInertiaMean);
    let printed = &scenario.oracles[4].figures;
    assert_eq!((printed[0].printed.value, printed[0].printed.bound), (0.013, 0.0005 * (1.0 + 1e-9)));
    let (finding, right) = printed[0].wrong.as_ref().unwrap();
    assert!(finding.starts_with("crank_rocker") && right.digits == 12 && right.value == 0.025_995_627_740);
    assert!(printed[2].wrong.is_none());
    // O is on the ground and the crank, A is on the crank and the coupler.
    // The distance is measured from the ground to the coupler.
    let [ground, coupler] = [0, 2].map(|link| JointSide {
        link: LinkId(link),
        local: scenario.case.mechanism.links()[LinkId(link)].points[0].local,
    });
    assert_eq!(printed[0].figure, MechanismFigure::Distance([ground, coupler]));
    let known = |index: usize| scenario.oracles[index].basis;
    assert_eq!([0, 2, 4].map(known), [OracleBasis::Derived, OracleBasis::Recomputed, OracleBasis::Published]);
}

#[test]
fn val_crank_rocker_extreme_positions_are_in_line() {
    let scenario = load("crank_rocker.toml");
    for (oracle, sign) in scenario.oracles.iter().zip([1.0, -1.0]) {
        let (crank, angle) = (oracle.series[0].points[0].at.crank().unwrap(), oracle.series[0].points[0].value);
        let a = linkage::math::unit(crank) * 0.025_995_627_740_337;
        let b = Vec2::new(0.15, 0.015) + linkage::math::unit(angle) * 0.25;
        assert!(((b - a).norm() - 0.347_071_931_891_81).abs() < 1e-14);
        assert!((b.norm() - 0.347_071_931_891_81 - sign * 0.025_995_627_740_337).abs() < 1e-14);
    }
}

fn edited(edits: &[(&str, &str)]) -> Scenario {
    let mut text = include_str!("../../../scenarios/crank_rocker.toml").to_string();
    for (from, to) in edits {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    Scenario::parse(&text, Path::new("edited.toml")).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn naming_a_group_in_reverse_order_swaps_its_mode() {
    let plain = edited(&[]);
    let turned = edited(&[
        ("links = [\"coupler\", \"rocker\"]\nmode", "links = [\"rocker\", \"coupler\"]\nmode"),
        ("mode = \"left\"", "mode = \"right\""),
    ]);
    assert_eq!((&turned.case.start, &turned.case.modes), (&plain.case.start, &plain.case.modes));
    let near = edited(&[("mode = \"left\"", "near = { point = \"D\", x_mm = 360, y_mm = 300 }")]);
    assert_eq!(near.case.start, plain.case.start);
}

#[test]
fn units_do_not_affect_the_case() {
    let plain = edited(&[]);
    let other = edited(&[
        ("C = { x_mm = 150, y_mm = 15 }", "C = { x_m = 0.15, y_m = 0.015 }"),
        ("mass_kg = 2.6", "mass_g = 2600"),
        ("[grid]", "[engine]\nstep_rad = -0.013613568165555769\n[grid]"),
        ("B = { x_mm = 250, y_mm = 0 }", "B = { from = \"C\", length_m = 0.25, angle_rad = 0 }"),
    ]);
    assert_eq!(other.case.mechanism, plain.case.mechanism);
    assert_eq!(other.case.start, plain.case.start);
    assert!((other.engine.step.get().unwrap() - 1e-3).abs() < 1e-17);
    let by_time = edited(&[("from_deg = 0\nto_deg = 360\nstep_deg = 1", "from_s = 0\nto_s = 0.4\nstep_ms = 100")]);
    assert_eq!(by_time.case.grid.times, [0.0, 0.1, 0.2, 3.0 * 0.1, 0.4]);
    assert!((by_time.case.grid.inputs[1] - 78f64.to_radians()).abs() < 1e-15);
}

#[test]
fn links_keep_the_order_of_the_file_when_their_points_come_first() {
    let text = "[links.b.points]\n[links.a]\n[links.b]\n[links.c]\n";
    let source = Source::new(Path::new("x.toml"), text);
    let tree = source.tree().unwrap();
    let links = TomlTable::root(&source, &tree).table("links").unwrap().all_tables().unwrap();
    let names: Vec<&str> = links.iter().map(TomlTable::name).collect();
    // The order is that of the headers of the links, not of the headers of their points.
    assert_eq!(names, ["a", "b", "c"]);
}

#[test]
fn cells_known_to_be_wrong_keep_their_finding() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("table.csv"), "\u{feff}turn_rad, B \r\n0,12.5\r\n0.5,9.25\r\n1e0,7\r\n")
        .unwrap();
    let text = include_str!("../../../scenarios/crank_rocker.toml").to_string()
        + "[[oracle]]\nsource = \"t\"\nfile = \"table.csv\"\ncrank = \"turn_rad\"\n[oracle.columns]\n\
           B = { channel = \"link.rocker.angle_deg\", offset_deg = 2.5, expect = [{ crank_rad = 0.5, finding = \"misprint\", right = { value = 7.125, digits = 3 } }] }\n";
    let scenario = Scenario::parse(&text, directory.path().join("x.toml")).unwrap_or_else(|error| panic!("{error}"));
    let oracle = scenario.oracles.last().unwrap();
    assert_eq!((oracle.name.as_str(), oracle.series[0].name.as_str()), ("table.csv", "B"));
    let expected = &oracle.series[0].expected;
    assert_eq!((expected.len(), expected[0].point.at, expected[0].point.digits), (1, When::Crank(0.5), 2));
    assert_eq!(expected[0].finding, "misprint");
    assert_eq!((expected[0].right.at, expected[0].right.digits), (When::Crank(0.5), 3));
    assert!((expected[0].right.value - 4.625f64.to_radians()).abs() < 1e-15);
    let points = &oracle.series[0].points;
    assert_eq!((points.len(), points[0].digits, points[1].digits, points[1].at), (2, 1, 2, When::Crank(1.0)));
    assert!((points[0].value - 10f64.to_radians()).abs() < 1e-15);
    // Trailing zeros were not printed: 7 has as many decimals as 9.25, and 12.5 has three significant digits.
    assert!((points[1].bound / 0.005f64.to_radians() - 1.0).abs() < 2e-9);
    // The angle 0 may have been rounded to one decimal, like 0.5 in the same column.
    // The angle 1e0 may have been rounded to one digit.
    assert!((points[0].at_error - 0.05).abs() < 1e-9 && (points[1].at_error - 0.5).abs() < 1e-8);
}

/// One random change that damages the lines of a scenario.
#[derive(Clone, Debug)]
enum Damage {
    Delete(usize),
    Double(usize),
    Swap(usize, usize),
    Value(usize, &'static str),
    Text(usize, String),
}

fn damage() -> impl Strategy<Value = Damage> {
    let values = prop::sample::select(vec![
        "nan",
        "-inf",
        "1e308",
        "1e-320",
        "0",
        "-1",
        "\"\"",
        "\"ground\"",
        "[]",
        "{}",
        "[\"a\"]",
        "true",
        "1979-05-27",
        "\"O\"",
        "99999999999999999999",
        "[\"crank\", \"rocker\"]",
        "\"left\"",
        "{ x_mm = 1, y_mm = 2 }",
    ]);
    prop_oneof![
        (0..200usize).prop_map(Damage::Delete),
        (0..200usize).prop_map(Damage::Double),
        (0..200usize, 0..200usize).prop_map(|(a, b)| Damage::Swap(a, b)),
        (0..200usize, values).prop_map(|(line, value)| Damage::Value(line, value)),
        (0..200usize, "\\PC{0,20}").prop_map(|(line, text)| Damage::Text(line, text)),
    ]
}

fn damaged(text: &str, damages: &[Damage]) -> String {
    let mut lines: Vec<String> = text.lines().map(ToString::to_string).collect();
    for damage in damages {
        let count = lines.len();
        match damage {
            Damage::Delete(line) => drop(lines.remove(line % count)),
            Damage::Double(line) => lines.insert(line % count, lines[line % count].clone()),
            Damage::Swap(a, b) => lines.swap(a % count, b % count),
            Damage::Value(line, value) => {
                let line = &mut lines[line % count];
                *line = format!("{} = {value}", line.split('=').next().unwrap_or_default());
            }
            Damage::Text(line, text) => lines[line % count].clone_from(text),
        }
    }
    lines.join("\n")
}

fn check(text: &str) -> std::result::Result<(), TestCaseError> {
    if let Err(error) = Scenario::parse(text, scenarios().join("damaged.toml")) {
        let Some(place) = error.place() else { return Err(TestCaseError::fail(format!("{error} has no place"))) };
        prop_assert!(place.text.get(place.span.clone()).is_some(), "{error} points outside its file");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_scenario_is_read_or_refused_with_a_position(damages in prop::collection::vec(damage(), 1..6)) {
        for text in [include_str!("../../../scenarios/crank_rocker.toml"), include_str!("../../../scenarios/ov7_base.toml")] {
            check(&damaged(text, &damages))?;
        }
    }

    #[test]
    fn any_text_is_read_or_refused_with_a_position(text in "[\\PC\\n]{0,200}") {
        check(&text)?;
    }
}
