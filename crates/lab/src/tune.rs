//! Searches for the cheapest settings with which an engine meets a requested error.
//! Errors are measured against a reference solution.
//!
//! The error is proportional to a power of the step.
//! For each method, a few runs against the reference therefore find the largest step that meets the requested error.
//! Three runs of the engine also predict the error without the reference.
//! The predicted error is reported beside the measured error.
//! See docs/numerics/laboratory.md.

mod bench;
mod candidate;
mod confirm;
mod price;
mod search;

use crate::sentences;
pub use candidate::{Candidate, Price};
pub use price::{by_work, price_of};

use analytic::AssurSolver;
use analytic::range::explained;
use bench::{Bench, Outcome};
use confirm::confirmed;
use linkage::case::Wanted;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::solver::{Progress, Solver};
use linkage::trajectory::{Channel, Stage};
use prover::numbers::significant;
use prover::run::{Options, memory};
use scenario::Scenario;

/// Work allowed by default. The unit is the work of one step without sweeps.
/// The shipped mechanisms need only a small fraction of this work, even at an allowed error of 1e-7 of the scale.
const BUDGET: f64 = 5e6;

/// The wanted accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct WantedAccuracy {
    /// Largest error allowed, divided by each channel's scale (usually half its range in the run).
    pub within: f64,
    /// Channels by name, or stages (`positions`, `reactions`, ...). If the list is empty, all channels that the
    /// scenario requests are used.
    pub channels: Vec<String>,
}

/// Result of tuning.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuning {
    /// The cheapest settings that meet the request and that a proof confirms.
    /// If no settings are confirmed, the field contains the cheapest settings that meet the request.
    pub best: Candidate,
    /// The cheapest settings that meet the request, with or without confirmation by a proof.
    pub cheapest: Candidate,
    /// Largest error of `best` divided by the channel's scale, predicted without the reference.
    /// The prediction compares the engine's runs at three steps, and a run with twice the sweeps.
    pub predicted: f64,
    /// The cheapest settings of every engine that meets the request, refined if necessary until a proof confirms them.
    /// Engines with confirmed settings come first. Engines with the same status are sorted by cost, the cheapest first.
    pub by_engine: Vec<Candidate>,
    /// Engines that do not meet the request, with the smallest error found.
    /// The error is infinite if no run of the engine finished.
    pub too_coarse: Vec<(&'static str, f64)>,
    /// Engines that could meet the request only at a higher cost than another engine.
    pub too_dear: Vec<&'static str>,
    /// Number of runs in the search.
    pub runs: usize,
    /// Whether the search ended because the allowed work was used up.
    /// If the work was used up, cheaper settings may exist.
    pub is_spent: bool,
}

/// Finds the cheapest settings of the engines in `options` that meet the request.
/// Settings that the options fix stay unchanged.
///
/// # Errors
/// [`ErrorKind::Input`] if the request or a channel is invalid.
/// [`ErrorKind::Numeric`] if no engine meets the request; the message has the smallest error of each engine.
/// The errors of the analytic solver are returned as well.
pub fn tune(
    scenario: &Scenario,
    wish: &WantedAccuracy,
    options: &Options,
    price: Price,
    progress: Progress,
) -> Result<Tuning> {
    if !(wish.within > 0.0 && wish.within < 1.0) {
        return Err(Error::new(ErrorKind::Input, sentences::an_error_within_is_wanted(&wish.within))
            .help(sentences::GIVE_A_SHARE_OF_A_CHANNEL));
    }
    let wanted = wanted_channels(scenario, wish)?;
    let stages: Vec<Stage> = wanted.iter().map(|channel| channel.kind.stage).collect();
    let case = scenario.case.wanting(Wanted::of(&stages));
    memory::check(&case, memory::of_proof(&case, 1), options.memory)?;
    let reference = AssurSolver.solve(&case).map_err(|error| explained(&case, error))?;
    let engines = options.set_engines(scenario)?;
    let budget = options.budget.unwrap_or(BUDGET);
    let mut bench = Bench {
        case: &case,
        reference: &reference,
        wanted: &wanted,
        price,
        runs: 0,
        refused: false,
        effort: 0.0,
        budget,
        is_spent: false,
    };
    let mut cheapest = Vec::new();
    let (mut by_engine, mut too_coarse, mut too_dear): (Vec<Candidate>, _, _) = (Vec::new(), Vec::new(), Vec::new());
    for (index, engine) in engines.iter().enumerate() {
        let mut part = |part: f64| progress((index as f64 + part) / engines.len() as f64);
        let known = cheapest.iter().map(|candidate: &Candidate| candidate.price).fold(f64::INFINITY, f64::smaller);
        match bench.best_of(engine.as_ref(), wish.within, options, known, &mut part) {
            Outcome::Met(candidate) => {
                cheapest.push(candidate.clone());
                by_engine.push(confirmed(
                    &mut bench,
                    scenario,
                    engine.as_ref(),
                    candidate,
                    (wish.within, options.reference),
                )?);
            }
            Outcome::TooCoarse(error) => too_coarse.push((engine.name(), error)),
            Outcome::TooDear => too_dear.push(engine.name()),
        }
    }
    let by_price = |a: &Candidate, b: &Candidate| a.price.total_cmp(&b.price);
    by_engine.sort_by(|a, b| b.is_proven.cmp(&a.is_proven).then(by_price(a, b)));
    cheapest.sort_by(by_price);
    let (Some(best), Some(cheapest)) = (by_engine.first().cloned(), cheapest.into_iter().next()) else {
        let tell = |(name, error): &(&str, f64)| match error.is_finite() {
            true => sentences::comes_to(&name, &significant(*error, 2)),
            false => sentences::does_not_run_it(&name),
        };
        let tells: Vec<String> = too_coarse.iter().map(tell).collect();
        let message = sentences::no_settings_meet_an_error(&significant(wish.within, 6), &tells.join(", "));
        let error = Error::new(ErrorKind::Numeric, message).help(Advice::WeakerWish);
        return Err(match bench.is_spent {
            true => error
                .map_message(|message| sentences::the_work_that_was_allowed(&message))
                .or_help(Advice::MoreWork { to: 10.0 * budget }),
            false => error,
        });
    };
    let engine = engines.iter().find(|engine| engine.name() == best.engine).expect("it is one of them");
    let predicted = bench.predicted(engine.with(best.settings).as_ref())?;
    Ok(Tuning {
        best,
        cheapest,
        predicted,
        by_engine,
        too_coarse,
        too_dear,
        runs: bench.runs,
        is_spent: bench.is_spent,
    })
}

/// The channels of a request.
fn wanted_channels(scenario: &Scenario, wish: &WantedAccuracy) -> Result<Vec<Channel>> {
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
            return Err(Error::new(ErrorKind::Input, sentences::the_scenario_wants_no_channel(&asked))
                .help(Advice::OtherChannel { groups: stages }));
        }
    }
    Ok(wanted)
}
