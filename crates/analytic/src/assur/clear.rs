//! Refuses steps of [`PoseSolver`] over a change point.

use super::PoseSolver;
use super::watch::CLEAR;
use crate::assur::groups::{Misfit, OutOfReach, SINGULAR, SingularityDistance};
use linkage::math::KeepNan;
use linkage::mechanism::GroupId;

/// Number of bisections after which the width of an interval is rounding error.
const BISECTIONS: usize = 64;

impl PoseSolver<'_> {
    /// Checks the step to the pose just found, if the stored bounds do not exclude a change point on this step.
    #[cold]
    pub(super) fn pass_closely(&mut self, target: f64) -> Result<(), OutOfReach> {
        self.gauges.pass_closely([self.crank, target], self.case, &self.plan, &self.state.motions)?;
        self.watch.leave_to(&self.gauges, &self.plan);
        Ok(())
    }

    /// Computes the [clearances](crate::assur::groups::SolutionPlan::clearances) at a crank angle; the positions at
    /// this angle must be known.
    /// Returns whether a group may have passed a change point.
    fn find_clearances(&mut self, crank: f64, sense: f64) -> bool {
        let from = std::mem::replace(&mut self.crank, crank);
        self.drive(1.0);
        self.crank = from;
        let motions = &mut self.watch.motions;
        motions.clone_from(&self.state.motions);
        self.plan.velocities(&self.inputs, motions);
        let motions = std::mem::take(&mut self.watch.motions);
        let may_pass = self.watch.see(&self.plan, &motions, 1.0, sense);
        self.watch.motions = motions;
        may_pass
    }

    /// Refuses a step over a change point, where a clearance falls to zero and rises again.
    #[inline]
    pub(super) fn keep_clear(&mut self, target: f64) -> Result<(), OutOfReach> {
        let step = target - self.crank;
        if self.watch.begins() && step != 0.0 {
            self.begin(target)?;
        }
        if !self.watch.is_far(step.abs(), &self.plan, &self.state.motions) {
            let may_pass = match self.has_motions {
                true => self.watch.see(&self.plan, &self.state.motions, self.omega, step),
                false => self.find_clearances(target, step),
            };
            if may_pass {
                self.keep_clear_closely(target)?;
            }
        }
        self.watch.groups.iter_mut().for_each(|seen| seen.last = seen.now);
        Ok(())
    }

    /// Computes the clearances at the beginning of a step, for groups that were not watched before.
    #[cold]
    fn begin(&mut self, target: f64) -> Result<(), OutOfReach> {
        let (from, step) = (self.crank, target - self.crank);
        self.has_motions = false;
        self.turn(from);
        self.plan.positions(&self.inputs, &mut self.state.motions)?;
        self.find_clearances(from, step);
        self.watch.groups.iter_mut().for_each(|seen| seen.last = seen.now);
        self.turn(target);
        self.plan.positions(&self.inputs, &mut self.state.motions)
    }

    /// For every group that may have passed a change point, searches the step for this change point.
    #[cold]
    fn keep_clear_closely(&mut self, target: f64) -> Result<(), OutOfReach> {
        let sense = target - self.crank;
        self.has_motions = false;
        for group in self.watch.groups.ids() {
            let seen = self.watch.groups[group];
            if seen.may_pass(sense) {
                self.search(group, target, [seen.last, seen.now])?;
                // The search has changed the pose and the clearances: restore the pose and the clearances of `target`.
                self.turn(target);
                self.plan.positions(&self.inputs, &mut self.state.motions)?;
                self.find_clearances(target, sense);
            }
        }
        Ok(())
    }

    /// Searches for the smallest clearance of a group between the present crank angle and `target`, by bisection on its
    /// slope.
    /// Refuses the step if the smallest clearance is zero within rounding error, or if a pose in between cannot be
    /// assembled.
    #[cold]
    fn search(&mut self, group: GroupId, target: f64, ends: [SingularityDistance; 2]) -> Result<(), OutOfReach> {
        let ([mut low, mut high], [mut before, mut after]) = ([self.crank, target], ends);
        let sense = target - self.crank;
        if before.rate.is_nan() {
            self.turn(low);
            self.plan.positions(&self.inputs, &mut self.state.motions)?;
            self.find_clearances(low, sense);
            before = self.watch.groups[group].now;
            if before.rate * sense >= 0.0 {
                return Ok(());
            }
        }
        for _ in 0..BISECTIONS {
            if (high - low).abs() <= 8.0 * f64::EPSILON * high.abs().larger(1.0) {
                return Ok(());
            }
            let reach = before.rate.abs().larger(after.rate.abs()) * (high - low).abs();
            if before.sine.smaller(after.sine) > CLEAR * reach {
                return Ok(());
            }
            let middle = 0.5 * (low + high);
            self.turn(middle);
            match self.plan.positions(&self.inputs, &mut self.state.motions) {
                Ok(()) => {}
                Err(OutOfReach { why: Misfit::Lost, .. }) => return Ok(()),
                Err(_) => return Err(OutOfReach { group, why: Misfit::Passed { crank: middle } }),
            }
            self.find_clearances(middle, sense);
            let now = self.watch.groups[group].now;
            if now.sine < 10.0 * SINGULAR {
                return Err(OutOfReach { group, why: Misfit::Passed { crank: middle } });
            }
            if now.rate * sense < 0.0 { (low, before) = (middle, now) } else { (high, after) = (middle, now) }
        }
        Ok(())
    }
}
