//! Search of an engine's settings. Coarse runs come first.
//! The settings that cause the dominant part of the bound are refined until every channel is conclusive.
//! The search depends only on the engine's runs and on counted work. See docs/numerics/settings.md.

use crate::numbers::error;
use crate::sentences;
use linkage::engine::{Engine, Settings};
use linkage::error::{Advice, Error, ErrorKind};
use linkage::math::KeepNan;
use linkage::math::statistics::half_range;
use linkage::solver::Progress;

use super::engine_proof::{SearchEnd, SettingsSearch};
use super::judge::{Judge, Judged};
use super::need::{Blame, MOST_LEFT_OUT, Need, Next, Pace, Stall, need};
use super::observe::Stopped;
use super::order;
use super::runs::{Bank, FEWER, other_sweeps, room, rungs};
use crate::tolerance::BoundPart;
use scenario::EngineSettings;

/// Work allowed by default. The unit is a step without sweeps.
pub const BUDGET: f64 = 2e7;
/// A conclusive result is refined further, to the target accuracy, as long as the search has done less than this
/// fraction of the allowed work.
const THRIFT: f64 = 0.0015;
/// Target of the search: bounds at this fraction of the widest conclusive bound. With extrapolation, such bounds cost
/// little more work than conclusive bounds.
const AIM: f64 = 0.01;
/// Limit of extrapolations. In further extrapolations, the added rounding error would exceed the cancelled truncation
/// error.
const MOST_TIMES: usize = 4;
/// The coarsest step is at most this multiple of the first step.
/// Steps coarser than the first step are tried if rounding dominates.
const COARSEST: f64 = 16.0;
/// Work that the first runs may always do, because there is no result without the first runs. This work takes some
/// hundredths of a second.
pub(super) const FIRST: f64 = 1e4;
/// Whenever this number of runs have failed in a row, more sweeps are tried instead of a smaller step.
const FAILURES: usize = 6;
/// A run of a prescribed motion begins and ends a few steps outside the grid. The additional steps may take this
/// fraction of the angle to a dead centre.
const ROOM: f64 = 0.98;
/// Largest number of rounds of a short search.
const QUICK: i32 = 3;
/// Cause to blame if runs with fewer sweeps fail.
const SWEEPS: Blame = Blame { part: BoundPart::Iteration, is_shared: false };
/// Factors by which the sweeps are multiplied: at first, and near the end of a search.
const MORE_SWEEPS: [usize; 2] = [4, 2];
/// A bound counts as near if it is at most this multiple of the requested bound.
const NEAR: f64 = 8.0;

/// Returns an error if the first runs of an engine, at the settings `rungs`, need more work than `most`.
/// The error names the requested `budget`.
/// A step counts as a mistake of the user if it divides the motion into more than [`BUDGET`] steps. This function then
/// returns no error, because the engine rejects the step.
pub(super) fn too_much(
    bank: &Bank,
    settings: Settings,
    rungs: &[Settings],
    [most, budget]: [f64; 2],
) -> Result<(), Stopped> {
    let first = bank.missing(rungs);
    let is_mistake = 2.0 * half_range(&bank.case.grid.times) / settings.resolution > BUDGET;
    // This form of the comparison counts NaN as too much.
    if first <= most || is_mistake {
        return Ok(());
    }
    let message = sentences::the_first_runs_of_the_engine(&error(first), &error(budget));
    let error = Error::new(ErrorKind::Unsupported, message);
    Err(Stopped { error, kept: None, spent: Some(first) })
}

/// The judgement of one combination of the runs made so far.
struct Trial {
    judged: Judged,
    need: Need,
    blame: Blame,
}

/// The state of a search.
pub(super) struct Settling<'a, 'b> {
    judge: &'a Judge<'a>,
    bank: &'a mut Bank<'b>,
    given: &'a EngineSettings,
    /// Current settings, with the step of the finest run.
    now: Settings,
    most_sweeps: usize,
    /// Step of the coarsest run.
    coarsest: f64,
    budget: f64,
    /// Target: largest ratio of a bound to the requested bound.
    aim: f64,
    /// Whether the search ends as soon as all channels are conclusive.
    conclusive: bool,
    /// Lower limit of the step (s); 0 if the step is not limited.
    finest: f64,
    /// Factor by which the sweeps were last multiplied.
    factor: usize,
    /// Whether the bound of the last round was near the requested bound.
    near: bool,
    /// Largest step (s) for which runs do not reach a dead centre; `None` until this step is needed.
    room: Option<f64>,
}

impl<'a, 'b> Settling<'a, 'b> {
    /// A search that begins with the settings of `engine`.
    pub(super) fn new(
        judge: &'a Judge<'a>,
        bank: &'a mut Bank<'b>,
        engine: &dyn Engine,
        given: &'a EngineSettings,
        budget: f64,
    ) -> Self {
        let mut now = engine.settings();
        let [first, most] = engine.sweeps(bank.case).unwrap_or([now.sweeps; 2]);
        if given.sweeps.is_free() {
            now.sweeps = first;
        }
        // The search begins with three runs. `now` gets the finest step of these runs.
        let times = if given.extrapolated.is_free() { 0 } else { now.extrapolated };
        now.resolution *= 0.5f64.powi(times as i32 + 1);
        let coarsest = 2.0 * engine.settings().resolution;
        Settling {
            judge,
            bank,
            given,
            now,
            most_sweeps: most,
            coarsest,
            budget,
            aim: AIM,
            conclusive: false,
            finest: 0.0,
            factor: MORE_SWEEPS[0],
            near: false,
            room: None,
        }
    }

    /// A search that ends as soon as every channel is conclusive. The search begins with coarser steps and with at
    /// least `sweeps` sweeps, and chooses no step below `finest` (s).
    pub(super) fn conclusive(mut self, finest: f64, sweeps: usize) -> Self {
        (self.aim, self.conclusive, self.finest, self.factor) = (1.0, true, finest, MORE_SWEEPS[1]);
        if self.given.sweeps.is_free() {
            self.now.sweeps = self.now.sweeps.max(sweeps);
        }
        if self.given.step.is_free() {
            self.coarsest *= 4.0;
        }
        self
    }

    /// Whether the step cannot be refined further.
    fn is_finest(&self) -> bool {
        !self.given.step.is_free() || 0.5 * self.now.resolution < 0.99 * self.finest
    }

    /// Refines the settings until the verdict is conclusive, no finer setting is left, or the work limit is reached.
    ///
    /// # Errors
    /// The failure of the last run, if no run can be judged.
    /// An error if the first runs need more work than is allowed.
    pub(super) fn run(mut self, progress: Progress) -> Result<Judged, Stopped> {
        let mut best: Option<Trial> = None;
        let mut failure = None;
        let (mut round, mut failed) = (0, 0);
        let (mut stall, mut pace) = (Stall::default(), Pace::default());
        // Names of channels and checks that disagree: in the last round, and in two consecutive rounds.
        let (mut against, mut borne_out): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
        too_much(self.bank, self.now, &self.rungs(), [self.budget.larger(FIRST), self.budget])?;
        let end = loop {
            let left = 0.5f64.powi(round);
            let mut part = |part: f64| progress(1.0 - left + 0.5 * left * part);
            round += 1;
            let blame = match self.round(round > QUICK, &mut part) {
                Ok(trial) if trial.need.is_vague && self.makes_room() => {
                    best = best.or(Some(trial));
                    BoundPart::Discretisation
                }
                Ok(mut trial) => {
                    // If the order is wrong, neither a smaller step nor more sweeps help, so the search ends.
                    if round > QUICK && order::look(self.judge, self.bank, &mut trial.judged.proof)? {
                        borne_out = trial.judged.proof.against();
                        best = Some(trial);
                        break SearchEnd::Decided;
                    }
                    let now = trial.judged.proof.against();
                    borne_out = now.iter().filter(|name| against.contains(name)).cloned().collect();
                    against = now;
                    let disagrees = !against.is_empty();
                    let (decided, sharp) = (trial.need.is_within(1.0), trial.need.is_within(self.aim));
                    // If the sweeps cause only a part of the bound, the number of sweeps is multiplied by the smaller
                    // factor. Halving the step reduces the remaining part.
                    let is_careful = round > QUICK && !trial.need.is_vague && trial.blame.is_shared;
                    self.near = trial.need.is_within(NEAR) || is_careful;
                    let is_slow = self.conclusive && pace.is_too_slow(self.bank.effort, trial.need, self.budget);
                    let thrift = self.bank.effort > THRIFT * self.budget;
                    let blame = match stall.look_closer(
                        trial.need,
                        trial.blame.part,
                        self.now.sweeps,
                        self.given.sweeps.is_free(),
                    ) {
                        Next::Blames(part) => part,
                        Next::Returns(fewer) => {
                            self.now.sweeps = fewer;
                            BoundPart::Discretisation
                        }
                    };
                    if trial.need.is_of_instants() && self.given.step.is_free() {
                        self.leave_out_less(&trial.judged);
                    }
                    // The trial of this round replaces the best trial so far in three cases: its bounds are tighter,
                    // one of its channels or checks disagrees, or it is conclusive although the best trial disagrees.
                    let better = best.as_ref().is_none_or(|best| {
                        let refuted = decided && !best.judged.proof.against().is_empty();
                        disagrees || refuted || trial.need < best.need
                    });
                    if better {
                        best = Some(trial);
                    }
                    // A disagreement counts only if the next refinement confirms it.
                    if decided && (sharp || thrift) && (!disagrees || !borne_out.is_empty()) {
                        break SearchEnd::Decided;
                    }
                    if is_slow {
                        break SearchEnd::Pace;
                    }
                    blame
                }
                Err(stopped) if stopped.error.kind() == ErrorKind::Numeric => {
                    failure = Some(stopped);
                    // A failed run may need more sweeps or a smaller step. Most failed runs need a smaller step.
                    failed = if self.makes_room() { 0 } else { failed + 1 };
                    if failed > 0 && failed % FAILURES == 0 { BoundPart::Iteration } else { BoundPart::Discretisation }
                }
                Err(stopped) => return Err(stopped),
            };
            if let Some(end) = self.refine(blame) {
                break end;
            }
        };
        progress(1.0);
        let search = SettingsSearch { runs: self.bank.count, effort: self.bank.effort, budget: self.budget, end };
        match (best, failure) {
            (Some(mut best), _) => {
                // If the step is given, there is no finer run to confirm a disagreement. A disagreement is then judged
                // by the error estimate of the run itself.
                let is_over = matches!(end, SearchEnd::Budget | SearchEnd::Pace);
                let is_cut = self.given.sweeps.is_free() && is_over;
                if (!self.is_finest() || is_cut) && borne_out.is_empty() {
                    best.judged.proof.doubt(sentences::NO_FINER_RUN_BEARS_IT_OUT, &Advice::SmallerStep { to: None });
                }
                // Impulses converge with order 1, and sweeps leave larger errors in impulses than in the motion.
                // Disagreements are therefore not reported if the search ends before all channels are conclusive.
                if self.conclusive && is_over {
                    best.judged
                        .proof
                        .doubt(sentences::THE_OTHERS_ARE_NOT_CONCLUSIVE, &Advice::MoreWork { to: 10.0 * self.budget });
                }
                best.judged.proof.search = Some(search);
                Ok(best.judged)
            }
            (None, Some(stopped)) => {
                Err(Stopped { spent: (end == SearchEnd::Budget).then_some(self.budget), ..stopped })
            }
            (None, None) => unreachable!("a round ends with a trial or a failure"),
        }
    }

    /// Chooses smaller steps for the next rounds, so that the runs leave out fewer instants.
    /// The number of instants that a run leaves out is proportional to its step.
    fn leave_out_less(&mut self, judged: &Judged) {
        let most = judged.proof.info.settings.resolution * MOST_LEFT_OUT / judged.too_coarse;
        // The next round halves the step again, so a step of `most` is small enough.
        while self.now.resolution > most && !self.is_finest() {
            self.now.resolution *= 0.5;
        }
        while self.coarsest > 4.0 * most.larger(self.now.resolution) {
            self.coarsest *= 0.5;
        }
    }

    /// Chooses smaller steps if a run with the steps of this round goes beyond a dead centre. Runs through a dead
    /// centre fail or show no order of convergence. Returns whether the steps were too large.
    fn makes_room(&mut self) -> bool {
        let (case, engine) = (self.judge.problem.case, self.bank.engine(self.now));
        let most = *self.room.get_or_insert_with(|| room(case, engine.as_ref()));
        let is_cramped = 4.0 * self.now.resolution > most && !self.is_finest();
        if is_cramped {
            // The finest step of the next round must be at most a quarter of `most`. The next round halves the present
            // step, so the present step may be half of `most`. The largest permitted step is chosen, because a large
            // step keeps rounding small.
            if self.finest == 0.0 {
                self.now.resolution = self.now.resolution.smaller(ROOM * 0.5 * most);
            }
            while 2.0 * self.now.resolution > most && !self.is_finest() {
                self.now.resolution *= 0.5;
            }
            self.coarsest = 2.0 * self.now.resolution;
        }
        is_cramped
    }

    /// Changes the settings on which the part `blame` of the bound depends. If no setting can be changed, the search
    /// ends, and this function returns the kind of end.
    fn refine(&mut self, blame: BoundPart) -> Option<SearchEnd> {
        let mut next = self.now;
        let factor = MORE_SWEEPS[usize::from(self.conclusive || self.near)];
        match blame {
            BoundPart::Iteration if self.given.sweeps.is_free() && self.now.sweeps < self.most_sweeps => {
                next.sweeps *= factor
            }
            // If the step cannot be refined, only the sweeps can be increased. Too few sweeps hide the order of
            // convergence.
            BoundPart::Discretisation
                if self.is_finest() && self.given.sweeps.is_free() && self.now.sweeps < self.judge.asked.sweeps =>
            {
                next.sweeps *= factor;
            }
            // Coarser runs with more extrapolations have less rounding error than finer runs with fewer extrapolations.
            BoundPart::Rounding
                if self.given.step.is_free() && self.coarsest < COARSEST * self.judge.asked.resolution =>
            {
                self.coarsest = COARSEST * self.judge.asked.resolution;
                return None;
            }
            // If rounding is to blame, coarser steps have already been tried. If the reference is to blame, no step
            // reduces its error.
            BoundPart::Rounding | BoundPart::Reference if self.given.step.is_free() => {
                return Some(SearchEnd::Rounding);
            }
            BoundPart::Rounding | BoundPart::Reference => return Some(SearchEnd::Nothing),
            BoundPart::Discretisation | BoundPart::Iteration if !self.is_finest() => next.resolution *= 0.5,
            BoundPart::Discretisation | BoundPart::Iteration => return Some(SearchEnd::Nothing),
        }
        if next.sweeps != self.now.sweeps {
            self.bank.keep_sweeps(&[next.sweeps, self.now.sweeps]);
            self.factor = factor;
        }
        let previous = std::mem::replace(&mut self.now, next);
        if self.bank.effort + self.bank.missing(&self.rungs()) > self.budget {
            self.now = previous;
            return Some(SearchEnd::Budget);
        }
        None
    }

    /// Settings at which this round can judge the engine, those with the most extrapolations first. Each judgement
    /// combines several runs, and the finest run is one of them.
    fn candidates(&self) -> Vec<Settings> {
        let asked = self.judge.asked;
        let times =
            if self.given.extrapolated.is_free() { 0..=MOST_TIMES } else { asked.extrapolated..=asked.extrapolated };
        let at = |times: usize| Settings {
            resolution: self.now.resolution * 2f64.powi(times as i32 + 1),
            extrapolated: times,
            ..self.now
        };
        // A judgement needs steps up to four times the finest step.
        let coarsest = self.coarsest.larger(4.0 * self.now.resolution);
        let is_open =
            |settings: &Settings| !self.given.step.is_free() || 2.0 * settings.resolution <= coarsest * 1.000_001;
        times.rev().map(at).filter(is_open).collect()
    }

    /// Settings of the runs of this round.
    fn rungs(&self) -> Vec<Settings> {
        self.candidates().into_iter().flat_map(|settings| rungs(settings, &[])).collect()
    }

    /// Makes the runs of a round, judges their combinations and returns the best combination.
    /// If `is_long` is true (a long search), the iteration error is determined even if the step is to blame for the
    /// bound.
    fn round(&mut self, is_long: bool, progress: Progress) -> Result<Trial, Stopped> {
        let mut best: Option<Trial> = None;
        let mut failure = None;
        let candidates = self.candidates();
        let all = self.rungs();
        self.bank.keep_needed(&all);
        self.bank.prepare(&all, &mut |part| progress(0.7 * part));
        for settings in candidates {
            let trial = match self.trial(settings, &[], &mut |_| {}) {
                Ok(trial) => trial,
                Err(stopped) => {
                    failure = Some(stopped);
                    continue;
                }
            };
            if best.as_ref().is_none_or(|best| trial.need < best.need) {
                let sharp = trial.need.is_within(self.aim);
                best = Some(trial);
                if sharp {
                    break;
                }
            }
        }
        let Some(best) = best else { return Err(failure.expect("every round has a candidate")) };
        // In the first rounds, the iteration error is determined only if the step is not to blame for the bound.
        let settings = best.judged.proof.info.settings;
        let engine = self.bank.engine(settings);
        let share = if self.given.sweeps.is_free() { self.factor } else { FEWER };
        let others = other_sweeps(self.bank.case, engine.as_ref(), settings.sweeps, share);
        let disagrees = !best.judged.proof.against().is_empty();
        let is_asking = is_long && !self.conclusive && !best.need.is_of_instants();
        if others.is_empty() || (best.need.share > 1.0 && !best.need.is_vague && !disagrees && !is_asking) {
            return Ok(best);
        }
        let found = match self.trial(settings, &others[..1], &mut |part| progress(0.7 + 0.2 * part)) {
            // If a run with fewer sweeps fails, the judged run may have too few sweeps as well.
            Err(stopped) if stopped.error.kind() == ErrorKind::Numeric => {
                return Ok(Trial { need: Need { is_vague: true, ..best.need }, blame: SWEEPS, ..best });
            }
            found => found?,
        };
        // A third run shows how fast the sweeps converge, before the number of sweeps is multiplied. Before a channel
        // is reported as disagreeing, the third run also shows whether the sweeps converge at all. Two runs cannot show
        // this: while the sweeps have hardly begun to converge, runs with different numbers of sweeps differ little.
        let is_asked =
            found.blame.part == BoundPart::Iteration && !found.need.is_within(self.aim) && self.given.sweeps.is_free();
        if others.len() < 2 || (!is_asked && found.judged.proof.against().is_empty()) {
            return Ok(found);
        }
        match self.trial(settings, &others, &mut |part| progress(0.9 + 0.1 * part)) {
            // If a run with fewer sweeps fails, the judged run may have too few sweeps as well.
            Err(stopped) if stopped.error.kind() == ErrorKind::Numeric && !found.judged.proof.against().is_empty() => {
                Ok(Trial { need: Need { is_vague: true, ..found.need }, blame: SWEEPS, ..found })
            }
            Err(stopped) if stopped.error.kind() == ErrorKind::Numeric => Ok(found),
            better => better,
        }
    }

    fn trial(&mut self, settings: Settings, others: &[usize], progress: Progress) -> Result<Trial, Stopped> {
        let runs = self.bank.runs(settings, others, progress)?;
        let judged = self.judge.judge(self.bank.engine(settings).as_ref(), runs)?;
        let (need, blame) = need(&judged, self.judge.problem.engine_rel);
        Ok(Trial { judged, need, blame })
    }
}
