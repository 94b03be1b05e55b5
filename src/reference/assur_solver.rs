//! Side 1: group by group, forwards for the motion and backwards for the forces; dyads in closed form.

use super::kinetostatics::Kinetostatics;
use crate::assur::{OutOfReach, Plan};
use crate::case::Case;
use crate::error::{Error, ErrorKind, Result};
use crate::math::angle;
use crate::solver::{Progress, Provision, Solver, State};
use crate::trajectory::{Channel, Stage};

/// Crank angle between two poses (rad) up to which the nearest angle of a link is taken for its continuation.
const CLOSED_FORM_STEP: f64 = std::f64::consts::PI / 12.0;
/// The same where a group is followed by Newton's method from pose to pose.
const FOLLOWED_STEP: f64 = std::f64::consts::PI / 90.0;
/// How often a step that fails is halved: down to a millionth of it.
const HALVINGS: u32 = 20;

/// Group by group.
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
        let deepest = case.wanted.deepest();
        let mut state = State::at_start(case);
        let mut walk = Walk::of(case, &mut state)?;
        let mut statics = Kinetostatics::of(case, &walk.plan);
        for (done, row) in case.grid.ascending().into_iter().enumerate() {
            walk.go_to(case.grid.cranks[row], &mut state)?;
            let drive = case.drive.at(case.grid.times[row]);
            if deepest >= Stage::Velocities {
                walk.plan.velocities(drive.omega, &mut state.motions);
            }
            if deepest >= Stage::Accelerations {
                walk.plan.accelerations(drive.alpha, &mut state.motions);
            }
            if deepest >= Stage::Reactions {
                state.torque = statics.solve(case, &walk.plan, &state.motions, &mut state.forces);
            }
            visit(row, &state)?;
            progress((done + 1) as f64 / case.grid.len() as f64);
        }
        Ok(())
    }
}

/// Goes from crank angle to crank angle on one branch.
struct Walk<'a> {
    case: &'a Case,
    plan: Plan,
    crank: f64,
    step: f64,
}

impl<'a> Walk<'a> {
    /// At the start pose, which `state` holds and which fixes the branch.
    fn of(case: &'a Case, state: &mut State) -> Result<Self> {
        let plan = Plan::of(&case.mechanism, &case.structure, &case.modes);
        let step = if plan.is_closed_form() { CLOSED_FORM_STEP } else { FOLLOWED_STEP };
        let mut walk = Walk { case, plan, crank: case.drive.start, step };
        walk.step_to(case.drive.start, 0, state)?;
        Ok(walk)
    }

    /// Places the mechanism at the crank angle `target`, in small steps from where it is.
    fn go_to(&mut self, target: f64, state: &mut State) -> Result<()> {
        let from = self.crank;
        let parts = ((target - from).abs() / self.step).ceil().max(1.0);
        for part in 1..parts as usize {
            self.step_to(from + (target - from) * (part as f64 / parts), HALVINGS, state)?;
        }
        self.step_to(target, HALVINGS, state)
    }

    /// One step; where a group cannot be followed over it, two of half the size.
    fn step_to(&mut self, target: f64, halvings: u32, state: &mut State) -> Result<()> {
        let world = self.case.drive.world_angle(target);
        match self.plan.positions(world, &mut state.motions) {
            Ok(()) => {
                self.crank = target;
                self.continue_angles(world, state);
                Ok(())
            }
            Err(OutOfReach { span: None, .. }) if halvings > 0 => {
                self.step_to((self.crank + target) / 2.0, halvings - 1, state)?;
                self.step_to(target, halvings - 1, state)
            }
            Err(reach) => Err(self.unreachable(target, reach)),
        }
    }

    /// The links' angles, continued from the last pose.
    fn continue_angles(&self, world: f64, state: &mut State) {
        for (link, (motion, kept)) in state.motions.iter().zip(&mut state.angles).enumerate() {
            *kept = if link == self.case.drive.link {
                world
            } else {
                angle::nearest(motion.direction.y.atan2(motion.direction.x), *kept)
            };
        }
    }

    fn unreachable(&self, crank: f64, reach: OutOfReach) -> Error {
        let group = self.case.structure.groups[reach.group].names(&self.case.mechanism);
        let crank = crank.to_degrees();
        let message = match reach.span {
            Some((distance, [shortest, longest])) => format!(
                "the group ({group}) cannot be assembled at crank angle {crank:.4} deg: its outer joints are {distance:.6} m apart, its links span {shortest:.6} to {longest:.6} m"
            ),
            None => format!(
                "the group ({group}) cannot be followed beyond crank angle {crank:.4} deg: it has a dead point there"
            ),
        };
        Error::new(ErrorKind::Geometry, message)
            .help("shorten the grid to the crank angles that can be reached, or check the lengths")
    }
}
