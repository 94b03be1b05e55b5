//! Ranges on the command line.

use std::str::FromStr;

use crate::scenario::grid::range;

/// `FROM:TO:STEP`, both ends included.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Range(pub(super) Vec<f64>);

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(':').collect();
        let [from, to, step] = parts.as_slice() else {
            return Err(format!("found \"{text}\", expected FROM:TO:STEP, for example 0:360:30"));
        };
        let number = |part: &str| -> Result<f64, String> {
            part.trim().parse().map_err(|_| format!("\"{part}\" is not a number; expected FROM:TO:STEP"))
        };
        Ok(Range(range(number(from)?, number(to)?, number(step)?)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_include_both_ends() {
        assert_eq!("0:-90:-30".parse(), Ok(Range(vec![0.0, -30.0, -60.0, -90.0])));
    }

    #[test]
    fn bad_ranges_say_what_is_expected() {
        for text in ["0:360", "a:1:2", "0:360:0", "0:360:-1", "0:1:nan", "0:1e99:1e-9", ""] {
            let message = text.parse::<Range>().unwrap_err();
            assert!(!message.is_empty(), "{text}");
        }
    }
}
