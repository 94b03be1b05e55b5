//! `linkproof check`.

use std::path::PathBuf;

use super::grid::GridArgs;
use super::load::StartArgs;
use super::{advice, exit_code, number, output, terminal};
use crate::report::check as report;
use linkage::error::{Error, ErrorKind, Result};
use prover::proof::claimed;
use scenario::formula::{fault_of_claim, refused};
use scenario::{Claim, Scenario};

const EXAMPLES: &str = "\
Examples:
  linkproof new --shipped      write the files that the examples name
  linkproof check scenarios/formulas/slider_crank_centric.toml           every [[formula]] of a file
  linkproof check scenarios/formulas/slider_crank_centric.toml --verbose  each of them, by value and by derivative
  linkproof check scenarios/crank_rocker.toml 'phi*180/pi' --channel link.crank.angle_deg
  linkproof check scenarios/scotch_yoke.toml 'r*cos(phi)' --set r_mm=80 --channel point.A.x_m
  linkproof check mine.toml 'atan2(u, v)' --let 'u=a*sin(phi)' --let 'v=d - a*cos(phi)' --set a_mm=30 --set d_mm=80 \\
      --channel link.guide.angle_rad
  linkproof check mine.toml 'r*w^2*(cos(phi) + r/l*cos(2*phi))' --set r=0.05 --set l=0.2 --set w_rpm=300 \\
      --channel point.B.ax_m_s2 --error 0.4 --json -

phi is the crank angle in rad as the scenario states it, t the time in s; pi, sin cos tan asin acos atan atan2(y, x) \
sqrt abs exp ln are known. The value counts in the channel's unit. -x^2 is -(x^2). --set a_mm=30 makes `a` known in \
SI (0.03) and `a_mm` as the plain number. Judged by value, and by first and second derivative where the mechanism has \
channels for them, at every instant of the grid and against both analytic sides: `linkproof docs formulas`.

Exit codes: 0 right, 1 wrong, 2 bad input, 3 nothing proven.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    file: PathBuf,
    /// Formula over phi, t, parameters and named formulas [default: every `[[formula]]` of the file]
    #[arg(value_name = "EXPR", requires = "channel", allow_hyphen_values = true)]
    expression: Option<String>,
    /// What the formula claims to be: a channel such as link.rocker.angle_deg, drive.reduced_inertia_kg_m2, or an
    /// arithmetic of channels
    #[arg(long, value_name = "CHANNEL", requires = "expression", allow_hyphen_values = true)]
    channel: Option<String>,
    /// Step of the derivation: a formula with a name, which those after it and EXPR may use; may be given several times
    #[arg(long = "let", value_name = "NAME=EXPR", requires = "expression", value_parser = step)]
    steps: Vec<(String, String)>,
    /// First crank angle in degrees for which the formula is claimed
    #[arg(long, value_name = "DEG", requires = "expression", allow_hyphen_values = true, value_parser = number::finite)]
    from_deg: Option<f64>,
    /// Last crank angle in degrees for which the formula is claimed
    #[arg(long, value_name = "DEG", requires = "expression", allow_hyphen_values = true, value_parser = number::finite)]
    to_deg: Option<f64>,
    /// Error that the formula is claimed to have, in the channel's unit: for series and approximations
    #[arg(long, value_name = "NUMBER", requires = "expression", allow_hyphen_values = true, value_parser = number::positive)]
    error: Option<f64>,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    start: StartArgs,
    /// Show every formula and every derivative
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    /// Show only the verdict, in one line
    #[arg(short, long)]
    quiet: bool,
    /// Write the judgement as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
}

/// Reads `NAME=EXPR`.
fn step(text: &str) -> std::result::Result<(String, String), String> {
    let (name, expression) = text.split_once('=').ok_or("expected NAME=EXPR, such as 'u=a*sin(phi)'")?;
    Ok((name.trim().into(), expression.trim().into()))
}

/// Judges, reports, and says how it ended.
pub(super) fn check(args: &Args) -> u8 {
    let answer = || -> Result<u8> {
        let scenario = asked(args)?;
        let found = claimed::judge(&scenario)?;
        if let Some(to) = &args.json {
            output::write(&report::json(&scenario, &found, advice::told), to)?;
        }
        if !output::is_said(&args.json) {
            let width = terminal::columns();
            terminal::print(&match (args.quiet, args.verbose) {
                (true, _) => format!("{}\n", report::verdict_line(&scenario, &found)),
                (_, true) => report::text(&scenario, &found, advice::told, width),
                _ => report::brief(&scenario, &found, advice::told, width),
            })?;
        }
        Ok(exit_code::of(&found.verdict))
    };
    answer().unwrap_or_else(|error| {
        output::show(&error);
        exit_code::BAD_INPUT
    })
}

/// The scenario with the formulas that are asked about.
fn asked(args: &Args) -> Result<Scenario> {
    let adds = args.expression.is_some();
    let mut scenario = args.start.load_and_add(&args.file, &args.grid, adds)?;
    let (Some(expression), Some(channel)) = (&args.expression, &args.channel) else { return Ok(scenario) };
    // What the file claims itself is not asked.
    scenario.formulas.list.iter_mut().for_each(|formula| formula.claim = None);
    for (name, text) in &args.steps {
        scenario.formulas.check_name(name).map_err(|error| error.key("--let"))?;
        scenario.formulas.add(name, text).map_err(|fault| refused("--let", text, &fault))?;
    }
    let claim = Claim::parse(channel, &scenario.case).map_err(|fault| refused("--channel", channel, &fault))?;
    let formula = scenario.formulas.add("formula", expression).map_err(|fault| refused("EXPR", expression, &fault))?;
    formula.claim = Some(claim);
    formula.valid = [args.from_deg, args.to_deg].map(|degrees| degrees.map(f64::to_radians));
    formula.error = args.error;
    if let Some((key, message, help)) = fault_of_claim(formula.valid, formula.error) {
        let option = if key == "to" { "--to-deg" } else { "--error" };
        return Err(Error::new(ErrorKind::Input, message).key(option).help(help));
    }
    Ok(scenario)
}
