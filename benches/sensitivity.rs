//! Cost of exact derivatives, divided by the cost of the solution.
//! The derivatives are the gradients of the largest reaction and of the largest driving moment of `ov7_base`, with
//! respect to all its dimensions, masses and its speed.
//! `cargo bench --bench sensitivity`.

#[path = "shared/timing.rs"]
mod timing;

use design::sensitivity::{SensitivityQuestion, sensitivity_by};
use std::hint::black_box;
use std::path::Path;

use analytic::AssurSolver;
use linkage::solver::Solver;
use scenario::{CaseSlopes, Scenario};

use timing::shortest;

/// Number of timings; the shortest counts.
const REPEATS: usize = 200;

fn main() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/ov7_base.toml");
    let scenario = Scenario::load(path).unwrap_or_else(|error| panic!("{error}"));
    let figures = ["max:joint.3a.f_N", "maxabs:drive.torque_N_m"].map(|text| text.parse().expect("a figure"));
    let question = SensitivityQuestion { figures: figures.to_vec(), ..SensitivityQuestion::default() };
    // Reading the file is timed separately.
    let slopes = CaseSlopes::of(&scenario, &question.asked).unwrap_or_else(|error| panic!("{error}"));
    let reading = shortest(REPEATS, || drop(black_box(CaseSlopes::of(black_box(&scenario), &question.asked))));
    let mut keys = 0;
    let gradient = shortest(REPEATS, || {
        let found = sensitivity_by(black_box(&scenario), &slopes, &question).unwrap_or_else(|error| panic!("{error}"));
        keys = found.keys.len();
    });
    let solution = shortest(REPEATS, || drop(black_box(AssurSolver.solve(black_box(&scenario.case)))));
    println!("solution of all channels: {:.3} ms", solution * 1e3);
    println!(
        "two figures with their derivatives by {keys} keys: {:.3} ms, {:.2} solutions",
        gradient * 1e3,
        gradient / solution
    );
    println!("reading the derivatives of the numbers of the file: {:.3} ms", reading * 1e3);
}
