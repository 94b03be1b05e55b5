//! Bounds and their justification.
//! See docs/numerics/bounds.md.

use crate::sentences;
use std::fmt;

/// Origin of a bound. If the checked number is compared with a printed number: origin of the printed number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundOrigin {
    /// Claimed by the formula that is judged.
    Claimed,
    /// Derived from given data by a formula.
    Derived,
    /// Estimated from an engine's own runs at several resolutions.
    Estimated,
    /// Measured on similar cases, with a margin added.
    Measured,
    /// Chosen: a limit that the number must not exceed.
    Wanted,
    /// Recomputed by this project's solvers from data that others published.
    Recomputed,
    /// Printed in a source.
    Published,
}

impl BoundOrigin {
    /// Word for reports and scenario files, such as `measured`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            BoundOrigin::Claimed => "claimed",
            BoundOrigin::Derived => "derived",
            BoundOrigin::Estimated => "estimated",
            BoundOrigin::Measured => "measured",
            BoundOrigin::Wanted => "wanted",
            BoundOrigin::Recomputed => "recomputed",
            BoundOrigin::Published => "published",
        }
    }
}

/// Basis of a bound.
#[derive(Clone, Debug, PartialEq)]
pub enum BoundBasis {
    /// Chosen for a number that would be zero without rounding. The text gives the reason for the size of the bound.
    Wanted(&'static str),
    /// Error of the engine, estimated from runs at three resolutions and from runs with fewer sweeps.
    Truncation {
        /// Order of convergence observed between the runs. NaN if the runs at single and half step differ only by
        /// rounding.
        observed: f64,
        /// Order of convergence that the method has in theory.
        formal: f64,
        /// Step (s) or accuracy of the run that is judged.
        resolution: f64,
        /// Factor applied to the estimate of the discretisation error.
        safety: f64,
        /// The parts of the bound, safety factors included, in the channel's unit.
        parts: Parts,
        /// Origin of the rounding part. The discretisation and iteration parts are estimated.
        noise: BoundOrigin,
    },
    /// Bound of a printed number.
    /// For a number of a series, the bound is a sum of four parts: half a unit of the number's last digit, the known
    /// error of the number, the known error of the side, and the effect of the rounding of the number's instant.
    /// For a figure, the bound is the larger of half a unit of the last digit and the known error of the side.
    Digits {
        /// How the number is known: published, recomputed or derived.
        origin: BoundOrigin,
        /// Number of decimals.
        digits: i32,
        /// Source of the number.
        source: String,
        /// The part of the bound due to the rounding of the instant, in the unit of the number.
        instant: f64,
    },
    /// Rounding error of a formula, propagated through its operations, plus the error of the side's values.
    Formula {
        /// Whether the formula also states an error of its values.
        claimed: bool,
    },
    /// A basis of one of the kinds above, with a note on the check that uses the basis.
    Noted(Box<BoundBasis>, &'static str),
}

impl BoundBasis {
    /// Origin of the bound; for [`BoundBasis::Digits`], origin of the printed number.
    #[must_use]
    pub fn origin(&self) -> BoundOrigin {
        match self {
            BoundBasis::Wanted(_) => BoundOrigin::Wanted,
            BoundBasis::Truncation { parts, noise, .. } => match parts.largest() {
                BoundPart::Rounding => *noise,
                BoundPart::Reference => BoundOrigin::Wanted,
                BoundPart::Discretisation | BoundPart::Iteration => BoundOrigin::Estimated,
            },
            BoundBasis::Digits { origin, .. } => *origin,
            BoundBasis::Formula { claimed: true } => BoundOrigin::Claimed,
            BoundBasis::Formula { claimed: false } => BoundOrigin::Derived,
            BoundBasis::Noted(basis, _) => basis.origin(),
        }
    }
}

/// The parts of a bound on an engine's error, safety factors included.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Parts {
    /// Discretisation error: a finer step reduces it.
    pub discretisation: f64,
    /// Iteration error: more sweeps reduce it.
    pub iteration: f64,
    /// Rounding error: neither a finer step nor more sweeps reduce it.
    pub rounding: f64,
    /// Error of the reference: the accuracy to which the analytic sides know the number.
    pub reference: f64,
}

/// One of the [`Parts`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundPart {
    /// See [`Parts::discretisation`].
    Discretisation,
    /// See [`Parts::iteration`].
    Iteration,
    /// See [`Parts::rounding`].
    Rounding,
    /// See [`Parts::reference`].
    Reference,
}

impl Parts {
    /// The bound: the sum of its parts.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.discretisation + self.iteration + self.rounding + self.reference
    }

    /// The reference part if this part exceeds the sum of the other parts; otherwise the largest of the other parts.
    #[must_use]
    pub fn largest(&self) -> BoundPart {
        let own = self.discretisation + self.iteration + self.rounding;
        if self.reference > own {
            BoundPart::Reference
        } else if self.rounding >= self.discretisation && self.rounding >= self.iteration {
            BoundPart::Rounding
        } else if self.iteration >= self.discretisation {
            BoundPart::Iteration
        } else {
            BoundPart::Discretisation
        }
    }
}

impl fmt::Display for BoundBasis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BoundBasis::Wanted(why) => write!(f, "wanted: {why}"),
            BoundBasis::Truncation { observed, formal, resolution, safety, parts, noise } => {
                let Parts { discretisation, iteration, rounding, reference } = parts;
                let order = match observed.is_nan() {
                    true => sentences::below_round_off_order_assumed(&formal),
                    false => sentences::observed_order_formal(&observed, &formal),
                };
                write!(
                    f,
                    "{}",
                    sentences::truncation_at_resolutions_and_safety(
                        &self.origin().word(),
                        &order,
                        &format_args!("{:e}", 2.0 * resolution),
                        &format_args!("{resolution:e}"),
                        &format_args!("{:e}", resolution / 2.0),
                        &safety,
                        &format_args!("{discretisation:.1e}"),
                        &format_args!("{iteration:.1e}"),
                        &format_args!("{rounding:.1e}"),
                        &noise.word(),
                        &format_args!("{reference:.1e}")
                    )
                )
            }
            BoundBasis::Digits { origin, digits, source, instant } => {
                write!(f, "{}", sentences::with_decimals(&origin.word(), &digits, &source))?;
                match *instant > 0.0 {
                    true => write!(f, "{}", sentences::of_the_bound_for_the_rounding(&format_args!("{instant:.1e}"))),
                    false => Ok(()),
                }
            }
            BoundBasis::Formula { claimed } => {
                let error = if *claimed { sentences::THE_ERROR_THAT_THE_FORMULA } else { "the formula's" };
                let origin = self.origin().word();
                write!(f, "{}", sentences::rounding_passed_through_its_operations(&origin, &error))
            }
            BoundBasis::Noted(basis, note) => write!(f, "{basis}; {note}"),
        }
    }
}

/// A bound with its basis.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerance {
    /// The bound, in the unit of the checked number.
    pub bound: f64,
    /// Basis of the bound.
    pub basis: BoundBasis,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn truncation(parts: Parts) -> BoundBasis {
        let noise = BoundOrigin::Measured;
        BoundBasis::Truncation { observed: 2.0, formal: 2.0, resolution: 1e-3, safety: 1.25, parts, noise }
    }

    #[test]
    fn a_bound_dominated_by_rounding_states_the_rounding_origin() {
        let estimated = truncation(Parts { discretisation: 1.0, rounding: 0.5, ..Parts::default() });
        let measured = truncation(Parts { discretisation: 0.5, rounding: 1.0, ..Parts::default() });
        assert_eq!([estimated.origin(), measured.origin()], [BoundOrigin::Estimated, BoundOrigin::Measured]);
        assert!(estimated.to_string().starts_with("estimated: truncation, observed order 2.00"));
        assert!(measured.to_string().starts_with("measured: "));
        assert!(measured.to_string().ends_with("rounding 1.0e0 (measured), reference 0.0e0"));
    }

    #[test]
    fn a_bound_is_the_sum_of_all_its_parts() {
        let parts = Parts { discretisation: 1.0, iteration: 2.0, rounding: 4.0, reference: 8.0 };
        assert_eq!((parts.sum(), parts.largest()), (15.0, BoundPart::Reference));
        assert_eq!(Parts { reference: 7.0, ..parts }.largest(), BoundPart::Rounding);
    }

    #[test]
    fn every_basis_begins_with_its_origin() {
        let digits =
            BoundBasis::Digits { origin: BoundOrigin::Recomputed, digits: 3, source: "a table".into(), instant: 0.0 };
        let noted = BoundBasis::Noted(Box::new(BoundBasis::Wanted("so much")), "a note");
        assert_eq!(digits.to_string(), "recomputed with 3 decimals: a table");
        assert_eq!((noted.to_string().as_str(), noted.origin()), ("wanted: so much; a note", BoundOrigin::Wanted));
    }
}
