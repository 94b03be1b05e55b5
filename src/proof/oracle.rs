//! Published numbers against both analytic sides.

use crate::case::{Case, Grid, Wanted};
use crate::compare::Check;
use crate::error::{Error, ErrorKind, Result};
use crate::math::angle::wrapped;
use crate::reference::{self, reduced};
use crate::scenario::{Figure, Oracle, OraclePoint, OracleSeries, Scenario};
use crate::solver::Solver;
use crate::tolerance::{Basis, Tolerance};
use crate::trajectory::{Channel, Stage, Trajectory};

/// One check for every published series and figure and each analytic side.
pub(super) fn checks(scenario: &Scenario) -> Result<Vec<Check>> {
    let mut checks = Vec::new();
    for solver in reference::all() {
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
    let case = Case { wanted: Wanted::of(&stages), ..base.on(Grid::of_cranks(&base.drive, cranks)) };
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
    let family = format!("published {} ({side})", oracle.name);
    let wrong = format!("published {}, known to be wrong ({side})", oracle.name);
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
    if all().next().is_none() {
        return Ok(Vec::new());
    }
    let means = reduced::means_over_turn(&scenario.case, solver)?;
    let check = |(oracle, figure): (&Oracle, &crate::scenario::OracleFigure)| {
        let value = match figure.figure {
            Figure::ReducedInertiaMean => means.inertia,
            Figure::ReducedResistanceMean => means.resistance,
        };
        let basis = Basis::Published { digits: figure.digits, source: oracle.source.clone() };
        let tolerance = Tolerance { abs: figure.bound, rel: 0.0, basis };
        let family = format!("published {} ({})", oracle.name, solver.name());
        Check::new(family, (value - figure.value).abs(), tolerance, figure.figure.unit()).of(figure.figure.name())
    };
    Ok(all().map(check).collect())
}
