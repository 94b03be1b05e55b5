//! `[drive]`, with `[motor]`, and `[gravity]`.

use crate::sentences;
use std::sync::Arc;

use super::asked::StartRequest;
use super::curve::{self, CurveVariable};
use super::keys::key::{Section, ValueKind, needed, optional};
use super::motor;
use super::reader::{Faults, Sign, TomlTable};
use super::unit::{LENGTH, SPEED, UnitFamily, of_input, of_input_rate};
use super::words::{Words, names, suggestion};
use linkage::drive::{Drive, DriveMotion, Drives, MotionLaw};
use linkage::error::Result;
use linkage::input::{Input, InputValue};
use linkage::math::{Curve, KeepNan, Piecewise, Vec2};
use linkage::mechanism::{LinkId, Mechanism};

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("drive").with(&[
        needed("joint", ValueKind::Text).means(
            "the driven joint. A prismatic joint has its slide as input, a revolute joint on the ground the crank angle, \
             any other revolute joint the angle of its second link minus that of its first link. A free link on the link \
             of an earlier drive has its world angle as input",
        ),
        optional("law", ValueKind::Choice(|| names(LAWS)), "`\"constant\"`")
            .means("law of the input over time, see below"),
        optional("zero", ValueKind::INPUTS, "0").means("zero of the input; for a crank, the world direction from which its angle is measured"),
        optional("motion", ValueKind::Choice(|| vec!["prescribed", "free"]), "`\"prescribed\"`")
            .means("`\"free\"`: forces determine the motion, see below"),
        optional("initial_speed", ValueKind::INPUT_RATES, "0").means("rate of the input of a free driving link at t = 0"),
        optional(
            "through",
            ValueKind::Choice(|| vec!["smooth"]),
            "a change point is an error; a free motion passes it",
        )
        .means("the mechanism passes change points on the branch with continuous velocities; see below"),
        optional("start", ValueKind::INPUTS, "required, except for a crank as the first drive, a table and a formula")
            .means("input at t = 0. The angle of the first crank is `crank` in `[start]`"),
        optional(
            "speed",
            ValueKind::INPUT_RATES.of(Sign::NotZero),
            "required for the laws `\"constant\"` and `\"ramp\"`",
        )
        .means("rate of the input, not zero; an angular velocity is counter-clockwise positive"),
        optional("time", ValueKind::TIMES.of(Sign::Positive), "required for these laws")
            .means("duration of a ramp, of a cycloidal law, or of a formula"),
        optional("to", ValueKind::INPUTS, "required for this law").means("last input of a cycloidal law"),
        optional("amplitude", ValueKind::INPUTS.of(Sign::NotZero), "required for the law `\"harmonic\"`")
            .means("amplitude of the oscillation amplitude * sin(2 pi t / period + phase) of the input about a mean value"),
        optional("period", ValueKind::TIMES.of(Sign::Positive), "required for this law").means("period of the oscillation"),
        optional("phase", ValueKind::ANGLES, "0").means("phase at t = 0; the oscillation begins at rest with -90 deg"),
        optional("formula", ValueKind::Text, "required for the law `\"formula\"`")
            .means("the input in rad or m as a formula of the time `t` in s, with two continuous derivatives"),
        optional("points", ValueKind::Tables, "required for the law `\"table\"`")
            .means("points of a table, two or more: times ascending from 0; the first point is the start"),
    ]),
    Section::at("drive.points").with(&[
        needed("time", ValueKind::TIMES.of(Sign::NotNegative)).means("time"),
        optional("angle", ValueKind::ANGLES, "required for an angle").means("input at that time"),
        optional("slide", ValueKind::LENGTHS, "required for a slide").means("input at that time"),
    ]),
    Section::at("gravity").with(&[
        needed("x", ValueKind::ACCELERATIONS).means("along x"),
        needed("y", ValueKind::ACCELERATIONS).means("along y"),
    ]),
];

/// The drives of the mechanism: the crank first, then the further drives.
/// `crank` is the stated crank angle at t = 0 (rad), if the first drive moves a crank. `asked` may replace the start of
/// the first drive. The first drive gets the motor, if there is one.
/// Also returns the start of the first drive as the file states it. Returns `None` after a mistake in a drive or in the
/// motor, or if there is no drive.
pub fn drives(
    tables: Vec<TomlTable>,
    motor: Option<TomlTable>,
    mechanism: &Mechanism,
    (crank, asked): (Option<f64>, &StartRequest),
    faults: &mut Faults,
) -> Option<(Drives, f64)> {
    if tables.is_empty() {
        return None;
    }
    let (mut drives, mut first): (Vec<Drive>, f64) = (Vec::new(), 0.0);
    let (count, whole) = (tables.len(), faults.whole);
    for (index, mut table) in tables.into_iter().enumerate() {
        let own = |table: &mut TomlTable| {
            let first_drive = (index == 0).then_some((crank, asked));
            let mut drive = drive(table, mechanism, &drives, first_drive, whole)?;
            check_beside(table, &drive, &drives)?;
            if index == 0 {
                first = drive.start;
                drive.start = asked.start(drive.input).unwrap_or(first);
            }
            Ok(drive)
        };
        drives.extend(faults.read(&mut table, own));
        // An earlier drive may move the link that carries a later drive. After a mistake in a drive, errors that may
        // follow from it are therefore not reported (see `Faults::whole`).
        faults.whole &= drives.len() > index;
    }
    let motor = motor.map(|mut motor| {
        let input = drives.first().map_or(Input::Angle, |drive| drive.input);
        faults.read(&mut motor, |motor| {
            if input != Input::Angle {
                let message = sentences::a_motor_needs_a_crank(&input.noun());
                return Err(motor.fault(message).help(sentences::TAKE_MOTOR_OUT_OR_DRIVE));
            }
            motor::read(motor)
        })
    });
    if drives.len() < count || matches!(motor, Some(None)) {
        return None;
    }
    let crank = drives.remove(0).with_motor(motor.flatten());
    Some((Drives::new(crank, drives), first))
}

/// Input of the first drive; `None` without a drive.
pub fn first_input(tables: &[TomlTable], mechanism: &Mechanism) -> Option<Input> {
    let table = tables.first()?;
    let joint = table.peek("joint").and_then(|name| mechanism.joint_named(name));
    Some(joint.map_or_else(|| guessed(table), |joint| Drive::of_joint(&mechanism.joints()[joint], &[], false).0))
}

/// Probable input of a drive whose joint is unknown, from the units of its keys.
fn guessed(table: &TomlTable) -> Input {
    let lengths = [("start", &LENGTH), ("to", &LENGTH), ("zero", &LENGTH), ("speed", &SPEED)];
    let has = |(key, family): &(&str, &'static UnitFamily)| family.all_keys(key).iter().any(|key| table.has(key));
    if lengths.iter().any(has) { Input::Slide } else { Input::Angle }
}

/// Checks that a drive can be combined with the drives before it.
fn check_beside(table: &TomlTable, drive: &Drive, before: &[Drive]) -> Result<()> {
    if !before.is_empty() && before.iter().chain([drive]).any(|drive| drive.through) {
        let message = sentences::CHANGE_POINTS_ARE_PASSED_WITH_ONE_DRIVE;
        return table.unsupported("through", message, sentences::TAKE_THE_KEY_OUT);
    }
    Ok(())
}

/// Reads a drive. `before` are the drives already read. `first` is `Some` only for the first drive. It contains the
/// crank angle that `[start]` states, if any, and the caller's request, which may replace the file's start.
/// `whole` says whether all links and joints of the file could be read. Only then is an unknown joint reported.
fn drive(
    table: &mut TomlTable,
    mechanism: &Mechanism,
    before: &[Drive],
    first: Option<(Option<f64>, &StartRequest)>,
    whole: bool,
) -> Result<Drive> {
    let name = table.string("joint")?;
    let known = mechanism.joint_named(&name);
    let unknown = |table: &TomlTable| -> Result<Drive> {
        let names = mechanism.joints().iter().map(|joint| joint.name.as_str());
        table.refuse("joint", sentences::there_is_no_joint(&name), suggestion(&name, names, "\""))
    };
    let is_free = table.optional_string("motion")?.as_deref() == Some("free");
    let joint = known.map(|index| &mechanism.joints()[index]);
    let (input, link) = match joint {
        Some(joint) => Drive::of_joint(joint, before, is_free),
        None => (guessed(table), LinkId(1)),
    };
    let gives_start = table.has("points") || table.has("formula");
    let stated = match first {
        // A missing angle is the law's first angle, or zero. The reader of `[start]` reports the mistake.
        Some((crank, _)) if input == Input::Angle => crank.or((!gives_start).then_some(0.0)),
        Some(_) | None if gives_start => table.optional_quantity("start", of_input(input), Sign::Any)?,
        Some(_) | None => Some(table.quantity("start", of_input(input), Sign::Any)?),
    };
    let asked = first.and_then(|(_, asked)| asked.start(input)).or(stated);
    let law =
        law(table, input.at(asked.unwrap_or_default())).and_then(|(law, begin)| begun(table, input, law, begin, asked));
    if law.is_err() && whole && known.is_none() {
        let missing = unknown(table);
        table.part(missing.map(|_| ()));
    }
    let (law, start) = law?;
    if first.is_some() && law.holds() {
        return table.refuse("law", sentences::THE_FIRST_DRIVE_HOLDS, sentences::PUT_A_MOVING_DRIVE_FIRST);
    }
    let stated = stated.unwrap_or(start);
    let zero = table.optional_quantity("zero", of_input(input), Sign::Any)?.unwrap_or(0.0);
    let motion = motion(table, law, input)?;
    let through = through(table)?;
    table.finish()?;
    let Some(joint) = known else {
        return unknown(table);
    };
    if before.iter().any(|other| other.joint == joint) {
        return table.refuse("joint", sentences::THIS_JOINT_IS_DRIVEN_ALREADY, sentences::GIVE_EVERY_DRIVE_A_JOINT);
    }
    Ok(Drive { input, joint, link, zero, start: stated, motion, through })
}

/// The motion of a drive. The link of the drive either follows `law`, or is free from t = 0 on with `law` as its
/// nominal motion.
fn motion(table: &mut TomlTable, law: MotionLaw, input: Input) -> Result<DriveMotion> {
    let initial = table.optional_quantity("initial_speed", of_input_rate(input), Sign::Any)?;
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
            table.refuse("initial_speed", sentences::THE_LINK_IS_GIVEN_A_SPEED, sentences::WRITE_MOTION_FREE_TO_LEAVE)
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
            let help = sentences::WRITE_THROUGH_SMOOTH_FOR_THE_BRANCH;
            table.unsupported("through", sentences::ON_THE_OTHER_BRANCH_VELOCITIES, help)
        }
        Some(other) => {
            let help = sentences::WRITE_THROUGH_SMOOTH_FOR_THE_BRANCH;
            table.refuse("through", sentences::is_no_way_through_a_change(&other), help)
        }
    }
}

/// A law, and the input at t = 0 if the law itself gives this input.
type Begun = (MotionLaw, Option<f64>);

/// Laws of motion, each with its reader. The reader gets the input at t = 0.
const LAWS: Words<fn(&mut TomlTable, InputValue) -> Result<Begun>> = &[
    ("constant", constant),
    ("ramp", ramp),
    ("cycloidal", cycloidal),
    ("harmonic", harmonic),
    ("formula", formula),
    ("table", points),
    ("hold", hold),
];

fn law(table: &mut TomlTable, start: InputValue) -> Result<Begun> {
    // Keys that a constant speed does not have.
    let has_key = ["law", "points", "formula"].iter().any(|key| table.has(key));
    if has_key || ["to", "time", "amplitude", "period"].iter().any(|key| table.has_si(key)) {
        return table.choice("law", sentences::IS_NO_LAW_OF_MOTION, LAWS)?(table, start);
    }
    table.optional_string("law")?;
    constant(table, start)
}

/// The law with its start. `begin` is the input at t = 0 that the law itself gives; `start` is the stated or requested
/// start. If both are given, they must be equal.
fn begun(
    table: &mut TomlTable,
    input: Input,
    law: MotionLaw,
    begin: Option<f64>,
    start: Option<f64>,
) -> Result<(MotionLaw, f64)> {
    match (begin, start) {
        (Some(begin), Some(start)) if !((begin - start).abs() <= 1e-12 * start.abs().larger(1.0)) => {
            let rounded = |value: f64| {
                format!("{:.6}", input.shown(value)).trim_end_matches('0').trim_end_matches('.').to_string()
            };
            let message = sentences::the_law_does_not_begin(&rounded(begin), &rounded(start), &input.shown_in().0);
            let key = if table.has("formula") { "formula" } else { "points" };
            table.refuse(key, message, sentences::LET_LAW_AND_START_BE_EQUAL)
        }
        (begin, start) => Ok((law, start.or(begin).unwrap_or_default())),
    }
}

fn constant(table: &mut TomlTable, start: InputValue) -> Result<Begun> {
    Ok((MotionLaw::ConstantSpeed(speed(table, start)?), None))
}

/// Speed of a law: the rate of the input (rad/s or m/s).
fn speed(table: &mut TomlTable, start: InputValue) -> Result<f64> {
    table.quantity("speed", of_input_rate(start.input), Sign::NotZero)
}

fn ramp(table: &mut TomlTable, start: InputValue) -> Result<Begun> {
    let speed = speed(table, start)?;
    Ok((MotionLaw::Ramp { speed, time: table.si("time")? }, None))
}

fn hold(_: &mut TomlTable, _: InputValue) -> Result<Begun> {
    Ok((MotionLaw::ConstantSpeed(0.0), None))
}

fn harmonic(table: &mut TomlTable, start: InputValue) -> Result<Begun> {
    let amplitude = table.quantity("amplitude", of_input(start.input), Sign::NotZero)?;
    let (period, phase) = (table.si("period")?, table.optional_si("phase")?.unwrap_or(0.0));
    Ok((MotionLaw::Curve(Arc::new(Curve::Harmonic { amplitude, period, phase })), None))
}

fn formula(table: &mut TomlTable, _: InputValue) -> Result<Begun> {
    let time = table.si("time")?;
    let (curve, begin) = curve::formula(table, CurveVariable::Time, time)?;
    Ok((MotionLaw::Curve(Arc::new(curve)), Some(begin)))
}

fn cycloidal(table: &mut TomlTable, start: InputValue) -> Result<Begun> {
    let rise = table.quantity("to", of_input(start.input), Sign::Any)? - start.value;
    let time = table.si("time")?;
    if rise == 0.0 {
        return table.refuse("to", sentences::THE_CRANK_IS_TO_STAY_WHERE, sentences::GIVE_A_CRANK_ANGLE_OTHER);
    }
    Ok((MotionLaw::Cycloidal { rise, time }, None))
}

/// A law of motion from a table. The motion starts from rest at t = 0 and ends at rest at the last point.
fn points(table: &mut TomlTable, start: InputValue) -> Result<Begun> {
    let [key, example] = match start.input {
        Input::Slide => ["slide", "write `points = [{ time_s = 0, slide_mm = 0 }, { time_s = 0.5, slide_mm = 90 }]`"],
        Input::Angle | Input::Turn => {
            ["angle", "write `points = [{ time_s = 0, angle_deg = 0 }, { time_s = 0.5, angle_deg = 90 }]`"]
        }
    };
    if !table.has("points") {
        return Err(table.lacks(&["points"], example));
    }
    let mut points: Vec<(f64, f64)> = Vec::new();
    for mut point in table.tables("points")? {
        let read = point.read(|point| {
            let time = point.si("time")?;
            let value = point.si(key)?;
            point.finish()?;
            Ok((time, value))
        });
        let (time, value) = read?;
        match points.last() {
            None if time != 0.0 => {
                return Err(point.fault(sentences::THE_TABLE_BEGINS_LATER).help(sentences::LET_LAW_AND_START_BE_EQUAL));
            }
            Some((last, _)) if !(time > *last) => {
                let message = sentences::the_times_do_not_ascend_comes(&time, &last);
                return Err(point.fault(message).help(sentences::WRITE_THE_POINTS_IN_ASCENDING_ORDER));
            }
            _ => points.push((time, value)),
        }
    }
    let begin = points.first().map_or(0.0, |(_, value)| *value);
    points.iter_mut().for_each(|(_, value)| *value -= begin);
    if points.len() < 2 || points.iter().all(|&(_, gone)| gone == 0.0) {
        return table.refuse("points", sentences::A_TABLE_OF_ANGLES_NEEDS_TWO, example);
    }
    let spline = Piecewise::clamped_spline(&points, [0.0; 2]);
    Ok((MotionLaw::Curve(Arc::new(Curve::Table(spline))), Some(begin)))
}

/// Acceleration of gravity (m/s^2).
pub fn gravity(table: &mut TomlTable) -> Result<Vec2> {
    let (x, y) = (table.si("x")?, table.si("y")?);
    table.finish()?;
    Ok(Vec2::new(x, y))
}
