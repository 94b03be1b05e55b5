//! Discretisation error of an engine, from its own runs at three step sizes.
//!
//! With differences e1 = y(2h) - y(h) and e2 = y(h) - y(h/2), the observed order is p = log2(|e1| / |e2|), and the error
//! of the run at h is estimated as |e2| 2^p / (2^p - 1) (Richardson), times a safety factor: 1.25 with the formal order where
//! the observed one is as good as that, else 3 with the smaller of the two (Oberkampf and Roy, "Verification and
//! validation in scientific computing", 2010, section 8.7; grid convergence index of Roache and ASME V&V 20). They allow a
//! tenth of the order for 1.25; here it is a fiftieth, because errors of two orders can cancel in the differences.

use super::residual::differences;
use crate::error::Result;
use crate::math::statistics::rms;
use crate::tolerance::{Basis, Tolerance};
use crate::trajectory::{Channel, Trajectory};

/// Share of the formal order within which the observed one is as good. With a tenth, random chains with an order of 1.91 had
/// errors 1.1 times the bound.
const AS_GOOD: f64 = 0.02;

/// What three runs say about the error of the middle one, in one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Observed order; NaN where the differences are rounding.
    pub observed: f64,
    /// Order that the method should have.
    pub formal: f64,
    /// Estimated largest error of the middle run, safety factor not included, in the channel's unit.
    pub error: f64,
    /// Safety factor.
    pub safety: f64,
}

impl Convergence {
    /// From the values of one channel at double, single and half step. Differences below `noise` (in the channel's unit)
    /// are rounding and show no order.
    #[must_use]
    pub fn of(double: &[f64], single: &[f64], half: &[f64], periodic: bool, formal: f64, noise: f64) -> Self {
        let coarse = differences(double, single, periodic);
        let fine = differences(single, half, periodic);
        let largest = fine.iter().fold(0.0, |max: f64, e| max.max(e.abs()));
        let (before, after) = (rms(coarse), rms(fine));
        let observed = if after <= noise { f64::NAN } else { (before / after).log2() };
        let (order, safety) = if (observed - formal).abs() <= AS_GOOD * formal {
            (formal, 1.25)
        } else if observed.is_nan() {
            (formal, 3.0)
        } else {
            (observed.clamp(0.5, formal), 3.0)
        };
        let error = largest / (1.0 - 0.5f64.powf(order));
        Convergence { observed, formal, error, safety }
    }

    /// The same for a channel of three trajectories on one grid; `None` if one of them does not have it.
    #[must_use]
    pub fn of_channel(runs: [&Trajectory; 3], channel: &Channel, formal: f64, noise: f64) -> Option<Self> {
        let [double, single, half] = [runs[0].column(channel)?, runs[1].column(channel)?, runs[2].column(channel)?];
        Some(Convergence::of(double, single, half, channel.kind.periodic, formal, noise))
    }

    /// Whether the runs converge as they should, so that the estimate can be trusted.
    #[must_use]
    pub fn is_trusted(&self) -> bool {
        self.observed.is_nan() || self.observed >= 0.5 * self.formal
    }

    /// Bound on the error of the middle run at step `step` (s); `noise` is the rounding added to it, in the channel's unit.
    #[must_use]
    pub fn tolerance(&self, step: f64, noise: f64) -> Tolerance {
        let Convergence { observed, formal, safety, .. } = *self;
        Tolerance {
            abs: safety * self.error + noise,
            rel: 0.0,
            basis: Basis::Truncation { observed, formal, step, safety },
        }
    }
}

/// Order observed between two runs at steps h and h/2 whose true errors are known from a reference: log2 of the
/// quotient of their root mean squares.
///
/// # Errors
/// If the grids differ.
pub fn observed_order(reference: &Trajectory, runs: [&Trajectory; 2], channel: &Channel) -> Result<Option<f64>> {
    let error = |run: &Trajectory| -> Result<Option<f64>> {
        Ok(super::difference(reference, run)?.column(channel).map(|values| rms(values.iter().copied())))
    };
    Ok(error(runs[0])?.zip(error(runs[1])?).map(|(coarse, fine)| (coarse / fine).log2()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs(order: i32, exact: f64) -> [Vec<f64>; 3] {
        [2.0f64, 1.0, 0.5].map(|h| vec![exact + 1e-3 * h.powi(order), exact - 2e-3 * h.powi(order)])
    }

    #[test]
    fn second_order_is_seen_and_its_error_estimated_exactly() {
        let [double, single, half] = runs(2, 7.0);
        let found = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        assert!((found.observed - 2.0).abs() < 1e-9 && found.safety == 1.25);
        assert!((found.error - 2e-3).abs() < 1e-12);
        assert!((found.tolerance(1.0, 0.0).bound(1.0) - 2.5e-3).abs() < 1e-12);
    }

    #[test]
    fn first_order_where_second_is_due_is_not_trusted_less_is_guarded() {
        let [double, single, half] = runs(1, 7.0);
        let found = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        assert!(found.is_trusted() && found.safety == 3.0 && (found.error - 2e-3).abs() < 1e-12);
        let stuck = Convergence::of(&[1.0], &[0.9], &[0.8], false, 2.0, 0.0);
        assert!(!stuck.is_trusted());
    }

    #[test]
    fn rounding_shows_no_order() {
        let found = Convergence::of(&[1.0], &[1.0 + 1e-15], &[1.0], false, 2.0, 1e-13);
        assert!(found.observed.is_nan() && found.is_trusted() && found.error < 2e-15);
    }
}
