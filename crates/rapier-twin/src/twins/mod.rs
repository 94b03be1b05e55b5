//! Rapier's worlds, written once for both precisions.
//! This module is compiled against `rapier2d-f64` and against `rapier2d`.

mod frame;
mod joints;
mod motion;
mod reading;

use super::{Real, parry, rapier, real, wide};

use rapier::prelude::{
    ImpulseJointHandle, JointAxis, MotorModel, MultibodyJointHandle, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
};

use crate::steer::steered;
use crate::tree::Tree;
use crate::world::{LinkAngle, LinkFrame, Loading, world_masses};
use linkage::case::Case;
use linkage::engine::Settings;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Joint, LinkPose};

/// Damping of the velocity motor (N m s/rad) that holds a prescribed speed to rounding.
const RIGID_MOTOR: f64 = 1e30;

/// A joint that closes a loop.
#[derive(Clone, Debug)]
struct Cut {
    joint: Joint,
    index: usize,
    handle: ImpulseJointHandle,
    /// The link that Rapier calls first, and the direction of the first row in that link's frame, where they are not
    /// those of the joint itself.
    steered: Option<(usize, Vec2)>,
    /// Where the joint was at the start of the last substep.
    start: frame::Frame,
}

/// The motor of a drive. It stands on the ground, also where its link hangs on a moving one: it gives the link its speed
/// in the world.
#[derive(Clone, Debug)]
struct Motor {
    handle: ImpulseJointHandle,
    /// +1 if the driving link is what the motor counts as second, else -1.
    sense: f64,
}

/// The Rapier world of a case.
pub(crate) struct Twin {
    world: PhysicsWorld,
    tree: Tree,
    joints: Vec<Joint>,
    bodies: Vec<RigidBodyHandle>,
    /// The multibody of all links, given by one of them; `None` if all links are separate bodies.
    any_link: Option<MultibodyJointHandle>,
    /// Links outside the tree. They are separate bodies, or float in the multibody.
    outside: Vec<usize>,
    /// Generalised coordinate of every branch's joint: its index in the multibody.
    /// Its sense is that of the child relative to its parent.
    dofs: Vec<usize>,
    /// Number of every branch's link in the multibody.
    ids: Vec<usize>,
    /// The first of the three coordinates of every link that floats in the multibody, and its number there.
    floating: Vec<[usize; 2]>,
    cuts: Vec<Cut>,
    /// One for each drive, in the case's order.
    motors: Vec<Motor>,
    /// Mass centre of every link, and the inverses of the mass and of the moment of inertia that it has here.
    centres: Vec<Vec2>,
    inverse: Vec<[f64; 2]>,
    /// Angle of the child minus that of its parent (rad), for every branch whose joint keeps it constant.
    twists: Vec<Option<f64>>,
    /// Frames of all links after the last step or placement.
    frames: Vec<LinkFrame>,
    /// Whether reactions will be read.
    read: bool,
}

impl Twin {
    /// Builds the world in the case's start pose, at rest.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if Rapier refuses a joint.
    pub(crate) fn new(case: &Case, tree: Tree, settings: &Settings, loading: Loading) -> Result<Self> {
        let mechanism = &case.mechanism;
        let masses = world_masses(case, &tree, loading);
        let read = loading != Loading::Moving;
        let mut world = PhysicsWorld::new();
        world.gravity = joints::vector(case.gravity);
        world.integration_parameters = joints::parameters(settings);
        let mut bodies = vec![world.bodies.insert(RigidBodyBuilder::fixed())];
        for (link, &masses) in mechanism.links().iter().zip(&masses).skip(1) {
            bodies.push(world.bodies.insert(joints::body(link, masses)));
        }
        let is_outside = |&link: &usize| tree.branches.iter().all(|branch| branch.link != link);
        let outside: Vec<usize> = (1..mechanism.links().len()).filter(is_outside).collect();
        let mut any_link = None;
        for branch in &tree.branches {
            let found = &mechanism.joints()[branch.joint];
            let joint = joints::between(found, [branch.parent, branch.link]);
            any_link = world.multibody_joints.insert(bodies[branch.parent], bodies[branch.link], joint, true);
            if any_link.is_none() {
                let name = &found.name;
                return Err(Error::new(ErrorKind::Unsupported, format!("Rapier refuses the tree joint \"{name}\"")));
            }
        }
        if any_link.is_some() {
            // Rapier never turns a separate body that is joined to a link of the multibody. Links outside the tree
            // are links of the multibody too, with all three freedoms.
            for &link in &outside {
                let joint = joints::floating(&mechanism.links()[link]);
                any_link = world.multibody_joints.insert(bodies[GROUND], bodies[link], joint, true);
            }
        }
        let cuts = tree.cut.iter().map(|&index| {
            let joint = mechanism.joints()[index].clone();
            let links = [joint.first.link, joint.second.link];
            let steered = steered(&tree, mechanism, &masses, &joint);
            let (order, between) = match steered {
                None => (links, joints::between(&joint, links)),
                Some((order, axis)) => (order, joints::steered(&joint, order, axis)),
            };
            let handle = world.impulse_joints.insert(bodies[order[0]], bodies[order[1]], between, true);
            let steered = steered.map(|(order, axis)| (order[0], axis));
            Cut { joint, index, handle, steered, start: frame::Frame::default() }
        });
        let cuts = cuts.collect();
        let motors = case.drives.iter().map(|drive| {
            let joint = &mechanism.joints()[drive.joint];
            let data = joints::free()
                .motor_model(JointAxis::AngX, MotorModel::ForceBased)
                .motor_velocity(JointAxis::AngX, 0.0, real(RIGID_MOTOR))
                .build();
            let is_second = joint.second.link != GROUND;
            let links = if is_second { [GROUND, drive.link] } else { [drive.link, GROUND] };
            let handle = world.impulse_joints.insert(bodies[links[0]], bodies[links[1]], data, true);
            Motor { handle, sense: if is_second { 1.0 } else { -1.0 } }
        });
        let motors = motors.collect();
        let twists = tree.branches.iter().map(|branch| {
            let angle = |link: usize| case.start.0[link].angle;
            mechanism.joints()[branch.joint].keeps_angle().then(|| angle(branch.link) - angle(branch.parent))
        });
        let frames = (0..mechanism.links().len()).map(|link| {
            let angle = if outside.contains(&link) { LinkAngle::Turns(0.0) } else { LinkAngle::Whole(0.0) };
            LinkFrame { angle, ..LinkFrame::GROUND }
        });
        let mut twin = Twin {
            twists: twists.collect(),
            joints: mechanism.joints().to_vec(),
            frames: frames.collect(),
            outside,
            any_link,
            dofs: Vec::new(),
            ids: Vec::new(),
            floating: Vec::new(),
            cuts,
            motors,
            centres: mechanism.links().iter().map(|link| link.mass_centre).collect(),
            inverse: masses.iter().map(|of| of.map(|of| if of > 0.0 { of.recip() } else { 0.0 })).collect(),
            read,
            world,
            bodies,
            tree,
        };
        twin.prepare();
        twin.put(&case.start.0);
        Ok(twin)
    }

    /// Prepares the multibody. The order of calls matters: see the comments.
    fn prepare(&mut self) {
        if self.any_link.is_none() {
            return;
        }
        let PhysicsWorld { multibody_joints, bodies, .. } = &mut self.world;
        let root = multibody_joints.rigid_body_link(self.bodies[GROUND]).expect("the ground is in it").multibody;
        let id = |link: usize| {
            multibody_joints.rigid_body_link(self.bodies[link]).expect("every link is in the multibody").id
        };
        let ids: Vec<usize> = self.tree.branches.iter().map(|branch| id(branch.link)).collect();
        let floating: Vec<usize> = self.outside.iter().map(|&link| id(link)).collect();
        let multibody = multibody_joints.get_multibody_mut(root).expect("the multibody exists");
        // Removes the degrees of freedom of the fixed root; the indices below are wrong before this call.
        multibody.forward_kinematics(bodies, true);
        // Rapier gives every revolute joint a damping of 0.1 N m s/rad by default.
        multibody.damping_mut().fill(0.0);
        let first = |id: usize| multibody.link(id).expect("the link exists").assembly_id();
        self.dofs = ids.iter().map(|&id| first(id)).collect();
        self.floating = floating.into_iter().map(|id| [first(id), id]).collect();
        self.ids = ids;
    }

    /// Moves all links into the given poses.
    fn put(&mut self, poses: &[LinkPose]) {
        self.put_tree(poses);
        self.put_bodies(poses);
        self.put_frames(poses);
    }
}
