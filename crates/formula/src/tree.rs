//! The syntax tree of a formula, the table of all functions, and the faults in a formula's text with their positions.

use std::fmt;
use std::ops::Range;

/// An operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operator {
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Times,
    /// `/`
    Over,
    /// `^`
    Power,
}

impl Operator {
    /// Sign in formulas.
    #[must_use]
    pub const fn sign(self) -> char {
        match self {
            Operator::Plus => '+',
            Operator::Minus => '-',
            Operator::Times => '*',
            Operator::Over => '/',
            Operator::Power => '^',
        }
    }

    /// Precedence: an operator with a larger number binds tighter.
    pub(crate) const fn rank(self) -> u8 {
        match self {
            Operator::Plus | Operator::Minus => 1,
            Operator::Times | Operator::Over => 2,
            Operator::Power => 4,
        }
    }
}

/// Precedence of a minus sign before an operand: -x^2 is -(x^2), -x*y is (-x)*y.
const NEGATION: u8 = 3;
/// Precedence of a number, a name or a call.
const WHOLE: u8 = 5;

/// Kind of a node in a formula's expression tree.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeShape {
    /// A number.
    Number(f64),
    /// A name of an input or of another formula.
    Name(String),
    /// The negative of an expression.
    Negative(Box<FormulaTree>),
    /// Two operands and the operator between them.
    Pair(Operator, Box<[FormulaTree; 2]>),
    /// A function with its arguments.
    Call(Function, Vec<FormulaTree>),
}

/// A formula, or a subexpression of a formula.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct FormulaTree {
    /// Kind of the root node of this tree.
    pub shape: NodeShape,
    /// Byte range of the subexpression in the text.
    pub at: Range<usize>,
}

impl FormulaTree {
    /// A number that does not come from a text.
    pub fn number(value: f64) -> FormulaTree {
        FormulaTree::of(NodeShape::Number(value))
    }

    /// A name that does not come from a text.
    pub fn name(name: impl Into<String>) -> FormulaTree {
        FormulaTree::of(NodeShape::Name(name.into()))
    }

    /// Two operands and the operator between them.
    pub fn pair(operator: Operator, left: FormulaTree, right: FormulaTree) -> FormulaTree {
        FormulaTree::of(NodeShape::Pair(operator, Box::new([left, right])))
    }

    /// A function with its arguments.
    pub fn call(function: Function, arguments: Vec<FormulaTree>) -> FormulaTree {
        FormulaTree::of(NodeShape::Call(function, arguments))
    }

    /// The negative of an expression. The negative of a negative is the inner expression.
    pub fn negative(&self) -> FormulaTree {
        match &self.shape {
            NodeShape::Negative(inner) => (**inner).clone(),
            NodeShape::Number(_) | NodeShape::Name(_) | NodeShape::Pair(..) | NodeShape::Call(..) => {
                FormulaTree::of(NodeShape::Negative(Box::new(self.clone())))
            }
        }
    }

    fn of(shape: NodeShape) -> FormulaTree {
        FormulaTree { shape, at: 0..0 }
    }

    /// This tree with every occurrence of a name replaced by `other`.
    pub fn with_name(&self, name: &str, other: &FormulaTree) -> FormulaTree {
        if matches!(&self.shape, NodeShape::Name(own) if own == name) {
            return other.clone();
        }
        let mut changed = self.clone();
        for part in changed.parts_mut() {
            *part = part.with_name(name, other);
        }
        changed
    }

    /// The arguments of the outermost operation.
    pub fn parts(&self) -> &[FormulaTree] {
        match &self.shape {
            NodeShape::Number(_) | NodeShape::Name(_) => &[],
            NodeShape::Negative(part) => std::slice::from_ref(part),
            NodeShape::Pair(_, parts) => &parts[..],
            NodeShape::Call(_, parts) => parts,
        }
    }

    /// The arguments of the outermost operation, mutable.
    pub fn parts_mut(&mut self) -> &mut [FormulaTree] {
        match &mut self.shape {
            NodeShape::Number(_) | NodeShape::Name(_) => &mut [],
            NodeShape::Negative(part) => std::slice::from_mut(part),
            NodeShape::Pair(_, parts) => &mut parts[..],
            NodeShape::Call(_, parts) => parts,
        }
    }

    /// All names with their positions, from left to right.
    pub fn names(&self) -> Vec<(&str, Range<usize>)> {
        let (mut names, mut open) = (Vec::new(), vec![self]);
        while let Some(part) = open.pop() {
            if let NodeShape::Name(name) = &part.shape {
                names.push((name.as_str(), part.at.clone()));
            }
            open.extend(part.parts().iter().rev());
        }
        names
    }

    /// The tree, its left argument, the left argument of its left argument, and so on.
    /// The tree of a long sum is deep only along its left arguments.
    pub(crate) fn left_parts(&self) -> Vec<&FormulaTree> {
        std::iter::successors(Some(self), |tree| match &tree.shape {
            NodeShape::Pair(_, parts) => Some(&parts[0]),
            NodeShape::Number(_) | NodeShape::Name(_) | NodeShape::Negative(_) | NodeShape::Call(..) => None,
        })
        .collect()
    }

    fn rank(&self) -> u8 {
        match &self.shape {
            NodeShape::Number(number) if number.is_sign_negative() => NEGATION,
            NodeShape::Number(_) | NodeShape::Name(_) | NodeShape::Call(..) => WHOLE,
            NodeShape::Negative(_) => NEGATION,
            NodeShape::Pair(operator, _) => operator.rank(),
        }
    }

    fn write(&self, f: &mut fmt::Formatter<'_>, least: u8) -> fmt::Result {
        if self.rank() < least { write!(f, "({self})") } else { write!(f, "{self}") }
    }
}

/// Writes the formula with only the necessary parentheses.
impl fmt::Display for FormulaTree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.shape {
            NodeShape::Number(number) => write!(f, "{number}"),
            NodeShape::Name(name)
                if name.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.')) =>
            {
                write!(f, "{name}")
            }
            NodeShape::Name(name) => write!(f, "`{name}`"),
            NodeShape::Negative(part) => {
                write!(f, "-")?;
                part.write(f, NEGATION)
            }
            NodeShape::Pair(operator, parts) => {
                let rank = operator.rank();
                // If inner and outer operator have the same precedence, parentheses are needed on the right of `+`,
                // `-`, `*` and `/`, and on the left of `^`.
                let [left, right] = match operator {
                    Operator::Plus | Operator::Minus | Operator::Times | Operator::Over => [rank, rank + 1],
                    Operator::Power => [rank + 1, NEGATION],
                };
                parts[0].write(f, left)?;
                match operator {
                    Operator::Plus | Operator::Minus => write!(f, " {} ", operator.sign())?,
                    Operator::Times | Operator::Over | Operator::Power => write!(f, "{}", operator.sign())?,
                }
                parts[1].write(f, right)
            }
            NodeShape::Call(function, parts) => {
                write!(f, "{}(", function.name())?;
                for (index, part) in parts.iter().enumerate() {
                    write!(f, "{}{part}", if index > 0 { ", " } else { "" })?;
                }
                write!(f, ")")
            }
        }
    }
}

/// A function that a formula may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// Sine of an angle (rad).
    Sin,
    /// Cosine of an angle (rad).
    Cos,
    /// Tangent of an angle (rad).
    Tan,
    /// Angle (rad) from -pi/2 to pi/2 whose sine is the argument.
    Asin,
    /// Angle (rad) from 0 to pi whose cosine is the argument.
    Acos,
    /// Angle (rad) from -pi/2 to pi/2 whose tangent is the argument.
    Atan,
    /// Angle (rad) from -pi to pi of a vector. The first argument is y, the second is x.
    Atan2,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// Exponential function.
    Exp,
    /// Natural logarithm.
    Ln,
    /// -1, 0 or 1: the sign of a number. Except at 0, it is the derivative of the absolute value.
    Sign,
}

impl Function {
    /// All functions, in the order of the documentation.
    pub const ALL: [Function; 12] = {
        use Function::{Abs, Acos, Asin, Atan, Atan2, Cos, Exp, Ln, Sign, Sin, Sqrt, Tan};
        [Sin, Cos, Tan, Asin, Acos, Atan, Atan2, Sqrt, Abs, Exp, Ln, Sign]
    };

    /// Name in formulas.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Asin => "asin",
            Function::Acos => "acos",
            Function::Atan => "atan",
            Function::Atan2 => "atan2",
            Function::Sqrt => "sqrt",
            Function::Abs => "abs",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Sign => "sign",
        }
    }

    /// Number of arguments.
    #[must_use]
    pub const fn arity(self) -> usize {
        if matches!(self, Function::Atan2) { 2 } else { 1 }
    }

    /// The function called `name`.
    #[must_use]
    pub fn named(name: &str) -> Option<Function> {
        Function::ALL.into_iter().find(|function| function.name() == name)
    }
}

/// A fault in the text of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormulaFault {
    /// What was found.
    pub message: String,
    /// Byte range of the faulty text.
    pub at: Range<usize>,
    /// The remedy.
    pub help: String,
}

impl FormulaFault {
    /// A fault with its position and the remedy.
    pub(crate) fn new(message: impl Into<String>, at: Range<usize>, help: impl Into<String>) -> Self {
        FormulaFault { message: message.into(), at, help: help.into() }
    }
}

impl fmt::Display for FormulaFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)
    }
}

impl std::error::Error for FormulaFault {}
