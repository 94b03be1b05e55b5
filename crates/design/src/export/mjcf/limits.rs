//! Refuses loads, drives and transmissions that MJCF cannot express. The error names the part.

use crate::sentences;
use linkage::drive::{Acts, Drive, Load, MotorLaw};
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::Transmission;

fn refused(what: String, help: &'static str) -> Error {
    Error::new(ErrorKind::Unsupported, sentences::cannot_be_written_to_a_model(&what)).help(help)
}

/// Checks that a load can be written.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the type of a load that MJCF cannot express.
pub(super) fn check(load: &Load) -> Result<()> {
    const ALONE: &str = sentences::LEAVE_IT_OUT_OF_THE_SCENARIO;
    let sort = load.sort();
    if load.courses().any(|course| course.knots().is_some()) {
        return Err(refused(sentences::a_load_of_type_with_a_table(&sort), ALONE));
    }
    if let Load::Moment { acts, .. } | Load::TorsionSpring { acts, .. } = load
        && *acts != Acts::Always
    {
        return Err(refused(sentences::a_load_of_type_that_acts(&sort), ALONE));
    }
    let has_words = matches!(load, Load::Resistance { .. } | Load::Moment { .. } | Load::Force { .. })
        || matches!(load, Load::Spring { .. } | Load::Damper { .. })
        || matches!(load, Load::TorsionSpring { .. } | Load::TorsionDamper { .. });
    if has_words { Ok(()) } else { Err(refused(sentences::a_load_of_type(&sort), ALONE)) }
}

/// Checks that a transmission can be written.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a cam, and for a transmission with losses.
pub(super) fn check_transmission(transmission: &Transmission) -> Result<()> {
    let what = match (&transmission.cam, transmission.losses) {
        (None, None) => return Ok(()),
        (Some(_), _) => sentences::a_cam(&transmission.name()),
        (None, Some(_)) => sentences::the_losses_of(&transmission.name()),
    };
    Err(refused(what, sentences::LEAVE_IT_OUT_OF_THE_SCENARIO))
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
    // A rotor can only keep a constant speed, so a drive with a changing speed is refused.
    match drive.constant_speed() {
        Some(_) => Ok(()),
        None => Err(refused(sentences::a_drive_with_the_law(&drive.law_name()), sentences::GIVE_THE_DRIVE_A_CONSTANT)),
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
    Err(refused(sentences::a_motor_with_the_law(&name), sentences::GIVE_THE_MOTOR_THE_LAW_LINEAR))
}
