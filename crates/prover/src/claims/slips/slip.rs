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

/// Kinds of slips, the simplest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A sign.
    Sign,
    /// Another branch of a square root or of an inverse function.
    Branch,
    /// Degrees for radians, turns a minute, millimetres, and the like.
    Unit,
    /// Sine for cosine, and the like.
    Function,
    /// A square, a root, or their absence.
    Power,
    /// A derivative by the crank angle for one by time.
    PerRadian,
    /// A derivative by time for one by the crank angle, or a power for a moment.
    PerSecond,
    /// Another of the names.
    Name,
    /// Two names exchanged.
    Exchanged,
    /// A term too many.
    Term,
    /// A reference angle that is a quarter or half a turn off.
    Reference,
    /// A factor or divisor that is a small number.
    Factor,
    /// A product for a quotient, or for a power.
    Operator,
    /// Parentheses that are missing, or in another place.
    Parentheses,
    /// A number, or the value of a parameter.
    Value,
}

impl Kind {
    /// All kinds, the simplest first.
    pub const ALL: [Kind; 15] = [
        Kind::Sign,
        Kind::Branch,
        Kind::Unit,
        Kind::Function,
        Kind::Power,
        Kind::PerRadian,
        Kind::PerSecond,
        Kind::Name,
        Kind::Exchanged,
        Kind::Term,
        Kind::Reference,
        Kind::Factor,
        Kind::Operator,
        Kind::Parentheses,
        Kind::Value,
    ];

    /// The kind in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Kind::Sign => "a sign",
            Kind::Branch => "another branch",
            Kind::Function => "another function",
            Kind::Power => "a power",
            Kind::Factor => "a factor",
            Kind::Unit => "a unit",
            Kind::Reference => "another reference angle",
            Kind::Name => "another quantity",
            Kind::Term => "a term too many",
            Kind::Exchanged => "two quantities exchanged",
            Kind::Operator => "a product for a quotient",
            Kind::Parentheses => "parentheses",
            Kind::Value => "a value",
            Kind::PerRadian => "per radian of the crank in place of per second",
            Kind::PerSecond => "per second in place of per radian of the crank",
        }
    }
}
