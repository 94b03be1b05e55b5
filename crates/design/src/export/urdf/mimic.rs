//! Joints that follow the driven joint by polynomials with proven errors: see [`relations`](crate::relations).

use super::chebyshev::Chebyshev;
use crate::export::limits::Follower;
use crate::export::rigid::RigidModel;
use crate::export::xml::number;
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

/// Coordinate of a joint as a polynomial of the driven joint's coordinate. Both are zero in the start pose.
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

/// Error of the place of a joint's point on a link, if all joints of the tree follow their polynomials.
#[derive(Clone, Debug, PartialEq)]
pub struct PinError {
    /// The joint.
    pub joint: JointId,
    /// The link.
    pub link: LinkId,
    /// Error of the place (m).
    pub error: MimicError,
}

/// All joints of the spanning tree as followers of the driven joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Mimics {
    pub(crate) driver: JointId,
    /// Range of the driven joint's coordinate (rad or m).
    pub domain: [f64; 2],
    pub(crate) degree: usize,
    /// The relations of all joints of the tree but the driven one.
    pub relations: Vec<JointRelation>,
    /// The errors of all pins that a relation places.
    pub pins: Vec<PinError>,
}

impl Mimics {
    /// The polynomial of a joint; `None` for the driven joint.
    pub(crate) fn polynomial(&self, joint: JointId) -> Option<&Chebyshev> {
        self.relations.iter().find(|own| own.joint == joint).map(|own| &own.polynomial)
    }

    /// The relations of degree 1 as followers of the driven joint, and their offsets (rad or m).
    pub(super) fn linear(&self) -> (Vec<Follower>, Vec<f64>) {
        let lines = self.relations.iter().filter_map(|own| Some((own.joint, own.polynomial.line()?)));
        lines.map(|(joint, [offset, multiplier])| (Follower { joint, leader: self.driver, multiplier }, offset)).unzip()
    }

    /// The relations with their errors as JSON on one line.
    pub(super) fn json(&self, model: &RigidModel) -> String {
        let quoted = |name: &str| format!("{name:?}").replace("--", "-\\u002d");
        let joint = |joint: JointId| quoted(model.joint_name(joint));
        let list = |values: &[f64]| values.iter().copied().map(number).collect::<Vec<_>>().join(", ");
        let error = |unit: &str, error: MimicError| {
            let [bound, sampled] = [error.bound, error.sampled].map(number);
            format!(r#""error_{unit}": {bound}, "sampled_{unit}": {sampled}"#)
        };
        let unit = |joint: JointId| if model.case.mechanism.joints()[joint].slides() { "m" } else { "rad" };
        let relations = self.relations.iter().map(|own| {
            let (name, coefficients) = (joint(own.joint), list(&own.polynomial.coefficients));
            let error = error(unit(own.joint), own.error);
            format!(r#"{{"joint": {name}, {error}, "chebyshev": [{coefficients}]}}"#)
        });
        let pins = self.pins.iter().map(|own| {
            let (name, link) = (joint(own.joint), quoted(model.link_name(own.link)));
            format!(r#"{{"joint": {name}, "link": {link}, {}}}"#, error("m", own.error))
        });
        let (relations, pins) = (relations.collect::<Vec<_>>().join(", "), pins.collect::<Vec<_>>().join(", "));
        let (driver, unit, domain) = (joint(self.driver), unit(self.driver), list(&self.domain));
        let head = format!(r#""driven": {driver}, "domain_{unit}": [{domain}], "degree": {}"#, self.degree);
        format!(r#"{{{head}, "joints": [{relations}], "pins": [{pins}]}}"#)
    }
}
