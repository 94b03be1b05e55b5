use std::fs;
use std::path::Path;

use crate::cli::tools::Place;
use scenario::Scenario;

const FOUR_BAR: &str = r#"
format = 1
name = "by_parameters"
title = "Crank-rocker with lengths by arithmetic"

[parameters]
a_mm = 40
b_mm = "3*a"
ratio = 2.5
w_rpm = 60

[ground.points]
O = { x_mm = 0, y_mm = 0 }
C = { x_mm = "a + b - 20", y_m = 0 }
[links.crank.points]
O = { x_mm = 0, y_mm = 0 }
A = { x_mm = "a", y_mm = 0 }
[links.coupler]
mass_kg = "ratio/2"
inertia_kg_m2 = "ratio/2*b^2/12"
mass_centre = { x_mm = "b/2", y_mm = 0 }
[links.coupler.points]
A = { x_mm = 0, y_mm = 0 }
B = { x_mm = "b_mm", y_mm = 0 }
[links.rocker.points]
C = { x_mm = 0, y_mm = 0 }
B = { x_mm = "sqrt(a*b)*sqrt(3)", y_mm = 0 }

[[joints]]
name = "O"
type = "revolute"
links = ["ground", "crank"]
[[joints]]
name = "A"
type = "revolute"
links = ["crank", "coupler"]
[[joints]]
name = "B"
type = "revolute"
links = ["coupler", "rocker"]
[[joints]]
name = "C"
type = "revolute"
links = ["ground", "rocker"]

[drive]
joint = "O"
speed_rpm = "w"

[start]
crank_deg = "30 + 15"
[[start.groups]]
links = ["coupler", "rocker"]
mode = "left"

[grid]
from_deg = 45
to_deg = 405
step_deg = "90/ratio"
"#;

/// The short name `b` of a parameter `b_mm` may be used in the value of a key.
/// If the key is a length too, `b` is the length in the unit of the key; otherwise `b` is the length in metres.
/// A whole key, such as `b_mm`, is the number as given, without conversion.
#[test]
fn numbers_may_be_expressions_of_parameters() {
    let scenario = Scenario::parse(FOUR_BAR, Path::new("x.toml")).unwrap_or_else(|error| panic!("{error}"));
    let links = scenario.case.mechanism.links();
    let size = |name: &str| links.iter().find(|link| link.name == name).unwrap().size();
    assert_eq!([size("crank"), size("coupler")], [0.04, 0.12]);
    assert!((size("rocker") - 0.12).abs() < 1e-15, "{}", size("rocker"));
    let coupler = links.iter().find(|link| link.name == "coupler").unwrap();
    assert_eq!((coupler.mass, coupler.mass_centre.x), (1.25, 0.06));
    assert!((coupler.inertia - 1.25 * 0.12 * 0.12 / 12.0).abs() < 1e-18);
    let crank = scenario.case.crank();
    assert!((crank.at(0.0).rate - std::f64::consts::TAU).abs() < 1e-14);
    assert_eq!(scenario.case.grid.len(), 11);
}

#[test]
fn parameters_are_set_from_the_command_line() {
    let place = Place::new();
    fs::write(place.path("mine.toml"), FOUR_BAR).unwrap();
    let radius = |arguments: &str| -> f64 {
        let csv = place.ok(&format!("solve mine.toml --with assur --only point.A.x_m --times 0 {arguments}"));
        let x: f64 = csv.lines().nth(1).unwrap().split(',').nth(2).unwrap().parse().unwrap();
        (1e9 * x / std::f64::consts::FRAC_1_SQRT_2).round() * 1e-9
    };
    assert_eq!([radius(""), radius("--set a_mm=50"), radius("--set b_mm=100")], [0.04, 0.05, 0.04]);
    place.ok("run mine.toml --no-record --set a_mm=30");
    place.refused("run mine.toml --no-record --set a_m=0.03", &["no parameter `a_m`", "a_mm"]);
    // Parameters that are computed from the changed parameter change too.
    let set = place.ok("solve mine.toml --with assur --times 0 --set a_mm=50");
    fs::write(place.path("other.toml"), FOUR_BAR.replace("a_mm = 40", "a_mm = 50")).unwrap();
    assert_eq!(set, place.ok("solve other.toml --with assur --times 0"));
}

#[test]
fn errors_in_expressions_are_shown_at_their_position() {
    let place = Place::new();
    for (old, new, words) in [
        ("x_mm = \"a + b - 20\"", "x_mm = \"a + c - 20\"", ["there is no `c`", "allowed here"]),
        ("x_mm = \"a\"", "x_mm = \"a,5\"", ["comma", "decimal point"]),
        ("x_mm = \"a\"", "x_mm = \"40 mm\"", ["operator is missing", "`*`"]),
        ("x_mm = \"a\"", "x_mm = \"sqrt(-a)\"", ["sqrt(-40) is undefined", "sqrt takes"]),
        ("mass_kg = \"ratio/2\"", "mass_kg = \"-ratio\"", ["must", "mass_kg"]),
        ("b_mm = \"3*a\"", "b_mm = \"3*b\"", ["there is no `b`", "`a`"]),
        ("b_mm = \"3*a\"", "b_mm = \"3*a\"\na = 4", ["would mean both `a_mm` and `a`", "keep one"]),
    ] {
        assert_eq!(FOUR_BAR.matches(old).count(), 1, "{old}");
        fs::write(place.path("mine.toml"), FOUR_BAR.replace(old, new)).unwrap();
        let outcome = place.refused("run mine.toml --no-record", &words);
        assert!(outcome.stderr.contains("mine.toml"), "{new}: {}", outcome.stderr);
    }
}
