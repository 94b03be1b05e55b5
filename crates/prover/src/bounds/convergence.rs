//! Error of an engine, estimated from its runs at three resolutions and from runs with fewer sweeps.
//!
//! Let y(h) be the result at step h, e1 = y(2h) - y(h) and e2 = y(h) - y(h/2).
//! The observed order is p = log2(|e1| / |e2|).
//! The error of the run at h is estimated as |e2| 2^p / (2^p - 1) (Richardson), times a safety factor.
//! If the observed order agrees with the formal order, p is the formal order and the factor is 1.25.
//! If the two orders disagree, p is the smaller order and the factor is 3 (Oberkampf and Roy, "Verification and
//! validation in scientific computing", 2010, section 8.7; grid convergence index of Roache and ASME V&V 20).
//! Oberkampf and Roy use the factor 1.25 if the observed order differs from the formal order by up to a tenth of the
//! formal order.
//! In this module the observed order may deviate by only a fiftieth, because errors of two orders can cancel in the
//! differences.

use super::other_sweeps::{self, OtherSweeps};
use crate::tolerance::{BoundBasis, BoundOrigin, Parts, Tolerance};
use linkage::error::Result;
use linkage::math::statistics::{differences, rms};
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::{Channel, Trajectory};

/// If the observed order deviates from the formal order by at most this fraction of the formal order, the smaller
/// safety factor applies.
/// With a limit of a tenth, random chains of dyads with an observed order of 1.91 had errors of 1.1 times the bound.
const AS_GOOD: f64 = 0.02;

/// If the observed order deviates from the formal order by more than this fraction of the formal order, the runs are
/// not extrapolated to their limit.
const BEARS_OUT: f64 = 0.1;

/// Runs of one engine on one grid.
#[derive(Clone, Copy, Debug)]
pub struct Ladder<'a> {
    /// Runs at double, single and half the step (or accuracy).
    pub resolutions: [&'a Trajectory; 3],
    /// Runs with the step of the middle run and with other numbers of sweeps than the middle run.
    pub other_sweeps: OtherSweeps<&'a Trajectory>,
}

/// Estimate of the error of the middle run in one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Convergence {
    /// Observed order of convergence. NaN if the difference between single and half step is only rounding.
    pub observed: f64,
    /// Order of convergence that the method has in theory.
    pub formal: f64,
    /// Estimated largest error of the middle run, without safety factor, in the channel's unit.
    pub error: f64,
    /// Safety factor.
    pub safety: f64,
    /// Iteration error of the middle run, without safety factor, in the channel's unit; 0 for an engine that does not
    /// iterate.
    pub iteration: f64,
}

impl Convergence {
    /// The estimate from the values of one channel at double, single and half step.
    /// Differences below `noise` (in the channel's unit) are rounding errors and show no order.
    pub fn of(double: &[f64], single: &[f64], half: &[f64], periodic: bool, formal: f64, noise: f64) -> Self {
        let coarse = differences(double, single, periodic);
        let fine = differences(single, half, periodic);
        let largest = largest_size(&fine);
        let (before, after) = (rms(&coarse), rms(&fine));
        let quotient = (before / after).log2();
        // `observed` is NaN if the difference between single and half step is only rounding.
        // If the quotient of the differences is NaN and rounding is not the reason, the runs count as not convergent.
        let observed = match quotient.is_nan() {
            _ if after <= noise => f64::NAN,
            true => f64::NEG_INFINITY,
            false => quotient,
        };
        let (order, safety) = if (observed - formal).abs() <= AS_GOOD * formal {
            (formal, 1.25)
        } else if observed.is_nan() {
            (formal, 3.0)
        } else {
            (observed.clamp(0.5, formal), 3.0)
        };
        // If the observed order is below half of the formal order, the error may be as large as the coarser difference.
        // If only the finer difference is rounding, the coarser difference gives the estimate. If the observed order
        // exceeds the formal order by more than one, the coarser difference gives a lower limit of the estimate. The
        // finer difference is then too small: errors of several orders cancel in it, as may occur with few instants.
        let before = largest_size(&coarse);
        let largest = match observed {
            _ if observed.is_nan() => largest.larger(before * 0.5f64.powf(order)),
            _ if observed < 0.5 * formal => largest.larger(before),
            _ if observed > formal + 1.0 => largest.larger(before * 0.5f64.powf(formal)),
            _ => largest,
        };
        let error = largest / (1.0 - 0.5f64.powf(order));
        Convergence { observed, formal, error, safety, iteration: 0.0 }
    }

    /// This estimate with the safety factor for runs that were extrapolated `times` times.
    /// Extrapolation cancels only errors that are a power series in the step.
    /// Errors near a jump of a load, or near a knot of the load's table, are not a power series in the step.
    /// Errors near such a jump or knot were up to ten times the difference of neighbouring runs (measured in
    /// `benches/peers`).
    pub fn extrapolated(self, times: usize) -> Self {
        let safety = match times {
            0 => self.safety,
            1 if self.safety < 3.0 => 3.0,
            _ => 10.0,
        };
        Convergence { safety, ..self }
    }

    /// The estimate for one channel, from three trajectories on one grid and from runs that differ in the number of
    /// sweeps.
    /// `None` if one of these trajectories does not have the channel.
    #[must_use]
    pub fn of_channel(runs: Ladder<'_>, channel: &Channel, formal: f64, noise: f64) -> Option<Self> {
        let [double, single, half] = runs.resolutions.map(|run| run.column(channel));
        let (double, single, half, periodic) = (double?, single?, half?, channel.kind.periodic);
        let found = Convergence::of(double, single, half, periodic, formal, noise);
        Some(found.with_other_sweeps(single, &runs.other_sweeps.column(channel)?, noise, periodic))
    }

    /// Adds the iteration error of the middle run. Differences below `noise` (in the channel's unit) show no trend.
    pub fn with_other_sweeps(self, single: &[f64], others: &OtherSweeps<&[f64]>, noise: f64, periodic: bool) -> Self {
        Convergence { iteration: others.left(single, noise, periodic), ..self }
    }

    /// Limit of the runs, extrapolated from the middle and the finest run: y(h/2) + (y(h/2) - y(h)) / (2^p - 1).
    /// p is the formal order. `None` if the observed order is NaN or too far from the formal order.
    #[must_use]
    pub fn limit(&self, single: &[f64], half: &[f64], periodic: bool) -> Option<Vec<f64>> {
        if !((self.observed - self.formal).abs() <= BEARS_OUT * self.formal) {
            return None;
        }
        let share = 1.0 / (2f64.powf(self.formal) - 1.0);
        let steps = differences(single, half, periodic);
        Some(half.iter().zip(steps).map(|(value, step)| value + step * share).collect())
    }

    /// Whether the estimate can be trusted: the observed order is at least half of the formal order, or the difference
    /// between single and half step is only rounding.
    #[must_use]
    pub fn is_trusted(&self) -> bool {
        self.observed.is_nan() || self.observed >= 0.5 * self.formal
    }

    /// The parts of the bound on the error of the middle run; `noise` is the rounding part, in the channel's unit.
    #[must_use]
    pub fn parts(&self, noise: f64) -> Parts {
        let (discretisation, iteration) = (self.safety * self.error, other_sweeps::SAFETY * self.iteration);
        Parts { discretisation, iteration, rounding: noise, reference: 0.0 }
    }

    /// Bound on the error of the middle run: the sum of `parts`. `resolution` is the step or accuracy of the middle
    /// run, and `noise` is the origin of the rounding part.
    #[must_use]
    pub fn tolerance(&self, resolution: f64, parts: Parts, noise: BoundOrigin) -> Tolerance {
        let Convergence { observed, formal, safety, .. } = *self;
        let basis = BoundBasis::Truncation { observed, formal, resolution, safety, parts, noise };
        Tolerance { bound: parts.sum(), basis }
    }
}

/// Order of convergence observed between two runs at steps h and h/2.
/// A reference gives the true errors of both runs. The order is log2 of the ratio of their root mean square errors.
/// `None` if a trajectory lacks the channel.
///
/// # Errors
/// If the grids differ.
pub fn observed_order(reference: &Trajectory, runs: [&Trajectory; 2], channel: &Channel) -> Result<Option<f64>> {
    let error =
        |run: &Trajectory| -> Result<Option<f64>> { Ok(super::difference(reference, run)?.column(channel).map(rms)) };
    Ok(error(runs[0])?.zip(error(runs[1])?).map(|(coarse, fine)| (coarse / fine).log2()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn runs(order: i32, exact: f64) -> [Vec<f64>; 3] {
        [2.0f64, 1.0, 0.5].map(|h| vec![exact + 1e-3 * h.powi(order), exact - 2e-3 * h.powi(order)])
    }

    #[test]
    fn second_order_is_observed_and_its_error_estimate_exact() {
        let [double, single, half] = runs(2, 7.0);
        let found = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        assert!((found.observed - 2.0).abs() < 1e-9 && found.safety == 1.25);
        assert!((found.error - 2e-3).abs() < 1e-12);
        assert!((found.parts(0.0).sum() - 2.5e-3).abs() < 1e-12);
    }

    #[test]
    fn an_unexpected_first_order_gets_a_larger_safety_factor() {
        let [double, single, half] = runs(1, 7.0);
        let found = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        assert!(found.is_trusted() && found.safety == 3.0 && (found.error - 2e-3).abs() < 1e-12);
        let stuck = Convergence::of(&[1.0], &[0.9], &[0.8], false, 2.0, 0.0);
        assert!(!stuck.is_trusted());
    }

    #[test]
    fn orders_below_a_half_are_untrusted_and_extrapolation_guarded() {
        // Differences of 1.1 and 1 give an order of 0.14. Used alone, this order would give an error of eleven times
        // the finer difference.
        // The estimate uses an order of 0.5 instead.
        let slow = Convergence::of(&[2.1], &[1.0], &[0.0], false, 2.0, 0.0);
        assert!((slow.observed - 1.1f64.log2()).abs() < 1e-12 && !slow.is_trusted());
        assert!((slow.error - 1.1 / (1.0 - 0.5f64.sqrt())).abs() < 1e-12, "{slow:?}");
        let [double, single, half] = runs(2, 7.0);
        let found = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        assert_eq!([0, 1, 2, 3].map(|times| found.extrapolated(times).safety), [1.25, 3.0, 10.0, 10.0]);
    }

    #[test]
    fn a_nearly_formal_order_gets_the_larger_safety_factor() {
        let runs = [2.0f64, 1.0, 0.5].map(|h| [7.0 + 2e-3 * h.powf(1.9)]);
        let found = Convergence::of(&runs[0], &runs[1], &runs[2], false, 2.0, 0.0);
        assert!((found.observed - 1.9).abs() < 1e-9 && found.safety == 3.0, "{found:?}");
        assert!((found.error - 2e-3).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_coarse_difference_replaces_a_fine_one_below_rounding() {
        // With second order, the difference between the single and the half step is expected to be a quarter of the
        // difference between the double and the single step.
        // The estimated error of the run at the single step is 4/3 of that quarter.
        let found = Convergence::of(&[3e-6], &[0.0], &[0.0], false, 2.0, 1e-12);
        assert!(found.observed.is_nan() && (found.error - 1e-6).abs() < 1e-18, "{found:?}");
    }

    #[test]
    fn whole_turns_between_runs_are_no_difference() {
        let [double, single, half] = runs(2, 1.0);
        let plain = Convergence::of(&double, &single, &half, true, 2.0, 0.0);
        for run in 0..3 {
            let mut turned = [double.clone(), single.clone(), half.clone()];
            turned[run].iter_mut().for_each(|angle| *angle += std::f64::consts::TAU);
            let found = Convergence::of(&turned[0], &turned[1], &turned[2], true, 2.0, 0.0);
            assert!(
                (found.error - plain.error).abs() < 1e-12 && (found.observed - 2.0).abs() < 1e-9,
                "{run}: {found:?}"
            );
        }
    }

    #[test]
    fn an_accidentally_small_difference_is_not_the_error() {
        // The errors are 3 h^2 - 2.3 h^4. The errors at the single and the half step, 0.70 and 0.61, are nearly equal.
        let [double, single, half] = [2.0f64, 1.0, 0.5].map(|h| [3.0 * h.powi(2) - 2.3 * h.powi(4)]);
        let found = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        assert!(found.observed > 6.0, "{found:?}");
        assert!(found.error >= 0.7 && found.parts(0.0).sum() <= 40.0, "{found:?}");
    }

    #[test]
    fn the_limit_is_exact_at_the_formal_order_only() {
        let [double, single, half] = runs(2, 7.0);
        let found = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        let limit = found.limit(&single, &half, false).unwrap();
        assert!(limit.iter().all(|value| (value - 7.0).abs() < 1e-12), "{limit:?}");
        let [double, single, half] = runs(1, 7.0);
        let first = Convergence::of(&double, &single, &half, false, 2.0, 0.0);
        assert_eq!(first.limit(&single, &half, false), None);
    }

    #[test]
    fn runs_with_fewer_sweeps_give_the_iteration_error() {
        let of = |values: &[f64]| {
            let times = vec![0.0, 1.0];
            let channels = vec![Channel::named("joint.A.fx_N").unwrap()];
            Trajectory::new(times.clone(), times, channels, vec![values.to_vec()]).unwrap()
        };
        let [double, single, half] = runs(2, 7.0).map(|values| of(&values));
        // Half the sweeps leave an error of 0.1, and all sweeps leave an error of 0.01.
        // The bound must include this iteration error besides the error of the step.
        let values = single.column(&single.channels()[0]).unwrap();
        let fewer = of(&[values[0] + 0.09, values[1]]);
        let other_sweeps = OtherSweeps { runs: [Some(&fewer), None], factor: 2.0, growth: 0.0 };
        let ladder = Ladder { resolutions: [&double, &single, &half], other_sweeps };
        let found = Convergence::of_channel(ladder, &single.channels()[0], 2.0, 0.0).unwrap();
        assert!((found.iteration - 0.09).abs() < 1e-15);
        assert!(found.parts(0.0).sum() >= 2e-3 + 0.01);
    }

    #[test]
    fn nan_gives_a_bound_that_no_residual_meets() {
        for place in 0..3 {
            let mut runs = [2.0f64, 1.0, 0.5].map(|h| vec![h * h, 2.0 * h * h]);
            runs[place][0] = f64::NAN;
            let found = Convergence::of(&runs[0], &runs[1], &runs[2], false, 2.0, 0.0);
            // A NaN in the run at double step does not enter the estimate, but the estimate is then not trusted.
            let bound = found.parts(0.0).sum();
            assert!(bound.is_nan() || !found.is_trusted(), "{place}: {found:?}");
            assert!(found.limit(&runs[1], &runs[2], false).is_none(), "{place}: {found:?}");
        }
        let found = Convergence::of(&[1.0], &[1.0], &[1.0], false, 2.0, 1.0);
        let fewer = OtherSweeps { runs: [Some([f64::NAN, 1.0].as_slice()), None], factor: 2.0, growth: 0.0 };
        let found = found.with_other_sweeps(&[1.0, 1.0], &fewer, 0.0, false);
        assert!(found.parts(0.0).sum().is_nan(), "{found:?}");
    }

    #[test]
    fn rounding_shows_no_order() {
        let found = Convergence::of(&[1.0], &[1.0 + 1e-15], &[1.0], false, 2.0, 1e-13);
        assert!(found.observed.is_nan() && found.is_trusted() && found.error < 2e-15);
    }
}
