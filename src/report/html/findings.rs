//! Findings of a page in words: the reasons of the verdict, and everything else that was found.

use super::markup::escaped;
use crate::plain::judged::{Grade, grade};
use crate::plain::reasons::{Reason, grouped};
use crate::plain::{Tell, engines, reasons};
use crate::sentences;
use prover::run::Proof;

/// Number of reasons at the top of the page; the findings list the other reasons.
const FIRST: usize = 3;
/// Largest number of reasons written in full; the tables of the page have the other reasons.
const MOST: usize = 12;

/// For the top of the page, the reasons why the verdict is not *agree*: faults, diagnosis, first reasons and formulas.
/// The text is empty if everything agrees.
pub(super) fn why(proof: &Proof, tell: Tell) -> String {
    if agrees(proof) {
        return String::new();
    }
    let mut told = String::new();
    faults(proof, &mut told);
    reasons::diagnosed(proof, None, &mut told);
    write(&grouped(proof, tell), 0..FIRST, &mut told);
    let blocks = reasons::formulas(proof, tell, None).into_iter().take(MOST);
    let formulas: String = blocks.map(|block| format!("<pre>{}</pre>\n", escaped(&block))).collect();
    format!("<div id=\"why\">\n{formulas}{}</div>", paragraphs(&told))
}

/// All findings that `why` does not show at the top of the page; the text is empty if there are none.
pub(super) fn others(proof: &Proof, tell: Tell) -> String {
    let mut told = String::new();
    if proof.engines.len() > 1 {
        say!(told, sentences::engines_and_reference_against_each(&engines::disputes(proof)));
    }
    // If the proof does not agree, `why` has already reported the faults at the top of the page.
    if agrees(proof) {
        faults(proof, &mut told);
    }
    let all = grouped(proof, tell);
    write(&all, if agrees(proof) { 0 } else { FIRST }..MOST, &mut told);
    if all.len() > MOST {
        say!(told, sentences::of_more_the_channels_and_the_table(&(all.len() - MOST)));
    }
    reasons::notes(proof, None, &mut told);
    reasons::expected(proof, tell, &mut told);
    paragraphs(&told)
}

fn agrees(proof: &Proof) -> bool {
    grade(&proof.verdict) == Grade::Agree
}

/// Reports the failure of the engine if the proof has only one, and engines whose forces disagree.
fn faults(proof: &Proof, told: &mut String) {
    for engine in &proof.engines {
        if let (Some(error), 1) = (&engine.failure, proof.engines.len()) {
            say!(told, "{} failed: {}\n", engine.info.name, error.message());
        }
        if let Some(fault) = engine.force_fault() {
            say!(told, "{}\n", engines::sentence(fault));
        }
    }
}

fn write(all: &[Reason], which: std::ops::Range<usize>, told: &mut String) {
    for reason in all.iter().skip(which.start).take(which.len()) {
        say!(told, "\n{}", reason.text());
    }
}

/// Converts blocks between empty lines to paragraphs, keeps line breaks, and converts text in backticks to code.
fn paragraphs(told: &str) -> String {
    let blocks = told.split("\n\n").map(str::trim).filter(|block| !block.is_empty());
    blocks.map(|block| format!("<p>{}</p>\n", coded(&escaped(block)).replace('\n', "<br>\n"))).collect()
}

fn coded(told: &str) -> String {
    let parts: Vec<&str> = told.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return told.to_string();
    }
    let part = |(index, part): (usize, &&str)| match index % 2 {
        0 => (*part).to_string(),
        _ => format!("<code>{part}</code>"),
    };
    parts.iter().enumerate().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backquoted_formulas_are_rendered_as_code() {
        assert_eq!(paragraphs("a `x<1` b\n\nc `d"), "<p>a <code>x&lt;1</code> b</p>\n<p>c `d</p>\n");
    }
}
