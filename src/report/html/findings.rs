//! Findings of a page in words: the reasons of the verdict, and everything else that was found.

use super::markup::escaped;
use crate::plain::judged::{Grade, grade, unproven};
use crate::plain::{Tell, engines, reasons};
use crate::sentences;
use linkage::trajectory::Channel;
use prover::bounds::Verdict;
use prover::run::Proof;

/// Number of reasons at the top of the page; the findings list the other reasons.
const FIRST: usize = 3;
/// Largest number of reasons written in full; the tables of the page have the other reasons.
const MOST: usize = 12;

/// The reason why something disagrees or is open, and the number of verdicts with that reason.
struct Reason {
    key: String,
    told: String,
    count: usize,
}

/// For the top of the page, the reasons why the verdict is not *agree*: the diagnosis and the first reasons.
/// The text is empty if everything agrees.
pub(super) fn why(proof: &Proof, tell: Tell) -> String {
    if agrees(proof) {
        return String::new();
    }
    let mut told = String::new();
    faults(proof, &mut told);
    reasons::diagnosed(proof, None, &mut told);
    write(&grouped(proof, tell), 0..FIRST, &mut told);
    format!("<div id=\"why\">\n{}</div>", paragraphs(&told))
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

/// Reports the failure of a single engine, and engines whose forces disagree.
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
        let more = match reason.count {
            1 => String::new(),
            count => sentences::and_more_alike(&(count - 1)),
        };
        say!(told, "\n{}{more}", reason.told);
    }
}

/// The distinct reasons of all verdicts, disagreements first.
fn grouped(proof: &Proof, tell: Tell) -> Vec<Reason> {
    let mut all: Vec<Reason> = Vec::new();
    for (name, verdict) in unproven(proof) {
        let reason = verdict.reason(tell).unwrap_or_default();
        let key = key(&name, verdict, &reason);
        match all.iter_mut().find(|own| own.key == key) {
            Some(own) => own.count += 1,
            None => all.push(Reason { key, told: format!("{name}: {reason}"), count: 1 }),
        }
    }
    all
}

/// Key under which equivalent reasons are counted once.
/// For an inconclusive verdict, the key is the reason without its numbers.
/// For any other verdict, the key is the cause. If the reason states no cause, the key is the name without its side and
/// channel.
fn key(name: &str, verdict: &Verdict, reason: &str) -> String {
    let bare = name.replace(" (assur)", "").replace(" (newton)", "");
    let channel = bare.split([' ', '(']).next().unwrap_or_default();
    match verdict {
        Verdict::Inconclusive { .. } => reason.replace(|sign: char| sign.is_ascii_digit() || ".e-+".contains(sign), ""),
        Verdict::Agree { .. } | Verdict::Expected { .. } | Verdict::Disagree { .. } => {
            match reason.split_once("cause: ") {
                Some((_, cause)) => cause.to_string(),
                None if Channel::named(channel).is_some() => bare.replacen(channel, "", 1),
                None => bare,
            }
        }
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
    fn equivalent_reasons_have_the_same_key() {
        let open = Verdict::Inconclusive { reason: String::new(), advice: Vec::new() };
        let wrong = Verdict::Disagree { place: String::new() };
        let keys = [("a", "may reach 2.4 %"), ("b", "may reach 46 %")].map(|(name, why)| key(name, &open, why));
        assert_eq!(keys[0], keys[1]);
        let sides = ["x (assur), y", "x (newton), y"].map(|name| key(name, &wrong, "1 N is beyond the bound"));
        assert_eq!(sides[0], sides[1]);
        assert_ne!(sides[0], key("z (assur), y", &wrong, "1 N is beyond the bound"));
        for suffix in ["", " (rapier)", " as the engine exerts it"] {
            let names = ["link.crank.x_m", "point.B.y_m"].map(|name| format!("{name}{suffix}"));
            let keys = names.map(|name| key(&name, &wrong, "1e-3 is beyond 1e-6"));
            assert_eq!(keys[0], keys[1]);
        }
    }

    #[test]
    fn backquoted_formulas_are_rendered_as_code() {
        assert_eq!(paragraphs("a `x<1` b\n\nc `d"), "<p>a <code>x&lt;1</code> b</p>\n<p>c `d</p>\n");
    }
}
