//! Faults in motor and reducer of a free crank.

use super::kind::kinds;
use linkage::case::Case;
use linkage::drive::{Motor, ShaftInertia};
use prover::diagnosis::remade;

kinds! { Motor, Case:
    "motor-size" (1e-2): "the motor torque is too large by a relative amount",
        |case, size| of(case, |motor| motor.law = motor.law.scaled(1.0 + size));
    "motor-missing": "the motor torque is zero", |case, _| of(case, |motor| motor.law = motor.law.scaled(0.0));
    "motor-reversed": "the motor drives backwards", |case, _| of(case, |motor| motor.law = motor.law.scaled(-1.0));
    "motor-without-ratio": "the motor's torque is not multiplied by the ratio",
        |case, _| geared(case, |motor| motor.law = motor.law.scaled(1.0 / motor.ratio));
    "motor-ratio-twice": "the motor's torque is multiplied by the ratio twice",
        |case, _| geared(case, |motor| motor.law = motor.law.scaled(motor.ratio));
    "motor-ratio" (1e-2): "the reducer's ratio is too large by a relative amount",
        |case, size| of(case, |motor| motor.ratio *= 1.0 + size);
    "motor-lossless": "the reducer's efficiency is ignored", |case, _| {
        (case.crank().moving_motor()?.efficiency < 1.0).then_some(())?;
        of(case, |motor| motor.efficiency = 1.0)
    };
    "rotor-missing": "the inertia of rotor and reducer is missing", |case, _| {
        (case.crank().moving_motor()?.inertia_on_crank() > 0.0).then_some(())?;
        of(case, |motor| motor.inertia = ShaftInertia::default())
    };
    "rotor-ratio": "the rotor's inertia is reduced by the ratio instead of its square", |case, _| {
        (case.crank().moving_motor()?.inertia.rotor > 0.0).then_some(())?;
        geared(case, |motor| motor.inertia.rotor /= motor.ratio)
    };
}

fn of(case: &Case, change: impl Fn(&mut Motor)) -> Option<Case> {
    case.crank().is_free().then_some(())?;
    let mut motor = case.crank().moving_motor()?.clone();
    change(&mut motor);
    remade(case, |parts| {
        let drive = parts.drives.crank_mut();
        *drive = drive.with_motor(Some(motor));
        Some(())
    })
}

/// The case with a changed motor; `None` if the motor has no reducer.
fn geared(case: &Case, change: impl Fn(&mut Motor)) -> Option<Case> {
    (case.crank().moving_motor()?.ratio != 1.0).then_some(())?;
    of(case, change)
}
