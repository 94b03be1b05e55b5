//! Iteration error of an engine, estimated from runs with fewer sweeps.
//!
//! Sweeps converge geometrically.
//! If half of the sweeps leave a fraction q of the initial error, all sweeps leave the fraction q^2.
//! The results with half and with all sweeps differ by q - q^2, so the remaining error is q / (1 - q) times this
//! difference.
//! The safety factor 3 covers q up to 3/4 (ASME V&V 20 also counts the iteration error separately).
//! If a run with a quarter of the sweeps leaves q, all sweeps leave q^4. The safety factor then covers q^3 up to 3/4.
//!
//! A third run shows how the differences develop.
//! Let each number of sweeps be r times the previous one, and each difference s times the previous one.
//!
//! - If the differences continue to shrink by the factor s, the remaining error is s / (1 - s) times the last
//!   difference (Aitken). This is an upper limit: the number of sweeps grows by the factor r from run to run, so if the
//!   convergence is geometric, each quotient of successive differences is smaller than the one before.
//! - The differences of a channel may grow at first: if the iteration has hardly begun, the result changes in
//!   proportion to the number of sweeps, and s is close to r. If one mode dominates the iteration, the remaining error
//!   is then at most (r - 1) s / (r - s) times the last difference.
//! - The position channel with the slowest convergence decides for all channels. If the differences of this channel
//!   grow, the error of every channel is unknown.
//!
//! See docs/numerics/bounds.md.

use linkage::math::KeepNan;
use linkage::math::statistics::{largest_difference, share};
use linkage::trajectory::{Channel, Trajectory};

/// Safety factor on the iteration error, explained in the documentation of this module.
pub(super) const SAFETY: f64 = 3.0;

/// Runs with the step of the middle run, but with other numbers of sweeps. `T` is the data stored for a run.
#[derive(Clone, Copy, Debug)]
pub struct OtherSweeps<T> {
    /// Two runs. The first run has the sweeps of the middle run divided by `factor`, or two sweeps if the middle run
    /// has one sweep. The second run has the sweeps of the first run divided by `factor`.
    /// `None` for an engine that does not iterate, and for a missing run.
    pub runs: [Option<T>; 2],
    /// Factor between the numbers of sweeps of successive runs.
    pub factor: f64,
    /// Largest [growth](OtherSweeps::growth) over the position channels; 0 if no growth is known.
    /// For the forces that the engine itself exerts, the largest growth over these forces is used instead.
    pub growth: f64,
}

impl<T> OtherSweeps<T> {
    /// The runs, each converted by `f`.
    pub fn map<'s, U>(&'s self, mut f: impl FnMut(&'s T) -> U) -> OtherSweeps<U> {
        let runs = self.runs.each_ref().map(|run| run.as_ref().map(&mut f));
        OtherSweeps { runs, factor: self.factor, growth: self.growth }
    }
}

impl<'a> OtherSweeps<&'a Trajectory> {
    /// The values of one channel. `None` if a run does not have the channel.
    #[must_use]
    pub fn column(&self, channel: &Channel) -> Option<OtherSweeps<&'a [f64]>> {
        let columns = self.map(|run| run.column(channel));
        let has_all = columns.runs.iter().flatten().all(Option::is_some);
        has_all.then(|| columns.map(|column| column.expect("all runs have it")))
    }
}

impl OtherSweeps<&[f64]> {
    /// Growth of the differences between runs: the last difference divided by the difference before. The last
    /// difference is between the first run and the middle run `single`, the difference before is between the second and
    /// the first run. Each difference is the largest over all instants.
    /// The result is 0 if a run is missing, or if the difference from the middle run is at most `negligible`.
    #[must_use]
    pub fn growth(&self, single: &[f64], negligible: f64, periodic: bool) -> f64 {
        let [Some(fewer), Some(fewest)] = self.runs else { return 0.0 };
        let last = largest_difference(fewer, single, periodic);
        if last <= negligible { 0.0 } else { share(last, largest_difference(fewest, fewer, periodic)) }
    }

    /// Iteration error of the middle run, without safety factor. Differences of at most `noise` show no trend.
    #[must_use]
    pub fn left(&self, single: &[f64], noise: f64, periodic: bool) -> f64 {
        let last = |fewer: &[f64]| largest_difference(fewer, single, periodic);
        match self.runs {
            [None, _] => 0.0,
            [Some(fewer), None] => last(fewer),
            // A channel that sweeps do not change has no iteration error.
            [Some(fewer), Some(_)] if last(fewer) == 0.0 => 0.0,
            // If the differences of a position channel grow, the iteration may not have reached the judged channel yet.
            // Even small differences of the judged channel are then not rounding. The error is infinite (unknown).
            [Some(_), Some(_)] if self.growth > 1.0 => f64::INFINITY,
            [Some(fewer), Some(_)] => match self.growth(single, noise, periodic) {
                // If the last difference is only rounding, this difference counts as the error.
                0.0 => last(fewer),
                own => last(fewer) * part_left(own.larger(self.growth), self.factor),
            },
        }
    }
}

/// Remaining error divided by the last difference, if each difference is `share` times the previous difference. The
/// documentation of this module gives the formulas.
fn part_left(share: f64, factor: f64) -> f64 {
    if share < 1.0 {
        share.larger(share / (1.0 - share) / SAFETY)
    } else if share < factor {
        (factor - 1.0) * share / (factor - share)
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left(runs: [&[f64]; 3], factor: f64, growth: f64, noise: f64) -> f64 {
        let [fewest, fewer, all] = runs;
        SAFETY * OtherSweeps { runs: [Some(fewer), Some(fewest)], factor, growth }.left(all, noise, false)
    }

    #[test]
    fn early_iterations_do_not_count_as_converged() {
        for factor in [2.0f64, 4.0] {
            for q in [0.2f64, 0.5, 0.8, 0.9, 0.97, 0.99] {
                // The error after n sweeps is q^n. The run with the fewest sweeps has one sweep.
                let [fewest, fewer, all] = [0, 1, 2].map(|k| [q.powf(factor.powi(k))]);
                let bound = left([&fewest, &fewer, &all], factor, 0.0, 0.0);
                assert!(bound >= all[0] && bound <= 20.0, "{factor} {q}: {bound} for {}", all[0]);
            }
        }
        // If the differences grow as fast as the numbers of sweeps, the remaining error is unknown. Differences that
        // are only rounding are excepted.
        let grown: [&[f64]; 3] = [&[1.0], &[2.0], &[6.0]];
        assert_eq!(left(grown, 4.0, 0.0, 0.0), f64::INFINITY);
        assert_eq!(left(grown, 4.0, 0.0, 5.0), 12.0);
    }

    #[test]
    fn a_channel_converges_no_faster_than_the_others() {
        let shrinking: [&[f64]; 3] = [&[1.0], &[0.1], &[0.0]];
        assert!((left(shrinking, 4.0, 0.0, 0.0) - 3.0 * 0.1 * (1.0 / 9.0)).abs() < 1e-12);
        assert!((left(shrinking, 4.0, 0.9, 0.0) - 0.1 * 9.0).abs() < 1e-12);
        assert_eq!(left(shrinking, 4.0, 1.5, 0.0), f64::INFINITY);
        // If the differences of a position channel grow, the error is unknown, even if the judged channel's differences
        // could be rounding.
        // A channel that sweeps do not change has no iteration error.
        assert_eq!(left(shrinking, 4.0, 1.5, 5.0), f64::INFINITY);
        assert_eq!(left([&[1.0], &[1.0], &[1.0]], 4.0, 1.5, 0.0), 0.0);
    }
}
