//! Multiplies all bounds of a proof by one factor, to show how close the proof is to its bounds.

use super::{EngineProof, Proof, parties};
use crate::bounds::{Check, Verdict, overall};
use crate::numbers::error;
use crate::sentences;

impl Proof {
    /// This proof, judged again with every bound multiplied by `dial`. The judgement is stricter if `dial` is below 1.
    /// With `dial` = 0, only a residual of exactly zero agrees.
    ///
    /// Residuals do not change.
    /// Inconclusive verdicts do not change either, because their bounds decide nothing.
    #[must_use]
    pub fn with_bounds_scaled(mut self, dial: f64) -> Self {
        self.engines.iter_mut().for_each(|engine| scale_engine(engine, dial));
        self.checks.iter_mut().for_each(|check| scale(check, dial));
        if self.engines.len() > 1 {
            self.disputes = parties::disputes(self.reference, &self.reference_trajectory, &self.engines);
        }
        let analytic = overall(self.checks.iter().map(|check| &check.verdict));
        self.verdict = overall([&analytic].into_iter().chain(self.engines.iter().map(|engine| &engine.verdict)));
        // The diagnosis is dropped if the bounds change. A diagnosis is valid only for the bounds with which it was
        // made.
        self.diagnosis = self.diagnosis.filter(|_| dial == 1.0);
        self.diagnosis_is_cut &= dial == 1.0;
        self
    }
}

fn scale_engine(engine: &mut EngineProof, dial: f64) {
    for channel in &mut engine.channels {
        judge(&mut channel.verdict, channel.residual.max, &mut channel.bound, dial);
    }
    engine.checks.iter_mut().for_each(|check| scale(check, dial));
    engine.own_forces.iter_mut().for_each(|own| scale_engine(own, dial));
    if engine.failure.is_none() {
        engine.conclude();
    }
}

fn scale(check: &mut Check, dial: f64) {
    judge(&mut check.verdict, check.value, &mut check.bound, dial);
}

/// Renews a verdict that is based on a bound.
/// A published number that `docs/findings.md` calls wrong may have the verdict `disagree` although it is within its
/// bound. This verdict does not change.
fn judge(verdict: &mut Verdict, value: f64, bound: &mut f64, dial: f64) {
    let beyond = !(value <= *bound);
    *bound *= dial;
    let again = Verdict::of(value, *bound, || sentences::is_beyond_the_scaled_bound(&error(value), &error(*bound)));
    match (&*verdict, &again) {
        (Verdict::Agree { .. }, _) => *verdict = again,
        (Verdict::Disagree { .. }, _) if beyond => *verdict = again,
        // The verdict was `expected`, because the number agreed with the corrected value. With the new bound the number
        // does not agree, so the verdict becomes `disagree`.
        (Verdict::Expected { .. }, Verdict::Disagree { .. }) => *verdict = again,
        (Verdict::Disagree { .. } | Verdict::Expected { .. } | Verdict::Inconclusive { .. }, _) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(verdict: Verdict, value: f64, dial: f64) -> (&'static str, f64) {
        let (mut verdict, mut bound) = (verdict, 2.0);
        judge(&mut verdict, value, &mut bound, dial);
        (verdict.word(), bound)
    }

    #[test]
    fn the_tolerance_scale_changes_bounds_but_no_open_verdict() {
        let agree = || Verdict::Agree { margin: 2.0 };
        let disagree = || Verdict::Disagree { place: String::new() };
        assert_eq!(judged(agree(), 1.0, 0.5), ("agree", 1.0));
        assert_eq!(judged(agree(), 1.0, 0.4), ("disagree", 0.8));
        assert_eq!(judged(disagree(), 3.0, 2.0), ("agree", 4.0));
        assert_eq!(judged(disagree(), f64::NAN, 2.0).0, "disagree");
        assert_eq!(judged(disagree(), 1.0, 2.0).0, "disagree");
        let expected = || Verdict::Expected { finding: String::new(), off: 5.0 };
        assert_eq!(judged(expected(), 1.0, 0.5).0, "expected");
        assert_eq!(judged(expected(), 1.0, 0.4).0, "disagree");
        assert_eq!(judged(Verdict::open("why"), 1.0, 2.0).0, "inconclusive");
    }
}
