//! Rapier's worlds, from one source for both precisions.
//! This module is compiled against `rapier2d-f64` and against `rapier2d`.

mod joints;
mod meshes;
mod motion;
mod reading;

use super::{Real, parry, rapier, reactions, real, wide};
use crate::sentences;

use rapier::prelude::{
    GenericJoint, ImpulseJointHandle, JointAxis, MultibodyJointHandle, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
};

use crate::masses::{Loading, world_masses};
use crate::steer::steered;
use crate::tree::SpanningTree;
use crate::world::{LinkAngle, LinkFrame};
use linkage::case::Case;
use linkage::engine::Settings;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Joint, JointId, LinkId, LinkPose, Transmission};
use rapier_reactions::JointRows;

/// If a tree has at least this many branches, a free motion has a separate multibody for every link that is joined to
/// the ground.
/// In a sweep, the cost of a row grows with the number of coordinates of the multibodies to which its two links belong.
/// Coordinates that do not move these links cost as much as coordinates that move them.
/// With separate multibodies, a chain of ten four-bars takes 0.6 of the time that it takes with one multibody.
///
/// Smaller trees, and all prescribed motions, stay in one multibody. (In a prescribed motion, the links have the
/// drives' flywheels.)
/// On `ov7_base` with steps of 1.4 ms, separate multibodies increased the errors of forces by a factor of 60.
/// The likely cause is a test in Rapier that decides when the Coriolis forces of a multibody are computed.
/// Rapier usually computes these forces at the end of a step.
/// If the forces would add more than a hundredth of the multibody's kinetic energy, Rapier computes them at the start
/// of the step.
const LARGE: usize = 16;

/// A joint that closes a loop.
#[derive(Clone, Debug)]
struct Cut {
    joint: Joint,
    index: JointId,
    handle: ImpulseJointHandle,
    /// The link that is Rapier's first body, and the direction of the first row in that link's frame.
    /// `None` if Rapier's first body is the joint's first link and the direction is not changed.
    steered: Option<(LinkId, Vec2)>,
    /// Rows of the joint at the start of the last substep.
    start: JointRows,
}

/// A transmission in the world.
#[derive(Clone, Debug)]
struct Mesh {
    transmission: Transmission,
    handle: ImpulseJointHandle,
    /// The difference q2 - f(q1) at the start.
    phase: f64,
}

/// The motor of a drive.
/// The motor of a crank connects the crank to the ground, so it sets the crank's speed in the world.
/// The motor of any other drive connects the two links of the driven joint.
#[derive(Clone, Debug)]
struct Motor {
    handle: ImpulseJointHandle,
    /// The coordinate that the motor moves.
    axis: JointAxis,
    /// Sign of the drive's input in this coordinate.
    sense: f64,
}

/// Position of a link in the multibodies.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Index of the multibody in the list of multibodies.
    multibody: usize,
    /// Index of the link's first coordinate in its multibody.
    dof: usize,
    /// Number of the link in its multibody.
    id: usize,
}

/// The Rapier world of a case.
pub(crate) struct Twin {
    world: PhysicsWorld,
    tree: SpanningTree,
    joints: Vec<Joint>,
    bodies: Vec<RigidBodyHandle>,
    /// The multibodies, each given by one of its links. The list is empty if all links are separate bodies. See
    /// [`LARGE`].
    multibodies: Vec<MultibodyJointHandle>,
    /// Links outside the tree. These links are separate bodies, or float in a multibody.
    outside: Vec<LinkId>,
    /// Position of every branch's link in the multibodies.
    /// A positive coordinate of a link means a positive displacement of the link relative to its parent.
    places: Vec<Place>,
    /// Position of every floating link in the multibodies. Each floating link has three coordinates.
    floating: Vec<Place>,
    cuts: Vec<Cut>,
    /// The transmissions, in the case's order.
    meshes: Vec<Mesh>,
    /// The motors, one for each drive, in the case's order.
    motors: Vec<Motor>,
    /// Mass centre of every link, and the inverses of the link's mass and moment of inertia in this world.
    centres: Vec<Vec2>,
    inverse: Vec<[f64; 2]>,
    /// Angle of the child minus the angle of its parent (rad), for every branch whose joint keeps this difference
    /// constant.
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
    pub(crate) fn new(case: &Case, tree: SpanningTree, settings: &Settings, loading: Loading) -> Result<Self> {
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
        let is_outside = |&link: &LinkId| tree.branches.iter().all(|branch| branch.link != link);
        let outside: Vec<LinkId> = mechanism.links().ids().skip(1).filter(is_outside).collect();
        let is_split = case.is_free() && tree.branches.len() >= LARGE;
        let (mut multibodies, mut home) = (Vec::new(), vec![0; bodies.len()]);
        // Joins a link to the ground: to the shared ground body, or to an additional ground body for this multibody
        // alone.
        let mut hang = |world: &mut PhysicsWorld, link: LinkId, joint: GenericJoint| {
            let ground = if is_split { world.bodies.insert(RigidBodyBuilder::fixed()) } else { bodies[GROUND] };
            let handle = world.multibody_joints.insert(ground, bodies[link], joint, true)?;
            if is_split || multibodies.is_empty() {
                multibodies.push(handle);
            }
            Some(multibodies.len() - 1)
        };
        for branch in &tree.branches {
            let found = &mechanism.joints()[branch.joint];
            let joint = joints::between(found, [branch.parent, branch.link]);
            let own = if branch.parent == GROUND {
                hang(&mut world, branch.link, joint)
            } else {
                let [parent, link] = [branch.parent, branch.link].map(|link| bodies[link]);
                world.multibody_joints.insert(parent, link, joint, true).map(|_| home[branch.parent])
            };
            let Some(own) = own else {
                let name = &found.name;
                return Err(Error::new(ErrorKind::Unsupported, sentences::rapier_refuses_the_tree_joint(&name)));
            };
            home[branch.link] = own;
        }
        if !tree.branches.is_empty() {
            // Rapier never turns a separate body that is joined to a link of a multibody.
            // Links outside the tree are therefore also links of a multibody, with all three degrees of freedom.
            for &link in &outside {
                home[link] =
                    hang(&mut world, link, joints::floating(&mechanism.links()[link])).expect("it has no parent");
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
            Cut { joint, index, handle, steered, start: JointRows::default() }
        });
        let cuts = cuts.collect();
        let motors = case.drives.iter().map(|drive| {
            let (data, links, axis, sense) = joints::motor(drive, &mechanism.joints()[drive.joint]);
            let handle = world.impulse_joints.insert(bodies[links[0]], bodies[links[1]], data, true);
            Motor { handle, axis, sense }
        });
        let motors = motors.collect();
        let twists = tree.branches.iter().map(|branch| {
            let angle = |link: LinkId| case.start.0[link].angle;
            mechanism.joints()[branch.joint].keeps_angle().then(|| angle(branch.link) - angle(branch.parent))
        });
        let frames = mechanism.links().ids().map(|link| {
            let angle = if outside.contains(&link) { LinkAngle::Turns(0.0) } else { LinkAngle::Whole(0.0) };
            LinkFrame { angle, ..LinkFrame::GROUND }
        });
        let mut twin = Twin {
            twists: twists.collect(),
            joints: mechanism.joints().to_vec(),
            frames: frames.collect(),
            outside,
            multibodies,
            places: Vec::new(),
            floating: Vec::new(),
            cuts,
            meshes: Vec::new(),
            motors,
            centres: mechanism.links().iter().map(|link| link.mass_centre).collect(),
            inverse: masses.iter().map(|of| of.map(|of| if of > 0.0 { of.recip() } else { 0.0 })).collect(),
            read,
            world,
            bodies,
            tree,
        };
        twin.prepare(&home);
        twin.put(&case.start.0);
        twin.mesh(case);
        Ok(twin)
    }

    /// Prepares the multibodies; `home` gives the multibody of every link. The order of the calls matters; comments
    /// give the reasons.
    fn prepare(&mut self, home: &[usize]) {
        if self.multibodies.is_empty() {
            return;
        }
        let PhysicsWorld { multibody_joints, bodies, .. } = &mut self.world;
        for &handle in &self.multibodies {
            let (multibody, _) = multibody_joints.get_mut(handle).expect("the multibody exists");
            // Removes the degrees of freedom of the fixed root. Before this call, the indices below would be wrong.
            multibody.forward_kinematics(bodies, true);
            // Rapier gives every revolute joint a damping of 0.1 N m s/rad by default, so this damping is set to zero.
            multibody.damping_mut().fill(0.0);
        }
        let place = |link: LinkId| {
            let own = multibody_joints.rigid_body_link(self.bodies[link]).expect("every link is in a multibody");
            let multibody = multibody_joints.get_multibody(own.multibody).expect("the multibody exists");
            let dof = multibody.link(own.id).expect("the link exists").assembly_id();
            Place { multibody: home[link], dof, id: own.id }
        };
        self.places = self.tree.branches.iter().map(|branch| place(branch.link)).collect();
        self.floating = self.outside.iter().map(|&link| place(link)).collect();
    }

    /// Moves all links into the given poses.
    fn put(&mut self, poses: &[LinkPose]) {
        self.put_tree(poses);
        self.put_bodies(poses);
        self.put_frames(poses);
    }
}
