//! USD as text (`.usda`) with the schema UsdPhysics: rigid bodies, and all joints between them.
//!
//! - The plane of motion is XOY, and z points out of the plane. The frame of a body is the frame of its link.
//! - Every joint of the mechanism is a joint of the file.
//!   The frames of a joint on its two bodies coincide in the start pose, so that its coordinate is zero there.
//! - The joints that close loops are excluded from the articulation, which is a tree.
//!   The tree's root is the fixed joint of the ground with the world.
//! - A prescribed drive is a velocity drive.

mod text;

use super::limits;
use super::names;
use super::shapes::{self, Shape};
use super::start::{first_state, model_header};
use crate::rigid::{Body, Freedom, RigidModel};
use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{Vec2, rotated, unit};
use linkage::mechanism::{GROUND, LinkId};
use linkage::solver::Solver;
use text::{Usd, about_z, flat, number, quoted, tuple};

/// Name of the format in messages.
const FORMAT: &str = "USD";
/// Damping of a velocity drive of the type "acceleration" (1/s).
/// With this damping, a drive reaches its speed within one time step of any engine.
const DAMPING: f64 = 1e6;

/// The case as USD, with the name `name` of the mechanism.
/// The model starts in the case's pose at t = 0, with the velocities that `solver` computes for this pose.
///
/// # Errors
/// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) for loads, motors, transmissions, and laws of motion
/// with a changing speed.
/// The errors of the solver.
pub fn usd(case: &Case, solver: &dyn Solver, name: &str) -> Result<String> {
    for drive in &case.drives {
        limits::check_speed(drive, FORMAT)?;
        limits::check_motor(drive, FORMAT)?;
    }
    if let Some(own) = case.mechanism.transmissions().first() {
        let what = sentences::the_coupling_of(&own.name());
        return Err(limits::refused(&what, FORMAT, sentences::LEAVE_IT_OUT_OF_THE_SCENARIO));
    }
    let model = RigidModel::new(case, &first_state(case, solver)?, name);
    limits::check_no_loads(&model, FORMAT)?;
    let links = names::identifiers(case.mechanism.links().iter().map(|link| link.name.as_str()));
    let joints = names::identifiers(case.mechanism.joints().iter().map(|joint| joint.name.as_str()));
    let mut usd = Usd::new(&model_header(&model));
    usd.prim("Xform", "mechanism", &[format!("displayName = {}", quoted(name))], |usd| {
        usd.prim("PhysicsScene", "scene", &[], |usd| {
            let size = case.gravity.norm();
            let way = if size > 0.0 { case.gravity / size } else { Vec2::new(0.0, -1.0) };
            usd.line(format_args!("vector3f physics:gravityDirection = {}", flat(way)));
            usd.line(format_args!("float physics:gravityMagnitude = {}", number(size)));
        });
        usd.prim("Scope", "links", &[], |usd| {
            for (link, own) in case.mechanism.links().ids().zip(&links) {
                body(usd, &model, link, own);
            }
        });
        usd.prim("Scope", "joints", &[], |usd| {
            root(usd, &links[0]);
            for own in model.bodies.iter().chain(&model.closing) {
                joint(usd, &model, own, [&links, &joints], model.tree.cut.contains(&own.branch.joint));
            }
        });
    });
    Ok(usd.text)
}

/// The metadata with the name that the scenario gives to a part, if the part's identifier differs from this name.
fn shown(name: &str, identifier: &str) -> Option<String> {
    (name != identifier).then(|| format!("displayName = {}", quoted(name)))
}

fn body(usd: &mut Usd, model: &RigidModel, link: LinkId, identifier: &str) {
    let (data, at, motion) = (&model.case.mechanism.links()[link], model.pose(link), &model.start.motions[link]);
    let apis = r#"prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]"#.to_string();
    let facts: Vec<String> = [apis].into_iter().chain(shown(&data.name, identifier)).collect();
    usd.prim("Xform", identifier, &facts, |usd| {
        usd.line(format_args!("double3 xformOp:translate = {}", flat(at.origin)));
        usd.line(format_args!("quatd xformOp:orient = {}", about_z(at.angle)));
        usd.line(r#"uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]"#);
        let (mass, inertia) = if link == GROUND { (1.0, 1.0) } else { model.inertial(link) };
        if link != GROUND {
            // Physics engines read this velocity as the velocity of the mass centre.
            usd.line(format_args!("vector3f physics:velocity = {}", flat(motion.point_velocity(data.mass_centre))));
            let turn = tuple([0.0, 0.0, motion.omega.to_degrees()]);
            usd.line(format_args!("vector3f physics:angularVelocity = {turn}"));
            if !(data.mass > 0.0 && data.inertia > 0.0) {
                usd.comment(sentences::IT_HAS_NO_MASS_OR_NO_INERTIA);
            }
        }
        usd.line(format_args!("float physics:mass = {}", number(mass)));
        usd.line(format_args!("point3f physics:centerOfMass = {}", flat(data.mass_centre)));
        // All three moments of inertia are equal, so that they satisfy the triangle inequality of rigid bodies.
        usd.line(format_args!("float3 physics:diagonalInertia = {}", tuple([inertia; 3])));
        usd.line("quatf physics:principalAxes = (1, 0, 0, 0)");
        shapes(usd, model, link);
    });
}

fn shapes(usd: &mut Usd, model: &RigidModel, link: LinkId) {
    let [red, green, blue, _] = shapes::colour(link);
    for (index, shape) in shapes::shapes(model, link).into_iter().enumerate() {
        let (kind, sizes, at, angle, scale) = match shape {
            Shape::Rod { ends: [from, to], radius } => {
                let (way, middle) = (to - from, (from + to) / 2.0);
                let sizes = vec![
                    r#"uniform token axis = "X""#.to_string(),
                    format!("double height = {}", number(way.norm())),
                    format!("double radius = {}", number(radius)),
                ];
                ("Cylinder", sizes, middle, way.y.atan2(way.x), [1.0; 3])
            }
            Shape::Block { at, angle, half } => ("Cube", vec!["double size = 2".to_string()], at, angle, half),
            Shape::Ball { at, radius } => {
                ("Sphere", vec![format!("double radius = {}", number(radius))], at, 0.0, [1.0; 3])
            }
        };
        usd.prim(kind, &format!("shape_{}", index + 1), &[], |usd| {
            sizes.iter().for_each(|line| usd.line(line));
            usd.line(format_args!("color3f[] primvars:displayColor = [{}]", tuple([red, green, blue])));
            usd.line(format_args!("double3 xformOp:translate = {}", flat(at)));
            usd.line(format_args!("quatd xformOp:orient = {}", about_z(angle)));
            usd.line(format_args!("double3 xformOp:scale = {}", tuple(scale)));
            usd.line(r#"uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient", "xformOp:scale"]"#);
        });
    }
}

/// Writes the fixed joint between the ground and the world. This joint is the root of the articulation.
fn root(usd: &mut Usd, ground: &str) {
    let apis = r#"prepend apiSchemas = ["PhysicsArticulationRootAPI"]"#.to_string();
    usd.prim("PhysicsFixedJoint", "world__root", &[apis], |usd| {
        usd.line(format_args!("rel physics:body1 = </mechanism/links/{ground}>"));
    });
}

fn joint(usd: &mut Usd, model: &RigidModel, body: &Body, [links, joints]: [&[String]; 2], closes: bool) {
    let branch = body.branch;
    let name = &joints[branch.joint.index()];
    let driven = model.is_prescribed(branch.joint);
    // In the start pose, the joint's frames on the two bodies coincide.
    let place = model.point(branch.joint, branch.link);
    let (kind, axis, own, drive, speed) = match body.freedom {
        Freedom::Hinge(_) => ("PhysicsRevoluteJoint", "Z", 0.0, "angular", body.rate.to_degrees()),
        Freedom::Slide(axis) => ("PhysicsPrismaticJoint", "X", axis.y.atan2(axis.x), "linear", body.rate),
    };
    let facts = driven.then(|| format!(r#"prepend apiSchemas = ["PhysicsDriveAPI:{drive}"]"#));
    let facts: Vec<String> = facts.into_iter().chain(shown(model.joint_name(branch.joint), name)).collect();
    usd.prim(kind, name, &facts, |usd| {
        for (index, link) in [branch.parent, branch.link].into_iter().enumerate() {
            usd.line(format_args!("rel physics:body{index} = </mechanism/links/{}>", links[link.index()]));
        }
        let on_parent = body.offset + rotated(unit(body.turn), place);
        for (index, (at, angle)) in [(on_parent, body.turn + own), (place, own)].into_iter().enumerate() {
            usd.line(format_args!("point3f physics:localPos{index} = {}", flat(at)));
            usd.line(format_args!("quatf physics:localRot{index} = {}", about_z(angle)));
        }
        usd.line(format_args!(r#"uniform token physics:axis = "{axis}""#));
        if closes {
            usd.line("uniform bool physics:excludeFromArticulation = 1");
        }
        if driven {
            usd.line(format_args!(r#"uniform token drive:{drive}:physics:type = "acceleration""#));
            for (part, value) in [("targetVelocity", speed), ("damping", DAMPING), ("stiffness", 0.0)] {
                usd.line(format_args!("float drive:{drive}:physics:{part} = {}", number(value)));
            }
        }
    });
}
