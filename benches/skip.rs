//! Cost of solving for all channels, divided by the cost of solving for a few requested channels only.
//! The ratio is measured for both analytic sides, and for Rapier at one setting.
//! Only the ratios are printed; both costs of a ratio are measured in the same run.
//! `cargo bench --bench skip`.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Grid};
use linkage::engine::Settings;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use scenario::Scenario;

/// Number of timings; the shortest counts, because other activity of the machine only adds time.
const REPEATS: usize = 15;
/// Instants of a turn.
const INSTANTS: usize = 3600;

/// Mechanisms, each with its list of requests.
/// Requests are: all positions, positions of a point of the first or the last group, a point's whole motion without
/// forces, and one joint.
const QUESTIONS: [(&str, &[&str]); 4] = [
    ("crank_rocker", &["positions", "point.B.positions", "joint.B"]),
    ("ov7_base", &["positions", "point.3.positions", "point.9.positions", "point.9", "joint.7"]),
    ("ov7_new", &["positions", "point.3.positions", "joint.7"]),
    ("fourth_class", &["positions", "point.A.positions", "link.link_5.positions"]),
];

fn case(name: &str) -> Case {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let crank = scenario.case.crank();
    let turn = std::f64::consts::TAU * crank.sense();
    let angle = |k: usize| crank.start + turn * k as f64 / INSTANTS as f64;
    scenario.case.on(Grid::of_inputs(crank, (0..INSTANTS).map(angle).collect())).unwrap()
}

fn seconds(solver: &dyn Solver, case: &Case) -> f64 {
    let since = Instant::now();
    let _ = black_box(solver.solve(black_box(case)).unwrap_or_else(|error| panic!("{error}")));
    since.elapsed().as_secs_f64()
}

fn main() {
    println!("cost of all channels divided by the cost of the requested channels; {INSTANTS} instants of a turn\n");
    println!("{:14} {:24} {:>8} {:>8} {:>8}", "", "asked", "assur", "newton", "rapier");
    for (name, words) in QUESTIONS {
        let whole = case(name);
        let plain = prover::engines::all(1e-4).remove(0);
        let engine = plain.with(Settings { sweeps: 64, ..plain.settings() });
        let asked = |word: &&str| {
            let channels = whole.channels_called(word);
            assert!(!channels.is_empty(), "{name}: {word}");
            whole.wanting_only(&channels).scene().unwrap().case
        };
        let cases: Vec<Case> = std::iter::once(whole.clone()).chain(words.iter().map(asked)).collect();
        let solvers: [(&dyn Solver, usize); 3] =
            [(&AssurSolver, REPEATS), (&NewtonSolver, REPEATS), (engine.as_ref(), 3)];
        let mut best = vec![[f64::INFINITY; 3]; cases.len()];
        for (column, (solver, repeats)) in solvers.into_iter().enumerate() {
            for _ in 0..repeats {
                for (case, best) in cases.iter().zip(&mut best) {
                    best[column] = best[column].smaller(seconds(solver, case));
                }
            }
        }
        for (word, own) in words.iter().zip(&best[1..]) {
            let ratio = |column: usize| best[0][column] / own[column];
            println!("{name:14} {word:24} {:8.1} {:8.1} {:8.1}", ratio(0), ratio(1), ratio(2));
        }
    }
}
