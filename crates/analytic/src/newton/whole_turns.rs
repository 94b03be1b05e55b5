//! Whole turns of the crank during a motion to a distant instant.
//!
//! With one drive, a pose is a function of the crank angle and the branch.
//! If every link is back at its old pose after one whole turn in small steps, all further turns repeat this turn.
//! The repeated turns are not followed one by one.
//! See docs/numerics/change_points.md.

use std::f64::consts::TAU;

use super::system::System;
use linkage::error::Result;

/// The check for equal turns is made only if at least this number of crank turns can be skipped.
const WORTH: f64 = 3.0;
/// Two poses are equal if their differences are at most this large.
/// Positions are compared in units of the mechanism's size, angles in rad.
/// Branches that come this close to each other are refused as singular.
const SAME: f64 = 1e-9;

impl System<'_> {
    /// Follows one whole turn towards `t`, and skips the following turns if they equal this turn. Less than one turn
    /// then remains.
    /// No turns are skipped if the mechanism is not back at its old pose after one turn.
    /// No turns are skipped if there are several drives, if the drive is a slide, or if its speed is not constant.
    pub(super) fn skip_turns(&mut self, t: f64) -> Result<()> {
        let [drive] = &self.case.drives.iter().collect::<Vec<_>>()[..] else { return Ok(()) };
        let Some(speed) = drive.constant_speed() else { return Ok(()) };
        let Some((whole, _)) = drive.input.period() else { return Ok(()) };
        let period = (whole / speed).abs().copysign(t - self.time);
        let turns = ((t - self.time) / period).floor() - 1.0;
        // The comparison is negated so that NaN skips nothing.
        if !(turns >= WORTH) {
            return Ok(());
        }
        let (from, begun) = (self.time, self.q.clone());
        self.follow_to(from + period)?;
        let size = self.case.mechanism.size();
        let mut whole = vec![0.0; self.q.len()];
        for (index, (own, before)) in self.q.iter().zip(&begun).enumerate() {
            let (change, unit) = if index % 3 == 2 { (own - before, 1.0) } else { (own - before, size) };
            whole[index] = if index % 3 == 2 { (change / TAU).round() * TAU } else { 0.0 };
            if !((change - whole[index]).abs() <= SAME * unit) {
                return Ok(());
            }
        }
        let (here, rate, second) = (self.q.clone(), self.rate.clone(), self.second.clone());
        for (own, turn) in self.q.iter_mut().zip(&whole) {
            *own += turns * turn;
        }
        self.set_time(from + (turns + 1.0) * period);
        if self.correct().and_then(|()| self.check_signs()).is_ok() {
            self.differentiate();
            return Ok(());
        }
        (self.q, self.rate, self.second) = (here, rate, second);
        self.set_time(from + period);
        Ok(())
    }
}
