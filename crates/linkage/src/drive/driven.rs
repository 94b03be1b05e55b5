//! A driving link and its motion.

use super::{InputState, MotionLaw, Motor};
use crate::input::{Input, InputValue};
use crate::math::statistics::share;
use crate::mechanism::{GROUND, Joint, JointId, LinkId};

/// Kind of motion of a driving link.
#[derive(Clone, Debug, PartialEq)]
pub enum DriveMotion {
    /// Motion prescribed by a law. The drive supplies the moment that this motion requires.
    Prescribed {
        /// The motion law.
        law: MotionLaw,
        /// Motor for additional results, such as the motor's steady speed under load.
        /// The motor does not affect the motion. The link follows the law even if the motor is too weak.
        motor: Option<Motor>,
    },
    /// Free motion from t = 0 on. Loads, weights, inertia and the motor (if there is one) determine the motion.
    Free {
        /// Speed at t = 0 (rad/s), counter-clockwise positive.
        initial_speed: f64,
        /// Speed of the nominal motion (rad/s, not zero), counter-clockwise positive.
        /// The sign of this speed is the motor's sense of rotation. The speed also serves as [`Drive::top_speed`].
        /// An instant given by a crank angle is an instant of the nominal motion.
        nominal_speed: f64,
        /// Motor that drives the link.
        motor: Option<Motor>,
    },
}

impl DriveMotion {
    /// Whether forces determine the motion.
    #[must_use]
    pub fn is_free(&self) -> bool {
        match self {
            DriveMotion::Prescribed { .. } => false,
            DriveMotion::Free { .. } => true,
        }
    }
}

/// A driving link and the motion of its input. The input is the coordinate of the driven joint.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Drive {
    /// Kind of the input.
    pub input: Input,
    /// Driven joint.
    pub joint: JointId,
    /// Link moved by the drive.
    pub link: LinkId,
    /// Coordinate of the joint at zero input (rad or m): see [`Drive::coordinate`].
    pub zero: f64,
    /// Input at t = 0 (SI unit).
    pub start: f64,
    /// Motion of the link: prescribed or free.
    pub motion: DriveMotion,
    /// Whether the mechanism continues through change points, on the branch with continuous velocities.
    /// If `false`, a change point is an error. The field has no effect on a free motion: see [`Drive::passes`].
    pub through: bool,
}

impl Drive {
    /// Returns the drive of a crank that follows `law` and has no motor.
    /// The other arguments are values of the fields with the same names.
    pub fn prescribed(joint: JointId, link: LinkId, zero: f64, start: f64, law: MotionLaw) -> Self {
        let motion = DriveMotion::Prescribed { law, motor: None };
        Drive { input: Input::Angle, joint, link, zero, start, motion, through: false }
    }

    /// Input and driving link of a drive at `joint`.
    /// A prismatic joint has its slide as input.
    /// A revolute joint on the ground has the world angle of its moving link as input.
    /// If `is_free` is true, a revolute joint on the link of a drive in `before` has the world angle of the free link
    /// as input.
    /// Any other revolute joint has the angle between its two links as input.
    #[must_use]
    pub fn of_joint(joint: &Joint, before: &[Drive], is_free: bool) -> (Input, LinkId) {
        let carries = |link: LinkId| link == GROUND || before.iter().any(|drive| drive.link == link);
        let [first, second] = [joint.first.link, joint.second.link];
        let link = if carries(second) && !carries(first) { first } else { second };
        let is_crank = first == GROUND || second == GROUND || is_free && (carries(first) || carries(second));
        match joint.is_pin() {
            true if is_crank => (Input::Angle, link),
            true => (Input::Turn, link),
            false => (Input::Slide, link),
        }
    }

    /// Applies `read` to the law of the motion. For a free link, `read` receives the law of the link's nominal motion.
    #[inline]
    fn by_law<T>(&self, read: impl FnOnce(&MotionLaw) -> T) -> T {
        match &self.motion {
            DriveMotion::Prescribed { law, .. } => read(law),
            DriveMotion::Free { nominal_speed, .. } => read(&MotionLaw::ConstantSpeed(*nominal_speed)),
        }
    }

    /// Input, rate and acceleration at time `t` (s), as in [`MotionLaw::at`].
    /// For a free link, the values of its nominal motion.
    #[inline]
    pub fn at(&self, t: f64) -> InputState {
        self.by_law(|law| law.at(self.start, t))
    }

    /// Time (s) at which the crank angle is `angle` (rad, in the scenario's convention), as in [`MotionLaw::time_of`].
    /// For a free link, the time in its nominal motion.
    #[inline]
    #[must_use]
    pub fn time_of(&self, angle: f64) -> f64 {
        self.by_law(|law| law.time_of(angle - self.start))
    }

    /// Constant speed (rad/s) that moves the link from its angle at time `from` to its angle at time `to` (s).
    /// The duration of this motion is the absolute difference of the two times.
    /// If `to` is before `from`, the speed has the sign opposite to the law's sense.
    #[inline]
    #[must_use]
    pub fn step_speed(&self, from: f64, to: f64) -> f64 {
        self.by_law(|law| match law.constant() {
            Some(omega) => omega.copysign(omega * (to - from)),
            None => (law.at(self.start, to).value - law.at(self.start, from).value) / (to - from).abs(),
        })
    }

    /// Largest speed of the law (rad/s), as in [`MotionLaw::top_speed`]. For a free link: the nominal speed.
    #[must_use]
    pub fn top_speed(&self) -> f64 {
        self.by_law(MotionLaw::top_speed)
    }

    /// Largest angular acceleration of the law (rad/s^2), as in [`MotionLaw::largest_acceleration`].
    #[must_use]
    pub fn largest_acceleration(&self) -> f64 {
        self.by_law(MotionLaw::largest_acceleration)
    }

    /// How fast the law changes its speed (1/s): the largest acceleration divided by the top speed. For a harmonic law
    /// this is the angular frequency; zero for a constant speed and for a drive that holds its joint.
    #[must_use]
    pub fn pace(&self) -> f64 {
        share(self.largest_acceleration(), self.top_speed().abs())
    }

    /// Sense of rotation of the law: +1 counter-clockwise, -1 clockwise.
    /// For an oscillating law, the result is the sense of the top speed.
    #[must_use]
    pub fn sense(&self) -> f64 {
        self.top_speed().signum()
    }

    /// Angular velocity at t = 0 (rad/s), counter-clockwise positive: the speed of the law, or the initial speed of a
    /// free link.
    #[must_use]
    pub fn initial_speed(&self) -> f64 {
        match self.motion {
            DriveMotion::Prescribed { .. } => self.at(0.0).rate,
            DriveMotion::Free { initial_speed, .. } => initial_speed,
        }
    }

    /// Constant speed of the law, or the nominal speed of a free link (rad/s); `None` if the speed varies.
    #[inline]
    #[must_use]
    pub fn constant_speed(&self) -> Option<f64> {
        self.by_law(MotionLaw::constant)
    }

    /// Time (s) at which the law ends; `None` if it never ends.
    #[must_use]
    pub fn end(&self) -> Option<f64> {
        self.by_law(MotionLaw::end)
    }

    /// Time (s) at which the angular acceleration jumps; `None` if there is no jump.
    #[must_use]
    pub fn jump(&self) -> Option<f64> {
        self.by_law(MotionLaw::jump)
    }

    /// Name of the law in scenario files; for a free link, the name of the nominal motion's law.
    #[must_use]
    pub fn law_name(&self) -> &'static str {
        self.by_law(MotionLaw::name)
    }

    /// Whether the motion is free, that is, determined by forces.
    #[inline]
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.motion.is_free()
    }

    /// Whether the mechanism continues through change points, on the branch with continuous velocities.
    /// A free motion continues because of its momentum. A motion under a law continues if [`Drive::through`] is set.
    /// [`Case::passes`](crate::case::Case::passes) has further conditions for the whole mechanism.
    #[inline]
    #[must_use]
    pub fn passes(&self) -> bool {
        self.through || self.is_free()
    }

    /// Whether the drive exerts a moment on the link. Only the drive of a free link without a motor exerts no moment.
    #[must_use]
    pub fn has_moment(&self) -> bool {
        match &self.motion {
            DriveMotion::Prescribed { .. } => true,
            DriveMotion::Free { motor, .. } => motor.is_some(),
        }
    }

    /// The motor of the link. The motor of a free link drives the link.
    /// The motor of a link under a law does not drive the link.
    /// For a link under a law, only the motor's speed under load is computed.
    #[must_use]
    pub fn motor(&self) -> Option<&Motor> {
        match &self.motion {
            DriveMotion::Prescribed { motor, .. } | DriveMotion::Free { motor, .. } => motor.as_ref(),
        }
    }

    /// Motor that drives the link.
    /// `None` for a link under a law, because only free links are driven by motors.
    #[must_use]
    pub fn moving_motor(&self) -> Option<&Motor> {
        match &self.motion {
            DriveMotion::Prescribed { .. } => None,
            DriveMotion::Free { motor, .. } => motor.as_ref(),
        }
    }

    /// Moment of inertia of rotor and reducer (kg m^2), referred to the free link that the motor drives.
    /// The result is 0 for a link under a law.
    #[must_use]
    pub fn moving_inertia(&self) -> f64 {
        self.moving_motor().map_or(0.0, Motor::inertia_on_crank)
    }

    /// Returns this drive with the given motor, or without a motor.
    pub fn with_motor(&self, motor: Option<Motor>) -> Drive {
        let motion = match &self.motion {
            DriveMotion::Prescribed { law, .. } => DriveMotion::Prescribed { law: law.clone(), motor },
            &DriveMotion::Free { initial_speed, nominal_speed, .. } => {
                DriveMotion::Free { initial_speed, nominal_speed, motor }
            }
        };
        Drive { motion, ..*self }
    }

    /// Returns this drive in its nominal motion. The law of a free link is then constant speed at the nominal speed.
    pub fn nominal(&self) -> Drive {
        let motion = match &self.motion {
            DriveMotion::Prescribed { .. } => self.motion.clone(),
            DriveMotion::Free { nominal_speed, motor, .. } => {
                DriveMotion::Prescribed { law: MotionLaw::ConstantSpeed(*nominal_speed), motor: motor.clone() }
            }
        };
        Drive { motion, through: self.passes(), ..*self }
    }

    /// Returns this drive with the law's top speed at all times.
    /// The drive of a free link is returned unchanged, because its top speed is its constant nominal speed.
    pub fn at_top_speed(&self) -> Drive {
        let motion = match &self.motion {
            DriveMotion::Prescribed { law, motor } => {
                DriveMotion::Prescribed { law: MotionLaw::ConstantSpeed(law.top_speed()), motor: motor.clone() }
            }
            DriveMotion::Free { .. } => self.motion.clone(),
        };
        Drive { motion, ..*self }
    }

    /// Coordinate of the driven joint at the input `angle` (rad or m, in the scenario's convention).
    /// For [`Input::Angle`]: the world angle of the driving link's x axis (rad).
    /// For [`Input::Turn`]: the angle of the joint's second link minus that of its first link (rad).
    /// For [`Input::Slide`]: the slide (m), as in [`State::slide`](crate::solver::State::slide).
    #[inline]
    #[must_use]
    pub fn coordinate(&self, angle: f64) -> f64 {
        self.zero + angle
    }

    /// Converts the coordinate measured as in [`Drive::coordinate`] to the input in the scenario's convention.
    #[inline]
    #[must_use]
    pub fn from_coordinate(&self, coordinate: f64) -> f64 {
        coordinate - self.zero
    }

    /// Angle of the driving link's frame (rad, unwrapped) for a coordinate measured as in [`Drive::coordinate`].
    /// `None` if the input is not an [`Input::Angle`].
    #[inline]
    #[must_use]
    pub fn link_angle(&self, coordinate: f64) -> Option<f64> {
        match self.input {
            Input::Angle => Some(coordinate),
            Input::Turn | Input::Slide => None,
        }
    }

    /// The input with the value `value`, formatted for messages.
    pub fn told(&self, value: f64) -> InputValue {
        self.input.at(value)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::math::{Curve, Piecewise};

    fn drive(law: MotionLaw) -> Drive {
        Drive::prescribed(JointId(0), LinkId(1), 3.0, 0.5, law)
    }

    fn table() -> MotionLaw {
        let points = [(0.0, 0.0), (0.1, 0.4), (0.25, 0.2), (0.4, 1.0)];
        MotionLaw::Curve(Arc::new(Curve::Table(Piecewise::clamped_spline(&points, [0.0; 2]))))
    }

    #[test]
    fn time_and_angle_are_inverse() {
        let constant = drive(MotionLaw::ConstantSpeed(-97.2));
        assert_eq!((constant.at(0.01).rate, constant.at(0.01).acceleration), (-97.2, 0.0));
        let ramp = drive(MotionLaw::Ramp { speed: -30.0, time: 0.02 });
        let cycloidal = drive(MotionLaw::Cycloidal { rise: -2.0, time: 0.05 });
        for drive in [constant, ramp, cycloidal] {
            for t in [0.01, 0.02, 0.03] {
                let state = drive.at(t);
                assert!((drive.time_of(state.value) - t).abs() < 1e-15, "{t} {:?}", drive.motion);
                assert_eq!(drive.coordinate(state.value), 3.0 + state.value);
            }
        }
        // The table starts at 0.5, and reaches 0.8 three times and 0.6 once.
        let own = drive(table());
        assert!(own.time_of(0.8).is_nan() && own.time_of(1.6).is_nan() && own.time_of(0.5) == 0.0);
        assert!([0.6, 1.2, 1.5].iter().all(|&value| (own.at(own.time_of(value)).value - value).abs() < 1e-15));
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
                let (omega, alpha) = ((ahead.value - back.value) / (2.0 * h), (ahead.rate - back.rate) / (2.0 * h));
                assert!(
                    (omega - here.rate).abs() < 1e-7 && (alpha - here.acceleration).abs() < 1e-5,
                    "{t} {:?}",
                    drive.motion
                );
                assert!(here.rate.abs() <= drive.top_speed().abs() * (1.0 + 1e-12), "{t} {:?}", drive.motion);
                let step = drive.step_speed(t, t + h);
                assert!((drive.at(t).value + step * h - ahead.value).abs() < 1e-15);
                let step = drive.step_speed(t, t - h);
                assert!((drive.at(t).value + step * h - back.value).abs() < 1e-15);
            }
            assert_eq!(drive.at(0.0).value, 0.5);
        }
    }

    /// A law that starts from rest has a sense of rotation even at t = 0.
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
            let drive = drive(law);
            assert_eq!((drive.sense(), drive.initial_speed()), (sense, speed), "{:?}", drive.motion);
            let motion = DriveMotion::Free { initial_speed: 0.5, nominal_speed: 4.0 * sense, motor: None };
            let free = Drive { motion, ..drive };
            assert_eq!((free.sense(), free.initial_speed()), (sense, 0.5), "{:?}", free.motion);
            // A free drive returns the states and times of its nominal motion.
            assert_eq!(free.at(2.0), free.nominal().at(2.0));
            assert_eq!((free.time_of(3.0), free.nominal().initial_speed()), (2.5 * sense / 4.0, 4.0 * sense));
        }
    }

    #[test]
    fn a_cycloid_rests_at_both_ends() {
        let drive = drive(MotionLaw::Cycloidal { rise: 3.0, time: 0.4 });
        for (t, angle) in [(0.0, 0.5), (0.2, 2.0), (0.4, 3.5)] {
            assert!((drive.at(t).value - angle).abs() < 1e-15 && drive.at(t).acceleration.abs() < 1e-12, "{t}");
        }
        assert!(drive.at(0.0).rate == 0.0 && drive.at(0.4).rate.abs() < 1e-12 && drive.at(0.2).rate == 15.0);
        assert_eq!(drive.end(), Some(0.4));
    }
}
