//! The part of a graph that some of its nodes need, to be run for many inputs.

use crate::graph::{Graph, Id, Node};
use crate::rounded::Rounded;

/// Formulas ready to be evaluated: every common part once, in an order in which arguments come first. What no input
/// enters is evaluated beforehand.
#[derive(Clone, Debug)]
pub struct Program {
    /// What changes with the inputs, each with the place of its value.
    steps: Vec<(usize, Node)>,
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
        let place_of = |id: Id| Id(needed.binary_search(&id).expect("arguments are needed too") as u32);
        let (mut steps, mut values, mut varies) = (Vec::new(), Vec::new(), Vec::new());
        for &id in &needed {
            let node = graph.node(id);
            let at = place_of;
            let (node, is_varied) = match node {
                Node::Input(_) => (node, true),
                Node::Number(_) => (node, false),
                Node::Negative(part) => (Node::Negative(at(part)), varies[at(part).0 as usize]),
                Node::Pair(operator, left, right) => {
                    let (left, right) = (at(left), at(right));
                    (Node::Pair(operator, left, right), varies[left.0 as usize] || varies[right.0 as usize])
                }
                Node::Call(function, first, second) => {
                    let (first, second) = (at(first), at(second));
                    (Node::Call(function, first, second), varies[first.0 as usize] || varies[second.0 as usize])
                }
            };
            match is_varied {
                true => {
                    steps.push((values.len(), node));
                    values.push(Rounded::exact(f64::NAN));
                }
                false => values.push(value(node, &values, &[])),
            }
            varies.push(is_varied);
        }
        let results = nodes.iter().map(|id| place_of(*id).0 as usize).collect();
        Program { steps, results, values, answers: vec![Rounded::exact(0.0); nodes.len()] }
    }

    /// The values of the nodes, in the order in which they were asked for. An input that is not there is NaN.
    pub fn run(&mut self, inputs: &[Rounded]) -> &[Rounded] {
        for &(place, node) in &self.steps {
            self.values[place] = value(node, &self.values, inputs);
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

    /// Whether nothing changes with the inputs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }
}

#[inline]
fn value(node: Node, values: &[Rounded], inputs: &[Rounded]) -> Rounded {
    let at = |id: Id| values[id.0 as usize];
    match node {
        Node::Input(input) => inputs.get(input).copied().unwrap_or(Rounded::exact(f64::NAN)),
        Node::Number(number) => number,
        Node::Negative(part) => at(part).negative(),
        Node::Pair(operator, left, right) => Rounded::pair(operator, at(left), at(right)),
        Node::Call(function, first, second) => Rounded::call(function, [at(first), at(second)]),
    }
}
