//! What the rounding of their instants leaves open in the numbers of `[[oracle]]` tables.

use super::shifted::{grow, is_exact, shifted};
use formula::Rounded;
use linkage::case::{Case, Grid};
use linkage::drive::Drive;
use linkage::error::Result;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use scenario::{OraclePoint, When};
use std::f64::consts::TAU;

/// The instants of a motion that may be off, and by how much every channel changes meanwhile.
pub(super) struct RoundedInstants {
    /// Instants (rad or s) with their errors, in ascending order.
    at: Vec<(f64, f64)>,
    /// Channel by channel, in its unit.
    drift: Vec<(Channel, Vec<f64>)>,
}

impl RoundedInstants {
    /// Those of some points of a case; `of` gives the instant of a point in the motion of the case, in rad of the crank
    /// if `by_crank`, else in s. Where the case cannot be solved at both ends of an instant, the course from row to row
    /// must do.
    ///
    /// # Errors
    /// Those of the solver at the instants themselves.
    pub(super) fn of<'a>(
        case: &Case,
        points: impl Iterator<Item = &'a OraclePoint>,
        (of, by_crank): (fn(When) -> Option<f64>, bool),
        channels: &[Channel],
        solver: &dyn Solver,
    ) -> Result<Self> {
        let instant = |point: &OraclePoint| Some((of(point.at)?, point.at_error));
        let mut at: Vec<(f64, f64)> = points.filter_map(instant).filter(|(at, error)| !is_exact(*at, *error)).collect();
        if at.is_empty() {
            return Ok(RoundedInstants { at, drift: Vec::new() });
        }
        at.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        at.dedup();
        let (instants, slack): (Vec<f64>, Vec<f64>) = at.iter().copied().unzip();
        let grid: fn(&Drive, Vec<f64>) -> Grid = if by_crank { Grid::of_inputs } else { Grid::of_times };
        let case = case.on(grid(case.crank(), instants.clone()))?.wanting_only(channels);
        let own = solver.solve(&case)?;
        let mut drift = vec![vec![0.0; at.len()]; own.channels().len()];
        let solved = shifted(&case, &own, (by_crank, &slack), solver, &mut |_, found| {
            for (drift, ((channel, before), (_, after))) in drift.iter_mut().zip(own.iter().zip(found.iter())) {
                grow(drift, before.iter().zip(after).map(|(before, after)| after - before), turn(channel));
            }
            Ok(())
        });
        if solved.is_err() {
            drift = along(&own, &instants, &slack);
        }
        Ok(RoundedInstants { at, drift: own.channels().iter().cloned().zip(drift).collect() })
    }

    /// By how much a channel changes within the rounding of the instant of a point, `at` in the motion of the case.
    pub(super) fn of_point(&self, channel: &Channel, at: f64, error: f64) -> f64 {
        let place = self.at.binary_search_by(|own| own.0.total_cmp(&at).then(own.1.total_cmp(&error)));
        let column = self.drift.iter().find(|(own, _)| own == channel);
        match (place, column) {
            (Ok(row), Some((_, drift))) => drift[row],
            // The instant is exact.
            (Err(_), _) | (_, None) => 0.0,
        }
    }
}

fn along(own: &Trajectory, instants: &[f64], slack: &[f64]) -> Vec<Vec<f64>> {
    let order: Vec<usize> = (0..instants.len()).collect();
    let of = |(channel, values): (&Channel, &[f64])| {
        let values: Vec<Rounded> = values.iter().copied().map(Rounded::exact).collect();
        columns::drift(&values, instants, slack, &order, turn(channel))
    };
    own.iter().map(of).collect()
}

fn turn(channel: &Channel) -> Option<f64> {
    channel.kind.periodic.then_some(TAU)
}
