//! Singular (Assur) point of groups of class III and IV: the intersection of the lines of two leads.
//! A lead is a link of the group with two joints; a base link has three.
//! With this point, velocities and accelerations are found without a system of equations.

mod fourth;
mod leads;
mod point;
mod third;

pub use point::{AssurAcceleration, AssurLead, AssurTrial, FalsePositions, SingularPoint};

use linkage::case::Case;
use linkage::error::Result;
use linkage::math::Motion;
use linkage::mechanism::Group;

impl SingularPoint {
    /// Computes the singular point of `group`.
    /// `None` if the group is neither of class IV and order 2, nor of class III and order 3 with pins only.
    /// Of `motions`, this function uses only the poses of the group's links, and the motions of links that are solved
    /// before the group.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`](linkage::error::ErrorKind::Geometry) at a dead point: the leads are parallel, the point
    /// is in line with the outer joints (class IV), or all three leads meet in the point (class III).
    pub fn of(case: &Case, group: &Group, motions: &[Motion]) -> Result<Option<Self>> {
        match group.class {
            3 => third::point(&case.mechanism, group, motions),
            _ => fourth::point(&case.mechanism, group, motions),
        }
    }

    /// The singular points of all groups. A group at a dead point gives an error. Other groups without a singular point
    /// are left out.
    pub fn all(case: &Case, motions: &[Motion]) -> Vec<Result<Self>> {
        case.structure.groups.iter().filter_map(|group| Self::of(case, group, motions).transpose()).collect()
    }
}
