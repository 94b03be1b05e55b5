//! Cost of a run-up against the accuracy of the crank angle, and cost of the steady motion.
//! The run-up is half a second of `crank_rocker`, 500 output points with all channels. `cargo bench --bench run_up`.

use linkage::math::KeepNan;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use analytic::reduced::{ACCURACY, Model, RunUp, motion};
use linkproof::scenario::Scenario;

/// Timings, of which the shortest counts: other activity of the machine only adds time.
const REPEATS: usize = 100;

fn shortest(mut run: impl FnMut()) -> f64 {
    let time = |_| {
        let since = Instant::now();
        run();
        since.elapsed().as_secs_f64()
    };
    (0..REPEATS).map(time).fold(f64::INFINITY, f64::smaller) * 1e3
}

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let case = &scenario.case;
    let times: Vec<f64> = (0..=500).map(|k| f64::from(k) * 1e-3).collect();
    let model = Model::of(case).unwrap();
    println!("model (range of motion, kinks)    {:8.3} ms", shortest(|| drop(black_box(Model::of(case).unwrap()))));
    let steady = shortest(|| drop(black_box(model.regime(&[], ACCURACY).unwrap())));
    println!("steady motion                     {steady:8.3} ms");
    let (exact, _) = motion(&model, 0.0, &times, 1e-14).unwrap();
    println!("{:>10} {:>14} {:>22} {:>16}", "accuracy", "crank alone ms", "all channels ms", "worst crank rad");
    for accuracy in [1e-8, 1e-9, 1e-10, ACCURACY, 1e-12] {
        let alone = shortest(|| drop(black_box(motion(&model, 0.0, &times, accuracy).unwrap())));
        let whole = shortest(|| drop(black_box(RunUp::of(&model, 0.0, &times, accuracy).unwrap())));
        let (found, _) = motion(&model, 0.0, &times, accuracy).unwrap();
        let worst = found.iter().zip(&exact).fold(0.0f64, |most, (a, b)| most.larger((a.crank - b.crank).abs()));
        println!("{accuracy:10.0e} {alone:14.3} {whole:22.3} {worst:16.1e}");
    }
}
