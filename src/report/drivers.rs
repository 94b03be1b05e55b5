//! Structures of a mechanism for other driven joints.

use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::mechanism::{JointId, Structure};
use serde_json::{Value, json};

use super::pretty::list;

/// For each joint of a list, the structure with this joint as driven joint, or the reason why it does not exist.
pub(crate) struct Drivers(Vec<(String, Result<Structure>)>);

impl Drivers {
    /// For each of these joints, the structure of the case if the first drive moves this joint.
    pub(crate) fn of(case: &Case, joints: &[JointId]) -> Self {
        let name = |joint: JointId| case.mechanism.joints()[joint].name.clone();
        Drivers(joints.iter().map(|&joint| (name(joint), case.structure_at(joint))).collect())
    }

    /// One line for each joint: class and structural formula, or the reason.
    pub(crate) fn text(&self, case: &Case) -> String {
        let mut text = String::from(sentences::STRUCTURE_FOR_OTHER_DRIVEN_JOINTS);
        for (joint, structure) in &self.0 {
            match structure {
                Ok(own) => say!(text, sentences::driven_at(joint, &class(own), &own.formula(&case.mechanism))),
                Err(error) => say!(text, sentences::not_driven_at(joint, &error.message())),
            }
        }
        text
    }

    /// The structures as JSON.
    pub(crate) fn json(&self, case: &Case) -> Value {
        list(&self.0, |(joint, structure)| match structure {
            Ok(own) => json!({
                "joint": joint, "class": class(own), "formula": own.formula(&case.mechanism),
                "groups": list(&own.groups, |group| json!(group.bodies(&case.mechanism))),
            }),
            Err(error) => json!({"joint": joint, "reason": error.message()}),
        })
    }
}

/// Class of a mechanism: the highest class of its groups.
fn class(structure: &Structure) -> usize {
    structure.groups.iter().map(|group| group.class).fold(1, usize::max)
}
