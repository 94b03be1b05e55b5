//! Results for other programs and people: JSON, JUnit, Markdown.

use std::path::PathBuf;

use super::exit_code::{self, graver};
use super::output::{self, End};
use crate::report::outcomes::Outcomes;
use crate::report::{junit, markdown};
use linkage::error::Result;

/// Where results go, beside the report on the terminal.
#[derive(Clone, Debug, clap::Args)]
#[group(skip)]
pub(super) struct Reports {
    /// Write the results as JSON to a file, or to standard output instead of the report with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
    /// Write the results as JUnit to a file, for whatever reads reports of tests: a suite for each scenario, a case for
    /// each channel and check; `-` for standard output after the report
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    junit: Option<PathBuf>,
    /// Write the results as Markdown to a file, for a comment to a pull request; `-` for standard output after the report
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    markdown: Option<PathBuf>,
}

impl Reports {
    /// Refuses results that would take the place of each other, or of what the command is `given` besides.
    pub(super) fn check(&self, given: &[(&str, &Option<PathBuf>)]) -> Result<()> {
        let own = [("--json", &self.json), ("--junit", &self.junit), ("--markdown", &self.markdown)];
        output::apart(&own)?;
        given.iter().try_for_each(|one| output::apart(&[&[*one][..], &own].concat()))
    }

    /// Whether JSON takes the place of the report on standard output.
    pub(super) fn takes_output(&self) -> bool {
        output::is_said(&self.json)
    }

    /// Writes what is asked for. A target that cannot be written does not stop the others.
    pub(super) fn write(&self, json: impl Fn() -> String, outcomes: &Outcomes) -> u8 {
        let targets: [(&Option<PathBuf>, &dyn Fn() -> String); 3] = [
            (&self.json, &json),
            (&self.junit, &|| junit::xml(outcomes)),
            (&self.markdown, &|| markdown::text(outcomes)),
        ];
        let mut worst = exit_code::AGREE;
        for (to, text) in targets {
            if let Some(to) = to {
                worst = graver(worst, output::write(&text(), to).code());
            }
        }
        worst
    }
}
