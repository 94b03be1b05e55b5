//! Numbers of other sources against both analytic sides.

use crate::compare::{Check, Verdict, magnitudes};
use crate::scenario::{ExpectedCell, Figure, FigureValue, Oracle, OracleBasis, OraclePoint, OracleSeries, Scenario};
use crate::tolerance::{Basis, Origin, Tolerance};
use analytic::reduced::means::{self as reduced, Means};
use linkage::case::{Grid, Wanted};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::angle::wrapped;
use linkage::mechanism::Side;
use linkage::solver::{Solver, State};
use linkage::trajectory::{Channel, Stage, Trajectory};

/// One check for every series and figure of an oracle and for each analytic side.
/// Series are those of channels of the `scenario`, figures those of the `whole` mechanism.
pub(super) fn checks(scenario: &Scenario, whole: &Scenario, sides: [&dyn Solver; 2]) -> Result<Vec<Check>> {
    // Where forces decide the true motion, numbers at crank angles belong to the nominal motion.
    let nominal = |scenario: &Scenario| scenario.clone().nominal();
    let mut checks = of_series(&nominal(scenario), sides)?;
    checks.extend(of_figures(&nominal(whole), sides)?);
    Ok(checks)
}

/// Rounding of an analytic side's number, in units in the last place of the largest number of its quantity. A printed
/// number may have more digits than that.
const ULPS: f64 = 16.0;

fn of_series(scenario: &Scenario, [first, second]: [&dyn Solver; 2]) -> Result<Vec<Check>> {
    let all = || scenario.oracles.iter().flat_map(|oracle| oracle.series.iter().map(move |series| (oracle, series)));
    let points = |series: &OracleSeries| {
        let wrong = series.wrong.iter().flat_map(|(_, cells)| cells);
        let cells = series.expected.iter().chain(wrong).map(|cell| cell.point.crank);
        series.points.iter().map(|point| point.crank).chain(cells).collect::<Vec<f64>>()
    };
    let mut cranks: Vec<f64> = all().flat_map(|(_, series)| points(series)).collect();
    if cranks.is_empty() {
        return Ok(Vec::new());
    }
    cranks.sort_by(f64::total_cmp);
    cranks.dedup();
    let stages: Vec<Stage> = all().map(|(_, series)| series.channel.kind.stage).collect();
    let base = &scenario.case;
    let case = base.on(Grid::of_cranks(base.crank(), cranks))?.wanting(Wanted::of(&stages));
    let solved = [first.solve(&case)?, second.solve(&case)?];
    let mut checks = Vec::new();
    for (side, solver) in [first, second].into_iter().enumerate() {
        for (oracle, series) in all() {
            checks.extend(of_one(oracle, series, [&solved[side], &solved[1 - side]], solver.name())?);
        }
    }
    Ok(checks)
}

/// The checks of one series: one for all correct values together, and one for each value that is known to be wrong. If
/// all values are known to be wrong, they have one check together.
fn of_one(oracle: &Oracle, series: &OracleSeries, [solved, other]: [&Trajectory; 2], side: &str) -> Result<Vec<Check>> {
    let values = column(oracle, series, solved)?;
    let others = column(oracle, series, other)?;
    let size = solved.channels().iter().zip(magnitudes(solved)).find(|(own, _)| **own == series.channel);
    let rounding = ULPS * f64::EPSILON * size.map_or(0.0, |(_, size)| size);
    let against = |family: &str, point: &OraclePoint, origin: Origin| {
        let row =
            solved.cranks().binary_search_by(|crank| crank.total_cmp(&point.crank)).expect("solved at this angle");
        let difference = values[row] - point.value;
        let deviation = if series.channel.kind.periodic { wrapped(difference) } else { difference }.abs();
        // No number is known better than both sides agree on it.
        let known = rounding + 2.0 * (values[row] - others[row]).abs();
        let tolerance = tolerance(oracle, origin, point.bound.larger(known), point.digits);
        Check::new(family, deviation, tolerance, series.channel.kind.unit.symbol())
            .located(|| format!("at crank angle {:.3} deg", point.crank.to_degrees()))
    };
    let [family, wrong] = [false, true].map(|wrong| family(oracle, wrong, side));
    let corrected = |cell: &ExpectedCell| {
        let printed = against(&wrong, &cell.point, origin(oracle));
        against(&wrong, &cell.right, Origin::Recomputed).expected(&cell.finding, &printed)
    };
    // Each cell has its own bound: the worst cell is the one that uses the largest share of it.
    let all = series.points.iter().map(|point| against(&family, point, origin(oracle)).of(&series.name));
    let worst = all.max_by(|a, b| a.used().total_cmp(&b.used()));
    let expected = series.expected.iter().map(|cell| {
        let detail = format!("{} at {:.1} deg", series.name, cell.point.crank.to_degrees());
        corrected(cell).of(detail)
    });
    let column = series.wrong.iter().filter_map(|(_, cells)| worst_of(cells.iter().map(corrected)));
    let column = column.map(|check| check.of(&series.name));
    Ok(worst.into_iter().chain(expected).chain(column).collect())
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

/// Values of a series' channel, or magnitudes of its vector.
fn column(oracle: &Oracle, series: &OracleSeries, solved: &Trajectory) -> Result<Vec<f64>> {
    let named = |channel: &Channel| {
        solved.column(channel).ok_or_else(|| {
            Error::new(ErrorKind::Input, format!("oracle {}: there is no channel {channel}", oracle.name))
                .help("name a link, point or joint of this scenario")
        })
    };
    let x = named(&series.channel)?;
    if !series.magnitude {
        return Ok(x.to_vec());
    }
    let y = named(&Channel::named(&format!("joint.{}.fy_N", series.channel.of)).expect("joints have this channel"))?;
    Ok(x.iter().zip(y).map(|(x, y)| x.hypot(*y)).collect())
}

fn of_figures(scenario: &Scenario, solvers: [&dyn Solver; 2]) -> Result<Vec<Check>> {
    let all = || scenario.oracles.iter().flat_map(|oracle| oracle.figures.iter().map(move |figure| (oracle, figure)));
    let mut values = [Vec::new(), Vec::new()];
    for (values, solver) in values.iter_mut().zip(solvers) {
        let mut measured = Measured { scenario, solver, means: None };
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

/// Figures computed by one analytic side. The means over a turn are computed once, if one is asked for.
struct Measured<'a> {
    scenario: &'a Scenario,
    solver: &'a dyn Solver,
    means: Option<Means>,
}

impl Measured<'_> {
    fn value(&mut self, figure: Figure) -> Result<f64> {
        Ok(match figure {
            Figure::ReducedInertiaMean => self.means()?.inertia,
            Figure::ReducedResistanceMean => self.means()?.resistance,
            Figure::SteadyCrankSpeed => self.steady()?[0],
            Figure::SteadyMotorSpeed => self.steady()?[1],
            Figure::Distance(ends) => self.distance(ends)?,
        })
    }

    fn means(&mut self) -> Result<Means> {
        let found = match self.means {
            Some(means) => means,
            None => reduced::means_over_turn(&self.scenario.case, self.solver)?,
        };
        self.means = Some(found);
        Ok(found)
    }

    /// Steady speeds of the crank and of the motor (rad/s).
    fn steady(&mut self) -> Result<[f64; 2]> {
        let case = &self.scenario.case;
        let motor = case.crank().motor().expect("a scenario with this figure has a motor");
        // The motor acts in the direction in which the crank is driven.
        let sense = case.crank().sense();
        let resistance = sense * self.means()?.resistance;
        let Some(speed) = motor.steady_speed(resistance) else {
            return Err(reduced::no_steady_speed(resistance));
        };
        let crank = sense * speed;
        Ok([crank, crank * motor.ratio])
    }

    /// Distance of two points at t = 0 by this side (m).
    fn distance(&self, ends: [Side; 2]) -> Result<f64> {
        let base = &self.scenario.case;
        let grid = Grid::of_times(base.crank(), vec![0.0]);
        let case = base.on(grid)?.wanting(Wanted::of(&[Stage::Positions]));
        let mut distance = f64::NAN;
        let mut visit = |_: usize, state: &State| {
            let [first, second] = ends.map(|end| state.motions[end.link].point(end.local));
            distance = (second - first).norm();
            Ok(())
        };
        self.solver.each(&case, &mut visit)?;
        Ok(distance)
    }
}

/// Heading of the checks of an oracle.
fn family(oracle: &Oracle, wrong: bool, side: &str) -> String {
    let known = if wrong { ", known to be wrong" } else { "" };
    format!("{} {}{known} ({side})", origin(oracle).word(), oracle.name)
}
