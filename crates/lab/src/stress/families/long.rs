//! Long runs. Engines make many steps, and the analytic sides solve instants after many revolutions of the crank.

use std::f64::consts::TAU;

use linkage::case::Case;
use linkage::error::Result;

use super::four_bar::{LENGTHS, SPEED_OF_ALL, builder, rods};
use crate::stress::{EngineUse, Setup, StressFamily};

/// Number of intervals between the instants of the last revolution.
const INSTANTS: usize = 12;
/// Step of the engines (deg of the crank), and their number of sweeps.
const STEP_OF_ALL: f64 = 1.0;
const SWEEPS_OF_ALL: usize = 16;

/// A crank-rocker whose requested instants divide the last of `turns` revolutions.
/// If `turns` is below 1, the instants divide the whole motion.
fn last_turn(turns: f64) -> Result<Case> {
    let span = if turns < 1.0 { turns } else { 1.0 };
    // Rounding must not move an instant beyond `turns` revolutions, so the last instant is one interval before the end.
    let at = |part: usize| TAU / SPEED_OF_ALL * (turns - span * (1.0 - part as f64 / (INSTANTS + 1) as f64));
    let times: Vec<f64> = (0..=INSTANTS).map(at).collect();
    // The start angle is 0, so the last crank angle is below `turns` revolutions.
    builder(LENGTHS, rods(LENGTHS), SPEED_OF_ALL).start(0.0).times(&times).build()
}

/// Family that varies the number of engine steps.
pub(super) const STEPS: StressFamily = StressFamily {
    name: "steps",
    dial: "number of one-degree steps to the last instant",
    title: "a crank-rocker over up to 1e6 steps at 16 sweeps, compared over its last revolution",
    points: &[1e2, 1e3, 1e4, 1e5, 1e6],
    quick: &[1e2, 1e4],
    samples: 1,
    setup: |steps, _, _| {
        let step = STEP_OF_ALL.to_radians() / SPEED_OF_ALL;
        let case = last_turn(steps * STEP_OF_ALL / 360.0)?;
        Ok(Setup { engines: EngineUse::Given { step, sweeps: SWEEPS_OF_ALL }, ..Setup::usual(case) })
    },
};

/// Family that varies the number of crank revolutions.
pub(super) const TURNS: StressFamily = StressFamily {
    name: "turns",
    dial: "number of crank revolutions to the last instant",
    title: "a crank-rocker after up to 1e5 revolutions, analytic sides only",
    points: &[1.0, 10.0, 1e2, 1e3, 1e4, 1e5],
    quick: &[1.0, 1e2],
    samples: 1,
    setup: |turns, _, _| Ok(Setup { engines: EngineUse::None, ..Setup::usual(last_turn(turns)?) }),
};
