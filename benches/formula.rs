//! Cost of judging formulas (values, first and second derivatives), divided by the cost of solving the poses.
//! Both costs are measured on 3600 poses of a revolution.
//! Only the ratios are printed; both costs of a ratio are measured in the same run.
//! `cargo bench --bench formula`.

#[path = "shared/timing.rs"]
mod timing;

use std::hint::black_box;
use std::path::Path;

use analytic::{AssurSolver, NewtonSolver};
use linkage::case::Grid;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use prover::check::{KnownTrajectory, judge, needed};
use scenario::{Scenario, files_in};

use timing::shortest;

/// Number of timings; the shortest counts.
const REPEATS: usize = 15;
/// Instants of a turn.
const INSTANTS: usize = 3600;

fn main() {
    println!(
        "time of judging one formula, divided by the time of solving its poses (both sides); {INSTANTS} instants\n"
    );
    println!("{:28} {:>8} {:>10} {:>10}", "", "formulas", "mean", "largest");
    for path in files_in(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/formulas")).unwrap() {
        let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let crank = scenario.case.crank();
        if scenario.case.is_free() || crank.constant_speed().is_none() {
            continue;
        }
        let turn = std::f64::consts::TAU * crank.sense();
        let grid = |first: f64| {
            Grid::of_inputs(crank, (0..INSTANTS).map(|k| first + turn * k as f64 / INSTANTS as f64).collect())
        };
        // Mechanisms that do not turn fully are skipped.
        let Ok(whole) = scenario.case.on(grid(crank.start)) else { continue };
        let mut ratios = Vec::new();
        for (formula, claim) in scenario.formulas.claims() {
            let asked = needed(claim, &whole);
            let Ok(case) = whole.wanting_only(&asked).scene().map(|scene| scene.case) else { continue };
            let (Ok(first), Ok(second)) = (AssurSolver.solve(&case), NewtonSolver.solve(&case)) else { continue };
            let solving = shortest(REPEATS, || {
                let _ = black_box((AssurSolver.solve(black_box(&case)), NewtonSolver.solve(black_box(&case))));
            });
            let mut alone = scenario.formulas.clone();
            for own in &mut alone.list {
                own.claim = own.claim.take().filter(|_| own.name == formula.name);
            }
            let error = |_: usize, _: usize| 1e-12;
            let on = |trajectory: &Trajectory| {
                let _ = black_box(judge(black_box(&alone), &KnownTrajectory::new(&case, trajectory, &error)));
            };
            let judging = shortest(REPEATS, || {
                on(&first);
                on(&second);
            });
            ratios.push(judging / solving);
        }
        if ratios.is_empty() {
            continue;
        }
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        let largest = ratios.iter().copied().fold(0.0, f64::larger);
        println!("{:28} {:>8} {:>10.2} {:>10.2}", scenario.name, ratios.len(), mean, largest);
    }
}
