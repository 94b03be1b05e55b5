//! The criterion by which a cell is right.

use super::answers::StudentCell;
use super::sheet::AnswerSheet;
use linkage::math::KeepNan;

/// Largest amount by which an answer that counts as right may differ from the right value. Every cell is judged alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MarkCriterion {
    /// This fraction of the right value, but at least half a unit of the last requested decimal.
    /// The lower limit is for values near zero, which a student cannot know to a fraction of the value.
    /// An angle may differ by this fraction of a radian: such an error moves the end of a link by the same fraction of
    /// the link's length.
    Within(f64),
    /// Half a unit of the last requested decimal.
    Digits,
    /// Half a unit of the last decimal that the student wrote, but at most half a unit of the last requested decimal.
    Written,
}

impl MarkCriterion {
    /// Largest difference of the answer from the right value, in the printed unit.
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
