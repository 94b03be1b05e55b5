//! Motions that begin at rest.
//! A quantity that depends on the direction of motion takes the direction in which the motion begins.
//! This direction must not come from the rounding error of the speed.

use std::path::Path;

use crate::common::{assert_within, shipped, states};
use analytic::{AssurSolver, NewtonSolver};
use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::mechanism::LinkId;
use linkage::solver::Solver;
use scenario::Scenario;

fn case_of(text: &str) -> Case {
    Scenario::parse(text, Path::new("setting_off.toml")).unwrap_or_else(|error| panic!("{error}")).case
}

/// Both analytic sides, and the engines `rapier` and `impulse` with the time step `step` (s), each with its bound.
fn solvers(step: f64) -> Vec<(Box<dyn Solver>, f64)> {
    let mut all: Vec<(Box<dyn Solver>, f64)> = vec![(Box::new(AssurSolver), 1e-11), (Box::new(NewtonSolver), 1e-11)];
    for name in ["rapier", "impulse"] {
        all.push((prover::engines::named(name, step).unwrap(), 1e-3));
    }
    all
}

/// Angular accelerations of all links at the first instants.
fn accelerations(solver: &dyn Solver, case: &Case) -> Vec<f64> {
    let found = states(solver, case, &[0.0, 1e-4]).unwrap_or_else(|error| panic!("{}: {error}", solver.name()));
    found.iter().flat_map(|state| state.motions.iter().map(|motion| motion.alpha)).collect()
}

/// Symptom: with an efficiency below 1, the multibody's accelerations at t = 0 were wrong by a factor of 1 / efficiency
/// squared.
/// Cause: at rest, the sign of the crank's speed is rounding error, and a negative speed means that power flows back to
/// the motor.
#[test]
fn regress_a_motor_with_a_lossy_reducer_starts_forwards() {
    let text = shipped("crank_rocker_runup.toml").text;
    let lossy = text.replace("slope_N_m_s = -0.0716", "slope_N_m_s = -0.0716\nefficiency = 0.9");
    for text in [lossy.replace("speed_rpm = 130", "speed_rpm = -130"), lossy] {
        let case = case_of(&text);
        let known = accelerations(&AssurSolver, &case);
        let scale = known.iter().fold(0.0f64, |most, alpha| most.larger(alpha.abs()));
        for (solver, bound) in solvers(2e-5) {
            for (found, known) in accelerations(solver.as_ref(), &case).iter().zip(&known) {
                assert_within!((found - known).abs() / scale, bound, "{}: {found} {known}", solver.name());
            }
        }
    }
}

/// A weight on the crankshaft, in closed form: alpha = (M - m g s) / (J + m s^2).
/// M is the motor's torque times the ratio.
/// If the motor lifts the weight, M is multiplied by the efficiency.
/// If the weight drives the motor, M is divided by the efficiency.
/// Symptom: side 2 took the motor's losses in the forward direction at t = 0, although the crank starts backwards.
#[test]
fn regress_a_weight_that_drives_the_motor_meets_its_losses() {
    let [mass, inertia, arm, gravity] = [2.0, 0.05, 0.3, 9.81];
    for (torque, efficiency, factor) in [(2.0, 0.8, 0.8), (0.5, 0.8, 1.0 / 0.8), (0.5, 1.0, 1.0)] {
        for sense in [1.0, -1.0] {
            let text = format!(
                "format = 1\nname = \"weight\"\ntitle = \"weight\"\n[ground.points]\nO = {{ x_m = 0, y_m = 0 }}\n\
                 [links.crank]\nmass_kg = {mass}\ninertia_kg_m2 = {inertia}\nmass_centre = {{ x_m = {:?}, y_m = 0 }}\n\
                 [links.crank.points]\nO = {{ x_m = 0, y_m = 0 }}\n\
                 [[joints]]\nname = \"O\"\ntype = \"revolute\"\nlinks = [\"ground\", \"crank\"]\n\
                 [drive]\njoint = \"O\"\nmotion = \"free\"\ninitial_speed_rad_s = 0\nspeed_rad_s = {:?}\n\
                 [motor]\nlaw = \"constant\"\ntorque_N_m = {torque}\nratio = 4\nefficiency = {efficiency}\n\
                 [gravity]\nx_m_s2 = 0\ny_m_s2 = -{gravity}\n[start]\ncrank_deg = 0\n\
                 [grid]\nfrom_s = 0\nto_s = 0.1\nstep_s = 0.01\n[engine]\ndt_s = 1e-4\n",
                sense * arm,
                sense * 5.0,
            );
            let case = case_of(&text);
            let expected = sense * (4.0 * factor * torque - mass * gravity * arm) / (inertia + mass * arm * arm);
            for (solver, bound) in solvers(1e-5) {
                let found = states(solver.as_ref(), &case, &[0.0]).unwrap_or_else(|error| panic!("{error}"));
                let found = found[0].motions[LinkId(1)].alpha;
                let message = format!("{} {torque} {sense}: {found} {expected}", solver.name());
                assert_within!((found / expected - 1.0).abs(), bound, "{message}");
            }
        }
    }
}

/// Symptom: the two sides gave motions in opposite directions, and neither side explained why.
/// Cause: from rest, the crank may start in both directions, because a load drives it in one direction and the motor in
/// the opposite direction.
/// Side 1 took one direction, side 2 the opposite direction.
#[test]
fn regress_an_ambiguous_start_is_refused() {
    let text = shipped("crank_rocker_runup.toml").text.replace("speed_rpm = 130", "speed_rpm = -130");
    let load = "[[loads]]\ntype = \"moment\"\nlink = \"crank\"\nacts = \"counter-clockwise\"\nmoment_N_m = 500\n\n";
    let case = case_of(&text.replacen("[[loads]]", &format!("{load}[[loads]]"), 1));
    let error = AssurSolver.solve(&case).unwrap_err();
    assert!(error.message().contains("from rest in either sense") && error.way_out().is_some(), "{error}");
}

/// A pendulum on a driven crank is at rest when the motion begins; its load acts against the motion that then begins.
/// Symptom: at the first instant, the check of the whole mechanism's momentum did not include this load, so a correct
/// motion disagreed.
#[test]
fn regress_a_load_on_a_link_that_starts_at_rest_agrees() {
    let text = |load: &str| {
        format!(
            "format = 1\nname = \"pendulum\"\ntitle = \"pendulum\"\n[ground.points]\nO = {{ x_m = 0, y_m = 0 }}\n\
             [links.crank]\nmass_kg = 3\ninertia_kg_m2 = 0.01\nmass_centre = {{ x_m = 0.1, y_m = 0 }}\n\
             [links.crank.points]\nO = {{ x_m = 0, y_m = 0 }}\nA = {{ x_m = 0.15, y_m = 0 }}\n\
             [links.bob]\nmass_kg = 2\ninertia_kg_m2 = 0.05\nmass_centre = {{ x_m = 0.3, y_m = 0.02 }}\n\
             [links.bob.points]\nA = {{ x_m = 0, y_m = 0 }}\nB = {{ x_m = 0.5, y_m = 0 }}\n\
             [[joints]]\nname = \"O\"\ntype = \"revolute\"\nlinks = [\"ground\", \"crank\"]\n\
             [[joints]]\nname = \"A\"\ntype = \"revolute\"\nlinks = [\"crank\", \"bob\"]\n\
             [[drive]]\njoint = \"O\"\nspeed_rad_s = 2.5\n\
             [[drive]]\njoint = \"A\"\nmotion = \"free\"\nspeed_rad_s = 2\ninitial_speed_rad_s = 0\nstart_deg = -40\n\
             [gravity]\nx_m_s2 = 0\ny_m_s2 = -9.81\n[[loads]]\n{load}\n[start]\ncrank_deg = 130\n\
             [grid]\nfrom_s = 0\nto_s = 0.3\nstep_s = 0.01\n"
        )
    };
    for load in [
        "type = \"resistance\"\nlink = \"bob\"\nmoment_N_m = 0.8",
        "type = \"moment\"\nlink = \"bob\"\nmoment_N_m = 0.8\nacts = \"clockwise\"",
        "type = \"moment\"\nlink = \"bob\"\nmoment_N_m = -0.8\nacts = \"counter-clockwise\"",
    ] {
        let scenario =
            Scenario::parse(&text(load), Path::new("pendulum.toml")).unwrap_or_else(|error| panic!("{error}"));
        let proof =
            linkproof::prove(&scenario, &linkproof::Options::default()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(proof.verdict.word(), "agree", "{load}: {:?}", proof.verdict);
    }
}
