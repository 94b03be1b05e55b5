//! Formulas as checks of a proof.

use crate::sentences;
use std::collections::{BTreeMap, BTreeSet};

use super::each_side::{EachSide, Reference};
use crate::bounds::{Check, Verdict};
use crate::check::{CUT, FormulaAtInstant, FormulaCause, FormulaOutcome, JudgedFormula, Undefined, WORDS};
use crate::numbers::{fixed, input_told, significant};
use crate::tolerance::{BoundBasis, Tolerance};

/// Judgement of all formulas of a scenario.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// For each side, the comparisons of every claim with the side's results: first by value, then by derivative.
    pub sides: EachSide<Vec<Vec<JudgedFormula>>>,
    /// The wrong formulas by name, each with its cause if a simple cause was found.
    pub causes: Vec<(String, Option<FormulaCause>)>,
    /// Wrong formulas that are undefined at some instants: by name, each with the undefined operation.
    pub undefined: BTreeMap<String, Undefined>,
    /// Names of the wrong formulas for which the search for a cause reached its work limit.
    pub unsought: BTreeSet<String>,
    /// Number of operations of all searches.
    pub work: u64,
}

impl Judgement {
    /// The comparisons of the claims with the results of `sides`, without causes of wrong formulas.
    pub fn of(sides: EachSide<Vec<Vec<JudgedFormula>>>) -> Self {
        Judgement { sides, causes: Vec::new(), undefined: BTreeMap::new(), unsought: BTreeSet::new(), work: 0 }
    }
}

/// One check for every claim, and for every derivative that could be judged, for each side.
pub fn checks(judgement: &Judgement) -> Vec<Check> {
    let causes: BTreeMap<&str, String> = judgement
        .causes
        .iter()
        .filter_map(|(name, cause)| {
            let words = match cause {
                Some(cause) if judgement.unsought.contains(name) => sentences::cause_perhaps_another(&cause, &CUT),
                Some(cause) => format!("cause: {cause}"),
                None if judgement.unsought.contains(name) => sentences::cause_not_found(&CUT),
                None => return None,
            };
            Some((name.as_str(), words))
        })
        .collect();
    let of_side = |(side, all): (Reference, &Vec<Vec<JudgedFormula>>)| -> Vec<Check> {
        let words = |judged: &JudgedFormula| {
            let undefined =
                judgement.undefined.get(&judged.name).filter(|_| judged.order == 0).map(ToString::to_string);
            let all: Vec<String> = undefined.into_iter().chain(causes.get(judged.name.as_str()).cloned()).collect();
            all.join("; ")
        };
        all.iter().flatten().map(|judged| check(side, judged, &words(judged))).collect()
    };
    judgement.sides.iter().flat_map(of_side).collect()
}

/// Beginning of the family name of formula checks; the name of the side follows.
const FAMILY: &str = "formulas (";

/// Whether a check belongs to a formula.
pub(super) fn is_of_formula(check: &Check) -> bool {
    check.family.starts_with(FAMILY)
}

/// The check of a judged formula. `why` is the cause of the formula's error; empty if the cause is unknown.
fn check(side: Reference, judged: &JudgedFormula, why: &str) -> Check {
    let (value, bound) = judged.worst.map_or((0.0, 0.0), |worst| (worst.difference.abs(), worst.bound));
    let tolerance = Tolerance { bound, basis: BoundBasis::Formula { claimed: judged.claimed } };
    let mut check = Check::new(format!("{FAMILY}{side})"), value, tolerance, judged.unit).of(name(judged));
    match judged.outcome() {
        FormulaOutcome::Open { reason, advice } => check.verdict = Verdict::Inconclusive { reason, advice },
        FormulaOutcome::Expected { finding } => check.verdict = Verdict::Expected { finding, off: value },
        FormulaOutcome::Wrong if judged.since.is_none() => {
            let finding = judged.finding.as_deref().unwrap_or_default();
            check.verdict = Verdict::Disagree { place: sentences::the_finding_calls_the_formula(&finding) };
            return check;
        }
        FormulaOutcome::Right | FormulaOutcome::Wrong => {}
    }
    check.located(|| {
        let place = judged.since.map_or_else(String::new, |since| place(&since));
        if why.is_empty() { place } else { format!("{place}; {why}") }
    })
}

/// Name of a formula with its claim and the order of its derivative.
fn name(judged: &JudgedFormula) -> String {
    let of = match judged.order {
        0 => String::new(),
        order => format!("{} of ", WORDS[order]),
    };
    format!("{of}{} as {}", judged.name, judged.claim)
}

/// The first instant beyond the bound, with both values, in words.
fn place(since: &FormulaAtInstant) -> String {
    let FormulaAtInstant { time, crank, input, formula, mechanism, .. } = since;
    let found = if formula.is_nan() {
        sentences::IT_HAS_NO_VALUE.to_string()
    } else {
        sentences::it_gives(&significant(*formula, 9))
    };
    sentences::first_at(&fixed(*time, 6), &input_told(input.at(*crank), 3), &found, &significant(*mechanism, 9))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::solved::judge;
    use fixtures::of_repository;
    use scenario::Claim;

    /// The formula is undefined below 0.5 rad. Below this angle, the derivatives of the formula have values, which are
    /// wrong for another reason.
    #[test]
    fn only_the_value_is_reported_as_undefined() {
        let mut scenario = of_repository("scenarios/crank_rocker.toml");
        let claim = Claim::parse("link.crank.angle_deg", &scenario.case).unwrap();
        scenario.formulas.add("late", "phi*180/pi + 0.001*ln(phi - 0.5)").unwrap().claim = Some(claim);
        let judgement = judge(&scenario).unwrap().judgement;
        let judged: Vec<&JudgedFormula> = judgement.sides.iter().flat_map(|(_, all)| all.iter().flatten()).collect();
        let checks = checks(&judgement);
        assert_eq!((judged.len(), checks.len()), (6, 6));
        for (judged, check) in judged.into_iter().zip(checks) {
            let Verdict::Disagree { place } = &check.verdict else { panic!("{} {:?}", check.name(), check.verdict) };
            assert_eq!(place.contains("is undefined"), judged.order == 0, "{}: {place}", check.name());
            assert_eq!(place.contains("it has no value"), judged.order == 0, "{}: {place}", check.name());
        }
    }
}
