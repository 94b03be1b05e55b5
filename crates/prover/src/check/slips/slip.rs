//! A slip in writing, the kinds of slips, and the corrected formula.

use super::marks::{FormulaMark, marks};
use crate::check::dimension::Dimensions;
use crate::check::trial::Trial;
use formula::FormulaTree;

/// A slip in writing.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaSlip {
    /// The formula that contains the slip.
    pub formula: String,
    /// Kind of slip.
    pub kind: SlipKind,
    /// The wrong subexpression, as written.
    pub written: String,
    /// The corrected subexpression.
    pub right: String,
    /// Whether the slip is repeated at every occurrence of the subexpression. The occurrences are those in the formula,
    /// or those in the formula and in the steps that the formula uses.
    pub everywhere: bool,
    /// The smallest wrong pieces of the formula's text; empty if the slip is not in a formula.
    pub marks: Vec<FormulaMark>,
}

linkage::words! {
    /// Kinds of slips, the simplest first.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum SlipKind: words {
        /// A missing factor of -1.
        Sign = "a sign",
        /// Another branch of a square root or of an inverse function.
        Branch = "another branch",
        /// A wrong unit, such as degrees in place of radians, revolutions per minute, or millimetres.
        Unit = "a unit",
        /// A wrong or missing function, such as a sine in place of a cosine.
        Function = "another function",
        /// A square or a root that is missing or superfluous.
        Power = "a power",
        /// A derivative with respect to the crank angle in place of a derivative with respect to time.
        PerRadian = "per radian of the crank in place of per second",
        /// A derivative with respect to time in place of a derivative with respect to the crank angle, or a power in
        /// place of a moment.
        PerSecond = "per second in place of per radian of the crank",
        /// A wrong name in place of the right one.
        Name = "another quantity",
        /// Two names exchanged.
        Exchanged = "two quantities exchanged",
        /// A term too many.
        Term = "a term too many",
        /// A reference angle that is wrong by a quarter, half or whole revolution, or has the opposite direction.
        Reference = "another reference angle",
        /// A factor or divisor that is a small number.
        Factor = "a factor",
        /// A product, quotient or power in place of another of these operations, or an inverted quotient.
        Operator = "a product for a quotient",
        /// Parentheses that are missing or at a wrong position.
        Parentheses = "parentheses",
        /// A wrong number, or a wrong value of a parameter.
        Value = "a value",
    }
}

/// Order of slips. The simplest slip has the smallest rank.
/// The rank has four entries: whether the units contradict the correction, whether the slip occurs at many positions,
/// whether the slip is in a step, and the kind of slip.
/// For a wrong value, the second entry is true unless digits of the value were exchanged, lost, added or doubled.
type Rank = (bool, bool, bool, SlipKind);

/// A slip and the effect of its correction.
pub(in crate::check) struct Mended {
    pub(in crate::check) slip: FormulaSlip,
    pub(in crate::check) rank: Rank,
    /// Fraction of the largest difference that remains after the correction; zero if the formula is then right.
    pub(in crate::check) left: f64,
    /// Number of slips tried up to and including this one. Slips are not tried in the order of ranks. Slips at one
    /// position are tried first, kind by kind, then slips at all occurrences, then wrong values.
    pub(in crate::check) among: usize,
}

/// Slips that were tried.
#[derive(Default)]
pub(in crate::check) struct Tried {
    /// Corrections that make the formula right, the simplest first.
    pub(in crate::check) right: Vec<Mended>,
    /// The correction that leaves the smallest remainder without making the formula right. `None` if no remainder is
    /// small.
    pub(in crate::check) nearest: Option<Mended>,
    /// Number of corrections tried.
    pub(in crate::check) count: usize,
}

impl Tried {
    /// Judges a corrected slip.
    /// Keeps the correction if it makes the formula right, or brings the formula closer to the mechanism than all
    /// earlier corrections.
    pub(super) fn put(
        &mut self,
        trial: &mut Trial,
        changed: &[(usize, FormulaTree)],
        mut slip: FormulaSlip,
        rank: Rank,
    ) {
        let Some(left) = trial.left(changed, 0.0) else { return };
        let list = &trial.formulas.list;
        let own = changed.iter().map(|(index, tree)| (&list[*index], tree)).find(|(own, _)| own.name == slip.formula);
        slip.marks = own.map(|(own, tree)| marks(&own.text, &own.tree, tree)).unwrap_or_default();
        let mended = Mended { slip, rank, left, among: self.count };
        // The nearest correction is replaced only if a later one leaves a clearly smaller remainder, because simpler
        // corrections are mostly tried earlier.
        if left == 0.0 {
            self.right.push(mended);
        } else if self.nearest.as_ref().is_none_or(|nearest| left < 0.8 * nearest.left) {
            self.nearest = Some(mended);
        }
    }

    /// Judges a corrected slip as `put` does, but only if the units allow the correction. `replaced` holds the old and
    /// the new subexpression in the first changed formula.
    pub(super) fn put_standing(
        &mut self,
        trial: &mut Trial,
        dimensions: &Dimensions,
        changed: &[(usize, FormulaTree)],
        replaced: [&FormulaTree; 2],
        slip: FormulaSlip,
    ) {
        let standing = dimensions.standing(changed, changed[0].0, replaced);
        trial.sheet.operations += dimensions.work();
        let Some(is_sound) = standing else { return };
        let is_in_step = changed.iter().any(|(own, _)| *own != trial.index);
        let rank = (!is_sound, slip.everywhere, is_in_step, slip.kind);
        self.put(trial, changed, slip, rank);
    }
}
