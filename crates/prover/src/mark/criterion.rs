//! The criterion that decides whether a cell is right.

use super::answers::StudentCell;
use super::sheet::AnswerSheet;
use linkage::math::KeepNan;

/// Largest allowed difference between an answer and the right value. The verdict on a cell does not depend on other
/// cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MarkCriterion {
    /// The allowed difference is this fraction of the right value, but at least half a unit of the last requested
    /// decimal. The lower limit is for values near zero, for which a fraction of the value would be too strict. For an
    /// angle, the allowed difference is this fraction of a radian: such an error moves the end of a link by the same
    /// fraction of the link's length.
    Within(f64),
    /// The allowed difference is half a unit of the last requested decimal.
    Digits,
    /// The allowed difference is half a unit of the last decimal that the student wrote, but at most half a unit of the
    /// last requested decimal.
    Written,
}

impl MarkCriterion {
    /// Largest allowed difference between the answer and the right value, in the printed unit.
    #[must_use]
    pub fn allowed(self, sheet: &AnswerSheet, row: usize, column: usize, cell: &StudentCell) -> f64 {
        let asked = sheet.half_unit(column);
        match self {
            MarkCriterion::Within(share) => {
                let size = match sheet.columns[column].turn {
                    Some(turn) => turn / std::f64::consts::TAU,
                    None => sheet.right[row][column].abs(),
                };
                asked.larger(share * size)
            }
            MarkCriterion::Digits => asked,
            MarkCriterion::Written => asked.smaller(cell.half_unit()),
        }
    }
}
