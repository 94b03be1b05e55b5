//! Prescribed motion of a driving link.

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

/// Crank angle as a function of time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotionLaw {
    /// Constant angular velocity (rad/s, not zero), counter-clockwise positive.
    ConstantSpeed(f64),
}

/// Prescribed rotation of one link about its joint with the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// State of the driving link at time `t` (s). Times before the start are meant: the law goes on backwards.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> DriveState {
        match self.law {
            MotionLaw::ConstantSpeed(omega) => DriveState { angle: self.start + omega * t, omega, alpha: 0.0 },
        }
    }

    /// Time (s) at which the crank angle is `angle` (rad, as the scenario states it).
    #[inline]
    #[must_use]
    pub fn time_of(&self, angle: f64) -> f64 {
        match self.law {
            // Adding zero turns the -0 of a clockwise crank into 0.
            MotionLaw::ConstantSpeed(omega) => (angle - self.start) / omega + 0.0,
        }
    }

    /// World angle of the driving link's x axis (rad) for a crank angle as the scenario states it.
    #[inline]
    #[must_use]
    pub fn world_angle(&self, angle: f64) -> f64 {
        self.zero + angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_and_angle_are_inverse() {
        let drive =
            Drive { joint: 0, link: 1, zero: 3.0, start: 0.5, law: MotionLaw::ConstantSpeed(-97.2), free: None };
        let state = drive.at(0.01);
        assert!((drive.time_of(state.angle) - 0.01).abs() < 1e-15);
        assert_eq!((state.omega, state.alpha), (-97.2, 0.0));
        assert_eq!(drive.world_angle(state.angle), 3.0 + state.angle);
    }
}
