//! `linkproof check`.

use crate::sentences;
use std::path::PathBuf;

use super::grid::GridArgs;
use super::load::StartArgs;
use super::outputs::{Outputs, results};
use super::{advice, exit_code, number, output};
use crate::check::{FormulaQuestion, Words, check as judged};
use crate::plain::style::Detail;
use crate::report::check as report;
use linkage::error::Result;
use scenario::{Scenario, StartRequest};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/check.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    file: PathBuf,
    /// Formula of phi, t, parameters and named formulas [default: every `[[formula]]` of the file]
    #[arg(value_name = "EXPR", requires = "channel", allow_hyphen_values = true)]
    expression: Option<String>,
    /// Channel that the formula claims to equal, such as link.rocker.angle_deg or drive.reduced_inertia_kg_m2, or an
    /// expression of channels
    #[arg(long, value_name = "CHANNEL", requires = "expression", allow_hyphen_values = true)]
    channel: Option<String>,
    /// Step of the derivation: a named formula that later steps and EXPR may use; may be given several times
    #[arg(long = "let", value_name = "NAME=EXPR", requires = "expression", value_parser = step)]
    steps: Vec<(String, String)>,
    /// First crank angle (deg), or slide (mm), at which the formula is claimed to be valid
    #[arg(long, value_name = "DEG", requires = "expression", allow_hyphen_values = true, value_parser = number::finite)]
    from_deg: Option<f64>,
    /// Last crank angle (deg), or slide (mm), at which the formula is claimed to be valid
    #[arg(long, value_name = "DEG", requires = "expression", allow_hyphen_values = true, value_parser = number::finite)]
    to_deg: Option<f64>,
    /// Claimed error of the formula in the channel's unit, for series and approximations
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
    #[command(flatten)]
    outputs: Outputs<Judgements>,
}

results! { Judgements {
    Json = "the judgement",
} }

/// Reads `NAME=EXPR`.
fn step(text: &str) -> std::result::Result<(String, String), String> {
    let (name, expression) = text.split_once('=').ok_or(sentences::EXPECTED_NAME_EXPR_SUCH_AS_A_SIN)?;
    Ok((name.trim().into(), expression.trim().into()))
}

/// Judges the formulas, reports the result, and returns the exit code.
pub(super) fn check(args: &Args) -> Result<u8> {
    let scenario = asked(args)?;
    let found = judged(&scenario)?;
    args.outputs.write(|_| Ok(report::json(&scenario, &found, advice::told)))?;
    if !args.outputs.take_standard() {
        let width = output::columns();
        output::report(&match Detail::asked(args.quiet, args.verbose) {
            Detail::Verdict => format!("{}\n", report::verdict_line(&scenario, &found)),
            Detail::Whole => report::text(&scenario, &found, advice::told, width),
            Detail::Short => report::brief(&scenario, &found, advice::told, width),
        })?;
    }
    Ok(exit_code::of(&found.verdict))
}

/// Names that messages use for the arguments.
const WORDS: Words =
    Words { formula: "EXPR", channel: "--channel", step: "--let", valid: "--to-deg", error: "--error" };

/// The scenario with the formulas to be judged.
fn asked(args: &Args) -> Result<Scenario> {
    let (Some(formula), Some(channel)) = (&args.expression, &args.channel) else {
        return args.start.load(&args.file, &args.grid);
    };
    let besides = StartRequest { adds_parameters: true, ..StartRequest::default() };
    let scenario = args.start.load_as(&args.file, &args.grid, besides)?;
    let input = scenario.case.crank().input;
    let question = FormulaQuestion {
        formula: formula.clone(),
        channel: channel.clone(),
        steps: args.steps.clone(),
        valid: [args.from_deg, args.to_deg].map(|end| end.map(|value| input.read(value))),
        error: args.error,
    };
    question.of_scenario(scenario, &WORDS)
}
