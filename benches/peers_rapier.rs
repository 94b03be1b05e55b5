//! Rapier's part of the comparison with other engines in `benches/peers`, as CSV.
//! The table gives error and time of single runs, and of combinations of runs at h, h/2, h/4, ...
//! `cargo bench --bench peers_rapier -- REPEATS FILE...` times each run REPEATS times; the shortest time counts.
//! Each FILE is a scenario file.

use linkage::math::KeepNan;
use std::path::Path;
use std::time::Instant;

use analytic::AssurSolver;
use linkage::case::{Case, Wanted};
use linkage::engine::{Engine, Settings};
use linkage::solver::Solver;
use linkage::trajectory::{Stage, Trajectory};
use rapier_twin::{Build, Precision, Rapier};
use scenario::Scenario;

/// Compared channels, besides the crank angle.
const CHANNELS: [&str; 2] = ["joint.B.fx_N", "joint.B.fy_N"];
/// Steps (s) of the coarsest run of a combination.
const STEPS: [f64; 6] = [1e-3, 7e-4, 5e-4, 4.5e-4, 3.5e-4, 2.5e-4];
/// Largest number of runs in a combination.
const RUNS: usize = 5;
/// Finest step (s); with smaller steps, second differences are rounding noise.
const FINEST: f64 = 1.2e-5;
/// Sweeps per step.
/// More than 16 sweeps change no result.
/// With 8 sweeps, the reaction at the first instant is wrong by a few percent.
const SWEEPS: [usize; 2] = [12, 16];

/// Crank angle (rad) and reaction (N) over the grid, and the shortest times (s) with and without reading reactions.
struct Run {
    columns: Vec<Vec<f64>>,
    seconds: f64,
    bare: f64,
}

fn columns(trajectory: &Trajectory) -> Vec<Vec<f64>> {
    let cranks = trajectory.named("link.crank.angle_rad").expect("the crank has an angle");
    let forces = CHANNELS.map(|name| trajectory.named(name).expect("the joint has a reaction"));
    [cranks].iter().chain(&forces).map(|column| column.to_vec()).collect()
}

/// Processor time (s) of this thread; other work on the machine hardly disturbs it.
/// On systems other than Linux, the function returns the elapsed time since `since`.
fn used(since: Instant) -> f64 {
    // Linux updates the processor time when the thread yields, so the thread yields before the time is requested.
    std::thread::yield_now();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|told| told.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| since.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

/// Runs a case with this step and number of sweeps.
/// Returns the values, and the shortest times with and without reading reactions.
fn run(case: &Case, step: f64, sweeps: usize, repeats: usize) -> Option<Run> {
    let engine = Rapier::new(Build::Multibody, Precision::Double, step);
    let engine = engine.set(Settings { sweeps, ..engine.settings() });
    let positions = case.wanting(Wanted::of(&[Stage::Positions]));
    let (mut found, mut seconds, mut bare) = (None, f64::INFINITY, f64::INFINITY);
    let clock = Instant::now();
    for _ in 0..repeats {
        let before = used(clock);
        found = Some(engine.solve(case).ok()?);
        let between = used(clock);
        engine.solve(&positions).ok()?;
        seconds = seconds.smaller(between - before);
        bare = bare.smaller(used(clock) - between);
    }
    Some(Run { columns: columns(&found?), seconds, bare })
}

/// Weights of the runs at h, h/2, h/4, ... for extrapolation to step zero.
/// The weights assume that the error is a series in h with all powers.
fn weights(runs: usize) -> Vec<f64> {
    let at = |k: usize| 0.5f64.powi(k as i32);
    let others = |k: usize| (0..runs).filter(move |&j| j != k);
    (0..runs).map(|k| others(k).map(|j| at(j) / (at(j) - at(k))).product()).collect()
}

/// Largest errors over the instants, divided by the channels' ranges, and the instant of the largest force error.
fn errors(reference: &[Vec<f64>], found: &[&Run]) -> ([f64; 2], usize) {
    let weights = weights(found.len());
    let (mut worst, mut place) = ([0.0f64; 2], 0);
    for (channel, exact) in reference.iter().enumerate() {
        let range = exact.iter().fold(f64::NEG_INFINITY, |a, &b| a.larger(b))
            - exact.iter().fold(f64::INFINITY, |a, &b| a.smaller(b));
        for (row, exact) in exact.iter().enumerate() {
            let value: f64 = found.iter().zip(&weights).map(|(run, weight)| weight * run.columns[channel][row]).sum();
            let (error, force) = ((value - exact).abs() / range, usize::from(channel > 0));
            if !(error <= worst[force]) {
                worst[force] = error;
                place = if force == 1 { row } else { place };
            }
        }
    }
    (worst, place)
}

fn main() {
    println!("scenario,sweeps,step_s,runs,steps,crank,reaction,worst_row,ms,ms_without_reactions");
    let mut words = std::env::args().skip(1).filter(|word| !word.starts_with('-'));
    let Some(repeats) = words.next().and_then(|word| word.parse().ok()) else { return };
    for name in words {
        let scenario = Scenario::load(Path::new(&name)).unwrap_or_else(|error| panic!("{error}"));
        let case = scenario.case.wanting(Wanted::of(&[Stage::Positions, Stage::Reactions]));
        let reference = columns(&AssurSolver.solve(&case).unwrap_or_else(|error| panic!("{error}")));
        let last = case.grid.times.iter().fold(0.0f64, |last, &t| last.larger(t));
        for sweeps in SWEEPS {
            for coarsest in STEPS {
                let mut made: Vec<Run> = Vec::new();
                for count in 1..=RUNS {
                    let step = coarsest * 0.5f64.powi(count as i32 - 1);
                    if count > 1 && step < FINEST {
                        break;
                    }
                    let Some(next) = run(&case, step, sweeps, repeats) else { break };
                    made.push(next);
                    let ([crank, reaction], row) = errors(&reference, &made.iter().collect::<Vec<_>>());
                    let (ms, bare) = made.iter().fold((0.0, 0.0), |(a, b), run| (a + run.seconds, b + run.bare));
                    let steps = (0..count).map(|k| last / coarsest * 2f64.powi(k as i32)).sum::<f64>();
                    println!(
                        "{},{sweeps},{coarsest:e},{count},{steps:.0},{crank:.3e},{reaction:.3e},{row},{:.2},{:.2}",
                        scenario.name,
                        ms * 1e3,
                        bare * 1e3
                    );
                }
            }
        }
    }
}
