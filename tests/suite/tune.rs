//! `tune` against an exhaustive search, and the accuracy of its prediction.

mod exhaustive;
mod near;

use lab::tune::{WantedAccuracy, tune};
use linkage::engine::{Engine, Settings};
use prover::engines::EngineName;
use prover::run::{Options, prove};

use crate::common::shipped;
use exhaustive::{REFERENCES, Space, thinned};
use near::{FACTOR, near_the_cheapest, tuned};

/// A part of the space of `cargo bench --bench tune -- whole`. Only settings that would make the test fail are run;
/// sweeps are a factor 4 apart and steps 1.2.
const SMALL: Space = Space { sweeps: &[4, 16, 64, 256], factor: 1.2 };

#[test]
fn tune_comes_near_the_cheapest_of_an_exhaustive_search_and_keeps_its_promise() {
    let (one, other) = REFERENCES.split_at(4);
    std::thread::scope(|scope| {
        for names in [one, other] {
            scope.spawn(move || {
                for name in names {
                    near_the_cheapest(&thinned(shipped(&format!("{name}.toml")), 24), 1e-3, FACTOR, &SMALL);
                }
            });
        }
    });
}

#[test]
fn wishes_that_make_no_sense_say_so() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options::default().engine(EngineName::Rapier);
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
    let options = Options::default().engine(EngineName::Rapier).extrapolated(0).sweeps(64).substeps(1);
    let error = tuned(&scenario, 1e-15, &["accelerations"], &options).unwrap_err();
    assert!(error.message().contains("rapier comes to"), "{error}");
}

/// Symptom: four sweeps meet the wish, but the engine's runs show no order with them, so that a proof is inconclusive.
#[test]
fn regress_settings_that_are_recommended_prove_what_they_promise() {
    for (name, within) in [("crank_rocker", 1e-4), ("six_bar_slider", 1e-3)] {
        let scenario = shipped(&format!("{name}.toml"));
        let found = tuned(&scenario, within, &[], &Options::default().engine(EngineName::Rapier)).unwrap();
        let Settings { resolution, sweeps, substeps, route, extrapolated } = found.best.settings;
        let options = Options::default().engine(EngineName::Rapier).step(resolution).sweeps(sweeps);
        let options = options.substeps(substeps).route(route).extrapolated(extrapolated);
        let proof = prove(&scenario, &options).unwrap();
        assert_eq!((found.best.is_proven, proof.verdict.word()), (true, "agree"), "{name}: {:?}", found.best);
        assert!(found.best.verified <= within, "{name}: {:?}", found.best);
    }
}

/// Symptom: a wish below what rounding leaves was searched for without end.
#[test]
fn regress_a_search_ends_with_the_work_that_is_allowed() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options::default().engine(EngineName::Rapier).budget(1e5);
    let error = tuned(&scenario, 1e-9, &[], &options).unwrap_err();
    assert!(error.message().contains("the work that was allowed is done"), "{error}");
    assert!(error.way_out().unwrap().contains("1e6 steps"), "{error}");
}

/// Fewer channels are cheaper: positions need no reactions, and no step that resolves them.
#[test]
fn only_the_channels_asked_for_decide() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options::default().engine(EngineName::Rapier).extrapolated(0).substeps(1);
    let positions = tuned(&scenario, 1e-4, &["positions"], &options).unwrap();
    let all = tuned(&scenario, 1e-4, &[], &options).unwrap();
    assert!(positions.best.price < all.best.price, "{:?} {:?}", positions.best, all.best);
    assert!(positions.best.worst.contains("_m") || positions.best.worst.contains("angle"), "{:?}", positions.best);
}

/// In free motion probes are refused, whatever the step and the sweeps. So they are not tried again and again, and a
/// tuning that may use nothing else reports it.
#[test]
fn a_route_that_is_refused_is_given_up_at_once() {
    let scenario = shipped("pendulum.toml");
    let options = Options::default().engine(EngineName::Rapier).route(linkage::engine::Route::Probe);
    let mut runs = 0;
    let wish = WantedAccuracy { within: 1e-3, channels: Vec::new() };
    let mut price = |_: &dyn Engine, run: &mut dyn FnMut() -> linkage::Result<()>| {
        runs += 1;
        run()?;
        Ok(1.0)
    };
    let error = tune(&scenario, &wish, &options, &mut price, &mut |_| {}).unwrap_err();
    assert!(error.message().contains("rapier does not run it"), "{error}");
    assert!(runs <= 40, "{runs} runs");
}
