//! `linkproof mutate`.

use crate::sentences;
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;

use super::engine_args::EngineArgs;
use super::load::plain;
use super::outputs::{Outputs, results};
use super::progress::Bar;
use super::{advice, exit_code, load, output};
use crate::plain::errors;
use crate::report::mutate as report;
use lab::mutate::{FaultTally, FaultyParty, MutationPlan, all, mutate, named, tally};
use linkage::error::Result;
use prover::run::Reference;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/mutate.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(required_unless_present = "list", value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Kind of fault, or family of kinds. May be given several times [default: all]
    #[arg(long, value_name = "KIND", value_parser = kind)]
    kind: Vec<String>,
    /// Party that gets the fault. May be given several times [default: each party in turn]
    #[arg(long, value_name = "PARTY", value_parser = PossibleValuesParser::new(FaultyParty::ALL.map(FaultyParty::name)))]
    party: Vec<String>,
    /// Do not search for the size below which a fault is missed
    #[arg(long)]
    no_sizes: bool,
    /// Number of faults tested in parallel; results do not depend on it [default: the number of cores]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    jobs: usize,
    /// List the kinds of faults
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    outputs: Outputs<Mutations>,
}

results! { Mutations {
    Json = "the results",
    Markdown = "figures and tables",
} }

/// Plants faults in the proof of every file. If a file is bad, the remaining files are still processed.
pub(super) fn run(args: &Args) -> Result<u8> {
    if args.list {
        return output::print(&report::all_kinds(output::width())).map(|()| exit_code::AGREE);
    }
    let options = args.engine.options(Reference::Assur);
    if options.engine_count() > 1 {
        let message = sentences::found_engines_but_faults_are_planted(&options.engine_count());
        return output::refused("--engine", message, sentences::GIVE_ONE_ENGINE);
    }
    let parties = args.party.iter().filter_map(|name| FaultyParty::named(name)).collect();
    let asked =
        MutationPlan { kinds: args.kind.clone(), parties, with_sizes: !args.no_sizes, jobs: args.jobs, options };
    let (mut found, mut failures) = (Vec::new(), Vec::new());
    for file in &args.files {
        let one = plain(file).and_then(|scenario| {
            let mut bar = Bar::new(&scenario.name);
            mutate(&scenario, &asked, &mut |part| bar.at(part))
        });
        match one {
            Ok(one) => found.push(one),
            Err(error) => {
                output::show(&error);
                failures.push((load::named(file).display().to_string(), errors::text(&error, advice::told)));
            }
        }
    }
    let result = |form| match form {
        Mutations::Markdown => Ok(report::markdown(&found)),
        Mutations::Json => Ok(report::json(&found, &failures)),
    };
    args.outputs.deliver(result, |_| report::text(&found))?;
    Ok(match tally(&found).end() {
        _ if !failures.is_empty() => exit_code::BAD_INPUT,
        FaultTally::AllFound => exit_code::AGREE,
        FaultTally::NoneEscapes | FaultTally::TrunkOpen | FaultTally::Nothing => exit_code::INCONCLUSIVE,
        FaultTally::SomeEscape => exit_code::DISAGREE,
    })
}

/// Reads the name of a kind or family of faults.
fn kind(text: &str) -> std::result::Result<String, String> {
    if named(text).is_some() || all().any(|kind| kind.family.name() == text) {
        return Ok(text.into());
    }
    Err(sentences::THERE_IS_NO_SUCH_KIND_AND_NO_SUCH_FAMILY.into())
}
