//! `linkproof export`.

use std::path::{Path, PathBuf};

use super::grid::GridArgs;
use super::load::StartArgs;
use super::outputs::{Outputs, Results, results};
use super::{number, output};
use crate::report::{case_json, table_csv};
use crate::sentences;
use analytic::AssurSolver;
use analytic::range::explained;
use design::export::{ModelFormat, cam, first_state, urdf};
use design::relations::Mimics;
use design::rigid::RigidModel;
use linkage::error::{Error, ErrorKind, Result};
use prover::engines::usual_step;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/export.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    outputs: Outputs<Exports>,
    /// Time step stated in the file, in seconds [default: the scenario's time step, else the fastest driving link's
    /// time for 0.25 deg; in a motion under forces at most a ten-thousandth of the duration]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = number::positive)]
    dt: Option<f64>,
    #[command(flatten)]
    start: StartArgs,
    /// Leave all loads out of the file. A prescribed motion does not depend on them
    #[arg(long)]
    no_loads: bool,
    /// URDF: each joint of the tree follows the driven joint by a polynomial of degree N, with a proven bound on the
    /// error. A relation of degree 1 becomes a `<mimic>`
    #[arg(long, value_name = "N", value_parser = number::degree)]
    mimic: Option<usize>,
}

results! { Exports {
    Mjcf = "a model for MuJoCo",
    Sdf = "a world for Gazebo (SDFormat)",
    Urdf = "the spanning tree as a robot for ROS",
    Usd = "a stage with UsdPhysics",
    Json = "the case in SI units, with its state at t = 0",
    Csv = "the profiles of cams",
    Dxf = "the profiles of cams in mm",
} }

pub(super) fn export(args: &Args) -> Result<()> {
    let scenario = args.start.load(&args.file, &GridArgs::default())?;
    let unloaded = args.no_loads.then(|| scenario.case.with(|parts| parts.loads.clear())).transpose()?;
    let case = unloaded.as_ref().unwrap_or(&scenario.case);
    let dt = args.dt.or(scenario.engine.step.get()).unwrap_or_else(|| usual_step(case));
    let has_lost_loads = case.loads.len() < scenario.case.loads.len();
    let noted = |format: ModelFormat, text: String| if has_lost_loads { format.noting_no_loads(&text) } else { text };
    let model = |format: ModelFormat| Ok(noted(format, format.model(case, &AssurSolver, &scenario.name, dt)?));
    let text = |form| match form {
        Exports::Json => first_state(case, &AssurSolver).map(|start| case_json::text(&scenario.name, case, &start)),
        Exports::Csv => table_csv::cams(case),
        Exports::Dxf => cam::drawing(case),
        Exports::Mjcf => model(ModelFormat::Mjcf),
        Exports::Sdf => model(ModelFormat::Sdf),
        Exports::Urdf => match args.mimic {
            None => model(ModelFormat::Urdf),
            Some(degree) => {
                let mimics = Mimics::new(&RigidModel::new(case, &first_state(case, &AssurSolver)?, ""), degree)?;
                let model = urdf::urdf(case, &AssurSolver, &scenario.name, Some(&mimics))?;
                Ok(noted(ModelFormat::Urdf, model))
            }
        },
        Exports::Usd => model(ModelFormat::Usd),
    };
    let all: Vec<(Exports, &Path)> = args.outputs.each().collect();
    if args.mimic.is_some() && all.iter().all(|(form, _)| *form != Exports::Urdf) {
        return Err(Error::new(ErrorKind::Input, sentences::MIMIC_IS_A_MATTER_OF_URDF).help(sentences::WRITE_A_URDF));
    }
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
