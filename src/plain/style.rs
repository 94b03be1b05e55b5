//! Colour and width of what a terminal shows. Colours are escape codes, which the command line takes out again where
//! nobody sees them.

use anstyle::{AnsiColor, Style};
use textwrap::{Options, WordSplitter, wrap};

use super::judged::{Grade, grade};
use prover::bounds::Verdict;

/// How much a report tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// The verdict, in one line.
    Verdict,
    /// What is needed to act.
    Short,
    /// Everything.
    Whole,
}

impl Detail {
    /// That of the options `--quiet` and `--verbose`.
    #[must_use]
    pub fn asked(quiet: bool, verbose: bool) -> Detail {
        match (quiet, verbose) {
            (true, _) => Detail::Verdict,
            (false, true) => Detail::Whole,
            (false, false) => Detail::Short,
        }
    }
}

/// Columns of a report that goes to a file or a pipe.
pub const COLUMNS: usize = 80;

/// The same text without colours.
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
    let colour = match grade {
        Grade::Agree => AnsiColor::Green,
        Grade::Open => AnsiColor::Yellow,
        Grade::Disagree => AnsiColor::Red,
    };
    let style = Style::new().bold().fg_color(Some(colour.into()));
    format!("{style}{}{style:#}", grade.capitals())
}

/// Text in lines of at most `width` columns, if there is a width. Lines after the first of each line given are indented.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_whole_and_following_lines_are_indented() {
        let text = "first --option=1e-4 of\n\nsecond";
        assert_eq!(wrapped(text, Some(20), 2), "first --option=1e-4\n  of\n\nsecond");
        assert_eq!(wrapped("averylongword x", Some(5), 0), "averylongword\nx");
        assert_eq!(wrapped(text, None, 2), text);
    }
}
