//! The cost of a run. The cost is computed from the settings, so it does not depend on a clock.
//! See docs/numerics/laboratory.md.

use crate::steps::span;
use linkage::case::Case;
use linkage::engine::{Engine, Route};
use linkage::error::Result;
use linkage::mechanism::SpanningTree;
use linkage::work::{Count, counted};
use prover::engines::EngineName;

/// Additional steps of a run outside the interval from the first to the last instant.
/// The additional steps are a few steps backwards, the same number of steps forwards again, and some steps beyond the
/// end.
const EXTRA_STEPS: f64 = 16.0;
/// Number of tiny steps of a probe (`Route::Probe`) in each simulation world.
const TINY_STEPS: f64 = 5.0;

/// Costs of an engine, in units of a step of `rapier` without sweeps on the same mechanism (4.9 us on the measuring
/// machine).
struct Costs {
    /// A step, without its substeps.
    step: f64,
    /// A substep, without its sweeps.
    substep: f64,
    sweep: f64,
    /// Reading all channels at an instant.
    instant: f64,
    /// Cost of a step in a world whose reactions are read, divided by the cost of a step in a world without this
    /// reading.
    native: f64,
    /// Cost of a tiny step of a probe, divided by the cost of an ordinary step with one substep.
    tiny: f64,
}

/// The costs were measured once on `crank_rocker` by `cargo bench --bench tune -- prices`.
/// A step's cost has a part that occurs once and a part that occurs in every substep.
/// Runs with one and with two substeps give both parts.
/// The costs of Simbody's steps and readings are from runs of `bench` on `crank_rocker`, at the accuracies 1e-4 and
/// 1e-10.
fn costs(engine: EngineName) -> Costs {
    match engine {
        EngineName::Rapier => Costs { step: 0.47, substep: 0.53, sweep: 0.028, instant: 0.26, native: 1.03, tiny: 1.1 },
        EngineName::RapierF32 => {
            Costs { step: 0.33, substep: 0.65, sweep: 0.029, instant: 0.40, native: 1.1, tiny: 1.25 }
        }
        EngineName::Impulse => {
            Costs { step: 0.25, substep: 0.36, sweep: 0.076, instant: 0.53, native: 1.26, tiny: 1.7 }
        }
        EngineName::ImpulseF32 => {
            Costs { step: 0.55, substep: 0.20, sweep: 0.074, instant: 0.29, native: 1.16, tiny: 1.45 }
        }
        EngineName::Simbody => Costs { step: 38.0, substep: 0.0, sweep: 0.0, instant: 32.0, native: 1.0, tiny: 1.0 },
    }
}

/// Runs an engine on a case and returns the cost of the run. The unit of cost is a step of `rapier` without its sweeps.
/// The number of steps follows from the settings.
/// If the engine chooses its steps itself, the steps of the run are counted.
///
/// # Errors
/// The errors of the run.
pub fn by_work(case: &Case, engine: &dyn Engine, run: &mut dyn FnMut() -> Result<()>) -> Result<f64> {
    let (outcome, work) = counted(run);
    outcome?;
    Ok(match engine.controls_error() {
        true => {
            let costs = named(engine);
            costs.step * work.of(Count::Steps) as f64 + costs.instant * case.grid.len() as f64
        }
        false => price_of(case, engine),
    })
}

fn named(engine: &dyn Engine) -> Costs {
    costs(EngineName::named(engine.name()).expect("engines are made by their names"))
}

/// Cost of a run of an engine with a fixed step, from its settings.
///
/// # Panics
/// Panics if the engine is not in [`EngineName::ALL`].
pub fn price_of(case: &Case, engine: &dyn Engine) -> f64 {
    let settings = engine.settings();
    let costs = named(engine);
    let worlds = match engine.name().starts_with("rapier") {
        true => SpanningTree::covering(&case.mechanism, &case.wanted_reactions()).len() as f64,
        false => 1.0,
    };
    let (span, instants) = (span(case), case.grid.len() as f64);
    let substep = costs.substep + costs.sweep * settings.sweeps as f64;
    let step = costs.step + settings.substeps as f64 * substep;
    let tiny = (costs.step + substep) * costs.tiny;
    let run = |resolution: f64| {
        let steps = (span / resolution + EXTRA_STEPS) * step;
        let steps = match settings.route {
            Route::Differences => steps,
            Route::Native => steps * worlds * costs.native,
            Route::Probe => steps + instants * TINY_STEPS * worlds * tiny,
        };
        steps + instants * costs.instant
    };
    (0..=settings.extrapolated as i32).map(|time| run(settings.resolution * 0.5f64.powi(time))).sum()
}
