//! Reactions in single precision, compared with the closed form of a driven pendulum.

use rapier_reactions::single::{ImpulseReader, PoseWindow, Probing, WorldRef};
use rapier2d::parry::mass_properties::MassProperties;
use rapier2d::prelude::*;

const MASS: f32 = 2.0;
const LENGTH: f32 = 0.4;
const SPEED: f32 = 7.0;

/// In f32, second differences have a rounding error of a few epsilon / (omega h)^2, which is 6e-4 at this step.
/// 128 sweeps of a probe, whose tiny step turns the pendulum by 5e-3 rad, have a rounding error of about
/// 0.9 * 128 epsilon / 5e-3, which is 3e-3.
#[test]
fn a_driven_pendulum_in_single_precision() {
    let (step, steps) = (2e-3, 150);
    let mut world = PhysicsWorld::new();
    let parameters = &mut world.integration_parameters;
    (parameters.dt, parameters.num_solver_iterations) = (step, 1);
    (parameters.num_internal_pgs_iterations, parameters.num_internal_stabilization_iterations) = (256, 256);
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let rod = MassProperties::new(Vector::new(0.0, -LENGTH), MASS, 0.05);
    let body = RigidBodyBuilder::dynamic().can_sleep(false).allow_fast_rotation(true).additional_mass_properties(rod);
    let body = world.bodies.insert(body);
    let joint = RevoluteJointBuilder::new().motor_model(MotorModel::ForceBased);
    let joint = joint.motor_velocity((SPEED * step).tan() / step, 1e30).softness(SpringCoefficients::new(1e12, 1.0));
    world.impulse_joints.insert(ground, body, joint.build(), true);
    let (mut reader, mut window, mut impulses) = (ImpulseReader::default(), PoseWindow::default(), Vec::new());
    for _ in 0..=steps {
        reader.before_step(&WorldRef::from(&world)).unwrap();
        world.step();
        impulses = reader.after_step(&WorldRef::from(&world)).unwrap();
        window.push(&WorldRef::from(&world)).unwrap();
    }
    let (mass, length, speed) = (f64::from(MASS), f64::from(LENGTH), f64::from(SPEED));
    let (sin, cos) = (speed * f64::from(step) * f64::from(steps)).sin_cos();
    // Towards the pin m g cos phi + m l omega^2, across the rod m g sin phi.
    let radial = mass * 9.81 * cos + mass * length * speed * speed;
    let force = [-sin * radial + cos * mass * 9.81 * sin, cos * radial + sin * mass * 9.81 * sin];
    let (differences, probe) =
        (window.by_differences().unwrap().reactions, window.by_probe(&Probing::default()).unwrap());
    for (name, own, bound) in
        [("impulses", &impulses, 3e-2), ("differences", &differences, 1e-2), ("probe", &probe, 1e-2)]
    {
        let error = (own[0].force[0] - force[0]).hypot(own[0].force[1] - force[1]) / radial;
        assert!(error < bound, "{name}: {error:.1e}");
        let error = (own[0].moment / (mass * 9.81 * length * sin) - 1.0).abs();
        assert!(error < 3.0 * bound, "{name}: moment {error:.1e}");
    }
}
