//! A slip of the pen, its kinds, and formulas with one mended.

use formula::Tree;

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
    /// Degrees for radians, and the like.
    Unit,
    /// A reference angle that is a quarter or half a turn off.
    Reference,
    /// A factor or divisor that is a small number.
    Factor,
    /// A product for a quotient.
    Operator,
    /// Parentheses that are missing, or in another place.
    Parentheses,
}

impl Kind {
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
            Kind::PerRadian => "per radian of the crank in place of per second",
            Kind::PerSecond => "per second in place of per radian of the crank",
        }
    }
}

/// One slip mended: the formulas that it changes by their indices, as they would be right, and the slip in words.
pub(in crate::claims) struct Mended {
    pub(in crate::claims) changed: Vec<(usize, Tree)>,
    pub(in crate::claims) slip: Slip,
    /// Whether the units of the mended formula fit together.
    pub(in crate::claims) is_sound: bool,
}
