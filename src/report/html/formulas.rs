//! Formulas of a proof as curves beside the quantities that they claim.

use serde_json::{Value, json};

use super::markup::singles;
use crate::plain::formula_blocks::lines;
use prover::check::{JudgedFormula, KnownTrajectory};
use prover::run::Proof;
use scenario::{Claim, Formula};

/// Number of single-precision values that a formula adds to each row of the page's columns.
pub(super) const WIDTH: usize = 2;

/// A formula at all instants of the reference, in the unit of its claim.
pub(super) struct FormulaCurve<'a> {
    judged: &'a JudgedFormula,
    verdict: &'static str,
    mechanism: Vec<f64>,
    /// Formula minus mechanism; NaN where one of them has no value, or where the formula is not claimed to hold.
    difference: Vec<f64>,
}

/// The formulas that claim the values of a quantity at all instants, and not figures of it; in the order of the file.
pub(super) fn of(proof: &Proof) -> Vec<FormulaCurve<'_>> {
    let Some(judgement) = &proof.judgement else { return Vec::new() };
    let (case, run) = (&proof.scene.case, &proof.reference_trajectory);
    let exact = |_: usize, _: usize| 0.0;
    let course = KnownTrajectory::new(case, run, &exact);
    let curve = |judged, formula: &Formula, claim: &Claim| {
        let found = course.values(claim).ok()?;
        let mechanism: Vec<f64> =
            found.iter().map(|own| if own.is_undefined() { f64::NAN } else { own.value }).collect();
        let given = course.formula(&proof.formulas, formula);
        let off = |row: usize| {
            let value = given[row].filter(|_| formula.holds_at(run.inputs()[row])).unwrap_or(f64::NAN);
            let off = value - mechanism[row];
            off - claim.turn().map_or(0.0, |turn| turn * (off / turn).round())
        };
        let difference = (0..mechanism.len()).map(off).collect();
        // The verdict of the check is shown, because `--tolerance-scale` scales the bound of the check, but not the
        // bound of the formula.
        let check =
            proof.formula_checks().find(|(own, check)| own.name == formula.name && check.verdict.word() == "disagree");
        let own = proof.formula_checks().find(|(own, _)| own.name == formula.name && own.order == 0);
        let verdict = check.or(own)?.1.verdict.word();
        Some(FormulaCurve { judged, verdict, mechanism, difference })
    };
    let values = lines(&proof.formulas, judgement).into_iter().filter(|line| line.judged.order == 0);
    let with_claim = values.filter_map(|line| Some((line.judged, line.formula, line.formula.claim.as_ref()?)));
    let courses = with_claim.filter(|(_, _, claim)| claim.figures.is_empty());
    courses.filter_map(|(judged, formula, claim)| curve(judged, formula, claim)).collect()
}

impl FormulaCurve<'_> {
    /// The curve at these rows, for the script of a page.
    pub(super) fn json(&self, rows: &[usize]) -> Value {
        let at = |values: &[f64]| singles(rows.iter().map(|row| values[*row]));
        let worst = self.judged.worst.as_ref();
        json!({
            "name": self.judged.name, "claim": self.judged.claim, "unit": self.judged.unit, "verdict": self.verdict,
            "bound": worst.map(|own| own.bound), "max": worst.map(|own| own.difference.abs()),
            "mechanism": at(&self.mechanism), "difference": at(&self.difference),
        })
    }
}
