//! The part of a graph that some of its nodes need, to be run for many inputs.

use crate::graph::{FormulaGraph, Node, NodeId};
use crate::rounded::Rounded;

/// Formulas ready to be evaluated: every common part once, in an order in which arguments come first. What no input
/// enters is evaluated beforehand.
#[derive(Clone, Debug)]
pub struct Program {
    /// What changes with the inputs, each with the place of its value.
    steps: Vec<(usize, Node<usize>)>,
    /// Where the results of the nodes asked for stand.
    results: Vec<usize>,
    values: Vec<Rounded>,
    answers: Vec<Rounded>,
}

impl Program {
    /// What `nodes` of a graph need.
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

    /// The values of the nodes, in the order in which they were asked for. An input that is not there is NaN.
    pub fn run(&mut self, inputs: &[Rounded]) -> &[Rounded] {
        for &(place, node) in &self.steps {
            self.values[place] = node.value(inputs, |part| self.values[part]);
        }
        for (answer, &result) in self.answers.iter_mut().zip(&self.results) {
            *answer = self.values[result];
        }
        &self.answers
    }

    /// The values of the last run.
    #[must_use]
    pub fn answers(&self) -> &[Rounded] {
        &self.answers
    }

    /// Number of operations of a run.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether nothing changes with the inputs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }
}
