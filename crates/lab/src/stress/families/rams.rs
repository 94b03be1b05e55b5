//! A cylinder near its dead point, a cam near its undercut, and a wheel that turns fast.

use linkage::case::Case;
use linkage::drive::MotionLaw;
use linkage::error::Result;
use linkage::math::Vec2;
use linkage::mechanism::{AssemblyMode, CamContact, CamCurve, CamLaw, CamSegment, TransmissionKind};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::four_bar::{LENGTHS, SPEED_OF_ALL, builder, rods};
use crate::stress::{Setup, StressFamily};

/// Distances of the boom's pivot from the foot and from the eye of the cylinder (m).
const FOOT: f64 = 0.6;
const EYE: f64 = 0.4;

/// A boom that a cylinder turns until the cylinder's lever arm is small.
/// At the boom's pivot, foot and eye form an angle. At the end, this angle is 180 deg minus `gap` (deg).
fn boom(gap: f64) -> Result<Setup> {
    let length = |angle: f64| (FOOT * FOOT + EYE * EYE - 2.0 * FOOT * EYE * angle.cos()).sqrt();
    let (begin, end) = (length(FRAC_PI_2), length(PI - gap.to_radians()));
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [-FOOT, 0.0])])
        .link("boom", &[("O", [0.0, 0.0]), ("B", [EYE, 0.0])])
        .link("cylinder", &[("C", [0.0, 0.0])])
        .link("rod", &[("H", [0.0, 0.0]), ("B", [0.4, 0.0])])
        .mass("boom", 20.0, [0.5, 0.02], 2.0)
        .mass("cylinder", 3.0, [0.15, 0.0], 0.03)
        .mass("rod", 2.0, [0.2, 0.0], 0.02)
        .pin("O", "ground", "boom")
        .pin("C", "ground", "cylinder")
        .pin("B", "rod", "boom")
        .slider("S", ("cylinder", "C"), ("rod", "H"), [0.0, 0.0])
        .gravity([0.0, -9.81])
        .mode(&["boom", "cylinder", "rod"], AssemblyMode::Left)
        .start(begin - 0.4)
        .driven("S", MotionLaw::Cycloidal { rise: end - begin, time: 2.0 })
        .times(&[0.3, 0.6, 0.9, 1.2, 1.5, 1.7, 1.8])
        .build()?;
    Ok(Setup::usual(case))
}

/// Family that approaches the dead point of a cylinder.
pub(super) const RAM: StressFamily = StressFamily {
    name: "ram",
    dial: "angle at the boom's pivot to the dead point of the cylinder (deg)",
    title: "a boom that a cylinder turns to a small angle before the dead point of the cylinder",
    points: &[0.01, 0.1, 0.5, 1.0, 5.0, 20.0],
    quick: &[1.0, 20.0],
    samples: 1,
    setup: |gap, _, _| boom(gap),
};

/// A cam with an offset roller follower; `base` is the radius of the base circle divided by the lift.
fn cam(base: f64) -> Result<Setup> {
    let (lift, radius, offset) = (0.02, 0.004, 0.003);
    let contact = CamContact::Roller { centre: Vec2::zeros(), radius };
    let pieces = [(0.4 * PI, lift), (PI, lift), (1.4 * PI, 0.0), (TAU, 0.0)];
    let law = pieces.map(|(to, lift)| CamSegment { to, lift, curve: CamCurve::Cycloidal });
    let law = CamLaw::of(law.to_vec()).expect("the angles ascend to a turn");
    let height = ((base * lift + radius).powi(2) - offset * offset).sqrt();
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("G", [offset, 0.0])])
        .link("cam", &[("O", [0.0, 0.0])])
        .link("follower", &[("F", [0.0, 0.0])])
        .mass("cam", 0.5, [0.002, 0.001], 3e-4)
        .mass("follower", 0.3, [0.0, 0.02], 1e-4)
        .pin("O", "ground", "cam")
        .slider("B", ("ground", "G"), ("follower", "F"), [FRAC_PI_2, FRAC_PI_2])
        .transmission("profile", TransmissionKind::Cam { law, contact }, ["cam", "follower"], "ground", ("B", height))
        .gravity([0.0, -9.81])
        .crank("O", 20.0)
        .instants(60)
        .build()?;
    Ok(Setup::usual(case))
}

/// Family that varies the base circle of a cam.
pub(super) const CAM: StressFamily = StressFamily {
    name: "cam",
    dial: "radius of the base circle divided by the lift",
    title: "a cam with an offset roller follower, down to base circles with steep and undercut profiles",
    points: &[0.3, 0.5, 1.0, 3.0, 10.0, 100.0],
    quick: &[0.5, 3.0],
    samples: 1,
    setup: |base, _, _| cam(base),
};

/// Position of the wheel's axle on the ground (m), and pressure angle of the gears (rad).
const AXLE: [f64; 2] = [-0.1, 0.15];
const PRESSURE_ANGLE: f64 = 0.35;

/// A crank-rocker with a gear wheel on the ground. The wheel turns `ratio` times as fast as the crank.
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

/// Family that varies the speed ratio of a geared wheel.
pub(super) const GEAR_RATIO: StressFamily = StressFamily {
    name: "gear_ratio",
    dial: "speed of the geared wheel divided by that of the crank",
    title: "a crank-rocker with a wheel that turns up to 1e4 times as fast as its crank",
    points: &[1.0, 10.0, 1e2, 1e3, 1e4],
    quick: &[1.0, 1e2],
    samples: 1,
    setup: |ratio, _, _| geared(ratio),
};
