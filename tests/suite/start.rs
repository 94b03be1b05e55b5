//! First poses of mechanisms with prismatic joints, from their files, against hand computation.

use crate::common::assert_within;
use std::path::Path;

use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::AssemblyMode;
use scenario::Scenario;

/// A crank OA of 100 mm and the given links, joints and start; the crank is at `crank` degrees.
fn parse(ground: &str, body: &str, crank: f64, start: &str) -> linkage::Result<Scenario> {
    let text = format!(
        "format = 1\nname = \"start\"\ntitle = \"start\"\n[ground.points]\nO = {{ x_mm = 0, y_mm = 0 }}\n{ground}\n\
         [links.crank.points]\nO = {{ x_mm = 0, y_mm = 0 }}\nA = {{ x_mm = 100, y_mm = 0 }}\n{body}\n\
         [[joints]]\nname = \"O\"\ntype = \"revolute\"\nlinks = [\"ground\", \"crank\"]\n\
         [drive]\njoint = \"O\"\nspeed_rpm = 60\n[start]\ncrank_deg = {crank}\n{start}\n\
         [grid]\nfrom_deg = 0\nto_deg = 10\nstep_deg = 5\n[engine]\ndt_ms = 1\n"
    );
    Scenario::parse(&text, Path::new("start.toml"))
}

/// Position of a point (mm) in the start pose; the pose must be closed.
fn place(scenario: &Scenario, name: &str) -> Vec2 {
    let case = &scenario.case;
    assert_within!(case.start.closure(&case.mechanism), 1e-15);
    let (_, side) = case.mechanism.moving_points().find(|&(point, _)| point == name).unwrap();
    case.start.0[side.link].point(side.local) * 1e3
}

fn assert_at(found: Vec2, x: f64, y: f64) {
    assert_within!((found - Vec2::new(x, y)).norm(), 1e-10, "{found:?} for {x}, {y}");
}

const SLIDER: &str = r#"
[links.rod.points]
A = { x_mm = 0, y_mm = 0 }
B = { x_mm = 260, y_mm = 0 }
[links.slider.points]
B = { x_mm = 0, y_mm = 0 }
[[joints]]
name = "A"
type = "revolute"
links = ["crank", "rod"]
[[joints]]
name = "B"
type = "revolute"
links = ["rod", "slider"]
"#;

/// Slider-crank. `guide` contains the links, points and axis of the prismatic joint, as keys of the file.
fn slider_crank(guide: &str, start: &str) -> linkage::Result<Scenario> {
    let guide = format!("[[joints]]\nname = \"guide\"\ntype = \"prismatic\"\n{guide}\n");
    parse("G = { x_mm = 10, y_mm = 0 }", &format!("{SLIDER}{guide}"), 90.0, start)
}

const FORWARD: &str = "links = [\"ground\", \"slider\"]\npoints = [\"G\", \"B\"]\naxis_deg = 0";

fn start(mode: &str) -> String {
    format!("[[start.groups]]\nlinks = [\"rod\", \"slider\"]\n{mode}")
}

#[test]
fn a_slider_lies_ahead_of_the_crank_pin_or_behind_it() {
    // A = (0, 100), rod 260: B = (+-240, 0).
    let ahead = slider_crank(FORWARD, &start("mode = \"ahead\"")).unwrap();
    assert_at(place(&ahead, "B"), 240.0, 0.0);
    assert_eq!(ahead.case.modes, [AssemblyMode::Ahead]);
    assert_at(place(&slider_crank(FORWARD, &start("mode = \"behind\"")).unwrap(), "B"), -240.0, 0.0);
    // Three variants, each with one change: the axis is reversed, the slider is the first link, or an approximate
    // position replaces the mode.
    let backward = FORWARD.replace("axis_deg = 0", "axis_deg = 180");
    assert_at(place(&slider_crank(&backward, &start("mode = \"ahead\"")).unwrap(), "B"), -240.0, 0.0);
    let swapped = "links = [\"slider\", \"ground\"]\npoints = [\"B\", \"G\"]\naxis_deg = 0";
    assert_at(place(&slider_crank(swapped, &start("mode = \"ahead\"")).unwrap(), "B"), 240.0, 0.0);
    let near = slider_crank(FORWARD, &start("near = { point = \"B\", x_mm = -200, y_mm = 30 }")).unwrap();
    assert_at(place(&near, "B"), -240.0, 0.0);
    let [nearest, next] = [near.choices[0].nearest_m, near.choices[0].next_m].map(Option::unwrap);
    assert_within!((nearest - 0.05).abs(), 1e-15, "{nearest} {next}");
    assert_within!((next - 0.44f64.hypot(0.03)).abs(), 1e-15, "{nearest} {next}");
}

#[test]
fn a_rod_that_is_too_short_is_reported_in_metres() {
    let short = SLIDER.replace("x_mm = 260", "x_mm = 90");
    let guide = format!("[[joints]]\nname = \"guide\"\ntype = \"prismatic\"\n{FORWARD}\n");
    let error =
        parse("G = { x_mm = 10, y_mm = 0 }", &format!("{short}{guide}"), 90.0, &start("mode = \"ahead\"")).unwrap_err();
    let words = "0.100000 m away from its outer pin, but its rod is 0.090000 m long";
    assert!(error.to_string().contains(words), "{error}");
    let error = slider_crank(FORWARD, &start("")).unwrap_err();
    assert!(error.to_string().contains("add `mode = \"ahead\"` or `mode = \"behind\"`, or `near = "), "{error}");
    let error = slider_crank(FORWARD, &start("mode = \"left\"")).unwrap_err();
    assert!(error.to_string().contains("write \"ahead\" or \"behind\""), "{error}");
}

#[test]
fn a_guide_swings_to_either_side() {
    let body = r#"
[links.guide.points]
C = { x_mm = 0, y_mm = 0 }
T = { x_mm = 400, y_mm = 0 }
[links.block.points]
A = { x_mm = 0, y_mm = 0 }
[[joints]]
name = "A"
type = "revolute"
links = ["crank", "block"]
[[joints]]
name = "C"
type = "revolute"
links = ["ground", "guide"]
[[joints]]
name = "slot"
type = "prismatic"
links = ["guide", "block"]
points = ["C", "A"]
axis_deg = 0
"#;
    // C = (-240, 0), A = (0, 100): the unit vector from C to A is (12, 5)/13.
    // The guide points in this direction or in the opposite direction.
    for (mode, sign) in [("ahead", 1.0), ("behind", -1.0)] {
        let start = format!("[[start.groups]]\nlinks = [\"guide\", \"block\"]\nmode = \"{mode}\"");
        let scenario = parse("C = { x_mm = -240, y_mm = 0 }", body, 90.0, &start).unwrap();
        assert_at(place(&scenario, "T"), -240.0 + sign * 400.0 * 12.0 / 13.0, sign * 400.0 * 5.0 / 13.0);
    }
}

/// Two mechanisms that need no start, because each has only one configuration: the Scotch yoke (RPP), and a crank with
/// a slot in which the slider runs (PRP).
#[test]
fn dyads_of_two_sliders_need_no_start() {
    let yoke = r#"
[links.block.points]
A = { x_mm = 0, y_mm = 0 }
[links.yoke.points]
S = { x_mm = 0, y_mm = 0 }
[[joints]]
name = "A"
type = "revolute"
links = ["crank", "block"]
[[joints]]
name = "slot"
type = "prismatic"
links = ["yoke", "block"]
points = ["S", "A"]
axis_deg = 90
[[joints]]
name = "guide"
type = "prismatic"
links = ["ground", "yoke"]
points = ["G", "S"]
axis_deg = 0
"#;
    let scenario = parse("G = { x_mm = 0, y_mm = 50 }", yoke, 60.0, "").unwrap();
    assert_at(place(&scenario, "S"), 50.0, 50.0);
    assert_eq!(scenario.case.modes, [AssemblyMode::Only]);
    // The slot is parallel to the guide, so either no position or every position fits.
    let error =
        parse("G = { x_mm = 0, y_mm = 50 }", &yoke.replace("axis_deg = 90", "axis_deg = 0"), 60.0, "").unwrap_err();
    assert!(error.to_string().contains("the axes of its two prismatic joints are parallel"), "{error}");

    let tangent = r#"
[links.runner.points]
P = { x_mm = 0, y_mm = 0 }
[links.slider.points]
P = { x_mm = 0, y_mm = 0 }
[[joints]]
name = "slot"
type = "prismatic"
links = ["crank", "runner"]
points = ["O", "P"]
axis_deg = 0
[[joints]]
name = "P"
type = "revolute"
links = ["runner", "slider"]
[[joints]]
name = "guide"
type = "prismatic"
links = ["ground", "slider"]
points = ["G", "P"]
axis_deg = 90
"#;
    let scenario = parse("G = { x_mm = 300, y_mm = 0 }", tangent, 30.0, "").unwrap();
    assert_at(place(&scenario, "P"), 300.0, 300.0 / 3f64.sqrt());
}

/// The remaining closure error in a start pose is rounding, far below the limit of [`linkage::case::Case::new`].
#[test]
fn start_poses_of_all_scenarios_close_to_rounding() {
    let (mut worst, mut count) = (0.0f64, 0);
    for folder in ["scenarios", "scenarios/variants60"] {
        let files = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).unwrap();
        for path in files.map(|file| file.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "toml"))
        {
            let case = Scenario::load(&path).unwrap().case;
            let reach = case.start.0.iter().fold(case.mechanism.size(), |most, pose| most.larger(pose.origin.norm()));
            let open = case.start.closure(&case.mechanism) / reach;
            assert_within!(open, 1e-12, "{}", path.display());
            (worst, count) = (worst.larger(open), count + 1);
        }
    }
    println!("largest opening over reach in {count} scenarios: {worst:.1e}");
    assert!(count > 70, "{count}");
}
