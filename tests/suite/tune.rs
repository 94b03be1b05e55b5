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

/// A part of the space of `cargo bench --bench tune -- whole`, with only those settings that could make the test fail.
/// Neighbouring numbers of sweeps differ by a factor of 4, neighbouring steps by a factor of 1.2.
const SMALL: Space = Space { sweeps: &[4, 16, 64, 256], factor: 1.2 };

#[test]
fn tune_is_near_the_cheapest_settings_and_meets_the_accuracy() {
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
fn invalid_accuracies_and_channels_are_refused() {
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
fn an_unreachable_accuracy_reports_the_best_one() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options::default().engine(EngineName::Rapier).extrapolated(0).sweeps(64).substeps(1);
    let error = tuned(&scenario, 1e-15, &["accelerations"], &options).unwrap_err();
    assert!(error.message().contains("rapier reaches "), "{error}");
}

/// Symptom: four sweeps reach the required accuracy, but the engine's runs then show no order, so a proof is
/// inconclusive.
#[test]
fn regress_recommended_settings_prove_the_promised_accuracy() {
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

/// Symptom: an accuracy below rounding was searched for without end.
#[test]
fn regress_a_search_ends_at_the_work_limit() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options::default().engine(EngineName::Rapier).budget(1e5);
    let error = tuned(&scenario, 1e-9, &[], &options).unwrap_err();
    assert!(error.message().contains("the work limit was reached"), "{error}");
    assert!(error.way_out().unwrap().contains("1e6 steps"), "{error}");
}

/// A few channels cost less than all channels: positions need neither reactions nor a step that resolves reactions.
#[test]
fn only_requested_channels_decide() {
    let scenario = shipped("crank_rocker.toml");
    let options = Options::default().engine(EngineName::Rapier).extrapolated(0).substeps(1);
    let positions = tuned(&scenario, 1e-4, &["positions"], &options).unwrap();
    let all = tuned(&scenario, 1e-4, &[], &options).unwrap();
    assert!(positions.best.price < all.best.price, "{:?} {:?}", positions.best, all.best);
    assert!(positions.best.worst.contains("_m") || positions.best.worst.contains("angle"), "{:?}", positions.best);
}

/// In free motion the engine refuses probes at any step and number of sweeps.
/// Probes are therefore not tried repeatedly, and a tuning that may use only probes reports the refusal.
#[test]
fn a_refused_route_is_given_up_at_once() {
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
    assert!(error.message().contains("rapier cannot run the scenario"), "{error}");
    assert!(runs <= 40, "{runs} runs");
}
