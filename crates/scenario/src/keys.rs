//! Every key of scenario files: what editors are told of the format. The readers decide what is read; tests hold this
//! table to the keys that they ask for, and the document of the format to this table.

mod key;
mod table;
#[cfg(test)]
mod tests;

pub use key::{Key, Kind, Section, needed, optional};
pub use table::SECTIONS;

/// The section with a path.
#[must_use]
pub fn section(path: &str) -> Option<&'static Section> {
    SECTIONS.iter().find(|section| section.path == path)
}
