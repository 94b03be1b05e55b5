//! `linkproof tune`.

use linkage::math::KeepNan;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;

use super::engine_args::EngineArgs;
use super::output;
use super::progress::Bar;
use crate::report::table;
use crate::scenario::{EngineKeys, Scenario, edit};
use crate::tune::{Candidate, Tuning, Wish, tune};
use linkage::engine::{Engine, Settings};
use linkage::error::{Advice, Error, ErrorKind, Result};

const EXAMPLES: &str = "\
Examples:
  linkproof tune scenarios/crank_rocker.toml --within 1e-4            every engine and route
  linkproof tune scenarios/crank_rocker.toml --within 1e-4 --engine rapier --route differences
  linkproof tune scenarios/ov7_base.toml --within 1e-3 --channel positions --channel joint.A.fx_N
  linkproof tune scenarios/crank_rocker.toml --within 1e-5 --engine all
  linkproof tune scenarios/compressor.toml --within 1e-4 --write      change the scenario's [engine] section

The error is a share of each channel's scale, half its range over the run. Prices are times on this machine, so they, and with them a close
choice, may differ from run to run; the errors do not.";

/// Number of timed runs. The shortest counts, because other work on the machine only adds time.
const REPEATS: usize = 2;
/// A run longer than this (s) is timed once.
const LONG: f64 = 0.1;

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Largest error wanted, as a share of each channel's scale
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true)]
    within: f64,
    /// Channel, or stage of channels, that must meet it [default: all that the scenario wants]
    #[arg(long, value_name = "CHANNEL")]
    channel: Vec<String>,
    #[command(flatten)]
    engine: EngineArgs,
    /// Write the settings found to the scenario's `[engine]` section
    #[arg(long)]
    write: bool,
    /// Write the result as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> Result<()> {
    let scenario = Scenario::load(&args.file)?;
    let wish = Wish { within: args.within, channels: args.channel.clone() };
    let mut options = args.engine.options("assur");
    if options.engines.is_empty() {
        options = options.every_engine();
    }
    let mut bar = Bar::new(&scenario.name);
    let mut price = |_: &dyn Engine, run: &mut dyn FnMut() -> Result<()>| {
        let mut shortest = f64::INFINITY;
        for _ in 0..REPEATS {
            let since = Instant::now();
            run()?;
            shortest = shortest.smaller(since.elapsed().as_secs_f64());
            if shortest > LONG {
                break;
            }
        }
        Ok(shortest)
    };
    let found = tune(&scenario, &wish, &options, &mut price, &mut |part| bar.at(part)).map_err(of_argument)?;
    drop(bar);
    if args.write {
        let text = edit::with_engine(&scenario.text, keys(&scenario, &found.best))?;
        fs::write(&args.file, text).map_err(|error| {
            Error::new(ErrorKind::Io, format!("{} cannot be written: {error}", args.file.display()))
                .help("check that the file may be written to, or copy the section by hand")
        })?;
    }
    match &args.json {
        Some(to) => output::write(&format!("{}\n", as_json(args, &scenario, &found)), to),
        None => output::print(&as_text(args, &scenario, &found)),
    }
}

/// Names the argument that asked for an unknown channel.
fn of_argument(error: Error) -> Error {
    match error.advice() {
        [Advice::OtherChannel { .. }] => error.key("--channel"),
        _ => error,
    }
}

/// What the scenario must state to run a candidate: its step (s), and its other keys.
fn keys(scenario: &Scenario, best: &Candidate) -> (f64, EngineKeys) {
    let Settings { resolution, sweeps, substeps, route, extrapolated } = best.settings;
    // For an engine that chooses its own steps, the scenario's step stays: it belongs to the other engines.
    let step = if best.controls_error { scenario.dt } else { resolution };
    let keys = EngineKeys {
        name: Some(best.engine.into()),
        sweeps: (sweeps > 0).then_some(sweeps),
        substeps: (substeps > 1).then_some(substeps),
        route: Some(route.name().into()),
        extrapolated: extrapolated.then_some(true),
    };
    (step, keys)
}

fn as_text(args: &Args, scenario: &Scenario, found: &Tuning) -> String {
    let header = ["engine", "step", "sweeps", "substeps", "extrapolated", "route", "error", "worst channel", "price"];
    let mut table = table(header, &[1, 2, 3, 6, 8]);
    for candidate in &found.by_engine {
        let Settings { resolution, sweeps, substeps, route, extrapolated } = candidate.settings;
        table.add_row([
            candidate.engine.to_string(),
            format!("{resolution:.3e}"),
            sweeps.to_string(),
            substeps.to_string(),
            if extrapolated { "yes" } else { "no" }.to_string(),
            route.name().to_string(),
            format!("{:.2e}", candidate.verified),
            candidate.worst.clone(),
            format!("{:.2}", candidate.price / found.best.price),
        ]);
    }
    let mut text = String::new();
    let _ = writeln!(text, "{}: {}\n", scenario.name, scenario.title);
    let _ = writeln!(text, "The cheapest settings within {:e} of every channel's scale:\n{table}\n", args.within);
    for (name, error) in &found.too_coarse {
        let _ = match error.is_finite() {
            true => writeln!(text, "{name} does not meet it: its smallest error was {error:.1e}."),
            false => {
                writeln!(text, "{name} does not run it with any settings: `linkproof run --engine {name}` says why.")
            }
        };
    }
    for name in &found.too_dear {
        let _ = writeln!(text, "{name} costs more than the cheapest.");
    }
    let _ = writeln!(
        text,
        "{}: error {:.2e} measured against the reference, {:.2e} expected from its own runs; {} runs.",
        found.best.engine, found.best.verified, found.predicted, found.runs
    );
    let section = edit::engine_section(keys(scenario, &found.best));
    let place = args.file.display();
    let _ = match args.write {
        true => writeln!(text, "\nWritten to {place}:\n\n{section}"),
        false => writeln!(text, "\nFor {place} (or let --write put it there):\n\n{section}"),
    };
    text
}

fn as_json(args: &Args, scenario: &Scenario, found: &Tuning) -> String {
    let candidate = |candidate: &Candidate| {
        let Settings { resolution, sweeps, substeps, route, extrapolated } = candidate.settings;
        let key = if candidate.controls_error { "accuracy" } else { "dt_s" };
        json!({
            "engine": candidate.engine, key: resolution, "sweeps": sweeps,
            "substeps": substeps, "route": route.name(), "extrapolated": extrapolated,
            "error": candidate.verified, "worst_channel": candidate.worst, "price_of_best": candidate.price / found.best.price,
        })
    };
    let value = json!({
        "schema": 1, "scenario": scenario.name, "within": args.within, "runs": found.runs,
        "best": candidate(&found.best), "expected_error": found.predicted,
        "engines": found.by_engine.iter().map(candidate).collect::<Vec<_>>(),
        "too_coarse": found.too_coarse.iter().map(|(name, error)| json!({"engine": name, "smallest_error": error})).collect::<Vec<_>>(),
        "too_dear": found.too_dear,
    });
    serde_json::to_string_pretty(&value).expect("plain values are always JSON")
}
