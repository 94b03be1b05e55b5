//! What the terminal of standard output is like: its width, and whether it takes colours.

use std::io::{self, IsTerminal, Write};

use anstream::AutoStream;
use terminal_size::{Width, terminal_size_of};

use super::output;
use crate::plain::style::COLUMNS;
use linkage::error::Result;

/// Columns below which a table is not worth reading; a narrower terminal breaks the lines itself.
const LEAST: usize = 60;

/// Columns of the terminal, or 80 if standard output is none.
pub(super) fn columns() -> usize {
    width().unwrap_or(COLUMNS)
}

/// Columns of the terminal; `None` if standard output is none.
pub(super) fn width() -> Option<usize> {
    let out = io::stdout();
    let known = if out.is_terminal() { terminal_size_of(&out) } else { None };
    known.map(|(Width(columns), _)| usize::from(columns).max(LEAST))
}

/// Writes a report to standard output. Its colours stay where standard output takes them: on a terminal, unless NO_COLOR
/// is set, or with CLICOLOR_FORCE.
pub(super) fn print(report: &str) -> Result<()> {
    let choice = AutoStream::choice(&io::stdout());
    let mut text = AutoStream::new(Vec::new(), choice);
    // A vector takes everything.
    let _ = text.write_all(report.as_bytes());
    output::print(&String::from_utf8_lossy(&text.into_inner()))
}
