//! Scenarios that differ from a file only in some numbers.

use std::path::Path;

use toml::Spanned;
use toml::de::DeTable;

use super::numbers;
use super::source::Source;
use super::start::Lists;
use super::words::suggestion;
use super::{Scenario, StartRequest, of_tree};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};

/// A file whose numbers are replaced many times. The text is parsed only once.
pub struct ScenarioFamily<'a> {
    source: Source<'a>,
    tree: Spanned<DeTable<'a>>,
    asked: StartRequest,
}

impl<'a> ScenarioFamily<'a> {
    /// The family of the file at `path`, whose text is `text`. `asked` is the start of all scenarios.
    /// If `is_judged` is false, formulas and published numbers are not read.
    ///
    /// # Errors
    /// The errors of [`Scenario::parse_as`] for a text that is not TOML.
    pub fn of(text: &'a str, path: &'a Path, asked: StartRequest, is_judged: bool) -> Result<Self> {
        let source = Source::new(path, text);
        let mut tree = source.tree()?;
        if !is_judged {
            for key in ["formula", "oracle"] {
                tree.as_mut().remove(key);
            }
        }
        Ok(ScenarioFamily { source, tree, asked })
    }

    /// The tree of the file, before numbers are replaced.
    pub(super) fn tree(&self) -> &DeTable<'a> {
        self.tree.get_ref()
    }

    /// The numbers that replace numbers of the file in all scenarios.
    pub(super) fn set(&self) -> &[(String, f64)] {
        &self.asked.set
    }

    /// Checks that the file has numbers or parameters with these keys. `member` is a scenario of the family.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a key that the file does not have, and for a parameter that is not named by its key
    /// alone.
    pub fn check_keys(&self, keys: &[&str], member: &Scenario) -> Result<()> {
        for key in keys {
            let all = member.formulas.parameters.iter().map(|own| own.key.as_str());
            if let Some(own) = key.strip_prefix("parameters.") {
                let error = Error::new(ErrorKind::Input, sentences::is_the_path_of_a_parameter(key)).key(*key);
                return Err(error.help(sentences::name_the_parameter(&own)));
            }
            if numbers::is_path(key) {
                numbers::replace(&mut self.tree.get_ref().clone(), &[(key.to_string(), 0.0)])?;
            } else if all.clone().all(|own| own != *key) {
                let error = Error::new(ErrorKind::Input, sentences::the_scenario_has_no_parameter(key));
                return Err(error.key("parameters").help(suggestion(key, all, "`")));
            }
        }
        Ok(())
    }

    /// The scenario in which numbers of the file are replaced: first by the numbers of the whole family, then by the
    /// numbers in `set`.
    ///
    /// # Errors
    /// The errors of [`Scenario::parse_as`].
    pub fn member(&self, set: &[(String, f64)]) -> Result<Scenario> {
        let mut asked = self.asked.clone();
        asked.set.extend_from_slice(set);
        Ok(of_tree(self.source.clone(), self.tree.clone(), &asked, Lists::No)?.0)
    }
}
