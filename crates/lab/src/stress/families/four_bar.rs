//! Families of four-bars. They vary ratios of masses and lengths, transmission angles, speeds and sizes.

use linkage::case::{Case, CaseBuilder};
use linkage::error::Result;
use linkage::mechanism::AssemblyMode;

use crate::stress::{Setup, StressFamily};

/// Number of instants in one turn of the crank.
const INSTANTS: usize = 36;
/// Mass per length of a rod (kg/m).
const DENSITY: f64 = 10.0;
/// Lengths of a crank-rocker (m): base, crank, coupler, rocker.
/// The transmission angle of this crank-rocker stays above 57 deg.
pub(super) const LENGTHS: [f64; 4] = [0.4, 0.1, 0.35, 0.25];
/// Speed (rad/s).
pub(super) const SPEED_OF_ALL: f64 = 10.0;

/// Masses of crank, coupler and rocker (kg): slender rods.
pub(super) fn rods([_, crank, coupler, rocker]: [f64; 4]) -> [f64; 3] {
    [crank, coupler, rocker].map(|length| DENSITY * length)
}

/// A four-bar O-A-B-C under gravity. Mass centres lie off the lines between the joints.
pub(super) fn builder([base, crank, coupler, rocker]: [f64; 4], masses: [f64; 3], speed: f64) -> CaseBuilder {
    let inertia = |mass: f64, length: f64| mass * length * length / 12.0;
    let centre = |length: f64| [0.45 * length, 0.1 * length];
    let [m1, m2, m3] = masses;
    Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [base, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [crank, 0.0])])
        .link("coupler", &[("A", [0.0, 0.0]), ("B", [coupler, 0.0])])
        .link("rocker", &[("C", [0.0, 0.0]), ("B", [rocker, 0.0])])
        .mass("crank", m1, centre(crank), inertia(m1, crank))
        .mass("coupler", m2, centre(coupler), inertia(m2, coupler))
        .mass("rocker", m3, centre(rocker), inertia(m3, rocker))
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .gravity([0.0, -9.81])
        .crank("O", speed)
        .start(0.3)
        .mode(&["coupler", "rocker"], AssemblyMode::Left)
        .instants(INSTANTS)
}

fn usual(lengths: [f64; 4], masses: [f64; 3], speed: f64) -> Result<Setup> {
    Ok(Setup::usual(builder(lengths, masses, speed).build()?))
}

/// Family that varies the mass ratio of neighbouring links.
pub(super) const MASS_RATIO: StressFamily = StressFamily {
    name: "mass_ratio",
    dial: "ratio of rocker mass to coupler mass",
    title: "a crank-rocker whose rocker is up to 1e8 times as heavy as its coupler",
    points: &[1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8],
    quick: &[1.0, 1e4, 1e8],
    samples: 1,
    setup: |ratio, _, _| usual(LENGTHS, [1.0, 1.0, ratio], SPEED_OF_ALL),
};

/// Family that varies the length ratio of neighbouring links.
pub(super) const LENGTH_RATIO: StressFamily = StressFamily {
    name: "length_ratio",
    dial: "ratio of coupler length to crank length",
    title: "a crank-rocker whose coupler is up to 1e4 times as long as its crank",
    points: &[3.5, 10.0, 30.0, 1e2, 3e2, 1e3, 3e3, 1e4],
    quick: &[3.5, 1e2, 1e4],
    samples: 1,
    setup: |ratio, _, _| {
        let lengths = [LENGTHS[0], LENGTHS[2] / ratio, LENGTHS[2], LENGTHS[3]];
        usual(lengths, rods(lengths), SPEED_OF_ALL)
    },
};

/// Family that approaches a dead point.
pub(super) const TRANSMISSION: StressFamily = StressFamily {
    name: "transmission_angle",
    dial: "smallest transmission angle (deg)",
    title: "a crank-rocker whose transmission angle falls as low as 0.01 deg, near a dead point",
    points: &[0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0],
    quick: &[0.01, 1.0, 30.0],
    samples: 1,
    setup: |degrees, _, _| {
        // Coupler and rocker have equal lengths.
        // At crank angle zero, coupler and rocker are the equal sides of a triangle.
        // The third side of this triangle leads from the crank's end to the rocker's pivot.
        let (crank, rod) = (0.1, 0.3);
        let lengths = [crank + 2.0 * rod * (0.5 * degrees.to_radians()).sin(), crank, rod, rod];
        // The revolution begins at the smallest transmission angle, so one instant has exactly this angle.
        let case = builder(lengths, rods(lengths), SPEED_OF_ALL).start(0.0).build()?;
        Ok(Setup::usual(case))
    },
};

/// Family that varies the speed of the crank.
pub(super) const SPEED: StressFamily = StressFamily {
    name: "speed",
    dial: "speed of the crank (rad/s)",
    title: "a crank-rocker under gravity, from one revolution in 17 hours to 95 000 rpm",
    points: &[1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4],
    quick: &[1e-4, 1.0, 1e4],
    samples: 1,
    setup: |speed, _, _| usual(LENGTHS, rods(LENGTHS), speed),
};

/// Family that varies the size of the mechanism.
pub(super) const SIZE: StressFamily = StressFamily {
    name: "size",
    dial: "length of the base (m)",
    title: "a crank-rocker of constant density, from 1 um to 1 km",
    points: &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3],
    quick: &[1e-6, 1e-2, 1e3],
    samples: 1,
    setup: |size, _, _| {
        let factor = size / LENGTHS[0];
        let masses = rods(LENGTHS).map(|mass| mass * factor.powi(3));
        usual(LENGTHS.map(|length| length * factor), masses, SPEED_OF_ALL)
    },
};
