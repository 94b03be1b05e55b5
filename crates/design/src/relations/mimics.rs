//! Joints that follow the driven joint by polynomials with proven errors.

use super::chebyshev::Chebyshev;
use linkage::mechanism::{JointId, LinkId};

/// Largest degree of the polynomials.
pub const MOST_DEGREE: usize = 60;

/// Largest error over the range.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MimicError {
    /// Proven bound (rad or m).
    pub bound: f64,
    /// Largest error of the sampled poses (rad or m).
    pub sampled: f64,
}

/// Coordinate of a joint as a polynomial of the driven joint's coordinate. Both coordinates are zero in the start pose.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRelation {
    /// The joint.
    pub joint: JointId,
    pub(crate) polynomial: Chebyshev,
    /// Error of the joint's coordinate (rad or m).
    pub error: MimicError,
}

impl JointRelation {
    /// Coordinate of the joint (rad or m) for a coordinate of the driven joint (rad or m).
    #[must_use]
    pub fn at(&self, driven: f64) -> f64 {
        self.polynomial.at(driven)[0]
    }
}

/// Error of the position of a joint's point on a link. The error arises if all joints of the tree follow their
/// polynomials.
#[derive(Clone, Debug, PartialEq)]
pub struct PinError {
    /// The joint.
    pub joint: JointId,
    /// The link.
    pub link: LinkId,
    /// Error of the point's position (m).
    pub error: MimicError,
}

/// All joints of the spanning tree as followers of the driven joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Mimics {
    pub(crate) driver: JointId,
    /// Range of the driven joint's coordinate (rad or m).
    pub domain: [f64; 2],
    pub(crate) degree: usize,
    /// The relations of all joints of the tree, except the driven joint.
    pub relations: Vec<JointRelation>,
    /// The position errors of those points of joints that the relations move.
    pub pins: Vec<PinError>,
}

impl Mimics {
    /// The polynomial of a joint; `None` for the driven joint.
    pub(crate) fn polynomial(&self, joint: JointId) -> Option<&Chebyshev> {
        self.relations.iter().find(|own| own.joint == joint).map(|own| &own.polynomial)
    }
}
