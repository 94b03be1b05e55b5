#![doc = include_str!("../README.md")]
//! Loops over rows are in this crate, because release builds compile it with the highest optimisation level.
//!
//! - [`read`]: a text with separated columns as a [`TextTable`].
//! - [`CellTable`]: the cells of a table as written.
//! - [`Records`]: the rows of a table whose cells are not all numbers.
//! - [`TableCell`] and [`numbers`]: the numbers of a column, each with the uncertainty caused by the printing of its
//!   digits.
//! - [`numbers_beside`]: the numbers of a column of a file, each with its uncertainty.
//!   The file's other columns show the format of a column of zeros.
//! - [`chosen`]: whether printed instants are exact or rounded.
//! - [`judge`]: comparison of two columns.

mod cell;
mod cells;
mod constant;
mod instants;
mod judge;
mod records;
mod sentences;
mod text;

pub use cell::{MISSING, TableCell, UNDEFINED, is_missing, numbers};
pub use cells::CellTable;
pub use constant::numbers_beside;
pub use instants::{chosen, degrees_chosen, drift};
pub use judge::{Allowance, Beside, JudgedColumns, RowPair, ScaleColumn, judge};
pub use records::Records;
pub use text::{TableFault, TextTable, Twice, bytes, read};
