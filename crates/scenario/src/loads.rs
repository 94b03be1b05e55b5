//! `[[loads]]`: forces, moments, springs and dampers.

use super::joints::link;
use super::keys::key::{Section, ValueKind, needed, optional};
use super::reader::{Faults, Sign, TomlTable};
use super::unit::{DAMPING, MOMENT, MOMENT_PER_SPEED, STIFFNESS, TORSIONAL_STIFFNESS, of_input};
use super::words::{Words, names, suggestion};
use crate::sentences;
use linkage::drive::{Acts, Course, Load};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::mechanism::{GROUND, JointId, JointSide, LinkId, Mechanism};
use std::f64::consts::{PI, TAU};

const ACTS: Words<Acts> =
    &[("always", Acts::Always), ("counter-clockwise", Acts::CounterClockwise), ("clockwise", Acts::Clockwise)];

/// Words for the sense of a slide in which a force acts.
const SLIDING: Words<Acts> =
    &[("always", Acts::Always), ("extending", Acts::CounterClockwise), ("retracting", Acts::Clockwise)];

/// Words that say when a spring acts: always, or only beyond or below its unloaded slide or angle.
const SIDES: Words<Acts> = &[("always", Acts::Always), ("beyond", Acts::CounterClockwise), ("below", Acts::Clockwise)];

/// All words of the key `acts`.
fn all_acts() -> Vec<&'static str> {
    let rest = [SLIDING, SIDES].into_iter().flat_map(|words| names(&words[1..]));
    names(ACTS).into_iter().chain(rest).collect()
}

/// Words for the axes of a force, and whether these axes turn with the link.
const FRAMES: Words<bool> = &[("world", false), ("link", true)];

/// Words for the interpolation of a table, and whether its curve has no kinks.
const INTERPOLATIONS: Words<bool> = &[("linear", false), ("smooth", true)];

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("loads").with(&[
        needed("type", ValueKind::Choice(|| names(SORTS))).means("kind of load"),
        optional("link", ValueKind::Text, "required by the type").means("the loaded link"),
        optional("point", ValueKind::Text, "required by the type").means("the loaded point of that link"),
        optional("links", ValueKind::Texts, "required by the type")
            .means("the two links that a spring or damper joins; one may be `\"ground\"`"),
        optional("points", ValueKind::Texts, "required by the type").means("one point of each of these two links"),
        optional("moment", ValueKind::MOMENTS, "required by the type, or a table")
            .means("moment, counter-clockwise positive; for a resistance its magnitude, not negative"),
        optional("acts", ValueKind::Choice(all_acts), "`\"always\"`").means(
            "the load acts only while the link rotates in this sense (moment), while the slide changes in this sense \
             (force on a slide), or on this side of the free angle or free slide (spring)",
        ),
        optional("x", ValueKind::FORCES, "required by the type, or a table").means("force along x"),
        optional("y", ValueKind::FORCES, "required by the type, or a table").means("force along y"),
        optional("frame", ValueKind::Choice(|| names(FRAMES)), "`\"world\"`")
            .means("for a force: world axes, or link axes, which rotate with the link"),
        optional("force", ValueKind::FORCES.of(Sign::NotNegative), "required by the type")
            .means("magnitude of a force against the motion of the point, not negative"),
        optional("stiffness", ValueKind::STIFFNESSES_OR_TORSIONAL, "required by the type")
            .means("stiffness of a spring, not negative"),
        optional("free_length", ValueKind::LENGTHS.of(Sign::NotNegative), "required by the type")
            .means("unloaded length of the spring, not negative"),
        optional("free_angle", ValueKind::ANGLES, "required by the type").means("unloaded twist of the spring"),
        optional("damping", ValueKind::DAMPINGS_OR_SLOPES, "required by the type").means("damping, not negative"),
        optional("joint", ValueKind::Text, "required by the type").means("the joint with friction, or the loaded prismatic joint"),
        optional("thrust", ValueKind::FORCES, "required by the type, or a table, or a pressure")
            .means("force along the axis of a prismatic joint on its second link, positive if it increases the slide"),
        optional("pressure", ValueKind::PRESSURES, "required with `bore`, or a table").means("pressure on a piston"),
        optional("bore", ValueKind::LENGTHS.of(Sign::Positive), "no piston").means("diameter of the piston under the pressure"),
        optional("free_slide", ValueKind::LENGTHS, "required by the type").means("unloaded slide of the spring"),
        optional("coefficient", ValueKind::Number, "required by the type")
            .means("coefficient of friction, not negative"),
        optional("radius", ValueKind::LENGTHS.of(Sign::NotNegative), "required for a revolute joint")
            .means("radius of the journal"),
        optional("length", ValueKind::LENGTHS.of(Sign::NotNegative), "0: the moment of the guide causes no friction")
            .means("length of the guide of a prismatic joint, half of it on each side of the point of the second link"),
        optional("table", ValueKind::Tables, "constant values")
            .means("load as a function of the input of the first drive: crank angles ascending, within one period, or slides ascending; \
                    between two points with the same input a table of straight lines jumps"),
        optional("interpolation", ValueKind::Choice(|| names(INTERPOLATIONS)), "`\"linear\"`").means(
            "interpolation of the table: straight lines, which do not overshoot, or a periodic cubic spline \
             with continuous second derivatives",
        ),
        optional("turns", ValueKind::Integer, "1")
            .means("turns of the crank after which the table repeats; 2 for a four-stroke engine"),
    ]),
    Section::at("loads.table").with(&[
        needed("crank", ValueKind::INPUTS).means("crank angle, or slide of the first drive. Beyond its ends, a table over a slide keeps the values of its ends"),
        optional("moment", ValueKind::MOMENTS, "required for a moment").means("moment at that input"),
        optional("thrust", ValueKind::FORCES, "required for a force on a slide").means("force along the axis at that input"),
        optional("pressure", ValueKind::PRESSURES, "required with `bore`").means("pressure at that input"),
        optional("x", ValueKind::FORCES, "required for a force").means("force along x at that input"),
        optional("y", ValueKind::FORCES, "required for a force").means("force along y at that input"),
    ]),
];

/// Types of loads, each with its reader. The names of the types are the names that [`Load::sort`] returns.
const SORTS: Words<fn(&mut TomlTable, &Mechanism) -> Result<Load>> = &[
    ("resistance", resistance),
    ("moment", moment),
    ("force", force),
    ("resisting_force", resisting_force),
    ("spring", spring),
    ("damper", damper),
    ("torsion_spring", torsion_spring),
    ("torsion_damper", torsion_damper),
    ("slide_force", slide_force),
    ("slide_spring", slide_spring),
    ("slide_damper", slide_damper),
    ("friction", friction),
];

/// Upper limit of a coefficient of friction. A larger number is most likely a percentage or a mistake.
const MOST_FRICTION: f64 = 10.0;

/// Upper limit of the number of crank turns after which a table repeats.
const MOST_TURNS: i64 = 1000;

/// Reads the loads. Loads with mistakes are left out.
pub fn read(tables: Vec<TomlTable>, mechanism: &Mechanism, faults: &mut Faults) -> Vec<Load> {
    tables.into_iter().filter_map(|mut table| faults.read(&mut table, |table| load(table, mechanism))).collect()
}

/// Reads `joint`: a joint, and its links.
fn joint(table: &mut TomlTable, mechanism: &Mechanism) -> Result<(JointId, [LinkId; 2])> {
    let name = table.string("joint")?;
    let Some(joint) = mechanism.joint_named(&name) else {
        let names = mechanism.joints().iter().map(|joint| joint.name.as_str());
        return table.refuse("joint", sentences::there_is_no_joint(&name), suggestion(&name, names, "\""));
    };
    let own = &mechanism.joints()[joint];
    Ok((joint, [own.first.link, own.second.link]))
}

/// Reads `joint`: a prismatic joint, and its links.
fn slide(table: &mut TomlTable, mechanism: &Mechanism) -> Result<(JointId, [LinkId; 2])> {
    let found = joint(table, mechanism)?;
    let own = &mechanism.joints()[found.0];
    match own.slides() {
        true => Ok(found),
        false => table.refuse("joint", sentences::joint_does_not_slide(&own.name), sentences::NAME_A_PRISMATIC_JOINT),
    }
}

fn slide_force(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let (joint, links) = slide(table, mechanism)?;
    let acts = table.optional_choice("acts", sentences::DOES_NOT_SAY_WHEN_THE_MOMENT, SLIDING)?;
    let [force] = match table.optional_si("bore")? {
        None => courses(table, ["thrust"])?,
        Some(bore) => courses(table, ["pressure"])?.map(|pressure| pressure.times(PI * bore * bore / 4.0)),
    };
    Ok(Load::SlideForce { joint, links, force, acts: acts.unwrap_or(Acts::Always) })
}

fn slide_spring(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let (joint, links) = slide(table, mechanism)?;
    let stiffness = table.quantity("stiffness", &STIFFNESS, Sign::NotNegative)?;
    let free_slide = table.si("free_slide")?;
    let acts = table.optional_choice("acts", sentences::DOES_NOT_SAY_WHEN_THE_MOMENT, SIDES)?;
    Ok(Load::SlideSpring { joint, links, stiffness, free_slide, acts: acts.unwrap_or(Acts::Always) })
}

fn slide_damper(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let (joint, links) = slide(table, mechanism)?;
    let damping = table.quantity("damping", &DAMPING, Sign::NotNegative)?;
    Ok(Load::SlideDamper { joint, links, damping })
}

fn friction(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let (joint, links) = joint(table, mechanism)?;
    let coefficient = table.number("coefficient")?;
    if !(0.0..MOST_FRICTION).contains(&coefficient) {
        let message = sentences::found_but_a_coefficient_lies(&coefficient, &MOST_FRICTION);
        return table.refuse("coefficient", message, sentences::STEEL_ON_BRONZE);
    }
    let own = &mechanism.joints()[joint];
    let length = if own.slides() { table.optional_si("length")?.unwrap_or(0.0) } else { table.si("radius")? };
    Ok(Load::Friction { joint, links, coefficient, length })
}

fn load(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let load = table.choice("type", sentences::IS_NO_TYPE_OF_LOAD, SORTS)?(table, mechanism)?;
    table.finish()?;
    Ok(load)
}

fn resistance(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let name = table.string("link")?;
    let moment = table.quantity("moment", &MOMENT, Sign::NotNegative)?;
    Ok(Load::Resistance { link: turning(table, &name, mechanism)?, moment })
}

fn moment(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let name = table.string("link")?;
    let [moment] = courses(table, ["moment"])?;
    let acts = table.optional_choice("acts", sentences::DOES_NOT_SAY_WHEN_THE_MOMENT, ACTS)?.unwrap_or(Acts::Always);
    let link = match acts {
        Acts::Always => moving(table, &name, mechanism)?,
        Acts::CounterClockwise | Acts::Clockwise => turning(table, &name, mechanism)?,
    };
    Ok(Load::Moment { link, moment, acts })
}

fn force(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let point = (table.string("link")?, table.string("point")?);
    let force = courses(table, ["x", "y"])?;
    let follows = table.optional_choice("frame", sentences::IS_NO_FRAME_OF_A_FORCE, FRAMES)?.unwrap_or(false);
    let at = loaded_point(table, mechanism, point)?;
    Ok(Load::Force { at, force, follows })
}

fn resisting_force(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let point = (table.string("link")?, table.string("point")?);
    let force = table.si("force")?;
    let at = loaded_point(table, mechanism, point)?;
    // A point at a ground pivot does not move. Its computed velocity is only rounding error. A point at a ground pivot
    // is refused, because the rounding error would decide the direction of the force.
    let mut pins = mechanism.joints().iter().filter(|joint| joint.is_pin() && joint.on(GROUND).is_some());
    if pins.any(|joint| joint.on(at.link) == Some(at.local)) {
        let message = sentences::THE_POINT_DOES_NOT_MOVE_IT_IS_HINGED;
        return table.refuse("point", message, sentences::NAME_A_POINT_THAT_MOVES);
    }
    Ok(Load::ResistingForce { at, force })
}

fn spring(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let named = (table.strings("links")?, table.strings("points")?);
    let stiffness = table.quantity("stiffness", &STIFFNESS, Sign::NotNegative)?;
    let free_length = table.si("free_length")?;
    Ok(Load::Spring { ends: ends(table, mechanism, named)?, stiffness, free_length })
}

fn damper(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let named = (table.strings("links")?, table.strings("points")?);
    let damping = table.quantity("damping", &DAMPING, Sign::NotNegative)?;
    Ok(Load::Damper { ends: ends(table, mechanism, named)?, damping })
}

fn torsion_spring(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let names = table.strings("links")?;
    let stiffness = table.quantity("stiffness", &TORSIONAL_STIFFNESS, Sign::NotNegative)?;
    let free_angle = table.si("free_angle")?;
    let acts = table.optional_choice("acts", sentences::DOES_NOT_SAY_WHEN_THE_MOMENT, SIDES)?;
    let links = pair(table, mechanism, &names)?;
    Ok(Load::TorsionSpring { links, stiffness, free_angle, acts: acts.unwrap_or(Acts::Always) })
}

fn torsion_damper(table: &mut TomlTable, mechanism: &Mechanism) -> Result<Load> {
    let names = table.strings("links")?;
    let damping = table.quantity("damping", &MOMENT_PER_SPEED, Sign::NotNegative)?;
    Ok(Load::TorsionDamper { links: pair(table, mechanism, &names)?, damping })
}

/// Quantities that are constants, or columns of a table over the input of the first drive.
fn courses<const N: usize>(table: &mut TomlTable, names: [&str; N]) -> Result<[Course; N]> {
    let rows = table.tables("table")?;
    let constants = names.map(|name| table.optional_si(name));
    let smooth = table.optional_choice("interpolation", sentences::IS_NO_INTERPOLATION, INTERPOLATIONS)?;
    let turns = table.optional_integer("turns")?;
    if !table.has("table") {
        for (key, is_given) in [("interpolation", smooth.is_some()), ("turns", turns.is_some())] {
            if is_given {
                let message = sentences::THIS_BELONGS_TO_A_TABLE_OVER;
                return table.refuse(key, message, sentences::ADD_TABLE_OR_LEAVE_THE_KEY);
            }
        }
        let mut found = [0.0; N];
        for ((value, constant), name) in found.iter_mut().zip(constants).zip(names) {
            *value = match constant? {
                Some(constant) => constant,
                None => table.si(name)?,
            };
        }
        return Ok(found.map(Course::Constant));
    }
    for (constant, name) in constants.into_iter().zip(names) {
        if constant?.is_some() {
            return table.refuse(name, sentences::and_table_are_both_given(&name), sentences::KEEP_ONE_OF_THE_TWO);
        }
    }
    let mut points: [Vec<(f64, f64)>; N] = names.map(|_| Vec::new());
    let is_periodic = smooth == Some(true) || turns.is_some();
    let (smooth, turns) = (smooth.unwrap_or(false), period(table, turns)?);
    let mut slides: Option<bool> = None;
    for mut row in rows {
        let read = row.read(|row| {
            let Some((family, crank)) = row.optional_si_of("crank")? else {
                return Err(row.lacks(&["crank_rad", "crank_deg", "crank_m", "crank_mm"], sentences::GIVE_THE_INPUT));
            };
            let is_slide = std::ptr::eq(family, of_input(Input::Slide));
            if *slides.get_or_insert(is_slide) != is_slide || (is_slide && is_periodic) {
                let message = sentences::A_TABLE_OVER_A_SLIDE_IS_NOT_PERIODIC;
                return Err(row.wrong(ErrorKind::Input, "crank", message).help(sentences::GIVE_SLIDES_IN_ALL_ROWS));
            }
            for (name, points) in names.into_iter().zip(&mut points) {
                points.push((crank, row.si(name)?));
            }
            row.finish()
        });
        read?;
        check_crank(&row, &points[0], (slides != Some(true)).then_some(turns), smooth)?;
    }
    if points[0].is_empty() {
        let help = sentences::WRITE_A_CONSTANT_OR_ADD_POINTS;
        return table.refuse("table", sentences::A_TABLE_OVER_THE_CRANK_ANGLE, help);
    }
    let is_slide = slides == Some(true);
    Ok(points.map(|own| if is_slide { Course::over_slide(&own) } else { Course::table(&own, turns, smooth) }))
}

/// Checks that the last point lies after the point before it and within the period of the table.
/// Two points with the same input are a jump, which only a table without a spline may have.
fn check_crank(row: &TomlTable, points: &[(f64, f64)], turns: Option<u32>, smooth: bool) -> Result<()> {
    let (&[(first, _), ..], &[.., (last, _)]) = (points, points) else { return Ok(()) };
    let before = |count: usize| points.len().checked_sub(count + 1).map(|index| points[index].0);
    let jumps = before(1) == Some(last);
    if jumps && smooth {
        return Err(row.fault(sentences::A_SPLINE_CANNOT_JUMP).help(sentences::TAKE_LINES_FOR_JUMPS));
    }
    if jumps && before(2) == Some(last) {
        return Err(row.fault(sentences::A_JUMP_HAS_TWO_POINTS).help(sentences::WRITE_THE_POINTS_IN_ASCENDING));
    }
    if !jumps && before(1).is_some_and(|before| !(last > before)) {
        return Err(row.fault(sentences::THE_CRANK_ANGLES_OF_THE_TABLE).help(sentences::WRITE_THE_POINTS_IN_ASCENDING));
    }
    // The margin 1e-12 allows for the rounding of degrees that are converted to radians. The last point of a spline
    // lies before the end of the period. The last point of a table with straight lines may also lie at the end.
    let Some(turns) = turns else { return Ok(()) };
    let (length, period) = (last - first, TAU * f64::from(turns));
    if length > period * (1.0 - 1e-12) && (smooth || length > period * (1.0 + 1e-12)) {
        let message = sentences::the_table_is_longer_than_its_period(&(360 * u64::from(turns)));
        return Err(row.fault(message).help(sentences::A_TABLE_REPEATS_AFTER_A_TURN));
    }
    Ok(())
}

/// Number of crank turns after which a table repeats.
fn period(table: &TomlTable, turns: Option<i64>) -> Result<u32> {
    match turns {
        None => Ok(1),
        Some(turns @ 1..=MOST_TURNS) => Ok(turns as u32),
        Some(other) => {
            let message = sentences::found_but_a_table_repeats(&other, &MOST_TURNS);
            table.refuse("turns", message, sentences::WRITE_FOR_A_FOUR_STROKE_ENGINE)
        }
    }
}

/// A moving link.
fn moving(table: &mut TomlTable, name: &str, mechanism: &Mechanism) -> Result<LinkId> {
    let link = link(table, name, mechanism.links())?;
    if link == GROUND {
        return table.refuse("link", sentences::THE_GROUND_DOES_NOT_MOVE, sentences::NAME_A_MOVING_LINK);
    }
    Ok(link)
}

/// The link called `name`, which must be able to turn.
fn turning(table: &mut TomlTable, name: &str, mechanism: &Mechanism) -> Result<LinkId> {
    let link = link(table, name, mechanism.links())?;
    if link == GROUND {
        return table.refuse("link", sentences::THE_GROUND_DOES_NOT_TURN, sentences::NAME_A_MOVING_LINK);
    }
    // If a link cannot turn, its computed angular velocity is only rounding error. A link that cannot turn is refused,
    // because the rounding error would decide the sense of the moment.
    if !mechanism.can_turn(link) {
        return table.refuse("link", sentences::link_does_not_turn_prismatic(&name), sentences::NAME_A_LINK_THAT_TURNS);
    }
    Ok(link)
}

/// The point under the keys `link` and `point`, which must be on a moving link.
fn loaded_point(table: &mut TomlTable, mechanism: &Mechanism, (name, point): (String, String)) -> Result<JointSide> {
    let link = moving(table, &name, mechanism)?;
    side(table, mechanism, link, &point, "point")
}

fn side(table: &TomlTable, mechanism: &Mechanism, link: LinkId, point: &str, key: &str) -> Result<JointSide> {
    let body = &mechanism.links()[link];
    let found = body.points.iter().find(|found| found.name == point);
    let missing = || -> Error {
        let error = table.wrong(ErrorKind::Input, key, sentences::link_has_no_point(&body.name, &point));
        error.help(suggestion(point, body.points.iter().map(|point| point.name.as_str()), "\""))
    };
    found.map(|found| JointSide { link, local: found.local }).ok_or_else(missing)
}

/// The two links under the key `links`. One of them may be the ground.
fn pair(table: &mut TomlTable, mechanism: &Mechanism, names: &[String]) -> Result<[LinkId; 2]> {
    let [first, second] = names else {
        let message = sentences::found_links_but_this_load(&names.len());
        return table.refuse("links", message, "write `links = [\"ground\", \"rocker\"]`");
    };
    let links = [link(table, first, mechanism.links())?, link(table, second, mechanism.links())?];
    if links[0] == links[1] {
        let message = sentences::it_acts_between_and_itself(&first);
        return table.refuse("links", message, sentences::NAME_TWO_DIFFERENT_LINKS);
    }
    Ok(links)
}

/// Reads `links` and `points`: two links, and one point on each of them.
fn ends(
    table: &mut TomlTable,
    mechanism: &Mechanism,
    (links, points): (Vec<String>, Vec<String>),
) -> Result<[JointSide; 2]> {
    let links = pair(table, mechanism, &links)?;
    let [first, second] = &points[..] else {
        let help = sentences::WRITE_POINTS_A_POINT_OF_THE_FIRST_LINK;
        return table.refuse("points", sentences::found_points_but_this_load(&points.len()), help);
    };
    if first == second {
        let message = sentences::a_joint_holds_the_two_points(&first);
        return table.refuse("points", message, sentences::NAME_TWO_POINTS_THAT_MOVE);
    }
    Ok([side(table, mechanism, links[0], first, "points")?, side(table, mechanism, links[1], second, "points")?])
}
