//! All sentences that the command and its reports can show, in one place, so that they can be read as a list.

#[cfg(feature = "command")]
mod command;
#[cfg(feature = "command")]
mod draw;
mod machine;
mod report;
#[cfg(feature = "command")]
mod sweep;
#[cfg(feature = "command")]
mod synthesize;

#[cfg(feature = "command")]
pub(crate) use command::*;
#[cfg(feature = "command")]
pub(crate) use draw::*;
pub(crate) use machine::*;
pub(crate) use report::*;
#[cfg(feature = "command")]
pub(crate) use sweep::*;
#[cfg(feature = "command")]
pub(crate) use synthesize::*;
