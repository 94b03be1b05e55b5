//! Motors: their torque as a function of their speed, and the gear between them and the crank.

/// Torque of a motor as a function of its own speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotorLaw {
    /// M = `at_rest` + `slope` omega: the stable branch of an induction motor's characteristic, or a direct current motor.
    Linear {
        /// Torque at which the line meets standstill (N m).
        at_rest: f64,
        /// Change of the torque with the speed (N m s); negative, or the motor would run away.
        slope: f64,
    },
}

impl MotorLaw {
    /// Torque (N m) at the motor's speed `omega` (rad/s).
    #[inline]
    #[must_use]
    pub fn torque(&self, omega: f64) -> f64 {
        match *self {
            MotorLaw::Linear { at_rest, slope } => at_rest + slope * omega,
        }
    }
}

/// A motor that turns the crank through a reducer without losses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// The motor's law.
    pub law: MotorLaw,
    /// Speed of the motor over that of the crank, greater than zero.
    pub ratio: f64,
}

impl Motor {
    /// Moment of the motor on the crank (N m) while the crank turns with `omega` (rad/s): ratio times the torque, by equal powers.
    #[inline]
    #[must_use]
    pub fn moment_on_crank(&self, omega: f64) -> f64 {
        self.ratio * self.law.torque(self.ratio * omega)
    }

    /// Speed of the crank (rad/s) at which the motor's moment on it is `resistance` (N m).
    #[must_use]
    pub fn steady_speed(&self, resistance: f64) -> f64 {
        match self.law {
            MotorLaw::Linear { at_rest, slope } => (resistance / self.ratio - at_rest) / (slope * self.ratio),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_steady_speed_the_moment_is_the_resistance() {
        let motor = Motor { law: MotorLaw::Linear { at_rest: 22.51, slope: -0.0716 }, ratio: 2745.0 / 130.0 };
        let steady = motor.steady_speed(17.0);
        assert!((motor.moment_on_crank(steady) - 17.0).abs() < 1e-12);
        // Without resistance the motor runs at its synchronous speed, 22.51 / 0.0716 = 314.385 1/s.
        assert!((motor.steady_speed(0.0) * motor.ratio - 314.385_474_860_335_2).abs() < 1e-10);
    }
}
