//! Whole turns of the crank on the way to a distant instant.
//!
//! With one drive, a pose is a function of the crank angle and the branch.
//! If one whole turn, followed in small steps, brings every link back, the next turns are the same.
//! They are not followed one by one.
//! See docs/numerics/change_points.md.

use std::f64::consts::TAU;

use super::system::System;
use linkage::error::Result;

/// Number of crank turns from which a check for equal turns pays off.
const WORTH: f64 = 3.0;
/// Largest difference of equal poses: of positions in sizes of the mechanism, of angles in rad.
/// Branches as close as that are refused as singular.
const SAME: f64 = 1e-9;

impl System<'_> {
    /// Follows one whole turn towards `t` and skips the turns equal to it. At most a few turns then remain.
    /// No turn is skipped where a turn leads to another pose, or with several drives or another law.
    pub(super) fn skip_turns(&mut self, t: f64) -> Result<()> {
        let [drive] = &self.case.drives.iter().collect::<Vec<_>>()[..] else { return Ok(()) };
        let Some(speed) = drive.constant_speed() else { return Ok(()) };
        let Some((whole, _)) = drive.input.period() else { return Ok(()) };
        let period = (whole / speed).abs().copysign(t - self.time);
        let turns = ((t - self.time) / period).floor() - 1.0;
        // Written so that NaN skips nothing.
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
