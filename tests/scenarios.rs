//! One test a textbook scenario, as users write it for a folder of theirs.

use std::process::ExitCode;

fn main() -> ExitCode {
    linkproof::testing::main("scenarios/formulas")
}
