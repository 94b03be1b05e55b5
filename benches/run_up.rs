//! Cost of a run-up and of the steady motion. The run-up is computed at several accuracies, for the crank alone and for
//! all channels.
//! The run-up is half a second of `crank_rocker`, 501 output points.
//! `cargo bench --bench run_up`.
//!
//! This benchmark does not check errors; `tests/suite/bench.rs` tests the errors of the run-up at the usual accuracy
//! and at 1e-8.

use std::path::Path;
use std::sync::LazyLock;

use analytic::reduced::{ACCURACY, ReducedModel, RunUp, motion};
use divan::{Bencher, black_box};
use linkage::case::Case;
use scenario::Scenario;

const ACCURACIES: [f64; 5] = [1e-8, 1e-9, 1e-10, ACCURACY, 1e-12];

static CASE: LazyLock<Case> = LazyLock::new(|| {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}")).case
});

fn times() -> Vec<f64> {
    (0..=500).map(|k| f64::from(k) * 1e-3).collect()
}

fn main() {
    divan::main();
}

/// Cost of building the reduced model, including the range of motion and the kinks.
#[divan::bench]
fn model(bencher: Bencher) {
    let case = &*CASE;
    bencher.bench(|| ReducedModel::of(black_box(case)).unwrap());
}

#[divan::bench]
fn steady_motion(bencher: Bencher) {
    let model = ReducedModel::of(&CASE).unwrap();
    bencher.bench(|| model.regime(&[], ACCURACY).unwrap());
}

#[divan::bench(args = ACCURACIES)]
fn crank_alone(bencher: Bencher, accuracy: f64) {
    let (model, times) = (ReducedModel::of(&CASE).unwrap(), times());
    bencher.bench(|| motion(&model, 0.0, black_box(&times), accuracy).unwrap());
}

#[divan::bench(args = ACCURACIES)]
fn all_channels(bencher: Bencher, accuracy: f64) {
    let (model, times) = (ReducedModel::of(&CASE).unwrap(), times());
    bencher.bench(|| RunUp::of(&model, 0.0, black_box(&times), accuracy).unwrap());
}
