//! Output of `linkproof run`: the report and the files.

use crate::sentences;
use std::collections::BTreeMap;
use std::path::Path;

use super::args::{Args, RunResults};
use crate::cli::engine_section::{self, keys};
use crate::cli::exit_code::{self, graver};
use crate::cli::html::Pages;
use crate::cli::live::Live;
use crate::cli::output::End;
use crate::cli::record_args::Recorded;
use crate::cli::{advice, load, output};
use crate::plain::brief;
use crate::plain::judged::grade;

use crate::plain::style::Detail;
use crate::report::closing::Closing;
use crate::report::outcomes::Outcomes;
use crate::report::{explain, json, junit, markdown, recorded, text};
use linkage::error::{Error, Result};
use linkage::work::Work;
use prover::run::{EngineProof, LedgerEntry, Proof};
use scenario::Scenario;

/// Everything that the command has shown and written so far.
/// The session receives the proofs in the order of the files.
pub(super) struct Session<'a> {
    args: &'a Args,
    pages: Option<Pages>,
    live: Option<&'a Live>,
    /// Message about the live server at the end; `None` if no proof is shown.
    live_told: Option<String>,
    document: json::Document,
    outcomes: Outcomes,
    closing: Closing,
    worst: u8,
}

impl<'a> Session<'a> {
    pub(super) fn of(args: &'a Args, pages: Option<Pages>, live: Option<&'a Live>) -> Self {
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

    /// Whether standard output carries the report; otherwise it carries a result for other programs, such as JSON.
    fn reports(&self) -> bool {
        !self.args.outputs.take_standard()
    }

    fn failed(&mut self, file: &Path, error: &Error) {
        output::show(error);
        let named = load::named(file).display().to_string();
        self.document.add_failure(&named, error);
        self.outcomes.add_failure(&named, error);
        self.worst = exit_code::BAD_INPUT;
    }

    /// Shows a proof, and writes its settings and its recording.
    pub(super) fn take(&mut self, file: &Path, proven: Result<(Scenario, Proof)>) {
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
                self.closing.add_failure(&load::named(file).display().to_string());
                return;
            }
        };
        // A failed recording does not affect the proof, so its error is reported separately.
        let recording = self.record(&scenario, &proof).unwrap_or_else(|error| {
            self.failed(file, &error);
            None
        });
        let layout = recording.as_ref().and_then(|recorded| recorded.layout.as_deref());
        let tried = [self.page(&scenario, &proof), self.show_live(&scenario, &proof, layout)];
        tried.into_iter().filter_map(Result::err).for_each(|error| self.failed(file, &error));
        if self.tells() && self.args.files.len() > 1 {
            self.print("\n");
        }
        self.worst = graver(self.worst, exit_code::of(&proof.verdict));
        // With several engines, the report states the failure of each engine.
        // With only one engine, the engine's failure is the outcome.
        if let [EngineProof { failure: Some(error), .. }] = proof.engines.as_slice() {
            output::show(error);
            self.worst = exit_code::BAD_INPUT;
        }
        self.closing.add(&proof);
        self.outcomes.add(&proof);
        self.document.add(&proof, recording.map(|recorded| recorded.path.display().to_string()));
    }

    /// Shows the report of one proof: one line, everything needed to act, or all details.
    fn show(&self, proof: &Proof) -> Result<()> {
        let args = self.args;
        if !self.reports() {
            return Ok(());
        }
        output::report(&match Detail::asked(args.quiet, args.verbose) {
            Detail::Verdict => format!("{}\n", brief::verdict_line(proof)),
            Detail::Whole => text::proof(proof, advice::told, output::width()),
            Detail::Short => brief::proof(proof, advice::told, output::columns()) + &self.next(proof),
        })?;
        if args.explain {
            output::print(&format!("\n{}", explain::text(proof, &[recording_told(args)])))?;
        }
        if args.tolerance_scale == Some(0.0) {
            output::print(&text::residuals(proof))?;
        }
        Ok(())
    }

    /// Advice for the next step, chosen by the verdict. For several files, the text is empty, because a table of all
    /// files follows.
    fn next(&self, proof: &Proof) -> String {
        if self.args.files.len() > 1 {
            return String::new();
        }
        format!(
            "\n{}\n",
            grade(&proof.verdict).of([sentences::NEXT_AGREE, sentences::NEXT_OPEN, sentences::NEXT_DISAGREE])
        )
    }

    /// Whether the terminal shows more than verdicts.
    fn tells(&self) -> bool {
        self.reports() && !self.args.quiet
    }

    /// Prints text between and below the reports.
    fn print(&mut self, text: &str) {
        self.worst = graver(self.worst, output::report(text).code());
    }

    /// Records a proof, unless recording is off.
    /// A recording of a different run is not replaced.
    fn record(&self, scenario: &Scenario, proof: &Proof) -> Result<Option<Recorded>> {
        let recorded = self.args.record.record(scenario, proof, metadata(self.args, proof))?;
        if let Some(recorded) = &recorded
            && self.tells()
        {
            output::print(&recorded.told)?;
        }
        Ok(recorded)
    }

    /// Shows a proof to viewers, if a server is running.
    fn show_live(&mut self, scenario: &Scenario, proof: &Proof, layout: Option<&Path>) -> Result<()> {
        let Some(live) = self.live else { return Ok(()) };
        live.show_proof(&self.args.record, scenario, proof)?;
        self.live_told = Some(live.told(layout));
        Ok(())
    }

    /// Writes the page of a proof, if requested.
    fn page(&mut self, scenario: &Scenario, proof: &Proof) -> Result<()> {
        let Some(pages) = &mut self.pages else { return Ok(()) };
        let path = pages.write(scenario, proof, &metadata(self.args, proof))?;
        if self.tells() {
            let gap = if self.args.record.no_record { "\n" } else { "" };
            output::print(&format!("{gap}page       {}\n", path.display()))?;
        }
        Ok(())
    }

    /// Shows the table of all files, and writes the results for other programs.
    /// Then serves live viewers, if requested, and returns the exit code.
    pub(super) fn end(mut self) -> u8 {
        if self.tells()
            && let Some(table) = self.closing.text(output::columns())
        {
            self.print(&table);
        }
        let written = self.args.outputs.write_some(|result| {
            Ok(match result {
                RunResults::Json => Some(self.document.text()),
                RunResults::Junit => Some(junit::xml(&self.outcomes)),
                RunResults::Markdown => Some(markdown::text(&self.outcomes)),
                RunResults::Html => None,
            })
        });
        if let (Some(live), Some(told)) = (self.live, self.live_told.take()) {
            let tell = || if self.reports() { self.print(&told) } else { output::note(told.trim()) };
            let served = live.serve(tell).code();
            self.worst = graver(self.worst, served);
        }
        graver(self.worst, written.code())
    }
}

/// Entry about the recording.
fn recording_told(args: &Args) -> LedgerEntry {
    let why = if args.record.no_record { sentences::NOT_ASKED_FOR } else { "written below" };
    let work = (!args.record.no_record).then_some(Work::NONE);
    LedgerEntry { part: "recording".into(), why, work }
}

/// Writes the settings of the first engine to the scenario file, if the proof has found them.
fn write_settings(file: &Path, scenario: &Scenario, proof: &Proof) -> Result<()> {
    let engine = proof.engine();
    match engine.search {
        None => Ok(()),
        Some(_) => engine_section::write(file, scenario, keys(scenario, engine.info.name, engine.info.settings)),
    }
}

/// Versions, settings, verdict, and the options of the command that change the scenario.
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
    let input = proof.scene.case.crank().input;
    let start = args.start.start_crank_deg;
    metadata.extend(start.map(|value| (format!("start_{}", input.shown_in().1), value.to_string())));
    metadata.extend(args.grid.told(input).map(|(name, values)| (format!("grid_{name}"), values.to_string())));
    metadata
}
