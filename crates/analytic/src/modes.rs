//! All real configurations of every group at one crank angle.

use std::f64::consts::TAU;

use super::range::is_singular;
use crate::PoseSolver;
use crate::assur::groups::SolutionPlan;
use linkage::case::{Case, Grid, When};
use linkage::error::{ErrorKind, Result};
use linkage::math::unit;
use linkage::mechanism::assembly::{Configuration, configurations};
use linkage::mechanism::{AssemblyMode, LinkId, LinkPose, Pose};
use linkage::trajectory::Stage;

/// One real configuration of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Assembly mode of the configuration.
    pub mode: AssemblyMode,
    /// Pose of each link of the group, in the order of its links.
    pub poses: Vec<LinkPose>,
    /// Angular velocity of each link (rad/s). `None` in a singular configuration, where angular velocities are
    /// undetermined.
    pub omegas: Option<Vec<f64>>,
    /// Whether the motion of the case follows this configuration.
    pub is_followed: bool,
}

/// The known real configurations of one group.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// Configurations of the group. If not all configurations are known, the list contains only the configuration that
    /// the motion follows.
    pub modes: Vec<Mode>,
    /// For groups with transmissions or more than four bodies: the reason why the list is incomplete.
    /// `None` if the list is complete.
    pub unknown: Option<String>,
}

/// Moves the mechanism to a time (s), at which the crank angle is `crank` (rad).
/// If a dead point lies on the path, moves the crank in the opposite direction, to the crank angle that differs by one
/// whole turn.
/// Returns the crank angle reached.
fn reached(case: &Case, t: f64, crank: f64) -> Result<(PoseSolver<'_>, f64)> {
    let mut poses = PoseSolver::counting_turns(case)?;
    let Err(error) = poses.solve_place(t, crank, Stage::Positions) else { return Ok((poses, crank)) };
    if error.kind() == ErrorKind::Geometry && case.drives.further().is_empty() {
        let other = crank - TAU.copysign(crank - case.crank().start);
        let mut round = PoseSolver::counting_turns(case)?;
        if round.solve_place(case.crank().time_of(other), other, Stage::Positions).is_ok() {
            return Ok((round, other));
        }
    }
    Err(error)
}

/// The real configurations of every group (in the order of the structure) at an instant.
/// Links that are placed before the group are in the pose of the branch that the case follows.
///
/// # Errors
/// [`ErrorKind::Geometry`] if the crank angle cannot be reached on the case's branch.
pub fn all(case: &Case, when: When) -> Result<Vec<Modes>> {
    let mechanism = &case.mechanism;
    let Grid { times, inputs } = when.grid(case.crank());
    let (mut poses, crank) = reached(case, times[0], inputs[0])?;
    poses.solve_place(times[0], crank, Stage::Velocities)?;
    let state = poses.with_angles().clone();
    let [angles, omegas] = [poses.coordinates().to_vec(), poses.speeds().to_vec()];
    let followed: Vec<LinkPose> =
        state.motions.iter().zip(&state.angles).map(|(m, &angle)| LinkPose { origin: m.origin, angle }).collect();
    let pose = Pose(followed.into());
    let mut groups = Vec::with_capacity(case.structure.groups.len());
    for (index, group) in case.structure.groups.entries() {
        let part = case.structure.of_groups(case.structure.groups.ids().take(index.index() + 1));
        let mut modes = Vec::new();
        let (found, unknown) = match configurations(mechanism, group, &pose) {
            Ok(found) => (found, None),
            Err(error) if error.kind() == ErrorKind::Unsupported => {
                let links = group.links.iter().map(|&link| pose.0[link]).collect();
                (vec![Configuration { mode: case.modes[index], links }], Some(error.message().to_string()))
            }
            Err(error) => return Err(error),
        };
        for one in found {
            let mut motions = state.motions.clone();
            for (&link, place) in group.links.iter().zip(&one.links) {
                motions[link].origin = place.origin;
                motions[link].direction = unit(place.angle);
            }
            let mut chosen = case.modes[..=index.index()].to_vec();
            chosen[index] = one.mode;
            let mut plan = SolutionPlan::of(mechanism, &part, &chosen);
            // The configurations are already exact. `positions` is called only to prepare the computation of the
            // velocities.
            let solved = plan.positions(&angles, &mut motions).is_ok();
            let mut placed = pose.clone();
            for (&link, place) in group.links.iter().zip(&one.links) {
                placed.0[link] = *place;
            }
            let omegas = (solved && !is_singular(mechanism, group, &placed)).then(|| {
                plan.velocities(&omegas, &mut motions);
                group.links.iter().map(|&link| motions[link].omega).collect()
            });
            let near = |(&link, place): (&LinkId, &LinkPose)| {
                (unit(place.angle) - state.motions[link].direction).norm() < 1e-9
            };
            let is_followed = group.links.iter().zip(&one.links).all(near);
            modes.push(Mode { mode: one.mode, poses: one.links, omegas, is_followed });
        }
        groups.push(Modes { modes, unknown });
    }
    Ok(groups)
}
