//! Measures for a search of settings: how far an engine's channels are from being conclusive, which part dominates the
//! bounds, and whether the remaining work suffices.
//! See docs/numerics/settings.md.

use linkage::math::KeepNan;
use linkage::math::statistics::share;

use super::judge::Judged;
use crate::bounds::Verdict;
use crate::tolerance::BoundPart;

/// Largest fraction of the instants that may be left out because, with this step, they are too close to a reversal.
pub(super) const MOST_LEFT_OUT: f64 = 0.03;
/// If a step leaves out too many instants, the need is at least this number, as if a bound were this many times as
/// large as the requested bound.
const LEFT_OUT: f64 = 2.0;
/// If a larger fraction of the instants is left out, the remaining instants show neither a bound nor an order of
/// convergence. Only a finer step then helps, so the need is twice `LEFT_OUT`.
const TOO_FEW: f64 = 0.5;

/// The item that is farthest from being conclusive.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) enum Of {
    /// The bound of a channel or check.
    Bound,
    /// The instants that are not judged because the step is too coarse.
    Instants,
}

/// Distance of a trial from being conclusive.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Need {
    /// Whether the runs show no order of convergence, so that the bound means little.
    pub(super) is_vague: bool,
    /// Largest ratio of a bound to the requested bound.
    pub(super) share: f64,
    /// The item that has the ratio `share`.
    pub(super) of: Of,
}

impl Need {
    /// Whether the bound is reliable and at most `most` times the requested bound.
    pub(super) fn is_within(self, most: f64) -> bool {
        !self.is_vague && self.share <= most
    }

    /// Whether this trial is closer to conclusive than the trial `other`: its `share` is at most `part` times the
    /// `share` of `other`. A trial with an observed order of convergence is always closer than a trial without an
    /// observed order.
    pub(super) fn is_less(self, part: f64, other: Need) -> bool {
        match (self.is_vague, other.is_vague) {
            (false, true) => true,
            (true, false) => false,
            (true, true) | (false, false) => self.share <= part * other.share,
        }
    }

    /// Whether an order of convergence is observed, and the instants left out by the step determine `share`.
    pub(super) fn is_of_instants(self) -> bool {
        !self.is_vague && self.of == Of::Instants
    }
}

/// If the iteration part is the largest part of a bound but does not exceed this fraction of the bound, the step is to
/// blame too.
const SHARED: f64 = 0.8;

/// Cause of the largest bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Blame {
    /// The largest part of the bound. If no order of convergence is observed, the iteration part is taken instead,
    /// unless it is negligible.
    pub(super) part: BoundPart,
    /// Whether the step contributes much to a bound although the sweeps cause the largest part. Halving the step then
    /// reduces both contributions.
    pub(super) is_shared: bool,
}

/// The largest ratio of a bound of a channel or check to the requested bound (`wanted` times its scale), and its cause.
/// A channel or check whose runs show no order of convergence takes precedence over those with an order.
pub(super) fn need(judged: &Judged, wanted: f64) -> (Need, Blame) {
    let channels =
        judged.proof.channels.iter().map(|own| (own.parts, own.residual.scale, &own.convergence, &own.verdict));
    let checks = judged.proof.checks.iter().filter_map(|check| {
        let (parts, convergence) = check.estimate.as_ref()?;
        Some((*parts, 1.0, convergence, &check.verdict))
    });
    // If a step leaves out too many instants, the run proves nothing about these instants. The need is then at least
    // `LEFT_OUT`.
    let (least, of) = if judged.too_coarse > MOST_LEFT_OUT { (LEFT_OUT, Of::Instants) } else { (0.0, Of::Bound) };
    let none = Blame { part: BoundPart::Discretisation, is_shared: false };
    if judged.too_coarse > TOO_FEW {
        return (Need { is_vague: false, share: 2.0 * least, of }, none);
    }
    let mut worst = (Need { is_vague: false, share: least, of }, none);
    for (parts, scale, convergence, verdict) in channels.chain(checks) {
        let share = share(parts.sum(), wanted * scale);
        let is_open = matches!(verdict, Verdict::Inconclusive { .. });
        // If a verdict is inconclusive for another reason than the bound, no setting can change the verdict. The need
        // is then zero.
        let is_vague = is_open && !convergence.is_trusted();
        let share = if is_open && !is_vague && share <= 1.0 { 0.0 } else { share.larger(0.0) };
        let own = Need { is_vague, share: if share.is_nan() { f64::INFINITY } else { share }, of: Of::Bound };
        if own > worst.0 {
            // If no order is observed, the sweeps are to blame, unless the iteration part is negligible.
            let sweeps = is_vague && 10.0 * parts.iteration > parts.discretisation;
            let part = if sweeps { BoundPart::Iteration } else { parts.largest() };
            worst = (
                own,
                Blame { part, is_shared: part == BoundPart::Iteration && parts.iteration <= SHARED * parts.sum() },
            );
        }
    }
    worst
}

/// Number of rounds needed to determine a rate of progress. The first rounds of a search show only whether the settings
/// are meaningful.
const ROUNDS: usize = 4;
/// Factor on the observed exponent p of the law need = constant / work^p. The exponent may still increase, because
/// extrapolation becomes more effective as the runs become smooth.
/// For all shipped scenarios, the last rounds of a successful search progress at most twice as fast as the first
/// rounds.
const OPTIMISM: f64 = 2.0;

/// The rounds of a search: work so far, and the smallest need so far.
#[derive(Default)]
pub(super) struct Pace {
    rounds: Vec<[f64; 2]>,
}

impl Pace {
    /// Records a round; `effort` is the work of the search up to the end of this round. Returns whether `budget` is far
    /// too small.
    /// The need falls with a power of the work. The need at the end of the budget is predicted. If the predicted need
    /// exceeds 1, the budget is too small.
    /// The prediction uses [`OPTIMISM`] times the exponent that the last rounds show.
    pub(super) fn is_too_slow(&mut self, effort: f64, need: Need, budget: f64) -> bool {
        let least = self.rounds.last().map_or(f64::INFINITY, |[_, least]| *least).smaller(need.share);
        self.rounds.push([effort, least]);
        if self.rounds.len() < ROUNDS || need.is_within(1.0) {
            return false;
        }
        // Rounds without any bound show no rate of progress, so they are ignored.
        let last = &self.rounds[self.rounds.len() - ROUNDS..];
        let Some([before, most]) = last.iter().find(|[_, least]| least.is_finite()) else { return false };
        if *before >= effort {
            return false;
        }
        let exponent = (most / least).ln() / (effort / before).ln();
        least > (budget / effort).powf(OPTIMISM * exponent)
    }
}

/// Number of rounds without an order of convergence after which more sweeps are tried instead of a smaller step.
const MOST_VAGUE: usize = 2;
/// If halving the step reduces the bound to at most this fraction, the number of sweeps counts as sufficient.
const BRINGS: f64 = 0.7;
/// If more sweeps reduce the bound to at most this fraction, the additional sweeps are worth their work.
const HELPS: f64 = 0.5;
/// If halving the step doubles the bound, or more, in this number of consecutive rounds, rounding is to blame, even if
/// the rounding part of the bound is small.
const MOST_WIDER: usize = 2;
/// Number of rounds that must pass before more sweeps are tried again after more sweeps have helped little.
const PATIENCE: usize = 3;

/// Record of the rounds of a search that brought no progress.
#[derive(Default)]
pub(super) struct Stall {
    /// Need of the last round that had the same number of sweeps as the present round.
    before: Option<Need>,
    /// Number of consecutive rounds without an order of convergence.
    vague: usize,
    /// Number of consecutive rounds in which halving the step has doubled the bound or more.
    wider: usize,
    /// Sweeps and need of the previous round, if more sweeps are being tried.
    tried: Option<(usize, Need)>,
    /// Number of rounds until more sweeps may be tried again.
    wait: usize,
}

/// The next action of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Next {
    /// The search changes the settings on which this part of the bound depends.
    Blames(BoundPart),
    /// The search returns to this number of sweeps and reduces the step.
    Returns(usize),
}

impl Stall {
    /// Decides the next action after a round with `sweeps` sweeps. `need` is the need of the round, and `blame` is the
    /// part of the bound that is to blame.
    /// Too few sweeps may hide the order with which the error falls with the step, and the iteration part of the bound
    /// does not always show this. If a smaller step helps little and the number of sweeps is `free`, more sweeps are
    /// therefore tried.
    /// If a smaller step and more sweeps both help little, the search returns to the previous number of sweeps.
    pub(super) fn look_closer(&mut self, need: Need, blame: BoundPart, sweeps: usize, free: bool) -> Next {
        self.vague = if need.is_vague { self.vague + 1 } else { 0 };
        let before = self.before.replace(need);
        let tried = self.tried.take();
        self.wait = self.wait.saturating_sub(1);
        if blame != BoundPart::Discretisation || need.is_of_instants() {
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
            return Next::Blames(BoundPart::Rounding);
        }
        let is_stalled = self.vague >= MOST_VAGUE || before.is_some_and(|before| !need.is_less(BRINGS, before));
        if !is_stalled || self.wait > 0 || !free || need.is_within(1.0) {
            return Next::Blames(blame);
        }
        self.tried = Some((sweeps, need));
        Next::Blames(BoundPart::Iteration)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a search is given up in its last round. Each round is given as its work and its need.
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
    fn impulses_without_progress_are_given_up_in_round_four() {
        // Work and need in the first rounds for a parallelogram that swings through its change points.
        let flat = [(3.4e3, 1942.0), (7.4e3, 1893.0), (1.7e4, 1885.0), (2.5e4, 1917.0)];
        assert!(given_up(&flat, 1e6) && !given_up(&flat[..3], 1e6));
    }

    #[test]
    fn a_search_with_progress_is_not_given_up() {
        assert!(!given_up(&[(1.8e3, 67.3), (3.7e3, 20.3), (7.4e3, 5.7), (1.6e4, 1.9)], 1e6));
        // A search continues if it has just begun to show a bound, or if its bound is conclusive.
        let infinite = f64::INFINITY;
        assert!(!given_up(&[(1e3, infinite), (2e3, infinite), (4e3, infinite), (8e3, 3e4)], 1e6));
        assert!(!given_up(&[(1e3, 0.9), (2e3, 0.9), (4e3, 0.9), (8e3, 0.9)], 1e6));
    }

    #[test]
    fn the_same_rounds_continue_with_a_larger_budget() {
        // The need falls as the work grows. A budget of 1e5 is too small, but a hundred times this budget suffices.
        let rounds = [(1e3, 8e4), (2e3, 4e4), (4e3, 2e4), (8e3, 1e4)];
        assert!(given_up(&rounds, 1e5) && !given_up(&rounds, 1e7));
    }

    fn need(share: f64) -> Need {
        Need { is_vague: false, share, of: Of::Bound }
    }

    /// The actions that a search takes after each of these rounds. A round is given as its need and its number of
    /// sweeps.
    fn follow(rounds: &[(f64, usize)]) -> Vec<Next> {
        let mut stall = Stall::default();
        let next =
            |&(share, sweeps): &(f64, usize)| stall.look_closer(need(share), BoundPart::Discretisation, sweeps, true);
        rounds.iter().map(next).collect()
    }

    #[test]
    fn a_stalled_step_asks_for_sweeps_kept_only_if_they_help() {
        let [step, sweeps] = [BoundPart::Discretisation, BoundPart::Iteration].map(Next::Blames);
        assert_eq!(
            follow(&[(100.0, 16), (50.0, 16), (45.0, 16), (10.0, 64), (5.0, 64)]),
            [step, step, sweeps, step, step]
        );
        let given_up = follow(&[(100.0, 16), (90.0, 16), (89.0, 64), (80.0, 16), (75.0, 16), (70.0, 16)]);
        assert_eq!(given_up, [step, sweeps, Next::Returns(16), step, step, sweeps]);
    }

    #[test]
    fn bounds_that_grow_with_finer_steps_are_rounding() {
        let [step, rounding] = [BoundPart::Discretisation, BoundPart::Rounding].map(Next::Blames);
        let mut stall = Stall::default();
        let mut of = |share: f64| stall.look_closer(need(share), BoundPart::Discretisation, 16, false);
        assert_eq!([of(10.0), of(3.0), of(7.0), of(30.0)], [step, step, step, rounding]);
    }
}
