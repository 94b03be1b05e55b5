//! Why a group cannot be placed.

/// Why a group cannot be placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Misfit {
    /// RRR: distance of the outer joints, and the shortest and longest distance that the links can span (m).
    Span {
        /// Distance of the outer joints (m).
        distance: f64,
        /// Shortest and longest distance that the two links can span (m).
        reach: [f64; 2],
    },
    /// RRP: the outer pin is farther from the line of the inner joint than the rod is long (m).
    Guide {
        /// Distance of the pin from the line (m).
        distance: f64,
        /// Length of the rod (m).
        length: f64,
    },
    /// RPR: the outer pins are closer together than their distances from the axis allow (m).
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
    /// A higher group whose branch could not be followed.
    Lost,
}

/// How far a dyad is from a singular pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularityDistance {
    /// Sine of the transmission angle, or what it is for the dyad: from 0 (singular) to about 1.
    pub sine: f64,
    /// Its rate in time (1/s).
    pub rate: f64,
}

/// Clearance below which a pose is singular.
/// The angles of a dyad are known to rounding over this sine: below it the sine itself is mostly rounding.
pub const SINGULAR: f64 = 1e-7;

/// Sine of the angle between two axes below which it is zero to rounding.
const PARALLEL: f64 = 1e-14;

/// Sign of the sine of the angle between two axes, checked against `side` once that is known.
/// A dyad that passed through infinity is on another branch. A dyad whose axes are parallel to rounding has no
/// pose.
pub(super) fn kept_side(side: f64, sine: f64) -> Result<f64, Misfit> {
    let now = sine.signum();
    if !(sine.abs() > PARALLEL) || side * now < 0.0 { Err(Misfit::Parallel) } else { Ok(now) }
}
