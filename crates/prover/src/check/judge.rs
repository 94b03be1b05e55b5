//! Compares formulas with their claims along a trajectory.

use std::collections::BTreeMap;

use super::course::{Column, KnownTrajectory};
use super::judged::{JudgedFormula, Pair};
use formula::{FormulaGraph, NodeId, Program, Rounded};
use linkage::error::Result;
use scenario::{Claim, Formula, Formulas};

/// A claim and its derivatives along a trajectory.
/// The claim and its derivatives are functions of values of the whole mechanism, of the claim's channels, and of the
/// first and second derivatives of these channels.
pub(super) struct Claimed<'a> {
    program: Program,
    columns: Vec<Column<'a>>,
    /// First the values of the whole mechanism, then the values of the columns at the row that was evaluated last.
    inputs: Vec<Rounded>,
}

impl<'a> Claimed<'a> {
    /// Prepares a claim and its derivatives up to `orders`.
    ///
    /// # Errors
    /// If the course lacks a channel of the claim.
    pub(super) fn of(claim: &Claim, orders: usize, course: &'a KnownTrajectory) -> Result<Self> {
        let (mut graph, node) = graph_of(claim);
        let (numbers, count) = (claim.figures.len(), claim.channels.len());
        let changes = numbers..numbers + 2 * count;
        let rate = |input: usize| changes.contains(&input).then(|| graph.input(input + count));
        let rates: Vec<Option<NodeId>> = (0..numbers + 3 * count).map(rate).collect();
        let mut nodes = vec![node];
        for order in 0..orders {
            let next = graph.rate(nodes[order], &rates);
            nodes.push(next);
        }
        let columns = course.channels(claim, orders)?;
        let mut inputs = course.figures(claim)?;
        inputs.resize(numbers + columns.len(), Rounded::exact(0.0));
        Ok(Claimed { program: Program::of(&graph, &nodes), columns, inputs })
    }

    /// Evaluates the claim and its derivatives at a row.
    pub(super) fn at(&mut self, row: usize) -> &[Rounded] {
        let numbers = self.inputs.len() - self.columns.len();
        for (input, column) in self.inputs[numbers..].iter_mut().zip(&self.columns) {
            *input = column.at(row);
        }
        self.program.run(&self.inputs)
    }
}

/// Returns the values of the formula and of the mechanism at some rows of a course.
///
/// # Errors
/// If the course lacks a channel of the claim.
pub(super) fn pairs(
    formulas: &Formulas,
    (formula, claim): (&Formula, &Claim),
    course: &KnownTrajectory,
    rows: &[usize],
) -> Result<Vec<Pair>> {
    let mut claimed = Claimed::of(claim, 0, course)?;
    let mut own = Program::of(&formulas.graph, &[formula.id]);
    let mut at = |row: usize| Pair {
        place: [course.trajectory.times()[row], course.trajectory.inputs()[row]],
        input: course.trajectory.input(),
        formula: own.run(&course.inputs(row))[0],
        mechanism: claimed.at(row)[0],
    };
    Ok(rows.iter().map(|&row| at(row)).collect())
}

/// Graph of a claim over values of the whole mechanism, the claim's channels, and their first and second derivatives.
pub(super) fn graph_of(claim: &Claim) -> (FormulaGraph, NodeId) {
    let (figures, channels) = (claim.figures.iter().map(|(name, _)| name), claim.channels.iter().map(|(name, _)| name));
    let names: Vec<&str> = figures.chain(channels).map(String::as_str).collect();
    let mut graph = FormulaGraph::new(&names, 2 * claim.channels.len());
    let node = graph.add(&claim.tree).expect("a claim knows its channels");
    (graph, node)
}

/// A formula that is being judged, with its claim.
struct One<'a> {
    formula: &'a Formula,
    turn: Option<f64>,
    /// Index of the formula's claim among all claims.
    claimed: usize,
    /// Judgement by value, then by every derivative.
    judged: Vec<JudgedFormula>,
}

/// Number of derivatives by which a formula is judged.
fn orders(formula: &Formula, claim: &Claim, course: &KnownTrajectory) -> Result<usize> {
    // Three kinds of formulas are judged only by value, not by derivatives: approximations, formulas that are known to
    // be wrong, and formulas that are claimed at a single crank angle.
    let is_instant = formula.valid[0].is_some() && formula.valid[0] == formula.valid[1];
    let known = course.orders(claim)?;
    let is_value_only = formula.error.is_some() || formula.finding.is_some() || is_instant;
    Ok(if is_value_only { 0 } else { known })
}

/// Judges the claims of a scenario's formulas. A claim is left out if the trajectory lacks a channel of the claim.
/// Each claim is judged by value, then by every derivative.
/// A subexpression that several formulas share is evaluated once at every instant. A claim that several formulas make
/// is also evaluated once.
///
/// # Errors
/// No error occurs in practice, because claims whose channels or figures are missing are left out.
pub fn judge(formulas: &Formulas, course: &KnownTrajectory) -> Result<Vec<Vec<JudgedFormula>>> {
    let mut derived = formulas.clone();
    let (mut nodes, mut all) = (Vec::new(), Vec::new());
    let (mut claims, mut known) = (Vec::new(), BTreeMap::new());
    for (formula, claim) in formulas.claims() {
        let Ok(orders) = orders(formula, claim, course) else { continue };
        nodes.push(formula.id);
        for _ in 0..orders {
            let next = derived.rate(nodes[nodes.len() - 1]);
            nodes.push(next);
        }
        let claimed = match known.get(&(claim.text.as_str(), orders)) {
            Some(&claimed) => claimed,
            None => {
                claims.push(Claimed::of(claim, orders, course)?);
                known.insert((claim.text.as_str(), orders), claims.len() - 1);
                claims.len() - 1
            }
        };
        let judged = (0..=orders).map(|order| JudgedFormula::new((formula, claim), order)).collect();
        all.push(One { formula, turn: claim.turn(), claimed, judged });
    }
    // The scale is determined first, because the largest value of the claim decides how accurately a formula must be
    // known.
    for row in 0..course.len() {
        let crank = course.trajectory.inputs()[row];
        claims.iter_mut().for_each(|claim| {
            claim.at(row);
        });
        for One { judged, claimed, .. } in all.iter_mut().filter(|own| own.formula.holds_at(crank)) {
            let mechanism = &claims[*claimed].program.answers;
            judged.iter_mut().zip(mechanism).for_each(|(judged, mechanism)| judged.seen(*mechanism));
        }
    }
    let mut program = Program::of(&derived.graph, &nodes);
    for row in 0..course.len() {
        let place @ [_, crank] = [course.trajectory.times()[row], course.trajectory.inputs()[row]];
        claims.iter_mut().for_each(|claim| {
            claim.at(row);
        });
        let mut values = program.run(&course.inputs(row));
        for One { formula, turn, claimed, judged } in &mut all {
            let (own, rest) = values.split_at(judged.len());
            values = rest;
            if !formula.holds_at(crank) {
                continue;
            }
            let both = own.iter().zip(&claims[*claimed].program.answers);
            for (judged, (&formula_value, &mechanism)) in judged.iter_mut().zip(both) {
                let turn = turn.filter(|_| judged.order == 0);
                let input = course.trajectory.input();
                judged.put(formula, turn, Pair { place, input, formula: formula_value, mechanism });
            }
        }
    }
    Ok(all.into_iter().map(|own| own.judged).collect())
}

impl KnownTrajectory<'_> {
    /// Returns the values of every formula with a claim, at the instants at which the formula is claimed to hold.
    #[must_use]
    pub fn given(&self, formulas: &Formulas) -> Vec<Vec<Rounded>> {
        let nodes: Vec<NodeId> = formulas.claims().map(|(formula, _)| formula.id).collect();
        let mut program = Program::of(&formulas.graph, &nodes);
        let mut all = vec![Vec::new(); nodes.len()];
        for row in 0..self.len() {
            let values = program.run(&self.inputs(row));
            for ((own, value), (formula, _)) in all.iter_mut().zip(values).zip(formulas.claims()) {
                if formula.holds_at(self.trajectory.inputs()[row]) {
                    own.push(*value);
                }
            }
        }
        all
    }

    /// Returns the value of a formula at every instant; `None` at instants for which the formula is not claimed.
    #[must_use]
    pub fn formula(&self, formulas: &Formulas, formula: &Formula) -> Vec<Option<f64>> {
        let mut program = Program::of(&formulas.graph, &[formula.id]);
        let mut at = |row: usize| program.run(&self.inputs(row))[0].value;
        let holds = |row: usize| formula.holds_at(self.trajectory.inputs()[row]);
        (0..self.len()).map(|row| holds(row).then(|| at(row))).collect()
    }

    /// Returns the value that this trajectory gives for a claim at every instant, in the claim's unit. Each value has
    /// its error.
    ///
    /// # Errors
    /// If the trajectory lacks a channel of the claim.
    pub fn values(&self, claim: &Claim) -> Result<Vec<Rounded>> {
        let mut claimed = Claimed::of(claim, 0, self)?;
        Ok((0..self.len()).map(|row| claimed.at(row)[0]).collect())
    }
}
