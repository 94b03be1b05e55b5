//! External parties: other programs that solve a case or show it, and the machine that everything runs on.

mod answer;
mod machine;
mod peer;
mod process;
mod viewer;

pub use machine::{machine, processor_time};
pub use peer::{Command, Exports};
pub use viewer::{converted, opened};
