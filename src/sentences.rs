//! Every sentence that the command and its reports can show, in one place, to be read as a list.

mod command;
mod report;

pub(crate) use command::*;
pub(crate) use report::*;
