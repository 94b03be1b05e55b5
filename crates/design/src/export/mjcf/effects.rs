//! Motors and loads in the document: sites, tendons, actuators.

use crate::sentences;
use std::fmt::Write;

use quick_xml::escape::escape;

use super::forces::{Actuator, Forces, Target};
use super::model::MjcfModel;
use super::names;
use crate::export::xml::{Xml, flat, number, numbers};
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, JointSide, LinkId};

/// Name of the site on the ground whose axes are the world axes, for loads in world axes.
const AXES: &str = "world.axes";

/// A site of a link.
pub(super) fn site(xml: &mut Xml, name: &str, place: Vec2) {
    xml.leaf(format_args!(r#"site name="{}" pos="{}""#, escape(name), flat(place)));
}

/// Writes the sites of a link at which loads act. The ground also gets the site that defines the world axes.
pub(super) fn sites(xml: &mut Xml, forces: &Forces, link: LinkId) {
    for (name, place) in places(forces, link) {
        site(xml, &name, place);
    }
    let is_world = |target: &Target| matches!(target, Target::Place { follows: false, .. });
    if link == GROUND && forces.actuators.iter().any(|own| is_world(&own.target)) {
        xml.comment(sentences::FORCES_IN_WORLD_AXES_REFER);
        site(xml, AXES, Vec2::zeros());
    }
}

/// Writes the tendons. The length of a fixed tendon is a sum of joint coordinates; frictions, actuators and
/// transmissions use fixed tendons. Springs and dampers between points are spatial tendons.
pub(super) fn tendons<'a>(xml: &mut Xml, model: &MjcfModel, forces: &'a Forces) {
    let long: Vec<_> = model.frictions.iter().filter(|friction| !friction.own_hinge).collect();
    let sum = |own: &'a Actuator| match &own.target {
        Target::Sum(sum) => Some((&own.name, sum)),
        Target::Hinge(_) | Target::Place { .. } => None,
    };
    let sums: Vec<_> = forces.actuators.iter().filter_map(sum).collect();
    let transmissions = model.case.mechanism.transmissions();
    if long.is_empty() && sums.is_empty() && forces.tendons.is_empty() && transmissions.is_empty() {
        return;
    }
    let hinge = |xml: &mut Xml, branch: usize, factor: f64| {
        xml.leaf(format_args!(r#"joint joint="{}" coef="{}""#, joint(model, branch), number(factor)));
    };
    xml.nest("tendon", |xml| {
        for friction in long {
            let name = escape(model.case.mechanism.links()[friction.link].name.as_str());
            let loss = number(friction.moment);
            xml.comment(sentences::ITS_LENGTH_IS_THE_LINK_ANGLE);
            xml.nest(format_args!(r#"fixed name="{name}" frictionloss="{loss}""#), |xml| {
                friction.hinges.iter().for_each(|&branch| hinge(xml, branch, 1.0));
            });
        }
        for (name, sum) in sums {
            xml.comment(sentences::ITS_LENGTH_IS_THE_ANGLE_THAT_THE_LOAD);
            xml.nest(format_args!(r#"fixed name="{name}""#), |xml| {
                sum.iter().for_each(|&(branch, factor)| hinge(xml, branch, factor));
            });
        }
        for transmission in transmissions {
            let name = names::of_transmission(transmission);
            let name = escape(&name);
            xml.comment(sentences::ITS_LENGTH_IS_CONSTANT);
            xml.nest(format_args!(r#"fixed name="{name}""#), |xml| {
                model.coupled(transmission).iter().for_each(|&(branch, factor)| hinge(xml, branch, factor));
            });
        }
        for tendon in &forces.tendons {
            let name = &tendon.name;
            let [stiffness, damping, length] = [tendon.stiffness, tendon.damping, tendon.free_length].map(number);
            let spring = format!(r#"stiffness="{stiffness}" springlength="{length}" damping="{damping}""#);
            xml.nest(format_args!(r#"spatial name="{name}" {spring}"#), |xml| {
                for index in 0..tendon.ends.len() {
                    xml.leaf(format_args!(r#"site site="{}""#, end(name, index)));
                }
            });
        }
    });
}

/// Name of the joint of a branch.
fn joint<'a>(model: &'a MjcfModel, branch: usize) -> std::borrow::Cow<'a, str> {
    escape(model.case.mechanism.joints()[model.tree.branches[branch].joint].name.as_str())
}

/// Name of the site of a load.
fn end(load: &str, index: usize) -> String {
    format!("{load}.{}", ["first", "second"][index])
}

/// Positions at which loads act on a link, each with the name of its site.
fn places(forces: &Forces, link: LinkId) -> Vec<(String, Vec2)> {
    let ends = forces.tendons.iter().flat_map(|tendon| {
        let named = |(index, side): (usize, &JointSide)| (*side, end(&tendon.name, index));
        tendon.ends.iter().enumerate().map(named).collect::<Vec<_>>()
    });
    let pushed = forces.actuators.iter().filter_map(|own| match own.target {
        Target::Place { at, .. } => Some((at, end(&own.name, 0))),
        Target::Hinge(_) | Target::Sum(_) => None,
    });
    ends.chain(pushed).filter(|(side, _)| side.link == link).map(|(side, name)| (name, side.local)).collect()
}

/// Writes the actuators of motors and loads. The actuators have no control input.
/// The force of an actuator is `biasprm[0] + biasprm[1] length + biasprm[2] rate`.
pub(super) fn actuators(xml: &mut Xml, model: &MjcfModel, forces: &Forces) {
    if forces.actuators.is_empty() {
        return;
    }
    xml.nest("actuator", |xml| {
        for actuator in &forces.actuators {
            let name = escape(actuator.name.as_str());
            let target = match &actuator.target {
                Target::Hinge(branch) => format!(r#"joint="{}""#, joint(model, *branch)),
                Target::Sum(_) => format!(r#"tendon="{name}""#),
                Target::Place { force, moment, follows, .. } => {
                    let axes = if *follows { String::new() } else { format!(r#" refsite="{AXES}""#) };
                    let gear = numbers([force.x, force.y, 0.0, 0.0, 0.0, *moment]);
                    format!(r#"site="{}"{axes} gear="{gear}""#, end(&name, 0))
                }
            };
            let bias = numbers(actuator.bias);
            let mut tag = format!(r#"general name="{name}" {target} gainprm="0" biastype="affine" biasprm="{bias}""#);
            if let Some(range) = actuator.range {
                let _ = write!(tag, r#" forcelimited="true" forcerange="{}""#, numbers(range));
            }
            xml.leaf(tag);
        }
    });
}
