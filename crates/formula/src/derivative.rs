//! Derivatives by the rules of calculus.

use crate::graph::{FormulaGraph, Node, NodeId};
use crate::tree::Function;
use crate::tree::Operator::{Minus, Over, Plus, Power, Times};

impl FormulaGraph {
    /// The derivative of a node with respect to an input.
    pub fn derivative(&mut self, of: NodeId, input: usize) -> NodeId {
        // The nodes are visited in an order in which arguments precede the nodes that use them.
        // The derivatives of the arguments therefore exist before the derivative of the node itself.
        for id in self.needed_but(&[of], &|id| self.derivatives.contains_key(&(id, input))) {
            let found = self.rule(id, input);
            self.derivatives.insert((id, input), found);
        }
        self.derivatives[&(of, input)]
    }

    /// Rate of change of a node: the sum, over all inputs, of the partial derivative times the input's rate in `rates`.
    /// Inputs without a rate are constant.
    pub fn rate(&mut self, of: NodeId, rates: &[Option<NodeId>]) -> NodeId {
        let mut sum = self.whole(0.0);
        for (input, rate) in rates.iter().enumerate() {
            let Some(rate) = *rate else { continue };
            let partial = self.derivative(of, input);
            let part = self.pair(Times, partial, rate);
            sum = self.pair(Plus, sum, part);
        }
        sum
    }

    fn rule(&mut self, id: NodeId, input: usize) -> NodeId {
        let of = |graph: &FormulaGraph, part: NodeId| graph.derivatives[&(part, input)];
        match self.node(id) {
            Node::Input(index) => self.whole(if index == input { 1.0 } else { 0.0 }),
            Node::Number(_) => self.whole(0.0),
            Node::Negative(part) => {
                let inner = of(self, part);
                self.negative(inner)
            }
            Node::Pair(operator, left, right) => {
                let (a, b) = (of(self, left), of(self, right));
                match operator {
                    Plus | Minus => self.pair(operator, a, b),
                    Times => {
                        let (first, second) = (self.pair(Times, a, right), self.pair(Times, left, b));
                        self.pair(Plus, first, second)
                    }
                    // The derivative of l / r is (a - q b) / r, where a and b are the derivatives of l and r. The
                    // quotient q = l / r is the node itself, so it already exists.
                    Over => {
                        let taken = self.pair(Times, id, b);
                        let above = self.pair(Minus, a, taken);
                        self.pair(Over, above, right)
                    }
                    Power => self.power(id, [left, right], [a, b]),
                }
            }
            Node::Call(function, first, second) => {
                let (a, b) = (of(self, first), of(self, second));
                self.call_rule(id, function, [first, second], [a, b])
            }
        }
    }

    fn power(&mut self, id: NodeId, [base, exponent]: [NodeId; 2], [a, b]: [NodeId; 2]) -> NodeId {
        let (zero, one) = (self.whole(0.0), self.whole(1.0));
        let by_base = if a == zero {
            zero
        } else {
            let less = self.pair(Minus, exponent, one);
            let power = self.pair(Power, base, less);
            let factor = self.pair(Times, exponent, power);
            self.pair(Times, factor, a)
        };
        let by_exponent = if b == zero {
            zero
        } else {
            let logarithm = self.call(Function::Ln, base, base);
            let factor = self.pair(Times, id, logarithm);
            self.pair(Times, factor, b)
        };
        self.pair(Plus, by_base, by_exponent)
    }

    fn call_rule(&mut self, id: NodeId, function: Function, [x, other]: [NodeId; 2], [a, b]: [NodeId; 2]) -> NodeId {
        let (one, two) = (self.whole(1.0), self.whole(2.0));
        if a == self.whole(0.0) && (function.arity() == 1 || a == b) {
            return a;
        }
        match function {
            Function::Sin => {
                let slope = self.call(Function::Cos, x, x);
                self.pair(Times, slope, a)
            }
            Function::Cos => {
                let sine = self.call(Function::Sin, x, x);
                let slope = self.negative(sine);
                self.pair(Times, slope, a)
            }
            Function::Tan => {
                let square = self.pair(Power, id, two);
                let slope = self.pair(Plus, one, square);
                self.pair(Times, slope, a)
            }
            Function::Asin | Function::Acos => {
                // 1 - x^2 is written as the product (1 - x)(1 + x), so that no digits cancel near the ends of the
                // domain.
                let (less, more) = (self.pair(Minus, one, x), self.pair(Plus, one, x));
                let product = self.pair(Times, less, more);
                let root = self.call(Function::Sqrt, product, product);
                let slope = self.pair(Over, a, root);
                if function == Function::Asin { slope } else { self.negative(slope) }
            }
            Function::Atan => {
                let square = self.pair(Power, x, two);
                let below = self.pair(Plus, one, square);
                self.pair(Over, a, below)
            }
            Function::Atan2 => {
                let (y, x, dy, dx) = (x, other, a, b);
                let (first, second) = (self.pair(Times, x, dy), self.pair(Times, y, dx));
                let above = self.pair(Minus, first, second);
                let (squared_x, squared_y) = (self.pair(Power, x, two), self.pair(Power, y, two));
                let below = self.pair(Plus, squared_x, squared_y);
                self.pair(Over, above, below)
            }
            Function::Sqrt => {
                let twice = self.pair(Times, two, id);
                self.pair(Over, a, twice)
            }
            Function::Abs => {
                let (sign, smooth) = (self.call(Function::Sign, x, x), self.but_at_zero(x));
                let slope = self.put(Node::Pair(Plus, sign, smooth));
                self.pair(Times, slope, a)
            }
            Function::Exp => self.pair(Times, id, a),
            Function::Ln => self.pair(Over, a, x),
            Function::Sign => self.but_at_zero(x),
        }
    }

    /// A node that is zero, but undefined if `x` is zero.
    /// The node makes a derivative undefined at a kink or a jump at `x` = 0.
    fn but_at_zero(&mut self, x: NodeId) -> NodeId {
        let zero = self.whole(0.0);
        self.put(Node::Pair(Over, zero, x))
    }
}
