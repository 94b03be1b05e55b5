//! `linkproof synthesize search` and `check`.

use crate::sentences;
use std::path::PathBuf;

use super::target::{scenario_target, write_scenario};
use crate::cli::load::plain;
use crate::cli::{output, progress};
use crate::report::synthesize::{self as report, Story};
use design::draw;
use design::synthesize::redraw;
use design::synthesize::task::Task;
use design::synthesize::task_file::TaskFile;
use design::synthesize::{self, Achieved};
use linkage::error::{Error, ErrorKind, Result};
use scenario::Scenario;

/// Where results are written.
#[derive(Debug, clap::Args)]
struct Target {
    /// Draw the wanted and the achieved motion to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    svg: Option<PathBuf>,
    /// Write the result as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
}

impl Target {
    fn check(&self, output: &Option<PathBuf>) -> Result<()> {
        output::apart(&[("--output", output), ("--svg", &self.svg), ("--json", &self.json)])
    }
}

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Synthesis file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Write the scenario found to a file, or to standard output instead of the text with `-`
    #[arg(short, long, value_name = "FILE", value_parser = scenario_target)]
    output: Option<PathBuf>,
    /// Seed of the random numbers [default: the file's]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Random candidates [default: the file's]
    #[arg(long, value_name = "N")]
    candidates: Option<usize>,
    /// Best candidates to refine [default: the file's]
    #[arg(long, value_name = "N")]
    refined: Option<usize>,
    /// Evaluations of each refinement [default: the file's]
    #[arg(long, value_name = "N")]
    evaluations: Option<usize>,
    /// Threads; the result does not depend on them [default: as many as the machine has]
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    threads: usize,
    #[command(flatten)]
    target: Target,
}

#[derive(Debug, clap::Args)]
pub(super) struct CheckArgs {
    /// Synthesis file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Scenario of the same structure
    #[arg(value_name = "SCENARIO")]
    scenario: PathBuf,
    #[command(flatten)]
    target: Target,
}

pub(super) fn search(args: &Args) -> Result<()> {
    args.target.check(&args.output)?;
    let TaskFile { mut task, drawing } = TaskFile::load(&args.file)?;
    let effort = &mut task.effort;
    effort.seed = args.seed.unwrap_or(effort.seed);
    effort.candidates = args.candidates.unwrap_or(effort.candidates);
    effort.refined = args.refined.unwrap_or(effort.refined);
    effort.evaluations = args.evaluations.unwrap_or(effort.evaluations);
    let mut bar = progress::Bar::new(&task.name);
    let found = synthesize::search(&task, args.threads, &mut |part| bar.at(part))?;
    drop(bar);
    let values = redraw::round_values(&task, &found.values);
    // The reported figures are measured on the scenario as it is written and read back.
    let place = drawing.path.with_file_name(format!("{}.toml", task.name));
    let bare = Scenario::parse(&redraw::redrawn(&task, &drawing.text, &values, "")?, &place)?;
    let own = Task { case: bare.case, ..task.clone() };
    let achieved = Achieved::of(&own, found.forward)?;
    let text = redraw::redrawn(&task, &drawing.text, &values, &comment(args, &own, &achieved))?;
    if let Some(to) = &args.output {
        write_scenario(&text, to, &[&args.file, &drawing.path])?;
        if output::is_standard(to) {
            return Ok(());
        }
    }
    tell(&args.target, &Story { task: &own, achieved: &achieved, search: Some((&found, &values)) })
}

/// How the scenario was found, and how good it is.
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

pub(super) fn check(args: &CheckArgs) -> Result<()> {
    args.target.check(&None)?;
    let TaskFile { task, drawing } = TaskFile::load(&args.file)?;
    let scenario = plain(&args.scenario)?;
    let names =
        |scenario: &Scenario| scenario.case.mechanism.links().iter().map(|link| link.name.clone()).collect::<Vec<_>>();
    if names(&scenario) != names(&drawing) || scenario.case.structure != drawing.case.structure {
        let message = sentences::has_another_structure_than_the_drawing(&scenario.path.display(), &args.file.display());
        return Err(Error::new(ErrorKind::Input, message).help(sentences::CHECK_A_SCENARIO_WITH_THE_SAME));
    }
    let task = Task { case: scenario.case, ..task };
    let achieved = Achieved::of_either(&task)?;
    tell(&args.target, &Story { task: &task, achieved: &achieved, search: None })
}

fn tell(target: &Target, story: &Story) -> Result<()> {
    if let Some(to) = &target.svg {
        output::write(&draw::timing(&report::diagram(story), &story.task.title), to)?;
    }
    if let Some(to) = &target.json {
        output::write(&report::json(story), to)?;
    }
    if output::is_said(&target.svg) || output::is_said(&target.json) {
        Ok(())
    } else {
        output::print(&report::text(story))
    }
}
