//! `linkproof drive`.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::load::load;
use super::motor_choice;
use super::output;
use super::{drive_graphs, drive_run_up};
use crate::report::table;
use crate::scenario::Scenario;
use analytic::AssurSolver;
use analytic::range::explained;
use analytic::reduced::means::{self as reduced, Means};
use analytic::reduced::{ACCURACY, Model, RunUp};
use analytic::steady::course::{Extremes, Row};
use analytic::steady::regime::At;
use analytic::steady::{Averaged, Regime};
use linkage::error::{Error, ErrorKind, Result};
use workshop::flywheel::Flywheel;

const EXAMPLES: &str = "\
Examples:
  linkproof drive scenarios/crank_rocker.toml
  linkproof drive scenarios/crank_rocker.toml --non-uniformity 0.02
  linkproof drive scenarios/crank_rocker.toml --step-deg 5 --table
  linkproof drive scenarios/crank_rocker.toml --svg graphs.svg
  linkproof drive scenarios/crank_rocker.toml --step-deg 1 --json drive.json
  linkproof drive scenarios/crank_rocker.toml --catalogue catalogues/motors.toml --efficiency 0.92   choose a motor
  linkproof drive scenarios/crank_rocker.toml --run-up run_up.csv --seconds 0.5 --points 500

The mechanism is reduced to its crank: moment of inertia I* = sum of m (v / omega)^2 + J (omega_k / omega)^2, moment of resistance from the
powers of gravity and loads. With a `[motor]` section: the steady speed and time constant of the averaged model, the steady motion of the true one from
omega^2 / 2 dI*/dphi + I* domega/dt = M, its coefficient of non-uniformity (fastest - slowest) / mean over time, and the flywheel on the
crank's shaft for a wanted one. A run-up begins at the start of the scenario.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Start a group in another assembly mode than the file states, as in `linkproof run`
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
    /// Find the flywheel on the crank's shaft for this coefficient of non-uniformity
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true)]
    non_uniformity: Option<f64>,
    /// Show the reduced quantities and the steady motion by crank angle
    #[arg(long)]
    table: bool,
    /// Crank angle between two rows of the table, in degrees
    #[arg(long, value_name = "DEG", default_value = "10", allow_hyphen_values = true)]
    step_deg: f64,
    /// Write the run-up with all wanted channels as CSV to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    run_up: Option<PathBuf>,
    /// Duration of the run-up
    #[arg(long, value_name = "S", default_value = "0.5", allow_hyphen_values = true, requires = "run_up")]
    seconds: f64,
    /// Number of equal time intervals of the run-up; a row is written at both ends of each
    #[arg(long, value_name = "N", default_value = "500", requires = "run_up")]
    points: usize,
    /// Speed of the crank at the start of the run-up, in turns per minute, counter-clockwise positive
    #[arg(long, value_name = "RPM", default_value = "0", allow_hyphen_values = true, requires = "run_up")]
    from_rpm: f64,
    /// Draw the reduced quantities and the steady motion over the crank angle to a file, or to standard output instead
    /// of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    svg: Option<PathBuf>,
    /// Write everything as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
    #[command(flatten)]
    choice: motor_choice::Args,
}

/// Largest number of rows of a table or a run-up.
const MOST_ROWS: f64 = 1e6;

/// What is known about a drive.
struct Found {
    means: Means,
    extremes: [Extremes; 2],
    /// Moment of inertia that motor and reducer add to the crank (kg m^2).
    added: f64,
    rows: Vec<Row>,
    /// Speeds of crank and motor by the averaged model, and the steady motion; `None` without a motor.
    steady: Option<([f64; 2], Regime)>,
    /// The averaged model, if it has a closed form.
    averaged: Option<Averaged>,
    flywheel: Option<Flywheel>,
}

pub(super) fn drive(args: &Args) -> Result<()> {
    check(args)?;
    let scenario = load(&args.file, &args.mode)?.nominal();
    driven(args, &scenario).map_err(|error| explained(&scenario.case, error))
}

fn driven(args: &Args, scenario: &Scenario) -> Result<()> {
    if let Some(file) = &args.choice.catalogue {
        return motor_choice::choose(&args.choice, file, scenario, args.json.as_deref());
    }
    let model = Model::of(&scenario.case)?;
    let targets = [&args.run_up, &args.json, &args.svg];
    let told_there = targets.iter().any(|to| to.as_deref() == Some(Path::new("-")));
    if let Some(to) = &args.run_up {
        let run_up = run_up(args, &model)?;
        output::write(&drive_run_up::csv(&run_up)?, to)?;
        if told_there && targets[1..].iter().all(|to| to.is_none()) {
            return Ok(());
        }
        if !told_there {
            output::print(&drive_run_up::told(&run_up))?;
        }
    }
    let found = find(args, scenario, &model)?;
    if let Some(to) = &args.svg {
        let steady = found.steady.as_ref().map(|(_, regime)| regime);
        output::write(&drive_graphs::draw(scenario, &model, &found.means, &found.extremes, steady)?, to)?;
    }
    match &args.json {
        Some(to) => output::write(&format!("{}\n", as_json(args, scenario, &found)), to),
        None if told_there => Ok(()),
        None => output::print(&as_text(args, scenario, &found)),
    }
}

fn check(args: &Args) -> Result<()> {
    let wrong = |message: String, help: &str| Err(Error::new(ErrorKind::Input, message).help(help));
    if !(args.step_deg > 0.0 && 360.0 / args.step_deg <= MOST_ROWS) {
        return wrong(format!("--step-deg is {}", args.step_deg), "give a number of degrees above zero, such as 10");
    }
    if !(args.seconds > 0.0 && args.seconds.is_finite()) {
        return wrong(format!("--seconds is {}", args.seconds), "give a number above zero, such as 0.5");
    }
    if !(args.points >= 1 && args.points as f64 <= MOST_ROWS) {
        return wrong(format!("--points is {}", args.points), "give a number from 1 to 1000000");
    }
    if !args.from_rpm.is_finite() {
        return wrong(format!("--from-rpm is {}", args.from_rpm), "give a finite number; 0 for a start from rest");
    }
    let targets = [("--run-up", &args.run_up), ("--svg", &args.svg), ("--json", &args.json)];
    for (k, (one, to)) in targets.iter().enumerate() {
        if let Some((other, _)) = targets[k + 1..].iter().find(|(_, other)| to.is_some() && to == other) {
            let message = format!("{one} and {other} name the same file");
            return wrong(message, "give two files, or leave one of the two out");
        }
    }
    Ok(())
}

fn find(args: &Args, scenario: &Scenario, model: &Model) -> Result<Found> {
    let case = &scenario.case;
    let means = reduced::means_over_turn(case, &AssurSolver)?;
    let sense = case.crank().sense();
    let period = model.kinks().period.unwrap_or(std::f64::consts::TAU).to_degrees();
    let count = (period / args.step_deg + 1e-9).floor() as usize;
    let cranks: Vec<f64> =
        (0..=count).map(|k| case.crank().start + sense * (args.step_deg * k as f64).to_radians()).collect();
    let resistance = sense * means.resistance;
    let inertia = means.inertia + model.added_inertia();
    let averaged = case.crank().motor().and_then(|motor| Averaged::of(motor, inertia, resistance));
    let steady = match case.crank().motor() {
        None => None,
        Some(motor) => {
            let Some(speed) = motor.steady_speed(resistance) else { return Err(reduced::no_steady_speed(resistance)) };
            Some(([sense * speed, sense * speed * motor.ratio], model.regime(&cranks, ACCURACY)?))
        }
    };
    let flywheel = args.non_uniformity.map(|wanted| Flywheel::of(model, wanted, ACCURACY)).transpose()?;
    let (extremes, rows) = (model.extremes()?, model.rows(&cranks)?);
    Ok(Found { means, extremes, added: model.added_inertia(), rows, steady, averaged, flywheel })
}

fn as_text(args: &Args, scenario: &Scenario, found: &Found) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "{}: {}\n", scenario.name, scenario.title);
    let names = [("reduced moment of inertia", "kg m^2"), ("reduced moment of resistance", "N m")];
    let means = [found.means.inertia, found.means.resistance * scenario.case.crank().sense()];
    for (((name, unit), mean), extremes) in names.into_iter().zip(means).zip(&found.extremes) {
        let end = |(crank, value): (f64, f64)| format!("{value:.9} {unit} at {:.4} deg", crank.to_degrees());
        let _ = writeln!(text, "{name}\n  mean      {mean:.9} {unit}");
        let _ = writeln!(text, "  least     {}\n  greatest  {}", end(extremes.least), end(extremes.greatest));
    }
    if found.added > 0.0 {
        let _ = writeln!(text, "motor and reducer on the crank\n  inertia   {:.9} kg m^2", found.added);
    }
    match &found.steady {
        None => text.push_str("no motor: add a `[motor]` section to learn the steady motion\n"),
        Some(([crank, motor], regime)) => {
            let _ = writeln!(text, "averaged model\n  crank     {crank:.6} rad/s\n  motor     {motor:.6} rad/s");
            match &found.averaged {
                Some(averaged) => {
                    let _ = writeln!(text, "  time constant {:.9} s", averaged.time_constant);
                }
                None => text.push_str("  time constant: none, the motor's law is not one straight line from rest on\n"),
            }
            let _ = writeln!(text, "steady motion\n{}", of_regime(regime));
        }
    }
    if let (Some(flywheel), Some(wanted)) = (&found.flywheel, args.non_uniformity) {
        let _ = writeln!(text, "flywheel for a non-uniformity of {wanted}\n  inertia   {:.9} kg m^2", flywheel.inertia);
        let _ = writeln!(text, "{}", of_regime(&flywheel.regime));
    }
    if args.table {
        let _ = writeln!(text, "\n{}", by_angle(found));
    }
    text
}

fn of_regime(regime: &Regime) -> String {
    let at = |at: &At| format!("{:.9} rad/s at {:.4} deg", at.omega, at.crank.to_degrees());
    let mut text = String::new();
    let _ = writeln!(text, "  mean      {:.10} rad/s, period {:.13} s", regime.mean_speed, regime.period);
    let _ = writeln!(text, "  at start  {:.10} rad/s", regime.start_speed);
    let _ = writeln!(text, "  slowest   {}\n  fastest   {}", at(&regime.slowest), at(&regime.fastest));
    let _ = write!(text, "  non-uniformity {:.6}", regime.non_uniformity());
    text
}

fn by_angle(found: &Found) -> String {
    let header = ["crank deg", "I* kg m^2", "dI*/dphi kg m^2", "resistance N m", "omega rad/s", "alpha rad/s^2"];
    let mut table = table(header, &[0, 1, 2, 3, 4, 5]);
    for (index, row) in found.rows.iter().enumerate() {
        let at = found.steady.as_ref().map(|(_, regime)| regime.samples[index]);
        let steady = |of: fn(At) -> f64| at.map_or("-".into(), |at| format!("{:.6}", of(at)));
        table.add_row([
            format!("{:.3}", row.crank.to_degrees()),
            format!("{:.9}", row.inertia),
            format!("{:.9}", row.slope),
            format!("{:.6}", row.resistance),
            steady(|at| at.omega),
            steady(|at| at.alpha),
        ]);
    }
    table.to_string()
}

fn as_json(args: &Args, scenario: &Scenario, found: &Found) -> String {
    let sense = scenario.case.crank().sense();
    let extremes = |extremes: &Extremes, mean: f64| {
        let end = |(crank, value): (f64, f64)| json!({"crank_rad": crank, "value": value});
        json!({"mean": mean, "least": end(extremes.least), "greatest": end(extremes.greatest)})
    };
    let at = |at: &At| json!({"crank_rad": at.crank, "omega_rad_s": at.omega, "alpha_rad_s2": at.alpha});
    let regime = |regime: &Regime| {
        json!({
            "period_s": regime.period, "turns": regime.turns, "mean_rad_s": regime.mean_speed,
            "at_start_rad_s": regime.start_speed, "slowest": at(&regime.slowest), "fastest": at(&regime.fastest),
            "non_uniformity": regime.non_uniformity(), "multiplier": regime.multiplier,
        })
    };
    let column = |of: fn(&Row) -> f64| found.rows.iter().map(of).collect::<Vec<f64>>();
    let mut by_angle = json!({
        "crank_rad": column(|row| row.crank), "inertia_kg_m2": column(|row| row.inertia),
        "inertia_slope_kg_m2": column(|row| row.slope), "resistance_N_m": column(|row| row.resistance),
    });
    if let Some((_, steady)) = &found.steady {
        by_angle["omega_rad_s"] = steady.samples.iter().map(|at| at.omega).collect();
        by_angle["alpha_rad_s2"] = steady.samples.iter().map(|at| at.alpha).collect();
    }
    let mut value = json!({
        "schema": 1, "scenario": scenario.name,
        "inertia_kg_m2": extremes(&found.extremes[0], found.means.inertia),
        "resistance_N_m": extremes(&found.extremes[1], sense * found.means.resistance),
        "motor_and_reducer_kg_m2": found.added,
        "averaged": found.steady.as_ref().map(|([crank, motor], _)| {
            let constant = found.averaged.map(|averaged| averaged.time_constant);
            json!({"crank_rad_s": crank, "motor_rad_s": motor, "time_constant_s": constant})
        }),
        "steady": found.steady.as_ref().map(|(_, steady)| regime(steady)),
        "flywheel": found.flywheel.as_ref().map(|wheel| {
            json!({"non_uniformity": args.non_uniformity, "inertia_kg_m2": wheel.inertia, "steady": regime(&wheel.regime)})
        }),
        "by_angle": by_angle,
    });
    if found.steady.is_none() {
        value["steady_absent"] = Value::from("the scenario has no motor");
    }
    serde_json::to_string_pretty(&value).expect("plain values are always JSON")
}

fn run_up(args: &Args, model: &Model) -> Result<RunUp> {
    let times: Vec<f64> = (0..=args.points).map(|k| args.seconds * (k as f64 / args.points as f64)).collect();
    RunUp::of(model, args.from_rpm * std::f64::consts::TAU / 60.0, &times, ACCURACY)
}
