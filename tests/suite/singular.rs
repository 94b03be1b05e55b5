//! Singular poses and their neighbourhood: both analytic sides report an error with the crank angle, and never answer
//! silently.

use std::path::Path;

use crate::common::chain::four_bars;
use crate::common::spec::{Spec, four_bar};
use crate::common::{assert_within, shipped};
use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Grid, When};
use linkage::error::ErrorKind;
use linkage::math::KeepNan;
use linkage::mechanism::LinkId;
use linkage::solver::Solver;
use scenario::Scenario;

const SIDES: [&dyn Solver; 2] = [&AssurSolver, &NewtonSolver];

/// A four-bar of these lengths (ground, crank, coupler, rocker) at crank angles in degrees.
fn at(lengths: [f64; 4], left: bool, start: f64, cranks: &[f64]) -> Case {
    let mut spec: Spec = four_bar(lengths, left);
    spec.start = start.to_radians();
    let case = spec.scenario().unwrap_or_else(|error| panic!("{error}")).case;
    let times = cranks.iter().map(|crank| case.crank().time_of(crank.to_radians())).collect();
    case.on(Grid::of_times(case.crank(), times)).unwrap()
}

/// Both sides refuse the case, and name a crank angle near `crank` (deg).
fn is_refused(what: &str, case: &Case, crank: f64) {
    for side in SIDES {
        let error = match side.solve(case) {
            Ok(_) => panic!("{what}: {} answers", side.name()),
            Err(error) => error,
        };
        assert!(matches!(error.kind(), ErrorKind::Geometry | ErrorKind::Numeric), "{what}: {error}");
        let found = error.input().unwrap_or_else(|| panic!("{what}: {error}")).value.to_degrees();
        assert_within!((found - crank).abs(), 1e-3, "{what}: {}: {error}", side.name());
    }
}

/// Symptom: at and beyond a change point of a parallelogram, side 1 let the rocker jump from 20 to -8.6 rad/s.
/// At the change point, side 2 gave forces of 3e25 N.
/// Cause: a closed form keeps the sign of a dyad's sine, and a determinant that is zero except for rounding still has a
/// sign.
#[test]
fn regress_change_points_are_refused() {
    let parallelogram = [0.4, 0.1, 0.4, 0.1];
    for left in [true, false] {
        is_refused("at", &at(parallelogram, left, 60.0, &[90.0, 180.0, 270.0]), 180.0);
        is_refused("up to", &at(parallelogram, left, 60.0, &[180.0]), 180.0);
        is_refused("over", &at(parallelogram, left, 60.0, &[95.0, 175.0, 185.0, 275.0]), 180.0);
        is_refused("over, in one step of one degree", &at(parallelogram, left, 179.5, &[179.5, 180.5]), 180.0);
        is_refused("back over", &at(parallelogram, left, 60.0, &[60.0, -10.0]), 0.0);
        // The fault report did not mention the next two mechanisms.
        // They are a kite, and a four-bar whose longest and shortest links together are as long as its other two links.
        is_refused("kite", &at([0.3, 0.2, 0.2, 0.3], left, 90.0, &[90.0, 200.0]), 180.0);
        is_refused("sum", &at([0.5, 0.1, 0.25, 0.35], left, 90.0, &[90.0, 170.0, 190.0]), 180.0);
    }
}

/// Slightly off the change point, both sides continue and agree.
#[test]
fn poses_near_a_change_point_are_passed() {
    for (ground, bound) in [(0.401, 1e-9), (0.40001, 1e-6)] {
        for left in [true, false] {
            let case = at([ground, 0.1, 0.4, 0.1015], left, 60.0, &[95.0, 175.0, 179.9, 180.1, 185.0, 275.0]);
            let [one, two] = SIDES.map(|side| side.solve(&case).unwrap_or_else(|error| panic!("{ground}: {error}")));
            for ((channel, a), (_, b)) in one.iter().zip(two.iter()) {
                let scale = a.iter().fold(1e-9f64, |most, value| most.larger(value.abs()));
                for (a, b) in a.iter().zip(b) {
                    assert_within!((a - b).abs() / scale, bound, "{channel}: {a} {b}");
                }
            }
        }
    }
}

/// Both sides refuse a limit of rotation and solve the poses next to it.
#[test]
fn dead_points_are_refused() {
    let lengths = [0.4, 0.3, 0.25, 0.2];
    let limit = ((0.4f64.powi(2) + 0.3f64.powi(2) - 0.45f64.powi(2)) / (2.0 * 0.4 * 0.3)).acos().to_degrees();
    is_refused("dead point", &at(lengths, true, 30.0, &[30.0, limit]), limit);
    for off in [1e-3, 1e-6, 1e-9] {
        for side in SIDES {
            side.solve(&at(lengths, true, 30.0, &[30.0, limit - off])).unwrap_or_else(|error| panic!("{off}: {error}"));
        }
    }
}

/// Symptom: 1e-9 deg from a dead point, side 2 gave the acceleration of the crank pin wrong by 176 %.
/// Cause: one elimination over all rows mixed the rounding error of the neighbouring group's huge accelerations into
/// the rows of the crank.
/// The motion of the crank depends on its drive alone, and is exact in this test.
/// The mechanism is ten times as large as the mechanism of the fault report, because lever arms above 1 m become pivots
/// of the elimination.
#[test]
fn regress_a_dead_point_does_not_affect_the_driving_link() {
    let lengths = [4.0, 3.0, 2.5, 2.0];
    let limit = ((16.0f64 + 9.0 - 4.5 * 4.5) / (2.0 * 4.0 * 3.0)).acos();
    for off in [1e-3f64, 1e-9, 1e-11] {
        let case = at(lengths, true, 30.0, &[(limit - off.to_radians()).to_degrees()]);
        let pin = case.mechanism.links()[LinkId(1)].points.iter().find(|point| point.local.norm() > 1.0).unwrap().local;
        let mut found = None;
        NewtonSolver
            .each(&case, &mut |_, state| {
                found = Some(state.motions[LinkId(1)]);
                Ok(())
            })
            .unwrap();
        let (crank, drive) = (found.unwrap(), case.crank().at(case.grid.times[0]));
        let expected = -crank.arm(pin) * drive.rate.powi(2);
        let error =
            (crank.point_acceleration(pin) - crank.point_acceleration(linkage::math::Vec2::zeros()) - expected).norm();
        assert_within!(error / expected.norm(), 1e-12, "{off}: {crank:?}");
        assert_eq!((crank.omega, crank.alpha), (drive.rate, drive.acceleration));
    }
}

/// Symptom: at a change point in free motion side 2 took ever smaller steps, and had no answer after ten minutes.
/// With an even number of loops, side 2 passed the change point with errors up to 8e-7 rad.
/// Cause: with an even number of loops, the determinant of the whole system kept its sign.
/// Free motions pass change points, see `dynamics/through.rs`; free motions with several driving links do not.
#[test]
fn regress_a_free_motion_continues_at_a_change_point() {
    for pairs in [1, 2] {
        let case = four_bars(pairs, 2.0, 0.1);
        for side in SIDES {
            side.solve(&case).unwrap_or_else(|error| panic!("{} {pairs}: {error}", side.name()));
        }
    }
}

/// The computed rotation of a link that only translates is rounding error, so it must not determine the direction of a
/// load.
/// Symptom: with a resistance of 100 N m on the coupler of a parallelogram, the sides gave -452 N and 413 N for one
/// reaction.
#[test]
fn regress_a_link_that_only_translates_has_no_sense_of_rotation() {
    let mut spec = four_bar([0.4, 0.1, 0.4, 0.1], true);
    spec.start = 30f64.to_radians();
    let plain = spec.scenario().unwrap();
    let load = "[[loads]]\ntype = \"resistance\"\nlink = \"coupler\"\nmoment_N_m = 100\n[start]";
    let names: Vec<&str> = plain.case.mechanism.links().iter().map(|link| link.name.as_str()).collect();
    let text = plain.text.replace("[start]", &load.replace("coupler", names[2]));
    let loaded = Scenario::parse(&text, Path::new("loaded.toml")).unwrap_or_else(|error| panic!("{error}"));
    let cranks: Vec<f64> = (30..150).step_by(10).map(f64::from).collect();
    let on = |case: &Case| {
        let times = cranks.iter().map(|crank| case.crank().time_of(crank.to_radians())).collect();
        case.on(Grid::of_times(case.crank(), times)).unwrap()
    };
    assert!(!loaded.case.can_turn(LinkId(2)) && loaded.case.can_turn(LinkId(1)) && loaded.case.can_turn(LinkId(3)));
    let mut solvers: Vec<Box<dyn Solver>> = vec![Box::new(AssurSolver), Box::new(NewtonSolver)];
    for name in ["rapier", "impulse"] {
        solvers.push(prover::engines::named(name, 1e-3).unwrap());
    }
    for solver in solvers {
        let [with, without] = [&loaded.case, &plain.case].map(|case| solver.solve(&on(case)).unwrap());
        for ((channel, with), (_, without)) in with.iter().zip(without.iter()) {
            assert_eq!(with, without, "{}: {channel}", solver.name());
        }
    }
}

/// The coupler of an almost exact parallelogram rotates, so its rotation has a sense.
#[test]
fn a_link_that_turns_slightly_keeps_its_sense() {
    let case = at([0.4, 0.1, 0.4, 0.1 + 1e-9], true, 30.0, &[30.0]);
    assert!(case.can_turn(LinkId(2)));
    assert!(shipped("crank_rocker.toml").case.can_turn(LinkId(2)));
}

/// A crank whose pins lie on its axis moves nothing.
#[test]
fn regress_a_crank_without_length_is_refused() {
    let error = four_bar([0.4, 0.0, 0.4, 0.4], true).scenario().unwrap_err();
    assert!(error.message().contains("moves no point"), "{error}");
    assert!(error.scenario_key().is_some(), "{error}");
}

/// If the direct rotation to a crank angle crosses a dead point, the configurations at this angle are found by rotation
/// in the opposite direction.
#[test]
fn regress_configurations_beyond_a_dead_point_are_found() {
    // The crank swings between 44 and 316 deg.
    // Coupler and rocker connect only if their outer joints are between d = 0.3 and 0.9 apart.
    let lengths = [0.4f64, 0.4, 0.3, 0.6];
    let limit = ((0.16f64 + 0.16 - 0.09) / 0.32).acos().to_degrees();
    let case = at(lengths, true, limit + 10.0, &[limit + 10.0]);
    let there = (limit + 20.0 - 360.0).to_radians();
    let modes = analytic::modes::all(&case, When::Crank(there)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(modes[0].modes.iter().filter(|mode| mode.is_followed).count(), 1);
}

/// A chain with ten loops; side 1 first follows all poses over the revolution.
/// An older version took 2.7 s for this solution, and its time grew with the third power of the number of loops.
#[test]
fn both_sides_solve_a_long_chain() {
    let case = four_bars(10, 0.01, 0.01);
    let [one, two] = SIDES.map(|side| side.solve(&case).unwrap_or_else(|error| panic!("{}: {error}", side.name())));
    for ((channel, a), (_, b)) in one.iter().zip(two.iter()) {
        for (a, b) in a.iter().zip(b) {
            assert_within!((a - b).abs() / (1.0 + a.abs()), 1e-10, "{channel}: {a} {b}");
        }
    }
}
