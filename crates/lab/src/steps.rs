//! Estimate of an engine's work before a run.

use linkage::case::Case;
use linkage::engine::{Engine, Settings};
use linkage::math::KeepNan;

/// Time (s) from the first to the last of the following instants: all instants of the grid, and t = 0.
pub(crate) fn span(case: &Case) -> f64 {
    let end = |of: fn(f64, f64) -> f64| case.grid.times.iter().copied().fold(0.0, of);
    end(f64::larger) - end(f64::smaller)
}

/// Work of a run. The unit is the work of one engine step that makes no solver sweeps.
/// If the engine chooses its steps itself, the result is 0 (unknown).
pub(crate) fn work_of_run(case: &Case, engine: &dyn Engine, settings: &Settings) -> f64 {
    if engine.controls_error() {
        return 0.0;
    }
    let runs = 2f64.powi(settings.extrapolated as i32 + 1) - 1.0;
    span(case) * runs * settings.work()
}
