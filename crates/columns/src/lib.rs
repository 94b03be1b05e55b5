#![doc = include_str!("../README.md")]
//!
//! Loops over rows stand here, because this crate is compiled with optimisation.
//!
//! - [`read`]: a text with separated columns as a [`TextTable`].
//! - [`Records`]: the rows of a table whose cells are not all numbers.
//! - [`TableCell`] and [`numbers`]: what the digits of a column leave open.
//! - [`numbers_beside`]: the same in a file, where other columns tell what a constant does not show.
//! - [`chosen`]: whether instants were chosen as they are printed, or rounded.
//! - [`judge`]: two columns against each other.

mod cell;
mod constant;
mod instants;
mod judge;
mod records;
mod sentences;
mod text;

pub use cell::{MISSING, TableCell, UNDEFINED, is_missing, numbers};
pub use constant::numbers_beside;
pub use instants::{chosen, degrees_chosen, drift};
pub use judge::{Allowance, Beside, JudgedColumns, RowPair, ScaleColumn, judge};
pub use records::Records;
pub use text::{TableFault, TextTable, Twice, bytes, read};
