//! Bounds of the links' speeds over a step of the crank, which prove that a dyad passes no singular pose in this step.
//!
//! Every dyad that can be singular has a gauge g, a smooth function of the positions of its outer joints.
//! Inside the gauge's range the dyad can be assembled; at an end of the range the dyad is singular.
//! RRR: the squared distance of its outer joints, from (l1 - l2)^2 to (l1 + l2)^2.
//! RRP: the signed distance h of its outer pin from the line along which its inner joint moves, from -l to l.
//! RPR: the squared distance of its outer pins, from the square of the axes' offset upwards.
//! PRP: the sine of the angle between its axes, with the sign of its branch, from 0 upwards.
//! Between two crank angles g differs from linear interpolation by at most M h^2 / 8.
//! Here h is the step and M a bound of the second derivative of g.
//! M follows from the bounds of the links that carry the dyad. These bounds follow from the crank's motion, group by
//! group.

use linkage::math::{KeepNan, Vec2};

/// Bounds of a link's motion during a step. The bounds are magnitudes of derivatives with respect to the crank angle.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Bound {
    /// Reference point of the link, in its frame (m).
    pub(super) about: Vec2,
    /// Speed and acceleration of the reference point (m per rad and m per rad^2 of the crank angle).
    pub(super) speed: f64,
    pub(super) second: f64,
    /// Angular velocity and angular acceleration of the link (rad per rad and rad per rad^2 of the crank angle).
    pub(super) turn: f64,
    pub(super) spin: f64,
}

impl Bound {
    /// A link at rest.
    pub(in crate::assur) const REST: Bound =
        Bound { about: Vec2::new(0.0, 0.0), speed: 0.0, second: 0.0, turn: 0.0, spin: 0.0 };

    /// Bounds of a link that turns at a constant speed. The link turns about the point `about`, whose speed and
    /// acceleration are given.
    pub(super) fn driven(about: Vec2, [speed, second]: [f64; 2], turn: f64) -> Self {
        Bound { about, speed, second, turn, spin: 0.0 }
    }

    /// Bounds on the speed and on the acceleration of the point `local` of the link.
    pub(super) fn at(&self, local: Vec2) -> [f64; 2] {
        self.beyond((local - self.about).norm())
    }

    /// Bounds of the speed and acceleration of a point at the distance `arm` (m) from the reference point.
    pub(super) fn beyond(&self, arm: f64) -> [f64; 2] {
        [self.speed + self.turn * arm, self.second + self.centripetal() * arm]
    }

    /// Bound on the acceleration of a point of the link relative to the reference point, divided by the distance of
    /// the two points.
    pub(super) fn centripetal(&self) -> f64 {
        self.spin + self.turn * self.turn
    }
}

/// The bounds known so far, one per link; `None` for links without bounds, for example links of higher groups.
pub(in crate::assur) type Bounds = [Option<Bound>];

/// Range of a dyad's gauge over a step, and a bound of the gauge's second derivative.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Limit {
    /// Ends of the gauge's range.
    pub(in crate::assur) range: [f64; 2],
    /// Bound of the gauge's second derivative with respect to the crank angle.
    pub(in crate::assur) second: f64,
    /// Crank travel (rad) for which the bound is valid.
    pub(in crate::assur) way: f64,
}

/// Bound on the second derivative of the squared distance between two points.
/// The inputs are bounds on the relative speed and on the relative acceleration.
/// `most` is the largest distance of the two points.
pub(super) fn of_square([speed, second]: [f64; 2], most: f64) -> f64 {
    2.0 * (speed * speed + most * second)
}

/// Smallest value of (g - low) (high - g) on a band within the range. The minimum is at an end of the band.
pub(super) fn least_product([low, high]: [f64; 2], band: [f64; 2]) -> f64 {
    let [first, last] = band.map(|gauge| (gauge - low) * (high - gauge));
    first.smaller(last)
}
