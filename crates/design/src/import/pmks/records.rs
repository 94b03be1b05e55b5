//! The records of a share link: settings, joints, links and forces.
//!
//! Sections and records end with a dot, and fields with a comma.
//! The first four sections are flags, decimal numbers, whole numbers and units.
//! Then follow the lists of joints, links and forces; an empty record ends each list.
//! The next section names the selected part. The import leaves out any sections after it.

use super::token::{Fields, checked, flags};
use crate::import::parts::Parts;
use crate::sentences;
use linkage::error::Result;
use linkage::math::Vec2;

/// Unit of lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LinkLength {
    Inch,
    Centimetre,
    Metre,
}

/// Settings of the document.
#[derive(Debug)]
pub(super) struct PmksSettings {
    pub(super) is_clockwise: bool,
    /// Whether gravity and forces are analysed.
    pub(super) has_forces: bool,
    /// Speed of the input (turns per minute).
    pub(super) speed: f64,
    pub(super) length: LinkLength,
    /// Whether forces are in lbf; otherwise they are in N.
    pub(super) is_pound: bool,
}

/// A joint.
#[derive(Debug)]
pub(super) struct PmksJoint {
    pub(super) id: String,
    pub(super) name: String,
    pub(super) place: Vec2,
    pub(super) is_slide: bool,
    pub(super) is_input: bool,
    pub(super) is_ground: bool,
    pub(super) is_welded: bool,
    /// Direction of a slide (rad).
    pub(super) angle: f64,
    /// For a slide in a slot: the link with the slot, and the two joints that give the slot's direction.
    pub(super) slot: Option<[String; 3]>,
    /// Whether the record contains a speed of this joint. Only development versions of PMKS+ write such speeds.
    pub(super) has_speed: bool,
}

/// A link.
#[derive(Debug)]
pub(super) struct PmksLink {
    pub(super) is_root: bool,
    pub(super) is_block: bool,
    pub(super) id: String,
    pub(super) name: String,
    pub(super) mass: f64,
    pub(super) inertia: f64,
    pub(super) centre: Vec2,
    pub(super) joints: Vec<String>,
    /// Links that are welded into this link.
    pub(super) parts: Vec<String>,
}

/// A force on a link.
#[derive(Debug)]
pub(super) struct PmksForce {
    pub(super) name: String,
    pub(super) link: String,
    pub(super) from: Vec2,
    pub(super) to: Vec2,
    pub(super) turns_with_link: bool,
    pub(super) is_outward: bool,
    pub(super) size: f64,
}

/// All records of a share link.
#[derive(Debug)]
pub(super) struct PmksRecords {
    pub(super) settings: PmksSettings,
    pub(super) joints: Vec<PmksJoint>,
    pub(super) links: Vec<PmksLink>,
    pub(super) forces: Vec<PmksForce>,
    /// Sections of the query that follow the section about the selected part.
    pub(super) further: Vec<String>,
}

/// Reads the records of a query.
pub(super) fn records(query: &str) -> Result<PmksRecords> {
    let mut sections = checked(query)?.split('.');
    let mut next = || sections.next().unwrap_or_default();
    let settings = settings([next(), next(), next(), next()])?;
    let mut list = |kind: &str| {
        let own: Vec<&str> = sections.by_ref().take_while(|record| !record.is_empty()).collect();
        let named = own.into_iter().enumerate().map(|(k, text)| (format!("{kind} {}", k + 1), text));
        named.collect::<Vec<_>>()
    };
    let (joints, links, forces) = (list("joint"), list("link"), list("force"));
    Parts::check_count(joints.len() + links.len() + forces.len())?;
    Ok(PmksRecords {
        settings,
        joints: joints.into_iter().map(joint).collect::<Result<_>>()?,
        links: links.into_iter().map(link).collect::<Result<_>>()?,
        forces: forces.into_iter().map(force).collect::<Result<_>>()?,
        further: sections.skip(1).filter(|section| !section.is_empty()).map(String::from).collect(),
    })
}

fn settings([bools, decimals, wholes, units]: [&str; 4]) -> Result<PmksSettings> {
    let read = Fields::of("settings".into(), bools);
    let own = flags(bools).filter(|_| (1..=2).contains(&bools.len()));
    let own = own.ok_or_else(|| read.fault(sentences::are_no_flags_of_a_link(&bools)))?;
    Fields::of("settings".into(), decimals).decimal("the scale")?;
    let speed = Fields::of("settings".into(), wholes).whole("the speed")?;
    let unit = |at: usize, what: &str| {
        let found = units.as_bytes().get(at).map(|byte| byte.wrapping_sub(b'0'));
        found.ok_or_else(|| Fields::of("settings".into(), units).fault(sentences::the_record_ends_before(&what)))
    };
    let length = match unit(0, "the unit of lengths")? {
        0 => LinkLength::Inch,
        1 => LinkLength::Centimetre,
        2 => LinkLength::Metre,
        _ => return Err(Fields::of("settings".into(), units).fault(sentences::is_no_unit_of_lengths(&units))),
    };
    let is_pound = unit(2, "the unit of forces")? == 0;
    let is = |bit: u32| own >> bit & 1 == 1;
    Ok(PmksSettings { is_clockwise: is(0), has_forces: is(1) || is(7), speed, length, is_pound })
}

/// The first `count` characters of a record, and the rest.
fn first<'a>(fields: &Fields, text: &'a str, count: usize) -> Result<(&'a str, &'a str)> {
    text.split_at_checked(count).ok_or_else(|| fields.fault(sentences::the_record_ends_before(&"its name")))
}

fn joint((record, text): (String, &str)) -> Result<PmksJoint> {
    let mut fields = Fields::of(record, text);
    let own = fields.text("its name")?;
    let (sign, id) = first(&fields, own, 1).map(|(sign, id)| (sign, id.to_string()))?;
    let own = flags(sign).ok_or_else(|| fields.fault(sentences::are_no_flags_of_a_link(&sign)))?;
    let name = fields.text("its label")?.to_string();
    let place = Vec2::new(fields.decimal("x")?, fields.decimal("y")?);
    let angle = fields.decimal("the angle")?;
    let slot = [0; 3].map(|_| fields.optional().unwrap_or_default().to_string());
    let is = |bit: u32| own >> bit & 1 == 1;
    Ok(PmksJoint {
        id,
        name,
        place,
        is_slide: is(0),
        is_input: is(1),
        is_ground: is(2),
        is_welded: is(3),
        angle,
        slot: Some(slot).filter(|slot| slot.iter().all(|own| !own.is_empty())),
        has_speed: fields.optional().is_some(),
    })
}

fn link((record, text): (String, &str)) -> Result<PmksLink> {
    let mut fields = Fields::of(record, text);
    let own = fields.text("its name")?;
    let (signs, id) = first(&fields, own, 2).map(|(signs, id)| (signs, id.to_string()))?;
    let is_root = match &signs[..1] {
        "Y" | "A" | "M" | "G" | "0" | "1" | "2" | "3" => true,
        "N" | "a" | "m" | "g" | "4" | "5" | "6" | "7" => false,
        other => return Err(fields.fault(sentences::are_no_flags_of_a_link(&other))),
    };
    let is_block = match &signs[1..] {
        "R" => false,
        "P" => true,
        other => return Err(fields.fault(sentences::are_no_flags_of_a_link(&other))),
    };
    let name = fields.text("its label")?.to_string();
    let (mass, inertia) = (fields.decimal("the mass")?, fields.decimal("the moment of inertia")?);
    let centre = Vec2::new(fields.decimal("x of the mass centre")?, fields.decimal("y of the mass centre")?);
    fields.text("the colour")?;
    let mut list = || {
        let names = std::iter::from_fn(|| fields.optional().filter(|name| !name.is_empty()));
        names.map(String::from).collect::<Vec<_>>()
    };
    let (joints, parts) = (list(), list());
    Ok(PmksLink { is_root, is_block, id, name, mass, inertia, centre, joints, parts })
}

fn force((record, text): (String, &str)) -> Result<PmksForce> {
    let mut fields = Fields::of(record, text);
    let own = fields.text("its name")?;
    let (sign, _) = first(&fields, own, 1)?;
    let own = flags(sign).ok_or_else(|| fields.fault(sentences::are_no_flags_of_a_link(&sign)))?;
    let (link, name) = (fields.text("its link")?.to_string(), fields.text("its label")?.to_string());
    let from = Vec2::new(fields.decimal("x of the force")?, fields.decimal("y of the force")?);
    let to = Vec2::new(fields.decimal("x of its end")?, fields.decimal("y of its end")?);
    let size = fields.decimal("the magnitude")?;
    Ok(PmksForce { name, link, from, to, turns_with_link: own & 1 == 1, is_outward: own & 2 == 2, size })
}
