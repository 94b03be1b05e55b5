//! `linkproof graph`.

use crate::sentences;
use std::path::PathBuf;

use super::engine_args::{MemoryArgs, SettingArgs};
use super::grid::GridArgs;
use super::load::{self, StartArgs};
use super::outputs::{Made, Outputs, results};
use super::solving::With;
use super::{number, output};
use crate::graph::{Look, Question, Source, Words, graphs, rows};
use crate::report::table_csv;
use linkage::error::Result;
use prover::engines::EngineName;
use prover::run::Reference;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/graph.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// One chart: curves, separated by commas. A curve is a channel, an expression of channels, a formula of the file by
    /// its name, or a pattern such as joint.*.f_N. May be given several times; the charts are drawn below each other
    /// [default: angles, angular velocities and accelerations of all links, reactions, driving torques]
    #[arg(long, value_name = "CURVE[,CURVE...]")]
    show: Vec<String>,
    /// Horizontal axis: `crank`, `time` or an expression [default: crank, for motions under forces time]
    #[arg(long, value_name = "WHAT")]
    over: Option<String>,
    /// Solver: an analytic one or an engine
    #[arg(long, visible_alias = "solver", value_name = "SOLVER", value_parser = With::parser())]
    with: Option<With>,
    /// Draw the engine beside the analytic side; --with names the engine [default: the scenario's engine]
    #[arg(long, conflicts_with = "difference")]
    both: bool,
    /// Draw the engine minus the analytic side; --with names the engine [default: the scenario's engine]
    #[arg(long)]
    difference: bool,
    /// Title above the charts
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true)]
    title: String,
    /// Name of the horizontal axis, with its unit
    #[arg(long, value_name = "TEXT")]
    x_label: Option<String>,
    /// Name of the vertical axis, with its unit; the first for the first chart, the second for the second
    #[arg(long, value_name = "TEXT")]
    y_label: Vec<String>,
    /// Names of all curves, in the order of the charts
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',')]
    legend: Vec<String>,
    /// Width and height of each chart in millimetres [default: 160,70; for a hodograph 110,105]
    #[arg(long, value_name = "W,H", value_parser = size)]
    size_mm: Option<[f64; 2]>,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    start: StartArgs,
    #[command(flatten)]
    settings: SettingArgs,
    #[command(flatten)]
    memory: MemoryArgs,
    #[command(flatten)]
    outputs: Outputs<GraphResults>,
}

results! { GraphResults {
    Svg = "the charts",
    Csv = "the numbers of the curves",
} }

/// Limits of the size of a chart (mm).
const SIZES: [f64; 2] = [40.0, 1000.0];

/// Reads `W,H`.
fn size(text: &str) -> std::result::Result<[f64; 2], String> {
    let numbers = text.split(',').map(|part| number::decimal(part.trim(), sentences::TWO_LENGTHS_WITH_A_COMMA));
    let numbers: Vec<f64> = numbers.collect::<std::result::Result<_, _>>()?;
    match numbers.as_slice() {
        [width, height] if [width, height].iter().all(|own| (SIZES[0]..=SIZES[1]).contains(*own)) => {
            Ok([*width, *height])
        }
        _ => Err(sentences::expected_a_size(&SIZES[0], &SIZES[1])),
    }
}

/// The parties of a graph: one solver, or an analytic side and an engine that are compared.
fn parties(args: &Args, scenario: &scenario::Scenario) -> Result<Vec<With>> {
    if !args.both && !args.difference {
        return Ok(vec![args.with.unwrap_or(With::Side(Reference::Assur))]);
    }
    let engine = match args.with {
        Some(With::Engine(engine)) => engine,
        Some(With::Side(side)) => {
            let option = if args.both { "--both" } else { "--difference" };
            let engines = EngineName::ALL.map(EngineName::name).join(", ");
            return output::refused(
                option,
                sentences::is_an_analytic_side_and_no_engine(&side),
                &sentences::name_an_engine_or_leave_with_out(&engines),
            );
        }
        None => {
            let own = scenario.engine.engines.value().and_then(|engines| engines.first().copied());
            own.unwrap_or(EngineName::ALL[0])
        }
    };
    Ok(vec![With::Side(Reference::Assur), With::Engine(engine)])
}

/// Solves every scenario as far as its charts need it, and draws the charts.
pub(super) fn graph(args: &Args) -> Result<()> {
    let words = Words { show: args.show.clone(), over: args.over.clone(), keys: ["--show", "--over"] };
    let solved = |file: &PathBuf| -> Result<Source> {
        let scenario = args.start.load(file, &args.grid)?;
        let question = Question::of(&words, &scenario)?;
        let case = scenario.case.wanting_only(&question.channels(&scenario)).scene()?.case;
        let solve = |with: &With| Ok((with.name(), with.solve(&scenario, &case, &args.settings, args.memory)?));
        let parties = parties(args, &scenario)?.iter().map(solve).collect::<Result<Vec<_>>>()?;
        Ok(Source { scenario, question, case, parties, chosen_instants: args.grid.is_given() })
    };
    let sources = args.files.iter().map(solved).collect::<Result<Vec<_>>>()?;
    let look = Look {
        title: args.title.clone(),
        x_label: args.x_label.clone(),
        y_labels: args.y_label.clone(),
        legend: args.legend.clone(),
        size: args.size_mm,
        difference: args.difference,
    };
    let found = graphs(&sources, &look)?;
    found.notes.iter().for_each(|note| output::note(note));
    if args.outputs.is_empty() {
        let stem = match args.files.as_slice() {
            [one] if !load::is_standard_input(one) => one.file_stem().unwrap_or_default().to_string_lossy(),
            _ => "scenarios".into(),
        };
        return output::make_here(&found.drawing.svg(), &format!("{stem}_graph.svg"));
    }
    args.outputs.write(|form| -> Result<Made> {
        Ok(match form {
            GraphResults::Svg => found.drawing.clone().into(),
            GraphResults::Csv => table_csv::as_csv(rows(&found.curves))?.into(),
        })
    })
}
