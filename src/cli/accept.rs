//! `linkproof accept`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::engine_args::EngineArgs;
use super::exit_code::graver;
use super::output::End;
use super::outputs::{Outputs, results};
use super::progress::Bar;
use super::{advice, exit_code, output};
use crate::plain::brief;
use crate::report::accept::{Deed, Document, Item, text};
use linkage::error::{Error, ErrorKind, Result};
use prover::accept::{compared, figures, renewed};
use prover::run::{Proof, Reference, memory, prove_with};
use scenario::Scenario;
use scenario::accepted::{self, beside};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/accept.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Write nothing: judge the run against the accepted figures, and show the changes
    #[arg(long, conflicts_with = "unproven")]
    check: bool,
    /// Also accept figures if the proof disagrees or is inconclusive; the file then states this verdict
    #[arg(long)]
    unproven: bool,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    outputs: Outputs<AcceptResults>,
}

results! { AcceptResults {
    Json = "the results",
} }

/// Processes all files. If a file is bad, the remaining files are still processed.
pub(super) fn run(args: &Args) -> u8 {
    let mut document = Document::told_by(advice::told);
    let mut worst = exit_code::AGREE;
    for file in &args.files {
        let code = one(args, file, &mut document).unwrap_or_else(|error| {
            output::show(&error);
            document.add_failure(&file.display().to_string(), &error);
            exit_code::BAD_INPUT
        });
        worst = graver(worst, code);
    }
    graver(worst, args.outputs.write(|_| Ok(document.text())).code())
}

/// Accepts or judges the figures of one file, and returns the exit code.
fn one(args: &Args, file: &Path, document: &mut Document) -> Result<u8> {
    let scenario = Scenario::load(file)?;
    let place = beside(file);
    let kept = accepted::load(&place, &scenario.name)?;
    if args.check && kept.is_none() {
        let message = sentences::nothing_was_accepted_of_there(&file.display(), &place.display());
        let help = sentences::linkproof_accept_writes_it(&file.display());
        return Err(Error::new(ErrorKind::Io, message).help(help));
    }
    let proof = proven(args, &scenario)?;
    let found = figures(&proof);
    let comparison = kept.as_ref().map(|kept| compared(kept, &found));
    let is_proven = exit_code::of(&proof.verdict) == exit_code::AGREE;
    let (deed, written) = match kept.as_ref().zip(comparison.as_ref()) {
        Some(_) if args.check => (Deed::Checked, None),
        _ if !is_proven && !args.unproven => (Deed::Refused, None),
        None => (Deed::Written, Some(found.clone())),
        Some((_, comparison)) if comparison.is_same() => (Deed::Kept, None),
        Some((kept, comparison)) => (Deed::Renewed, Some(renewed(kept, found.clone(), comparison))),
    };
    if let Some(figures) = written {
        // An existing file may be replaced: it was read above as the accepted figures of this scenario.
        output::make_by(accepted::text(&figures).as_bytes(), &place, &|_| kept.is_some())?;
    }
    let item = Item { proof: &proof, found: &found, comparison: comparison.as_ref(), deed, file: &place };
    document.add(&item);
    if !args.outputs.take_standard() {
        output::print(&text(&item))?;
        let proofs = comparison.as_ref().and_then(|comparison| comparison.proof.as_ref());
        let is_worse = proofs.is_some_and(|[_, found]| found != "agree");
        if !is_proven && (deed == Deed::Refused || deed == Deed::Checked && is_worse) {
            output::report(&format!("\n{}", brief::proof(&proof, advice::told, output::columns())))?;
        }
    }
    Ok(match (deed, &comparison) {
        (Deed::Checked, Some(comparison)) => exit_code::of(&comparison.verdict),
        (Deed::Refused, _) => exit_code::of(&proof.verdict),
        (Deed::Written | Deed::Renewed | Deed::Kept | Deed::Checked, _) => exit_code::AGREE,
    })
}

/// The proof of a scenario.
fn proven(args: &Args, scenario: &Scenario) -> Result<Proof> {
    let options = args.engine.options(Reference::default());
    args.engine.memory.tell(&scenario.case, memory::of_proof(&scenario.case, options.engine_count()));
    let mut bar = Bar::new(&scenario.name);
    prove_with(scenario, &options, &mut |part| bar.at(part))
}
