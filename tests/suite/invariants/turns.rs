//! Whole revolutions: the pose repeats every 360 degrees, and the angles count the revolutions.

use linkage::math::KeepNan;
use std::f64::consts::TAU;

use linkage::case::Grid;

use crate::common::spec::four_bar;
use crate::common::{assert_within, states};
use linkage::mechanism::LinkId;

/// Lengths of base, crank, coupler and rocker of four-bars whose crank rotates fully.
/// The last two numbers are the revolutions of coupler and rocker per revolution of the crank.
const TURNING: [([f64; 4], [f64; 2]); 4] = [
    // Crank-rocker: the shortest link is the crank.
    ([0.4, 0.1, 0.35, 0.3], [0.0, 0.0]),
    ([0.15, 0.026, 0.347, 0.25], [0.0, 0.0]),
    // Drag link: the base is the shortest link, and all links rotate fully.
    ([0.1, 0.3, 0.35, 0.4], [1.0, 1.0]),
    ([0.2, 0.5, 0.45, 0.6], [1.0, 1.0]),
];

#[test]
fn three_turns_are_one_turn_three_times() {
    for (lengths, turning) in TURNING {
        for left in [true, false] {
            for speed in [12.0, -12.0] {
                for step_deg in [1.0f64, 15.0, 90.0] {
                    three_turns(lengths, turning, left, speed, step_deg);
                }
            }
        }
    }
}

fn three_turns(lengths: [f64; 4], turning: [f64; 2], left: bool, speed: f64, step_deg: f64) {
    let mut spec = four_bar(lengths, left);
    spec.speed = speed;
    let case = spec.scenario().unwrap_or_else(|error| panic!("{error}")).case;
    let turn = (360.0 / step_deg) as usize;
    let cranks = (0..=3 * turn).map(|k| (k as f64 * step_deg).to_radians() * speed.signum());
    let times = Grid::of_inputs(case.crank(), cranks.collect()).times;
    for solver in analytic::all() {
        let found = states(solver, &case, &times).unwrap_or_else(|error| panic!("{error}"));
        for (first, second) in found.iter().zip(&found[turn..]) {
            for (link, turns) in [(1, 1.0), (2, turning[0]), (3, turning[1])] {
                let gone = second.angles[LinkId(link)] - first.angles[LinkId(link)];
                let wrong = (gone - TAU * turns * speed.signum()).abs();
                assert_within!(wrong, 1e-12, "{} {lengths:?} link {link}: {gone} in a turn", solver.name());
            }
            for (a, b) in first.forces.iter().zip(&second.forces) {
                let bound = 1e-11 * first.forces.iter().map(|f| f.norm()).fold(0.0, f64::larger);
                assert_within!((a - b).norm(), bound, "{} {lengths:?}", solver.name());
            }
        }
        for pair in found.windows(2) {
            // No link of these mechanisms rotates more than eight times as fast as the crank.
            // If an angle changes by more than eight steps of the crank, the solver has miscounted a revolution.
            let limit = (8.0 * step_deg.to_radians()).smaller(TAU * 0.75);
            let jumps = (1..4).map(|link| (pair[1].angles[LinkId(link)] - pair[0].angles[LinkId(link)]).abs());
            assert_within!(jumps.fold(0.0, f64::larger), limit, "{} {lengths:?}", solver.name());
        }
    }
}
