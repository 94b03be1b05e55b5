//! Parts that all pages of a class share.

use super::super::class_words::{self as words, SheetLanguage};
use super::super::html::{escaped, filled};
use linkage::trajectory::ChannelSubject;
use prover::mark::{AnswerSheet, AskedColumn};
use prover::numbers::fixed;

/// A page of HTML for screen and print that needs no further file.
pub(in crate::report) fn page(language: SheetLanguage, title: &str, body: &str) -> String {
    let slots = [("language", language.code()), ("title", &escaped(title)), ("body", body)];
    filled(include_str!("page.html"), &slots)
}

/// A quantity in words.
pub(in crate::report) fn quantity(language: SheetLanguage, column: &AskedColumn) -> String {
    let (kind, name) = (column.channels[0].kind, column.of());
    match (kind.subject, kind.suffix, column.is_size()) {
        (ChannelSubject::Link, "angle_rad", _) => words::angle_of(language, &name),
        (ChannelSubject::Link, "omega_rad_s", _) => words::omega_of(language, &name),
        (ChannelSubject::Link, "alpha_rad_s2", _) => words::alpha_of(language, &name),
        (ChannelSubject::Point, "vx_m_s", true) => words::speed_of(language, &name),
        (ChannelSubject::Point, "ax_m_s2", true) => words::acceleration_of(language, &name),
        (ChannelSubject::Joint, "fx_N", true) => words::reaction_of(language, &name),
        (_, "torque_N_m", _) => words::balancing_moment(language),
        _ => words::other_quantity(language, &column.name),
    }
}

/// A value of a quantity as text, with the requested decimals and `more` further decimals.
pub(in crate::report) fn cell_text(sheet: &AnswerSheet, column: usize, value: f64, more: usize) -> String {
    let decimals = usize::try_from(sheet.decimals[column]).unwrap_or_default() + more;
    fixed(value, decimals)
}
