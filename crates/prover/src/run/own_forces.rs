//! Judges the forces that an engine itself exerts: its own forces.
//! These forces are judged in addition to the forces that follow from the engine's motion by Newton-Euler equations.
//! The search for the settings of the engine's own forces begins after the search for the settings of the motion. There
//! is one search for each method by which the engine reports its forces (`Engine::own_routes`), until one result is
//! conclusive.
//! See docs/numerics/forces.md.

use crate::sentences;
use std::sync::Arc;

use super::engine_proof::{EngineInfo, EngineProof};
use super::judge::{Judge, Judged};
use super::observe::{Stopped, Watch};
use super::options::Chosen;
use super::runs::Bank;
use super::settle::Settling;
use crate::bounds::Verdict;
use crate::engines::coarse_step;
use crate::numbers::error;
use linkage::case::Case;
use linkage::engine::{Engine, Route, Settings};
use linkage::error::{Advice, Error, ErrorKind};
use linkage::solver::Progress;
use linkage::trajectory::Stage;
use scenario::EngineSetting;

/// Limit of the number of sweeps at the start of the search, even if the motion has needed more sweeps.
const ENOUGH: usize = 32;
/// Additional work allowed for the engine's own forces, as a fraction of the work allowed for the search of settings.
const SHARE: f64 = 0.05;

/// Whether the engine's own forces are judged.
/// The forces are not judged if no force is requested or if the route is given.
/// If the engine's default route already gives the engine's own forces, [`judged`] finds no further route for these
/// forces.
pub(super) fn are_asked(judge: &Judge, chosen: &Chosen) -> bool {
    chosen.given.route.is_free() && judge.asking(judge.asked).of_own_forces().has_channels()
}

/// Judges the forces that the engine exerts, in addition to its `motion`. [`are_asked`] must be true for these forces.
/// `None` if the engine has no route for these forces. The first conclusive route counts.
pub(super) fn judged(
    judge: &Judge,
    case: &Case,
    chosen: &Chosen,
    motion: &EngineProof,
    progress: Progress,
) -> Option<EngineProof> {
    let effort = motion.search.as_ref().map_or(0.0, |search| search.effort);
    // The engine's own forces are not judged if the motion has needed more work than is allowed for these forces.
    // Impulses converge with a lower order than the motion, so their runs need at least as much work as the runs for
    // the motion.
    if effort > SHARE * chosen.budget {
        let told = sentences::the_motion_has_taken_the_work(&error(effort), &error(SHARE * chosen.budget));
        let failure = Error::new(ErrorKind::Unsupported, told);
        return Some(failed(chosen.engine.as_ref(), failure, Some(effort)));
    }
    // Only forces are requested, because the other channels of these runs are not needed.
    let mut forces = case.channels();
    forces.retain(|channel| channel.kind.stage >= Stage::Reactions);
    let case = &case.wanting_only(&forces);
    let sweeps = motion.info.settings.sweeps.min(ENOUGH);
    let mut found: Option<EngineProof> = None;
    for &route in chosen.engine.own_routes(case) {
        let own = by_route(judge, case, chosen, route, sweeps, progress);
        let is_open = matches!(own.verdict, Verdict::Inconclusive { .. });
        // Of several inconclusive results, a result with numbers is preferred to a failure.
        let better = found.as_ref().is_none_or(|found| !is_open || found.failure.is_some());
        if better {
            found = Some(own);
        }
        if !is_open {
            break;
        }
    }
    found
}

/// A result without comparison.
/// `work` is given only if the failure is due to too little allowed work. It is the work done, or the work that the
/// first runs need. The advice then names a sufficient amount of work.
fn failed(engine: &dyn Engine, failure: Error, work: Option<f64>) -> EngineProof {
    // The advised work is rounded up to a power of ten, so that it is enough for the next attempt.
    let advice = work.map(|work| Advice::MoreWork { to: 10f64.powf((work / SHARE).log10().ceil()) });
    let reason = failure.message().to_string();
    let verdict = Verdict::Inconclusive { reason, advice: advice.into_iter().collect() };
    EngineProof { failure: Some(failure), ..EngineProof::bare(EngineInfo::of(engine), verdict) }
}

fn by_route(
    judge: &Judge,
    case: &Case,
    chosen: &Chosen,
    route: Route,
    sweeps: usize,
    progress: Progress,
) -> EngineProof {
    let given = chosen.engine.settings();
    // If the step and the number of extrapolations are given, the step is kept: both settings belong together.
    let (step, finest) = match (chosen.given.step.is_free(), chosen.given.extrapolated.is_free()) {
        (true, _) => (coarse_step(case), 0.0),
        (false, true) => (coarser(given.resolution, coarse_step(case)), 0.5 * given.resolution),
        (false, false) => (given.resolution, 0.0),
    };
    let mut asked = chosen.given.clone();
    let extrapolated = match asked.extrapolated.is_free() {
        true => {
            asked.step = EngineSetting::Free;
            0
        }
        false => given.extrapolated,
    };
    let engine = chosen.engine.with(Settings { resolution: step, route, extrapolated, ..given });
    let judge = judge.asking(engine.settings()).of_own_forces();
    let mut bank = Bank::new(case, engine.as_ref(), Watch::Senses);
    let search =
        Settling::new(&judge, &mut bank, engine.as_ref(), &asked, SHARE * chosen.budget).conclusive(finest, sweeps);
    match search.run(progress) {
        Ok(Judged { mut proof, run, .. }) => {
            drop(bank);
            if let Some(end) = proof.search.as_ref().map(|search| search.end) {
                proof.verdicts_mut().for_each(|verdict| end.tell(verdict, chosen.budget));
            }
            EngineProof { trajectory: Some(Arc::unwrap_or_clone(run).trajectory), ..proof }
        }
        Err(Stopped { error, spent, .. }) => failed(engine.as_ref(), error, spent),
    }
}

/// Returns the largest of the steps `step`, 2 `step`, 4 `step`, ... that does not exceed `most`. Returns `step` if even
/// `step` exceeds `most`.
fn coarser(step: f64, most: f64) -> f64 {
    let times = (most / step).log2().floor();
    if times > 0.0 { step * 2f64.powf(times) } else { step }
}
