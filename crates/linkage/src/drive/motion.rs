//! Prescribed motion of a driving link.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::math::Piecewise;

/// Angle, angular velocity and angular acceleration of a driving link; rad, rad/s, rad/s^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveState {
    /// Crank angle as the scenario states it: from the drive's zero direction, counter-clockwise, turns counted (rad).
    pub angle: f64,
    /// Angular velocity (rad/s), counter-clockwise positive.
    pub omega: f64,
    /// Angular acceleration (rad/s^2).
    pub alpha: f64,
}

/// Crank angle as a function of time, from t = 0.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionLaw {
    /// Constant angular velocity (rad/s, not zero), counter-clockwise positive.
    ConstantSpeed(f64),
    /// From rest with constant acceleration up to a speed, which then stays.
    Ramp {
        /// The speed (rad/s, not zero), counter-clockwise positive.
        speed: f64,
        /// Time in which it is reached (s), positive.
        time: f64,
    },
    /// Cycloidal motion from rest to rest: rise (s - sin(2 pi s) / 2 pi) with s = t / time. Its acceleration, 2 pi rise / time^2 sin(2 pi s),
    /// begins and ends with zero. Artobolevsky, "Theory of mechanisms and machines", laws of motion of followers.
    Cycloidal {
        /// Angle gone through (rad, not zero), counter-clockwise positive.
        rise: f64,
        /// Time that it takes (s), positive.
        time: f64,
    },
    /// Angle gone through (rad) as a function of time (s) that has two continuous derivatives, from its first knot, 0, to its last.
    Table(Arc<Piecewise>),
}

impl MotionLaw {
    /// Time (s) up to which the law holds, if it ends.
    #[must_use]
    pub fn end(&self) -> Option<f64> {
        match self {
            MotionLaw::ConstantSpeed(_) | MotionLaw::Ramp { .. } => None,
            MotionLaw::Cycloidal { time, .. } => Some(*time),
            MotionLaw::Table(table) => table.knots().last().copied(),
        }
    }

    /// The speed if it is constant (rad/s).
    #[inline]
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        match *self {
            MotionLaw::ConstantSpeed(omega) => Some(omega),
            MotionLaw::Ramp { .. } | MotionLaw::Cycloidal { .. } | MotionLaw::Table(_) => None,
        }
    }

    /// Time (s) at which the angular acceleration jumps, if it does.
    #[must_use]
    pub fn jump(&self) -> Option<f64> {
        match *self {
            MotionLaw::Ramp { time, .. } => Some(time),
            MotionLaw::ConstantSpeed(_) | MotionLaw::Cycloidal { .. } | MotionLaw::Table(_) => None,
        }
    }

    /// What it is called in scenario files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            MotionLaw::ConstantSpeed(_) => "constant",
            MotionLaw::Ramp { .. } => "ramp",
            MotionLaw::Cycloidal { .. } => "cycloidal",
            MotionLaw::Table(_) => "table",
        }
    }
}

/// Prescribed rotation of one link about its joint with the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Driven joint.
    pub joint: usize,
    /// Driving link.
    pub link: usize,
    /// World direction from which the crank angle is measured: the angle of the link's x axis at crank angle zero (rad).
    pub zero: f64,
    /// Crank angle at t = 0 (rad).
    pub start: f64,
    /// The law. Of a free link, its nominal motion: the motor drives in its sense, and its speed is what speeds are measured by.
    pub law: MotionLaw,
    /// Speed (rad/s, counter-clockwise positive) at t = 0 of a link that motor and loads move from then on; `None` while it follows the law.
    pub free: Option<f64>,
}

impl Drive {
    /// State of the driving link at time `t` (s). Times beyond the law's are meant, for what runs up to it: the formula goes on smoothly.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> DriveState {
        match self.law {
            MotionLaw::ConstantSpeed(omega) => DriveState { angle: self.start + omega * t, omega, alpha: 0.0 },
            MotionLaw::Ramp { speed, time } if t <= time => {
                let alpha = speed / time;
                DriveState { angle: self.start + alpha * t * t / 2.0, omega: alpha * t, alpha }
            }
            MotionLaw::Ramp { speed, time } => {
                DriveState { angle: self.start + speed * (t - time / 2.0), omega: speed, alpha: 0.0 }
            }
            MotionLaw::Cycloidal { rise, time } => {
                let (share, mean) = (t / time, rise / time);
                let (sin, cos) = (TAU * share).sin_cos();
                DriveState {
                    angle: self.start + rise * (share - sin / TAU),
                    omega: mean * (1.0 - cos),
                    alpha: mean / time * TAU * sin,
                }
            }
            MotionLaw::Table(ref table) => {
                let [gone, omega, alpha] = table.at(t);
                DriveState { angle: self.start + gone, omega, alpha }
            }
        }
    }

    /// The speed that the law reaches (rad/s), counter-clockwise positive: the constant one, or that of largest size. Not zero.
    #[must_use]
    pub fn top_speed(&self) -> f64 {
        match &self.law {
            MotionLaw::ConstantSpeed(speed) | MotionLaw::Ramp { speed, .. } => *speed,
            MotionLaw::Cycloidal { rise, time } => 2.0 * rise / time,
            MotionLaw::Table(table) => {
                let [least, most] = table.slopes();
                if -least > most { least } else { most }
            }
        }
    }

    /// Sense in which the law goes: +1 counter-clockwise, -1 clockwise. A law that goes to and fro has the sense of its top speed.
    #[must_use]
    pub fn sense(&self) -> f64 {
        self.top_speed().signum()
    }

    /// Angular velocity at t = 0 (rad/s), counter-clockwise positive: that from which a free link starts, or the law's.
    #[must_use]
    pub fn initial_speed(&self) -> f64 {
        self.free.unwrap_or(self.at(0.0).omega)
    }

    /// Constant speed (rad/s) that takes the driving link in a step from where the law is at the time `from` (s) to where it is at `to`, in a
    /// time as long as the step; negative of the law's sense if `to` lies before `from`.
    #[inline]
    #[must_use]
    pub fn step_speed(&self, from: f64, to: f64) -> f64 {
        match self.law {
            MotionLaw::ConstantSpeed(omega) => omega.copysign(omega * (to - from)),
            MotionLaw::Ramp { .. } | MotionLaw::Cycloidal { .. } | MotionLaw::Table(_) => {
                (self.at(to).angle - self.at(from).angle) / (to - from).abs()
            }
        }
    }

    /// Time (s) at which the crank angle is `angle` (rad, as the scenario states it): the first one of the law's. Not a number if the law never
    /// comes there, and for tables, which may come there more than once.
    #[inline]
    #[must_use]
    pub fn time_of(&self, angle: f64) -> f64 {
        let gone = angle - self.start;
        match self.law {
            // Adding zero turns the -0 of a clockwise crank into 0.
            MotionLaw::ConstantSpeed(omega) => gone / omega + 0.0,
            MotionLaw::Ramp { speed, time } => match gone / speed {
                early if early < time / 2.0 => (2.0 * time * early).sqrt(),
                late => late + time / 2.0,
            },
            MotionLaw::Cycloidal { rise, time } => time * cycloid(gone / rise),
            MotionLaw::Table(_) => f64::NAN,
        }
    }

    /// World angle of the driving link's x axis (rad) for a crank angle as the scenario states it.
    #[inline]
    #[must_use]
    pub fn world_angle(&self, angle: f64) -> f64 {
        self.zero + angle
    }
}

/// The share s of time at which s - sin(2 pi s) / 2 pi is `gone`: by halving, since the function is flat at both ends.
fn cycloid(gone: f64) -> f64 {
    // The rounding of the last angle belongs to it.
    if !(-1e-15..=1.0 + 1e-15).contains(&gone) {
        return f64::NAN;
    }
    let (mut low, mut high) = (0.0f64, 1.0f64);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if middle - (TAU * middle).sin() / TAU < gone {
            low = middle;
        } else {
            high = middle;
        }
    }
    match gone {
        _ if gone <= 0.0 => 0.0,
        _ if gone >= 1.0 => 1.0,
        _ => (low + high) / 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive(law: MotionLaw) -> Drive {
        Drive { joint: 0, link: 1, zero: 3.0, start: 0.5, law, free: None }
    }

    fn table() -> MotionLaw {
        MotionLaw::Table(Arc::new(Piecewise::clamped_spline(
            &[(0.0, 0.0), (0.1, 0.4), (0.25, 0.2), (0.4, 1.0)],
            [0.0; 2],
        )))
    }

    #[test]
    fn time_and_angle_are_inverse() {
        let constant = drive(MotionLaw::ConstantSpeed(-97.2));
        assert_eq!((constant.at(0.01).omega, constant.at(0.01).alpha), (-97.2, 0.0));
        let ramp = drive(MotionLaw::Ramp { speed: -30.0, time: 0.02 });
        let cycloidal = drive(MotionLaw::Cycloidal { rise: -2.0, time: 0.05 });
        for drive in [constant, ramp, cycloidal] {
            for t in [0.01, 0.02, 0.03] {
                let state = drive.at(t);
                assert!((drive.time_of(state.angle) - t).abs() < 1e-15, "{t} {:?}", drive.law);
                assert_eq!(drive.world_angle(state.angle), 3.0 + state.angle);
            }
        }
        assert!(drive(table()).time_of(0.6).is_nan());
        let cycloidal = drive(MotionLaw::Cycloidal { rise: 2.0, time: 0.05 });
        assert_eq!([cycloidal.time_of(0.5), cycloidal.time_of(2.5)], [0.0, 0.05]);
        assert!(cycloidal.time_of(2.6).is_nan() && cycloidal.time_of(0.4).is_nan());
    }

    #[test]
    fn rates_are_derivatives() {
        let laws = [
            MotionLaw::ConstantSpeed(4.0),
            MotionLaw::Ramp { speed: 7.0, time: 0.2 },
            MotionLaw::Cycloidal { rise: 3.0, time: 0.4 },
            table(),
        ];
        for drive in laws.map(drive) {
            for t in [-0.01, 0.003, 0.09, 0.15, 0.31, 0.39] {
                let h = 1e-5;
                let [back, here, ahead] = [t - h, t, t + h].map(|t| drive.at(t));
                let (omega, alpha) = ((ahead.angle - back.angle) / (2.0 * h), (ahead.omega - back.omega) / (2.0 * h));
                assert!((omega - here.omega).abs() < 1e-7 && (alpha - here.alpha).abs() < 1e-5, "{t} {:?}", drive.law);
                assert!(here.omega.abs() <= drive.top_speed().abs() * (1.0 + 1e-12), "{t} {:?}", drive.law);
                let step = drive.step_speed(t, t + h);
                assert!((drive.at(t).angle + step * h - ahead.angle).abs() < 1e-15);
                let step = drive.step_speed(t, t - h);
                assert!((drive.at(t).angle + step * h - back.angle).abs() < 1e-15);
            }
            assert_eq!(drive.at(0.0).angle, 0.5);
        }
    }

    /// Laws that start from rest have a sense there too.
    #[test]
    fn sense_and_initial_speed() {
        let laws = [
            (MotionLaw::ConstantSpeed(-4.0), -1.0, -4.0),
            (MotionLaw::ConstantSpeed(4.0), 1.0, 4.0),
            (MotionLaw::Ramp { speed: -7.0, time: 0.2 }, -1.0, 0.0),
            (MotionLaw::Cycloidal { rise: -3.0, time: 0.4 }, -1.0, 0.0),
            (table(), 1.0, 0.0),
        ];
        for (law, sense, speed) in laws {
            let mut drive = drive(law);
            assert_eq!((drive.sense(), drive.initial_speed()), (sense, speed), "{:?}", drive.law);
            drive.free = Some(0.5);
            assert_eq!((drive.sense(), drive.initial_speed()), (sense, 0.5), "{:?}", drive.law);
        }
    }

    #[test]
    fn a_cycloid_rests_at_both_ends() {
        let drive = drive(MotionLaw::Cycloidal { rise: 3.0, time: 0.4 });
        for (t, angle) in [(0.0, 0.5), (0.2, 2.0), (0.4, 3.5)] {
            assert!((drive.at(t).angle - angle).abs() < 1e-15 && drive.at(t).alpha.abs() < 1e-12, "{t}");
        }
        assert!(drive.at(0.0).omega == 0.0 && drive.at(0.4).omega.abs() < 1e-12 && drive.at(0.2).omega == 15.0);
        assert_eq!(drive.law.end(), Some(0.4));
    }
}
