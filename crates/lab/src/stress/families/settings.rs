//! Families that vary an engine's settings: the step, until the engine diverges, and the number of sweeps.

use super::chain::chain;
use super::four_bar::{LENGTHS, SPEED_OF_ALL, builder, rods};
use crate::stress::{EngineUse, Setup, StressFamily};

/// Number of sweeps in the family that varies the step.
const SWEEPS_OF_ALL: usize = 64;
/// Step in the family that varies the number of sweeps (deg of the crank).
const STEP_OF_ALL: f64 = 0.5;

fn step_of(degrees: f64) -> f64 {
    degrees.to_radians() / SPEED_OF_ALL
}

/// Family that varies the engine's step.
pub(super) const STEP: StressFamily = StressFamily {
    name: "step",
    dial: "step of the engine (deg of the crank)",
    title: "a crank-rocker at a given step and 64 sweeps, until an engine blows up",
    points: &[0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0],
    quick: &[0.2, 2.0, 90.0],
    samples: 1,
    setup: |degrees, _, _| {
        let case = builder(LENGTHS, rods(LENGTHS), SPEED_OF_ALL).build()?;
        let engines = EngineUse::Given { step: step_of(degrees), sweeps: SWEEPS_OF_ALL };
        Ok(Setup { engines, ..Setup::usual(case) })
    },
};

/// Family that varies the number of sweeps.
pub(super) const SWEEPS: StressFamily = StressFamily {
    name: "sweeps",
    dial: "sweeps of the iteration per step",
    title: "a chain of three four-bars at a step of half a degree, with few to many sweeps",
    points: &[1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0, 2048.0, 4096.0],
    quick: &[1.0, 16.0, 256.0],
    samples: 1,
    setup: |sweeps, _, _| {
        let engines = EngineUse::Given { step: step_of(STEP_OF_ALL), sweeps: sweeps as usize };
        Ok(Setup { engines, ..Setup::usual(chain(3, SPEED_OF_ALL)?) })
    },
};
