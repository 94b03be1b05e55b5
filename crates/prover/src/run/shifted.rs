//! Uncertainty due to rounded instants: a case is solved at both ends of the rounding interval.

use std::f64::consts::TAU;

use formula::Rounded;
use linkage::case::{Case, Grid};
use linkage::drive::Drive;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use scenario::{OraclePoint, When, within};

/// An instant counts as exact if its error is at most this many units in the last place of a double.
/// The known errors of the analytic sides cover an error of this size.
const EXACT: f64 = 4.0;
/// Shifts of the instants at which the case is solved, as fractions of the rounding error of the instant.
/// If the values form a parabola over the interval, the largest change occurs at one of these two ends, even if the
/// vertex of the parabola lies between them.
const ENDS: [f64; 2] = [-1.0, 1.0];
/// If the crank rotates by more than `FAR` (rad) between an instant and an end of its rounding interval, the case is
/// also solved at `BETWEEN`.
const FAR: f64 = 0.01;
const BETWEEN: [f64; 2] = [-0.5, 0.5];

/// Agreement proves nothing if the uncertainty due to digits, interpolation and rounded instants exceeds this fraction
/// of a scale.
pub const TELLING: f64 = 1e-2;

/// Quantity in which instants are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// The crank angle (rad).
    Crank,
    /// Time (s).
    Time,
}

impl Along {
    /// The value of an instant in this quantity; `None` if the instant is given in another quantity.
    pub(super) fn of(self, when: When) -> Option<f64> {
        match self {
            Along::Crank => when.crank(),
            Along::Time => when.time(),
        }
    }

    pub(super) fn grid(self, crank: &Drive, instants: Vec<f64>) -> Grid {
        match self {
            Along::Crank => Grid::of_inputs(crank, instants),
            Along::Time => Grid::of_times(crank, instants),
        }
    }
}

/// Whether an instant with this error counts as exact.
#[must_use]
pub fn is_exact(at: f64, error: f64) -> bool {
    error <= EXACT * f64::EPSILON * at.abs()
}

/// Solves a case at the instants of its trajectory `own`, shifted by fractions of `slack`. `slack` has one value for
/// each row.
/// Every solution is passed to `then`, with its case.
/// The solutions show the changes of all channels, including forces, even at instants at which the rate of a channel is
/// zero.
///
/// # Errors
/// The errors of the solver and the errors of `then`. The solver fails, for example, if the mechanism cannot reach a
/// shifted instant.
pub fn shifted(
    case: &Case,
    own: &Trajectory,
    along: Along,
    slack: &[f64],
    solver: &dyn Solver,
    then: &mut dyn FnMut(&Case, &Trajectory) -> Result<()>,
) -> Result<()> {
    let crank = case.crank();
    let mut turned = 0.0;
    let mut at = |part: f64| -> Result<f64> {
        let off = |at: &[f64]| at.iter().zip(slack).map(|(at, slack)| at + part * slack).collect::<Vec<f64>>();
        let instants = match along {
            Along::Crank => off(own.inputs()),
            Along::Time => off(own.times()).into_iter().map(|at| within(crank, at)).collect(),
        };
        let shifted = case.on(along.grid(crank, instants))?;
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

/// Raises every entry of `drift` to at least the absolute value of the corresponding entry of `changes`. Values of an
/// angle that differ by a whole `turn` are equal.
pub fn grow(drift: &mut [f64], changes: impl Iterator<Item = f64>, turn: Option<f64>) {
    for (drift, change) in drift.iter_mut().zip(changes) {
        let change = turn.map_or(change, |turn| change - turn * (change / turn).round()).abs();
        if change > *drift {
            *drift = change;
        }
    }
}

/// Rounded instants of a motion, and the change of every channel within the rounding interval of each instant.
pub(super) struct RoundedInstants {
    /// Instants (rad or s) with their errors, in ascending order.
    at: Vec<(f64, f64)>,
    /// Changes by channel, in the channel's unit.
    drift: Vec<(Channel, Vec<f64>)>,
}

impl RoundedInstants {
    /// Rounded instants of the given points of a case.
    /// If the case cannot be solved at one of the shifted instants, all changes are estimated from neighbouring rows.
    ///
    /// # Errors
    /// The errors of the solver at the unshifted instants.
    pub(super) fn of<'a>(
        case: &Case,
        points: impl Iterator<Item = &'a OraclePoint>,
        along: Along,
        channels: &[Channel],
        solver: &dyn Solver,
    ) -> Result<Self> {
        let instant = |point: &OraclePoint| Some((along.of(point.at)?, point.at_error));
        let mut at: Vec<(f64, f64)> = points.filter_map(instant).filter(|(at, error)| !is_exact(*at, *error)).collect();
        if at.is_empty() {
            return Ok(RoundedInstants { at, drift: Vec::new() });
        }
        at.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        at.dedup();
        let (instants, slack): (Vec<f64>, Vec<f64>) = at.iter().copied().unzip();
        let case = case.on(along.grid(case.crank(), instants.clone()))?.wanting_only(channels);
        let own = solver.solve(&case)?;
        let mut drift = vec![vec![0.0; at.len()]; own.channels().len()];
        let solved = shifted(&case, &own, along, &slack, solver, &mut |_, found| {
            for (drift, ((channel, before), (_, after))) in drift.iter_mut().zip(own.iter().zip(found.iter())) {
                grow(drift, before.iter().zip(after).map(|(before, after)| after - before), turn(channel));
            }
            Ok(())
        });
        if solved.is_err() {
            drift = from_row_to_row(&own, &instants, &slack);
        }
        Ok(RoundedInstants { at, drift: own.channels().iter().cloned().zip(drift).collect() })
    }

    /// Change of a channel within the rounding interval of a point's instant. `at` is the instant, and `error` is its
    /// rounding error.
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

/// Changes within the rounding of the instants, estimated from neighbouring rows.
fn from_row_to_row(own: &Trajectory, instants: &[f64], slack: &[f64]) -> Vec<Vec<f64>> {
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
