//! The part of a graph on which the requested nodes depend, evaluated for many inputs.

use crate::graph::{FormulaGraph, Node, NodeId};
use crate::rounded::Rounded;

/// Formulas ready to be evaluated. Each common subexpression is stored once. Arguments precede the nodes that use
/// them.
/// Parts that do not depend on any input are evaluated beforehand.
#[derive(Clone, Debug)]
pub struct Program {
    /// Operations that depend on the inputs, each with the position of its value.
    steps: Vec<(usize, Node<usize>)>,
    /// Positions of the results of the requested nodes.
    results: Vec<usize>,
    values: Vec<Rounded>,
    /// The values of the last run.
    pub answers: Vec<Rounded>,
}

impl Program {
    /// The program that evaluates `nodes` of a graph.
    #[must_use]
    pub fn of(graph: &FormulaGraph, nodes: &[NodeId]) -> Self {
        let needed = graph.needed(nodes);
        let place_of = |id: NodeId| needed.binary_search(&id).expect("arguments are needed too");
        let (mut steps, mut values) = (Vec::new(), Vec::new());
        for &id in &needed {
            let node = graph.node(id).map(place_of);
            let constant = graph.constants[id.0 as usize];
            if constant.is_none() {
                steps.push((values.len(), node));
            }
            values.push(constant.unwrap_or(Rounded::UNDEFINED));
        }
        let results = nodes.iter().map(|&id| place_of(id)).collect();
        Program { steps, results, values, answers: vec![Rounded::exact(0.0); nodes.len()] }
    }

    /// The values of the nodes, in the order of the request. A missing input is NaN.
    pub fn run(&mut self, inputs: &[Rounded]) -> &[Rounded] {
        for &(place, node) in &self.steps {
            self.values[place] = node.value(inputs, |part| self.values[part]);
        }
        for (answer, &result) in self.answers.iter_mut().zip(&self.results) {
            *answer = self.values[result];
        }
        &self.answers
    }

    /// Number of operations per run.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether all results are independent of the inputs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }
}
