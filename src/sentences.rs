//! All sentences that the command and its reports can show, in one place, so that they can be read as a list.

#[cfg(feature = "command")]
mod command;
mod machine;
#[cfg(feature = "command")]
mod precision;
mod report;
#[cfg(feature = "command")]
mod sweep;

#[cfg(feature = "command")]
pub(crate) use command::*;
pub(crate) use machine::*;
#[cfg(feature = "command")]
pub(crate) use precision::*;
pub(crate) use report::*;
#[cfg(feature = "command")]
pub(crate) use sweep::*;
