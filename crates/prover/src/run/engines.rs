//! One engine compared with the reference, at the given settings or at the settings found by the search.

use crate::sentences;
use std::sync::Arc;

use super::engine_proof::{EngineInfo, EngineProof, SearchEnd};
use super::judge::{Judge, Judged};
use super::ledger::Ledger;
use super::observe::{Stopped, Watch};
use super::options::Chosen;
use super::runs::{Bank, FEWER, other_sweeps, rungs};
use super::settle::{BUDGET, FIRST, Settling, too_much};
use super::{order, own_forces};
use crate::bounds::{Verdict, difference, overall};
use crate::engines::coarse_step;
use crate::numbers::error;
use linkage::case::Case;
use linkage::engine::{Engine, Settings};
use linkage::error::{Advice, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::solver::Progress;
use scenario::EngineSettings;

/// Runs an engine on `case` and judges it, at the given settings or at the settings found by the search.
pub(super) fn prove(
    judge: &Judge,
    case: &Case,
    chosen: &Chosen,
    ledger: &mut Ledger,
    progress: Progress,
) -> Result<EngineProof> {
    let (engine, asked) = (chosen.engine.as_ref(), judge.asked);
    let mut bank = Bank::new(case, engine, Watch::Engine);
    // If the given step is not positive and finite, no search begins: the engine itself refuses such a step.
    let is_step = asked.resolution > 0.0 && asked.resolution.is_finite();
    let given = chosen.given.clone().of_motion();
    let searches = given.leaves_a_choice() && !engine.controls_error() && is_step;
    let why =
        if searches { sentences::FINDS_ITS_SETTINGS_AND_ITS_ERROR } else { sentences::ITS_ERROR_FROM_ITS_OWN_RUNS };
    let found = ledger.done(engine.name(), why, || match searches {
        true => {
            let search = Settling::new(judge, &mut bank, engine, &given, chosen.budget);
            search.run(progress)
        }
        false => at_given(judge, &mut bank, engine, chosen.budget, progress),
    });
    let Judged { mut proof, run, .. } = match found {
        Ok(found) => found,
        Err(Stopped { error, kept, spent }) => {
            // If the allowed work was too small for finer steps, the engine may have failed only because the steps were
            // coarse. The verdict is then inconclusive, with the advice to allow more work.
            let (verdict, failure) = match spent {
                None => (Verdict::open(error.message()), Some(error)),
                Some(work) => {
                    let reason = match error.kind() {
                        ErrorKind::Unsupported => error.message().to_string(),
                        ErrorKind::Numeric | ErrorKind::Geometry | ErrorKind::Input | ErrorKind::Io => {
                            sentences::the_work_that_was_allowed_is_done(&error.message())
                        }
                    };
                    let most = 10f64.powf(work.log10().ceil());
                    let advice = vec![Advice::MoreWork { to: FIRST.larger(most) }];
                    (Verdict::Inconclusive { reason, advice }, None)
                }
            };
            let bare = EngineProof::bare(EngineInfo::of(engine), verdict);
            return Ok(EngineProof { trajectory: kept.map(|kept| *kept), failure, ..bare });
        }
    };
    let is_open = matches!(proof.verdict, Verdict::Inconclusive { .. });
    if is_open && !given.step.is_free() && !engine.controls_error() {
        let why = sentences::THE_GIVEN_STEP_PROVES_NOTHING;
        let advice = ledger.done(sentences::other_settings(&engine.name()), why, || tried(judge, &mut bank, chosen));
        for verdict in proof.verdicts_mut() {
            if let Verdict::Inconclusive { advice: own, .. } = verdict {
                own.push(advice.clone());
            }
        }
    }
    if let Some(search) = &proof.search {
        let (end, budget) = (search.end, search.budget);
        proof.verdicts_mut().for_each(|verdict| end.tell(verdict, budget));
    }
    // Releases the stored runs before new runs are made.
    drop(bank);
    let trajectory = Arc::unwrap_or_clone(run).trajectory;
    let part = sentences::own_forces(&engine.name());
    match own_forces::are_asked(judge, chosen) {
        true => {
            let own = || own_forces::judged(judge, case, chosen, &proof, &mut |part| progress(0.7 + 0.3 * part));
            let why = sentences::WHAT_IT_EXERTS_ITSELF_BESIDE;
            proof.own_forces = ledger.done(part, why, own).map(Box::new);
        }
        false => ledger.skipped(part, sentences::NO_FORCE_IS_WANTED_OR_ITS_FORCES),
    }
    if let Some(verdict) = proof.added() {
        proof.verdict = overall([&proof.verdict, verdict]);
    }
    proof.errors = Some(difference(&judge.reference.trajectory, &trajectory)?);
    proof.trajectory = Some(trajectory);
    Ok(proof)
}

/// A judged engine, or the reason why it stopped.
type Outcome = std::result::Result<Judged, Stopped>;

/// Judges the engine at its given settings, without a search.
/// The limit of the work is the larger of two budgets: the usual budget and the given budget.
fn at_given(judge: &Judge, bank: &mut Bank, engine: &dyn Engine, budget: f64, progress: Progress) -> Outcome {
    if !engine.controls_error() {
        let budget = budget.larger(BUDGET);
        too_much(bank, judge.asked, &rungs(judge.asked, &[]), [budget; 2])?;
    }
    let others = other_sweeps(bank.case, engine, judge.asked.sweeps, FEWER);
    let mut with = |others: &[usize]| -> Outcome {
        let runs = bank.runs(judge.asked, others, progress)?;
        Ok(judge.judge(engine, runs)?)
    };
    let judged = with(&others[..others.len().min(1)])?;
    // Two runs with different numbers of sweeps differ little if the sweeps have converged, but also if the sweeps have
    // hardly begun to converge. A third run distinguishes these cases.
    let mut judged = match judged.proof.against().is_empty() || others.len() < 2 {
        true => judged,
        false => match with(&others) {
            Err(stopped) if stopped.error.kind() == ErrorKind::Numeric => {
                let why = sentences::A_RUN_WITH_A_QUARTER_OF_THE_SWEEPS;
                let mut judged = judged;
                judged.proof.doubt(why, &Advice::MoreSweeps { to: None });
                judged
            }
            told => told?,
        },
    };
    if !engine.controls_error() {
        order::look(judge, bank, &mut judged.proof)?;
    }
    Ok(judged)
}

/// Advice for an inconclusive run at a given step. The advice comes from a run with free settings.
fn tried(judge: &Judge, bank: &mut Bank, chosen: &Chosen) -> Advice {
    let case = bank.case;
    let engine = chosen.engine.at(coarse_step(case));
    let judge = judge.asking(engine.settings());
    let free = EngineSettings::default();
    let found = Settling::new(&judge, bank, engine.as_ref(), &free, chosen.budget).run(&mut |_| {});
    let Ok(Judged { proof, .. }) = found else { return Advice::FreeSettings };
    let Settings { resolution, sweeps, extrapolated, .. } = proof.info.settings;
    let outcome = match (&proof.verdict, proof.search.map(|search| search.end)) {
        (Verdict::Inconclusive { .. }, Some(SearchEnd::Budget | SearchEnd::Pace)) => {
            sentences::THE_WORK_ALLOWED_IS_NOT_ENOUGH.into()
        }
        (Verdict::Inconclusive { .. }, _) => sentences::NOTHING_IS_PROVEN_THERE_EITHER.into(),
        (verdict, _) => sentences::the_verdict_there_is(&verdict.word()),
    };
    let combined = match extrapolated {
        0 => "not extrapolated".into(),
        1 => "extrapolated once".into(),
        times => sentences::extrapolated_times(&times),
    };
    Advice::Text(sentences::leave_the_step_to_the_proof(&error(resolution), &sweeps, &combined, &outcome))
}
