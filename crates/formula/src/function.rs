//! The one table of functions.

/// A function that a formula may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// Sine of an angle (rad).
    Sin,
    /// Cosine of an angle (rad).
    Cos,
    /// Tangent of an angle (rad).
    Tan,
    /// Angle (rad) from -pi/2 to pi/2 with this sine.
    Asin,
    /// Angle (rad) from 0 to pi with this cosine.
    Acos,
    /// Angle (rad) from -pi/2 to pi/2 with this tangent.
    Atan,
    /// Angle (rad) from -pi to pi of the vector with the second argument as x and the first as y.
    Atan2,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// Exponential function.
    Exp,
    /// Natural logarithm.
    Ln,
    /// -1, 0 or 1: the derivative of the absolute value.
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
