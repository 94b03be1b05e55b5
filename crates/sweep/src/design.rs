//! Designs of experiments: the values of the varied numbers in each case.
//! The numbers of a case depend only on the design and on the index of the case. Any part of the cases can therefore be
//! computed without the other cases.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use linkage::error::{Error, ErrorKind, Result};
use serde::{Deserialize, Serialize};

use crate::axis::{Spread, SweepAxis};
use crate::sentences;
use crate::sobol::{self, Sobol};

/// How the values of the varied numbers are combined.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DesignKind {
    /// Full factorial: every combination of the values of all grids. The first axis changes slowest.
    Grid,
    /// Independent random numbers.
    Random {
        /// Number of cases.
        cases: u64,
        /// Seed of the random numbers.
        seed: u64,
    },
    /// Latin hypercube: the range of each axis is divided into equally probable parts, and each part contains the value
    /// of exactly one case.
    /// Source: M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979), 239-245.
    LatinHypercube {
        /// Number of cases.
        cases: u64,
        /// Seed of the random numbers.
        seed: u64,
    },
    /// Sobol's sequence with a random digital shift.
    Sobol {
        /// Number of cases; powers of two are best.
        cases: u64,
        /// Seed of the shift.
        seed: u64,
    },
}

/// A design of experiments with its axes. The design gives the values of the varied numbers in any case.
#[derive(Clone, Debug)]
pub struct SweepDesign {
    kind: DesignKind,
    axes: Vec<SweepAxis>,
    cases: u64,
    sobol: Sobol,
}

/// Largest number of cases.
const MOST_CASES: u64 = 1 << 45;

impl SweepDesign {
    /// A design of the kind `kind` for these axes.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if there is no axis, if an axis is given twice, if a full factorial has a distribution or a
    /// sample has a grid, if there are too many cases, or more axes than dimensions of Sobol's sequence.
    pub fn of(kind: DesignKind, axes: Vec<SweepAxis>) -> Result<SweepDesign> {
        let wrong = |message: String, help: &'static str| Err(Error::new(ErrorKind::Input, message).help(help));
        if axes.is_empty() {
            return wrong(sentences::NO_NUMBER_IS_VARIED.into(), sentences::VARY_KEY_BY_A_GRID_OR);
        }
        for (index, axis) in axes.iter().enumerate() {
            if axes[..index].iter().any(|other| other.key == axis.key) {
                return wrong(sentences::is_varied_twice(&axis.key), sentences::GIVE_EVERY_KEY_ONE_SPREAD);
            }
            let is_stepped = matches!(axis.spread, Spread::Steps { .. });
            match (kind, is_stepped) {
                (DesignKind::Grid, false) => {
                    return wrong(sentences::a_grid_needs_steps(axis), sentences::GIVE_STEPS_OR_SAMPLES);
                }
                (DesignKind::Random { .. } | DesignKind::LatinHypercube { .. } | DesignKind::Sobol { .. }, true) => {
                    return wrong(sentences::samples_have_no_steps(axis), sentences::LEAVE_THE_NUMBER_OF_STEPS_OUT);
                }
                _ => {}
            }
        }
        let cases = match kind {
            DesignKind::Grid => axes.iter().try_fold(1u64, |product, axis| match axis.spread {
                Spread::Steps { count, .. } => product.checked_mul(count),
                Spread::Uniform { .. } | Spread::Normal { .. } | Spread::TruncatedNormal { .. } => None,
            }),
            DesignKind::Random { cases, .. }
            | DesignKind::LatinHypercube { cases, .. }
            | DesignKind::Sobol { cases, .. } => Some(cases),
        };
        let Some(cases) = cases.filter(|cases| (1..=MOST_CASES).contains(cases)) else {
            return wrong(sentences::too_many_or_no_cases(&MOST_CASES), sentences::TAKE_FEWER_CASES);
        };
        if matches!(kind, DesignKind::Sobol { .. }) && axes.len() > sobol::MOST {
            return wrong(
                sentences::sobol_has_dimensions(&sobol::MOST, &axes.len()),
                sentences::TAKE_A_LATIN_HYPERCUBE,
            );
        }
        let sobol = Sobol::of(if matches!(kind, DesignKind::Sobol { .. }) { axes.len() } else { 0 });
        Ok(SweepDesign { kind, axes, cases, sobol })
    }

    /// Number of cases.
    #[must_use]
    pub fn cases(&self) -> u64 {
        self.cases
    }

    /// The varied numbers, in the order in which they were given.
    #[must_use]
    pub fn axes(&self) -> &[SweepAxis] {
        &self.axes
    }

    /// How the values are combined.
    #[must_use]
    pub fn kind(&self) -> DesignKind {
        self.kind
    }

    /// The varied keys with their values.
    #[must_use]
    pub fn setting(&self, values: &[f64]) -> Vec<(String, f64)> {
        self.axes.iter().zip(values).map(|(axis, value)| (axis.key.clone(), *value)).collect()
    }

    /// The varied keys with their values in case `index`.
    #[must_use]
    pub fn setting_of(&self, index: u64) -> Vec<(String, f64)> {
        let mut values = vec![0.0; self.axes.len()];
        self.values(index, &mut values);
        self.setting(&values)
    }

    /// Writes the values of case `index` into `values`, one for each axis, in the units of the keys.
    pub fn values(&self, index: u64, values: &mut [f64]) {
        let axes = self.axes.iter().enumerate();
        match self.kind {
            DesignKind::Grid => {
                let mut rest = index;
                for (at, axis) in axes.rev() {
                    let Spread::Steps { count, .. } = axis.spread else { continue };
                    values[at] = axis.spread.step(rest % count);
                    rest /= count;
                }
            }
            DesignKind::Random { seed, .. } => {
                let mut random = random(seed, index);
                axes.for_each(|(at, axis)| values[at] = axis.spread.quantile(unit(random.next_u64())));
            }
            DesignKind::LatinHypercube { cases, seed } => {
                let mut random = random(seed, index);
                for (at, axis) in axes {
                    let part = shuffled(index, cases, mixed(seed ^ mixed(at as u64 + 1)));
                    values[at] = axis.spread.quantile((part as f64 + unit(random.next_u64())) / cases as f64);
                }
            }
            DesignKind::Sobol { seed, .. } => {
                for (at, axis) in axes {
                    let shift = mixed(seed ^ mixed(at as u64 + 1)) >> 12;
                    let bits = self.sobol.bits(index, at) ^ shift;
                    values[at] = axis.spread.quantile((bits as f64 + 0.5) / (1u64 << 52) as f64);
                }
            }
        }
    }
}

/// The random numbers of a case. The generator has a separate stream for every case.
fn random(seed: u64, index: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index);
    random
}

/// A number strictly between 0 and 1 from 64 random bits.
fn unit(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) / (1u64 << 52) as f64
}

/// A well-mixed number: the finaliser of SplitMix64.
fn mixed(number: u64) -> u64 {
    let mut z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Image of `index` under a pseudo-random permutation of the numbers below `count`.
/// A Feistel network permutes the numbers below the next power of four. The network is applied again until the image is
/// below `count`.
/// Source: J. Black, P. Rogaway, Ciphers with arbitrary finite domains, CT-RSA 2002, section 3.
fn shuffled(index: u64, count: u64, key: u64) -> u64 {
    let half = (u64::BITS - (count - 1).leading_zeros()).div_ceil(2);
    let mask = (1u64 << half) - 1;
    let mut at = index;
    loop {
        for round in 0..6u64 {
            let (left, right) = (at >> half, at & mask);
            at = right << half | (left ^ (mixed(right ^ key.wrapping_add(round.wrapping_mul(0x9e37_79b9)))) & mask);
        }
        if at < count {
            return at;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn design(kind: DesignKind, axes: &[&str]) -> SweepDesign {
        SweepDesign::of(kind, axes.iter().map(|text| SweepAxis::parse(text).unwrap()).collect()).unwrap()
    }

    fn all(design: &SweepDesign) -> Vec<Vec<f64>> {
        let of = |index| {
            let mut values = vec![f64::NAN; design.axes().len()];
            design.values(index, &mut values);
            values
        };
        (0..design.cases()).map(of).collect()
    }

    #[test]
    fn a_grid_combines_all_values() {
        let found = all(&design(DesignKind::Grid, &["a=1:3:3", "b=10:20:2"]));
        assert_eq!(found, [[1.0, 10.0], [1.0, 20.0], [2.0, 10.0], [2.0, 20.0], [3.0, 10.0], [3.0, 20.0]]);
    }

    #[test]
    fn a_latin_hypercube_has_one_case_in_every_part() {
        for cases in [1, 2, 3, 7, 64, 1000] {
            let kind = DesignKind::LatinHypercube { cases, seed: 5 };
            let found = all(&design(kind, &["a=0:1", "b=0:1", "c=0:1"]));
            for axis in 0..3 {
                let mut parts: Vec<u64> = found.iter().map(|values| (values[axis] * cases as f64) as u64).collect();
                parts.sort_unstable();
                assert_eq!(parts, (0..cases).collect::<Vec<_>>(), "{cases} cases");
            }
        }
    }

    /// The means, variances and correlations of ten thousand cases are accurate to five standard errors. The standard
    /// errors are those of independent random numbers.
    /// Sobol's sequence and the Latin hypercube have smaller deviations than random numbers.
    #[test]
    fn samples_have_the_moments_of_their_distributions() {
        let cases = 10_000;
        for kind in [
            DesignKind::Random { cases, seed: 1 },
            DesignKind::LatinHypercube { cases, seed: 1 },
            DesignKind::Sobol { cases, seed: 1 },
        ] {
            let found = all(&design(kind, &["a=2:4", "b=normal(10, 3)"]));
            let mean = |of: &dyn Fn(&[f64]) -> f64| found.iter().map(|own| of(own)).sum::<f64>() / cases as f64;
            let root = (cases as f64).sqrt();
            let deviation = (1.0f64 / 3.0).sqrt();
            assert!((mean(&|own| own[0]) - 3.0).abs() < 5.0 * deviation / root, "{kind:?}");
            assert!((mean(&|own| own[1]) - 10.0).abs() < 5.0 * 3.0 / root, "{kind:?}");
            assert!((mean(&|own| (own[0] - 3.0).powi(2)) - 1.0 / 3.0).abs() < 5.0 * 0.3 / root, "{kind:?}");
            assert!((mean(&|own| (own[1] - 10.0).powi(2)) - 9.0).abs() < 5.0 * 9.0 * 1.42 / root, "{kind:?}");
            let product = mean(&|own| (own[0] - 3.0) / deviation * (own[1] - 10.0) / 3.0);
            assert!(product.abs() < 5.0 / root, "{kind:?}: {product}");
        }
    }

    #[test]
    fn seeds_give_other_cases_and_the_same_seed_the_same() {
        for kind in [
            |seed| DesignKind::Random { cases: 9, seed },
            |seed| DesignKind::LatinHypercube { cases: 9, seed },
            |seed| DesignKind::Sobol { cases: 9, seed },
        ] {
            let of = |seed| all(&design(kind(seed), &["a=0:1"]));
            assert_eq!(of(3), of(3));
            assert_ne!(of(3), of(4));
        }
    }

    #[test]
    fn designs_that_mean_nothing_are_refused() {
        let refused = |kind, axes: &[&str]| {
            let axes = axes.iter().map(|text| SweepAxis::parse(text).unwrap()).collect();
            SweepDesign::of(kind, axes).unwrap_err().message().to_string()
        };
        let random = DesignKind::Random { cases: 5, seed: 0 };
        refused(DesignKind::Grid, &[]);
        refused(DesignKind::Grid, &["a=1:2"]);
        refused(random, &["a=1:2:3"]);
        refused(random, &["a=1:2", "a=3:4"]);
        refused(DesignKind::Random { cases: 0, seed: 0 }, &["a=1:2"]);
        refused(DesignKind::Grid, &["a=1:2:1000000000000", "b=1:2:1000000000000"]);
        let many: Vec<String> = (0..50).map(|axis| format!("a{axis}=1:2")).collect();
        refused(DesignKind::Sobol { cases: 5, seed: 0 }, &many.iter().map(String::as_str).collect::<Vec<_>>());
    }
}
