//! The work of a proof: how often and why each part was done, and the parts that the proof did not need.

use crate::plain::cells::some;
use crate::sentences;
use linkage::case::{Case, LeftOut};
use linkage::trajectory::Stage;
use linkage::work::Work;
use prover::run::{LedgerEntry, Proof};

/// The text about one proof. `further` has the work of the command besides the proof, such as the recording.
#[must_use]
pub fn text(proof: &Proof, further: &[LedgerEntry]) -> String {
    let case = &proof.scene.case;
    let mut text = sentences::what_ran_how_often_and_why(&proof.scenario);
    say!(text, "requested  {}", asked(case));
    say!(text, sentences::left_out(&left_out(&proof.scene.left_out)));
    let entries = || proof.work.iter().chain(further);
    say!(text, "Ran:");
    for entry in entries() {
        if let Some(work) = &entry.work {
            say!(text, "  {}: {}\n      {}", entry.part, entry.why, counts(work));
        }
    }
    say!(text, "Skipped:");
    for (part, why) in skipped(case, entries()) {
        say!(text, "  {part}: {why}");
    }
    text
}

/// One line with the requested stages or channels, and the number of instants.
fn asked(case: &Case) -> String {
    let (own, all) = (case.channels(), case.all_channels().len());
    let stages: Vec<&str> = Stage::ALL.into_iter().filter(|&stage| case.wanted.has(stage)).map(Stage::name).collect();
    let instants = case.grid.len();
    match &case.only {
        None => sentences::of_everything_at_instants_of_channels(&stages.join(", "), &instants, &own.len(), &all),
        Some(only) => sentences::at_instants(&some(&only[..], SHOWN), &instants),
    }
}

/// Number of names that are listed; further names are only counted.
const SHOWN: usize = 8;

fn left_out(left: &LeftOut) -> String {
    if left.is_empty() {
        return sentences::NOTHING_EVERY_PART_OF_THE_MECHANISM.into();
    }
    let listed = |what: &str, names: &[String]| match names.len() {
        0 => None,
        count if count > SHOWN => Some(format!("{count} {what}")),
        _ => Some(format!("{what} {}", names.join(", "))),
    };
    let loads = (left.loads > 0).then(|| format!("{} loads", left.loads));
    let all = [listed("links", &left.links), listed("joints", &left.joints), listed("drives", &left.drives), loads];
    sentences::nothing_asked_depends_on_them(&(all.into_iter().flatten().collect::<Vec<_>>().join("; ")))
}

/// `361 poses, 722 groups`, or a note that nothing is counted.
fn counts(work: &Work) -> String {
    let all: Vec<String> = work.iter().map(|(what, times)| format!("{times} {}", what.name())).collect();
    if all.is_empty() { sentences::NOTHING_THAT_IS_COUNTED.into() } else { all.join(", ") }
}

fn skipped<'a>(case: &'a Case, entries: impl Iterator<Item = &'a LedgerEntry>) -> Vec<(String, String)> {
    let stages = Stage::ALL.into_iter().filter(|&stage| stage > case.wanted.deepest());
    let mut all: Vec<(String, String)> =
        stages.map(|stage| (stage.name().replace('_', " "), sentences::NOTHING_ASKED_NEEDS_THEM.into())).collect();
    all.extend(entries.filter(|entry| entry.work.is_none()).map(|entry| (entry.part.clone(), entry.why.into())));
    all
}
