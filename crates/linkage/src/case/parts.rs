//! The parts of a case.

use super::grid::Grid;
use crate::drive::{Drives, Load};
use crate::math::Vec2;
use crate::mechanism::{AssemblyMode, Mechanism, Pose, Structure};
use crate::trajectory::{Channel, Stage};

/// The stages of channels that a run must deliver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted([bool; Stage::ALL.len()]);

impl Wanted {
    /// All channels.
    pub const ALL: Wanted = Wanted([true; Stage::ALL.len()]);

    /// Returns the selection of all channels of the given stages.
    #[must_use]
    pub fn of(stages: &[Stage]) -> Self {
        let mut wanted = Wanted([false; Stage::ALL.len()]);
        for &stage in stages {
            wanted.0[stage as usize] = true;
        }
        wanted
    }

    /// Whether the channels of `stage` are requested.
    #[inline]
    #[must_use]
    pub fn has(&self, stage: Stage) -> bool {
        self.0[stage as usize]
    }

    /// Last stage that must be computed, at least the positions.
    #[must_use]
    pub fn deepest(&self) -> Stage {
        Stage::ALL.into_iter().rev().find(|&stage| self.has(stage)).unwrap_or(Stage::Positions)
    }
}

/// The unchecked parts of a [`Case`](super::Case). SI units, world axes.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseParts {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Driving links and Assur groups of the mechanism.
    pub structure: Structure,
    /// Drives of the driving links, in the order of [`Structure::drivers`].
    pub drives: Drives,
    /// Loads other than gravity and inertia.
    pub loads: Vec<Load>,
    /// Acceleration of gravity (m/s^2).
    pub gravity: Vec2,
    /// Pose at t = 0.
    pub start: Pose,
    /// Assembly mode of each group, in the order of the structure.
    pub modes: Vec<AssemblyMode>,
    /// Requested instants.
    pub grid: Grid,
    /// Stages of the requested channels.
    pub wanted: Wanted,
    /// The requested channels in the order of columns; `None` means all channels of the requested stages.
    pub only: Option<Vec<Channel>>,
}
