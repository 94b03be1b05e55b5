//! A wrong formula, and the effect of changes to it.

use super::judge;
use super::judged::{JudgedFormula, Pair};
use super::{FormulaOutcome, KnownTrajectory};
use formula::{DerivationSheet, FormulaTarget, FormulaTree, Program, Rounded};
use linkage::error::Result;
use linkage::math::KeepNan;
use scenario::formula::OMEGA;
use scenario::{Claim, Formula, Formulas, INPUTS, Parameter};

/// Number of instants at which every change is tried first, besides the instant with the largest error.
const FIRST: usize = 9;
/// Largest number of preceding steps that are kept although the formula does not use them. At most this number of
/// unused parameters is kept as well. The author may have omitted these steps or parameters by mistake.
const BESIDE: usize = 20;
/// Cost, in operations, of changing a tree and judging the change. The cost of evaluations comes in addition.
const TREE: u64 = 2000;
/// Cost, in operations, of adding a formula or a subexpression to a graph.
const ADDED: usize = 16;
/// Cost, in operations, of changing one subexpression. The cost of evaluations comes in addition.
const EDIT: u64 = 40;
/// A change is rejected if it leaves more than this fraction of the difference at any instant.
pub(super) const MOST_LEFT: f64 = 0.1;

/// A formula that contradicts the mechanism's values, prepared for trying changes.
pub(super) struct Trial<'a> {
    /// The formula and all formulas that it may use.
    pub(super) formulas: Formulas,
    /// Index of the formula in `formulas`.
    pub(super) index: usize,
    pub(super) formula: &'a Formula,
    claim: &'a Claim,
    /// Input values of the formulas at every instant. `pairs` holds the values of formula and mechanism.
    inputs: Vec<[Rounded; 4]>,
    pub(super) pairs: Vec<Pair>,
    /// Selected instants: some with equal spacing, and the instant with the largest error. In a long run, the equally
    /// spaced instants begin after the start, because many values are zero at the start.
    pub(super) few: Vec<usize>,
    /// The derivation, evaluated at the instants of `few`.
    pub(super) sheet: DerivationSheet,
    /// Correct value of the formula at each instant of `few`.
    pub(super) targets: Vec<FormulaTarget>,
    /// Indices into `few`, the instants with the largest error first.
    pub(super) order: Vec<usize>,
    /// The largest difference at the instants of `few`, limited to the mechanism's largest value at these instants.
    before: f64,
    /// Whether a factor or an offset makes the formula right.
    pub(super) is_number: bool,
    /// Limit of operations for the search.
    limit: u64,
}

impl<'a> Trial<'a> {
    /// Prepares a wrong formula for trying changes against the values of `course`.
    ///
    /// # Errors
    /// `course` lacks a channel of the claim.
    pub(super) fn of(
        formulas: &'a Formulas,
        index: usize,
        claim: &'a Claim,
        course: &KnownTrajectory,
        limit: u64,
    ) -> Result<Self> {
        let formula = &formulas.list[index];
        let rows = course.rows(formula);
        let mut pairs = judge::pairs(formulas, (formula, claim), course, &rows)?;
        // Instants at which the claimed quantity is undefined are left out. For example, a moment reduced to the crank
        // is undefined while the crank is at rest.
        let has_number = |pair: &Pair| pair.mechanism.value.is_finite() && pair.mechanism.error.is_finite();
        let kept = rows.iter().zip(&pairs).filter(|(_, pair)| has_number(pair));
        let inputs: Vec<[Rounded; 4]> = kept.map(|(&row, _)| course.inputs(row)).collect();
        pairs.retain(has_number);
        let (index_of_file, (formulas, index)) = (index, formulas.derivation(index, BESIDE));
        let step = pairs.len().div_ceil(FIRST).max(1);
        let mut own = Trial {
            sheet: DerivationSheet::new(&[], Vec::new()),
            formulas,
            index,
            formula,
            claim,
            few: (0..pairs.len()).skip(step / 2).step_by(step).collect(),
            inputs,
            pairs,
            targets: Vec::new(),
            order: Vec::new(),
            before: 0.0,
            is_number: false,
            limit,
        };
        let size = |place: usize| own.difference(own.pairs[place].formula.value, place).abs();
        let worse = |one: &usize, other: &usize| size(*one).total_cmp(&size(*other));
        let worst = (0..own.pairs.len()).filter(|place| size(*place).is_finite()).max_by(worse);
        let mut few = own.few.clone();
        few.extend(worst);
        few.sort_unstable();
        few.dedup();
        let mut order: Vec<usize> = (0..few.len()).collect();
        order.sort_by(|one, other| size(few[*other]).total_cmp(&size(few[*one])));
        // The largest difference is limited to the mechanism's largest value. If the difference were very large, almost
        // any change would leave only a small fraction of it.
        let largest = |of: &dyn Fn(usize) -> f64| few.iter().map(|&place| of(place)).fold(0.0, f64::larger);
        let numbers = largest(&|place| own.pairs[place].mechanism.value.abs());
        own.before = largest(&size).smaller(numbers);
        let target = |&place: &usize| FormulaTarget {
            value: own.pairs[place].mechanism.value,
            bound: own.bound(place),
            turn: own.claim.turn(),
        };
        let targets = few.iter().map(target).collect();
        (own.targets, own.order, own.few) = (targets, order, few);
        let instants = own.few.iter().map(|&place| own.inputs[place].to_vec()).collect();
        own.sheet = DerivationSheet::new(&[INPUTS[0], INPUTS[1], OMEGA], instants);
        for (name, number) in own.formulas.parameters.iter().flat_map(Parameter::names) {
            own.sheet.constant(name, number);
        }
        for step in &own.formulas.list {
            own.sheet.add(&step.name, &step.tree).expect("a formula knows what stands before it");
        }
        // The work includes the preparation: judging the formula, and searching the file for the formulas that it uses.
        let made = (16 * own.pairs.len() + 8 * index_of_file) as u64 + 8 * own.sheet.operations;
        own.sheet.operations += made;
        Ok(own)
    }

    /// Whether the search has reached its work limit.
    pub(super) fn is_spent(&self) -> bool {
        self.sheet.operations >= self.limit
    }

    /// Whether the mechanism's value is the same at all instants, or there is only one instant.
    pub(super) fn is_constant(&self) -> bool {
        is_one(self.pairs.iter().map(|pair| pair.mechanism))
    }

    /// Whether the formula has the same value at all instants.
    pub(super) fn gives_one_number(&self) -> bool {
        is_one(self.pairs.iter().map(|pair| pair.formula))
    }

    /// Formula minus mechanism; for angles, without whole revolutions.
    pub(super) fn difference(&self, formula: f64, place: usize) -> f64 {
        let difference = formula - self.pairs[place].mechanism.value;
        self.claim.turn().map_or(difference, |turn| difference - turn * (difference / turn).round())
    }

    /// Largest allowed difference between formula and mechanism at an instant.
    pub(super) fn bound(&self, place: usize) -> f64 {
        let Pair { formula, mechanism, .. } = self.pairs[place];
        formula.error + mechanism.error + self.formula.error.unwrap_or(0.0)
    }

    /// The inputs of formulas at one of the instants.
    pub(super) fn inputs(&self, place: usize) -> [Rounded; 4] {
        self.inputs[place]
    }

    /// Whether `changes` of subexpressions of the derivation are worth examining at all instants.
    /// At each instant of `few`, the changes must make the formula right or leave only a small part of the difference.
    /// `depending` lists the positions that depend on the changed positions.
    pub(super) fn is_promising(&mut self, changes: &[(usize, FormulaTree)], depending: &[usize]) -> bool {
        let claimed = self.formula.error.unwrap_or(0.0);
        self.sheet.operations += EDIT;
        (0..self.order.len()).all(|next| {
            let (instant, place) = (self.order[next], self.few[self.order[next]]);
            let found = self.sheet.changed(changes, depending, instant);
            let difference = self.targets[instant].difference(found.value).abs();
            difference <= found.error + self.pairs[place].mechanism.error + claimed
                || difference <= MOST_LEFT * self.before
        })
    }

    /// Whether the formula is right at every instant if the trees in `changed` replace the trees of the file. `slack`
    /// is added to the bound.
    pub(super) fn fits(&mut self, changed: &[(usize, FormulaTree)], slack: f64) -> bool {
        self.left(changed, slack) == Some(0.0)
    }

    /// Fraction of the difference that remains if the trees in `changed` replace the trees of the file.
    /// The fraction is zero if the formula is right at every instant.
    /// Otherwise, the fraction is the largest remaining difference divided by the largest difference before the change.
    /// `None` if the changed formula has no value.
    pub(super) fn left(&mut self, changed: &[(usize, FormulaTree)], slack: f64) -> Option<f64> {
        let Trial { formulas, index, formula, claim, inputs, pairs, few, .. } = self;
        let after = *index - changed.iter().map(|(own, _)| *own).min().unwrap_or(*index);
        let mut program = formulas.with_trees(changed, *index, |graph, id| Program::of(graph, &[id]))?;
        let mut judged = |places: &mut dyn Iterator<Item = usize>| {
            let mut at = |place: usize| {
                let mut pair = Pair { formula: program.run(&inputs[place])[0], ..pairs[place] };
                pair.mechanism.error += slack;
                pair
            };
            let pairs: Vec<Pair> = places.map(&mut at).collect();
            JudgedFormula::of((formula, claim), claim.turn(), pairs.into_iter())
        };
        let first = judged(&mut few.iter().copied());
        // If the formula is right at the few instants, it is judged at all instants. The few instants do not suffice,
        // because an instant with lost digits is not judged.
        let is_right = first.since.is_none() && judged(&mut (0..inputs.len())).outcome() == FormulaOutcome::Right;
        let rows = if first.since.is_none() { inputs.len() } else { few.len() };
        let work = (program.len() * (rows + ADDED) + after * ADDED) as u64 + TREE;
        self.sheet.operations += work;
        if is_right {
            return Some(0.0);
        }
        let left = first.worst.map(|worst| worst.difference.abs())? / self.before;
        left.is_finite().then_some(left.larger(f64::MIN_POSITIVE))
    }
}

/// Whether numbers are equal within their errors.
fn is_one(mut numbers: impl Iterator<Item = Rounded>) -> bool {
    let Some(first) = numbers.next() else { return true };
    numbers.all(|own| (own.value - first.value).abs() <= 4.0 * (own.error + first.error))
}
