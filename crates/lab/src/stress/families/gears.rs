//! Ratios of gears.

use linkage::error::Result;
use linkage::mechanism::TransmissionKind;

use super::four_bar::{LENGTHS, SPEED_OF_ALL, builder, rods};
use crate::stress::{Setup, StressFamily};

/// Position of the wheel's axle on the ground (m), and pressure angle of the gears (rad).
const AXLE: [f64; 2] = [-0.1, 0.15];
const PRESSURE_ANGLE: f64 = 0.35;

/// A crank-rocker with a wheel on the ground that turns `ratio` times as fast as the crank.
fn geared(ratio: f64) -> Result<Setup> {
    let kind = TransmissionKind::Gears { teeth: [ratio, 1.0], pressure_angle: PRESSURE_ANGLE };
    let case = builder(LENGTHS, rods(LENGTHS), SPEED_OF_ALL)
        .point("ground", "W", AXLE)
        .link("wheel", &[("W", [0.0, 0.0])])
        .mass("wheel", 0.1, [1e-3 / ratio, 0.0], 1e-4 / ratio)
        .pin("W", "ground", "wheel")
        .transmission("gears", kind, ["crank", "wheel"], "ground", ("W", 0.5))
        .build()?;
    Ok(Setup::usual(case))
}

/// Ratio of the speeds.
pub(super) const GEAR_RATIO: StressFamily = StressFamily {
    name: "gear_ratio",
    dial: "speed of the geared wheel divided by that of the crank",
    title: "a crank-rocker with a wheel that turns up to 1e4 times as fast as its crank",
    points: &[1.0, 10.0, 1e2, 1e3, 1e4],
    quick: &[1.0, 1e2],
    samples: 1,
    setup: |ratio, _, _| geared(ratio),
};
