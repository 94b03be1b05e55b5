//! Columns with the same number in every row, such as a zero moment or a constant speed.

use crate::cell::{Precision, TableCell, numbers, numbers_as};
use crate::instants::chosen;
use formula::Rounded;

/// Number of significant digits of single precision, rounded down: 24 bits are 7.2 digits.
const SINGLE: u16 = 7;

/// The numbers of a column of a file, each with the uncertainty caused by the printing of its digits.
/// The result equals the result of [`numbers`], except for a column of zeros.
/// For a column of zeros, the result also depends on `others`, the columns of the file other than this column.
///
/// A constant column does not show its format.
/// A `0` printed by `%g`, Python and similar formats is an exact zero. A `0` printed by `%.0f` may be any number
/// whose absolute value is at most a half.
/// A file usually has one format. If this format omits trailing zeros, decimals and significant digits both vary from
/// cell to cell of a column that is not constant.
/// If the number of decimals and the number of significant digits vary in every column of `others`, each zero counts as
/// printed with at least as many decimals as the coarsest of these columns has.
/// Constant columns, and columns of exact equidistant numbers ([`chosen`]), are not considered.
/// If a column of `others` has a fixed number of decimals, as from `%.6f`, or contains only whole numbers, each column
/// may have a separate format. The zeros may then be rounded to the format of their column.
pub fn numbers_beside<Others>(cells: &[TableCell], others: impl FnOnce() -> Others) -> Vec<Rounded>
where
    Others: IntoIterator<Item: AsRef<[TableCell]>>,
{
    match is_zero(cells).then(|| vouched(others())).flatten() {
        Some(Vouched { decimals, significant, precision }) => {
            let cells: Vec<TableCell> = cells.iter().map(|cell| cell.with_zeros(decimals, significant)).collect();
            numbers_as(&cells, precision)
        }
        None => numbers(cells),
    }
}

/// Evidence from the columns other than the column of zeros.
/// The evidence consists of three minima over these columns: the minimum of the decimals, of the digits, and of the
/// precision.
#[derive(Clone, Copy)]
struct Vouched {
    decimals: i32,
    significant: u16,
    precision: Precision,
}

/// Evidence from the columns `others`.
/// `None` if these columns give no evidence, or if the format of one of these columns does not omit trailing zeros.
fn vouched(others: impl IntoIterator<Item: AsRef<[TableCell]>>) -> Option<Vouched> {
    let mut coarsest: Option<Vouched> = None;
    for column in others {
        let cells = column.as_ref();
        if is_constant(cells) || chosen(&numbers(cells)) {
            continue;
        }
        let shown = || cells.iter().filter(|cell| cell.has_digits());
        let (Some(decimals), Some(significant)) =
            (shown().map(|cell| cell.decimals).max(), shown().map(|cell| cell.significant).max())
        else {
            continue;
        };
        if decimals <= 0 || !leaves_zeros_out(cells) {
            return None;
        }
        let precision = Precision::of(cells);
        let significant = if precision == Precision::Single { significant.min(SINGLE) } else { significant };
        let own = Vouched { decimals, significant, precision };
        coarsest = Some(coarsest.map_or(own, |least| Vouched {
            decimals: least.decimals.min(own.decimals),
            significant: least.significant.min(own.significant),
            precision: least.precision.min(own.precision),
        }));
    }
    coarsest
}

/// Whether all numbers of a column are zero. The file's other columns affect the uncertainty only for a column of
/// zeros.
/// In a format with significant digits, a zero is exact even with few digits.
/// A constant other than zero may have been rounded to fewer digits than the file's other columns have.
fn is_zero(cells: &[TableCell]) -> bool {
    is_constant(cells) && cells.iter().any(|cell| cell.value == 0.0)
}

/// Whether all numbers of a column are the same.
fn is_constant(cells: &[TableCell]) -> bool {
    let mut shown = cells.iter().map(|cell| cell.value).filter(|value| !value.is_nan());
    let Some(first) = shown.next() else { return false };
    shown.all(|value| value == first)
}

fn leaves_zeros_out(cells: &[TableCell]) -> bool {
    fn differ<T: PartialEq>(cells: &[TableCell], of: fn(&TableCell) -> T) -> bool {
        let mut all = cells.iter().filter(|cell| cell.has_digits()).map(of);
        let first = all.next();
        all.any(|own| Some(own) != first)
    }
    differ(cells, |cell| cell.decimals) && differ(cells, |cell| cell.significant)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(texts: &[&str]) -> Vec<TableCell> {
        texts.iter().map(|text| TableCell::parse(text).unwrap()).collect()
    }

    /// Error of the first number of `column` in a file that also contains the columns `others`.
    fn error(column: &[&str], others: &[&[&str]]) -> f64 {
        let others: Vec<Vec<TableCell>> = others.iter().map(|texts| cells(texts)).collect();
        numbers_beside(&cells(column), || others)[0].error
    }

    const GENERAL: &[&str] = &["0.123456789", "1.5", "12.3456789"];
    const FORCES: &[&str] = &["2450.12345", "-13.5", "301.12"];
    const STEPS: &[&str] = &["0.000", "0.025", "0.050"];

    #[test]
    fn a_file_without_trailing_zeros_bounds_its_constants() {
        for zero in [["0", "0", "-0"], ["0.0", "0.0", "0"]] {
            approx::assert_relative_eq!(error(&zero, &[STEPS, GENERAL, FORCES]), 5e-6, max_relative = 1e-6);
        }
        // For a constant other than zero, the other columns of the file do not count.
        // Rounded to three digits, 13.63 is printed as 13.6 or 1.36e1.
        approx::assert_relative_eq!(error(&["13.6", "13.6", ""], &[GENERAL, FORCES]), 0.05, max_relative = 1e-6);
        approx::assert_relative_eq!(error(&["1.36e1", "1.36e1"], &[GENERAL, FORCES]), 0.05, max_relative = 1e-6);
        let three: &[&str] = &["0.123", "1.5", "12.3"];
        approx::assert_relative_eq!(error(&["0", "0", "0"], &[three]), 5e-4, max_relative = 1e-6);
    }

    #[test]
    fn a_constant_in_a_different_format_may_be_rounded() {
        // These columns have fixed decimals, an exponent, or whole numbers.
        // Columns of equidistant numbers and constant columns give no evidence.
        for fixed in [["0.125000", "1.500000", "12.345679"], ["1.25e-1", "1.50e0", "1.23e1"], ["2450", "-13", "301"]] {
            approx::assert_relative_eq!(error(&["0", "0", "0"], &[GENERAL, &fixed]), 0.5, max_relative = 1e-6);
        }
        approx::assert_relative_eq!(
            error(&["0", "0", "0"], &[STEPS, &["7.5", "7.5", "7.5"]]),
            0.5,
            max_relative = 1e-6
        );
        // A column whose numbers differ shows its format, so the other columns of the file do not count.
        approx::assert_relative_eq!(error(&["0", "1", "0"], &[GENERAL, FORCES]), 0.5, max_relative = 1e-6);
    }
}
