//! Numerical stability: stored results of every family, tables, a text with the verdict first, a map.

mod kept;
mod map;
mod summary;
mod table;

pub(crate) use kept::{is_kept, json, outcomes};
pub(crate) use map::map;
pub(crate) use summary::{Tally, page, text};
pub(crate) use table::rows;
