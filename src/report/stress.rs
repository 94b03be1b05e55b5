//! Numerical stability: stored results of every family, tables, a text with the verdict first, a map.

mod kept;
mod map;
mod page;
mod summary;
mod table;

pub(crate) use kept::{is_kept, json, outcomes};
pub(crate) use map::map;
pub(crate) use page::page;
pub(crate) use summary::{Tally, text};
pub(crate) use table::rows;
