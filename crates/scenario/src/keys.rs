//! Every key of scenario files, with the description that editors show.
//! Each key is defined beside its reader, which decides what is read.
//! Tests check that keys, readers and the format document are consistent.

pub mod key;
#[cfg(test)]
mod tests;

pub use key::{FileKey, Section, ValueKind};

use super::{
    case_figure, clearance, engine, formula, grid, joints, links, loads, motion, motor, oracle, settings, start,
    stated, transmissions,
};

/// All sections.
pub fn sections() -> impl Iterator<Item = &'static Section> {
    let all = [
        stated::SECTIONS,
        links::SECTIONS,
        joints::SECTIONS,
        transmissions::SECTIONS,
        motion::SECTIONS,
        motor::SECTIONS,
        loads::SECTIONS,
        start::SECTIONS,
        grid::SECTIONS,
        settings::SECTIONS,
        engine::SECTIONS,
        clearance::SECTIONS,
        oracle::SECTIONS,
        formula::SECTIONS,
        case_figure::SECTIONS,
    ];
    all.into_iter().flatten()
}

/// The keys of the section at a path; empty if there is no such section.
pub(crate) fn rows(path: &str) -> &'static [FileKey] {
    section(path).map_or(&[], |section| section.keys)
}

/// The section at `path`; `None` if there is no such section.
#[must_use]
pub fn section(path: &str) -> Option<&'static Section> {
    sections().find(|section| section.path == path)
}
