//! Presentation of the results of every command, as text and as JSON: pure functions of data, without files, clock or
//! terminal.

/// Adds a line to a text.
macro_rules! say {
    ($text:expr, $($told:tt)*) => {{
        use std::fmt::Write as _;
        // A text takes whatever is written to it.
        let _ = writeln!($text, $($told)*);
    }};
}

/// Adds to the last line of a text.
macro_rules! put {
    ($text:expr, $($told:tt)*) => {{
        use std::fmt::Write as _;
        let _ = write!($text, $($told)*);
    }};
}

pub(crate) mod accept;
pub(crate) mod bearings;
pub(crate) mod bench;
pub(crate) mod bench_page;
pub(crate) mod bench_plot;
pub mod brief;
pub(crate) mod case_json;
mod cells;
pub(crate) mod check;
pub(crate) mod clearance;
pub(crate) mod closed_form;
pub(crate) mod closing;
pub mod diagnosis;
pub(crate) mod diagram;
pub(crate) mod drive;
pub(crate) mod drive_graphs;
mod engines;
pub(crate) mod errors;
pub mod explain;
pub(crate) mod film;
pub(crate) mod html;
pub(crate) mod inspect;
pub mod json;
mod judged;
pub mod junit;
pub(crate) mod layout;
pub(crate) mod lists;
#[cfg(feature = "live")]
pub(crate) mod live;
pub mod markdown;
pub(crate) mod modes;
pub(crate) mod motor_choice;
pub mod mutate;
pub mod outcomes;
mod own_forces;
pub(crate) mod plan;
pub(crate) mod plotjuggler;
mod pretty;
pub(crate) mod range;
mod reasons;
pub(crate) mod recorded;
pub mod residuals;
pub(crate) mod run_up;
pub mod schema;
pub(crate) mod stress;
pub mod style;
pub(crate) mod synthesis;
pub(crate) mod table_csv;
mod tell;
pub mod text;
pub(crate) mod tune;
pub mod versus;

pub use tell::Tell;
