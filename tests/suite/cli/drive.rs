//! `linkproof drive`.

use serde_json::Value;

use super::tools::Place;
use crate::common::assert_within;

fn near(value: &Value, expected: f64, within: f64) {
    let found = value.as_f64().unwrap_or_else(|| panic!("no number: {value}"));
    assert_within!((found - expected).abs(), within, "{found} {expected}");
}

#[test]
fn the_published_drive_as_json() {
    let place = Place::new();
    let json = place.ok("drive scenarios/crank_rocker.toml --non-uniformity 0.02 --step-deg 45 --json -");
    let value: Value = serde_json::from_str(&json).unwrap();
    near(&value["inertia_kg_m2"]["mean"], 0.164_846_013, 5.1e-10);
    near(&value["resistance_N_m"]["mean"], 160.0 / 9.0, 1e-10);
    near(&value["averaged"]["crank_rad_s"], 14.33204, 5e-6);
    near(&value["averaged"]["motor_rad_s"], 302.6266, 5e-5);
    // The time constant, computed by hand, is I* / (ratio^2 slope).
    let constant = 0.164_846_013 / ((2745.0f64 / 130.0).powi(2) * 0.0716);
    near(&value["averaged"]["time_constant_s"], constant, 2e-11);
    near(&value["steady"]["mean_rad_s"], 14.263_883_878_5, 1e-9);
    near(&value["steady"]["period_s"], 0.440_496_106_159_4, 1e-9);
    near(&value["steady"]["at_start_rad_s"], 16.679_930_049_7, 1e-9);
    near(&value["flywheel"]["steady"]["non_uniformity"], 0.02, 1e-9);
    let rows = value["by_angle"]["omega_rad_s"].as_array().unwrap();
    assert_eq!(rows.len(), 9);
    near(&rows[8], 16.679_930_049_7, 1e-9);
}

#[test]
fn a_run_up_as_csv() {
    let place = Place::new();
    let text = place.ok("drive scenarios/crank_rocker.toml --run-up - --seconds 0.1 --points 10");
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(header[..3], ["t_s", "crank_rad", "crank_omega_rad_s"]);
    assert!(header.contains(&"joint.B.fx_N") && header.contains(&"drive.torque_N_m"));
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 11);
    let (shaft, torque) =
        ["shaft_N_m", "drive.torque_N_m"].map(|name| header.iter().position(|h| *h == name).unwrap()).into();
    for row in &rows {
        assert_within!((row[shaft] - row[torque]).abs(), 1e-9, "{row:?}");
    }
    assert!(rows[0][2] == 0.0 && rows[10][2] > 10.0);
}

/// All words of a drawing, and the number of its curves (open paths).
fn drawn(text: &str) -> (String, usize) {
    let document = roxmltree::Document::parse(text).unwrap_or_else(|error| panic!("{error}: {text}"));
    let words = document.descendants().filter_map(|node| if node.is_text() { node.text() } else { None }).collect();
    let paths = document.descendants().filter_map(|node| node.attribute("d"));
    (words, paths.filter(|path| !path.ends_with('Z')).count())
}

#[test]
fn graphs_as_svg() {
    let place = Place::new();
    let (words, curves) = drawn(&place.ok("drive scenarios/crank_rocker.toml --svg -"));
    assert_eq!(curves, 4);
    for label in [
        "moment of inertia I*, kg m2",
        "dI*/dφ",
        "moment of resistance Mr, N m",
        "steady motion ω, rad/s",
        "crank angle φ, deg",
        "mean 0.1648",
        "least 0.01111 at 234.2°",
        "greatest 0.4641 at 329.4°",
        "mean 17.78",
        "greatest 36.99 at 94.2°",
        "slowest 13.04 at 305.6°",
        "fastest 17.33 at 9.5°",
        "mean over time 14.26",
        "non-uniformity 0.300370",
    ] {
        assert!(words.contains(label), "{label}: {words}");
    }
    // The command writes the drawing in addition to the text.
    // Without a motor there is no steady motion, and a resistance by gravity alone has a zero mean.
    let text = place.ok("drive scenarios/ov7_base.toml --svg ov7.svg");
    assert!(text.contains("no motor"), "{text}");
    let (words, curves) = drawn(&std::fs::read_to_string(place.path("ov7.svg")).unwrap());
    assert!(curves == 3 && words.contains("-330°") && words.contains("mean 0") && !words.contains("e-18"), "{words}");
    // In clockwise motion the steady speed is negative, so the slowest point is the upper of the two marked points.
    place.edited("crank_rocker.toml", "back.toml", &[("speed_rpm = 130", "speed_rpm = -130")]);
    let (words, curves) = drawn(&place.ok("drive scenarios/back.toml --svg -"));
    let there = ["slowest -12.11 at -10.1°", "greatest 0.4641 at -30.6°", "mean 17.78", "mean over time -14.26"];
    assert!(curves == 4 && there.iter().all(|label| words.contains(label)), "{words}");
}

#[test]
fn text_report_and_hint_on_a_missing_motor() {
    let place = Place::new();
    let text = place.ok("drive scenarios/crank_rocker.toml --table");
    for words in [
        "mean      0.164846 kg·m²",
        "mean      17.7778 N·m",
        "period 0.440496 s",
        "dI*/dphi",
        "time constant 0.005164 s",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(place.ok("drive scenarios/ov7_base.toml").contains("no motor: add a `[motor]` section"));
}

#[test]
fn mistakes_are_reported() {
    let place = Place::new();
    for (arguments, words) in [
        ("--non-uniformity 0", ["non-uniformity of 0 is requested", "above zero"]),
        ("--step-deg -1", ["'-1' for '--step-deg", "greater than 0"]),
        ("--run-up - --seconds 0", ["'0' for '--seconds", "greater than 0"]),
        ("--run-up - --points 0", ["'0' for '--points", "at least 1"]),
        ("--run-up - --from-rpm nan", ["'nan' for '--from-rpm", "finite"]),
        ("--run-up same --json same", ["--output and --run-up both name same", "two files"]),
        ("--run-up same --svg same", ["--output and --run-up both name same", "two files"]),
        ("--svg - --json -", ["two results go to -", "two files"]),
    ] {
        let outcome = place.run(&format!("drive scenarios/crank_rocker.toml {arguments}"));
        assert_eq!(outcome.code, 2, "{arguments}");
        assert!(words.iter().all(|word| outcome.stderr.contains(word)), "{arguments}: {}", outcome.stderr);
    }
    for (file, words) in [
        ("ov7_base.toml --non-uniformity 0.1", "no motor"),
        ("five_bar.toml", "2 degrees of freedom"),
        ("tangent.toml", "does not turn fully"),
    ] {
        let outcome = place.run(&format!("drive scenarios/{file}"));
        assert!(outcome.code == 2 && outcome.stderr.contains(words), "{file}: {}", outcome.stderr);
    }
}

/// A flywheel under a linear motor, with a load that becomes smaller at once: the crank's acceleration changes its sign
/// at the jump.
/// The mean speed is compared with a numerical integration of d(omega)/d(phi) = M / (J omega) over three turns.
/// The last turn is periodic.
#[test]
fn regress_a_jump_of_a_load_does_not_stall_the_motor() {
    let place = Place::new();
    let text = "format = 1\nname = \"jump\"\ntitle = \"Jump\"\nground.points = { O = { x_mm = 0, y_mm = 0 } }\n\
        start = { crank_deg = 0 }\n[links.m]\npoints = { O = { x_mm = 0, y_mm = 0 } }\nmass_kg = 3\n\
        mass_centre = { x_mm = 0, y_mm = 0 }\ninertia_kg_m2 = 0.05\n[[joints]]\nname = \"O\"\ntype = \"revolute\"\n\
        links = [\"ground\", \"m\"]\n[drive]\njoint = \"O\"\nspeed_rad_s = 10\nmotion = \"free\"\n[motor]\n\
        law = \"linear\"\ntorque_at_rest_N_m = 60\nslope_N_m_s = -4\nratio = 1\n[[loads]]\ntype = \"moment\"\n\
        link = \"m\"\ntable = [{ crank_deg = 0, moment_N_m = -1 }, { crank_deg = 100, moment_N_m = -1 },\n\
        { crank_deg = 100, moment_N_m = -0.5 }, { crank_deg = 360, moment_N_m = -0.5 }]\n\
        [grid]\nfrom_s = 0\nto_s = 1\nstep_s = 0.02\n";
    std::fs::write(place.path("jump.toml"), text).unwrap();
    let value: Value = serde_json::from_str(&place.ok("drive jump.toml --json -")).unwrap();
    let step = 0.01f64.to_radians();
    let (mut omega, mut time) = (14.8, 0.0);
    for row in 0..3 * 36_000 {
        let load = if row % 36_000 < 10_000 { 1.0 } else { 0.5 };
        let rate = |omega: f64| (60.0 - 4.0 * omega - load) / (0.05 * omega);
        let middle = omega + 0.5 * step * rate(omega);
        time = if row % 36_000 == 0 { 0.0 } else { time } + step / middle;
        omega += step * rate(middle);
    }
    near(&value["steady"]["mean_rad_s"], std::f64::consts::TAU / time, 1e-6);
    near(&value["steady"]["at_start_rad_s"], omega, 1e-6);
}
