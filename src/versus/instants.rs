//! What rounded instants leave open where a scenario can be solved beside them.

use crate::claims::Course;
use crate::proof::solved::Solved;
use crate::scenario::Claim;
use crate::tables::{At, Column};
use analytic::AssurSolver;
use formula::Rounded;
use linkage::case::{Case, Grid};
use linkage::drive::Drive;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;

/// Units in the last place of a double within which an instant is exact: what the sides know allows for these.
const EXACT: f64 = 4.0;
/// Distances from an instant at which the scenario is solved, as shares of what its digits leave open. The ends are
/// enough where the course between them is a parabola, with its vertex anywhere.
const ENDS: [f64; 2] = [-1.0, 1.0];
/// Where the crank turns further than that meanwhile (rad), it is solved at these too.
const FAR: f64 = 0.01;
const BETWEEN: [f64; 2] = [-0.5, 0.5];

/// By how much numbers may be off because their instants were rounded, row by row: nothing where that is empty.
#[derive(Default)]
pub(super) struct Drift {
    /// Claim by claim, in their units.
    pub claims: Vec<Vec<f64>>,
    /// The crank angle (rad).
    pub crank: Vec<f64>,
}

/// A time brought into the motion of a drive: from zero to the end of its law.
pub(super) fn within(drive: &Drive, time: f64) -> f64 {
    match drive.constant_speed() {
        Some(_) => time,
        None => time.larger(0.0).smaller(drive.end().unwrap_or(f64::INFINITY)),
    }
}

/// The largest change of every claim within what the digits of the instants leave open: the scenario is solved at both
/// ends of that. So a course whose rate vanishes at an instant is followed too, and so are rates and forces.
/// Where it cannot be solved there, the course from row to row must do.
pub(super) fn drift(solved: &Solved, claims: &[Claim], at: &At, rows: &[usize], columns: &[Column]) -> Drift {
    let trajectory = solved.trajectory();
    let mut slack = vec![0.0; trajectory.times().len()];
    for (own, &row) in at.values.iter().zip(rows) {
        let is_exact = own.error <= EXACT * f64::EPSILON * own.value.abs();
        slack[row] = slack[row].larger(if is_exact { 0.0 } else { own.error });
    }
    if slack.iter().all(|slack| *slack == 0.0) {
        return Drift::default();
    }
    let of_rows = |of: &[f64]| rows.iter().map(|&row| of[row]).collect::<Vec<f64>>();
    if let Ok(found) = by_solving(solved, claims, at.is_crank, &slack) {
        let Drift { claims, crank } = found;
        return Drift { claims: claims.iter().map(|own| of_rows(own)).collect(), crank: of_rows(&crank) };
    }
    let (instants, order) = (at.values.iter().map(|at| at.value).collect::<Vec<f64>>(), at.ascending());
    let slack = of_rows(&slack);
    let along = |values: &[Rounded], turn| columns::drift(values, &instants, &slack, &order, turn);
    let cranks: Vec<Rounded> = of_rows(trajectory.cranks()).into_iter().map(Rounded::exact).collect();
    let claims = columns.iter().map(|own| along(&own.values, own.claim.turn())).collect();
    Drift { claims, crank: along(&cranks, None) }
}

fn by_solving(solved: &Solved, claims: &[Claim], by_crank: bool, slack: &[f64]) -> Result<Drift> {
    let (case, own) = (&solved.case, solved.trajectory());
    let mut drift = Drift { claims: vec![vec![0.0; slack.len()]; claims.len()], crank: vec![0.0; slack.len()] };
    let values =
        |case: &Case, trajectory: &Trajectory, claim: &Claim| Course::new(case, trajectory, &|_, _| 0.0).values(claim);
    let mut add = |part: f64| -> Result<f64> {
        let shifted = |at: &[f64]| at.iter().zip(slack).map(|(at, slack)| at + part * slack).collect::<Vec<f64>>();
        let crank = case.crank();
        let grid = match by_crank {
            true => Grid::of_cranks(crank, shifted(own.cranks())),
            false => Grid::of_times(crank, shifted(own.times()).into_iter().map(|at| within(crank, at)).collect()),
        };
        let shifted = case.on(grid)?;
        let found = AssurSolver.solve(&shifted)?;
        for (claim, drift) in claims.iter().zip(&mut drift.claims).filter(|(claim, _)| claim.figures.is_empty()) {
            let (before, after) = (values(case, own, claim)?, values(&shifted, &found, claim)?);
            grow(drift, before.iter().zip(&after).map(|(before, after)| after.value - before.value), claim.turn());
        }
        let turned = || own.cranks().iter().zip(found.cranks()).map(|(before, after)| after - before);
        grow(&mut drift.crank, turned(), None);
        Ok(turned().map(f64::abs).fold(0.0, f64::larger))
    };
    let mut furthest = 0.0;
    for part in ENDS {
        furthest = add(part)?.larger(furthest);
    }
    if furthest > FAR {
        for part in BETWEEN {
            add(part)?;
        }
    }
    Ok(drift)
}

/// Widens what is known so far by some changes.
fn grow(drift: &mut [f64], changes: impl Iterator<Item = f64>, turn: Option<f64>) {
    for (drift, change) in drift.iter_mut().zip(changes) {
        let change = turn.map_or(change, |turn| change - turn * (change / turn).round()).abs();
        if change > *drift {
            *drift = change;
        }
    }
}
