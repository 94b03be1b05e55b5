//! A varied number of a scenario, with its grid or distribution.

use std::fmt;

use linkage::error::{Error, ErrorKind, Result};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::sentences;

/// A varied number: a parameter, named by its key, or another number of the file, named by its path.
/// Values are in the unit of the key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepAxis {
    /// Key of the parameter, or path of the number.
    pub key: String,
    /// Values of the number.
    pub spread: Spread,
}

/// The values of a varied number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spread {
    /// A grid of equally spaced values, both ends included.
    Steps {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// Number of values, at least 1.
        count: u64,
    },
    /// Uniform distribution.
    Uniform {
        /// Lower limit.
        from: f64,
        /// Upper limit.
        to: f64,
    },
    /// Normal distribution.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation, positive.
        deviation: f64,
    },
    /// Normal distribution, truncated at two limits.
    TruncatedNormal {
        /// Mean of the distribution before it is truncated.
        mean: f64,
        /// Standard deviation of the distribution before it is truncated, positive.
        deviation: f64,
        /// Lower limit.
        from: f64,
        /// Upper limit.
        to: f64,
    },
}

/// Largest number of values of one axis.
const MOST_STEPS: f64 = 1e15;

impl SweepAxis {
    /// Reads a key and its values: `a_mm=30:50:21` (grid), `a_mm=30:50` or `a_mm=uniform(30, 50)`,
    /// `a_mm=normal(40, 0.1)` (mean and standard deviation), `a_mm=normal(40, 0.1, 39.8, 40.2)` (truncated).
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for any other text, and for limits in the wrong order.
    pub fn parse(text: &str) -> Result<SweepAxis> {
        let wrong = |message: String| Error::new(ErrorKind::Input, message).help(sentences::VARY_KEY_BY_A_GRID_OR);
        let (key, spread) = text.split_once('=').ok_or_else(|| wrong(sentences::no_key_of(&text)))?;
        let (key, spread) = (key.trim(), spread.trim());
        let (name, list) = match spread.split_once('(') {
            Some((name, rest)) => {
                (name.trim(), rest.strip_suffix(')').ok_or_else(|| wrong(sentences::no_spread(&spread)))?)
            }
            None => ("", spread),
        };
        let numbers = list.split(if name.is_empty() { ':' } else { ',' }).map(|word| word.trim().parse().ok());
        let numbers: Option<Vec<f64>> =
            numbers.map(|number| number.filter(|number: &f64| number.is_finite())).collect();
        let Some(numbers) = numbers.filter(|_| !key.is_empty()) else {
            return Err(wrong(sentences::no_spread(&spread)));
        };
        let spread = match (name, &numbers[..]) {
            ("", &[from, to, count]) => {
                if !((1.0..=MOST_STEPS).contains(&count) && count.fract() == 0.0) {
                    return Err(wrong(sentences::a_grid_has_a_whole_number(&count)));
                }
                Spread::Steps { from, to, count: count as u64 }
            }
            ("" | "uniform", &[from, to]) => Spread::Uniform { from, to },
            ("normal", &[mean, deviation]) => Spread::Normal { mean, deviation },
            ("normal", &[mean, deviation, from, to]) => Spread::TruncatedNormal { mean, deviation, from, to },
            _ => return Err(wrong(sentences::no_spread(&spread))),
        };
        match spread {
            Spread::Steps { from, to, .. } | Spread::Uniform { from, to } if !(to - from).is_finite() => {
                Err(wrong(sentences::the_range_is_too_wide(&format_args!("{from:e}"), &format_args!("{to:e}"))))
            }
            Spread::Normal { deviation, .. } | Spread::TruncatedNormal { deviation, .. } if !(deviation > 0.0) => {
                Err(wrong(sentences::the_deviation_is_not_positive(&deviation)))
            }
            Spread::Uniform { from, to } | Spread::TruncatedNormal { from, to, .. } if !(from < to) => {
                Err(wrong(sentences::the_limits_are_not_in_order(&from, &to)))
            }
            Spread::TruncatedNormal { mean, deviation, from, to } if !(share(mean, deviation, from, to) > 0.0) => {
                Err(wrong(sentences::nothing_lies_between(&from, &to)))
            }
            Spread::Steps { .. } | Spread::Uniform { .. } | Spread::Normal { .. } | Spread::TruncatedNormal { .. } => {
                Ok(SweepAxis { key: key.into(), spread })
            }
        }
    }
}

impl fmt::Display for SweepAxis {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{}=", self.key)?;
        match self.spread {
            Spread::Steps { from, to, count } => write!(out, "{from}:{to}:{count}"),
            Spread::Uniform { from, to } => write!(out, "{from}:{to}"),
            Spread::Normal { mean, deviation } => write!(out, "normal({mean}, {deviation})"),
            Spread::TruncatedNormal { mean, deviation, from, to } => {
                write!(out, "normal({mean}, {deviation}, {from}, {to})")
            }
        }
    }
}

/// The standard normal distribution.
fn standard() -> Normal {
    Normal::standard()
}

/// Probability of a normal distribution between two limits.
fn share(mean: f64, deviation: f64, from: f64, to: f64) -> f64 {
    standard().cdf((to - mean) / deviation) - standard().cdf((from - mean) / deviation)
}

impl Spread {
    /// Value number `step` of a grid.
    pub(crate) fn step(self, step: u64) -> f64 {
        match self {
            Spread::Steps { from, to, count } if step + 1 < count || count == 1 => {
                from + (to - from) * (step as f64 / (count.max(2) - 1) as f64)
            }
            Spread::Steps { to, .. } => to,
            Spread::Uniform { .. } | Spread::Normal { .. } | Spread::TruncatedNormal { .. } => self.quantile(0.5),
        }
    }

    /// The quantile: a random value of the axis is less than the quantile with the probability `part`.
    pub(crate) fn quantile(self, part: f64) -> f64 {
        match self {
            Spread::Steps { from, to, .. } | Spread::Uniform { from, to } => from + (to - from) * part,
            Spread::Normal { mean, deviation } => mean + deviation * standard().inverse_cdf(part),
            Spread::TruncatedNormal { mean, deviation, from, to } => {
                let below = standard().cdf((from - mean) / deviation);
                let part = below + part * share(mean, deviation, from, to);
                (mean + deviation * standard().inverse_cdf(part)).clamp(from, to)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_are_read_as_they_are_written() {
        for text in ["a_mm=30:50:21", "links.crank.mass_kg=1:2", "b=normal(40, 0.1)", "b=normal(40, 0.1, 39.8, 40.2)"] {
            assert_eq!(SweepAxis::parse(text).unwrap().to_string(), text);
        }
        assert_eq!(SweepAxis::parse("a = uniform(1,2)").unwrap().to_string(), "a=1:2");
    }

    #[test]
    fn mistakes_are_refused() {
        for text in
            ["a_mm", "=1:2", "a=1", "a=1:2:3:4", "a=1:2:0", "a=1:2:2.5", "a=2:1", "a=normal(1, 0)", "a=normal(1, -2)"]
        {
            assert!(SweepAxis::parse(text).is_err(), "{text}");
        }
        for text in ["a=normal(1, 2", "a=cauchy(1, 2)", "a=nan:2", "a=1:inf", "a=normal(0, 1, 100, 101)", "a=1:2:1e18"]
        {
            assert!(SweepAxis::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn grids_hit_both_ends_and_quantiles_are_those_of_tables() {
        let grid = SweepAxis::parse("a=0.1:0.7:7").unwrap().spread;
        assert_eq!([grid.step(0), grid.step(6)], [0.1, 0.7]);
        assert!((grid.step(3) - 0.4).abs() < 1e-15);
        assert_eq!(SweepAxis::parse("a=5:9:1").unwrap().spread.step(0), 5.0);
        // 97.5 % of the standard normal distribution lie below 1.959963984540054.
        let normal = SweepAxis::parse("a=normal(10, 2)").unwrap().spread;
        assert!((normal.quantile(0.975) - (10.0 + 2.0 * 1.959_963_984_540_054)).abs() < 1e-12);
        let truncated = SweepAxis::parse("a=normal(0, 1, -1, 3)").unwrap().spread;
        assert_eq!([truncated.quantile(0.0), truncated.quantile(1.0)].map(|own| (own * 1e9).round()), [-1e9, 3e9]);
        // The median m of the distribution truncated to -1 and 3 has Phi(m) = (Phi(-1) + Phi(3)) / 2.
        let median = truncated.quantile(0.5);
        let standard = standard();
        assert!((standard.cdf(median) - (standard.cdf(-1.0) + standard.cdf(3.0)) / 2.0).abs() < 1e-14);
    }
}
