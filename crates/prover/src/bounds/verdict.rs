//! The verdict: agree, disagree, expected or inconclusive.
//! See docs/numerics/bounds.md.

use crate::sentences;
use std::fmt;

use super::{Convergence, Residual};
use crate::numbers::{error_in, fixed, input_told, percent};
use crate::tolerance::{BoundBasis, BoundPart, Parts, Tolerance};
use linkage::error::Advice;
use linkage::math::KeepNan;
use linkage::math::statistics::share;

/// Outcome of one comparison.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub enum Verdict {
    /// The residual is at most its bound.
    Agree {
        /// Bound divided by residual; infinite if the residual is zero.
        margin: f64,
    },
    /// The residual exceeds its bound.
    Disagree {
        /// Location of the largest residual, in words.
        place: String,
    },
    /// A published number disagrees with the solution as an entry of `docs/findings.md` predicts, and the corrected
    /// number agrees.
    Expected {
        /// Anchor of the entry in `docs/findings.md` that calls the published number wrong.
        finding: String,
        /// Difference between the published number and the solution, in the unit of the check.
        off: f64,
    },
    /// Neither agreement nor disagreement is proven.
    Inconclusive {
        /// Why the verdict is inconclusive.
        reason: String,
        /// Alternative actions that would decide the verdict; empty if none is known.
        advice: Vec<Advice>,
    },
}

/// Refers the reader to the section of `docs/findings.md` with the anchor `finding`.
#[must_use]
pub fn place_of_finding(finding: &str) -> Advice {
    Advice::Text(format!("docs/findings.md#{finding}"))
}

impl fmt::Display for Verdict {
    /// Writes the word for the verdict.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

impl Verdict {
    /// Word for reports: `agree`, `disagree`, `expected` or `inconclusive`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Verdict::Agree { .. } => "agree",
            Verdict::Disagree { .. } => "disagree",
            Verdict::Expected { .. } => "expected",
            Verdict::Inconclusive { .. } => "inconclusive",
        }
    }

    /// An inconclusive verdict without advice.
    pub fn open(reason: impl Into<String>) -> Self {
        Verdict::Inconclusive { reason: reason.into(), advice: Vec::new() }
    }

    /// Reason of a verdict other than agreement. `tell` converts advice to text.
    #[must_use]
    pub fn reason(&self, tell: impl Fn(&Advice) -> String) -> Option<String> {
        match self {
            Verdict::Agree { .. } => None,
            Verdict::Expected { finding, .. } => Some(sentences::expected_see(&tell(&place_of_finding(finding)))),
            Verdict::Disagree { place } => Some(place.clone()),
            Verdict::Inconclusive { reason, advice } => Some(match Advice::sentence(advice, tell) {
                Some(way_out) => format!("{reason}; {way_out}"),
                None => reason.clone(),
            }),
        }
    }

    /// This verdict, with values to try in its advice.
    /// The values come from the settings of the engine: see [`Advice::from_settings`].
    pub fn from_settings(mut self, resolution: f64, controls_error: bool, sweeps: usize) -> Self {
        if let Verdict::Inconclusive { advice, .. } = &mut self {
            for one in advice {
                *one = one.clone().from_settings(resolution, controls_error, sweeps);
            }
        }
        self
    }

    /// Compares a residual with its bound. The verdict is disagree if the residual or the bound is NaN.
    pub fn of(residual: f64, bound: f64, place: impl FnOnce() -> String) -> Self {
        if residual <= bound {
            Verdict::Agree { margin: if residual == 0.0 { f64::INFINITY } else { bound / residual } }
        } else {
            Verdict::Disagree { place: place() }
        }
    }

    /// Verdict on an engine's channel.
    /// A small residual proves nothing if the engine does not converge.
    /// A small residual also proves nothing if the bound on the engine's error exceeds the fraction `wanted` of the
    /// channel's scale.
    pub fn of_engine(residual: &Residual, convergence: &Convergence, parts: Parts, wanted: f64) -> Self {
        let place = || {
            let unit = residual.channel.kind.unit.symbol();
            let (error, bound) = (error_in(residual.max, unit), error_in(parts.sum(), unit));
            let (t, at) = (fixed(residual.worst_time, 6), input_told(residual.input.at(residual.worst_crank), 3));
            sentences::is_beyond_the_bound_at(&error, &bound, &t, &at)
        };
        Verdict::of_estimate(residual.max, residual.scale, convergence, parts, wanted, place)
    }

    /// Verdict on a number whose bound comes from an engine's own runs. The bound is the sum of `parts`; `scale` is the
    /// channel's scale.
    /// The verdict is inconclusive in three cases. First, the runs do not confirm the bound. Second, the bound exceeds
    /// the fraction `wanted` of the scale, and `value` is at most three times the bound. Third, the scale is zero and
    /// `value` is positive.
    pub fn of_estimate(
        value: f64,
        scale: f64,
        convergence: &Convergence,
        parts: Parts,
        wanted: f64,
        place: impl FnOnce() -> String,
    ) -> Self {
        let bound = parts.sum();
        if scale == 0.0 && value > 0.0 {
            // The reference is zero throughout if the grid is a single instant at rest, or if masses and loads are
            // missing.
            let reason = sentences::THE_REFERENCE_IS_ZERO_THROUGHOUT;
            return Verdict::open(reason);
        }
        let open = |reason: String| {
            let (why, advice) = way_out(parts);
            Verdict::Inconclusive { reason: reason + why, advice }
        };
        if parts.iteration.is_infinite() {
            return open(sentences::THE_SWEEPS_HAVE_HARDLY_BEGUN.into());
        }
        // A negligible bound needs no order of convergence: see `NEGLIGIBLE`.
        if !convergence.is_trusted() && !(bound <= NEGLIGIBLE * wanted * scale) {
            return open(sentences::the_engine_converges_with_order(&convergence.observed, &convergence.formal));
        }
        // A bound that is too wide to prove agreement cannot disprove a number close to the bound.
        if bound > wanted * scale && value <= DISPROVEN * bound {
            let (reached, proves) = (percent(bound / scale), percent(wanted));
            return open(sentences::the_engine_error_may_reach(&reached, &proves));
        }
        Verdict::of(value, bound, place)
    }
}

/// If a bound is at most this fraction of the widest bound that proves agreement, no order of convergence is required.
/// Below this limit, runs at three steps differ so little that rounding or the last iterations determine the order.
/// The bound is reliable nevertheless: if the runs show no order, the discretisation part of the bound is six to
/// ten times the larger of the two differences between successive runs.
const NEGLIGIBLE: f64 = 0.1;
/// A number disagrees with a bound that is too wide to prove agreement only if the number exceeds this multiple of the
/// bound. The factor equals the larger safety factor of the estimate, and applies in addition to the safety factor that
/// the bound contains.
const DISPROVEN: f64 = 3.0;

/// Text that names the largest part of an engine's error, for the end of a reason, and advice on how to reduce this
/// part.
fn way_out(parts: Parts) -> (&'static str, Vec<Advice>) {
    match parts.largest() {
        BoundPart::Rounding => {
            (sentences::MOST_OF_IT_IS_ROUNDING, vec![Advice::LargerStep { to: None }, Advice::DoublePrecision])
        }
        BoundPart::Iteration => (sentences::MOST_OF_IT_IS_LEFT_BY_THE_SWEEPS, vec![Advice::MoreSweeps { to: None }]),
        BoundPart::Discretisation => ("", vec![Advice::SmallerStep { to: None }]),
        BoundPart::Reference => (sentences::MOST_OF_IT_IS_THE_REFERENCE, vec![Advice::ShortenGrid]),
    }
}

/// A number that must stay below a bound, in addition to the compared channels.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Check {
    /// The subject of the check. A report shows the checks of one family on one line.
    pub family: String,
    /// Identifies the check within its family; empty if the family has only one check.
    pub detail: String,
    /// The number.
    pub value: f64,
    /// Bound on the number.
    pub bound: f64,
    /// Unit of number and bound; empty for relative numbers.
    pub unit: &'static str,
    /// Basis of the bound.
    pub basis: BoundBasis,
    /// Parts of the bound and the convergence of the runs, if the bound comes from an engine's own runs.
    pub estimate: Option<(Parts, Convergence)>,
    /// The outcome.
    pub verdict: Verdict,
}

impl Check {
    /// A check of a number against a bound.
    pub fn new(family: impl Into<String>, value: f64, tolerance: Tolerance, unit: &'static str) -> Self {
        let Tolerance { bound, basis } = tolerance;
        let verdict = Verdict::of(value, bound, || beyond(value, bound, unit));
        Check { family: family.into(), detail: String::new(), value, bound, unit, basis, estimate: None, verdict }
    }

    /// A check of a relative number whose bound comes from an engine's own runs.
    /// The check is inconclusive in the cases of [`Verdict::of_estimate`], with the scale 1.
    pub fn estimated(
        family: impl Into<String>,
        value: f64,
        convergence: &Convergence,
        parts: Parts,
        basis: BoundBasis,
        wanted: f64,
    ) -> Self {
        let own = Check::new(family, value, Tolerance { bound: parts.sum(), basis }, "");
        let place = || beyond(value, own.bound, "");
        let verdict = Verdict::of_estimate(value, 1.0, convergence, parts, wanted, place);
        Check { estimate: Some((parts, *convergence)), verdict, ..own }
    }

    /// Sets the detail that identifies this check within its family.
    pub fn of(mut self, detail: impl Into<String>) -> Self {
        self.detail = detail.into();
        self
    }

    /// Adds the location of the largest residual to the reason of a disagreement.
    pub fn located(mut self, place: impl FnOnce() -> String) -> Self {
        if let Verdict::Disagree { place: reason } = &mut self.verdict {
            *reason = format!("{reason}, {}", place());
        }
        self
    }

    /// Combines this check, which is against the correct number, with `printed`, the check against the published
    /// number. The entry `finding` of `docs/findings.md` calls the published number wrong.
    /// The check against the published number must disagree, and the check against the correct number must agree.
    /// The verdict is disagree for NaN and for a number that differs from both the published and the correct number.
    pub fn expected(mut self, finding: &str, printed: &Check) -> Self {
        self.verdict = match (self.verdict, &printed.verdict) {
            (_, Verdict::Agree { .. }) => {
                Verdict::Disagree { place: sentences::the_finding_says_that_the_printed(&finding) }
            }
            (Verdict::Agree { .. }, Verdict::Disagree { .. }) => {
                Verdict::Expected { finding: finding.to_string(), off: printed.value }
            }
            (Verdict::Disagree { place }, _) => {
                Verdict::Disagree { place: sentences::neither_the_printed_number_nor(&finding, &place) }
            }
            (verdict @ (Verdict::Agree { .. } | Verdict::Expected { .. } | Verdict::Inconclusive { .. }), _) => verdict,
        };
        self
    }

    /// Family and detail: the name of the check.
    #[must_use]
    pub fn name(&self) -> String {
        if self.detail.is_empty() { self.family.clone() } else { format!("{}, {}", self.family, self.detail) }
    }

    /// Ratio of the number to its bound; infinite for NaN, so that NaN counts as the worst.
    #[must_use]
    pub fn used(&self) -> f64 {
        let used = share(self.value, self.bound);
        if used.is_nan() { f64::INFINITY } else { used }
    }
}

/// Text of a disagreement: the number and its bound.
fn beyond(value: f64, bound: f64, unit: &str) -> String {
    sentences::is_beyond_the_bound(&error_in(value, unit), &error_in(bound, unit))
}

/// Overall verdict: disagree if any verdict is disagree, otherwise inconclusive if any verdict is inconclusive,
/// otherwise agree.
pub fn overall<'a>(verdicts: impl IntoIterator<Item = &'a Verdict>) -> Verdict {
    let mut margin = f64::INFINITY;
    let mut open = None;
    for verdict in verdicts {
        match verdict {
            Verdict::Disagree { .. } => return verdict.clone(),
            Verdict::Inconclusive { .. } => open = open.or(Some(verdict)),
            Verdict::Agree { margin: own } => margin = margin.smaller(*own),
            Verdict::Expected { .. } => {}
        }
    }
    open.cloned().unwrap_or(Verdict::Agree { margin })
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::trajectory::Channel;

    fn residual(max: f64) -> Residual {
        let channel = Channel::named("joint.A.fx_N").unwrap();
        let (worst_time, worst_crank, input) = (0.1, 1.0, linkage::input::Input::Angle);
        Residual { channel, scale: 1.0, max, rms: 0.0, q75: 0.0, q99: 0.0, worst_time, worst_crank, input }
    }

    fn converging(observed: f64) -> Convergence {
        Convergence { observed, formal: 2.0, error: 1e-3, safety: 1.25, iteration: 0.0 }
    }

    #[test]
    fn nan_never_agrees() {
        assert_eq!(Verdict::of(f64::NAN, 1.0, String::new).word(), "disagree");
        assert_eq!(Verdict::of(1.0, f64::NAN, String::new).word(), "disagree");
    }

    #[test]
    fn a_zero_residual_meets_a_zero_bound() {
        assert_eq!(Verdict::of(0.0, 0.0, String::new), Verdict::Agree { margin: f64::INFINITY });
    }

    fn judged(max: f64, observed: f64, discretisation: f64) -> Verdict {
        let parts = Parts { discretisation, ..Parts::default() };
        Verdict::of_engine(&residual(max), &converging(observed), parts, 1e-2)
    }

    #[test]
    fn an_inconclusive_verdict_names_its_remedy() {
        let told = |parts: Parts| match Verdict::of_engine(&residual(1e-4), &converging(2.0), parts, 1e-2) {
            Verdict::Inconclusive { reason, advice } => (reason, advice),
            other @ (Verdict::Agree { .. } | Verdict::Disagree { .. } | Verdict::Expected { .. }) => {
                panic!("{other:?}")
            }
        };
        let (_, advice) = told(Parts { discretisation: 0.5, iteration: 0.1, rounding: 0.1, reference: 0.0 });
        assert_eq!(advice, [Advice::SmallerStep { to: None }]);
        let (reason, advice) = told(Parts { discretisation: 0.1, iteration: 0.5, rounding: 0.1, reference: 0.0 });
        assert!(
            reason.ends_with("iteration error: too few sweeps") && advice == [Advice::MoreSweeps { to: None }],
            "{reason}"
        );
        let (reason, advice) = told(Parts { discretisation: 0.1, iteration: 0.1, rounding: 0.5, reference: 0.0 });
        assert!(reason.ends_with("the largest part is rounding error"), "{reason}");
        assert_eq!(advice, [Advice::LargerStep { to: None }, Advice::DoublePrecision]);
        let (reason, advice) = told(Parts { discretisation: 0.1, iteration: 0.2, rounding: 0.3, reference: 0.7 });
        assert!(reason.ends_with("the error of the reference") && advice == [Advice::ShortenGrid], "{reason}");
        let (reason, _) = told(Parts { iteration: f64::INFINITY, ..Parts::default() });
        assert!(reason.starts_with("the sweeps have hardly begun to converge"), "{reason}");
    }

    #[test]
    fn a_nan_check_uses_infinitely_much_of_its_bound() {
        let used = |value: f64, bound: f64| {
            Check::new("f", value, Tolerance { bound, basis: BoundBasis::Wanted("test") }, "").used()
        };
        assert_eq!([used(1.0, 4.0), used(0.0, 0.0), used(3.0, 0.0)], [0.25, 0.0, f64::INFINITY]);
        assert_eq!([used(f64::NAN, 1.0), used(1.0, f64::NAN)], [f64::INFINITY; 2]);
    }

    #[test]
    fn a_reason_ends_with_its_remedy() {
        let parts = Parts { discretisation: 0.5, ..Parts::default() };
        let open = Verdict::of_engine(&residual(1e-4), &converging(2.0), parts, 1e-2).from_settings(1e-3, false, 0);
        let told = open.reason(Advice::to_string).unwrap();
        assert!(told.ends_with("is inconclusive; choose a smaller time step, such as 5e-4 s"), "{told}");
        assert_eq!(Verdict::open("nothing was run").reason(Advice::to_string).unwrap(), "nothing was run");
        assert_eq!(Verdict::Agree { margin: 1.0 }.reason(Advice::to_string), None);
    }

    #[test]
    fn an_engine_without_convergence_or_too_coarse_is_inconclusive() {
        assert_eq!(judged(1e-4, 2.0, 1e-3).word(), "agree");
        assert_eq!(judged(1e-2, 2.0, 1e-3).word(), "disagree");
        assert_eq!(judged(1e-4, 0.3, 2e-3).word(), "inconclusive");
        // A bound below a tenth of the requested bound needs no order of convergence.
        assert_eq!(judged(1e-4, 0.3, 9e-4).word(), "agree");
        assert_eq!(judged(1e-3, 0.3, 9e-4).word(), "disagree");
        assert_eq!(judged(1e-4, 2.0, 5e-2).word(), "inconclusive");
        // A bound that is too wide to prove agreement cannot disprove a number close to the bound.
        assert_eq!(judged(6e-2, 2.0, 5e-2).word(), "inconclusive");
        assert_eq!(judged(2e-1, 2.0, 5e-2).word(), "disagree");
        assert_eq!(judged(1e-4, f64::NAN, 1e-3).word(), "agree");
    }

    #[test]
    fn an_error_on_a_zero_scale_is_inconclusive() {
        let nothing = Residual { scale: 0.0, ..residual(1e-9) };
        let parts = Parts { discretisation: 1.0, ..Parts::default() };
        let verdict = Verdict::of_engine(&nothing, &converging(2.0), parts, 1e-2);
        assert!(verdict.reason(Advice::to_string).unwrap().contains("zero throughout"), "{verdict:?}");
    }

    #[test]
    fn check_bounds_need_order_and_size_like_channel_bounds() {
        let check = |value: f64, observed: f64, discretisation: f64| {
            let parts = Parts { discretisation, ..Parts::default() };
            Check::estimated("f", value, &converging(observed), parts, BoundBasis::Wanted("test"), 1e-2).verdict
        };
        assert_eq!(check(1e-4, 2.0, 1e-3).word(), "agree");
        assert_eq!(check(2e-3, 2.0, 1e-3).word(), "disagree");
        assert_eq!(check(f64::NAN, 2.0, 1e-3).word(), "disagree");
        assert_eq!(check(1e-4, 2.0, f64::NAN).word(), "disagree");
        assert_eq!(check(1e-4, 0.3, 2e-3).word(), "inconclusive");
        assert_eq!(check(1e-4, 2.0, 5e-2).word(), "inconclusive");
    }

    /// Verdict on the number `found`, if 5 is printed, 7 is correct, and both are known to half a unit.
    fn known_wrong(found: f64) -> Verdict {
        let against = |number: f64| {
            Check::new("f", (found - number).abs(), Tolerance { bound: 0.5, basis: BoundBasis::Wanted("test") }, "N")
        };
        against(7.0).expected("why", &against(5.0)).verdict
    }

    #[test]
    fn a_known_wrong_number_requires_the_corrected_value() {
        assert_eq!(known_wrong(7.2), Verdict::Expected { finding: "why".into(), off: 7.2 - 5.0 });
        let reason = |found: f64| match known_wrong(found) {
            Verdict::Disagree { place } => place,
            other @ (Verdict::Agree { .. } | Verdict::Expected { .. } | Verdict::Inconclusive { .. }) => {
                panic!("{found}: {other:?}")
            }
        };
        assert!(reason(5.2).contains("but the number agrees"));
        for third in [f64::NAN, f64::INFINITY, 9.0, 6.0, -7.0] {
            assert!(reason(third).contains("are both wrong"), "{third}");
        }
    }

    #[test]
    fn the_overall_verdict_is_the_worst_one() {
        let agree = Verdict::Agree { margin: 2.0 };
        let open = Verdict::open("why");
        let no = Verdict::Disagree { place: "there".into() };
        assert_eq!(overall([&agree, &agree]).word(), "agree");
        let closer = Verdict::Agree { margin: 1.5 };
        assert_eq!(overall([&agree, &closer, &agree]), closer);
        assert_eq!(overall([&agree, &open]).word(), "inconclusive");
        assert_eq!(overall([&open, &no]).word(), "disagree");
    }
}
