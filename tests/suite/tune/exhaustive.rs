//! All settings of all Rapier engines on a dense grid, for comparison with `tune`.
//! The tests compare by the cost model, `benches/tune.rs` by measured time.

use analytic::NewtonSolver;
use linkage::case::Grid;
use linkage::engine::{Engine, Settings};
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use prover::bounds::{Residual, residuals};
use scenario::Scenario;

/// Mechanisms with published figures, of every class, with and without sliders.
pub const REFERENCES: [&str; 8] = [
    "crank_rocker",
    "ov7_base",
    "ov7_new",
    "ov7_new_tabulated",
    "fourth_class",
    "six_bar_slider",
    "compressor",
    "class3_group",
];

/// Largest step in the search, in degrees of the crank.
/// With this step a revolution has twelve steps, and six-point interpolation spans 150 deg.
const COARSEST_DEG: f64 = 30.0;
/// If the error of a step exceeds the required error by this factor, larger steps are not run.
/// Errors grow with the step, except where parts of opposite sign cancel at one instant.
/// Such cancellation never reduces the error by this factor at all instants of all channels.
const HOPELESS: f64 = 30.0;

/// The settings in the exhaustive search.
pub struct Space {
    /// Numbers of sweeps.
    pub sweeps: &'static [usize],
    /// Ratio of successive steps.
    pub factor: f64,
}

/// Settings that reach the required accuracy.
pub struct Met {
    pub engine: Box<dyn Engine>,
    pub price: f64,
    pub error: f64,
}

/// The scenario at every `every`-th instant of its grid.
pub fn thinned(mut scenario: Scenario, every: usize) -> Scenario {
    let grid = &scenario.case.grid;
    let times = grid.times.iter().step_by(every).copied().collect();
    scenario.case = scenario.case.on(Grid::of_times(scenario.case.crank(), times)).unwrap();
    scenario
}

/// Largest error divided by the scale, over all requested channels; infinite if the engine fails.
/// The reference comes from the analytic side that `tune` does not use.
pub fn error_of(scenario: &Scenario, truth: &Trajectory, engine: &dyn Engine) -> f64 {
    let Ok(found) = engine.solve(&scenario.case) else { return f64::INFINITY };
    let residuals = residuals(truth, &found).expect("both trajectories have the same grid");
    residuals.iter().map(Residual::share).fold(0.0, f64::larger)
}

/// The reference of [`error_of`].
pub fn truth(scenario: &Scenario) -> Trajectory {
    NewtonSolver.solve(&scenario.case).unwrap_or_else(|error| panic!("{error}"))
}

/// The rows of the space: each row is one combination of all settings of the Rapier engines except the step.
/// These settings are engine, route, extrapolation, substeps and sweeps.
fn rows(space: &Space) -> Vec<Box<dyn Engine>> {
    let mut rows = Vec::new();
    for engine in prover::engines::all(1e-3).into_iter().filter(|engine| !engine.controls_error()) {
        for &route in engine.routes() {
            for extrapolated in [0, 1] {
                for substeps in [1, 2] {
                    for &sweeps in space.sweeps {
                        let own = engine.settings();
                        rows.push(engine.with(Settings { route, extrapolated, substeps, sweeps, ..own }));
                    }
                }
            }
        }
    }
    rows
}

/// Searches every row of the space from the finest affordable step to larger steps.
/// At first, the limit of the cost is the argument `below`.
/// Settings are sufficient if their cost is below the limit and their error is at most `within`.
/// The cost of sufficient settings becomes the new limit.
/// Returns the cheapest sufficient settings of each row; rows without sufficient settings give no result.
/// Each result is therefore cheaper than the previous result, and the last result is the cheapest of all rows.
/// Also returns the number of runs.
pub fn cheaper(
    scenario: &Scenario,
    within: f64,
    below: f64,
    space: &Space,
    price: &mut dyn FnMut(&dyn Engine) -> f64,
) -> (Vec<Met>, usize) {
    let truth = truth(scenario);
    let coarsest = COARSEST_DEG.to_radians() / scenario.case.crank().at(0.0).rate.abs();
    let (mut met, mut runs): (Vec<Met>, usize) = (Vec::new(), 0);
    for row in rows(space) {
        let mut limit = met.last().map_or(below, |best| best.price);
        let at = |k: i32| row.at(coarsest * space.factor.powi(-k));
        let Some(finest) = (0..200).take_while(|&k| price(at(k).as_ref()) < limit).last() else { continue };
        let mut best = None;
        for k in (0..=finest).rev() {
            let engine = at(k);
            runs += 1;
            let error = error_of(scenario, &truth, engine.as_ref());
            let price = price(engine.as_ref());
            if error <= within && price < limit {
                limit = price;
                best = Some(Met { engine, price, error });
            } else if !(error <= HOPELESS * within) {
                break;
            }
        }
        met.extend(best);
    }
    (met, runs)
}
