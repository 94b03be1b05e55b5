//! Finds the friction in the joints together with the reactions.
//!
//! The reactions R are linear in the normal forces p of the joints with friction: R = R0 + C p.
//! R0 are the reactions without friction.
//! Each normal force is a norm of its joint's reaction, so p is a solution of p = |R0 + C p|.
//! The equation is solved by iteration of p = |R0 + C p|. If the iteration converges slowly, Newton's method follows.
//! With L_ij = |C_ij|, the iteration is a contraction if the spectral radius of L is below 1.
//! By Banach's theorem, the equation then has exactly one solution.
//! If the iteration is not proven to be a contraction, Newton's method is tried from several start values.
//! If no solution is found, friction locks the mechanism; if two solutions are found, the forces are undetermined.
//! By Collatz and Wielandt, the spectral radius is at most the largest ratio (L v)_i / v_i, for any v > 0.

use crate::sentences;
use linkage::case::{Case, Friction, FrictionSeat};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2};
use linkage::solver::State;

/// Reaction of a joint: force (N) and moment (N m).
type Reaction = (Vec2, f64);

/// Largest number of linearisations. One linearisation is enough unless a transmission changes its line of action.
const ROUNDS: usize = 20;
/// The normal forces are settled if they change by less than this fraction of the largest normal force.
/// A smaller limit has no use, because the rounding errors of the reactions are larger than this fraction.
const SETTLED: f64 = 1e-14;
/// A change below this fraction of the largest normal force is rounding error if the changes no longer decrease.
const ROUNDING: f64 = 1e-10;
/// Largest number of steps of the iteration, and of Newton's method.
const MOST: usize = 60;
/// The iteration continues while each change is below this fraction of the previous change.
const QUICK: f64 = 0.3;
/// How many times a vector is multiplied by the matrix 1 + L.
/// Each multiplication gives an upper bound of the spectral radius of L.
const POWERS: usize = 8;
/// Two solutions are different if a normal force differs by more than this fraction of the sum of its two values.
const DIFFERENT: f64 = 1e-6;
/// Start values of the normal forces for Newton's method, as multiples of the largest normal force found so far.
const STARTS: [f64; 7] = [0.0, 0.1, 1.0, 3.0, 10.0, 100.0, 1e4];

/// Reason why there is no unique solution.
#[derive(Debug)]
enum Stuck {
    Locked,
    Several,
}

/// Solver for the normal forces of all joints with friction and for the losses of transmissions. The solver reuses its
/// memory for every pose.
#[derive(Clone, Debug)]
pub(crate) struct Dry {
    /// Sense of the motion of every joint with friction, then of every transmission with losses: +1, -1, or 0 at
    /// standstill.
    pub(crate) senses: Vec<f64>,
    /// Sense of sliding that is assumed for a joint at standstill: 0 for no friction.
    /// The sense differs from 0 only while the interval of the driving force is computed.
    pub(crate) at_rest: Vec<f64>,
    normals: Vec<f64>,
    /// Normal forces at which the reactions are linearised.
    at: Vec<f64>,
    next: Vec<f64>,
    efforts: Vec<f64>,
    base: Vec<Reaction>,
    /// Derivatives of all reactions with respect to the first normal force, then with respect to each further normal
    /// force.
    columns: Vec<Reaction>,
    matrix: Lu,
}

impl Dry {
    /// The solver for a case; `None` if no joint has friction and no transmission has losses.
    pub(crate) fn of(case: &Case) -> Option<Self> {
        let n = case.frictions().count();
        let zeros = || vec![0.0; n];
        (n > 0).then(|| Dry {
            senses: zeros(),
            at_rest: zeros(),
            normals: zeros(),
            at: zeros(),
            next: zeros(),
            efforts: zeros(),
            base: vec![(Vec2::zeros(), 0.0); n],
            columns: vec![(Vec2::zeros(), 0.0); n * n],
            matrix: Lu::new(n),
        })
    }

    /// Sets the senses of sliding from a motion.
    pub(crate) fn sense(&mut self, case: &Case, motions: &[Motion]) {
        for ((sense, at_rest), friction) in self.senses.iter_mut().zip(&self.at_rest).zip(case.frictions()) {
            let rate = friction.rate(motions);
            *sense = if rate == 0.0 { *at_rest } else { rate.signum() };
        }
    }

    /// Finds the reactions with friction.
    /// `react` receives the friction of each joint on its second link (N m or N) and writes the reactions to the state.
    /// The reactions must be linear in the friction while no transmission changes its line of action.
    ///
    /// # Errors
    /// The errors of `react`; [`ErrorKind::Numeric`] if the friction locks the mechanism, or if several states of the
    /// forces are in equilibrium.
    pub(crate) fn settle(
        &mut self,
        case: &Case,
        state: &mut State,
        react: &mut dyn FnMut(&[f64], &mut State) -> Result<()>,
    ) -> Result<()> {
        let mut last = f64::INFINITY;
        self.at.fill(0.0);
        for round in 0..ROUNDS {
            self.react(case, 0.0, 0, state, react)?;
            for (k, friction) in case.frictions().enumerate() {
                self.base[k] = friction.reaction(state.reactions());
                self.normals[k] = friction.normal(self.base[k], self.senses[k]);
            }
            let largest = self.normals.iter().chain(&self.at).fold(0.0f64, |most, own| most.larger(*own));
            let change = self.normals.iter().zip(&self.at).fold(0.0f64, |most, (a, b)| most.larger((a - b).abs()));
            let is_rounding = change <= ROUNDING * largest && !(change < 0.5 * last);
            if round > 0 && (change <= SETTLED * largest || is_rounding) {
                return Ok(());
            }
            last = change;
            let unit = if largest > 0.0 { largest } else { 1.0 };
            for i in 0..self.normals.len() {
                self.react(case, unit, i, state, react)?;
                for (j, friction) in case.frictions().enumerate() {
                    let ((force, moment), base) = (friction.reaction(state.reactions()), self.base[j]);
                    self.columns[i * self.normals.len() + j] = ((force - base.0) / unit, (moment - base.1) / unit);
                }
            }
            self.solve(case, unit).map_err(|why| stuck(case, state, &why))?;
            std::mem::swap(&mut self.at, &mut self.normals);
        }
        // In every one of the rounds, a transmission has changed its line of action, so no state of the forces is
        // found.
        Err(stuck(case, state, &Stuck::Locked))
    }

    /// Finds the reactions for the normal forces `self.at`; `more` (N) is added to the normal force number `index`.
    fn react(
        &mut self,
        case: &Case,
        more: f64,
        index: usize,
        state: &mut State,
        react: &mut dyn FnMut(&[f64], &mut State) -> Result<()>,
    ) -> Result<()> {
        for (k, friction) in case.frictions().enumerate() {
            let normal = self.at[k] + if k == index { more } else { 0.0 };
            self.efforts[k] = -self.senses[k] * friction.lever() * normal;
        }
        react(&self.efforts, state)
    }

    /// Reaction number `j` for the normal forces `normals`, by linearisation at `self.at`.
    fn linear(&self, normals: &[f64], j: usize) -> Reaction {
        let (mut force, mut moment) = self.base[j];
        for (i, (normal, at)) in normals.iter().zip(&self.at).enumerate() {
            let column = self.columns[i * normals.len() + j];
            force += column.0 * (normal - at);
            moment += column.1 * (normal - at);
        }
        (force, moment)
    }

    /// Solves the linearised equation for the normal forces. `unit` is the unit of the start values (N).
    fn solve(&mut self, case: &Case, unit: f64) -> std::result::Result<(), Stuck> {
        if self.contracts(case) {
            let mut start = std::mem::take(&mut self.normals);
            let is_found = self.iterate(case, &mut start) || self.newton(case, &mut start);
            self.normals = start;
            return if is_found { Ok(()) } else { Err(Stuck::Locked) };
        }
        let mut found: Option<Vec<f64>> = None;
        let n = self.normals.len();
        for size in STARTS {
            for only in 0..=n {
                let mut start: Vec<f64> =
                    (0..n).map(|k| if only == n || only == k { size * unit } else { 0.1 * size * unit }).collect();
                if !self.newton(case, &mut start) {
                    continue;
                }
                let differs = |own: &f64, other: &f64| (own - other).abs() > DIFFERENT * (own.abs() + other.abs());
                match &found {
                    Some(known) if known.iter().zip(&start).any(|(own, other)| differs(own, other)) => {
                        return Err(Stuck::Several);
                    }
                    Some(_) => {}
                    None => found = Some(start),
                }
            }
        }
        self.normals = found.ok_or(Stuck::Locked)?;
        Ok(())
    }

    /// Whether the iteration is proven to be a contraction.
    fn contracts(&mut self, case: &Case) -> bool {
        let n = self.normals.len();
        let (mut v, mut before) = (std::mem::take(&mut self.next), std::mem::take(&mut self.efforts));
        v.fill(1.0);
        let mut ratio = f64::INFINITY;
        for _ in 0..POWERS {
            let (mut most, mut sum) = (0.0f64, 0.0);
            before.copy_from_slice(&v);
            for (j, friction) in case.frictions().enumerate() {
                let of = |i: usize| friction.largest(self.columns[i * n + j]) * before[i];
                let own: f64 = (0..n).map(of).sum();
                most = most.larger(own / before[j]);
                // v + L v stays positive, even if L v has zeros.
                v[j] = before[j] + own;
                sum += v[j];
            }
            ratio = ratio.smaller(most);
            v.iter_mut().for_each(|own| *own *= n as f64 / sum);
        }
        (self.next, self.efforts) = (v, before);
        ratio < 1.0
    }

    /// Iterates from `start` while the changes decrease quickly. Returns whether the iteration has converged.
    fn iterate(&mut self, case: &Case, start: &mut [f64]) -> bool {
        let mut last = f64::INFINITY;
        for _ in 0..MOST {
            let (mut change, mut largest) = (0.0f64, 0.0f64);
            for (j, friction) in case.frictions().enumerate() {
                self.next[j] = friction.normal(self.linear(start, j), self.senses[j]);
                change = change.larger((self.next[j] - start[j]).abs());
                largest = largest.larger(self.next[j]);
            }
            start.copy_from_slice(&self.next);
            if change <= f64::EPSILON * largest {
                return true;
            }
            if !(change <= QUICK * last) {
                return false;
            }
            last = change;
        }
        false
    }

    /// Newton's method for p - |R0 + C p| = 0 from `start`. Returns whether the method has converged to a solution.
    fn newton(&mut self, case: &Case, start: &mut [f64]) -> bool {
        let (n, mut last) = (start.len(), f64::INFINITY);
        for _ in 0..MOST {
            self.matrix.clear();
            let mut largest = 0.0f64;
            for (j, friction) in case.frictions().enumerate() {
                let reaction = self.linear(start, j);
                let normal = friction.normal(reaction, self.senses[j]);
                self.next[j] = start[j] - normal;
                largest = largest.larger(normal).larger(start[j].abs());
                self.matrix.add(j, j, 1.0);
                for i in 0..n {
                    let column = self.columns[i * n + j];
                    self.matrix.add(j, i, -slope(&friction, reaction, column, self.senses[j]));
                }
            }
            if !self.matrix.factor() {
                return false;
            }
            self.matrix.solve(&mut self.next);
            let change = self.next.iter().fold(0.0f64, |most, own| most.larger(own.abs()));
            start.iter_mut().zip(&self.next).for_each(|(own, step)| *own -= step);
            let is_rounding = change <= ROUNDING * largest && !(change < 0.5 * last);
            if change <= 4.0 * f64::EPSILON * largest || is_rounding {
                return start.iter().all(|own| *own >= -ROUNDING * largest);
            }
            last = change;
        }
        false
    }
}

/// Derivative of [`Friction::normal`] at a reaction, in the direction of a change of the reaction.
fn slope(friction: &Friction, (force, moment): Reaction, change: Reaction, sense: f64) -> f64 {
    if let FrictionSeat::Mesh { losses, .. } = friction.seat {
        return losses.normal(force.x, sense)[1] * change.0.x;
    }
    let (size, guide) = (force.norm(), friction.guide());
    if guide > 0.0 && 2.0 * moment.abs() / guide > size {
        return 2.0 * moment.signum() * change.1 / guide;
    }
    if size > 0.0 { force.dot(&change.0) / size } else { change.0.norm() }
}

fn stuck(case: &Case, state: &State, why: &Stuck) -> Error {
    let at = case.told(case.input_in(&state.motions, &state.angles));
    let message = match why {
        Stuck::Locked => sentences::friction_locks_the_mechanism(&at),
        Stuck::Several => sentences::friction_allows_several_states(&at),
    };
    Error::new(ErrorKind::Numeric, message).at_input(at).help(sentences::LOWER_A_COEFFICIENT_OF_FRICTION)
}
