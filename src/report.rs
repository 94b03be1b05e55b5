//! Presents the results of every command as text and as JSON.
//! The functions are pure: they use no files, clock or terminal.

pub(crate) mod accept;
pub(crate) mod bearings;
pub(crate) mod bench;
pub(crate) mod bench_page;
pub(crate) mod bench_plot;
pub(crate) mod case_json;
mod chart;
pub(crate) mod check;
pub(crate) mod class_words;
pub(crate) mod clearance;
pub(crate) mod closed_form;
pub(crate) mod closing;
pub mod compare;
pub(crate) mod comparison;
pub(crate) mod cyclogram;
pub(crate) mod diagram;
pub(crate) mod drive;
pub(crate) mod drive_graphs;
pub(crate) mod drivers;
pub(crate) mod exercise;
pub mod explain;
pub(crate) mod fixed;
pub(crate) mod front;
pub(crate) mod golden;
pub(crate) mod html;
pub(crate) mod inspect;
pub mod json;
pub mod junit;
pub(crate) mod layout;
pub(crate) mod lists;
#[cfg(feature = "live")]
pub(crate) mod live;
pub(crate) mod mark;
pub mod markdown;
pub(crate) mod modes;
pub(crate) mod motor_choice;
pub mod mutate;
pub mod outcomes;
pub(crate) mod plan;
pub(crate) mod plotjuggler;
pub(crate) mod precision;
mod pretty;
pub(crate) mod range;
pub(crate) mod recorded;
pub mod schema;
pub(crate) mod sensitivity;
pub(crate) mod stress;
pub(crate) mod sweep;
pub(crate) mod synthesize;
pub(crate) mod table_csv;
pub mod text;
pub(crate) mod tune;
#[cfg(feature = "watch")]
pub(crate) mod watch;

pub use crate::plain::Tell;
