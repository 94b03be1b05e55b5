//! All integration tests in one binary, so that their common parts are compiled and linked once.
//!
//! `cargo test --release --test suite` runs all tests; `... --test suite figures::` runs the tests of one module.

#![expect(
    clippy::wildcard_enum_match_arm,
    reason = "a test names what it looks at; whatever else there is fails it or is passed over"
)]

mod architecture;
mod authors;
mod bad_scenarios;
mod batch;
mod bench;
mod bounds;
mod change_points;
mod clearance;
mod cli;
mod common;
mod compare;
mod degenerate;
mod diagnosis;
mod drawings;
mod dynamics;
mod engine;
mod exact_zeros;
mod exercise;
mod export;
mod faults;
mod figures;
mod formulas;
mod golden;
mod graphs;
mod higher_groups;
mod import;
mod invariants;
mod key_tables;
mod laws;
mod library_texts;
#[cfg(feature = "live")]
mod live;
mod loads;
mod oracle_tables;
mod outside;
mod own_forces;
mod peaks;
mod plans;
mod prismatic;
mod random_proofs;
mod range;
mod rapier;
mod record;
mod robustness;
mod scenario_docs;
mod scenes;
mod schema;
mod security;
mod sensitivity;
mod setting_off;
mod settling;
#[cfg(feature = "simbody")]
mod simbody;
mod singular;
mod slider_limits;
mod sliders_closed_form;
mod specimens;
mod start;
mod stories;
mod stress;
mod sweep;
mod synthesize;
mod testing;
mod timed_numbers;
mod triad_methods;
mod trunk;
mod tune;
mod tutorial;
mod units;
mod variants60;
#[cfg(feature = "watch")]
mod watch;
mod work_allowed;
mod wrong_tables;
