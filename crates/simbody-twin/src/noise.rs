//! Accuracy of Simbody's results at a given constraint tolerance.
//!
//! Under prescribed motion the pose follows from the constraints alone, and every state is projected onto the
//! constraints.
//! The error of the pose is at most the tolerance of the projection times a factor that depends on the pose.
//! The integrator's error before the projection does not affect the projected pose.

use super::model::inertia;
use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::trajectory::{ChannelKind, ChannelSubject, Unit};

/// Factor by which the pose amplifies a constraint error. The factor is 1 / sin of the angle between two links. At an
/// angle of 6 degrees the factor is 10.
const POSE: f64 = 10.0;
/// Rounding errors in the tree and in the projection, in units in the last place.
const ULPS: f64 = 20.0;

/// Bound on the error of a channel, in the channel's unit.
/// The bound depends on the constraint tolerance `tolerance` (m) and the integrator's accuracy `accuracy`.
///
/// In a free motion, the integrator adds errors: the error of each step (rad) may be as large as the accuracy.
/// Every output time is also the end of an integration step.
/// Dense output times limit the steps more than the accuracy does, so a tighter accuracy hardly reduces the errors.
/// On the shipped run-ups the errors are 5e-9 to 5e-7 of the channel's scale at an accuracy of 1e-8.
///
/// A constraint error rotates a link by an angle equal to the constraint error divided by the link's length.
/// The rotation is largest for the shortest link.
/// A factor that depends on the pose (`POSE`) amplifies the errors: the errors of the angles contain this factor once,
/// the errors of velocities contain its square, and the errors of accelerations and forces contain its cube.
/// Simbody keeps the rates of the constraint errors below the tolerance times the drive's speed. Accelerations follow
/// from positions and velocities.
pub(super) fn bound(case: &Case, [tolerance, accuracy]: [f64; 2], channel: &ChannelKind) -> f64 {
    let longest = case.grid.times.iter().fold(0.0, |max: f64, t| max.larger(t.abs()));
    let speed = case.drives.top_speed(case.mechanism.size());
    let size = case.mechanism.size();
    let moving = &case.mechanism.links()[1..];
    let shortest = moving.iter().map(|link| link.size()).filter(|&size| size > 0.0).fold(size, f64::smaller);
    let mass: f64 =
        case.mechanism.links().ids().skip(1).map(|link| inertia(case, link)).map(|own| own.mass + own.extra_mass).sum();
    let turned = case.start.0.iter().fold(speed * longest, |max: f64, pose| max.larger(pose.angle.abs())).larger(1.0);
    // Positions are world coordinates. A position far from the origin has larger rounding errors than a length in the
    // mechanism. The bound therefore includes the distance from the origin.
    let reach = case.start.0.iter().fold(size, |max: f64, pose| max.larger(pose.origin.norm() + size));

    let place = POSE * tolerance + ULPS * f64::EPSILON * reach;
    let integrated = if case.is_free() { accuracy * case.grid.len() as f64 } else { 0.0 };
    let closed = place / shortest + f64::EPSILON * turned;
    // `angle(k)` is the error of the `k`-th derivative of an angle, and `linear(k)` is the error of the `k`-th
    // derivative of a position.
    let angle = |k: i32| (POSE.powi(k) * closed + integrated) * speed.powi(k);
    let linear = |k: i32| POSE.powi(k) * place * speed.powi(k) + angle(k) * size;
    let force = mass * (linear(2) + (POSE * closed + integrated) * case.gravity.norm());
    match channel.unit {
        Unit::Radian => angle(0),
        Unit::RadianPerSecond => angle(1),
        Unit::RadianPerSecondSquared => angle(2),
        Unit::Metre => linear(0),
        Unit::MetrePerSecond => linear(1),
        Unit::MetrePerSecondSquared => linear(2),
        Unit::Newton => force,
        Unit::NewtonMetre => force * if channel.subject == ChannelSubject::Frame { reach } else { size },
    }
}
