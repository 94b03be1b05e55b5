//! What rounded instants leave open: a case solved at both ends of it.

use linkage::case::{Case, Grid};
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use scenario::within;

/// Units in the last place of a double within which an instant is exact: what the sides know allows for these.
const EXACT: f64 = 4.0;
/// Distances from an instant at which the case is solved, as shares of what its digits leave open. The ends are enough
/// where the course between them is a parabola, with its vertex anywhere.
const ENDS: [f64; 2] = [-1.0, 1.0];
/// Where the crank turns further than that meanwhile (rad), it is solved at these too.
const FAR: f64 = 0.01;
const BETWEEN: [f64; 2] = [-0.5, 0.5];

/// Share of its scale beyond which what digits, interpolation and instants leave open proves nothing.
pub const TELLING: f64 = 1e-2;

/// Whether an instant with this error is as exact as a double.
#[must_use]
pub fn is_exact(at: f64, error: f64) -> bool {
    error <= EXACT * f64::EPSILON * at.abs()
}

/// Solves a case beside the trajectory that was found at its instants: where these are off by shares of `slack`, row by
/// row (rad of the crank if `by_crank`, else s). Every solution is handed to `then`, with its case. So a course whose
/// rate vanishes at an instant is followed too, and so are rates and forces.
///
/// # Errors
/// Those of the solver, where an instant is off beyond the reach of the mechanism, and of `then`.
pub fn shifted(
    case: &Case,
    own: &Trajectory,
    (by_crank, slack): (bool, &[f64]),
    solver: &dyn Solver,
    then: &mut dyn FnMut(&Case, &Trajectory) -> Result<()>,
) -> Result<()> {
    let crank = case.crank();
    let mut turned = 0.0;
    let mut at = |part: f64| -> Result<f64> {
        let off = |at: &[f64]| at.iter().zip(slack).map(|(at, slack)| at + part * slack).collect::<Vec<f64>>();
        let grid = match by_crank {
            true => Grid::of_inputs(crank, off(own.inputs())),
            false => Grid::of_times(crank, off(own.times()).into_iter().map(|at| within(crank, at)).collect()),
        };
        let shifted = case.on(grid)?;
        let found = solver.solve(&shifted)?;
        then(&shifted, &found)?;
        let turned = own.inputs().iter().zip(found.inputs()).map(|(before, after)| (after - before).abs());
        Ok(turned.fold(0.0, f64::larger))
    };
    for part in ENDS {
        turned = at(part)?.larger(turned);
    }
    if turned > FAR {
        for part in BETWEEN {
            at(part)?;
        }
    }
    Ok(())
}

/// Widens what is known so far by some changes; values of an angle that are a `turn` apart mean the same.
pub fn grow(drift: &mut [f64], changes: impl Iterator<Item = f64>, turn: Option<f64>) {
    for (drift, change) in drift.iter_mut().zip(changes) {
        let change = turn.map_or(change, |turn| change - turn * (change / turn).round()).abs();
        if change > *drift {
            *drift = change;
        }
    }
}
