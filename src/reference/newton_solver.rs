//! Side 2: the whole mechanism at once, from its constraint equations and their Jacobian.
//!
//! Coordinates are (x, y, theta) of every link's mass centre frame. Constraints: two equations C = 0 of every joint, and the
//! driving link has its angle. Positions by Newton, then J q' = rate of the drive, J q'' = gamma with the centripetal terms,
//! and M q'' = Q + J^T lambda, whose multipliers are the reactions on the second links and the balancing moment (Haug,
//! "Computer aided kinematics and dynamics of mechanical systems", 1989, chapters 3 and 8).

mod constraint;
mod free;

use std::f64::consts::PI;

use super::range;
use crate::case::Case;
use crate::drive::{Drive, DriveState, Wrench};
use crate::error::{Error, ErrorKind, Result};
use crate::math::dense::Lu;
use crate::math::{KeepNan, Motion, Vec2, unit};
use crate::mechanism::EQUATIONS;
use crate::solver::{Progress, Provision, Solver, State, Visit};
use crate::trajectory::{Channel, Stage};

/// Largest turn of the crank between two poses (rad): a prediction from there stays on the branch.
const TRACKING_STEP: f64 = PI / 90.0;
/// How often a step that fails is halved: down to a millionth of it.
const HALVINGS: u32 = 20;
/// Newton from a predicted pose converges in two or three iterations; more mean that something is wrong.
const MAX_ITERATIONS: usize = 12;

/// Whole mechanism by Newton and Lagrange multipliers.
#[derive(Clone, Copy, Debug)]
pub struct NewtonSolver;

impl Solver for NewtonSolver {
    fn name(&self) -> &'static str {
        "newton"
    }

    fn provides(&self, _: &Channel) -> Provision {
        Provision::Computed
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        let mut system = System::new(case);
        if case.is_free() {
            system.settle().map_err(|error| range::explained(case, &error))?;
            return super::free::sweep(case, &mut free::Embedded::new(system), visit, progress);
        }
        let mut state = State::at_rest(case);
        let rows = case.grid.ascending();
        // Outwards from the start in both directions: first the rows at and after t = 0, then those before it, backwards.
        let split = rows.partition_point(|&row| case.grid.times[row] < 0.0);
        let mut done = 0;
        let mut follow = |rows: &mut dyn Iterator<Item = usize>, system: &mut System| -> Result<()> {
            for row in rows {
                system.go_to(case.grid.times[row]).map_err(|error| range::explained(case, &error))?;
                system.fill(&mut state);
                visit(row, &state)?;
                done += 1;
                progress(done as f64 / case.grid.len() as f64);
            }
            Ok(())
        };
        system.settle().map_err(|error| range::explained(case, &error))?;
        follow(&mut rows[split..].iter().copied(), &mut system)?;
        if split > 0 {
            system = System::new(case);
            system.settle()?;
            follow(&mut rows[..split].iter().rev().copied(), &mut system)?;
        }
        Ok(())
    }
}

/// The equations of one case and the state they are solved for.
struct System<'a> {
    case: &'a Case,
    stage: Stage,
    time: f64,
    /// Coordinates, velocities and accelerations: x, y, theta of each moving link's mass centre.
    q: Vec<f64>,
    rate: Vec<f64>,
    second: Vec<f64>,
    /// Multipliers: two a joint, then the drives'.
    lambda: Vec<f64>,
    /// Of every joint: see [`constraint::twist`].
    twists: Vec<f64>,
    jacobian: Lu,
    /// Sign of the Jacobian's determinant on the branch that is followed.
    branch: f64,
    residual: Vec<f64>,
    predicted: Vec<f64>,
    /// Coordinates before the step, to go back to.
    before: Vec<f64>,
    /// The driving links now: angles in the world, angular velocities and accelerations.
    inputs: Vec<DriveState>,
    /// Motions and angles of all links, for their loads, and these.
    motions: Vec<Motion>,
    angles: Vec<f64>,
    loads: Vec<Wrench>,
}

impl<'a> System<'a> {
    fn new(case: &'a Case) -> Self {
        let links = &case.mechanism.links()[1..];
        let n = 3 * links.len();
        let mut q = Vec::with_capacity(n);
        for (link, pose) in links.iter().zip(&case.start.0[1..]) {
            let centre = pose.point(link.mass_centre);
            q.extend([centre.x, centre.y, pose.angle]);
        }
        let zeros = || vec![0.0; n];
        System {
            case,
            stage: case.wanted.deepest(),
            time: 0.0,
            q,
            rate: zeros(),
            second: zeros(),
            lambda: zeros(),
            twists: case.mechanism.joints().iter().map(|joint| constraint::twist(case, joint)).collect(),
            jacobian: Lu::new(n),
            branch: 0.0,
            residual: zeros(),
            predicted: zeros(),
            before: zeros(),
            motions: vec![Motion::REST; links.len() + 1],
            angles: vec![0.0; links.len() + 1],
            loads: vec![Wrench::ZERO; links.len() + 1],
            inputs: case.drives().map(|drive| by_law(drive, 0.0)).collect(),
        }
    }

    /// Sets the time, and the driving links as their laws have them then.
    fn set_time(&mut self, t: f64) {
        self.time = t;
        for (input, drive) in self.inputs.iter_mut().zip(self.case.drives()) {
            *input = by_law(drive, t);
        }
    }

    /// Polishes the pose at t = 0 and fixes the branch there.
    fn settle(&mut self) -> Result<()> {
        self.correct()?;
        self.branch = self.jacobian.determinant_sign();
        self.differentiate();
        Ok(())
    }

    /// Follows the branch to time `t`, in small turns of the crank.
    fn go_to(&mut self, t: f64) -> Result<()> {
        let turned = |drive: &Drive| match drive.law.constant() {
            Some(_) => (drive.at(t).angle - drive.at(self.time).angle).abs(),
            // It may go there and back in between.
            None => drive.top_speed().abs() * (t - self.time).abs(),
        };
        let turn = self.case.drives().map(turned).fold(0.0, f64::larger);
        let parts = (turn / TRACKING_STEP).ceil().larger(1.0);
        let from = self.time;
        for part in 1..parts as usize {
            self.step_to(from + (t - from) * (part as f64 / parts), HALVINGS)?;
        }
        // The last part lands on t itself, not on a rounded neighbour.
        self.step_to(t, HALVINGS)?;
        if self.stage >= Stage::Reactions {
            self.find_loads(Case::loads_on);
            self.multipliers();
        }
        Ok(())
    }

    /// One step from a prediction; where the branch cannot be followed over it, two of half the size.
    fn step_to(&mut self, t: f64, halvings: u32) -> Result<()> {
        let (from, dt) = (self.time, t - self.time);
        self.before.copy_from_slice(&self.q);
        for i in 0..self.q.len() {
            self.q[i] += dt * (self.rate[i] + 0.5 * dt * self.second[i]);
        }
        self.set_time(t);
        self.predicted.copy_from_slice(&self.q);
        match self.correct().and_then(|()| self.check_branch(dt)) {
            Ok(()) => {
                self.differentiate();
                Ok(())
            }
            Err(error) if halvings == 0 => Err(error),
            Err(_) => {
                self.q.copy_from_slice(&self.before);
                self.set_time(from);
                self.step_to(from + dt / 2.0, halvings - 1)?;
                self.step_to(t, halvings - 1)
            }
        }
    }

    /// Newton to rounding, from the pose that stands in `q`. The Jacobian is left factored at the last pose but one
    /// (which differs from the last by rounding).
    fn correct(&mut self) -> Result<()> {
        let size = self.case.mechanism.size().larger(f64::MIN_POSITIVE);
        let mut last = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            self.assemble();
            if !self.jacobian.factor() {
                return Err(self.lost("the Jacobian is singular there (dead point)"));
            }
            self.jacobian.solve(&mut self.residual);
            let mut change: f64 = 0.0;
            for (i, step) in self.residual.iter().enumerate() {
                self.q[i] -= step;
                change = change.larger(step.abs() / if i % 3 == 2 { 1.0 } else { size });
            }
            // Quadratic convergence: once below 1e-9 the next change is rounding, and one more step makes sure of it.
            if change < 1e-14 || (last < 1e-9 && change < 1e-9) {
                return Ok(());
            }
            last = change;
        }
        Err(self.lost("Newton's method does not converge there"))
    }

    /// Residuals of all constraints and their Jacobian at the pose in `q`.
    fn assemble(&mut self) {
        self.jacobian.clear();
        let case = self.case;
        for (index, joint) in case.mechanism.joints().iter().enumerate() {
            self.assemble_joint(2 * index, joint);
        }
        let first = EQUATIONS * case.mechanism.joints().len();
        for (row, drive) in self.drives() {
            let theta = 3 * (drive.link - 1) + 2;
            self.residual[row] = self.q[theta] - self.inputs[row - first].angle;
            self.jacobian.add(row, theta, 1.0);
        }
    }

    /// Velocities and accelerations from the factored Jacobian.
    fn differentiate(&mut self) {
        self.rate.fill(0.0);
        let first = EQUATIONS * self.case.mechanism.joints().len();
        for (index, input) in self.inputs.iter().enumerate() {
            (self.rate[first + index], self.second[first + index]) = (input.omega, input.alpha);
        }
        self.jacobian.solve(&mut self.rate);
        for (index, joint) in self.case.mechanism.joints().iter().enumerate() {
            let gamma = self.gamma(joint);
            self.second[2 * index..2 * index + 2].copy_from_slice(&gamma);
        }
        self.jacobian.solve(&mut self.second);
    }

    /// Motions and angles of all links from the coordinates, for the loads, which are then found by `of`.
    fn find_loads(&mut self, of: impl FnOnce(&Case, &[Motion], &[f64], &mut [Wrench])) {
        if !self.case.loads.is_empty() {
            for link in 1..self.motions.len() {
                (self.motions[link], self.angles[link]) = self.motion(link);
            }
            of(self.case, &self.motions, &self.angles, &mut self.loads);
        }
    }

    /// J^T lambda = M q'' - Q, with the loads last found.
    fn multipliers(&mut self) {
        for (index, link) in self.case.mechanism.links()[1..].iter().enumerate() {
            let i = 3 * index;
            let Wrench { force, moment } = self.loads[index + 1];
            self.lambda[i] = link.mass * (self.second[i] - self.case.gravity.x) - force.x;
            self.lambda[i + 1] = link.mass * (self.second[i + 1] - self.case.gravity.y) - force.y;
            self.lambda[i + 2] = link.inertia * self.second[i + 2] - moment;
        }
        self.jacobian.solve_transposed(&mut self.lambda);
    }

    /// A pose reached by going through a singular one, or by a correction far beyond the prediction, is another branch.
    fn check_branch(&self, dt: f64) -> Result<()> {
        if self.jacobian.determinant_sign() != self.branch {
            return Err(self.lost("the mechanism has passed a dead point on the way there"));
        }
        // Places too: where axes become parallel, a slider comes back from infinity on the other side.
        let size = self.case.mechanism.size();
        for (index, rate) in self.rate.iter().enumerate() {
            let allowed = (dt * rate).abs() + if index % 3 == 2 { TRACKING_STEP } else { size };
            if !((self.q[index] - self.predicted[index]).abs() <= allowed) {
                return Err(self.lost("the solution has jumped to another branch"));
            }
        }
        Ok(())
    }

    /// Motion and angle of a moving link's frame.
    fn motion(&self, link: usize) -> (Motion, f64) {
        let i = 3 * (link - 1);
        let pair = |of: &[f64]| Vec2::new(of[i], of[i + 1]);
        let motion = Motion::of_point(
            self.case.mechanism.links()[link].mass_centre,
            [pair(&self.q), pair(&self.rate), pair(&self.second)],
            unit(self.q[i + 2]),
            self.rate[i + 2],
            self.second[i + 2],
        );
        (motion, self.q[i + 2])
    }

    fn fill(&self, state: &mut State) {
        for link in 1..state.motions.len() {
            (state.motions[link], state.angles[link]) = self.motion(link);
        }
        for (index, joint) in self.case.mechanism.joints().iter().enumerate() {
            let multipliers = [self.lambda[2 * index], self.lambda[2 * index + 1]];
            (state.forces[index], state.moments[index]) = self.reaction(joint, multipliers);
        }
        for ((row, _), torque) in self.drives().zip(&mut state.torques) {
            *torque = self.lambda[row];
        }
    }

    /// The drives with their rows, which stand below those of the joints.
    fn drives(&self) -> impl Iterator<Item = (usize, &'a Drive)> + use<'a> {
        let first = EQUATIONS * self.case.mechanism.joints().len();
        self.case.drives().enumerate().map(move |(index, drive)| (first + index, drive))
    }

    fn lost(&self, why: &str) -> Error {
        let crank = (self.inputs[0].angle - self.case.drive.zero).to_degrees();
        Error::new(ErrorKind::Numeric, format!("crank angle {crank:.4} deg, t = {:.6} s: {why}", self.time))
            .help("shorten the grid to the crank angles that can be reached on this branch")
    }
}

/// A driving link as its law has it, with its angle in the world.
fn by_law(drive: &Drive, t: f64) -> DriveState {
    let state = drive.at(t);
    DriveState { angle: drive.world_angle(state.angle), ..state }
}
