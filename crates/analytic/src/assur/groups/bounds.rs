//! Bounds of speeds over a step of the crank, from which follows that a dyad stays clear of its singular poses.
//!
//! Every dyad that can be singular has a gauge g, a smooth function of the places of its outer joints, and a range of
//! it: inside it can be assembled, at an end it is singular.
//! RRR: the square of the distance of its outer joints, from (l1 - l2)^2 to (l1 + l2)^2.
//! RRP: the distance h of its outer pin from the line of its inner joint, from -l to l.
//! RPR: the square of the distance of its outer pins, from that of its axes up.
//! PRP: the sine of the angle between its axes, with the sign of its branch, from 0 up.
//! Between two angles of the crank g differs from the straight line through its values there by M h^2 / 8 at most, h
//! being the step and M a bound of its second derivative.
//! M follows from bounds of the links that carry the dyad, and these from the crank's own motion, group by group.

use linkage::math::{KeepNan, Vec2};

/// Bounds of a link's motion while the crank turns by a step, per unit of its angle; without signs.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Bound {
    /// A point of the link, in its frame (m).
    pub(super) about: Vec2,
    /// Its speed (m) and acceleration (m).
    pub(super) speed: f64,
    pub(super) second: f64,
    /// The link's angular velocity and acceleration.
    pub(super) turn: f64,
    pub(super) spin: f64,
}

impl Bound {
    /// A link that rests.
    pub(in crate::assur) const REST: Bound =
        Bound { about: Vec2::new(0.0, 0.0), speed: 0.0, second: 0.0, turn: 0.0, spin: 0.0 };

    /// A link that is driven at a constant speed about a point with this speed and acceleration.
    pub(super) fn driven(about: Vec2, [speed, second]: [f64; 2], turn: f64) -> Self {
        Bound { about, speed, second, turn, spin: 0.0 }
    }

    /// Speed and acceleration of one of the link's points.
    pub(super) fn at(&self, local: Vec2) -> [f64; 2] {
        self.beyond((local - self.about).norm())
    }

    /// The same of a point that turns with the link at this distance from its known point.
    pub(super) fn beyond(&self, arm: f64) -> [f64; 2] {
        [self.speed + self.turn * arm, self.second + self.centripetal() * arm]
    }

    /// Acceleration of a point in units of its distance from one that rests.
    pub(super) fn centripetal(&self) -> f64 {
        self.spin + self.turn * self.turn
    }
}

/// Bounds of the links known so far; `None` for those that have none, as the links of higher groups.
pub(in crate::assur) type Bounds = [Option<Bound>];

/// What limits a dyad over a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Limit {
    /// Ends of the gauge's range.
    pub(in crate::assur) range: [f64; 2],
    /// Bound of the gauge's second derivative by the crank angle.
    pub(in crate::assur) second: f64,
    /// Way of the crank (rad) for which the bound is good.
    pub(in crate::assur) way: f64,
}

/// Bound of the second derivative of the square of a distance, from this relative speed and acceleration of its ends,
/// which are never farther apart than `most`.
pub(super) fn of_square([speed, second]: [f64; 2], most: f64) -> f64 {
    2.0 * (speed * speed + most * second)
}

/// Least value of (g - low) (high - g) on a band within the range: at one of its ends.
pub(super) fn least_product([low, high]: [f64; 2], band: [f64; 2]) -> f64 {
    let [first, last] = band.map(|gauge| (gauge - low) * (high - gauge));
    first.smaller(last)
}
