//! `[channels]` and `[tolerances]`: the requested channels and the limits of judgement.

use super::keys::key::{Section, ValueKind, needed, optional};
use super::reader::TomlTable;
use super::words::{choice, nearest, suggestion};
use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::trajectory::{Channel, Stage};

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("channels").with(&[needed("want", ValueKind::Texts).means("requested stages, subjects or channels")]),
    Section::at("tolerances").with(&[optional("engine_rel", ValueKind::Number, "1e-2").means(
        "largest bound on the engine's error, as a fraction of a channel's scale, at which agreement is \
         conclusive; between 0 and 1",
    )]),
];

/// The words of `[channels]`. At least one word is required.
pub fn wanted(table: &mut TomlTable) -> Result<Vec<String>> {
    let names = table.strings("want")?;
    table.finish()?;
    let stages = || Stage::ALL.into_iter().map(Stage::name);
    if names.is_empty() {
        let help = sentences::name_at_least_one_or_leave(&(suggestion("", stages(), "\"")));
        return table.refuse("want", sentences::NOTHING_IS_WANTED, help);
    }
    Ok(names)
}

/// The case, restricted to the channels that the words of `[channels]` request.
pub fn wanting(table: &TomlTable, names: &[String], case: Case) -> Result<Case> {
    let channels = called(&case, names).or_else(|(message, help)| table.refuse("want", message, help))?;
    Ok(case.wanting_only(&channels))
}

/// The channels that words request.
///
/// # Errors
/// Message and help for a word that requests no channel.
pub fn called(case: &Case, words: &[String]) -> std::result::Result<Vec<Channel>, (String, String)> {
    let mut channels = Vec::new();
    for word in words {
        let own = case.channels_called(word);
        if own.is_empty() {
            let known = case.channel_words();
            let stages = Stage::ALL.into_iter().map(Stage::name);
            let ends = known.iter().find(|known| known.split_once('.').is_some_and(|(_, name)| name == word));
            let near = ends.map(String::as_str).or_else(|| nearest(word, known.iter().map(String::as_str)));
            let help = match near {
                Some(near) => sentences::did_you_mean_2(&near),
                None => sentences::ask_for_for_a_subject_such_as_for_its_stage(
                    &(choice(stages, "\"")),
                    &known[Stage::ALL.len()],
                    &known[Stage::ALL.len()],
                ),
            };
            return Err((sentences::there_are_no_channels(&word), help));
        }
        channels.extend(own);
    }
    Ok(channels)
}

/// Default of [`engine_rel`]. This default is a choice and has no derivation.
pub const ENGINE_REL: f64 = 1e-2;

/// Reads the limit of a ratio: the bound on the engine's error, divided by a channel's scale. If the ratio exceeds this
/// limit, agreement proves nothing.
pub fn engine_rel(table: &mut TomlTable) -> Result<f64> {
    let share = table.optional_number("engine_rel")?.unwrap_or(ENGINE_REL);
    table.finish()?;
    if share > 0.0 && share < 1.0 {
        return Ok(share);
    }
    let message = sentences::found_but_this_is_a_share(&share);
    table.refuse("engine_rel", message, sentences::GIVE_A_NUMBER_BETWEEN_AND_SUCH_AS)
}
