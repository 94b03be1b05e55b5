//! A slip of the pen, and its kinds.

/// A slip of the pen.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    /// The formula that it is in.
    pub formula: String,
    /// What kind it is.
    pub kind: Kind,
    /// What is written, and what would be right.
    pub written: String,
    /// See `written`.
    pub right: String,
    /// Whether it is wrong wherever it stands, in the formula and in the steps that it uses.
    pub everywhere: bool,
}

linkage::words! {
    /// Kinds of slips, the simplest first.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Kind: words {
        /// A sign.
        Sign = "a sign",
        /// Another branch of a square root or of an inverse function.
        Branch = "another branch",
        /// Degrees for radians, turns a minute, millimetres, and the like.
        Unit = "a unit",
        /// Sine for cosine, and the like.
        Function = "another function",
        /// A square, a root, or their absence.
        Power = "a power",
        /// A derivative by the crank angle for one by time.
        PerRadian = "per radian of the crank in place of per second",
        /// A derivative by time for one by the crank angle, or a power for a moment.
        PerSecond = "per second in place of per radian of the crank",
        /// Another of the names.
        Name = "another quantity",
        /// Two names exchanged.
        Exchanged = "two quantities exchanged",
        /// A term too many.
        Term = "a term too many",
        /// A reference angle that is a quarter or half a turn off.
        Reference = "another reference angle",
        /// A factor or divisor that is a small number.
        Factor = "a factor",
        /// A product for a quotient, or for a power.
        Operator = "a product for a quotient",
        /// Parentheses that are missing, or in another place.
        Parentheses = "parentheses",
        /// A number, or the value of a parameter.
        Value = "a value",
    }
}
