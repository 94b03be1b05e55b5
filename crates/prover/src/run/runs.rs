//! The runs from which an engine's error is estimated, and the largest step that stays within the reachable crank
//! angles.
//! See docs/numerics/settings.md.

use crate::sentences;
use std::sync::Arc;

use super::observe::{Observed, Stopped, Watch, observe};
use crate::bounds::{Ladder, OtherSweeps};
use crate::numbers::significant;
use analytic::range::{ASIDE, Extent, reachable};
use linkage::case::Case;
use linkage::engine::{CachedEngine, Engine, Settings, plain_runs, size_of_step};
use linkage::error::Advice;
use linkage::math::KeepNan;
use linkage::solver::Progress;
use linkage::work::limited;

/// The runs that judge an engine at some settings.
pub(super) struct Runs {
    /// Runs at double, single and half the step (or accuracy), the coarsest run first.
    pub(super) resolutions: [Arc<Observed>; 3],
    /// Runs at the single step, with other numbers of sweeps than the judged run.
    pub(super) other_sweeps: OtherSweeps<Arc<Observed>>,
}

impl Runs {
    pub(super) fn single(&self) -> &Observed {
        &self.resolutions[1]
    }

    pub(super) fn ladder(&self) -> Ladder<'_> {
        Ladder {
            resolutions: [0, 1, 2].map(|k| &self.resolutions[k].trajectory),
            other_sweeps: self.other_sweeps.map(|run| &run.trajectory),
        }
    }
}

/// Numbers of sweeps for the additional runs that are compared with a run with `sweeps` sweeps.
/// The first number is `sweeps` / `share`; the second is the first number divided by `share`.
/// If `sweeps` is one, the additional run has two sweeps. The list is empty if the iteration leaves no error.
pub(super) fn other_sweeps(case: &Case, engine: &dyn Engine, sweeps: usize, share: usize) -> Vec<usize> {
    match (sweeps, engine.sweeps(case)) {
        (_, None) | (1, Some([_, 1])) => Vec::new(),
        (1, Some(_)) => vec![2],
        (sweeps, Some(_)) => {
            let share = share.min(sweeps);
            [sweeps / share, sweeps / share / share].into_iter().filter(|&fewer| fewer > 0).collect()
        }
    }
}

/// Factor between the numbers of sweeps of two successive runs, if the number of sweeps is given.
pub(super) const FEWER: usize = 2;

/// Not all trajectories of a search are kept if a trajectory has more values than this number.
pub(super) const FEW: usize = 1_000_000;

/// All runs of one engine on one case. Each run is made and observed only once, unless it is large. Large runs are
/// dropped and made again when needed.
pub(super) struct Bank<'a> {
    pub(super) case: &'a Case,
    kept: CachedEngine,
    seen: Vec<(Settings, Arc<Observed>)>,
    watch: Watch,
    /// Number of plain runs (runs without extrapolation) made so far.
    pub(super) count: usize,
    /// Work of the plain runs made so far. The unit is a step without sweeps.
    pub(super) effort: f64,
}

impl<'a> Bank<'a> {
    pub(super) fn new(case: &'a Case, engine: &dyn Engine, watch: Watch) -> Self {
        Bank { case, kept: CachedEngine::new(engine), seen: Vec::new(), watch, count: 0, effort: 0.0 }
    }

    /// An engine with these settings that takes its runs from the bank.
    pub(super) fn engine(&self, settings: Settings) -> Box<dyn Engine> {
        self.kept.with(settings)
    }

    /// Makes the runs that are still missing for all `settings`, in parallel.
    pub(super) fn prepare(&mut self, settings: &[Settings], progress: Progress) {
        let missing = self.kept.missing(self.case, settings);
        self.count += missing.len();
        self.effort += self.work(&missing);
        self.kept.prepare(self.case, missing, progress);
    }

    /// Work that [`Bank::prepare`] would do.
    pub(super) fn missing(&self, settings: &[Settings]) -> f64 {
        self.work(&self.kept.missing(self.case, settings))
    }

    /// Work of plain runs on the case's grid. The work is counted and not measured in seconds, so that equal inputs
    /// give equal work.
    fn work(&self, runs: &[Settings]) -> f64 {
        let [first, last] = ends(self.case);
        size_of_step(self.case) * runs.iter().map(|run| (last - first) * run.work()).sum::<f64>()
    }

    /// Drops all runs whose number of sweeps is not in `sweeps`.
    pub(super) fn keep_sweeps(&mut self, sweeps: &[usize]) {
        self.kept.retain(|settings| sweeps.contains(&settings.sweeps));
        self.seen.retain(|(settings, _)| sweeps.contains(&settings.sweeps));
    }

    /// If the runs are large, drops the runs that `settings` do not need.
    pub(super) fn keep_needed(&mut self, settings: &[Settings]) {
        if self.is_large() {
            let needed: Vec<Settings> = settings.iter().copied().flat_map(plain_runs).collect();
            self.kept.retain(|own| needed.contains(own));
            self.keep_few(settings);
        }
    }

    /// Whether the case has so many instants that not all trajectories can be kept in memory.
    fn is_large(&self) -> bool {
        self.case.grid.len() * self.case.channels().len() > FEW
    }

    /// If the observations are large, drops the observations that `settings` do not need. Dropped observations can be
    /// computed again from the kept runs.
    fn keep_few(&mut self, settings: &[Settings]) {
        if self.is_large() {
            self.seen.retain(|(own, _)| settings.contains(own));
        }
    }

    /// Returns the run at `settings` with its observations.
    fn observed(&mut self, settings: Settings) -> Result<Arc<Observed>, Stopped> {
        if let Some((_, seen)) = self.seen.iter().find(|(own, _)| *own == settings) {
            return Ok(Arc::clone(seen));
        }
        let seen = Arc::new(observe(self.case, self.engine(settings).as_ref(), self.watch, &mut |_| {})?);
        self.seen.push((settings, Arc::clone(&seen)));
        Ok(seen)
    }

    /// The runs that judge the engine at `settings`: the runs at double, single and half the step (or accuracy), and
    /// the runs with the numbers of sweeps `others` (at most two numbers).
    pub(super) fn runs(&mut self, settings: Settings, others: &[usize], progress: Progress) -> Result<Runs, Stopped> {
        let rungs = rungs(settings, others);
        self.keep_few(&rungs);
        self.prepare(&rungs, progress);
        // The run at the single step comes first, because its error message is the most useful one.
        let single = self.observed(settings)?;
        let controls_error = self.kept.controls_error();
        let unit = if controls_error { "" } else { " s" };
        let mut auxiliary = |rung: Settings| {
            let what = match rung.sweeps == settings.sweeps {
                true => format!("at {}{unit}", significant(rung.resolution, 5)),
                false => sentences::with_sweeps(&rung.sweeps),
            };
            let failed = |stopped| in_ladder(stopped, &what, settings, controls_error);
            self.observed(rung).map_err(failed)
        };
        let half = auxiliary(rungs[1])?;
        let double = auxiliary(rungs[2])?;
        let mut fewer = rungs[3..].iter().map(|&rung| auxiliary(rung));
        let other_sweeps = [fewer.next().transpose()?, fewer.next().transpose()?];
        drop(fewer);
        let factor = others.first().map_or(1.0, |&fewer| settings.sweeps as f64 / fewer as f64);
        let other_sweeps = OtherSweeps { runs: other_sweeps, factor, growth: 0.0 };
        Ok(Runs { resolutions: [double, single, half], other_sweeps })
    }
}

/// Settings of the runs that judge an engine at `settings`: first with the single step (or accuracy), then with the
/// half and the double step, then with the other numbers of sweeps.
pub(super) fn rungs(settings: Settings, others: &[usize]) -> Vec<Settings> {
    let at = |factor: f64| Settings { resolution: settings.resolution * factor, ..settings };
    let other = others.iter().map(|&sweeps| Settings { sweeps, ..settings });
    [settings, at(0.5), at(2.0)].into_iter().chain(other).collect()
}

/// The failure `stopped` of an auxiliary run. The message names the failed run, because the user did not request this
/// run.
fn in_ladder(stopped: Stopped, what: &str, asked: Settings, controls_error: bool) -> Stopped {
    let told = |message: &str| sentences::the_run_from_which_the_error(&what, &message);
    // Values to try are based on the settings that the user requested.
    let advised = |advice: Advice| advice.from_settings(asked.resolution, controls_error, asked.sweeps);
    Stopped { error: stopped.error.map_message(told).map_advice(advised), kept: None, spent: None }
}

/// The first and the last time (s) of a run. A run begins at zero.
fn ends(case: &Case) -> [f64; 2] {
    case.grid.times.iter().fold([0.0; 2], |[first, last], &t| [first.smaller(t), last.larger(t)])
}

/// The largest step (s) for which a run of this engine stays within the reachable crank angles.
/// A run of a prescribed motion begins some steps before the first instant and ends some steps after the last instant.
/// Near a limit of rotation, the steps must be so small that the additional steps of a run stay within the limit.
/// The result is infinite if the crank makes full revolutions or if forces determine the motion.
pub(super) fn room(case: &Case, engine: &dyn Engine) -> f64 {
    let steps = engine.overrun();
    let Some([from, to]) = limits(case).filter(|_| steps > 0.0) else { return f64::INFINITY };
    let drive = case.crank();
    let at = |t: f64| {
        let own = drive.at(t);
        // The additional steps lie before the first instant or after the last, so they may lead towards either limit.
        // The nearer limit is therefore used.
        let distance = (own.value - from).abs().smaller((to - own.value).abs());
        distance / own.rate.abs() / steps
    };
    // An instant at which the drive is at rest does not limit the step.
    ends(case).map(at).into_iter().filter(|step| step.is_finite()).fold(f64::INFINITY, f64::smaller)
}

/// Limits of the crank angle (rad) in a prescribed motion of one drive.
/// `None` if the angle is not limited, or if the limits are still unknown after some work. An engine that reaches an
/// unknown limit reports the position that it cannot pass.
fn limits(case: &Case) -> Option<[f64; 2]> {
    if case.is_free() || case.drives.len() > 1 {
        return None;
    }
    match limited(ASIDE, || reachable(case)).0 {
        Ok(Extent::Limited(ends)) => Some(ends.map(|end| end.crank)),
        Ok(Extent::FullTurn(_)) | Err(_) => None,
    }
}
