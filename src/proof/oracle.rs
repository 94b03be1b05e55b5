//! Published numbers against both analytic sides.

use crate::compare::Check;
use crate::scenario::{Figure, Oracle, OraclePoint, OracleSeries, Scenario};
use crate::tolerance::{Basis, Tolerance};
use analytic::reduced::means::{self as reduced, Means};
use linkage::case::{Grid, Wanted};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::angle::wrapped;
use linkage::mechanism::Side;
use linkage::solver::{Solver, State};
use linkage::trajectory::{Channel, Stage, Trajectory};

/// One check for every published series and figure and each analytic side.
pub(super) fn checks(scenario: &Scenario) -> Result<Vec<Check>> {
    // Numbers at crank angles are of the nominal motion, where forces decide the true one.
    let scenario = &scenario.clone().nominal();
    let mut checks = Vec::new();
    for solver in analytic::all() {
        checks.extend(of_series(scenario, solver)?);
        checks.extend(of_figures(scenario, solver)?);
    }
    Ok(checks)
}

fn of_series(scenario: &Scenario, solver: &dyn Solver) -> Result<Vec<Check>> {
    let all = || scenario.oracles.iter().flat_map(|oracle| oracle.series.iter().map(move |series| (oracle, series)));
    let points = |series: &OracleSeries| {
        let expected = series.expected.iter().map(|cell| cell.point.crank);
        series.points.iter().map(|point| point.crank).chain(expected).collect::<Vec<f64>>()
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
    let solved = solver.solve(&case, &mut |_| {})?;
    let mut checks = Vec::new();
    for (oracle, series) in all() {
        checks.extend(of_one(oracle, series, &solved, solver.name())?);
    }
    Ok(checks)
}

/// The checks of one series: one of all its values, and one of each value that is known to be wrong.
fn of_one(oracle: &Oracle, series: &OracleSeries, solved: &Trajectory, side: &str) -> Result<Vec<Check>> {
    let values = column(oracle, series, solved)?;
    let check = |family: String, point: &OraclePoint| {
        let row =
            solved.cranks().binary_search_by(|crank| crank.total_cmp(&point.crank)).expect("solved at this angle");
        let difference = values[row] - point.value;
        let deviation = if series.channel.kind.periodic { wrapped(difference) } else { difference }.abs();
        let basis = Basis::Published { digits: point.digits, source: oracle.source.clone() };
        Check::new(family, deviation, Tolerance { abs: point.bound, rel: 0.0, basis }, series.channel.kind.unit)
            .located(|| format!("at crank angle {:.3} deg", point.crank.to_degrees()))
    };
    let [family, wrong] = [false, true].map(|wrong| family(oracle, wrong, side));
    // Each cell has its own bound: the worst is the one that uses most of it.
    let all = series.points.iter().map(|point| check(family.clone(), point).of(&series.name));
    let worst = all.max_by(|a, b| a.used().total_cmp(&b.used()));
    let worst = worst.map(|worst| match &series.finding {
        Some(finding) => Check { family: wrong.clone(), ..worst }.expected(finding),
        None => worst,
    });
    let expected = series.expected.iter().map(|cell| {
        let detail = format!("{} at {:.1} deg", series.name, cell.point.crank.to_degrees());
        check(wrong.clone(), &cell.point).of(detail).expected(&cell.finding)
    });
    Ok(worst.into_iter().chain(expected).collect())
}

/// Values of a series' channel, or sizes of its vector.
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

fn of_figures(scenario: &Scenario, solver: &dyn Solver) -> Result<Vec<Check>> {
    let all = || scenario.oracles.iter().flat_map(|oracle| oracle.figures.iter().map(move |figure| (oracle, figure)));
    let mut measured = Measured { scenario, solver, means: None };
    let mut checks = Vec::new();
    for (oracle, printed) in all() {
        let value = measured.value(printed.figure)?;
        let basis = Basis::Published { digits: printed.digits, source: oracle.source.clone() };
        let tolerance = Tolerance { abs: printed.bound, rel: 0.0, basis };
        let (family, unit) = (family(oracle, printed.finding.is_some(), solver.name()), printed.figure.unit());
        let check = Check::new(family, (value - printed.value).abs(), tolerance, unit).of(&printed.name);
        let found = format!("printed {} {unit}, found {value:.10}", printed.value);
        checks.push(match &printed.finding {
            Some(finding) => check.expected(finding),
            None => check.located(|| found),
        });
    }
    Ok(checks)
}

/// Figures as one analytic side finds them; the means over a turn once, where one is asked for.
struct Measured<'a> {
    scenario: &'a Scenario,
    solver: &'a dyn Solver,
    means: Option<Means>,
}

impl Measured<'_> {
    fn value(&mut self, figure: Figure) -> Result<f64> {
        let case = &self.scenario.case;
        Ok(match figure {
            Figure::ReducedInertiaMean => self.means()?.inertia,
            Figure::ReducedResistanceMean => self.means()?.resistance,
            Figure::SteadyCrankSpeed => self.steady()?[0],
            Figure::SteadyMotorSpeed => self.steady()?[1],
            Figure::Distance(ends) => self.distance(ends)?,
            Figure::Mass(link) => case.mechanism.links()[link].mass,
            Figure::Inertia(link) => case.mechanism.links()[link].inertia,
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
        // The motor works in the sense in which the crank is driven.
        let sense = case.crank().sense();
        let resistance = sense * self.means()?.resistance;
        let Some(speed) = motor.steady_speed(resistance) else {
            return Err(reduced::no_steady_speed(resistance));
        };
        let crank = sense * speed;
        Ok([crank, crank * motor.ratio])
    }

    /// Distance of two points as the side places them at t = 0 (m).
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
        self.solver.sweep(&case, &mut visit, &mut |_| {})?;
        Ok(distance)
    }
}

/// Heading of the checks of an oracle.
fn family(oracle: &Oracle, wrong: bool, side: &str) -> String {
    let known = if wrong { ", known to be wrong" } else { "" };
    format!("published {}{known} ({side})", oracle.name)
}
