//! A slip in writing, its kinds, and the corrected formula.

use crate::check::dimension::Dimensions;
use crate::check::trial::Trial;
use formula::FormulaTree;

/// A slip in writing.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaSlip {
    /// The formula that contains it.
    pub formula: String,
    /// Kind of slip.
    pub kind: SlipKind,
    /// The written part.
    pub written: String,
    /// The corrected part.
    pub right: String,
    /// Whether it occurs everywhere in the formula and in the steps that it uses.
    pub everywhere: bool,
}

linkage::words! {
    /// Kinds of slips, the simplest first.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum SlipKind: words {
        /// A missing factor `* -1`.
        Sign = "a sign",
        /// Another branch of a square root or of an inverse function.
        Branch = "another branch",
        /// Degrees for radians, revolutions per minute, millimetres, and the like.
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

/// Smallest for the simplest slip. The parts: whether units contradict it, whether it is made in many places, whether
/// it is in a step, and its kind.
type Rank = (bool, bool, bool, SlipKind);

/// A slip mended.
pub(in crate::check) struct Mended {
    pub(in crate::check) slip: FormulaSlip,
    pub(in crate::check) rank: Rank,
    /// Share of the largest difference that the correction leaves; zero if it makes the formula right.
    pub(in crate::check) left: f64,
    /// Number of slips tried up to this one: the equally simple ones.
    pub(in crate::check) among: usize,
}

/// Slips that were tried.
#[derive(Default)]
pub(in crate::check) struct Tried {
    /// Corrections that make the formula right, the simplest first.
    pub(in crate::check) right: Vec<Mended>,
    /// The other correction that leaves the least, if it leaves little.
    pub(in crate::check) nearest: Option<Mended>,
    /// How many were tried.
    pub(in crate::check) count: usize,
}

impl Tried {
    /// Judges a corrected slip. Keeps it if the formula is then right, or nearer than before.
    pub(super) fn put(&mut self, trial: &mut Trial, changed: &[(usize, FormulaTree)], slip: FormulaSlip, rank: Rank) {
        let Some(left) = trial.left(changed, 0.0) else { return };
        let mended = Mended { slip, rank, left, among: self.count };
        // A simpler correction that leaves hardly more counts as nearer.
        if left == 0.0 {
            self.right.push(mended);
        } else if self.nearest.as_ref().is_none_or(|nearest| left < 0.8 * nearest.left) {
            self.nearest = Some(mended);
        }
    }

    /// The same for a part of the first changed formula, `replaced` by another, if the units allow it.
    pub(super) fn put_standing(
        &mut self,
        trial: &mut Trial,
        dimensions: &Dimensions,
        changed: &[(usize, FormulaTree)],
        replaced: [&FormulaTree; 2],
        slip: FormulaSlip,
    ) {
        let standing = dimensions.standing(changed, changed[0].0, replaced);
        trial.sheet.count(dimensions.work());
        let Some(is_sound) = standing else { return };
        let is_in_step = changed.iter().any(|(own, _)| *own != trial.index);
        let rank = (!is_sound, slip.everywhere, is_in_step, slip.kind);
        self.put(trial, changed, slip, rank);
    }
}
