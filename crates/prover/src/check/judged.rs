//! Compares a formula's values with the mechanism's values.

use crate::sentences;
use formula::Rounded;
use linkage::error::Advice;
use linkage::input::Input;
use linkage::math::KeepNan;
use scenario::{Claim, Formula};

/// Formula and mechanism at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormulaAtInstant {
    /// Time (s).
    pub time: f64,
    /// Value of the input (SI unit, in the scenario's convention).
    pub crank: f64,
    /// What `crank` measures.
    pub input: Input,
    /// Value of the formula.
    pub formula: f64,
    /// Value of the mechanism.
    pub mechanism: f64,
    /// Formula minus mechanism; for angles, without whole revolutions.
    pub difference: f64,
    /// Largest difference allowed.
    pub bound: f64,
}

impl FormulaAtInstant {
    /// Difference divided by bound; infinite if the difference is not a number.
    #[must_use]
    pub fn used(&self) -> f64 {
        let used = if self.difference == 0.0 { 0.0 } else { self.difference.abs() / self.bound };
        if used.is_nan() { f64::INFINITY } else { used }
    }
}

/// Values of a formula and of the mechanism at an instant. `place` holds the time (s) and the value of the input (SI).
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) place: [f64; 2],
    pub(super) input: Input,
    pub(super) formula: Rounded,
    pub(super) mechanism: Rounded,
}

/// Outcome of a judgement.
#[derive(Clone, Debug, PartialEq)]
pub enum FormulaOutcome {
    /// The formula is right at every instant judged.
    Right,
    /// The formula is wrong, or is right although a finding calls it wrong.
    Wrong,
    /// The formula is wrong, as `docs/findings.md` states.
    Expected {
        /// Anchor of the section of `docs/findings.md`.
        finding: String,
    },
    /// Inconclusive.
    Open {
        /// Why the judgement is inconclusive.
        reason: String,
        /// What the user can do to get a conclusive judgement.
        advice: Vec<Advice>,
    },
}

/// A formula judged by value, or by a derivative.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JudgedFormula {
    /// Name of the formula.
    pub name: String,
    /// The quantity that the formula claims to give.
    pub claim: String,
    /// Unit of the claimed values; empty for a derivative, and for an expression of several channels.
    pub unit: &'static str,
    /// Number of derivatives with respect to time (s): 0, 1 or 2.
    pub order: usize,
    /// Whether the bound includes an error that the formula itself states.
    pub claimed: bool,
    /// Number of instants judged.
    pub judged: usize,
    /// Number of instants at which the formula has lost too many digits to be judged.
    pub lost: usize,
    /// Number of instants at which the claimed quantity is undefined, such as a value reduced to a crank at rest.
    pub undefined: usize,
    /// Number of instants at which the claimed quantity is defined but the formula is not.
    pub without: usize,
    /// First instant at which the bound is exceeded.
    pub since: Option<FormulaAtInstant>,
    /// Instant with the largest ratio of difference to bound.
    pub worst: Option<FormulaAtInstant>,
    /// Largest absolute value of the claimed quantity of the mechanism.
    pub scale: f64,
    /// Anchor of the section of `docs/findings.md` that calls the formula wrong.
    pub finding: Option<String>,
}

/// Digits of a formula can count as lost only if its error exceeds this fraction of the scale: see `NO_WORSE`.
const TELLING: f64 = 1e-6;
/// If a formula's error is at most this multiple of the mechanism's error, no digits count as lost.
/// The limit allows for a few products of numbers that are known as accurately as the mechanism's numbers.
const NO_WORSE: f64 = 1e3;
/// If digits count as lost at more than this fraction of the instants, the judgement is inconclusive.
const MOST_LOST: f64 = 0.03;

/// Whether the mechanism's value is defined.
fn has_number(mechanism: Rounded) -> bool {
    mechanism.value.is_finite() && mechanism.error.is_finite()
}

impl JudgedFormula {
    /// Starts the judgement of a formula against its claim. `order` is the number of time derivatives that are taken of
    /// both.
    pub(super) fn new((formula, claim): (&Formula, &Claim), order: usize) -> Self {
        JudgedFormula {
            name: formula.name.clone(),
            claim: claim.text.clone(),
            unit: if order == 0 { claim.unit() } else { "" },
            order,
            claimed: formula.error.is_some(),
            finding: formula.finding.clone(),
            ..JudgedFormula::default()
        }
    }

    /// Judges the values of a formula and its claim. Angles that differ by a multiple of `turn` are equal.
    pub(super) fn of(
        (formula, claim): (&Formula, &Claim),
        turn: Option<f64>,
        course: impl Iterator<Item = Pair> + Clone,
    ) -> Self {
        let mut own = JudgedFormula::new((formula, claim), 0);
        course.clone().for_each(|pair| own.seen(pair.mechanism));
        course.for_each(|pair| own.put(formula, turn, pair));
        own
    }

    /// Includes one value of the claimed quantity in the scale, which is the largest magnitude of these values.
    /// All values must be passed to this function before the first instant is judged.
    pub(super) fn seen(&mut self, mechanism: Rounded) {
        if has_number(mechanism) { self.scale = self.scale.larger(mechanism.value.abs()) } else { self.undefined += 1 }
    }

    /// Judges one instant.
    pub(super) fn put(&mut self, formula: &Formula, turn: Option<f64>, pair: Pair) {
        let Pair { place: [time, crank], input, formula: found, mechanism } = pair;
        if !has_number(mechanism) {
            return;
        }
        self.without += usize::from(found.is_undefined());
        let difference = found.value - mechanism.value;
        let difference = turn.map_or(difference, |turn| difference - turn * (difference / turn).round());
        // An undefined value has no rounding error.
        let rounding = if found.is_undefined() { 0.0 } else { found.error };
        let bound = formula.error.unwrap_or(0.0) + rounding + mechanism.error;
        let (value, right) = (found.value, mechanism.value);
        let at = FormulaAtInstant { time, crank, input, formula: value, mechanism: right, difference, bound };
        // Digits count as lost only if the mechanism's value is much more accurate than the formula's value. If both
        // values are inaccurate, the formula is not the cause.
        let has_lost = !(found.error <= TELLING * self.scale) && !(found.error <= NO_WORSE * mechanism.error);
        // At the end of a function's domain, such as acos at 1, the derivative is not finite although the value is
        // right. A derivative that is not finite therefore counts as an instant with lost digits.
        let is_end = self.order > 0 && !found.value.is_finite();
        if is_end || has_lost && at.used() <= 1.0 {
            self.lost += 1;
            return;
        }
        self.judged += 1;
        if !(at.used() <= 1.0) && self.since.is_none_or(|since| time < since.time) {
            self.since = Some(at);
        }
        if self.worst.is_none_or(|worst| at.used() > worst.used()) {
            self.worst = Some(at);
        }
    }

    /// Returns the outcome.
    #[must_use]
    pub fn outcome(&self) -> FormulaOutcome {
        if self.since.is_some() {
            let expected = |finding: &String| FormulaOutcome::Expected { finding: finding.clone() };
            return self.finding.as_ref().map_or(FormulaOutcome::Wrong, expected);
        }
        let open = |reason: String, advice: &str| FormulaOutcome::Open { reason, advice: vec![advice.into()] };
        let all = self.judged + self.lost;
        match self.worst {
            None if all == 0 && self.undefined > 0 => {
                open(sentences::the_claim_has_no_number_at_any(&self.undefined), sentences::CLAIM_IT_WHERE_THE_CRANK)
            }
            None if all == 0 => {
                open(sentences::NO_INSTANT_LIES_BETWEEN_THE_CRANK.into(), sentences::LET_THE_GRID_COME_TO_THEM)
            }
            Some(_) if self.lost as f64 <= MOST_LOST * all as f64 => match self.finding {
                Some(_) => FormulaOutcome::Wrong,
                None => FormulaOutcome::Right,
            },
            _ => open(
                sentences::rounding_leaves_the_formula_less(&self.lost, &all),
                sentences::WRITE_IT_SO_THAT_NO_DIGITS,
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixtures::of_repository;
    use scenario::Formulas;

    /// A formula's value decides nothing if its error exceeds both 1e-6 of the scale and a thousand times the
    /// mechanism's error.
    #[test]
    fn lost_digits_count_only_if_the_mechanism_has_them() {
        let case = of_repository("scenarios/crank_rocker.toml").case;
        let claim = Claim::parse("link.rocker.omega_rad_s", &case).unwrap();
        let mut formulas = Formulas::over(Vec::new());
        let formula = formulas.add("f", "2").unwrap();
        let claimed = |error: f64, own: f64| {
            let of = |row: u32| Pair {
                place: [f64::from(row), f64::from(row)],
                input: Input::Angle,
                formula: Rounded { value: 2.0, error: 2.0 * error },
                mechanism: Rounded { value: 2.0, error: 2.0 * own },
            };
            let judged = JudgedFormula::of((&*formula, &claim), None, (0..10).map(of));
            (judged.outcome() == FormulaOutcome::Right, judged.judged, judged.lost)
        };
        let (right, lost) = ((true, 10, 0), (false, 0, 10));
        let cases =
            [(9e-7, 0.0, right), (1e-4, 0.0, lost), (1e-4, 1e-6, right), (1e-4, 1e-8, lost), (1e-2, 1e-6, lost)];
        for (error, own, wanted) in cases {
            assert_eq!(claimed(error, own), wanted, "{error} {own}");
        }
    }
}
