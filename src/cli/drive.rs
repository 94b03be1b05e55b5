//! `linkproof drive`.

use crate::sentences;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use super::load::load;
use super::outputs::{Made, Outputs, results};
use super::{number, output};
use crate::report::drive::{self as report, Found};
use crate::report::drive_graphs::{self, Curves};
use crate::report::{motor_choice, table_csv};
use analytic::AssurSolver;
use analytic::range::explained;
use analytic::reduced::{ACCURACY, ReducedModel, RunUp, means as reduced};
use analytic::steady::Averaged;
use design::drive::catalogue;
use design::drive::flywheel::Flywheel;
use design::drive::motor::{MotorChoice, MotorLimit};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use scenario::Scenario;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/drive.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Start a group in a different assembly mode from that of the file, as in `linkproof run`
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
    /// Find the flywheel that the crank's shaft needs for this coefficient of non-uniformity
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, value_parser = number::finite)]
    non_uniformity: Option<f64>,
    /// Show the reduced quantities and the steady motion by crank angle
    #[arg(long)]
    table: bool,
    /// Crank angle between two rows of the table, in degrees
    #[arg(long, value_name = "DEG", default_value = "10", allow_hyphen_values = true, value_parser = number::positive)]
    step_deg: f64,
    /// Write the run-up with all requested channels as CSV to FILE; the CSV replaces the text on standard output if
    /// FILE is `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    run_up: Option<PathBuf>,
    /// Duration of the run-up in seconds
    #[arg(long, value_name = "S", default_value = "0.5", allow_hyphen_values = true, requires = "run_up", value_parser = number::positive)]
    seconds: f64,
    /// Number of equal time intervals of the run-up; the CSV has N + 1 rows of values
    #[arg(long, value_name = "N", default_value = "500", requires = "run_up", allow_hyphen_values = true, value_parser = number::count)]
    points: usize,
    /// Speed of the crank at the start of the run-up, in turns per minute, counter-clockwise positive
    #[arg(long, value_name = "RPM", default_value = "0", allow_hyphen_values = true, requires = "run_up", value_parser = number::finite)]
    from_rpm: f64,
    #[command(flatten)]
    outputs: Outputs<DriveResults>,
    #[command(flatten)]
    choice: Choosing,
}

results! { DriveResults {
    Json = "everything",
    Svg = "reduced quantities and steady motion over the crank angle",
} }

/// A motor for the mechanism.
#[derive(Debug, clap::Args)]
struct Choosing {
    /// Choose a motor from this catalogue by peak resistance and scenario speed; compute nothing else
    #[arg(long, value_name = "FILE", conflicts_with_all = ["non_uniformity", "run_up", "table"])]
    catalogue: Option<PathBuf>,
    /// Efficiency between motor and crank, for the choice [default: the efficiency of the scenario's motor, else 1]
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, requires = "catalogue", value_parser = number::efficiency)]
    efficiency: Option<f64>,
    /// Choose only among motors of this synchronous speed, in turns per minute
    #[arg(long, value_name = "RPM", requires = "catalogue", allow_hyphen_values = true, value_parser = number::positive)]
    synchronous_rpm: Option<f64>,
}

/// Number of equal intervals of a graph over one period. If the period is one revolution, an interval is half a degree.
const PARTS: u32 = 720;

/// Largest number of rows of a table or a run-up.
const MOST_ROWS: f64 = 1e6;

pub(super) fn drive(args: &Args) -> Result<()> {
    check(args)?;
    let scenario = load(&args.file, &args.mode)?.nominal();
    driven(args, &scenario).map_err(|error| explained(&scenario.case, error))
}

fn driven(args: &Args, scenario: &Scenario) -> Result<()> {
    if let Some(file) = &args.choice.catalogue {
        return choose(args, file, scenario);
    }
    let model = ReducedModel::of(&scenario.case)?;
    let is_said = args.run_up.as_deref().is_some_and(output::is_standard);
    if let Some(to) = &args.run_up {
        let motion = run_up(args, &model)?;
        output::stream(to, |out| table_csv::run_up(&motion, out))?;
        if is_said && args.outputs.is_empty() {
            return Ok(());
        }
        if !is_said && !args.outputs.take_standard() {
            let speeds = motion.motion.iter().map(|instant| scenario.case.crank().sense() * instant.omega);
            let ends = speeds.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], speed| {
                [low.smaller(speed), high.larger(speed)]
            });
            let motor = scenario.case.crank().motor();
            let limits = motor.map_or_else(Vec::new, |motor| MotorLimit::of(motor, ends, true));
            output::print(&report::run_up(&motion, &limits, output::columns()))?;
        }
    }
    let found = find(scenario, &model, args.step_deg, args.non_uniformity)?;
    let result = |form| -> Result<Made> {
        Ok(match form {
            DriveResults::Svg => drive_graphs::draw(scenario, &found, &curves(scenario, &model, &found)?).into(),
            DriveResults::Json => report::json(scenario, &found).into(),
        })
    };
    match is_said {
        true => args.outputs.write(result),
        false => args.outputs.deliver(result, |_| report::text(scenario, &found, args.table, output::columns())),
    }
}

fn check(args: &Args) -> Result<()> {
    let wrong = |message: String, help: &str| Err(Error::new(ErrorKind::Input, message).help(help));
    if !(360.0 / args.step_deg <= MOST_ROWS) {
        return wrong(sentences::step_deg_is(&args.step_deg), sentences::GIVE_A_NUMBER_OF_DEGREES);
    }
    if args.points as f64 > MOST_ROWS {
        return wrong(sentences::points_is(&args.points), sentences::GIVE_A_NUMBER_FROM_TO);
    }
    let run_up = args.run_up.as_deref().map(|to| ("--run-up", to));
    output::apart(&args.outputs.named().into_iter().chain(run_up).collect::<Vec<_>>())
}

/// The reduced quantities every `step_deg` of the crank, the steady motion, and the flywheel for a required
/// non-uniformity.
pub(super) fn find(
    scenario: &Scenario,
    model: &ReducedModel,
    step_deg: f64,
    non_uniformity: Option<f64>,
) -> Result<Found> {
    let case = &scenario.case;
    let means = reduced::means_over_turn(case, &AssurSolver)?;
    let sense = case.crank().sense();
    let period = model.kinks().period.unwrap_or(TAU).to_degrees();
    let count = (period / step_deg + 1e-9).floor() as usize;
    let cranks: Vec<f64> =
        (0..=count).map(|k| case.crank().start + sense * (step_deg * k as f64).to_radians()).collect();
    let resistance = sense * means.resistance;
    let averaged = case.crank().motor().and_then(|motor| Averaged::over_turn(model, motor, &means));
    let steady = match case.crank().motor() {
        None => None,
        Some(motor) => {
            let Some(speed) = motor.steady_speed(resistance) else { return Err(reduced::no_steady_speed(resistance)) };
            Some(([sense * speed, sense * speed * motor.ratio], model.regime(&cranks, ACCURACY)?))
        }
    };
    let limits = match (case.crank().motor(), &steady) {
        (Some(motor), Some((_, regime))) => MotorLimit::of(motor, regime.ends(), false),
        (None, _) | (_, None) => Vec::new(),
    };
    let flywheel = match non_uniformity {
        Some(wanted) => Some((wanted, Flywheel::of(model, wanted, ACCURACY)?)),
        None => None,
    };
    let (extremes, rows) = (model.extremes()?, model.rows(&cranks)?);
    Ok(Found { means, extremes, added: model.added_inertia(), rows, steady, averaged, limits, flywheel })
}

/// Data of the graphs: rows at equal intervals, and at the kinks of the reduced quantities.
pub(super) fn curves(scenario: &Scenario, model: &ReducedModel, found: &Found) -> Result<Curves> {
    let (start, sense) = (scenario.case.crank().start, scenario.case.crank().sense());
    let period = model.kinks().period.unwrap_or(TAU);
    let even: Vec<f64> = (0..=PARTS).map(|k| start + sense * period * (f64::from(k) / f64::from(PARTS))).collect();
    let kinks = model.kinks().cranks.iter().map(|kink| start + sense * (sense * (kink - start)).rem_euclid(period));
    let mut cranks: Vec<f64> = even.iter().copied().chain(kinks).collect();
    cranks.sort_by(|a, b| (sense * a).total_cmp(&(sense * b)));
    let (rows, slope) = (model.rows(&cranks)?, model.slope_extremes()?);
    let steady = found.steady.as_ref();
    let steady = steady.map(|(_, regime)| model.regime_at(regime, &even, ACCURACY)).transpose()?;
    Ok(Curves { period, rows, slope, steady })
}

fn run_up(args: &Args, model: &ReducedModel) -> Result<RunUp> {
    let times: Vec<f64> = (0..=args.points).map(|k| args.seconds * (k as f64 / args.points as f64)).collect();
    RunUp::of(model, args.from_rpm * TAU / 60.0, &times, ACCURACY)
}

/// Chooses a motor and reports the choice.
fn choose(args: &Args, file: &Path, scenario: &Scenario) -> Result<()> {
    let Choosing { efficiency, synchronous_rpm, .. } = args.choice;
    let mut motors = catalogue::load(file)?;
    if let Some(rpm) = synchronous_rpm {
        motors.retain(|motor| (motor.synchronous_speed * 60.0 / TAU - rpm).abs() < 0.5);
        if motors.is_empty() {
            let message = sentences::the_catalogue_has_no_motor(&rpm);
            return output::refused("--synchronous-rpm", message, sentences::GIVE_OR_OR_LEAVE_IT_OUT);
        }
    }
    let own = scenario.case.crank().motor().map_or(1.0, |motor| motor.efficiency);
    let choice = MotorChoice::of(&scenario.case, &motors, efficiency.unwrap_or(own))?;
    let result = |form| match form {
        DriveResults::Svg => output::refused("--output", sentences::NO_GRAPHS_OF_A_CHOICE, sentences::WRITE_JSON),
        DriveResults::Json => Ok(motor_choice::json(scenario, &choice)),
    };
    args.outputs.deliver(result, |_| motor_choice::text(scenario, &choice, output::columns()))
}
