//! The XML document.
//! Simple shapes show the links. The shapes have no mass and no contacts.

use crate::sentences;
use std::fmt::Write;

use quick_xml::escape::escape;

use super::effects;
use super::forces::Forces;
use super::model::MjcfModel;
use super::names::{of_transmission, side};
use crate::export::shapes::{self, Shape};
use crate::export::xml::{Xml, about_z, flat, number, numbers};
use crate::rigid::Freedom;
use linkage::math::{KeepNan, corners};
use linkage::mechanism::{GROUND, LinkId};

/// Stiffness of every constraint, as explained in the documentation of the module `mjcf`.
const STIFF: &str = "1e-9 0.5";
/// Impedance of every constraint: the largest impedance that MuJoCo accepts, the same for every gap.
const HARD: &str = "0.9999 0.9999 1";
/// The whole document.
pub(super) fn document(model: &MjcfModel, forces: &Forces) -> String {
    let mut xml = Xml::new();
    xml.nest(format_args!(r#"mujoco model="{}""#, escape(model.name)), |xml| {
        xml.comment(concat!(
            "Written by linkproof ",
            env!("CARGO_PKG_VERSION"),
            "; SI units, plane XOY. Load the keyframe \"start\": without it nothing moves."
        ));
        options(xml, model);
        xml.nest("worldbody", |xml| world(xml, model, forces));
        loops(xml, model);
        effects::tendons(xml, model, forces);
        effects::actuators(xml, model, forces);
        sensors(xml, model);
        keyframe(xml, model);
    });
    xml.text
}

fn options(xml: &mut Xml, model: &MjcfModel) {
    xml.leaf(r#"compiler angle="radian" autolimits="false" inertiafromgeom="false""#);
    // MuJoCo multiplies the solver's tolerance by the trace of the inertia matrix, which contains the heavy rotor.
    // Only a tolerance of zero is therefore small enough.
    // Newton's method needs two iterations. The limit of 20 stops iterations that rounding errors would prolong.
    let solver = r#"integrator="implicitfast" solver="Newton" iterations="20" tolerance="0" ls_tolerance="1e-6""#;
    let (step, gravity) = (number(model.step), flat(model.case.gravity));
    xml.nest(format_args!(r#"option timestep="{step}" gravity="{gravity}" {solver}"#), |xml| {
        xml.leaf(r#"flag contact="disable" refsafe="enable""#);
    });
    let poses = &model.case.start.0;
    let joints = model.case.mechanism.joints().iter();
    let [low, high] = corners(joints.map(|joint| poses[joint.second.link].point(joint.second.local)));
    let (centre, extent) = (flat((low + high) / 2.0), number((high - low).norm().larger(model.size())));
    xml.leaf(format_args!(r#"statistic center="{centre}" extent="{extent}""#));
    xml.nest("visual", |xml| {
        // View from above: x right, y up.
        xml.leaf(r#"global azimuth="90" elevation="-90""#);
    });
    xml.comment(sentences::AS_STIFF_AS_A_STEP_ALLOWS);
    xml.nest("default", |xml| {
        xml.leaf(format_args!(r#"equality solref="{STIFF}" solimp="{HARD}""#));
        let friction = format!(r#"solreffriction="{STIFF}" solimpfriction="{HARD}""#);
        xml.leaf(format_args!(r#"joint {friction} damping="0""#));
        xml.leaf(format_args!("tendon {friction}"));
        xml.leaf(r#"geom contype="0" conaffinity="0""#);
        xml.leaf(format_args!(r#"site size="{}" rgba="0.1 0.1 0.1 1""#, number(0.005 * model.size())));
    });
}

fn world(xml: &mut Xml, model: &MjcfModel, forces: &Forces) {
    let above = numbers([0.0, 0.0, 10.0 * model.size()]);
    xml.leaf(format_args!(r#"light pos="{above}" dir="0 0 -1" type="directional""#));
    draw(xml, model, GROUND);
    sites(xml, model, forces, GROUND);
    for link in model.children(GROUND) {
        body(xml, model, forces, link);
    }
}

fn body(xml: &mut Xml, model: &MjcfModel, forces: &Forces, link: LinkId) {
    let index = model.branch_of(link).expect("every moving link is in the tree");
    let own = &model.bodies[index];
    let data = &model.case.mechanism.links()[link];
    let (name, at, turn) = (escape(data.name.as_str()), flat(own.offset), about_z(own.turn));
    xml.nest(format_args!(r#"body name="{name}" pos="{at}" axisangle="{turn}""#), |xml| {
        let (mass, inertia) = model.inertial(link);
        // The import of models reads these comments.
        if !(data.mass > 0.0) {
            xml.comment(sentences::IT_HAS_NO_MASS);
        } else if !(data.inertia > 0.0) {
            xml.comment(sentences::IT_HAS_NO_INERTIA);
        }
        // All three moments of inertia are equal, so that they satisfy the triangle inequality of rigid bodies.
        // The moments of inertia about x and y have no effect in planar motion.
        let (centre, mass, inertia) = (flat(data.mass_centre), number(mass), numbers([inertia; 3]));
        xml.leaf(format_args!(r#"inertial pos="{centre}" mass="{mass}" diaginertia="{inertia}""#));
        joint(xml, model, index);
        draw(xml, model, link);
        sites(xml, model, forces, link);
        for child in model.children(link) {
            body(xml, model, forces, child);
        }
    });
}

fn joint(xml: &mut Xml, model: &MjcfModel, index: usize) {
    let (own, branch) = (&model.bodies[index], &model.tree.branches[index]);
    let name = escape(model.case.mechanism.joints()[branch.joint].name.as_str());
    let freedom = match own.freedom {
        Freedom::Hinge(at) => format!(r#"type="hinge" axis="0 0 1" pos="{}""#, flat(at)),
        Freedom::Slide(axis) => format!(r#"type="slide" axis="{}""#, flat(axis)),
    };
    let mut tag = format!(r#"joint name="{name}" {freedom} ref="{}""#, number(own.coordinate));
    if let Some(inertia) = model.armature(branch.joint) {
        let _ = write!(tag, r#" armature="{}""#, number(inertia));
        xml.comment(match model.case.drives.iter().any(|drive| drive.joint == branch.joint && drive.is_free()) {
            true => sentences::ROTOR_AND_REDUCER_OF_THE_MOTOR,
            false => sentences::DRIVE_A_ROTOR_SO_HEAVY_THAT_ITS_SPEED,
        });
    }
    if let Some(found) = model.frictions.iter().find(|friction| friction.link == branch.link && friction.own_hinge) {
        let _ = write!(tag, r#" frictionloss="{}""#, number(found.moment));
    }
    xml.leaf(tag);
}

/// Sites of a link: at its joints, its points, and where loads act.
fn sites(xml: &mut Xml, model: &MjcfModel, forces: &Forces, link: LinkId) {
    let mechanism = &model.case.mechanism;
    for joint in mechanism.joints() {
        if let Some(place) = joint.on(link) {
            effects::site(xml, &side(joint, link), place);
        }
    }
    for (name, side) in mechanism.moving_points().filter(|(_, side)| side.link == link) {
        effects::site(xml, name, side.local);
    }
    effects::sites(xml, forces, link);
}

fn loops(xml: &mut Xml, model: &MjcfModel) {
    let transmissions = model.case.mechanism.transmissions();
    if model.tree.cut.is_empty() && transmissions.is_empty() {
        return;
    }
    xml.nest("equality", |xml| {
        for transmission in transmissions {
            let name = of_transmission(transmission);
            let name = escape(&name);
            xml.leaf(format_args!(r#"tendon name="{name}" tendon1="{name}""#));
        }
        for &joint in &model.tree.cut {
            let joint = &model.case.mechanism.joints()[joint];
            let [first, second] = [joint.first.link, joint.second.link].map(|link| side(joint, link));
            let [name, first, second] = [&joint.name, &first, &second].map(|name| escape(name.as_str()));
            xml.leaf(format_args!(r#"connect name="{name}" site1="{first}" site2="{second}""#));
        }
    });
}

/// Writes sensors of the reaction in every joint of the tree.
/// Prismatic and driven joints also get a sensor of the moment.
fn sensors(xml: &mut Xml, model: &MjcfModel) {
    xml.comment(sentences::WHAT_ACTS_ON_THE_BODY_IN_THE_JOINT);
    xml.nest("sensor", |xml| {
        for branch in &model.tree.branches {
            let joint = &model.case.mechanism.joints()[branch.joint];
            let (name, site) = (escape(joint.name.as_str()), side(joint, branch.link));
            let site = escape(site.as_str());
            xml.leaf(format_args!(r#"force name="{name}.force" site="{site}""#));
            if joint.keeps_angle() || model.is_driven(branch.joint) {
                xml.leaf(format_args!(r#"torque name="{name}.moment" site="{site}""#));
            }
        }
    });
}

fn keyframe(xml: &mut Xml, model: &MjcfModel) {
    let coordinates = numbers(model.in_order().iter().map(|body| body.coordinate));
    let rates = numbers(model.in_order().iter().map(|body| body.rate));
    xml.nest("keyframe", |xml| {
        xml.leaf(format_args!(r#"key name="start" time="0" qpos="{coordinates}" qvel="{rates}""#));
    });
}

/// Shapes of a link.
fn draw(xml: &mut Xml, model: &MjcfModel, link: LinkId) {
    let colour = numbers(shapes::colour(link));
    for shape in shapes::shapes(model, link) {
        let geometry = match shape {
            Shape::Rod { ends: [from, to], radius } => {
                let ends = numbers([from.x, from.y, 0.0, to.x, to.y, 0.0]);
                format!(r#"type="capsule" fromto="{ends}" size="{}""#, number(radius))
            }
            Shape::Block { at, angle, half } => {
                let (at, turn, size) = (flat(at), about_z(angle), numbers(half));
                format!(r#"type="box" pos="{at}" axisangle="{turn}" size="{size}""#)
            }
            Shape::Ball { at, radius } => {
                format!(r#"type="sphere" pos="{}" size="{}""#, flat(at), number(radius))
            }
        };
        xml.leaf(format_args!(r#"geom {geometry} rgba="{colour}""#));
    }
}
