//! Numbers of other sources against both analytic sides.

use super::figures::Measured;
use crate::compare::{Check, Verdict, magnitudes};
use crate::scenario::{ExpectedCell, FigureValue, Oracle, OracleBasis, OraclePoint, OracleSeries, Scenario, When};
use crate::tolerance::{Basis, Origin, Tolerance};
use linkage::case::{Case, Grid, Wanted};
use linkage::drive::Drive;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::angle::wrapped;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Stage, Trajectory};

/// One check for every series and figure of an oracle and for each analytic side.
/// Series are those of channels of the `scenario`, figures those of the `whole` mechanism.
/// `integration` is the error of a side's integration in a channel, in its unit, for numbers of a motion under forces.
pub(super) fn checks(
    scenario: &Scenario,
    whole: &Scenario,
    sides: [&dyn Solver; 2],
    integration: &dyn Fn(usize, &Channel) -> f64,
) -> Result<Vec<Check>> {
    let mut checks = of_series(scenario, sides, integration)?;
    // Where forces decide the true motion, means over a turn belong to the nominal motion.
    checks.extend(of_figures(&whole.clone().nominal(), sides)?);
    Ok(checks)
}

/// Rounding of an analytic side's number, in units in the last place of the largest number of its quantity. A printed
/// number may have more digits than that.
const ULPS: f64 = 16.0;

/// Both sides' trajectories, and the largest numbers of the quantity of every channel.
struct Solved([(Trajectory, Vec<f64>); 2]);

/// What both sides answer where an oracle's numbers hold.
struct Answers<'a> {
    solvers: [&'a dyn Solver; 2],
    /// In the nominal motion, in the order of crank angles; `None` if no number holds at one.
    nominal: Option<Solved>,
    /// In the motion itself, in the order of times; `None` if no number holds at one.
    timed: Option<Solved>,
    /// Error of a side's integration in a channel of the motion itself.
    integration: &'a dyn Fn(usize, &Channel) -> f64,
}

impl<'a> Answers<'a> {
    fn of(
        case: &Case,
        series: &[&OracleSeries],
        solvers: [&'a dyn Solver; 2],
        integration: &'a dyn Fn(usize, &Channel) -> f64,
    ) -> Result<Self> {
        let stages: Vec<Stage> = series.iter().map(|series| series.channel.kind.stage).collect();
        type At = fn(When) -> Option<f64>;
        type Of = fn(&Drive, Vec<f64>) -> Grid;
        let solved = |case: &Case, at: At, grid: Of| -> Result<Option<Solved>> {
            let mut instants: Vec<f64> = series.iter().flat_map(|series| series.instants()).filter_map(at).collect();
            if instants.is_empty() {
                return Ok(None);
            }
            instants.sort_by(f64::total_cmp);
            instants.dedup();
            let case = case.on(grid(case.crank(), instants))?.wanting(Wanted::of(&stages));
            let of = |solver: &dyn Solver| {
                solver.solve(&case).map(|solved| {
                    let sizes = magnitudes(&solved);
                    (solved, sizes)
                })
            };
            Ok(Some(Solved([of(solvers[0])?, of(solvers[1])?])))
        };
        // Where forces decide the true motion, numbers at crank angles belong to the nominal motion.
        let nominal = solved(&case.nominal(), When::crank, Grid::of_cranks)?;
        Ok(Answers { solvers, nominal, timed: solved(case, When::time, Grid::of_times)?, integration })
    }

    /// The trajectories with an instant, and its row in them.
    fn at(&self, instant: When) -> (&Solved, usize) {
        let (solved, instants, own) = match (instant, &self.nominal, &self.timed) {
            (When::Crank(crank), Some(solved), _) => (solved, solved.0[0].0.cranks(), crank),
            (When::Time(time), _, Some(solved)) => (solved, solved.0[0].0.times(), time),
            (When::Crank(_), None, _) | (When::Time(_), _, None) => unreachable!("solved at every instant"),
        };
        (solved, instants.binary_search_by(|other| other.total_cmp(&own)).expect("solved at this instant"))
    }

    /// A side's value at an instant, and how far it is known.
    fn value(&self, (oracle, series): (&Oracle, &OracleSeries), side: usize, instant: When) -> Result<(f64, f64)> {
        let (Solved(solved), row) = self.at(instant);
        let [value, other] = [side, 1 - side].map(|side| value(oracle, series, &solved[side].0, row));
        let (value, other) = (value?, other?);
        let (own, sizes) = &solved[side];
        let size = own.channels().iter().zip(sizes).find(|(own, _)| **own == series.channel);
        let rounding = ULPS * f64::EPSILON * size.map_or(0.0, |(_, size)| *size);
        let integration = instant.time().map_or(0.0, |_| self.integrated(series, side));
        // No number is known better than both sides agree on it.
        Ok((value, rounding + integration + 2.0 * (value - other).abs()))
    }

    fn integrated(&self, series: &OracleSeries, side: usize) -> f64 {
        let of = |channel: &Channel| (self.integration)(side, channel);
        of(&series.channel) + series.y().map_or(0.0, |y| of(&y))
    }
}

fn of_series(
    scenario: &Scenario,
    solvers: [&dyn Solver; 2],
    integration: &dyn Fn(usize, &Channel) -> f64,
) -> Result<Vec<Check>> {
    let all = || scenario.oracles.iter().flat_map(|oracle| oracle.series.iter().map(move |series| (oracle, series)));
    let series: Vec<&OracleSeries> = all().map(|(_, series)| series).collect();
    let answers = Answers::of(&scenario.case, &series, solvers, integration)?;
    let mut checks = Vec::new();
    for side in 0..2 {
        for (oracle, series) in all() {
            checks.extend(of_one(oracle, series, &answers, side)?);
        }
    }
    Ok(checks)
}

/// The checks of one series: one for all correct values together, and one for each value that is known to be wrong. If
/// all values are known to be wrong, they have one check together.
fn of_one(oracle: &Oracle, series: &OracleSeries, answers: &Answers, side: usize) -> Result<Vec<Check>> {
    let against = |family: &str, point: &OraclePoint, origin: Origin| -> Result<Check> {
        let (value, known) = answers.value((oracle, series), side, point.at)?;
        let difference = value - point.value;
        let deviation = if series.channel.kind.periodic { wrapped(difference) } else { difference }.abs();
        let bound = match point.at {
            When::Crank(_) => point.bound.larger(known),
            // The error of an integration is no rounding: it adds to that of the printed number.
            When::Time(_) => point.bound + known,
        };
        let tolerance = tolerance(oracle, origin, bound, point.digits);
        let check = Check::new(family, deviation, tolerance, series.channel.kind.unit.symbol());
        Ok(check.located(|| format!("at {}", point.at)))
    };
    let [family, wrong] = [false, true].map(|wrong| family(oracle, wrong, answers.solvers[side].name()));
    let corrected = |cell: &ExpectedCell| -> Result<Check> {
        let printed = against(&wrong, &cell.point, origin(oracle))?;
        Ok(against(&wrong, &cell.right, Origin::Recomputed)?.expected(&cell.finding, &printed))
    };
    // Each cell has its own bound: the worst cell is the one that uses the largest share of it.
    let all = series.points.iter().map(|point| Ok(against(&family, point, origin(oracle))?.of(&series.name)));
    let all: Vec<Check> = all.collect::<Result<_>>()?;
    let mut checks: Vec<Check> = all.into_iter().max_by(|a, b| a.used().total_cmp(&b.used())).into_iter().collect();
    for cell in &series.expected {
        checks.push(corrected(cell)?.of(format!("{} at {}", series.name, shortly(cell.point.at))));
    }
    if let Some((_, cells)) = &series.wrong {
        let column: Vec<Check> = cells.iter().map(corrected).collect::<Result<_>>()?;
        checks.extend(worst_of(column.into_iter()).map(|check| check.of(&series.name)));
    }
    Ok(checks)
}

fn shortly(at: When) -> String {
    match at {
        When::Crank(crank) => format!("{:.1} deg", crank.to_degrees()),
        When::Time(_) => at.to_string(),
    }
}

/// The worst check of printed numbers that are all known to be wrong: the first that is not as expected, else the one
/// that uses the largest share of its bound.
fn worst_of(checks: impl Iterator<Item = Check>) -> Option<Check> {
    let rank = |check: &Check| (!matches!(check.verdict, Verdict::Expected { .. }), check.used());
    checks.reduce(|worst, check| {
        let ((wrong, used), (other_wrong, other_used)) = (rank(&worst), rank(&check));
        if (other_wrong && !wrong) || (other_wrong == wrong && other_used > used) { check } else { worst }
    })
}

/// Bound of a number: half a unit of its last digit, plus the known error of the number, but never less than what the
/// analytic sides know.
fn tolerance(oracle: &Oracle, origin: Origin, bound: f64, digits: i32) -> Tolerance {
    Tolerance { bound, basis: Basis::Digits { origin, digits, source: oracle.source.clone() } }
}

/// How the numbers of an oracle are known.
fn origin(oracle: &Oracle) -> Origin {
    match oracle.basis {
        OracleBasis::Published => Origin::Published,
        OracleBasis::Recomputed => Origin::Recomputed,
        OracleBasis::Derived => Origin::Derived,
    }
}

/// Value of a series' channel in a row, or the magnitude of its vector.
fn value(oracle: &Oracle, series: &OracleSeries, solved: &Trajectory, row: usize) -> Result<f64> {
    let named = |channel: &Channel| {
        solved.column(channel).map(|column| column[row]).ok_or_else(|| {
            Error::new(ErrorKind::Input, format!("oracle {}: there is no channel {channel}", oracle.name))
                .help("name a link, point or joint of this scenario")
        })
    };
    let x = named(&series.channel)?;
    Ok(match series.y() {
        None => x,
        Some(y) => x.hypot(named(&y)?),
    })
}

fn of_figures(scenario: &Scenario, solvers: [&dyn Solver; 2]) -> Result<Vec<Check>> {
    let all = || scenario.oracles.iter().flat_map(|oracle| oracle.figures.iter().map(move |figure| (oracle, figure)));
    let mut values = [Vec::new(), Vec::new()];
    for (values, solver) in values.iter_mut().zip(solvers) {
        let mut measured = Measured::of(scenario, solver);
        for (_, figure) in all() {
            values.push(measured.value(figure.figure)?);
        }
    }
    let mut checks = Vec::new();
    for (side, solver) in solvers.into_iter().enumerate() {
        for (index, (oracle, figure)) in all().enumerate() {
            let [value, other] = [values[side][index], values[1 - side][index]];
            let known = ULPS * f64::EPSILON * value.abs() + 2.0 * (value - other).abs();
            let (family, unit) = (family(oracle, figure.wrong.is_some(), solver.name()), figure.figure.unit());
            let against = |number: &FigureValue, origin: Origin| {
                let tolerance = tolerance(oracle, origin, number.bound.larger(known), number.digits);
                Check::new(family.as_str(), (value - number.value).abs(), tolerance, unit)
                    .of(&figure.name)
                    .located(|| format!("given {} {unit}, found {value:.10}", number.value))
            };
            let printed = against(&figure.printed, origin(oracle));
            checks.push(match &figure.wrong {
                Some((finding, right)) => against(right, Origin::Recomputed).expected(finding, &printed),
                None => printed,
            });
        }
    }
    Ok(checks)
}

/// Heading of the checks of an oracle.
fn family(oracle: &Oracle, wrong: bool, side: &str) -> String {
    let known = if wrong { ", known to be wrong" } else { "" };
    format!("{} {}{known} ({side})", origin(oracle).word(), oracle.name)
}
