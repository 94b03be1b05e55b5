//! Friction in the joints of the engine's mechanism.
//!
//! A prescribed motion does not depend on friction, so friction only enters the reactions of a sample.
//! In a free motion, friction acts as a load in every step. The friction is computed from the accelerations of the
//! previous step. The resulting error is of first order, as is the error of the engine's step.
//! Reactions and friction are found together by Newton's method for the normal forces, with numerical derivatives.
//! If the method does not converge for the full friction, the friction is increased in steps from zero to its full
//! value.

use super::lines::Lines;
use super::newton_euler::NewtonEuler;
use super::window::Window;
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2};
use linkage::mechanism::LinkId;
use linkage::solver::State;

/// Largest number of Newton's steps.
const MOST: usize = 40;
/// The normal forces have converged if their residuals are below this fraction of the largest normal force.
const SETTLED: f64 = 1e-14;
/// A residual below this fraction of the largest normal force is rounding error if the residuals no longer decrease.
const ROUNDING: f64 = 1e-11;
/// Change of a normal force for the numerical derivatives, as a fraction of the largest normal force.
const PROBE: f64 = 1e-4;
/// Smallest step in which the friction is increased, as a fraction of the full friction.
const LEAST: f64 = 1e-3;

/// Computes the reactions of a known motion, with friction. The force of a transmission acts along the first or
/// the second line of action, depending on the sign of the force.
#[derive(Debug)]
pub(super) struct InverseDynamics {
    equations: NewtonEuler,
    lines: Option<Lines>,
    /// Assumed normal forces, from which the friction is computed.
    normals: Vec<f64>,
    /// Normal forces of the reactions that follow from the friction of `normals`.
    now: Vec<f64>,
    /// The same as `now`, but with one entry of `normals` changed, for the numerical derivatives.
    beside: Vec<f64>,
    /// The entries of `normals` before the friction was last increased.
    before: Vec<f64>,
    matrix: Lu,
    efforts: Vec<f64>,
    /// Loads without friction.
    given: Vec<Wrench>,
    /// Loads with friction.
    loads: Vec<Wrench>,
}

impl InverseDynamics {
    /// The equations of a case.
    pub(super) fn of(case: &Case) -> Self {
        let n = case.frictions().count();
        let zeros = || vec![0.0; n];
        InverseDynamics {
            equations: NewtonEuler::new(case),
            lines: Lines::of(case),
            normals: zeros(),
            now: zeros(),
            beside: zeros(),
            before: zeros(),
            matrix: Lu::new(n),
            efforts: zeros(),
            given: vec![Wrench::ZERO; case.mechanism.links().len()],
            loads: vec![Wrench::ZERO; case.mechanism.links().len()],
        }
    }

    /// Fills in the reactions of a state whose motion is known, under the given loads and the friction.
    /// Returns the friction of every joint on its second link (N m or N).
    /// `sense` returns the sense of the sliding of a joint: 1, -1, or a mean if the sense changes within a step.
    ///
    /// # Errors
    /// The errors of [`NewtonEuler::solve`]; [`ErrorKind::Numeric`] if the friction locks the mechanism.
    fn solve(&mut self, case: &Case, state: &mut State, t: f64, sense: &dyn Fn(usize) -> f64) -> Result<&[f64]> {
        self.normals.fill(0.0);
        let (mut share, mut part) = (0.0, 1.0);
        while share < 1.0 {
            self.before.copy_from_slice(&self.normals);
            let next = f64::smaller(share + part, 1.0);
            if self.find(case, state, t, &|k| next * sense(k))? {
                (share, part) = (next, 2.0 * part);
                continue;
            }
            self.normals.copy_from_slice(&self.before);
            part *= 0.5;
            if part < LEAST {
                let error = Error::new(ErrorKind::Numeric, sentences::friction_has_no_equilibrium(&t)).at_time(t);
                return Err(error.help(sentences::LOWER_A_COEFFICIENT_OF_FRICTION));
            }
        }
        Ok(&self.efforts)
    }

    /// Newton's method for the normal forces, starting from their present values. Returns whether the method has
    /// converged to normal forces that are not negative.
    fn find(&mut self, case: &Case, state: &mut State, t: f64, sense: &dyn Fn(usize) -> f64) -> Result<bool> {
        let (n, mut last) = (self.normals.len(), f64::INFINITY);
        for _ in 0..MOST {
            self.react(case, state, t, sense)?;
            read(case, state, sense, &mut self.now);
            let largest = self.now.iter().chain(&self.normals).fold(0.0f64, |most, own| most.larger(*own));
            let off =
                self.now.iter().zip(&self.normals).fold(0.0f64, |most, (now, own)| most.larger((now - own).abs()));
            if off <= SETTLED * largest || (off <= ROUNDING * largest && !(off < 0.5 * last)) {
                return Ok(self.normals.iter().all(|own| *own >= -ROUNDING * largest));
            }
            last = off;
            let more = PROBE * largest;
            self.matrix.clear();
            for i in 0..n {
                let own = self.normals[i];
                self.normals[i] += more;
                self.react(case, state, t, sense)?;
                self.normals[i] = own;
                read(case, state, sense, &mut self.beside);
                for j in 0..n {
                    self.matrix.add(j, i, (self.now[j] - self.beside[j]) / more + if i == j { 1.0 } else { 0.0 });
                }
            }
            if !self.matrix.factor() {
                return Ok(false);
            }
            self.now.iter_mut().zip(&self.normals).for_each(|(now, own)| *now -= own);
            self.matrix.solve(&mut self.now);
            self.normals.iter_mut().zip(&self.now).for_each(|(own, step)| *own += step);
        }
        Ok(false)
    }

    /// Finds the reactions for the present normal forces.
    fn react(&mut self, case: &Case, state: &mut State, t: f64, sense: &dyn Fn(usize) -> f64) -> Result<()> {
        for (k, friction) in case.frictions().enumerate() {
            self.efforts[k] = -sense(k) * friction.lever() * self.normals[k];
        }
        self.loads.copy_from_slice(&self.given);
        case.add_friction(&self.efforts, &state.motions, &mut self.loads);
        self.equations.solve_under(&self.loads, case, state, t)?;
        self.lines.as_mut().map_or(Ok(()), |lines| lines.change(case, state, t))
    }

    /// Fills in the reactions of a sample.
    ///
    /// # Errors
    /// The errors of [`InverseDynamics::solve`].
    pub(super) fn sample(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        if self.normals.is_empty() {
            self.equations.solve(case, state, t)?;
            return self.lines.as_mut().map_or(Ok(()), |lines| lines.change(case, state, t));
        }
        case.loads_on(&state.motions, &state.angles, &mut self.given);
        let senses = case.frictions().map(|own| own.rate(&state.motions));
        let senses: Vec<f64> = senses.map(|rate| if rate == 0.0 { 0.0 } else { rate.signum() }).collect();
        self.solve(case, state, t, &|k| senses[k]).map(|_| ())
    }
}

/// Writes the normal forces of a state's reactions.
fn read(case: &Case, state: &State, sense: &dyn Fn(usize) -> f64, normals: &mut [f64]) {
    for (k, (normal, friction)) in normals.iter_mut().zip(case.frictions()).enumerate() {
        *normal = friction.normal(friction.reaction(state.reactions()), sense(k));
    }
}

/// Friction as a load of a free motion.
#[derive(Debug)]
pub(super) struct Braking {
    dynamics: InverseDynamics,
    state: State,
    /// Accelerations of every link in the last step or trial step: x and y of the mass centre, angle.
    accelerations: Vec<[f64; 3]>,
    /// Rates of the joints with friction one step earlier; NaN before the first step.
    before: Vec<f64>,
    now: Vec<f64>,
    /// Mean rate of each joint with friction in a trial step from the start. The sign of this rate counts as the sense
    /// of sliding while the joint's rate is 0.
    pub(super) setting_off: Vec<f64>,
}

impl Braking {
    /// Friction of the joints of a case; `None` if no joint has friction.
    pub(super) fn of(case: &Case) -> Option<Self> {
        let n = case.frictions().count();
        (n > 0).then(|| Braking {
            dynamics: InverseDynamics::of(case),
            state: State::at_rest(case),
            accelerations: vec![[0.0; 3]; case.mechanism.links().len()],
            before: vec![f64::NAN; n],
            now: vec![f64::NAN; n],
            setting_off: vec![0.0; n],
        })
    }

    /// Adds the friction to the loads on all links. `state` is the state at the start of the next step, at the time `t`
    /// (s).
    ///
    /// # Errors
    /// The errors of [`InverseDynamics::solve`].
    pub(super) fn add(
        &mut self,
        case: &Case,
        window: &Window,
        state: &State,
        loads: &mut [Wrench],
        t: f64,
    ) -> Result<()> {
        let is_first = window.newest() == 0;
        for (k, friction) in case.frictions().enumerate() {
            self.before[k] = if is_first { f64::NAN } else { self.now[k] };
            self.now[k] = friction.rate(&state.motions);
        }
        if !is_first {
            for (link, own) in self.accelerations.iter_mut().enumerate().skip(1) {
                *own = window.newest_acceleration(LinkId(link));
            }
        }
        self.state.clone_from(state);
        for ((motion, body), [x, y, alpha]) in
            self.state.motions.iter_mut().zip(case.mechanism.links()).zip(&self.accelerations).skip(1)
        {
            let centre = body.mass_centre;
            let place = [motion.point(centre), motion.point_velocity(centre), Vec2::new(*x, *y)];
            *motion = Motion::of_point(centre, place, motion.direction, motion.omega, *alpha);
        }
        let (before, now, setting_off) = (&self.before, &self.now, &self.setting_off);
        // If a joint reverses within the step, its friction is the mean of the frictions before and after the reversal,
        // weighted by their durations.
        let sense = |k: usize| {
            if now[k] == 0.0 {
                return if setting_off[k] == 0.0 { 0.0 } else { setting_off[k].signum() };
            }
            let next = 2.0 * now[k] - before[k];
            let reversed = now[k] * next < 0.0;
            now[k].signum() * if reversed { (now[k] + next) / (now[k] - next) } else { 1.0 }
        };
        self.dynamics.given.copy_from_slice(loads);
        let efforts = self.dynamics.solve(case, &mut self.state, t, &sense)?;
        case.add_friction(efforts, &state.motions, loads);
        Ok(())
    }

    /// Stores the accelerations of a trial step from the start of the motion.
    /// Returns the largest change of an acceleration, divided by the largest acceleration.
    pub(super) fn guess(&mut self, case: &Case, mut of: impl FnMut(usize) -> [f64; 3]) -> f64 {
        let size = case.mechanism.size();
        let length = |own: [f64; 3]| Vec2::new(own[0], own[1]).norm().larger(own[2].abs() * size);
        let (mut change, mut all) = (0.0f64, 0.0f64);
        for (link, own) in self.accelerations.iter_mut().enumerate().skip(1) {
            let now = of(link);
            change = change.larger(length([0, 1, 2].map(|k| now[k] - own[k])));
            all = all.larger(length(now));
            *own = now;
        }
        if all > 0.0 { change / all } else { 0.0 }
    }
}
