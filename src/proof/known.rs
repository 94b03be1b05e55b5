//! How well the analytic sides know their own numbers.
//!
//! Rounding grows with the condition of the pose: from positions to velocities once, to accelerations and forces once
//! more each. A motion under forces has the error of its integration besides, which both sides share: a third, tighter
//! run shows it.
//!
//! No bound on anything else is less than this.

use crate::compare::{largest_difference, magnitudes};
use analytic::TightAssurSolver;
use analytic::range::condition;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::mechanism::{LinkPose, Pose};
use linkage::solver::{Solver, State};
use linkage::trajectory::{Channel, Stage, Trajectory};

/// Wanted: relative error of an analytic side in well conditioned poses. Each derivative, and each linear solve for
/// forces, multiplies the rounding of its input by the condition of the pose, here at most some tens.
fn usual(stage: Stage) -> f64 {
    match stage {
        Stage::Positions => 1e-12,
        Stage::Velocities | Stage::Accelerations => 1e-11,
        Stage::Reactions | Stage::BalancingMoment => 1e-10,
    }
}

/// Power of the condition number that the rounding of a stage grows with.
fn power(stage: Stage) -> i32 {
    match stage {
        Stage::Positions => 1,
        Stage::Velocities => 2,
        Stage::Accelerations | Stage::Reactions | Stage::BalancingMoment => 3,
    }
}

/// Rounding of a position in a pose of condition number 1, in units in the last place.
const ULPS: f64 = 16.0;

/// Error of the integration over the difference to the tighter run: the tighter run has an error too.
const SAFETY: f64 = 2.0;

/// Errors allowed to an analytic side, channel by channel.
pub(super) struct Known {
    /// Size of the numbers in every channel, in its unit.
    magnitudes: Vec<f64>,
    /// Error of the integration in every channel, in its unit; zeros for a prescribed motion.
    integration: Vec<f64>,
    /// Condition number of the pose at every instant, so far in a motion under forces; empty as long as nobody needs it.
    conditions: Vec<f64>,
}

impl Known {
    /// What side 1's trajectory is known to.
    ///
    /// # Errors
    /// Those of the tighter run.
    pub(super) fn of(case: &Case, reference: &Trajectory) -> Result<Self> {
        let integration = match case.is_free() {
            false => vec![0.0; reference.channels().len()],
            true => {
                let tight = TightAssurSolver.solve(case)?;
                let of = |((channel, ours), (_, theirs)): ((&Channel, &[f64]), (_, &[f64]))| {
                    SAFETY * largest_difference(ours, theirs, channel.kind.periodic)
                };
                reference.iter().zip(tight.iter()).map(of).collect()
            }
        };
        Ok(Known { magnitudes: magnitudes(reference), integration, conditions: Vec::new() })
    }

    /// Measures the condition of every pose, for a trajectory whose errors exceed those of well conditioned poses.
    ///
    /// # Errors
    /// Those of the solver.
    pub(super) fn measure(&mut self, case: &Case, solver: &dyn Solver) -> Result<()> {
        let mut conditions = vec![1.0; case.grid.len()];
        let mut worst: f64 = 1.0;
        let mut visit = |row: usize, state: &State| {
            let frames = state.motions.iter().zip(&state.angles);
            let pose = Pose(frames.map(|(motion, &angle)| LinkPose { origin: motion.origin, angle }).collect());
            let own = condition(&case.mechanism, &case.structure.groups, &pose);
            // What a motion under forces has lost once, it does not get back.
            worst = if case.is_free() { worst.larger(own) } else { own };
            conditions[row] = worst;
            Ok(())
        };
        solver.each(case, &mut visit)?;
        self.conditions = conditions;
        Ok(())
    }

    /// Size of the numbers in a channel of the reference, in its unit.
    pub(super) fn magnitude(&self, channel: usize) -> f64 {
        self.magnitudes[channel]
    }

    /// Relative error allowed in a channel of a stage at an instant.
    pub(super) fn share(&self, stage: Stage, channel: usize, row: usize) -> f64 {
        let condition = self.conditions.get(row).copied().unwrap_or(1.0);
        let rounding = usual(stage).larger(ULPS * f64::EPSILON * condition.powi(power(stage)));
        rounding + linkage::math::statistics::share(self.integration[channel], self.magnitudes[channel])
    }

    /// Largest error allowed in a channel over the run, in its unit.
    pub(super) fn error(&self, stage: Stage, channel: usize) -> f64 {
        let rows = 0..self.conditions.len().max(1);
        let share = rows.map(|row| self.share(stage, channel, row)).fold(0.0, f64::larger);
        share * self.magnitudes[channel]
    }
}
