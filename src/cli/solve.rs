//! `linkproof solve`.

use crate::sentences;
use std::path::{Path, PathBuf};

use clap::builder::TypedValueParser;

use super::engine_args::{MemoryArgs, SettingArgs, engine_names, word};
use super::grid::GridArgs;
use super::load::{StartArgs, only};
use super::output;
use super::outputs::{Outputs, results};
use super::progress::Bar;
use crate::report::table_csv;
use analytic::range::explained;
use linkage::error::{Error, ErrorKind, Result};
use prover::engines::EngineName;
use prover::run::{Reference, memory};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/solve.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Solver: an analytic one or an engine
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = With::parser())]
    with: With,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    start: StartArgs,
    #[command(flatten)]
    settings: SettingArgs,
    #[command(flatten)]
    memory: MemoryArgs,
    /// Request only these channels, as in `run`; quantities that they do not depend on are not computed. May be given
    /// several times
    #[arg(long, value_name = "WORD")]
    only: Vec<String>,
    #[command(flatten)]
    outputs: Outputs<Solutions>,
}

results! { Solutions {
    Csv = "one row per instant",
} }

/// The solver: an analytic side or an engine.
#[derive(Clone, Copy, Debug)]
enum With {
    Side(Reference),
    Engine(EngineName),
}

impl With {
    fn parser() -> impl TypedValueParser<Value = With> {
        let names = Reference::ALL.map(Reference::name).into_iter().chain(engine_names());
        word(names, |name| Reference::named(name).map(With::Side).or_else(|| EngineName::named(name).map(With::Engine)))
    }
}

pub(super) fn solve(args: &Args) -> Result<()> {
    let scenario = only(args.start.load(&args.file, &args.grid)?, &args.only)?;
    let case = &scenario.case.scene()?.case;
    let engine = match args.with {
        With::Side(_) => None,
        With::Engine(engine) => Some(args.settings.engine(engine, &scenario)?),
    };
    let runs = engine.as_ref().map_or(1, |engine| engine.settings().extrapolated + 1);
    let needed = memory::of_solution(case, runs);
    memory::check(case, needed, Some(args.memory.bytes()))?;
    args.memory.tell(case, needed);
    let mut bar = Bar::new(&scenario.name);
    let mut progress = |part| bar.at(part);
    let trajectory = match (args.with, args.settings.given()) {
        (With::Side(side), Some(option)) => {
            let engines = EngineName::ALL.map(EngineName::name).join(", ");
            let error = Error::new(ErrorKind::Input, sentences::is_a_setting_of_an_engine(&option, &side));
            return Err(error.help(sentences::leave_out_or_solve_with_one_of(&option, &engines)));
        }
        (With::Side(side), None) => {
            side.solver().solve_with(case, &mut progress).map_err(|error| explained(case, error))?
        }
        (With::Engine(_), _) => engine.expect("it was made above").solve_with(case, &mut progress)?,
    };
    drop(bar);
    let to = args.outputs.first(Solutions::Csv).unwrap_or(Path::new("-"));
    output::stream(to, |out| table_csv::solution(&trajectory, out))
}
