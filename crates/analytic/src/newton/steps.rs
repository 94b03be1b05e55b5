//! Follows the branch in small rotations of the crank. Newton's method corrects a prediction of each pose.
//! Velocities, accelerations and multipliers are computed from the corrected pose.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use super::system::System;
use linkage::case::{Case, Grid};
use linkage::drive::{Drive, Wrench};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::{KeepNan, Motion};
use linkage::solver::State;
use linkage::trajectory::Stage;
use linkage::work::{self, Count};

/// Largest rotation of the crank between two poses (rad). A prediction over this step stays on the branch.
pub(super) const TRACKING_STEP: f64 = PI / 90.0;
/// Largest number of times a failing step is halved.
/// Near a dead point speeds grow without limit, and steps must shrink with the distance to the dead point.
pub(super) const HALVINGS: u32 = 40;
/// Largest accepted jump of a link's velocity over a step, divided by the largest velocity.
/// The jump is the change of the velocity, less the change that the link's acceleration explains.
/// If a step changes to another branch where two branches cross, the velocity jumps, even if the step is very small.
const VELOCITY_JUMP: f64 = 0.1;
/// A pose is singular if the ratio of a block's determinant to the largest possible determinant is below this value.
/// The largest possible determinant is the determinant of orthogonal columns with the lengths of the block's columns.
/// For a dyad the ratio is about a tenth of the sine of its transmission angle.
/// The error of angles is about the rounding error divided by this sine. Below the limit the sine itself is mostly
/// rounding error.
const SINGULAR: f64 = 1e-8;
/// Largest number of iterations. From a predicted pose, Newton's method converges in two or three iterations.
/// More iterations indicate an error.
const MAX_ITERATIONS: usize = 12;

impl System<'_> {
    /// Corrects the pose at t = 0 to rounding accuracy and fixes the branch at this pose.
    pub(super) fn settle(&mut self) -> Result<()> {
        self.correct()?;
        self.branch = self.jacobian.signs().collect();
        self.check_singular()?;
        self.differentiate();
        Ok(())
    }

    /// Follows the branch to time `t`, in small rotations of the crank.
    pub(super) fn go_to(&mut self, t: f64) -> Result<()> {
        self.skip_turns(t)?;
        self.follow_to(t)?;
        self.check_singular()?;
        if self.stage >= Stage::Reactions {
            self.find_loads(Case::loads_on);
            self.multipliers();
            if self.has_friction {
                self.rub(None)?;
            }
        }
        Ok(())
    }

    /// Follows the branch to time `t`; solves positions, velocities and accelerations.
    pub(super) fn follow_to(&mut self, t: f64) -> Result<()> {
        let size = self.case.mechanism.size();
        let turned = |drive: &Drive| {
            let way = match drive.constant_speed() {
                Some(_) => (drive.at(t).value - drive.at(self.time).value).abs(),
                // The drive may move forwards and back between the two times, so its path is bounded by the top speed.
                None => drive.top_speed().abs() * (t - self.time).abs(),
            };
            way / drive.input.span(size)
        };
        let turn = self.case.drives.iter().map(turned).fold(0.0, f64::larger);
        // Refuse too many turns. With a varying speed, `turn` is computed from the top speed and may be much larger
        // than the real angle. No other check limits `turn`.
        if !(turn <= 2.0 * Grid::MOST_TURNS * TAU) {
            let turns = turn / TAU;
            return Err(self.lost(&sentences::up_to_turns_on_the_way_to_are_too(&format_args!("{turns:.1e}"), &t)));
        }
        let parts = (turn / TRACKING_STEP).ceil().larger(1.0);
        let from = self.time;
        for part in 1..parts as usize {
            self.step_to(from + (t - from) * (part as f64 / parts), HALVINGS)?;
        }
        // The last part ends exactly at `t`, without rounding.
        self.step_to(t, HALVINGS)
    }

    /// Takes one step from a prediction. If the branch cannot be followed over this step, takes two steps of half the
    /// size instead.
    pub(super) fn step_to(&mut self, t: f64, halvings: u32) -> Result<()> {
        work::spend(work::PLACED * self.case.mechanism.links().len() as f64)?;
        let (from, dt) = (self.time, t - self.time);
        self.before.copy_from_slice(&self.q);
        self.rate_before.copy_from_slice(&self.rate);
        self.second_before.copy_from_slice(&self.second);
        for i in 0..self.q.len() {
            self.q[i] += dt * (self.rate[i] + 0.5 * dt * self.second[i]);
        }
        self.set_time(t);
        self.predicted.copy_from_slice(&self.q);
        let followed = self.correct().and_then(|()| self.check_branch(dt)).and_then(|()| {
            // Before velocities are compared, refuse a pose at which branches cross. At such a pose, velocities and
            // accelerations are mostly rounding error, and a check for jumps gives random results.
            self.check_singular()?;
            self.differentiate();
            self.check_velocities(dt)
        });
        match followed {
            Ok(()) => Ok(()),
            Err(error) if halvings == 0 => Err(error),
            Err(_) => {
                self.q.copy_from_slice(&self.before);
                self.rate.copy_from_slice(&self.rate_before);
                self.second.copy_from_slice(&self.second_before);
                self.set_time(from);
                self.step_to(from + dt / 2.0, halvings - 1)?;
                self.step_to(t, halvings - 1)
            }
        }
    }

    /// Corrects the pose in `q` by Newton's method, to rounding accuracy.
    /// The factored Jacobian belongs to the pose before the last correction, which differs from the result by rounding
    /// error.
    pub(super) fn correct(&mut self) -> Result<()> {
        self.tally.one(Count::Poses);
        let size = self.case.mechanism.size();
        let mut last = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            self.assemble();
            self.tally.one(Count::Iterations);
            self.tally.one(Count::Factorisations);
            if !self.jacobian.factor() {
                return Err(self.lost(sentences::THE_JACOBIAN_IS_SINGULAR_THERE));
            }
            self.jacobian.solve(&mut self.residual);
            let mut change: f64 = 0.0;
            for (i, step) in self.residual.iter().enumerate() {
                self.q[i] -= step;
                change = change.larger(step.abs() / if i % 3 == 2 { 1.0 } else { size });
            }
            // Convergence is quadratic: after a change below 1e-9, the next change is rounding error. One more step is
            // taken nevertheless.
            if change < 1e-14 || last.larger(change) < self.settled {
                return Ok(());
            }
            last = change;
        }
        Err(self.lost(sentences::NEWTON_METHOD_DOES_NOT_CONVERGE))
    }

    /// Computes the residuals of all constraints and their Jacobian at the pose in `q`.
    pub(super) fn assemble(&mut self) {
        self.jacobian.clear();
        let case = self.case;
        for (index, joint) in case.mechanism.joints().entries() {
            self.assemble_joint(index, joint);
        }
        for (index, transmission) in case.mechanism.transmissions().entries() {
            self.assemble_transmission(index, transmission);
        }
        let first = case.mechanism.row_of_drive(0);
        for (row, drive) in self.drives() {
            self.assemble_drive(row, drive, self.inputs[row - first].value);
        }
    }

    /// Computes velocities and accelerations from the factored Jacobian.
    pub(super) fn differentiate(&mut self) {
        self.tally.one(Count::Velocities);
        self.tally.one(Count::Accelerations);
        self.rate.fill(0.0);
        let case = self.case;
        let first = case.mechanism.row_of_drive(0);
        for (index, input) in self.inputs.iter().enumerate() {
            self.rate[first + index] = input.rate;
        }
        self.jacobian.solve(&mut self.rate);
        for (row, drive) in self.drives() {
            self.second[row] = self.drive_gamma(drive, self.inputs[row - first].acceleration);
        }
        for (index, joint) in case.mechanism.joints().entries() {
            self.put_gamma(index, joint);
        }
        for (index, transmission) in case.mechanism.transmissions().entries() {
            self.second[case.mechanism.row_of_transmission(index)] = self.transmission_gamma(transmission);
        }
        self.jacobian.solve(&mut self.second);
    }

    /// Computes motions and angles of all links from the coordinates, and calls `of` to find their loads.
    pub(super) fn find_loads(&mut self, of: impl FnOnce(&Case, &[Motion], &[f64], &mut [Wrench])) {
        if !self.case.loads.is_empty() || self.has_friction {
            for link in self.case.mechanism.links().ids().skip(1) {
                (self.motions[link], self.angles[link]) = self.motion(link);
            }
            of(self.case, &self.motions, &self.angles, &mut self.loads);
        }
    }

    /// Solves J^T lambda = M q'' - Q with the last computed loads.
    pub(super) fn multipliers(&mut self) {
        for (link, body) in self.case.mechanism.links().entries().skip(1) {
            let i = 3 * (link.index() - 1);
            let Wrench { force, moment } = self.loads[link];
            self.lambda[i] = body.mass * (self.second[i] - self.case.gravity.x) - force.x;
            self.lambda[i + 1] = body.mass * (self.second[i + 1] - self.case.gravity.y) - force.y;
            self.lambda[i + 2] = body.inertia * self.second[i + 2] - moment;
        }
        self.tally.one(Count::Forces);
        self.jacobian.solve_transposed(&mut self.lambda);
        self.change_lines();
    }

    /// Refuses a pose beyond a singular pose: every block must keep the sign of its determinant.
    pub(super) fn check_signs(&self) -> Result<()> {
        if !self.jacobian.signs().eq(self.branch.iter().copied()) {
            return Err(self.lost(sentences::THE_MECHANISM_HAS_PASSED_A_DEAD));
        }
        Ok(())
    }

    /// Refuses a singular pose.
    pub(super) fn check_singular(&self) -> Result<()> {
        // The comparison is negated so that NaN is refused too.
        if !(self.jacobian.smallest_share() > SINGULAR) {
            let error = self.lost(sentences::THE_POSE_IS_SINGULAR_THERE);
            return Err(error.or_help(way_through(self.case)));
        }
        Ok(())
    }

    /// Refuses a pose on another branch. A pose on another branch lies beyond a singular pose, or far from the
    /// prediction.
    pub(super) fn check_branch(&self, dt: f64) -> Result<()> {
        self.check_signs()?;
        // Positions are checked too: if the axes of two prismatic joints become parallel, a slider moves to infinity
        // and returns from the opposite side.
        let size = self.case.mechanism.size();
        for (index, rate) in self.rate.iter().enumerate() {
            let allowed = (dt * rate).abs() + if index % 3 == 2 { TRACKING_STEP } else { size };
            if !((self.q[index] - self.predicted[index]).abs() <= allowed) {
                return Err(self.lost(sentences::THE_SOLUTION_HAS_JUMPED_TO_ANOTHER));
            }
        }
        Ok(())
    }

    /// Refuses a step over which velocities jump. In such a step, the motion has changed to another branch at a change
    /// point.
    fn check_velocities(&self, dt: f64) -> Result<()> {
        let size = self.case.mechanism.size();
        let unit = |index: usize| if index % 3 == 2 { 1.0 } else { size };
        let rates = [&self.rate, &self.rate_before];
        let largest = rates.into_iter().flat_map(|rates| rates.iter().enumerate());
        let largest = largest.fold(0.0f64, |most, (index, rate)| most.larger(rate.abs() / unit(index)));
        for (index, rate) in self.rate.iter().enumerate() {
            let jump = rate - (self.rate_before[index] + 0.5 * dt * (self.second_before[index] + self.second[index]));
            if !(jump.abs() <= VELOCITY_JUMP * largest * unit(index)) {
                let error = self.lost(sentences::VELOCITIES_JUMP_THERE_CHANGE_POINT);
                return Err(error.or_help(way_through(self.case)));
            }
        }
        Ok(())
    }

    pub(super) fn fill(&self, state: &mut State) {
        for link in state.motions.ids().skip(1) {
            (state.motions[link], state.angles[link]) = self.motion(link);
        }
        for (index, joint) in self.case.mechanism.joints().entries() {
            (state.forces[index], state.moments[index]) = self.reaction(index, joint);
        }
        for (index, transmitted) in state.transmitted.entries_mut() {
            *transmitted = self.lambda[self.case.mechanism.row_of_transmission(index)];
        }
        for ((row, _), torque) in self.drives().zip(&mut state.torques) {
            *torque = self.lambda[row];
        }
    }

    pub(super) fn lost(&self, why: &str) -> Error {
        let (at, t) = (self.case.told(self.case.crank().from_coordinate(self.inputs[0].value)), self.time);
        // In a free motion the error contains no time, because only the integrator knows the time of the pose.
        if self.case.is_free() {
            return Error::new(ErrorKind::Numeric, format!("{at}: {why}"))
                .at_input(at)
                .help(sentences::LET_THE_GRID_END_BEFORE);
        }
        let message = format!("{at}, t = {t:.6} s: {why}");
        Error::new(ErrorKind::Numeric, message).at_time(t).at_input(at).help(Advice::ShortenGrid)
    }
}

/// Advice for passing a pose that may be a change point.
fn way_through(case: &Case) -> &'static str {
    match case.crank().passes() || !case.drives.further().is_empty() {
        // Either the case is already set to pass change points and has failed to pass this pose, or it has several
        // drives and cannot pass change points.
        true => sentences::LET_THE_GRID_END_BEFORE_IT,
        false => sentences::PASS_IT_WITH_THROUGH_SMOOTH,
    }
}
