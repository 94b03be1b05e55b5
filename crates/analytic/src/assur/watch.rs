//! What is watched so that no step of [`PoseSolver`] passes over a change point.
//!
//! A closed form keeps the sign of a dyad's sine, and there the branch that it takes has a corner: the dyad's
//! clearance falls to zero and rises again.

use super::PoseSolver;
use crate::assur::groups::{Clearance, Misfit, OutOfReach, Plan, SINGULAR, Step};
use linkage::math::{KeepNan, Motion};

/// Clearance of a dyad below which a change point may lie within a step.
const NARROW: f64 = 0.8;
/// A clearance that is this many times the change over the rest of the way cannot fall to zero on it.
const CLEAR: f64 = 4.0;
/// Angle by which the links of a dyad turn against each other while the crank turns by one unit, and hardly ever more.
const FAST: f64 = 16.0;

/// The clearance of a group that has none.
const NONE: Clearance = Clearance { sine: f64::NAN, rate: f64::NAN };

/// What is seen of one group. Rates are per unit of the crank angle, NaN if they are not known.
#[derive(Clone, Copy, Debug)]
struct Seen {
    last: Clearance,
    now: Clearance,
    /// Change of the clearance over the last step, without sign.
    fall: f64,
}

impl Seen {
    /// Whether the clearance may have fallen to zero and risen again, on a step of the crank in this sense.
    #[inline]
    fn may_pass(&self, sense: f64) -> bool {
        // A rate that is not known might be any.
        self.last.sine.smaller(self.now.sine) < NARROW
            && !(self.last.rate * sense >= 0.0)
            && self.now.rate * sense > 0.0
    }
}

/// Clearances of all groups at the last two poses.
#[derive(Debug)]
pub(super) struct Watch {
    is_needed: bool,
    motions: Vec<Motion>,
    groups: Vec<Seen>,
    /// The last step of the crank (rad), without sign.
    step: f64,
}

impl Watch {
    pub(super) fn of(plan: &Plan) -> Self {
        let groups = vec![Seen { last: NONE, now: NONE, fall: f64::NAN }; plan.steps().len()];
        Watch { is_needed: plan.steps().iter().any(Step::has_clearance), motions: Vec::new(), groups, step: 0.0 }
    }

    /// Whether a group has a clearance at all.
    #[inline]
    pub(super) fn is_needed(&self) -> bool {
        self.is_needed
    }

    /// Reads the clearances from the velocities at this angular velocity of the crank. Returns whether a group may have
    /// passed a change point.
    #[inline]
    fn see(&mut self, plan: &Plan, motions: &[Motion], omega: f64, sense: f64) -> bool {
        let per_unit = 1.0 / omega;
        let mut may_pass = false;
        for (group, seen) in plan.steps().iter().zip(&mut self.groups) {
            if let Some(found) = group.clearance(motions) {
                seen.now = Clearance { rate: found.rate * per_unit, ..found };
                may_pass |= seen.may_pass(sense);
            }
        }
        may_pass
    }

    /// Whether the positions alone tell that no group passes a change point on this step of the crank.
    /// On the way through one, the angle between the two links turns by both sines together at least. They must be many
    /// times the change over the last step, as it would be over this one, and more than links ever turn.
    #[inline]
    fn is_far(&mut self, step: f64, plan: &Plan, motions: &[Motion]) -> bool {
        let (steps, mut is_far) = (CLEAR * step / self.step, true);
        for (group, seen) in plan.steps().iter().zip(&mut self.groups) {
            if let Some(sine) = group.sine(motions) {
                let both = seen.last.sine + sine;
                is_far &= both > FAST * step && both > steps * seen.fall;
                seen.fall = (sine - seen.last.sine).abs();
                seen.now = Clearance { sine, rate: f64::NAN };
            }
        }
        self.step = step;
        is_far
    }
}

impl PoseSolver<'_> {
    /// Finds the clearances of a crank angle whose positions are known. Returns whether a group may have passed a change
    /// point.
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

    /// Refuses a step that passes over a change point: there a clearance falls to zero and rises again.
    #[inline]
    pub(super) fn keep_clear(&mut self, target: f64) -> Result<(), OutOfReach> {
        let step = target - self.crank;
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

    /// The same for groups that may have passed one.
    #[cold]
    fn keep_clear_closely(&mut self, target: f64) -> Result<(), OutOfReach> {
        let sense = target - self.crank;
        self.has_motions = false;
        for group in 0..self.watch.groups.len() {
            let seen = self.watch.groups[group];
            if seen.may_pass(sense) {
                self.search(group, target, [seen.last, seen.now])?;
                // The search has left another pose and its clearances.
                self.turn(target);
                self.plan.positions(&self.inputs, &mut self.state.motions)?;
                self.find_clearances(target, sense);
            }
        }
        Ok(())
    }

    /// Searches the smallest clearance of a group between the present crank angle and `target`, by bisection of its
    /// slope. It is refused where it is zero to rounding.
    #[cold]
    fn search(&mut self, group: usize, target: f64, ends: [Clearance; 2]) -> Result<(), OutOfReach> {
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
        while (high - low).abs() > 8.0 * f64::EPSILON * high.abs().larger(1.0) {
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
