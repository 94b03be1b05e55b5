//! Hypotheses: each is the table that a student would have written with one mistake.

use super::cause::{CellPlace, MarkCause};
use super::sheet::{AnswerSheet, AnswerTable};

/// Origin of the numbers in the table of a hypothesis.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Origin {
    /// The same mistake in every cell.
    Mistake(MarkCause),
    /// The right value of another quantity at the same position.
    OfColumn(usize),
    /// The right value of the same quantity at another position.
    OfRow(usize),
    /// The right value of another quantity at the same position, with the opposite sign.
    OppositeOfColumn(usize),
}

/// A table that results from one mistake.
pub(super) struct Hypothesis {
    pub(super) origin: Origin,
    /// The values in the printed units; `None` where the mistake has no effect or gives no number.
    pub(super) values: Vec<Vec<Option<f64>>>,
    /// Factor by which the mistake multiplies a number. The rounding of the number is multiplied by the same factor.
    pub(super) factor: f64,
    /// Logarithm of the frequency of the mistake, plus a constant that is the same for all mistakes.
    pub(super) prior: f64,
    /// Whether the mistake changes all quantities of a position, so that a single wrong quantity does not prove it.
    pub(super) is_whole: bool,
}

impl Hypothesis {
    /// The hypothesis of a mistake that changes the right value of each cell by a rule.
    pub(super) fn by_rule(
        sheet: &AnswerSheet,
        origin: Origin,
        prior: f64,
        rule: impl Fn(CellPlace, f64) -> Option<f64>,
    ) -> Hypothesis {
        let cell = |row: usize, column: usize| rule(CellPlace { row, column }, sheet.right[row][column]);
        let values =
            (0..sheet.right.len()).map(|row| (0..sheet.columns.len()).map(|column| cell(row, column)).collect());
        Hypothesis { origin, values: values.collect(), factor: 1.0, prior, is_whole: false }
    }

    /// The hypothesis of a mistake by which the student solved another case. `table` has the right answers for that
    /// case.
    pub(super) fn of_table(cause: MarkCause, prior: f64, table: Vec<Option<AnswerTable>>) -> Hypothesis {
        let mut values = Vec::new();
        for row in table {
            let row = row.and_then(|own| own.into_iter().next());
            values.push(row.map_or(Vec::new(), |own| own.into_iter().map(Some).collect()));
        }
        Hypothesis { origin: Origin::Mistake(cause), values, factor: 1.0, prior, is_whole: true }
    }

    pub(super) fn value(&self, at: CellPlace) -> Option<f64> {
        self.values.get(at.row)?.get(at.column).copied().flatten().filter(|value| value.is_finite())
    }

    /// The cause that this hypothesis gives for the cell `at`.
    pub(super) fn cause(&self, at: CellPlace) -> MarkCause {
        match &self.origin {
            Origin::Mistake(cause) => cause.clone(),
            Origin::OfColumn(column) => MarkCause::OfCell(CellPlace { column: *column, ..at }),
            Origin::OppositeOfColumn(column) => MarkCause::OppositeOfCell(CellPlace { column: *column, ..at }),
            Origin::OfRow(row) => MarkCause::OfCell(CellPlace { row: *row, ..at }),
        }
    }

    /// The other cell whose right value the hypothesis predicts for the cell `at`; `None` if the value is not the right
    /// value of another cell.
    pub(super) fn other_cell(&self, at: CellPlace) -> Option<CellPlace> {
        match self.origin {
            Origin::OfColumn(column) => Some(CellPlace { column, ..at }),
            Origin::OfRow(row) => Some(CellPlace { row, ..at }),
            Origin::Mistake(_) | Origin::OppositeOfColumn(_) => None,
        }
    }
}
