//! How a mechanism is built in Rapier, and in which precision.

/// How a mechanism is built in Rapier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Build {
    /// The spanning tree is a multibody; impulse joints close the loops.
    Multibody,
    /// Every link is a separate rigid body, every joint an impulse joint.
    Impulse,
}

/// Precision of Rapier's floating-point numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// f64: the crate `rapier2d-f64`.
    Double,
    /// f32: the crate `rapier2d`.
    #[cfg(feature = "f32")]
    Single,
}

impl Precision {
    /// Machine epsilon: the distance from 1 to the next number.
    #[must_use]
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::Double => f64::EPSILON,
            #[cfg(feature = "f32")]
            Precision::Single => f64::from(f32::EPSILON),
        }
    }
}
