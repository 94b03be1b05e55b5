//! Error and time of every engine, with every route, raw and extrapolated: a Markdown table for docs/engines.md.
//! `cargo bench --bench work_precision [-- SCENARIO]`; with `--features simbody` the table includes the engine Simbody.

use linkage::math::KeepNan;
use std::path::Path;
use std::time::Instant;

use analytic::AssurSolver;
use linkage::engine::{Engine, Settings};
use linkage::solver::Solver;
use linkage::trajectory::{Stage, Trajectory};
use prover::bounds::residuals;
use rapier_twin::Rapier;
use scenario::Scenario;

/// Steps of fixed-step engines, in degrees of crank angle.
const STEPS: [f64; 3] = [0.8, 0.24, 0.08];
/// Requested accuracies of engines that control their error.
const ACCURACIES: [f64; 2] = [1e-4, 1e-10];
/// Number of timings; the shortest counts. Runs longer than a second are timed once.
const REPEATS: usize = 3;
/// Sweeps of Rapier's multibody build. This number is sufficient here because the simulated driving link has a
/// flywheel.
/// Rapier's impulse build needs its full default number of sweeps.
const SWEEPS: usize = 256;

struct Row {
    engine: &'static str,
    settings: Settings,
    resolution: String,
    errors: [f64; 4],
    seconds: f64,
}

/// Largest error divided by the channel's scale, over the channels of the given stages.
fn error(reference: &Trajectory, found: &Trajectory, stages: &[Stage]) -> f64 {
    let residuals = residuals(reference, found).expect("both stand on one grid");
    let own = residuals.iter().filter(|r| stages.contains(&r.channel.kind.stage));
    own.map(|r| r.share()).fold(0.0, f64::larger)
}

fn measure(engine: &dyn Engine, scenario: &Scenario, reference: &Trajectory, resolution: String) -> Option<Row> {
    let mut shortest = f64::INFINITY;
    let mut found = None;
    for _ in 0..REPEATS {
        let since = Instant::now();
        found = Some(engine.solve(&scenario.case).ok()?);
        shortest = shortest.smaller(since.elapsed().as_secs_f64());
        if shortest > 1.0 {
            break;
        }
    }
    let found = found?;
    let stages = [Stage::Positions, Stage::Velocities, Stage::Accelerations, Stage::Reactions];
    let errors = stages.map(|stage| match stage {
        Stage::Reactions => error(reference, &found, &[Stage::Reactions, Stage::BalancingMoment]),
        stage @ (Stage::Positions | Stage::Velocities | Stage::Accelerations | Stage::BalancingMoment) => {
            error(reference, &found, &[stage])
        }
    });
    Some(Row { engine: engine.name(), settings: engine.settings(), resolution, errors, seconds: shortest })
}

fn main() {
    let name = std::env::args().skip(1).find(|word| !word.starts_with('-')).unwrap_or_else(|| "crank_rocker".into());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let reference = AssurSolver.solve(&scenario.case).unwrap_or_else(|error| panic!("{error}"));
    let omega = scenario.case.crank().at(0.0).rate.abs();
    let mut rows = Vec::new();
    for engine in prover::engines::all(1e-3) {
        let resolutions: Vec<(f64, String)> = match engine.controls_error() {
            true => ACCURACIES.map(|accuracy| (accuracy, format!("{accuracy:e}"))).to_vec(),
            false => STEPS.map(|degrees: f64| (degrees.to_radians() / omega, format!("{degrees} deg"))).to_vec(),
        };
        let ways: &[usize] = if engine.controls_error() { &[0] } else { &[0, 1] };
        for &route in engine.routes() {
            for &extrapolated in ways {
                for (resolution, told) in &resolutions {
                    let own = engine.settings().sweeps;
                    let sweeps = if own == Rapier::SWEEPS { SWEEPS } else { own };
                    let settings =
                        Settings { resolution: *resolution, sweeps, route, extrapolated, ..engine.settings() };
                    rows.extend(measure(engine.with(settings).as_ref(), &scenario, &reference, told.clone()));
                }
            }
        }
    }
    let least = rows.iter().map(|row| row.seconds).fold(f64::INFINITY, f64::smaller);
    println!("`{name}`, {} instants; time as a ratio to the fastest run of the table\n", scenario.case.grid.len());
    println!(
        "| engine | route | sweeps | step or accuracy | extrapolated | positions | velocities | accelerations | reactions, moment | time |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for row in rows {
        let Row { engine, settings, resolution, errors, seconds } = row;
        let extrapolated = if settings.extrapolated > 0 { "yes" } else { "" };
        let [positions, velocities, accelerations, reactions] = errors.map(|error| format!("{error:.1e}"));
        println!(
            "| {engine} | {} | {} | {resolution} | {extrapolated} | {positions} | {velocities} | {accelerations} | {reactions} | {:.1} |",
            settings.route.name(),
            settings.sweeps,
            seconds / least
        );
    }
}
