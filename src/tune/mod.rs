//! The cheapest settings of an engine that meet a wanted error, found by measurement.
//!
//! An engine's error depends on its step, its sweeps, its substeps, whether it is extrapolated, and the way to its reactions. For every way of setting
//! all but the step, the largest step that meets the wanted error is found from runs against the reference (the error falls with a
//! power of the step, so few runs are enough), and priced. The cheapest wins. What it promises without the reference, from its own
//! runs at three steps, stands beside what was measured.

mod search;

use crate::case::{Case, Wanted};
use crate::compare::{Convergence, Ladder, residuals};
use crate::engine::{Engine, Route, Settings};
use crate::error::{Error, ErrorKind, Result};
use crate::proof::Options;
use crate::reference::AssurSolver;
use crate::scenario::Scenario;
use crate::solver::Solver;
use crate::trajectory::{Channel, Stage, Trajectory};
use search::{Found, largest_step};

/// What is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Wish {
    /// Largest error, as a share of each channel's scale (half its range over the run).
    pub within: f64,
    /// Channels by name, or stages (`positions`, `reactions`, ...); all that the scenario wants, if there is none.
    pub channels: Vec<String>,
}

/// One way of setting an engine, at the largest step with which it meets the wish.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Name of the engine.
    pub engine: &'static str,
    /// Its settings.
    pub settings: Settings,
    /// Whether the resolution among them is an accuracy, not a step.
    pub controls_error: bool,
    /// Largest error against the reference, over the channel's scale.
    pub verified: f64,
    /// Channel with that error.
    pub worst: String,
    /// Price of the run, in the unit of the price given to [`tune`].
    pub price: f64,
}

/// What tuning found.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuning {
    /// The cheapest candidate.
    pub best: Candidate,
    /// Largest error of the cheapest that its own runs at three steps and with twice the sweeps let expect, over the channel's scale; no
    /// reference in it.
    pub predicted: f64,
    /// The cheapest of every engine that meets the wish, the cheapest first.
    pub by_engine: Vec<Candidate>,
    /// Engines that do not meet it, and how far they come: the smallest error seen.
    pub too_coarse: Vec<(&'static str, f64)>,
    /// Engines that cost more than another one before they meet it.
    pub too_dear: Vec<&'static str>,
    /// Number of runs that it took.
    pub runs: usize,
}

/// What a run costs: it is given the engine and the run, which it must call at least once.
pub type Price<'a> = &'a mut dyn FnMut(&dyn Engine, &mut dyn FnMut() -> Result<()>) -> Result<f64>;

/// Numbers of sweeps that are tried.
const SWEEPS: [usize; 11] = [4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096];
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
/// Numbers of substeps that are tried.
const SUBSTEPS: [usize; 2] = [1, 2];

/// Finds the cheapest settings of the engines in `options` that meet the wish. Settings that the options fix stay as they are.
///
/// # Errors
/// [`ErrorKind::Input`] if the wish or a channel makes no sense; [`ErrorKind::Numeric`] if no engine meets the wish, with how far each
/// comes; those of the analytic solver.
pub fn tune(
    scenario: &Scenario,
    wish: &Wish,
    options: &Options,
    price: Price,
    progress: &mut dyn FnMut(f64),
) -> Result<Tuning> {
    if !(wish.within > 0.0 && wish.within < 1.0) {
        return Err(Error::new(ErrorKind::Input, format!("an error within {} is wanted", wish.within))
            .help("give a share of a channel's scale between 0 and 1, such as 1e-4"));
    }
    let wanted = wanted_channels(scenario, wish)?;
    let stages: Vec<Stage> = wanted.iter().map(|channel| channel.kind.stage).collect();
    let case = Case { wanted: Wanted::of(&stages), ..scenario.case.clone() };
    let reference = AssurSolver.solve(&case, &mut |_| {})?;
    let engines = options.engines(scenario)?;
    let mut bench = Bench { case: &case, reference: &reference, wanted: &wanted, price, runs: 0 };
    let (mut by_engine, mut too_coarse, mut too_dear): (Vec<Candidate>, _, _) = (Vec::new(), Vec::new(), Vec::new());
    for (index, engine) in engines.iter().enumerate() {
        let mut part = |part: f64| progress((index as f64 + part) / engines.len() as f64);
        let cheapest = by_engine.iter().map(|candidate| candidate.price).fold(f64::INFINITY, f64::min);
        match bench.best_of(engine.as_ref(), wish.within, options, cheapest, &mut part)? {
            Outcome::Met(candidate) => by_engine.push(candidate),
            Outcome::TooCoarse(error) => too_coarse.push((engine.name(), error)),
            Outcome::TooDear => too_dear.push(engine.name()),
        }
    }
    by_engine.sort_by(|a, b| a.price.total_cmp(&b.price));
    let Some(best) = by_engine.first().cloned() else {
        let tells: Vec<String> =
            too_coarse.iter().map(|(name, error)| format!("{name} comes to {error:.1e}")).collect();
        let message = format!("no settings meet an error within {:e} of the scale: {}", wish.within, tells.join(", "));
        return Err(Error::new(ErrorKind::Numeric, message)
            .help("ask for a larger error, other channels (--channel) or further engines (--engine all)"));
    };
    let engine = engines.iter().find(|engine| engine.name() == best.engine).expect("it is one of them");
    let predicted = bench.predicted(engine.with(best.settings).as_ref())?;
    Ok(Tuning { best, predicted, by_engine, too_coarse, too_dear, runs: bench.runs })
}

/// The channels of a wish.
fn wanted_channels(scenario: &Scenario, wish: &Wish) -> Result<Vec<Channel>> {
    let all = scenario.case.channels();
    if wish.channels.is_empty() {
        return Ok(all);
    }
    let mut wanted = Vec::new();
    for asked in &wish.channels {
        let named = |channel: &&Channel| channel.to_string() == *asked || channel.kind.stage.name() == asked;
        let before = wanted.len();
        wanted.extend(all.iter().filter(named).cloned());
        if wanted.len() == before {
            let stages = Stage::ALL.map(Stage::name).join(", ");
            return Err(Error::new(ErrorKind::Input, format!("the scenario wants no channel \"{asked}\""))
                .key("--channel")
                .help(format!("name a column of `linkproof solve`, such as joint.A.fx_N, or one of: {stages}")));
        }
    }
    Ok(wanted)
}

enum Outcome {
    Met(Candidate),
    /// The smallest error seen.
    TooCoarse(f64),
    /// It would meet the wish, but at a higher price than another engine.
    TooDear,
}

/// Runs engines against the reference.
struct Bench<'a> {
    case: &'a Case,
    reference: &'a Trajectory,
    wanted: &'a [Channel],
    price: Price<'a>,
    runs: usize,
}

/// Error and price of one run.
#[derive(Clone, Debug)]
struct Measured {
    error: f64,
    worst: String,
    price: f64,
}

impl Bench<'_> {
    /// Cheapest settings of one engine that cost less than `limit`.
    fn best_of(
        &mut self,
        engine: &dyn Engine,
        within: f64,
        options: &Options,
        limit: f64,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Outcome> {
        let mut best: Option<Candidate> = None;
        let (mut least, mut dear) = (f64::INFINITY, false);
        let ways = ways(engine, self.case, options);
        let most = if engine.controls_error() { COARSEST } else { f64::INFINITY };
        for (done, way) in ways.iter().enumerate() {
            progress(done as f64 / ways.len() as f64);
            let sweeps = sweeps(engine, options);
            // Without a limit few sweeps would be searched down to the finest steps.
            let first =
                sweeps.iter().copied().find(|&sweeps| sweeps >= ENOUGH && best.is_none() && limit.is_infinite());
            // From few to many, within the price of the cheapest, the error falls, and rises again once they are more than needed.
            let (mut rising, mut last) = (0, f64::INFINITY);
            let mut start = if engine.controls_error() { way.resolution } else { COARSE_START * way.resolution };
            for sweeps in first.into_iter().chain(sweeps.iter().copied().filter(|&sweeps| Some(sweeps) != first)) {
                let settings = Settings { sweeps, ..*way };
                let limit = best.as_ref().map_or(limit, |best| best.price.min(limit)) * GAIN;
                let order = engine.with(settings).formal_order(self.case, self.wanted[0].kind);
                let mut run = |resolution: f64| self.measure(engine, Settings { resolution, ..settings });
                let error = match largest_step([start, most], order, within, limit, &mut run) {
                    Found::Step { resolution, measured: Measured { error, worst, price } } => {
                        start = resolution;
                        dear |= price >= limit;
                        if price < limit {
                            let settings = Settings { resolution, ..settings };
                            best = Some(Candidate {
                                engine: engine.name(),
                                settings,
                                controls_error: engine.controls_error(),
                                verified: error,
                                worst,
                                price,
                            });
                        }
                        within * (price / limit).max(1.0)
                    }
                    Found::TooDear { resolution, error } => {
                        (start, dear) = (resolution, true);
                        error
                    }
                    Found::TooCoarse(error) => {
                        (start, least) = (start / COARSER, least.min(error));
                        error
                    }
                };
                if !engine.controls_error() {
                    // More sweeps cost more, and so afford a larger step only.
                    start *= COARSER;
                }
                rising = if error > last { rising + 1 } else { 0 };
                last = error;
                if rising >= 2 {
                    break;
                }
            }
        }
        Ok(match best {
            Some(best) => Outcome::Met(best),
            None if dear => Outcome::TooDear,
            None => Outcome::TooCoarse(least),
        })
    }

    /// One run; an engine that fails has an infinite error.
    fn measure(&mut self, engine: &dyn Engine, settings: Settings) -> Measured {
        self.runs += 1;
        let engine = engine.with(settings);
        let mut found = None;
        let mut run = || {
            found = Some(engine.solve(self.case, &mut |_| {})?);
            Ok(())
        };
        let failed = |price: f64| Measured { error: f64::INFINITY, worst: String::new(), price };
        let Ok(price) = (self.price)(engine.as_ref(), &mut run) else { return failed(f64::INFINITY) };
        let Some(trajectory) = found else { return failed(price) };
        let Ok(residuals) = residuals(self.reference, &trajectory) else { return failed(price) };
        let of_wanted = residuals.iter().filter(|residual| self.wanted.contains(&residual.channel));
        let share = |max: f64, scale: f64| if max == 0.0 { 0.0 } else { max / scale };
        let (mut error, mut worst, mut seen) = (0.0, String::new(), 0);
        for residual in of_wanted {
            seen += 1;
            let own = share(residual.max, residual.scale);
            if !(own <= error) {
                (error, worst) = (own, residual.channel.to_string());
            }
        }
        // A channel that the engine does not have is not within anything.
        if seen < self.wanted.len() { failed(price) } else { Measured { error, worst, price } }
    }

    /// Error that an engine's own runs let expect.
    fn predicted(&mut self, engine: &dyn Engine) -> Result<f64> {
        let settings = engine.settings();
        let mut run = |settings: Settings| {
            self.runs += 1;
            engine.with(settings).solve(self.case, &mut |_| {})
        };
        let at = |factor: f64| Settings { resolution: settings.resolution * factor, ..settings };
        let [double, single, half] = [run(at(2.0))?, run(settings)?, run(at(0.5))?];
        // Against twice the sweeps: what is left then is little beside what is left now, so that the difference is the error itself. (A
        // proof takes half of them, which costs a quarter and errs on the safe side.)
        let more = match settings.sweeps {
            0 => None,
            sweeps => Some(run(Settings { sweeps: sweeps * 2, ..settings })?),
        };
        let ladder = Ladder { resolutions: [&double, &single, &half], fewer_sweeps: more.as_ref() };
        let finest = engine.at(settings.resolution / 2.0);
        let mut predicted: f64 = 0.0;
        for residual in residuals(self.reference, &single)? {
            let (channel, kind) = (&residual.channel, residual.channel.kind);
            if residual.scale == 0.0 || !self.wanted.contains(channel) {
                continue;
            }
            let noise = finest.noise(self.case, kind);
            let found = Convergence::of_channel(ladder, channel, engine.formal_order(self.case, kind), noise);
            let found = found.expect("all runs of an engine have the same channels");
            predicted = predicted.max((found.error + found.iteration) / residual.scale);
        }
        Ok(predicted)
    }
}

/// All ways of setting an engine but for its sweeps and its resolution.
fn ways(engine: &dyn Engine, case: &Case, options: &Options) -> Vec<Settings> {
    let defaults = engine.settings();
    let forces = case.wanted.deepest() >= Stage::Reactions;
    let routes: Vec<Route> = match forces && options.route.is_none() {
        true => engine.routes().to_vec(),
        false => vec![defaults.route],
    };
    let substeps = match (options.substeps, defaults.substeps) {
        (None, 1..) if !engine.controls_error() => SUBSTEPS.to_vec(),
        _ => vec![defaults.substeps],
    };
    let extrapolated = match options.extrapolated {
        None if !engine.controls_error() => vec![false, true],
        _ => vec![defaults.extrapolated],
    };
    let mut ways = Vec::new();
    for &extrapolated in &extrapolated {
        for &route in &routes {
            for &substeps in &substeps {
                ways.push(Settings { substeps, route, extrapolated, ..defaults });
            }
        }
    }
    ways
}

fn sweeps(engine: &dyn Engine, options: &Options) -> Vec<usize> {
    match (options.sweeps, engine.settings().sweeps) {
        (None, 1..) => SWEEPS.to_vec(),
        (_, own) => vec![own],
    }
}
