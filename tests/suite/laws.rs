//! Laws of motion other than constant speed: both analytic sides, the balance of powers, and the engine by every route.

use linkage::math::KeepNan;
use std::path::Path;

use analytic::{self, witness::momentum, witness::power};
use linkage::engine::Route;
use linkage::error::ErrorKind;
use linkage::trajectory::Stage;
use prover::bounds::residuals;
use prover::run::{Options, prove};
use scenario::Scenario;

use crate::common::{assert_within, shipped, states};

/// The shipped scenario `cycloidal_start`, with another law and grid.
fn swing(law: &str, grid: &str) -> Scenario {
    let text = include_str!("../../scenarios/cycloidal_start.toml");
    let text = &text[..text.find("[[oracle]]").unwrap()];
    let grid = format!("[grid]\n{grid}\n");
    let (first, _) = text.split_at(text.find("[grid]").unwrap());
    let text = format!("{first}{grid}").replace("law = \"cycloidal\"\nto_deg = 200\ntime_s = 0.2", law);
    Scenario::parse(&text, Path::new("swing.toml")).unwrap_or_else(|error| panic!("{error}"))
}

const RAMP: &str = "law = \"ramp\"\nspeed_rpm = -300\ntime_s = 0.12";
/// The crank moves forward, partly back, and forward again.
const TABLE: &str = "law = \"table\"\npoints = [{ time_s = 0, angle_deg = 20 }, { time_ms = 60, angle_deg = 90 }, { time_s = 0.12, angle_deg = 50 }, { time_s = 0.2, angle_deg = 160 }]";
const CYCLOIDAL: &str = "law = \"cycloidal\"\nto_deg = -150\ntime_s = 0.15";

#[test]
fn both_sides_agree_and_balance_powers_and_momentum() {
    for (law, grid) in [
        (RAMP, "from_s = 0\nto_s = 0.3\nstep_s = 0.005"),
        (TABLE, "from_s = 0\nto_s = 0.2\nstep_s = 0.004"),
        (CYCLOIDAL, "from_deg = 20\nto_deg = -150\nstep_deg = -5"),
    ] {
        let scenario = swing(law, grid);
        let case = &scenario.case;
        let [a, b] = analytic::all().map(|solver| solver.solve(case).unwrap());
        let largest = |stage: Stage| {
            let own = a.iter().filter(move |(channel, _)| channel.kind.stage == stage);
            own.flat_map(|(_, values)| values).fold(0.0, |max: f64, v| max.larger(v.abs()))
        };
        for residual in residuals(&a, &b).unwrap() {
            let share = residual.max / largest(residual.channel.kind.stage);
            assert_within!(share, 1e-12, "{law} {}: {share:e}", residual.channel);
        }
        let moment = largest(Stage::BalancingMoment);
        for solver in analytic::all() {
            for (state, &t) in states(solver, case, &case.grid.times).unwrap().iter().zip(&case.grid.times) {
                let crank = state.motions[case.crank().link];
                let law = case.crank().at(t);
                assert_within!((crank.omega - law.rate).abs(), 1e-12, "{t}");
                assert_within!((crank.alpha - law.acceleration).abs(), 1e-9, "{t}");
                let power = power::of_known_forces(case, state) + state.torques[0] * crank.omega;
                let scale = moment * case.crank().top_speed().abs();
                assert_within!(power.abs(), 1e-12 * scale, "{} {t}: {:e}", solver.name(), power / scale);
                let ((force, _), (other, _)) = (state.shaking(case), momentum::shaking(case, state));
                assert_within!((force - other).norm(), 1e-12 * largest(Stage::Reactions), "{} {t}", solver.name());
            }
        }
    }
}

/// Velocities are the derivatives of positions, and accelerations are the derivatives of velocities.
/// The derivatives are difference quotients of the solutions.
#[test]
fn rates_are_derivatives_under_every_law() {
    for (law, t) in [(RAMP, 0.07), (RAMP, 0.2), (TABLE, 0.05), (TABLE, 0.09), (CYCLOIDAL, 0.04)] {
        let scenario = swing(law, "from_s = 0\nto_s = 0.1\nstep_s = 0.1");
        let h = 1e-5;
        for solver in analytic::all() {
            let found = states(solver, &scenario.case, &[t - h, t, t + h]).unwrap();
            for link in found[0].motions.ids().skip(1) {
                let [back, here, ahead] = [0, 1, 2].map(|k| (found[k].angles[link], found[k].motions[link]));
                let (omega, alpha) = ((ahead.0 - back.0) / (2.0 * h), (ahead.1.omega - back.1.omega) / (2.0 * h));
                assert_within!((omega - here.1.omega).abs(), 1e-5, "{law} {t} {link}: {omega} {}", here.1.omega);
                assert_within!((alpha - here.1.alpha).abs(), 1e-3, "{law} {t} {link}: {alpha} {}", here.1.alpha);
            }
        }
    }
}

#[test]
fn val_the_engine_agrees_by_every_route() {
    for (law, grid, part) in [
        (CYCLOIDAL, "from_s = 0\nto_s = 0.15\nstep_s = 0.01", 1.0),
        // This grid stays within one segment of the table.
        (TABLE, "from_s = 0\nto_s = 0.05\nstep_s = 0.01", 0.5),
        // The grids lie after and before the jump of the acceleration at 0.12 s.
        (RAMP, "from_s = 0.13\nto_s = 0.2\nstep_s = 0.01", 1.0),
        (RAMP, "from_s = 0\nto_s = 0.1\nstep_s = 0.01", 1.0),
    ] {
        let scenario = swing(law, grid);
        for (route, dt) in [(Route::Differences, 5e-4), (Route::Native, 4e-5), (Route::Probe, 5e-4)] {
            // The native route is of first order and slow, so one law with a changing acceleration is enough.
            if route == Route::Native && law != CYCLOIDAL {
                continue;
            }
            let proof = prove(&scenario, &Options::default().route(route).step(dt * part)).unwrap();
            let wrong = proof.engine().channels.iter().filter(|channel| channel.verdict.word() != "agree");
            let wrong: Vec<_> = wrong
                .map(|c| (c.residual.channel.to_string(), c.residual.max, c.bound, c.convergence.observed))
                .collect();
            assert_eq!(proof.verdict.word(), "agree", "{law} {route:?}: {:?} {wrong:?}", proof.verdict);
        }
    }
}

/// Values obtained by differences converge with the order 2, as at constant speed.
#[test]
fn val_the_order_stays_two() {
    let scenario = shipped("cycloidal_start.toml");
    let proof = prove(&scenario, &Options::default().step(5e-4)).unwrap();
    for channel in &proof.engine().channels {
        // The crank follows the law exactly at every step, so its angle has no error and no visible order.
        let order = channel.convergence.observed;
        let name = channel.residual.channel.to_string();
        let exact = channel.residual.channel.kind.stage == Stage::Positions
            && (name.contains("crank") || name.contains("point.A"));
        assert!(exact || (order - 2.0).abs() < 0.1, "{name}: {order}");
    }
}

/// Instants about a jump of the drive's acceleration are left out, and all remaining instants are proven.
#[test]
fn instants_at_a_jump_of_the_acceleration_are_left_out() {
    let scenario = swing(RAMP, "from_s = 0.1\nto_s = 0.14\nstep_s = 0.0005");
    let proof = prove(&scenario, &Options::default()).unwrap();
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    let left_out = |stage: Stage| {
        let channels = proof.engine().channels.iter();
        channels.filter(|own| own.residual.channel.kind.stage == stage).map(|own| own.left_out).max().unwrap()
    };
    assert_eq!(left_out(Stage::Positions), 0);
    assert!((1..20).contains(&left_out(Stage::Velocities)), "{}", left_out(Stage::Velocities));
}

#[test]
fn constant_speed_features_refuse_other_laws_by_name() {
    let case = shipped("cycloidal_start.toml").case;
    let unloaded = case.with(|parts| parts.loads.clear()).unwrap();
    let error = design::export::mjcf::mjcf(&unloaded, analytic::all()[0], "swing", 1e-3).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("law \"cycloidal\""), "{error}");
    let table = swing(TABLE, "from_s = 0\nto_s = 0.2\nstep_s = 0.01").case;
    let error = design::bearings::over_range(&table).unwrap_err();
    assert!(error.message().contains("more than once"), "{error}");
    assert!(design::bearings::over_range(&case).is_ok());
}
