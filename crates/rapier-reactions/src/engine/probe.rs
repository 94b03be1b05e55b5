//! Reactions from tiny steps of a separate world.

use super::impulses::from_impulses;
use super::rapier::parry::mass_properties::MassProperties;
use super::rapier::prelude::{
    GenericJoint, GenericJointBuilder, ImpulseJointHandle, IntegrationParameters, JointAxesMask, JointAxis, MotorModel,
    PhysicsWorld, Pose, RigidBodyBuilder, RigidBodyHandle, Rotation, SpringCoefficients, Vector,
};
use super::snapshot::{JointHandle, JointReaction, Middle, Snapshot, WorldRef};
use super::{Real, TOLERANCE, TURN, real, wide};
use crate::balance::relative_speed;
use crate::error::ReactionError;
use crate::model::{ModelBody, ModelJoint, Stance};
use crate::plane::{Placement, Vec2, larger};
use crate::rows::{JointType, ROTATION};
use crate::tiny::{TinyStep, tiny_steps};

/// Frequency of the joints' softness (Hz). The frequency is so high that the joints are rigid up to rounding.
const JOINT_FREQUENCY: f64 = 1e12;

/// Damping of a velocity motor (N m s/rad or N s/m). The damping is so high that the motor keeps its speed up to
/// rounding.
const RIGID_MOTOR: f64 = 1e30;

/// The three coordinates of a joint.
const AXES: [JointAxis; 3] = [JointAxis::LinX, JointAxis::LinY, JointAxis::AngX];

/// Factor in the bound of the sweeps' rounding error. The rounding errors of the sweeps add up, because Rapier updates
/// the velocities after every change of an impulse. In a test with a driven pendulum, the relative error of the force
/// after n sweeps is 0.9 n epsilon / `turn`, where `turn` is the rotation in the tiny step (rad). The bound is about
/// twice this error.
const SWEEP_ULPS: f64 = 2.0;

/// Settings of a probe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probing {
    /// Rotation of the fastest body in the tiny step (rad). The tiny step is at most the step of the window.
    pub turn: f64,
    /// The sweeps are doubled until no force changes by more than this fraction of the largest force.
    /// The change of a moment is divided by the largest moment, or by the product of the largest force and the longest
    /// arm of a joint if this product is larger.
    /// The bound of the sweeps' rounding error is added to the fraction.
    pub tolerance: f64,
    /// The first number of sweeps.
    pub sweeps: usize,
    /// The largest number of sweeps.
    pub most_sweeps: usize,
}

impl Default for Probing {
    fn default() -> Self {
        Probing { turn: TURN, tolerance: TOLERANCE, sweeps: 64, most_sweeps: 65_536 }
    }
}

impl Probing {
    /// The reactions at the middle pose of a window with the step `longest` (s).
    pub(super) fn reactions(&self, middle: &Middle, longest: f64) -> Result<Vec<JointReaction>, ReactionError> {
        let fastest = middle.motions.iter().fold(0.0, |most, motion| larger(most, motion.omega.abs()));
        let turning = self.turn / fastest;
        let step = if turning < longest { turning } else { longest };
        let (arm, mut sweeps, mut coarse) = (arm(middle), self.sweeps, probed(middle, step, self.sweeps)?);
        loop {
            sweeps *= 2;
            let fine = probed(middle, step, sweeps)?;
            let change = change(&coarse, &fine, arm);
            if change <= self.tolerance + SWEEP_ULPS * sweeps as f64 * wide(Real::EPSILON) / self.turn {
                return Ok(fine);
            }
            if 2 * sweeps > self.most_sweeps {
                return Err(ReactionError::NotConverged(sweeps, change));
            }
            coarse = fine;
        }
    }
}

/// The longest arm of a joint about the mass centre of a dynamic body (m).
fn arm(middle: &Middle) -> f64 {
    let model = &middle.snapshot.model;
    let arms = model.joints.iter().zip(&middle.stances).flat_map(|(joint, stance)| {
        let is_moved = |side: &usize| model.bodies[joint.bodies[*side]].inertia.is_some();
        [0, 1].into_iter().filter(is_moved).map(|side| stance.rows.arms[side].norm()).collect::<Vec<f64>>()
    });
    arms.fold(0.0, larger)
}

/// Largest relative change of a force or of a moment.
/// The change of a force is divided by the largest force.
/// The change of a moment is divided by the largest moment, or by the product of the largest force and `arm` (m) if
/// this product is larger.
fn change(coarse: &[JointReaction], fine: &[JointReaction], arm: f64) -> f64 {
    let largest = |of: &dyn Fn(&JointReaction, &JointReaction) -> f64| {
        coarse.iter().zip(fine).fold(0.0, |most, (coarse, fine)| larger(most, of(coarse, fine).abs()))
    };
    let force = |of: [f64; 2]| Vec2::from(of).norm();
    let change = largest(&|coarse, fine| force([0, 1].map(|k| fine.force[k] - coarse.force[k])));
    let whole = largest(&|_, fine| force(fine.force));
    let turning = largest(&|coarse, fine| fine.moment - coarse.moment);
    let moment = larger(largest(&|_, fine| fine.moment), whole * arm);
    let part = |of: f64, whole: f64| if of > 0.0 { of / whole } else { of };
    larger(part(change, whole), part(turning, moment))
}

/// The reactions extrapolated from two tiny steps. Each tiny step has the same number of sweeps.
fn probed(middle: &Middle, step: f64, sweeps: usize) -> Result<Vec<JointReaction>, ReactionError> {
    let mut sum: Vec<JointReaction> = Vec::new();
    for tiny in tiny_steps(step) {
        let reactions = Sandbox::new(middle, &tiny, sweeps).step(middle, &tiny)?;
        if sum.is_empty() {
            sum = reactions.iter().map(|own| scaled(own, 0.0)).collect();
        }
        for (sum, own) in sum.iter_mut().zip(&reactions) {
            let part = scaled(own, tiny.share);
            (0..2).for_each(|k| sum.force[k] += part.force[k]);
            (0..3).for_each(|k| sum.efforts[k] += part.efforts[k]);
            sum.moment += part.moment;
        }
    }
    Ok(sum)
}

fn scaled(of: &JointReaction, share: f64) -> JointReaction {
    let (force, efforts) = (of.force.map(|value| value * share), of.efforts.map(|value| value * share));
    JointReaction { force, efforts, moment: of.moment * share, ..*of }
}

/// A separate world with the bodies and joints of a snapshot.
struct Sandbox {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    joints: Vec<ImpulseJointHandle>,
}

impl Sandbox {
    /// Makes the world, with the velocities at t - h: t is the time of the middle pose, and h is the tiny step.
    fn new(middle: &Middle, tiny: &TinyStep, sweeps: usize) -> Sandbox {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters = IntegrationParameters {
            dt: real(tiny.step),
            num_solver_iterations: 1,
            num_internal_pgs_iterations: sweeps,
            num_internal_stabilization_iterations: sweeps,
            max_ccd_substeps: 0,
            normalized_max_linear_velocity: Real::MAX,
            normalized_max_corrective_velocity: Real::MAX,
            ..IntegrationParameters::default()
        };
        let model = &middle.snapshot.model;
        let mut bodies = Vec::new();
        for (own, motion) in model.bodies.iter().zip(&middle.motions) {
            let [x, y, omega] = motion.speeds(-tiny.step).map(real);
            let is_moving = [x, y, omega].iter().any(|speed| *speed != 0.0);
            let handle = world.bodies.insert(body(own, is_moving).linvel(Vector::new(x, y)).angvel(omega));
            world.bodies[handle].add_force(vector(own.force), true);
            world.bodies[handle].add_torque(real(own.moment), true);
            bodies.push(handle);
        }
        let joints = model.joints.iter().map(|own| {
            let [first, second] = own.bodies.map(|body| bodies[body]);
            world.impulse_joints.insert(first, second, joint(own), true)
        });
        let joints = joints.collect();
        Sandbox { world, bodies, joints }
    }

    /// Makes the velocities consistent at t - h, steps from the pose at t, and reads the impulses.
    fn step(&mut self, middle: &Middle, tiny: &TinyStep) -> Result<Vec<JointReaction>, ReactionError> {
        let before = placements(middle, -tiny.step);
        self.drive(middle, &middle.snapshot.model.stances(&before), -tiny.step);
        // The velocities at t - h are computed from the poses of the window by differences. They satisfy the joints up
        // to the small error of these differences, so one step is enough to make them consistent. In both tiny
        // steps of the probe, this step also increases the speed of each free coordinate by its acceleration times h.
        self.place(&before);
        self.world.step();
        let now = placements(middle, 0.0);
        self.place(&now);
        self.drive(middle, &middle.stances, 0.0);
        self.world.step();
        // The joints of this world are all impulse joints between separate bodies.
        let mut snapshot = middle.snapshot.clone();
        snapshot.joints = self.joints.iter().copied().map(JointHandle::Impulse).collect();
        snapshot.model.bodies.iter_mut().for_each(|own| own.is_link = false);
        snapshot.handles.clone_from(&self.bodies);
        let reactions = from_impulses(&WorldRef::from(&self.world), &snapshot, &middle.stances)?;
        Ok(reactions.iter().enumerate().map(|(index, own)| named(own, middle.snapshot, index)).collect())
    }

    fn place(&mut self, placements: &[Placement]) {
        for (&body, placement) in self.bodies.iter().zip(placements) {
            self.world.bodies[body].set_position(pose(placement), true);
        }
    }

    /// Gives every coordinate with a motor, a damper or a spring the speed that it has in the window.
    fn drive(&mut self, middle: &Middle, stances: &[Stance], time: f64) {
        for (index, own) in middle.snapshot.model.joints.iter().enumerate() {
            let motions = own.bodies.map(|body| &middle.motions[body]);
            let joint = self.world.impulse_joints.get_mut(self.joints[index], true).expect("the joint exists");
            for (coordinate, axis) in AXES.into_iter().enumerate().filter(|(coordinate, _)| own.efforts[*coordinate]) {
                let speed = relative_speed(&stances[index], motions, coordinate, time);
                joint.data.set_motor_velocity(axis, real(speed), real(RIGID_MOTOR));
            }
        }
    }
}

/// A reaction of the separate world with the handles of the user's world.
fn named(of: &JointReaction, snapshot: &Snapshot, index: usize) -> JointReaction {
    let bodies = snapshot.model.joints[index].bodies.map(|body| snapshot.handles[body]);
    JointReaction { joint: snapshot.joints[index], bodies, ..*of }
}

fn placements(middle: &Middle, time: f64) -> Vec<Placement> {
    middle.snapshot.model.bodies.iter().zip(&middle.motions).map(|(own, motion)| motion.placement(own, time)).collect()
}

fn vector(of: Vec2) -> Vector {
    Vector::new(real(of.x), real(of.y))
}

fn pose(of: &Placement) -> Pose {
    Pose::from_parts(vector(of.origin), Rotation::from_cos_sin_unchecked(real(of.direction.x), real(of.direction.y)))
}

fn body(own: &ModelBody, is_moving: bool) -> RigidBodyBuilder {
    let [mass, inertia] = match own.inertia {
        Some(inertia) => inertia,
        None if is_moving => return RigidBodyBuilder::kinematic_velocity_based(),
        None => return RigidBodyBuilder::fixed(),
    };
    RigidBodyBuilder::dynamic()
        .can_sleep(false)
        // Without this setting, Rapier limits separate bodies to an eighth of a turn per step.
        .allow_fast_rotation(true)
        .linear_damping(real(own.damping[0]))
        .angular_damping(real(own.damping[1]))
        .additional_mass_properties(MassProperties::new(vector(own.centre), real(mass), real(inertia)))
}

fn joint(own: &ModelJoint) -> GenericJoint {
    let locked = match own.joint_type {
        JointType::Revolute => JointAxesMask::LOCKED_REVOLUTE_AXES,
        JointType::Prismatic => JointAxesMask::LOCKED_PRISMATIC_AXES,
        JointType::Fixed => JointAxesMask::LOCKED_FIXED_AXES,
        JointType::Free => JointAxesMask::empty(),
    };
    let softness = SpringCoefficients::new(real(JOINT_FREQUENCY), 1.0);
    let mut joint = GenericJointBuilder::new(locked).contacts_enabled(false).softness(softness).build();
    joint.set_local_frame1(pose(&own.frames[0])).set_local_frame2(pose(&own.frames[1]));
    for (_, axis) in AXES.into_iter().enumerate().filter(|(coordinate, _)| own.efforts[*coordinate]) {
        joint.set_motor_model(axis, MotorModel::ForceBased);
    }
    debug_assert_eq!(ROTATION, JointAxis::AngX as usize);
    joint
}
