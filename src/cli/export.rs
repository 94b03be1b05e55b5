//! `linkproof export`.

use std::path::{Path, PathBuf};

use super::load::load;
use super::output;
use crate::engines::usual_step;
use analytic::AssurSolver;
use analytic::range::explained;
use linkage::error::Result;
use workshop::export::mjcf;

const EXAMPLES: &str = "\
Examples:
  linkproof export scenarios/crank_rocker.toml --mjcf              write crank_rocker.xml
  linkproof export scenarios/compressor.toml --mjcf compressor.mjcf --dt 1e-4
  linkproof export scenarios/ov7_base.toml --mjcf - | head
  python -m mujoco.viewer --mjcf=crank_rocker.xml                  look at it; load the keyframe \"start\" to set it going

docs/mjcf.md tells what is in the file and how exactly MuJoCo simulates it.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Write MJCF to a file, to standard output with `-`, to NAME.xml in this directory without a value; NAME is the
    /// scenario's
    #[arg(long, value_name = "PATH", required = true, num_args = 0..=1, value_parser = output::target)]
    mjcf: Option<Option<PathBuf>>,
    /// Time step in seconds that the file starts with [default: the scenario's, else a quarter of a degree of the
    /// fastest driving link]
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    dt: Option<f64>,
    /// Start a group in another assembly mode than the file states, or in the configuration with that number in
    /// `inspect --modes`. May be given for several groups
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
}

pub(super) fn export(args: &Args) -> Result<()> {
    let scenario = load(&args.file, &args.mode)?;
    let (case, dt) = (&scenario.case, args.dt.or(scenario.dt).unwrap_or_else(|| usual_step(&scenario.case)));
    let text = mjcf::mjcf(case, &AssurSolver, &scenario.name, dt).map_err(|error| explained(case, error))?;
    match args.mjcf.as_ref().and_then(Option::as_ref) {
        Some(to) => output::write(&text, to),
        None => {
            // The user did not choose this name, so it is printed.
            let name = format!("{}.xml", scenario.name);
            output::write(&text, Path::new(&name))?;
            output::print(&format!("{name}\n"))
        }
    }
}
