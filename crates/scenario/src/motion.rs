//! `[drive]`, with `[motor]`, and `[gravity]`.

use crate::sentences;
use std::sync::Arc;

use super::keys::key::{Section, ValueKind, needed, optional};
use super::motor;
use super::reader::{Faults, Sign, TomlTable};
use super::words::{Words, choice, names, suggestion};
use linkage::drive::{Drive, DriveMotion, Drives, MotionLaw};
use linkage::error::Result;
use linkage::input::InputValue;
use linkage::math::{Piecewise, Vec2};
use linkage::mechanism::{GROUND, JointKind, JointSide, Mechanism};

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("drive").with(&[
        needed("joint", ValueKind::Text).means("revolute joint between the ground and the driving link"),
        optional("law", ValueKind::Choice(|| names(LAWS)), "`\"constant\"`")
            .means("law of the crank angle over time, see below"),
        optional("zero", ValueKind::INPUTS, "0").means("world direction from which the crank angle is measured"),
        optional("motion", ValueKind::Choice(|| vec!["prescribed", "free"]), "`\"prescribed\"`")
            .means("`\"free\"`: forces determine the motion, see below"),
        optional("initial_speed", ValueKind::SPEEDS, "0").means("angular velocity of a free driving link at t = 0"),
        optional(
            "through",
            ValueKind::Choice(|| vec!["smooth"]),
            "a change point is an error; a free motion passes it",
        )
        .means("the mechanism passes change points on the branch with continuous velocities; see below"),
        optional("start", ValueKind::ANGLES, "required for these drives, not allowed for the first")
            .means("for every drive but the first: angle at t = 0"),
        optional(
            "speed",
            ValueKind::SPEEDS.of(Sign::NotZero),
            "required, except for the laws `\"cycloidal\"` and `\"table\"`",
        )
        .means("angular velocity, counter-clockwise positive, not zero"),
        optional("time", ValueKind::TIMES.of(Sign::Positive), "required for these laws")
            .means("duration of a ramp, or of a cycloidal law"),
        optional("to", ValueKind::INPUTS, "required for this law").means("last crank angle of a cycloidal law"),
        optional("points", ValueKind::Tables, "required for the law `\"table\"`")
            .means("points of a table, two or more: times ascending from 0; the first angle is the start angle"),
    ]),
    Section::at("drive.points").with(&[
        needed("time", ValueKind::TIMES.of(Sign::NotNegative)).means("time"),
        needed("angle", ValueKind::INPUTS).means("crank angle at that time"),
    ]),
    Section::at("gravity").with(&[
        needed("x", ValueKind::ACCELERATIONS).means("along x"),
        needed("y", ValueKind::ACCELERATIONS).means("along y"),
    ]),
];

/// The drives of the mechanism: the crank first, then the further drives.
/// The crank has the angle `start` at t = 0 (rad) and gets the motor, if there is one.
/// Every further drive states its start itself. After a mistake, the result is `None`.
pub fn drives(
    tables: Vec<TomlTable>,
    motor: Option<TomlTable>,
    mechanism: &Mechanism,
    start: f64,
    faults: &mut Faults,
) -> Option<Drives> {
    let mut drives: Vec<Drive> = Vec::new();
    let (count, whole) = (tables.len(), faults.whole);
    for (index, mut table) in tables.into_iter().enumerate() {
        let own = |table: &mut TomlTable| {
            let start = if index == 0 { start } else { table.si("start")? };
            let drive = drive(table, mechanism, &drives, start, whole)?;
            check_beside(table, &drive, &drives)?;
            Ok(drive)
        };
        drives.extend(faults.read(&mut table, own));
        // An earlier drive may move the link that carries a later drive. After a mistake in a drive, the file therefore
        // does not count as whole.
        faults.whole &= drives.len() > index;
    }
    let motor = motor.map(|mut motor| faults.read(&mut motor, motor::read));
    if drives.len() < count || matches!(motor, Some(None)) {
        return None;
    }
    let crank = drives.remove(0).with_motor(motor.flatten());
    Some(Drives::new(crank, drives))
}

/// Checks that a drive can be combined with the drives before it.
fn check_beside(table: &TomlTable, drive: &Drive, before: &[Drive]) -> Result<()> {
    if before.is_empty() {
        return Ok(());
    }
    let all = || before.iter().chain([drive]);
    // Several drives are coupled by the crank angle. The crank angle determines the time only at constant speeds, so
    // changing speeds are refused.
    if all().any(|drive| drive.constant_speed().is_none()) {
        let message = sentences::ONE_OF_SEVERAL_DRIVES_HAS_A_SPEED;
        return table.unsupported("law", message, sentences::GIVE_ALL_DRIVES_CONSTANT_SPEEDS);
    }
    if all().any(|drive| drive.through) {
        let message = sentences::CHANGE_POINTS_ARE_PASSED_WITH_ONE_DRIVE;
        return table.unsupported("through", message, sentences::TAKE_THE_KEY_OUT);
    }
    Ok(())
}

/// Reads a drive. `before` are the drives already read. `start` is the input of the drive at t = 0.
/// If the mechanism is `whole`, all its joints are known.
fn drive(table: &mut TomlTable, mechanism: &Mechanism, before: &[Drive], start: f64, whole: bool) -> Result<Drive> {
    let name = table.string("joint")?;
    let known = mechanism.joint_named(&name);
    let kind = known.map(|index| mechanism.joints()[index].kind);
    let input = kind.and_then(JointKind::input).unwrap_or_default();
    let unknown = |table: &TomlTable| -> Result<Drive> {
        let names = mechanism.joints().iter().map(|joint| joint.name.as_str());
        table.refuse("joint", sentences::there_is_no_joint(&name), suggestion(&name, names, "\""))
    };
    let law = law(table, input.at(start));
    if law.is_err() && whole && known.is_none() {
        let missing = unknown(table);
        table.part(missing.map(|_| ()));
    }
    let law = law?;
    let zero = table.optional_si("zero")?.unwrap_or(0.0);
    let motion = motion(table, law)?;
    let through = through(table)?;
    table.finish()?;
    let Some(index) = known else {
        return unknown(table);
    };
    if before.iter().any(|other| other.joint == index) {
        return table.refuse("joint", sentences::THIS_JOINT_IS_DRIVEN_ALREADY, sentences::GIVE_EVERY_DRIVE_A_JOINT);
    }
    let joint = &mechanism.joints()[index];
    let hangs_on = |side: JointSide| side.link == GROUND || before.iter().any(|drive| drive.link == side.link);
    let Some(link) = [[joint.first, joint.second], [joint.second, joint.first]]
        .into_iter()
        .find_map(|[base, side]| (hangs_on(base) && !hangs_on(side)).then_some(side.link))
    else {
        let names = [joint.first, joint.second].map(|side| &mechanism.links()[side.link].name);
        let message = sentences::joint_joins_and_not_a_link(&name, &names[0], &names[1]);
        let hinges = mechanism.joints().iter().filter(|joint| joint.on(GROUND).is_some() && joint.is_pin());
        let hinges: Vec<&str> = hinges.map(|joint| joint.name.as_str()).collect();
        let help = sentences::drive_a_link_that_is_hinged_to_the_ground(&(choice(hinges, "\"")));
        return table.unsupported("joint", message, help);
    };
    let drive = Drive { input, joint: index, link, zero, start, motion, through };
    if joint.on(GROUND).is_none() && !drive.is_free() {
        let message = sentences::joint_hangs_on_a_moving_link(&name);
        let help = sentences::ONLY_A_FREE_LINK_MAY_HANG;
        return table.unsupported("joint", message, help);
    }
    if joint.kind.input().is_none() {
        let message = sentences::joint_is_but_the_crank_turns(&name, &joint.kind.name());
        let help = sentences::DRIVE_A_LINK_THAT_IS_HINGED;
        return table.unsupported("joint", message, help);
    }
    Ok(drive)
}

/// The motion of a drive. The link of the drive either follows `law`, or is free from t = 0 on with `law` as its
/// nominal motion.
fn motion(table: &mut TomlTable, law: MotionLaw) -> Result<DriveMotion> {
    let initial = table.optional_si("initial_speed")?;
    match table.optional_string("motion")?.as_deref() {
        Some("free") => {
            let Some(nominal_speed) = law.constant() else {
                let help = sentences::FORCES_DECIDE_A_FREE_MOTION;
                return table.refuse("law", sentences::THE_MOTION_IS_FREE_BUT_A_LAW, help);
            };
            Ok(DriveMotion::Free { initial_speed: initial.unwrap_or(0.0), nominal_speed, motor: None })
        }
        None if initial.is_some() => Err(table.lacks(&["motion"], sentences::A_LINK_WITH_A_SPEED_AT_MOVES)),
        Some("prescribed") if initial.is_some() => {
            let help = sentences::WRITE_MOTION_FREE_TO_LEAVE;
            table.refuse("initial_speed", sentences::THE_LINK_IS_GIVEN_A_SPEED, help)
        }
        None | Some("prescribed") => Ok(DriveMotion::Prescribed { law, motor: None }),
        Some(other) => {
            let help = suggestion(other, ["prescribed", "free"], "\"");
            table.refuse("motion", sentences::is_no_sort_of_motion(&other), help)
        }
    }
}

/// Whether the motion passes change points.
fn through(table: &mut TomlTable) -> Result<bool> {
    match table.optional_string("through")?.as_deref() {
        None => Ok(false),
        Some("smooth") => Ok(true),
        Some("jump") => {
            let message = sentences::ON_THE_OTHER_BRANCH_VELOCITIES;
            let help = sentences::WRITE_THROUGH_SMOOTH_FOR_THE_BRANCH_ON_WHICH_THEY;
            table.unsupported("through", message, help)
        }
        Some(other) => {
            let help = sentences::WRITE_THROUGH_SMOOTH_FOR_THE_BRANCH;
            table.refuse("through", sentences::is_no_way_through_a_change(&other), help)
        }
    }
}

/// Laws of motion, each with its reader. The reader gets the input at t = 0.
const LAWS: Words<fn(&mut TomlTable, InputValue) -> Result<MotionLaw>> =
    &[("constant", constant), ("ramp", ramp), ("cycloidal", cycloidal), ("table", points)];

fn law(table: &mut TomlTable, start: InputValue) -> Result<MotionLaw> {
    if table.has("law") || table.has("points") || table.has_si("to") || table.has_si("time") {
        return table.choice("law", sentences::IS_NO_LAW_OF_MOTION, LAWS)?(table, start);
    }
    table.optional_string("law")?;
    constant(table, start)
}

fn constant(table: &mut TomlTable, _: InputValue) -> Result<MotionLaw> {
    Ok(MotionLaw::ConstantSpeed(table.si("speed")?))
}

fn ramp(table: &mut TomlTable, _: InputValue) -> Result<MotionLaw> {
    let speed = table.si("speed")?;
    Ok(MotionLaw::Ramp { speed, time: table.si("time")? })
}

fn cycloidal(table: &mut TomlTable, start: InputValue) -> Result<MotionLaw> {
    let rise = table.si("to")? - start.value;
    let time = table.si("time")?;
    if rise == 0.0 {
        let message = sentences::THE_CRANK_IS_TO_STAY_WHERE;
        return table.refuse("to", message, sentences::GIVE_A_CRANK_ANGLE_OTHER);
    }
    Ok(MotionLaw::Cycloidal { rise, time })
}

/// A law of motion from a table. The motion starts from rest at t = 0 and ends at rest at the last point.
fn points(table: &mut TomlTable, start: InputValue) -> Result<MotionLaw> {
    let InputValue { input, value: start } = start;
    let mut points: Vec<(f64, f64)> = Vec::new();
    for mut point in table.tables("points")? {
        let read = point.read(|point| {
            let time = point.si("time")?;
            let gone = point.si("angle")? - start;
            point.finish()?;
            Ok((time, gone))
        });
        let (time, gone) = read?;
        match points.last() {
            None if time != 0.0 || gone.abs() > 1e-12 => {
                let message = sentences::the_table_does_not_begin(&input.shown(start), &input.shown_in().0);
                return Err(point.fault(message).help(sentences::WRITE_THE_START_AS_THE_FIRST));
            }
            Some((last, _)) if !(time > *last) => {
                let message = sentences::the_times_do_not_ascend_comes(&time, &last);
                return Err(point.fault(message).help(sentences::WRITE_THE_POINTS_IN_ASCENDING_ORDER));
            }
            _ => points.push((time, gone)),
        }
    }
    if points.len() < 2 || points.iter().all(|&(_, gone)| gone == 0.0) {
        let help = "write `points = [{ time_s = 0, angle_deg = 0 }, { time_s = 0.5, angle_deg = 90 }]`";
        return table.refuse("points", sentences::A_TABLE_OF_ANGLES_NEEDS_TWO, help);
    }
    Ok(MotionLaw::Table(Arc::new(Piecewise::clamped_spline(&points, [0.0; 2]))))
}

/// Acceleration of gravity (m/s^2).
pub fn gravity(table: &mut TomlTable) -> Result<Vec2> {
    let (x, y) = (table.si("x")?, table.si("y")?);
    table.finish()?;
    Ok(Vec2::new(x, y))
}
