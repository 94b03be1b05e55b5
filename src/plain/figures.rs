//! The figures of a proof as cells of a table.

use prover::numbers::{fixed, significant, with_unit};
use prover::run::{Proof, ReportedFigure};

/// Significant digits of a figure.
const DIGITS: usize = 5;

/// Name and unit of the instants at which figures occur: the time in a free motion, otherwise the input.
#[must_use]
pub fn place(proof: &Proof) -> (&'static str, &'static str) {
    let case = &proof.scene.case;
    if case.is_free() { ("t", "s") } else { (case.crank().input.word(), case.crank().input.shown_in().0) }
}

/// Name, value, unit and instants of each figure.
#[must_use]
pub fn rows(proof: &Proof) -> Vec<[String; 4]> {
    let row = |own: ReportedFigure| {
        let at = own.rows.iter().map(|row| instant(proof, *row)).collect::<Vec<_>>().join(", ");
        [own.label, significant(own.value, DIGITS), with_unit("", &own.unit).trim_start().to_string(), at]
    };
    proof.figures().into_iter().map(row).collect()
}

fn instant(proof: &Proof, row: usize) -> String {
    let run = &proof.reference_trajectory;
    if proof.scene.case.is_free() {
        significant(run.times()[row], 4)
    } else {
        fixed(run.input().shown(run.inputs()[row]), 1)
    }
}
