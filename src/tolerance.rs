//! Bounds and what they rest on.

use std::fmt;

/// Why a bound is what it is.
#[derive(Clone, Debug, PartialEq)]
pub enum Basis {
    /// Rounding of double precision only; the text says how it grows.
    RoundOff(&'static str),
    /// Error of the engine, estimated from its own runs at three resolutions and with half the sweeps.
    Truncation {
        /// Order of convergence observed between the runs; NaN where the differences are rounding.
        observed: f64,
        /// Order that the method should have.
        formal: f64,
        /// Step (s) or accuracy of the run that is judged.
        resolution: f64,
        /// Safety factor on the estimate of the discretisation error.
        safety: f64,
        /// What the bound is made of, safety factors included, in the channel's unit.
        parts: Parts,
    },
    /// Half a unit of the last printed digit of a published figure.
    Published {
        /// Number of printed decimals.
        digits: i32,
        /// Where it is published.
        source: String,
    },
}

/// The parts of a bound on an engine's error, safety factors included.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Parts {
    /// Discretisation: what a finer step makes smaller.
    pub discretisation: f64,
    /// Iteration: what more sweeps make smaller.
    pub iteration: f64,
    /// Rounding: what neither makes smaller.
    pub rounding: f64,
}

impl Parts {
    /// The bound.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.discretisation + self.iteration + self.rounding
    }
}

impl fmt::Display for Basis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Basis::RoundOff(why) => write!(f, "round-off: {why}"),
            Basis::Truncation { observed, formal, resolution, safety, parts } => {
                let Parts { discretisation, iteration, rounding } = parts;
                let order = match observed.is_nan() {
                    true => format!("below round-off, order {formal} assumed"),
                    false => format!("observed order {observed:.2} (formal {formal})"),
                };
                write!(
                    f,
                    "truncation: {order} at resolutions {:e}, {resolution:e} and {:e}, safety factor {safety}; discretisation {discretisation:.1e}, iteration {iteration:.1e}, rounding {rounding:.1e}",
                    2.0 * resolution,
                    resolution / 2.0
                )
            }
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
