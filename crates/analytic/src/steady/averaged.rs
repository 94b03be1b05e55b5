//! The averaged model in closed form: a linear motor against constant coefficients.

use crate::reduced::ReducedModel;
use crate::reduced::means::Means;
use linkage::drive::{Motor, MotorLaw};

/// Rounding may put a steady speed beyond the end of the motor's line. A relative excess of up to this value is
/// accepted.
const SAME: f64 = 1e-12;

/// Motion from rest under `I domega/dt = M0 - B omega - R`.
/// I and R are the means of inertia and resistance over one period. The variation of I and R is neglected.
/// M0 - B omega is the straight line of the motor's moment on the crank.
/// Then omega = omega_s (1 - exp(-t / T)) with T = I / B and omega_s = (M0 - R) / B.
///
/// For a linear law of the motor and power flow to the crank, B = -k ratio^2 efficiency, where k is the slope of the
/// law.
/// Speeds and angles are positive in the motor's sense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Averaged {
    /// Time constant T (s). After this time the speed is 1 - 1 / e = 63.2 % of the steady speed.
    pub time_constant: f64,
    /// Steady speed omega_s of the crank (rad/s), above zero.
    pub steady_speed: f64,
}

impl Averaged {
    /// The model of a motor that drives a constant moment of inertia against a constant moment of resistance.
    /// `inertia` is the moment of inertia on the crank, including rotor, reducer and flywheel (kg m^2).
    /// `resistance` is the moment of resistance on the crank (N m), positive where the motor must work against it.
    ///
    /// `None` where this closed form does not exist: the law is not linear, or the motor does not start against the
    /// resistance.
    /// Also `None` if the reducer has losses and the resistance drives the motor beyond its no-load speed.
    /// In this case, the motor's line has a bend at the no-load speed.
    #[must_use]
    pub fn of(motor: &Motor, inertia: f64, resistance: f64) -> Option<Self> {
        let MotorLaw::Linear { .. } = motor.law else { return None };
        let steady_speed = motor.steady_speed(resistance)?;
        let line = motor.branch(0.0, 1.0);
        let holds = steady_speed > 0.0 && steady_speed <= line.speeds[1] * (1.0 + SAME);
        (holds && inertia > 0.0).then(|| Averaged { time_constant: inertia / -line.slope(0.0), steady_speed })
    }

    /// The model of a motor that drives a reduced mechanism, whose means over a period are `means`.
    ///
    /// `None` under the conditions under which [`Averaged::of`] returns `None`.
    #[must_use]
    pub fn over_turn(model: &ReducedModel, motor: &Motor, means: &Means) -> Option<Self> {
        Averaged::of(motor, means.inertia + model.added_inertia(), model.sense * means.resistance)
    }
}
