//! Plain text of a proof, its diagnosis and an error.
//! The text is the message of a failed test, and the common part of all reports.

/// Adds a line to a text. The line is a format string with its values, or a complete sentence.
macro_rules! say {
    ($text:expr, $format:literal $($values:tt)*) => {{
        use std::fmt::Write as _;
        // Writing to a string never fails.
        let _ = writeln!($text, $format $($values)*);
    }};
    ($text:expr, $sentence:expr) => {
        say!($text, "{}", $sentence)
    };
}

/// Appends words to the last line of a text. The words are a format string with its values, or a complete sentence.
macro_rules! put {
    ($text:expr, $format:literal $($values:tt)*) => {{
        use std::fmt::Write as _;
        let _ = write!($text, $format $($values)*);
    }};
    ($text:expr, $sentence:expr) => {
        put!($text, "{}", $sentence)
    };
}

pub mod brief;
pub mod cells;
pub mod diagnosis;
pub mod engines;
pub mod errors;
pub mod figures;
pub mod formula_blocks;
pub mod judged;
pub mod machine;
pub mod reasons;
pub mod style;

/// Function that puts advice into words.
/// A program with options can name them in the advice; `Advice::to_string` names no options.
pub type Tell = fn(&linkage::error::Advice) -> String;
