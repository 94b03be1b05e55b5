//! Refuses loads, drives and transmissions that MJCF cannot express. The error names the part.

use crate::export::limits;
use crate::sentences;
use linkage::drive::{Acts, Drive, Load, MotorLaw};
use linkage::error::{Advice, Error, Result};
use linkage::mechanism::Transmission;

/// Name of the format in messages.
const FORMAT: &str = "a model for MuJoCo";

fn refused(what: &str, help: impl Into<Advice>) -> Error {
    limits::refused(what, FORMAT, help)
}

/// Checks that a load can be written.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the type of a load that MJCF cannot express.
pub(super) fn check(load: &Load) -> Result<()> {
    const ALONE: Advice = Advice::NoLoads;
    let sort = load.sort();
    if load.courses().any(|course| course.knots().is_some()) {
        return Err(refused(&sentences::a_load_of_type_with_a_table(&sort), ALONE));
    }
    if let Load::Moment { acts, .. } | Load::TorsionSpring { acts, .. } = load
        && *acts != Acts::Always
    {
        return Err(refused(&sentences::a_load_of_type_that_acts(&sort), ALONE));
    }
    let has_words = matches!(load, Load::Resistance { .. } | Load::Moment { .. } | Load::Force { .. })
        || matches!(load, Load::Spring { .. } | Load::Damper { .. })
        || matches!(load, Load::TorsionSpring { .. } | Load::TorsionDamper { .. });
    if has_words { Ok(()) } else { Err(refused(&sentences::a_load_of_type(&sort), ALONE)) }
}

/// Checks that a transmission can be written.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a cam, and for a transmission with losses.
pub(super) fn check_transmission(transmission: &Transmission) -> Result<()> {
    limits::check_transmission(transmission, FORMAT)
}

/// Checks that a drive can be written.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a law of motion with a changing speed, and for a motor whose law is not a straight
/// line.
pub(super) fn check_drive(drive: &Drive) -> Result<()> {
    if let Some(motor) = drive.moving_motor() {
        return line(&motor.law).map(|_| ());
    }
    // A drive with a changing speed is refused: the model's rotor can only keep a constant speed.
    limits::check_speed(drive, FORMAT)
}

/// Torque at rest (N m) and slope (N m s) of a motor's law.
pub(super) fn line(law: &MotorLaw) -> Result<[f64; 2]> {
    let name = match law {
        MotorLaw::Constant { torque } => return Ok([*torque, 0.0]),
        MotorLaw::Linear { at_rest, slope } => return Ok([*at_rest, *slope]),
        MotorLaw::Kloss { .. } => "kloss",
        MotorLaw::Table { .. } => "table",
    };
    Err(refused(&sentences::a_motor_with_the_law(&name), sentences::GIVE_THE_MOTOR_THE_LAW_LINEAR))
}
