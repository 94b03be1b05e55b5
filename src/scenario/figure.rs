//! Published figures of a mechanism: what it is made of, and what it comes to over a turn.

use super::joints::link;
use super::oracle::number;
use super::reader::Table;
use super::unit::{LENGTH, Unit};
use super::words::suggestion;
use linkage::case::Case;
use linkage::error::{ErrorKind, Result};
use linkage::mechanism::{GROUND, Side};

/// One published figure.
#[derive(Clone, Debug, PartialEq)]
pub struct OracleFigure {
    /// Which figure.
    pub figure: Figure,
    /// Its name in reports: that in scenario files, and of what.
    pub name: String,
    /// Value in the figure's SI unit.
    pub value: f64,
    /// Half a unit of the last printed digit, in the figure's SI unit.
    pub bound: f64,
    /// Number of printed decimals.
    pub digits: i32,
    /// Finding that says why the figure is wrong; it must not be reproduced.
    pub finding: Option<String>,
}

/// A figure of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Figure {
    /// Mean over the turn of the moment of inertia reduced to the crank (kg m^2).
    ReducedInertiaMean,
    /// Mean over the turn of the moment of resistance reduced to the crank (N m).
    ReducedResistanceMean,
    /// Speed of the crank (rad/s) at which the motor's moment on it is the mean resistance.
    SteadyCrankSpeed,
    /// Speed of the motor (rad/s) then.
    SteadyMotorSpeed,
    /// Distance between two points at t = 0 (m).
    Distance([Side; 2]),
    /// Mass of a link (kg).
    Mass(usize),
    /// Moment of inertia of a link about its mass centre (kg m^2).
    Inertia(usize),
}

impl Figure {
    /// SI unit.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Figure::ReducedInertiaMean | Figure::Inertia(_) => "kg m^2",
            Figure::ReducedResistanceMean => "N m",
            Figure::SteadyCrankSpeed | Figure::SteadyMotorSpeed => "rad/s",
            Figure::Distance(_) => "m",
            Figure::Mass(_) => "kg",
        }
    }
}

/// How a figure is read that carries a name in scenario files.
type Reader = fn(&mut Table, &Case) -> Result<(Figure, String)>;

/// Every figure: its name in scenario files, unit included, and its reader.
const FIGURES: [(&str, Reader); 8] = [
    ("reduced_inertia_mean_kg_m2", |_, _| Ok((Figure::ReducedInertiaMean, String::new()))),
    ("reduced_resistance_mean_N_m", |_, _| Ok((Figure::ReducedResistanceMean, String::new()))),
    ("steady_crank_speed_rad_s", |entry, case| with_motor(entry, case, Figure::SteadyCrankSpeed)),
    ("steady_motor_speed_rad_s", |entry, case| with_motor(entry, case, Figure::SteadyMotorSpeed)),
    ("distance_m", distance),
    ("distance_mm", distance),
    ("mass_kg", |entry, case| of_link(entry, case, Figure::Mass)),
    ("inertia_kg_m2", |entry, case| of_link(entry, case, Figure::Inertia)),
];

/// The figures of an oracle.
pub(super) fn read(table: &mut Table, case: &Case) -> Result<Vec<OracleFigure>> {
    let mut figures = Vec::new();
    for mut entry in table.tables("figures")? {
        let name = entry.string("figure")?;
        let Some((_, reader)) = FIGURES.iter().find(|(known, _)| *known == name) else {
            let error = entry.wrong(ErrorKind::Input, "figure", format!("there is no figure \"{name}\""));
            return Err(error.help(suggestion(&name, FIGURES.map(|(known, _)| known), "\"")));
        };
        let (figure, of) = reader(&mut entry, case)?;
        let printed = number(&mut entry)?;
        let finding = entry.optional_string("finding")?;
        entry.finish()?;
        let unit = LENGTH.unit_of("distance", &name);
        let si = |value: f64| unit.map_or(value, |unit: &Unit| unit.to_si(value));
        let (value, bound) = (si(printed.value), si(printed.half_unit()));
        let name = if of.is_empty() { name } else { format!("{name} of {of}") };
        figures.push(OracleFigure { figure, name, value, bound, digits: printed.digits, finding });
    }
    if figures.is_empty() {
        let names = suggestion("", FIGURES.map(|(known, _)| known), "\"");
        return Err(table.wrong(ErrorKind::Input, "figures", "there is no figure").help(names));
    }
    Ok(figures)
}

fn with_motor(entry: &mut Table, case: &Case, figure: Figure) -> Result<(Figure, String)> {
    match case.crank().motor() {
        Some(_) => Ok((figure, String::new())),
        None => Err(entry
            .wrong(ErrorKind::Input, "figure", "a steady speed needs a motor, and the scenario has none")
            .help("add a `[motor]` section: its law, and the ratio of the reducer")),
    }
}

fn distance(entry: &mut Table, case: &Case) -> Result<(Figure, String)> {
    let names = entry.strings("points")?;
    let [first, second] = names.as_slice() else {
        let message = format!("a distance lies between two points, found {}", names.len());
        return Err(entry.wrong(ErrorKind::Input, "points", message).help("write `points = [\"A\", \"B\"]`"));
    };
    let ends = [place(entry, case, first)?, place(entry, case, second)?];
    Ok((Figure::Distance(ends), names.join(" ")))
}

/// The point called `name` on the first link that has it.
fn place(entry: &Table, case: &Case, name: &str) -> Result<Side> {
    let links = || case.mechanism.links().iter().enumerate();
    let on = |(link, body): (usize, &linkage::mechanism::Link)| {
        let point = body.points.iter().find(|point| point.name == name)?;
        Some(Side { link, local: point.local })
    };
    links().find_map(on).ok_or_else(|| {
        let names = links().flat_map(|(_, body)| body.points.iter().map(|point| point.name.as_str()));
        let error = entry.wrong(ErrorKind::Input, "points", format!("the mechanism has no point \"{name}\""));
        error.help(suggestion(name, names, "\""))
    })
}

fn of_link(entry: &mut Table, case: &Case, figure: fn(usize) -> Figure) -> Result<(Figure, String)> {
    let name = entry.string("link")?;
    let found = link(entry, &name, case.mechanism.links())?;
    if found == GROUND {
        return Err(entry.wrong(ErrorKind::Input, "link", "the ground has no mass").help("name a moving link"));
    }
    Ok((figure(found), name))
}
