//! Bounds and what they rest on.

use std::fmt;

/// Why a bound is what it is.
#[derive(Clone, Debug, PartialEq)]
pub enum Basis {
    /// Rounding of double precision only; the text says how it grows.
    RoundOff(&'static str),
    /// Discretisation error of the engine, estimated from its own runs at several step sizes.
    Truncation {
        /// Order of convergence observed between the runs; NaN where the differences are rounding.
        observed: f64,
        /// Order that the method should have.
        formal: f64,
        /// Step (s) of the run that is judged.
        step: f64,
        /// Safety factor on the estimate.
        safety: f64,
    },
    /// Half a unit of the last printed digit of a published figure.
    Published {
        /// Number of printed decimals.
        digits: i32,
        /// Where it is published.
        source: String,
    },
}

impl fmt::Display for Basis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Basis::RoundOff(why) => write!(f, "round-off: {why}"),
            Basis::Truncation { observed, formal, step, safety } if observed.is_nan() => {
                write!(
                    f,
                    "truncation below round-off at steps {:e}, {step:e} and {:e} s, order {formal} assumed, safety factor {safety}",
                    2.0 * step,
                    step / 2.0
                )
            }
            Basis::Truncation { observed, formal, step, safety } => write!(
                f,
                "truncation: observed order {observed:.2} (formal {formal}) over steps {:e}, {step:e} and {:e} s, safety factor {safety}",
                2.0 * step,
                step / 2.0
            ),
            Basis::Published { digits, source } => write!(f, "published with {digits} decimals: {source}"),
        }
    }
}

/// Bound `abs + rel * scale` with its basis; never relative to a single sample, whose channel may cross zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// Absolute part, in the channel's unit.
    pub abs: f64,
    /// Part relative to the channel's scale over the run.
    pub rel: f64,
    /// What the bound rests on.
    pub basis: Basis,
}

impl Tolerance {
    /// The bound for a channel of the given scale, in the channel's unit.
    #[must_use]
    pub fn bound(&self, scale: f64) -> f64 {
        self.abs + self.rel * scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bound_adds_both_parts() {
        let tolerance = Tolerance { abs: 0.5, rel: 0.1, basis: Basis::RoundOff("test") };
        assert_eq!(tolerance.bound(10.0), 1.5);
    }
}
