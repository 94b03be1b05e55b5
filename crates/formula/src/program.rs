//! The part of a graph that some of its nodes need, to be run for many inputs.

use crate::graph::{Graph, Id, Node};
use crate::rounded::Rounded;

/// Formulas ready to be evaluated: every common part once, in an order in which arguments come first.
#[derive(Clone, Debug)]
pub struct Program {
    steps: Vec<Node>,
    /// Where the results of the nodes asked for stand.
    results: Vec<usize>,
    values: Vec<Rounded>,
    answers: Vec<Rounded>,
}

impl Program {
    /// What `nodes` of a graph need.
    #[must_use]
    pub fn of(graph: &Graph, nodes: &[Id]) -> Self {
        let needed = graph.needed(nodes);
        let mut place = vec![Id(0); graph.nodes.len()];
        let mut steps = Vec::new();
        for (index, &node) in graph.nodes.iter().enumerate().filter(|(index, _)| needed[*index]) {
            place[index] = Id(steps.len() as u32);
            let at = |id: Id| place[id.0 as usize];
            steps.push(match node {
                Node::Input(_) | Node::Number(_) => node,
                Node::Negative(part) => Node::Negative(at(part)),
                Node::Pair(operator, left, right) => Node::Pair(operator, at(left), at(right)),
                Node::Call(function, first, second) => Node::Call(function, at(first), at(second)),
            });
        }
        let results = nodes.iter().map(|id| place[id.0 as usize].0 as usize).collect();
        let values = vec![Rounded::exact(0.0); steps.len()];
        Program { steps, results, values, answers: vec![Rounded::exact(0.0); nodes.len()] }
    }

    /// The values of the nodes, in the order in which they were asked for. An input that is not there is NaN.
    pub fn run(&mut self, inputs: &[Rounded]) -> &[Rounded] {
        for (index, step) in self.steps.iter().enumerate() {
            let at = |id: Id| self.values[id.0 as usize];
            self.values[index] = match *step {
                Node::Input(input) => inputs.get(input).copied().unwrap_or(Rounded::exact(f64::NAN)),
                Node::Number(number) => number,
                Node::Negative(part) => at(part).negative(),
                Node::Pair(operator, left, right) => Rounded::pair(operator, at(left), at(right)),
                Node::Call(function, first, second) => Rounded::call(function, [at(first), at(second)]),
            };
        }
        for (answer, &result) in self.answers.iter_mut().zip(&self.results) {
            *answer = self.values[result];
        }
        &self.answers
    }

    /// Number of operations of a run.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether nothing was asked for.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }
}
