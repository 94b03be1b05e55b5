//! Side 1: group by group, closed form forwards for the motion, closed form backwards for the forces.

use super::kinetostatics::Kinetostatics;
use crate::assur::{OutOfReach, Plan};
use crate::case::Case;
use crate::error::{Error, ErrorKind, Result};
use crate::math::angle;
use crate::solver::{Progress, Provision, Solver, State};
use crate::trajectory::{Channel, Stage};

/// Crank angle between two poses (rad) up to which the nearest angle of a link is taken for its continuation.
const TRACKING_STEP: f64 = std::f64::consts::PI / 12.0;

/// Group by group in closed form.
#[derive(Clone, Copy, Debug)]
pub struct AssurSolver;

impl Solver for AssurSolver {
    fn name(&self) -> &'static str {
        "assur"
    }

    fn provides(&self, _: &Channel) -> Provision {
        Provision::Computed
    }

    fn sweep(&self, case: &Case, visit: &mut dyn FnMut(usize, &State) -> Result<()>, progress: Progress) -> Result<()> {
        let plan = Plan::of(&case.mechanism, &case.structure, &case.modes)?;
        let statics = Kinetostatics::of(case);
        let deepest = case.wanted.deepest();
        let mut state = State::at_rest(case);
        state.angles.iter_mut().zip(&case.start.0).for_each(|(angle, pose)| *angle = pose.angle);
        let mut crank = case.drive.start;
        for (done, row) in case.grid.ascending().into_iter().enumerate() {
            let (t, target) = (case.grid.times[row], case.grid.cranks[row]);
            let parts = ((target - crank).abs() / TRACKING_STEP).ceil().max(1.0);
            for part in 1..parts as usize {
                let between = crank + (target - crank) * (part as f64 / parts);
                place(case, &plan, between, &mut state)?;
            }
            place(case, &plan, target, &mut state)?;
            crank = target;
            let drive = case.drive.at(t);
            if deepest >= Stage::Velocities {
                plan.velocities(drive.omega, &mut state.motions);
            }
            if deepest >= Stage::Accelerations {
                plan.accelerations(drive.alpha, &mut state.motions);
            }
            if deepest >= Stage::Reactions {
                state.torque = statics.solve(case, &state.motions, &mut state.forces);
            }
            visit(row, &state)?;
            progress((done + 1) as f64 / case.grid.len() as f64);
        }
        Ok(())
    }
}

/// Positions at a crank angle, and the links' angles continued from the last pose.
fn place(case: &Case, plan: &Plan, crank: f64, state: &mut State) -> Result<()> {
    let world = case.drive.world_angle(crank);
    plan.positions(world, &mut state.motions).map_err(|reach| unreachable_pose(case, crank, reach))?;
    for (link, (motion, kept)) in state.motions.iter().zip(&mut state.angles).enumerate() {
        *kept = if link == case.drive.link {
            world
        } else {
            angle::nearest(motion.direction.y.atan2(motion.direction.x), *kept)
        };
    }
    Ok(())
}

fn unreachable_pose(case: &Case, crank: f64, reach: OutOfReach) -> Error {
    let group = &case.structure.groups[reach.group];
    let [shortest, longest] = reach.span;
    Error::new(
        ErrorKind::Geometry,
        format!(
            "the group ({}) cannot be assembled at crank angle {:.4} deg: its outer joints are {:.6} m apart, its links span {shortest:.6} to {longest:.6} m",
            group.names(&case.mechanism),
            crank.to_degrees(),
            reach.distance
        ),
    )
    .help("shorten the grid to the crank angles that can be reached, or check the lengths")
}
