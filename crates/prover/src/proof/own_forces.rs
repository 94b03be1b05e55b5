//! Forces as an engine itself exerts them, judged besides those that follow from its motion by Newton and Euler.
//!
//! A search of its own, by the engine's own routes. It ends as soon as every force is conclusive; coarse runs,
//! extrapolated, usually are. With a given step no run is finer than those that estimate the error of that step:
//! coarser ones are extrapolated.

use std::sync::Arc;

use super::judge::{ChannelProof, EngineInfo, Judge, Judged, describe};
use super::observe::{Stopped, Watch};
use super::options::Chosen;
use super::runs::Bank;
use super::settle::{Search, Settling};
use crate::compare::Verdict;
use crate::engines::coarse_step;
use crate::numbers::error;
use linkage::case::Case;
use linkage::engine::{Engine, Route, Settings};
use linkage::error::{Advice, Error, ErrorKind};
use linkage::trajectory::{Stage, Trajectory};
use scenario::Setting;

/// Sweeps to begin with at the most, if the motion has needed as many.
const ENOUGH: usize = 32;
/// Share of the work allowed for an engine's settings that its own forces may take once more.
const SHARE: f64 = 0.05;

/// Reactions and balancing moment as an engine itself exerts them.
#[derive(Clone, Debug)]
pub struct OwnForces {
    /// The engine, with the route and the settings by which it is asked.
    pub info: EngineInfo,
    /// How the settings were found; `None` if the engine failed.
    pub search: Option<Search>,
    /// Channels of forces, in the order of columns; none if the engine failed.
    pub channels: Vec<ChannelProof>,
    /// Verdict on them together.
    pub verdict: Verdict,
    /// The engine's trajectory by this route, forces only; `None` if it failed.
    pub trajectory: Option<Trajectory>,
    /// Why there is no comparison.
    pub failure: Option<Error>,
}

impl OwnForces {
    /// Whether there is anything to judge: not where no force is wanted, where the route is given, and for an engine
    /// whose usual route is its own.
    pub(super) fn are_asked(judge: &Judge, chosen: &Chosen) -> bool {
        chosen.given.route.is_free() && judge.asking(judge.asked).of_own_forces().has_channels()
    }

    /// Judges the forces that the engine exerts, whose motion has needed `sweeps` and this work; `None` if they are not
    /// [asked](OwnForces::are_asked). The first route that is conclusive counts.
    pub(super) fn judged(
        judge: &Judge,
        case: &Case,
        chosen: &Chosen,
        (sweeps, effort): (usize, f64),
        progress: &mut dyn FnMut(f64),
    ) -> Option<OwnForces> {
        if !chosen.given.route.is_free() {
            return None;
        }
        // Impulses are of a lower order than the motion, and need as many sweeps with the true masses.
        if effort > SHARE * chosen.budget {
            let told = format!(
                "the motion has taken the work of {} steps, and the forces that the engine exerts need no less; {} are \
                 allowed for them",
                error(effort),
                error(SHARE * chosen.budget)
            );
            let failure = Error::new(ErrorKind::Unsupported, told);
            return Some(OwnForces::failed(chosen.engine.as_ref(), failure, Some(effort)));
        }
        // Nothing else of these runs is looked at.
        let mut forces = case.channels();
        forces.retain(|channel| channel.kind.stage >= Stage::Reactions);
        let case = &case.wanting_only(&forces);
        let mut found: Option<OwnForces> = None;
        for &route in chosen.engine.own_routes(case) {
            let own = by_route(judge, case, chosen, (route, sweeps.min(ENOUGH)), progress);
            let is_open = matches!(own.verdict, Verdict::Inconclusive { .. });
            // Of several open results, one with numbers tells more.
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
}

/// Which of the two judgements of an engine's forces is against them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceFault {
    /// Those that follow from its motion, which agrees: the fault is in the equations that make forces of it.
    Reading,
    /// Those that the engine itself exerts: its motion is right, and so are the forces that belong to it.
    Exerted,
    /// Both.
    Both,
}

impl OwnForces {
    /// No comparison. Where nothing but work was missing, `work` that was not enough says how much would be.
    fn failed(engine: &dyn Engine, failure: Error, work: Option<f64>) -> OwnForces {
        // A round number that is surely enough for the next round.
        let advice = work.map(|work| Advice::MoreWork { to: 10f64.powf((work / SHARE).log10().ceil()) });
        let reason = failure.message().to_string();
        OwnForces {
            info: describe(engine),
            search: None,
            channels: Vec::new(),
            verdict: Verdict::Inconclusive { reason, advice: advice.into_iter().collect() },
            trajectory: None,
            failure: Some(failure),
        }
    }

    /// What they add to the engine's verdict. Where they stay open, they are told and take nothing back: the motion and
    /// its forces are judged all the same, and impulses are of a lower order and need the true masses, with many
    /// sweeps.
    pub fn adds(&self) -> Option<&Verdict> {
        Some(&self.verdict).filter(|verdict| !matches!(verdict, Verdict::Inconclusive { .. }))
    }

    /// Which of the two judgements of the forces disagrees, `channels` being the first one; `None` if neither does, or
    /// if the other one is open or the motion itself disagrees, so that nothing follows.
    pub(super) fn fault(&self, channels: &[ChannelProof]) -> Option<ForceFault> {
        let disagrees = |channel: &ChannelProof| matches!(channel.verdict, Verdict::Disagree { .. });
        let agrees = |channel: &ChannelProof| matches!(channel.verdict, Verdict::Agree { .. });
        let is_force = |channel: &&ChannelProof| channel.residual.channel.kind.stage >= Stage::Reactions;
        let (forces, motion): (Vec<&ChannelProof>, Vec<&ChannelProof>) = channels.iter().partition(is_force);
        if motion.into_iter().any(disagrees) {
            return None;
        }
        match [forces.iter().copied().any(disagrees), self.channels.iter().any(disagrees)] {
            [true, true] => Some(ForceFault::Both),
            [true, false] if self.channels.iter().all(agrees) => Some(ForceFault::Reading),
            [false, true] if forces.into_iter().all(agrees) => Some(ForceFault::Exerted),
            [_, _] => None,
        }
    }
}

fn by_route(
    judge: &Judge,
    case: &Case,
    chosen: &Chosen,
    (route, sweeps): (Route, usize),
    progress: &mut dyn FnMut(f64),
) -> OwnForces {
    let given = chosen.engine.settings();
    // A number of extrapolations that is given belongs to the given step.
    let (step, finest) = match (chosen.given.step.is_free(), chosen.given.extrapolated.is_free()) {
        (true, _) => (coarse_step(case), 0.0),
        (false, true) => (coarser(given.resolution, coarse_step(case)), 0.5 * given.resolution),
        (false, false) => (given.resolution, 0.0),
    };
    let mut asked = chosen.given.clone();
    let extrapolated = match asked.extrapolated.is_free() {
        true => {
            asked.step = Setting::Free;
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
        Ok((Judged { info, mut channels, mut verdict, run, .. }, search)) => {
            drop(bank);
            let (end, budget) = (search.end, chosen.budget);
            let all = channels.iter_mut().map(|channel| &mut channel.verdict).chain([&mut verdict]);
            all.for_each(|verdict| end.tell(verdict, budget));
            OwnForces {
                info,
                search: Some(search),
                channels,
                verdict,
                trajectory: Some(Arc::unwrap_or_clone(run).trajectory),
                failure: None,
            }
        }
        Err(Stopped { error, spent, .. }) => OwnForces::failed(engine.as_ref(), error, spent),
    }
}

/// The largest step of `step`, twice, four times `step`, ... up to `most`; `step` if that is larger.
fn coarser(step: f64, most: f64) -> f64 {
    let times = (most / step).log2().floor();
    if times > 0.0 { step * 2f64.powf(times) } else { step }
}
