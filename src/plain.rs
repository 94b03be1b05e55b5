//! A proof, its diagnosis and an error as plain text: what a failed test shows, and what every report has in common.

/// Adds a line to a text: a format with its values, or a sentence.
macro_rules! say {
    ($text:expr, $format:literal $($values:tt)*) => {{
        use std::fmt::Write as _;
        // A text takes whatever is written to it.
        let _ = writeln!($text, $format $($values)*);
    }};
    ($text:expr, $sentence:expr) => {
        say!($text, "{}", $sentence)
    };
}

/// Adds to the last line of a text: a format with its values, or a sentence.
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
pub mod judged;
pub mod reasons;
pub mod style;

/// Function that words an advice. A program with options names them; `Advice::to_string` names none.
pub type Tell = fn(&linkage::error::Advice) -> String;
