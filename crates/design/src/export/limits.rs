//! Checks for parts of a case that a model file cannot hold. Each error names the part and a remedy.

use crate::rigid::{Body, RigidModel};
use crate::sentences;
use linkage::drive::{Drive, Load};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::mechanism::{GROUND, JointId, Transmission};

/// The error that `what` cannot be written to the format `format`.
pub(super) fn refused(what: &str, format: &str, help: impl Into<Advice>) -> Error {
    Error::new(ErrorKind::Unsupported, sentences::cannot_be_written_to(&what, &format)).help(help)
}

/// Checks that a transmission has a constant ratio and no losses.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a cam, and for a transmission with losses.
pub(super) fn check_transmission(transmission: &Transmission, format: &str) -> Result<()> {
    let what = match (&transmission.cam, transmission.losses) {
        (None, None) => return Ok(()),
        (Some(_), _) => sentences::a_cam(&transmission.name()),
        (None, Some(_)) => sentences::the_losses_of(&transmission.name()),
    };
    Err(refused(&what, format, sentences::LEAVE_IT_OUT_OF_THE_SCENARIO))
}

/// Checks that a prescribed drive has a constant speed.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a law of motion with a changing speed.
pub(super) fn check_speed(drive: &Drive, format: &str) -> Result<()> {
    if drive.is_free() || drive.constant_speed().is_some() {
        return Ok(());
    }
    let what = sentences::a_drive_with_the_law(&drive.law_name());
    Err(refused(&what, format, sentences::GIVE_THE_DRIVE_A_CONSTANT))
}

/// Checks that no motor moves a free link.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a motor that moves a free link.
pub(super) fn check_motor(drive: &Drive, format: &str) -> Result<()> {
    match drive.moving_motor() {
        None => Ok(()),
        Some(_) => Err(refused(sentences::A_MOTOR, format, sentences::LEAVE_IT_OUT_OF_THE_SCENARIO)),
    }
}

/// Checks that a mechanism has no loads.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the type of the first load.
pub(super) fn check_no_loads(model: &RigidModel, format: &str) -> Result<()> {
    model.case.loads.first().map_or(Ok(()), |load| Err(refused_load(&sentences::a_load_of_type(&load.sort()), format)))
}

fn refused_load(what: &str, format: &str) -> Error {
    refused(what, format, Advice::NoLoads)
}

/// Dry friction of hinges on the ground: the joint and the moment (N m) of every resistance.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for any other load, and for a resistance on a link without a hinge on the ground.
pub(super) fn frictions(model: &RigidModel, format: &str) -> Result<Vec<(JointId, f64)>> {
    let joints = &model.case.mechanism.joints();
    let friction = |load: &Load| {
        let what = sentences::a_load_of_type(&load.sort());
        let (link, moment) = load.resistance().ok_or_else(|| refused_load(&what, format))?;
        let hinge = joints
            .entries()
            .find(|(_, joint)| joint.on(link).is_some() && joint.other(link).link == GROUND && !joint.keeps_angle());
        let (joint, _) = hinge.ok_or_else(|| refused_load(&sentences::without_a_hinge_on_the_ground(&what), format))?;
        Ok((joint, moment))
    };
    model.case.loads.iter().map(friction).collect()
}

/// Moment of dry friction in a joint (N m).
pub(super) fn friction_of(frictions: &[(JointId, f64)], joint: JointId) -> f64 {
    frictions.iter().filter(|(own, _)| *own == joint).map(|(_, moment)| moment).sum()
}

/// A joint whose coordinate is a multiple of another joint's coordinate. Both coordinates are zero in the start pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Follower {
    /// The joint.
    pub joint: JointId,
    /// The other joint.
    pub leader: JointId,
    /// The joint's coordinate divided by the other joint's coordinate (each in rad or m).
    pub multiplier: f64,
}

/// The transmissions, each as a joint that follows another joint.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for cams, and for losses.
/// [`ErrorKind::Unsupported`] for a transmission that does not couple exactly two joints of the spanning tree.
/// [`ErrorKind::Unsupported`] if each of the two joints is already driven, or already follows another joint.
pub(super) fn followers(model: &RigidModel, format: &str) -> Result<Vec<Follower>> {
    let mut found: Vec<Follower> = Vec::new();
    for transmission in model.case.mechanism.transmissions() {
        check_transmission(transmission, format)?;
        let coupled = model.coupled(transmission);
        let is_bound = |joint: JointId| model.is_driven(joint) || found.iter().any(|own| own.joint == joint);
        let follower = match coupled[..] {
            [first, second] => {
                let [(one, this), (two, that)] = [first, second].map(|(branch, factor)| (model.bodies[branch], factor));
                let follows = |(own, of): (Body, Body), multiplier: f64| {
                    let (joint, leader) = (own.branch.joint, of.branch.joint);
                    (!is_bound(joint)).then_some(Follower { joint, leader, multiplier })
                };
                follows((two, one), -this / that).or_else(|| follows((one, two), -that / this))
            }
            _ => None,
        };
        let what = sentences::the_coupling_of(&transmission.name());
        found.push(follower.ok_or_else(|| refused(&what, format, sentences::LEAVE_IT_OUT_OF_THE_SCENARIO))?);
    }
    Ok(found)
}
