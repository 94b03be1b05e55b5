//! `linkproof export`.

use std::path::{Path, PathBuf};

use super::load::load;
use super::{number, output};
use crate::report::case_json;
use analytic::AssurSolver;
use analytic::range::explained;
use design::export::{first_state, mjcf};
use linkage::error::Result;
use prover::engines::usual_step;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/export.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Write MJCF to a file, to standard output with `-`, to NAME.xml in this directory without a value; NAME is the
    /// scenario's
    #[arg(long, value_name = "PATH", required_unless_present = "json", num_args = 0..=1, value_parser = output::target)]
    mjcf: Option<Option<PathBuf>>,
    /// Write the case as JSON, in SI units and with its state at t = 0, to a file, to standard output with `-`, to
    /// NAME.json in this directory without a value
    #[arg(long, value_name = "PATH", num_args = 0..=1, value_parser = output::target)]
    json: Option<Option<PathBuf>>,
    /// Time step in seconds that the file starts with [default: the scenario's, else a quarter of a degree of the
    /// fastest driving link]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = number::positive)]
    dt: Option<f64>,
    /// Start a group in another assembly mode than the file states, or in the configuration with that number in
    /// `inspect --modes`. May be given for several groups
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
}

pub(super) fn export(args: &Args) -> Result<()> {
    output::apart(&[("--mjcf", &args.mjcf.clone().flatten()), ("--json", &args.json.clone().flatten())])?;
    let scenario = load(&args.file, &args.mode)?;
    let (case, dt) =
        (&scenario.case, args.dt.or(scenario.engine.step.get()).unwrap_or_else(|| usual_step(&scenario.case)));
    if let Some(to) = &args.mjcf {
        let text = mjcf::mjcf(case, &AssurSolver, &scenario.name, dt).map_err(|error| explained(case, error))?;
        put(&text, to.as_deref(), &format!("{}.xml", scenario.name))?;
    }
    if let Some(to) = &args.json {
        let start = first_state(case, &AssurSolver).map_err(|error| explained(case, error))?;
        put(&case_json::text(&scenario.name, case, &start), to.as_deref(), &format!("{}.json", scenario.name))?;
    }
    Ok(())
}

fn put(text: &str, to: Option<&Path>, name: &str) -> Result<()> {
    match to {
        Some(to) => output::write(text, to),
        None => {
            // The user did not choose this name, so it is printed.
            output::make(text, Path::new(name))?;
            output::print(&format!("{name}\n"))
        }
    }
}
