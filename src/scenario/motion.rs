//! `[drive]`, `[gravity]` and `[[loads]]`.

use super::joints::link;
use super::reader::{Sign, Table};
use super::unit::{ACCELERATION, ANGLE, ANGULAR_SPEED, MOMENT};
use super::words::suggestion;
use crate::drive::{Drive, Load, MotionLaw};
use crate::error::{ErrorKind, Result};
use crate::math::Vec2;
use crate::mechanism::{GROUND, Mechanism, Side};

/// The crank's drive, with `start` as the crank angle at t = 0 (rad), and further drives, which say their own.
pub fn drives(tables: Vec<Table>, mechanism: &Mechanism, start: f64) -> Result<(Drive, Vec<Drive>)> {
    let mut drives: Vec<Drive> = Vec::new();
    for mut table in tables {
        let start = match drives.is_empty() {
            true => start,
            false => table.quantity("start", &ANGLE, Sign::Any)?,
        };
        let drive = drive(&mut table, mechanism, &drives, start)?;
        drives.push(drive);
    }
    let crank = drives.remove(0);
    Ok((crank, drives))
}

/// A drive, after the drives `before` it.
fn drive(table: &mut Table, mechanism: &Mechanism, before: &[Drive], start: f64) -> Result<Drive> {
    let name = table.string("joint")?;
    let speed = table.quantity("speed", &ANGULAR_SPEED, Sign::NotZero)?;
    let zero = table.optional_quantity("zero", &ANGLE, Sign::Any)?.unwrap_or(0.0);
    let free = free(table)?;
    table.finish()?;
    let Some(index) = mechanism.joint_named(&name) else {
        let names = mechanism.joints().iter().map(|joint| joint.name.as_str());
        let error = table.wrong(ErrorKind::Input, "joint", format!("there is no joint \"{name}\""));
        return Err(error.help(suggestion(&name, names, "\"")));
    };
    if before.iter().any(|other| other.joint == index) {
        let message = "this joint is driven already";
        return Err(table.wrong(ErrorKind::Input, "joint", message).help("give every drive a joint of its own"));
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
        let hinges = mechanism.joints().iter().filter(|joint| joint.on(GROUND).is_some() && !joint.is_prismatic());
        let hinges: Vec<&str> = hinges.map(|joint| joint.name.as_str()).collect();
        return Err(table
            .wrong(ErrorKind::Unsupported, "joint", message)
            .help(format!("drive a link that is hinged to the ground: {}", super::words::choice(hinges, "\""))));
    };
    if joint.on(GROUND).is_none() && free.is_none() {
        let message = format!("joint \"{name}\" hangs on a moving link, but the motion of its link is prescribed");
        let help = "only a free link may hang on a moving one: write `motion = \"free\"`, or drive a link that is hinged to the ground";
        return Err(table.wrong(ErrorKind::Unsupported, "joint", message).help(help));
    }
    if joint.is_prismatic() {
        let message = format!("joint \"{name}\" is prismatic, but the crank turns");
        let help = "drive a link that is hinged to the ground by a revolute joint";
        return Err(table.wrong(ErrorKind::Unsupported, "joint", message).help(help));
    }
    Ok(Drive { joint: index, link, zero, start, law: MotionLaw::ConstantSpeed(speed), free })
}

/// The speed at t = 0 of a link that is free from then on.
fn free(table: &mut Table) -> Result<Option<f64>> {
    let initial = table.optional_quantity("initial_speed", &ANGULAR_SPEED, Sign::Any)?;
    match table.optional_string("motion")?.as_deref() {
        Some("free") => Ok(Some(initial.unwrap_or(0.0))),
        None | Some("prescribed") if initial.is_some() => {
            let message = "the link is given a speed at t = 0, but its motion is prescribed";
            let help = "write `motion = \"free\"` to leave it to its motor and the loads, or take the key out";
            Err(table.wrong(ErrorKind::Input, "initial_speed", message).help(help))
        }
        None | Some("prescribed") => Ok(None),
        Some(other) => Err(table
            .wrong(ErrorKind::Input, "motion", format!("\"{other}\" is no sort of motion"))
            .help(suggestion(other, ["prescribed", "free"], "\""))),
    }
}

/// Acceleration of gravity (m/s^2); none without a table.
pub fn gravity(table: Option<Table>) -> Result<Vec2> {
    let Some(mut table) = table else { return Ok(Vec2::zeros()) };
    let (x, y) = (table.quantity("x", &ACCELERATION, Sign::Any)?, table.quantity("y", &ACCELERATION, Sign::Any)?);
    table.finish()?;
    Ok(Vec2::new(x, y))
}

/// All loads.
pub fn loads(tables: Vec<Table>, mechanism: &Mechanism) -> Result<Vec<Load>> {
    tables.into_iter().map(|table| load(table, mechanism)).collect()
}

fn load(mut table: Table, mechanism: &Mechanism) -> Result<Load> {
    let kind = table.string("type")?;
    if kind != "resistance" {
        return Err(table.wrong(ErrorKind::Input, "type", format!("\"{kind}\" is no type of load")).help(suggestion(
            &kind,
            ["resistance"],
            "\"",
        )));
    }
    let name = table.string("link")?;
    let moment = table.quantity("moment", &MOMENT, Sign::NotNegative)?;
    table.finish()?;
    let link = link(&table, &name, mechanism.links())?;
    if link == GROUND {
        return Err(table.wrong(ErrorKind::Input, "link", "the ground does not turn").help("name a moving link"));
    }
    // Its angular velocity would be the rounding of zero, and so would the sense of the moment.
    if !mechanism.can_turn(link) {
        let message = format!("link \"{name}\" does not turn: prismatic joints alone connect it with the ground");
        return Err(table.wrong(ErrorKind::Input, "link", message).help("name a link that turns"));
    }
    Ok(Load::Resistance { link, moment })
}
