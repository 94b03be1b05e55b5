//! The join: a scenario solved by both sides, compared, checked, and judged.

mod checks;
mod methods;
mod observe;
mod oracle;

use crate::case::Case;
use crate::compare::{Check, Convergence, Residual, Verdict, difference, overall, residuals};
use crate::engine::{self, Engine};
use crate::error::{Error, ErrorKind, Result};
use crate::reference;
use crate::scenario::Scenario;
use crate::solver::{Provision, Solver};
use crate::tolerance::Basis;
use crate::trajectory::{Channel, Stage, Trajectory};
use observe::{Observed, observe};

/// What to prove a scenario with.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Analytic solver whose trajectory is the reference; the other one checks it.
    pub reference: String,
    /// Engine.
    pub engine: String,
    /// Time step of the engine (s); the scenario's if none is given.
    pub step: Option<f64>,
}

impl Default for Options {
    fn default() -> Self {
        Options { reference: "assur".into(), engine: "rapier".into(), step: None }
    }
}

/// What is known of the engine that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineInfo {
    /// Name, as on the command line.
    pub name: &'static str,
    /// Software and version behind it.
    pub version: String,
    /// Time step (s).
    pub step: f64,
    /// Settings that influence the result.
    pub settings: Vec<(&'static str, String)>,
    /// How it comes by each sort of channel: stage and provision.
    pub provides: Vec<(&'static str, Provision)>,
}

/// Comparison of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelProof {
    /// Residual of the engine against the reference.
    pub residual: Residual,
    /// Bound, in the channel's unit.
    pub bound: f64,
    /// Convergence of the engine in this channel.
    pub convergence: Convergence,
    /// What the bound rests on.
    pub basis: Basis,
    /// The outcome.
    pub verdict: Verdict,
}

/// Everything that one proof found out.
#[derive(Clone, Debug)]
pub struct Proof {
    /// Name of the scenario.
    pub scenario: String,
    /// Title of the scenario.
    pub title: String,
    /// Formula of structure.
    pub formula: String,
    /// Name of the reference solver.
    pub reference: &'static str,
    /// The engine.
    pub engine: EngineInfo,
    /// Channels, in the order of columns.
    pub channels: Vec<ChannelProof>,
    /// Checks besides the comparison.
    pub checks: Vec<Check>,
    /// Verdict on the whole.
    pub verdict: Verdict,
    /// The reference's trajectory.
    pub reference_trajectory: Trajectory,
    /// The engine's trajectory.
    pub engine_trajectory: Trajectory,
    /// Engine minus reference.
    pub errors: Trajectory,
}

/// Solves a scenario with both analytic sides and an engine at three step sizes, and judges what comes out.
/// `progress` is told how far the work is, from 0 to 1.
///
/// # Errors
/// If a solver cannot solve the case, with the crank angle; if a solver is not known.
pub fn prove(scenario: &Scenario, options: &Options, progress: &mut dyn FnMut(f64)) -> Result<Proof> {
    prove_against(scenario, &scenario.case, options, progress)
}

/// As [`prove`], with an engine that is given a case of its own, on the scenario's instants. With a fault planted in it, what a proof
/// can find is seen.
///
/// # Errors
/// Those of [`prove`].
pub fn prove_against(
    scenario: &Scenario,
    engine_case: &Case,
    options: &Options,
    progress: &mut dyn FnMut(f64),
) -> Result<Proof> {
    let case = &scenario.case;
    let step = options.step.unwrap_or(scenario.dt);
    let main = reference::named(&options.reference).ok_or_else(|| {
        unknown("analytic solver", &options.reference, reference::all().iter().map(|solver| solver.name()))
    })?;
    let engine = engine::named(&options.engine, step).ok_or_else(|| {
        let known = engine::all(step);
        unknown("engine", &options.engine, known.iter().map(|engine| engine.name()))
    })?;
    let observed = |solver: &dyn Solver| -> Result<_> { Ok((solver.name(), observe(case, solver, &mut |_| {})?)) };
    let [first, second] = reference::all();
    let sides = [observed(first)?, observed(second)?];
    let runs = run_ladder(&engine_case.on(case.grid.clone()), engine.as_ref(), progress)?;
    let own = &sides.iter().find(|(name, _)| *name == main.name()).expect("the reference is one of the sides").1;

    let channels = judge(scenario, engine.as_ref(), &own.trajectory, &runs)?;
    let mut checks = checks::of_sides(case, &sides);
    checks.extend(methods::checks(case, main)?);
    checks.extend(checks::of_engine(scenario, engine.as_ref(), &runs));
    checks.extend(oracle::checks(scenario)?);
    let verdict = overall(channels.iter().map(|c| &c.verdict).chain(checks.iter().map(|c| &c.verdict)));
    let errors = difference(&own.trajectory, &runs[1].trajectory)?;
    let [_, single, _] = runs;
    Ok(Proof {
        scenario: scenario.name.clone(),
        title: scenario.title.clone(),
        formula: case.structure.formula(&case.mechanism),
        reference: main.name(),
        engine: describe(engine.as_ref()),
        channels,
        checks,
        verdict,
        reference_trajectory: own.trajectory.clone(),
        engine_trajectory: single.trajectory,
        errors,
    })
}

/// The engine at double, single and half step.
fn run_ladder(case: &Case, engine: &dyn Engine, progress: &mut dyn FnMut(f64)) -> Result<[Observed; 3]> {
    // The single step first: if it fails, its own message is the one that helps.
    let mut run = |factor: f64, from: f64, to: f64| {
        let run = engine.at(engine.settings().resolution * factor);
        let observed = observe(case, run.as_ref(), &mut |part| progress(from + (to - from) * part));
        observed.map_err(|error| {
            if factor == 1.0 {
                error
            } else {
                in_ladder(&error, run.settings().resolution, engine.settings().resolution)
            }
        })
    };
    let single = run(1.0, 0.0, 2.0 / 7.0)?;
    let half = run(0.5, 2.0 / 7.0, 6.0 / 7.0)?;
    let double = run(2.0, 6.0 / 7.0, 1.0)?;
    Ok([double, single, half])
}

/// The same error, told as that of a run which nobody asked for.
fn in_ladder(error: &Error, step: f64, asked: f64) -> Error {
    let message = format!(
        "the run at {step:e} s, from which the error of the run at {asked:e} s is estimated, failed: {}",
        error.message()
    );
    let told = Error::new(error.kind(), message);
    match error.way_out() {
        Some(help) => told.help(help),
        None => told,
    }
}

fn judge(
    scenario: &Scenario,
    engine: &dyn Engine,
    reference: &Trajectory,
    runs: &[Observed; 3],
) -> Result<Vec<ChannelProof>> {
    let ladder = [0, 1, 2].map(|k| &runs[k].trajectory);
    let case = &scenario.case;
    let finest = engine.at(engine.settings().resolution / 2.0);
    let judged = residuals(reference, ladder[1])?.into_iter().map(|residual| {
        let kind = residual.channel.kind;
        let convergence =
            Convergence::of_channel(ladder, &residual.channel, engine.formal_order(kind), finest.noise(case, kind))
                .expect("all runs of an engine have the same channels");
        let tolerance = convergence.tolerance(engine.settings().resolution, engine.noise(case, kind));
        let bound = tolerance.bound(residual.scale);
        let mut verdict = Verdict::of_engine(&residual, &convergence, bound, scenario.engine_rel);
        if let (Verdict::Disagree { place }, true) = (&verdict, kind.stage >= Stage::Reactions)
            && let Some(link) = turning_about(case, [reference, ladder[1]], residual.worst_time)
        {
            verdict = Verdict::Inconclusive {
                reason: format!(
                    "{place}, but there link \"{link}\" turns about and its load jumps: leave that instant out of the grid"
                ),
            };
        }
        ChannelProof { residual, bound, convergence, basis: tolerance.basis, verdict }
    });
    Ok(judged.collect())
}

/// The link whose load turns about at an instant: it turns one way on one side and the other way on the other. The load's
/// moment jumps there, so that the smallest error of the engine makes a difference of twice the moment.
fn turning_about<'a>(case: &'a Case, sides: [&Trajectory; 2], time: f64) -> Option<&'a str> {
    let row = sides[0].times().iter().position(|&t| t == time)?;
    let speed =
        |side: &Trajectory, name: &str| Some(side.column(&Channel::named(&format!("link.{name}.omega_rad_s"))?)?[row]);
    let names = case.loads.iter().map(|load| case.mechanism.links()[load.link()].name.as_str());
    let mut turning = names.filter(|name| match (speed(sides[0], name), speed(sides[1], name)) {
        (Some(ours), Some(theirs)) => ours * theirs <= 0.0,
        _ => false,
    });
    turning.next()
}

fn describe(engine: &dyn Engine) -> EngineInfo {
    let provides = Stage::ALL.map(|stage| {
        let kind =
            crate::trajectory::CHANNELS.iter().find(|kind| kind.stage == stage).expect("every stage has a channel");
        (stage.name(), engine.provides(&Channel { of: String::new(), kind }))
    });
    EngineInfo {
        name: engine.name(),
        version: engine.version(),
        step: engine.settings().resolution,
        settings: engine.told(),
        provides: provides.into(),
    }
}

fn unknown<'a>(what: &str, asked: &str, known: impl Iterator<Item = &'a str>) -> Error {
    let known: Vec<&str> = known.collect();
    Error::new(ErrorKind::Input, format!("there is no {what} called \"{asked}\""))
        .help(format!("choose one of: {}", known.join(", ")))
}
