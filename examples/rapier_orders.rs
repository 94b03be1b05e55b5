//! Errors of Rapier's builds and routes against the reference, and the orders of convergence of these errors. The
//! tables of `docs/rapier.md` come from this example.
//!
//! `cargo run --release --example rapier_orders -- SCENARIO DEG [ENGINE,..] [ROUTE,..] [plain|extrapolated] [SWEEPS]`
//!
//! For each stage the example prints the largest error of any channel, divided by half of the channel's range.
//! The step is DEG degrees of the crank.
//! The example also prints the order of convergence observed between this step and half of this step.

use std::path::Path;
use std::time::Instant;

use analytic::AssurSolver;
use linkage::case::{Case, Wanted};
use linkage::engine::{Engine, Route, Settings};
use linkage::solver::Solver;
use linkage::trajectory::{Stage, Trajectory};
use prover::bounds::convergence::observed_order;
use prover::bounds::residuals;
use scenario::Scenario;

fn solve(solver: &dyn Solver, case: &Case) -> Option<(Trajectory, f64)> {
    let since = Instant::now();
    match solver.solve(case) {
        Ok(found) => Some((found, since.elapsed().as_secs_f64())),
        Err(error) => {
            println!("{:12} {error}", solver.name());
            None
        }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let at = |k: usize, default: &str| arguments.get(k).cloned().unwrap_or_else(|| default.into());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{}.toml", at(0, "crank_rocker")));
    let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let case = &scenario.case.wanting(Wanted::ALL);
    let degrees: f64 = at(1, "0.08").parse().expect("a step in degrees");
    let step = degrees.to_radians() / case.crank().at(0.0).rate.abs();
    let (truth, _) = solve(&AssurSolver, case).expect("the reference solves its own scenarios");
    println!("{} at {degrees} deg = {step:e} s a step", scenario.name);
    println!(
        "{:12} {:12} {:>6} {:>8}  largest error (order) of {}",
        "engine",
        "route",
        "extrap",
        "s",
        Stage::ALL.map(Stage::name).join(", ")
    );
    for name in at(2, "rapier,impulse,rapier-f32,impulse-f32").split(',') {
        let engine = prover::engines::named(name, step).unwrap_or_else(|| panic!("no engine {name}"));
        for route in at(3, "differences,native,probe").split(',') {
            let route = Route::named(route).expect("a route");
            for extrapolated in at(4, "plain,extrapolated").split(',').map(|word| usize::from(word == "extrapolated")) {
                let sweeps = at(5, &engine.settings().sweeps.to_string()).parse().expect("a number of sweeps");
                let engine = engine.with(Settings { route, extrapolated, sweeps, ..engine.settings() });
                row(engine.as_ref(), case, &truth);
            }
        }
    }
}

fn row(engine: &dyn Engine, case: &Case, truth: &Trajectory) {
    let finer = engine.at(0.5 * engine.settings().resolution);
    let (Some((coarse, seconds)), Some((fine, _))) = (solve(engine, case), solve(finer.as_ref(), case)) else { return };
    let found = residuals(truth, &coarse).expect("one grid");
    let mut text = String::new();
    for stage in Stage::ALL {
        let own = found.iter().filter(|residual| residual.channel.kind.stage == stage);
        let Some(worst) = own.max_by(|a, b| a.share().total_cmp(&b.share())) else { continue };
        let order = observed_order(truth, [&coarse, &fine], &worst.channel).ok().flatten().unwrap_or(f64::NAN);
        let noise = engine.noise(case, worst.channel.kind) / worst.scale;
        text += &format!("  {:.1e} ({order:.2}; noise {noise:.0e})", worst.share());
        if std::env::var_os("WHERE").is_some() {
            text += &format!(" {} at {:.1} deg", worst.channel, worst.worst_crank.to_degrees());
        }
    }
    let Settings { route, extrapolated, .. } = engine.settings();
    println!("{:12} {:12} {:>6} {seconds:>8.3}{text}", engine.name(), route.name(), extrapolated);
}
