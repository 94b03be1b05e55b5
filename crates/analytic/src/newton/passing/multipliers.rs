//! Multipliers near a change point.
//!
//! The Jacobian is singular at the change point. Multipliers generally grow with the inverse of the distance from the
//! change point.
//! The reason is that the constraints also permit a motion along the other branch, so that they do not resist a load
//! that does work along this branch.
//! The product of multiplier and distance is always smooth.

use super::WITHOUT_POLE;
use super::window::{Window, neville};
use crate::newton::system::System;
use crate::sentences;
use linkage::drive::Wrench;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Motion};

/// The product of multiplier and distance is extrapolated to the change point; below a threshold it counts as zero.
/// The threshold is the sum of two terms.
/// The first term is `NOISE` times the change of the product if the innermost poses are left out.
/// The second term is `LEAST` times the largest product.
const NOISE: f64 = 16.0;
const LEAST: f64 = 1e-12;

/// If a pose is nearer to a change point than this (rad), multipliers with a nonzero product are not reported.
/// The position of the change point has an error of about 1e-14 rad.
/// The relative error of these multipliers is the error of the position, divided by the distance.
const NEAREST: f64 = 1e-7;

/// Writes the loads that act on the links, for given motions and angles (rad) of the links.
type Loads<'a> = &'a mut dyn FnMut(&[Motion], &[f64], &mut [Wrench]);

impl Window {
    /// Writes the multipliers to the system, for the crank angle `angle` (rad) and the crank's angular velocity and
    /// acceleration.
    /// `loads` finds the loads on all links.
    /// In free motion, `shaft` contains the moment on the crank and the moment of inertia that turns with it.
    /// In free motion, every pose has the acceleration that balances its crank at the given angular velocity.
    pub(in crate::newton) fn multipliers(
        &self,
        system: &mut System,
        [angle, omega, alpha]: [f64; 3],
        shaft: Option<[f64; 2]>,
        loads: Loads,
    ) -> Result<()> {
        let (q, rate, second) = (system.q.clone(), system.rate.clone(), system.second.clone());
        let x = angle - self.at;
        let drive = system.case.mechanism.row_of_drive(0);
        let mut all: Vec<Vec<f64>> = Vec::with_capacity(self.spots.len());
        for spot in &self.spots {
            system.q.copy_from_slice(&spot.q);
            system.assemble();
            if !system.jacobian.factor() {
                return Err(system.lost(sentences::THE_JACOBIAN_IS_SINGULAR_THERE));
            }
            let mut at = |system: &mut System, alpha: f64| {
                for (i, (slope, curve)) in spot.slope.iter().zip(&spot.curve).enumerate() {
                    (system.rate[i], system.second[i]) = (slope * omega, slope * alpha + curve * omega * omega);
                }
                system.find_loads(|_, motions, angles, out| loads(motions, angles, out));
                system.multipliers();
                system.lambda.clone()
            };
            let mut lambda = at(system, alpha);
            if let Some([moment, inertia]) = shaft {
                // Multipliers are linear in the acceleration. `gain` is the increase of the multipliers per unit of
                // acceleration.
                // The acceleration that balances the crank follows from `gain`.
                let unit = 1.0 + alpha.abs() + omega * omega;
                let gain: Vec<f64> =
                    at(system, alpha + unit).iter().zip(&lambda).map(|(more, own)| (more - own) / unit).collect();
                let more = (moment - inertia * alpha - lambda[drive]) / (gain[drive] + inertia);
                lambda.iter_mut().zip(&gain).for_each(|(own, gain)| *own += more * gain);
            }
            all.push(lambda);
        }
        (system.q, system.rate, system.second) = (q, rate, second);
        let found = self.beside(x, &all);
        let Some(found) = found else {
            let at = system.case.told(system.case.crank().from_coordinate(angle));
            let message = sentences::this_is_a_change_point_and_towards_it_reactions(&at);
            return Err(Error::new(ErrorKind::Numeric, message).at_input(at).help(WITHOUT_POLE));
        };
        system.lambda = found;
        Ok(())
    }

    /// Multipliers at the distance `x`, from the multipliers at all poses.
    /// `None` if a multiplier grows without bound and `x` is too small.
    fn beside(&self, x: f64, all: &[Vec<f64>]) -> Option<Vec<f64>> {
        let distances = &self.places;
        let nearest = distances.iter().fold(f64::INFINITY, |least, x| least.smaller(x.abs()));
        let outer: Vec<usize> = (0..all.len()).filter(|&k| distances[k].abs() > 1.5 * nearest).collect();
        let outer_distances: Vec<f64> = outer.iter().map(|&k| distances[k]).collect();
        let product = |k: usize, index: usize| all[k][index] * distances[k];
        let largest = (0..all.len()).flat_map(|k| (0..all[k].len()).map(move |index| (k, index)));
        let largest = largest.fold(0.0f64, |most, (k, index)| most.larger(product(k, index).abs()));
        let of = |index: usize| {
            let there = neville(distances, |k| product(k, index), 0.0);
            let without = neville(&outer_distances, |k| product(outer[k], index), 0.0);
            if there.abs() <= NOISE * (there - without).abs() + LEAST * largest {
                return Some(neville(distances, |k| all[k][index], x));
            }
            let is_there = !(x.abs() > NEAREST);
            (!is_there).then(|| neville(distances, |k| product(k, index), x) / x)
        };
        (0..all[0].len()).map(of).collect()
    }
}
