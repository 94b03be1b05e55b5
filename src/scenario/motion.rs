//! `[drive]` and `[gravity]`.

use super::reader::{Sign, Table};
use super::unit::{ACCELERATION, ANGLE, ANGULAR_SPEED};
use super::words::suggestion;
use crate::drive::{Drive, MotionLaw};
use crate::error::{ErrorKind, Result};
use crate::math::Vec2;
use crate::mechanism::{GROUND, Mechanism};

/// The crank's drive, with `start` as the crank angle at t = 0 (rad), and further drives, which say their own.
pub fn drives(tables: Vec<Table>, mechanism: &Mechanism, start: f64) -> Result<(Drive, Vec<Drive>)> {
    let mut drives: Vec<Drive> = Vec::new();
    for mut table in tables {
        let start = match drives.is_empty() {
            true => start,
            false => table.quantity("start", &ANGLE, Sign::Any)?,
        };
        let drive = drive(&mut table, mechanism, start)?;
        if drives.iter().any(|other| other.joint == drive.joint) {
            let message = "this joint is driven already";
            return Err(table.wrong(ErrorKind::Input, "joint", message).help("give every drive a joint of its own"));
        }
        drives.push(drive);
    }
    let crank = drives.remove(0);
    Ok((crank, drives))
}

fn drive(table: &mut Table, mechanism: &Mechanism, start: f64) -> Result<Drive> {
    let name = table.string("joint")?;
    let speed = table.quantity("speed", &ANGULAR_SPEED, Sign::NotZero)?;
    let zero = table.optional_quantity("zero", &ANGLE, Sign::Any)?.unwrap_or(0.0);
    table.finish()?;
    let Some(index) = mechanism.joint_named(&name) else {
        let names = mechanism.joints().iter().map(|joint| joint.name.as_str());
        let error = table.wrong(ErrorKind::Input, "joint", format!("there is no joint \"{name}\""));
        return Err(error.help(suggestion(&name, names, "\"")));
    };
    let joint = &mechanism.joints()[index];
    if joint.on(GROUND).is_none() {
        let names = [joint.first, joint.second].map(|side| &mechanism.links()[side.link].name);
        let message =
            format!("joint \"{name}\" joins \"{}\" and \"{}\", not a link and the ground", names[0], names[1]);
        let hinges = mechanism.joints().iter().filter(|joint| joint.on(GROUND).is_some() && !joint.is_prismatic());
        let hinges: Vec<&str> = hinges.map(|joint| joint.name.as_str()).collect();
        return Err(table
            .wrong(ErrorKind::Unsupported, "joint", message)
            .help(format!("drive a link that is hinged to the ground: {}", super::words::choice(hinges, "\""))));
    }
    if joint.is_prismatic() {
        let message = format!("joint \"{name}\" is prismatic, but the crank turns");
        let help = "drive a link that is hinged to the ground by a revolute joint";
        return Err(table.wrong(ErrorKind::Unsupported, "joint", message).help(help));
    }
    Ok(Drive { joint: index, link: joint.other(GROUND).link, zero, start, law: MotionLaw::ConstantSpeed(speed) })
}

/// Acceleration of gravity (m/s^2); none without a table.
pub fn gravity(table: Option<Table>) -> Result<Vec2> {
    let Some(mut table) = table else { return Ok(Vec2::zeros()) };
    let (x, y) = (table.quantity("x", &ACCELERATION, Sign::Any)?, table.quantity("y", &ACCELERATION, Sign::Any)?);
    table.finish()?;
    Ok(Vec2::new(x, y))
}
