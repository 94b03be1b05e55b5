//! `[[loads]]`: forces, moments, springs and dampers.

use super::joints::link;
use super::keys::key::{Kind, Section, needed, optional};
use super::reader::{Faults, Sign, Table};
use super::unit::{ANGLE, DAMPING, FORCE, Family, LENGTH, MOMENT, MOMENT_PER_SPEED, STIFFNESS, TORSIONAL_STIFFNESS};
use super::words::{Words, names, suggestion};
use linkage::drive::{Acts, Course, Load, LoadSort};
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::{GROUND, LinkId, Mechanism, Side};
use std::f64::consts::TAU;

const ACTS: Words<Acts> =
    &[("always", Acts::Always), ("counter-clockwise", Acts::CounterClockwise), ("clockwise", Acts::Clockwise)];

/// Whether a force turns with its link.
const FRAMES: Words<bool> = &[("world", false), ("link", true)];

/// Whether a table is a curve without kinks.
const INTERPOLATIONS: Words<bool> = &[("linear", false), ("smooth", true)];

/// What is told of the keys that are read here.
pub const SECTIONS: &[Section] = &[
    Section {
        path: "loads",
        keys: &[
            needed("type", Kind::Choice(|| LoadSort::ALL.iter().map(|sort| sort.name()).collect()), "kind of load"),
            optional("link", Kind::Text, "the loaded link", "required by the type"),
            optional("point", Kind::Text, "the loaded point of that link", "required by the type"),
            optional(
                "links",
                Kind::Texts,
                "the two links that a spring or damper joins; one may be `\"ground\"`",
                "required by the type",
            ),
            optional("points", Kind::Texts, "a point of each of them", "required by the type"),
            optional(
                "moment",
                Kind::MOMENTS,
                "moment, counter-clockwise positive; of a resistance its size, not negative",
                "required by the type, or a table",
            ),
            optional(
                "acts",
                Kind::Choice(|| names(ACTS)),
                "of a moment: the sense of rotation of the link in which it acts",
                "`\"always\"`",
            ),
            optional("x", Kind::FORCES, "force along x", "required by the type, or a table"),
            optional("y", Kind::FORCES, "force along y", "required by the type, or a table"),
            optional(
                "frame",
                Kind::Choice(|| names(FRAMES)),
                "axes of a force: those of the world, or of the link, turning with it",
                "`\"world\"`",
            ),
            optional(
                "force",
                Kind::FORCES,
                "size of a force against the motion of the point, not negative",
                "required by the type",
            ),
            optional(
                "stiffness",
                Kind::STIFFNESSES_OR_TORSIONAL,
                "stiffness of a spring, not negative",
                "required by the type",
            ),
            optional(
                "free_length",
                Kind::LENGTHS,
                "length of the spring without force, not negative",
                "required by the type",
            ),
            optional("free_angle", Kind::ANGLES, "twist of the spring without moment", "required by the type"),
            optional("damping", Kind::DAMPINGS_OR_SLOPES, "damping, not negative", "required by the type"),
            optional(
                "table",
                Kind::Tables,
                "the load over the crank angle: crank angles ascending, within one period",
                "the constants",
            ),
            optional(
                "interpolation",
                Kind::Choice(|| names(INTERPOLATIONS)),
                "of the table: straight lines, which do not overshoot, or a periodic cubic spline with continuous second derivatives",
                "`\"linear\"`",
            ),
            optional(
                "turns",
                Kind::Integer,
                "turns of the crank after which the table repeats; 2 for a four-stroke engine",
                "1",
            ),
        ],
    },
    Section {
        path: "loads.table",
        keys: &[
            needed("crank", Kind::INPUTS, "crank angle"),
            optional("moment", Kind::MOMENTS, "moment there", "of a moment"),
            optional("x", Kind::FORCES, "force along x there", "of a force"),
            optional("y", Kind::FORCES, "force along y there", "of a force"),
        ],
    },
];

/// Reads the keys of a load.
type Reader = fn(&mut Table, &Mechanism) -> Result<Load>;

fn reader(sort: LoadSort) -> Reader {
    match sort {
        LoadSort::Resistance => resistance,
        LoadSort::Moment => moment,
        LoadSort::Force => force,
        LoadSort::ResistingForce => resisting_force,
        LoadSort::Spring => spring,
        LoadSort::Damper => damper,
        LoadSort::TorsionSpring => torsion_spring,
        LoadSort::TorsionDamper => torsion_damper,
    }
}

/// Largest number of crank turns after which a table may repeat.
const MOST_TURNS: i64 = 1000;

/// The loads, but those with mistakes.
pub fn read(tables: Vec<Table>, mechanism: &Mechanism, faults: &mut Faults) -> Vec<Load> {
    tables.into_iter().filter_map(|mut table| faults.read(&mut table, |table| load(table, mechanism))).collect()
}

fn load(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let sorts: Vec<_> = LoadSort::ALL.iter().map(|&sort| (sort.name(), sort)).collect();
    let sort = table.choice("type", "is no type of load", &sorts)?;
    let load = reader(sort)(table, mechanism)?;
    table.finish()?;
    Ok(load)
}

fn resistance(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let name = table.string("link")?;
    let moment = table.quantity("moment", &MOMENT, Sign::NotNegative)?;
    Ok(Load::Resistance { link: turning(table, &name, mechanism)?, moment })
}

fn moment(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let name = table.string("link")?;
    let [moment] = courses(table, ["moment"], &MOMENT)?;
    let acts = table.optional_choice("acts", "does not say when the moment acts", ACTS)?.unwrap_or(Acts::Always);
    let link = match acts {
        Acts::Always => moving(table, &name, mechanism)?,
        Acts::CounterClockwise | Acts::Clockwise => turning(table, &name, mechanism)?,
    };
    Ok(Load::Moment { link, moment, acts })
}

fn force(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let point = (table.string("link")?, table.string("point")?);
    let force = courses(table, ["x", "y"], &FORCE)?;
    let follows = table.optional_choice("frame", "is no frame of a force", FRAMES)?.unwrap_or(false);
    let at = loaded_point(table, mechanism, point)?;
    Ok(Load::Force { at, force, follows })
}

fn resisting_force(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let point = (table.string("link")?, table.string("point")?);
    let force = table.quantity("force", &FORCE, Sign::NotNegative)?;
    let at = loaded_point(table, mechanism, point)?;
    // The velocity of such a point would be the rounding of zero, and so would the direction of the force.
    let mut pins = mechanism.joints().iter().filter(|joint| joint.is_pin() && joint.on(GROUND).is_some());
    if pins.any(|joint| joint.on(at.link) == Some(at.local)) {
        let message = "the point does not move: it is hinged to the ground";
        return Err(table.wrong(ErrorKind::Input, "point", message).help("name a point that moves"));
    }
    Ok(Load::ResistingForce { at, force })
}

fn spring(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let named = (table.strings("links")?, table.strings("points")?);
    let stiffness = table.quantity("stiffness", &STIFFNESS, Sign::NotNegative)?;
    let free_length = table.quantity("free_length", &LENGTH, Sign::NotNegative)?;
    Ok(Load::Spring { ends: ends(table, mechanism, named)?, stiffness, free_length })
}

fn damper(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let named = (table.strings("links")?, table.strings("points")?);
    let damping = table.quantity("damping", &DAMPING, Sign::NotNegative)?;
    Ok(Load::Damper { ends: ends(table, mechanism, named)?, damping })
}

fn torsion_spring(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let names = table.strings("links")?;
    let stiffness = table.quantity("stiffness", &TORSIONAL_STIFFNESS, Sign::NotNegative)?;
    let free_angle = table.quantity("free_angle", &ANGLE, Sign::Any)?;
    Ok(Load::TorsionSpring { links: pair(table, mechanism, &names)?, stiffness, free_angle })
}

fn torsion_damper(table: &mut Table, mechanism: &Mechanism) -> Result<Load> {
    let names = table.strings("links")?;
    let damping = table.quantity("damping", &MOMENT_PER_SPEED, Sign::NotNegative)?;
    Ok(Load::TorsionDamper { links: pair(table, mechanism, &names)?, damping })
}

/// Quantities of one family: constants, or columns of a table over the crank angle.
fn courses<const N: usize>(table: &mut Table, names: [&str; N], family: &'static Family) -> Result<[Course; N]> {
    let rows = table.tables("table")?;
    let constants = names.map(|name| table.optional_quantity(name, family, Sign::Any));
    let smooth = table.optional_choice("interpolation", "is no interpolation", INTERPOLATIONS)?;
    let turns = table.optional_integer("turns")?;
    if !table.has("table") {
        for (key, is_given) in [("interpolation", smooth.is_some()), ("turns", turns.is_some())] {
            if is_given {
                let message = "this belongs to a table over the crank angle, but there is none";
                return Err(table.wrong(ErrorKind::Input, key, message).help("add `table`, or leave the key out"));
            }
        }
        let mut found = [0.0; N];
        for ((value, constant), name) in found.iter_mut().zip(constants).zip(names) {
            *value = match constant? {
                Some(constant) => constant,
                None => table.quantity(name, family, Sign::Any)?,
            };
        }
        return Ok(found.map(Course::Constant));
    }
    for (constant, name) in constants.into_iter().zip(names) {
        if constant?.is_some() {
            let error = table.wrong(ErrorKind::Input, name, format!("`{name}` and `table` are both given"));
            return Err(error.help("keep one of the two"));
        }
    }
    let mut points: [Vec<(f64, f64)>; N] = names.map(|_| Vec::new());
    let (smooth, turns) = (smooth.unwrap_or(false), period(table, turns)?);
    for mut row in rows {
        let read = row.read(|row| {
            let crank = row.quantity("crank", &ANGLE, Sign::Any)?;
            for (name, points) in names.into_iter().zip(&mut points) {
                points.push((crank, row.quantity(name, family, Sign::Any)?));
            }
            row.finish()
        });
        read?;
        check_crank(&row, &points[0], turns)?;
    }
    if points[0].is_empty() {
        let error = table.wrong(ErrorKind::Input, "table", "a table over the crank angle needs a point or more");
        return Err(error.help("write a constant, or add points"));
    }
    Ok(points.map(|points| Course::table(&points, turns, smooth)))
}

/// Checks that the last point is after the one before it, and within the table's period.
fn check_crank(row: &Table, points: &[(f64, f64)], turns: u32) -> Result<()> {
    let (&[(first, _), ..], &[.., (last, _)]) = (points, points) else { return Ok(()) };
    let before = points.len().checked_sub(2).map(|index| points[index].0);
    if before.is_some_and(|before| !(last > before)) {
        let message = "the crank angles of the table do not ascend";
        return Err(row.fault(message).help("write the points in ascending order of the crank angle, each angle once"));
    }
    // The rounding of degrees into radians must not move a point at the end of the period into the next period.
    if last - first > TAU * f64::from(turns) * (1.0 - 1e-12) {
        let message = format!("the table is longer than its period, {} deg", 360 * u64::from(turns));
        return Err(row.fault(message).help(
            "a table repeats after a turn, or after `turns` of them: leave out its last point if it repeats the first",
        ));
    }
    Ok(())
}

/// Turns of the crank after which a table repeats.
fn period(table: &Table, turns: Option<i64>) -> Result<u32> {
    match turns {
        None => Ok(1),
        Some(turns @ 1..=MOST_TURNS) => Ok(turns as u32),
        Some(other) => {
            let message = format!("found {other}, but a table repeats after 1 to {MOST_TURNS} turns of the crank");
            Err(table
                .wrong(ErrorKind::Input, "turns", message)
                .help("write 2 for a four-stroke engine, else leave it out"))
        }
    }
}

/// A moving link.
fn moving(table: &mut Table, name: &str, mechanism: &Mechanism) -> Result<LinkId> {
    let link = link(table, name, mechanism.links())?;
    if link == GROUND {
        let error = table.wrong(ErrorKind::Input, "link", "the ground does not move, and bears any load");
        return Err(error.help("name a moving link"));
    }
    Ok(link)
}

/// A link that can turn.
fn turning(table: &mut Table, name: &str, mechanism: &Mechanism) -> Result<LinkId> {
    let link = link(table, name, mechanism.links())?;
    if link == GROUND {
        return Err(table.wrong(ErrorKind::Input, "link", "the ground does not turn").help("name a moving link"));
    }
    // The angular velocity of such a link would be the rounding of zero, and so would the sense of the moment.
    if !mechanism.can_turn(link) {
        let message = format!("link \"{name}\" does not turn: prismatic joints alone connect it with the ground");
        return Err(table.wrong(ErrorKind::Input, "link", message).help("name a link that turns"));
    }
    Ok(link)
}

/// `link` and `point`: a point of a moving link.
fn loaded_point(table: &mut Table, mechanism: &Mechanism, (name, point): (String, String)) -> Result<Side> {
    let link = moving(table, &name, mechanism)?;
    side(table, mechanism, link, &point, "point")
}

fn side(table: &Table, mechanism: &Mechanism, link: LinkId, point: &str, key: &str) -> Result<Side> {
    let body = &mechanism.links()[link];
    let found = body.points.iter().find(|found| found.name == point);
    let missing = || -> Error {
        let error = table.wrong(ErrorKind::Input, key, format!("link \"{}\" has no point \"{point}\"", body.name));
        error.help(suggestion(point, body.points.iter().map(|point| point.name.as_str()), "\""))
    };
    found.map(|found| Side { link, local: found.local }).ok_or_else(missing)
}

/// `links`: two links, either of which may be the ground.
fn pair(table: &mut Table, mechanism: &Mechanism, names: &[String]) -> Result<[LinkId; 2]> {
    let [first, second] = names else {
        let message = format!("found {} links, but this load acts between two", names.len());
        return Err(table.wrong(ErrorKind::Input, "links", message).help("write `links = [\"ground\", \"rocker\"]`"));
    };
    let links = [link(table, first, mechanism.links())?, link(table, second, mechanism.links())?];
    if links[0] == links[1] {
        let message = format!("it acts between \"{first}\" and itself");
        return Err(table.wrong(ErrorKind::Input, "links", message).help("name two different links"));
    }
    Ok(links)
}

/// `links` and `points`: a point of either link.
fn ends(table: &mut Table, mechanism: &Mechanism, (links, points): (Vec<String>, Vec<String>)) -> Result<[Side; 2]> {
    let links = pair(table, mechanism, &links)?;
    let [first, second] = &points[..] else {
        let message = format!("found {} points, but this load acts between two", points.len());
        let help = "write `points = [\"S\", \"B\"]`: a point of the first link and one of the second";
        return Err(table.wrong(ErrorKind::Input, "points", message).help(help));
    };
    if first == second {
        let message = format!("a joint holds the two points \"{first}\" together");
        return Err(table.wrong(ErrorKind::Input, "points", message).help("name two points that move apart"));
    }
    Ok([side(table, mechanism, links[0], first, "points")?, side(table, mechanism, links[1], second, "points")?])
}
