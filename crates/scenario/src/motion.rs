//! `[drive]`, with `[motor]`, and `[gravity]`.

use std::sync::Arc;

use super::keys::key::{Kind, Section, needed, optional};
use super::motor;
use super::reader::{Faults, Sign, Table};
use super::words::{Words, choice, names, suggestion};
use linkage::drive::{Drive, DriveMotion, Drives, MotionLaw};
use linkage::error::Result;
use linkage::input::InputValue;
use linkage::math::{Piecewise, Vec2};
use linkage::mechanism::{GROUND, JointKind, Mechanism, Side};

/// What is told of the keys that are read here.
pub const SECTIONS: &[Section] = &[
    Section::at("drive").with(&[
        needed("joint", Kind::Text).means("revolute joint between the ground and the driving link"),
        optional("law", Kind::Choice(|| names(LAWS)), "`\"constant\"`").means("crank angle over time; below"),
        optional("zero", Kind::INPUTS, "0").means("world direction from which the crank angle is measured"),
        optional("motion", Kind::Choice(|| vec!["prescribed", "free"]), "`\"prescribed\"`")
            .means("`\"free\"`: forces determine the motion, see below"),
        optional("initial_speed", Kind::SPEEDS, "0").means("of a free link: its angular velocity at t = 0"),
        optional("through", Kind::Choice(|| vec!["smooth"]), "a change point is an error; a free motion passes it")
            .means("the mechanism passes change points on the branch on which velocities go on; see below"),
        optional("start", Kind::ANGLES, "required there, refused on the first")
            .means("of every drive but the first: its angle at t = 0"),
        optional("speed", Kind::SPEEDS.of(Sign::NotZero), "required but of the laws `\"cycloidal\"` and `\"table\"`")
            .means("angular velocity, counter-clockwise positive, not zero"),
        optional("time", Kind::TIMES.of(Sign::Positive), "required of these laws")
            .means("duration of a ramp, or of a cycloidal law"),
        optional("to", Kind::INPUTS, "required of this law").means("last crank angle of a cycloidal law"),
        optional("points", Kind::Tables, "required of the law `\"table\"`")
            .means("points of a table, two or more: times ascending from 0, the first angle that of the start"),
    ]),
    Section::at("drive.points").with(&[
        needed("time", Kind::TIMES.of(Sign::NotNegative)).means("time"),
        needed("angle", Kind::INPUTS).means("crank angle at that time"),
    ]),
    Section::at("gravity")
        .with(&[needed("x", Kind::ACCELERATIONS).means("along x"), needed("y", Kind::ACCELERATIONS).means("along y")]),
];

/// The drives of the mechanism: the crank, with `start` as its angle at t = 0 (rad) and with the motor, and further
/// drives, which state their own start. `None` after a mistake.
pub fn drives(
    tables: Vec<Table>,
    motor: Option<Table>,
    mechanism: &Mechanism,
    start: f64,
    faults: &mut Faults,
) -> Option<Drives> {
    let mut drives: Vec<Drive> = Vec::new();
    let count = tables.len();
    for (index, mut table) in tables.into_iter().enumerate() {
        let own = |table: &mut Table| {
            let start = if index == 0 { start } else { table.si("start")? };
            let drive = drive(table, mechanism, &drives, start)?;
            check_beside(table, &drive, &drives)?;
            Ok(drive)
        };
        drives.extend(faults.read(&mut table, own));
        // A drive may hang on a link that one before it moves.
        faults.whole &= drives.len() > index;
    }
    let motor = motor.map(|mut motor| faults.read(&mut motor, motor::read));
    if drives.len() < count || matches!(motor, Some(None)) {
        return None;
    }
    let crank = drives.remove(0).with_motor(motor.flatten());
    Some(Drives::new(crank, drives))
}

/// Checks that a drive may stand beside those before it.
fn check_beside(table: &Table, drive: &Drive, before: &[Drive]) -> Result<()> {
    if before.is_empty() {
        return Ok(());
    }
    let all = || before.iter().chain([drive]);
    // Several drives are coupled by the crank angle, which determines the time only at constant speeds.
    if all().any(|drive| drive.constant_speed().is_none()) {
        let message = "one of several drives has a speed that changes";
        return table.unsupported("law", message, "give all drives constant speeds");
    }
    if all().any(|drive| drive.through) {
        let message = "change points are passed with one drive only, and there are several";
        return table.unsupported("through", message, "take the key out");
    }
    Ok(())
}

/// A drive; `before` are the drives already read.
fn drive(table: &mut Table, mechanism: &Mechanism, before: &[Drive], start: f64) -> Result<Drive> {
    let name = table.string("joint")?;
    let known = mechanism.joint_named(&name);
    let kind = known.map(|index| mechanism.joints()[index].kind);
    let input = kind.and_then(JointKind::input).unwrap_or_default();
    let law = law(table, input.at(start))?;
    let zero = table.optional_si("zero")?.unwrap_or(0.0);
    let motion = motion(table, law)?;
    let through = through(table)?;
    table.finish()?;
    let Some(index) = known else {
        let names = mechanism.joints().iter().map(|joint| joint.name.as_str());
        return table.refuse("joint", format!("there is no joint \"{name}\""), suggestion(&name, names, "\""));
    };
    if before.iter().any(|other| other.joint == index) {
        return table.refuse("joint", "this joint is driven already", "give every drive a joint of its own");
    }
    let joint = &mechanism.joints()[index];
    let hangs_on = |side: Side| side.link == GROUND || before.iter().any(|drive| drive.link == side.link);
    let Some(link) = [[joint.first, joint.second], [joint.second, joint.first]]
        .into_iter()
        .find_map(|[base, side]| (hangs_on(base) && !hangs_on(side)).then_some(side.link))
    else {
        let names = [joint.first, joint.second].map(|side| &mechanism.links()[side.link].name);
        let message =
            format!("joint \"{name}\" joins \"{}\" and \"{}\", not a link and the ground", names[0], names[1]);
        let hinges = mechanism.joints().iter().filter(|joint| joint.on(GROUND).is_some() && joint.is_pin());
        let hinges: Vec<&str> = hinges.map(|joint| joint.name.as_str()).collect();
        let help = format!("drive a link that is hinged to the ground: {}", choice(hinges, "\""));
        return table.unsupported("joint", message, help);
    };
    let drive = Drive { input, joint: index, link, zero, start, motion, through };
    if joint.on(GROUND).is_none() && !drive.is_free() {
        let message = format!("joint \"{name}\" hangs on a moving link, but the motion of its link is prescribed");
        let help = "only a free link may hang on a moving one: write `motion = \"free\"`, or drive a link that is hinged to the ground";
        return table.unsupported("joint", message, help);
    }
    if joint.kind.input().is_none() {
        let message = format!("joint \"{name}\" is {}, but the crank turns", joint.kind.name());
        let help = "drive a link that is hinged to the ground by a revolute joint";
        return table.unsupported("joint", message, help);
    }
    Ok(drive)
}

/// Whether the link follows `law`, or is free from t = 0 on with `law` as its nominal motion.
fn motion(table: &mut Table, law: MotionLaw) -> Result<DriveMotion> {
    let initial = table.optional_si("initial_speed")?;
    match table.optional_string("motion")?.as_deref() {
        Some("free") => {
            let Some(nominal_speed) = law.constant() else {
                let help = "forces decide a free motion: give its nominal speed only (`speed_rpm`)";
                return table.refuse("law", "the motion is free, but a law is given", help);
            };
            Ok(DriveMotion::Free { initial_speed: initial.unwrap_or(0.0), nominal_speed, motor: None })
        }
        None if initial.is_some() => Err(table.lacks(
            &["motion"],
            "a link with a speed at t = 0 moves freely: write `motion = \"free\"`, or take `initial_speed` out",
        )),
        Some("prescribed") if initial.is_some() => {
            let help = "write `motion = \"free\"` to leave it to its motor and the loads, or take the key out";
            table.refuse("initial_speed", "the link is given a speed at t = 0, but its motion is prescribed", help)
        }
        None | Some("prescribed") => Ok(DriveMotion::Prescribed { law, motor: None }),
        Some(other) => {
            let help = suggestion(other, ["prescribed", "free"], "\"");
            table.refuse("motion", format!("\"{other}\" is no sort of motion"), help)
        }
    }
}

/// Whether change points are passed.
fn through(table: &mut Table) -> Result<bool> {
    match table.optional_string("through")?.as_deref() {
        None => Ok(false),
        Some("smooth") => Ok(true),
        Some("jump") => {
            let message = "on the other branch velocities jump at a change point, which takes infinite forces";
            let help = "write `through = \"smooth\"` for the branch on which they go on, or take the key out";
            table.unsupported("through", message, help)
        }
        Some(other) => {
            let help = "write `through = \"smooth\"` for the branch on which velocities go on, or take the key out";
            table.refuse("through", format!("\"{other}\" is no way through a change point"), help)
        }
    }
}

/// Laws, each with its reader, which gets the input at t = 0.
const LAWS: Words<fn(&mut Table, InputValue) -> Result<MotionLaw>> =
    &[("constant", constant), ("ramp", ramp), ("cycloidal", cycloidal), ("table", points)];

fn law(table: &mut Table, start: InputValue) -> Result<MotionLaw> {
    if table.has("law") || table.has("points") || table.has_si("to") || table.has_si("time") {
        return table.choice("law", "is no law of motion", LAWS)?(table, start);
    }
    table.optional_string("law")?;
    constant(table, start)
}

fn constant(table: &mut Table, _: InputValue) -> Result<MotionLaw> {
    Ok(MotionLaw::ConstantSpeed(table.si("speed")?))
}

fn ramp(table: &mut Table, _: InputValue) -> Result<MotionLaw> {
    let speed = table.si("speed")?;
    Ok(MotionLaw::Ramp { speed, time: table.si("time")? })
}

fn cycloidal(table: &mut Table, start: InputValue) -> Result<MotionLaw> {
    let rise = table.si("to")? - start.value;
    let time = table.si("time")?;
    if rise == 0.0 {
        let message = "the crank is to stay where it starts";
        return table.refuse("to", message, "give a crank angle other than that of the start");
    }
    Ok(MotionLaw::Cycloidal { rise, time })
}

/// From rest at the start, at t = 0, to rest at the last point.
fn points(table: &mut Table, start: InputValue) -> Result<MotionLaw> {
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
                let message = format!(
                    "the table does not begin with the start of the crank, {} {} at 0 s",
                    input.shown(start),
                    input.shown_in().0
                );
                return Err(point.fault(message).help("write the start as the first point"));
            }
            Some((last, _)) if !(time > *last) => {
                let message = format!("the times do not ascend: {time} s comes after {last} s");
                return Err(point.fault(message).help("write the points in ascending order of time, each time once"));
            }
            _ => points.push((time, gone)),
        }
    }
    if points.len() < 2 || points.iter().all(|&(_, gone)| gone == 0.0) {
        let help = "write `points = [{ time_s = 0, angle_deg = 0 }, { time_s = 0.5, angle_deg = 90 }]`";
        return table.refuse("points", "a table of angles needs two points or more that are not all one angle", help);
    }
    Ok(MotionLaw::Table(Arc::new(Piecewise::clamped_spline(&points, [0.0; 2]))))
}

/// Acceleration of gravity (m/s^2).
pub fn gravity(table: &mut Table) -> Result<Vec2> {
    let (x, y) = (table.si("x")?, table.si("y")?);
    table.finish()?;
    Ok(Vec2::new(x, y))
}
