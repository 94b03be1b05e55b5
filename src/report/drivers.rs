//! Structures of a mechanism for other driven joints.

use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::{GROUND, Group, Joint, JointId, Mechanism, Structure, roman};
use serde_json::{Value, json};

use super::pretty::list;

/// For each joint of a list, the structure with this joint as driven joint, or the reason why it does not exist.
pub(crate) struct Drivers(Vec<Driver>);

/// A joint, and the structure of the mechanism if the first drive moves this joint.
struct Driver {
    joint: JointId,
    structure: Result<Structure>,
}

impl Drivers {
    /// For each of these joints, the structure of the case if the first drive moves this joint.
    pub(crate) fn of(case: &Case, joints: &[JointId]) -> Self {
        Drivers(joints.iter().map(|&joint| Driver { joint, structure: case.structure_at(joint) }).collect())
    }

    /// The joint and its structure, for a list of one joint.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for several joints; the reason if the structure does not exist.
    pub(crate) fn only(&self) -> Result<(JointId, Structure)> {
        match &self.0[..] {
            [one] => Ok((one.joint, one.structure.clone()?)),
            all => {
                let error = Error::new(ErrorKind::Input, sentences::a_drawing_shows_one_driver(&all.len()));
                Err(error.help(sentences::GIVE_THE_JOINT_INSTEAD))
            }
        }
    }

    /// For several joints, a table with the class and structural formula for each; for a single joint, the structure
    /// with its groups.
    pub(crate) fn text(&self, case: &Case) -> String {
        match &self.0[..] {
            [one] => one.text(case),
            all => table(all, case),
        }
    }

    /// The structures as JSON.
    pub(crate) fn json(&self, case: &Case) -> Value {
        let mechanism = &case.mechanism;
        list(&self.0, |own| {
            let joint = &mechanism.joints()[own.joint];
            let mut told = json!({"joint": joint.name, "links": moved(mechanism, joint)});
            match &own.structure {
                Ok(found) => {
                    told["class"] = found.class().into();
                    told["is_chain_of_dyads"] = found.is_chain_of_dyads().into();
                    told["formula"] = found.formula(mechanism).into();
                    told["numbered_formula"] = found.numbered_formula(mechanism).into();
                    told["groups"] = list(&found.groups, |group| json!(group.bodies(mechanism)));
                }
                Err(error) => told["reason"] = error.message().into(),
            }
            told
        })
    }
}

impl Driver {
    /// The structure with this driven joint, and its groups. If the file drives another joint, also that joint and the
    /// class with it.
    fn text(&self, case: &Case) -> String {
        let mechanism = &case.mechanism;
        let joint = &mechanism.joints()[self.joint];
        let present = &mechanism.joints()[case.crank().joint];
        let links = moved(mechanism, joint).join(" - ");
        let mut text = sentences::driver_at(&links, &joint.name, &joint.kind.name());
        let structure = match &self.structure {
            Ok(structure) => structure,
            Err(error) => return text + &sentences::not_possible(&error.message()),
        };
        let dyads =
            if structure.is_chain_of_dyads() && structure.class() > 1 { sentences::A_CHAIN_OF_DYADS } else { "" };
        let before = match self.joint == case.crank().joint {
            true => sentences::AS_IN_THE_FILE.to_string(),
            false => sentences::driven_in_the_file(&present.name, &roman(case.structure.class())),
        };
        text += &sentences::class_of_the_mechanism(&roman(structure.class()), &dyads, &before);
        text += &sentences::structure_and_numbers(
            &structure.formula(mechanism),
            &structure.numbered_formula(mechanism),
            &numbers(mechanism),
        );
        if !structure.groups.is_empty() {
            text += sentences::GROUPS_IN_THE_ORDER_OF_SOLUTION;
        }
        let names = |joints: &[JointId]| {
            let names: Vec<&str> = joints.iter().map(|&joint| mechanism.joints()[joint].name.as_str()).collect();
            if names.is_empty() { "-".to_string() } else { names.join(", ") }
        };
        let line = |group: &Group| {
            let (bodies, inner, outer) = (group.bodies(mechanism), names(&group.inner), names(&group.outer));
            sentences::a_group(&bodies, &roman(group.class), &group.order(), &group.pairs(), &inner, &outer)
        };
        text + &structure.groups.iter().map(line).collect::<String>()
    }
}

/// The links that a drive at this joint moves: the joint's links except the ground.
fn moved<'a>(mechanism: &'a Mechanism, joint: &Joint) -> Vec<&'a str> {
    let links = [joint.first.link, joint.second.link].into_iter().filter(|&link| link != GROUND);
    links.map(|link| mechanism.links()[link].name.as_str()).collect()
}

/// The numbers of all links, as in `0 ground, 1 crank`.
fn numbers(mechanism: &Mechanism) -> String {
    let links = mechanism.links().entries().map(|(id, link)| format!("{id} {}", link.name));
    links.collect::<Vec<_>>().join(", ")
}

/// A table with one line for each joint: first the joints on the ground, then the joints between moving links.
fn table(all: &[Driver], case: &Case) -> String {
    let mechanism = &case.mechanism;
    let is_on_ground = |own: &&Driver| mechanism.joints()[own.joint].on(GROUND).is_some();
    let (grounded, between): (Vec<&Driver>, Vec<&Driver>) = all.iter().partition(is_on_ground);
    let rows = grounded.into_iter().chain(between).map(|own| {
        let joint = &mechanism.joints()[own.joint];
        let (class, structure) = match &own.structure {
            Ok(found) => (roman(found.class()), found.numbered_formula(mechanism)),
            Err(error) => ("-".into(), sentences::not_possible(&error.message()).trim().to_string()),
        };
        let present = if own.joint == case.crank().joint { sentences::AS_IN_THE_FILE } else { "" };
        [moved(mechanism, joint).join(" - "), joint.name.clone(), class, structure + present]
    });
    let head = sentences::COLUMNS_OF_DRIVERS.split(", ").map(String::from).collect::<Vec<_>>();
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows.map(Vec::from)).collect();
    let wide = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let wide = [0, 1, 2].map(wide);
    let mut text = String::from(sentences::STRUCTURE_FOR_OTHER_DRIVEN_JOINTS);
    for row in &rows {
        let cells = row.iter().zip(wide).map(|(cell, wide)| format!("  {cell:wide$}")).collect::<String>();
        say!(text, "{cells}  {}", row[3]);
    }
    let chains = all.iter().filter(|own| own.structure.as_ref().is_ok_and(Structure::is_chain_of_dyads));
    let chains: Vec<&str> = chains.map(|own| mechanism.joints()[own.joint].name.as_str()).collect();
    if !chains.is_empty() {
        text += &sentences::chains_of_dyads(&chains.join(", "));
    }
    text + &sentences::numbers_of_links(&numbers(mechanism))
}
