//! Pages of `linkproof run -o PAGE.html`.

use crate::sentences;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::iter::once;
use std::path::{Path, PathBuf};

use super::{advice, drive, output};
use crate::report::drive_graphs;
use crate::report::html::{self, Beside, PAGE_BYTES};
use analytic::range::explained;
use analytic::reduced::ReducedModel;
use design::diagram::Graphs;
use linkage::error::{Error, ErrorKind, Result};
use prover::run::Proof;
use scenario::Scenario;

/// Crank angle between two rows of the reduced quantities (deg); the page shows only means and extremes of these rows.
const STEP_DEG: f64 = 10.0;

/// Destination of pages: one file, or a directory with a page for each scenario.
pub(super) struct Pages {
    to: PathBuf,
    is_directory: bool,
    /// Names already used for pages, without the ending.
    taken: BTreeSet<String>,
}

impl Pages {
    /// The destination `to` for the pages of this number of scenarios.
    /// The function tests in advance whether the pages can be written.
    ///
    /// # Errors
    /// An error is returned if a page cannot be written.
    pub(super) fn of(to: &Path, scenarios: usize) -> Result<Pages> {
        let is_directory = scenarios > 1 || to.is_dir() || to.as_os_str().to_string_lossy().ends_with('/');
        let tried = if is_directory { files::may_fill(to) } else { files::may_write(to) };
        let wrong = |found: String| {
            let what = if is_directory {
                sentences::PAGES_CANNOT_BE_WRITTEN_TO
            } else {
                sentences::THE_PAGE_CANNOT_BE_WRITTEN
            };
            Error::new(ErrorKind::Io, format!("{what} {}: {found}", to.display()))
                .key("-o")
                .help(sentences::NAME_A_FILE_FOR_ONE_SCENARIO)
        };
        tried.map_err(wrong)?;
        Ok(Pages { to: to.to_path_buf(), is_directory, taken: BTreeSet::new() })
    }

    /// Writes the page of a proof, and returns its path.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if the page cannot be written.
    pub(super) fn write(
        &mut self,
        scenario: &Scenario,
        proof: &Proof,
        settings: &BTreeMap<String, String>,
    ) -> Result<PathBuf> {
        let beside = Beside { given: &scenario.text, settings, reduced: reduced(scenario), bytes: PAGE_BYTES };
        let page = html::page(proof, &beside, advice::told);
        let path = self.place(&scenario.name)?;
        if self.is_directory {
            output::make(&page, &path)?
        } else {
            output::write(&page, &path)?
        }
        Ok(path)
    }

    /// Path of a page: `NAME.html` in the directory, or `NAME-2.html` if an earlier scenario had the same name.
    fn place(&mut self, name: &str) -> Result<PathBuf> {
        if !self.is_directory {
            return Ok(self.to.clone());
        }
        fs::create_dir_all(&self.to).map_err(|error| {
            Error::new(ErrorKind::Io, sentences::the_directory_cannot_be_made(&self.to.display(), &error))
                .help(sentences::NAME_ANOTHER_DIRECTORY_WITH_HTML)
        })?;
        let mut names = once(name.to_string()).chain((2..).map(|number| format!("{name}-{number}")));
        let own = names.find(|own| self.taken.insert(own.clone())).expect("numbers do not end");
        Ok(self.to.join(format!("{own}.html")))
    }
}

/// The mechanism reduced to its crank, or the reason why it cannot be reduced.
pub(super) fn reduced(scenario: &Scenario) -> std::result::Result<Graphs, String> {
    let scenario = scenario.clone().nominal();
    let graphs = || {
        let model = ReducedModel::of(&scenario.case)?;
        let found = drive::find(&scenario, &model, STEP_DEG, None)?;
        Ok(drive_graphs::graphs(&scenario, &found, &drive::curves(&scenario, &model, &found)?))
    };
    graphs().map_err(|error: Error| explained(&scenario.case, error).message().to_string())
}
