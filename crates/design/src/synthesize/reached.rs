//! Positions of a mechanism at the precision points of its task.

use std::f64::consts::TAU;

use analytic::PoseSolver;
use linkage::error::Result;
use linkage::math::{KeepNan, Vec2, extremum};
use linkage::trajectory::Stage;

use super::evaluate::Evaluator;
use super::nearest::nearest;
use crate::synthesize::task::{PrecisionPoint, Task};

/// Number of evenly spaced crank angles per turn from which the search for a free crank angle starts.
const ROWS: usize = 720;

/// The position of a mechanism that comes nearest to a precision point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachedPoint {
    /// Crank angle (rad, from crank angle zero in the sense of rotation).
    pub turn: f64,
    /// World position of the working point (m); (0, 0) if the output link has no working point.
    pub place: Vec2,
    /// Angle of the output link (rad).
    pub angle: f64,
    /// Distance from the required position (m). `None` if no position is required.
    pub distance: Option<f64>,
    /// Angle minus required angle (rad). `None` if no angle is required.
    pub turned: Option<f64>,
}

/// The positions of the mechanism of `task.case` at its precision points.
/// For a precision point with a free crank angle, the crank angle is chosen at which the mechanism comes nearest to the
/// point.
///
/// # Errors
/// The errors of [`PoseSolver::solve_at`].
pub fn reached(task: &Task) -> Result<Vec<ReachedPoint>> {
    if task.points.is_empty() {
        return Ok(Vec::new());
    }
    let (link, working) = task.output.working_point();
    let local = working.map(|point| task.case.mechanism.links()[link].points[point].local);
    let mut poses = PoseSolver::new(&task.case)?;
    let mut position = |turn: f64| -> Result<(Vec2, f64)> {
        let state = poses.solve_at(task.turning() * turn, Stage::Positions)?;
        let place = local.map_or(Vec2::zeros(), |local| state.motions[link].point(local));
        Ok((place, state.angles[link]))
    };
    let coarse = coarse(task);
    let one = |(point, near): (&PrecisionPoint, &f64)| {
        let apart = |(place, angle): (Vec2, f64)| task.points.squared_deviation(point, place, angle);
        let turn = match point.turn {
            Some(turn) => turn,
            None => {
                let turns = [near - TAU / ROWS as f64, *near, near + TAU / ROWS as f64];
                let mut value = |turn: f64| Ok(-apart(position(turn)?));
                let samples = turns.iter().map(|&turn| value(turn)).collect::<Result<Vec<f64>>>()?;
                extremum::greatest(&turns, &samples, &mut value)?.0
            }
        };
        let (place, angle) = position(turn)?;
        let [.., turned] = task.points.deviations(point, place, angle);
        Ok(ReachedPoint {
            turn,
            place,
            angle,
            distance: point.place.map(|wanted| (place - wanted).norm()),
            turned: point.angle.map(|_| turned),
        })
    };
    task.points.all().iter().zip(&coarse).map(one).collect()
}

/// Crank angles (rad) of the precision points. Free crank angles are chosen from evenly spaced crank angles.
fn coarse(task: &Task) -> Vec<f64> {
    let turns: Vec<f64> = (0..=ROWS).map(|row| TAU * (row as f64 / ROWS as f64)).collect();
    let as_drawn = Task { places: Vec::new(), ..task.clone() };
    let mut evaluator = Evaluator::new(&as_drawn);
    match evaluator.run(&[], task.case.crank().zero, &turns) {
        Ok(()) => nearest(task, &evaluator, &turns),
        Err(_) => task.points.all().iter().map(|point| point.turn.unwrap_or(0.0)).collect(),
    }
}

/// Largest distance from a required position (m), and largest deviation from a required angle (rad).
/// The first is `None` if no point requires a position, the second if no point requires an angle.
pub fn largest_deviations(points: &[ReachedPoint]) -> [Option<f64>; 2] {
    let largest = |of: &dyn Fn(&ReachedPoint) -> Option<f64>| points.iter().filter_map(of).reduce(f64::larger);
    [largest(&|point| point.distance), largest(&|point| point.turned.map(f64::abs))]
}
