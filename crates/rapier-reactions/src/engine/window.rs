//! Reactions from the poses of three successive steps.

use super::probe::Probing;
use super::snapshot::{JointReaction, Middle, Snapshot, WorldRef};
use super::wide;
use crate::balance::balance;
use crate::error::ReactionError;
use crate::motion::Motion;

/// The poses of the last three steps of a world.
///
/// Push the world after every step; the time step must stay constant.
/// The reactions are those at the middle pose, one step before the last push.
/// The reactions do not come from impulses, so the joints of a multibody have reactions too.
///
/// Loads are gravity, and the forces and torques that bodies have (`add_force`, `add_torque`) when they are pushed.
/// Damping of separate bodies counts as a load. If a load changes from step to step, the load of the step that begins
/// at the middle pose is used.
/// Contacts, and impulses applied between steps, are not taken into account.
/// Reset the window ([`PoseWindow::clear`]) after moving a body by hand.
#[derive(Clone, Debug, Default)]
pub struct PoseWindow {
    snapshots: Vec<Snapshot>,
    step: f64,
}

/// Reactions of all joints from the Newton-Euler equations.
#[derive(Clone, Debug)]
pub struct BalancedReactions {
    /// The reactions: impulse joints, then joints of multibodies, each in the order of its set.
    pub reactions: Vec<JointReaction>,
    /// Part of m a - loads that no joint force explains, as a fraction of m a - loads. Numerator and denominator are
    /// root sums of squares, each square divided by the mass or moment of inertia. The residual belongs to coordinates
    /// that move freely. A large residual shows a load that was not taken into account, such as a contact. If every
    /// coordinate has a motor, the residual is 0 up to rounding.
    pub residual: f64,
}

impl PoseWindow {
    /// Forgets all poses.
    pub fn clear(&mut self) {
        self.snapshots.clear();
    }

    /// Stores the poses after a step. If bodies, joints or the time step have changed, the older poses are dropped.
    ///
    /// # Errors
    /// [`ReactionError::Unsupported`] for a joint or body of an unsupported kind, [`ReactionError::Step`],
    /// and [`ReactionError::NotFinite`].
    pub fn push(&mut self, world: &WorldRef) -> Result<(), ReactionError> {
        let step = wide(world.parameters.dt);
        if !(step > 0.0 && step.is_finite()) {
            return Err(ReactionError::Step(step));
        }
        let snapshot = Snapshot::with_masses(world)?;
        if step != self.step || self.snapshots.last().is_some_and(|last| !last.has_joints_of(&snapshot)) {
            self.clear();
        }
        self.step = step;
        if self.snapshots.len() == 3 {
            self.snapshots.remove(0);
        }
        self.snapshots.push(snapshot);
        Ok(())
    }

    /// The reactions of all joints from second differences of the poses, by the Newton-Euler equations of all bodies.
    /// Under prescribed speeds, the error is of second order in the step. In a free motion, the error is of first
    /// order, as is the error of the engine's motion.
    ///
    /// # Errors
    /// [`ReactionError::TooFewPoses`], [`ReactionError::NotDetermined`] with the names of the joints whose forces the
    /// motion does not determine, and [`ReactionError::NotFinite`].
    pub fn by_differences(&self) -> Result<BalancedReactions, ReactionError> {
        let Middle { snapshot, stances, motions } = self.middle()?;
        let found = balance(&snapshot.model, &stances, &motions);
        let found = found.map_err(|joints| {
            ReactionError::NotDetermined(joints.into_iter().map(|joint| snapshot.joints[joint].name()).collect())
        })?;
        if found.components.iter().flatten().any(|value| !value.is_finite()) {
            return Err(ReactionError::NotFinite);
        }
        let reaction = |(index, &components)| snapshot.reaction(index, &stances[index], components);
        let reactions = found.components.iter().enumerate().map(reaction).collect();
        Ok(BalancedReactions { reactions, residual: found.residual })
    }

    /// The reactions of all joints, read from Rapier's impulses in tiny steps.
    ///
    /// A separate world with the same bodies is set to the pose shortly before the middle pose, and one step makes
    /// its velocities consistent with the joints.
    /// The separate world is then set to the middle pose and makes a tiny step, whose impulses are read.
    /// A second tiny step is half as long. The result is extrapolated from both tiny steps.
    /// In the separate world every joint is an impulse joint, so joints of a multibody are read as well.
    /// Along a coordinate with a motor, a damper or a spring, the bodies move as they do in the window.
    ///
    /// The error has the same order in the step as the error of [`PoseWindow::by_differences`], but it is smaller.
    ///
    /// # Errors
    /// [`ReactionError::TooFewPoses`], [`ReactionError::NotConverged`], [`ReactionError::NotFinite`], and
    /// [`ReactionError::Unsupported`] for prismatic and fixed joints in worlds of 64 joints and more.
    pub fn by_probe(&self, probing: &Probing) -> Result<Vec<JointReaction>, ReactionError> {
        probing.reactions(&self.middle()?, self.step)
    }

    /// The middle pose, with the loads of the step that begins there.
    fn middle(&self) -> Result<Middle<'_>, ReactionError> {
        let [before, now, after] = self.snapshots.as_slice() else {
            return Err(ReactionError::TooFewPoses(self.snapshots.len()));
        };
        let stances = after.model.stances(&now.placements);
        let bodies = after.model.bodies.iter().enumerate();
        let poses = |index: usize| [before, now, after].map(|own| own.placements[index]);
        let motions = bodies.map(|(index, body)| Motion::of(body, poses(index), self.step)).collect();
        Ok(Middle { snapshot: after, stances, motions })
    }
}
