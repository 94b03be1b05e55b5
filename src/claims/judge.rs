//! A formula and what it claims, side by side over a course.

use super::course::Course;
use super::judged::{Judged, Pair};
use crate::scenario::{Claim, Formula, Formulas};
use formula::{Graph, Id, Program, Rounded};
use linkage::error::Result;

/// A formula and its claim, ready to be judged: both with as many derivatives as the side has channels for.
pub struct Judge<'a> {
    formula: &'a Formula,
    claim: &'a Claim,
    /// The formula and its derivatives.
    own: Program,
    /// The claim and its derivatives, over its figures, its channels, their rates and the rates of those.
    claimed: Program,
    orders: usize,
}

impl<'a> Judge<'a> {
    /// Prepares the judgement of a formula by what a `course` has. Derivatives are added to `formulas`, where those of
    /// other formulas find what they share.
    ///
    /// # Errors
    /// If the course lacks a channel of the claim.
    pub fn new(formulas: &mut Formulas, formula: &'a Formula, claim: &'a Claim, course: &Course) -> Result<Self> {
        // Neither an approximation nor a number for one instant says anything about derivatives.
        let is_instant = formula.valid[0].is_some() && formula.valid[0] == formula.valid[1];
        let orders = if formula.error.is_some() || is_instant { 0 } else { course.orders(claim)? };
        if orders == 0 {
            return Ok(Judge::of_values(formulas, formula, claim));
        }
        let mut own = vec![formula.id];
        let (mut graph, node) = graph_of(claim);
        let (numbers, count) = (claim.figures.len(), claim.channels.len());
        let changes = numbers..numbers + 2 * count;
        let rate = |input: usize| changes.contains(&input).then(|| graph.input(input + count));
        let rates: Vec<Option<Id>> = (0..numbers + 3 * count).map(rate).collect();
        let mut claimed = vec![node];
        for order in 0..orders {
            let next = formulas.rate(own[order]);
            own.push(next);
            let next = graph.rate(claimed[order], &rates);
            claimed.push(next);
        }
        let (own, claimed) = (Program::of(&formulas.graph, &own), Program::of(&graph, &claimed));
        Ok(Judge { formula, claim, own, claimed, orders })
    }

    /// The same by value alone.
    pub(super) fn of_values(formulas: &Formulas, formula: &'a Formula, claim: &'a Claim) -> Self {
        let (graph, node) = graph_of(claim);
        let own = Program::of(&formulas.graph, &[formula.id]);
        Judge { formula, claim, own, claimed: Program::of(&graph, &[node]), orders: 0 }
    }

    /// The judgement by value, then by every derivative.
    ///
    /// # Errors
    /// If the course lacks a channel of the claim.
    pub fn by(&mut self, course: &Course) -> Result<Vec<Judged>> {
        let pairs = self.pairs(course, &course.rows(self.formula))?;
        let orders = self.orders + 1;
        let of = |order: usize| {
            let turn = self.claim.turn().filter(|_| order == 0);
            let course = pairs.iter().skip(order).step_by(orders).copied();
            Judged::of((self.formula, self.claim), order, turn, course)
        };
        Ok((0..orders).map(of).collect())
    }

    /// Formula and mechanism at some rows of the course, by value and then by every derivative.
    pub(super) fn pairs(&mut self, course: &Course, rows: &[usize]) -> Result<Vec<Pair>> {
        let channels = course.channels(self.claim, self.orders)?;
        let mut inputs = course.figures(self.claim)?;
        let numbers = inputs.len();
        inputs.resize(numbers + channels.len(), Rounded::exact(0.0));
        let mut pairs = Vec::with_capacity(rows.len() * (self.orders + 1));
        for &row in rows {
            for (input, channel) in inputs[numbers..].iter_mut().zip(&channels) {
                *input = channel.at(row);
            }
            let (formula, mechanism) = (self.own.run(&course.inputs(row)), self.claimed.run(&inputs));
            let place = [course.times()[row], course.cranks()[row]];
            let both = formula.iter().zip(mechanism);
            pairs.extend(both.map(|(&formula, &mechanism)| Pair { place, formula, mechanism }));
        }
        Ok(pairs)
    }
}

/// A claim over its figures, its channels, their rates, and the rates of those.
pub(super) fn graph_of(claim: &Claim) -> (Graph, Id) {
    let (figures, channels) = (claim.figures.iter().map(|(name, _)| name), claim.channels.iter().map(|(name, _)| name));
    let names: Vec<&str> = figures.chain(channels).map(String::as_str).collect();
    let mut graph = Graph::new(&names, 2 * claim.channels.len());
    let node = graph.add(&claim.tree).expect("a claim knows its channels");
    (graph, node)
}

/// All claims of a scenario's formulas that a course has the channels for.
///
/// # Errors
/// None but those of a course that changes between two calls.
pub fn judge(formulas: &Formulas, course: &Course) -> Result<Vec<Vec<Judged>>> {
    let mut derived = formulas.clone();
    let known = formulas.claims().filter(|(_, claim)| course.orders(claim).is_ok());
    known.map(|(formula, claim)| Judge::new(&mut derived, formula, claim, course)?.by(course)).collect()
}
