//! The contract of the command line: exit codes, streams, JSON, CSV and messages, on the built command.

mod accept;
mod bench;
mod clearance;
mod drive;
mod encodings;
mod engines;
mod export;
mod files;
mod html;
mod messages;
mod modes;
mod mutate;
mod new;
mod numbers;
mod outputs;
mod plan;
mod range;
mod recordings;
mod reports;
mod run;
mod solve;
mod standard_input;
mod starts;
mod stress;
mod synthesize;
mod terminal;
pub mod tools;
