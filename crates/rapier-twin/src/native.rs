//! Reactions and moments as the engine reports them during the run.
//! In a prescribed motion, the contribution of loads is added afterwards by the Newton-Euler equations.
//! The reason is that loads jump where a link reverses, and a jump cannot be interpolated between steps.

use super::ghost::Ghost;
use super::guard::Guard;
use super::ring::{Place, Ring};
use super::window::first_steps;
use linkage::case::Case;
use linkage::engine::Settings;
use linkage::error::Result;
use linkage::math::Vec2;
use linkage::mechanism::{JointId, PerJoint, TransmissionId};
use linkage::solver::State;

/// Delay of the engine's reports, in substeps.
/// Each report describes one instant best. The delay is the time from this instant to the end of the reported step.
/// The impulses of step n belong to the pose of step n - 1.
/// The impulses of step n change velocities along the constraints of the pose of step n - 2 into velocities along the
/// constraints of the pose of step n - 1.
/// The error is of first order whichever instant the impulses are assigned to.
/// At a crank rotation of 0.32 deg per step, the instants t_n, t_(n-1) and t_(n-2) gave these errors:
/// 3.8e-2, 2.0e-2 and 2.1e-2 on `ov7_base`; 1.7e-2, 5.8e-3 and 6.6e-3 on `crank_rocker`.
const LATE: f64 = 1.0;

/// For every joint, the index of the world that reports its reaction.
/// `None` is possible only for joints whose reactions are not requested.
pub(super) fn reporters(case: &Case, cuts: &[&[JointId]]) -> PerJoint<Option<usize>> {
    let of = |joint: JointId| cuts.iter().position(|cut| cut.contains(&joint));
    case.mechanism.joints().ids().map(of).collect()
}

/// The engine's reports of the last steps.
pub(super) struct Native {
    step: f64,
    late: f64,
    ring: Ring,
    reporters: PerJoint<Option<usize>>,
    ghost: Option<Ghost>,
    row: Vec<f64>,
    /// Number of drives, whose moments are the last values of a row.
    drives: usize,
    /// Smallest step number for [`Place::from`]. Reactions at earlier instants are extrapolated from later steps.
    lowest: i64,
}

impl Native {
    pub(super) fn new(case: &Case, worlds: &[Guard], settings: &Settings, start: i64) -> Self {
        let plain = worlds[0].world().tree().branches.is_empty();
        let cuts: Vec<&[JointId]> = worlds.iter().map(|guard| guard.world().tree().cut.as_slice()).collect();
        let width = 3 * case.mechanism.joints().len() + case.mechanism.transmissions().len() + case.drives.len();
        let reporters = reporters(case, &cuts);
        // In a free motion, the first reported step is step 1.
        // The first steps begin with velocities along the constraints of the present pose. Later steps begin with
        // velocities along the constraints of the previous pose. The impulses of the first steps are therefore
        // incomplete, and these steps are left out.
        let lowest = if case.is_free() { 3 + first_steps(case, plain) } else { i64::MIN / 2 };
        let (step, late) = (settings.resolution, LATE / settings.substeps as f64);
        let (ring, ghost, row) = (Ring::new(width, start), Ghost::of(case, !case.is_free()), vec![0.0; width]);
        Native { step, late, ring, reporters, ghost, row, drives: case.drives.len(), lowest }
    }

    /// Stores the reports of a step.
    /// `direct` is the moment of the crank's motor (N m) that was applied as a load.
    pub(super) fn push(&mut self, worlds: &[Guard], direct: f64) {
        let row = self.ring.push();
        let (first, drives) = (3 * self.reporters.len(), row.len() - self.drives);
        for (joint, &world) in self.reporters.entries() {
            let Some(world) = world else { continue };
            let (force, moment) = worlds[world].world().reaction(joint).expect("the tree of this world cuts the joint");
            row[3 * joint.index()..][..3].copy_from_slice(&[force.x, force.y, moment]);
        }
        for (transmission, force) in row[first..drives].iter_mut().enumerate() {
            *force = worlds[0].world().transmitted(TransmissionId(transmission));
        }
        for (drive, torque) in row[drives..].iter_mut().enumerate() {
            *torque = worlds[0].world().torque(drive);
        }
        row[drives] += direct;
    }

    /// Fills in the reactions and moments of a state whose motion is known.
    pub(super) fn solve(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        let place = Place::of(t / self.step + self.late).from(self.lowest);
        self.ring.weigh(place.first(), &place.weights(0.0), 0..self.row.len(), &mut self.row);
        for joint in self.reporters.ids() {
            let row = &self.row[3 * joint.index()..];
            (state.forces[joint], state.moments[joint]) = (Vec2::new(row[0], row[1]), row[2]);
        }
        let (first, drives) = (3 * self.reporters.len(), self.row.len() - self.drives);
        state.transmitted = self.row[first..drives].to_vec().into();
        state.torques.copy_from_slice(&self.row[drives..]);
        self.ghost.as_mut().map_or(Ok(()), |ghost| ghost.take_off(case, state, t))
    }
}
