//! Rapier's worlds, written once for both precisions.
//! This module is compiled against `rapier2d-f64` and against `rapier2d`.

mod frame;
mod joints;
mod motion;
mod reading;

use super::{Real, parry, rapier, real, wide};

use rapier::prelude::{
    ImpulseJointHandle, JointAxesMask, JointAxis, MotorModel, MultibodyJointHandle, PhysicsWorld, RigidBodyBuilder,
    RigidBodyHandle,
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
    /// Whether neither body is a link of the multibody. Rapier then makes the joint's rows orthogonal to each other.
    plain: bool,
    /// The link that Rapier calls first, and the direction of the first row in that link's frame, where they are not
    /// those of the joint itself.
    steered: Option<(usize, Vec2)>,
    /// Where the joint was at the start of the last substep.
    start: frame::Frame,
}

/// The motor of a drive.
#[derive(Clone, Debug)]
struct Motor {
    handle: ImpulseJointHandle,
    /// +1 if the driving link is the second link of the driven joint, as the motor counts it, else -1.
    sense: f64,
    /// Whether the driving link is a separate body.
    plain: bool,
}

/// The Rapier world of a case.
pub(crate) struct Twin {
    world: PhysicsWorld,
    tree: Tree,
    joints: Vec<Joint>,
    bodies: Vec<RigidBodyHandle>,
    /// The multibody, given by one of its links; `None` if all links are separate bodies.
    any_link: Option<MultibodyJointHandle>,
    /// Links that are separate bodies.
    plain: Vec<usize>,
    /// Generalised coordinate of every branch's joint: its index in the multibody.
    /// Its sense is that of the child relative to its parent.
    dofs: Vec<usize>,
    /// Number of every branch's link in the multibody.
    ids: Vec<usize>,
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
        let plain = |link: usize| tree.branches.iter().all(|branch| branch.link != link);
        // Rapier never turns a separate body that is joined to a link of the multibody.
        // Such bodies are therefore joined to a separate ground.
        let own_ground = world.bodies.insert(RigidBodyBuilder::fixed());
        let hold = |link: usize, other: usize| {
            if link == GROUND && plain(other) { own_ground } else { bodies[link] }
        };
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
        let cuts = tree.cut.iter().map(|&index| {
            let joint = mechanism.joints()[index].clone();
            let links = [joint.first.link, joint.second.link];
            let steered = steered(&tree, mechanism, &masses, &joint);
            let (order, between) = match steered {
                None => (links, joints::between(&joint, links)),
                Some((order, axis)) => (order, joints::steered(&joint, order, axis)),
            };
            let (first, second) = (hold(order[0], order[1]), hold(order[1], order[0]));
            let handle = world.impulse_joints.insert(first, second, between, true);
            let plain = links.into_iter().filter(|&link| link != GROUND).all(plain);
            let steered = steered.map(|(order, axis)| (order[0], axis));
            Cut { joint, index, handle, plain, steered, start: frame::Frame::default() }
        });
        let cuts = cuts.collect();
        let motors = case.drives.iter().map(|drive| {
            let joint = &mechanism.joints()[drive.joint];
            let links = [joint.first.link, joint.second.link];
            let data = joints::holding(JointAxesMask::empty(), joint, links)
                .motor_model(JointAxis::AngX, MotorModel::ForceBased)
                .motor_velocity(JointAxis::AngX, 0.0, real(RIGID_MOTOR))
                .build();
            let (first, second) = (hold(links[0], links[1]), hold(links[1], links[0]));
            let sense = if links[1] == drive.link { 1.0 } else { -1.0 };
            Motor { handle: world.impulse_joints.insert(first, second, data, true), sense, plain: plain(drive.link) }
        });
        let motors = motors.collect();
        let twists = tree.branches.iter().map(|branch| {
            let angle = |link: usize| case.start.0[link].angle;
            mechanism.joints()[branch.joint].keeps_angle().then(|| angle(branch.link) - angle(branch.parent))
        });
        let frames = (0..mechanism.links().len()).map(|link| {
            let angle = if link == GROUND || !plain(link) { LinkAngle::Whole(0.0) } else { LinkAngle::Turns(0.0) };
            LinkFrame { angle, ..LinkFrame::GROUND }
        });
        let mut twin = Twin {
            twists: twists.collect(),
            joints: mechanism.joints().to_vec(),
            plain: (1..mechanism.links().len()).filter(|&link| plain(link)).collect(),
            any_link,
            dofs: Vec::new(),
            ids: Vec::new(),
            cuts,
            motors,
            centres: mechanism.links().iter().map(|link| link.mass_centre).collect(),
            inverse: masses.iter().map(|of| of.map(|of| if of > 0.0 { of.recip() } else { 0.0 })).collect(),
            frames: frames.collect(),
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
        let ids = self.tree.branches.iter().map(|branch| {
            multibody_joints.rigid_body_link(self.bodies[branch.link]).expect("every link is in the multibody").id
        });
        let ids: Vec<usize> = ids.collect();
        let multibody = multibody_joints.get_multibody_mut(root).expect("the multibody exists");
        // Removes the degrees of freedom of the fixed root; the indices below are wrong before this call.
        multibody.forward_kinematics(bodies, true);
        // Rapier gives every revolute joint a damping of 0.1 N m s/rad by default.
        multibody.damping_mut().fill(0.0);
        self.dofs = ids.iter().map(|&id| multibody.link(id).expect("the link exists").assembly_id()).collect();
        self.ids = ids;
    }

    /// Moves all links into the given poses.
    fn put(&mut self, poses: &[LinkPose]) {
        self.put_tree(poses);
        self.put_bodies(poses);
        self.put_frames(poses);
    }
}
