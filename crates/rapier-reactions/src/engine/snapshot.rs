//! Bodies, joints and poses of the user's world, and the reaction of a joint.

use super::rapier::prelude::{
    GenericJoint, ImpulseJointHandle, ImpulseJointSet, IntegrationParameters, JointAxesMask, LockedAxes, Multibody,
    MultibodyJointHandle, MultibodyJointSet, MultibodyLink, PhysicsWorld, Pose, RigidBody, RigidBodyHandle,
    RigidBodySet, Vector,
};
use super::wide;
use crate::error::ReactionError;
use crate::model::{Model, ModelBody, ModelJoint, Stance};
use crate::motion::Motion;
use crate::plane::{Placement, Vec2};
use crate::rows::{JointType, ROTATION};
use crate::sentences;
use std::collections::BTreeMap;

/// The parts of the user's world from which reactions are read. The world is not changed.
#[derive(Clone, Copy)]
pub struct WorldRef<'a> {
    /// All rigid bodies.
    pub bodies: &'a RigidBodySet,
    /// The impulse joints. Disabled joints are left out.
    pub impulse_joints: &'a ImpulseJointSet,
    /// The multibody joints.
    pub multibody_joints: &'a MultibodyJointSet,
    /// The parameters of the steps; only time step and substeps are read.
    pub parameters: &'a IntegrationParameters,
    /// Gravity (m/s^2).
    pub gravity: Vector,
}

impl<'a> From<&'a PhysicsWorld> for WorldRef<'a> {
    fn from(world: &'a PhysicsWorld) -> Self {
        WorldRef {
            bodies: &world.bodies,
            impulse_joints: &world.impulse_joints,
            multibody_joints: &world.multibody_joints,
            parameters: &world.integration_parameters,
            gravity: world.gravity,
        }
    }
}

/// Handle of a joint of either kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointHandle {
    /// An impulse joint.
    Impulse(ImpulseJointHandle),
    /// A joint of a multibody.
    Multibody(MultibodyJointHandle),
}

impl JointHandle {
    /// Name of the joint in messages.
    pub(super) fn name(self) -> String {
        match self {
            JointHandle::Impulse(handle) => sentences::impulse_joint(&handle.0.into_raw_parts().0),
            JointHandle::Multibody(handle) => sentences::multibody_joint(&handle.0.into_raw_parts().0),
        }
    }
}

/// Reaction of a joint: everything that it transmits, including the effort of its motor, damper or spring.
/// All vectors are in world axes. On body 1, force and moment act in the opposite direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointReaction {
    /// The joint.
    pub joint: JointHandle,
    /// Body 1 and body 2 of the joint. For a joint of a multibody, these are parent and child.
    pub bodies: [RigidBodyHandle; 2],
    /// Force of the joint on body 2 (N).
    pub force: [f64; 2],
    /// Point where the force acts (m): the origin of joint frame 2.
    pub point: [f64; 2],
    /// Moment of the joint on body 2 about `point` (N m), positive counter-clockwise. The moment comes from a locked
    /// rotation, or from a motor, a damper or a spring of a free rotation.
    pub moment: f64,
    /// The part of the reaction that a motor, a damper or a spring exerts: forces along x and y of joint frame 1 (N),
    /// and moment (N m). The values of locked coordinates are 0.
    pub efforts: [f64; 3],
}

/// Extrapolation of the reactions at one instant from runs with the steps h (`coarse`) and h / 2 (`fine`).
///
/// The result is 2 y(h / 2) - y(h), in which the error of first order cancels (Richardson's extrapolation).
/// The extrapolation is meant for reactions from impulses, and for reactions from second differences of a free motion.
/// The field `point` is taken from the fine run.
/// Both slices must have the same joints in the same order.
pub fn extrapolated(coarse: &[JointReaction], fine: &[JointReaction]) -> Vec<JointReaction> {
    let of = |coarse: f64, fine: f64| 2.0 * fine - coarse;
    let pair = |(coarse, fine): (&JointReaction, &JointReaction)| JointReaction {
        force: [0, 1].map(|k| of(coarse.force[k], fine.force[k])),
        moment: of(coarse.moment, fine.moment),
        efforts: [0, 1, 2].map(|k| of(coarse.efforts[k], fine.efforts[k])),
        ..*fine
    };
    coarse.iter().zip(fine).map(pair).collect()
}

/// Bodies and joints of a world at one instant.
#[derive(Clone, Debug)]
pub(super) struct Snapshot {
    pub(super) handles: Vec<RigidBodyHandle>,
    pub(super) joints: Vec<JointHandle>,
    pub(super) model: Model,
    pub(super) placements: Vec<Placement>,
}

impl Snapshot {
    /// All enabled joints with at least one dynamic body, and their bodies.
    /// Masses are 0 before the first step, because Rapier computes them in this step.
    ///
    /// # Errors
    /// [`ReactionError::Unsupported`] for the first joint or body with an unsupported property, and
    /// [`ReactionError::NotFinite`].
    pub(super) fn of(world: &WorldRef) -> Result<Snapshot, ReactionError> {
        let mut snapshot = Snapshot {
            handles: Vec::new(),
            joints: Vec::new(),
            model: Model { bodies: Vec::new(), joints: Vec::new() },
            placements: Vec::new(),
        };
        let mut numbers = BTreeMap::new();
        for joint in joints(world) {
            let FoundJoint { handle, data, bodies, .. } = joint;
            let is_moved = |handle: &RigidBodyHandle| world.bodies[*handle].is_dynamic();
            let is_off = |handle: &RigidBodyHandle| !world.bodies[*handle].is_enabled();
            if !bodies.iter().any(is_moved) || bodies.iter().any(is_off) {
                continue;
            }
            let (joint_type, efforts) = read_joint(&joint)?;
            let mut number = |handle: RigidBodyHandle| match numbers.get(&handle.into_raw_parts()) {
                Some(&number) => Ok(number),
                None => {
                    let number = snapshot.add_body(world, handle)?;
                    numbers.insert(handle.into_raw_parts(), number);
                    Ok(number)
                }
            };
            let bodies = [number(bodies[0])?, number(bodies[1])?];
            let frames = [placement(&data.local_frame1), placement(&data.local_frame2)];
            snapshot.model.joints.push(ModelJoint { bodies, joint_type, frames, efforts });
            snapshot.joints.push(handle);
        }
        let is_finite = |own: &Placement| own.origin.iter().chain(own.direction.iter()).all(|value| value.is_finite());
        if snapshot.placements.iter().all(is_finite) { Ok(snapshot) } else { Err(ReactionError::NotFinite) }
    }

    /// Like [`Snapshot::of`], but every dynamic body must have a mass and a moment of inertia.
    ///
    /// # Errors
    /// Those of [`Snapshot::of`], and [`ReactionError::Unsupported`] for a body without mass or moment of inertia.
    pub(super) fn with_masses(world: &WorldRef) -> Result<Snapshot, ReactionError> {
        let snapshot = Snapshot::of(world)?;
        let lacks = |own: &ModelBody| own.inertia.is_some_and(|inertia| !inertia.iter().all(|&value| value > 0.0));
        match snapshot.model.bodies.iter().position(lacks) {
            Some(body) => Err(refused_body(snapshot.handles[body], sentences::NO_MASS)),
            None => Ok(snapshot),
        }
    }

    /// Whether both snapshots have the same bodies and joints.
    pub(super) fn has_joints_of(&self, other: &Snapshot) -> bool {
        self.handles == other.handles && self.joints == other.joints
    }

    fn add_body(&mut self, world: &WorldRef, handle: RigidBodyHandle) -> Result<usize, ReactionError> {
        let is_link = world.multibody_joints.rigid_body_link(handle).is_some();
        self.model.bodies.push(read_body(&world.bodies[handle], handle, world.gravity, is_link)?);
        self.placements.push(placement(world.bodies[handle].position()));
        self.handles.push(handle);
        Ok(self.handles.len() - 1)
    }

    /// The reaction of joint `index` from its components along its coordinates.
    pub(super) fn reaction(&self, index: usize, stance: &Stance, components: [f64; 3]) -> JointReaction {
        let own = &self.model.joints[index];
        let (force, moment) = stance.action(components);
        let effort = |k: usize| if own.efforts[k] { components[k] } else { 0.0 };
        JointReaction {
            joint: self.joints[index],
            bodies: own.bodies.map(|body| self.handles[body]),
            force: force.into(),
            point: stance.point.into(),
            moment,
            efforts: [0, 1, 2].map(effort),
        }
    }
}

/// The joints and the motion at the middle pose of three successive poses. `snapshot` gives masses and loads.
pub(super) struct Middle<'a> {
    pub(super) snapshot: &'a Snapshot,
    pub(super) stances: Vec<Stance>,
    pub(super) motions: Vec<Motion>,
}

/// A joint of the user's world.
struct FoundJoint<'a> {
    handle: JointHandle,
    data: &'a GenericJoint,
    bodies: [RigidBodyHandle; 2],
    /// For each coordinate, whether it has a damper, a spring, dry friction, the inertia of a rotor, or a given speed.
    /// An error if a coordinate is coupled with a coordinate of another joint.
    passive: Result<[bool; 3], &'static str>,
}

/// All enabled joints.
fn joints<'a>(world: &WorldRef<'a>) -> impl Iterator<Item = FoundJoint<'a>> {
    let impulse = world.impulse_joints.iter().filter(|(_, joint)| joint.data.is_enabled());
    let impulse = impulse.map(|(handle, joint)| FoundJoint {
        handle: JointHandle::Impulse(handle),
        data: &joint.data,
        bodies: [joint.body1(), joint.body2()],
        passive: Ok([false; 3]),
    });
    let multibody = world.multibody_joints.iter().filter_map(|(handle, _, multibody, link)| {
        let parent = multibody.link(link.parent_id()?)?;
        Some(FoundJoint {
            handle: JointHandle::Multibody(handle),
            data: &link.joint().data,
            bodies: [parent.rigid_body_handle(), link.rigid_body_handle()],
            passive: passive(multibody, link),
        })
    });
    impulse.chain(multibody)
}

/// The field `passive` of [`FoundJoint`] for a joint of a multibody.
fn passive(multibody: &Multibody, link: &MultibodyLink) -> Result<[bool; 3], &'static str> {
    let own = link.link_id();
    if multibody.couplings().iter().any(|coupling| coupling.link1 == own || coupling.link2 == own) {
        return Err(sentences::COUPLED_COORDINATES);
    }
    let (joint, mut coordinate, mut passive) = (link.joint(), link.assembly_id(), [false; 3]);
    for (axis, passive) in passive.iter_mut().enumerate() {
        if joint.data.locked_axes.bits() >> axis & 1 == 1 {
            continue;
        }
        let terms = [multibody.damping(), multibody.armature(), multibody.frictions()];
        let has_term = terms.iter().any(|term| term.get(coordinate).is_some_and(|value| *value != 0.0));
        *passive = joint.kinematic || joint.spring(axis).0 != 0.0 || has_term;
        coordinate += 1;
    }
    Ok(passive)
}

/// Type and efforts of a joint.
fn read_joint(joint: &FoundJoint) -> Result<(JointType, [bool; 3]), ReactionError> {
    let refused = |property| ReactionError::Unsupported(joint.handle.name(), property);
    let (data, locked) = (joint.data, joint.data.locked_axes);
    let passive = joint.passive.map_err(refused)?;
    if !data.coupled_axes.is_empty() {
        return Err(refused(sentences::COUPLED_AXES));
    }
    if !(data.limit_axes & !locked).is_empty() {
        return Err(refused(sentences::LIMITS));
    }
    let joint_type = match locked {
        JointAxesMask::LOCKED_REVOLUTE_AXES => JointType::Revolute,
        JointAxesMask::LOCKED_PRISMATIC_AXES => JointType::Prismatic,
        JointAxesMask::LOCKED_FIXED_AXES => JointType::Fixed,
        JointAxesMask::LOCKED_PIN_SLOT_AXES => return Err(refused(sentences::A_PIN_IN_A_SLOT)),
        _ if locked.is_empty() => JointType::Free,
        _ => return Err(refused(sentences::OTHER_LOCKED_AXES)),
    };
    let motors = (data.motor_axes & !locked).bits();
    Ok((joint_type, [0, 1, ROTATION].map(|axis| passive[axis] || motors >> axis & 1 == 1)))
}

fn refused_body(handle: RigidBodyHandle, property: &'static str) -> ReactionError {
    ReactionError::Unsupported(sentences::rigid_body(&handle.into_raw_parts().0), property)
}

fn read_body(
    body: &RigidBody,
    handle: RigidBodyHandle,
    gravity: Vector,
    is_link: bool,
) -> Result<ModelBody, ReactionError> {
    let properties = &body.mass_properties().local_mprops;
    let [mass, inertia] = [properties.mass(), properties.principal_inertia()].map(wide);
    if body.is_dynamic() && body.locked_axes() != LockedAxes::empty() {
        return Err(refused_body(handle, sentences::LOCKED_MOTIONS));
    }
    let weight = vec2(gravity) * (mass * wide(body.gravity_scale()));
    let damping = if is_link { [0.0; 2] } else { [body.linear_damping(), body.angular_damping()].map(wide) };
    Ok(ModelBody {
        // Moments are needed about the mass centres of dynamic bodies only, so other bodies need no mass centre.
        centre: if body.is_dynamic() { vec2(properties.local_com) } else { Vec2::zeros() },
        inertia: body.is_dynamic().then_some([mass, inertia]),
        is_link,
        force: weight + vec2(body.user_force()),
        moment: wide(body.user_torque()),
        damping,
    })
}

/// A vector from the engine.
pub(super) fn vec2(of: Vector) -> Vec2 {
    Vec2::new(wide(of.x), wide(of.y))
}

fn placement(pose: &Pose) -> Placement {
    Placement { origin: vec2(pose.translation), direction: Vec2::new(wide(pose.rotation.re), wide(pose.rotation.im)) }
}
