//! `tune` against an exhaustive search, and its promise.

mod common;

use linkproof::engine::{Engine, Settings};
use linkproof::proof::Options;
use linkproof::scenario::Scenario;
use linkproof::solver::Solver;
use linkproof::tune::{Tuning, Wish, tune};

use common::shipped;

const REFERENCES: [&str; 8] = [
    "crank_rocker",
    "ov7_base",
    "ov7_new",
    "ov7_new_tabulated",
    "fourth_class",
    "six_bar_slider",
    "compressor",
    "class3_group",
];

/// Price of a step in units of a step without sweeps, as measured on the four-bar (multibody, double precision): a sweep costs 0.03 of
/// it. A model, so that no clock decides a test; `cargo bench --bench tune` has the clock's own.
fn price_of(settings: &Settings) -> f64 {
    let steps = settings.substeps as f64 / settings.resolution;
    let runs = if settings.extrapolated { 3.0 } else { 1.0 };
    steps * runs * (1.0 + 0.03 * settings.sweeps as f64)
}

fn tuned(scenario: &Scenario, within: f64, channels: &[&str], options: &Options) -> linkproof::Result<Tuning> {
    let wish = Wish { within, channels: channels.iter().map(|name| name.to_string()).collect() };
    let mut price = |engine: &dyn Engine, run: &mut dyn FnMut() -> linkproof::Result<()>| {
        run()?;
        Ok(price_of(&engine.settings()))
    };
    tune(scenario, &wish, options, &mut price, &mut |_| {})
}

/// Largest error over the scale, in the channels of the stages that the case wants.
fn error_of(scenario: &Scenario, engine: &dyn Engine) -> f64 {
    let reference = linkproof::reference::NewtonSolver.solve(&scenario.case, &mut |_| {}).unwrap();
    let Ok(found) = engine.solve(&scenario.case, &mut |_| {}) else { return f64::INFINITY };
    let residuals = linkproof::compare::residuals(&reference, &found).unwrap();
    residuals.iter().map(|r| if r.max == 0.0 { 0.0 } else { r.max / r.scale }).fold(0.0, f64::max)
}

/// The promise holds when it is checked from outside, with the other analytic side, and no setting of a dense grid is cheaper by more
/// than half. The grid: steps a factor 1.1 apart, sweeps a factor 2.
#[test]
fn tune_comes_near_the_cheapest_of_an_exhaustive_search_and_keeps_its_promise() {
    for name in REFERENCES {
        let mut scenario = shipped(&format!("{name}.toml"));
        let rows: Vec<usize> = (0..scenario.case.grid.len()).step_by(8).collect();
        let times = rows.iter().map(|&row| scenario.case.grid.times[row]).collect();
        scenario.case.grid = linkproof::case::Grid::of_times(&scenario.case.drive, times);
        let options = Options {
            extrapolated: Some(false),
            substeps: Some(1),
            route: Some("differences".into()),
            ..Options::of_engine("rapier")
        };
        let within = 1e-3;
        let found = tuned(&scenario, within, &[], &options).unwrap_or_else(|error| panic!("{name}: {error}"));
        let engine = &options.engines(&scenario).unwrap()[0];
        let verified = error_of(&scenario, engine.with(found.best.settings).as_ref());
        assert!(verified <= within, "{name}: {verified:e} with {:?}", found.best);
        assert!(
            (verified - found.best.verified).abs() <= 1e-6 * within,
            "{name}: {verified:e} {:e}",
            found.best.verified
        );

        let mut cheapest = f64::INFINITY;
        for sweeps in [8, 16, 32, 64, 128, 256, 512] {
            // From large steps to small ones: the first that is met is the cheapest of its sweeps.
            let mut resolution = 8.0 * found.best.settings.resolution;
            while resolution > found.best.settings.resolution / 16.0 {
                let settings = Settings { resolution, sweeps, ..found.best.settings };
                if price_of(&settings) >= cheapest.min(found.best.price) {
                    break;
                }
                if error_of(&scenario, engine.with(settings).as_ref()) <= within {
                    cheapest = cheapest.min(price_of(&settings));
                    break;
                }
                resolution /= 1.1;
            }
        }
        let ratio = found.best.price / cheapest.min(found.best.price);
        eprintln!(
            "{name}: {ratio:.2} of the cheapest, {:?}, {} runs, expected {:e}",
            found.best, found.runs, found.predicted
        );
        assert!(ratio <= 1.5, "{name}: {ratio} times the cheapest: {:?}", found.best);
    }
}

#[test]
fn wishes_that_make_no_sense_say_so() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options::of_engine("rapier");
    for within in [0.0, -1e-3, 2.0, f64::NAN] {
        let error = tuned(&scenario, within, &[], &options).unwrap_err();
        assert!(error.way_out().unwrap().contains("between 0 and 1"), "{error}");
    }
    let error = tuned(&scenario, 1e-3, &["joint.X.fx_N"], &options).unwrap_err();
    assert!(error.message().contains("joint.X.fx_N") && error.way_out().unwrap().contains("reactions"), "{error}");
}

#[test]
fn a_wish_beyond_rounding_tells_how_far_the_engine_comes() {
    let scenario = shipped("crank_rocker.toml");
    let options =
        Options { extrapolated: Some(false), sweeps: Some(64), substeps: Some(1), ..Options::of_engine("rapier") };
    let error = tuned(&scenario, 1e-15, &["accelerations"], &options).unwrap_err();
    assert!(error.message().contains("rapier comes to"), "{error}");
}

/// Fewer channels are cheaper: positions need no reactions, and no step that resolves them.
#[test]
fn only_the_channels_asked_for_decide() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options { extrapolated: Some(false), substeps: Some(1), ..Options::of_engine("rapier") };
    let positions = tuned(&scenario, 1e-4, &["positions"], &options).unwrap();
    let all = tuned(&scenario, 1e-4, &[], &options).unwrap();
    assert!(positions.best.price < all.best.price, "{:?} {:?}", positions.best, all.best);
    assert!(positions.best.worst.contains("_m") || positions.best.worst.contains("angle"), "{:?}", positions.best);
}
