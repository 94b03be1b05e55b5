//! `linkproof synthesize search`.

use crate::sentences;
use std::fs;
use std::path::{Path, PathBuf};

use super::proven::proven;
use crate::cli::number::Parsed;
use crate::cli::outputs::{Made, Outputs, results};
use crate::cli::{output, progress};
use crate::report::synthesize::{self as report, Story};
use design::synthesize::task::{Refinement, SearchEffort, Task};
use design::synthesize::task_file::TaskFile;
use design::synthesize::{self, Achieved, SearchResult, redraw};
use linkage::error::Result;
use scenario::Scenario;

results! { SearchResults {
    Scenario = "the scenario found",
    Json = "the result",
    Svg = "required and achieved motion",
} }

/// Effort of a search, in place of the effort in the file.
#[derive(Debug, clap::Args)]
pub(super) struct EffortArgs {
    /// Seed of the random numbers [default: the seed in the file]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Random candidates [default: the number in the file]
    #[arg(long, value_name = "N")]
    candidates: Option<usize>,
    /// Best candidates to refine [default: the number in the file]
    #[arg(long, value_name = "N")]
    refined: Option<usize>,
    /// Method of the refinement [default: the method in the file]
    #[arg(long, value_name = "METHOD", value_parser = refinement)]
    refinement: Option<Refinement>,
    /// Evaluations per refinement; steps for a method with exact derivatives [default: the number in the file]
    #[arg(long, value_name = "N")]
    evaluations: Option<usize>,
}

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Synthesis file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    effort: EffortArgs,
    /// Threads; the result does not depend on them [default: the number of cores]
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    threads: usize,
    #[command(flatten)]
    outputs: Outputs<SearchResults>,
}

impl EffortArgs {
    /// Replaces numbers in the effort of a task by the given options.
    pub(super) fn apply(&self, effort: &mut SearchEffort) {
        effort.refinement = self.refinement.unwrap_or(effort.refinement);
        effort.seed = self.seed.unwrap_or(effort.seed);
        effort.candidates = self.candidates.unwrap_or(effort.candidates);
        effort.refined = self.refined.unwrap_or(effort.refined);
        effort.evaluations = self.evaluations.unwrap_or(effort.evaluations);
    }
}

pub(super) fn search(args: &Args) -> Result<()> {
    let TaskFile { mut task, drawing } = TaskFile::load(&args.file)?;
    for to in args.outputs.of(SearchResults::Scenario) {
        [&args.file, &drawing.path].into_iter().try_for_each(|source| is_no_source(to, source))?;
    }
    args.effort.apply(&mut task.effort);
    let mut bar = progress::Bar::new(&task.name);
    let searched = synthesize::search(&task, args.threads, &mut |part| bar.at(part))?;
    drop(bar);
    let Found { task: own, achieved, values, verdict } = found(&task, &drawing, &searched)?;
    let text = redraw::redrawn(&task, &drawing.text, &values, &comment(args, &own, &achieved))?;
    let story = Story { task: &own, achieved: &achieved, search: Some((&searched, &values)) };
    let result = |result| -> Result<Made> {
        Ok(match result {
            SearchResults::Scenario => text.clone().into(),
            SearchResults::Json => report::json(&story).into(),
            SearchResults::Svg => report::picture(&story)?.into(),
        })
    };
    args.outputs.deliver(result, |_| format!("{}\n{verdict}\n", report::text(&story)))
}

/// The mechanism that a search has found, read back from the written scenario.
pub(super) struct Found {
    pub(super) task: Task,
    pub(super) achieved: Achieved,
    /// Values of the variables (SI), rounded as they are written.
    pub(super) values: Vec<f64>,
    /// The verdict of the mechanism's proof, in one sentence.
    pub(super) verdict: String,
}

/// Reads the text of the scenario back, so that the reported figures are those of the written scenario, and proves it.
pub(super) fn found(task: &Task, drawing: &Scenario, searched: &SearchResult) -> Result<Found> {
    let values = redraw::round_values(task, &searched.values);
    let place = drawing.path.with_file_name(format!("{}.toml", task.name));
    let text = redraw::redrawn(task, &drawing.text, &values, "")?;
    let verdict = proven(&text, &place)?;
    let bare = Scenario::parse(&text, &place)?;
    let task = Task { case: bare.case, ..task.clone() };
    let achieved = Achieved::of(&task, searched.forward)?;
    Ok(Found { task, achieved, values, verdict })
}

/// Comment on the origin and the quality of the scenario.
fn comment(args: &Args, task: &Task, achieved: &Achieved) -> String {
    let effort = &task.effort;
    let command = sentences::linkproof_synthesize_search_seed_candidates(
        &args.file.display(),
        &effort.seed,
        &effort.candidates,
        &effort.refined,
        &effort.evaluations,
    );
    let command = args.effort.refinement.map_or(command.clone(), |own| command + " --refinement " + own.name());
    sentences::found_by(&command, &report::summary(task, achieved))
}

pub(super) fn refinement(text: &str) -> Parsed<Refinement> {
    let all = || Refinement::ALL.map(Refinement::name).join(", ");
    Refinement::named(text).ok_or_else(|| sentences::the_methods_are(&all()))
}

/// Refuses to write the scenario over one of its sources.
fn is_no_source(to: &Path, source: &Path) -> Result<()> {
    match (fs::canonicalize(source), fs::canonicalize(to)) {
        (Ok(a), Ok(b)) if a == b => {
            let message = sentences::the_scenario_found_would_overwrite(&source.display());
            output::refused("--output", message, sentences::NAME_ANOTHER_FILE)
        }
        _ => Ok(()),
    }
}
