//! Choice of a motor from the peak of the reduced moment of resistance.
//!
//! The required power is that of the peak on the crank's shaft at the wanted speed.
//! Divided by the efficiency between motor and crank, it is the least rated power of the motor.
//! Courses of machine design choose in this way.
//! It is conservative, because inertia carries the crank over peaks.

use super::catalogue::{CatalogueMotor, weakest_sufficient};
use analytic::AssurSolver;
use analytic::reduced::means::{self, means_over_turn};
use analytic::reduced::{ACCURACY, Model};
use analytic::steady::Regime;
use linkage::case::Case;
use linkage::drive::Motor;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;

/// A motor chosen for a mechanism, and the resulting motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Crank angle (rad) and value (N m) of the greatest reduced moment of resistance.
    pub peak: (f64, f64),
    /// Mean reduced moment of resistance (N m).
    pub mean: f64,
    /// Wanted magnitude of the crank's speed (rad/s): that of the scenario.
    pub wanted: f64,
    /// Power on the crank's shaft at the peak (W).
    pub power: f64,
    /// Required power of the motor (W): that power divided by the efficiency.
    pub asked: f64,
    /// The motor.
    pub motor: CatalogueMotor,
    /// The motor with a gearbox from its rated speed to the wanted one.
    pub geared: Motor,
    /// Magnitude of the crank's speed (rad/s) at which the averaged model is in equilibrium.
    pub averaged: f64,
    /// Steady periodic motion.
    pub regime: Regime,
}

impl Choice {
    /// The weakest motor of the catalogue that has the peak's power, for the crank's speed in the scenario.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an efficiency that is not above 0 and at most 1, or if every motor is too weak.
    /// [`ErrorKind::Numeric`] if the mechanism needs no motor, or the motor has no steady speed.
    /// Those of [`Model::of`] and of its extremes.
    pub fn of(case: &Case, catalogue: &[CatalogueMotor], efficiency: f64) -> Result<Self> {
        if !(efficiency > 0.0 && efficiency <= 1.0) {
            return Err(Error::new(ErrorKind::Input, format!("the efficiency is {efficiency}"))
                .help("give a share above 0 and at most 1: 0.92 for 92 %"));
        }
        let model = Model::of(case)?;
        let [_, resistance] = model.extremes()?;
        let omega = case.crank().at(0.0).rate;
        let mean = omega.signum() * means_over_turn(case, &AssurSolver)?.resistance;
        let wanted = omega.abs();
        let power = resistance.greatest.1 * wanted;
        if !(power > 0.0) {
            let message =
                format!("the greatest moment of resistance is {:.6} N m: nothing needs a motor", resistance.greatest.1);
            return Err(Error::new(ErrorKind::Numeric, message)
                .help("give the scenario the loads that the drive works against"));
        }
        let asked = power / efficiency;
        let Some(motor) = weakest_sufficient(catalogue, asked) else {
            let strongest = catalogue.iter().map(|motor| motor.power).fold(0.0, f64::larger);
            let message =
                format!("the drive asks for {:.4} kW, the strongest motor has {:.4} kW", asked / 1e3, strongest / 1e3);
            return Err(Error::new(ErrorKind::Input, message).help(
                "give a catalogue with stronger motors, or lower the peak: a flywheel on the crank carries over it",
            ));
        };
        let geared = motor.geared_to(wanted, efficiency);
        let Some(averaged) = geared.steady_speed(mean) else { return Err(means::no_steady_speed(mean)) };
        let driven = case.with_motor(Some(geared.clone()))?;
        let regime = Model::of(&driven)?.regime(&[], ACCURACY)?;
        Ok(Choice {
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
    #[must_use]
    pub fn peak_torque(&self) -> f64 {
        self.peak.1 / (self.geared.ratio * self.geared.efficiency)
    }

    /// Torque (N m) on the motor's shaft that the mean resistance requires.
    #[must_use]
    pub fn mean_torque(&self) -> f64 {
        self.mean / (self.geared.ratio * self.geared.efficiency)
    }
}
