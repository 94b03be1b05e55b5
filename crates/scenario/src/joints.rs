//! `[[joints]]`: which links are joined, how, and where.

use crate::sentences;
use std::f64::consts::FRAC_PI_2;

use super::keys::key::{Section, ValueKind, needed, optional};
use super::links::{is_somewhere, sound_name};
use super::reader::{Faults, TomlTable};
use super::words::{Words, names, suggestion};
use linkage::error::{ErrorKind, Result};
use linkage::math::{Vec2, unit};
use linkage::mechanism::{Guise, Joint, JointKind, JointSide, Link, LinkId};

/// Reads the keys of a type of joint. Returns the kind of the joint and how it is drawn.
type ReadJoint = fn(&mut TomlTable) -> Result<(JointKind, Option<Guise>)>;

/// Types of joints, each with its reader.
const TYPES: Words<ReadJoint> = &[("revolute", revolute), ("prismatic", prismatic)];

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[Section::at("joints").with(&[
    needed("name", ValueKind::Text).means("unique name"),
    needed("type", ValueKind::Choice(|| names(TYPES))).means("kind of joint"),
    needed("links", ValueKind::Texts).means(
        "first and second link; `\"ground\"` is the frame. The reaction of the joint is that of the first \
         link on the second",
    ),
    optional("point", ValueKind::Text, "the joint's name")
        .means("revolute: the joint is at the point of this name, on both links"),
    optional("points", ValueKind::Texts, "required for a prismatic joint").means(
        "prismatic: `[\"G\", \"B\"]`, a point of the first link and one of the second; the line through \
         the first point along the axis passes through the second point",
    ),
    optional("axis", ValueKind::ANGLES, "required for a prismatic joint")
        .means("prismatic: direction of sliding in the frame of the first link"),
    optional("second_axis", ValueKind::ANGLES, "0: along its x axis").means(
        "prismatic: the same direction in the frame of the second link; it fixes the angle of the second \
         link to the first",
    ),
    optional(
        "drawn",
        ValueKind::Choice(|| Guise::ALL.map(Guise::name).to_vec()),
        "guessed from names and positions: docs/draw.md",
    )
    .means(
        "prismatic: how pictures show it, as a piston in a cylinder, or as a block on rails or in a slot; \
         it does not affect any result",
    ),
])];

/// The joints, in the order of the file. Joints with mistakes are left out. Joints at points whose position could not
/// be read are left out too.
pub fn read(tables: Vec<TomlTable>, links: &[Link], faults: &mut Faults) -> Vec<Joint> {
    let mut joints: Vec<Joint> = Vec::new();
    let count = tables.len();
    for mut table in tables {
        let read = faults.read(&mut table, |table| joint(table, links, &joints));
        joints.extend(read.filter(|joint| [joint.first, joint.second].iter().all(|side| is_somewhere(side.local))));
    }
    // Drives and the mechanism may need a joint that is left out. If a joint is left out, errors that may follow from
    // this are therefore not reported (see `Faults::whole`).
    faults.whole &= joints.len() == count;
    joints
}

fn joint(table: &mut TomlTable, links: &[Link], before: &[Joint]) -> Result<Joint> {
    let name = sound_name(table, "a joint")?;
    if before.iter().any(|joint| joint.name == name) {
        return table.refuse("name", sentences::two_joints_are_called(&name), sentences::GIVE_EVERY_JOINT_ITS_OWN);
    }
    let (kind, drawn) = kind(table)?;
    let pair = table.strings("links")?;
    let places = places(table, kind, &name)?;
    table.finish()?;
    let [first, second] = &pair[..] else {
        let message = sentences::found_links_but_a_joint_has_two(&pair.len());
        return table.refuse("links", message, "write `links = [\"ground\", \"crank\"]`");
    };
    let (first, second) = (link(table, first, links)?, link(table, second, links)?);
    if first == second {
        let message = sentences::it_joins_with_itself(&links[first].name);
        return table.refuse("links", message, sentences::NAME_TWO_DIFFERENT_LINKS);
    }
    if let Some(other) = before.iter().find(|joint| joint.on(first).is_some() && joint.on(second).is_some()) {
        let message = sentences::joint_joins_and_already_two(&other.name, &links[first].name, &links[second].name);
        return table.refuse("links", message, sentences::MAKE_THE_TWO_ONE_LINK_WITH_ALL);
    }
    let side = |link: LinkId, point: &str| -> Result<JointSide> {
        let points = &links[link].points;
        let found = points.iter().find(|found| found.name == point);
        let local = found.map(|found| found.local).ok_or_else(|| {
            let message = sentences::link_has_no_point(&links[link].name, &point);
            let near = suggestion(point, points.iter().map(|point| point.name.as_str()), "\"");
            table.wrong(ErrorKind::Input, places.key, message).help(format!("{}; {near}", places.rule))
        })?;
        Ok(JointSide { link, local })
    };
    let [first, second] = [side(first, &places.names[0])?, side(second, &places.names[1])?];
    Ok(Joint { name, kind, first, second, drawn })
}

/// Names of the points at which a joint lies, on its first and its second link.
struct Places {
    names: [String; 2],
    /// Key in the file that states the names of the points.
    key: &'static str,
    rule: &'static str,
}

fn places(table: &mut TomlTable, kind: JointKind, name: &str) -> Result<Places> {
    match kind {
        JointKind::Revolute => pinned(table, name),
        JointKind::Prismatic { .. } => guided(table),
    }
}

fn pinned(table: &mut TomlTable, name: &str) -> Result<Places> {
    let rule = sentences::A_JOINT_LIES_AT_THE_POINT;
    Ok(match table.optional_string("point")? {
        Some(point) => Places { names: [point.clone(), point], key: "point", rule },
        None => Places { names: [name.to_string(), name.to_string()], key: "name", rule },
    })
}

fn guided(table: &mut TomlTable) -> Result<Places> {
    let names = table.strings("points")?;
    let [first, second] = &names[..] else {
        let message = sentences::found_points_but_a_guide(&names.len());
        return table.refuse("points", message, sentences::WRITE_POINTS_A_POINT_OF_THE_FIRST);
    };
    let rule = sentences::POINTS_NAMES_A_POINT_OF_THE_FIRST;
    Ok(Places { names: [first.clone(), second.clone()], key: "points", rule })
}

/// The kind of a joint, and how it is drawn if the file says so.
fn kind(table: &mut TomlTable) -> Result<(JointKind, Option<Guise>)> {
    table.choice("type", sentences::IS_NO_TYPE_OF_JOINT, TYPES)?(table)
}

fn revolute(_: &mut TomlTable) -> Result<(JointKind, Option<Guise>)> {
    Ok((JointKind::Revolute, None))
}

fn prismatic(table: &mut TomlTable) -> Result<(JointKind, Option<Guise>)> {
    let first = table.si("axis")?;
    let second = table.optional_si("second_axis")?.unwrap_or(0.0);
    let guises = Guise::ALL.map(|guise| (guise.name(), guise));
    let drawn = table.optional_choice("drawn", sentences::IS_NOT_HOW_A_PRISMATIC_PAIR, &guises)?;
    Ok((JointKind::Prismatic { axes: [first, second].map(direction) }, drawn))
}

/// Unit vector at `angle` (rad).
/// Multiples of a right angle give exact components, so that a vertical guide is exactly vertical.
fn direction(angle: f64) -> Vec2 {
    let quarters = angle / FRAC_PI_2;
    if (quarters - quarters.round()).abs() > 4.0 * f64::EPSILON * quarters.abs() {
        return unit(angle);
    }
    match quarters.round().rem_euclid(4.0) as u8 {
        0 => Vec2::new(1.0, 0.0),
        1 => Vec2::new(0.0, 1.0),
        2 => Vec2::new(-1.0, 0.0),
        _ => Vec2::new(0.0, -1.0),
    }
}

/// Index of the link called `name`. An unknown name is an error of the key `links` or `link` of `table`.
pub fn link(table: &mut TomlTable, name: &str, links: &[Link]) -> Result<LinkId> {
    if let Some(found) = links.iter().position(|link| link.name == name) {
        return Ok(LinkId(found));
    }
    let key = if table.has("links") { "links" } else { "link" };
    let names = links.iter().map(|link| link.name.as_str());
    let error = table.wrong(ErrorKind::Input, key, sentences::there_is_no_link(&name));
    table.unknown_name(LinkId(links.len() - 1), error.help(suggestion(name, names, "\"")))
}
