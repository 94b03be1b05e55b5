//! Motors with the data of catalogues.

use linkage::drive::{Motor, MotorLaw};

/// An induction motor from a catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct CatalogueMotor {
    /// Its type.
    pub name: String,
    /// Rated power on the shaft (W).
    pub power: f64,
    /// Speed at the rated power (rad/s).
    pub rated_speed: f64,
    /// Speed without load (rad/s), above the rated one.
    pub synchronous_speed: f64,
    /// Breakdown torque divided by rated torque, if the catalogue states it.
    pub breakdown: Option<f64>,
}

impl CatalogueMotor {
    /// Rated torque (N m): rated power over rated speed.
    #[must_use]
    pub fn rated_torque(&self) -> f64 {
        self.power / self.rated_speed
    }

    /// The stable part of its characteristic: the straight line through the rated point and synchronous speed,
    /// M = M_n (omega_s - omega) / (omega_s - omega_n).
    #[must_use]
    pub fn law(&self) -> MotorLaw {
        let slope = -self.rated_torque() / (self.synchronous_speed - self.rated_speed);
        MotorLaw::Linear { at_rest: -slope * self.synchronous_speed, slope }
    }

    /// The motor with a gearbox that reduces the rated speed to `crank` (rad/s, greater than zero).
    /// The gearbox has the efficiency `efficiency` (above 0, at most 1).
    #[must_use]
    pub fn geared_to(&self, crank: f64, efficiency: f64) -> Motor {
        Motor { efficiency, ..Motor::ideal(self.law(), self.rated_speed / crank) }
    }
}

/// The motor of the least rated power that is not below `power` (W). Of equal ones the first in the catalogue is taken.
/// `None` if all are too weak.
#[must_use]
pub fn weakest_sufficient(motors: &[CatalogueMotor], power: f64) -> Option<&CatalogueMotor> {
    motors.iter().filter(|motor| motor.power >= power).min_by(|a, b| a.power.total_cmp(&b.power))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn motor(name: &str, kw: f64, rated: f64) -> CatalogueMotor {
        let rpm = TAU / 60.0;
        CatalogueMotor {
            name: name.into(),
            power: kw * 1e3,
            rated_speed: rated * rpm,
            synchronous_speed: 3000.0 * rpm,
            breakdown: None,
        }
    }

    #[test]
    fn the_published_line() {
        let motor = motor("a", 0.55, 2745.0);
        // The printed values are 1.913 N m, 22.51 N m and -0.0716 N m s.
        assert!((motor.rated_torque() - 1.913).abs() < 5e-4);
        let MotorLaw::Linear { at_rest, slope } = motor.law() else { panic!("not linear") };
        assert!((at_rest - 22.51).abs() < 5e-3 && (slope + 0.0716).abs() < 1e-4, "{at_rest} {slope}");
        assert!((motor.law().torque(motor.rated_speed) - motor.rated_torque()).abs() < 1e-12);
        assert!(motor.law().torque(motor.synchronous_speed).abs() < 1e-12);
        assert!((motor.geared_to(130.0 * TAU / 60.0, 1.0).ratio - 2745.0 / 130.0).abs() < 1e-12);
    }

    #[test]
    fn the_weakest_that_is_strong_enough() {
        let all =
            [motor("big", 2.2, 2850.0), motor("b", 0.75, 2840.0), motor("a", 0.55, 2745.0), motor("c", 0.55, 1390.0)];
        let name = |power| weakest_sufficient(&all, power).map(|motor| motor.name.as_str());
        assert_eq!(
            [name(547.1), name(550.0), name(551.0), name(2000.0), name(3000.0)],
            [Some("a"), Some("a"), Some("b"), Some("big"), None]
        );
    }
}
