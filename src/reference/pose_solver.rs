//! Pose after pose by Assur groups: the part of side 1 that is fast.

use std::f64::consts::TAU;

use super::kinetostatics::Kinetostatics;
use super::range;
use crate::assur::{Misfit, OutOfReach, Plan};
use crate::case::Case;
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Vec2, angle, cross};
use crate::solver::State;
use crate::trajectory::Stage;

/// Crank angle between two poses (rad) over which no link turns so far that its turns could be miscounted.
const CLOSED_FORM_STEP: f64 = std::f64::consts::PI / 12.0;
/// The same where a group is followed by Newton's method from pose to pose.
const FOLLOWED_STEP: f64 = std::f64::consts::PI / 90.0;
/// How often a step that fails is halved: down to a millionth of it.
const HALVINGS: u32 = 20;

/// Goes from crank angle to crank angle on one branch and solves the pose there, without allocation.
#[derive(Debug)]
pub struct PoseSolver<'a> {
    case: &'a Case,
    plan: Plan,
    statics: Kinetostatics,
    state: State,
    /// Direction of every link at the last pose, and its whole turns.
    directions: Vec<Vec2>,
    turns: Vec<f64>,
    /// Angles, angular velocities or accelerations of all driving links, as each stage needs them.
    inputs: Vec<f64>,
    crank: f64,
    step: f64,
}

impl<'a> PoseSolver<'a> {
    /// At the start pose of the case, which fixes the branch.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the start pose is a singular one.
    pub fn new(case: &'a Case) -> Result<Self> {
        let plan = Plan::of(&case.mechanism, &case.structure, &case.modes);
        let step = if plan.is_closed_form() { CLOSED_FORM_STEP } else { FOLLOWED_STEP };
        let (statics, state) = (Kinetostatics::of(case, &plan), State::at_start(case));
        let inputs = vec![0.0; case.drives().count()];
        let directions = state.motions.iter().map(|motion| motion.direction).collect();
        let turns = case.start.0.iter().map(|pose| ((pose.angle - angle::wrapped(pose.angle)) / TAU).round()).collect();
        let mut solver =
            PoseSolver { case, plan, statics, state, directions, turns, inputs, crank: case.drive.start, step };
        solver.step_to(case.drive.start, 0)?;
        Ok(solver)
    }

    /// The state at the crank angle `crank` (rad, as the scenario states it) for the crank's angular velocity `omega` (rad/s)
    /// and acceleration `alpha` (rad/s^2), to which further drives are geared as at that instant, computed as far as `deepest`; what lies beyond is left from before, and so are the angles:
    /// see [`PoseSolver::with_angles`].
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the crank angle cannot be reached on the branch, with the group and the angle at which it fails.
    #[inline]
    pub fn solve(&mut self, crank: f64, omega: f64, alpha: f64, deepest: Stage) -> Result<&State> {
        self.go_to(crank)?;
        if deepest >= Stage::Velocities {
            self.drive(omega);
            self.plan.velocities(&self.inputs, &mut self.state.motions);
        }
        if deepest >= Stage::Accelerations {
            self.drive(alpha);
            self.plan.accelerations(&self.inputs, &mut self.state.motions);
        }
        if deepest >= Stage::Reactions {
            self.statics.solve(self.case, &self.plan, &mut self.state);
        }
        Ok(&self.state)
    }

    /// Places the mechanism at the crank angle `target`, in small steps from where it is.
    fn go_to(&mut self, target: f64) -> Result<()> {
        let from = self.crank;
        if (target - from).abs() <= self.step {
            return self.step_to(target, HALVINGS);
        }
        let parts = ((target - from).abs() / self.step).ceil();
        for part in 1..parts as usize {
            self.step_to(from + (target - from) * (part as f64 / parts), HALVINGS)?;
        }
        self.step_to(target, HALVINGS)
    }

    /// World angles of all driving links at a crank angle into the inputs.
    #[inline]
    fn turn(&mut self, crank: f64) {
        let (first, further) = self.inputs.split_first_mut().expect("there is a drive");
        *first = self.case.drive.world_angle(crank);
        if !further.is_empty() {
            let t = self.case.drive.time_of(crank);
            for (angle, drive) in further.iter_mut().zip(&self.case.further_drives) {
                *angle = drive.world_angle(drive.at(t).angle);
            }
        }
    }

    /// The crank's `rate` and those of further driving links, which are geared to it, into the inputs.
    #[inline]
    fn drive(&mut self, rate: f64) {
        let (first, further) = self.inputs.split_first_mut().expect("there is a drive");
        *first = rate;
        if !further.is_empty() {
            let ratios = self.case.ratios(self.case.drive.time_of(self.crank));
            further.iter_mut().zip(ratios.skip(1)).for_each(|(own, ratio)| *own = rate * ratio);
        }
    }

    /// One step; where a group cannot be followed over it, two of half the size.
    fn step_to(&mut self, target: f64, halvings: u32) -> Result<()> {
        self.turn(target);
        match self.plan.positions(&self.inputs, &mut self.state.motions) {
            Ok(()) => {
                self.crank = target;
                self.count_turns();
                Ok(())
            }
            Err(OutOfReach { why: Misfit::Lost, .. }) if halvings > 0 => {
                self.step_to((self.crank + target) / 2.0, halvings - 1)?;
                self.step_to(target, halvings - 1)
            }
            Err(reach) => Err(self.unreachable(target, reach)),
        }
    }

    /// Counts the turns of every link: it has gone past the direction -x since the last pose, one way or the other.
    #[inline]
    fn count_turns(&mut self) {
        for ((turns, last), motion) in self.turns.iter_mut().zip(&mut self.directions).zip(&self.state.motions) {
            let now = motion.direction;
            let (was_up, is_up) = (last.y >= 0.0, now.y >= 0.0);
            if was_up != is_up {
                let sense = cross(*last, now);
                if was_up && sense > 0.0 {
                    *turns += 1.0;
                } else if is_up && sense < 0.0 {
                    *turns -= 1.0;
                }
            }
            *last = now;
        }
    }

    /// The last state with its links' angles (rad), turns kept.
    pub fn with_angles(&mut self) -> &State {
        for ((angle, turns), motion) in self.state.angles.iter_mut().zip(&self.turns).zip(&self.state.motions) {
            // Adding zero makes -0 a 0: on the axis -x the angle is +pi, as it is counted.
            *angle = (motion.direction.y + 0.0).atan2(motion.direction.x) + TAU * turns;
        }
        self.turn(self.crank);
        for (drive, &angle) in self.case.drives().zip(&self.inputs) {
            self.state.angles[drive.link] = angle;
        }
        &self.state
    }

    fn unreachable(&self, crank: f64, reach: OutOfReach) -> Error {
        let group = self.case.structure.groups[reach.group].names(&self.case.mechanism);
        let crank = crank.to_degrees();
        let assembled = format!("the group ({group}) cannot be assembled at crank angle {crank:.4} deg");
        let message = match reach.why {
            Misfit::Span { distance, reach: [shortest, longest] } => format!(
                "{assembled}: its outer joints are {distance:.6} m apart, its links span {shortest:.6} to {longest:.6} m"
            ),
            Misfit::Guide { distance, length } => format!(
                "{assembled}: its rod is {length:.6} m long, its outer pin {distance:.6} m from the line on which the other end slides"
            ),
            Misfit::Swing { distance, shortest } => format!(
                "{assembled}: its outer pins are {distance:.6} m apart, its slider holds them at least {shortest:.6} m apart"
            ),
            Misfit::Parallel => format!("{assembled}: its two axes are parallel there"),
            Misfit::Lost => format!(
                "the group ({group}) cannot be followed beyond crank angle {crank:.4} deg: it has a dead point there"
            ),
        };
        let error = Error::new(ErrorKind::Geometry, message)
            .help("shorten the grid to the crank angles that can be reached, or check the lengths");
        range::explained(self.case, &error)
    }
}
