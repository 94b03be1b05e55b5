//! Formulas as checks of a proof.

use crate::claims::{At, Judged, Outcome, WORDS};
use crate::compare::{Check, Verdict};
use crate::tolerance::{Basis, Tolerance};

/// A check for every claim, and for every derivative that could be judged, of both sides.
pub(super) fn checks(sides: &[(&'static str, Vec<Vec<Judged>>); 2]) -> Vec<Check> {
    let of_side = |(side, all): &(&'static str, Vec<Vec<Judged>>)| -> Vec<Check> {
        all.iter().flatten().map(|judged| check(side, judged)).collect()
    };
    sides.iter().flat_map(of_side).collect()
}

fn check(side: &str, judged: &Judged) -> Check {
    let (value, bound) = judged.worst.map_or((0.0, 0.0), |worst| (worst.difference.abs(), worst.bound));
    let tolerance = Tolerance { bound, basis: Basis::Formula { claimed: judged.claimed } };
    let mut check = Check::new(format!("formulas ({side})"), value, tolerance, judged.unit).of(name(judged));
    if let Outcome::Open { reason, advice } = judged.outcome() {
        check.verdict = Verdict::Inconclusive { reason, advice };
    }
    check.located(|| judged.since.map_or_else(String::new, |since| place(&since)))
}

/// A formula with its claim, and which derivative.
fn name(judged: &Judged) -> String {
    let of = match judged.order {
        0 => String::new(),
        order => format!("{} of ", WORDS[order]),
    };
    format!("{of}{} as {}", judged.name, judged.claim)
}

/// Since when, in words.
fn place(since: &At) -> String {
    let At { time, crank, formula, mechanism, .. } = since;
    let found = if formula.is_nan() { "it has no value".to_string() } else { format!("it gives {formula:.9e}") };
    format!(
        "first at t = {time:.6} s, crank angle {:.3} deg: {found}, the mechanism {mechanism:.9e}",
        crank.to_degrees()
    )
}
