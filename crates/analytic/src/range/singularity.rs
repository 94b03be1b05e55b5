//! Singular poses, and values at a crank angle.

use crate::sentences;
use linkage::mechanism::GroupId;

linkage::words! {
    /// Kind of a singular pose.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SingularityKind: name {
        /// Limit of rotation of the crank: two configurations of a group coincide. Beyond the limit there is no
        /// configuration.
        /// The determinant goes to zero as the square root of the remaining crank angle.
        DeadPoint = sentences::LIMIT_OF_ROTATION_DEAD_POINT,
        /// Branches cross: the determinant passes through zero linearly in the crank angle. The crank need not reverse.
        ChangePoint = "change point",
        /// The two axes of an RPP or PRP dyad are parallel. As this pose is approached, the slides of the dyad grow
        /// without bound.
        ParallelAxes = "parallel axes",
        /// Another branch is so near the followed branch that the magnitude of the determinant is below 1e-3.
        /// The determinant keeps its sign.
        BranchContact = "branch contact",
    }
}

/// A singular or nearly singular pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singularity {
    /// Kind.
    pub kind: SingularityKind,
    /// Crank angle (rad, in the scenario's convention), accurate to 1e-9 rad.
    /// For a contact, the crank angle at which the magnitude of the determinant is smallest.
    pub crank: f64,
    /// The group with the zero determinant: index in [`Structure::groups`](linkage::mechanism::Structure::groups).
    pub group: GroupId,
    /// Normalised determinant of the group in this pose: 0, except for a contact. For a dyad, the arc sine of the
    /// determinant is the transmission angle.
    pub determinant: f64,
}

/// A value and the crank angle (rad) at which it occurs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueAtCrank {
    /// Crank angle (rad, in the scenario's convention).
    pub crank: f64,
    /// The value.
    pub value: f64,
}
