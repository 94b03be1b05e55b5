//! Slips of the pen: two digits exchanged, one digit wrong, left out or added.

use super::answers::StudentCell;
use super::cause::MarkCause;

/// The slip that turns the right number into the written text, with the logarithm of the frequency of this slip.
/// `decimals` is the requested number of decimals.
pub(super) fn slip(cell: &StudentCell, right: f64, decimals: i32) -> Option<(MarkCause, f64)> {
    let digits = |text: &str| text.chars().filter(char::is_ascii_digit).collect::<Vec<char>>();
    let written = digits(&cell.text.to_lowercase().split('e').next().unwrap_or_default().replace(',', "."));
    if (cell.value < 0.0) != (right < 0.0) && cell.value != 0.0 {
        return None;
    }
    [cell.decimals, decimals].into_iter().find_map(|decimals| {
        let own = digits(&format!("{:.*}", usize::try_from(decimals).ok()?, right));
        let differing: Vec<usize> = (0..own.len().min(written.len())).filter(|&at| own[at] != written[at]).collect();
        let without = |text: &[char], at: usize| [&text[..at], &text[at + 1..]].concat();
        match (&differing[..], own.len() as isize - written.len() as isize) {
            (&[one, two], 0) if two == one + 1 && own[one] == written[two] && own[two] == written[one] => {
                Some((MarkCause::DigitsSwapped, -1.5))
            }
            ([_], 0) => Some((MarkCause::OneDigit, -4.0)),
            (_, 1) if (0..own.len()).any(|at| without(&own, at) == written) => Some((MarkCause::DigitLost, -4.0)),
            (_, -1) if (0..written.len()).any(|at| without(&written, at) == own) => Some((MarkCause::DigitLost, -4.0)),
            _ => None,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_pen_are_recognised() {
        let of = |text: &str, right: f64| {
            let value = text.replace(',', ".").parse().unwrap();
            let decimals = text.split([',', '.']).nth(1).map_or(0, str::len) as i32;
            slip(&StudentCell { text: text.into(), value, decimals }, right, 2).map(|(cause, _)| cause)
        };
        assert_eq!(of("13,24", 12.3401), Some(MarkCause::DigitsSwapped));
        assert_eq!(of("14.32", 12.34), None);
        assert_eq!(of("21.34", 12.34), Some(MarkCause::DigitsSwapped));
        assert_eq!(of("12,43", 12.34), Some(MarkCause::DigitsSwapped));
        assert_eq!(of("-17.34", -12.34), Some(MarkCause::OneDigit));
        assert_eq!(of("1.34", 12.34), Some(MarkCause::DigitLost));
        assert_eq!(of("122.34", 12.34), Some(MarkCause::DigitLost));
        assert_eq!(of("-12.43", 12.34), None);
    }
}
