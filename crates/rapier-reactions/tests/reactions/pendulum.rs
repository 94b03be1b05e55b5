//! A pendulum, whose pin force is known in closed form.
//!
//! The pendulum has the angle phi from the vertical, its mass centre at the distance l from the pin, and the moment of
//! inertia J about the mass centre. The force of the pin on the pendulum is m g cos phi + m l omega^2 towards the pin.
//! Across the rod, this force is m g sin phi + m l alpha in the sense of growing phi.
//! In a free motion, alpha = -m g l sin phi / (J + m l^2). At constant speed, alpha = 0.
//! A motor that keeps the speed constant exerts the moment m g l sin phi.

use super::four_bar::{body, driven, empty_world, pin, set_up};
use super::plane::{Pair, converges};
use rapier_reactions::double::{ImpulseReader, JointReaction, PoseWindow, Probing, WorldRef};
use rapier2d_f64::prelude::*;

const MASS: f64 = 2.0;
const INERTIA: f64 = 0.05;
const LENGTH: f64 = 0.4;
const G: f64 = 9.81;
const SPEED: f64 = 7.0;
/// Angle at the start of the free motion (rad), at rest.
const START: f64 = 1.2;

/// Force of the pin on a pendulum (N, world axes).
fn pin_force(phi: f64, omega: f64, alpha: f64) -> Pair {
    let (sin, cos) = phi.sin_cos();
    let towards_pin = MASS * G * cos + MASS * LENGTH * omega * omega;
    let along_motion = MASS * LENGTH * alpha + MASS * G * sin;
    [-sin * towards_pin + cos * along_motion, cos * towards_pin + sin * along_motion]
}

/// A world with a pendulum, and the pendulum's body.
struct Pendulum {
    world: PhysicsWorld,
    body: RigidBodyHandle,
}

/// Construction of the pendulum.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Build {
    Driven,
    Free,
    FreeMultibody,
    /// A multibody with the damping that Rapier gives to every joint.
    Damped,
}

impl Pendulum {
    fn new(build: Build, step: f64) -> Pendulum {
        let mut world = empty_world(step, 1024);
        let ground = world.bodies.insert(RigidBodyBuilder::fixed());
        let phi = if build == Build::Driven { 0.0 } else { START };
        let body = body(&mut world, (0.0, MASS, INERTIA, [0.0, -LENGTH]), [0.0; 2], phi);
        let joint = pin([0.0; 2], [0.0; 2]);
        match build {
            Build::Driven => {
                let joint = driven(joint, JointAxis::AngX, (SPEED * step).tan() / step);
                world.impulse_joints.insert(ground, body, joint, true);
            }
            Build::Free => {
                world.impulse_joints.insert(ground, body, joint, true);
            }
            Build::FreeMultibody | Build::Damped => {
                let handle = world.multibody_joints.insert(ground, body, joint, true).unwrap();
                set_up(&mut world, handle, &[phi]);
                if build == Build::Damped {
                    let (multibody, _) = world.multibody_joints.get_mut(handle).unwrap();
                    multibody.damping_mut().fill(0.1);
                }
            }
        }
        Pendulum { world, body }
    }

    fn angle(&self) -> f64 {
        self.world.bodies[self.body].rotation().angle()
    }
}

/// The three readings after `steps` steps, the angle of the pendulum at their instant (rad), and the residual of the
/// differences.
struct Readings {
    impulses: Vec<JointReaction>,
    differences: JointReaction,
    probe: JointReaction,
    angle: f64,
    residual: f64,
}

fn readings(build: Build, step: f64, steps: usize, gravity: f64) -> Readings {
    let mut pendulum = Pendulum::new(build, step);
    let (mut reader, mut window, mut angle) = (ImpulseReader::default(), PoseWindow::default(), f64::NAN);
    let mut impulses = Vec::new();
    for _ in 0..=steps {
        angle = pendulum.angle();
        reader.before_step(&WorldRef::from(&pendulum.world)).unwrap();
        pendulum.world.step();
        let world = WorldRef { gravity: Vector::new(0.0, gravity), ..WorldRef::from(&pendulum.world) };
        impulses = reader.after_step(&world).unwrap();
        window.push(&world).unwrap();
    }
    let balanced = window.by_differences().unwrap();
    let probe = window.by_probe(&Probing::default()).unwrap()[0];
    Readings { impulses, differences: balanced.reactions[0], probe, angle, residual: balanced.residual }
}

fn distance(a: Pair, b: Pair) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[test]
fn a_driven_pendulum_has_the_force_of_its_closed_form() {
    for steps in [100, 200, 400] {
        let step = 0.3 / f64::from(steps as u32);
        let read = readings(Build::Driven, step, steps, -G);
        let phi = SPEED * 0.3;
        let (force, torque) = (pin_force(phi, SPEED, 0.0), MASS * G * LENGTH * phi.sin());
        let whole = MASS * (G + LENGTH * SPEED * SPEED);
        let turn = SPEED * step;
        for (name, own, bound) in [
            ("impulses", &read.impulses[0], 2.0 * turn),
            ("differences", &read.differences, 0.5 * turn * turn),
            ("probe", &read.probe, 0.5 * turn * turn),
        ] {
            let error = distance(own.force, force) / whole;
            assert!(error < bound, "{name}, {steps} steps: force {error:.1e}");
            let error = (own.moment - torque).abs() / (MASS * G * LENGTH);
            assert!(error < bound, "{name}, {steps} steps: moment {error:.1e}");
            assert_eq!(own.efforts[2], own.moment, "the moment is that of the motor");
        }
    }
}

/// Pin force of a free pendulum at the engine's angle. The speed follows from the conservation of energy.
fn free_force(phi: f64) -> Pair {
    let about_pin = INERTIA + MASS * LENGTH * LENGTH;
    let omega = (2.0 * MASS * G * LENGTH * (phi.cos() - START.cos()) / about_pin).sqrt();
    pin_force(phi, omega, -MASS * G * LENGTH * phi.sin() / about_pin)
}

/// The energy of a separate body drifts in proportion to the step, so the errors of both routes have order 1.
/// Rapier moves a multibody with a single joint by the leapfrog method, whose energy has an error of order 2.
#[test]
fn a_free_pendulum_converges_to_its_closed_form() {
    for (build, stated) in [(Build::Free, 1.0), (Build::FreeMultibody, 2.0)] {
        let errors = |steps: usize| {
            let read = readings(build, 0.3 / steps as f64, steps, -G);
            let exact = free_force(read.angle);
            [&read.differences, &read.probe].map(|own| distance(own.force, exact) / (MASS * G))
        };
        let [coarse, middle, fine] = [300, 600, 1200].map(errors);
        for route in 0..2 {
            let own = [coarse, middle, fine].map(|errors| errors[route]);
            assert!(own[2] < 2e-3 && converges(own, stated, 1e-6), "{build:?}, route {route}: {own:?}");
        }
    }
}

/// The equation of the free coordinate contains no unknown force, so a missing load remains as its residual.
#[test]
fn the_residual_shows_a_missing_load() {
    let seen = readings(Build::Free, 1e-3, 300, -G).residual;
    let unseen = readings(Build::Free, 1e-3, 300, 0.0).residual;
    assert!(seen < 2e-3 && unseen > 0.1, "{seen:.1e}, without gravity {unseen:.1e}");
}

/// Rapier damps every joint of a multibody by 0.1 N m s/rad unless told otherwise.
#[test]
fn the_damping_of_a_multibody_is_a_moment_of_its_joint() {
    let step = 1e-4;
    let read = readings(Build::Damped, step, 3000, -G);
    let before = readings(Build::Damped, step, 2999, -G).angle;
    let omega = (read.angle - before) / step;
    assert!(omega.abs() > 1.0, "{omega}");
    for own in [read.differences, read.probe] {
        assert!((own.moment / (-0.1 * omega) - 1.0).abs() < 2e-3, "{} {}", own.moment, -0.1 * omega);
        assert_eq!(own.efforts, [0.0, 0.0, own.moment]);
    }
    assert!(read.impulses.is_empty(), "a joint of a multibody has no impulses");
}

/// A step of two substeps equals two steps of half the size. The frames between the poses are interpolated.
#[test]
fn substeps_are_read_like_steps() {
    let step = 2e-3;
    let last = |step: f64, substeps: usize, steps: usize| {
        let mut pendulum = Pendulum::new(Build::Driven, step / substeps as f64);
        let parameters = &mut pendulum.world.integration_parameters;
        (parameters.dt, parameters.num_solver_iterations) = (step, substeps);
        let (mut reader, mut read) = (ImpulseReader::default(), Vec::new());
        for _ in 0..steps {
            reader.before_step(&WorldRef::from(&pendulum.world)).unwrap();
            pendulum.world.step();
            read = reader.after_step(&WorldRef::from(&pendulum.world)).unwrap();
        }
        read[0]
    };
    let (whole, halves) = (last(step, 2, 100), last(0.5 * step, 1, 200));
    let turn = SPEED * step;
    let apart = distance(whole.force, halves.force) / halves.force[0].hypot(halves.force[1]);
    assert!(apart < turn * turn && distance(whole.point, halves.point) < 1e-6, "{whole:?} {halves:?}");
    assert!((whole.moment / halves.moment - 1.0).abs() < 1e-6, "{whole:?} {halves:?}");
}
