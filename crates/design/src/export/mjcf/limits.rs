//! What MJCF has no words for, refused by name.

use linkage::drive::{Acts, Drive, Load, MotorLaw};
use linkage::error::{Error, ErrorKind, Result};

fn refused(what: String, help: &'static str) -> Error {
    Error::new(ErrorKind::Unsupported, format!("{what} cannot be written to a model for MuJoCo")).help(help)
}

/// Checks that a load can be written.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for one that MJCF has no words for, by its name.
pub(super) fn check(load: &Load) -> Result<()> {
    const ALONE: &str = "leave it out of the scenario, and add it to the model by hand";
    let sort = load.sort();
    if load.courses().any(|course| course.knots().is_some()) {
        return Err(refused(format!("a load of type \"{sort}\" with a table over the crank angle"), ALONE));
    }
    if let Load::Moment { acts: Acts::CounterClockwise | Acts::Clockwise, .. } = load {
        return Err(refused(format!("a load of type \"{sort}\" that acts in one sense of rotation only"), ALONE));
    }
    let has_words = matches!(load, Load::Resistance { .. } | Load::Moment { .. } | Load::Force { .. })
        || matches!(load, Load::Spring { .. } | Load::Damper { .. })
        || matches!(load, Load::TorsionSpring { .. } | Load::TorsionDamper { .. });
    if has_words { Ok(()) } else { Err(refused(format!("a load of type \"{sort}\""), ALONE)) }
}

/// Checks that a drive can be written.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a law of motion with a changing speed, and for a motor's law that is no straight line.
pub(super) fn check_drive(drive: &Drive) -> Result<()> {
    if let Some(motor) = drive.moving_motor() {
        return line(&motor.law).map(|_| ());
    }
    // A rotor keeps a constant speed and permits no other law.
    match drive.constant_speed() {
        Some(_) => Ok(()),
        None => {
            Err(refused(format!("a drive with the law \"{}\"", drive.law_name()), "give the drive a constant speed"))
        }
    }
}

/// Torque at rest (N m) and slope (N m s) of a motor's law.
pub(super) fn line(law: &MotorLaw) -> Result<[f64; 2]> {
    let name = match law {
        MotorLaw::Constant { torque } => return Ok([*torque, 0.0]),
        MotorLaw::Linear { at_rest, slope } => return Ok([*at_rest, *slope]),
        MotorLaw::Kloss { .. } => "kloss",
        MotorLaw::Table { .. } => "table",
    };
    Err(refused(format!("a motor with the law \"{name}\""), "give the motor the law \"linear\" or \"constant\""))
}
