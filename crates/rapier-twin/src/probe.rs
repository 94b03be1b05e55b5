//! Reactions and moments from tiny steps of the engine, started on the engine's trajectory.
//!
//! A separate world is placed in the pose at t - h. One or two steps make its velocities consistent with pose and
//! drives.
//! All degrees of freedom are driven, so the velocities are unique.
//! With these velocities, the world is placed in the pose at t and makes a step of h.
//! The impulses of this step give the reactions y(h) at t with an error proportional to h.
//! A second probe with h / 2 gives the extrapolated result 2 y(h / 2) - y(h).
//! Only poses are read from the trajectory, not velocities or accelerations.

use super::ghost::Ghost;
use super::guard::Guard;
use super::native::reporters;
use super::rapier::Precision;
use super::window::Window;
use super::world::World;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::Vec2;
use linkage::mechanism::{JointId, LinkPose, PerJoint};
use linkage::solver::State;
use linkage::work::{Count, WorkTally};
use rapier_reactions::{TinyStep, tiny_steps};

/// The worlds that are probed.
pub(super) struct Probe<'a> {
    worlds: Vec<Guard<'a>>,
    /// The tiny step (s).
    step: f64,
    reporters: PerJoint<Option<usize>>,
    ghost: Option<Ghost>,
    /// Poses at t - h and at t.
    poses: [Vec<LinkPose>; 2],
    tally: WorkTally,
}

impl<'a> Probe<'a> {
    /// Probes of worlds whose trees together cut every joint. The fastest drive turns by `turn` (rad) in a tiny step.
    pub(super) fn new(case: &'a Case, worlds: Vec<Guard<'a>>, turn: f64) -> Self {
        let cuts: Vec<&[JointId]> = worlds.iter().map(|guard| guard.world().tree().cut.as_slice()).collect();
        let reporters = reporters(case, &cuts);
        let speed = case.drives.top_speed(case.mechanism.size());
        let (poses, tally) = ([Vec::new(), Vec::new()], WorkTally::default());
        Probe { reporters, step: turn / speed, ghost: Ghost::of(case, false), worlds, poses, tally }
    }

    /// Fills in the reactions and moments of a state. The reactions belong to the window's motion at the time `t` (s).
    pub(super) fn solve(&mut self, case: &Case, window: &Window, state: &mut State, t: f64) -> Result<()> {
        state.forces.fill(Vec2::zeros());
        state.moments.fill(0.0);
        state.transmitted.iter_mut().for_each(|force| *force = 0.0);
        state.torques.fill(0.0);
        for index in 0..self.worlds.len() {
            for (TinyStep { step, share }, settling) in tiny_steps(self.step).into_iter().zip([2, 1]) {
                self.tally.one(Count::Probes);
                let ([before, now], guard) = (&mut self.poses, &mut self.worlds[index]);
                window.poses(case, t, step, before);
                window.poses(case, t, 0.0, now);
                guard.set_step(step);
                guard.load(state);
                guard.drive(|drive| drive.at(t - step).rate);
                for _ in 0..settling {
                    guard.place(before);
                    guard.step(t)?;
                }
                guard.place(now);
                guard.drive(|drive| drive.at(t).rate);
                guard.step(t)?;
                self.add(index, share, state);
            }
        }
        self.ghost.as_mut().map_or(Ok(()), |ghost| ghost.take_off(case, state, t))
    }

    /// Adds the reports of a world, multiplied by `share`, to a state.
    fn add(&self, index: usize, share: f64, state: &mut State) {
        let world: &dyn World = self.worlds[index].world();
        for joint in self.reporters.ids().filter(|&joint| self.reporters[joint] == Some(index)) {
            let (force, moment) = world.reaction(joint).expect("the tree of this world cuts the joint");
            state.forces[joint] += force * share;
            state.moments[joint] += moment * share;
        }
        if index == 0 {
            for (transmission, force) in state.transmitted.entries_mut() {
                *force += world.transmitted(transmission) * share;
            }
            for (drive, torque) in state.torques.iter_mut().enumerate() {
                *torque += world.torque(drive) * share;
            }
        }
    }
}

/// Rotation of the fastest driving link in a tiny step (rad).
/// In 2 y(h / 2) - y(h), the truncation error is proportional to the square of this rotation.
/// The rounding error is inversely proportional to this rotation. The sum of both errors has a flat minimum.
pub(super) fn probe_turn(precision: Precision) -> f64 {
    match precision {
        Precision::Double => 1e-4,
        #[cfg(feature = "f32")]
        Precision::Single => 5e-3,
    }
}
