//! Faults in angles and speeds of driving links.

use std::f64::consts::{PI, TAU};

use super::kind::kinds;
use linkage::case::{Case, Grid};
use linkage::drive::{Drive, DriveMotion, MotionLaw};
use prover::diagnosis::{at_speed, driven, reassembled, remade};

kinds! { Drive, Case:
    "start-angle" (1e-2): "the start angle of the crank is off (rad)",
        |case, size| started(case, 0, |start| start + size);
    "start-degrees": "the crank's start angle in degrees is taken for radians",
        |case, _| started(case, 0, f64::to_degrees);
    "start-radians": "the crank's start angle is converted to radians twice",
        |case, _| started(case, 0, f64::to_radians);
    "start-sense": "the start angle of the crank is measured clockwise", |case, _| started(case, 0, |start| -start);
    "start-from-y": "the start angle of the crank is measured from the y axis",
        |case, _| started(case, 0, |start| start + PI / 2.0);
    "speed" (1e-2): "the drive is too fast by a fraction of its speed", |case, size| faster(case, 0, 1.0 + size);
    "speed-reversed": "the drive rotates backwards", |case, _| faster(case, 0, -1.0);
    "speed-rpm": "the speed in rad/s is taken for rpm", |case, _| faster(case, 0, PI / 30.0);
    "speed-hertz": "the speed in rad/s is taken for revolutions per second", |case, _| faster(case, 0, TAU);
    "law-constant": "a variable speed is replaced by the constant top speed", |case, _| {
        (!case.is_free() && case.crank().constant_speed().is_none()).then_some(())?;
        turned(case, 0, |drive| if let DriveMotion::Prescribed { law, .. } = &mut drive.motion {
            *law = MotionLaw::ConstantSpeed(law.top_speed());
        })
    };
    "initial-speed" (1e-2): "the free crank starts too fast by a fraction of its nominal speed", |case, size| {
        let nominal = case.crank().top_speed();
        initial(case, |speed| speed + size * nominal)
    };
    "initial-speed-missing": "the free crank starts from rest", |case, _| initial(case, |_| 0.0);
    "initial-speed-reversed": "the free crank starts backwards", |case, _| initial(case, |speed| -speed);
    "free-held": "a free crank rotates at its nominal speed all the time", |case, _| {
        (case.crank().is_free() && case.drives.iter().count() == 1).then_some(())?;
        turned(case, 0, |drive| *drive = drive.nominal())
    };
    "second-angle" (1e-2): "the start angle of the last driving link is off (rad)",
        |case, size| started(case, last(case)?, |start| start + size);
    "second-reversed": "the last driving link rotates backwards", |case, _| faster(case, last(case)?, -1.0);
    "second-speed" (1e-2): "the last driving link is too fast by a fraction of its speed",
        |case, size| faster(case, last(case)?, 1.0 + size);
    "late" (1e-3): "all instants are too early, by a small crank rotation (rad)", |case, size| shifted(case, size);
    "clock" (1e-3): "the clock runs slow: all times are too small by a relative amount",
        |case, size| scaled(case, 1.0 - size);
}

/// Index of the last drive other than the crank.
fn last(case: &Case) -> Option<usize> {
    Some(case.drives.further().len()).filter(|last| *last > 0)
}

/// The case with one drive changed.
fn turned(case: &Case, index: usize, change: impl Fn(&mut Drive)) -> Option<Case> {
    remade(case, |parts| {
        driven(parts, index, change);
        Some(())
    })
}

fn started(case: &Case, index: usize, to: impl Fn(f64) -> f64) -> Option<Case> {
    let old = case.drives.get(index)?.start;
    let new = Some(to(old)).filter(|new| *new != old)?;
    remade(case, |parts| {
        driven(parts, index, |drive| drive.start = new);
        reassembled(parts)
    })
}

fn faster(case: &Case, index: usize, factor: f64) -> Option<Case> {
    let drive = case.drives.get(index)?;
    if drive.is_free() && drive.initial_speed() == 0.0 {
        return None;
    }
    turned(case, index, |drive| match &mut drive.motion {
        DriveMotion::Prescribed { law, .. } => *law = at_speed(law, factor * law.top_speed()),
        DriveMotion::Free { initial_speed, .. } => *initial_speed *= factor,
    })
}

fn initial(case: &Case, to: impl Fn(f64) -> f64) -> Option<Case> {
    case.crank().is_free().then_some(())?;
    let old = case.crank().initial_speed();
    let new = Some(to(old)).filter(|new| *new != old)?;
    turned(case, 0, |drive| {
        if let DriveMotion::Free { initial_speed, .. } = &mut drive.motion {
            *initial_speed = new;
        }
    })
}

/// Moves all instants earlier, by the time in which the crank turns by `angle` (rad) at top speed.
/// If the motion begins at t = 0, instants that would be negative become 0.
fn shifted(case: &Case, angle: f64) -> Option<Case> {
    let begins = case.is_free() || case.crank().constant_speed().is_none();
    let by = angle / case.crank().top_speed().abs();
    let earlier = |&t: &f64| if begins && t < by { 0.0 } else { t - by };
    case.on(Grid::of_times(case.crank(), case.grid.times.iter().map(earlier).collect())).ok()
}

fn scaled(case: &Case, factor: f64) -> Option<Case> {
    let times = case.grid.times.iter().map(|t| t * factor).collect();
    case.on(Grid::of_times(case.crank(), times)).ok()
}
