//! Random higher groups, with and without sliders, alone and together with dyads.
//! Both analytic sides must agree: side 1 uses contours, angles and slides, side 2 absolute coordinates.

use crate::common::assert_within;
use crate::common::higher::{Among, FAMILIES, Family, mechanism};
use crate::common::sketch::RandomSource;
use analytic::{AssurSolver, NewtonSolver};
use linkage::ErrorKind;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::{Stage, Trajectory};
use prover::bounds::{magnitudes, residuals};

/// Number of mechanisms of each family.
const TRIES: usize = 60;

/// A measure of how near a motion comes to a singular pose.
/// The measure is the largest of all speeds and of the square roots of all accelerations, divided by the crank's speed.
/// The measure is at least 1.
/// The rounding error of a solution grows with the square of `nearness`.
/// Near a singular pose, accelerations are large even if a speed passes through zero.
/// Lengths are about a metre, so linear and angular speeds are of similar size.
fn nearness(trajectory: &Trajectory, crank: f64) -> f64 {
    let of = |(channel, values): (&linkage::trajectory::Channel, &[f64])| {
        let most = values.iter().fold(0.0f64, |max, v| max.larger(v.abs()));
        match channel.kind.stage {
            Stage::Velocities => most / crank,
            Stage::Accelerations => most.sqrt() / crank,
            _ => 0.0,
        }
    };
    trajectory.iter().map(of).fold(1.0, f64::larger)
}

/// Returns, for each stage, the largest difference of the two sides.
/// Each difference is divided by the magnitude of the channel's numbers and by the square of `nearness`.
/// Also returns the number of solved mechanisms, and the number of mechanisms whose start pose is the drawn pose.
fn worst(family: &Family, among: Among, tries: usize) -> ([f64; 5], usize, usize) {
    let mut random = RandomSource::from_seed(7);
    let (mut worst, mut solved, mut as_drawn) = ([0.0f64; 5], 0, 0);
    for _ in 0..tries {
        let (spec, drawn) = mechanism(&mut random, family, among);
        let scenario = match spec.scenario() {
            Ok(scenario) => scenario,
            // Approximate positions are refused if they fit two configurations or lead to no configuration.
            // The test allows no error other than these refusals.
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::Geometry, "{error}\n{}", spec.toml());
                assert!(error.message().contains("approximate position"), "{error}\n{}", spec.toml());
                continue;
            }
        };
        let case = &scenario.case;
        let group = case.structure.groups.iter().find(|group| group.links.len() > 2).expect("a higher group");
        assert_eq!((group.links.len(), group.class), (family.topology.links, family.topology.class));
        assert_within!(case.start.closure(&case.mechanism), 1e-12, "{}", spec.toml());
        let off = |(a, b): (&linkage::mechanism::LinkPose, &linkage::mechanism::LinkPose)| {
            (a.origin - b.origin).norm() < 1e-6
        };
        as_drawn += usize::from(case.start.0.iter().zip(&drawn).all(off));
        let (assur, newton) = (AssurSolver.solve(case), NewtonSolver.solve(case));
        // Beyond a dead point a comparison is impossible, but both sides must report the dead point.
        let (Ok(assur), Ok(newton)) = (&assur, &newton) else {
            assert!(assur.is_err() && newton.is_err(), "{:?} {:?}\n{}", assur.err(), newton.err(), spec.toml());
            continue;
        };
        solved += 1;
        let near = nearness(assur, case.crank().at(0.0).rate.abs());
        for (residual, size) in residuals(assur, newton).unwrap().iter().zip(magnitudes(assur)) {
            let share = residual.max / (size * near * near);
            let stage = residual.channel.kind.stage as usize;
            worst[stage] = worst[stage].larger(share);
        }
    }
    (worst, solved, as_drawn)
}

fn agree(among: Among, tries: usize) {
    for family in &FAMILIES {
        let (worst, solved, as_drawn) = worst(family, among, tries);
        let what = format!("{}, sliding {:?}, {among:?}", family.topology.name, family.slides);
        println!("{what}: {solved} solved, {as_drawn} as drawn, {}", worst.map(|w| format!("{w:.1e}")).join(" "));
        // Many mechanisms may end at dead points, but more than a tenth of all mechanisms must be solved.
        // More than half of all mechanisms must start in the drawn pose.
        assert!(solved * 10 > tries && as_drawn * 2 > tries, "{what}: only {solved}, {as_drawn} of {tries}");
        for stage in Stage::ALL {
            // The bounds are those of the published mechanisms.
            // The differences in `worst` are already divided by the square of `nearness`.
            let bound = match stage {
                Stage::Positions => 1e-12,
                Stage::Velocities | Stage::Accelerations => 1e-11,
                Stage::Reactions | Stage::BalancingMoment => 1e-10,
            };
            assert_within!(worst[stage as usize], bound, "{what}: {} {worst:?} of {solved}", stage.name());
        }
    }
}

#[test]
fn both_sides_agree_on_random_higher_groups() {
    agree(Among::Alone, TRIES);
}

#[test]
fn both_sides_agree_on_higher_groups_behind_a_dyad() {
    agree(Among::BehindADyad, TRIES / 2);
}

#[test]
fn both_sides_agree_on_higher_groups_that_carry_a_dyad() {
    agree(Among::CarryingADyad, TRIES / 2);
}
