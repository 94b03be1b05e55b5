//! Errors of a text that is not valid TOML or CSV.

use crate::sentences;
use std::ops::Range;

use toml::de::DeTable;

use linkage::error::{Error, ErrorKind, Place};

/// Upper limit of the number of bytes that are parsed in the search for the first occurrence of a duplicate key.
const MOST: usize = 10_000_000;

/// Function that converts a range of bytes to a position in the file.
type Places<'a> = &'a dyn Fn(Range<usize>) -> Place;

/// The error of a file that is not valid TOML.
pub(super) fn no_toml(text: &str, place: Places, error: &toml::de::Error) -> Error {
    let span = error.span().unwrap_or(0..0);
    if error.message() == DUPLICATE {
        return duplicate(text, place, span);
    }
    if let Some(number) = decimal_comma(text, span.start) {
        let found = &text[number.clone()];
        return Error::new(ErrorKind::Input, sentences::the_file_is_not_valid_toml_has_a_decimal(&found))
            .at(place(number.clone()))
            .help(sentences::decimals_take_a_point_write(&(found.replace(',', "."))));
    }
    let message = error.message().trim().replace('\n', ", ");
    let help = if message.contains("unquoted key") {
        sentences::QUOTE_NAMES_WITH_OTHER_LETTERS
    } else if message.contains("inline table") {
        sentences::WRITE_THE_KEYS_INSIDE_THE_BRACES
    } else {
        sentences::A_KEY_IS_WRITTEN_NAME_VALUE
    };
    Error::new(ErrorKind::Input, sentences::the_file_is_not_valid_toml(&message)).at(place(span)).help(help)
}

/// The parser's message for a key that occurs twice in its table.
const DUPLICATE: &str = "duplicate key";

fn duplicate(text: &str, place: Places, span: Range<usize>) -> Error {
    let key = &text[span.clone()];
    let error = Error::new(ErrorKind::Input, sentences::the_file_is_not_valid_toml_duplicate(&key));
    let first = first_of(text, &span).map(|at| place(at..at + key.len()).line());
    let error = match first {
        None => error,
        Some(line) => error.map_message(|message| sentences::first_in_line(&message, &line)),
    };
    error.at(place(span)).help(sentences::KEEP_ONE_OF_THE_TWO)
}

/// Position of the first occurrence of the duplicate key at `span`.
/// The keys before `span` are renamed, one after the other. If the error disappears, the renamed key is the first
/// occurrence, because it is in the table of the duplicate key.
fn first_of(text: &str, span: &Range<usize>) -> Option<usize> {
    const OTHER: &str = "another-key";
    let key = &text[span.clone()];
    let is_part = |c: char| c.is_alphanumeric() || "_-\"'".contains(c);
    let is_word = |at: usize| !text[..at].ends_with(is_part) && !text[at + key.len()..].starts_with(is_part);
    let before = text[..span.start].rmatch_indices(key).map(|(at, _)| at).filter(|&at| is_word(at));
    before.take(MOST / text.len()).find(|&at| {
        let without = [&text[..at], OTHER, &text[at + key.len()..]].concat();
        let moved = span.start - key.len() + OTHER.len();
        let errors = DeTable::parse_recoverable(&without).1;
        !errors.iter().any(|error| error.message() == DUPLICATE && error.span().is_some_and(|at| at.start == moved))
    })
}

/// The number with a decimal comma that is the value of a key. Byte `at` lies within this number or at its end.
fn decimal_comma(text: &str, at: usize) -> Option<Range<usize>> {
    let line = text[..at].rfind('\n').map_or(0, |before| before + 1);
    let end = text[at..].find('\n').map_or(text.len(), |length| at + length);
    let values = text[line..end].match_indices('=').map(|(own, _)| {
        let value = text[line + own + 1..end].trim_start();
        (end - value.len(), value)
    });
    values
        .filter_map(|(start, value)| {
            let length = value.find(|c: char| !c.is_ascii_digit() && !"+-,.".contains(c)).unwrap_or(value.len());
            let number = value[..length].trim_end_matches(',');
            has_decimal_comma(number).then_some(start..start + number.len())
        })
        .find(|number| (number.start..=number.end + 1).contains(&at))
}

/// Whether a text is a number if its decimal comma is replaced by a point.
pub(super) fn has_decimal_comma(text: &str) -> bool {
    let is_sound = |(whole, part): (&str, &str)| {
        let whole = whole.trim_start_matches(['+', '-']);
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        digits(whole) && digits(part)
    };
    text.trim().split_once(',').is_some_and(is_sound)
}

#[cfg(test)]
mod tests {
    use crate::source::Source;
    use std::path::Path;

    fn told(text: &str) -> (usize, String) {
        let error = Source::new(Path::new("x.toml"), text).tree().unwrap_err();
        (error.place().unwrap().line(), format!("{}; {}", error.message(), error.way_out().unwrap()))
    }

    #[test]
    fn duplicate_keys_name_both_lines() {
        for (text, second, first) in [
            ("a = 1\n[x]\na = 2\nb = 3\na = 4\n", 5, 3),
            ("a = 1\na = 4\n", 2, 1),
            ("[x]\na = 1\n[y]\na = 1\n[x]\nb = 1\n", 5, 1),
            ("p = {\n a = 1,\n b = 2,\n a = 3 }\n", 4, 2),
            ("p.a = 1\nq.a = 1\np.b = 1\np.a = 2\n", 4, 1),
            ("[[l]]\na = 1\n[[l]]\n\"a\" = 1\n\"a\" = 2\n", 5, 4),
        ] {
            let (line, told) = told(text);
            assert_eq!(line, second, "{text}: {told}");
            assert!(told.contains(&format!("is given twice, first in line {first}; keep one")), "{text}: {told}");
        }
    }

    #[test]
    fn names_with_other_letters_are_to_be_quoted() {
        assert!(told("О = { x_m = 0 }\n").1.ends_with("such as \"О\" = 1"), "{}", told("О = { x_m = 0 }\n").1);
    }

    #[test]
    fn decimal_commas_are_reported() {
        for text in
            ["x = 30,5\n", "p = { x = 30,5, y = 4 }\n", "p = { y = 4, x = 30,5 }\n", "x = 30,5", "x = 30,5 # mm\n"]
        {
            let (_, told) = told(text);
            assert_eq!(
                told, "the file is not valid TOML: `30,5` has a decimal comma; write decimals with a point: 30.5",
                "{text}"
            );
        }
        assert!(told("x = -0,25\n").1.ends_with("with a point: -0.25"));
        for text in ["x = 30,\n", "x = [1,2\n", "x = 1 2\n", "x = 1,2,3\n", "x = ,5\n"] {
            assert!(!told(text).1.contains("decimal comma"), "{text}");
        }
    }
}
