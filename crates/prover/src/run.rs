//! The proof: a scenario solved by both analytic sides and by engines, compared, checked, and judged.

pub mod beside;
mod checks;
mod dependence;
mod dial;
mod doubt;
mod each_side;
mod engine_proof;
mod engines;
mod entrants;
mod examined;
mod figures;
mod formulas;
mod judge;
mod known;
mod ledger;
pub mod memory;
mod methods;
mod need;
mod observe;
mod options;
mod oracle;
mod order;
mod own_forces;
mod parties;
#[cfg(test)]
mod planted;
#[cfg(test)]
mod planted_forces;
mod problem;
mod reported;
mod reported_figure;
mod runs;
mod sensitivity;
mod settle;
pub mod shifted;
pub mod solved;

use crate::sentences;
pub use each_side::{EachSide, Reference};
pub use engine_proof::{ChannelProof, EngineInfo, EngineProof, ForceFault, SearchEnd, SettingsSearch};
pub use entrants::{EngineRole, Entrant, ObservedSides, TRUE_SIDES};
pub use formulas::{Judgement, checks as formula_checks};
pub use ledger::{Ledger, LedgerEntry};
pub use options::Options;
pub use parties::Dispute;
pub use problem::Problem;
pub use reported_figure::ReportedFigure;
pub use settle::BUDGET;

use crate::bounds::{Check, Verdict, overall};
use crate::check::JudgedFormula;
use crate::diagnosis::Diagnosis;
use analytic::range::explained;
use linkage::case::{Case, Scene};
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::solver::Progress;
use linkage::trajectory::Trajectory;
use linkage::work::limited;
use scenario::{CaseFigure, Formulas, Scenario};

/// Work that the analytic sides may always do, even if it exceeds the budget, because there is no result without the
/// analytic sides. This work takes a second or two.
pub const SIDES: f64 = 1e6;
/// A diagnosis may use at most this multiple of the proof's budget.
/// With half of this limit, the diagnosis of a free motion with two degrees of freedom could not confirm its finding.
const DIAGNOSIS: f64 = 1.0;

/// All results of one proof.
///
/// ```
/// use linkproof::{Options, Scenario, prove};
///
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// let scenario = Scenario::load("scenarios/pendulum.toml")?;
/// let proof = prove(&scenario, &Options::default())?;
/// println!("{}: {} by {}", proof.scenario, proof.verdict.word(), proof.engine().info.version);
/// for channel in &proof.engine().channels {
///     println!("{}: {:e} of {:e}", channel.residual.channel, channel.residual.max, channel.bound);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
    /// Checks on the analytic sides, including the comparisons with published numbers.
    pub checks: Vec<Check>,
    /// The engines, in the requested order. The list is empty only for an [unjudged](Proof::unjudged) motion.
    pub engines: Vec<EngineProof>,
    /// Channels in which the reference and the engines do not all agree.
    /// The list is empty if there is only one engine, because the verdicts on its channels then show the disagreement.
    pub disputes: Vec<Dispute>,
    /// Diagnosis if a channel disagrees: which party contradicts the others, since when, and why.
    pub diagnosis: Option<Diagnosis>,
    /// Whether the search for the diagnosis reached its work limit before it had tried all causes.
    pub diagnosis_is_cut: bool,
    /// Verdict of the whole proof.
    pub verdict: Verdict,
    /// The reference's trajectory.
    pub reference_trajectory: Trajectory,
    /// Bound on the error of each reference channel over the whole run, in the channel's unit. The list is empty for an
    /// unjudged motion.
    pub reference_bounds: Vec<f64>,
    /// The part of the scenario's case that was solved, and the parts on which no requested channel depends.
    pub scene: Scene,
    /// The formulas of the scenario, with their claims.
    pub formulas: Formulas,
    /// Judgement of the formulas; `None` if no formula claims a requested channel.
    pub judgement: Option<Judgement>,
    /// Figures that the file requests for reports.
    pub asked: Vec<CaseFigure>,
    /// The work done, part by part, and the work that was not needed.
    pub work: Vec<LedgerEntry>,
}

impl Proof {
    /// The first engine. Recordings and short reports use this engine.
    #[must_use]
    pub fn engine(&self) -> &EngineProof {
        &self.engines[0]
    }

    /// The motion as side 1 computes it, without checks and engines.
    /// The verdict is inconclusive, because no residual is known.
    ///
    /// # Errors
    /// The errors of [`solve`].
    pub fn unjudged(scenario: &Scenario) -> Result<Proof> {
        let scene = scenario.case.scene()?;
        let side = Reference::Assur;
        let solved = side.solver().solve(&scene.case).map_err(|error| explained(&scene.case, error))?;
        Ok(Proof {
            scenario: scenario.name.clone(),
            title: scenario.title.clone(),
            formula: scene.case.structure.formula(&scene.case.mechanism),
            reference: side.name(),
            checks: Vec::new(),
            engines: Vec::new(),
            disputes: Vec::new(),
            diagnosis: None,
            diagnosis_is_cut: false,
            verdict: Verdict::Inconclusive { reason: sentences::NOTHING_IS_COMPARED_YET.into(), advice: Vec::new() },
            reference_trajectory: solved,
            reference_bounds: Vec::new(),
            scene,
            formulas: scenario.formulas.clone(),
            judgement: None,
            asked: scenario.figures.clone(),
            work: Vec::new(),
        })
    }

    /// The judged formulas, each with its check, in the order of the checks.
    pub fn formula_checks(&self) -> impl Iterator<Item = (&JudgedFormula, &Check)> {
        let sides = self.judgement.iter().flat_map(|own| own.sides.iter());
        let judged = sides.flat_map(|(_, all)| all.iter().flatten());
        judged.zip(self.checks.iter().filter(|check| formulas::is_of_formula(check)))
    }

    /// Checks on the analytic sides and on all engines.
    pub fn all_checks(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().chain(self.engines.iter().flat_map(|engine| &engine.checks))
    }
}

/// Solves a scenario with both analytic sides and engines, each engine at three resolutions, and judges the results.
///
/// ```
/// use linkproof::{Options, Scenario, Verdict, prove};
///
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// let scenario = Scenario::load("scenarios/crank_rocker.toml")?;
/// let proof = prove(&scenario, &Options::default())?;
/// assert!(matches!(proof.verdict, Verdict::Agree { .. }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If an analytic side cannot solve the case. The error states the crank angle.
/// If this build does not have a requested engine, or if an engine does not have a given setting.
/// If the only engine cannot start.
/// If the run would need more memory than is allowed.
///
/// If an engine fails after its start, or if one of several engines fails, the engine stays part of the proof with its
/// trajectory up to the failure.
pub fn prove(scenario: &Scenario, options: &Options) -> Result<Proof> {
    prove_with(scenario, options, &mut |_| {})
}

/// Does the same as [`prove`], and calls `progress` with the finished fraction of the work, from 0 to 1.
///
/// # Errors
/// The errors of [`prove`].
pub fn prove_with(scenario: &Scenario, options: &Options, progress: Progress) -> Result<Proof> {
    joined(scenario, &scenario.case, options, progress).map_err(|error| explained(&scenario.case, error))
}

/// Does the same as [`prove`], but the engines solve `engine_case` at the scenario's instants. Tests plant a fault in
/// `engine_case` to show that a proof finds the fault.
///
/// # Errors
/// The errors of [`prove`].
pub fn prove_against(scenario: &Scenario, engine_case: &Case, options: &Options) -> Result<Proof> {
    joined(scenario, engine_case, options, &mut |_| {}).map_err(|error| explained(&scenario.case, error))
}

/// Solves a case with side 1: computes all requested channels on the case's grid. The channels of a prescribed motion
/// are accurate to rounding, the channels of a free motion to the integration error.
///
/// ```
/// use linkproof::{Scenario, solve};
///
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// let scenario = Scenario::load("scenarios/crank_rocker.toml")?;
/// let solution = solve(&scenario.case)?;
/// let moment = solution.named("drive.torque_N_m").expect("every mechanism with a drive has it");
/// assert_eq!(moment.len(), solution.times().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
/// # Errors
/// If the mechanism cannot stay on its branch. The error states the reason, the crank angle and the reachable interval.
pub fn solve(case: &Case) -> Result<Trajectory> {
    let case = &case.scene()?.case;
    Reference::Assur.solver().solve(case).map_err(|error| explained(case, error))
}

/// Does the same as `prove_with`, but with a separate case for the engines. Errors of the solvers are returned
/// unchanged.
fn joined(scenario: &Scenario, engine_case: &Case, options: &Options, progress: Progress) -> Result<Proof> {
    let scene = scenario.case.scene()?;
    let (whole, case) = (&scenario.case, &scene.case);
    let problem = Problem::of(scenario, case);
    let main = options.reference.solver();
    let engines = options.chosen(&scenario.engine, case)?;
    memory::check(case, memory::of_proof(case, engines.len()), options.memory)?;
    memory::check_input(sentences::WHAT_ORACLE_SAYS, memory::of_oracles(&scenario.oracles), options.memory)?;
    let mut ledger = Ledger::default();
    let budget = options.budget.unwrap_or(settle::BUDGET);
    let (sides, _) =
        limited(budget.larger(SIDES), || ObservedSides::of(problem, whole, TRUE_SIDES, options.reference, &mut ledger));
    let sides = sides?;
    let engine_case = match &whole.only {
        Some(only) => engine_case.wanting_only(only).scene()?.case,
        None => engine_case.clone(),
    };
    let proofs = sides.engines(problem, &EngineRole::on(&engine_case), engines, &mut ledger, progress)?;
    let own = sides.own();
    let disputes = match proofs.len() {
        1 => Vec::new(),
        _ => parties::disputes(main.name(), &own.trajectory, &proofs),
    };
    let analytic = sides.verdict();
    let verdict = overall([&analytic].into_iter().chain(proofs.iter().map(|proof| &proof.verdict)));
    let (diagnosis, diagnosis_is_cut) = match verdict {
        Verdict::Disagree { .. } => {
            let examined = || examined::of(case, options.reference, &sides.observed, &sides.known, &proofs);
            let (found, is_cut) =
                limited(DIAGNOSIS * budget, || ledger.done("diagnosis", "something disagrees", examined));
            if is_cut {
                ledger.skipped(sentences::REST_OF_THE_DIAGNOSIS, sentences::ITS_SHARE_OF_THE_WORK_THAT_WAS_ALLOWED);
            }
            (found, is_cut)
        }
        Verdict::Agree { .. } | Verdict::Expected { .. } | Verdict::Inconclusive { .. } => {
            ledger.skipped("diagnosis", "nothing disagrees");
            (None, false)
        }
    };
    Ok(Proof {
        scenario: scenario.name.clone(),
        title: scenario.title.clone(),
        formula: case.structure.formula(&case.mechanism),
        reference: main.name(),
        diagnosis,
        diagnosis_is_cut,
        reference_trajectory: own.trajectory.clone(),
        reference_bounds: sides.bounds(),
        checks: sides.checks,
        formulas: scenario.formulas.clone(),
        judgement: sides.judgement,
        asked: scenario.figures.clone(),
        engines: proofs,
        disputes,
        verdict,
        scene,
        work: ledger.0,
    })
}
