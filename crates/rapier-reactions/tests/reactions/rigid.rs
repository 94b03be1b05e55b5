//! Fixed and prismatic joints between moving bodies, in closed form.
//!
//! An arm turns about the origin at constant speed. A block is fixed to the arm, or slides on it at constant speed
//! along an inclined line. The mass centre of the block is not at the joint, so all rows of the joint are loaded.

use super::four_bar::{GRAVITY, body, driven, empty_world, pin};
use super::plane::{Pair, add, converges, cross, dot, less, times, turned};
use rapier_reactions::double::{ImpulseReader, JointHandle, JointReaction, PoseWindow, Probing, WorldRef};
use rapier2d_f64::prelude::*;

const SPEED: f64 = 6.0;
/// Speed of the block along the slide (m/s).
const SLIDE: f64 = 0.8;
/// Mass (kg), moment of inertia (kg m^2) and mass centre (m) of the block.
const BLOCK: (f64, f64, Pair) = (1.7, 0.03, [0.12, 0.07]);
/// Origin of the joint on the arm (m), and angle of the joint's x axis (rad).
const PLACE: (Pair, f64) = ([0.5, 0.1], 0.7);

/// The joint between arm and block.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Link {
    Fixed,
    /// A slide whose motor holds the block.
    Held,
    /// A slide whose motor moves the block.
    Moved,
}

impl Link {
    /// Speed along the slide (m/s); `None` without a slide.
    fn slide(self) -> Option<f64> {
        match self {
            Link::Fixed => None,
            Link::Held => Some(0.0),
            Link::Moved => Some(SLIDE),
        }
    }
}

/// A world with arm and block, and the handle of the joint between them.
fn world(link: Link, step: f64) -> (PhysicsWorld, ImpulseJointHandle) {
    let mut world = empty_world(step, 1024);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let arm = body(&mut world, (0.0, 2.5, 0.2, [0.3, 0.0]), [0.0; 2], 0.0);
    let block = body(&mut world, (0.0, BLOCK.0, BLOCK.1, BLOCK.2), PLACE.0, PLACE.1);
    let turn = driven(pin([0.0; 2], [0.0; 2]), JointAxis::AngX, (SPEED * step).tan() / step);
    world.impulse_joints.insert(ground, arm, turn, true);
    let locked = match link {
        Link::Fixed => JointAxesMask::LOCKED_FIXED_AXES,
        Link::Held | Link::Moved => JointAxesMask::LOCKED_PRISMATIC_AXES,
    };
    let joint = GenericJointBuilder::new(locked).contacts_enabled(false);
    let mut joint = joint.softness(SpringCoefficients::new(1e12, 1.0)).build();
    joint.set_local_frame1(Pose::from_parts(Vector::new(PLACE.0[0], PLACE.0[1]), Rotation::new(PLACE.1)));
    if let Some(speed) = link.slide() {
        joint = driven(joint, JointAxis::LinX, speed);
    }
    let handle = world.impulse_joints.insert(arm, block, joint, true);
    (world, handle)
}

/// Force on the block, moment about the origin of its frame, and thrust along the slide, at a time (s).
fn exact(link: Link, time: f64) -> (Pair, f64, f64) {
    let travel = link.slide().unwrap_or(0.0);
    let angle = SPEED * time;
    let along = turned([1.0, 0.0], angle + PLACE.1);
    let origin = add(turned(PLACE.0, angle), times(along, travel * time));
    let arm = turned(BLOCK.2, angle + PLACE.1);
    let centre = add(origin, arm);
    // Centripetal and Coriolis acceleration; the relative speed is constant.
    let coriolis = times([-along[1], along[0]], 2.0 * SPEED * travel);
    let acceleration = less(coriolis, times(centre, SPEED * SPEED));
    let force = times(less(acceleration, GRAVITY), BLOCK.0);
    let thrust = if link.slide().is_some() { dot(force, along) } else { 0.0 };
    (force, cross(arm, force), thrust)
}

/// For each route, the largest error of force, moment and thrust, relative to the sum of weight and centrifugal force.
fn errors(link: Link, steps: usize) -> [f64; 3] {
    let (step, time) = (0.4 / steps as f64, 0.4);
    let (mut world, handle) = world(link, step);
    let (mut reader, mut window, mut impulses) = (ImpulseReader::default(), PoseWindow::default(), Vec::new());
    for _ in 0..=steps {
        reader.before_step(&WorldRef::from(&world)).unwrap();
        world.step();
        impulses = reader.after_step(&WorldRef::from(&world)).unwrap();
        window.push(&WorldRef::from(&world)).unwrap();
    }
    let joint = JointHandle::Impulse(handle);
    let (force, moment, thrust) = exact(link, time);
    let error = |reactions: &[JointReaction]| {
        let own = reactions.iter().find(|own| own.joint == joint).unwrap();
        let scale = BLOCK.0 * (9.81 + SPEED * SPEED * 0.5);
        let parts = [
            less(own.force, force)[0],
            less(own.force, force)[1],
            (own.moment - moment) / 0.1,
            own.efforts[0] - thrust,
        ];
        parts.iter().map(|part| part.abs() / scale).fold(0.0, |most, part| if part > most { part } else { most })
    };
    [
        error(&impulses),
        error(&window.by_differences().unwrap().reactions),
        error(&window.by_probe(&Probing::default()).unwrap()),
    ]
}

/// In a slide between separate bodies, the motor acts along the axis that the slide has at the start of the step.
/// The motor corrects no drift. Rapier's motion therefore has an error of first order.
#[test]
fn joints_between_separate_bodies_have_the_orders_of_their_routes() {
    for (link, orders, bound) in [
        (Link::Fixed, [1.0, 2.0, 2.0], 2e-4),
        (Link::Held, [1.0, 1.0, 1.0], 1e-2),
        (Link::Moved, [1.0, 1.0, 1.0], 1e-2),
    ] {
        let [coarse, middle, fine] = [100, 200, 400].map(|steps| errors(link, steps));
        for (route, stated) in orders.into_iter().enumerate() {
            let own = [coarse, middle, fine].map(|errors| errors[route]);
            assert!(converges(own, stated, 1e-8), "{link:?}, route {route}: {own:?}");
        }
        assert!(fine[0] < 2e-2 && fine[1] < bound && fine[2] < bound, "{link:?}: {fine:?}");
    }
}

/// In every step, the impulse of the only joint of the block explains the change of its momentum and angular momentum.
/// The agreement is to rounding error, which shows that the crate correctly undoes the orthogonalisation of Rapier's
/// rows.
#[test]
fn impulses_explain_the_momentum_of_a_body() {
    for link in [Link::Fixed, Link::Held, Link::Moved] {
        let step = 1e-3;
        let (mut world, handle) = world(link, step);
        let block = world.impulse_joints.get(handle).unwrap().body2();
        let (mut reader, mut corrected) = (ImpulseReader::default(), 0.0);
        for number in 0..40 {
            reader.before_step(&WorldRef::from(&world)).unwrap();
            let own = &world.bodies[block];
            let (speed, omega) = (own.linvel(), own.angvel());
            let centre: Pair = (own.position() * Vector::new(BLOCK.2[0], BLOCK.2[1])).into();
            world.step();
            let reactions = reader.after_step(&WorldRef::from(&world)).unwrap();
            let read = reactions.iter().find(|own| own.joint == JointHandle::Impulse(handle)).unwrap();
            let own = &world.bodies[block];
            let acceleration: Pair = ((own.linvel() - speed) / step).into();
            let force = times(less(acceleration, GRAVITY), BLOCK.0);
            let moment = BLOCK.1 * (own.angvel() - omega) / step - cross(less(read.point, centre), read.force);
            let raw = world.impulse_joints.get(handle).unwrap().impulses[2] / -step;
            corrected = if (raw - moment).abs() > corrected { (raw - moment).abs() } else { corrected };
            let scale = if number == 0 { 1e4 } else { 100.0 };
            let errors = [less(read.force, force)[0], less(read.force, force)[1], read.moment - moment];
            assert!(errors.iter().all(|error| error.abs() < 1e-9 * scale), "{link:?}, step {number}: {errors:?}");
        }
        assert!(corrected > 1.0, "{link:?}: the raw numbers are not a moment, {corrected}");
    }
}

/// A block on a kinematic body that turns at constant speed. No force moves the kinematic body, so this body has no
/// equation.
#[test]
fn a_kinematic_body_carries_a_block() {
    let errors = |steps: usize| {
        let step = 0.4 / steps as f64;
        let mut world = empty_world(step, 64);
        let disc = world.bodies.insert(RigidBodyBuilder::kinematic_velocity_based().angvel(SPEED));
        let block = body(&mut world, (0.0, BLOCK.0, BLOCK.1, BLOCK.2), PLACE.0, PLACE.1);
        let joint = GenericJointBuilder::new(JointAxesMask::LOCKED_FIXED_AXES).contacts_enabled(false);
        let mut joint = joint.softness(SpringCoefficients::new(1e12, 1.0)).build();
        joint.set_local_frame1(Pose::from_parts(Vector::new(PLACE.0[0], PLACE.0[1]), Rotation::new(PLACE.1)));
        world.impulse_joints.insert(disc, block, joint, true);
        let (mut reader, mut window, mut impulses) = (ImpulseReader::default(), PoseWindow::default(), Vec::new());
        for _ in 0..=steps {
            reader.before_step(&WorldRef::from(&world)).unwrap();
            world.step();
            impulses = reader.after_step(&WorldRef::from(&world)).unwrap();
            window.push(&WorldRef::from(&world)).unwrap();
        }
        let (force, moment, _) = exact(Link::Fixed, 0.4);
        let (differences, probe) =
            (window.by_differences().unwrap().reactions, window.by_probe(&Probing::default()).unwrap());
        [impulses[0], differences[0], probe[0]].map(|own| {
            let apart = less(own.force, force);
            (apart[0].hypot(apart[1]) + (own.moment - moment).abs()) / (BLOCK.0 * 9.81)
        })
    };
    let [coarse, middle, fine] = [100, 200, 400].map(errors);
    for (route, stated) in [1.0, 2.0, 2.0].into_iter().enumerate() {
        let own = [coarse, middle, fine].map(|errors| errors[route]);
        assert!(converges(own, stated, 1e-7), "route {route}: {own:?}");
    }
    assert!(fine[0] < 5e-2 && fine[1] < 1e-3, "{fine:?}");
}
