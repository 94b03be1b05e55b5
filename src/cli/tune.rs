//! `linkproof tune`.

use std::path::PathBuf;

use super::engine_args::EngineArgs;
use super::engine_section::{self, keys};
use super::outputs::{Outputs, results};
use super::progress::Bar;
use super::{load, number};
use crate::report::tune as report;
use lab::tune::{WantedAccuracy, by_work, tune};
use linkage::engine::Engine;
use linkage::error::{Advice, Error, Result};
use prover::run::Reference;
use scenario::edit;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/tune.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Largest allowed error, as a fraction of each channel's scale
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, value_parser = number::share)]
    within: f64,
    /// Channel, or stage of channels, that must meet the allowed error [default: all channels that the scenario
    /// requests]
    #[arg(long, value_name = "CHANNEL")]
    channel: Vec<String>,
    #[command(flatten)]
    engine: EngineArgs,
    /// Write the found settings to the scenario's `[engine]` section
    #[arg(long)]
    write: bool,
    #[command(flatten)]
    outputs: Outputs<Tuned>,
}

results! { Tuned {
    Json = "the result",
} }

pub(super) fn run(args: &Args) -> Result<()> {
    if args.write {
        load::refuse_writing(&args.file)?;
    }
    let scenario = load::plain(&args.file)?;
    let wish = WantedAccuracy { within: args.within, channels: args.channel.clone() };
    let mut options = args.engine.options(Reference::Assur);
    if options.settings.engines.is_free() {
        options = options.every_engine();
    }
    let mut bar = Bar::new(&scenario.name);
    let mut price = |engine: &dyn Engine, run: &mut dyn FnMut() -> Result<()>| by_work(&scenario.case, engine, run);
    let found = tune(&scenario, &wish, &options, &mut price, &mut |part| bar.at(part)).map_err(of_argument)?;
    drop(bar);
    let best_keys = || keys(&scenario, found.best.engine, found.best.settings);
    if args.write {
        engine_section::write(&args.file, &scenario, best_keys())?;
    }
    args.outputs.deliver(
        |_| Ok(report::json(&scenario, &found, args.within)),
        |_| {
            let section = edit::engine_section(best_keys());
            let place = report::Section { text: &section, file: load::named(&args.file), is_written: args.write };
            let hints = report::Hints { why: &|engine| format!("`linkproof run --engine {engine}`"), write: "--write" };
            report::text(&scenario, &found, args.within, &place, hints)
        },
    )
}

/// Names the argument that requested an unknown channel.
fn of_argument(error: Error) -> Error {
    match error.advice() {
        [Advice::OtherChannel { .. }] => error.key("--channel"),
        _ => error,
    }
}
