//! The contract of the command line: exit codes, streams, JSON, CSV and messages, on the built command.

#[path = "cli/drive.rs"]
mod drive;
#[path = "cli/engines.rs"]
mod engines;
#[path = "cli/export.rs"]
mod export;
#[path = "cli/messages.rs"]
mod messages;
#[path = "cli/modes.rs"]
mod modes;
#[path = "cli/plan.rs"]
mod plan;
#[path = "cli/range.rs"]
mod range;
#[path = "cli/run.rs"]
mod run;
#[path = "cli/solve.rs"]
mod solve;
#[path = "cli/synthesize.rs"]
mod synthesize;
#[path = "cli/tools.rs"]
mod tools;
