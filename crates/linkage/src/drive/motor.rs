//! Motors: torque as a function of speed, and the reducer between motor and crank.

use super::branch::{Curve, MotorBranch};

/// Torque of a motor as a function of its speed. Torque and speed are positive in the motor's driving sense.
#[derive(Clone, Debug, PartialEq)]
pub enum MotorLaw {
    /// Constant torque at all speeds.
    Constant {
        /// Torque (N m).
        torque: f64,
    },
    /// M = `at_rest` + `slope` omega.
    /// The straight line is the characteristic of a direct-current motor.
    /// The straight line also approximates the stable branch of an induction motor's characteristic.
    Linear {
        /// Torque of the straight line at standstill (N m).
        at_rest: f64,
        /// Slope of the torque with respect to the speed (N m s), negative for a stable motor.
        slope: f64,
    },
    /// Induction motor after Kloss, with the stator's resistance neglected:
    /// M = 2 `breakdown_torque` / (s / `breakdown_slip` + `breakdown_slip` / s) with the slip s = 1 - omega /
    /// `synchronous_speed`.
    /// Kloss, Archiv fuer Elektrotechnik 5 (1916).
    Kloss {
        /// Breakdown torque, the largest torque (N m).
        breakdown_torque: f64,
        /// Slip at the breakdown torque, above 0.
        breakdown_slip: f64,
        /// Synchronous speed, the speed without load (rad/s), above 0.
        synchronous_speed: f64,
    },
    /// Straight lines between measured points. Beyond the table, the first and the last line continue.
    /// Straight lines cannot overshoot, so a decreasing table gives a decreasing law.
    Table {
        /// Speeds (rad/s), ascending, at least two.
        speeds: Vec<f64>,
        /// Torques at the speeds of the table (N m).
        torques: Vec<f64>,
    },
}

impl MotorLaw {
    /// Returns the law with its torque multiplied by the factor `share` at all speeds.
    #[must_use]
    pub fn scaled(&self, share: f64) -> MotorLaw {
        match self {
            MotorLaw::Constant { torque } => MotorLaw::Constant { torque: share * torque },
            MotorLaw::Linear { at_rest, slope } => MotorLaw::Linear { at_rest: share * at_rest, slope: share * slope },
            &MotorLaw::Kloss { breakdown_torque, breakdown_slip, synchronous_speed } => {
                MotorLaw::Kloss { breakdown_torque: share * breakdown_torque, breakdown_slip, synchronous_speed }
            }
            MotorLaw::Table { speeds, torques } => MotorLaw::Table {
                speeds: speeds.clone(),
                torques: torques.iter().map(|torque| share * torque).collect(),
            },
        }
    }

    /// Torque (N m) at the motor's speed `omega` (rad/s).
    #[must_use]
    pub fn torque(&self, omega: f64) -> f64 {
        let curves = self.curves();
        let holds = |curve: &&([f64; 2], Curve)| omega <= curve.0[1];
        curves.iter().find(holds).or(curves.last()).map_or(0.0, |(_, curve)| curve.torque(omega))
    }

    /// Smooth pieces of the law, each with the speeds (rad/s) between which it is valid.
    /// Together the pieces cover all speeds.
    pub(super) fn curves(&self) -> Vec<([f64; 2], Curve)> {
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        match self {
            &MotorLaw::Constant { torque } => vec![(all, Curve::Line { at_rest: torque, slope: 0.0 })],
            &MotorLaw::Linear { at_rest, slope } => vec![(all, Curve::Line { at_rest, slope })],
            &MotorLaw::Kloss { breakdown_torque, breakdown_slip, synchronous_speed } => {
                vec![(all, Curve::Kloss { breakdown_torque, breakdown_slip, synchronous_speed })]
            }
            MotorLaw::Table { speeds, torques } => {
                let last = speeds.len().saturating_sub(2);
                let piece = |k: usize| {
                    let slope = (torques[k + 1] - torques[k]) / (speeds[k + 1] - speeds[k]);
                    let ends = [
                        if k == 0 { f64::NEG_INFINITY } else { speeds[k] },
                        if k == last { f64::INFINITY } else { speeds[k + 1] },
                    ];
                    (ends, Curve::Line { at_rest: torques[k] - slope * speeds[k], slope })
                };
                (0..=last).map(piece).collect()
            }
        }
    }
}

/// Moments of inertia of the rotor and of the reducer's shafts (kg m^2), each about its axis of rotation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShaftInertia {
    /// Rotor of the motor.
    pub rotor: f64,
    /// Input shaft of the reducer, which turns with the motor.
    pub input: f64,
    /// Intermediate shaft of the reducer, which turns `intermediate_ratio` times as fast as the crank.
    /// The value is 0 if the reducer has no intermediate shaft.
    pub intermediate: f64,
    /// Speed of the intermediate shaft divided by the speed of the crank; ignored if `intermediate` is 0.
    pub intermediate_ratio: f64,
    /// Output shaft of the reducer, which turns with the crank.
    pub output: f64,
}

/// A motor that drives the crank through a reducer.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// Torque-speed law of the motor.
    pub law: MotorLaw,
    /// Ratio of the motor's speed to that of the crank, above 0.
    pub ratio: f64,
    /// Efficiency of the reducer, above 0 and at most 1. The efficiency is the same in both directions of power flow.
    /// The efficiency applies to the motor's static torque: see [`Motor::moment_on_crank`].
    /// The efficiency does not affect the moments that accelerate the shafts.
    pub efficiency: f64,
    /// Moments of inertia of rotor and reducer.
    pub inertia: ShaftInertia,
    /// Rated torque (N m), if it is known.
    /// With a rated torque, a linear law describes an induction motor.
    /// The law is valid only below the breakdown torque, which is a multiple of the rated torque.
    pub rated_torque: Option<f64>,
}

impl Motor {
    /// Returns a motor with a reducer that has neither losses nor inertia.
    #[must_use]
    pub fn ideal(law: MotorLaw, ratio: f64) -> Self {
        Motor { law, ratio, efficiency: 1.0, inertia: ShaftInertia::default(), rated_torque: None }
    }

    /// Moment of the motor on the crank (N m) if the crank turns at `omega` (rad/s, positive in the motor's driving
    /// sense).
    /// If power flows to the crank, the moment is ratio times torque times efficiency.
    /// If power flows back, the moment is ratio times torque divided by efficiency.
    #[must_use]
    pub fn moment_on_crank(&self, omega: f64) -> f64 {
        self.branch(omega, 1.0).moment(omega)
    }

    /// Moment of inertia of rotor and reducer, reduced to the crank (kg m^2).
    /// Each part contributes its moment of inertia times (part's speed / crank's speed)^2.
    #[must_use]
    pub fn inertia_on_crank(&self) -> f64 {
        let own = &self.inertia;
        (own.rotor + own.input) * self.ratio.powi(2) + own.intermediate * own.intermediate_ratio.powi(2) + own.output
    }

    /// The smooth piece of the moment on the crank that is valid at the crank's speed `omega` (rad/s).
    /// If two pieces meet at `omega`, a positive `towards` selects the piece at higher speeds.
    /// If `towards` is not positive, the piece at lower speeds is returned.
    #[must_use]
    pub fn branch(&self, omega: f64, towards: f64) -> MotorBranch {
        let holds = |branch: &&MotorBranch| match towards > 0.0 {
            true => omega < branch.speeds[1],
            false => omega <= branch.speeds[1],
        };
        let branches = self.branches();
        *branches.iter().find(holds).or(branches.last()).expect("a law has at least one piece")
    }

    /// All smooth pieces, in ascending order of speed.
    fn branches(&self) -> Vec<MotorBranch> {
        let mut found = Vec::new();
        for ([from, to], curve) in self.law.curves() {
            // The direction of the power flow changes with the sign of the speed or torque.
            // The effect of the losses changes with this direction.
            // A piece therefore ends at zero speed and at zero torque.
            let mut ends = vec![from, to];
            if self.efficiency < 1.0 {
                let turns = [Some(0.0), curve.root()].into_iter().flatten();
                ends.extend(turns.filter(|&speed| speed > from && speed < to));
                ends.sort_by(f64::total_cmp);
                ends.dedup();
            }
            found.extend(
                ends.windows(2).map(|pair| MotorBranch::of(self.ratio, self.efficiency, curve, [pair[0], pair[1]])),
            );
        }
        found
    }

    /// Speed of the crank (rad/s) at stable equilibrium.
    /// At stable equilibrium the motor's moment equals `resistance` (N m) and decreases with increasing speed.
    /// If there are several equilibrium speeds, the largest speed is returned. If there is no such speed, the result is
    /// `None`.
    #[must_use]
    pub fn steady_speed(&self, resistance: f64) -> Option<f64> {
        self.branches().iter().rev().find_map(|branch| branch.steady_speed(resistance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINEAR: MotorLaw = MotorLaw::Linear { at_rest: 22.51, slope: -0.0716 };
    const KLOSS: MotorLaw = MotorLaw::Kloss { breakdown_torque: 5.0, breakdown_slip: 0.25, synchronous_speed: 100.0 };

    #[test]
    fn at_the_steady_speed_the_moment_is_the_resistance() {
        let motor = Motor::ideal(LINEAR, 2745.0 / 130.0);
        let steady = motor.steady_speed(17.0).unwrap();
        assert!((motor.moment_on_crank(steady) - 17.0).abs() < 1e-12);
        // Without load the motor runs at its synchronous speed, 22.51 / 0.0716 = 314.385 rad/s.
        assert!((motor.steady_speed(0.0).unwrap() * motor.ratio - 314.385_474_860_335_2).abs() < 1e-10);
        let kloss = Motor { efficiency: 0.9, ..Motor::ideal(KLOSS, 10.0) };
        for resistance in [-20.0, 0.0, 20.0, 44.9] {
            let steady = kloss.steady_speed(resistance).unwrap();
            assert!((kloss.moment_on_crank(steady) - resistance).abs() < 1e-10, "{resistance}");
        }
        // The breakdown torque on the crank is 10 * 0.9 * 5 = 45 N m, so there is no equilibrium at 45.1 N m.
        assert_eq!(kloss.steady_speed(45.1), None);
        assert_eq!(Motor::ideal(MotorLaw::Constant { torque: 3.0 }, 1.0).steady_speed(2.0), None);
    }

    #[test]
    fn kloss_has_its_known_points() {
        // The torque is largest at the breakdown slip and zero at synchronous speed.
        // At standstill the torque is 2 M / (1 / s + s) = 10 / 4.25.
        assert!((KLOSS.torque(75.0) - 5.0).abs() < 1e-14);
        assert_eq!(KLOSS.torque(100.0), 0.0);
        assert!((KLOSS.torque(0.0) - 10.0 / 4.25).abs() < 1e-14);
        assert!((KLOSS.torque(125.0) + 5.0).abs() < 1e-14);
    }

    #[test]
    fn a_table_is_interpolated_and_extrapolated() {
        let table = MotorLaw::Table { speeds: vec![0.0, 10.0, 30.0], torques: vec![4.0, 6.0, 0.0] };
        let torques: Vec<f64> = [-5.0, 0.0, 5.0, 10.0, 20.0, 30.0, 40.0].map(|omega| table.torque(omega)).to_vec();
        for (found, expected) in torques.iter().zip([3.0, 4.0, 5.0, 6.0, 3.0, 0.0, -3.0]) {
            assert!((found - expected).abs() < 1e-14, "{torques:?}");
        }
        // The stable equilibrium is where the torque decreases with speed.
        let steady = Motor::ideal(table, 2.0).steady_speed(10.0).unwrap();
        assert!((steady - 20.0 / 3.0).abs() < 1e-14, "{steady}");
    }

    #[test]
    fn losses_reduce_power_in_both_directions() {
        let motor = Motor { efficiency: 0.8, ..Motor::ideal(LINEAR, 10.0) };
        for omega in [-3.0, 5.0, 31.0, 32.0, 40.0] {
            let (given, taken) = (motor.law.torque(10.0 * omega) * 10.0 * omega, motor.moment_on_crank(omega) * omega);
            assert!(given > taken, "{omega}: {given} {taken}");
            let ratio = if given > 0.0 { taken / given } else { given / taken };
            assert!((ratio - 0.8).abs() < 1e-12, "{omega}");
        }
    }

    #[test]
    fn branches_meet_and_cover_all_speeds() {
        let table = MotorLaw::Table { speeds: vec![0.0, 10.0, 30.0], torques: vec![4.0, 6.0, 0.0] };
        let motor = Motor { efficiency: 0.9, ..Motor::ideal(table, 2.0) };
        let branches = motor.branches();
        assert_eq!(branches[0].speeds[0], f64::NEG_INFINITY);
        assert_eq!(branches[branches.len() - 1].speeds[1], f64::INFINITY);
        for pair in branches.windows(2) {
            let at = pair[0].speeds[1];
            assert_eq!(at, pair[1].speeds[0]);
            let jump = (pair[0].moment(at) - pair[1].moment(at)).abs();
            // The moment jumps only at standstill, where the direction of the power flow changes.
            assert!(jump < 1e-12 || at == 0.0, "{at} {jump}");
            assert_eq!(motor.branch(at, 1.0), pair[1]);
            assert_eq!(motor.branch(at, -1.0), pair[0]);
        }
    }

    #[test]
    fn shaft_inertias_scale_with_the_square_of_their_ratio() {
        let inertia =
            ShaftInertia { rotor: 1e-3, input: 2e-3, intermediate: 5e-2, intermediate_ratio: 4.0, output: 0.7 };
        let motor = Motor { inertia, ..Motor::ideal(LINEAR, 20.0) };
        assert!((motor.inertia_on_crank() - (3e-3 * 400.0 + 5e-2 * 16.0 + 0.7)).abs() < 1e-14);
    }
}
