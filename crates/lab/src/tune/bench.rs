//! Runs one engine against the reference, and finds the engine's cheapest settings.
//! This file lists the settings that are tried, except the step.

use linkage::math::KeepNan;
use std::f64::consts::PI;

use super::candidate::{Candidate, Measured, Price};
use super::search::{Found, largest_step};
use crate::steps::work_of_run;
use linkage::case::Case;
use linkage::engine::{CachedEngine, Engine, Route, Settings};
use linkage::error::{ErrorKind, Result};
use linkage::solver::Progress;
use linkage::trajectory::{Channel, Stage, Trajectory};
use prover::bounds::{Convergence, Ladder, OtherSweeps, residuals};
use prover::run::Options;

/// Coarsest accuracy that is tried for an engine that controls its error.
const COARSEST: f64 = 0.1;
/// While no cost limit is known, the smallest listed number of sweeps that is at least this number is tried first.
/// With a cost limit, the lower limit of the cost is measured at that number, too.
const ENOUGH: usize = 64;
/// First step that is tried, as a multiple of the engine's usual or given step.
/// A coarse step is cheap, and its cost predicts the cost of other steps.
const COARSE_START: f64 = 4.0;
/// After an increase of the number of sweeps, the search begins at this multiple of the last step found.
const COARSER: f64 = 1.4;
/// New settings must cost less than this fraction of the cheapest known settings.
const GAIN: f64 = 0.95;
/// Coarse steps for measuring the lower limit of a run's cost, as rotations of the fastest driving link (rad).
/// With such a coarse step, most of the cost is the reading of results.
/// The steps are tried in this order. The cost is measured at the first step with which the engine finishes a run.
const ROUGH: [f64; 3] = [PI / 6.0, PI / 18.0, PI / 54.0];

/// Result of the search with one engine.
pub(super) enum Outcome {
    /// The cheapest settings.
    Met(Candidate),
    /// The smallest error found.
    TooCoarse(f64),
    /// The engine could meet the request, but at a higher cost than another engine.
    TooDear,
}

/// Runs engines against the reference.
pub(super) struct Bench<'a> {
    pub(super) case: &'a Case,
    pub(super) reference: &'a Trajectory,
    pub(super) wanted: &'a [Channel],
    pub(super) price: Price<'a>,
    pub(super) runs: usize,
    /// Whether the engine has refused the last method. A refusal does not depend on the step or the number of sweeps.
    pub(super) refused: bool,
    /// Work done so far, and total work allowed. The unit is the work of one step without sweeps.
    pub(super) effort: f64,
    pub(super) budget: f64,
    /// Whether a run was omitted because its work exceeds the allowance.
    pub(super) is_spent: bool,
}

/// Lower limit of the cost of a run, whatever its step.
/// Stored as pairs (number of sweeps, cost), in ascending order.
/// The limit exists because results are read at every instant.
/// Some methods for reactions also do all sweeps at every instant.
struct Floor(Vec<(usize, f64)>);

impl Floor {
    /// Lower limit of the cost at this number of sweeps.
    /// The cost is modelled as a constant plus a term proportional to the number of sweeps.
    /// Constant and term are not negative.
    fn at(&self, sweeps: usize) -> f64 {
        let sweeps = sweeps.max(1) as f64;
        let of = |&(many, price): &(usize, f64)| price * (sweeps / many.max(1) as f64).smaller(1.0);
        let least = self.0.iter().map(of).fold(0.0, f64::larger);
        let [(few, low), (many, high)] = self.0[..] else { return least };
        least.larger(low + (high - low) / (many - few) as f64 * (sweeps - few as f64))
    }
}

/// State of the search with one method, while the number of sweeps increases.
struct Row {
    /// The first step to try.
    start: f64,
    /// Error with the last tried number of sweeps, in a run that costs as much as the cost limit.
    /// `rising` is the number of successive increases of this error.
    last: f64,
    rising: usize,
}

/// The cheapest settings of one engine so far.
struct Search<'e> {
    engine: &'e dyn Engine,
    within: f64,
    /// Lowest cost of the other engines.
    others: f64,
    best: Option<Candidate>,
    /// Smallest error among methods that do not meet the request at any step.
    least: f64,
    /// Whether some settings meet the request, or might meet it, but cost too much.
    dear: bool,
}

impl Search<'_> {
    /// Highest cost at which a run can still improve the result.
    fn limit(&self) -> f64 {
        self.best.as_ref().map_or(self.others, |best| best.price.smaller(self.others)) * GAIN
    }
}

impl Bench<'_> {
    /// Cheapest settings of one engine that cost less than `others`, the lowest cost of the other engines.
    pub(super) fn best_of(
        &mut self,
        engine: &dyn Engine,
        within: f64,
        options: &Options,
        others: f64,
        progress: Progress,
    ) -> Outcome {
        let mut search = Search { engine, within, others, best: None, least: f64::INFINITY, dear: false };
        let (ways, sweeps) = (ways(engine, self.case, options), sweeps(engine, options));
        for (done, way) in ways.iter().enumerate() {
            progress(done as f64 / ways.len() as f64);
            self.through_sweeps(&mut search, way, &sweeps);
        }
        match search.best {
            Some(best) => Outcome::Met(best),
            None if search.dear => Outcome::TooDear,
            None => Outcome::TooCoarse(search.least),
        }
    }

    /// Searches one method with increasing numbers of sweeps.
    /// At a fixed cost, the error first falls with the number of sweeps. With more sweeps than needed, the error rises
    /// again.
    /// The search ends early if the error rises twice in a row, or if more sweeps would cost too much.
    fn through_sweeps(&mut self, search: &mut Search, way: &Settings, sweeps: &[usize]) {
        let unlimited = search.limit().is_infinite();
        self.refused = false;
        let floor = if unlimited { Floor(Vec::new()) } else { self.floor(search.engine, way, sweeps, search.limit()) };
        // Without a cost limit, the search begins with many sweeps.
        // With too few sweeps, no step meets the request, and the search would try ever finer steps.
        let first = sweeps.iter().copied().find(|&sweeps| sweeps >= ENOUGH && unlimited);
        let start = if search.engine.controls_error() { way.resolution } else { COARSE_START * way.resolution };
        let mut row = Row { start, last: f64::INFINITY, rising: 0 };
        for sweeps in first.into_iter().chain(sweeps.iter().copied().filter(|&sweeps| Some(sweeps) != first)) {
            if self.refused || self.is_spent {
                break;
            }
            if floor.at(sweeps) >= search.limit() {
                search.dear = true;
                break;
            }
            let error = self.largest_step(search, &mut row, Settings { sweeps, ..*way });
            if !search.engine.controls_error() {
                // More sweeps cost more. Only a larger step can then stay within the cost limit.
                row.start *= COARSER;
            }
            row.rising = if error > row.last { row.rising + 1 } else { 0 };
            row.last = error;
            if row.rising >= 2 {
                break;
            }
        }
    }

    /// Searches for the largest step at which the settings meet the request.
    /// Returns the measured or expected error of a run that costs as much as the cost limit.
    fn largest_step(&mut self, search: &mut Search, row: &mut Row, settings: Settings) -> f64 {
        let Search { engine, within, .. } = *search;
        let limit = search.limit();
        let most = if engine.controls_error() { COARSEST } else { f64::INFINITY };
        let order = engine.with(settings).formal_order(self.case, self.wanted[0].kind);
        let mut run = |resolution: f64| self.measure(engine, Settings { resolution, ..settings });
        match largest_step([row.start, most], order, within, limit, &mut run) {
            Found::Step { resolution, measured: Measured { error, worst, price } } => {
                row.start = resolution;
                search.dear |= price >= limit;
                if price < limit {
                    search.best = Some(Candidate {
                        engine: engine.name(),
                        settings: Settings { resolution, ..settings },
                        controls_error: engine.controls_error(),
                        verified: error,
                        worst,
                        price,
                        is_proven: false,
                    });
                }
                within * (price / limit).larger(1.0)
            }
            Found::TooDear { resolution, error } => {
                (row.start, search.dear) = (resolution, true);
                error
            }
            Found::TooCoarse(error) => {
                (row.start, search.least) = (row.start / COARSER, search.least.smaller(error));
                error
            }
        }
    }

    /// Lower limit of the cost of one method, measured in runs with a coarse step.
    /// Most of the cost of such a run is the reading of results.
    /// The measurement stops as soon as the cost is known to exceed `limit`.
    fn floor(&mut self, engine: &dyn Engine, way: &Settings, sweeps: &[usize], limit: f64) -> Floor {
        let rough = match engine.controls_error() {
            true => vec![COARSEST],
            false => ROUGH.map(|turn| turn / self.case.drives.top_speed(self.case.mechanism.size())).to_vec(),
        };
        let mut floor = Floor(Vec::new());
        let many = sweeps.iter().copied().find(|&many| many >= ENOUGH && many > sweeps[0]);
        for sweeps in [Some(sweeps[0]), many].into_iter().flatten() {
            let prices = rough
                .iter()
                .filter(|step| step.is_finite())
                .map(|&resolution| self.measure(engine, Settings { resolution, sweeps, ..*way }).price);
            let Some(price) = { prices }.find(|price| price.is_finite()) else { continue };
            floor.0.push((sweeps, price));
            if price >= limit {
                break;
            }
        }
        floor
    }

    /// One run; an engine that fails has an infinite error.
    pub(super) fn measure(&mut self, engine: &dyn Engine, settings: Settings) -> Measured {
        let failed = |price: f64| Measured { error: f64::INFINITY, worst: String::new(), price };
        self.effort += work_of_run(self.case, engine, &settings);
        if self.effort > self.budget {
            self.is_spent = true;
            return failed(f64::INFINITY);
        }
        self.runs += 1;
        let engine = engine.with(settings);
        let mut found = None;
        let mut run = || {
            found = Some(engine.solve(self.case)?);
            Ok(())
        };
        let price = match (self.price)(engine.as_ref(), &mut run) {
            Ok(price) => price,
            Err(error) => {
                self.refused |= error.kind() == ErrorKind::Unsupported;
                return failed(f64::INFINITY);
            }
        };
        let Some(trajectory) = found else { return failed(price) };
        let Ok(residuals) = residuals(self.reference, &trajectory) else { return failed(price) };
        let of_wanted = residuals.iter().filter(|residual| self.wanted.contains(&residual.channel));
        let (mut error, mut worst, mut seen) = (0.0, String::new(), 0);
        for residual in of_wanted {
            seen += 1;
            let own = residual.share();
            if !(own <= error) {
                (error, worst) = (own, residual.channel.to_string());
            }
        }
        // An engine that lacks a requested channel does not meet the request.
        if seen < self.wanted.len() { failed(price) } else { Measured { error, worst, price } }
    }

    /// Error estimated from several runs of the engine, without the reference.
    pub(super) fn predicted(&mut self, engine: &dyn Engine) -> Result<f64> {
        let settings = engine.settings();
        let at = |factor: f64| Settings { resolution: settings.resolution * factor, ..settings };
        let mut rungs = vec![at(2.0), settings, at(0.5)];
        // The comparison run has twice the sweeps of the run at `settings`.
        // The iteration error of the comparison run is comparatively small.
        // The difference of the two runs is therefore the iteration error at `settings`.
        // In a proof, the comparison run has fewer sweeps: half, or a quarter at the beginning of a search for
        // settings.
        // A comparison run with half the sweeps costs a quarter of one with twice the sweeps, but overestimates the
        // error.
        if settings.sweeps > 0 {
            rungs.push(Settings { sweeps: settings.sweeps * 2, ..settings });
        }
        self.runs += rungs.len();
        let kept = CachedEngine::new(engine);
        let runs: Result<Vec<Trajectory>> = rungs.iter().map(|&rung| kept.with(rung).solve(self.case)).collect();
        let runs = runs?;
        let [double, single, half] = [0, 1, 2].map(|k| &runs[k]);
        let other_sweeps = OtherSweeps { runs: [runs.get(3), None], factor: 0.5, growth: 0.0 };
        let ladder = Ladder { resolutions: [double, single, half], other_sweeps };
        let finest = engine.at(settings.resolution / 2.0);
        let mut predicted: f64 = 0.0;
        for residual in residuals(self.reference, single)? {
            let (channel, kind) = (&residual.channel, residual.channel.kind);
            if residual.scale == 0.0 || !self.wanted.contains(channel) {
                continue;
            }
            let noise = finest.noise(self.case, kind);
            let found = Convergence::of_channel(ladder, channel, engine.formal_order(self.case, kind), noise);
            let found = found.expect("all runs of an engine have the same channels");
            predicted = predicted.larger((found.error + found.iteration) / residual.scale);
        }
        Ok(predicted)
    }
}

/// Numbers of sweeps that are tried.
const SWEEPS: [usize; 11] = [4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096];
/// Numbers of substeps that are tried.
const SUBSTEPS: [usize; 2] = [1, 2];

/// All methods of an engine: its settings except sweeps and resolution.
/// The usually cheapest methods come first. More expensive methods can then be abandoned early.
pub(super) fn ways(engine: &dyn Engine, case: &Case, options: &Options) -> Vec<Settings> {
    let Settings { resolution, sweeps, substeps, route, extrapolated } = engine.settings();
    let forces = case.wanted.deepest() >= Stage::Reactions;
    let routes: Vec<Route> = match forces && options.settings.route.is_free() {
        true => engine.routes().to_vec(),
        false => vec![route],
    };
    let substeps = match (options.settings.substeps.get(), substeps) {
        (None, 1..) if !engine.controls_error() => SUBSTEPS.to_vec(),
        (Some(_), _) | (None, _) => vec![substeps],
    };
    let extrapolated = match options.settings.extrapolated.get() {
        None if !engine.controls_error() => vec![1, 0],
        Some(_) | None => vec![extrapolated],
    };
    let pairs = extrapolated.iter().flat_map(|&times| routes.iter().map(move |&route| (times, route)));
    let settings = |(extrapolated, route), substeps| Settings { resolution, sweeps, substeps, route, extrapolated };
    pairs.flat_map(|pair| substeps.iter().map(move |&substeps| settings(pair, substeps))).collect()
}

/// Numbers of sweeps that are tried, in ascending order.
pub(super) fn sweeps(engine: &dyn Engine, options: &Options) -> Vec<usize> {
    match (options.settings.sweeps.get(), engine.settings().sweeps) {
        (None, 1..) => SWEEPS.to_vec(),
        (_, own) => vec![own],
    }
}
