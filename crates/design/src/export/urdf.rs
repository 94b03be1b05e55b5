//! URDF: the spanning tree as links and joints; the joints that close loops as an extension for Gazebo.
//!
//! - The plane of motion is XOY. A joint's coordinate is zero in the start pose.
//! - The frame of a URDF link has the directions of the frame of the mechanism's link.
//!   Its origin lies at the hinge that carries the link. If a prismatic joint carries the link, the frames are equal.
//! - URDF permits no loops. A joint that closes a loop is an SDF joint within an element `gazebo`.
//!   Parsers of URDF skip the element `gazebo`. The converter of SDFormat copies the contents of the element.
//! - URDF has no place for gravity, drives and speeds.
//! - With [`Mimics`], every joint whose relation to the driven joint is linear follows the driven joint (`mimic`).
//!   A comment states all relations.

mod mimic;

use std::f64::consts::FRAC_PI_2;

use quick_xml::escape::escape;

use super::limits::{self, Follower};
use super::names;
use super::sdf;
use super::shapes::{self, Shape};
use super::start::{first_state, model_header};
use super::xml::{Xml, flat, number, numbers};
use crate::relations::Mimics;
use crate::rigid::{Body, Freedom, RigidModel};
use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{Vec2, rotated, unit};
use linkage::mechanism::{GROUND, JointId, LinkId};
use linkage::solver::Solver;

/// Name of the format in messages.
const FORMAT: &str = "URDF";
/// Name of the root link. Gazebo takes a link with this name as the world.
const ROOT: &str = "world";
/// Limit of the force (N) and of the speed (m/s) of a prismatic joint. URDF requires such limits; this one is never
/// reached.
const ENDLESS: f64 = 1e9;

/// The case as URDF, with the robot's name `name`, in the pose at t = 0 that `solver` computes.
/// `mimics` are the [relations](crate::relations) of the joints to the driven joint, if the file is to state them.
///
/// # Errors
/// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) for a link with the name of the root, and for loads and
/// transmissions that URDF cannot express.
/// The errors of the solver.
pub fn urdf(case: &Case, solver: &dyn Solver, name: &str, mimics: Option<&Mimics>) -> Result<String> {
    names::check_urdf(&case.mechanism)?;
    let model = RigidModel::new(case, &first_state(case, solver)?, name);
    let (mut followers, frictions) = (limits::followers(&model, FORMAT)?, limits::frictions(&model, FORMAT)?);
    let mut offsets = vec![0.0; followers.len()];
    if let Some(mimics) = mimics {
        (followers, offsets) = mimics.linear();
    }
    let mut xml = Xml::new();
    xml.nest(format_args!(r#"robot name="{}""#, escape(name)), |xml| {
        model_header(&model).iter().for_each(|line| xml.comment(line));
        if let Some(mimics) = mimics {
            xml.comment(sentences::THE_RELATIONS_OF_THE_JOINTS);
            xml.comment(&mimics.json(&model));
        }
        xml.nest(format_args!(r#"link name="{ROOT}""#), |xml| visuals(xml, &model, GROUND, Vec2::zeros()));
        for body in &model.bodies {
            link(xml, &model, body);
            let follower = followers.iter().position(|own| own.joint == body.branch.joint);
            let follower = follower.map(|index| (followers[index], offsets[index]));
            joint(xml, &model, body, follower, limits::friction_of(&frictions, body.branch.joint));
        }
        if !model.closing.is_empty() {
            xml.comment(sentences::URDF_PERMITS_NO_LOOPS);
            xml.nest("gazebo", |xml| {
                for body in &model.closing {
                    let friction = limits::friction_of(&frictions, body.branch.joint);
                    sdf::joint(xml, &model, body, &[], friction, shift(&model, body.branch.link));
                }
            });
        }
    });
    Ok(xml.text)
}

/// Origin of a URDF link's frame in the frame of the mechanism's link (m).
fn shift(model: &RigidModel, link: LinkId) -> Vec2 {
    match model.branch_of(link).map(|branch| model.bodies[branch].freedom) {
        Some(Freedom::Hinge(place)) => place,
        Some(Freedom::Slide(_)) | None => Vec2::zeros(),
    }
}

/// Name of a link in the file.
fn file_name<'a>(model: &RigidModel<'a>, link: LinkId) -> &'a str {
    if link == GROUND { ROOT } else { model.link_name(link) }
}

/// An origin in the plane: position (m), pitch and yaw (rad).
fn origin(xml: &mut Xml, at: Vec2, pitch: f64, yaw: f64) {
    xml.leaf(format_args!(r#"origin xyz="{}" rpy="{}""#, flat(at), numbers([0.0, pitch, yaw])));
}

fn link(xml: &mut Xml, model: &RigidModel, body: &Body) {
    let link = body.branch.link;
    let (data, shift) = (&model.case.mechanism.links()[link], shift(model, link));
    xml.nest(format_args!(r#"link name="{}""#, escape(data.name.as_str())), |xml| {
        let (mass, inertia) = model.inertial(link);
        if !(data.mass > 0.0 && data.inertia > 0.0) {
            xml.comment(sentences::IT_HAS_NO_MASS_OR_NO_INERTIA);
        }
        xml.nest("inertial", |xml| {
            origin(xml, data.mass_centre - shift, 0.0, 0.0);
            xml.leaf(format_args!(r#"mass value="{}""#, number(mass)));
            // All three moments of inertia are equal, so that they satisfy the triangle inequality of rigid bodies.
            let own = number(inertia);
            xml.leaf(format_args!(r#"inertia ixx="{own}" ixy="0" ixz="0" iyy="{own}" iyz="0" izz="{own}""#));
        });
        visuals(xml, model, link, shift);
    });
}

fn visuals(xml: &mut Xml, model: &RigidModel, link: LinkId, shift: Vec2) {
    let colour = numbers(shapes::colour(link));
    for shape in shapes::shapes(model, link) {
        xml.nest("visual", |xml| {
            let geometry = match shape {
                Shape::Rod { ends: [from, to], radius } => {
                    let way = to - from;
                    // URDF places cylinders along z. A pitch of a quarter turn turns the cylinder to x.
                    origin(xml, (from + to) / 2.0 - shift, FRAC_PI_2, way.y.atan2(way.x));
                    format!(r#"cylinder radius="{}" length="{}""#, number(radius), number(way.norm()))
                }
                Shape::Block { at, angle, half } => {
                    origin(xml, at - shift, 0.0, angle);
                    format!(r#"box size="{}""#, numbers(half.map(|size| 2.0 * size)))
                }
                Shape::Ball { at, radius } => {
                    origin(xml, at - shift, 0.0, 0.0);
                    format!(r#"sphere radius="{}""#, number(radius))
                }
            };
            xml.nest("geometry", |xml| xml.leaf(geometry));
            let material = escape(file_name(model, link));
            xml.nest(format_args!(r#"material name="{material}""#), |xml| {
                xml.leaf(format_args!(r#"color rgba="{colour}""#));
            });
        });
    }
}

fn joint(xml: &mut Xml, model: &RigidModel, body: &Body, follower: Option<(Follower, f64)>, friction: f64) {
    let (branch, own) = (body.branch, shift(model, body.branch.link));
    let (kind, axis) = match body.freedom {
        Freedom::Hinge(_) => ("continuous", numbers([0.0, 0.0, 1.0])),
        Freedom::Slide(axis) => ("prismatic", flat(axis)),
    };
    let name = |joint: JointId| escape(model.joint_name(joint));
    xml.nest(format_args!(r#"joint name="{}" type="{kind}""#, name(branch.joint)), |xml| {
        origin(xml, body.offset + rotated(unit(body.turn), own) - shift(model, branch.parent), 0.0, body.turn);
        xml.leaf(format_args!(r#"parent link="{}""#, escape(file_name(model, branch.parent))));
        xml.leaf(format_args!(r#"child link="{}""#, escape(file_name(model, branch.link))));
        xml.leaf(format_args!(r#"axis xyz="{axis}""#));
        if matches!(body.freedom, Freedom::Slide(_)) {
            // URDF requires limits of the coordinate. The limits written here cannot be reached: each is the
            // mechanism's size times the number of bodies.
            let reach = number(model.size() * model.bodies.len() as f64);
            let endless = number(ENDLESS);
            let ends = format!(r#"lower="-{reach}" upper="{reach}""#);
            xml.leaf(format_args!(r#"limit {ends} effort="{endless}" velocity="{endless}""#));
        }
        if friction > 0.0 {
            xml.leaf(format_args!(r#"dynamics damping="0" friction="{}""#, number(friction)));
        }
        if let Some((own, offset)) = follower {
            let [multiplier, offset] = [own.multiplier, offset].map(number);
            let leader = name(own.leader);
            xml.leaf(format_args!(r#"mimic joint="{leader}" multiplier="{multiplier}" offset="{offset}""#));
        }
    });
}
