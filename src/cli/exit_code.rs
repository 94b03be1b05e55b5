//! Exit codes.

use prover::bounds::Verdict;

/// Exit code when everything agrees.
pub const AGREE: u8 = 0;

/// Exit code when something disagrees.
pub const DISAGREE: u8 = 1;

/// Exit code for bad input or usage.
pub const BAD_INPUT: u8 = 2;

/// Exit code if the result is inconclusive.
pub const INCONCLUSIVE: u8 = 3;

/// The exit code of a verdict.
pub fn of(verdict: &Verdict) -> u8 {
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => AGREE,
        Verdict::Disagree { .. } => DISAGREE,
        Verdict::Inconclusive { .. } => INCONCLUSIVE,
    }
}

/// The more serious of two exit codes.
/// The order is: bad input, disagreement, inconclusive, agreement; bad input is the most serious.
pub fn graver(a: u8, b: u8) -> u8 {
    [BAD_INPUT, DISAGREE, INCONCLUSIVE].into_iter().find(|code| [a, b].contains(code)).unwrap_or(a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_outcome_decides_the_exit_code() {
        assert_eq!([0, 3, 1].into_iter().fold(0, graver), 1);
        assert_eq!([2, 1, 0].into_iter().fold(0, graver), 2);
        assert_eq!([0, 3, 0].into_iter().fold(0, graver), 3);
    }
}
