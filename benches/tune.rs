//! Time of the settings that `tune` chooses, divided by the time of the cheapest settings of an exhaustive search.
//! Both settings are timed alternately.
//! The search covers engines, routes, extrapolation, substeps, sweeps and steps.
//! `cargo bench --bench tune [-- SCENARIO...]`.
//! With `-- prices` the benchmark measures the constants of the cost model in `crates/lab/src/tune/price.rs`.
//! With `-- whole` the benchmark searches the whole space by the cost model, for three required accuracies.
//! The benchmark then fails if the settings that `tune` chooses miss the required error, or cost more than `FACTOR`
//! times the cheapest settings.

use linkage::math::KeepNan;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use lab::tune::{WantedAccuracy, tune};
use linkage::case::{Case, Grid, Wanted};
use linkage::engine::{Engine, Route, Settings};
use linkage::trajectory::Stage;
use prover::engines::EngineName;
use prover::run::Options;
use scenario::Scenario;

#[path = "../tests/suite/tune/exhaustive.rs"]
mod exhaustive;
#[path = "../tests/suite/tune/near.rs"]
mod near;

use exhaustive::{Met, REFERENCES, Space, cheaper, error_of, thinned, truth};
use near::near_the_cheapest;

const WITHIN: f64 = 1e-3;
/// Only every eighth instant of a scenario's grid is compared.
const EVERY: usize = 8;
const SPACE: Space = Space { sweeps: &[4, 8, 16, 32, 64, 128, 256], factor: 1.15 };
/// Number of alternating timings; the shortest counts, because other activity of the machine only adds time.
const REPEATS: usize = 7;
/// Number of the cheapest settings of the exhaustive search that are timed again.
const FINALISTS: usize = 5;

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// Shortest time of `repeats` runs (s); infinite if a run fails.
fn seconds(engine: &dyn Engine, case: &Case, repeats: usize) -> f64 {
    let mut shortest = f64::INFINITY;
    for _ in 0..repeats {
        let since = Instant::now();
        if black_box(engine.solve(case)).is_err() {
            return f64::INFINITY;
        }
        shortest = shortest.smaller(since.elapsed().as_secs_f64());
    }
    shortest
}

/// Cost of settings that differ only in the step: a constant plus a part proportional to the number of steps.
/// Runs at two steps determine the constant and the proportional part.
struct Clock<'a> {
    case: &'a Case,
    row: Option<(Settings, &'static str)>,
    fit: [f64; 2],
}

impl Clock<'_> {
    fn price(&mut self, engine: &dyn Engine) -> f64 {
        let own = engine.settings();
        let row = (Settings { resolution: 0.0, ..own }, engine.name());
        if self.row != Some(row) {
            self.row = Some(row);
            let degree = 1f64.to_radians() / self.case.crank().at(0.0).rate.abs();
            let [coarse, fine] = [2.0 * degree, degree];
            let [a, b] = [coarse, fine].map(|step| seconds(engine.at(step).as_ref(), self.case, 2));
            let slope = (b - a) / (1.0 / fine - 1.0 / coarse);
            self.fit = [b - slope / fine, slope];
        }
        // If a run fails, the cost is unknown and counts as infinite.
        let price = self.fit[0] + self.fit[1] / own.resolution;
        if price.is_finite() { price } else { f64::INFINITY }
    }
}

fn told(engine: &dyn Engine, case: &Case) -> String {
    let settings = engine.settings();
    let degrees = (settings.resolution * case.crank().at(0.0).rate.abs()).to_degrees();
    format!(
        "{} {} {degrees:.3} deg, {} sweeps, {} substeps{}",
        engine.name(),
        settings.route.name(),
        settings.sweeps,
        settings.substeps,
        if settings.extrapolated > 0 { ", extrapolated" } else { "" }
    )
}

fn compare(name: &str) {
    let scenario = thinned(scenario(name), EVERY);
    let case = &scenario.case;
    let engines = prover::engines::all(1e-3).into_iter().filter(|engine| !engine.controls_error());
    let named = engines.filter_map(|engine| EngineName::named(engine.name()));
    let options = named.fold(Options::default(), Options::engine);
    let wish = WantedAccuracy { within: WITHIN, channels: Vec::new() };
    let mut price = |_: &dyn Engine, run: &mut dyn FnMut() -> linkage::Result<()>| {
        let mut shortest = f64::INFINITY;
        for _ in 0..2 {
            let since = Instant::now();
            run()?;
            shortest = shortest.smaller(since.elapsed().as_secs_f64());
        }
        Ok(shortest)
    };
    let since = Instant::now();
    let found = tune(&scenario, &wish, &options, &mut price, &mut |_| {}).unwrap_or_else(|error| panic!("{error}"));
    let tuning = since.elapsed().as_secs_f64();
    let best =
        prover::engines::named(found.cheapest.engine, 1e-3).expect("it is one of them").with(found.cheapest.settings);
    let mut clock = Clock { case, row: None, fit: [0.0; 2] };
    let since = Instant::now();
    let (mut met, runs) =
        cheaper(&scenario, WITHIN, 1.3 * found.cheapest.price, &SPACE, &mut |engine| clock.price(engine));
    let searching = since.elapsed().as_secs_f64();
    met.reverse();
    met.truncate(FINALISTS);
    let mut shortest = vec![f64::INFINITY; met.len()];
    let mut own = f64::INFINITY;
    for _ in 0..REPEATS {
        own = own.smaller(seconds(best.as_ref(), case, 1));
        for (Met { engine, .. }, shortest) in met.iter().zip(&mut shortest) {
            *shortest = shortest.smaller(seconds(engine.as_ref(), case, 1));
        }
    }
    let verified = error_of(&scenario, &truth(&scenario), best.as_ref());
    println!("{name}");
    println!("  tune      {:.2} ms, error {verified:.2e}: {}", own * 1e3, told(best.as_ref(), case));
    let cheapest = (0..met.len()).min_by(|&a, &b| shortest[a].total_cmp(&shortest[b]));
    if let Some(k) = cheapest {
        let Met { engine, error, .. } = &met[k];
        println!("  cheapest  {:.2} ms, error {error:.2e}: {}", shortest[k] * 1e3, told(engine.as_ref(), case));
    }
    let least = cheapest.map_or(own, |k| shortest[k].smaller(own));
    println!(
        "  ratio {:.2}; tune {} runs in {tuning:.1} s, exhaustive {runs} runs in {searching:.1} s",
        own / least,
        found.runs
    );
}

/// Measures the cost of steps, sweeps, substeps, instants and worlds, in units of a step of `rapier` without sweeps.
fn measure_prices() {
    let base = scenario("crank_rocker").case;
    let (steps, step) = (1000, 1e-3);
    let last = steps as f64 * step;
    let quiet = base.on(Grid::of_times(base.crank(), vec![last])).unwrap().wanting(Wanted::of(&[Stage::Positions]));
    let one = quiet.wanting(Wanted::ALL);
    let times = (1..=steps).map(|k| k as f64 * step).collect();
    let all = base.on(Grid::of_times(base.crank(), times)).unwrap().wanting(Wanted::ALL);
    let mut unit = f64::NAN;
    for engine in prover::engines::all(step).into_iter().filter(|engine| !engine.controls_error()) {
        let set = |sweeps, substeps, route| engine.with(Settings { sweeps, substeps, route, ..engine.settings() });
        let cost = |case: &Case, sweeps, substeps, route| {
            seconds(set(sweeps, substeps, route).as_ref(), case, 15) / (steps + 16) as f64
        };
        let [few, many] = [4, 132].map(|sweeps| cost(&quiet, sweeps, 1, Route::Differences));
        let sweep = (many - few) / 128.0;
        let fixed = few - 4.0 * sweep;
        unit = if unit.is_nan() { fixed } else { unit };
        let halves = cost(&quiet, 4, 2, Route::Differences);
        let native = cost(&one, 4, 1, Route::Native);
        let instant = cost(&all, 4, 1, Route::Differences) - few;
        let probe = cost(&all, 4, 1, Route::Probe) - few;
        println!(
            "{:12} step {:.3}, sweep {:.4}, instant {:.3}; of a step with 4 sweeps: with two substeps {:.2}, native {:.2}, a probe {:.2}",
            engine.name(),
            fixed / unit,
            sweep / unit,
            instant / unit,
            halves / few,
            native / few,
            probe / few
        );
    }
    println!("unit: {:.2} us", unit * 1e6);
}

/// Compares the settings that `tune` chooses with the cheapest settings of the whole space, for three required
/// accuracies.
/// The costs come from the cost model. Nothing is timed, but the comparison runs for minutes.
fn whole(names: &[&str]) {
    const SWEEPS: &[usize] = &[1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 512, 1024];
    const WHOLE: Space = Space { sweeps: SWEEPS, factor: 1.1 };
    for name in names {
        for within in [1e-2, 1e-3, 1e-4] {
            near_the_cheapest(&thinned(scenario(name), EVERY), within, 1.0, &WHOLE);
        }
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    if words.iter().any(|word| word == "prices") {
        return measure_prices();
    }
    let of_model = words.iter().any(|word| word == "whole");
    let named = |name: &&str| words.len() == usize::from(of_model) || words.iter().any(|word| word == name);
    let names: Vec<&str> = REFERENCES.into_iter().filter(named).collect();
    if of_model {
        // The searches are not timed, so the two halves of the list of scenarios are searched in parallel.
        let (one, other) = names.split_at(names.len() / 2);
        return std::thread::scope(|scope| {
            scope.spawn(|| whole(one));
            whole(other);
        });
    }
    names.into_iter().for_each(compare);
}
