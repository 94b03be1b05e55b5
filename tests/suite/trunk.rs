//! Faults in code that all parties share, and independent numbers that reveal these faults.
//! The numbers are a run-up in closed form, and the same values as an `[[oracle]]` at a time.

use std::path::Path;

use crate::common::assert_within;
use crate::common::disc::disc;
use lab::mutate::{FaultyParty, MutationPlan, Plant, mutate, named};
use linkproof::{Case, Scenario, solve};

/// Rest of the file after the disc: a motor behind a reducer, with an initial speed.
const REDUCER: &str = r#"initial_speed_rad_s = 3

[motor]
law = "linear"
torque_at_rest_N_m = 1.5
slope_N_m_s = -0.01
ratio = 6
efficiency = 0.8
rotor_inertia_kg_m2 = 0.002

[start]
crank_deg = 10

[grid]
from_s = 0
to_s = 0.5
step_s = 0.05
"#;

/// Kinds of faults that change the course of a run-up in time.
const COURSE: [&str; 17] = [
    "initial-speed",
    "initial-speed-missing",
    "initial-speed-reversed",
    "free-held",
    "late",
    "clock",
    "start-angle",
    "inertia-crank",
    "motor-size",
    "motor-missing",
    "motor-reversed",
    "motor-without-ratio",
    "motor-ratio-twice",
    "motor-ratio",
    "motor-lossless",
    "rotor-missing",
    "rotor-ratio",
];

/// Angle (rad) and speed (rad/s) in closed form.
/// With J = J1 + i^2 Jr: J omega' = eta i (a + b i omega), so that omega tends to -a / (b i) with the time constant J /
/// (-eta b i^2).
fn closed(t: f64) -> [f64; 2] {
    let [inertia, rotor, ratio, efficiency, at_rest, slope, first] = [0.05, 0.002, 6.0, 0.8, 1.5, -0.01, 3.0];
    let last = -at_rest / (slope * ratio);
    let constant = (inertia + ratio * ratio * rotor) / (-efficiency * slope * ratio * ratio);
    let left = (-t / constant).exp();
    [10f64.to_radians() + last * t + (first - last) * constant * (1.0 - left), last + (first - last) * left]
}

/// Largest difference from the closed form: of the angle in rad, or of the speed divided by 25 rad/s.
fn off(case: &Case, times: &[f64]) -> f64 {
    let last = 25.0;
    let solved = solve(case).unwrap();
    let [angles, speeds] = ["link.disc.angle_rad", "link.disc.omega_rad_s"].map(|name| solved.named(name).unwrap());
    let mut worst = 0.0f64;
    for (row, t) in times.iter().enumerate() {
        let [angle, speed] = closed(*t);
        for own in [(speeds[row] - speed).abs() / last, (angles[row] - angle).abs()] {
            if !(own <= worst) {
                worst = own;
            }
        }
    }
    worst
}

#[test]
fn a_closed_form_run_up_finds_faults_hidden_at_crank_angles() {
    let scenario =
        Scenario::parse(&disc(REDUCER), Path::new("flywheel.toml")).unwrap_or_else(|error| panic!("{error}"));
    let (case, times) = (&scenario.case, &scenario.case.grid.times);
    assert_within!(off(case, times), 1e-9, "run-up of a disc against its closed form");
    for name in COURSE {
        let kind = named(name).unwrap_or_else(|| panic!("{name}"));
        let Plant::Case(change) = kind.plant else { panic!("{name} is no fault in a case") };
        let wrong = change(case, kind.size.unwrap_or(1.0)).unwrap_or_else(|| panic!("{name} cannot be planted"));
        // A failing run would also reveal the fault, but all of these runs succeed, so only the difference from the
        // closed form reveals the fault.
        let found = off(&wrong, times);
        assert!(!(found <= 1e-5), "{name} changes the run-up by {found:e} only");
    }
}

/// A scenario with reference values of the run-up, computed in closed form, finds every fault in the shared code.
/// Without independent numbers, nothing inside a proof can reveal faults in the shared code.
#[test]
fn numbers_at_a_time_find_faults_of_a_run_up() {
    let [angle, speed] = closed(0.23);
    let oracle = format!(
        "\n[[oracle]]\nsource = \"closed form\"\ntime_s = 0.23\nvalues = [\n\
         {{ channel = \"link.disc.angle_rad\", value = {angle:.7}, digits = 7 }},\n\
         {{ channel = \"link.disc.omega_rad_s\", value = {speed:.7}, digits = 7 }},\n]\n"
    );
    for (text, is_seen) in [(disc(REDUCER) + &oracle, true), (disc(REDUCER), false)] {
        let scenario = Scenario::parse(&text, Path::new("flywheel.toml")).unwrap_or_else(|error| panic!("{error}"));
        let kinds = COURSE.map(String::from).to_vec();
        let asked = MutationPlan { kinds, parties: vec![FaultyParty::All], ..MutationPlan::default() };
        let found = mutate(&scenario, &asked, &mut |_| {}).unwrap();
        assert_eq!(found.mutants.len(), COURSE.len(), "{:?}", found.without);
        for mutant in &found.mutants {
            assert_eq!(mutant.outcome.is_found(), is_seen, "{}: {:?}", mutant.kind.name, mutant.outcome);
        }
    }
}
