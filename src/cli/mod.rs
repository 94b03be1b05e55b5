//! The command line. Only this part uses standard output, paths, the clock, the environment and exit codes.

mod advice;
mod bearings;
mod bench;
mod check;
mod clearance;
mod diagram;
mod drive;
mod engine_args;
mod engine_section;
mod exit_code;
mod export;
mod grid;
mod inspect;
mod list;
mod load;
mod motor_choice;
mod mutate;
mod output;
mod panics;
mod plan;
mod progress;
mod run;
mod schema;
mod solve;
mod stress;
mod synthesize;
mod tune;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

const EXAMPLES: &str = "\
Examples:
  linkproof list                                        what scenarios there are
  linkproof run scenarios/crank_rocker.toml             prove one, record it to recordings/
  linkproof run scenarios/*.toml --no-record --json -   prove all, as JSON
  linkproof solve scenarios/ov7_base.toml --with assur --crank-deg 0:-360:-30
  linkproof tune scenarios/crank_rocker.toml --within 1e-3 --engine rapier --channel positions   the settings it takes
  linkproof mutate scenarios/crank_rocker.toml --no-sizes --kind load   does the proof see faults?
  linkproof inspect scenarios/ov7_base.toml             links, joints, Assur groups

Exit codes: 0 all agree, 1 something disagrees, 2 bad input or usage, 3 nothing proven either way.";

/// Builds planar mechanisms twice, analytically and as a Rapier multibody, and proves that the two agree.
#[derive(Debug, Parser)]
#[command(name = "linkproof", version, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve scenarios both ways, compare, check, record, and say whether the two sides agree
    Run(run::Args),
    /// Judge formulas over the whole motion, by value and by derivative, against both analytic sides
    Check(check::Args),
    /// Solve a scenario with one solver and write the solution as CSV, one row per instant
    Solve(solve::Args),
    /// Find the cheapest settings of an engine that meet a wanted error, by measurement
    Tune(tune::Args),
    /// Turn one dial at a time until numbers are lost: where every solver and engine holds to, with maps of stability
    Stress(stress::Args),
    /// Plant faults in one party of a proof, or in what all share, and say which are found
    Mutate(mutate::Args),
    /// Measure run time against error of every solver, engine and setting, and of other programs: diagrams and numbers
    Bench(bench::Args),
    /// Show the structure of a mechanism: links, joints, mobility, driving link and Assur groups; its configurations;
    /// its range of motion
    Inspect(inspect::Args),
    /// Largest reactions over the range of the grid, and the smallest journals that carry them
    Bearings(bearings::Args),
    /// Smallest distances of links from each other and from a housing over the whole turn, first collision, swept areas
    Clearance(clearance::Args),
    /// The mechanism reduced to its crank, its steady motion under its motor, flywheel and run-up; choice of a motor
    Drive(drive::Args),
    /// Velocity and acceleration plans at one crank angle, as a table, as JSON or drawn to scale
    Plan(plan::Args),
    /// Velocity and acceleration from a displacement by the chord method, and back, with their errors
    Diagram(diagram::Args),
    /// Find dimensions for a wanted motion: crank-rocker and slider-crank in closed form, any linkage by search
    Synthesize(synthesize::Args),
    /// Write a mechanism for another program: MuJoCo's MJCF, or JSON
    Export(export::Args),
    /// List scenarios, or the available channels and solvers
    List(list::Args),
    /// Write the format of scenario files as a JSON Schema, by which editors complete and check keys
    Schema(schema::Args),
}

/// Runs the command line and returns its exit code.
#[must_use]
pub fn main() -> ExitCode {
    panics::silence(crate::engines::panic_is_caught);
    let cli = Cli::parse();
    let code = match cli.command {
        Command::Run(args) => run::run(&args),
        Command::Check(args) => check::check(&args),
        Command::Solve(args) => output::exit(solve::solve(&args)),
        Command::Tune(args) => output::exit(tune::run(&args)),
        Command::Stress(args) => stress::run(&args),
        Command::Mutate(args) => mutate::run(&args),
        Command::Bench(args) => output::exit(bench::run(&args)),
        Command::Inspect(args) => output::exit(inspect::inspect(&args)),
        Command::Bearings(args) => output::exit(bearings::bearings(&args)),
        Command::Clearance(args) => clearance::clearance(&args),
        Command::Drive(args) => output::exit(drive::drive(&args)),
        Command::Plan(args) => output::exit(plan::plan(&args)),
        Command::Diagram(args) => output::exit(diagram::diagram(&args)),
        Command::Synthesize(args) => output::exit(synthesize::synthesize(&args)),
        Command::Export(args) => output::exit(export::export(&args)),
        Command::List(args) => output::exit(list::list(&args)),
        Command::Schema(args) => output::exit(schema::schema(&args)),
    };
    ExitCode::from(code)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        super::Cli::command().debug_assert();
    }
}
