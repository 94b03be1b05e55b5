//! Reactions from the impulses of the running world.

use super::rapier::prelude::{ImpulseJoint, IntegrationParameters, JointAxesMask, JointAxis, RigidBodyHandle};
use super::snapshot::{JointHandle, JointReaction, Snapshot, WorldRef};
use super::wide;
use crate::error::ReactionError;
use crate::model::Stance;
use crate::plane::turned;
use crate::rows::{JointRows, JointType, ROTATION};
use crate::sentences;

/// Rapier gives joints one colour if no two of them move the same body.
/// If a colour has at least this many joints, Rapier 0.36.1 solves them in groups. In a group, the rows of a joint have
/// another order (`min_color_joints` and `JointConstraint<SimdReal, SIMD_WIDTH>::update`).
/// For a prismatic or fixed joint between separate bodies, the order of the rows is then unknown.
const GROUPED: usize = 64;

/// Reads the reactions of all impulse joints from the impulses of each step.
///
/// Call [`ImpulseReader::before_step`], step the world, call [`ImpulseReader::after_step`].
/// The reactions belong to the start of the last substep: with one substep, to the poses before the step.
/// The error of the reactions is of first order in the step. After [`extrapolated`](super::extrapolated), it is of
/// second order.
/// The first step after a start contains a transient and should be left out.
/// Joints of a multibody report no impulses, so the result does not contain them.
#[derive(Clone, Debug, Default)]
pub struct ImpulseReader {
    before: Option<Snapshot>,
}

impl ImpulseReader {
    /// Stores the poses at the start of a step.
    ///
    /// # Errors
    /// [`ReactionError::NotFinite`], and [`ReactionError::Unsupported`] for a joint or body of an unsupported kind.
    pub fn before_step(&mut self, world: &WorldRef) -> Result<(), ReactionError> {
        self.before = Some(Snapshot::of(world)?);
        Ok(())
    }

    /// The reactions of all enabled impulse joints in the step just made, in the order of the joint set.
    ///
    /// # Errors
    /// The errors of [`ImpulseReader::before_step`].
    /// [`ReactionError::Changed`] if bodies or joints have changed since the call of `before_step`.
    /// [`ReactionError::Unsupported`] if a joint sleeps, or if its rows have an unknown order (prismatic and fixed
    /// joints between separate bodies in worlds of 64 joints and more).
    pub fn after_step(&mut self, world: &WorldRef) -> Result<Vec<JointReaction>, ReactionError> {
        let after = Snapshot::with_masses(world)?;
        let before = self.before.take().filter(|before| before.has_joints_of(&after));
        let before = before.ok_or(ReactionError::Changed)?;
        let share = 1.0 - 1.0 / world.parameters.num_solver_iterations as f64;
        let at = |of: &Snapshot| after.model.stances(&of.placements).into_iter();
        let stances: Vec<Stance> = at(&before).zip(at(&after)).map(|(start, end)| start.towards(end, share)).collect();
        from_impulses(world, &after, &stances)
    }
}

/// The reactions of the impulse joints of a snapshot. `stances` has the position and direction of each joint's
/// constraint rows in the step.
pub(super) fn from_impulses(
    world: &WorldRef,
    snapshot: &Snapshot,
    stances: &[Stance],
) -> Result<Vec<JointReaction>, ReactionError> {
    let mut reactions = Vec::new();
    for (index, (&handle, stance)) in snapshot.joints.iter().zip(stances).enumerate() {
        let JointHandle::Impulse(own) = handle else { continue };
        let joint = world.impulse_joints.get(own).expect("the snapshot has joints of this world");
        let refused = |property| Err(ReactionError::Unsupported(handle.name(), property));
        let asleep = |body: RigidBodyHandle| !world.bodies[body].is_dynamic() || world.bodies[body].is_sleeping();
        if asleep(joint.body1()) && asleep(joint.body2()) {
            return refused(sentences::IT_SLEEPS);
        }
        let joint_type = snapshot.model.joints[index].joint_type;
        let separate = separate(snapshot, index);
        let has_order = matches!(joint_type, JointType::Prismatic | JointType::Fixed);
        if separate.is_some() && has_order && world.impulse_joints.len() >= GROUPED {
            return refused(sentences::ROWS_IN_UNKNOWN_ORDER);
        }
        let duration = substep(world.parameters);
        let rows = [joint.impulses[0], joint.impulses[1], joint.impulses[2]].map(wide);
        let components = components(&stance.rows, joint_type, rows, separate).map(|impulse| -impulse / duration);
        let efforts =
            [JointAxis::LinX, JointAxis::LinY, JointAxis::AngX].map(|axis| motor_effort(joint, axis, duration));
        let sum = [0, 1, 2].map(|k| components[k] + efforts[k]);
        if sum.iter().any(|value| !value.is_finite()) {
            return Err(ReactionError::NotFinite);
        }
        reactions.push(snapshot.reaction(index, stance, sum));
    }
    Ok(reactions)
}

/// Components of the impulse along the coordinates of the joint.
fn components(
    rows: &JointRows,
    joint_type: JointType,
    impulses: [f64; 3],
    separate: Option<[[f64; 2]; 2]>,
) -> [f64; 3] {
    let (impulse, turning) = rows.impulse(joint_type, impulses, separate);
    let mut components = [rows.axis.dot(&impulse), turned(rows.axis).dot(&impulse), 0.0];
    components[ROTATION] = turning;
    components
}

/// The inverses of mass and moment of inertia of both bodies, if neither is a link of a multibody.
fn separate(snapshot: &Snapshot, index: usize) -> Option<[[f64; 2]; 2]> {
    let bodies = snapshot.model.joints[index].bodies.map(|body| &snapshot.model.bodies[body]);
    let inverse = |inertia: Option<[f64; 2]>| inertia.map_or([0.0; 2], |own| own.map(f64::recip));
    bodies.iter().all(|body| !body.is_link).then(|| bodies.map(|body| inverse(body.inertia)))
}

/// Force (N) or moment (N m) of a joint's motor on body 2 in the last substep, along an axis of joint frame 1.
///
/// `substep` is the duration of a substep (s).
/// The effort of a motor that is off is 0, although Rapier keeps the impulse of its last active step.
pub fn motor_effort(joint: &ImpulseJoint, axis: JointAxis, substep: f64) -> f64 {
    if !joint.data.motor_axes.contains(JointAxesMask::from(axis)) {
        return 0.0;
    }
    -wide(joint.data.motors[axis as usize].impulse) / substep
}

/// Duration of a substep (s). Rapier treats each of its solver iterations as a step of this duration.
pub fn substep(parameters: &IntegrationParameters) -> f64 {
    wide(parameters.dt) / parameters.num_solver_iterations as f64
}
