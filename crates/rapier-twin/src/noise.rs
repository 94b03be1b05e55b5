//! Bounds on the rounding noise in the engine's results.

use super::probe::probe_turn;
use super::rapier::{Build, Rapier};
use super::window::first_steps;
use linkage::case::Case;
use linkage::engine::Route;
use linkage::math::KeepNan;
use linkage::math::interpolate::lagrange_weights;
use linkage::trajectory::{ChannelKind, ChannelSubject, Stage, Unit};

/// Rounding error of a speed in the solver's sweeps, in units in the last place.
/// The measured values are 12 on the crank-rocker and 2 on `ov7_base`.
const SPEED_ULPS: f64 = 20.0;
/// Rounding error of a second difference, in units of epsilon times the largest angle.
/// The rounding error is later divided by the square of the step.
/// For the crank angle, the error is two such units: 12.6 epsilon for a full turn (measured: 11.7).
/// The constant is twice as large, to cover the links that the crank moves.
const DIFFERENCE_ULPS: f64 = 4.0;
/// Smallest angle (rad) that is multiplied by [`DIFFERENCE_ULPS`].
/// A smaller angle has no smaller error, because unit vectors and positions are rounded at any angle.
/// On the crank-rocker and on `quick_return`, 12.6 epsilon were measured, both for a quarter turn and for half a turn.
/// On `ov7_base`, 26 epsilon were measured; 37 epsilon are allowed.
const LEAST_TURN: f64 = 3.0 * std::f64::consts::PI;
/// Mean rounding error per step of an angle that grows from zero, in units of epsilon times its final value.
/// Unit vectors are rounded by up to one epsilon, so `bound` assumes at least one epsilon per step.
const MEAN_HALF_ULP: f64 = 0.25;
/// Rounding error of the speed change due to an impulse, in units in the last place.
/// The error is the product of the rounding error of a speed and the condition number of the loop that determines the
/// impulse.
/// On the crank-rocker in f32, 3100 and 3570 units were measured at time steps of 1e-3 s and 2.5e-4 s.
/// In the impulse build, 557 and 570 units were measured at these time steps.
/// The bound is about twice as large as the largest measured value.
const IMPULSE_ULPS: f64 = 8000.0;
/// Rounding error of the speed change in a probe, in units in the last place.
/// The error is larger than for an impulse, because a probe subtracts one reading from twice another reading.
/// The measured values are 4450 and 7080 units; the bound is about twice as large as the larger value.
const PROBE_ULPS: f64 = 16000.0;

/// Bound on the rounding noise of a channel, in the channel's unit.
///
/// An angle is a sum of rounded increments, one for each step.
/// The error of each increment is at most half a unit in the last place of the angle so far.
/// The errors of successive steps add up, because their sign is constant while the speed and the floating-point
/// exponent of the angle are constant.
/// The bounds of lengths, forces and moments follow from the bounds of angles, with the mechanism's size and mass.
pub(super) fn bound(case: &Case, engine: &Rapier, channel: &ChannelKind) -> f64 {
    let (step, epsilon) = (engine.settings.resolution, engine.precision.epsilon());
    let longest = case.grid.times.iter().fold(0.0, |max: f64, t| max.larger(t.abs()));
    let speed = case.drives.top_speed(case.mechanism.size());
    let size = case.mechanism.size();
    let mass: f64 = case.mechanism.links().iter().map(|link| link.mass).sum();
    let turned = case.start.0.iter().fold(speed * longest, |max: f64, pose| max.larger(pose.angle.abs())).larger(1.0);

    // Positions are world coordinates. Far from the origin, their rounding error is larger than the mechanism's size
    // suggests, so the distance from the origin is included.
    let reach = case.start.0.iter().fold(size, |max: f64, pose| max.larger(pose.origin.norm() + size));
    let place = epsilon * reach;
    // Gravity changes all speeds in every step, and the constraints then restore them. In a slow motion this change
    // exceeds the speeds, so the rounding error of the change counts.
    let change = case.gravity.norm() * step / size;
    let angle = epsilon * (longest / step * (MEAN_HALF_ULP * turned).larger(1.0) + turned);
    let rate = angle * speed + epsilon * (SPEED_ULPS * speed + change);
    let turned = turned.larger(LEAST_TURN);
    let second =
        angle * speed * speed + epsilon * (SPEED_ULPS * change / step + DIFFERENCE_ULPS * turned / (step * step));
    let second = second * beginning(case, engine);
    let (rate, rate_of_place) = match case.is_steady() {
        true => (rate, 0.0),
        // Rates are centred differences of poses here, so the rounding error of a difference is added.
        false => (rate + DIFFERENCE_ULPS * epsilon * turned / step, DIFFERENCE_ULPS * place / step),
    };
    let second = match engine.settings.route {
        _ if channel.stage < Stage::Reactions => second,
        Route::Differences => second,
        // An impulse gives the difference of two speeds one step apart, so the error is divided by the step.
        Route::Native => IMPULSE_ULPS * epsilon * speed / step * beginning(case, engine),
        Route::Probe => PROBE_ULPS * epsilon * speed * speed / probe_turn(engine.precision),
    };
    let linear = second * size + DIFFERENCE_ULPS * place / (step * step);
    match channel.unit {
        Unit::Radian => angle,
        Unit::RadianPerSecond => rate,
        Unit::RadianPerSecondSquared => second,
        Unit::Metre => angle * size + place,
        Unit::MetrePerSecond => rate * size + rate_of_place,
        Unit::MetrePerSecondSquared => linear,
        Unit::Newton => linear * mass,
        Unit::NewtonMetre => match engine.settings.route {
            Route::Differences => linear * mass * lever(case, reach, channel.subject),
            // An impulse corresponds to the difference of the speeds at two successive steps. The lever arm of the
            // impulse is `reach`.
            Route::Native | Route::Probe => linear * mass * reach,
        },
    }
}

/// Lever arm (m) that converts the noise of forces to the noise of a moment.
/// For a driving moment, the arm extends to the far end of the driving link.
/// A prismatic joint may transmit its force anywhere in the mechanism, so the arm of this force is the mechanism's
/// size.
/// The mechanism's size is also the arm of a driving moment if the driving link has a prismatic joint.
/// For the frame, moments are those about the origin, so the arm is `reach`.
fn lever(case: &Case, reach: f64, subject: ChannelSubject) -> f64 {
    match (subject.is_drive(), subject == ChannelSubject::Frame) {
        (true, _) => case.drive_arm(),
        (false, true) => reach,
        (false, false) => case.mechanism.size(),
    }
}

/// Factor on the rounding error of second differences at the beginning of a free motion.
/// At the beginning, second differences and impulses are extrapolated backwards from the first regular steps.
/// The factor is therefore the sum of the absolute Lagrange weights of this extrapolation.
fn beginning(case: &Case, engine: &Rapier) -> f64 {
    let steps = first_steps(case, engine.build == Build::Impulse) as f64;
    let first = case.grid.times.iter().fold(f64::INFINITY, |least: f64, &t| least.smaller(t));
    if !case.is_free() || first > (2.0 + steps) * engine.settings.resolution {
        return 1.0;
    }
    lagrange_weights(-steps).iter().map(|weight| weight.abs()).sum()
}
