//! Friction in the complete system: M q'' = Q + J^T lambda + F(lambda).
//!
//! The friction of a joint is a function of its multipliers. In a revolute joint, the moment of friction is mu r
//! |lambda|.
//! The multipliers of a prismatic joint are its normal force and its moment; the friction is mu times the larger of
//! |lambda_1| and 2 |lambda_2| / l.
//! Newton's method solves for all multipliers together and, in a free motion, for the accelerations of the free drives.
//! A free drive has the equation lambda = T - I alpha, with the moment T and the inertia I of its motor, if it has one.
//! The equation of motion with constraints is equation 6.3.18 of E. J. Haug, Computer Aided Kinematics and Dynamics of
//! Mechanical Systems, vol. 1, Allyn and Bacon 1989; F is derived here.

use super::system::System;
use crate::motion::side::Held;
use crate::sentences;
use linkage::case::{Friction, FrictionSeat};
use linkage::error::Result;
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, cross};
use linkage::mechanism::{GROUND, LinkId};

/// Largest number of Newton's steps.
const MOST: usize = 40;
/// If Newton's method does not converge, the friction is increased in steps from zero to its full value.
/// `LEAST` is the smallest of these steps, as a fraction of the full value.
const LEAST: f64 = 1e-3;
/// The multipliers are settled if they change by less than this fraction of the largest one.
const SETTLED: f64 = 1e-14;
/// A change below this fraction of the largest multiplier is rounding error if the changes no longer decrease.
const ROUNDING: f64 = 1e-10;

/// Data of a free motion: the columns V, the indices of the free drives, and the data of motor, loads and losses.
/// A column of V contains the velocities of all links for a unit rate of one drive.
pub(super) struct Freedom<'a> {
    pub(super) columns: &'a [f64],
    pub(super) free: &'a [usize],
    pub(super) held: &'a Held,
}

/// Sum of the normal forces of a joint as a function of its multipliers, and the derivatives of the sum with respect to
/// the multipliers.
/// For a transmission: the power lost in the transmission, divided by the lever and the speed.
fn of_multipliers(friction: &Friction, own: &[f64], slides: bool, sense: f64) -> (f64, [f64; 2]) {
    if let FrictionSeat::Mesh { losses, .. } = friction.seat {
        // Power that flows to the second member, divided by a positive factor.
        let power = own[0] * losses.lever * sense;
        let slope = if power < 0.0 { -losses.lost[1] } else { losses.lost[0] } * (losses.lever * sense).signum();
        return (slope * own[0], [slope, 0.0]);
    }
    if !slides {
        let size = own[0].hypot(own[1]);
        return (size, if size > 0.0 { [own[0] / size, own[1] / size] } else { [0.0; 2] });
    }
    let guide = friction.guide();
    match guide > 0.0 && 2.0 * own[1].abs() > guide * own[0].abs() {
        true => (2.0 * own[1].abs() / guide, [0.0, 2.0 * own[1].signum() / guide]),
        false => (own[0].abs(), [own[0].signum(), 0.0]),
    }
}

impl System<'_> {
    /// Solves for the multipliers with friction. Newton's method starts from the multipliers without friction.
    /// In a free motion, also solves for the accelerations and stores them in [`System::second`].
    /// The senses of sliding come from the velocities or, in a free motion, from `freedom`.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`](linkage::error::ErrorKind::Numeric) if the method does not converge.
    pub(super) fn rub(&mut self, freedom: Option<&Freedom>) -> Result<()> {
        let case = self.case;
        let levers: Vec<f64> = case
            .frictions()
            .map(|friction| {
                let sense = match freedom {
                    Some(own) => own.held.senses[friction.index],
                    None => friction.rate(&self.motions),
                };
                if sense == 0.0 { 0.0 } else { -sense.signum() * friction.lever() }
            })
            .collect();
        let rows = case.mechanism.equations();
        self.lambda[..rows].iter_mut().zip(&self.beside).for_each(|(own, beside)| *own -= beside);
        let (mut share, mut part) = (0.0, 1.0);
        while share < 1.0 {
            let before = (self.lambda.clone(), self.second.clone(), self.inputs.clone());
            let next = f64::smaller(share + part, 1.0);
            let own: Vec<f64> = levers.iter().map(|lever| next * lever).collect();
            if self.find_multipliers(&own, freedom) {
                (share, part) = (next, 2.0 * part);
                continue;
            }
            (self.lambda, self.second, self.inputs) = before;
            part *= 0.5;
            if part < LEAST {
                let error = self.lost(sentences::FRICTION_HAS_NO_EQUILIBRIUM);
                return Err(error.help(sentences::LOWER_A_COEFFICIENT_OF_FRICTION));
            }
        }
        self.lambda[..rows].iter_mut().zip(&self.beside).for_each(|(own, beside)| *own += beside);
        Ok(())
    }

    /// Newton's method for the multipliers. Returns whether it has converged.
    /// `levers` is the friction of each joint, with its sign, divided by the sum of the joint's normal forces.
    fn find_multipliers(&mut self, levers: &[f64], freedom: Option<&Freedom>) -> bool {
        let (case, n) = (self.case, self.q.len());
        let free = freedom.map_or(&[][..], |own| own.free);
        let (size, first) = (n + free.len(), case.mechanism.row_of_drive(0));
        let (mut matrix, mut right, mut last) = (Lu::new(size), vec![0.0; size], f64::INFINITY);
        for _ in 0..MOST {
            self.find_lines();
            matrix.clear();
            // The residual M q'' - Q - J^T lambda - F, and the matrix J^T + dF / d lambda.
            for (link, body) in case.mechanism.links().entries().skip(1) {
                let (i, load) = (3 * (link.index() - 1), self.loads[link]);
                right[i] = body.mass * (self.second[i] - case.gravity.x) - load.force.x;
                right[i + 1] = body.mass * (self.second[i + 1] - case.gravity.y) - load.force.y;
                right[i + 2] = body.inertia * self.second[i + 2] - load.moment;
            }
            for (row, column, value) in self.jacobian.entries() {
                matrix.add(column, row, value);
                right[column] -= value * self.lambda[row];
            }
            for (friction, &lever) in case.frictions().zip(levers) {
                let joint = &case.mechanism.joints()[friction.joint];
                let (rows, axis, ends) = match friction.seat {
                    FrictionSeat::Joint { .. } => {
                        let axis = joint.axis_on(joint.first.link).map(|axis| self.along(joint.first.link, axis));
                        let ends = [(joint.first.link, -1.0), (joint.second.link, 1.0)];
                        (case.mechanism.rows(friction.joint), axis, ends)
                    }
                    FrictionSeat::Mesh { transmission, links: [carrier, first], losses } => {
                        let row = case.mechanism.row_of_transmission(transmission);
                        (row..row + 1, None, [(carrier, -1.0 / losses.per), (first, 1.0 / losses.per)])
                    }
                };
                let own: Vec<f64> = rows.clone().map(|row| self.lambda[row] + self.beside[row]).collect();
                // The sense of sliding and the lever have opposite signs.
                let (normal, slopes) = of_multipliers(&friction, &own, joint.slides(), -lever);
                let place = self.centre(joint.second.link) + self.arm(joint.second.link, joint.second.local);
                for (link, sign) in ends {
                    if link == GROUND {
                        continue;
                    }
                    let i = 3 * (link.index() - 1);
                    let mut put = |i: usize, value: f64| {
                        right[i] -= value * normal;
                        rows.clone().zip(slopes).for_each(|(row, slope)| matrix.add(i, row, value * slope));
                    };
                    match axis {
                        None => put(i + 2, sign * lever),
                        Some(axis) => {
                            let force = axis * (sign * lever);
                            put(i, force.x);
                            put(i + 1, force.y);
                            put(i + 2, cross(place - self.centre(link), force));
                        }
                    }
                }
            }
            if let Some(Freedom { columns, held, .. }) = freedom {
                for (k, &drive) in free.iter().enumerate() {
                    for (i, v) in columns[drive * n..][..n].iter().enumerate() {
                        let body = &case.mechanism.links()[LinkId(1 + i / 3)];
                        matrix.add(i, n + k, -v * if i % 3 == 2 { body.inertia } else { body.mass });
                    }
                    let [moment, inertia] = if drive == 0 { [held.motor, held.added] } else { [0.0; 2] };
                    let alpha = self.inputs[drive].acceleration;
                    matrix.add(n + k, first + drive, 1.0);
                    matrix.add(n + k, n + k, inertia);
                    right[n + k] = moment - inertia * alpha - self.lambda[first + drive];
                }
            }
            if !matrix.factor() {
                return false;
            }
            matrix.solve(&mut right);
            let largest = self.lambda.iter().fold(0.0f64, |most, own| most.larger(own.abs()));
            let change = right[..n].iter().fold(0.0f64, |most, own| most.larger(own.abs()));
            self.lambda.iter_mut().zip(&right).for_each(|(own, step)| *own += step);
            if let Some(Freedom { columns, .. }) = freedom {
                for (k, &drive) in free.iter().enumerate() {
                    self.inputs[drive].acceleration += right[n + k];
                    let column = &columns[drive * n..][..n];
                    self.second.iter_mut().zip(column).for_each(|(own, v)| *own += v * right[n + k]);
                }
            }
            if change <= SETTLED * largest || (change <= ROUNDING * largest && !(change < 0.5 * last)) {
                return true;
            }
            last = change;
        }
        false
    }
}
