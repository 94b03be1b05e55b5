//! MJCF, the XML of MuJoCo: the spanning tree as nested bodies, the loops closed by equality constraints.
//!
//! Contents of the file:
//!
//! - The plane of motion is XOY. Every body's frame is the frame of its link, in the start pose.
//!   With the attribute `ref`, the joint coordinates of the model equal those of the mechanism.
//!   The coordinate of a hinge is the angle of the child minus that of its parent.
//!   The coordinate of a slide is the value of the prismatic joint's channel.
//! - A joint that closes a loop is a `connect` of two sites.
//!   The third row of a `connect`, along z, is zero in a planar mechanism: the row costs a little time and has no
//!   effect.
//! - A transmission is a fixed tendon of constant length; the length is a sum of joint coordinates times factors.
//!   The tendon's force acts on each hinge as a moment.
//!   Reactions of axles therefore lack the radial part of tooth forces and the tension of strands.
//! - A prescribed drive is a rotor ([`MjcfModel::rotor`]) on the driven joint. On a slide, a heavy mass takes the place
//!   of the rotor.
//!   The rotor's inertia is so large that its speed is practically constant, with any integrator and at any step: the
//!   speed changes by 1e-9 of its value per radian.
//!   A velocity actuator would need a very large gain to keep the speed as constant as the rotor does. With this gain,
//!   most simulations diverge, because `implicitfast` solves the constraints without the actuator's damping.
//!   A velocity actuator with a smaller gain does not keep the speed exactly.
//!   The interaction forces that sensors read do not include the rotor's inertia.
//!   The torque sensor of the hinge therefore reads the driving moment.
//! - A free link has no rotor except that of its motor.
//!   The motor is an actuator whose moment is a linear function of the speed.
//!   A motor with losses becomes two actuators: one drives, the other brakes.
//! - Moments, forces, torsional springs and torsional dampers are actuators.
//!   These actuators act on a hinge, on a site, or on a fixed tendon whose length is an angle or a difference of
//!   angles.
//!   Springs and dampers between points are spatial tendons.
//! - A moment that resists the rotation of a link is dry friction.
//!   The friction acts in the link's hinge if this is the only hinge between the ground and the link.
//!   If there are several hinges between the ground and the link, the friction acts in a fixed tendon whose length is
//!   the link's angle.
//!   Dry friction holds a link at rest, whereas [`Load::Resistance`](linkage::drive::Load::Resistance) is zero at rest.
//! - Constraints are as stiff as the time step permits.
//!   With `solref="1e-9 0.5"` MuJoCo raises the time constant to twice the step (`refsafe`).
//!   The raised time constant gives b = 1/h and k = 1/h^2, so a gap is closed in one step.
//!   The file is therefore valid for any step, and the error is of second order in the step.

mod effects;
mod forces;
mod limits;
mod model;
mod names;
mod write;

pub use model::MjcfModel;

use super::start::first_state;
use linkage::case::Case;
use linkage::error::Result;
use linkage::solver::Solver;

/// The case as MJCF, with the model name `name` and the time step `step` (s).
/// The model starts in the case's pose at t = 0, with the velocities that `solver` computes for this pose.
///
/// # Errors
/// [`ErrorKind::Input`](linkage::ErrorKind::Input) for a step that is not positive and finite.
/// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) for names that MuJoCo does not accept, and for loads,
/// drives and transmissions that MJCF cannot express.
/// The errors of the solver.
pub fn mjcf(case: &Case, solver: &dyn Solver, name: &str, step: f64) -> Result<String> {
    let start = first_state(case, solver)?;
    let model = MjcfModel::new(case, &start, name, step)?;
    Ok(write::document(&model, &forces::forces(&model)?))
}
