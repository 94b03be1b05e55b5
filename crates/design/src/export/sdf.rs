//! SDFormat 1.11, the XML of Gazebo: a world with gravity, the links as free bodies, all joints between them.
//!
//! - The plane of motion is XOY. The frame of a body is the frame of its link.
//! - SDF permits loops of joints, so every joint of the mechanism is a joint of the file.
//!   A joint's coordinate is zero in the start pose.
//! - A prescribed drive is the joint controller of Gazebo, which keeps a speed.
//! - The element `state` holds the start pose with the velocities of all links.

use std::f64::consts::FRAC_PI_2;

use quick_xml::escape::escape;

use super::limits::{self, Follower};
use super::names;
use super::shapes::{self, Shape};
use super::start::{first_state, model_header};
use super::xml::{Xml, flat, number, numbers};
use crate::rigid::{Body, Freedom, RigidModel};
use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, LinkId};
use linkage::solver::Solver;

/// Name of the format in messages.
const FORMAT: &str = "SDF";

/// The case as SDF, with the world's name `name` and the time step `step` (s).
/// The model starts in the case's pose at t = 0, with the velocities that `solver` computes for this pose.
///
/// # Errors
/// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) for names that SDF does not accept, and for loads, drives
/// and transmissions that SDF cannot express.
/// The errors of the solver.
pub fn sdf(case: &Case, solver: &dyn Solver, name: &str, step: f64) -> Result<String> {
    names::check_sdf(&case.mechanism)?;
    for drive in &case.drives {
        limits::check_speed(drive, FORMAT)?;
        limits::check_motor(drive, FORMAT)?;
    }
    let model = RigidModel::new(case, &first_state(case, solver)?, name);
    let (followers, frictions) = (limits::followers(&model, FORMAT)?, limits::frictions(&model, FORMAT)?);
    let mut xml = Xml::new();
    xml.nest(r#"sdf version="1.11""#, |xml| {
        model_header(&model).iter().for_each(|line| xml.comment(line));
        xml.nest(format_args!(r#"world name="{}""#, escape(name)), |xml| {
            xml.nest(r#"physics name="step" type="ode""#, |xml| xml.value("max_step_size", number(step)));
            xml.value("gravity", flat(case.gravity));
            ground(xml, &model);
            xml.nest(format_args!(r#"model name="{}""#, escape(name)), |xml| {
                model.bodies.iter().for_each(|body| link(xml, &model, body.branch.link));
                for body in model.bodies.iter().chain(&model.closing) {
                    let friction = limits::friction_of(&frictions, body.branch.joint);
                    joint(xml, &model, body, &followers, friction, Vec2::zeros());
                }
                controllers(xml, &model);
            });
            state(xml, &model);
        });
    });
    Ok(xml.text)
}

/// A pose in the plane: position (m) and angle (rad).
fn pose(at: Vec2, angle: f64) -> String {
    numbers([at.x, at.y, 0.0, 0.0, 0.0, angle])
}

/// The ground as a static model, which is only drawn: joints with the ground have the parent `world`.
fn ground(xml: &mut Xml, model: &RigidModel) {
    xml.nest(format_args!(r#"model name="{}.ground""#, escape(model.name)), |xml| {
        xml.value("static", "true");
        xml.nest(r#"link name="ground""#, |xml| visuals(xml, model, GROUND));
    });
}

fn link(xml: &mut Xml, model: &RigidModel, link: LinkId) {
    let (data, at) = (&model.case.mechanism.links()[link], model.pose(link));
    xml.nest(format_args!(r#"link name="{}""#, escape(data.name.as_str())), |xml| {
        xml.value("pose", pose(at.origin, at.angle));
        let (mass, inertia) = model.inertial(link);
        if !(data.mass > 0.0 && data.inertia > 0.0) {
            xml.comment(sentences::IT_HAS_NO_MASS_OR_NO_INERTIA);
        }
        xml.nest("inertial", |xml| {
            xml.value("pose", pose(data.mass_centre, 0.0));
            xml.value("mass", number(mass));
            // All three moments of inertia are equal, so that they satisfy the triangle inequality of rigid bodies.
            xml.nest("inertia", |xml| {
                for (name, value) in [("xx", inertia), ("xy", 0.0), ("xz", 0.0), ("yy", inertia), ("yz", 0.0)] {
                    xml.value(&format!("i{name}"), number(value));
                }
                xml.value("izz", number(inertia));
            });
        });
        visuals(xml, model, link);
    });
}

fn visuals(xml: &mut Xml, model: &RigidModel, link: LinkId) {
    let colour = numbers(shapes::colour(link));
    for (index, shape) in shapes::shapes(model, link).into_iter().enumerate() {
        xml.nest(format_args!(r#"visual name="shape_{}""#, index + 1), |xml| {
            let (place, geometry) = placed(shape);
            xml.value("pose", numbers(place));
            xml.nest("geometry", |xml| {
                let (name, sizes) = geometry;
                xml.nest(name, |xml| sizes.iter().for_each(|(size, value)| xml.value(size, value)));
            });
            xml.nest("material", |xml| xml.value("diffuse", &colour));
        });
    }
}

/// Name of a geometry in SDF, and its sizes with their names.
type Geometry = (&'static str, Vec<(&'static str, String)>);

/// Position (m) with roll, pitch and yaw (rad) of a shape, the name of its geometry, and its sizes.
fn placed(shape: Shape) -> ([f64; 6], Geometry) {
    match shape {
        Shape::Rod { ends: [from, to], radius } => {
            let (middle, way) = ((from + to) / 2.0, to - from);
            // SDF places cylinders along z. A pitch of a quarter turn turns the cylinder to x.
            let place = [middle.x, middle.y, 0.0, 0.0, FRAC_PI_2, way.y.atan2(way.x)];
            (place, ("cylinder", vec![("radius", number(radius)), ("length", number(way.norm()))]))
        }
        Shape::Block { at, angle, half } => {
            ([at.x, at.y, 0.0, 0.0, 0.0, angle], ("box", vec![("size", numbers(half.map(|size| 2.0 * size)))]))
        }
        Shape::Ball { at, radius } => ([at.x, at.y, 0.0, 0.0, 0.0, 0.0], ("sphere", vec![("radius", number(radius))])),
    }
}

/// A joint with its dry friction (N m). The origin of the child's frame in the file can differ from the origin of the
/// frame that the mechanism gives to the link. `shift` is the vector from the latter to the former, in the link (m).
pub(super) fn joint(
    xml: &mut Xml,
    model: &RigidModel,
    body: &Body,
    followers: &[Follower],
    friction: f64,
    shift: Vec2,
) {
    let joint = body.branch.joint;
    let (kind, place, axis) = match body.freedom {
        Freedom::Hinge(place) => ("revolute", place, numbers([0.0, 0.0, 1.0])),
        Freedom::Slide(axis) => ("prismatic", model.point(joint, body.branch.link), flat(axis)),
    };
    xml.nest(format_args!(r#"joint name="{}" type="{kind}""#, escape(model.joint_name(joint))), |xml| {
        xml.value("pose", pose(place - shift, 0.0));
        let parent = if body.branch.parent == GROUND { "world" } else { model.link_name(body.branch.parent) };
        xml.value("parent", escape(parent));
        xml.value("child", escape(model.link_name(body.branch.link)));
        xml.nest("axis", |xml| {
            xml.value("xyz", axis);
            xml.nest("limit", |xml| [("lower", "-inf"), ("upper", "inf")].map(|(end, value)| xml.value(end, value)));
            if friction > 0.0 {
                xml.nest("dynamics", |xml| {
                    let all = [("spring_reference", 0.0), ("spring_stiffness", 0.0), ("friction", friction)];
                    all.into_iter().for_each(|(name, value)| xml.value(name, number(value)));
                });
            }
            followers.iter().filter(|own| own.joint == joint).for_each(|own| mimic(xml, model, own));
        });
    });
}

fn mimic(xml: &mut Xml, model: &RigidModel, own: &Follower) {
    xml.nest(format_args!(r#"mimic joint="{}""#, escape(model.joint_name(own.leader))), |xml| {
        let all = [("multiplier", own.multiplier), ("offset", 0.0), ("reference", 0.0)];
        all.into_iter().for_each(|(name, value)| xml.value(name, number(value)));
    });
}

/// Writes a controller for every prescribed drive. The controller keeps the speed of the joint's coordinate.
fn controllers(xml: &mut Xml, model: &RigidModel) {
    for body in model.bodies.iter().filter(|body| model.is_prescribed(body.branch.joint)) {
        let class = r#"filename="gz-sim-joint-controller-system" name="gz::sim::systems::JointController""#;
        xml.nest(format_args!("plugin {class}"), |xml| {
            xml.value("joint_name", escape(model.joint_name(body.branch.joint)));
            xml.value("initial_velocity", number(body.rate));
        });
    }
}

/// The start pose with the velocities of all links.
fn state(xml: &mut Xml, model: &RigidModel) {
    xml.nest(format_args!(r#"state world_name="{}""#, escape(model.name)), |xml| {
        xml.value("iterations", "0");
        xml.nest(format_args!(r#"model name="{}""#, escape(model.name)), |xml| {
            for own in model.bodies.iter().map(|body| body.branch.link) {
                let (at, motion) = (model.pose(own), &model.start.motions[own]);
                xml.nest(format_args!(r#"link name="{}""#, escape(model.link_name(own))), |xml| {
                    xml.value("pose", pose(at.origin, at.angle));
                    xml.value("velocity", pose(motion.velocity, motion.omega));
                });
            }
        });
    });
}
