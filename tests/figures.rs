//! The figures the project stands for, measured on the two published mechanisms.

use std::path::Path;

use approx::assert_abs_diff_eq;
use linkproof::case::{Case, Grid};
use linkproof::compare::{Verdict, difference, residuals, scales};
use linkproof::engine::rapier::Rapier;
use linkproof::proof::{Options, Proof, prove};
use linkproof::reference::{AssurSolver, NewtonSolver, power, reduced};
use linkproof::scenario::Scenario;
use linkproof::solver::{Solver, State};
use linkproof::tolerance::Basis;
use linkproof::trajectory::{Channel, Stage, Trajectory};

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn solve(solver: &dyn Solver, case: &Case) -> Trajectory {
    solver.solve(case, &mut |_| {}).unwrap_or_else(|error| panic!("{error}"))
}

fn proof(name: &str, step: Option<f64>) -> Proof {
    prove(&scenario(name), &Options { step, ..Options::default() }, &mut |_| {}).unwrap()
}

/// A turn in steps of a tenth of a degree, in the sense of the drive.
fn fine(case: &Case) -> Case {
    let sense = case.drive.at(0.0).omega.signum();
    let cranks = (0..=3600).map(|k| (sense * f64::from(k) / 10.0).to_radians() + case.drive.start).collect();
    case.on(Grid::of_cranks(&case.drive, cranks))
}

#[test]
fn val_ov7_base_every_printed_number_by_both_sides() {
    let scenario = scenario("ov7_base");
    let cells: Vec<usize> =
        scenario.oracles.iter().map(|oracle| oracle.series.iter().map(|series| series.points.len()).sum()).collect();
    // Positions, velocities, accelerations of five points in two directions, and three tables of seven angles, at 13 angles.
    assert_eq!(cells, [130, 130, 130, 91, 91, 91]);
    assert!(scenario.oracles.iter().all(|oracle| oracle.series.iter().all(|series| series.skipped.is_empty())));

    let proof = proof("ov7_base", None);
    let published: Vec<_> = proof.checks.iter().filter(|c| matches!(c.basis, Basis::Published { .. })).collect();
    assert_eq!(published.len(), 2 * 51);
    for check in published {
        assert!(matches!(check.verdict, Verdict::Agree { .. }), "{}: {:?}", check.name(), check.verdict);
        // Half a unit of two printed decimals (positions in mm, angles in degrees), nothing looser.
        let half_unit: f64 = match check.unit {
            "m" => 0.005e-3,
            "rad" => 0.005f64.to_radians(),
            _ => 0.005,
        };
        assert!(check.bound <= half_unit * (1.0 + 1e-8), "{}", check.name());
    }
}

#[test]
fn the_two_analytic_sides_agree_to_rounding_over_a_turn() {
    for name in ["crank_rocker", "ov7_base"] {
        let case = fine(&scenario(name).case);
        let (assur, newton) = (solve(&AssurSolver, &case), solve(&NewtonSolver, &case));
        for residual in residuals(&assur, &newton).unwrap() {
            let bound = match residual.channel.kind.stage {
                Stage::Positions => 1e-12,
                Stage::Velocities | Stage::Accelerations => 1e-11,
                Stage::Reactions | Stage::BalancingMoment => 1e-10,
            };
            assert!(
                residual.max <= bound * residual.scale,
                "{name} {}: {:e}",
                residual.channel,
                residual.max / residual.scale
            );
        }
    }
}

#[test]
fn balancing_moment_from_equilibrium_and_from_powers() {
    for name in ["crank_rocker", "ov7_base"] {
        let case = fine(&scenario(name).case);
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            let (mut amplitude, mut worst): (f64, f64) = (0.0, 0.0);
            let mut visit = |_: usize, state: &State| {
                amplitude = amplitude.max(state.torque.abs());
                worst = worst.max((state.torque - power::balancing_moment(&case, &state.motions)).abs());
                Ok(())
            };
            solver.sweep(&case, &mut visit, &mut |_| {}).unwrap();
            assert!(worst <= 1e-11 * amplitude, "{name} {}: {:e}", solver.name(), worst / amplitude);
        }
    }
}

/// Synthesis from the two extreme positions: l_OB1 = l_OA + l_AB, l_OB2 = l_AB - l_OA.
#[test]
fn val_crank_rocker_lengths_follow_from_the_extreme_positions() {
    let scenario = scenario("crank_rocker");
    let mechanism = &scenario.case.mechanism;
    let length = |link: &str| mechanism.links()[mechanism.link_named(link).unwrap()].size();
    let distance = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        (0.15 + 0.25 * cos).hypot(0.015 + 0.25 * sin)
    };
    assert_abs_diff_eq!(length("crank"), (distance(50.0) - distance(82.0)) / 2.0, epsilon = 1e-14);
    assert_abs_diff_eq!(length("coupler"), (distance(50.0) + distance(82.0)) / 2.0, epsilon = 1e-14);

    let rocker = Channel::named("link.rocker.angle_rad").unwrap();
    let turn = solve(&AssurSolver, &fine(&scenario.case));
    let angles = turn.column(&rocker).unwrap();
    let (low, high) = angles.iter().fold((f64::MAX, f64::MIN), |(l, h), &a| (l.min(a), h.max(a)));
    // Between two samples a tenth of a degree apart the rocker turns by less than 1e-6 rad near its extremes.
    assert_abs_diff_eq!(low.to_degrees(), 50.0, epsilon = 1e-4);
    assert_abs_diff_eq!(high.to_degrees(), 82.0, epsilon = 1e-4);
}

#[test]
fn val_crank_rocker_mean_reduced_inertia_and_resistance() {
    let case = scenario("crank_rocker").case;
    for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
        let means = reduced::means_over_turn(&case, solver).unwrap();
        assert_abs_diff_eq!(means.inertia, 0.164846013, epsilon = 0.5e-9);
        // Exactly 100 N m times twice the swing over a turn; the rest is the mean's error at the two kinks.
        assert_abs_diff_eq!(means.resistance, 100.0 * 2.0 * 32.0 / 360.0, epsilon = 5e-5);
    }
}

/// Largest error over half the range, of all channels of the given stages but those that stand still.
fn worst_share(reference: &Trajectory, run: &Trajectory, wanted: &[Stage]) -> f64 {
    let errors = difference(reference, run).unwrap();
    let shares = errors.iter().zip(scales(reference)).filter(|((channel, _), _)| {
        wanted.contains(&channel.kind.stage)
            && !(channel.kind.stage == Stage::Positions && channel.kind.suffix != "angle_rad")
    });
    shares.map(|((_, e), scale)| e.iter().fold(0.0f64, |m, x| m.max(x.abs())) / scale).fold(0.0, f64::max)
}

#[test]
fn rapier_on_the_crank_rocker_is_within_a_thousandth_and_a_hundred_times_less() {
    let case = scenario("crank_rocker").case;
    let reference = solve(&AssurSolver, &case);
    let stages = [Stage::Positions, Stage::Reactions, Stage::BalancingMoment];
    let [coarse, fine] = [1e-3, 1e-4].map(|step| worst_share(&reference, &solve(&Rapier::new(step), &case), &stages));
    assert!(coarse <= 1e-3, "{coarse:e}");
    assert!(fine <= 1e-5 && fine <= coarse / 95.0, "{fine:e} against {coarse:e}");
}

#[test]
fn rapier_shows_second_order_in_every_channel_of_both_mechanisms() {
    for name in ["crank_rocker", "ov7_base"] {
        let proof = proof(name, None);
        assert!(matches!(proof.verdict, Verdict::Agree { .. }), "{name}: {:?}", proof.verdict);
        let orders: Vec<(String, f64)> = proof
            .channels
            .iter()
            .filter(|c| !c.convergence.observed.is_nan())
            .map(|c| (c.residual.channel.to_string(), c.convergence.observed))
            .collect();
        // Only the crank's own motion, and that of points on it, is exact at any step.
        assert!(orders.len() * 10 > proof.channels.len() * 7, "{name}: {} of {}", orders.len(), proof.channels.len());
        for (channel, order) in orders {
            assert!((order - 2.0).abs() <= 0.1, "{name} {channel}: {order}");
        }
    }
}
