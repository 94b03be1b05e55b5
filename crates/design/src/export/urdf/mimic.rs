//! Relations of joints in a URDF file: the element `mimic` for polynomials of degree 1, and JSON with all polynomials
//! and their errors.

use crate::export::limits::Follower;
use crate::export::xml::number;
use crate::relations::{MimicError, Mimics};
use crate::rigid::RigidModel;
use linkage::mechanism::JointId;

impl Mimics {
    /// The joints with relations of degree 1, as followers of the driven joint, and the offsets of these relations (rad
    /// or m).
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
