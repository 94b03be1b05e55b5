//! A crank alone: all motions of the crank have closed forms.

use crate::common::assert_within;
use linkage::math::KeepNan;
use std::f64::consts::{PI, TAU};
use std::path::Path;

use analytic::AssurSolver;
use analytic::reduced::means;
use analytic::reduced::{ACCURACY, ReducedModel, RunUp, RunUpEnd, motion};
use analytic::steady::Averaged;
use linkage::case::Case;
use linkage::drive::{DriveMotion, Load, MotionLaw, Motor, MotorLaw, ShaftInertia};
use linkage::mechanism::LinkId;
use scenario::Scenario;

/// A bar of 2 kg, with a moment of inertia of 0.05 kg m^2 about its mass centre.
/// The distance of the mass centre from the pivot is `centre` (m).
/// The bar starts in the direction `start` (deg).
fn bar(centre: f64, start: f64, gravity: bool) -> Case {
    let field = if gravity { "[gravity]\nx_m_s2 = 0\ny_m_s2 = -9.81\n" } else { "" };
    let text = format!(
        "format = 1\nname = \"bar\"\ntitle = \"A bar on a pivot\"\n[ground.points]\nO = {{ x_m = 0, y_m = 0 }}\n\
         [links.bar]\nmass_kg = 2\ninertia_kg_m2 = 0.05\nmass_centre = {{ x_m = {centre}, y_m = 0 }}\n\
         [links.bar.points]\nO = {{ x_m = 0, y_m = 0 }}\nA = {{ x_m = 0.5, y_m = 0 }}\n\
         [[joints]]\nname = \"O\"\ntype = \"revolute\"\nlinks = [\"ground\", \"bar\"]\n\
         [drive]\njoint = \"O\"\nspeed_rad_s = 1\n{field}[start]\ncrank_deg = {start}\n\
         [grid]\nfrom_deg = 0\nto_deg = 10\nstep_deg = 1\n[engine]\ndt_s = 1e-3\n"
    );
    Scenario::parse(&text, Path::new("bar.toml")).unwrap_or_else(|error| panic!("{error}")).case
}

fn evenly(to: f64, parts: u32) -> Vec<f64> {
    (0..=parts).map(|k| to * f64::from(k) / f64::from(parts)).collect()
}

/// Complete elliptic integral of the first kind, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..40 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    PI / (2.0 * a)
}

/// The equation I domega/dt = M0 - c omega has the solution omega = M0 / c (1 - exp(-c t / I)).
#[test]
fn constant_coefficients_have_their_closed_form() {
    let case = bar(0.0, 0.0, false);
    let inertia = ShaftInertia { rotor: 1e-3, input: 5e-4, intermediate: 2e-2, intermediate_ratio: 3.0, output: 0.1 };
    let motor = Motor { inertia, ..Motor::ideal(MotorLaw::Linear { at_rest: 4.0, slope: -0.02 }, 10.0) };
    let case = case.with_motor(Some(motor)).unwrap();
    let model = ReducedModel::of(&case).unwrap();
    let whole = 0.05 + 1.5e-3 * 100.0 + 2e-2 * 9.0 + 0.1;
    assert_within!((model.added_inertia() + 0.05 - whole).abs(), 1e-15);
    let (moment, damping) = (40.0, 2.0);
    let rate = damping / whole;
    let (found, _) = motion(&model, 0.0, &evenly(1.5, 300), ACCURACY).unwrap();
    for at in &found {
        let omega = moment / damping * (1.0 - (-rate * at.t).exp());
        let crank = moment / damping * (at.t + ((-rate * at.t).exp() - 1.0) / rate);
        assert_within!((at.omega - omega).abs(), 1e-11, "{at:?} {omega} {crank}");
        assert_within!((at.crank - crank).abs(), 1e-11, "{at:?} {omega} {crank}");
        assert_within!((at.alpha - (moment - damping * omega) / whole).abs(), 1e-9);
    }
}

/// If inertia and resistance are constant, the averaged model is exact.
/// The example is a balanced bar with a resistance, driven through a reducer with losses.
#[test]
fn the_averaged_model_is_exact_for_constant_coefficients() {
    let inertia = ShaftInertia { rotor: 1e-3, input: 5e-4, intermediate: 2e-2, intermediate_ratio: 3.0, output: 0.1 };
    let law = MotorLaw::Linear { at_rest: 4.0, slope: -0.02 };
    for (speed, efficiency) in [(1.0, 0.9), (-1.0, 0.9), (1.0, 1.0)] {
        let motor = Motor { efficiency, inertia, ..Motor::ideal(law.clone(), 10.0) };
        let (law, turned) = (MotionLaw::ConstantSpeed(speed), Some(motor.clone()));
        let case = bar(0.0, 20.0, false).with(|parts| {
            parts.drives.crank_mut().motion = DriveMotion::Prescribed { law, motor: turned };
            parts.loads.push(Load::Resistance { link: LinkId(1), moment: 6.0 });
        });
        let case = case.unwrap();
        let model = ReducedModel::of(&case).unwrap();
        let means = means::means_over_turn(&case, &AssurSolver).unwrap();
        let averaged = Averaged::of(&motor, means.inertia + model.added_inertia(), speed * means.resistance).unwrap();
        // Without losses, the motor's moment on the crank is 40 N m minus 2 N m s times the crank's speed.
        assert_within!((averaged.time_constant - 0.48 / (2.0 * efficiency)).abs(), 1e-15, "{averaged:?}");
        assert_within!((averaged.steady_speed - (40.0 * efficiency - 6.0) / (2.0 * efficiency)).abs(), 1e-13);
        let (found, end) = motion(&model, 0.0, &evenly(1.5, 300), 1e-13).unwrap();
        assert_eq!((found.len(), end), (301, RunUpEnd::Reached));
        let mut most = [0.0f64; 2];
        for at in &found {
            let (omega, angle) = (speed * at.omega, speed * (at.crank - case.crank().start));
            // The speed is omega_s (1 - exp(-t / T)), and the angle is its integral.
            let Averaged { time_constant, steady_speed } = averaged;
            let gone = (-at.t / time_constant).exp_m1();
            let off = [omega + steady_speed * gone, angle - steady_speed * (at.t + time_constant * gone)];
            most = [0, 1].map(|k| most[k].larger(off[k].abs()));
        }
        most.iter().for_each(|off| assert_within!(*off, 1e-12, "{most:?}"));
    }
}

#[test]
fn the_averaged_model_needs_one_falling_straight_line() {
    let linear = Motor::ideal(MotorLaw::Linear { at_rest: 4.0, slope: -0.02 }, 10.0);
    let lossy = Motor { efficiency: 0.9, ..linear.clone() };
    // Without resistance, both motors reach the motor speed of 200 rad/s; the motor with losses takes longer.
    let free = [&linear, &lossy].map(|motor| Averaged::of(motor, 0.5, 0.0).unwrap());
    free.iter().for_each(|free| assert_within!((free.steady_speed - 20.0).abs(), 1e-12, "{free:?}"));
    assert_within!((free[1].time_constant / free[0].time_constant - 1.0 / 0.9).abs(), 1e-14);
    // If the resistance drives the crank above 20 rad/s, power flows back to the motor, and losses act in the opposite
    // direction.
    assert_within!((Averaged::of(&linear, 0.5, -2.0).unwrap().steady_speed - 21.0).abs(), 1e-12);
    assert_eq!(Averaged::of(&lossy, 0.5, -2.0), None);
    // There is no averaged model in these cases: a resistance above the starting moment, no inertia, or a
    // characteristic without slope, with a rising slope, or with a curve.
    assert_eq!(Averaged::of(&linear, 0.5, 40.1), None);
    assert_eq!(Averaged::of(&linear, 0.0, 1.0), None);
    let bent = [
        MotorLaw::Constant { torque: 4.0 },
        MotorLaw::Linear { at_rest: 4.0, slope: 0.02 },
        MotorLaw::Kloss { breakdown_torque: 5.0, breakdown_slip: 0.2, synchronous_speed: 200.0 },
    ];
    assert!(bent.into_iter().all(|law| Averaged::of(&Motor::ideal(law, 10.0), 0.5, 1.0).is_none()));
}

/// Kloss's run-up time without load: t = I omega_s / (2 M_b) ((1 - s^2) / (2 s_b) + s_b ln(1 / s)).
#[test]
fn kloss_runs_up_in_its_known_time() {
    let (largest, breakdown, synchronous) = (3.0, 0.2, 100.0);
    let law = MotorLaw::Kloss { breakdown_torque: largest, breakdown_slip: breakdown, synchronous_speed: synchronous };
    let case = bar(0.0, 0.0, false).with_motor(Some(Motor::ideal(law, 1.0))).unwrap();
    let time = |slip: f64| {
        0.05 * synchronous / (2.0 * largest) * ((1.0 - slip * slip) / (2.0 * breakdown) + breakdown * (1.0 / slip).ln())
    };
    let slips = [0.9, 0.5, 0.2, 0.05, 0.001];
    let times = slips.map(time);
    let (found, _) = motion(&ReducedModel::of(&case).unwrap(), 0.0, &times, ACCURACY).unwrap();
    for (at, slip) in found.iter().zip(slips) {
        assert_within!((at.omega - synchronous * (1.0 - slip)).abs(), 1e-8, "{at:?} {slip}");
    }
}

/// A pendulum released at rest swings with the period 4 K(sin(amplitude / 2)) / Omega, and reverses twice per period.
#[test]
fn a_pendulum_swings_in_its_known_time() {
    for degrees in [10.0f64, 90.0, 150.0] {
        let case = bar(0.3, -90.0 + degrees, true);
        let model = ReducedModel::of(&case).unwrap();
        let frequency = (2.0 * 9.81 * 0.3 / (0.05 + 2.0 * 0.09f64)).sqrt();
        let period = 4.0 * elliptic((degrees.to_radians() / 2.0).sin()) / frequency;
        let times: Vec<f64> = (0..=20).map(|k| period * f64::from(k) / 2.0).collect();
        let (found, end) = motion(&model, 0.0, &times, 1e-13).unwrap();
        assert_eq!((found.len(), end), (21, RunUpEnd::Reached));
        for (half, at) in found.iter().enumerate() {
            let side = if half % 2 == 0 { 1.0 } else { -1.0 };
            let expected = (-90.0f64).to_radians() + side * degrees.to_radians();
            // At a reversal the angular velocity is zero, so the angle there hardly depends on the time.
            // The check of the angle at reversals therefore proves the amplitude.
            // The check of the angle at odd multiples of a quarter period proves the period.
            assert_within!((at.crank - expected).abs(), 1e-11, "{degrees} {half}: {at:?}");
        }
        let quarters: Vec<f64> = (0..10).map(|k| period * (f64::from(k) + 0.25)).collect();
        let (found, _) = motion(&model, 0.0, &quarters, 1e-13).unwrap();
        for at in &found {
            // The bound equals the bound of run-ups in `figures.rs`.
            assert_within!((at.crank + PI / 2.0).abs(), 1e-10, "{degrees}: {at:?}");
        }
    }
}

/// If the pendulum rotates fully, every revolution from the lowest position takes 4 K(2 Omega / omega_0) / omega_0.
#[test]
fn a_pendulum_turns_in_its_known_time() {
    let case = bar(0.3, -90.0, true);
    let model = ReducedModel::of(&case).unwrap();
    let frequency = (2.0 * 9.81 * 0.3 / (0.05 + 2.0 * 0.09f64)).sqrt();
    for factor in [2.02, 3.0, 10.0] {
        let omega = factor * frequency;
        let turn = 4.0 * elliptic(2.0 / factor) / omega;
        for way in [1.0, -1.0] {
            let times: Vec<f64> = (1..=10).map(|k| turn * f64::from(k)).collect();
            let (found, _) = motion(&model, way * omega, &times, 1e-13).unwrap();
            for (k, at) in (1..).zip(&found) {
                let expected = case.crank().start + way * TAU * f64::from(k);
                assert_within!((at.crank - expected).abs(), 1e-10, "{factor} {k}: {}", at.crank - expected);
            }
        }
    }
}

/// The reaction in the pivot of a bar that falls from rest follows Newton's law.
#[test]
fn reactions_follow_the_true_motion() {
    let case = bar(0.3, 0.0, true);
    let model = ReducedModel::of(&case).unwrap();
    let run_up = RunUp::of(&model, 0.0, &evenly(0.3, 30), ACCURACY).unwrap();
    let column = |name: &str| {
        let place = run_up.trajectory.channels().iter().position(|channel| channel.to_string() == name).unwrap();
        run_up.trajectory.iter().nth(place).unwrap().1.to_vec()
    };
    let (fx, fy) = (column("joint.O.fx_N"), column("joint.O.fy_N"));
    for (row, at) in run_up.motion.iter().enumerate() {
        let (sin, cos) = at.crank.sin_cos();
        let along = -0.3 * at.omega * at.omega;
        let across = 0.3 * at.alpha;
        let [x, y] = [along * cos - across * sin, along * sin + across * cos];
        assert_within!((fx[row] - 2.0 * x).abs(), 1e-11, "{row}");
        assert_within!((fy[row] - 2.0 * (y + 9.81)).abs(), 1e-11, "{row}");
        // Energy: the kinetic energy comes from the drop of the mass centre.
        let energy = 0.5 * (0.05 + 0.18) * at.omega * at.omega + 2.0 * 9.81 * 0.3 * sin;
        assert_within!(energy.abs(), 1e-11, "{energy:e}");
    }
    assert_within!(run_up.power_residual().unwrap(), 1e-10);
}
