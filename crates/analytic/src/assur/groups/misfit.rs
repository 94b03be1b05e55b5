//! Reasons why a group cannot be placed.

/// Reasons why a group cannot be placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Misfit {
    /// RRR: the two links are too short or too long to span the distance of the outer joints.
    Span {
        /// Distance of the outer joints (m).
        distance: f64,
        /// Shortest and longest distance that the two links can span (m).
        reach: [f64; 2],
    },
    /// RRP: the distance of the outer pin from the line on which the inner joint moves exceeds the length of the rod.
    Guide {
        /// Distance of the pin from the line (m).
        distance: f64,
        /// Length of the rod (m).
        length: f64,
    },
    /// RPR: the outer pins are closer together than the offset of the second pin from the axis through the first pin.
    Swing {
        /// Distance of the pins (m).
        distance: f64,
        /// Smallest possible distance (m).
        shortest: f64,
    },
    /// RPP, PRP: the two axes are parallel.
    Parallel,
    /// The pose is singular: a dead point, or a change point where two branches meet.
    Singular,
    /// The step to the pose has passed a change point.
    Passed {
        /// Crank angle of the change point (rad, as the scenario states it).
        crank: f64,
    },
    /// The branch of a higher group could not be followed.
    Lost,
}

/// Distance of a dyad from a singular pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularityDistance {
    /// Sine of the transmission angle, or the corresponding measure of the dyad: from 0 (singular) to about 1.
    pub sine: f64,
    /// Time derivative of `sine` (1/s).
    pub rate: f64,
}

/// A pose is singular if [`SingularityDistance::sine`] of a dyad is below this value.
/// The error of a dyad's angles is the rounding error divided by this sine. Below the limit the sine itself is mostly
/// rounding error.
pub const SINGULAR: f64 = 1e-7;

/// If the sine of the angle between two axes is below this value, the axes count as parallel, because the sine may be
/// rounding error.
const PARALLEL: f64 = 1e-14;

/// Returns the sign of the sine of the angle between two axes.
/// If the sign `side` of the branch is known, the sign of the sine must agree with it. A changed sign means that a
/// slide has passed through infinity to another branch.
/// A dyad whose axes are parallel within rounding error has no pose.
pub(super) fn kept_side(side: f64, sine: f64) -> Result<f64, Misfit> {
    let now = sine.signum();
    if !(sine.abs() > PARALLEL) || side * now < 0.0 { Err(Misfit::Parallel) } else { Ok(now) }
}
