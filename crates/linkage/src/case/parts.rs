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

    /// The channels of the given stages.
    #[must_use]
    pub fn of(stages: &[Stage]) -> Self {
        let mut wanted = Wanted([false; Stage::ALL.len()]);
        for &stage in stages {
            wanted.0[stage as usize] = true;
        }
        wanted
    }

    /// Whether the channels of `stage` are wanted.
    #[inline]
    #[must_use]
    pub fn has(&self, stage: Stage) -> bool {
        self.0[stage as usize]
    }

    /// The last stage that must be computed; at least positions.
    #[must_use]
    pub fn deepest(&self) -> Stage {
        Stage::ALL.into_iter().rev().find(|&stage| self.has(stage)).unwrap_or(Stage::Positions)
    }
}

/// The parts of a [`Case`](super::Case), not checked yet. SI units, world axes.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseParts {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its driving links and Assur groups.
    pub structure: Structure,
    /// What moves the mechanism, in the order of [`Structure::drivers`].
    pub drives: Drives,
    /// Loads besides gravity and inertia.
    pub loads: Vec<Load>,
    /// Acceleration of gravity (m/s^2).
    pub gravity: Vec2,
    /// Pose at t = 0.
    pub start: Pose,
    /// Assembly mode of each group, in the order of the structure.
    pub modes: Vec<AssemblyMode>,
    /// Instants wanted.
    pub grid: Grid,
    /// Stages of the channels wanted.
    pub wanted: Wanted,
    /// The channels wanted, where these are not all of the wanted stages: in the order of columns.
    pub only: Option<Vec<Channel>>,
}
