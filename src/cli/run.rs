//! `linkproof run`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

use clap::builder::PossibleValuesParser;

use super::engine_args::EngineArgs;
use super::engine_section::{self, keys};
use super::grid::GridArgs;
use super::html::{self, Pages};
use super::jobs::{Room, side_by_side};
use super::live::{Live, LiveArgs};
use super::load::{StartArgs, only, reference_names};
use super::progress::Shared;
use super::record_args::{RecordArgs, Recorded};
use super::{advice, exit_code, number, output, standard_input, terminal};
use crate::compare::Verdict;
use crate::proof::{EngineProof, Entry, Proof, memory, prove_with};
use crate::report::closing::Closing;
use crate::report::outcomes::Outcomes;
use crate::report::{brief, explain, json, junit, markdown, recorded, residuals, text};
use crate::scenario::Scenario;
use linkage::error::{Error, Result};
use linkage::work::Work;

const EXAMPLES: &str = "\
Examples:
  linkproof new --shipped      write the files that the examples name
  linkproof run scenarios/crank_rocker.toml
  linkproof run scenarios/crank_rocker.toml --dt 1e-4          this step of the engine, not one that the run finds
  linkproof run mine.toml --write                              keep the settings that the run has found in the file
  linkproof run scenarios/crank_rocker.toml --verbose          every quantity and every check
  linkproof run scenarios/*.toml --no-record --quiet           one line for each file
  linkproof run scenarios/*.toml --reference newton            the other analytic side as reference
  linkproof run scenarios/crank_rocker.toml --engine all       every engine side by side, and who stands alone
  linkproof run scenarios/ov7_base.toml --sweeps 4096 --extrapolate   other settings of the engine
  linkproof run scenarios/fourth_class.toml --no-record --mode link_2,link_3,link_4,link_5=2   another configuration
  linkproof run scenarios/crank_rocker.toml --no-record --start-crank-deg 90 --crank-deg 90:450:2   another start and grid
  linkproof run scenarios/crank_rocker_runup.toml --no-record --times 0,0.01,0.05,0.1   only these instants
  linkproof run scenarios/crank_rocker.toml --slow 20 --record-forces   a recording to look at, twenty times slower
  linkproof run scenarios/crank_rocker.toml --live             move it in Foxglove or Lichtblick until Ctrl-C
  linkproof run scenarios/*.toml --no-record --json out.json   no recording, results for a script
  linkproof run scenarios/*.toml --no-record --junit out.xml --markdown out.md   for reports of tests, and a comment
  linkproof run scenarios/crank_rocker.toml --no-record --html crank_rocker.html   a page to look at, in any browser
  linkproof run scenarios/*.toml --no-record --html pages/     a page for each
  linkproof run mine.toml --set a_mm=30                        another number for a parameter of the file
  linkproof run scenarios/ov7_base.toml --no-record --only point.9.positions --explain   one point, and what that takes

Exit codes: 0 all agree, 1 something disagrees, 2 bad input or usage, 3 nothing proven either way.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Analytic solver that the engine is compared with; the other one checks it
    #[arg(long, default_value = "assur", value_parser = PossibleValuesParser::new(reference_names()))]
    reference: String,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    start: StartArgs,
    /// Multiply every bound by this factor, to see how close a proof is to its bounds; 0 judges as usual and prints
    /// every residual beside its bound
    #[arg(long, hide = true, value_name = "FACTOR", allow_hyphen_values = true, value_parser = number::not_negative)]
    tolerance_scale: Option<f64>,
    /// Write the settings that the proof has found to the `[engine]` section of the scenario file
    #[arg(long)]
    write: bool,
    #[command(flatten)]
    record: RecordArgs,
    #[command(flatten)]
    live: LiveArgs,
    /// Ask for these channels only: a stage (positions), a subject (point.P, joint.B, drive), a subject's stage
    /// (point.P.positions) or a channel (joint.B.fx_N). What they do not depend on is not computed; published numbers of
    /// other channels are left out. May be given several times
    #[arg(long, value_name = "WORD")]
    only: Vec<String>,
    /// Show everything: structure, settings, every quantity, every check
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    /// Show only the verdict, in one line for each file
    #[arg(short, long)]
    quiet: bool,
    /// Number of files that are proven side by side; the output is the same for any number [default: all cores]
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Show what ran, how often and why, and what was skipped
    #[arg(long)]
    explain: bool,
    /// Write the results as JSON to a file, or to standard output instead of the report with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
    /// Write the results as JUnit to a file, for whatever reads reports of tests: a suite for each scenario, a case for
    /// each channel and check
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    junit: Option<PathBuf>,
    /// Write a page to look at: the mechanism moving, all channels of both sides with errors and bounds, verdict and
    /// findings. It needs nothing else, no network either. A file for one scenario; for several, or if it is there or
    /// ends with `/`, a directory with NAME.html for each
    #[arg(long, value_name = "FILE|DIR", value_parser = html::target)]
    html: Option<PathBuf>,
    /// Write the results as Markdown to a file, for a comment to a pull request; `-` for standard output after the report
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    markdown: Option<PathBuf>,
}

/// Proves every file. A bad file does not stop the others from being proven.
pub(super) fn run(args: &Args) -> u8 {
    // The default directory need not be there if nothing is recorded.
    if let Err(found) = args.record.target(args.live.is_on()) {
        return output::exit(Err(found));
    }
    let live = match args.live.start(&args.files) {
        Ok(live) => live,
        Err(found) => return output::exit(Err(found)),
    };
    let pages = args.html.as_deref().map(|to| Pages::of(to, args.files.len())).transpose();
    let pages = match pages {
        Ok(pages) => pages,
        Err(found) => return output::exit(Err(found)),
    };
    let mut session = Session::of(args, pages, live.as_ref());
    let what = match args.files.as_slice() {
        [only] => only.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned()),
        several => format!("{} scenarios", several.len()),
    };
    let bar = Shared::new(&what, args.files.len());
    let most = args.engine.memory.bytes();
    let work = |index: usize, file: &PathBuf, room: &Room| prove_file(args, live.as_ref(), file, room, index, &bar);
    side_by_side(&args.files, threads(args), most, work, |index, file, proven| {
        bar.at(index, 1.0);
        bar.hidden(|| session.take(file, proven));
    });
    drop(bar);
    session.end()
}

/// Number of files that are proven at a time. A file that is given twice and written is read again when it is written.
fn threads(args: &Args) -> usize {
    let mut seen = BTreeSet::new();
    let is_new = |file: &PathBuf| seen.insert(fs::canonicalize(file).unwrap_or_else(|_| file.clone()));
    match args.write && !args.files.iter().all(is_new) {
        true => 1,
        false => args.jobs.or_else(|| available_parallelism().ok()).map_or(1, usize::from),
    }
}

/// What the command has shown and written so far. It takes the proofs in the order of the files.
struct Session<'a> {
    args: &'a Args,
    pages: Option<Pages>,
    live: Option<&'a Live>,
    /// What is said of the live server once all is written; `None` if there is no proof to show.
    live_told: Option<String>,
    document: json::Document,
    outcomes: Outcomes,
    closing: Closing,
    worst: u8,
}

impl<'a> Session<'a> {
    fn of(args: &'a Args, pages: Option<Pages>, live: Option<&'a Live>) -> Self {
        Session {
            args,
            pages,
            live,
            live_told: None,
            document: json::Document::told_by(advice::told),
            outcomes: Outcomes::told_by(advice::told),
            closing: Closing::default(),
            worst: exit_code::AGREE,
        }
    }

    /// Whether standard output has the report; it is JSON otherwise.
    fn reports(&self) -> bool {
        self.args.json.as_deref() != Some(Path::new("-"))
    }

    fn failed(&mut self, file: &Path, error: &Error) {
        output::show(error);
        let named = standard_input::named(file).display().to_string();
        self.document.add_failure(&named, error);
        self.outcomes.add_failure(&named, error);
        self.worst = exit_code::BAD_INPUT;
    }

    /// Shows a proof, writes its settings and its recording.
    fn take(&mut self, file: &Path, proven: Result<(Scenario, Proof)>) {
        let shown = proven.and_then(|(scenario, proof)| {
            if self.args.write {
                write_settings(file, &scenario, &proof)?;
            }
            self.show(&proof)?;
            Ok((scenario, proof))
        });
        let (scenario, proof) = match shown {
            Ok(shown) => shown,
            Err(error) => {
                self.failed(file, &error);
                self.closing.add_failure(&standard_input::named(file).display().to_string());
                return;
            }
        };
        // A proof is valid whether or not it can be recorded.
        let recording = self.record(&scenario, &proof).unwrap_or_else(|error| {
            self.failed(file, &error);
            None
        });
        if let Err(error) = self.page(&scenario, &proof) {
            self.failed(file, &error);
        }
        let layout = recording.as_ref().and_then(Recorded::layout);
        if let Err(error) = self.show_live(&scenario, &proof, layout) {
            self.failed(file, &error);
        }
        if self.tells() && self.args.files.len() > 1 {
            self.print("\n");
        }
        self.worst = graver(self.worst, exit_code_of(&proof.verdict));
        // With several engines, the report states the failure of one. With a single engine, its failure is the outcome.
        if let [EngineProof { failure: Some(error), .. }] = proof.engines.as_slice() {
            output::show(error);
            self.worst = exit_code::BAD_INPUT;
        }
        self.closing.add(&proof);
        self.outcomes.add(&proof);
        self.document.add(&proof, recording.map(|recorded| recorded.path.display().to_string()));
    }

    /// The report of one proof: a line, what is needed to act, or everything.
    fn show(&self, proof: &Proof) -> Result<()> {
        let args = self.args;
        if !self.reports() {
            return Ok(());
        }
        terminal::print(&match (args.quiet, args.verbose) {
            (true, _) => format!("{}\n", brief::verdict_line(proof)),
            (_, true) => text::proof(proof, advice::told, terminal::width()),
            _ => brief::proof(proof, advice::told, terminal::columns()),
        })?;
        if args.explain {
            output::print(&format!("\n{}", explain::text(proof, &[recording_told(args)])))?;
        }
        if args.tolerance_scale == Some(0.0) {
            output::print(&residuals::all(proof))?;
        }
        Ok(())
    }

    /// Whether more than the verdicts goes to the terminal.
    fn tells(&self) -> bool {
        self.reports() && !self.args.quiet
    }

    /// Prints what stands between and below the reports.
    fn print(&mut self, text: &str) {
        if let Err(error) = terminal::print(text) {
            output::show(&error);
            self.worst = exit_code::BAD_INPUT;
        }
    }

    /// Records a proof, unless recording is off. A recording of another run is left alone.
    fn record(&self, scenario: &Scenario, proof: &Proof) -> Result<Option<Recorded>> {
        let recorded = self.args.record.record(scenario, proof, metadata(self.args, proof))?;
        if let Some(recorded) = &recorded
            && self.tells()
        {
            output::print(&recorded.told())?;
        }
        Ok(recorded)
    }

    /// Shows a proof to viewers, if they are served.
    fn show_live(&mut self, scenario: &Scenario, proof: &Proof, layout: Option<&Path>) -> Result<()> {
        let Some(live) = self.live else { return Ok(()) };
        live.show_proof(&self.args.record, scenario, proof)?;
        self.live_told = Some(live.told(layout));
        Ok(())
    }

    /// Writes the page of a proof, if pages are asked for.
    fn page(&mut self, scenario: &Scenario, proof: &Proof) -> Result<()> {
        let Some(pages) = &mut self.pages else { return Ok(()) };
        let path = pages.write(scenario, proof, &metadata(self.args, proof))?;
        if self.tells() {
            let gap = if self.args.record.is_off() { "\n" } else { "" };
            output::print(&format!("{gap}page       {}\n", path.display()))?;
        }
        Ok(())
    }

    /// The table over all files, and the results for other programs; then viewers are served, if they are. Returns the
    /// exit code.
    fn end(mut self) -> u8 {
        if self.tells()
            && let Some(table) = self.closing.text(terminal::columns())
        {
            self.print(&table);
        }
        type Text<'a> = &'a dyn Fn() -> String;
        let (document, outcomes) = (&self.document, &self.outcomes);
        let targets: [(&Option<PathBuf>, Text); 3] = [
            (&self.args.json, &|| document.text()),
            (&self.args.junit, &|| junit::xml(outcomes)),
            (&self.args.markdown, &|| markdown::text(outcomes)),
        ];
        for (to, text) in targets {
            if let Some(to) = to
                && let Err(error) = output::write(&text(), to)
            {
                output::show(&error);
                self.worst = exit_code::BAD_INPUT;
            }
        }
        if let (Some(live), Some(told)) = (self.live, self.live_told.take()) {
            let tell = || match self.reports() {
                true => self.print(&told),
                false => output::note(told.trim()),
            };
            if let Err(error) = live.serve(tell) {
                output::show(&error);
                self.worst = exit_code::BAD_INPUT;
            }
        }
        self.worst
    }
}

/// Proves a file when there is room for it.
fn prove_file(
    args: &Args,
    live: Option<&Live>,
    file: &Path,
    room: &Room,
    index: usize,
    bar: &Shared,
) -> Result<(Scenario, Proof)> {
    standard_input::refuse_writing(file, args.write)?;
    let scenario = only(args.start.load(file, &args.grid)?, &args.only)?;
    let options = args.engine.options(&args.reference);
    let needed = memory::of_proof(&scenario.case, options.engines.len().max(1));
    room.take(index, needed, || bar.hidden(|| args.engine.memory.tell(&scenario.case, needed)));
    if let Some(live) = live {
        bar.hidden(|| output::note(&format!("viewers can listen at {} from now on", live.address())));
        live.show_reference(&args.record, &scenario, options.reference);
    }
    let proof = prove_with(&scenario, &options, &mut |part| bar.at(index, part))?;
    let proof = match args.tolerance_scale {
        Some(dial) if dial > 0.0 => proof.with_bounds_scaled(dial),
        _ => proof,
    };
    Ok((scenario, proof))
}

/// What the command does about the recording.
fn recording_told(args: &Args) -> Entry {
    let why = if args.record.is_off() { "not asked for" } else { "written below" };
    let work = (!args.record.is_off()).then_some(Work::NONE);
    Entry { part: "recording".into(), why, work }
}

/// Writes the settings of the first engine to the scenario file, if the proof has found them.
fn write_settings(file: &Path, scenario: &Scenario, proof: &Proof) -> Result<()> {
    let engine = proof.engine();
    match engine.search {
        None => Ok(()),
        Some(_) => engine_section::write(file, scenario, keys(scenario, engine.info.name, engine.info.settings)),
    }
}

/// Versions, settings and verdict, and what the command asks for beyond the scenario's text.
fn metadata(args: &Args, proof: &Proof) -> BTreeMap<String, String> {
    let mut metadata = recorded::metadata(proof);
    if !args.start.mode.is_empty() {
        metadata.insert("modes".into(), args.start.mode.join(" "));
    }
    if !args.start.set.is_empty() {
        let set: Vec<String> = args.start.set.iter().map(|(key, value)| format!("{key}={value}")).collect();
        metadata.insert("parameters".into(), set.join(" "));
    }
    if !args.only.is_empty() {
        metadata.insert("only".into(), args.only.join(" "));
    }
    metadata.extend(args.start.start_crank_deg.map(|degrees| ("start_crank_deg".into(), degrees.to_string())));
    metadata.extend(args.grid.told().map(|(name, values)| (format!("grid_{name}"), values.to_string())));
    metadata
}

/// The exit code of a verdict.
pub(super) fn exit_code_of(verdict: &Verdict) -> u8 {
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => exit_code::AGREE,
        Verdict::Disagree { .. } => exit_code::DISAGREE,
        Verdict::Inconclusive { .. } => exit_code::INCONCLUSIVE,
    }
}

/// The graver of two exit codes. Bad input is graver than disagreement, and disagreement graver than no proof.
pub(super) fn graver(a: u8, b: u8) -> u8 {
    let rank = |code: u8| match code {
        exit_code::BAD_INPUT => 3,
        exit_code::DISAGREE => 2,
        exit_code::INCONCLUSIVE => 1,
        _ => 0,
    };
    if rank(b) > rank(a) { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gravest_outcome_decides_the_exit_code() {
        assert_eq!([0, 3, 1].into_iter().fold(0, graver), 1);
        assert_eq!([2, 1, 0].into_iter().fold(0, graver), 2);
        assert_eq!([0, 3, 0].into_iter().fold(0, graver), 3);
    }
}
