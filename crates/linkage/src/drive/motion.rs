//! Motion laws: an input as a function of time.

use std::convert::Infallible;
use std::f64::consts::TAU;
use std::sync::Arc;

use crate::math::{Curve, root};

/// An input with its rate and acceleration.
/// The units are rad, rad/s, rad/s^2 for an angle; m, m/s, m/s^2 for a length.
/// [`Input`](crate::input::Input) defines what the input measures.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct InputState {
    /// Value in the scenario's convention.
    /// An angle is measured counter-clockwise from the drive's zero direction and includes whole turns.
    pub value: f64,
    /// Rate of the value. The rate of an angle is counter-clockwise positive.
    pub rate: f64,
    /// Acceleration of the value. The acceleration of an angle is counter-clockwise positive.
    pub acceleration: f64,
}

/// An input as a function of time, from t = 0.
/// The stated units are for an angle. For a length, the unit is m instead of rad, and m/s instead of rad/s.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionLaw {
    /// Constant angular velocity (rad/s), counter-clockwise positive.
    /// A drive with the speed 0 holds its joint. The first drive must not have the speed 0.
    ConstantSpeed(f64),
    /// Constant acceleration from rest to a final speed. After the acceleration the speed is constant.
    Ramp {
        /// Final speed (rad/s, not zero), counter-clockwise positive.
        speed: f64,
        /// Duration of the acceleration (s), positive.
        time: f64,
    },
    /// Cycloidal motion from rest to rest: rise (s - sin(2 pi s) / 2 pi) with s = t / time.
    /// The acceleration, 2 pi rise / time^2 sin(2 pi s), begins and ends with zero.
    /// Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988, on laws of motion of
    /// followers.
    Cycloidal {
        /// Total angle (rad, not zero), counter-clockwise positive.
        rise: f64,
        /// Duration (s), positive.
        time: f64,
    },
    /// Angle from the start (rad) as a function of time (s), from t = 0: a table, a harmonic or a formula.
    Curve(Arc<Curve>),
}

impl MotionLaw {
    /// Time (s) at which the law ends; `None` if it never ends.
    #[must_use]
    pub fn end(&self) -> Option<f64> {
        match self {
            MotionLaw::ConstantSpeed(_) | MotionLaw::Ramp { .. } => None,
            MotionLaw::Cycloidal { time, .. } => Some(*time),
            MotionLaw::Curve(curve) => curve.end(),
        }
    }

    /// The speed (rad/s) if it is constant; otherwise `None`.
    #[inline]
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        match *self {
            MotionLaw::ConstantSpeed(omega) => Some(omega),
            MotionLaw::Ramp { .. } | MotionLaw::Cycloidal { .. } | MotionLaw::Curve(_) => None,
        }
    }

    /// Whether the speed is always zero, so that the drive holds its joint.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.constant() == Some(0.0)
    }

    /// Time (s) at which the angular acceleration jumps; `None` if there is no jump.
    #[must_use]
    pub fn jump(&self) -> Option<f64> {
        match *self {
            MotionLaw::Ramp { time, .. } => Some(time),
            MotionLaw::ConstantSpeed(_) | MotionLaw::Cycloidal { .. } | MotionLaw::Curve(_) => None,
        }
    }

    /// Name of the law in scenario files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            MotionLaw::ConstantSpeed(_) if self.holds() => "hold",
            MotionLaw::ConstantSpeed(_) => "constant",
            MotionLaw::Ramp { .. } => "ramp",
            MotionLaw::Cycloidal { .. } => "cycloidal",
            MotionLaw::Curve(curve) => curve.name(),
        }
    }

    /// Angle, speed and acceleration at time `t` (s) of a motion with the input `start` (rad) at t = 0.
    /// The law continues smoothly beyond its end. Callers that approach the end need this continuation.
    #[inline]
    pub fn at(&self, start: f64, t: f64) -> InputState {
        match *self {
            MotionLaw::ConstantSpeed(omega) => InputState { value: start + omega * t, rate: omega, acceleration: 0.0 },
            MotionLaw::Ramp { speed, time } if t <= time => {
                let alpha = speed / time;
                InputState { value: start + alpha * t * t / 2.0, rate: alpha * t, acceleration: alpha }
            }
            MotionLaw::Ramp { speed, time } => {
                InputState { value: start + speed * (t - time / 2.0), rate: speed, acceleration: 0.0 }
            }
            MotionLaw::Cycloidal { rise, time } => {
                let (share, mean) = (t / time, rise / time);
                let (sin, cos) = (TAU * share).sin_cos();
                InputState {
                    value: start + rise * (share - sin / TAU),
                    rate: mean * (1.0 - cos),
                    acceleration: mean / time * TAU * sin,
                }
            }
            MotionLaw::Curve(ref curve) => {
                let [gone, rate, acceleration] = curve.at(t);
                InputState { value: start + gone, rate, acceleration }
            }
        }
    }

    /// The speed with the largest absolute value that the law reaches (rad/s), counter-clockwise positive.
    /// The result is zero only for a drive that holds its joint.
    #[must_use]
    pub fn top_speed(&self) -> f64 {
        match self {
            MotionLaw::ConstantSpeed(speed) | MotionLaw::Ramp { speed, .. } => *speed,
            MotionLaw::Cycloidal { rise, time } => 2.0 * rise / time,
            MotionLaw::Curve(curve) => curve.steepest(),
        }
    }

    /// Largest absolute value of the angular acceleration (rad/s^2).
    #[must_use]
    pub fn largest_acceleration(&self) -> f64 {
        match self {
            MotionLaw::ConstantSpeed(_) => 0.0,
            MotionLaw::Ramp { speed, time } => (speed / time).abs(),
            MotionLaw::Cycloidal { rise, time } => TAU * rise.abs() / (time * time),
            MotionLaw::Curve(curve) => curve.sharpest(),
        }
    }

    /// First time (s) at which the driving link has turned by the angle `gone` (rad). For `gone` = 0 the result is 0.
    /// At constant speed, the time is negative if the angle has the sign opposite to the speed.
    /// NaN if the law never reaches the angle.
    /// NaN also if a table or formula reaches the angle more than once, or if a harmonic reaches it more than once
    /// within one period.
    #[inline]
    #[must_use]
    pub fn time_of(&self, gone: f64) -> f64 {
        match *self {
            // Adding zero changes the -0 of a clockwise crank to 0.
            MotionLaw::ConstantSpeed(omega) => gone / omega + 0.0,
            MotionLaw::Ramp { speed, time } => match gone / speed {
                early if early < time / 2.0 => (2.0 * time * early).sqrt(),
                late => late + time / 2.0,
            },
            MotionLaw::Cycloidal { rise, time } => time * cycloid(gone / rise),
            MotionLaw::Curve(ref curve) => only_time(curve, gone),
        }
    }
}

/// Number of parts into which each interval of a table is divided, to find where the table reaches a value.
const PARTS: usize = 32;

/// The only time (s) at which a curve reaches `gone`, found by sign changes and bisection.
/// NaN if no time or several times are found.
fn only_time(curve: &Curve, gone: f64) -> f64 {
    if gone == 0.0 {
        return 0.0;
    }
    // A difference as small as rounding errors counts as zero.
    // The last value of the curve is then found even if the computed value is slightly off.
    let off =
        |t: f64| Some(curve.at(t)[0] - gone).filter(|off| off.abs() > 4.0 * f64::EPSILON * gone.abs()).unwrap_or(0.0);
    let (places, count) = (curve.places(), if matches!(curve, Curve::Table(_)) { PARTS } else { 1 });
    let parts = places.windows(2).flat_map(|pair| {
        let at = |k: usize| pair[0] + (pair[1] - pair[0]) * k as f64 / count as f64;
        (0..count).map(move |k| [at(k), if k + 1 == count { pair[1] } else { at(k + 1) }])
    });
    let mut times = parts.filter_map(|[low, high]| {
        let is_before = off(low) < 0.0;
        if off(low) == 0.0 || off(high) != 0.0 && (off(high) < 0.0) == is_before {
            return None;
        }
        let Ok([low, high]) = root::halved([low, high], HALVINGS, |t| Ok::<_, Infallible>((off(t) < 0.0) == is_before));
        Some(if off(high) == 0.0 { high } else { f64::midpoint(low, high) })
    });
    let first = times.next().unwrap_or(f64::NAN);
    if times.next().is_some() { f64::NAN } else { first }
}

/// Number of bisections that locate a time. The first interval is the law's duration, or a part of it.
/// After these bisections the error of the time is at the level of rounding errors.
const HALVINGS: usize = 60;

/// Fraction s of the duration at which s - sin(2 pi s) / 2 pi equals `gone`.
/// The fraction is found by bisection, because the function has zero slope at both ends.
fn cycloid(gone: f64) -> f64 {
    // `gone` may lie outside the range from 0 to 1 by 1e-15, because of rounding errors.
    if !(-1e-15..=1.0 + 1e-15).contains(&gone) {
        return f64::NAN;
    }
    if gone <= 0.0 || gone >= 1.0 {
        return gone.clamp(0.0, 1.0);
    }
    let before = |share: f64| Ok::<_, Infallible>(share - (TAU * share).sin() / TAU < gone);
    let Ok([low, high]) = root::halved([0.0, 1.0], HALVINGS, before);
    f64::midpoint(low, high)
}
