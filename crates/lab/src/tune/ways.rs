//! Settings of an engine except its step.

use linkage::case::Case;
use linkage::engine::{Engine, Route, Settings};
use linkage::trajectory::Stage;
use prover::run::Options;

/// Numbers of sweeps that are tried.
const SWEEPS: [usize; 11] = [4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096];
/// Numbers of substeps that are tried.
const SUBSTEPS: [usize; 2] = [1, 2];

/// All methods of an engine: its settings except sweeps and resolution.
/// The methods that are usually cheapest come first, so that methods above the known cost are abandoned early.
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
