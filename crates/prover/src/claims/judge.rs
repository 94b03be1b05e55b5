//! Formulas and what they claim, side by side over a course.

use std::collections::BTreeMap;

use super::course::{Column, KnownTrajectory};
use super::judged::{JudgedFormula, Pair};
use formula::{FormulaGraph, NodeId, Program, Rounded};
use linkage::error::Result;
use scenario::{Claim, Formula, Formulas};

/// A claim and its derivatives over a course: over its figures, its channels, their rates and the rates of those.
pub(super) struct Claimed<'a> {
    program: Program,
    columns: Vec<Column<'a>>,
    /// Figures, then what the columns hold at the last row.
    inputs: Vec<Rounded>,
}

impl<'a> Claimed<'a> {
    /// A claim by value and by some derivatives.
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

    /// What the side finds at a row, by value and then by every derivative.
    pub(super) fn at(&mut self, row: usize) -> &[Rounded] {
        let numbers = self.inputs.len() - self.columns.len();
        for (input, column) in self.inputs[numbers..].iter_mut().zip(&self.columns) {
            *input = column.at(row);
        }
        self.program.run(&self.inputs)
    }
}

/// Formula and mechanism by value at some rows of a course.
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
        place: [course.times()[row], course.cranks()[row]],
        formula: own.run(&course.inputs(row))[0],
        mechanism: claimed.at(row)[0],
    };
    Ok(rows.iter().map(|&row| at(row)).collect())
}

/// A claim over its figures, its channels, their rates, and the rates of those.
pub(super) fn graph_of(claim: &Claim) -> (FormulaGraph, NodeId) {
    let (figures, channels) = (claim.figures.iter().map(|(name, _)| name), claim.channels.iter().map(|(name, _)| name));
    let names: Vec<&str> = figures.chain(channels).map(String::as_str).collect();
    let mut graph = FormulaGraph::new(&names, 2 * claim.channels.len());
    let node = graph.add(&claim.tree).expect("a claim knows its channels");
    (graph, node)
}

/// A formula with its claim while it is judged.
struct One<'a> {
    formula: &'a Formula,
    turn: Option<f64>,
    /// Number of its claim among all.
    claimed: usize,
    /// By value, then by every derivative.
    judged: Vec<JudgedFormula>,
}

/// Number of derivatives that a formula is judged by.
fn orders(formula: &Formula, claim: &Claim, course: &KnownTrajectory) -> Result<usize> {
    // Neither an approximation nor a number for one instant says anything about derivatives.
    let is_instant = formula.valid[0].is_some() && formula.valid[0] == formula.valid[1];
    let known = course.orders(claim)?;
    Ok(if formula.error.is_some() || is_instant { 0 } else { known })
}

/// All claims of a scenario's formulas that a course has the channels for, each by value, then by every derivative.
/// What formulas share, and a claim that several make, is evaluated once at every instant.
///
/// # Errors
/// None but those of a course that changes between two calls.
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
    // How large its numbers are says how well a formula has to be known.
    for row in 0..course.len() {
        let crank = course.cranks()[row];
        claims.iter_mut().for_each(|claim| {
            claim.at(row);
        });
        for One { judged, claimed, .. } in all.iter_mut().filter(|own| own.formula.holds_at(crank)) {
            let mechanism = claims[*claimed].program.answers();
            judged.iter_mut().zip(mechanism).for_each(|(judged, mechanism)| judged.seen(*mechanism));
        }
    }
    let mut program = Program::of(&derived.graph, &nodes);
    for row in 0..course.len() {
        let place @ [_, crank] = [course.times()[row], course.cranks()[row]];
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
            let both = own.iter().zip(claims[*claimed].program.answers());
            for (judged, (&formula_value, &mechanism)) in judged.iter_mut().zip(both) {
                let turn = turn.filter(|_| judged.order == 0);
                judged.put(formula, turn, Pair { place, formula: formula_value, mechanism });
            }
        }
    }
    Ok(all.into_iter().map(|own| own.judged).collect())
}

impl KnownTrajectory<'_> {
    /// What the formulas that claim something give, each at the instants at which it holds.
    #[must_use]
    pub fn given(&self, formulas: &Formulas) -> Vec<Vec<Rounded>> {
        let nodes: Vec<NodeId> = formulas.claims().map(|(formula, _)| formula.id).collect();
        let mut program = Program::of(&formulas.graph, &nodes);
        let mut all = vec![Vec::new(); nodes.len()];
        for row in 0..self.len() {
            let values = program.run(&self.inputs(row));
            for ((own, value), (formula, _)) in all.iter_mut().zip(values).zip(formulas.claims()) {
                if formula.holds_at(self.cranks()[row]) {
                    own.push(*value);
                }
            }
        }
        all
    }

    /// What the side finds for a claim, instant by instant, in the claim's unit, with how well it is known.
    ///
    /// # Errors
    /// If the course lacks a channel of the claim.
    pub fn values(&self, claim: &Claim) -> Result<Vec<Rounded>> {
        let mut claimed = Claimed::of(claim, 0, self)?;
        Ok((0..self.len()).map(|row| claimed.at(row)[0]).collect())
    }
}
