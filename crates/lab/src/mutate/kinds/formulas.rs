//! Mistakes in formulas: the mistakes that the diagnosis knows, and claims of another quantity.

use super::kind::{FaultFamily, FaultKind, Mistake, Plant};
use prover::check::SlipKind as Slip;

pub(super) const KINDS: &[FaultKind] = &[
    slip("formula-sign", "a sign in a formula is wrong", Slip::Sign),
    slip("formula-branch", "the wrong branch of a square root or of an inverse function", Slip::Branch),
    slip("formula-unit", "degrees for radians, revolutions per minute, millimetres, and the like", Slip::Unit),
    slip("formula-function", "a wrong function, such as a cosine for a sine, or a missing function", Slip::Function),
    slip("formula-power", "a power or a root is missing or superfluous", Slip::Power),
    slip("formula-per-radian", "a superfluous factor: the crank's angular velocity", Slip::PerRadian),
    slip("formula-per-second", "the crank's angular velocity is missing as a factor", Slip::PerSecond),
    slip("formula-name", "a wrong quantity", Slip::Name),
    slip("formula-exchanged", "two quantities exchanged", Slip::Exchanged),
    slip("formula-term", "a term is dropped", Slip::Term),
    slip("formula-reference", "an angle is a quarter, a half or a whole turn off", Slip::Reference),
    slip("formula-number", "a wrong factor or divisor: 2, 3, 4 or another small number", Slip::Factor),
    slip("formula-operator", "a product instead of a quotient or a power", Slip::Operator),
    slip("formula-parentheses", "parentheses are missing or misplaced", Slip::Parentheses),
    of("formula-factor", "a formula is too large by a relative amount", Mistake::Larger).sized(1e-2),
    of("formula-link", "the same quantity of another link, point or joint is claimed", Mistake::Subject),
    of("formula-channel", "another quantity with the same unit is claimed", Mistake::Quantity),
];

const fn slip(name: &'static str, says: &'static str, slip: Slip) -> FaultKind {
    of(name, says, Mistake::Slip(slip))
}

const fn of(name: &'static str, says: &'static str, mistake: Mistake) -> FaultKind {
    FaultKind { name, says, family: FaultFamily::Formula, size: None, plant: Plant::Formula(mistake) }
}
