//! Smooth pieces of the motor's moment on the crank. The equations of motion are integrated piece by piece.

use crate::math::KeepNan;

/// A smooth torque-speed curve of a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Curve {
    Line { at_rest: f64, slope: f64 },
    Kloss { breakdown_torque: f64, breakdown_slip: f64, synchronous_speed: f64 },
}

impl Curve {
    #[inline]
    pub(super) fn torque(&self, omega: f64) -> f64 {
        match *self {
            Curve::Line { at_rest, slope } => at_rest + slope * omega,
            // The formula for Kloss's curve below does not divide by the slip, so zero slip needs no special case.
            Curve::Kloss { breakdown_torque, breakdown_slip: b, synchronous_speed } => {
                let slip = 1.0 - omega / synchronous_speed;
                2.0 * breakdown_torque * slip * b / (slip * slip + b * b)
            }
        }
    }

    #[inline]
    fn slope(&self, omega: f64) -> f64 {
        match *self {
            Curve::Line { slope, .. } => slope,
            Curve::Kloss { breakdown_torque, breakdown_slip: b, synchronous_speed } => {
                let slip = 1.0 - omega / synchronous_speed;
                let sum = slip * slip + b * b;
                -2.0 * breakdown_torque * b * (b * b - slip * slip) / (sum * sum) / synchronous_speed
            }
        }
    }

    /// Speed at which the torque is zero; `None` if there is no such speed.
    pub(super) fn root(&self) -> Option<f64> {
        match *self {
            Curve::Line { slope: 0.0, .. } => None,
            Curve::Line { at_rest, slope } => Some(-at_rest / slope),
            Curve::Kloss { synchronous_speed, .. } => Some(synchronous_speed),
        }
    }

    /// Speed at which the torque is `torque`, on a branch where the torque decreases with increasing speed.
    fn stable_speed(&self, torque: f64) -> Option<f64> {
        match *self {
            Curve::Line { at_rest, slope } if slope < 0.0 => Some((torque - at_rest) / slope),
            Curve::Line { .. } => None,
            // With the slip s, x = s / b and the breakdown torque M: torque * (x + 1 / x) = 2 M.
            // The smaller of the two roots x is used, in a form without cancellation.
            Curve::Kloss { breakdown_torque, breakdown_slip, synchronous_speed } => {
                let share = torque / breakdown_torque;
                let root = (1.0 - share * share).larger(0.0).sqrt();
                (share.abs() <= 1.0).then(|| synchronous_speed * (1.0 - breakdown_slip * share / (1.0 + root)))
            }
        }
    }
}

/// One smooth piece of the motor's moment on the crank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorBranch {
    curve: Curve,
    ratio: f64,
    /// Factor of the moment due to the reducer's losses. If power flows to the crank, the factor is the efficiency.
    /// If power flows back to the motor, the factor is the reciprocal of the efficiency.
    factor: f64,
    /// Speeds of the crank (rad/s) between which the piece is valid. Outside this interval the piece continues
    /// smoothly.
    pub speeds: [f64; 2],
}

impl MotorBranch {
    /// The piece of a curve between two speeds of the motor (rad/s), converted to the crank by a reducer of this ratio
    /// and efficiency.
    /// Torque and speed do not change sign on the piece.
    pub(super) fn of(ratio: f64, efficiency: f64, curve: Curve, ends: [f64; 2]) -> Self {
        let inside = match ends {
            [from, to] if from.is_finite() && to.is_finite() => (from + to) / 2.0,
            [from, _] if from.is_finite() => from + 1.0,
            [_, to] if to.is_finite() => to - 1.0,
            _ => 1.0,
        };
        let drives = curve.torque(inside) * inside >= 0.0;
        let factor = if drives { efficiency } else { 1.0 / efficiency };
        MotorBranch { curve, ratio, factor, speeds: ends.map(|speed| speed / ratio) }
    }

    /// Moment on the crank (N m) at the crank's speed `omega` (rad/s).
    #[inline]
    #[must_use]
    pub fn moment(&self, omega: f64) -> f64 {
        self.ratio * self.factor * self.curve.torque(self.ratio * omega)
    }

    /// Derivative of the moment on the crank with respect to the crank's speed (N m s).
    #[inline]
    #[must_use]
    pub fn slope(&self, omega: f64) -> f64 {
        self.ratio * self.ratio * self.factor * self.curve.slope(self.ratio * omega)
    }

    /// Speed of the crank (rad/s) at which the moment on this piece is `resistance` (N m) and decreases with increasing
    /// speed.
    pub(super) fn steady_speed(&self, resistance: f64) -> Option<f64> {
        let speed = self.curve.stable_speed(resistance / (self.ratio * self.factor))? / self.ratio;
        // The check allows a speed that exceeds an end of the piece by a rounding error.
        let slack = 4.0 * f64::EPSILON * speed.abs();
        (speed >= self.speeds[0] - slack && speed <= self.speeds[1] + slack).then_some(speed)
    }
}

#[cfg(test)]
mod tests {
    use crate::drive::{Motor, MotorLaw};

    #[test]
    fn the_slope_is_the_derivative_of_the_moment() {
        let kloss = MotorLaw::Kloss { breakdown_torque: 5.0, breakdown_slip: 0.25, synchronous_speed: 100.0 };
        let motor = Motor { efficiency: 0.9, ..Motor::ideal(kloss, 3.0) };
        for omega in [-4.0, 3.0, 20.0, 25.1, 33.0, 36.0] {
            let branch = motor.branch(omega, 1.0);
            let slope = (branch.moment(omega + 1e-4) - branch.moment(omega - 1e-4)) / 2e-4;
            assert!((slope - branch.slope(omega)).abs() < 1e-7, "{omega}: {slope} {}", branch.slope(omega));
        }
    }
}
