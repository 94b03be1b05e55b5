//! `[channels]` and `[tolerances]`: the wanted channels and the limits of judgement.

use super::keys::key::{Kind, Section, needed, optional};
use super::reader::Table;
use super::words::{choice, nearest, suggestion};
use linkage::case::Case;
use linkage::error::Result;
use linkage::trajectory::{Channel, Stage};

/// What is told of the keys that are read here.
pub const SECTIONS: &[Section] = &[
    Section::at("channels").with(&[needed("want", Kind::Texts).means("stages, subjects or channels that are wanted")]),
    Section::at("tolerances").with(&[optional("engine_rel", Kind::Number, "1e-2").means(
        "largest bound on the engine's error, as a share of a channel's scale, at which agreement still \
         proves something; between 0 and 1",
    )]),
];

/// The words of `[channels]`; there is one at least.
pub fn wanted(table: &mut Table) -> Result<Vec<String>> {
    let names = table.strings("want")?;
    table.finish()?;
    let stages = || Stage::ALL.into_iter().map(Stage::name);
    if names.is_empty() {
        let help =
            format!("name at least one, or leave the section out to get all; {}", suggestion("", stages(), "\""));
        return table.refuse("want", "nothing is wanted", help);
    }
    Ok(names)
}

/// The case with the channels wanted that the words of `[channels]` ask for.
pub fn wanting(table: &Table, names: &[String], case: Case) -> Result<Case> {
    let channels = called(&case, names).or_else(|(message, help)| table.refuse("want", message, help))?;
    Ok(case.wanting_only(&channels))
}

/// The channels that words ask for.
///
/// # Errors
/// What is wrong with a word, and the way out.
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
                Some(near) => format!("did you mean \"{near}\"?"),
                None => format!(
                    "ask for {}, for a subject such as \"{}\", for its stage, \"{}.positions\", or for one channel",
                    choice(stages, "\""),
                    known[Stage::ALL.len()],
                    known[Stage::ALL.len()],
                ),
            };
            return Err((format!("there are no channels \"{word}\""), help));
        }
        channels.extend(own);
    }
    Ok(channels)
}

/// Default share for [`engine_rel`]: chosen, not derived.
pub const ENGINE_REL: f64 = 1e-2;

/// Largest bound on the error of the engine, as a share of a channel's scale, at which agreement is still a proof.
pub fn engine_rel(table: &mut Table) -> Result<f64> {
    let share = table.optional_number("engine_rel")?.unwrap_or(ENGINE_REL);
    table.finish()?;
    if share > 0.0 && share < 1.0 {
        return Ok(share);
    }
    let message = format!("found {share}, but this is a share of a channel's scale");
    table.refuse("engine_rel", message, "give a number between 0 and 1, such as 1e-2")
}
