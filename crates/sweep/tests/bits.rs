//! The figures of cases solved in batches equal, bit by bit, the figures of the same cases read and solved alone.

use linkproof_sweep::{DesignKind, SweepAxis, SweepDesign, SweepPlan};
use scenario::Scenario;

const FIGURES: [&str; 22] = [
    "max:joint.A.f_N",
    "min:joint.B.fx_N",
    "maxabs:drive.torque_N_m",
    "mean:drive.torque_N_m",
    "rms:point.B.ax_m_s2",
    "range:point.B.x_mm",
    "at=30:point.B.vy_m_s",
    "at_maxabs:link.rocker.alpha_rad_s2",
    "max:link.coupler.omega_rad_s",
    "min:link.coupler.y_m",
    "maxabs:link.coupler.ax_m_s2",
    "at_min:joint.A.fy_N",
    "range:link.rocker.omega_rad_s",
    "rms:joint.B.f_N",
    "mean:joint.C.f_N",
    "transmission_angle_deg",
    "range:link.rocker.angle_deg",
    "at_min:link.coupler.angle_deg",
    "mean:link.crank.angle_rad",
    "at=350:link.coupler.angle_deg",
    "max:joint.A.fx_N + joint.B.fx_N*sin(link.rocker.angle_rad)",
    "at_max:point.B.v_m_s",
];

/// A four-bar whose points are given by parameters, distances and angles.
const TEXT: &str = r#"
format = 1
name = "four_bar"
title = "Four-bar linkage with the crank and the density as parameters"
[parameters]
crank_mm = 40
coupler_mm = 120
rocker_mm = "2*crank"
slant_deg = 12
density = 1.5
mean_density = "density/2 + 0.75"
[ground.points]
O = { x_mm = 0, y_mm = 0 }
C = { from = "O", length_mm = 100, angle_deg = "slant" }
[links.crank]
mass_kg = "density*crank"
mass_centre = { x_mm = "crank/2", y_mm = 0 }
inertia_kg_m2 = "density*crank^3/12"
[links.crank.points]
O = { x_mm = 0, y_mm = 0 }
A = { x_mm = "crank", y_mm = 0 }
[links.coupler]
mass_kg = 0.2
mass_centre = { from = "A", length_mm = "coupler/3", angle_deg = 5 }
inertia_kg_m2 = "mean_density*coupler^3/12"
[links.coupler.points]
A = { x_mm = 3, y_mm = -2 }
B = { from = "A", length_mm = "coupler", angle_rad = "atan2(1, 9) + 0.1*slant" }
[links.rocker.points]
C = { x_mm = 0, y_mm = 0 }
B = { x_mm = "rocker", y_mm = 0 }
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
speed_rpm = 300
[gravity]
x_m_s2 = 0
y_m_s2 = -9.81
[start]
crank_deg = 10
[[start.groups]]
links = ["coupler", "rocker"]
mode = "left"
[grid]
from_deg = 0
to_deg = 360
step_deg = 5
"#;

fn plan(text: &str, axes: &[&str], figures: &[&str], cases: u64) -> SweepPlan {
    let axes = axes.iter().map(|axis| SweepAxis::parse(axis).unwrap()).collect();
    let design = SweepDesign::of(DesignKind::Sobol { cases, seed: 7 }, axes).unwrap();
    let figures: Vec<String> = figures.iter().map(ToString::to_string).collect();
    SweepPlan::of((text.into(), "x.toml".as_ref()), Vec::new(), design, &figures, None, None).unwrap()
}

/// Solves every case with and without batches, and compares the bits. Returns the numbers of solved and of refused
/// cases.
fn compared(plan: &SweepPlan) -> [usize; 2] {
    let (mut fast, mut alone) = (plan.solver().unwrap(), plan.solver().unwrap().one_by_one());
    assert!(fast.is_fast() && !alone.is_fast());
    let mut counts = [0; 2];
    for case in 0..plan.design.cases() {
        let mut numbers = [0, 1].map(|_| (vec![0.0; plan.design.axes().len()], vec![0.0; plan.figures.len()]));
        let [(values, figures), (others, expected)] = &mut numbers;
        let found = fast.solve(case, values, figures);
        assert_eq!(found, alone.solve(case, others, expected), "case {case}");
        assert_eq!(values, others);
        for ((figure, own), expected) in plan.figures.iter().zip(&*figures).zip(&*expected) {
            assert_eq!(own.to_bits(), expected.to_bits(), "case {case}, {}: {own:e} {expected:e}", figure.text);
        }
        counts[usize::from(found.refusal.is_some())] += 1;
    }
    counts
}

#[test]
fn parameters_and_numbers_by_path_give_the_same_bits() {
    let axes = ["crank_mm=20:45", "coupler_mm=90:150", "slant_deg=-20:20", "density=normal(1.5, 0.2)"];
    let [solved, refused] = compared(&plan(TEXT, &axes, &FIGURES, 256));
    assert!(solved > 100 && refused > 20, "{solved} solved, {refused} refused");
    let axes = ["links.coupler.mass_kg=0.01:1", "ground.points.C.length_mm=90:120", "links.rocker.points.C.y_mm=-3:3"];
    let [solved, _] = compared(&plan(TEXT, &axes, &FIGURES, 64));
    assert!(solved > 30, "{solved} solved");
}

/// Masses that are not allowed are refused with the message of the reader.
#[test]
fn numbers_that_are_not_allowed_are_refused() {
    let [solved, refused] = compared(&plan(TEXT, &["links.coupler.mass_kg=-1:1"], &FIGURES[..3], 32));
    assert!(solved >= 12 && refused >= 12, "{solved} solved, {refused} refused");
}

#[test]
fn a_mechanism_of_three_dyads_gives_the_same_bits() {
    let file = fixtures::of_repository("scenarios/ov7_base.toml");
    let mut axes = Vec::new();
    let parameters: Vec<String> = file.formulas.parameters.iter().map(|own| own.key.clone()).collect();
    for own in &file.formulas.parameters {
        if own.key.ends_with("_mm") {
            axes.push(format!("{}={}:{}", own.key, own.given * 0.99, own.given * 1.01));
        }
    }
    assert!(axes.len() > 3, "{parameters:?}");
    let axes: Vec<&str> = axes.iter().map(String::as_str).collect();
    let figures = [
        "max:joint.1.f_N",
        "maxabs:drive.torque_N_m",
        "range:point.9.x_mm",
        "rms:joint.5a.f_N",
        "transmission_angle_deg",
        "max:point.9.v_m_s",
    ];
    // The oracles are left out, because their published numbers are in tables beside the file.
    let text = &file.text[..file.text.find("[[oracle]]").unwrap()];
    let [solved, _] = compared(&plan(text, &axes, &figures, 16));
    assert!(solved >= 8, "{solved} solved");
}

/// Cases that a batch cannot solve are read and solved one by one.
#[test]
fn other_questions_are_left_to_the_readers() {
    let is_fast =
        |text: &str, axes: &[&str], figures: &[&str]| plan(text, axes, figures, 4).solver().unwrap().is_fast();
    assert!(is_fast(TEXT, &["crank_mm=30:40"], &FIGURES));
    assert!(!is_fast(TEXT, &["crank_mm=30:40"], &["reach_to"]));
    assert!(!is_fast(TEXT, &["crank_mm=30:40"], &["max:joint.A.fx_N * crank"]));
    assert!(!is_fast(TEXT, &["drive.speed_rpm=100:300"], &FIGURES));
    let turned = TEXT.replace("speed_rpm = 300", "speed_rpm = \"7*crank_mm\"");
    assert!(!is_fast(&turned, &["crank_mm=30:40"], &FIGURES));
    assert!(is_fast(&turned, &["coupler_mm=110:130"], &FIGURES));
    let near = TEXT.replace("mode = \"left\"", "near = [ { point = \"B\", x_mm = 50, y_mm = 80 } ]");
    if Scenario::parse(&near, "x.toml").is_ok() {
        assert!(!is_fast(&near, &["crank_mm=30:40"], &FIGURES));
    }
}
