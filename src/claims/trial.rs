//! A wrong formula, and what a change of it would make of it.

use super::judge::Judge;
use super::judged::{Judged, Pair};
use super::{Course, Outcome};
use crate::scenario::{Claim, Formula, Formulas};
use formula::{Program, Rounded, Tree};
use linkage::error::Result;
use linkage::math::KeepNan;

/// Instants at which every change is tried first.
const FIRST: usize = 9;

/// A formula that a course contradicts, ready for changes to be tried.
pub(super) struct Trial<'a> {
    pub(super) formulas: Formulas,
    /// Its index in the list of formulas.
    pub(super) index: usize,
    pub(super) formula: &'a Formula,
    claim: &'a Claim,
    /// Inputs of the formulas, formula and mechanism at every instant.
    inputs: Vec<[Rounded; 4]>,
    pub(super) pairs: Vec<Pair>,
    /// Some of the instants, neither the first nor the last alone: much is zero there.
    pub(super) few: Vec<usize>,
}

impl<'a> Trial<'a> {
    /// A formula and its claim on a course.
    ///
    /// # Errors
    /// If the course lacks a channel of the claim.
    pub(super) fn of(formulas: &'a Formulas, index: usize, claim: &'a Claim, course: &Course) -> Result<Self> {
        let formula = &formulas.list[index];
        let rows = course.rows(formula);
        let pairs = Judge::of_values(formulas, formula, claim).pairs(course, &rows)?;
        let inputs = rows.iter().map(|&row| course.inputs(row)).collect();
        let step = rows.len().div_ceil(FIRST).max(1);
        let few = (0..rows.len()).skip(step / 2).step_by(step).collect();
        Ok(Trial { formulas: formulas.clone(), index, formula, claim, inputs, pairs, few })
    }

    /// Formula less mechanism, for angles without whole turns.
    pub(super) fn difference(&self, formula: f64, place: usize) -> f64 {
        let difference = formula - self.pairs[place].mechanism.value;
        self.claim.turn().map_or(difference, |turn| difference - turn * (difference / turn).round())
    }

    /// How far formula and mechanism may be apart at an instant.
    pub(super) fn bound(&self, place: usize) -> f64 {
        let Pair { formula, mechanism, .. } = self.pairs[place];
        formula.error + mechanism.error + self.formula.error.unwrap_or(0.0)
    }

    /// The inputs at an instant and a number that is looked for.
    pub(super) fn inputs(&self, place: usize, unknown: f64) -> [Rounded; 5] {
        let [phi, t, omega, alpha] = self.inputs[place];
        [phi, t, omega, alpha, Rounded::exact(unknown)]
    }

    /// Whether the formula is right at every instant with these trees in place of those of the file; `slack` more
    /// than its bound is allowed.
    pub(super) fn fits(&mut self, changed: &[(usize, Tree)], slack: f64) -> bool {
        self.left(changed, slack) == Some(0.0)
    }

    /// What such a change leaves of the difference: zero if the formula is right at every instant, else the largest
    /// difference at some of them over the largest that there was. `None` if it has no value.
    pub(super) fn left(&mut self, changed: &[(usize, Tree)], slack: f64) -> Option<f64> {
        let Trial { formulas, index, formula, claim, inputs, pairs, few } = self;
        let mut program = formulas.with_trees(changed, *index, |graph, id| Program::of(graph, &[id]))?;
        let mut judged = |places: &mut dyn Iterator<Item = usize>| {
            let mut at = |place: usize| {
                let mut pair = Pair { formula: program.run(&inputs[place])[0], ..pairs[place] };
                pair.mechanism.error += slack;
                pair
            };
            let pairs: Vec<Pair> = places.map(&mut at).collect();
            Judged::of((formula, claim), 0, claim.turn(), pairs.into_iter())
        };
        let first = judged(&mut few.iter().copied());
        // Where digits cancel, the few instants alone decide nothing.
        if first.since.is_none() && judged(&mut (0..inputs.len())).outcome() == Outcome::Right {
            return Some(0.0);
        }
        let largest = first.worst.map(|worst| worst.difference.abs())?;
        let before = self.few.iter().map(|&place| self.difference(self.pairs[place].formula.value, place).abs());
        let left = largest / before.fold(0.0, f64::larger);
        left.is_finite().then_some(left.larger(f64::MIN_POSITIVE))
    }
}
