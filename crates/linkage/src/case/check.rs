//! Conditions between the parts of a case.

use std::f64::consts::TAU;

use super::grid::Grid;
use super::parts::CaseParts;
use crate::drive::{Drive, DriveMotion, MotionLaw, Motor, MotorLaw};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{KeepNan, unit};
use crate::mechanism::{AssemblyMode, GROUND, GroupKind, LinkPose, Mechanism, Structure};

/// Largest opening of a joint in a start pose, as a share of the farthest place in it.
/// First poses of all shipped scenarios leave less than 1e-15 (`tests/suite/start.rs`).
/// The pose of a different mechanism is far above.
const LARGEST_OPENING: f64 = 1e-9;

/// Checks all parts.
///
/// # Errors
/// Those of [`Case::new`](super::Case::new).
pub(super) fn all(parts: &CaseParts) -> Result<()> {
    drives(parts)?;
    structure(parts)?;
    loads(parts)?;
    if !parts.gravity.iter().all(|value| value.is_finite()) {
        return Err(wrong("gravity", format!("gravity is ({}, {}) m/s^2", parts.gravity.x, parts.gravity.y)));
    }
    start(parts)?;
    modes(parts)?;
    grid(&parts.grid, parts.drives.crank())
}

/// Checks the instants.
pub(super) fn grid(grid: &Grid, crank: &Drive) -> Result<()> {
    if grid.times.len() != grid.inputs.len() {
        let [times, cranks] = [grid.times.len(), grid.inputs.len()];
        return Err(wrong("grid", format!("the grid has {times} times, but {cranks} crank angles")));
    }
    grid.check(crank)
        .map_err(|message| wrong("grid", message).help("ask for instants and crank angles to which the drive comes"))
}

fn wrong(key: &str, message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Input, message).key(key)
}

fn drives(parts: &CaseParts) -> Result<()> {
    let several = parts.drives.len() > 1;
    for (index, drive) in parts.drives.iter().enumerate() {
        let fault = |kind, message: String| Err(Error::new(kind, message).key("drive"));
        let links = parts.mechanism.links();
        let (Some(joint), Some(link)) = (parts.mechanism.joints().get(drive.joint), links.get(drive.link)) else {
            let message = format!("drive {index} turns link {} at joint {}", drive.link, drive.joint);
            let [links, joints] = [links.len(), parts.mechanism.joints().len()];
            return fault(ErrorKind::Input, format!("{message}, but there are {links} links and {joints} joints"));
        };
        let names = format!("the drive of link \"{}\" at joint \"{}\"", link.name, joint.name);
        if drive.link == GROUND || joint.on(drive.link).is_none() {
            return fault(ErrorKind::Input, format!("{names}: the joint does not carry a moving link of that name"));
        }
        if joint.kind.input() != Some(drive.input) {
            let message = format!("{names}: the joint is {}, but a drive turns", joint.kind.name());
            return fault(ErrorKind::Unsupported, message);
        }
        if moves_nothing(&parts.mechanism, drive) {
            let message = format!("{names} moves nothing: all joints of the link lie on one point");
            return Err(Error::new(ErrorKind::Geometry, message)
                .key(format!("links.{}", link.name))
                .of_link(&link.name)
                .help("give the crank a length"));
        }
        let before = &parts.drives[..index];
        if before.iter().any(|other| other.joint == drive.joint || other.link == drive.link) {
            return fault(ErrorKind::Input, format!("{names}: joint or link is driven already"));
        }
        if !(drive.zero.is_finite() && drive.start.is_finite() && motion_is_sound(&drive.motion)) {
            return fault(ErrorKind::Input, format!("{names} has a number that is not finite: {drive:?}"));
        }
        let turns = drive.start.abs() / TAU;
        if turns > Grid::MOST_TURNS {
            let message = format!("{names} starts {turns:.1e} turns away, the limit is {:e}", Grid::MOST_TURNS);
            return Err(Error::new(ErrorKind::Input, message)
                .key("start.crank")
                .help("give the crank angle of the start within a turn"));
        }
        if several && drive.constant_speed().is_none() {
            let message = format!("{names} has a speed that changes, beside other drives");
            return fault(ErrorKind::Unsupported, message);
        }
        if joint.on(GROUND).is_none() && !drive.is_free() {
            let message = format!("{names} hangs on a moving link, but the motion is prescribed");
            return fault(ErrorKind::Unsupported, message);
        }
        if index > 0 && drive.motor().is_some() {
            let message = format!("{names} has a motor, but only the crank's is solved");
            return fault(ErrorKind::Unsupported, message);
        }
    }
    Ok(())
}

/// Length, as a share of the mechanism's size, below which a crank is a point.
const POINT: f64 = 1e-12;

/// Whether a driving link carries others, but all of them by pins on its own axis.
fn moves_nothing(mechanism: &Mechanism, drive: &Drive) -> bool {
    let own = mechanism.joints()[drive.joint].on(drive.link);
    let others = || mechanism.joints().entries().filter(|&(index, _)| index != drive.joint);
    let mut carried = others().filter_map(|(_, joint)| Some((joint.is_pin(), joint.on(drive.link)?))).peekable();
    // A slide moves its link wherever the joints lie.
    mechanism.joints()[drive.joint].is_pin()
        && carried.peek().is_some()
        && carried
            .all(|(is_pin, place)| is_pin && own.is_some_and(|own| (place - own).norm() <= POINT * mechanism.size()))
}

fn motion_is_sound(motion: &DriveMotion) -> bool {
    let moves = |value: f64| value.is_finite() && value != 0.0;
    let (moved, motor) = match motion {
        DriveMotion::Prescribed { law, motor } => {
            let moved = match *law {
                MotionLaw::ConstantSpeed(speed) => moves(speed),
                MotionLaw::Ramp { speed, time } => moves(speed) && moves(time) && time > 0.0,
                MotionLaw::Cycloidal { rise, time } => moves(rise) && moves(time) && time > 0.0,
                MotionLaw::Table(ref table) => table.knots().iter().all(|knot| knot.is_finite()),
            };
            (moved && moves(law.top_speed()), motor)
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

/// Checks that the structure is that of mechanism and drives.
fn structure(parts: &CaseParts) -> Result<()> {
    let own = Structure::of(&parts.mechanism, &parts.drives.joints())?;
    if own != parts.structure {
        let [own, given] = [&own, &parts.structure].map(|structure| structure.groups.len() + structure.drivers.len());
        let message = format!("the structure, of {given} parts, is not that of mechanism and drives, of {own}");
        return Err(wrong("structure", message).help("take `Structure::of` the mechanism and its driven joints"));
    }
    match parts.drives.iter().zip(&own.drivers).find(|(drive, (link, _))| drive.link != *link) {
        None => Ok(()),
        Some((drive, &(link, joint))) => {
            let [said, turned] = [drive.link, link].map(|link| &parts.mechanism.links()[link].name);
            let name = &parts.mechanism.joints()[joint].name;
            Err(wrong("drive", format!("joint \"{name}\" drives link \"{turned}\", not \"{said}\"")))
        }
    }
}

fn loads(parts: &CaseParts) -> Result<()> {
    for (index, load) in parts.loads.iter().enumerate() {
        let fault = |message: String| Err(wrong("loads", format!("load {index}, a {}: {message}", load.sort())));
        let links = load.links();
        let count = parts.mechanism.links().len();
        if let Some(link) = links.iter().find(|link| link.index() >= count) {
            return fault(format!("it acts on link {link}, but there are {count} links"));
        }
        if !load.is_sound() {
            return fault(format!("a number is not finite, or negative where it must not be: {load:?}"));
        }
    }
    Ok(())
}

/// Checks that every link has a place, that all joints are closed there and that the driving links have their start
/// angles.
fn start(parts: &CaseParts) -> Result<()> {
    let (mechanism, poses) = (&parts.mechanism, &parts.start.0);
    let links = mechanism.links();
    if poses.len() != links.len() {
        let message = format!("the start pose has {} places, but there are {} links", poses.len(), links.len());
        return Err(wrong("start", message));
    }
    if poses[GROUND] != LinkPose::GROUND {
        return Err(wrong("start", format!("the ground is moved in the start pose: {:?}", poses[GROUND])));
    }
    let is_finite = |pose: &LinkPose| [pose.origin.x, pose.origin.y, pose.angle].iter().all(|value| value.is_finite());
    if let Some((link, pose)) = links.iter().zip(poses).find(|(_, pose)| !is_finite(pose)) {
        return Err(wrong("start", format!("link \"{}\" has no place in the start pose: {pose:?}", link.name)));
    }
    let at = parts.drives.crank().told(parts.drives.crank().start);
    let reach = poses.iter().fold(mechanism.size(), |most, pose| most.larger(pose.origin.norm()));
    for joint in mechanism.joints() {
        let sides = [joint.first, joint.second];
        let places = sides.map(|side| poses[side.link].point(side.local));
        let (gap, turn) = joint.opening(places, sides.map(|side| unit(poses[side.link].angle)));
        // Written this way round so that NaN is refused.
        if !(gap <= LARGEST_OPENING * reach && turn <= LARGEST_OPENING) {
            let message =
                format!("joint \"{}\" is open in the start pose, {at}: by {gap:.3e} m and {turn:.3e} rad", joint.name);
            return Err(Error::new(ErrorKind::Geometry, message).key("start").help(CLOSED));
        }
    }
    for drive in &parts.drives {
        let off = (unit(poses[drive.link].angle) - unit(drive.world_angle(drive.start))).norm();
        if !(off <= LARGEST_OPENING) {
            let name = &links[drive.link].name;
            let message = format!("link \"{name}\" stands {off:.3e} rad off the angle at which its drive starts");
            return Err(Error::new(ErrorKind::Geometry, message).key("start").help(CLOSED));
        }
    }
    Ok(())
}

const CLOSED: &str =
    "take `first_pose` at the world angles of the drives, or another pose in which all joints are closed";

/// Checks that every group has a mode, and that the mode is of the group's kind.
fn modes(parts: &CaseParts) -> Result<()> {
    let (groups, modes) = (&parts.structure.groups, &parts.modes);
    if groups.len() != modes.len() {
        let message = format!("there are {} assembly modes, but {} groups", modes.len(), groups.len());
        return Err(wrong("start", message));
    }
    for (group, mode) in groups.iter().zip(modes) {
        if !has_mode(group.kind, *mode) {
            let message = format!("the mode \"{}\" is none of group {}", mode.name(), group.names(&parts.mechanism));
            return Err(wrong("start", message));
        }
    }
    Ok(())
}

fn has_mode(kind: GroupKind, mode: AssemblyMode) -> bool {
    use AssemblyMode::{Ahead, Behind, Followed, Left, Only, Right};
    match kind {
        GroupKind::Rrr => matches!(mode, Left | Right),
        GroupKind::Rrp | GroupKind::Rpr => matches!(mode, Ahead | Behind),
        GroupKind::Rpp | GroupKind::Prp => mode == Only,
        GroupKind::Higher => mode == Followed,
    }
}

#[cfg(test)]
mod tests;
