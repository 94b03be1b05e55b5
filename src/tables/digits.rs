//! What the digits of a column say: how far its numbers may be from those that were printed.

use crate::scenario::Printed;
use formula::Rounded;
use linkage::math::KeepNan;

/// Significant digits from which on a file is taken to hold whole doubles.
const WHOLE: i32 = 15;

/// A cell as it was read.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    number: Option<Printed>,
    /// Digits from the first that is not zero.
    significant: i32,
    /// Whether it has an exponent.
    scientific: bool,
}

impl Cell {
    /// Nothing stands there.
    pub const MISSING: Cell = Cell { number: None, significant: 0, scientific: false };

    /// Reads a cell; `None` if it is neither a number nor missing.
    pub fn parse(text: &str) -> Option<Cell> {
        let is_word = !text.starts_with(|sign: char| sign.is_ascii_digit()) && text.len() < 5;
        if is_word
            && (text.is_empty()
                || ["nan", "na", "null", "none", "-"].iter().any(|word| text.eq_ignore_ascii_case(word)))
        {
            return Some(Cell::MISSING);
        }
        let (mut decimals, mut significant, mut point, mut exponent) = (0i32, 0i32, false, None);
        for (at, byte) in text.bytes().enumerate() {
            match byte {
                b'0'..=b'9' => {
                    significant += i32::from(significant > 0 || byte != b'0');
                    decimals += i32::from(point);
                }
                b'.' => point = true,
                b'+' | b'-' if at == 0 => {}
                b'e' | b'E' => {
                    exponent = Some(text[at + 1..].parse::<i32>().ok()?);
                    break;
                }
                // Words such as `inf` are no numbers here.
                _ => return None,
            }
        }
        let value: f64 = text.parse().ok().filter(|value: &f64| value.is_finite())?;
        let number = Printed { value, digits: decimals.saturating_sub(exponent.unwrap_or(0)) };
        Some(Cell { number: Some(number), significant, scientific: exponent.is_some() })
    }

    /// Whether it has as many digits as a double.
    pub fn is_whole_double(&self) -> bool {
        self.significant >= WHOLE
    }
}

/// The numbers of a column. In a file with whole doubles every number is one: programs leave out zeros at the end. Else
/// a number has as many decimals as the longest of its column, or as many significant digits where it has an exponent.
pub fn numbers(cells: &[Cell], doubles: bool) -> Vec<Rounded> {
    let all = || cells.iter().filter_map(|cell| Some((cell, cell.number?)));
    let decimals = all().filter(|(cell, _)| !cell.scientific).map(|(_, number)| number.digits).max();
    let significant = all().filter(|(cell, _)| cell.scientific).map(|(cell, _)| cell.significant).max().unwrap_or(0);
    let of = |cell: &Cell| {
        let Some(number) = cell.number else { return Rounded::exact(f64::NAN) };
        if doubles {
            return Rounded::nearly(number.value);
        }
        let digits = match cell.scientific {
            false => decimals,
            true => Some(number.digits + (significant - cell.significant).max(0)),
        };
        let half = number.with_zeros(digits).half_unit();
        Rounded { value: number.value, error: half.larger(Rounded::nearly(number.value).error) }
    };
    cells.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(cells: &[&str], doubles: bool) -> Vec<f64> {
        let cells: Vec<Cell> = cells.iter().map(|text| Cell::parse(text).unwrap()).collect();
        numbers(&cells, doubles).iter().map(|number| number.error).collect()
    }

    #[test]
    fn a_number_has_the_digits_of_its_column() {
        for (cells, half) in [(["1", "1.25"], 0.005), ([".5", "2."], 0.05), (["1e3", "1.25e3"], 5.0)] {
            for error in errors(&cells, false) {
                approx::assert_relative_eq!(error, half, max_relative = 1e-6);
            }
        }
        assert!(errors(&["0.1", "0"], true)[0] < 1e-16);
        assert!(errors(&["", "nan"], false).iter().all(|error| *error == 0.0));
    }

    #[test]
    fn what_is_no_number_is_none() {
        for wrong in ["1,5", "x", "1.2.3", "0x10", "inf", "12 mm"] {
            assert!(Cell::parse(wrong).is_none(), "{wrong}");
        }
        assert!(Cell::parse("-0.123456789012345678").unwrap().is_whole_double());
        assert_eq!(
            errors(&["7.958865576007463e-300", "+1"], true),
            [7.958865576007463e-300 * f64::EPSILON, f64::EPSILON]
        );
        assert!(!Cell::parse("0.000000000000001").unwrap().is_whole_double());
    }
}
