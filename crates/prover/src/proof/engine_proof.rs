//! One engine's part of a proof.

use std::fmt::Write;

use super::judge::{ChannelProof, EngineInfo};
use super::settle::Search;
use crate::compare::{Check, Verdict};
use linkage::error::Error;
use linkage::trajectory::{Stage, Trajectory};

/// One engine's part of a proof, or the part that the forces have which the engine itself exerts.
#[derive(Clone, Debug)]
pub struct EngineProof {
    /// The engine.
    pub info: EngineInfo,
    /// How its settings were found; `None` if all were given, or if the engine failed.
    pub search: Option<Search>,
    /// Channels, in the order of columns; none if the engine failed.
    pub channels: Vec<ChannelProof>,
    /// Checks on the engine alone; none on its own forces.
    pub checks: Vec<Check>,
    /// Forces as the engine itself exerts them, where the others follow from its motion.
    pub own_forces: Option<Box<EngineProof>>,
    /// Verdict on channels, checks and own forces together.
    pub verdict: Verdict,
    /// Its trajectory: all instants, or those before it failed; of own forces, forces only.
    pub trajectory: Option<Trajectory>,
    /// Engine minus reference; `None` if the engine failed, and of own forces.
    pub errors: Option<Trajectory>,
    /// Whether all channels are judged at an instant, by row of the grid; empty if the engine failed.
    pub kept: Vec<bool>,
    /// Why there is no comparison.
    pub failure: Option<Error>,
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

impl EngineProof {
    /// An engine with a verdict, and nothing that it rests on.
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

    /// What own forces add to the engine's verdict. Where they stay open, they are told and take nothing back: the
    /// motion and its forces are judged all the same, and impulses are of a lower order and need the true masses, with
    /// many sweeps.
    #[must_use]
    pub fn added(&self) -> Option<&Verdict> {
        let own = self.own_forces.as_ref().map(|own| &own.verdict);
        own.filter(|verdict| !matches!(verdict, Verdict::Inconclusive { .. }))
    }

    /// Which of the two judgements of the forces disagrees; `None` if neither does, or if there is only one, or if the
    /// other one is open or the motion itself disagrees, so that nothing follows.
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

    /// The verdicts on channels and checks, and that on all of them.
    pub(super) fn verdicts_mut(&mut self) -> impl Iterator<Item = &mut Verdict> {
        let channels = self.channels.iter_mut().map(|channel| &mut channel.verdict);
        channels.chain(self.checks.iter_mut().map(|check| &mut check.verdict)).chain([&mut self.verdict])
    }

    /// Adds to an inconclusive verdict how strongly the motion depends on the forces that cause it: `sensitivity`, channel
    /// by channel of the reference.
    pub(super) fn tell_sensitivity(&mut self, reference: &Trajectory, sensitivity: &[f64]) {
        for (channel, &change) in reference.channels().iter().zip(sensitivity) {
            let own = self.channels.iter_mut().find(|own| own.residual.channel == *channel);
            if let Some(own) = own
                && own.residual.scale > 0.0
            {
                let share = change / own.residual.scale;
                own.sensitivity = Some(share);
                if let Verdict::Inconclusive { reason, .. } = &mut own.verdict {
                    let _ = write!(
                        reason,
                        "; a millionth more of gravity and motor torque changes the channel by {share:.2} millionths of its scale"
                    );
                }
            }
        }
    }
}
