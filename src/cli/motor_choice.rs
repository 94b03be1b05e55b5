//! `linkproof drive --catalogue`: a motor for the mechanism.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use super::{number, output};
use crate::report::motor_choice as report;
use design::catalogue;
use design::motor::Choice;
use linkage::error::{Error, ErrorKind, Result};
use scenario::Scenario;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Only choose a motor from this catalogue, by the peak of the resistance and the scenario's speed
    #[arg(long, value_name = "FILE", conflicts_with_all = ["non_uniformity", "run_up", "svg", "table"])]
    pub(super) catalogue: Option<PathBuf>,
    /// Efficiency between motor and crank, for the choice [default: that of the scenario's motor, else 1]
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, requires = "catalogue", value_parser = number::efficiency)]
    efficiency: Option<f64>,
    /// Choose only among motors of this synchronous speed, in turns per minute
    #[arg(long, value_name = "RPM", requires = "catalogue", allow_hyphen_values = true, value_parser = number::positive)]
    synchronous_rpm: Option<f64>,
}

/// Chooses a motor and reports it.
pub(super) fn choose(args: &Args, file: &Path, scenario: &Scenario, json_to: &Option<PathBuf>) -> Result<()> {
    let mut motors = catalogue::load(file)?;
    if let Some(rpm) = args.synchronous_rpm {
        motors.retain(|motor| (motor.synchronous_speed * 60.0 / TAU - rpm).abs() < 0.5);
        if motors.is_empty() {
            let message = format!("the catalogue has no motor of {rpm} rpm");
            return Err(Error::new(ErrorKind::Input, message)
                .key("--synchronous-rpm")
                .help("give 3000 or 1500, or leave it out"));
        }
    }
    let own = scenario.case.crank().motor().map_or(1.0, |motor| motor.efficiency);
    let choice = Choice::of(&scenario.case, &motors, args.efficiency.unwrap_or(own))?;
    output::either(json_to, || report::json(scenario, &choice), || report::text(scenario, &choice))
}
