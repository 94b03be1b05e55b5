//! Figures of a mechanism: lengths between points, and quantities over a turn of the crank.

use super::printed::{Correction, Printed, number};
use super::reader::TomlTable;
use super::unit::{LENGTH, NamedUnit};
use super::words::suggestion;
use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::mechanism::{JointSide, LinkId};

/// One figure with its expected number.
#[derive(Clone, Debug, PartialEq)]
pub struct OracleFigure {
    /// Which figure.
    pub figure: MechanismFigure,
    /// Name in reports: the figure's name in scenario files, and its points or subject.
    pub name: String,
    /// The number as printed.
    pub printed: FigureValue,
    /// For a number known to be wrong: the finding that explains the error, and the correct number.
    pub wrong: Option<(String, FigureValue)>,
}

/// A number with which a figure is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureValue {
    /// Value in the figure's SI unit.
    pub value: f64,
    /// Half a unit of the last digit, in the figure's SI unit.
    pub bound: f64,
    /// Number of decimals.
    pub digits: i32,
}

/// A figure of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MechanismFigure {
    /// Mean over a turn of the crank of the moment of inertia reduced to the crank (kg m^2).
    ReducedInertiaMean,
    /// Mean over a turn of the crank of the moment of resistance reduced to the crank (N m).
    ReducedResistanceMean,
    /// Speed of the crank (rad/s) at which the motor's moment on the crank equals the mean resistance.
    SteadyCrankSpeed,
    /// Speed of the motor (rad/s) at the steady crank speed.
    SteadyMotorSpeed,
    /// Distance between two points at t = 0 (m).
    Distance([JointSide; 2]),
}

impl MechanismFigure {
    /// SI unit.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            MechanismFigure::ReducedInertiaMean => "kg m^2",
            MechanismFigure::ReducedResistanceMean => "N m",
            MechanismFigure::SteadyCrankSpeed | MechanismFigure::SteadyMotorSpeed => "rad/s",
            MechanismFigure::Distance(_) => "m",
        }
    }
}

/// Figures of the whole mechanism: their names in scenario files, unit included.
const OF_MECHANISM: [(&str, MechanismFigure); 4] = [
    ("reduced_inertia_mean_kg_m2", MechanismFigure::ReducedInertiaMean),
    ("reduced_resistance_mean_N_m", MechanismFigure::ReducedResistanceMean),
    ("steady_crank_speed_rad_s", MechanismFigure::SteadyCrankSpeed),
    ("steady_motor_speed_rad_s", MechanismFigure::SteadyMotorSpeed),
];

/// Names of the figures between two points.
const OF_POINTS: [&str; 2] = ["distance_m", "distance_mm"];

/// Prefix of a figure's name in a claim.
const CLAIMED: &str = "figure.";

impl MechanismFigure {
    /// The names of all figures that a formula may claim.
    pub(super) fn claims() -> impl Iterator<Item = String> {
        OF_MECHANISM.iter().map(|(name, _)| format!("{CLAIMED}{name}"))
    }

    /// The figure that a claim names; `None` if the name is not that of a figure.
    ///
    /// # Errors
    /// Message and help, if the case lacks data that the figure needs.
    pub(super) fn claimed(name: &str, case: &Case) -> Option<std::result::Result<MechanismFigure, (String, String)>> {
        let name = name.strip_prefix(CLAIMED)?;
        let (_, figure) = OF_MECHANISM.iter().find(|(own, _)| *own == name)?;
        Some(figure.lacks(case).map_or(Ok(*figure), |(message, help)| Err((message.into(), help.into()))))
    }

    /// Message and help, if the figure needs data that the case lacks.
    fn lacks(self, case: &Case) -> Option<(&'static str, &'static str)> {
        match self {
            MechanismFigure::SteadyCrankSpeed | MechanismFigure::SteadyMotorSpeed if case.crank().motor().is_none() => {
                Some((sentences::A_STEADY_SPEED_NEEDS_A_MOTOR, sentences::ADD_A_MOTOR_SECTION_ITS_LAW))
            }
            MechanismFigure::SteadyCrankSpeed | MechanismFigure::SteadyMotorSpeed => None,
            MechanismFigure::ReducedInertiaMean
            | MechanismFigure::ReducedResistanceMean
            | MechanismFigure::Distance(_) => None,
        }
    }
}

/// The figures of an oracle.
pub(super) fn read(table: &mut TomlTable, case: &Case) -> Result<Vec<OracleFigure>> {
    let mut figures = Vec::new();
    for mut entry in table.tables("figures")? {
        let figure = entry.read(|entry| one(entry, case)).map(Some);
        figures.extend(table.part(figure));
    }
    if figures.is_empty() {
        let names = suggestion("", names(), "\"");
        return table.refuse("figures", sentences::THERE_IS_NO_FIGURE_2, names);
    }
    Ok(figures)
}

fn one(entry: &mut TomlTable, case: &Case) -> Result<OracleFigure> {
    let name = entry.string("figure")?;
    let (figure, of) = match OF_MECHANISM.iter().find(|(known, _)| *known == name) {
        Some((_, figure)) => (*figure, String::new()),
        None if OF_POINTS.contains(&name.as_str()) => distance(entry, case)?,
        None => {
            return entry.refuse("figure", sentences::there_is_no_figure(&name), suggestion(&name, names(), "\""));
        }
    };
    if let Some((message, help)) = figure.lacks(case) {
        return entry.refuse("figure", message, help);
    }
    let printed = number(entry)?;
    let correction = Correction::read(entry, &printed)?;
    entry.finish()?;
    let unit = LENGTH.unit_of("distance", &name);
    let si = |value: f64| unit.map_or(value, |unit: &NamedUnit| unit.to_si(value));
    let of_number =
        |number: &Printed| FigureValue { value: si(number.value), bound: si(number.half_unit), digits: number.digits };
    let name = if of.is_empty() { name } else { format!("{name} of {of}") };
    let wrong = correction.map(|Correction { finding, right }| (finding, of_number(&right)));
    Ok(OracleFigure { figure, name, printed: of_number(&printed), wrong })
}

fn names() -> impl Iterator<Item = &'static str> {
    OF_MECHANISM.into_iter().map(|(name, _)| name).chain(OF_POINTS)
}

fn distance(entry: &mut TomlTable, case: &Case) -> Result<(MechanismFigure, String)> {
    let names = entry.strings("points")?;
    let [first, second] = names.as_slice() else {
        let message = sentences::a_distance_lies_between_two(&names.len());
        return entry.refuse("points", message, "write `points = [\"A\", \"B\"]`");
    };
    let places = [places(entry, case, first)?, places(entry, case, second)?];
    // The distance between two points of one link follows from the coordinates in the file and tests no pose.
    // The two points are therefore taken on different links: their distance then results from the solved pose, not
    // from the file alone.
    let has = |link: LinkId, of: &[JointSide]| of.iter().any(|side| side.link == link);
    let measured = |this: usize| places[this].iter().find(|side| !has(side.link, &places[1 - this])).copied();
    let (Some(first), Some(second)) = (measured(0), measured(1)) else {
        let help = sentences::NAME_POINTS_WHOSE_DISTANCE_FOLLOWS;
        return entry.refuse("points", sentences::the_distance_of_stands_in_the_file(&names.join(" and ")), help);
    };
    Ok((MechanismFigure::Distance([first, second]), names.join(" ")))
}

/// The point called `name` on every link that has this point.
fn places(entry: &TomlTable, case: &Case, name: &str) -> Result<Vec<JointSide>> {
    let links = || case.mechanism.links().entries();
    let on = |(link, body): (LinkId, &linkage::mechanism::Link)| {
        let point = body.points.iter().find(|point| point.name == name)?;
        Some(JointSide { link, local: point.local })
    };
    let places: Vec<JointSide> = links().filter_map(on).collect();
    if places.is_empty() {
        let names = links().flat_map(|(_, body)| body.points.iter().map(|point| point.name.as_str()));
        return entry.refuse("points", sentences::the_mechanism_has_no_point(&name), suggestion(name, names, "\""));
    }
    Ok(places)
}
