//! `tune` against an exhaustive search, and its promise.

mod exhaustive;
mod prices;

use linkage::engine::Engine;
use linkproof::proof::Options;
use linkproof::scenario::Scenario;
use linkproof::tune::{Tuning, Wish, tune};

use crate::common::shipped;
use exhaustive::{REFERENCES, Space, cheaper, error_of, thinned, truth};
use prices::price_of;

/// Within this factor of the cheapest.
const FACTOR: f64 = 1.5;

fn tuned(scenario: &Scenario, within: f64, channels: &[&str], options: &Options) -> linkage::Result<Tuning> {
    let wish = Wish { within, channels: channels.iter().map(|name| name.to_string()).collect() };
    let mut price = |engine: &dyn Engine, run: &mut dyn FnMut() -> linkage::Result<()>| {
        run()?;
        Ok(price_of(&scenario.case, engine))
    };
    tune(scenario, &wish, options, &mut price, &mut |_| {})
}

/// Tunes all Rapier engines on some of the reference mechanisms; what is found must keep its promise where it is checked from outside, with
/// the other analytic side, and nothing in the space may be cheaper than what was found over `below`.
fn near_the_cheapest(names: &[&str], every: usize, within: f64, below: f64, space: &Space) {
    for name in names {
        let scenario = thinned(shipped(&format!("{name}.toml")), every);
        let engines = ["rapier", "rapier-f32", "impulse", "impulse-f32"].map(String::from);
        let options = Options { engines: engines.into(), ..Options::default() };
        let found = tuned(&scenario, within, &[], &options).unwrap_or_else(|error| panic!("{name}: {error}"));
        let best = linkproof::engines::named(found.best.engine, 1e-3).unwrap().with(found.best.settings);
        let verified = error_of(&scenario, &truth(&scenario), best.as_ref());
        assert!(verified <= within, "{name}: {verified:e} with {:?}", found.best);
        let promised = found.best.verified;
        assert!((verified - promised).abs() <= 1e-6 * within, "{name}: {verified:e}, promised {promised:e}");
        let expected = price_of(&scenario.case, best.as_ref());
        assert!((found.best.price / expected - 1.0).abs() <= 1e-12, "{name}: {:?}, {expected}", found.best);

        let mut price = |engine: &dyn Engine| price_of(&scenario.case, engine);
        let (met, runs) = cheaper(&scenario, within, found.best.price / below, space, &mut price);
        let cheapest = met.last().map_or(found.best.price / below, |met| met.price);
        let ratio = found.best.price / cheapest;
        println!(
            "{name} within {within:e}: {ratio:.2} of the cheapest or less, {:?}, {} runs and {runs}, expected {:.1e}",
            found.best, found.runs, found.predicted
        );
        let told = met.last().map(|met| (met.engine.name(), met.engine.settings(), met.error));
        assert!(ratio <= FACTOR, "{name}: {ratio} times the cheapest: {:?}, cheapest {told:?}", found.best);
    }
}

/// A part of what the test below looks at: only what would make it fail is run, sweeps lie a factor 4 apart and steps 1.2.
const SMALL: Space = Space { sweeps: &[4, 16, 64, 256], factor: 1.2 };

#[test]
fn tune_comes_near_the_cheapest_of_an_exhaustive_search_and_keeps_its_promise() {
    let (one, other) = REFERENCES.split_at(4);
    std::thread::scope(|scope| {
        for names in [one, other] {
            scope.spawn(|| near_the_cheapest(names, 24, 1e-3, FACTOR, &SMALL));
        }
    });
}

/// The whole space, and three wishes: `cargo test --release --test suite tune:: -- --ignored --nocapture`. It takes minutes.
#[test]
#[ignore = "minutes"]
fn tune_comes_near_the_cheapest_of_the_whole_space() {
    let space =
        Space { sweeps: &[1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 512, 1024], factor: 1.1 };
    let space = &space;
    let (one, other) = REFERENCES.split_at(4);
    std::thread::scope(|scope| {
        for names in [one, other] {
            scope.spawn(move || {
                for within in [1e-2, 1e-3, 1e-4] {
                    near_the_cheapest(names, 8, within, 1.0, space);
                }
            });
        }
    });
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

/// In free motion probes are refused, whatever the step and the sweeps: that is not tried over and over, and a tune that may take nothing else says so.
#[test]
fn a_route_that_is_refused_is_given_up_at_once() {
    let scenario = shipped("pendulum.toml");
    let options = Options { route: Some("probe".into()), ..Options::of_engine("rapier") };
    let mut runs = 0;
    let wish = Wish { within: 1e-3, channels: Vec::new() };
    let mut price = |_: &dyn Engine, run: &mut dyn FnMut() -> linkage::Result<()>| {
        runs += 1;
        run()?;
        Ok(1.0)
    };
    let error = tune(&scenario, &wish, &options, &mut price, &mut |_| {}).unwrap_err();
    assert!(error.message().contains("rapier does not run it"), "{error}");
    assert!(runs <= 40, "{runs} runs");
}
