//! Whole turns of the crank during a motion to a distant crank angle.
//!
//! With one drive, a pose is a function of the crank angle and the branch.
//! If every link is back at its old pose after one whole turn in small steps, all further turns repeat this turn.
//! The repeated turns are counted, not followed.
//! See docs/numerics/change_points.md.

use std::f64::consts::TAU;

use super::PoseSolver;
use linkage::error::Result;
use linkage::math::Motion;

/// The check for equal turns is made only if at least this number of crank turns can be skipped.
const WORTH: f64 = 3.0;
/// Two poses are equal if their differences are at most this large.
/// Positions are compared in units of the mechanism's size, directions in rad.
/// Branches that come this close to each other are refused as singular.
const SAME: f64 = 1e-9;

impl PoseSolver<'_> {
    /// Follows one whole turn towards the crank angle `target`, and skips the following turns if they equal this turn.
    /// Less than one turn then remains.
    /// No turns are skipped if the mechanism is not back at its old pose after one turn.
    /// No turns are skipped if further drives or change points make the turns differ from each other.
    pub(super) fn skip_turns(&mut self, target: f64) -> Result<()> {
        let Some((whole, _)) = self.case.crank().input.period() else { return Ok(()) };
        let turns = ((target - self.crank).abs() / whole).floor() - 1.0;
        let repeats = self.case.drives.further().is_empty() && self.passing.is_none();
        // The comparison is negated so that NaN skips nothing.
        if !(repeats && turns >= WORTH) {
            return Ok(());
        }
        let turn = whole.copysign(target - self.crank);
        let begun = self.state.motions.clone();
        let angles = |solver: &Self| solver.turns.as_ref().map(|turns| turns.angles().collect::<Vec<f64>>());
        let before = angles(self);
        self.follow_to(self.crank + turn)?;
        if !self.is_at(&begun) {
            return Ok(());
        }
        if let (Some(before), Some(after), Some(counted)) = (before, angles(self), &mut self.turns) {
            let gone = before.iter().zip(&after).map(|(before, after)| turns * ((after - before) / TAU).round());
            counted.add(&gone.collect::<Vec<f64>>());
        }
        self.plan.skip(turns * turn);
        self.crank += turns * turn;
        Ok(())
    }

    /// Whether every link has the same pose as in the motions `begun`.
    pub(crate) fn is_at(&self, begun: &[Motion]) -> bool {
        let size = self.case.mechanism.size();
        self.state.motions.iter().zip(begun).all(|(own, before)| {
            (own.origin - before.origin).norm() <= SAME * size && (own.direction - before.direction).norm() <= SAME
        })
    }
}
