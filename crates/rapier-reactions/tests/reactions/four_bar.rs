//! A four-bar that a motor drives at constant speed: its closed form, and two worlds of Rapier.
//!
//! The forces of the closed form agree with the power balance of the whole mechanism.

use super::plane::{Pair, add, carried, cross, dot, less, solved, times, turned};
use rapier_reactions::double::{JointHandle, JointReaction};
use rapier2d_f64::parry::mass_properties::MassProperties;
use rapier2d_f64::prelude::*;

/// Crank, coupler and rocker: length (m), mass (kg), moment of inertia (kg m^2), mass centre in the link's frame (m).
/// The origin of a link's frame is the inner pin; the x axis goes to the outer pin.
const LINKS: [(f64, f64, f64, Pair); 3] =
    [(0.1, 1.5, 0.002, [0.04, 0.01]), (0.35, 3.0, 0.04, [0.15, 0.05]), (0.25, 2.0, 0.015, [0.1, -0.02])];
const GROUND: f64 = 0.4;
pub const SPEED: f64 = 10.0;
const START: f64 = 0.3;
pub const GRAVITY: Pair = [0.0, -9.81];
/// Force (N) at the mass centre of the coupler, and torque (N m) on the coupler.
pub const LOAD: (Pair, f64) = ([20.0, -35.0], 1.5);

/// Number of compared channels: two components of the force on the second body in each of O, A, B and C, and the
/// driving moment.
pub const CHANNELS: usize = 9;

/// Motion of a link: position of the inner pin, angle, and their derivatives.
#[derive(Clone, Copy)]
struct LinkMotion {
    pin: [Pair; 3],
    angle: [f64; 3],
}

/// The links at a time (s).
fn motions(time: f64) -> [LinkMotion; 3] {
    let [crank, coupler, rocker] = [0, 1, 2].map(|k| LINKS[k].0);
    let phi = START + SPEED * time;
    let a = turned([crank, 0.0], phi);
    let a_speed = times([-a[1], a[0]], SPEED);
    let a_acceleration = times(a, -SPEED * SPEED);
    let c = [GROUND, 0.0];
    // B is on the left of the line from A to C.
    let line = less(c, a);
    let length = dot(line, line).sqrt();
    let along = (length * length + coupler * coupler - rocker * rocker) / (2.0 * length);
    let across = (coupler * coupler - along * along).sqrt();
    let unit = times(line, length.recip());
    let b = add(a, add(times(unit, along), times([-unit[1], unit[0]], across)));
    let (ab, cb) = (less(b, a), less(b, c));
    // The lengths AB and CB are constant: two equations for the velocity, and two for the acceleration of B.
    let of = |first: f64, second: f64| solved([ab[0], cb[0]], [ab[1], cb[1]], [first, second]);
    let b_speed = of(dot(ab, a_speed), 0.0);
    let relative = less(b_speed, a_speed);
    let b_acceleration = of(dot(ab, a_acceleration) - dot(relative, relative), -dot(b_speed, b_speed));
    let rate = |arm: Pair, of: Pair| cross(arm, of) / dot(arm, arm);
    let link = |pin: [Pair; 3], arm: Pair, speed: Pair, acceleration: Pair| LinkMotion {
        pin,
        angle: [arm[1].atan2(arm[0]), rate(arm, speed), rate(arm, acceleration)],
    };
    let ground = |at: Pair| [at, [0.0; 2], [0.0; 2]];
    [
        link(ground([0.0; 2]), a, a_speed, a_acceleration),
        link([a, a_speed, a_acceleration], ab, relative, less(b_acceleration, a_acceleration)),
        link(ground(c), cb, b_speed, b_acceleration),
    ]
}

/// Angles of crank, coupler and rocker at the start.
pub fn start_angles() -> [f64; 3] {
    motions(0.0).map(|link| link.angle[0])
}

/// Position of the inner pins at the start.
fn start_pins() -> [Pair; 3] {
    motions(0.0).map(|link| link.pin[0])
}

/// Force and moment about the inner pin that the joints must exert on a link under `gravity` and `load`, and the vector
/// from the inner pin to the mass centre.
fn needed(link: usize, motion: &LinkMotion, gravity: Pair, load: (Pair, f64)) -> (Pair, f64, Pair) {
    let (_, mass, inertia, centre) = LINKS[link];
    let arm = turned(centre, motion.angle[0]);
    let acceleration = carried(motion.pin[2], arm, motion.angle[1], motion.angle[2]);
    let force = less(times(less(acceleration, gravity), mass), load.0);
    (force, inertia * motion.angle[2] + cross(arm, force) - load.1, arm)
}

/// The closed form with any gravity and load: the forces on the second body in O, A, B and C, and the driving moment.
pub fn exact_with(time: f64, gravity: Pair, load: (Pair, f64)) -> [f64; CHANNELS] {
    let links = motions(time);
    let none = ([0.0; 2], 0.0);
    let [crank, coupler, rocker] =
        [(0, none), (1, load), (2, none)].map(|(link, load)| needed(link, &links[link], gravity, load));
    let arm = |link: usize| turned([LINKS[link].0, 0.0], links[link].angle[0]);
    let (oa, ab, cb) = (arm(0), arm(1), arm(2));
    // The force in B follows from the moments of the coupler about A and of the rocker about C. On the coupler, this
    // force acts in the opposite direction.
    let b = solved([ab[1], -cb[1]], [-ab[0], cb[0]], [coupler.1, rocker.1]);
    let a = add(coupler.0, b);
    let c = less(rocker.0, b);
    let o = add(crank.0, a);
    let torque = crank.1 + cross(oa, a);
    [o[0], o[1], a[0], a[1], b[0], b[1], c[0], c[1], torque]
}

pub fn exact(time: f64) -> [f64; CHANNELS] {
    exact_with(time, GRAVITY, LOAD)
}

/// Half the peak-to-peak range of every channel in one turn.
pub fn ranges() -> [f64; CHANNELS] {
    let period = std::f64::consts::TAU / SPEED;
    let rows: Vec<_> = (0..720).map(|k| exact(period * f64::from(k) / 720.0)).collect();
    std::array::from_fn(|channel| {
        let of = |pick: fn(f64, f64) -> bool| {
            rows.iter().map(|row| row[channel]).reduce(|a, b| if pick(a, b) { a } else { b }).unwrap()
        };
        0.5 * (of(|a, b| a > b) - of(|a, b| a < b))
    })
}

/// Power of drive, gravity and load, minus the rate of change of the kinetic energy (W). The difference is zero.
pub fn power_imbalance(time: f64) -> f64 {
    let links = motions(time);
    let mut sum = exact(time)[8] * SPEED;
    for (link, motion) in links.iter().enumerate() {
        let (force, _, arm) = needed(link, motion, GRAVITY, if link == 1 { LOAD } else { ([0.0; 2], 0.0) });
        let speed = add(motion.pin[1], times([-arm[1], arm[0]], motion.angle[1]));
        let torque = if link == 1 { LOAD.1 } else { 0.0 };
        sum -= dot(force, speed) + (LINKS[link].2 * motion.angle[2] - torque) * motion.angle[1];
    }
    sum
}

/// Construction of the four-bar in Rapier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Build {
    /// Crank, coupler and rocker in a multibody; the pin B and the motor are impulse joints.
    Multibody,
    /// Separate bodies; the motor is in the impulse joint O.
    Impulse,
}

/// A world with the four-bar, and the joints of the channels: O, A, B, C, and the joint with the motor.
pub struct FourBar {
    pub world: PhysicsWorld,
    joints: [JointHandle; 5],
    pub links: [RigidBodyHandle; 3],
}

pub fn body(world: &mut PhysicsWorld, link: (f64, f64, f64, Pair), pin: Pair, angle: f64) -> RigidBodyHandle {
    let (_, mass, inertia, centre) = link;
    let properties = MassProperties::new(Vector::new(centre[0], centre[1]), mass, inertia);
    let builder = RigidBodyBuilder::dynamic().can_sleep(false).allow_fast_rotation(true);
    let builder = builder.translation(Vector::new(pin[0], pin[1])).rotation(angle);
    world.bodies.insert(builder.additional_mass_properties(properties))
}

pub fn pin(first: Pair, second: Pair) -> GenericJoint {
    let joint = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES).contacts_enabled(false);
    let joint = joint.softness(SpringCoefficients::new(1e12, 1.0));
    joint.local_anchor1(Vector::new(first[0], first[1])).local_anchor2(Vector::new(second[0], second[1])).build()
}

/// A world with rigid settings and the step `step` (s).
pub fn empty_world(step: f64, sweeps: usize) -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(GRAVITY[0], GRAVITY[1]);
    let parameters = &mut world.integration_parameters;
    (parameters.dt, parameters.num_solver_iterations, parameters.max_ccd_substeps) = (step, 1, 0);
    parameters.num_internal_pgs_iterations = sweeps;
    parameters.num_internal_stabilization_iterations = sweeps;
    parameters.normalized_max_linear_velocity = Real::MAX;
    world
}

/// A motor that keeps a speed in the joint.
pub fn driven(mut joint: GenericJoint, axis: JointAxis, speed: f64) -> GenericJoint {
    joint.set_motor_model(axis, MotorModel::ForceBased).set_motor_velocity(axis, speed, 1e30);
    joint
}

impl FourBar {
    pub fn new(build: Build, step: f64) -> FourBar {
        let mut world = empty_world(step, if build == Build::Multibody { 256 } else { 4096 });
        let ground = world.bodies.insert(RigidBodyBuilder::fixed());
        let (pins, angles) = (start_pins(), start_angles());
        let links = [0, 1, 2].map(|k| body(&mut world, LINKS[k], pins[k], angles[k]));
        let end = |link: usize| [LINKS[link].0, 0.0];
        let data = [pin([0.0; 2], [0.0; 2]), pin(end(0), [0.0; 2]), pin(end(1), end(2)), pin([GROUND, 0.0], [0.0; 2])];
        let pairs = [[ground, links[0]], [links[0], links[1]], [links[1], links[2]], [ground, links[2]]];
        let impulse = |world: &mut PhysicsWorld, k: usize, data: GenericJoint| {
            JointHandle::Impulse(world.impulse_joints.insert(pairs[k][0], pairs[k][1], data, true))
        };
        let joints = match build {
            Build::Impulse => {
                // A separate body turns by atan(omega h) in a step.
                let speed = (SPEED * step).tan() / step;
                let o = impulse(&mut world, 0, driven(data[0], JointAxis::AngX, speed));
                let [a, b, c] = [1, 2, 3].map(|k| impulse(&mut world, k, data[k]));
                [o, a, b, c, o]
            }
            Build::Multibody => {
                let [o, a, c] = [0, 1, 3].map(|k| {
                    let [first, second] = pairs[k];
                    world.multibody_joints.insert(first, second, data[k], true).unwrap()
                });
                set_up(&mut world, o, &[angles[0], angles[1] - angles[0], angles[2]]);
                let b = impulse(&mut world, 2, data[2]);
                let free = GenericJointBuilder::new(JointAxesMask::empty()).contacts_enabled(false).build();
                let motor = impulse(&mut world, 0, driven(free, JointAxis::AngX, SPEED));
                [JointHandle::Multibody(o), JointHandle::Multibody(a), b, JointHandle::Multibody(c), motor]
            }
        };
        let coupler = &mut world.bodies[links[1]];
        coupler.add_force(Vector::new(LOAD.0[0], LOAD.0[1]), true);
        coupler.add_torque(LOAD.1, true);
        FourBar { world, joints, links }
    }

    /// The channels of reactions; NaN for joints that are not read.
    pub fn channels(&self, reactions: &[JointReaction]) -> [f64; CHANNELS] {
        let of = |joint: JointHandle| reactions.iter().find(|own| own.joint == joint);
        std::array::from_fn(|channel| match channel {
            8 => of(self.joints[4]).map_or(f64::NAN, |own| own.moment),
            _ => of(self.joints[channel / 2]).map_or(f64::NAN, |own| own.force[channel % 2]),
        })
    }
}

/// Prepares a multibody: no damping, and the given joint coordinates.
pub fn set_up(world: &mut PhysicsWorld, joint: MultibodyJointHandle, coordinates: &[f64]) {
    let (multibody, _) = world.multibody_joints.get_mut(joint).unwrap();
    // Removes the coordinates of the fixed root.
    multibody.forward_kinematics(&world.bodies, true);
    multibody.damping_mut().fill(0.0);
    multibody.apply_displacements(coordinates);
    multibody.forward_kinematics(&world.bodies, false);
    multibody.update_rigid_bodies(&mut world.bodies, true);
}
