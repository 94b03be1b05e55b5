//! Words for messages: lists, and the known name that is nearest to a misspelt name.

use crate::sentences;
use strsim::osa_distance;

/// Upper limit of the length of a word that is checked for misspelling (characters).
/// The cost grows with the product of the lengths of word and candidate.
const LONGEST: usize = 100;
/// Upper limit of the number of candidates. If there are more, none is compared with the wrong word, and none is shown.
const MOST: usize = 1000;
/// Largest number of names that a list shows.
const LISTED: usize = 24;

/// The candidate nearest to `word`, if its edit distance from `word` is small enough.
#[must_use]
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // In a name of one or two letters, a different letter makes a different name, so no misspelling is assumed.
    let length = word.chars().count();
    if length > LONGEST {
        return None;
    }
    let allowed = if length < 3 { 0 } else { ((length + 1) / 3).min(3) };
    candidates
        .into_iter()
        .filter(|candidate| candidate.len() <= 4 * LONGEST)
        .map(|candidate| (osa_distance(word, candidate), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// `a, b or c`, each word quoted with the mark `quote`.
#[must_use]
pub fn choice<'a>(words: impl IntoIterator<Item = &'a str>, quote: &str) -> String {
    let words: Vec<String> = words.into_iter().map(|word| format!("{quote}{word}{quote}")).collect();
    match words.split_last() {
        None => "nothing".into(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
    }
}

/// Returns "did you mean" with the candidate that is nearest to `word`. If no candidate is near enough, returns the
/// candidates with the same end after a dot as `word`, such as `links.crank.mass_kg` for `mass_kg`; if there is none,
/// all candidates. A long list is cut.
#[must_use]
pub fn suggestion<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>, quote: &str) -> String {
    let candidates: Vec<&str> = candidates.into_iter().take(MOST + 1).collect();
    if candidates.len() > MOST {
        return sentences::it_is_none_of_more_than_names(&MOST);
    }
    match nearest(word, candidates.iter().copied()) {
        Some(near) => sentences::did_you_mean_4(&quote, &near),
        None if candidates.is_empty() => sentences::THERE_IS_NONE_THAT_COULD.into(),
        None => {
            let related: Vec<&str> = candidates.iter().copied().filter(|own| has_same_end(word, own)).collect();
            match related[..] {
                [] => sentences::allowed_here_2(&some_of(&candidates, quote)),
                [near] => sentences::did_you_mean_4(&quote, &near),
                _ => sentences::did_you_mean_one_of(&some_of(&related, quote)),
            }
        }
    }
}

/// Whether one of two names ends with the other name after a dot.
fn has_same_end(one: &str, other: &str) -> bool {
    let ends = |long: &str, short: &str| long.strip_suffix(short).is_some_and(|rest| rest.ends_with('.'));
    ends(one, other) || ends(other, one)
}

/// A choice of at most `LISTED` names, with the number of further names.
fn some_of(names: &[&str], quote: &str) -> String {
    match names.len() > LISTED {
        true => {
            let shown: Vec<String> = names[..LISTED].iter().map(|name| format!("{quote}{name}{quote}")).collect();
            sentences::and_names_more(&shown.join(", "), &(names.len() - LISTED))
        }
        false => choice(names.iter().copied(), quote),
    }
}

/// Words that are allowed as the value of a key, each with what it stands for.
pub type Words<T> = &'static [(&'static str, T)];

/// The words alone.
#[must_use]
pub fn names<T>(words: Words<T>) -> Vec<&'static str> {
    words.iter().map(|(word, _)| *word).collect()
}

/// Help for an unknown word: the list of all allowed words.
/// If an allowed word is near enough to the unknown word, the help also names the nearest allowed word.
#[must_use]
pub fn suggested(word: &str, words: &[&str]) -> String {
    let near = nearest(word, words.iter().copied()).map(|near| sentences::did_you_mean_3(&near));
    sentences::allowed_here(&near.unwrap_or_default(), &(choice(words.iter().copied(), "\"")))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four kinds of slip are tolerated: a missing letter, an extra letter, a wrong letter, and two swapped letters.
    #[test]
    fn single_typing_errors_are_recognised() {
        for slip in ["mas_kg", "masss_kg", "mess_kg", "amss_kg"] {
            assert_eq!(nearest(slip, ["length_mm", "mass_kg"]), Some("mass_kg"), "{slip}");
        }
    }

    #[test]
    fn only_a_near_word_is_suggested() {
        assert_eq!(nearest("rokcer", ["crank", "rocker"]), Some("rocker"));
        assert_eq!(nearest("wheel", ["crank", "rocker"]), None);
        assert_eq!(nearest("B", ["A", "C"]), None);
        assert_eq!(nearest("velocity", ["positions", "velocities"]), Some("velocities"));
        assert_eq!(suggestion("wheel", ["crank", "rocker"], "\""), "allowed here: \"crank\" or \"rocker\"");
    }

    #[test]
    fn names_with_the_same_end_are_suggested_and_long_lists_are_cut() {
        let known = ["L_mm", "links.crank.mass_kg", "links.rod.mass_kg", "links.rod.inertia_kg_m2"];
        assert_eq!(suggestion("parameters.L_mm", known, "`"), "did you mean `L_mm`?");
        assert_eq!(suggestion("rod.mass_kg", known, "`"), "did you mean `links.rod.mass_kg`?");
        let both = "did you mean one of these: `links.crank.mass_kg` or `links.rod.mass_kg`?";
        assert_eq!(suggestion("mass_kg", known, "`"), both);
        let many: Vec<String> = (0..30).map(|k| format!("name{k}0")).collect();
        let told = suggestion("wheel", many.iter().map(String::as_str), "`");
        assert!(told.ends_with("`name220`, `name230` and 6 more"), "{told}");
    }
}
