//! The engine's set-up, tested on a free compound pendulum with a period in closed form.
//! A free motion shows the multibody's order of convergence, which is one, and the multibody's default damping.

use crate::common::assert_within;
use linkage::math::KeepNan;
use rapier2d_f64::parry::mass_properties::MassProperties;
use rapier2d_f64::prelude::*;

const MASS: f64 = 2.0;
const ARM: f64 = 0.3;
const INERTIA: f64 = 0.05;
const GRAVITY: f64 = 9.81;
/// Amplitude (rad); the pendulum is released at this angle.
const AMPLITUDE: f64 = 1.0;

/// Period from the complete elliptic integral: 2 pi / (w agm(1, cos(amplitude / 2))) with w^2 = m g s / (J + m s^2).
fn exact_period() -> f64 {
    let (mut a, mut b) = (1.0f64, (AMPLITUDE / 2.0).cos());
    for _ in 0..8 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    let omega = (MASS * GRAVITY * ARM / (INERTIA + MASS * ARM * ARM)).sqrt();
    std::f64::consts::TAU / (omega * a)
}

/// The pendulum in a Rapier world that contains nothing else.
struct Pendulum {
    world: PhysicsWorld,
    handle: MultibodyJointHandle,
}

/// A pendulum held at its amplitude, built and started as in the crate `rapier-twin`.
/// If `damped`, the pendulum keeps Rapier's default damping.
fn pendulum(dt: f64, damped: bool) -> Pendulum {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, -GRAVITY);
    world.integration_parameters = IntegrationParameters {
        dt,
        num_solver_iterations: 1,
        num_internal_pgs_iterations: 64,
        num_internal_stabilization_iterations: 64,
        max_ccd_substeps: 0,
        normalized_max_linear_velocity: f64::MAX,
        normalized_max_corrective_velocity: f64::MAX,
        ..IntegrationParameters::default()
    };
    let ground = world.bodies.insert(RigidBodyBuilder::fixed());
    let properties = MassProperties::new(Vector::new(0.0, -ARM), MASS, INERTIA);
    let body =
        RigidBodyBuilder::dynamic().can_sleep(false).allow_fast_rotation(true).additional_mass_properties(properties);
    let bob = world.bodies.insert(body);
    let pin = RevoluteJointBuilder::new().contacts_enabled(false).softness(SpringCoefficients::new(1e12, 1.0));
    let handle = world.multibody_joints.insert(ground, bob, pin, true).unwrap();
    let PhysicsWorld { multibody_joints, bodies, .. } = &mut world;
    let root = multibody_joints.rigid_body_link(ground).unwrap().multibody;
    let multibody = multibody_joints.get_multibody_mut(root).unwrap();
    multibody.forward_kinematics(bodies, true);
    if !damped {
        multibody.damping_mut().fill(0.0);
    }
    let mut start = vec![0.0; multibody.ndofs()];
    start[multibody.ndofs() - 1] = AMPLITUDE;
    multibody.apply_displacements(&start);
    multibody.forward_kinematics(bodies, false);
    multibody.update_rigid_bodies(bodies, true);

    Pendulum { world, handle }
}

impl Pendulum {
    fn step(&mut self) -> f64 {
        self.world.step();
        let (multibody, _) = self.world.multibody_joints.get(self.handle).unwrap();
        multibody.links().last().unwrap().joint().coords()[2]
    }

    /// Mean of `turns` periods, from passages through the lowest point from left to right.
    /// Linear interpolation between steps is accurate enough, because the angle has no curvature at the lowest point.
    fn period(&mut self, dt: f64, turns: usize) -> f64 {
        let (mut passages, mut last, mut steps) = (Vec::new(), AMPLITUDE, 0.0);
        while passages.len() <= turns {
            let angle = self.step();
            steps += 1.0;
            if last < 0.0 && angle >= 0.0 {
                passages.push(dt * (steps - angle / (angle - last)));
            }
            last = angle;
            assert_within!(steps * dt, 100.0, "the pendulum stands still");
        }
        (passages[turns] - passages[0]) / turns as f64
    }
}

/// Story 30.
/// The integrator is semi-implicit Euler, which is conjugate to a method of second order.
/// The period therefore converges with second order, although a single angle converges with first order (story 31).
#[test]
fn val_elliptic_integral_period_of_a_compound_pendulum() {
    let exact = exact_period();
    let errors = [4e-3, 2e-3, 1e-3, 5e-4].map(|dt| pendulum(dt, false).period(dt, 5) / exact - 1.0);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert_within!((order - 2.0).abs(), 0.01, "order {order}: {errors:?}");
        let extrapolated = (4.0 * pair[1] - pair[0]) / 3.0;
        assert_within!(extrapolated.abs(), 1e-2 * pair[1].abs(), "{extrapolated:e} of {errors:?}");
    }
    assert_within!(errors[3].abs(), 2e-7, "{errors:?}");
}

/// Story 31.
/// Symptom: free motion is far less accurate than driven motion with the same step.
/// Cause: free motion is of first order.
/// A quarter of a period after the start, the pendulum is at its lowest point, so the exact angle is zero.
/// With the angles x at step h and y at step h / 2, the extrapolation 2y - x is much more accurate than y.
#[test]
fn regress_31_free_motion_is_of_first_order() {
    let quarter = exact_period() / 4.0;
    let errors = [250, 500, 1000, 2000].map(|steps| {
        let mut swinging = pendulum(quarter / f64::from(steps), false);
        (0..steps).map(|_| swinging.step()).last().unwrap()
    });
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert_within!((order - 1.0).abs(), 0.01, "order {order}: {errors:?}");
        let extrapolated = 2.0 * pair[1] - pair[0];
        assert_within!(extrapolated.abs(), 1e-2 * pair[1].abs(), "{extrapolated:e} of {errors:?}");
    }
}

/// Story 32.
/// Symptom: a free mechanism comes to rest.
/// Cause: by default, every pin has a damping of 0.1 N m s/rad.
/// With this damping, the amplitude of small swings decays as exp(-c t / 2 J).
/// Without damping, the amplitude is constant except for the first-order error of the integrator.
#[test]
fn regress_32_the_default_damping_must_be_removed() {
    let dt = 1e-3;
    let [free, damped] = [false, true].map(|damped| {
        let mut swinging = pendulum(dt, damped);
        let angles: Vec<f64> = (0..8000).map(|_| swinging.step().abs()).collect();
        angles[6000..].iter().fold(0.0, |max: f64, angle| max.larger(*angle))
    });
    assert_within!((free / AMPLITUDE - 1.0).abs(), 1e-4, "{free}");
    // The tested interval is from 6 to 8 s. At 6 s, the amplitude has fallen to exp(-0.1 * 6 / (2 * 0.23)) = 0.27 of
    // its start value.
    assert_within!(damped, 0.3 * AMPLITUDE, "{damped}");
}
