//! `[clearance]`: outlines of links, the housing, and the requested distances.

pub mod outline;
pub mod question;

use crate::sentences;
pub use outline::{Flaw, MOST_CORNERS, Outline, nearest};
pub use question::{ClearanceBody, ClearanceQuestion};

use super::keys::key::{FileKey, Section, ValueKind, needed, optional};
use super::links::{PLACE, place, sound_name};
use super::reader::{Sign, TomlTable};
use super::unit::LENGTH;
use super::words::suggestion;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, Link, LinkId, Mechanism, Point};
use question::pairs;

const RADIUS: FileKey = optional(
    "radius",
    ValueKind::LENGTHS.of(Sign::NotNegative),
    "`radius` of `[clearance]`; 0 for a polygon or the housing",
)
.means("rounding radius: positive for a line, not negative for a polygon or a part of the housing");
const CORNERS: FileKey = optional("corners", ValueKind::Tables, "a line")
    .means("three or more positions: the corners of a filled polygon, convex or not, in either sense");
const LINE: FileKey = optional("line", ValueKind::Tables, "for a link without `corners`: through its points")
    .means("positions joined by capsules; a single position is a disc");

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("clearance").with(&[
        optional("radius", ValueKind::LENGTHS.of(Sign::Positive), "every link needs an entry in `outlines`")
            .means("radius, positive, of the capsules between the points of every link without an entry in `outlines`"),
        optional("wanted", ValueKind::LENGTHS.of(Sign::NotNegative), "none: only collisions count")
            .means("required clearance: the distance of every pair must be larger"),
        optional("tolerance", ValueKind::LENGTHS.of(Sign::Positive), "a millionth of the mechanism's size")
            .means("largest allowed error of a smallest distance"),
        optional("area_rel", ValueKind::Number, "5e-3")
            .means("largest allowed error of a swept area, as a fraction of the area; at least 1e-5 and below 1"),
        optional("outlines", ValueKind::Table, "capsules between the points").means("outlines of links by name"),
        optional("housing", ValueKind::Tables, "none").means("parts of the housing"),
        optional("ignore", ValueKind::Tables, "none")
            .means("pairs that cannot meet, because they lie in different planes"),
    ]),
    Section::at("clearance.outlines.*").with(&[CORNERS, LINE, RADIUS]),
    Section::at("clearance.outlines.*.corners").with(PLACE),
    Section::at("clearance.outlines.*.line").with(PLACE),
    Section::at("clearance.housing").with(&[
        needed("name", ValueKind::Text).means("unique name, different from those of all links"),
        CORNERS,
        LINE,
        RADIUS,
    ]),
    Section::at("clearance.housing.corners").with(PLACE),
    Section::at("clearance.housing.line").with(PLACE),
    Section::at("clearance.ignore")
        .with(&[needed("bodies", ValueKind::Texts)
            .means("the two bodies that cannot meet; `\"housing\"` means all its parts")]),
];

/// Default tolerance of a swept area, divided by the area.
const AREA: f64 = 5e-3;
/// Lower limit of the tolerance of a swept area, divided by the area.
/// The area is found by division of the plane into squares. Their number grows with the inverse of the tolerance.
const SMALLEST_AREA: f64 = 1e-5;
/// Lower limit of a tolerance, divided by the mechanism's size. A finer tolerance would be below the rounding error.
const FINEST: f64 = 1e-10;
/// Upper limit of an outline's extent, divided by the sum of the mechanism's size and the largest distance of a ground
/// point from the origin. With a larger extent, the results would be rounding errors.
const FARTHEST: f64 = 1e6;
/// Upper limit of the number of parts of a housing.
const MOST_PARTS: usize = 200;
/// Name that denotes all parts of the housing.
const HOUSING: &str = "housing";

/// The question that a file asks about clearance.
pub fn read(table: &mut TomlTable, mechanism: &Mechanism) -> Result<ClearanceQuestion> {
    let radius = table.optional_si("radius")?;
    let wanted = table.optional_si("wanted")?;
    let tolerance = table.optional_si("tolerance")?;
    let size = mechanism.size();
    if tolerance.is_some_and(|tolerance| tolerance < FINEST * size) {
        let message = sentences::distances_are_found_to_and_no_better(
            &format_args!("{:.1e}", FINEST * size),
            &format_args!("{:e}", FINEST),
        );
        return table.refuse("tolerance", message, sentences::GIVE_A_LARGER_TOLERANCE_OR_LEAVE);
    }
    let area = area(table)?;
    let (outlines, housing) = (table.optional_table("outlines")?, table.tables("housing")?);
    let ignored = table.tables("ignore")?;
    table.finish()?;
    let mut bodies = links(table, outlines, radius, mechanism)?;
    if housing.len() > MOST_PARTS {
        let message = sentences::found_parts_of_the_housing(&housing.len(), &MOST_PARTS);
        return table.refuse(HOUSING, message, sentences::LEAVE_OUT_PARTS_THAT_NO_LINK);
    }
    for part in housing {
        let body = wall(part, mechanism, &bodies)?;
        bodies.push(body);
    }
    let ground = mechanism.links()[GROUND].points.iter().map(|point| point.local.norm()).fold(0.0, f64::larger);
    if let Some(far) = bodies.iter().find(|body| !(body.outline.extent() <= FARTHEST * (size + ground))) {
        let message = sentences::the_outline_of_extends_to_the_mechanism(
            &far.name,
            &format_args!("{:.3e}", far.outline.extent()),
            &format_args!("{size:.3e}"),
        );
        return Err(table.fault(message).help(sentences::CHECK_THE_UNITS_OF_ITS_CORNERS));
    }
    let ignored = ignored.into_iter().map(|pair| ignore(pair, &bodies)).collect::<Result<Vec<_>>>()?.concat();
    let pairs = pairs(mechanism, &bodies, &ignored);
    Ok(ClearanceQuestion { bodies, pairs, wanted, tolerance, area })
}

fn area(table: &mut TomlTable) -> Result<f64> {
    let share = table.optional_number("area_rel")?.unwrap_or(AREA);
    if (SMALLEST_AREA..1.0).contains(&share) {
        return Ok(share);
    }
    let message = sentences::found_but_this_is_the_share(&share);
    let error = table.wrong(ErrorKind::Input, "area_rel", message);
    table.instead(share, error.help(sentences::give_a_number_from_to_such_as(&format_args!("{:e}", SMALLEST_AREA))))
}

/// The moving links with their outlines, in the order of the mechanism.
fn links(
    table: &TomlTable,
    outlines: Option<TomlTable>,
    radius: Option<f64>,
    mechanism: &Mechanism,
) -> Result<Vec<ClearanceBody>> {
    let links = mechanism.links();
    let mut given: Vec<Option<Outline>> = vec![None; links.len()];
    if let Some(mut outlines) = outlines {
        for own in outlines.all_tables()? {
            let name = own.name().to_string();
            let found = links.find(|link| link.name == name);
            let Some(link) = found.filter(|&link| link != GROUND) else {
                let (message, names) = match found {
                    Some(_) => (sentences::THE_GROUND_HAS_NO_OUTLINE.into(), "write `[[clearance.housing]]`".into()),
                    None => {
                        let names = links[1..].iter().map(|link| link.name.as_str());
                        (sentences::there_is_no_link(&name), suggestion(&name, names, "\""))
                    }
                };
                return Err(own.fault(message).help(names));
            };
            given[link] = Some(of_link(own, radius, &links[link])?);
        }
    }
    let body = |(link, own): (LinkId, Option<Outline>)| {
        let Link { name, points, .. } = &links[link];
        let outline = match (own, radius) {
            (Some(outline), _) => outline,
            (None, Some(radius)) => default(table, points, radius)?,
            (None, None) => {
                let message = sentences::link_has_no_outline(&name);
                return Err(table.fault(message).help(sentences::give_all_links_capsules_with_radius(&name)));
            }
        };
        Ok(ClearanceBody { name: name.clone(), link, outline })
    };
    links.ids().zip(given).skip(1).map(body).collect()
}

fn default(table: &TomlTable, points: &[Point], radius: f64) -> Result<Outline> {
    let places: Vec<Vec2> = points.iter().map(|point| point.local).collect();
    Outline::of_points(&places, radius).map_err(|flaw| flawed(table, "radius", flaw))
}

/// The outline that the file states for a link: corners, a line, or only the radius of its capsules.
fn of_link(mut table: TomlTable, default_radius: Option<f64>, link: &Link) -> Result<Outline> {
    let drawn = drawn(&mut table, &link.points)?;
    let solid = matches!(drawn, Some(("corners", _)));
    // A line has no interior, so its radius must be positive.
    let sign = if solid { Sign::NotNegative } else { Sign::Positive };
    let radius = table.optional_quantity("radius", &LENGTH, sign)?;
    table.finish()?;
    let Some(radius) = radius.or(if solid { Some(0.0) } else { default_radius }) else {
        return Err(table.fault(sentences::THE_OUTLINE_HAS_NO_RADIUS).help(sentences::ADD_RADIUS_MM_OR_GIVE_CORNERS));
    };
    match drawn {
        Some(drawn) => rounded(&table, drawn, radius),
        None => default(&table, &link.points, radius),
    }
}

/// The outline from the positions that [`drawn`] has read: a polygon from `corners`, otherwise a line.
fn rounded(table: &TomlTable, (key, places): (&'static str, Vec<Vec2>), radius: f64) -> Result<Outline> {
    let outline = if key == "corners" { Outline::polygon(&places, radius) } else { Outline::line(&places, radius) };
    outline.map_err(|flaw| flawed(table, key, flaw))
}

/// A part of the housing.
fn wall(mut table: TomlTable, mechanism: &Mechanism, before: &[ClearanceBody]) -> Result<ClearanceBody> {
    let name = sound_name(&mut table, sentences::A_PART_OF_THE_HOUSING)?;
    if name == HOUSING || before.iter().any(|body| body.name == name) {
        return table.refuse("name", sentences::is_taken(&name), sentences::GIVE_EVERY_PART_A_NAME_OF_ITS_OWN);
    }
    let drawn = drawn(&mut table, &mechanism.links()[GROUND].points)?;
    let radius = table.optional_si("radius")?.unwrap_or(0.0);
    table.finish()?;
    let Some(drawn) = drawn else {
        let help = sentences::ADD_CORNERS_OF_A_SOLID_PART;
        return Err(table.fault(sentences::THIS_PART_OF_THE_HOUSING).help(help));
    };
    let outline = rounded(&table, drawn, radius)?;
    Ok(ClearanceBody { name, link: GROUND, outline })
}

/// The positions under `corners` (a polygon) or `line`, if either key is present.
/// Positions may be relative to the points `known`.
fn drawn(table: &mut TomlTable, known: &[Point]) -> Result<Option<(&'static str, Vec<Vec2>)>> {
    let mut found = None;
    for key in ["corners", "line"] {
        let places = table.tables(key)?;
        if !table.has(key) {
            continue;
        }
        if found.is_some() {
            return table.refuse(key, sentences::CORNERS_AND_LINE_ARE_BOTH, sentences::KEEP_ONE_OF_THE_TWO);
        }
        if places.len() > MOST_CORNERS {
            return Err(flawed(table, key, Flaw::Many(places.len())));
        }
        let places = places.into_iter().map(|own| place(own, known)).collect::<Result<Vec<_>>>()?;
        found = Some((key, places));
    }
    Ok(found)
}

/// The error for positions that do not form an outline.
fn flawed(table: &TomlTable, key: &str, flaw: Flaw) -> Error {
    let (message, help) = match flaw {
        Flaw::Few(0) if key == "line" => {
            (sentences::A_LINE_NEEDS_A_PLACE_OR_MORE.into(), sentences::ONE_PLACE_IS_A_DISC_TWO_ARE_A_CAPSULE)
        }
        Flaw::Few(count) => (sentences::found_corners_but_a_polygon(&count), sentences::ADD_CORNERS_OR_WRITE_A_LINE),
        Flaw::Many(count) => {
            (sentences::found_corners_but_at_most(&count, &MOST_CORNERS), sentences::LEAVE_OUT_CORNERS_THAT_CHANGE)
        }
        Flaw::Repeated([a, b]) => {
            (sentences::corners_and_are_in_one_place(&(a + 1), &(b + 1)), sentences::GIVE_EVERY_CORNER_ONCE_THE_LAST)
        }
        Flaw::Crossing([a, b]) => {
            (sentences::the_sides_that_begin_at_corners(&(a + 1), &(b + 1)), sentences::GIVE_THE_CORNERS_IN_THEIR)
        }
        Flaw::Flat => (sentences::ALL_CORNERS_LIE_ON_ONE_LINE.into(), sentences::WRITE_A_LINE_OR_GIVE_CORNERS),
        Flaw::NoNumber => (sentences::A_COORDINATE_OR_THE_RADIUS.into(), sentences::GIVE_FINITE_NUMBERS),
    };
    table.wrong(ErrorKind::Input, key, message).help(help)
}

/// The pairs of bodies that are named by one entry of `ignore`.
fn ignore(mut table: TomlTable, bodies: &[ClearanceBody]) -> Result<Vec<[usize; 2]>> {
    let names = table.strings("bodies")?;
    table.finish()?;
    let [first, second] = &names[..] else {
        let help = "write `{ bodies = [\"crank\", \"rocker\"] }`";
        return table.refuse("bodies", sentences::found_names_but_a_pair_has_two(&names.len()), help);
    };
    let numbers = |name: &str| -> Result<Vec<usize>> {
        let is_named = |body: &ClearanceBody| body.name == name || (name == HOUSING && !body.moves());
        let found: Vec<usize> = (0..bodies.len()).filter(|&body| is_named(&bodies[body])).collect();
        if found.is_empty() {
            let message = sentences::there_is_no_link_and_no_part(&name);
            let known = bodies.iter().map(|body| body.name.as_str());
            return table.refuse("bodies", message, suggestion(name, known, "\""));
        }
        Ok(found)
    };
    let (first, second) = (numbers(first)?, numbers(second)?);
    Ok(first.iter().flat_map(|&a| second.iter().map(move |&b| [a, b])).collect())
}
