//! Cost of the harness: the time of an engine's run, divided by the time of a bare loop of the same Rapier world.
//! The run and the loop have the same settings, and are timed alternately in one process.
//! `cargo bench --bench engine [-- SCENARIO|BUILD|SWEEPS...]`.

use linkage::math::KeepNan;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use linkage::case::{Case, Grid, Wanted};
use linkage::engine::{Engine, Settings};
use linkage::mechanism::LinkId;
use linkage::solver::Solver;
use rapier_twin::tree::SpanningTree;
use rapier_twin::{Build, Precision, Rapier};
use scenario::Scenario;

/// Steps per run. The runs are short, so that other activity of the machine leaves some of them undisturbed.
const STEPS: usize = 500;
/// Number of timings; the shortest counts, because other activity of the machine only adds time.
const REPEATS: usize = 40;

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn seconds(run: impl FnOnce()) -> f64 {
    let since = Instant::now();
    run();
    since.elapsed().as_secs_f64()
}

/// The bare loop, which only performs the steps.
fn bare(engine: &Rapier, build: Build, case: &Case, steps: usize) {
    let tree =
        if build == Build::Impulse { SpanningTree::none(&case.mechanism) } else { SpanningTree::of(&case.mechanism) };
    let mut world = engine.world(case, tree, false).expect("Rapier takes the mechanism");
    for (index, drive) in case.drives.iter().enumerate() {
        world.set_drive(index, drive.at(0.0).rate);
    }
    for _ in 0..steps {
        world.bare_step();
    }
    black_box(world.angle(LinkId(1)));
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let asked = |names: &[&str], name: &str| {
        let among: Vec<_> = words.iter().filter(|word| names.contains(&word.as_str())).collect();
        among.is_empty() || among.iter().any(|word| *word == name)
    };
    let step = 1e-4;
    println!(
        "{:14} {:10} {:>7} {:>12} {:>16} {:>22} {:>18}",
        "scenario", "build", "sweeps", "us a step", "without reading", "all, every tenth step", "all, every step"
    );
    const SCENARIOS: [&str; 3] = ["crank_rocker", "ov7_base", "quick_return"];
    for name in SCENARIOS.into_iter().filter(|name| asked(&SCENARIOS, name)) {
        let base = scenario(name).case;
        for (build, told) in [(Build::Multibody, "multibody"), (Build::Impulse, "impulse")] {
            if !asked(&["multibody", "impulse"], told) {
                continue;
            }
            for sweeps in [16, 64, 1024].into_iter().filter(|sweeps| asked(&["16", "64", "1024"], &sweeps.to_string()))
            {
                let engine = Rapier::new(build, Precision::Double, step);
                let engine = engine.set(Settings { sweeps, ..engine.settings() });
                let last = STEPS as f64 * step;
                // The engine also does sixteen steps outside the grid: six backwards from t = 0, six forwards to t = 0
                // again, and four beyond the end.
                // `bare` therefore does sixteen additional steps: nearly the same work as the engine.
                let none = base.on(Grid::of_times(base.crank(), vec![last])).unwrap().wanting(Wanted::of(&[]));
                let all = |every: usize| {
                    let times = (0..=STEPS / every).map(|k| every as f64 * step * k as f64).collect();
                    base.on(Grid::of_times(base.crank(), times)).unwrap().wanting(Wanted::ALL)
                };
                let (tenth, each) = (all(10), all(1));
                let mut best = [f64::INFINITY; 4];
                for _ in 0..REPEATS {
                    let times = [
                        seconds(|| bare(&engine, build, &base, STEPS + 16)),
                        seconds(|| drop(black_box(engine.solve(&none).expect("it runs")))),
                        seconds(|| drop(black_box(engine.solve(&tenth).expect("it runs")))),
                        seconds(|| drop(black_box(engine.solve(&each).expect("it runs")))),
                    ];
                    (0..4).for_each(|k| best[k] = best[k].smaller(times[k]));
                }
                let cost = best[0] * 1e6 / (STEPS + 16) as f64;
                println!(
                    "{name:14} {told:10} {sweeps:>7} {cost:>12.2} {:>16.3} {:>22.3} {:>18.3}",
                    best[1] / best[0],
                    best[2] / best[0],
                    best[3] / best[0]
                );
            }
        }
    }
}
