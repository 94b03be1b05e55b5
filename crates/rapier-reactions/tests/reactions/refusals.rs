//! Joints and bodies whose reactions cannot be read are refused, and the error names them.

use super::four_bar::{body, driven, empty_world, pin};
use rapier_reactions::ReactionError;
use rapier_reactions::double::{ImpulseReader, PoseWindow, Probing, WorldRef};
use rapier2d_f64::prelude::*;

/// A world with a bar, and with `joint` between the ground and the bar.
fn bar(joint: impl Into<GenericJoint>) -> PhysicsWorld {
    let mut world = empty_world(1e-3, 64);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let bar = body(&mut world, (0.0, 1.0, 0.1, [0.2, 0.0]), [0.0; 2], 0.0);
    world.impulse_joints.insert(ground, bar, joint.into(), true);
    world
}

/// A window with the poses after three steps.
fn window(world: &mut PhysicsWorld) -> Result<PoseWindow, ReactionError> {
    let mut window = PoseWindow::default();
    for _ in 0..3 {
        world.step();
        window.push(&WorldRef::from(&*world))?;
    }
    Ok(window)
}

#[test]
fn joints_of_other_kinds_are_refused_by_name() {
    let free = |locked: JointAxesMask| GenericJointBuilder::new(locked).build();
    let refused: [(GenericJoint, &str); 5] = [
        (RopeJointBuilder::new(0.5).build().into(), "impulse joint 0 has coupled axes"),
        (SpringJointBuilder::new(0.5, 10.0, 1.0).build().into(), "impulse joint 0 has coupled axes"),
        (RevoluteJointBuilder::new().limits([-1.0, 1.0]).build().into(), "impulse joint 0 has limits"),
        (free(JointAxesMask::LOCKED_PIN_SLOT_AXES), "impulse joint 0 has a pin in a slot"),
        (free(JointAxesMask::ANG_X), "impulse joint 0 has locked axes of no revolute"),
    ];
    for (joint, text) in refused {
        let mut world = bar(joint);
        let error = window(&mut world).unwrap_err();
        assert!(error.to_string().starts_with(text), "{error}");
        assert_eq!(ImpulseReader::default().before_step(&WorldRef::from(&world)).unwrap_err(), error);
    }
}

#[test]
fn coupled_coordinates_of_a_multibody_are_refused() {
    let mut world = empty_world(1e-3, 64);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let bars = [0.0, 0.4].map(|x| body(&mut world, (0.0, 1.0, 0.1, [0.2, 0.0]), [x, 0.0], 0.0));
    world.multibody_joints.insert(ground, bars[0], pin([0.0; 2], [0.0; 2]), true).unwrap();
    let last = world.multibody_joints.insert(bars[0], bars[1], pin([0.4, 0.0], [0.0; 2]), true).unwrap();
    window(&mut world).unwrap();
    let (multibody, _) = world.multibody_joints.get_mut(last).unwrap();
    let coupling =
        MultibodyDofCoupling { link1: 1, dof1: 0, axis1: 2, link2: 2, dof2: 0, axis2: 2, coeff: 2.0, offset: 0.0 };
    multibody.add_dof_coupling(coupling);
    let error = window(&mut world).unwrap_err().to_string();
    assert!(error.contains("multibody joint") && error.contains("coupled with"), "{error}");
}

#[test]
fn bodies_that_cannot_be_balanced_are_refused() {
    let mut world = bar(pin([0.0; 2], [0.0; 2]));
    let handle = world.bodies.iter().find(|(_, body)| body.is_dynamic()).unwrap().0;
    world.bodies[handle].lock_rotations(true, true);
    assert!(window(&mut world).unwrap_err().to_string().contains("locked translations"));
    let mut world = empty_world(1e-3, 64);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let light = world.bodies.insert(RigidBodyBuilder::dynamic());
    world.impulse_joints.insert(ground, light, pin([0.0; 2], [0.0; 2]), true);
    assert!(window(&mut world).unwrap_err().to_string().starts_with("rigid body 1 has no mass"));
}

/// Two pins connect a bar to the ground. The forces in the pins have four unknown components, but the bar has only
/// three equations.
#[test]
fn a_joint_too_many_is_named() {
    let mut world = bar(pin([0.0; 2], [0.0; 2]));
    let handles: Vec<RigidBodyHandle> = world.bodies.iter().map(|(handle, _)| handle).collect();
    world.impulse_joints.insert(handles[0], handles[1], pin([0.4, 0.0], [0.4, 0.0]), true);
    let error = window(&mut world).unwrap().by_differences().unwrap_err();
    let both = vec![String::from("impulse joint 0"), String::from("impulse joint 1")];
    assert_eq!(error, ReactionError::NotDetermined(both));
    assert!(error.to_string().contains("impulse joint 0, impulse joint 1; remove"), "{error}");
}

/// Three parallel rockers carry a table. The third rocker repeats the constraint of the other two, even if the loops
/// have small gaps.
#[test]
fn a_repeated_rocker_is_named() {
    let mut world = empty_world(2e-3, 256);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let table = body(&mut world, (0.0, 2.0, 0.2, [0.4, 0.0]), [0.0, 0.3], 0.0);
    for (number, x) in [0.0, 0.4, 0.8].into_iter().enumerate() {
        let rocker = body(&mut world, (0.0, 1.0, 0.01, [0.15, 0.0]), [x, 0.0], std::f64::consts::FRAC_PI_2);
        let foot = pin([x, 0.0], [0.0; 2]);
        let foot = if number == 0 { driven(foot, JointAxis::AngX, 3.0) } else { foot };
        world.impulse_joints.insert(ground, rocker, foot, true);
        world.impulse_joints.insert(rocker, table, pin([0.3, 0.0], [x, 0.0]), true);
    }
    for _ in 0..50 {
        world.step();
    }
    match window(&mut world).unwrap().by_differences() {
        Err(ReactionError::NotDetermined(names)) => assert_eq!(names.len(), 6, "{names:?}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn three_poses_are_needed_and_changes_are_noticed() {
    let mut world = bar(pin([0.0; 2], [0.0; 2]));
    let mut own = PoseWindow::default();
    assert_eq!(own.by_differences().unwrap_err(), ReactionError::TooFewPoses(0));
    world.step();
    own.push(&WorldRef::from(&world)).unwrap();
    assert_eq!(own.by_probe(&Probing::default()).unwrap_err(), ReactionError::TooFewPoses(1));
    let mut reader = ImpulseReader::default();
    assert_eq!(reader.after_step(&WorldRef::from(&world)).unwrap_err(), ReactionError::Changed);
    reader.before_step(&WorldRef::from(&world)).unwrap();
    let handles: Vec<RigidBodyHandle> = world.bodies.iter().map(|(handle, _)| handle).collect();
    world.impulse_joints.insert(handles[0], handles[1], pin([0.4, 0.0], [0.4, 0.0]), true);
    world.step();
    assert_eq!(reader.after_step(&WorldRef::from(&world)).unwrap_err(), ReactionError::Changed);
    own.push(&WorldRef::from(&world)).unwrap();
    assert_eq!(own.by_differences().unwrap_err(), ReactionError::TooFewPoses(1));
    world.integration_parameters.dt = 0.0;
    assert_eq!(own.push(&WorldRef::from(&world)).unwrap_err(), ReactionError::Step(0.0));
}

#[test]
fn a_sleeping_joint_has_no_impulse() {
    let mut world = bar(pin([0.0; 2], [0.0; 2]));
    let handle = world.bodies.iter().find(|(_, body)| body.is_dynamic()).unwrap().0;
    world.step();
    let mut reader = ImpulseReader::default();
    world.bodies[handle].sleep();
    reader.before_step(&WorldRef::from(&world)).unwrap();
    let error = reader.after_step(&WorldRef::from(&world)).unwrap_err().to_string();
    assert!(error.contains("sleep"), "{error}");
}

/// In a world of many joints, Rapier lays the rows of prismatic joints in another order.
#[test]
fn rows_in_an_unknown_order_are_refused() {
    let mut world = empty_world(1e-3, 16);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    for _ in 0..64 {
        let bar = body(&mut world, (0.0, 1.0, 0.1, [0.2, 0.0]), [0.0; 2], 0.0);
        world.impulse_joints.insert(ground, bar, PrismaticJointBuilder::new(Vector::X).build(), true);
    }
    let mut reader = ImpulseReader::default();
    reader.before_step(&WorldRef::from(&world)).unwrap();
    world.step();
    let error = reader.after_step(&WorldRef::from(&world)).unwrap_err().to_string();
    assert!(error.contains("unknown order"), "{error}");
    let reactions = window(&mut world).unwrap().by_differences().unwrap().reactions;
    for own in reactions {
        assert!((own.force[1] - 9.81).abs() < 1e-6, "{own:?}");
    }
}

#[test]
fn a_diverged_world_is_an_error() {
    let mut world = bar(pin([0.0; 2], [0.0; 2]));
    world.step();
    let handle = world.bodies.iter().find(|(_, body)| body.is_dynamic()).unwrap().0;
    world.bodies[handle].set_translation(Vector::new(f64::NAN, 0.0), true);
    assert_eq!(PoseWindow::default().push(&WorldRef::from(&world)).unwrap_err(), ReactionError::NotFinite);
}

#[test]
fn sweeps_that_do_not_converge_are_an_error() {
    let mut world = empty_world(1e-3, 1024);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let mut last = ground;
    for number in 0..6 {
        // Each bar is much heavier than the one above it.
        let mass = 10f64.powi(number);
        let bar = body(&mut world, (0.0, mass, 0.01 * mass, [0.15, 0.0]), [0.3 * f64::from(number), 0.0], 0.0);
        let anchor = if number == 0 { 0.0 } else { 0.3 };
        world.impulse_joints.insert(last, bar, pin([anchor, 0.0], [0.0; 2]), true);
        last = bar;
    }
    let probing = Probing { most_sweeps: 16, sweeps: 4, ..Probing::default() };
    match window(&mut world).unwrap().by_probe(&probing) {
        Err(ReactionError::NotConverged(16, change)) => assert!(change > 1e-3, "{change}"),
        other => panic!("{other:?}"),
    }
}
