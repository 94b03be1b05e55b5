//! Uncertainty of the numbers in a column. The uncertainty is estimated from the printed digits, because printing
//! rounds numbers.

use crate::instants::chosen;
use formula::Rounded;
use linkage::math::KeepNan;

/// A cell with its number and the properties of the printed digits.
#[derive(Clone, Copy, Debug)]
pub struct TableCell {
    /// The number; NaN if the cell does not contain a number.
    pub value: f64,
    /// Number of printed decimals minus the printed exponent (3 for `1.25e-1`).
    pub decimals: i32,
    /// Number of digits, counted from the first nonzero digit.
    pub(crate) significant: u16,
    /// Number of digits, counted from the first nonzero digit, without the trailing zeros of a whole number.
    /// The trailing zeros are left out because they may replace digits lost in rounding.
    telling: u16,
    is_missing: bool,
}

/// Value of an empty cell, in which nothing was measured.
pub const MISSING: Rounded = Rounded::exact(f64::NAN);

/// Value of a cell with a NaN or an infinity that a program computed.
pub const UNDEFINED: Rounded = Rounded { value: f64::NAN, error: f64::INFINITY };

/// Largest magnitude of an exponent, far outside the range of a double. Larger magnitudes are reduced to this one, so
/// that sums of digits and exponents cannot overflow.
const FARTHEST: i32 = 100_000;

/// Words that mean an empty cell.
const EMPTY: [&str; 6] = ["-", "na", "n/a", "<na>", "null", "none"];

/// Words for NaN and infinity, without the sign that may precede them.
const NO_NUMBER: [&str; 6] = ["nan", "nan(ind)", "inf", "infinity", "1.#ind", "1.#qnan"];

/// Whether nothing was measured in the cell. A NaN that a program computed does not count as missing.
pub fn is_missing(number: &Rounded) -> bool {
    number.value.is_nan() && number.error == 0.0
}

impl TableCell {
    /// Reads a cell; `None` if the text is neither a number nor a word for a missing or undefined number.
    pub fn parse(text: &str) -> Option<TableCell> {
        let Some(decimal) = TableCell::decimal(text) else { return TableCell::word(text) };
        // A final `.0` is removed before the digits are counted, because Python appends `.0` to whole numbers of any
        // number of digits.
        Some(text.strip_suffix(".0").and_then(TableCell::decimal).unwrap_or(decimal))
    }

    /// A number, with or without point and exponent.
    fn decimal(text: &str) -> Option<TableCell> {
        let (mut decimals, mut significant, mut telling, mut point, mut exponent) = (0i32, 0u16, 0u16, false, 0i32);
        for (at, byte) in text.bytes().enumerate() {
            match byte {
                b'0'..=b'9' => {
                    significant = significant.saturating_add(u16::from(significant > 0 || byte != b'0'));
                    decimals = decimals.saturating_add(i32::from(point));
                    telling = if byte != b'0' || point { significant } else { telling };
                }
                b'.' if !point => point = true,
                b'+' | b'-' if at == 0 => {}
                b'e' | b'E' => {
                    exponent = text[at + 1..].parse::<i32>().ok()?.clamp(-FARTHEST, FARTHEST);
                    telling = significant;
                    break;
                }
                _ => return None,
            }
        }
        let value: f64 = text.parse().ok().filter(|value: &f64| value.is_finite())?;
        Some(TableCell { value, decimals: decimals.checked_sub(exponent)?, significant, telling, is_missing: false })
    }

    fn word(text: &str) -> Option<TableCell> {
        let is = |words: &[&str], text: &str| words.iter().any(|word| text.eq_ignore_ascii_case(word));
        let is_missing = text.is_empty() || is(&EMPTY, text);
        let is_word = is_missing || is(&NO_NUMBER, text.strip_prefix(['+', '-']).unwrap_or(text));
        is_word.then_some(TableCell { value: f64::NAN, decimals: 0, significant: 0, telling: 0, is_missing })
    }

    /// Whether the cell contains a number other than zero.
    pub(crate) fn has_digits(&self) -> bool {
        self.significant > 0 && !self.value.is_nan()
    }

    /// The cell with the trailing zeros that the column's format left out.
    /// Zeros are added until the cell has `decimals` decimals or, if it is not zero, `significant` significant digits.
    pub(crate) fn with_zeros(mut self, decimals: i32, significant: u16) -> TableCell {
        let mut zeros = decimals.saturating_sub(self.decimals).max(0);
        if self.has_digits() {
            zeros = zeros.min(i32::from(significant.saturating_sub(self.significant)));
            self.significant += zeros as u16;
            self.telling = self.significant;
        }
        self.decimals += zeros;
        self
    }
}

/// The numbers of a column, each with the uncertainty caused by the printing of its digits.
///
/// A column is printed with a fixed number of decimals or of significant digits, and programs omit trailing zeros.
/// The fixed number is therefore the largest number of decimals, or of digits, that any cell has.
/// The uncertainty is half a unit of the last printed digit. The uncertainty is computed for both formats, and the
/// larger value counts.
/// The larger value is always the uncertainty for the actual format.
/// With fixed decimals, the number of largest magnitude has the most significant digits. As many significant digits in
/// every number would give the other numbers a smaller uncertainty.
/// With fixed significant digits, the number of smallest magnitude has the most decimals. As many decimals in every
/// number would give the other numbers a smaller uncertainty.
///
/// Several whole numbers may have more digits than all other cells only because of trailing zeros.
/// The trailing zeros then count as digits lost in rounding, unless the numbers count as exact: see [`chosen`].
///
/// Numbers in single precision are printed with up to nine digits but have fewer significant digits.
/// The shortest text of such a number may differ from the number by almost half the distance to the neighbouring
/// number.
/// A number in single precision is therefore converted to single precision again.
pub fn numbers(cells: &[TableCell]) -> Vec<Rounded> {
    numbers_as(cells, Precision::of(cells))
}

pub(crate) fn numbers_as(cells: &[TableCell], precision: Precision) -> Vec<Rounded> {
    let shown = || cells.iter().filter(|cell| !cell.value.is_nan());
    let decimals = shown().map(|cell| cell.decimals).max().unwrap_or(0);
    let [all, telling] = [|cell: &TableCell| cell.significant, |cell: &TableCell| cell.telling]
        .map(|of| i32::from(shown().map(of).max().unwrap_or(0)));
    let is_single = precision == Precision::Single;
    let binary = if is_single { 0.5 * f64::from(f32::EPSILON) } else { f64::EPSILON };
    let with = |significant: i32| -> Vec<Rounded> {
        let of = |cell: &TableCell| {
            if cell.value.is_nan() {
                return if cell.is_missing { MISSING } else { UNDEFINED };
            }
            let place = match cell.significant {
                0 => -decimals,
                _ => (-decimals).max(i32::from(cell.significant) - cell.decimals - significant),
            };
            // The conversion of the decimal to binary rounds the number once more. The margin 1e-9 covers this small
            // rounding error.
            let half = 0.5 * 10f64.powi(place) * (1.0 + 1e-9);
            let value = if is_single { f64::from(cell.value as f32) } else { cell.value };
            Rounded { value, error: half.larger(binary * value.abs()) }
        };
        cells.iter().map(of).collect()
    };
    let found = with(all);
    let are_rounded = shown().filter(|cell| i32::from(cell.significant) > telling).count() >= FEW;
    if are_rounded && !chosen(&found) { with(telling) } else { found }
}

/// Some whole numbers may have more digits than all other cells only because of trailing zeros.
/// If there are at least this many such whole numbers, the column counts as rounded to fewer digits.
/// By chance, one whole number in ten ends with zero.
const FEW: usize = 2;

/// A column counts as single precision only if at least this many cells have eight or more digits.
/// In addition, each cell must be the shortest text of a number in single precision.
/// By chance, about one in five decimal numbers with eight digits is the shortest text of such a number.
const TELLING: usize = 8;

/// Precision of the numbers of a column before the numbers were printed, coarsest precision first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Precision {
    /// Single: each number has just enough digits to be distinguished from its neighbours.
    Single,
    Double,
}

impl Precision {
    pub(crate) fn of(cells: &[TableCell]) -> Precision {
        let shown = || cells.iter().filter(|cell| !cell.value.is_nan());
        let are_few = shown().filter(|cell| cell.significant >= 8).count() < TELLING;
        let is_single = |cell: &TableCell| (cell.value as f32).to_string().parse::<f64>() == Ok(cell.value);
        match are_few || shown().any(|cell| cell.significant > 9) || !shown().all(is_single) {
            true => Precision::Double,
            false => Precision::Single,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(cells: &[&str]) -> Vec<f64> {
        let cells: Vec<TableCell> = cells.iter().map(|text| TableCell::parse(text).unwrap()).collect();
        numbers(&cells).iter().map(|number| number.error).collect()
    }

    #[test]
    fn a_number_has_the_digits_of_its_column() {
        for (cells, halves) in [
            (["1", "1.25"], [0.005, 0.005]),
            // The expected error of 2 is 0.5, because .5 has one significant digit, so 2 may have only one significant
            // digit too.
            ([".5", "2."], [0.05, 0.5]),
            // `%g` printed these numbers with an exponent, so they have a fixed number of significant digits.
            (["1e3", "1.25e3"], [5.0, 5.0]),
            (["0.000277777778", "0.0155555556"], [5e-13, 5e-11]),
            (["1.00001e-05", "123"], [5e-11, 5e-4]),
            // With %.3f.
            (["1000.123", "0.001"], [5e-4, 5e-4]),
            (["0.0", "1"], [0.5, 0.5]),
            (["0.00", "1.00"], [0.005, 0.005]),
            // An exponent far outside the range of a double.
            (["1e-2147483647", "1"], [0.0, 0.5]),
        ] {
            for (error, half) in errors(&cells).iter().zip(halves) {
                approx::assert_relative_eq!(*error, half, max_relative = 1e-6);
            }
        }
        // These numbers are rounded to three significant digits. Python prints such numbers with `.0`, other programs
        // without `.0`.
        for cells in [["-2450.0", "1260.0", "301.0", "0.354"], ["2450", "1260", "301", "0.354"]] {
            for (error, half) in errors(&cells).iter().zip([5.0, 5.0, 0.5, 0.0005]) {
                approx::assert_relative_eq!(*error, half, max_relative = 1e-6);
            }
        }
        // The number has as many digits as a double.
        assert_eq!(errors(&["7.958865576007463e-300"]), [7.958865576007463e-300 * f64::EPSILON]);
        assert_eq!(errors(&["", "-"]), [0.0, 0.0]);
    }

    #[test]
    fn invalid_missing_and_undefined_cells_are_distinguished() {
        for wrong in ["1,5", "x", "1.2.3", "0x10", "12 mm", "--1", "1e", ".", "+", "nano", "1e1.5"] {
            assert!(TableCell::parse(wrong).is_none(), "{wrong}");
        }
        let of = |text: &str| numbers(&[TableCell::parse(text).unwrap()])[0];
        for missing in ["", "-", "NULL", "None", "NA", "n/a", "<NA>"] {
            assert!(is_missing(&of(missing)), "{missing}");
        }
        for none in ["nan", "-NaN", "inf", "-Infinity", "-1.#IND", "1e999"] {
            let Some(found) = TableCell::parse(none) else {
                assert_eq!(none, "1e999");
                continue;
            };
            let found = numbers(&[found])[0];
            assert!(found.value.is_nan() && !is_missing(&found), "{none}");
        }
    }

    #[test]
    fn single_precision_has_fewer_digits_than_it_is_printed_with() {
        let printed: Vec<String> = (1..40).map(|row| (0.1f32 + (row as f32).sqrt()).to_string()).collect();
        let texts: Vec<&str> = printed.iter().map(String::as_str).collect();
        let cells: Vec<TableCell> = texts.iter().map(|text| TableCell::parse(text).unwrap()).collect();
        for (row, Rounded { value, error }) in numbers(&cells).into_iter().enumerate() {
            let exact = 0.1f32 + ((row + 1) as f32).sqrt();
            assert!(value == f64::from(exact) && error > 5.9e-8 * value, "{row}: {value} {error}");
        }
        // Doubles printed with eight digits do not count as single precision.
        let printed: Vec<String> = (1..40).map(|row| format!("{:.7}", f64::from(row).sqrt())).collect();
        let texts: Vec<&str> = printed.iter().map(String::as_str).collect();
        assert!(errors(&texts).iter().all(|error| *error < 6e-8));
    }
}
