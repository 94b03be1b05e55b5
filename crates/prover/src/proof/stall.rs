//! What to do where a smaller step brings a search little.

use super::need::Need;
use crate::tolerance::Part;

/// Rounds without an order of convergence after which more sweeps are tried instead of a smaller step.
const MOST_VAGUE: usize = 2;
/// Part of the bound down to which half the step must bring it, so that it is not the sweeps that are too few.
const BRINGS: f64 = 0.7;
/// Part of the bound down to which more sweeps must bring it to be worth their work.
const HELPS: f64 = 0.5;
/// Rounds with finer steps and wider bounds after which rounding is to blame, also where the engine's noise is thought
/// to be less.
const MOST_WIDER: usize = 2;
/// Rounds that pass before more sweeps are tried again, where they have brought little.
const PATIENCE: usize = 3;

/// What a search has seen of steps that do not bring it on.
#[derive(Default)]
pub(super) struct Stall {
    /// Need of the round before, with as many sweeps.
    before: Option<Need>,
    /// Rounds without an order of convergence, one after the other.
    vague: usize,
    /// Rounds in which half the step has made the bound wider, one after the other.
    wider: usize,
    /// Sweeps of the round before, and its need, if more sweeps are just tried.
    tried: Option<(usize, Need)>,
    /// Rounds until more sweeps may be tried again.
    wait: usize,
}

/// What a search does next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Next {
    /// It changes what this part depends on.
    Blames(Part),
    /// It goes back to as many sweeps, and takes a smaller step.
    Returns(usize),
}

impl Stall {
    /// What to do after a round with `sweeps`, by its need and the part that is to blame. Too few sweeps may hide the
    /// order of the step, and what they leave does not always show: where a smaller step brings little, more sweeps are
    /// tried, if they are `free`, and are given up where they bring little too.
    pub(super) fn look_closer(&mut self, need: Need, blame: Part, sweeps: usize, free: bool) -> Next {
        self.vague = if need.is_vague { self.vague + 1 } else { 0 };
        let before = self.before.replace(need);
        let tried = self.tried.take();
        self.wait = self.wait.saturating_sub(1);
        if blame != Part::Discretisation || need.is_of_instants() {
            return Next::Blames(blame);
        }
        if let Some((fewer, before)) = tried {
            if need.is_less(HELPS, before) {
                return Next::Blames(blame);
            }
            (self.wait, self.before) = (PATIENCE, Some(before));
            return Next::Returns(fewer);
        }
        self.wider = if before.is_some_and(|before| before.is_less(0.5, need)) { self.wider + 1 } else { 0 };
        if self.wider >= MOST_WIDER {
            return Next::Blames(Part::Rounding);
        }
        let is_stalled = self.vague >= MOST_VAGUE || before.is_some_and(|before| !need.is_less(BRINGS, before));
        if !is_stalled || self.wait > 0 || !free || need.is_within(1.0) {
            return Next::Blames(blame);
        }
        self.tried = Some((sweeps, need));
        Next::Blames(Part::Iteration)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::need::Of;

    fn need(share: f64) -> Need {
        Need { is_vague: false, share, of: Of::Bound }
    }

    /// The rounds of a search: need, blame and sweeps, and what it does next.
    fn follow(rounds: &[(f64, usize)]) -> Vec<Next> {
        let mut stall = Stall::default();
        let next = |&(share, sweeps): &(f64, usize)| stall.look_closer(need(share), Part::Discretisation, sweeps, true);
        rounds.iter().map(next).collect()
    }

    #[test]
    fn a_step_that_brings_little_asks_for_sweeps_and_they_stay_if_they_help() {
        let [step, sweeps] = [Part::Discretisation, Part::Iteration].map(Next::Blames);
        assert_eq!(
            follow(&[(100.0, 16), (50.0, 16), (45.0, 16), (10.0, 64), (5.0, 64)]),
            [step, step, sweeps, step, step]
        );
        let given_up = follow(&[(100.0, 16), (90.0, 16), (89.0, 64), (80.0, 16), (75.0, 16), (70.0, 16)]);
        assert_eq!(given_up, [step, sweeps, Next::Returns(16), step, step, sweeps]);
    }

    #[test]
    fn bounds_that_grow_with_finer_steps_are_rounding() {
        let [step, rounding] = [Part::Discretisation, Part::Rounding].map(Next::Blames);
        let mut stall = Stall::default();
        let mut of = |share: f64| stall.look_closer(need(share), Part::Discretisation, 16, false);
        assert_eq!([of(10.0), of(3.0), of(7.0), of(30.0)], [step, step, step, rounding]);
    }
}
