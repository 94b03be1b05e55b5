//! Energy of whole mechanisms, summed over the links.

use linkage::math::KeepNan;
use std::f64::consts::TAU;

use crate::common::{assert_within, centre, centre_velocity, shipped};
use analytic::PoseSolver;
use analytic::reduced::{CrankState, ReducedModel, RunUpEnd, motion};
use linkage::case::Case;
use linkage::trajectory::Stage;

/// Kinetic and potential energy (J).
fn energy(case: &Case, poses: &mut PoseSolver, at: &CrankState) -> [f64; 2] {
    let state = poses.solve(at.within, at.omega, at.alpha, Stage::Velocities).unwrap();
    let mut sum = [0.0; 2];
    for (index, link) in case.mechanism.links().entries().skip(1) {
        let velocity = centre_velocity(case, state, index);
        sum[0] += (link.mass * velocity.norm_squared() + link.inertia * state.motions[index].omega.powi(2)) / 2.0;
        sum[1] -= link.mass * case.gravity.dot(&centre(case, state, index));
    }
    sum
}

/// Without motor and loads the energy is constant.
/// The energy is checked over a hundred revolutions, at many instants.
#[test]
fn conservative_mechanisms_keep_their_energy() {
    for (name, speed) in [("crank_rocker", 30.0), ("compressor", 40.0), ("six_bar_slider", 100.0), ("ov7_base", -97.0)]
    {
        let case = shipped(&format!("{name}.toml")).case;
        let case = case.with(|parts| parts.loads.clear()).unwrap().with_motor(None).unwrap();
        let model = ReducedModel::of(&case).unwrap();
        // The times are long enough for a hundred revolutions; the speed varies about its initial value.
        let times: Vec<f64> = (0..=4000).map(|k| f64::from(k) * 0.1 * TAU / f64::abs(speed)).collect();
        let (mut found, end) = motion(&model, speed, &times, 3e-15).unwrap();
        assert_eq!(end, RunUpEnd::Reached, "{name}");
        let start = found[0].crank;
        let turns = |at: &CrankState| (at.crank - start).abs() / TAU;
        assert!(turns(&found[4000]) > 100.0, "{name}: {}", turns(&found[4000]));
        found.retain(|at| turns(at) <= 100.0);
        let mut poses = PoseSolver::new(&case).unwrap();
        let first: f64 = energy(&case, &mut poses, &found[0]).iter().sum();
        let mut worst = 0.0f64;
        let mut scale = 0.0f64;
        for at in &found {
            let [kinetic, potential] = energy(&case, &mut poses, at);
            worst = worst.larger((kinetic + potential - first).abs());
            scale = scale.larger(kinetic);
        }
        assert_within!(worst / scale, 1e-12, "{name}: {:e}", worst / scale);
        println!("{name}: energy kept to {:.1e} over 100 turns", worst / scale);
    }
}

/// A mechanism that runs freely against a resistance loses exactly the work of the resistance.
/// This work is 100 N m times the angle travelled by the rocker.
#[test]
fn a_resistance_dissipates_exactly_its_work() {
    let case = shipped("crank_rocker.toml").case.with_motor(None).unwrap();
    let model = ReducedModel::of(&case).unwrap();
    let times: Vec<f64> = (0..=20_000).map(|k| f64::from(k) * 1e-4).collect();
    let (found, end) = motion(&model, 60.0, &times, 1e-12).unwrap();
    let RunUpEnd::Held(t, crank) = end else { panic!("{end:?}") };
    assert!(t > 0.1 && crank > TAU, "{t} {crank}");
    let rocker = case.mechanism.link_named("rocker").unwrap();
    let mut poses = PoseSolver::counting_turns(&case).unwrap();
    let mut angle = |at: &CrankState| {
        poses.solve(at.crank, at.omega, at.alpha, Stage::Positions).unwrap();
        poses.with_angles().angles[rocker]
    };
    // Angle travelled by the rocker, which reverses at 50 and 82 deg.
    let (mut way, mut last) = (0.0f64, angle(&found[0]));
    let mut other = PoseSolver::new(&case).unwrap();
    let first: f64 = energy(&case, &mut other, &found[0]).iter().sum();
    let kinks = [50f64, 82.0].map(f64::to_radians);
    let mut previous = found[0];
    for at in &found[1..] {
        let now = angle(at);
        let turned: Vec<f64> = kinks.into_iter().filter(|_| crosses(&model, previous.crank, at.crank)).collect();
        way += match turned.first() {
            None => (now - last).abs(),
            // Between the previous instant and this instant, the rocker reaches the nearest extreme position and turns
            // back.
            Some(_) => {
                let extreme = kinks.into_iter().min_by(|a, b| (a - now).abs().total_cmp(&(b - now).abs())).unwrap();
                (extreme - last).abs() + (extreme - now).abs()
            }
        };
        let left: f64 = energy(&case, &mut other, at).iter().sum();
        // The published problem gives the extreme angles; the computed and the published angles agree to twelve digits.
        assert_within!(
            (first - left - 100.0 * way).abs(),
            1e-8 * first.abs(),
            "{at:?}: {} {}",
            first - left,
            100.0 * way
        );
        (last, previous) = (now, *at);
    }
}

/// Whether a kink lies between two crank angles.
fn crosses(model: &ReducedModel, from: f64, to: f64) -> bool {
    let kinks = model.kinks();
    let period = kinks.period.unwrap();
    kinks.cranks.iter().any(|kink| ((to - kink) / period).floor() > ((from - kink) / period).floor())
}
