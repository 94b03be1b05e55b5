//! `linkproof export`.

use std::path::{Path, PathBuf};

use super::load::load;
use super::outputs::{Outputs, Results, results};
use super::{number, output};
use crate::report::{case_json, table_csv};
use analytic::AssurSolver;
use analytic::range::explained;
use design::export::{cam, first_state, mjcf};
use linkage::error::Result;
use prover::engines::usual_step;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/export.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    outputs: Outputs<Exports>,
    /// Initial time step of the file in seconds [default: the scenario's time step, else a quarter of a degree of the
    /// fastest driving link]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = number::positive)]
    dt: Option<f64>,
    /// Start a group in a different assembly mode from that of the file. A number as MODE means the configuration with
    /// this number in `inspect --modes`. May be given for several groups
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
}

results! { Exports {
    Mjcf = "a model for MuJoCo",
    Json = "the case in SI units, with its state at t = 0",
    Csv = "the profiles of cams",
    Dxf = "the profiles of cams in mm",
} }

pub(super) fn export(args: &Args) -> Result<()> {
    let scenario = load(&args.file, &args.mode)?;
    let (case, dt) =
        (&scenario.case, args.dt.or(scenario.engine.step.get()).unwrap_or_else(|| usual_step(&scenario.case)));
    let text = |form| match form {
        Exports::Json => first_state(case, &AssurSolver).map(|start| case_json::text(&scenario.name, case, &start)),
        Exports::Csv => table_csv::cams(case),
        Exports::Dxf => cam::drawing(case),
        Exports::Mjcf => mjcf::mjcf(case, &AssurSolver, &scenario.name, dt),
    };
    let all: Vec<(Exports, &Path)> = args.outputs.each().collect();
    let all = if all.is_empty() { vec![(Exports::Mjcf, Path::new(""))] } else { all };
    for (form, to) in all {
        let text = text(form).map_err(|error| explained(case, error))?;
        match to == Path::new("") {
            true => output::make_here(&text, &format!("{}{}", scenario.name, form.form().sign()))?,
            false => output::write(&text, to)?,
        }
    }
    Ok(())
}
