//! The methods that are measured.
//! The methods of engines differ in step, sweeps, extrapolations and the way to obtain reactions.
//! The methods of analytic sides differ in accuracy.

use super::options::BenchOptions;
use super::peer::Way;
use super::point::{BenchOutcome, BenchPoint, MethodOwner};
use crate::sentences;
use crate::steps::work_of_run;
use analytic::reduced::ACCURACY;
use analytic::{AssurAt, NewtonAt};
use linkage::case::Case;
use linkage::engine::{Engine, Route, Settings};
use linkage::solver::Solver;
use linkage::trajectory::Stage;
use prover::engines::{EngineName, usual_step, with_step};

/// Steps of fixed-step engines, as multiples of the usual step, the coarsest first.
const STEPS: [f64; 10] = [16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];
const QUICK_STEPS: [f64; 3] = [8.0, 2.0, 0.5];
/// Accuracies of engines that control their error.
const ACCURACIES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
const QUICK_ACCURACIES: [f64; 2] = [1e-4, 1e-10];
/// Accuracies of the analytic sides' integration, in addition to the usual accuracy.
const SIDES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
/// Numbers of sweeps, as multiples of the engine's smallest useful number.
const SWEEPS: [usize; 3] = [1, 4, 16];
/// Numbers of extrapolations.
const TIMES: [usize; 4] = [0, 1, 2, 3];

/// The party that runs a method.
pub(super) enum Runner {
    /// An analytic side.
    Side(Box<dyn Solver>),
    /// An engine.
    Engine(Box<dyn Engine>),
    /// The peer with this index, and the method it is called with.
    Peer(usize, Way),
}

/// A method to be measured.
/// The method's [`BenchPoint`] counts as failed until the method has run.
pub(super) struct Planned {
    pub(super) point: BenchPoint,
    pub(super) runner: Runner,
}

impl Planned {
    fn new(program: &str, party: MethodOwner, resolution: String, runner: Runner) -> Self {
        let (program, way) = (program.to_string(), String::new());
        let outcome = BenchOutcome::Failed(sentences::IT_WAS_NOT_RUN.into());
        Planned {
            point: BenchPoint { program, party, way, resolution, settings: None, is_usual: false, outcome },
            runner,
        }
    }

    /// A method that a peer offers.
    pub(super) fn of_peer(index: usize, name: &str, way: Way) -> Self {
        let words = way.name.clone();
        let mut planned = Planned::new(name, MethodOwner::Peer, way.resolution.clone(), Runner::Peer(index, way));
        planned.point.way = words;
        planned
    }

    fn of_side(solver: Box<dyn Solver>, accuracy: Option<f64>) -> Self {
        let resolution = accuracy.map_or_else(String::new, |accuracy| format!("accuracy {accuracy:e}"));
        Planned::new(solver.name(), MethodOwner::Side, resolution, Runner::Side(solver))
    }
}

/// All methods of analytic sides and engines to be measured.
pub(super) struct Plan {
    pub(super) points: Vec<Planned>,
    pub(super) left_out: usize,
    pub(super) versions: Vec<(String, String)>,
}

/// The methods of analytic sides and engines.
/// A curve contains the methods of one engine whose settings differ only in the resolution.
/// The budget is divided equally between the curves.
/// Each curve gets ever finer resolutions until its part of the budget is used.
pub(super) fn plan(case: &Case, options: &BenchOptions) -> Plan {
    let mut points = sides(case, options);
    let names = if options.engines.is_empty() { EngineName::ALL.to_vec() } else { options.engines.clone() };
    let engines: Vec<Box<dyn Engine>> =
        names.into_iter().filter_map(|name| with_step(name, usual_step(case)).ok()).collect();
    let versions = engines.iter().map(|engine| (engine.name().to_string(), engine.version())).collect();
    let curves: Vec<(&dyn Engine, Settings)> = engines
        .iter()
        .flat_map(|engine| {
            curves(engine.as_ref(), case, options).into_iter().map(move |curve| (engine.as_ref(), curve))
        })
        .collect();
    let share = options.budget() / curves.len().max(1) as f64;
    let mut left_out = 0;
    for (engine, curve) in curves {
        let mut spent = 0.0;
        for (rung, resolution) in resolutions(engine, curve.resolution, options).into_iter().enumerate() {
            let settings = Settings { resolution, ..curve };
            spent += work(case, engine, &settings);
            // The coarsest run of a curve is always made, even beyond the curve's budget.
            if spent > share && rung > 0 {
                left_out += 1;
                continue;
            }
            let resolution = match engine.controls_error() {
                true => format!("accuracy {resolution:e}"),
                false => format!("step {resolution:.3e} s"),
            };
            let runner = Runner::Engine(engine.with(settings));
            let mut planned = Planned::new(engine.name(), MethodOwner::Engine, resolution, runner);
            (planned.point.way, planned.point.settings) = (told(engine, &settings, case), Some(settings));
            points.push(planned);
        }
    }
    Plan { points, left_out, versions }
}

fn sides(case: &Case, options: &BenchOptions) -> Vec<Planned> {
    let make = |accuracy: f64| -> [Box<dyn Solver>; 2] { [Box::new(AssurAt(accuracy)), Box::new(NewtonAt(accuracy))] };
    let told = case.is_free().then_some(ACCURACY);
    let mut points: Vec<Planned> = make(ACCURACY).map(|side| Planned::of_side(side, told)).into();
    points.iter_mut().for_each(|own| own.point.is_usual = true);
    if case.is_free() {
        let accuracies = if options.is_quick { &SIDES[2..3] } else { &SIDES[..] };
        for &accuracy in accuracies {
            points.extend(make(accuracy).map(|side| Planned::of_side(side, Some(accuracy))));
        }
    }
    points
}

/// All combinations of an engine's settings to be measured. The caller varies the resolution.
fn curves(engine: &dyn Engine, case: &Case, options: &BenchOptions) -> Vec<Settings> {
    let own = engine.settings();
    let has_forces = case.wanted.deepest() >= Stage::Reactions;
    let routes: Vec<Route> = if has_forces { engine.routes().to_vec() } else { vec![own.route] };
    let sweeps: Vec<usize> = match engine.sweeps(case) {
        None => vec![own.sweeps],
        Some([1, 1]) => vec![1],
        Some([few, most]) if options.is_quick => vec![(few * SWEEPS[1]).min(most)],
        Some([few, most]) => SWEEPS.map(|times| (few * times).min(most)).to_vec(),
    };
    let times: &[usize] = match (engine.controls_error(), options.is_quick) {
        (true, _) => &TIMES[..1],
        (false, true) => &TIMES[..2],
        (false, false) => &TIMES,
    };
    let mut curves = Vec::new();
    for &route in &routes {
        for &sweeps in &sweeps {
            // Reactions from probes or impulses are extrapolated at most once, because a second extrapolation does not
            // improve these reactions.
            let worth = times.iter().filter(|&&times| route == Route::Differences || times < 2);
            curves.extend(worth.map(|&extrapolated| Settings { sweeps, route, extrapolated, ..own }));
        }
    }
    curves
}

fn resolutions(engine: &dyn Engine, usual: f64, options: &BenchOptions) -> Vec<f64> {
    match (engine.controls_error(), options.is_quick) {
        (true, true) => QUICK_ACCURACIES.to_vec(),
        (true, false) => ACCURACIES.to_vec(),
        (false, true) => QUICK_STEPS.map(|times| times * usual).to_vec(),
        (false, false) => STEPS.map(|times| times * usual).to_vec(),
    }
}

/// Work of a run including its probes. The unit is the work of an engine step without sweeps.
fn work(case: &Case, engine: &dyn Engine, settings: &Settings) -> f64 {
    let probes = match settings.route {
        Route::Probe if !engine.controls_error() => case.grid.len() as f64 * settings.work() * settings.resolution,
        Route::Probe | Route::Differences | Route::Native => 0.0,
    };
    work_of_run(case, engine, settings) + probes * (settings.extrapolated + 1) as f64
}

/// The settings except the resolution, in words.
fn told(engine: &dyn Engine, settings: &Settings, case: &Case) -> String {
    let mut words = Vec::new();
    if engine.routes().len() > 1 && case.wanted.deepest() >= Stage::Reactions {
        words.push(settings.route.name().to_string());
    }
    if engine.sweeps(case).is_some() {
        words.push(format!("{} sweeps", settings.sweeps));
    }
    match settings.extrapolated {
        0 => {}
        1 => words.push("extrapolated once".into()),
        2 => words.push("extrapolated twice".into()),
        times => words.push(sentences::extrapolated_times(&times)),
    }
    words.join(", ")
}
