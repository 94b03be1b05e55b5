//! Turns of links, counted from pose to pose.

use std::f64::consts::TAU;

use linkage::math::{Motion, Vec2, cross};
use linkage::mechanism::{LinkId, PerLink, Pose};

/// Largest rotation of a driving link between two poses (rad). For larger steps, the turns of a link could be
/// miscounted.
pub(super) const CLOSED_FORM_STEP: f64 = std::f64::consts::PI / 12.0;
/// Largest rotation of a driving link (rad) between two poses if Newton's method follows a group.
pub(super) const FOLLOWED_STEP: f64 = std::f64::consts::PI / 90.0;
/// Counts the turns of every link. Between two poses, every link must turn by less than half a turn.
#[derive(Clone, Debug)]
pub(super) struct Turns {
    /// Direction of every link at the last pose.
    directions: Vec<Vec2>,
    whole: PerLink<f64>,
}

impl Turns {
    /// Starts from a pose whose angles include whole turns.
    pub(super) fn from(pose: &Pose, motions: &[Motion]) -> Self {
        // The whole turns of a link follow from the difference between its angle in the pose and the principal angle of
        // its direction.
        // This difference is not an exact multiple of a turn because of rounding errors, hence `round`.
        // On the axis -x, rounding errors also decide whether the principal angle is -pi or pi.
        let whole = |angle: f64, direction: Vec2| ((angle - principal(direction)) / TAU).round();
        let directions: Vec<Vec2> = motions.iter().map(|motion| motion.direction).collect();
        let whole = pose.0.iter().zip(&directions).map(|(pose, direction)| whole(pose.angle, *direction)).collect();
        Turns { directions, whole }
    }

    /// Updates the whole turns of each link that has passed the direction -x since the last pose: +1 for
    /// counter-clockwise rotation, -1 for clockwise.
    #[inline]
    pub(super) fn count(&mut self, motions: &[Motion]) {
        for ((whole, last), motion) in self.whole.iter_mut().zip(&mut self.directions).zip(motions) {
            let now = motion.direction;
            *whole += crossing(*last, now);
            *last = now;
        }
    }

    /// Adds a number of whole turns to every link.
    pub(super) fn add(&mut self, turns: &[f64]) {
        self.whole.iter_mut().zip(turns).for_each(|(whole, turns)| *whole += turns);
    }

    /// Angles of all links at the last pose (rad), with their whole turns.
    pub(super) fn angles(&self) -> impl Iterator<Item = f64> {
        self.whole.ids().map(|link| self.angle(link))
    }

    /// Angle of one link.
    #[inline]
    pub(super) fn angle(&self, link: LinkId) -> f64 {
        principal(self.directions[link]) + TAU * self.whole[link]
    }
}

/// +1 if a direction has passed -x counter-clockwise, -1 if clockwise, otherwise 0. From `last` to `now`, the direction
/// must turn by less than half a turn.
#[inline]
pub(super) fn crossing(last: Vec2, now: Vec2) -> f64 {
    let (was_up, is_up) = (last.y >= 0.0, now.y >= 0.0);
    match (was_up, is_up) {
        (true, false) if cross(last, now) > 0.0 => 1.0,
        (false, true) if cross(last, now) < 0.0 => -1.0,
        (true | false, _) => 0.0,
    }
}

/// Angle of a direction (rad), from -pi to pi.
/// The addition of 0.0 changes -0.0 to 0.0. The angle on the axis -x is therefore +pi, as the count assumes.
#[inline]
pub(super) fn principal(direction: Vec2) -> f64 {
    (direction.y + 0.0).atan2(direction.x)
}
