//! Published numbers against both analytic sides.

use crate::case::{Case, Grid, Wanted};
use crate::compare::Check;
use crate::error::{Error, ErrorKind, Result};
use crate::math::angle::wrapped;
use crate::reference::{self, reduced};
use crate::scenario::{Figure, Oracle, OracleSeries, Scenario};
use crate::solver::Solver;
use crate::tolerance::{Basis, Tolerance};
use crate::trajectory::{Stage, Trajectory};

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
    let mut cranks: Vec<f64> = all().flat_map(|(_, series)| series.points.iter().map(|point| point.crank)).collect();
    if cranks.is_empty() {
        return Ok(Vec::new());
    }
    cranks.sort_by(f64::total_cmp);
    cranks.dedup();
    let stages: Vec<Stage> = all().map(|(_, series)| series.channel.kind.stage).collect();
    let base = &scenario.case;
    let case = Case { wanted: Wanted::of(&stages), ..base.on(Grid::of_cranks(&base.drive, cranks)) };
    let solved = solver.solve(&case, &mut |_| {})?;
    all().map(|(oracle, series)| of_one(oracle, series, &solved, solver.name())).collect()
}

fn of_one(oracle: &Oracle, series: &OracleSeries, solved: &Trajectory, side: &str) -> Result<Check> {
    let column = solved.column(&series.channel).ok_or_else(|| {
        Error::new(ErrorKind::Input, format!("oracle {}: there is no channel {}", oracle.name, series.channel))
            .help("name a link, point or joint of this scenario")
    })?;
    let kind = series.channel.kind;
    let deviations = series.points.iter().map(|point| {
        let row =
            solved.cranks().binary_search_by(|crank| crank.total_cmp(&point.crank)).expect("solved at this angle");
        let difference = column[row] - point.value;
        (point, if kind.periodic { wrapped(difference) } else { difference }.abs())
    });
    // Each cell has its own bound: the worst is the one that uses most of it.
    let worst = deviations.max_by(|(p, a), (q, b)| (a / p.bound).total_cmp(&(b / q.bound)));
    let family = format!("published {} ({side})", oracle.name);
    let basis = |digits| Basis::Published { digits, source: oracle.source.clone() };
    Ok(match worst {
        Some((point, deviation)) => {
            let tolerance = Tolerance { abs: point.bound, rel: 0.0, basis: basis(point.digits) };
            Check::new(family, deviation, tolerance, kind.unit)
                .of(&series.name)
                .located(|| format!("at crank angle {:.3} deg", point.crank.to_degrees()))
        }
        None => Check::new(family, 0.0, Tolerance { abs: 0.0, rel: 0.0, basis: basis(0) }, kind.unit).of(&series.name),
    })
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
