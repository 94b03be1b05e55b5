//! Colour and width of terminal output.
//! Colours are escape codes, which the command line removes if the output is not a terminal.

use anstyle::{AnsiColor, Style};
use textwrap::{Options, WordSplitter, wrap};

use super::judged::grade;
use prover::bounds::Verdict;

/// How detailed a report is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// The verdict, in one line.
    Verdict,
    /// The verdict, and everything that the user needs to act.
    Short,
    /// Everything.
    Whole,
}

impl Detail {
    /// The level set by the options `--quiet` and `--verbose`.
    #[must_use]
    pub fn asked(quiet: bool, verbose: bool) -> Detail {
        match (quiet, verbose) {
            (true, _) => Detail::Verdict,
            (false, true) => Detail::Whole,
            (false, false) => Detail::Short,
        }
    }
}

/// Width of a report for a file or a pipe, in columns.
pub const COLUMNS: usize = 80;

/// The given text without colours.
#[must_use]
pub fn plain(text: &str) -> String {
    let mut parts = text.split("\u{1b}[");
    let first = parts.next().unwrap_or_default();
    let rest = parts.map(|part| part.split_once('m').map_or("", |(_, rest)| rest));
    std::iter::once(first).chain(rest).collect()
}

/// The word of a verdict in capitals, in its colour.
pub fn verdict(verdict: &Verdict) -> String {
    let grade = grade(verdict);
    let colour = grade.of([AnsiColor::Green, AnsiColor::Yellow, AnsiColor::Red]);
    let style = Style::new().bold().fg_color(Some(colour.into()));
    format!("{style}{}{style:#}", grade.capitals())
}

/// Text in lines of at most `width` columns, if a width is given.
/// Continuation lines are indented.
/// A word is never broken: names and commands stay whole.
pub fn wrapped(text: &str, width: Option<usize>, indent: usize) -> String {
    let Some(width) = width else { return text.into() };
    let indent = " ".repeat(indent);
    let options =
        Options::new(width).subsequent_indent(&indent).word_splitter(WordSplitter::NoHyphenation).break_words(false);
    let lines = text.lines().flat_map(|line| match line.trim_end() {
        "" => vec![String::new()],
        line => wrap(line, &options).into_iter().map(|line| line.into_owned()).collect(),
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Text in lines of at most `width` columns, if a width is given.
/// Continuation lines begin at the column of the text in the first line: after `error: `, or after the name of a value.
/// Lines of a file in a message stay as they are.
#[cfg(feature = "command")]
pub(crate) fn within(text: &str, width: Option<usize>) -> String {
    let Some(width) = width else { return text.into() };
    let fit = |line: &str| match textwrap::core::display_width(line) > width && !is_quoted(line) {
        true => wrapped(line, Some(width), hanging(line)),
        false => line.to_string(),
    };
    text.split('\n').map(fit).collect::<Vec<_>>().join("\n")
}

/// Whether a line of a message quotes a line of a file, or names its location.
#[cfg(feature = "command")]
fn is_quoted(line: &str) -> bool {
    let line = line.trim_start().trim_start_matches(|sign: char| sign.is_ascii_digit()).trim_start();
    ["|", "-->", "..."].iter().any(|sign| line.starts_with(sign))
}

/// Column of the text in a line.
#[cfg(feature = "command")]
fn hanging(line: &str) -> usize {
    const MOST: usize = 30;
    let named = ["error: ", "warning: ", "note: ", "= help: "];
    if let Some(end) = named.iter().find_map(|name| Some(line.find(name)? + name.len()).filter(|end| *end <= MOST)) {
        return end;
    }
    let margin = line.len() - line.trim_start().len();
    let gap = line[margin..].find("  ").map(|at| margin + at);
    let behind = gap.map(|at| at + line[at..].len() - line[at..].trim_start().len());
    behind.filter(|behind| *behind <= MOST).unwrap_or(margin + 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(feature = "command")]
    #[test]
    fn long_lines_have_a_hanging_indent() {
        for (line, lines) in [
            ("error: no such file or directory", "error: no such file or\n       directory"),
            ("  = help: name another file here", "  = help: name another\n          file here"),
            ("source   a book of mechanisms", "source   a book of\n         mechanisms"),
            ("12 | mass_kg = 1 # a long comment", "12 | mass_kg = 1 # a long comment"),
            ("short", "short"),
        ] {
            assert_eq!(super::within(line, Some(22)), lines);
        }
        assert_eq!(super::within("a long line of words", None), "a long line of words");
    }

    #[test]
    fn words_stay_whole_and_following_lines_are_indented() {
        let text = "first --option=1e-4 of\n\nsecond";
        assert_eq!(wrapped(text, Some(20), 2), "first --option=1e-4\n  of\n\nsecond");
        assert_eq!(wrapped("averylongword x", Some(5), 0), "averylongword\nx");
        assert_eq!(wrapped(text, None, 2), text);
    }
}
