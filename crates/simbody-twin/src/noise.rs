//! How exact Simbody's answers are at a constraint tolerance.
//!
//! Under prescribed motion the pose follows from the constraints alone: every state is projected onto them, and its error is what the
//! projection leaves, at most the tolerance, times what the pose makes of it. How far the integrator was off before does not matter.

use super::model::inertia;
use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::trajectory::{ChannelKind, Subject, Unit};

/// What poses make of an error in a constraint: 1 / sin of the angle at which two links meet, which is 10 at 6 degrees.
const POSE: f64 = 10.0;
/// Rounding on the way through the tree and the projection, in units of the last place.
const ULPS: f64 = 20.0;

/// Bound on the error of a channel at the constraint tolerance `tolerance` (m) and the integrator's accuracy, in the channel's unit.
///
/// In a free motion the integrator counts too: each step may be off by the accuracy, as a share of a radian, and every instant wanted ends a step, so that errors hardly
/// fall with the accuracy where instants are dense (on the shipped run-ups, 5e-9 to 5e-7 of the scale at 1e-8).
///
/// A constraint error turns a link by that error over its length, the shortest being worst. Rates of constraints are held to the
/// tolerance times the drive's speed, accelerations follow from both.
pub(super) fn bound(case: &Case, [tolerance, accuracy]: [f64; 2], channel: &ChannelKind) -> f64 {
    let longest = case.grid.times.iter().fold(0.0, |max: f64, t| max.larger(t.abs()));
    let speed = case.drives.top_speed();
    let size = case.mechanism.size();
    let moving = &case.mechanism.links()[1..];
    let shortest = moving.iter().map(|link| link.size()).filter(|&size| size > 0.0).fold(size, f64::smaller);
    let mass: f64 = (1..=moving.len()).map(|link| inertia(case, link)).map(|own| own.mass + own.extra_mass).sum();
    let turned = case.start.0.iter().fold(speed * longest, |max: f64, pose| max.larger(pose.angle.abs())).larger(1.0);
    // Places are world coordinates: far from the origin they are coarser than the mechanism's size lets expect.
    let reach = case.start.0.iter().fold(size, |max: f64, pose| max.larger(pose.origin.norm() + size));

    let place = POSE * tolerance + ULPS * f64::EPSILON * reach;
    let integrated = if case.is_free() { accuracy * case.grid.len() as f64 } else { 0.0 };
    let angle = place / shortest + f64::EPSILON * turned + integrated;
    let linear = place + angle * size;
    let gravity = case.gravity.norm();
    let force = mass * (linear * speed * speed + angle * gravity);
    match channel.unit {
        Unit::Radian => angle,
        Unit::RadianPerSecond => angle * speed,
        Unit::RadianPerSecondSquared => angle * speed * speed,
        Unit::Metre => linear,
        Unit::MetrePerSecond => linear * speed,
        Unit::MetrePerSecondSquared => linear * speed * speed,
        Unit::Newton => force,
        Unit::NewtonMetre => match channel.subject {
            Subject::Frame => force * reach,
            Subject::Link | Subject::Point | Subject::Joint | Subject::Slider | Subject::Drive | Subject::Motor => {
                force * size
            }
        },
    }
}
