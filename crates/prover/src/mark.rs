//! Answers of students, judged cell by cell, with the likely cause of every wrong cell.
//!
//! An [`AnswerSheet`] has the right answers for one student, from both analytic sides.
//! [`read_answers`] reads the student's table, and [`marked`] judges it by a [`MarkCriterion`].
//! The verdict on a cell does not depend on other cells.
//! The cause of a wrong cell is a [`MarkCause`]: a mistake that turns the right answers into the student's number.
//! A cause that also explains other wrong cells is preferred to a cause that explains this cell alone.

mod answers;
mod cause;
mod criterion;
mod digits;
mod forgotten;
mod hypothesis;
mod judge;
mod parts;
mod question;
mod rules;
mod sheet;
mod worlds;

pub use answers::{StudentAnswers, StudentCell, read_answers};
pub use cause::{CellPlace, MarkCause, PartOfPoint};
pub use criterion::MarkCriterion;
pub use judge::{CellVerdict, MarkedCell, MarkedSheet, marked};
pub use question::{ANSWER_WORDS, AskedColumn, columns_of};
pub use sheet::AnswerSheet;
