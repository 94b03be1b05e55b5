//! Cost of a run-up and of the steady motion. The run-up is computed at several accuracies, for the crank alone and for
//! all channels.
//! The run-up is half a second of `crank_rocker`, 501 output points.
//! Each cost is divided by the cost of the run-up of the crank alone at the usual accuracy.
//! Only the ratios are printed; both costs of a ratio are measured in the same run.
//! `cargo bench --bench run_up`.
//!
//! This benchmark does not check errors; `tests/suite/bench.rs` tests the errors of the run-up at the usual accuracy
//! and at 1e-8.

#[path = "shared/timing.rs"]
mod timing;

use std::hint::black_box;
use std::path::Path;

use analytic::reduced::{ACCURACY, ReducedModel, RunUp, motion};
use scenario::Scenario;

use timing::shortest;

/// Number of timings; the shortest counts.
const REPEATS: usize = 100;
const ACCURACIES: [f64; 5] = [1e-8, 1e-9, 1e-10, ACCURACY, 1e-12];

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let case = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}")).case;
    let times: Vec<f64> = (0..=500).map(|k| f64::from(k) * 1e-3).collect();
    let model = ReducedModel::of(&case).unwrap();
    let crank_alone = |accuracy| shortest(REPEATS, || motion(&model, 0.0, black_box(&times), accuracy).unwrap());
    let all_channels = |accuracy| shortest(REPEATS, || RunUp::of(&model, 0.0, black_box(&times), accuracy).unwrap());
    let one = crank_alone(ACCURACY);
    println!("cost divided by the cost of the run-up of the crank alone at the accuracy {ACCURACY:.0e}\n");
    // The time for the reduced model includes finding the range of motion and the kinks of the model's coefficients.
    println!("{:14} {:>8.2}", "reduced model", shortest(REPEATS, || ReducedModel::of(black_box(&case)).unwrap()) / one);
    println!("{:14} {:>8.2}\n", "steady motion", shortest(REPEATS, || model.regime(&[], ACCURACY).unwrap()) / one);
    println!("{:14} {:>12} {:>12}", "run-up", "crank alone", "all channels");
    for accuracy in ACCURACIES {
        println!("{accuracy:<14.0e} {:>12.2} {:>12.2}", crank_alone(accuracy) / one, all_channels(accuracy) / one);
    }
}
