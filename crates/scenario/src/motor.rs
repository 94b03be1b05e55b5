//! `[motor]`: the motor's law and the reducer behind it.

use super::keys::key::{Section, ValueKind, needed, optional};
use super::reader::{Sign, TomlTable};
use super::words::{Words, names};
use crate::sentences;
use linkage::drive::{Motor, MotorLaw, ShaftInertia};
use linkage::error::{ErrorKind, Result};

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("motor").with(&[
        needed("law", ValueKind::Choice(|| names(LAWS))).means("torque as a function of the motor speed"),
        needed("ratio", ValueKind::Number).means("ratio of motor speed to crank speed; 1 without a reducer"),
        optional("efficiency", ValueKind::Number, "1").means(
            "fraction of the power that the reducer transmits, above 0 and at most 1, the same in both \
             directions",
        ),
        optional("torque", ValueKind::MOMENTS.of(Sign::Positive), "required for this law")
            .means("constant law: the torque, positive"),
        optional("torque_at_rest", ValueKind::MOMENTS.of(Sign::Positive), "required for this law")
            .means("linear law: torque at rest, positive"),
        optional("slope", ValueKind::SLOPES.of(Sign::Negative), "required for this law")
            .means("linear law: change with the speed, negative"),
        optional("breakdown_torque", ValueKind::MOMENTS.of(Sign::Positive), "required for this law")
            .means("Kloss: largest torque"),
        optional("synchronous_speed", ValueKind::SPEEDS.of(Sign::Positive), "required for this law")
            .means("Kloss: synchronous speed"),
        optional("breakdown_slip", ValueKind::Number, "given by the speed")
            .means("Kloss: slip at breakdown; give this or `breakdown_speed`"),
        optional("breakdown_speed", ValueKind::SPEEDS.of(Sign::NotNegative), "given by the slip")
            .means("Kloss: speed at breakdown"),
        optional("points", ValueKind::Tables, "required for this law")
            .means("table: two or more points, speeds ascending"),
        optional("rotor_inertia", ValueKind::INERTIAS.of(Sign::NotNegative), "0")
            .means("moment of inertia of the rotor about its shaft"),
        optional("input_inertia", ValueKind::INERTIAS.of(Sign::NotNegative), "0")
            .means("moment of inertia of the reducer's input shaft, which rotates with the motor"),
        optional("intermediate_inertia", ValueKind::INERTIAS.of(Sign::NotNegative), "0")
            .means("moment of inertia of the reducer's intermediate shaft"),
        optional("intermediate_ratio", ValueKind::Number, "required with `intermediate_inertia`")
            .means("ratio of intermediate-shaft speed to crank speed"),
        optional("output_inertia", ValueKind::INERTIAS.of(Sign::NotNegative), "0")
            .means("moment of inertia of the reducer's output shaft, which rotates with the crank"),
        optional("rated_torque", ValueKind::MOMENTS.of(Sign::Positive), "unknown").means(
            "rated torque; if it is given for a linear law, the command `drive` warns of torques above the largest \
             usual breakdown torque",
        ),
    ]),
    Section::at("motor.points").with(&[
        needed("speed", ValueKind::SPEEDS).means("speed of the motor"),
        needed("torque", ValueKind::MOMENTS).means("torque at that speed"),
    ]),
];

/// Laws, each with its reader.
const LAWS: Words<fn(&mut TomlTable) -> Result<MotorLaw>> =
    &[("constant", constant), ("linear", linear), ("kloss", kloss), ("table", points)];

/// The motor.
pub fn read(table: &mut TomlTable) -> Result<Motor> {
    let law = table.choice("law", sentences::IS_NO_LAW_OF_A_MOTOR, LAWS)?(table)?;
    let ratio = table.number("ratio")?;
    if ratio <= 0.0 {
        let error = table.wrong(ErrorKind::Input, "ratio", sentences::found_but_a_ratio_of_speeds(&ratio));
        table.instead((), error.help(sentences::GIVE_THE_SPEED_OF_THE_MOTOR))?;
    }
    let efficiency = efficiency(table)?;
    let inertia = inertia(table)?;
    let rated_torque = table.optional_si("rated_torque")?;
    table.finish()?;
    Ok(Motor { law, ratio, efficiency, inertia, rated_torque })
}

/// The key `efficiency`, or 1.
pub(crate) fn efficiency(table: &mut TomlTable) -> Result<f64> {
    let efficiency = table.optional_number("efficiency")?.unwrap_or(1.0);
    if !(efficiency > 0.0 && efficiency <= 1.0) {
        let message = sentences::found_but_an_efficiency_lies(&efficiency);
        let error = table.wrong(ErrorKind::Input, "efficiency", message).help(sentences::GIVE_A_SHARE_FOR);
        table.instead((), error)?;
    }
    Ok(efficiency)
}

fn constant(table: &mut TomlTable) -> Result<MotorLaw> {
    Ok(MotorLaw::Constant { torque: table.si("torque")? })
}

fn linear(table: &mut TomlTable) -> Result<MotorLaw> {
    let at_rest = table.si("torque_at_rest")?;
    Ok(MotorLaw::Linear { at_rest, slope: table.si("slope")? })
}

/// The breakdown point is given by its slip or by its speed, because catalogues give either of the two.
fn kloss(table: &mut TomlTable) -> Result<MotorLaw> {
    let breakdown_torque = table.si("breakdown_torque")?;
    let synchronous_speed = table.si("synchronous_speed")?;
    let slip = table.optional_number("breakdown_slip")?;
    let speed = table.optional_si("breakdown_speed")?;
    let help = sentences::GIVE_ONE_OF_THE_TWO_BREAKDOWN;
    let breakdown_slip = match (slip, speed) {
        (Some(_), Some(_)) => {
            return table.refuse("breakdown_slip", sentences::THE_SLIP_AND_THE_SPEED_OF_BREAKDOWN, help);
        }
        (None, None) => {
            let keys = ["breakdown_slip", "breakdown_speed_rpm", "breakdown_speed_rad_s"];
            return Err(table.lacks(&keys, help));
        }
        (Some(slip), None) if slip > 0.0 => slip,
        (Some(slip), None) => {
            let message = sentences::found_but_the_slip_of_breakdown(&slip);
            return table.refuse("breakdown_slip", message, sentences::GIVE_SYNCHRONOUS_SPEED_SPEED_OF_BREAKDOWN);
        }
        (None, Some(speed)) if speed < synchronous_speed => 1.0 - speed / synchronous_speed,
        (None, Some(speed)) => {
            let message = sentences::the_motor_breaks_down_at_rad(&speed, &synchronous_speed);
            return Err(table.fault(message).help(sentences::CHECK_BREAKDOWN_SPEED_AND_SYNCHRONOUS));
        }
    };
    Ok(MotorLaw::Kloss { breakdown_torque, breakdown_slip, synchronous_speed })
}

fn points(table: &mut TomlTable) -> Result<MotorLaw> {
    let (mut speeds, mut torques) = (Vec::new(), Vec::new());
    for mut point in table.tables("points")? {
        let (speed, torque) = point.read(|point| {
            let speed = point.si("speed")?;
            let torque = point.si("torque")?;
            point.finish()?;
            Ok((speed, torque))
        })?;
        torques.push(torque);
        if let Some(last) = speeds.last()
            && !(speed > *last)
        {
            let message = sentences::the_speeds_do_not_ascend(&speed, &last);
            return Err(point.fault(message).help(sentences::WRITE_THE_POINTS_IN_ASCENDING_ORDER_OF_SPEED));
        }
        speeds.push(speed);
    }
    if speeds.len() < 2 {
        let help = "write `points = [{ speed_rpm = 0, torque_N_m = 4 }, { speed_rpm = 3000, torque_N_m = 0 }]`";
        let message = sentences::a_table_of_torques_needs(&speeds.len());
        return table.refuse("points", message, help);
    }
    Ok(MotorLaw::Table { speeds, torques })
}

/// Moments of inertia of the parts that turn with the motor and the reducer. A moment of inertia whose key is missing
/// is zero.
fn inertia(table: &mut TomlTable) -> Result<ShaftInertia> {
    let mut shaft = |name: &str| -> Result<f64> { Ok(table.optional_si(name)?.unwrap_or(0.0)) };
    let (rotor, input) = (shaft("rotor_inertia")?, shaft("input_inertia")?);
    let (intermediate, output) = (shaft("intermediate_inertia")?, shaft("output_inertia")?);
    let ratio = table.optional_number("intermediate_ratio")?;
    match ratio {
        Some(ratio) if ratio <= 0.0 => {
            let help = sentences::GIVE_THE_SPEED_OF_THE_INTERMEDIATE;
            return table.refuse("intermediate_ratio", sentences::found_but_a_ratio_of_speeds(&ratio), help);
        }
        None if intermediate > 0.0 => {
            let help = sentences::ADD_INTERMEDIATE_RATIO_ITS_SPEED;
            return table.refuse("intermediate_inertia_kg_m2", sentences::THE_INTERMEDIATE_SHAFT_HAS_A_MOMENT, help);
        }
        _ => {}
    }
    Ok(ShaftInertia { rotor, input, intermediate, intermediate_ratio: ratio.unwrap_or(1.0), output })
}
