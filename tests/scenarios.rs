//! One test per textbook scenario, set up like a user's test of a scenario folder.

use std::process::ExitCode;

fn main() -> ExitCode {
    linkproof::testing::main("scenarios/formulas")
}
