//! Joints and bodies as Rapier defines them.

use super::parry::mass_properties::MassProperties;
use super::rapier::prelude::{
    GenericJoint, GenericJointBuilder, IntegrationParameters, JointAxesMask, JointAxis, MotorModel, RigidBodyBuilder,
    SpringCoefficients, Vector,
};
use super::{Real, real};
use linkage::drive::Drive;
use linkage::engine::Settings;
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Joint, JointKind, Link, LinkId};

/// Frequency of the joints' softness (Hz). The frequency is so high that the joints are rigid up to rounding.
/// Rapier's default, 1e6 Hz, adds 6 % to the closure gap at a step of 1e-5 s.
const JOINT_FREQUENCY: f64 = 1e12;

/// Damping of a velocity motor (N m s/rad). The damping is so high that the motor keeps its prescribed speed up to
/// rounding.
pub(super) const RIGID_MOTOR: f64 = 1e30;

/// Rapier's vector.
pub(super) fn vector(of: Vec2) -> Vector {
    Vector::new(real(of.x), real(of.y))
}

/// A joint that locks the given axes.
fn locking(axes: JointAxesMask) -> GenericJointBuilder {
    GenericJointBuilder::new(axes).contacts_enabled(false).softness(SpringCoefficients::new(real(JOINT_FREQUENCY), 1.0))
}

/// A joint without locked axes.
pub(super) fn free() -> GenericJointBuilder {
    locking(JointAxesMask::empty())
}

/// A joint that locks only the translation along its x axis.
pub(super) fn along_a_line() -> GenericJoint {
    locking(JointAxesMask::LIN_X).build()
}

/// The joint by which a link floats in a multibody: its coordinates are the position of its mass centre and its angle.
pub(super) fn floating(link: &Link) -> GenericJoint {
    free().local_anchor2(vector(link.mass_centre)).build()
}

/// A Rapier joint that locks the given axes. Its anchors are the points of the mechanism's `joint` on `links`.
fn holding(axes: JointAxesMask, joint: &Joint, links: [LinkId; 2]) -> GenericJointBuilder {
    let [first, second] = links.map(|link| vector(joint.on(link).expect("the joint is on the link")));
    locking(axes).local_anchor1(first).local_anchor2(second)
}

/// The joint between `links`, which Rapier calls first and second.
/// For a prismatic joint, the x axes of both joint frames lie along the joint's axis.
pub(super) fn between(joint: &Joint, links: [LinkId; 2]) -> GenericJoint {
    match joint.kind {
        JointKind::Revolute => holding(JointAxesMask::LOCKED_REVOLUTE_AXES, joint, links).build(),
        JointKind::Prismatic { .. } => {
            let [first, second] = links.map(|link| vector(joint.axis_on(link).expect("the joint is on the link")));
            holding(JointAxesMask::LOCKED_PRISMATIC_AXES, joint, links).local_axis1(first).local_axis2(second).build()
        }
    }
}

/// Index of the free coordinate of a joint made by [`between`].
/// The free coordinate of a prismatic joint is the first coordinate (along the axis). The free coordinate of a revolute
/// joint is the last coordinate (the angle).
pub(super) fn free_coordinate(joint: &Joint) -> usize {
    if joint.slides() { 0 } else { 2 }
}

/// The motor of a drive: its joint, its links, the coordinate that it moves, and the sign of the drive's input in this
/// coordinate.
/// The motor keeps its speed up to rounding errors.
pub(super) fn motor(drive: &Drive, joint: &Joint) -> (GenericJoint, [LinkId; 2], JointAxis, f64) {
    let ends = [joint.first.link, joint.second.link];
    let (builder, links, axis, sense) = match drive.input {
        // The motor of a crank stands on the ground.
        Input::Angle if joint.second.link == GROUND => (free(), [drive.link, GROUND], JointAxis::AngX, -1.0),
        Input::Angle => (free(), [GROUND, drive.link], JointAxis::AngX, 1.0),
        Input::Turn => (free(), ends, JointAxis::AngX, 1.0),
        Input::Slide => {
            let axes = ends.map(|link| vector(joint.axis_on(link).expect("the driven joint slides")));
            let builder = holding(JointAxesMask::empty(), joint, ends).local_axis1(axes[0]).local_axis2(axes[1]);
            (builder, ends, JointAxis::LinX, 1.0)
        }
    };
    let rigid = builder.motor_model(axis, MotorModel::ForceBased).motor_velocity(axis, 0.0, real(RIGID_MOTOR));
    (rigid.build(), links, axis, sense)
}

/// A revolute joint between `links` whose rows lie along and across the direction `axis` of the first link.
pub(super) fn steered(joint: &Joint, links: [LinkId; 2], axis: Vec2) -> GenericJoint {
    holding(JointAxesMask::LOCKED_REVOLUTE_AXES, joint, links).local_axis1(vector(axis)).build()
}

/// A moving body with the given mass (kg) and moment of inertia (kg m^2).
pub(super) fn body(link: &Link, [mass, inertia]: [f64; 2]) -> RigidBodyBuilder {
    RigidBodyBuilder::dynamic()
        .can_sleep(false)
        // Without this setting, Rapier limits separate bodies to an eighth of a turn per step.
        .allow_fast_rotation(true)
        .additional_mass_properties(MassProperties::new(vector(link.mass_centre), real(mass), real(inertia)))
}

/// Integration parameters of a run.
pub(super) fn parameters(settings: &Settings) -> IntegrationParameters {
    // Route and extrapolation are ignored: the route affects only the readings, and extrapolation combines several
    // runs.
    let &Settings { resolution, sweeps, substeps, route: _, extrapolated: _ } = settings;
    IntegrationParameters {
        dt: real(resolution),
        // Rapier's iterations are substeps: each iteration restarts the sweeps from zero.
        num_solver_iterations: substeps,
        num_internal_pgs_iterations: sweeps,
        num_internal_stabilization_iterations: sweeps,
        max_ccd_substeps: 0,
        normalized_max_linear_velocity: Real::MAX,
        normalized_max_corrective_velocity: Real::MAX,
        ..IntegrationParameters::default()
    }
}
