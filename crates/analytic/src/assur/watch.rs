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

/// Clearances of all groups at the last two poses.
#[derive(Debug)]
pub(super) struct Watch {
    /// Angular velocity of the crank for which the caller wants velocities, or 0. Those of the pose are then found once
    /// for both.
    pub(super) shares: f64,
    has_shared: bool,
    is_needed: bool,
    motions: Vec<Motion>,
    /// Clearances per unit of the crank's speed. A rate is NaN if it is not known.
    last: Vec<Option<Clearance>>,
    now: Vec<Option<Clearance>>,
    /// Change of each clearance over the last step, per unit of the crank angle, without sign; NaN if it is not known.
    falls: Vec<f64>,
}

impl Watch {
    pub(super) fn of(plan: &Plan) -> Self {
        let groups = plan.steps().len();
        Watch {
            shares: 0.0,
            has_shared: false,
            is_needed: plan.steps().iter().any(Step::has_clearance),
            motions: Vec::new(),
            last: Vec::with_capacity(groups),
            now: Vec::with_capacity(groups),
            falls: vec![f64::NAN; groups],
        }
    }

    /// Whether a group has a clearance at all.
    #[inline]
    pub(super) fn is_needed(&self) -> bool {
        self.is_needed
    }

    /// Whether the state of the last pose has the velocities already that were [wanted](Watch::shares).
    #[inline]
    pub(super) fn has_shared(&self) -> bool {
        self.has_shared
    }

    /// Whether the positions alone tell that no group passes a change point on this step of the crank.
    /// On the way through one, both sines together are what the angle between the two links turns by. They must be many
    /// times that of the last step, and of the crank itself.
    fn is_far(&mut self, step: f64, plan: &Plan, motions: &[Motion]) -> bool {
        self.now.clear();
        let mut is_far = true;
        let before = self.last.iter().chain(std::iter::repeat(&None)).zip(&mut self.falls);
        for (group, (before, fall)) in plan.steps().iter().zip(before) {
            let sine = group.sine(motions);
            if let Some(sine) = sine {
                let last = before.map_or(f64::NAN, |before| before.sine);
                let both = last + sine;
                is_far &= both > CLEAR * step && both > CLEAR * *fall * step;
                *fall = (sine - last).abs() / step;
            }
            self.now.push(sine.map(|sine| Clearance { sine, rate: f64::NAN }));
        }
        is_far
    }
}

impl PoseSolver<'_> {
    /// Finds the clearances of a crank angle whose positions are known.
    #[inline]
    fn find_clearances(&mut self, crank: f64) {
        let shares = self.watch.shares;
        // The inverse of a smaller rate may be infinite.
        self.watch.has_shared = shares.is_normal();
        let rate = if self.watch.has_shared { shares } else { 1.0 };
        let from = std::mem::replace(&mut self.crank, crank);
        self.drive(rate);
        self.crank = from;
        let Watch { motions, now, .. } = &mut self.watch;
        let motions = if shares.is_normal() {
            &mut self.state.motions
        } else {
            motions.clone_from(&self.state.motions);
            motions
        };
        self.plan.velocities(&self.inputs, motions);
        let per_unit = 1.0 / rate;
        now.clear();
        let found = self.plan.clearances(motions);
        now.extend(found.map(|found| found.map(|found| Clearance { rate: found.rate * per_unit, ..found })));
    }

    /// Refuses a step that passes over a change point: there a clearance falls to zero and rises again.
    #[inline]
    pub(super) fn keep_clear(&mut self, target: f64) -> Result<(), OutOfReach> {
        self.watch.has_shared = false;
        let step = (target - self.crank).abs();
        if self.watch.shares == 0.0 {
            if !self.watch.is_far(step, &self.plan, &self.state.motions) {
                self.keep_clear_by_rates(target)?;
            }
        } else {
            self.watch.falls.fill(f64::NAN);
            self.keep_clear_by_rates(target)?;
        }
        let Watch { last, now, .. } = &mut self.watch;
        std::mem::swap(last, now);
        Ok(())
    }

    #[inline]
    fn keep_clear_by_rates(&mut self, target: f64) -> Result<(), OutOfReach> {
        self.find_clearances(target);
        let sense = target - self.crank;
        for group in 0..self.watch.last.len() {
            // A rate that is not known might be any.
            if let (Some(before), Some(after)) = (self.watch.last[group], self.watch.now[group])
                && before.sine.smaller(after.sine) < NARROW
                && !(before.rate * sense >= 0.0)
                && after.rate * sense > 0.0
            {
                self.search(group, target, [before, after])?;
                // The search has left another pose and its clearances.
                self.turn(target);
                self.plan.positions(&self.inputs, &mut self.state.motions)?;
                self.find_clearances(target);
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
            self.find_clearances(low);
            before = self.watch.now[group].unwrap_or(before);
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
            self.find_clearances(middle);
            let Some(now) = self.watch.now[group] else { return Ok(()) };
            if now.sine < 10.0 * SINGULAR {
                return Err(OutOfReach { group, why: Misfit::Passed { crank: middle } });
            }
            if now.rate * sense < 0.0 { (low, before) = (middle, now) } else { (high, after) = (middle, now) }
        }
        Ok(())
    }
}
