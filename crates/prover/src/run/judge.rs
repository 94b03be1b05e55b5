//! Judges one engine at some settings from its runs: estimates its error and gives a verdict on every channel.

use crate::sentences;
use std::collections::BTreeSet;
use std::sync::Arc;

use super::checks;
use super::doubt::Doubt;
use super::engine_proof::{ChannelProof, EngineInfo, EngineProof};
use super::known::Known;
use super::observe::Observed;
use super::problem::{Problem, built};
use super::runs::Runs;
use crate::bounds::{Convergence, Ladder, Residual, Verdict, largest_difference, overall, residuals_on, scales_beyond};
use crate::tolerance::Parts;
use linkage::case::{Case, Grid};
use linkage::engine::{Engine, Settings};
use linkage::error::{Advice, Result};
use linkage::math::statistics::half_range;
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::{Channel, ChannelKind, ChannelSubject, Stage, Trajectory, Unit};

/// Length of the beginning of a free motion, in steps of the coarsest run. In the beginning, second differences are
/// taken from later steps.
const BEGINNING: f64 = 5.0;
/// The beginning of a free motion is left out if rounding exceeds this fraction of the widest conclusive bound.
const MOST_ROUNDING: f64 = 0.1;

/// Number of values of one run that are copied at a time for a comparison.
const COPIED: usize = 1_000_000;
/// Number of channels compared at a time as one batch. The look-up of a channel searches one batch.
const AT_A_TIME: usize = 256;

/// A difference between runs with different numbers of sweeps is ignored if it is below this fraction of the widest
/// conclusive bound.
const COUNTS: f64 = 0.01;

/// A step is too long for a motion if the largest acceleration of a link, multiplied by the step, is more than this
/// multiple of the range of the link's speed.
const OUTRUN: f64 = 10.0;

/// What is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asks {
    /// All channels, and the additional checks.
    All,
    /// Reactions and balancing moment as the engine itself exerts them.
    /// Shaking force and shaking moment are left out, because they are sums of the judged forces and moments.
    OwnForces,
}

impl Asks {
    fn has(self, kind: &ChannelKind) -> bool {
        match self {
            Asks::All => true,
            Asks::OwnForces => kind.stage >= Stage::Reactions && kind.subject != ChannelSubject::Frame,
        }
    }
}

/// Data by which an engine's runs are judged.
pub(super) struct Judge<'a> {
    pub(super) problem: Problem<'a>,
    pub(super) reference: &'a Observed,
    /// Scales of the reference's channels.
    scales: Vec<f64>,
    /// Known errors of the reference.
    known: &'a Known,
    /// Requested settings, with which the search begins.
    pub(super) asked: Settings,
    /// What is judged.
    pub(super) asks: Asks,
}

/// Judgement of an engine at some settings.
pub(super) struct Judged {
    pub(super) proof: EngineProof,
    /// The judged run.
    pub(super) run: Arc<Observed>,
    /// Fraction of the instants that are left out because the step is too coarse.
    pub(super) too_coarse: f64,
}

/// An engine's runs, reduced to the instants at which the channels of one stage are judged.
struct Stand<'a> {
    engine: &'a dyn Engine,
    /// The engine with the settings of its finest run.
    finest: &'a dyn Engine,
    /// The case on the judged instants.
    case: &'a Case,
    ladder: Ladder<'a>,
    reference: &'a Trajectory,
    left_out: usize,
    /// Rounding errors of the runs of `engine` and of `finest`, by kind of channel.
    noise: Vec<(&'static ChannelKind, [f64; 2])>,
}

impl Stand<'_> {
    fn noise(&mut self, kind: &'static ChannelKind) -> [f64; 2] {
        if let Some((_, found)) = self.noise.iter().find(|(own, _)| std::ptr::eq(*own, kind)) {
            return *found;
        }
        let found = [self.engine, self.finest].map(|engine| engine.noise(self.case, kind));
        self.noise.push((kind, found));
        found
    }
}

impl<'a> Judge<'a> {
    pub(super) fn new(problem: Problem<'a>, reference: &'a Observed, known: &'a Known, asked: Settings) -> Self {
        let channels = reference.trajectory.channels().iter().enumerate();
        let errors: Vec<f64> = channels.map(|(index, channel)| known.error(channel.kind.stage, index)).collect();
        let scales = scales_beyond(&errors, &reference.trajectory, &built(problem.case));
        Judge { problem, reference, scales, known, asked, asks: Asks::All }
    }

    /// This judge, for a search that begins with the settings `asked`.
    pub(super) fn asking(&self, asked: Settings) -> Self {
        Judge { asked, scales: self.scales.clone(), ..*self }
    }

    /// This judge, for the forces that an engine itself exerts.
    pub(super) fn of_own_forces(self) -> Self {
        Judge { asks: Asks::OwnForces, ..self }
    }

    /// Whether the reference has a channel to judge.
    pub(super) fn has_channels(&self) -> bool {
        self.reference.trajectory.channels().iter().any(|channel| self.asks.has(channel.kind))
    }

    /// Judges an engine by its runs.
    pub(super) fn judge(&self, engine: &dyn Engine, mut runs: Runs) -> Result<Judged> {
        runs.other_sweeps.growth = self.growth(&runs);
        let doubt = Doubt::of(self.problem.case, self.reference, &runs, engine.settings());
        let late = self.after_the_beginning(engine)?;
        let channels = self.channels(engine, &runs, &doubt, late.as_ref())?;
        let checks = match self.asks {
            Asks::All => checks::of_engine(self.problem, engine, &runs),
            Asks::OwnForces => Vec::new(),
        };
        let verdict = overall(channels.iter().map(|c| &c.verdict).chain(checks.iter().map(|c| &c.verdict)));
        let case = late.as_ref().unwrap_or(self.problem.case);
        let (too_coarse, kept) = (doubt.too_coarse(), self.kept(&doubt, Stage::Reactions, case));
        let [_, run, _] = runs.resolutions;
        let mut proof = EngineProof { channels, checks, kept, ..EngineProof::bare(EngineInfo::of(engine), verdict) };
        if !engine.controls_error() && self.outruns(engine.settings().resolution) {
            let why = sentences::THE_MOTION_CHANGES_WITHIN_A_FRACTION;
            proof.doubt(why, &Advice::SmallerStep { to: None });
        }
        Ok(Judged { proof, run, too_coarse })
    }

    /// Whether, in a free motion, the largest acceleration of a link, multiplied by the step, is many times the range
    /// of the link's speed.
    /// This occurs with a motor that is much too strong for its load.
    /// Runs with such long steps agree with each other although they are wrong, because no run resolves the motion.
    fn outruns(&self, step: f64) -> bool {
        let reference = &self.reference.trajectory;
        let times = reference.times();
        let span = 2.0 * half_range(times);
        if !self.problem.case.is_free() || !(span > 0.0) {
            return false;
        }
        let of = |unit: Unit| reference.iter().filter(move |(channel, _)| channel.kind.unit == unit);
        of(Unit::RadianPerSecondSquared).any(|(gains, values)| {
            let speeds = of(Unit::RadianPerSecond).find(|(speeds, _)| speeds.of == gains.of);
            let gained = largest_size(values) * step.smaller(span);
            speeds.is_some_and(|(_, speeds)| gained > OUTRUN * 2.0 * half_range(speeds))
        })
    }

    /// Largest growth, with the number of sweeps, of the differences between runs.
    /// The growth is the maximum over all position channels with differences that are not negligible.
    /// For the engine's own forces, the growth is the maximum over these forces, because separate simulations compute
    /// them.
    fn growth(&self, runs: &Runs) -> f64 {
        let Ladder { resolutions: [_, single, _], other_sweeps } = runs.ladder();
        let of = |(channel, scale): (&Channel, &f64)| {
            let (own, others) = single.column(channel).zip(other_sweeps.column(channel))?;
            Some(others.growth(own, COUNTS * self.problem.engine_rel * scale, channel.kind.periodic))
        };
        let all = self.reference.trajectory.channels().iter().zip(&self.scales);
        let speaks = |channel: &Channel| match self.asks {
            Asks::All => channel.kind.stage == Stage::Positions,
            Asks::OwnForces => self.asks.has(channel.kind),
        };
        all.filter(|(channel, _)| speaks(channel)).filter_map(of).fold(0.0, f64::larger)
    }

    fn channels(
        &self,
        engine: &dyn Engine,
        runs: &Runs,
        doubt: &Doubt,
        late: Option<&Case>,
    ) -> Result<Vec<ChannelProof>> {
        let finest = engine.at(engine.settings().resolution / 2.0);
        let channels = self.reference.trajectory.channels();
        let mut all = Vec::with_capacity(channels.len());
        // All channels of a stage are judged at the same instants.
        for stage in Stage::ALL {
            let is_own = |channel: &Channel| channel.kind.stage == stage && self.asks.has(channel.kind);
            let indices: Vec<usize> = (0..channels.len()).filter(|&index| is_own(&channels[index])).collect();
            if indices.is_empty() {
                continue;
            }
            let case = late.filter(|_| stage >= Stage::Accelerations).unwrap_or(self.problem.case);
            let keep = self.kept(doubt, stage, case);
            let left_out = keep.iter().filter(|&&kept| !kept).count();
            // If there are many instants, only a few channels are copied at a time, and each copy is dropped before the
            // next.
            for indices in indices.chunks((COPIED / keep.len().max(1)).clamp(1, AT_A_TIME)) {
                let name = |channel: &'a Channel| (channel.of.as_str(), std::ptr::from_ref(channel.kind));
                let asked: BTreeSet<_> = indices.iter().map(|&index| name(&channels[index])).collect();
                let is_asked =
                    |channel: &Channel| asked.contains(&(channel.of.as_str(), std::ptr::from_ref(channel.kind)));
                let thin = |trajectory: &Trajectory| trajectory.part(&keep, &is_asked);
                let ladder = runs.ladder();
                let resolutions = ladder.resolutions.map(thin);
                let others = ladder.other_sweeps.map(|run| thin(run));
                let [double, single, half] = &resolutions;
                let ladder = Ladder { resolutions: [double, single, half], other_sweeps: others.map(|run| run) };
                let reference = &thin(&self.reference.trajectory);
                let scales: Vec<f64> = indices.iter().map(|&index| self.scales[index]).collect();
                let mut stand =
                    Stand { engine, finest: finest.as_ref(), case, ladder, reference, left_out, noise: Vec::new() };
                for (&index, residual) in indices.iter().zip(residuals_on(&scales, reference, single)?) {
                    all.push((index, self.channel(&mut stand, residual, index)));
                }
            }
        }
        all.sort_by_key(|(index, _)| *index);
        Ok(all.into_iter().map(|(_, proof)| proof).collect())
    }

    /// For every row, whether the channels of a stage are judged.
    /// A row is judged if no channel of the stage jumps at this row and the row is not before the first instant of
    /// `case`.
    fn kept(&self, doubt: &Doubt, stage: Stage, case: &Case) -> Vec<bool> {
        let first = case.grid.times.iter().copied().fold(f64::INFINITY, f64::smaller);
        doubt
            .keeps(stage)
            .into_iter()
            .zip(self.reference.trajectory.times())
            .map(|(kept, &t)| kept && t >= first)
            .collect()
    }

    /// The case without the beginning of a free motion, in which second differences use later steps. In the following
    /// cases, no instant is left out and the result is `None`:
    /// - in a prescribed motion;
    /// - in a motion that is not longer than its beginning;
    /// - if no impulses are judged, and accelerations and forces are conclusive despite the rounding error of second
    ///   differences.
    fn after_the_beginning(&self, engine: &dyn Engine) -> Result<Option<Case>> {
        let case = self.problem.case;
        let last = case.grid.times.iter().copied().fold(0.0, f64::larger);
        let begin = BEGINNING * 2.0 * engine.settings().resolution;
        if !case.is_free() || begin >= last {
            return Ok(None);
        }
        let wanted = self.problem.engine_rel;
        let is_open = self.reference.trajectory.channels().iter().zip(&self.scales).any(|(channel, scale)| {
            let noise = engine.noise(case, channel.kind);
            let stage = channel.kind.stage;
            stage >= Stage::Accelerations && self.asks.has(channel.kind) && noise > MOST_ROUNDING * wanted * scale
        });
        let late = || case.grid.times.iter().copied().filter(|&t| t > begin).collect();
        // If impulses are judged, the beginning is always left out, however small the rounding error is: the impulses
        // of the first steps are computed from later steps.
        let impulses = self.asks == Asks::OwnForces;
        (is_open || impulses).then(|| case.on(Grid::of_times(case.crank(), late()))).transpose()
    }

    fn channel(&self, stand: &mut Stand, residual: Residual, index: usize) -> ChannelProof {
        let (channel, kind) = (residual.channel.clone(), residual.channel.kind);
        let [noise, finest] = stand.noise(kind);
        let Stand { engine, case, ladder, reference, left_out, .. } = *stand;
        let Settings { resolution, sweeps, extrapolated, .. } = engine.settings();
        let convergence = Convergence::of_channel(ladder, &channel, engine.formal_order(case, kind), finest)
            .expect("all runs of an engine have the same channels")
            .extrapolated(extrapolated);
        let parts = Parts { reference: self.known.error(kind.stage, index), ..convergence.parts(noise) };
        let basis = convergence.tolerance(resolution, parts, checks::noise_origin(engine)).basis;
        let verdict = match reference.times().is_empty() {
            true => Verdict::open(sentences::A_DRIVE_OR_A_LOADED_LINK),
            false => Verdict::of_engine(&residual, &convergence, parts, self.problem.engine_rel),
        };
        let verdict = verdict.from_settings(resolution, engine.controls_error(), sweeps);
        let [_, single, half] = ladder.resolutions;
        let [single, half, reference] =
            [single, half, reference].map(|side| side.column(&channel).expect("all sides have the channel"));
        let limit = convergence.limit(single, half, kind.periodic);
        let limit = limit.map(|limit| largest_difference(reference, &limit, kind.periodic));
        let bound = parts.sum();
        ChannelProof { residual, bound, parts, convergence, limit, sensitivity: None, left_out, basis, verdict }
    }
}
