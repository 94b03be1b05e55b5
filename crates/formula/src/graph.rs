//! Formulas as a graph in which each common subexpression occurs only once.

use crate::sentences;
use std::collections::{BTreeMap, BTreeSet};

use crate::domain::undefined;
use crate::rounded::Rounded;
use crate::tree::{FormulaFault, FormulaTree, Function, NodeShape, Operator};

/// A node of a [`FormulaGraph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(crate) u32);

/// Operation of a node. The arguments of the operation are stored before the node.
/// `P` is the type of a reference to an argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Node<P = NodeId> {
    Input(usize),
    Number(Rounded),
    Negative(P),
    Pair(Operator, P, P),
    Call(Function, P, P),
}

impl<P: Copy> Node<P> {
    /// The operation of this node, with each reference to an argument changed by `to`.
    pub(crate) fn map<Q>(self, to: impl Fn(P) -> Q) -> Node<Q> {
        match self {
            Node::Input(input) => Node::Input(input),
            Node::Number(number) => Node::Number(number),
            Node::Negative(part) => Node::Negative(to(part)),
            Node::Pair(operator, left, right) => Node::Pair(operator, to(left), to(right)),
            Node::Call(function, first, second) => Node::Call(function, to(first), to(second)),
        }
    }

    /// References to the arguments. If there is only one argument, its reference is given twice.
    pub(crate) fn parts(self) -> Option<[P; 2]> {
        match self {
            Node::Input(_) | Node::Number(_) => None,
            Node::Negative(part) => Some([part; 2]),
            Node::Pair(_, left, right) | Node::Call(_, left, right) => Some([left, right]),
        }
    }

    /// Value of the node. `at` gives the values of the node's arguments. A missing input is undefined.
    #[inline]
    pub(crate) fn value(self, inputs: &[Rounded], at: impl Fn(P) -> Rounded) -> Rounded {
        match self {
            Node::Input(input) => inputs.get(input).copied().unwrap_or(Rounded::UNDEFINED),
            Node::Number(number) => number,
            Node::Negative(part) => at(part).negative(),
            Node::Pair(operator, left, right) => Rounded::pair(operator, at(left), at(right)),
            Node::Call(function, first, second) => Rounded::call(function, [at(first), at(second)]),
        }
    }
}

/// A node as a key. The key contains the bits of the node's numbers.
type Key = (u8, u64, u64, u64);

fn key(node: Node) -> Key {
    match node {
        Node::Input(index) => (0, index as u64, 0, 0),
        Node::Number(number) => (1, number.value.to_bits(), number.error.to_bits(), 0),
        Node::Negative(part) => (2, part.0.into(), 0, 0),
        Node::Pair(operator, left, right) => (3, operator as u64, left.0.into(), right.0.into()),
        Node::Call(function, first, second) => (4, function as u64, first.0.into(), second.0.into()),
    }
}

/// Formulas over common inputs.
#[derive(Clone, Debug, Default)]
pub struct FormulaGraph {
    pub(crate) nodes: Vec<Node>,
    /// Values of the nodes that do not depend on inputs.
    pub(crate) constants: Vec<Option<Rounded>>,
    known: BTreeMap<Key, NodeId>,
    names: BTreeMap<String, NodeId>,
    pub(crate) derivatives: BTreeMap<(NodeId, usize), NodeId>,
    inputs: usize,
    /// Names that were assigned during `meanwhile`, with their previous nodes.
    renamed: Vec<(String, Option<NodeId>)>,
    is_meanwhile: bool,
}

impl FormulaGraph {
    /// A graph with the constant `pi`, the named inputs `inputs`, and `unnamed` further inputs that have no name.
    #[must_use]
    pub fn new(inputs: &[&str], unnamed: usize) -> Self {
        let mut graph = FormulaGraph { inputs: inputs.len() + unnamed, ..FormulaGraph::default() };
        for (index, name) in inputs.iter().enumerate() {
            let id = graph.put(Node::Input(index));
            graph.name(name, id);
        }
        for index in 0..unnamed {
            graph.put(Node::Input(inputs.len() + index));
        }
        let pi = graph.put(Node::Number(Rounded::nearly(std::f64::consts::PI)));
        graph.name("pi", pi);
        graph
    }

    /// The node of an input.
    ///
    /// # Panics
    /// If there is no input with this index.
    #[must_use]
    pub fn input(&self, index: usize) -> NodeId {
        assert!(index < self.inputs, "there are {} inputs", self.inputs);
        // The inputs were added first, so the index of an input is also the number of its node.
        NodeId(index as u32)
    }

    /// Gives a node a name that later formulas may use.
    pub fn name(&mut self, name: &str, id: NodeId) {
        let before = self.names.insert(name.into(), id);
        if self.is_meanwhile {
            self.renamed.push((name.into(), before));
        }
    }

    /// A constant, with its error.
    pub fn constant(&mut self, number: Rounded) -> NodeId {
        self.put(Node::Number(number))
    }

    /// Whether a name is known.
    #[must_use]
    pub fn knows(&self, name: &str) -> bool {
        self.names.contains_key(name)
    }

    /// The names that formulas may use, in alphabetical order.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        self.names.keys().map(String::as_str).collect()
    }

    /// Adds a formula.
    ///
    /// # Errors
    /// An unknown name, with its position.
    pub fn add(&mut self, tree: &FormulaTree) -> Result<NodeId, FormulaFault> {
        self.added(tree, false)
    }

    /// Adds a formula that must have a value.
    ///
    /// # Errors
    /// The errors of [`FormulaGraph::add`].
    /// An operation on constants outside its domain is an error too; the error gives the position of the operation.
    pub fn add_defined(&mut self, tree: &FormulaTree) -> Result<NodeId, FormulaFault> {
        self.added(tree, true)
    }

    fn added(&mut self, tree: &FormulaTree, must_be_defined: bool) -> Result<NodeId, FormulaFault> {
        let mut lower: Option<NodeId> = None;
        for tree in tree.left_parts().into_iter().rev() {
            let parts = match lower {
                Some(left) => [Some(left), Some(self.added(&tree.parts()[1], must_be_defined)?)],
                None => self.parts(tree, must_be_defined)?,
            };
            let id = self.operation(tree, parts)?;
            if must_be_defined && self.constant_of(id).is_some_and(Rounded::is_undefined) {
                let arguments = parts.map(|part| part.and_then(|part| self.constant_of(part)));
                return Err(undefined(tree, &arguments.map(|number| number.unwrap_or(Rounded::UNDEFINED))));
            }
            lower = Some(id);
        }
        Ok(lower.expect("a tree is one of its parts"))
    }

    /// The nodes of the arguments of a tree. If there is only one argument, its node is given twice.
    fn parts(&mut self, tree: &FormulaTree, must_be_defined: bool) -> Result<[Option<NodeId>; 2], FormulaFault> {
        let mut part = |index: usize| tree.parts().get(index).map(|part| self.added(part, must_be_defined)).transpose();
        let first = part(0)?;
        Ok([first, part(1)?.or(first)])
    }

    /// The node of an operation on these arguments.
    fn operation(&mut self, tree: &FormulaTree, parts: [Option<NodeId>; 2]) -> Result<NodeId, FormulaFault> {
        Ok(match (&tree.shape, parts) {
            (NodeShape::Number(number), _) => self.put(Node::Number(Rounded::decimal(*number))),
            (NodeShape::Negative(_), [Some(part), _]) => self.negative(part),
            (NodeShape::Pair(operator, _), [Some(left), Some(right)]) => {
                match (operator, self.exact(left), self.exact(right)) {
                    // A node minus itself is exactly zero, even if the node has an error. If the node is undefined, the
                    // difference is undefined too.
                    // The difference is therefore stored as 0 times the node.
                    (Operator::Minus, ..) if left == right => {
                        let zero = self.whole(0.0);
                        self.put(Node::Pair(Operator::Times, zero, left))
                    }
                    // An operation with zero is not simplified, because its other argument may be outside a domain.
                    // Simplification would lose the domain error.
                    (Operator::Times | Operator::Over, Some(0.0), _)
                    | (Operator::Times | Operator::Power, _, Some(0.0)) => self.put(Node::Pair(*operator, left, right)),
                    _ => self.pair(*operator, left, right),
                }
            }
            (NodeShape::Call(function, _), [Some(first), Some(second)]) => self.call(*function, first, second),
            (NodeShape::Name(name), _) => self.named(name, tree)?,
            (NodeShape::Negative(_) | NodeShape::Pair(..) | NodeShape::Call(..), _) => unreachable!("they have parts"),
        })
    }

    /// The value of a node; `None` if the node depends on an input.
    #[must_use]
    pub fn constant_of(&self, id: NodeId) -> Option<Rounded> {
        self.constants[id.0 as usize]
    }

    fn named(&self, name: &str, tree: &FormulaTree) -> Result<NodeId, FormulaFault> {
        self.names.get(name).copied().ok_or_else(|| {
            let help = sentences::known_are(&self.names().join(", "));
            FormulaFault::new(sentences::there_is_no(&name), tree.at.clone(), help)
        })
    }

    pub(crate) fn node(&self, id: NodeId) -> Node {
        self.nodes[id.0 as usize]
    }

    /// The given nodes and all nodes on which they depend, arguments first.
    /// Only these nodes are visited, even in a large graph.
    pub(crate) fn needed(&self, nodes: &[NodeId]) -> Vec<NodeId> {
        self.needed_but(nodes, &|_| false)
    }

    /// The given nodes and all nodes on which they depend, arguments first.
    /// A node for which `is_done` is true is left out, and so are its arguments, unless another node needs them.
    /// A common subexpression of several formulas is visited once.
    pub(crate) fn needed_but(&self, nodes: &[NodeId], is_done: &dyn Fn(NodeId) -> bool) -> Vec<NodeId> {
        let mut needed: BTreeSet<NodeId> = nodes.iter().copied().filter(|id| !is_done(*id)).collect();
        let mut next: Vec<NodeId> = needed.iter().copied().collect();
        while let Some(id) = next.pop() {
            let Some(parts) = self.node(id).parts() else { continue };
            next.extend(parts.into_iter().filter(|part| !is_done(*part) && needed.insert(*part)));
        }
        // The set is sorted by node number, so arguments precede the nodes that use them.
        needed.into_iter().collect()
    }

    /// Lets `then` add nodes and names to the graph. Afterwards the added nodes and names are removed.
    pub fn meanwhile<T>(&mut self, then: impl FnOnce(&mut FormulaGraph) -> T) -> T {
        let (nodes, derivatives) = (self.nodes.len(), self.derivatives.len());
        self.is_meanwhile = true;
        let result = then(self);
        for node in self.nodes.drain(nodes..) {
            self.known.remove(&key(node));
        }
        self.constants.truncate(nodes);
        for (name, id) in self.renamed.drain(..).rev() {
            match id {
                Some(id) => self.names.insert(name, id),
                None => self.names.remove(&name),
            };
        }
        self.is_meanwhile = false;
        if self.derivatives.len() > derivatives {
            let is_kept = |id: &NodeId| (id.0 as usize) < nodes;
            self.derivatives.retain(|(of, _), id| is_kept(of) && is_kept(id));
        }
        result
    }

    pub(crate) fn put(&mut self, node: Node) -> NodeId {
        let next = NodeId(u32::try_from(self.nodes.len()).expect("formulas are bounded in length"));
        let id = *self.known.entry(key(node)).or_insert(next);
        if id == next {
            self.nodes.push(node);
            self.constants.push(self.folded(node));
        }
        id
    }

    fn folded(&self, node: Node) -> Option<Rounded> {
        let is_known = node.parts().is_none_or(|parts| parts.iter().all(|&part| self.constant_of(part).is_some()));
        let of = |part| self.constant_of(part).unwrap_or(Rounded::UNDEFINED);
        (is_known && !matches!(node, Node::Input(_))).then(|| node.value(&[], of))
    }

    fn exact(&self, id: NodeId) -> Option<f64> {
        let is_exact = |number: &Rounded| matches!(self.node(id), Node::Number(_)) && number.error == 0.0;
        self.constant_of(id).filter(is_exact).map(|number| number.value)
    }

    pub(crate) fn whole(&mut self, value: f64) -> NodeId {
        self.put(Node::Number(Rounded::exact(value)))
    }

    pub(crate) fn negative(&mut self, part: NodeId) -> NodeId {
        match self.node(part) {
            Node::Number(number) => self.put(Node::Number(number.negative())),
            Node::Negative(inner) => inner,
            Node::Input(_) | Node::Pair(..) | Node::Call(..) => self.put(Node::Negative(part)),
        }
    }

    /// The node of an operator on two operands, simplified if an operand is zero or one.
    /// Derivatives produce many zeros and ones.
    /// Where a derivative drops a factor, no domain error is lost: the factor comes from the formula that is
    /// differentiated, and its domain is checked there.
    pub(crate) fn pair(&mut self, operator: Operator, left: NodeId, right: NodeId) -> NodeId {
        let (a, b) = (self.exact(left), self.exact(right));
        match (operator, a, b) {
            (Operator::Plus, Some(0.0), _) | (Operator::Times, Some(1.0), _) => right,
            (Operator::Minus, Some(0.0), _) => self.negative(right),
            (Operator::Plus | Operator::Minus, _, Some(0.0)) => left,
            (Operator::Times | Operator::Over | Operator::Power, _, Some(1.0)) => left,
            (Operator::Times, Some(0.0), _) | (Operator::Times, _, Some(0.0)) => self.whole(0.0),
            (Operator::Over, Some(0.0), other) if other != Some(0.0) => self.whole(0.0),
            (Operator::Power, _, Some(0.0)) => self.whole(1.0),
            (_, Some(a), Some(b)) => {
                let both = Rounded::pair(operator, Rounded::exact(a), Rounded::exact(b));
                if both.value.fract() == 0.0 && both.value.abs() < 9e15 && both.error.is_finite() {
                    self.whole(both.value)
                } else {
                    self.put(Node::Pair(operator, left, right))
                }
            }
            _ => self.put(Node::Pair(operator, left, right)),
        }
    }

    pub(crate) fn call(&mut self, function: Function, first: NodeId, second: NodeId) -> NodeId {
        self.put(Node::Call(function, first, second))
    }
}
