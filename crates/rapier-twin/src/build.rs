//! How a mechanism is put together in Rapier, and in which precision.

/// How a mechanism is put together in Rapier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Build {
    /// A spanning tree as a multibody, loops closed by impulse joints.
    Multibody,
    /// Bodies of their own, every joint an impulse joint.
    Impulse,
}

/// Length of Rapier's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// f64: the crate `rapier2d-f64`.
    Double,
    /// f32: the crate `rapier2d`.
    #[cfg(feature = "f32")]
    Single,
}

impl Precision {
    /// Distance from one to the next number.
    #[must_use]
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::Double => f64::EPSILON,
            #[cfg(feature = "f32")]
            Precision::Single => f64::from(f32::EPSILON),
        }
    }
}
