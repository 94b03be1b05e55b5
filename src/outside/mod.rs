//! What is not ours: other programs that solve a case, and the machine that everything runs on.

mod answer;
mod machine;
mod peer;
mod process;

pub(crate) use machine::{machine, processor_time};
pub(crate) use peer::{Command, Exports};
