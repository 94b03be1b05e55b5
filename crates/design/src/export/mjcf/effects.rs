//! Motors and loads in the document: sites, tendons, actuators.

use super::forces::{Forces, Target};
use super::model::Model;
use super::xml::{Xml, flat, number, numbers};
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, LinkId, Side};

/// Site on the ground to which forces in world axes refer.
const AXES: &str = "world.axes";

/// Sites of a link at which loads act; on the ground also the one that tells the world's axes.
pub(super) fn sites(xml: &mut Xml, forces: &Forces, link: LinkId) {
    for (name, place) in places(forces, link) {
        xml.leaf("site", &[("name", &name), ("pos", &flat(place))]);
    }
    let is_world = |target: &Target| matches!(target, Target::Place(_, _, false));
    if link == GROUND && forces.actuators.iter().any(|own| is_world(&own.target)) {
        xml.comment("Forces in world axes refer to it.");
        xml.leaf("site", &[("name", AXES), ("pos", "0 0 0")]);
    }
}

/// Tendons: sums of angles that frictions and actuators act on, and springs and dampers between points.
pub(super) fn tendons(xml: &mut Xml, model: &Model, forces: &Forces) {
    let long: Vec<_> = model.frictions.iter().filter(|friction| !friction.own_hinge).collect();
    let sums: Vec<_> = forces.actuators.iter().filter_map(|own| Some((own, sum(&own.target)?))).collect();
    if long.is_empty() && sums.is_empty() && forces.tendons.is_empty() {
        return;
    }
    let hinge = |xml: &mut Xml, branch: usize, factor: f64| {
        let joint = &model.case.mechanism.joints()[model.tree.branches[branch].joint];
        xml.leaf("joint", &[("joint", &joint.name), ("coef", &number(factor))]);
    };
    xml.nest("tendon", &[], |xml| {
        for friction in long {
            let name = &model.case.mechanism.links()[friction.link].name;
            xml.comment("Its length is the link's angle.");
            xml.nest("fixed", &[("name", name), ("frictionloss", &number(friction.moment))], |xml| {
                friction.hinges.iter().for_each(|&branch| hinge(xml, branch, 1.0));
            });
        }
        for (actuator, sum) in sums {
            xml.comment("Its length is the angle that the load depends on.");
            xml.nest("fixed", &[("name", &actuator.name)], |xml| {
                sum.iter().for_each(|&(branch, factor)| hinge(xml, branch, factor));
            });
        }
        for tendon in &forces.tendons {
            let [stiffness, damping, length] = [tendon.stiffness, tendon.damping, tendon.free_length].map(number);
            let spring = [
                ("name", tendon.name.as_str()),
                ("stiffness", &stiffness),
                ("springlength", &length),
                ("damping", &damping),
            ];
            xml.nest("spatial", &spring, |xml| {
                for index in 0..tendon.ends.len() {
                    xml.leaf("site", &[("site", &end(&tendon.name, index))]);
                }
            });
        }
    });
}

/// Name of the site of a load.
fn end(load: &str, index: usize) -> String {
    format!("{load}.{}", ["first", "second"][index])
}

fn sum(target: &Target) -> Option<&[(usize, f64)]> {
    match target {
        Target::Sum(sum) => Some(sum),
        Target::Hinge(_) | Target::Place(..) => None,
    }
}

/// Places at which loads act on a link, with the names of their sites.
fn places(forces: &Forces, link: LinkId) -> Vec<(String, Vec2)> {
    let ends = forces.tendons.iter().flat_map(|tendon| {
        let named = |(index, side): (usize, &Side)| (*side, end(&tendon.name, index));
        tendon.ends.iter().enumerate().map(named).collect::<Vec<_>>()
    });
    let pushed = forces.actuators.iter().filter_map(|own| match own.target {
        Target::Place(side, ..) => Some((side, end(&own.name, 0))),
        Target::Hinge(_) | Target::Sum(_) => None,
    });
    ends.chain(pushed).filter(|(side, _)| side.link == link).map(|(side, name)| (name, side.local)).collect()
}

/// Motors and loads: no control enters, the force is `biasprm[0] + biasprm[1] length + biasprm[2] rate`.
pub(super) fn actuators(xml: &mut Xml, model: &Model, forces: &Forces) {
    if forces.actuators.is_empty() {
        return;
    }
    xml.nest("actuator", &[], |xml| {
        for actuator in &forces.actuators {
            let bias = numbers(actuator.bias);
            let mut own = vec![("name", actuator.name.clone())];
            match &actuator.target {
                Target::Hinge(branch) => {
                    let joint = &model.case.mechanism.joints()[model.tree.branches[*branch].joint];
                    own.push(("joint", joint.name.clone()));
                }
                Target::Sum(_) => own.push(("tendon", actuator.name.clone())),
                Target::Place(_, force, follows) => {
                    own.push(("site", end(&actuator.name, 0)));
                    if !follows {
                        own.push(("refsite", AXES.into()));
                    }
                    own.push(("gear", numbers([force.x, force.y, 0.0, 0.0, 0.0, 0.0])));
                }
            }
            own.extend([("gainprm", "0".to_string()), ("biastype", "affine".into()), ("biasprm", bias)]);
            if let Some(range) = actuator.range {
                own.extend([("forcelimited", "true".to_string()), ("forcerange", numbers(range))]);
            }
            let attributes: Vec<(&str, &str)> = own.iter().map(|(name, value)| (*name, value.as_str())).collect();
            xml.leaf("general", &attributes);
        }
    });
}
