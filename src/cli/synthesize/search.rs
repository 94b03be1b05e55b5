//! `linkproof synthesize search`.

use crate::sentences;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::outputs::{Made, Outputs, results};
use crate::cli::{output, progress};
use crate::report::synthesize::{self as report, Story};
use design::synthesize::task::Task;
use design::synthesize::task_file::TaskFile;
use design::synthesize::{self, Achieved, redraw};
use linkage::error::Result;
use scenario::Scenario;

results! { SearchResults {
    Scenario = "the scenario found",
    Json = "the result",
    Svg = "required and achieved motion",
} }

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Synthesis file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Seed of the random numbers [default: the seed in the file]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Random candidates [default: the number in the file]
    #[arg(long, value_name = "N")]
    candidates: Option<usize>,
    /// Best candidates to refine [default: the number in the file]
    #[arg(long, value_name = "N")]
    refined: Option<usize>,
    /// Evaluations of each refinement [default: the number in the file]
    #[arg(long, value_name = "N")]
    evaluations: Option<usize>,
    /// Threads; the result does not depend on them [default: the number of cores]
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    threads: usize,
    #[command(flatten)]
    outputs: Outputs<SearchResults>,
}

pub(super) fn search(args: &Args) -> Result<()> {
    let TaskFile { mut task, drawing } = TaskFile::load(&args.file)?;
    for to in args.outputs.of(SearchResults::Scenario) {
        [&args.file, &drawing.path].into_iter().try_for_each(|source| is_no_source(to, source))?;
    }
    let effort = &mut task.effort;
    effort.seed = args.seed.unwrap_or(effort.seed);
    effort.candidates = args.candidates.unwrap_or(effort.candidates);
    effort.refined = args.refined.unwrap_or(effort.refined);
    effort.evaluations = args.evaluations.unwrap_or(effort.evaluations);
    let mut bar = progress::Bar::new(&task.name);
    let found = synthesize::search(&task, args.threads, &mut |part| bar.at(part))?;
    drop(bar);
    let values = redraw::round_values(&task, &found.values);
    // The text of the scenario is read back before the report. The reported figures are therefore those of the written
    // scenario.
    let place = drawing.path.with_file_name(format!("{}.toml", task.name));
    let bare = Scenario::parse(&redraw::redrawn(&task, &drawing.text, &values, "")?, &place)?;
    let own = Task { case: bare.case, ..task.clone() };
    let achieved = Achieved::of(&own, found.forward)?;
    let text = redraw::redrawn(&task, &drawing.text, &values, &comment(args, &own, &achieved))?;
    let story = Story { task: &own, achieved: &achieved, search: Some((&found, &values)) };
    let result = |result| -> Made {
        match result {
            SearchResults::Scenario => text.clone().into(),
            SearchResults::Json => report::json(&story).into(),
            SearchResults::Svg => report::picture(&story).into(),
        }
    };
    args.outputs.deliver(|form| Ok(result(form)), |_| report::text(&story))
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
    sentences::found_by(&command, &report::summary(task, achieved))
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
