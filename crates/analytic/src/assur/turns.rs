//! Turns of links, counted from pose to pose.

use std::f64::consts::TAU;

use linkage::math::{Motion, Vec2, angle, cross};
use linkage::mechanism::Pose;

/// Counts the turns of every link. Between two poses no link may turn by half a turn or more.
#[derive(Clone, Debug)]
pub(super) struct Turns {
    /// Direction of every link at the last pose.
    directions: Vec<Vec2>,
    whole: Vec<f64>,
}

impl Turns {
    /// Starts from a pose whose angles keep their turns.
    pub(super) fn from(pose: &Pose, motions: &[Motion]) -> Self {
        let whole = |angle: f64| ((angle - angle::wrapped(angle)) / TAU).round();
        Turns {
            directions: motions.iter().map(|motion| motion.direction).collect(),
            whole: pose.0.iter().map(|pose| whole(pose.angle)).collect(),
        }
    }

    /// Counts a turn of each link that has passed the direction -x since the last pose, with the sign of its
    /// rotation.
    #[inline]
    pub(super) fn count(&mut self, motions: &[Motion]) {
        for ((whole, last), motion) in self.whole.iter_mut().zip(&mut self.directions).zip(motions) {
            let now = motion.direction;
            let (was_up, is_up) = (last.y >= 0.0, now.y >= 0.0);
            if was_up != is_up {
                let sense = cross(*last, now);
                if was_up && sense > 0.0 {
                    *whole += 1.0;
                } else if is_up && sense < 0.0 {
                    *whole -= 1.0;
                }
            }
            *last = now;
        }
    }

    /// Angles of all links at the last pose (rad), turns kept.
    pub(super) fn angles(&self) -> impl Iterator<Item = f64> {
        // Adding zero makes -0 a 0: on the axis -x the angle is +pi, as the count assumes.
        let angle = |(whole, now): (&f64, &Vec2)| (now.y + 0.0).atan2(now.x) + TAU * whole;
        self.whole.iter().zip(&self.directions).map(angle)
    }
}
