//! Runs of one engine against the reference, and its cheapest settings.

use linkage::math::KeepNan;
use std::f64::consts::PI;

use super::candidate::{Candidate, Measured, Price};
use super::search::{Found, largest_step};
use super::ways::{sweeps, ways};
use crate::compare::{Convergence, Ladder, residuals};
use crate::proof::Options;
use linkage::case::Case;
use linkage::engine::{Engine, Settings};
use linkage::error::{ErrorKind, Result};
use linkage::trajectory::{Channel, Trajectory};

/// Coarsest accuracy that is tried of an engine that controls its error: less is none.
const COARSEST: f64 = 0.1;
/// So many sweeps are tried first.
const ENOUGH: usize = 64;
/// The first step that is tried, as a multiple of the one asked for: a coarse one costs little and tells the price of others.
const COARSE_START: f64 = 4.0;
/// Factor from the step of some sweeps to the first one tried with twice as many.
const COARSER: f64 = 1.4;
/// What costs more than this share of the cheapest known is not looked for.
const GAIN: f64 = 0.95;
/// Turns of the fastest driving link (rad) in steps so coarse that a run costs little but what is read; the first with which the engine runs counts.
const ROUGH: [f64; 3] = [PI / 6.0, PI / 18.0, PI / 54.0];

/// What comes of one engine.
pub(super) enum Outcome {
    /// The cheapest.
    Met(Candidate),
    /// The smallest error seen.
    TooCoarse(f64),
    /// It would meet the wish, but at a higher price than another engine.
    TooDear,
}

/// Runs engines against the reference.
pub(super) struct Bench<'a> {
    pub(super) case: &'a Case,
    pub(super) reference: &'a Trajectory,
    pub(super) wanted: &'a [Channel],
    pub(super) price: Price<'a>,
    pub(super) runs: usize,
    /// Whether the engine has refused the last way of setting it: no step and no sweeps change that.
    pub(super) refused: bool,
}

/// What a run costs at least, however coarse its step: instants are read, some routes work at each of them with all sweeps. Known for some numbers of
/// sweeps, from few to many.
struct Floor(Vec<(usize, f64)>);

impl Floor {
    /// With `sweeps` a run costs a constant and a part in proportion to them, neither of them negative.
    fn at(&self, sweeps: usize) -> f64 {
        let sweeps = sweeps.max(1) as f64;
        let of = |&(many, price): &(usize, f64)| price * (sweeps / many.max(1) as f64).smaller(1.0);
        let least = self.0.iter().map(of).fold(0.0, f64::larger);
        let [(few, low), (many, high)] = self.0[..] else { return least };
        least.larger(low + (high - low) / (many - few) as f64 * (sweeps - few as f64))
    }
}

/// Where the search through the sweeps of one way stands.
struct Row {
    /// The step to begin with.
    start: f64,
    /// Error of the last number of sweeps within the price of the cheapest, and how often it has risen in a row.
    last: f64,
    rising: usize,
}

/// The cheapest of one engine so far.
struct Search<'e> {
    engine: &'e dyn Engine,
    within: f64,
    /// Price of the cheapest of other engines.
    others: f64,
    best: Option<Candidate>,
    /// Smallest error of what does not meet the wish at any price.
    least: f64,
    /// Whether something would meet the wish, or might, at a higher price.
    dear: bool,
}

impl Search<'_> {
    /// Price that is worth a run.
    fn limit(&self) -> f64 {
        self.best.as_ref().map_or(self.others, |best| best.price.smaller(self.others)) * GAIN
    }
}

impl Bench<'_> {
    /// Cheapest settings of one engine that cost less than `others`.
    pub(super) fn best_of(
        &mut self,
        engine: &dyn Engine,
        within: f64,
        options: &Options,
        others: f64,
        progress: &mut dyn FnMut(f64),
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

    /// One way of setting an engine with all numbers of sweeps that may be worth it. From few to many, within the price of the cheapest, the error
    /// falls, and rises again once they are more than needed.
    fn through_sweeps(&mut self, search: &mut Search, way: &Settings, sweeps: &[usize]) {
        let unlimited = search.limit().is_infinite();
        self.refused = false;
        let floor = if unlimited { Floor(Vec::new()) } else { self.floor(search.engine, way, sweeps, search.limit()) };
        // Without a limit few sweeps would be searched down to the finest steps.
        let first = sweeps.iter().copied().find(|&sweeps| sweeps >= ENOUGH && unlimited);
        let start = if search.engine.controls_error() { way.resolution } else { COARSE_START * way.resolution };
        let mut row = Row { start, last: f64::INFINITY, rising: 0 };
        for sweeps in first.into_iter().chain(sweeps.iter().copied().filter(|&sweeps| Some(sweeps) != first)) {
            if self.refused {
                break;
            }
            if floor.at(sweeps) >= search.limit() {
                search.dear = true;
                break;
            }
            let error = self.largest_step(search, &mut row, Settings { sweeps, ..*way });
            if !search.engine.controls_error() {
                // More sweeps cost more, and so afford a larger step only.
                row.start *= COARSER;
            }
            row.rising = if error > row.last { row.rising + 1 } else { 0 };
            row.last = error;
            if row.rising >= 2 {
                break;
            }
        }
    }

    /// Looks for the largest step with which settings meet the wish, and says what error they have within the price of the cheapest.
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

    /// The least price of a way of setting an engine, from runs so coarse that hardly anything but the reading is left; no more runs than
    /// it takes to see that it is above `limit`.
    fn floor(&mut self, engine: &dyn Engine, way: &Settings, sweeps: &[usize], limit: f64) -> Floor {
        let rough = match engine.controls_error() {
            true => vec![COARSEST],
            false => ROUGH.map(|turn| turn / self.case.drives.top_speed()).to_vec(),
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
    fn measure(&mut self, engine: &dyn Engine, settings: Settings) -> Measured {
        self.runs += 1;
        let engine = engine.with(settings);
        let mut found = None;
        let mut run = || {
            found = Some(engine.solve(self.case)?);
            Ok(())
        };
        let failed = |price: f64| Measured { error: f64::INFINITY, worst: String::new(), price };
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
        // A channel that the engine does not have is not within anything.
        if seen < self.wanted.len() { failed(price) } else { Measured { error, worst, price } }
    }

    /// Error that an engine's own runs let expect.
    pub(super) fn predicted(&mut self, engine: &dyn Engine) -> Result<f64> {
        let settings = engine.settings();
        let at = |factor: f64| Settings { resolution: settings.resolution * factor, ..settings };
        let mut rungs = vec![at(2.0), settings, at(0.5)];
        // Against twice the sweeps: what is left then is little beside what is left now, so that the difference is the error itself. (A
        // proof takes half of them, which costs a quarter and errs on the safe side.)
        if settings.sweeps > 0 {
            rungs.push(Settings { sweeps: settings.sweeps * 2, ..settings });
        }
        self.runs += rungs.len();
        let ladder = engine.ladder(&rungs);
        let runs: Result<Vec<Trajectory>> = ladder.iter().map(|rung| rung.solve(self.case)).collect();
        let runs = runs?;
        let [double, single, half] = [0, 1, 2].map(|k| &runs[k]);
        let ladder = Ladder { resolutions: [double, single, half], fewer_sweeps: runs.get(3) };
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
