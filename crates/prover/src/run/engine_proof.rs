//! One engine's part of a proof.

use crate::sentences;
use std::fmt::Write;

use crate::bounds::{Check, Convergence, Residual, Verdict, overall};
use crate::tolerance::{BoundBasis, Parts};
use linkage::engine::{Engine, Settings};
use linkage::error::{Advice, Error};
use linkage::solver::Provision;
use linkage::trajectory::{CHANNELS, Channel, Stage, Trajectory};

/// Data of an engine that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineInfo {
    /// Name, as on the command line.
    pub name: &'static str,
    /// Name and version of the software that the engine uses.
    pub version: String,
    /// Settings of the engine.
    pub settings: Settings,
    /// Whether the engine's resolution is an accuracy instead of a step.
    pub controls_error: bool,
    /// Settings that influence the result, by name, as text.
    pub told: Vec<(&'static str, String)>,
    /// For each stage, how the engine provides the channels of this stage.
    pub provides: Vec<(&'static str, Provision)>,
}

impl EngineInfo {
    pub(super) fn of(engine: &dyn Engine) -> Self {
        let provides = Stage::ALL.map(|stage| {
            let kind = CHANNELS.iter().find(|kind| kind.stage == stage).expect("every stage has a channel");
            (stage.name(), engine.provides(&Channel { of: String::new(), kind }))
        });
        EngineInfo {
            name: engine.name(),
            version: engine.version(),
            settings: engine.settings(),
            controls_error: engine.controls_error(),
            told: engine.told(),
            provides: provides.into(),
        }
    }
}

/// Comparison of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelProof {
    /// Residual of the engine against the reference.
    pub residual: Residual,
    /// Bound, in the channel's unit.
    pub bound: f64,
    /// Parts of the bound, in the channel's unit.
    pub parts: Parts,
    /// Convergence of the engine in this channel.
    pub convergence: Convergence,
    /// Largest difference between the extrapolated limit of the engine's runs and the reference, in the channel's unit.
    /// `None` if the limit cannot be estimated.
    pub limit: Option<f64>,
    /// For a free motion, the sensitivity to forces: largest change of the channel over the run, divided by the
    /// channel's scale and by the relative change of gravity and motor torque.
    pub sensitivity: Option<f64>,
    /// Number of instants that are not judged, because the channel jumps near the instant, the mechanism passes a
    /// change point, or a free motion begins.
    pub left_out: usize,
    /// Basis of the bound.
    pub basis: BoundBasis,
    /// The outcome.
    pub verdict: Verdict,
}

/// How the settings of an engine were found.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingsSearch {
    /// Number of runs made. Any two runs differ in step or number of sweeps.
    pub runs: usize,
    /// Work done. The unit is the work of one step without sweeps. Twenty sweeps count as one additional step.
    pub effort: f64,
    /// Allowed work, in the unit of `effort`.
    pub budget: f64,
    /// Why the search ended.
    pub end: SearchEnd,
}

/// Why a search for settings ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchEnd {
    /// Further refinement is not needed or does not help. Either every channel has the target accuracy, or every
    /// channel is conclusive and the work for further refinement is spent, or a channel converges steadily with too low
    /// an order.
    Decided,
    /// A finer step would add more rounding error than it would remove truncation error.
    Rounding,
    /// The allowed work is done.
    Budget,
    /// The search progresses so slowly that the allowed work would not be enough.
    Pace,
    /// No free setting is left to change.
    Nothing,
}

impl SearchEnd {
    /// Adds to an inconclusive verdict the reason why the search ended, and replaces the advice to match this reason.
    pub(super) fn tell(self, verdict: &mut Verdict, budget: f64) {
        let Verdict::Inconclusive { reason, advice } = verdict else { return };
        if advice.is_empty() {
            return;
        }
        let (why, way_out) = match self {
            // More work would not change the result, so the verdict keeps its advice.
            SearchEnd::Decided | SearchEnd::Nothing => return,
            SearchEnd::Rounding => (sentences::A_FINER_STEP_ADDS_MORE_ROUNDING, vec![Advice::OtherEngine]),
            SearchEnd::Budget => (sentences::THE_WORK_THAT_WAS_ALLOWED, vec![Advice::MoreWork { to: 10.0 * budget }]),
            SearchEnd::Pace => (sentences::AT_THE_PACE_OF_ITS_ROUNDS, vec![Advice::MoreWork { to: 10.0 * budget }]),
        };
        reason.push_str("; ");
        reason.push_str(why);
        *advice = way_out;
    }
}

/// One engine's part of a proof, or the part about the forces that the engine itself exerts.
#[derive(Clone, Debug)]
pub struct EngineProof {
    /// The engine.
    pub info: EngineInfo,
    /// How the engine's settings were found; `None` if all were given, or if the engine failed.
    pub search: Option<SettingsSearch>,
    /// Channels, in the order of columns; none if the engine failed.
    pub channels: Vec<ChannelProof>,
    /// Checks on the engine alone; empty for the engine's own forces.
    pub checks: Vec<Check>,
    /// Judgement of the forces that the engine itself exerts. The judgement exists only if the forces in `channels`
    /// follow from the engine's motion.
    pub own_forces: Option<Box<EngineProof>>,
    /// Verdict on channels, checks and the engine's own forces together.
    pub verdict: Verdict,
    /// Trajectory of the engine: all instants, or the instants before a failure. In a proof of the engine's own forces,
    /// the trajectory contains only forces.
    pub trajectory: Option<Trajectory>,
    /// Engine minus reference; `None` if the engine failed, and in a proof of the engine's own forces.
    pub errors: Option<Trajectory>,
    /// For every row of the grid, whether all channels are judged; empty if the engine failed.
    pub kept: Vec<bool>,
    /// Reason why the engine was not compared.
    pub failure: Option<Error>,
}

/// Which of the two judgements of an engine's forces disagrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceFault {
    /// The forces that follow from the engine's motion. The motion agrees, so the fault is in the equations for the
    /// forces.
    Reading,
    /// The forces that the engine itself exerts.
    /// The engine's motion is right, and the forces that follow from the motion are right too.
    Exerted,
    /// Both.
    Both,
}

impl EngineProof {
    /// An engine without results, only with a verdict.
    pub(super) fn bare(info: EngineInfo, verdict: Verdict) -> Self {
        EngineProof {
            info,
            search: None,
            channels: Vec::new(),
            checks: Vec::new(),
            own_forces: None,
            verdict,
            trajectory: None,
            errors: None,
            kept: Vec::new(),
            failure: None,
        }
    }

    /// The part of the verdict that comes from the forces that the engine itself exerts.
    /// An inconclusive verdict on these forces is reported but does not change the whole verdict, because the motion,
    /// and the forces that follow from the motion, are judged independently of the exerted forces.
    /// The engine computes these forces as impulses. Impulses converge with a lower order than the motion, and need the
    /// true masses and many sweeps.
    #[must_use]
    pub fn added(&self) -> Option<&Verdict> {
        let own = self.own_forces.as_ref().map(|own| &own.verdict);
        own.filter(|verdict| !matches!(verdict, Verdict::Inconclusive { .. }))
    }

    /// Which of the two judgements of the forces disagrees.
    /// `None` if both judgements agree or if only one judgement exists.
    /// Also `None` if one judgement disagrees and the other judgement is inconclusive, or if the motion disagrees: the
    /// cause is then unknown.
    #[must_use]
    pub fn force_fault(&self) -> Option<ForceFault> {
        let own = &self.own_forces.as_ref()?.channels;
        let disagrees = |channel: &ChannelProof| matches!(channel.verdict, Verdict::Disagree { .. });
        let agrees = |channel: &ChannelProof| matches!(channel.verdict, Verdict::Agree { .. });
        let is_force = |channel: &&ChannelProof| channel.residual.channel.kind.stage >= Stage::Reactions;
        let (forces, motion): (Vec<&ChannelProof>, Vec<&ChannelProof>) = self.channels.iter().partition(is_force);
        if motion.into_iter().any(disagrees) {
            return None;
        }
        match [forces.iter().copied().any(disagrees), own.iter().any(disagrees)] {
            [true, true] => Some(ForceFault::Both),
            [true, false] if own.iter().all(agrees) => Some(ForceFault::Reading),
            [false, true] if forces.into_iter().all(agrees) => Some(ForceFault::Exerted),
            [_, _] => None,
        }
    }

    /// Names of the channels and checks that disagree.
    pub(super) fn against(&self) -> Vec<String> {
        let disagrees = |verdict: &Verdict| matches!(verdict, Verdict::Disagree { .. });
        let channels = self.channels.iter().filter(|own| disagrees(&own.verdict));
        let checks = self.checks.iter().filter(|own| disagrees(&own.verdict));
        channels.map(|own| own.residual.channel.to_string()).chain(checks.map(Check::name)).collect()
    }

    /// Changes every verdict `disagree` to `inconclusive`, with a reason and advice.
    pub(super) fn doubt(&mut self, why: &str, way_out: &Advice) {
        for verdict in self.verdicts_mut() {
            if let Verdict::Disagree { place } = verdict {
                *verdict =
                    Verdict::Inconclusive { reason: format!("{place}, but {why}"), advice: vec![way_out.clone()] };
            }
        }
        self.conclude();
    }

    /// Recomputes the verdict from the verdicts of all channels, all checks and the engine's own forces.
    pub(super) fn conclude(&mut self) {
        let channels = self.channels.iter().map(|own| &own.verdict);
        self.verdict = overall(channels.chain(self.added()).chain(self.checks.iter().map(|own| &own.verdict)));
    }

    /// The verdicts on channels and checks, and the overall verdict.
    pub(super) fn verdicts_mut(&mut self) -> impl Iterator<Item = &mut Verdict> {
        let channels = self.channels.iter_mut().map(|channel| &mut channel.verdict);
        channels.chain(self.checks.iter_mut().map(|check| &mut check.verdict)).chain([&mut self.verdict])
    }

    /// Adds to inconclusive verdicts how strongly the motion depends on the forces that cause it.
    /// `sensitivity` has one value for each channel of the reference.
    pub(super) fn tell_sensitivity(&mut self, reference: &Trajectory, sensitivity: &[f64]) {
        for (channel, &change) in reference.channels().iter().zip(sensitivity) {
            let own = self.channels.iter_mut().find(|own| own.residual.channel == *channel);
            if let Some(own) = own
                && own.residual.scale > 0.0
            {
                let share = change / own.residual.scale;
                own.sensitivity = Some(share);
                if let Verdict::Inconclusive { reason, .. } = &mut own.verdict {
                    let _ = write!(reason, "{}", sentences::a_millionth_more_of_gravity(&share));
                }
            }
        }
    }
}
