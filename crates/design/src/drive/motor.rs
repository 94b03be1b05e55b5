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
use linkage::drive::{Motor, MotorLaw, ShaftInertia};
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
    /// Moment of inertia of the rotor (kg m^2), if the catalogue states it.
    pub rotor: Option<f64>,
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
        let inertia = ShaftInertia { rotor: self.rotor.unwrap_or(0.0), ..ShaftInertia::default() };
        let rated_torque = Some(self.rated_torque());
        Motor { efficiency, inertia, rated_torque, ..Motor::ideal(self.law(), self.rated_speed / crank) }
    }
}

/// Largest breakdown torque of usual induction motors, divided by the rated torque.
pub const LARGEST_BREAKDOWN: f64 = 3.0;

/// A limit beyond which a motor's torque law no longer describes the motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotorLimit {
    /// The motor turns faster than at no load, so the motor brakes the mechanism.
    AboveSynchronous {
        /// Largest speed of the motor (rad/s).
        speed: f64,
        /// Speed of the motor without load (rad/s).
        synchronous: f64,
    },
    /// The torque by a linear law exceeds the breakdown torque of usual induction motors.
    BeyondBreakdown {
        /// Speed of the motor (rad/s).
        speed: f64,
        /// Torque of the law at this speed (N m).
        torque: f64,
        /// The torque divided by the rated torque.
        share: f64,
    },
    /// The motor turns more slowly than at its breakdown torque. There, the torque falls with falling speed.
    BelowBreakdown {
        /// Smallest speed of the motor (rad/s).
        speed: f64,
        /// Speed at the breakdown torque (rad/s).
        breakdown: f64,
    },
}

impl MotorLimit {
    /// The limits of a motor that are exceeded in a motion between two speeds of the crank (rad/s, positive in the
    /// motor's sense).
    /// A linear law without a rated torque may describe a direct-current motor, so no breakdown is assumed for it.
    /// In a start from rest (`is_start`), a Kloss law is valid below the breakdown speed too.
    pub fn of(motor: &Motor, [slowest, fastest]: [f64; 2], is_start: bool) -> Vec<MotorLimit> {
        let [slowest, fastest] = [slowest, fastest].map(|speed| speed * motor.ratio);
        let mut limits = Vec::new();
        if let Some(synchronous) = motor.steady_speed(0.0).map(|speed| speed * motor.ratio)
            && fastest > synchronous * (1.0 + 1e-9)
        {
            limits.push(MotorLimit::AboveSynchronous { speed: fastest, synchronous });
        }
        match (&motor.law, motor.rated_torque) {
            (MotorLaw::Linear { .. }, Some(rated)) => {
                let torque = motor.law.torque(slowest);
                let share = torque / rated;
                if share > LARGEST_BREAKDOWN {
                    limits.push(MotorLimit::BeyondBreakdown { speed: slowest, torque, share });
                }
            }
            (&MotorLaw::Kloss { breakdown_slip, synchronous_speed, .. }, _) => {
                let breakdown = synchronous_speed * (1.0 - breakdown_slip);
                if !is_start && slowest < breakdown {
                    limits.push(MotorLimit::BelowBreakdown { speed: slowest, breakdown });
                }
            }
            (MotorLaw::Linear { .. } | MotorLaw::Constant { .. } | MotorLaw::Table { .. }, _) => {}
        }
        limits
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
    /// Magnitude of the crank's speed (rad/s) at which the motor balances the mean resistance.
    pub averaged: f64,
    /// Steady periodic motion.
    pub regime: Regime,
}

impl MotorChoice {
    /// Chooses the weakest motor of the catalogue that has enough power for the peak of the resistance.
    /// The power is computed with the crank's speed in the scenario.
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

    /// The limits of the motor's law that the steady motion exceeds.
    /// The start from rest is checked too, but only for a torque beyond the breakdown torque.
    pub fn limits(&self) -> Vec<MotorLimit> {
        let [slowest, fastest] = self.regime.ends();
        let mut limits = MotorLimit::of(&self.geared, [slowest, fastest], false);
        let at_start = MotorLimit::of(&self.geared, [0.0, slowest], true);
        limits.extend(at_start.into_iter().filter(|own| matches!(own, MotorLimit::BeyondBreakdown { .. })));
        limits
    }

    /// Torque (N m) on the motor's shaft at the peak of the resistance, without the torque that accelerates masses.
    pub fn peak_torque(&self) -> f64 {
        self.peak.1 / (self.geared.ratio * self.geared.efficiency)
    }

    /// Torque (N m) on the motor's shaft for the mean resistance.
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
            rotor: None,
        }
    }

    /// At rest, a linear law through the rated point gives 11.8 times the rated torque.
    /// No breakdown is assumed for a linear law without rated torque.
    /// A Kloss law is valid below the breakdown speed in a start, but not in steady motion.
    #[test]
    fn a_motion_beyond_the_stable_branch_is_told() {
        let geared = motor("a", 0.55, 2745.0).geared_to(130.0 * TAU / 60.0, 1.0);
        let ratio = geared.ratio;
        let MotorLimit::BeyondBreakdown { share, .. } = MotorLimit::of(&geared, [0.0, 10.0], true)[0] else { panic!() };
        assert!((share - 11.765).abs() < 1e-3, "{share}");
        assert_eq!(MotorLimit::of(&geared, [290.0 / ratio, 314.0 / ratio], false), vec![]);
        let fast = MotorLimit::of(&geared, [300.0 / ratio, 366.0 / ratio], false);
        assert!(matches!(fast[..], [MotorLimit::AboveSynchronous { speed, .. }] if (speed - 366.0).abs() < 1e-9));
        let unrated = Motor { rated_torque: None, ..geared.clone() };
        assert_eq!(MotorLimit::of(&unrated, [0.0, 10.0], true), vec![]);
        let law = MotorLaw::Kloss { breakdown_torque: 4.2, breakdown_slip: 0.2, synchronous_speed: 314.0 };
        let kloss = Motor { law, ..geared };
        assert_eq!(MotorLimit::of(&kloss, [0.0, 10.0], true), vec![]);
        assert!(matches!(MotorLimit::of(&kloss, [0.0, 10.0], false)[..], [MotorLimit::BelowBreakdown { .. }]));
    }

    #[test]
    fn rated_data_give_the_published_torque_line() {
        let motor = motor("a", 0.55, 2745.0);
        // The source prints 1.913 N m (rated torque), 22.51 N m (torque at rest) and -0.0716 N m s (slope).
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
