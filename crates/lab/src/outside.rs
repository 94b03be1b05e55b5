//! External parties: programs other than linkproof that solve or show a case.
//! This module also describes the machine on which all programs run.

mod answer;
mod machine;
mod peer;
mod process;
mod viewer;

pub use machine::{machine, processor_time};
pub use peer::{Command, Exports};
pub use viewer::{converted, opened};
