//! The key of a class: the quantities and positions that every sheet asks for.
//! The right answers are not in the key; they follow from the scenarios.

use super::super::class_words::{self as words, SheetLanguage};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use prover::mark::MarkCriterion;
use serde::{Deserialize, Serialize};

/// Version of the format.
const FORMAT: u32 = 1;

/// The key of a class.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct ClassKey {
    format: u32,
    /// Seed of the numbers; `None` if every sheet has the numbers of its scenario.
    pub(crate) seed: Option<u64>,
    language: String,
    /// Fraction of each value by which an answer may differ; `None` for half a unit of the last requested decimal.
    within: Option<f64>,
    /// Significant digits of the largest answer of each quantity.
    pub(crate) digits: usize,
    /// Names of quantities or of stages; empty for the usual quantities.
    pub(crate) asked: Vec<String>,
    /// The sheets.
    pub(crate) sheets: Vec<KeyedSheet>,
}

/// A sheet in the key.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct KeyedSheet {
    /// Name of the sheet and of its files.
    pub(crate) name: String,
    /// Values of the input, as people read them.
    pub(crate) positions: Vec<f64>,
}

impl ClassKey {
    pub(crate) fn new(
        seed: Option<u64>,
        language: SheetLanguage,
        within: Option<f64>,
        digits: usize,
        asked: Vec<String>,
    ) -> ClassKey {
        let language = language.code().into();
        ClassKey { format: FORMAT, seed, language, within, digits, asked, sheets: Vec::new() }
    }

    /// Language of the sheets.
    pub(crate) fn language(&self) -> SheetLanguage {
        SheetLanguage::named(&self.language).unwrap_or(SheetLanguage::English)
    }

    /// The criterion that the sheets state.
    pub(crate) fn criterion(&self) -> MarkCriterion {
        self.within.map_or(MarkCriterion::Digits, MarkCriterion::Within)
    }

    /// The criterion in words.
    pub(crate) fn criterion_text(&self) -> String {
        criterion_text(self.language(), self.criterion())
    }

    /// The text by which a table of answers states its sheet: the name of the sheet, and the seed if there is one.
    pub(crate) fn id(&self, name: &str) -> String {
        self.seed.map_or_else(|| name.into(), |seed| format!("{name} of seed {seed}"))
    }

    pub(crate) fn text(&self) -> String {
        serde_json::to_string_pretty(self).expect("numbers and text") + "\n"
    }

    /// Reads a key.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] with the reason why the text is not a key.
    pub(crate) fn parse(text: &str, place: &str) -> Result<ClassKey> {
        let wrong = |why: &dyn std::fmt::Display| {
            let error = Error::new(ErrorKind::Input, sentences::is_not_the_key_of_a_class(&place, why));
            error.help(sentences::NAME_THE_DIRECTORY_OF_THE_EXERCISE)
        };
        let key: ClassKey = serde_json::from_str(text).map_err(|error| wrong(&error))?;
        if key.format != FORMAT {
            return Err(wrong(&sentences::expected_format_found(&FORMAT, &key.format)));
        }
        // Names of sheets are names of files in the directory of the class.
        let is_name = |own: &&KeyedSheet| own.name.contains(['/', '\\']) || own.name.starts_with('.');
        if let Some(sheet) = key.sheets.iter().find(is_name) {
            return Err(wrong(&sentences::is_no_name_of_a_sheet(&sheet.name)));
        }
        Ok(key)
    }
}

/// A criterion in words.
pub(in crate::report) fn criterion_text(language: SheetLanguage, criterion: MarkCriterion) -> String {
    match criterion {
        MarkCriterion::Within(share) => words::right_within(language, &((100.0 * share * 1e6).round() / 1e6)),
        MarkCriterion::Digits => words::right_to_digits(language),
        MarkCriterion::Written => words::right_as_written(language),
    }
}
