//! Motors from catalogues, and the choice of a motor by the peak of the reduced moment of resistance.
//!
//! The power on the crank's shaft is computed at the peak and at the required speed.
//! This power divided by the efficiency between motor and crank is the smallest allowed rated power of the motor.
//! Courses of machine design teach this choice of a motor.
//! The choice is conservative, because it ignores that inertia carries the crank over peaks.

use crate::sentences;
use analytic::AssurSolver;
use analytic::reduced::means::{self, means_over_turn};
use analytic::reduced::{ACCURACY, ReducedModel};
use analytic::steady::Regime;
use linkage::case::Case;
use linkage::drive::{Motor, MotorLaw};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;

/// An induction motor from a catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct CatalogueMotor {
    /// Type designation in the catalogue.
    pub name: String,
    /// Rated power on the shaft (W).
    pub power: f64,
    /// Speed at the rated power (rad/s).
    pub rated_speed: f64,
    /// Speed without load (rad/s), above the rated speed.
    pub synchronous_speed: f64,
    /// Breakdown torque divided by rated torque, if the catalogue states it.
    pub breakdown: Option<f64>,
}

impl CatalogueMotor {
    /// Rated torque (N m): rated power divided by rated speed.
    pub fn rated_torque(&self) -> f64 {
        self.power / self.rated_speed
    }

    /// The stable part of the motor's characteristic.
    /// This part is the straight line through the rated point and the synchronous speed, M = M_n (omega_s - omega) /
    /// (omega_s - omega_n).
    pub fn law(&self) -> MotorLaw {
        let slope = -self.rated_torque() / (self.synchronous_speed - self.rated_speed);
        MotorLaw::Linear { at_rest: -slope * self.synchronous_speed, slope }
    }

    /// The motor with a gearbox that reduces the rated speed to `crank` (rad/s, greater than zero).
    /// The gearbox has the efficiency `efficiency` (above 0, at most 1).
    pub fn geared_to(&self, crank: f64, efficiency: f64) -> Motor {
        Motor { efficiency, ..Motor::ideal(self.law(), self.rated_speed / crank) }
    }
}

/// The motor with the smallest rated power that is not below `power` (W).
/// If several motors have this rated power, the first of them in the catalogue is chosen.
/// `None` if all motors are too weak.
pub fn weakest_sufficient(motors: &[CatalogueMotor], power: f64) -> Option<&CatalogueMotor> {
    motors.iter().filter(|motor| motor.power >= power).min_by(|a, b| a.power.total_cmp(&b.power))
}

/// A motor chosen for a mechanism, and the resulting motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorChoice {
    /// Crank angle (rad) and value (N m) of the largest reduced moment of resistance.
    pub peak: (f64, f64),
    /// Mean reduced moment of resistance (N m).
    pub mean: f64,
    /// Required magnitude of the crank's speed (rad/s). The scenario states this speed.
    pub wanted: f64,
    /// Power on the crank's shaft at the peak (W).
    pub power: f64,
    /// Required power of the motor (W): the power on the crank's shaft divided by the efficiency.
    pub asked: f64,
    /// The motor.
    pub motor: CatalogueMotor,
    /// The motor with a gearbox from its rated speed to the required speed.
    pub geared: Motor,
    /// Magnitude of the crank's speed (rad/s) at which the averaged model is in equilibrium.
    pub averaged: f64,
    /// Steady periodic motion.
    pub regime: Regime,
}

impl MotorChoice {
    /// Chooses the weakest motor of the catalogue that has enough power for the peak at the crank's speed in the
    /// scenario.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an efficiency of 0 or less or above 1, or if every motor is too weak.
    /// [`ErrorKind::Numeric`] if the mechanism needs no motor, or the motor has no steady speed.
    /// The errors of [`ReducedModel::of`] and of the search for the extremes of the reduced quantities.
    pub fn of(case: &Case, catalogue: &[CatalogueMotor], efficiency: f64) -> Result<Self> {
        if !(efficiency > 0.0 && efficiency <= 1.0) {
            return Err(Error::new(ErrorKind::Input, sentences::the_efficiency_is(&efficiency))
                .help(sentences::GIVE_A_SHARE_ABOVE_AND_AT_MOST));
        }
        let model = ReducedModel::of(case)?;
        let [_, resistance] = model.extremes()?;
        let omega = case.crank().at(0.0).rate;
        let mean = omega.signum() * means_over_turn(case, &AssurSolver)?.resistance;
        let wanted = omega.abs();
        let power = resistance.greatest.1 * wanted;
        if !(power > 0.0) {
            let message = sentences::the_greatest_moment_of_resistance(&resistance.greatest.1);
            return Err(Error::new(ErrorKind::Numeric, message).help(sentences::GIVE_THE_SCENARIO_THE_LOADS));
        }
        let asked = power / efficiency;
        let Some(motor) = weakest_sufficient(catalogue, asked) else {
            let strongest = catalogue.iter().map(|motor| motor.power).fold(0.0, f64::larger);
            let message = sentences::the_drive_asks_for_kw_the_strongest(&(asked / 1e3), &(strongest / 1e3));
            return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_CATALOGUE_WITH_STRONGER));
        };
        let geared = motor.geared_to(wanted, efficiency);
        let Some(averaged) = geared.steady_speed(mean) else { return Err(means::no_steady_speed(mean)) };
        let driven = case.with_motor(Some(geared.clone()))?;
        let regime = ReducedModel::of(&driven)?.regime(&[], ACCURACY)?;
        Ok(MotorChoice {
            peak: resistance.greatest,
            mean,
            wanted,
            power,
            asked,
            motor: motor.clone(),
            geared,
            averaged,
            regime,
        })
    }

    /// Torque (N m) on the motor's shaft that the peak requires, without inertia.
    pub fn peak_torque(&self) -> f64 {
        self.peak.1 / (self.geared.ratio * self.geared.efficiency)
    }

    /// Torque (N m) on the motor's shaft that the mean resistance requires.
    pub fn mean_torque(&self) -> f64 {
        self.mean / (self.geared.ratio * self.geared.efficiency)
    }
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
    fn rated_data_give_the_published_torque_line() {
        let motor = motor("a", 0.55, 2745.0);
        // The printed values of the three quantities below are 1.913 N m, 22.51 N m and -0.0716 N m s.
        assert!((motor.rated_torque() - 1.913).abs() < 5e-4);
        let MotorLaw::Linear { at_rest, slope } = motor.law() else { panic!("not linear") };
        assert!((at_rest - 22.51).abs() < 5e-3 && (slope + 0.0716).abs() < 1e-4, "{at_rest} {slope}");
        assert!((motor.law().torque(motor.rated_speed) - motor.rated_torque()).abs() < 1e-12);
        assert!(motor.law().torque(motor.synchronous_speed).abs() < 1e-12);
        assert!((motor.geared_to(130.0 * TAU / 60.0, 1.0).ratio - 2745.0 / 130.0).abs() < 1e-12);
    }

    #[test]
    fn the_weakest_sufficient_motor_is_chosen() {
        let all =
            [motor("big", 2.2, 2850.0), motor("b", 0.75, 2840.0), motor("a", 0.55, 2745.0), motor("c", 0.55, 1390.0)];
        let name = |power| weakest_sufficient(&all, power).map(|motor| motor.name.as_str());
        assert_eq!(
            [name(547.1), name(550.0), name(551.0), name(2000.0), name(3000.0)],
            [Some("a"), Some("a"), Some("b"), Some("big"), None]
        );
    }
}
