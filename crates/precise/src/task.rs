//! The cases that the solver of dyads supports, and the crank's motion.

use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::mechanism::{GROUND, JointId, LinkId};

use super::Long;
use super::frame::Frame;
use super::vector::Vector;

/// The drive of a supported case.
pub(crate) struct Task {
    /// Joint and link of the drive.
    pub(crate) joint: JointId,
    pub(crate) link: LinkId,
    zero: f64,
    start: f64,
    /// Speed (rad/s).
    pub(crate) speed: f64,
}

impl Task {
    /// The drive of a case.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] with the unsupported part of the case.
    pub(crate) fn of(case: &Case) -> Result<Task> {
        let refused = |what: &str| Err(Error::new(ErrorKind::Unsupported, sentences::no_precise_numbers(&what)));
        let drive = case.crank();
        let Some(speed) = drive.constant_speed().filter(|_| !case.is_free() && drive.input == Input::Angle) else {
            return refused(sentences::ONLY_A_CRANK_AT_CONSTANT);
        };
        if case.drives.len() > 1 {
            return refused(sentences::THERE_ARE_SEVERAL_DRIVES);
        }
        if drive.passes() {
            return refused(sentences::CHANGE_POINTS_MAY_BE_PASSED);
        }
        if !case.loads.is_empty() {
            return refused(sentences::THERE_ARE_LOADS);
        }
        if !case.mechanism.transmissions().is_empty() {
            return refused(sentences::THERE_ARE_TRANSMISSIONS);
        }
        check_instants(case)?;
        Ok(Task { joint: drive.joint, link: drive.link, zero: drive.zero, start: drive.start, speed })
    }

    /// World angle of the crank at a time (s), in full precision.
    pub(crate) fn angle(&self, time: f64) -> Long {
        Long::of(self.zero) + Long::of(self.start) + Long::of(self.speed) * Long::of(time)
    }

    /// Frame of the crank at a world angle. The crank is hinged to the ground.
    pub(crate) fn crank(&self, case: &Case, angle: Long) -> Frame<Long> {
        let joint = &case.mechanism.joints()[self.joint];
        let ground = [joint.first, joint.second].into_iter().find(|side| side.link == GROUND);
        let place = Vector::of(ground.map_or(joint.other(self.link).local, |side| side.local));
        let direction = Vector::unit(angle);
        let arm = Vector::of(joint.on(self.link).unwrap_or_default()).rotated(direction);
        let omega = Long::of(self.speed);
        Frame {
            origin: place - arm,
            direction,
            omega,
            alpha: Long::ZERO,
            velocity: -arm.turned() * omega,
            acceleration: arm * (omega * omega),
        }
    }
}

/// Refuses a case with an instant before t = 0, because the motion is followed from t = 0.
pub(crate) fn check_instants(case: &Case) -> Result<()> {
    match case.grid.times.iter().any(|&t| t < 0.0) {
        true => {
            let message = sentences::no_precise_numbers(&sentences::AN_INSTANT_LIES_BEFORE);
            Err(Error::new(ErrorKind::Unsupported, message))
        }
        false => Ok(()),
    }
}

/// An error at an instant of the grid.
pub(crate) fn stuck(case: &Case, row: usize, what: &str) -> Error {
    Error::new(ErrorKind::Geometry, sentences::no_precise_numbers(&what)).at_input(case.told(case.grid.inputs[row]))
}

/// Frames of the start pose.
pub(crate) fn at_start(case: &Case) -> Vec<Frame<Long>> {
    let frame = |pose: &linkage::mechanism::LinkPose| Frame::<Long> {
        origin: Vector::of(pose.origin),
        direction: Vector::unit(Long::of(pose.angle)),
        ..Frame::REST
    };
    case.start.0.iter().map(frame).collect()
}
