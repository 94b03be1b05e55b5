//! Cost of a chain of four-bars as a function of its length.
//! Five costs are measured: building the case, side 1, side 2, the double-double solution, and a proof with both sides.
//! The growth of each cost from one chain to the next is printed beside the growth of n and of n log n, where n is the
//! number of four-bars.
//!
//! `cargo bench --bench chain [-- N..]`

use std::time::Instant;

use analytic::{AssurSolver, NewtonSolver};
use lab::stress::named;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use prover::run::beside::sides;

/// Number of timings; the shortest counts.
/// A measurement longer than a second is not repeated.
const REPEATS: usize = 5;

fn shortest(mut run: impl FnMut()) -> f64 {
    let mut shortest = f64::INFINITY;
    for _ in 0..REPEATS {
        let since = Instant::now();
        run();
        shortest = shortest.smaller(since.elapsed().as_secs_f64());
        if shortest > 1.0 {
            break;
        }
    }
    shortest
}

fn main() {
    let asked: Vec<f64> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    let counts = if asked.is_empty() { vec![10.0, 100.0, 1000.0] } else { asked };
    let chain = named("chain").expect("the table has it");
    let case = |count: f64| (chain.setup)(count, 0, 0).unwrap_or_else(|error| panic!("{error}")).case;
    let mut before: Option<(f64, Vec<f64>)> = None;
    println!("| four-bars | what | time (s) | growth | n | n log n |\n|---|---|---|---|---|---|");
    for count in counts {
        let own = case(count);
        let mut row = Vec::new();
        let mut time = |what: &str, run: &mut dyn FnMut()| {
            let found = shortest(run);
            let told = before.as_ref().map_or_else(String::new, |(from, all): &(f64, Vec<f64>)| {
                let n = count / from;
                format!("{:.1} | {n:.1} | {:.1}", found / all[row.len()], n * count.ln() / from.ln())
            });
            println!("| {count} | {what} | {found:.2e} | {told} |");
            row.push(found);
        };
        time("the case", &mut || drop(case(count)));
        time("side 1", &mut || drop(AssurSolver.solve(&own).unwrap_or_else(|error| panic!("{error}"))));
        time("side 2", &mut || drop(NewtonSolver.solve(&own).unwrap_or_else(|error| panic!("{error}"))));
        time("double-double", &mut || drop(precise::solve(&own).unwrap_or_else(|error| panic!("{error}"))));
        time("both sides, judged", &mut || drop(sides(&own, None).unwrap_or_else(|error| panic!("{error}"))));
        before = Some((count, row));
    }
}
