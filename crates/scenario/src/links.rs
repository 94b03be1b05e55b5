//! `[ground]` and `[links]`: points and masses.

use crate::sentences;
use std::collections::BTreeSet;

use super::keys::key::{FileKey, Section, ValueKind, needed, optional};
use super::reader::{Faults, Sign, TomlTable};
use super::words::suggestion;
use linkage::error::Result;
use linkage::math::{Vec2, unit};
use linkage::mechanism::{Link, Point, is_sound_name};

/// A position: coordinates, or distance and direction from an earlier point.
pub const PLACE: &[FileKey] = &[
    optional("x", ValueKind::LENGTHS, "given with `y`, in place of `from`").means("coordinate along x"),
    optional("y", ValueKind::LENGTHS, "given with `x`").means("coordinate along y"),
    optional("from", ValueKind::Text, "given in place of `x` and `y`").means("earlier point of the same table"),
    optional("length", ValueKind::LENGTHS.of(Sign::NotNegative), "given with `from`").means("distance from that point"),
    optional("angle", ValueKind::ANGLES, "given with `from`").means(
        "direction from that point, counted from the x axis of the link; for ground points, from the x axis \
         of the world",
    ),
];

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("ground").with(&[needed("points", ValueKind::Table).means("fixed points by name")]),
    Section::at("ground.points.*").with(PLACE),
    Section::at("links.*").with(&[
        needed("points", ValueKind::Table).means("points by name, in the link's frame, at least one"),
        optional("mass", ValueKind::MASSES.of(Sign::NotNegative), "none: a massless link").means("mass, not negative"),
        optional("mass_centre", ValueKind::Table, "required with a mass, not allowed without")
            .means("position of the mass centre in the link's frame; may refer to any point of the link"),
        optional("inertia", ValueKind::INERTIAS.of(Sign::NotNegative), "0")
            .means("moment of inertia about the mass centre, not negative; needs a mass"),
    ]),
    Section::at("links.*.points.*").with(PLACE),
    Section::at("links.*.mass_centre").with(PLACE),
];

/// Value that marks a point whose position could not be read.
const NOWHERE: Vec2 = Vec2::new(f64::NAN, f64::NAN);

/// Whether a position could be read.
pub fn is_somewhere(place: Vec2) -> bool {
    place.iter().all(|part| part.is_finite())
}

/// The ground and all links, in the order of the file.
/// Links with mistakes keep their names and the names of their points.
/// Points whose position could not be read are at `NOWHERE`.
pub fn read(ground: Option<TomlTable>, links: Option<TomlTable>, faults: &mut Faults) -> Vec<Link> {
    let mut points = Vec::new();
    if let Some(mut ground) = ground {
        faults.read(&mut ground, |ground| {
            points = named_points(ground)?;
            ground.finish()
        });
    }
    let frame = Link { name: "ground".into(), points, mass: 0.0, mass_centre: Vec2::zeros(), inertia: 0.0 };
    let mut all = vec![frame];
    let tables = links.and_then(|mut links| {
        faults.read(&mut links, |links| {
            let tables = links.all_tables()?;
            match tables.is_empty() {
                true => Err(links.fault(sentences::THERE_IS_NO_LINK_2).help(sentences::ADD_A_SECTION_LINKS_NAME)),
                false => Ok(tables),
            }
        })
    });
    for mut table in tables.into_iter().flatten() {
        let mut link = Link { name: table.name().to_string(), ..all[0].clone() };
        link.points = Vec::new();
        faults.read(&mut table, |table| fill(table, &mut link));
        all.push(link);
    }
    // If not all links and points could be read, other sections may name a link or a point that is missing here. Errors
    // about unknown names are then not reported.
    faults.names &= all.len() > 1 && all.iter().all(|link| !link.points.is_empty());
    faults.whole &= faults.names;
    all
}

fn fill(table: &mut TomlTable, link: &mut Link) -> Result<()> {
    table.part(check_name(table, "link"));
    link.points = named_points(table)?;
    let points = &link.points;
    let mass = table.optional_si("mass")?;
    let inertia = table.optional_si("inertia")?;
    let centre = table.optional_table("mass_centre")?.map(|centre| place(centre, points)).transpose();
    let centre = table.part(centre);
    table.finish()?;
    if mass.is_none() && inertia.is_some() {
        let help = sentences::ADD_MASS_KG_OR_LEAVE_OUT;
        return table.refuse("inertia", sentences::THE_LINK_HAS_A_MOMENT_OF_INERTIA, help);
    }
    if mass.is_none() && centre.is_some() {
        let help = sentences::ADD_MASS_KG_IS_ALLOWED_OR_LEAVE;
        return table.refuse("mass_centre", sentences::THE_LINK_HAS_A_MASS_CENTRE, help);
    }
    if mass.is_some() && centre.is_none() {
        let message = sentences::THE_LINK_HAS_A_MASS_BUT_NO_MASS;
        return table.refuse("mass", message, sentences::ADD_MASS_CENTRE_IN_THE_LINK);
    }
    link.mass = mass.unwrap_or(0.0);
    link.mass_centre = centre.unwrap_or_else(Vec2::zeros);
    link.inertia = inertia.unwrap_or(0.0);
    Ok(())
}

/// The points of a link. Points with mistakes keep their names.
fn named_points(link: &mut TomlTable) -> Result<Vec<Point>> {
    let Ok(mut table) = link.table("points") else { return Ok(Vec::new()) };
    let mut points: Vec<Point> = Vec::new();
    let read = table.read(|table| {
        for point in table.all_tables()? {
            table.part(check_name(&point, "point"));
            let name = point.name().to_string();
            let local = place(point, &points).or_else(|error| table.instead(NOWHERE, error))?;
            points.push(Point { name, local });
        }
        match points.is_empty() {
            true => Err(table.fault(sentences::THERE_IS_NO_POINT).help(sentences::ADD_A_POINT_A)),
            false => Ok(()),
        }
    });
    link.part(read);
    let known: BTreeSet<&str> = points.iter().map(|own| own.name.as_str()).collect();
    let missing: Vec<String> = table.keys().into_iter().filter(|key| !known.contains(key.as_str())).collect();
    points.extend(missing.into_iter().map(|name| Point { name, local: NOWHERE }));
    Ok(points)
}

/// A position: coordinates, or a distance and an angle from a point that was read before.
pub fn place(mut table: TomlTable, known: &[Point]) -> Result<Vec2> {
    table.read(|table| place_of(table, known))
}

fn place_of(table: &mut TomlTable, known: &[Point]) -> Result<Vec2> {
    let from = match table.has_si("length") || table.has_si("angle") {
        true => Some(table.string("from")?),
        false => table.optional_string("from")?,
    };
    let place = match from {
        None => Vec2::new(table.si("x")?, table.si("y")?),
        Some(from) => {
            let names = known.iter().map(|point| point.name.as_str());
            let Some(origin) = known.iter().find(|point| point.name == from) else {
                let message = sentences::no_point_stands_before_this_one(&from);
                return table.refuse("from", message, suggestion(&from, names, "\""));
            };
            let length = table.si("length")?;
            let angle = table.si("angle")?;
            origin.local + unit(angle) * length
        }
    };
    table.finish()?;
    Ok(place)
}

/// The value of the key `name`, if it is allowed as the name of `what`.
pub fn sound_name(table: &mut TomlTable, what: &str) -> Result<String> {
    let name = table.string("name")?;
    match is_sound_name(&name) {
        true => Ok(name),
        false => table.refuse("name", sentences::cannot_be_the_name_of(&name, &what), NAME_HELP),
    }
}

fn check_name(table: &TomlTable, what: &str) -> Result<()> {
    if is_sound_name(table.name()) {
        return Ok(());
    }
    Err(table.fault(sentences::cannot_be_the_name_of_a(&table.name(), &what)).help(NAME_HELP))
}

/// Help for names that are not allowed.
const NAME_HELP: &str = sentences::NAMES_CONSIST_OF_LETTERS_DIGITS;
