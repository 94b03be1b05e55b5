//! The join: a scenario solved by both analytic sides and by engines, compared, checked, and judged.

mod checks;
mod dial;
mod engines;
mod methods;
mod observe;
mod options;
mod oracle;
mod parties;
#[cfg(test)]
mod planted;
mod sensitivity;

pub use engines::{ChannelProof, EngineInfo, EngineProof};
pub use options::Options;
pub use parties::Dispute;

use crate::compare::{Check, Verdict, overall};
use crate::scenario::Scenario;
use analytic::range::explained;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use observe::observe;

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
    /// Checks on the analytic sides, published numbers among them.
    pub checks: Vec<Check>,
    /// The engines, in the order asked for.
    pub engines: Vec<EngineProof>,
    /// Channels in which reference and engines do not all agree; empty with a single engine, whose own verdicts say it.
    pub disputes: Vec<Dispute>,
    /// Verdict on the whole.
    pub verdict: Verdict,
    /// The reference's trajectory.
    pub reference_trajectory: Trajectory,
}

impl Proof {
    /// The first engine, which recordings and short reports are about.
    #[must_use]
    pub fn engine(&self) -> &EngineProof {
        &self.engines[0]
    }

    /// Checks on the analytic sides and on all engines.
    pub fn all_checks(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().chain(self.engines.iter().flat_map(|engine| &engine.checks))
    }
}

/// Solves a scenario with both analytic sides and engines, each at three resolutions, and judges what comes out.
/// `progress` is told how far the work is, from 0 to 1.
///
/// # Errors
/// If an analytic side cannot solve the case, with the crank angle; if a solver is not known; if the only engine cannot even begin. An engine that
/// fails later, or beside others, is part of the proof, with what it had computed until then.
pub fn prove(scenario: &Scenario, options: &Options, progress: &mut dyn FnMut(f64)) -> Result<Proof> {
    prove_against(scenario, &scenario.case, options, progress)
}

/// As [`prove`], with engines that are given a case of their own, on the scenario's instants. With a fault planted in it, what a proof
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
    joined(scenario, engine_case, options, progress).map_err(|error| explained(&scenario.case, error))
}

/// The same with the errors of solvers as they come.
fn joined(scenario: &Scenario, engine_case: &Case, options: &Options, progress: &mut dyn FnMut(f64)) -> Result<Proof> {
    let case = &scenario.case;
    let main = options.reference()?;
    let engines = options.engines(scenario)?;
    let observed = |solver: &dyn Solver| -> Result<_> { Ok((solver.name(), observe(case, solver, &mut |_| {})?)) };
    let [first, second] = analytic::all();
    let sides = [observed(first)?, observed(second)?];
    let own = &sides.iter().find(|(name, _)| *name == main.name()).expect("the reference is one of the sides").1;
    let mut checks = checks::of_sides(case, &sides);
    checks.extend(methods::checks(case, main)?);
    checks.extend(oracle::checks(scenario)?);

    let sensitivity = sensitivity::of(case, main, &own.trajectory)?;
    let engine_case = engine_case.on(case.grid.clone())?;
    let mut proofs = Vec::with_capacity(engines.len());
    for (index, engine) in engines.iter().enumerate() {
        let mut part = |part: f64| progress((index as f64 + part) / engines.len() as f64);
        let mut proof = engines::prove(scenario, &engine_case, engine.as_ref(), &own.trajectory, &mut part)?;
        engines::tell_sensitivity(&mut proof, &own.trajectory, &sensitivity);
        proofs.push(proof);
    }
    if let [EngineProof { failure: Some(error), trajectory: None, .. }] = proofs.as_slice() {
        return Err(error.clone());
    }
    let disputes = match proofs.len() {
        1 => Vec::new(),
        _ => parties::disputes(main.name(), &own.trajectory, &proofs),
    };
    let analytic = overall(checks.iter().map(|check| &check.verdict));
    let verdict = overall([&analytic].into_iter().chain(proofs.iter().map(|proof| &proof.verdict)));
    Ok(Proof {
        scenario: scenario.name.clone(),
        title: scenario.title.clone(),
        formula: case.structure.formula(&case.mechanism),
        reference: main.name(),
        checks,
        engines: proofs,
        disputes,
        verdict,
        reference_trajectory: own.trajectory.clone(),
    })
}

fn unknown<'a>(what: &str, asked: &str, known: impl Iterator<Item = &'a str>) -> Error {
    let known: Vec<&str> = known.collect();
    Error::new(ErrorKind::Input, format!("there is no {what} called \"{asked}\""))
        .help(format!("choose one of: {}", known.join(", ")))
}
