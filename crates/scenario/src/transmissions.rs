//! `[[transmissions]]`: gear pairs, racks, screws, belts and cams.

mod cam;

use super::joints::link;
use super::keys::key::{Section, ValueKind, needed, optional};
use super::links::sound_name;
use super::motor::efficiency;
use super::reader::{Faults, Sign, TomlTable};
use super::unit::{UnitFamily, of_input};
use super::words::{Words, names, suggestion};
use crate::sentences;
use linkage::error::{ErrorKind, Result};
use linkage::input::Input;
use linkage::mechanism::{Joint, JointId, Link, LinkId, Mechanism, TransmissionDesign, TransmissionKind};
use std::f64::consts::FRAC_PI_2;

/// Reads the keys of a type of transmission. The [`Link`] is the second of the two links that the transmission couples.
/// The reader of cams also returns the units of the lifts, if the lifts have units.
type ReadTransmission = fn(&mut TomlTable, &Link) -> Result<(TransmissionKind, Option<&'static UnitFamily>)>;

/// Types of transmissions, each with its reader.
const TYPES: Words<ReadTransmission> =
    &[("gears", gears), ("rack", rack), ("screw", screw), ("belt", belt), ("cam", cam::read)];

/// Words for the contact of gears, each with a sign. In equations, the larger number of teeth has this sign.
const CONTACTS: Words<f64> = &[("external", 1.0), ("internal", -1.0)];

/// Words for the strands of a belt, and whether they cross.
const STRANDS: Words<bool> = &[("open", false), ("crossed", true)];

/// The usual pressure angle of involute gears (rad): ISO 53.
const PRESSURE_ANGLE: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("transmissions").with(&[
    needed("name", ValueKind::Text).means("unique name"),
    needed("type", ValueKind::Choice(|| names(TYPES))).means("kind of transmission"),
    needed("links", ValueKind::Texts)
        .means("the two wheels, pinion and rack, screw and nut, or cam and follower; `\"ground\"` may be a wheel, such as a fixed ring gear"),
    optional("carrier", ValueKind::Text, "`\"ground\"`").means(
        "the link that carries both axles, or the axle and the guide. A wheel turns on a pin of the carrier. \
         The pin may belong to a third link that a joint at the same point connects to the carrier",
    ),
    optional("teeth", ValueKind::Numbers, "required for gears").means(
        "gears: numbers of teeth; only their ratio matters. The pitch radii follow from the distance of the axles",
    ),
    optional("contact", ValueKind::Choice(|| names(CONTACTS)), "`\"external\"`")
        .means("gears: external, or internal if the wheel with more teeth is a ring gear"),
    optional("pressure_angle", ValueKind::ANGLES.of(Sign::NotNegative), "20 deg")
        .means("gears, rack: angle between the line of action and the tangent of the pitch circles"),
    optional("lead", ValueKind::LENGTHS.of(Sign::NotZero), "required for a screw")
        .means("screw: slide of the nut along the axis of its joint for a turn of the screw counter-clockwise; negative for a left-handed screw"),
    optional("radii", ValueKind::LIST_OF_LENGTHS, "required for a belt").means("belt: pitch radii of the two wheels"),
    optional("strands", ValueKind::Choice(|| names(STRANDS)), "`\"open\"`")
        .means("belt: open, or crossed, so that the wheels turn in opposite senses"),
    optional("slack", ValueKind::FORCES.of(Sign::NotNegative), "0: a chain").means("belt: tension of the slack strand"),
    optional("efficiency", ValueKind::Number, "1").means(
        "not for a cam: fraction of the power that arrives if the first member drives the second, above 0 and at most 1. \
         The loss is a moment between carrier and first member",
    ),
    optional("efficiency_back", ValueKind::Number, "`efficiency`").means(
        "not for a cam: efficiency while the second member drives the first, at most 1; 0 or less for a self-locking \
         transmission: the second member alone cannot move the first",
    ),
    optional("follower", ValueKind::Choice(|| names(cam::FOLLOWERS)), "required for a cam")
        .means("cam: the part of the follower that touches the cam; a flat face stands across the guide of the follower"),
    optional("point", ValueKind::Text, "required for a cam")
        .means("cam: point of the follower: the roller's centre, the knife's edge, or a point of the flat face"),
    optional("roller", ValueKind::LENGTHS.of(Sign::NotNegative), "required for a roller").means("cam: radius of the roller"),
    optional("motion", ValueKind::Tables, "required for a cam without `lifts` or `formula`")
        .means("cam: lift as a function of the cam's angle relative to the carrier, in pieces; it begins with lift 0 at angle 0"),
    optional("lifts", ValueKind::Tables, "none")
        .means("cam, instead of `motion`: a table of lifts in one turn, joined by a periodic cubic spline"),
    optional("formula", ValueKind::Text, "none").means(
        "cam, instead of `motion`: the lift in m, or in rad if the follower swings, as a formula of the cam's angle \
         `phi` in rad, from 0 to 2 pi, periodic with two continuous derivatives",
    ),
    optional("start_joint", ValueKind::Text, "the joint of the second link with the carrier")
        .means("the joint whose coordinate at t = 0 is `start`; a different joint for each transmission, not a driven one"),
    needed("start", ValueKind::INPUTS)
        .means("coordinate of that joint at t = 0: angle of its second link minus that of its first link, or slide"),
    ]), cam::SECTION, cam::LIFTS,
];

/// The mechanism with the transmissions of the file.
pub fn read(tables: Vec<TomlTable>, mechanism: Mechanism, faults: &mut Faults) -> Mechanism {
    let mut designs: Vec<TransmissionDesign> = Vec::new();
    let count = tables.len();
    for mut table in tables {
        designs.extend(faults.read(&mut table, |table| transmission(table, &mechanism, &designs)));
    }
    faults.whole &= designs.len() == count;
    if !faults.whole || designs.is_empty() {
        return mechanism;
    }
    match faults.kept(mechanism.clone().with_transmissions(designs)) {
        Some(geared) => geared,
        None => {
            faults.whole = false;
            mechanism
        }
    }
}

fn transmission(
    table: &mut TomlTable,
    mechanism: &Mechanism,
    before: &[TransmissionDesign],
) -> Result<TransmissionDesign> {
    let name = sound_name(table, "a transmission")?;
    let kind = table.choice("type", sentences::IS_NO_TYPE_OF_TRANSMISSION, TYPES)?;
    let (links, pair) = (mechanism.links(), table.strings("links")?);
    let [first, second] = &pair[..] else {
        let message = sentences::found_links_but_a_transmission_has_two(&pair.len());
        return table.refuse("links", message, sentences::NAME_TWO_WHEELS);
    };
    let members = [link(table, first, links)?, link(table, second, links)?];
    let (kind, lift) = kind(table, &links[members[1]])?;
    let forward = efficiency(table)?;
    let back = table.optional_number("efficiency_back")?.unwrap_or(forward);
    let carrier = table.optional_string("carrier")?.unwrap_or_else(|| "ground".into());
    let stated = table.optional_string("start_joint")?;
    let Some((family, start)) = table.optional_si_of("start")? else {
        let spellings = ["start_rad", "start_deg", "start_m", "start_mm"];
        return Err(table.lacks(&spellings, sentences::GIVE_AN_ANGLE_OR_A_SLIDE));
    };
    table.finish()?;
    let Some(carrier) = mechanism.link_named(&carrier) else {
        let known = suggestion(&carrier, links.iter().map(|link| link.name.as_str()), "\"");
        return table.refuse("carrier", sentences::there_is_no_link(&carrier), known);
    };
    let joint = start_joint(table, mechanism, stated, [members[1], carrier])?;
    let own = &mechanism.joints()[joint];
    if let Some(other) = before.iter().find(|other| other.joint == joint) {
        let message = sentences::the_start_joint_is_taken(&own.name, &other.name);
        return table.refuse("start_joint", message, sentences::NAME_ANOTHER_START_JOINT);
    }
    if !has_units_of(family, own) {
        let message = sentences::the_start_has_units_of(&family.noun, &own.name, &own.kind.name());
        return Err(table.wrong(ErrorKind::Input, "start", message).help(sentences::GIVE_AN_ANGLE_OR_A_SLIDE));
    }
    if let (Some(family), Some(joint)) = (lift, mechanism.joint_between(members[1], carrier))
        && let own = &mechanism.joints()[joint]
        && !has_units_of(family, own)
    {
        let message = sentences::the_lift_has_units_of(&family.noun, &own.name, &own.kind.name());
        return Err(table.wrong(ErrorKind::Input, "motion", message).help(sentences::GIVE_LIFTS_LIKE_THE_JOINT));
    }
    let efficiency = [forward, back];
    Ok(TransmissionDesign { name, kind, links: members, carrier, joint, start, efficiency })
}

/// Whether a quantity has the units of a joint's coordinate.
fn has_units_of(family: &UnitFamily, joint: &Joint) -> bool {
    std::ptr::eq(family, of_input(if joint.slides() { Input::Slide } else { Input::Turn }))
}

/// The joint whose coordinate at t = 0 is given.
fn start_joint(
    table: &TomlTable,
    mechanism: &Mechanism,
    stated: Option<String>,
    [second, carrier]: [LinkId; 2],
) -> Result<JointId> {
    let joints = mechanism.joints();
    let Some(name) = stated else {
        return mechanism.joint_between(second, carrier).map_or_else(
            || {
                let [second, carrier] = [second, carrier].map(|link| mechanism.links()[link].name.as_str());
                let message = sentences::no_joint_connects_with_the_carrier(&second, &carrier);
                table.refuse("start_joint", message, sentences::NAME_THE_START_JOINT)
            },
            Ok,
        );
    };
    mechanism.joint_named(&name).map_or_else(
        || {
            let known = suggestion(&name, joints.iter().map(|joint| joint.name.as_str()), "\"");
            table.refuse("start_joint", sentences::there_is_no_joint(&name), known)
        },
        Ok,
    )
}

fn gears(table: &mut TomlTable, _: &Link) -> Result<(TransmissionKind, Option<&'static UnitFamily>)> {
    let numbers = table.numbers("teeth")?;
    let sign = table.optional_choice("contact", sentences::IS_NO_CONTACT_OF_GEARS, CONTACTS)?.unwrap_or(1.0);
    let pressure_angle = pressure_angle(table)?;
    let [first, second] = two(table, "teeth", &numbers)?;
    let teeth = match sign < 0.0 {
        true if first == second => {
            let message = sentences::EQUAL_GEARS_CANNOT_BE_INTERNAL;
            return table.refuse("teeth", message, sentences::GIVE_THE_RING_MORE_TEETH);
        }
        true if first > second => [sign * first, second],
        true => [first, sign * second],
        false => [first, second],
    };
    Ok((TransmissionKind::Gears { teeth, pressure_angle }, None))
}

fn rack(table: &mut TomlTable, _: &Link) -> Result<(TransmissionKind, Option<&'static UnitFamily>)> {
    Ok((TransmissionKind::Rack { pressure_angle: pressure_angle(table)? }, None))
}

fn screw(table: &mut TomlTable, _: &Link) -> Result<(TransmissionKind, Option<&'static UnitFamily>)> {
    Ok((TransmissionKind::Screw { lead: table.si("lead")? }, None))
}

fn belt(table: &mut TomlTable, _: &Link) -> Result<(TransmissionKind, Option<&'static UnitFamily>)> {
    let Some((_, radii)) = table.optional_si_list("radii")? else {
        return Err(table.lacks(&["radii_m", "radii_mm"], sentences::GIVE_THE_PITCH_RADII));
    };
    let crossed = table.optional_choice("strands", sentences::IS_NO_COURSE_OF_STRANDS, STRANDS)?.unwrap_or(false);
    let slack = table.optional_si("slack")?.unwrap_or(0.0);
    Ok((TransmissionKind::Belt { radii: two(table, "radii", &radii)?, crossed, slack }, None))
}

fn pressure_angle(table: &mut TomlTable) -> Result<f64> {
    let angle = table.optional_si("pressure_angle")?.unwrap_or(PRESSURE_ANGLE);
    if angle >= FRAC_PI_2 {
        let message = sentences::the_pressure_angle_is(&angle.to_degrees());
        return table.refuse("pressure_angle", message, sentences::GIVE_A_PRESSURE_ANGLE_BELOW_90);
    }
    Ok(angle)
}

/// Two positive numbers.
fn two(table: &TomlTable, key: &str, numbers: &[f64]) -> Result<[f64; 2]> {
    match *numbers {
        [first, second] if first > 0.0 && second > 0.0 => Ok([first, second]),
        _ => Err(table.wrong(ErrorKind::Input, key, sentences::found_numbers_for_two_wheels(&key))),
    }
}
