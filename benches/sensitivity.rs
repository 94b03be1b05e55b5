//! Cost of exact derivatives, divided by the cost of the solution.
//! The derivatives are the gradients of the largest reaction and of the largest driving moment of `ov7_base`, with
//! respect to all its dimensions, masses and its speed.
//! `cargo bench --bench sensitivity`.

use design::sensitivity::{SensitivityQuestion, sensitivity_by};
use linkage::math::KeepNan;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use analytic::AssurSolver;
use linkage::solver::Solver;
use scenario::{CaseSlopes, Scenario};

/// Number of timings; the shortest counts, because other activity of the machine only adds time.
const REPEATS: usize = 200;

/// Shortest time of `work` (ms).
fn shortest(mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let since = Instant::now();
        work();
        since.elapsed().as_secs_f64() * 1e3
    };
    (0..REPEATS).map(time).fold(f64::INFINITY, f64::smaller)
}

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/ov7_base.toml");
    let scenario = Scenario::load(path).unwrap_or_else(|error| panic!("{error}"));
    let figures = ["max:joint.3a.f_N", "maxabs:drive.torque_N_m"].map(|text| text.parse().expect("a figure"));
    let question = SensitivityQuestion { figures: figures.to_vec(), ..SensitivityQuestion::default() };
    // Reading the file is timed separately.
    let slopes = CaseSlopes::of(&scenario, &question.asked).unwrap_or_else(|error| panic!("{error}"));
    let reading = shortest(|| drop(black_box(CaseSlopes::of(black_box(&scenario), &question.asked))));
    let mut keys = 0;
    let gradient = shortest(|| {
        let found = sensitivity_by(black_box(&scenario), &slopes, &question).unwrap_or_else(|error| panic!("{error}"));
        keys = found.keys.len();
    });
    let solution = shortest(|| drop(black_box(AssurSolver.solve(black_box(&scenario.case)))));
    println!("solution of all channels: {solution:.3} ms");
    println!(
        "two figures with their derivatives by {keys} keys: {gradient:.3} ms, {:.2} solutions",
        gradient / solution
    );
    println!("reading the derivatives of the numbers of the file: {reading:.3} ms");
}
