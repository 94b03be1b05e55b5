//! Consistency checks between the parts of a case.

use crate::sentences;
use std::f64::consts::TAU;

use super::grid::Grid;
use super::parts::CaseParts;
use crate::drive::{Drive, DriveMotion, Drives, MotionLaw, Motor, MotorLaw};
use crate::error::{Error, ErrorKind, Result};
use crate::input::Input;
use crate::math::{KeepNan, unit};
use crate::mechanism::{AssemblyMode, DrivingLink, GROUND, GroupKind, LinkPose, Mechanism, Structure};

/// If the opening of a joint in a start pose exceeds this fraction of the pose's reach, the case is rejected.
/// The reach is the larger of two lengths: the mechanism's size, and the largest distance of a link's origin from the
/// world's origin.
/// A prismatic joint also opens by rotation: the sine of the angle between its two axes must not exceed this number.
/// In the first poses of all shipped scenarios, the openings are at most 1e-12 of the reach (`tests/suite/start.rs`).
/// If the pose belongs to a different mechanism, the opening is far larger.
const LARGEST_OPENING: f64 = 1e-9;

/// Checks all parts.
///
/// # Errors
/// The errors of [`Case::new`](super::Case::new).
pub(super) fn all(parts: &CaseParts) -> Result<()> {
    drives(parts)?;
    structure(parts)?;
    loads(parts)?;
    if !parts.gravity.iter().all(|value| value.is_finite()) {
        return Err(wrong("gravity", sentences::gravity_is(&parts.gravity.x, &parts.gravity.y)));
    }
    start(parts)?;
    modes(parts)?;
    grid(&parts.grid, &parts.drives)
}

/// Checks the instants.
pub(super) fn grid(grid: &Grid, drives: &Drives) -> Result<()> {
    if grid.times.len() != grid.inputs.len() {
        let [times, cranks] = [grid.times.len(), grid.inputs.len()];
        return Err(wrong("grid", sentences::the_grid_has_times_but_crank(&times, &cranks)));
    }
    grid.check(drives).map_err(|message| wrong("grid", message).help(sentences::ASK_FOR_INSTANTS_AND_CRANK))
}

fn wrong(key: &str, message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Input, message).key(key)
}

fn drives(parts: &CaseParts) -> Result<()> {
    for (index, drive) in parts.drives.iter().enumerate() {
        let fault = |kind, message: String| Err(Error::new(kind, message).key("drive"));
        let links = parts.mechanism.links();
        let (Some(joint), Some(link)) = (parts.mechanism.joints().get(drive.joint), links.get(drive.link)) else {
            let message = sentences::drive_turns_link_at_joint(&index, &drive.link, &drive.joint);
            let [links, joints] = [links.len(), parts.mechanism.joints().len()];
            return fault(ErrorKind::Input, sentences::but_there_are_links_and_joints(&message, &links, &joints));
        };
        let names = sentences::the_drive_of_link_at_joint(&link.name, &joint.name);
        if drive.link == GROUND || joint.on(drive.link).is_none() {
            return fault(ErrorKind::Input, sentences::the_joint_does_not_carry(&names));
        }
        if !joint.kind.has_input(drive.input) {
            let message = sentences::the_joint_is_but_a_drive(&names, &joint.kind.name());
            return fault(ErrorKind::Unsupported, message);
        }
        if drive.input == Input::Angle && moves_nothing(&parts.mechanism, drive) {
            let message = sentences::moves_nothing_all_joints_of_the_link(&names);
            return Err(Error::new(ErrorKind::Geometry, message)
                .key(format!("links.{}", link.name))
                .of_link(&link.name)
                .help(sentences::GIVE_THE_CRANK_A_LENGTH));
        }
        let before = &parts.drives[..index];
        let same_link = |other: &Drive| drive.input == Input::Angle && other.link == drive.link;
        if before.iter().any(|other| other.joint == drive.joint || same_link(other)) {
            return fault(ErrorKind::Input, sentences::joint_or_link_is_driven_already(&names));
        }
        if !(drive.zero.is_finite() && drive.start.is_finite() && motion_is_sound(&drive.motion, index > 0)) {
            return fault(
                ErrorKind::Input,
                sentences::has_a_number_that_is_not_finite(&names, &format_args!("{drive:?}")),
            );
        }
        let turns = drive.start.abs() / TAU;
        if drive.input.period().is_some() && turns > Grid::MOST_TURNS {
            let message = sentences::starts_turns_away_the_limit(
                &names,
                &format_args!("{turns:.1e}"),
                &format_args!("{:e}", Grid::MOST_TURNS),
            );
            return Err(Error::new(ErrorKind::Input, message)
                .key("start.crank")
                .help(sentences::GIVE_THE_CRANK_ANGLE_OF_THE_START));
        }
        if drive.input == Input::Angle && joint.on(GROUND).is_none() && !drive.is_free() {
            let message = sentences::hangs_on_a_moving_link_but_the_motion(&names);
            return fault(ErrorKind::Unsupported, message);
        }
        if index > 0 && drive.motor().is_some() {
            let message = sentences::has_a_motor_but_only_the_crank(&names);
            return fault(ErrorKind::Unsupported, message);
        }
    }
    Ok(())
}

/// A crank counts as a point if its length is below this fraction of the mechanism's size.
const POINT: f64 = 1e-12;

/// Whether a driving link has joints with other links, but its rotation does not move these links.
/// All joints of such a driving link are revolute and lie on its axis of rotation.
fn moves_nothing(mechanism: &Mechanism, drive: &Drive) -> bool {
    let own = mechanism.joints()[drive.joint].on(drive.link);
    let others = || mechanism.joints().entries().filter(|&(index, _)| index != drive.joint);
    let mut carried = others().filter_map(|(_, joint)| Some((joint.is_pin(), joint.on(drive.link)?))).peekable();
    // A driven prismatic joint always moves the links that its driving link carries.
    mechanism.joints()[drive.joint].is_pin()
        && carried.peek().is_some()
        && carried
            .all(|(is_pin, place)| is_pin && own.is_some_and(|own| (place - own).norm() <= POINT * mechanism.size()))
}

/// Whether all numbers of a motion are valid.
/// The speed 0 is valid only for a drive that may hold its joint (`may_hold`).
fn motion_is_sound(motion: &DriveMotion, may_hold: bool) -> bool {
    let moves = |value: f64| value.is_finite() && value != 0.0;
    let (moved, motor) = match motion {
        DriveMotion::Prescribed { law, motor } => {
            let moved = match *law {
                MotionLaw::ConstantSpeed(speed) => moves(speed),
                MotionLaw::Ramp { speed, time } => moves(speed) && moves(time) && time > 0.0,
                MotionLaw::Cycloidal { rise, time } => moves(rise) && moves(time) && time > 0.0,
                MotionLaw::Curve(ref curve) => curve.is_finite(),
            };
            (may_hold && law.holds() || moved && moves(law.top_speed()), motor)
        }
        &DriveMotion::Free { initial_speed, nominal_speed, ref motor } => {
            (initial_speed.is_finite() && moves(nominal_speed), motor)
        }
    };
    moved && motor.as_ref().is_none_or(motor_is_sound)
}

fn motor_is_sound(motor: &Motor) -> bool {
    let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
    let law = match &motor.law {
        MotorLaw::Constant { torque } => torque.is_finite(),
        MotorLaw::Linear { at_rest, slope } => finite(&[*at_rest, *slope]),
        &MotorLaw::Kloss { breakdown_torque, breakdown_slip, synchronous_speed } => {
            finite(&[breakdown_torque, breakdown_slip, synchronous_speed])
                && breakdown_slip > 0.0
                && synchronous_speed > 0.0
        }
        MotorLaw::Table { speeds, torques } => {
            let ascends = speeds.windows(2).all(|pair| pair[0] < pair[1]);
            speeds.len() >= 2 && speeds.len() == torques.len() && ascends && finite(speeds) && finite(torques)
        }
    };
    let own = &motor.inertia;
    let inertias = [own.rotor, own.input, own.intermediate, own.output];
    law && motor.ratio > 0.0
        && motor.ratio.is_finite()
        && motor.efficiency > 0.0
        && motor.efficiency <= 1.0
        && inertias.iter().all(|&value| value >= 0.0 && value.is_finite())
        && own.intermediate_ratio.is_finite()
}

/// Checks that the structure belongs to mechanism and drives.
fn structure(parts: &CaseParts) -> Result<()> {
    let own = Structure::of(&parts.mechanism, &parts.drives.joints())?;
    if own != parts.structure {
        let [own, given] = [&own, &parts.structure].map(|structure| structure.groups.len() + structure.drivers.len());
        let message = sentences::the_structure_of_parts_is_not_that_of_mechanism(&given, &own);
        return Err(wrong("structure", message).help(sentences::TAKE_STRUCTURE_OF_THE_MECHANISM));
    }
    match parts.drives.iter().zip(&own.drivers).find(|(drive, driver)| drive.link != driver.link) {
        None => Ok(()),
        Some((drive, &DrivingLink { link, joint, .. })) => {
            let [said, turned] = [drive.link, link].map(|link| &parts.mechanism.links()[link].name);
            let name = &parts.mechanism.joints()[joint].name;
            Err(wrong("drive", sentences::joint_drives_link_not(&name, &turned, &said)))
        }
    }
}

fn loads(parts: &CaseParts) -> Result<()> {
    for (index, load) in parts.loads.iter().enumerate() {
        let fault = |message: String| Err(wrong("loads", format!("load {index}, a {}: {message}", load.sort())));
        let links = load.links();
        let count = parts.mechanism.links().len();
        if let Some(link) = links.iter().find(|link| link.index() >= count) {
            return fault(sentences::it_acts_on_link_but_there(&link, &count));
        }
        if !load.is_sound() {
            return fault(sentences::a_number_is_not_finite_or_negative(&format_args!("{load:?}")));
        }
        let Some(joint) = load.joint() else { continue };
        let Some(own) = parts.mechanism.joints().get(joint) else {
            return fault(sentences::it_acts_in_joint_but_there(&joint, &parts.mechanism.joints().len()));
        };
        if links != [own.first.link, own.second.link] {
            return fault(sentences::its_links_are_not_those_of_joint(&own.name));
        }
        if !load.is_friction() {
            continue;
        }
        if parts.loads[..index].iter().any(|other| other.is_friction() && other.joint() == Some(joint)) {
            return fault(sentences::joint_has_two_frictions(&own.name));
        }
        if parts.drives.crank().through {
            return fault(sentences::friction_grows_without_bound(&own.name));
        }
    }
    if parts.drives.crank().through
        && let Some(own) = parts.mechanism.transmissions().iter().find(|own| own.losses.is_some())
    {
        return Err(wrong("transmissions", sentences::losses_grow_without_bound(&own.name())));
    }
    Ok(())
}

/// Checks that every link has a pose, that all joints are closed, and that every driven joint has its start coordinate.
fn start(parts: &CaseParts) -> Result<()> {
    let (mechanism, poses) = (&parts.mechanism, &parts.start.0);
    let links = mechanism.links();
    if poses.len() != links.len() {
        let message = sentences::the_start_pose_has_places(&poses.len(), &links.len());
        return Err(wrong("start", message));
    }
    if poses[GROUND] != LinkPose::GROUND {
        return Err(wrong("start", sentences::the_ground_is_moved_in_the_start(&format_args!("{:?}", poses[GROUND]))));
    }
    let is_finite = |pose: &LinkPose| [pose.origin.x, pose.origin.y, pose.angle].iter().all(|value| value.is_finite());
    if let Some((link, pose)) = links.iter().zip(poses).find(|(_, pose)| !is_finite(pose)) {
        return Err(wrong("start", sentences::link_has_no_place_in_the_start(&link.name, &format_args!("{pose:?}"))));
    }
    let at = parts.drives.crank().told(parts.drives.crank().start);
    let reach = poses.iter().fold(mechanism.size(), |most, pose| most.larger(pose.origin.norm()));
    for joint in mechanism.joints() {
        let sides = [joint.first, joint.second];
        let places = sides.map(|side| poses[side.link].point(side.local));
        let (gap, turn) = joint.opening(places, sides.map(|side| unit(poses[side.link].angle)));
        // The negated condition also rejects NaN.
        if !(gap <= LARGEST_OPENING * reach && turn <= LARGEST_OPENING) {
            let message = sentences::joint_is_open_in_the_start(
                &joint.name,
                &at,
                &format_args!("{gap:.3e}"),
                &format_args!("{turn:.3e}"),
            );
            return Err(Error::new(ErrorKind::Geometry, message).key("start").help(CLOSED));
        }
    }
    for drive in &parts.drives {
        let [stated, found] = [
            drive.coordinate(drive.start),
            mechanism.joints()[drive.joint].coordinate(drive.link, drive.input, &parts.start),
        ];
        let (apart, scale) = match drive.input {
            Input::Angle | Input::Turn => ((unit(found) - unit(stated)).norm(), 1.0),
            Input::Slide => ((found - stated).abs(), reach),
        };
        if !(apart / scale <= LARGEST_OPENING) {
            let name = &links[drive.link].name;
            let message =
                sentences::link_is_away_from_its_start(&name, &format_args!("{apart:.3e}"), &drive.input.unit());
            return Err(Error::new(ErrorKind::Geometry, message).key("start").help(CLOSED));
        }
    }
    Ok(())
}

const CLOSED: &str = sentences::TAKE_FIRST_POSE_AT_THE_WORLD;

/// Checks that the mode of every group fits the kind of the group.
fn modes(parts: &CaseParts) -> Result<()> {
    let (groups, modes) = (&parts.structure.groups, &parts.modes);
    if groups.len() != modes.len() {
        let message = sentences::there_are_assembly_modes_but_groups(&modes.len(), &groups.len());
        return Err(wrong("start", message));
    }
    for (group, mode) in groups.iter().zip(modes) {
        if !has_mode(group.kind, *mode) {
            let message = sentences::the_mode_is_none_of_group(&mode.name(), &group.names(&parts.mechanism));
            return Err(wrong("start", message));
        }
    }
    Ok(())
}

fn has_mode(kind: GroupKind, mode: AssemblyMode) -> bool {
    match kind.modes() {
        Some(modes) => modes.contains(&mode),
        None if kind.has_one_configuration() => mode == AssemblyMode::Only,
        None => mode == AssemblyMode::Followed,
    }
}

#[cfg(test)]
mod tests;
