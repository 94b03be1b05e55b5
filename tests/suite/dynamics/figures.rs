//! The published drive of `crank_rocker`.

use std::f64::consts::TAU;

use crate::common::{assert_within, shipped};
use analytic::reduced::means;
use analytic::reduced::{ACCURACY, ReducedModel, RunUp, RunUpEnd, motion};
use design::drive::flywheel::Flywheel;
use linkage::drive::{Load, Motor, MotorLaw};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::LinkId;

/// Times from zero to half a second, 1 ms apart: the run-up of the published problem.
fn times() -> Vec<f64> {
    (0..=500).map(|k| f64::from(k) * 1e-3).collect()
}

#[test]
fn val_crank_rocker_reduced_means_and_maximum() {
    let case = shipped("crank_rocker.toml").case;
    for solver in analytic::all() {
        let means = means::means_over_turn(&case, solver).unwrap();
        assert_within!((means.inertia - 0.164_846_013).abs(), 5.1e-10, "{}: {}", solver.name(), means.inertia);
        // Over a revolution, gravity does no work, and the rocker travels its swing of 32 deg twice.
        let closed = 100.0 * 2.0 * 32.0 / 360.0;
        assert_within!((means.resistance - closed).abs(), 1e-11, "{}: {:e}", solver.name(), means.resistance - closed);
    }
    // The published reduced moment omits the crank's weight.
    // The crank's mass is therefore moved to the pivot, with the same moment of inertia about the pivot.
    let mut links = case.mechanism.links().to_vec();
    let crank = &mut links[1];
    crank.inertia += crank.mass * crank.mass_centre.norm_squared();
    crank.mass_centre = Vec2::zeros();
    let mechanism = linkage::mechanism::Mechanism::new(links, case.mechanism.joints().to_vec()).unwrap();
    let weightless = case.with(|parts| parts.mechanism = mechanism).unwrap();
    let [inertia, resistance] = ReducedModel::of(&weightless).unwrap().extremes().unwrap();
    assert_within!((resistance.greatest.1 - 37.016_264_0).abs(), 5.1e-8, "{resistance:?}");
    let [own, _] = ReducedModel::of(&case).unwrap().extremes().unwrap();
    assert_within!((inertia.greatest.1 - own.greatest.1).abs(), 1e-13);
    assert_within!((inertia.least.1 - own.least.1).abs(), 1e-13);
}

/// The authors' means are averages of 361 values: the position at 0 deg is counted a second time at 360 deg.
/// The authors' sum for the reduced inertia omits the crank's inertia.
#[test]
fn val_crank_rocker_printed_means_count_one_position_twice() {
    let case = shipped("crank_rocker.toml").case;
    let crank = &case.mechanism.links()[LinkId(1)];
    let about_pivot = crank.inertia + crank.mass * crank.mass_centre.norm_squared();
    for solver in analytic::all() {
        let (mut inertia, mut resistance, mut count) = (0.0, 0.0, 0.0);
        let mut add = |_: usize, state: &linkage::solver::State| {
            inertia += means::moment_of_inertia(&case, &state.motions) - about_pivot;
            resistance += means::moment_of_resistance(&case, state);
            count += 1.0;
            Ok(())
        };
        solver.each(&case, &mut add).unwrap();
        assert_eq!(count, 361.0);
        assert_within!((inertia / count - 0.1645).abs(), 0.5e-4, "{}: {}", solver.name(), inertia / count);
        assert_within!((resistance / count - 17.76).abs(), 0.5e-2, "{}: {}", solver.name(), resistance / count);
    }
}

/// The printed greatest reduced resistance is 36.98 N m.
/// Among the possible methods, only the method with all weights and g = 9.8 m/s^2 gives a value that rounds to 36.98 N
/// m.
#[test]
fn val_crank_rocker_printed_greatest_resistance_has_g_of_9_8() {
    let case = shipped("crank_rocker.toml").case;
    let greatest = |case: &linkage::case::Case| ReducedModel::of(case).unwrap().extremes().unwrap()[1].greatest.1;
    assert_within!((greatest(&case) - 36.990_825).abs(), 0.5e-6);
    let lighter = case.with(|parts| parts.gravity = Vec2::new(0.0, -9.8)).unwrap();
    assert_within!((greatest(&lighter) - 36.98).abs(), 0.5e-2);
}

#[test]
fn val_crank_rocker_steady_motion() {
    let case = shipped("crank_rocker.toml").case;
    let model = ReducedModel::of(&case).unwrap();
    assert_eq!(model.added_inertia(), 0.0);
    let regime = model.regime(&[], ACCURACY).unwrap();
    assert_within!((regime.mean_speed - 14.263_883_878_5).abs(), 1e-9, "{}", regime.mean_speed);
    assert_within!((regime.period - 0.440_496_106_159_4).abs(), 1e-12, "{}", regime.period);
    assert_within!((regime.start_speed - 16.679_930_049_7).abs(), 1e-9, "{}", regime.start_speed);
    assert!(regime.turns == 1.0);
    assert_within!(regime.multiplier, 1e-90);
    let motor = case.crank().motor().unwrap();
    let steady = motor.steady_speed(100.0 * 64.0 / 360.0).unwrap();
    assert_within!((steady - 14.33204).abs(), 5e-6);
    assert_within!((steady * motor.ratio - 302.6266).abs(), 5e-5);
}

/// The run-up, integrated in time with dI*/dphi, ends in the steady motion.
/// The steady motion is integrated with respect to the crank angle, without dI*/dphi.
#[test]
fn the_run_up_in_time_ends_in_the_steady_motion() {
    let case = shipped("crank_rocker.toml").case;
    let model = ReducedModel::of(&case).unwrap();
    let (found, end) = motion(&model, 0.0, &times(), ACCURACY).unwrap();
    assert_eq!((found.len(), end), (501, RunUpEnd::Reached));
    // Deviations from the steady motion decay within a tenth of a revolution, so the steady motion is reached at 0.1 s.
    let late: Vec<_> = found.iter().filter(|at| at.t >= 0.1 && at.crank < TAU).collect();
    assert!(late.len() > 300);
    let cranks: Vec<f64> = late.iter().map(|at| at.crank).collect();
    let regime = model.regime(&cranks, ACCURACY).unwrap();
    for (at, steady) in late.iter().zip(&regime.samples) {
        assert_within!((at.omega - steady.omega).abs(), 1e-10, "{at:?} {steady:?}");
        assert_within!((at.alpha - steady.alpha).abs(), 1e-7, "{at:?} {steady:?}");
    }
    // One period later, the crank has made one more revolution.
    let pair = [0.2, 0.2 + regime.period];
    let (found, _) = motion(&model, 0.0, &pair, ACCURACY).unwrap();
    assert_within!((found[1].crank - found[0].crank - TAU).abs(), 1e-11, "{:e}", found[1].crank - found[0].crank - TAU);
}

/// Compares the default accuracy with an accuracy a hundred times tighter, and with a grid ten times finer, so that all
/// steps differ.
#[test]
fn run_up_is_exact_to_1e_10() {
    let case = shipped("crank_rocker.toml").case;
    let model = ReducedModel::of(&case).unwrap();
    let run_up = RunUp::of(&model, 0.0, &times(), ACCURACY).unwrap();
    let fine: Vec<f64> = (0..=5000).map(|k| f64::from(k) * 1e-4).collect();
    let (tight, _) = motion(&model, 0.0, &fine, ACCURACY / 100.0).unwrap();
    for (row, at) in run_up.motion.iter().enumerate() {
        let exact = &tight[10 * row];
        assert_within!((at.t - exact.t).abs(), 1e-15);
        assert_within!((at.crank - exact.crank).abs(), 1e-10, "{at:?} {exact:?}");
    }
    assert_within!(run_up.power_residual().unwrap(), 1e-10, "{:?}", run_up.power_residual());
    // All reactions are present.
    let reactions = run_up.trajectory.channels().iter().filter(|c| c.to_string().ends_with("fx_N"));
    assert!(reactions.count() >= 4);
}

#[test]
fn slope_of_the_inertia_is_its_derivative() {
    for name in ["crank_rocker", "compressor", "ov7_base", "ov7_new", "six_bar_slider", "quick_return"] {
        let case = shipped(&format!("{name}.toml")).case;
        let model = ReducedModel::of(&case).unwrap();
        let step = 1e-5;
        let start = case.crank().start;
        for k in 0..24 {
            let crank = start + case.crank().sense() * f64::from(k) * 0.2;
            let rows = model.rows(&[crank - step, crank, crank + step]).unwrap();
            let slope = (rows[2].inertia - rows[0].inertia) / (2.0 * step);
            // The bound is the error of central differences: the third derivative (some hundred times the inertia)
            // times 1e-10 / 6, plus rounding error divided by 2e-5.
            assert_within!(
                (slope - rows[1].slope).abs(),
                1e-6 * rows[1].inertia.larger(1e-9),
                "{name} {k}: {slope} {rows:?}"
            );
        }
    }
}

#[test]
fn a_flywheel_gives_the_requested_non_uniformity() {
    let case = shipped("crank_rocker.toml").case;
    let model = ReducedModel::of(&case).unwrap();
    for wanted in [0.2, 0.02, 1e-3] {
        let found = Flywheel::of(&model, wanted, ACCURACY).unwrap();
        let again = model.with_flywheel(found.inertia).regime(&[], ACCURACY).unwrap();
        assert_within!((again.non_uniformity() / wanted - 1.0).abs(), 1e-10, "{wanted}");
    }
    // A non-uniformity of 0.5 is allowed here, so no flywheel is needed.
    assert_eq!(Flywheel::of(&model, 0.5, ACCURACY).unwrap().inertia, 0.0);
    // With a large flywheel the speed hardly changes, so J = W / (delta omega^2), as in textbooks (Merzalow).
    // W is the largest surplus of work that the kinetic energy of the mechanism does not absorb.
    // With a large flywheel, the motor's moment equals the mean resistance.
    let count = 36_000;
    let cranks: Vec<f64> = (0..count).map(|k| TAU * (f64::from(k) + 0.5) / f64::from(count)).collect();
    let mean = 100.0 * 64.0 / 360.0;
    let speed = case.crank().motor().unwrap().steady_speed(mean).unwrap();
    let (mut work, mut least, mut most) = (0.0f64, f64::INFINITY, f64::NEG_INFINITY);
    for row in model.rows(&cranks).unwrap() {
        work += (mean - row.resistance) * TAU / f64::from(count);
        let surplus = work - row.inertia * speed * speed / 2.0;
        (least, most) = (least.smaller(surplus), most.larger(surplus));
    }
    let wanted = 1e-5;
    let textbook = (most - least) / (wanted * speed * speed);
    let found = Flywheel::of(&model, wanted, ACCURACY).unwrap();
    // The textbook formula neglects changes of I* and of the motor's moment, which are of the order of I* / J.
    assert_within!((found.inertia / textbook - 1.0).abs(), 1e-3, "{} {textbook}", found.inertia);
}

#[test]
fn a_motor_table_of_a_straight_line_equals_the_linear_law() {
    let case = shipped("crank_rocker.toml").case;
    let motor = case.crank().motor().unwrap();
    let speeds: Vec<f64> = (0..8).map(|k| 50.0 * f64::from(k)).collect();
    let torques = speeds.iter().map(|&speed| motor.law.torque(speed)).collect();
    let motor = Motor { law: MotorLaw::Table { speeds, torques }, ..motor.clone() };
    let tabled = case.with_motor(Some(motor)).unwrap();
    let both =
        [&case, &tabled].map(|case| motion(&ReducedModel::of(case).unwrap(), 0.0, &times(), ACCURACY).unwrap().0);
    for (line, table) in both[0].iter().zip(&both[1]) {
        assert_within!((line.crank - table.crank).abs(), 1e-11);
        assert_within!((line.omega - table.omega).abs(), 1e-10);
    }
    let regimes = [&case, &tabled].map(|case| ReducedModel::of(case).unwrap().regime(&[], ACCURACY).unwrap());
    assert_within!((regimes[0].period - regimes[1].period).abs(), 1e-13);
}

#[test]
fn reducer_losses_apply_in_both_directions_of_power() {
    let case = shipped("crank_rocker.toml").case;
    let motor = Motor { efficiency: 0.9, ..case.crank().motor().unwrap().clone() };
    let case = case.with_motor(Some(motor)).unwrap();
    let model = ReducedModel::of(&case).unwrap();
    let run_up = RunUp::of(&model, 0.0, &times(), ACCURACY).unwrap();
    // Twice per revolution the mechanism drives the motor.
    // If the mechanism drives the motor, the moment on the crank is the motor's moment divided by 0.9; otherwise it is
    // multiplied by 0.9.
    let motor = case.crank().motor().unwrap();
    let (mut drives, mut driven) = (0, 0);
    for at in &run_up.motion[1..] {
        let own = motor.ratio * motor.law.torque(motor.ratio * at.omega);
        let expected = if own > 0.0 { own * 0.9 } else { own / 0.9 };
        assert_within!((at.motor - expected).abs(), 1e-9, "{at:?}");
        *(if own > 0.0 { &mut drives } else { &mut driven }) += 1;
    }
    assert!(drives > 100 && driven > 20, "{drives} {driven}");
    assert_within!(run_up.power_residual().unwrap(), 1e-10);
}

#[test]
fn a_motor_that_is_too_weak_stops_for_good() {
    // The motor has 10 N m, but the greatest resistance is 37 N m: the crank stalls at some angle.
    let motor = Motor::ideal(MotorLaw::Constant { torque: 10.0 }, 1.0);
    let case = shipped("crank_rocker.toml").case.with_motor(Some(motor)).unwrap();
    let model = ReducedModel::of(&case).unwrap();
    let (found, end) = motion(&model, 0.0, &times(), ACCURACY).unwrap();
    let RunUpEnd::Held(t, crank) = end else { panic!("{end:?}") };
    assert!(found.iter().all(|at| at.t <= t && at.crank <= crank + 1e-12) && found.len() < 501);
    // At the angle of the stall, the resistance alone exceeds the motor's moment.
    let rows = model.rows(&[crank]).unwrap();
    assert!(rows[0].resistance > 10.0, "{rows:?}");
    let error = model.regime(&[], ACCURACY).unwrap_err();
    assert!(error.message().contains("no stable speed"), "{error}");
    // Without a load the crank does not stall.
    let case = case.with(|parts| parts.loads.retain(|load| !matches!(load, Load::Resistance { .. }))).unwrap();
    let free = ReducedModel::of(&case).unwrap();
    assert_eq!(motion(&free, 0.0, &times(), ACCURACY).unwrap().1, RunUpEnd::Reached);
}
