//! Whether a search that goes on as in its rounds so far becomes conclusive with the work that is allowed.

use linkage::math::KeepNan;

use super::need::Need;

/// Rounds before a pace is told: the first ones show whether the settings mean anything.
const ROUNDS: usize = 4;
/// Factor on the observed exponent: extrapolation may gain speed as the runs become smooth. Searches that end well
/// gain twice as fast at the end as in their first rounds at most (all shipped scenarios).
const OPTIMISM: f64 = 2.0;

/// The rounds of a search: work so far, and the least need so far.
#[derive(Default)]
pub(super) struct Pace {
    rounds: Vec<[f64; 2]>,
}

impl Pace {
    /// Notes a round that ends with this work done. Returns whether `budget` is too little by far: the need falls with a
    /// power of the work, and even with twice the power seen in the last rounds it stays above 1.
    pub(super) fn is_too_slow(&mut self, effort: f64, need: Need, budget: f64) -> bool {
        let least = self.rounds.last().map_or(f64::INFINITY, |[_, least]| *least).smaller(need.share);
        self.rounds.push([effort, least]);
        if self.rounds.len() < ROUNDS || need.is_within(1.0) {
            return false;
        }
        // Rounds without any bound show no pace.
        let last = &self.rounds[self.rounds.len() - ROUNDS..];
        let Some([before, most]) = last.iter().find(|[_, least]| least.is_finite()) else { return false };
        if *before >= effort {
            return false;
        }
        let exponent = (most / least).ln() / (effort / before).ln();
        least > (budget / effort).powf(OPTIMISM * exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::need::Of;

    /// Whether a search is given up in its last round, of rounds with work and need.
    fn given_up(rounds: &[(f64, f64)], budget: f64) -> bool {
        let mut pace = Pace::default();
        let told = rounds
            .iter()
            .map(|&(effort, share)| pace.is_too_slow(effort, Need { is_vague: false, share, of: Of::Bound }, budget));
        let told: Vec<bool> = told.collect();
        let (last, before) = told.split_last().expect("there are rounds");
        assert!(!before.contains(&true), "{told:?}");
        *last
    }

    #[test]
    fn impulses_that_no_step_makes_better_are_given_up_in_the_fourth_round() {
        // The first rounds of a parallelogram that swings through its change points.
        let flat = [(3.4e3, 1942.0), (7.4e3, 1893.0), (1.7e4, 1885.0), (2.5e4, 1917.0)];
        assert!(given_up(&flat, 1e6) && !given_up(&flat[..3], 1e6));
    }

    #[test]
    fn a_search_that_gets_on_is_not_given_up() {
        assert!(!given_up(&[(1.8e3, 67.3), (3.7e3, 20.3), (7.4e3, 5.7), (1.6e4, 1.9)], 1e6));
        // Nor one that has just begun to show a bound, or that has one that decides.
        let infinite = f64::INFINITY;
        assert!(!given_up(&[(1e3, infinite), (2e3, infinite), (4e3, infinite), (8e3, 3e4)], 1e6));
        assert!(!given_up(&[(1e3, 0.9), (2e3, 0.9), (4e3, 0.9), (8e3, 0.9)], 1e6));
    }

    #[test]
    fn the_same_rounds_may_do_with_more_work() {
        // The need falls as the work grows: a hundredth of it is missing.
        let rounds = [(1e3, 8e4), (2e3, 4e4), (4e3, 2e4), (8e3, 1e4)];
        assert!(given_up(&rounds, 1e5) && !given_up(&rounds, 1e7));
    }
}
