//! `linkproof compare`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::engine_args::{MemoryArgs, word};
use super::exit_code::graver;
use super::grid::GridArgs;
use super::load::StartArgs;
use super::number::not_negative;
use super::output::End;
use super::outputs::{Outputs, results};
use super::{advice, exit_code, load, output};
use crate::plain::style::Detail;
use crate::report::outcomes::Outcomes;
use crate::report::{compare as report, junit, markdown};
use linkage::error::Result;
use prover::compare::{ComparedParty, ComparisonRule, compare as compared};
use prover::run::memory;
use prover::tables::By;
use scenario::mapping::{Allowed, Mapped, Mapping, Size};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/compare.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario, recording or table with which B is compared
    #[arg(value_name = "A")]
    first: PathBuf,
    /// Scenario, recording or table
    #[arg(value_name = "B")]
    second: PathBuf,
    /// Channels in the columns of B, or of A if B is no table: EXPR=CHANNEL, or a mapping file (.toml); may be given
    /// several times
    #[arg(long, value_name = "EXPR=CHANNEL|FILE", allow_hyphen_values = true)]
    map: Vec<String>,
    /// As --map, for A, if both are tables
    #[arg(long, value_name = "EXPR=CHANNEL|FILE", allow_hyphen_values = true)]
    map_a: Vec<String>,
    /// Write the settings of --map, --rel, --rel-value and --abs to a mapping file
    #[arg(long, value_name = "FILE", value_parser = mapping_target)]
    write_map: Option<PathBuf>,
    /// Allow differences of this fraction of a channel's scale (half its range over the scenario's run), for all
    /// channels or for one channel, subject or stage
    #[arg(long, value_name = "[CHANNEL=]SHARE", value_parser = share(Size::Relative))]
    rel: Vec<Allowed>,
    /// Allow differences of this fraction of each value: 0.05 for 5 %. Values near zero need --abs or --rel
    #[arg(long, value_name = "[CHANNEL=]SHARE", value_parser = share(Size::OfValue))]
    rel_value: Vec<Allowed>,
    /// Allow differences of this size, in the unit of the channel
    #[arg(long, value_name = "CHANNEL=SIZE", value_parser = size)]
    abs: Vec<Allowed>,
    /// Compare these channels only: a channel, a subject (point.P) or a stage (positions); may be given several times
    #[arg(long, value_name = "WORD")]
    only: Vec<String>,
    /// Match rows by time or by crank angle [default: by time, if A and B both have times]
    #[arg(long, value_name = "WHAT", value_parser = word(["time", "crank"], by))]
    by: Option<By>,
    /// Interpolate A between its rows, if A and B are tables or recordings; the interpolation error is added to the
    /// bound
    #[arg(long)]
    interpolate: bool,
    /// Side of the recordings that is compared, such as reference or engine [default: all]
    #[arg(long, value_name = "NAME")]
    side: Option<String>,
    #[command(flatten)]
    memory: MemoryArgs,
    #[command(flatten)]
    start: StartArgs,
    /// Show every channel, not only the most serious ones
    #[arg(long, short)]
    verbose: bool,
    /// Show the verdicts alone
    #[arg(long, short, conflicts_with = "verbose")]
    quiet: bool,
    #[command(flatten)]
    outputs: Outputs<Comparisons>,
}

results! { Comparisons {
    Json = "the results",
    Junit = "JUnit: one suite per comparison, one case per channel",
    Markdown = "a comment for a pull request",
} }

fn by(word: &str) -> Option<By> {
    match word {
        "time" => Some(By::Time),
        "crank" => Some(By::Crank),
        _ => None,
    }
}

/// A path for a mapping file. An existing mapping is replaced; any other existing file is refused.
fn mapping_target(text: &str) -> std::result::Result<PathBuf, String> {
    let path = output::writable(PathBuf::from(text))?;
    if path.extension().is_none_or(|ending| ending != "toml") {
        return Err(sentences::A_MAPPING_FILE_ENDS_IN_TOML.into());
    }
    if path.exists() && Mapping::load(&path).is_err() {
        return Err(sentences::THIS_FILE_IS_NO_MAPPING_AND_WOULD.into());
    }
    Ok(path)
}

/// Reads `[CHANNEL=]SHARE`; `size` states whether the share refers to the scale or to each value.
fn share(size: fn(f64) -> Size) -> impl Fn(&str) -> std::result::Result<Allowed, String> + Clone {
    move |text| {
        let (of, number) = text.rsplit_once('=').map_or((None, text), |(of, number)| (Some(of.trim().into()), number));
        Ok(Allowed { of, size: size(not_negative(number)?) })
    }
}

/// Reads `CHANNEL=SIZE`.
fn size(text: &str) -> std::result::Result<Allowed, String> {
    match text.contains('=') {
        true => share(Size::Absolute)(text),
        false => Err(sentences::EXPECTED_CHANNEL_SIZE_SUCH_AS_POINT.into()),
    }
}

/// Compares the parties, reports the result, and returns the exit code.
pub(super) fn compare(args: &Args) -> Result<u8> {
    let given = [("A", Some(&args.first)), ("B", Some(&args.second)), ("--write-map", args.write_map.as_ref())];
    for (name, path) in given {
        let path = path.map(|path| (name, path.as_path()));
        output::apart(&args.outputs.named().into_iter().chain(path).collect::<Vec<_>>())?;
    }
    check_parties(args)?;
    let mut second_mapping = mapping(&args.map, "--map")?;
    second_mapping.allowed.extend(args.rel.iter().chain(&args.rel_value).chain(&args.abs).cloned());
    // The first party has the mapping of `--map-a`. If only the first party is a table, it has the mapping of `--map`.
    let has_own = !args.map_a.is_empty() || is_table(&args.second);
    let first_mapping = if has_own { mapping(&args.map_a, "--map-a")? } else { second_mapping.clone() };
    let second = party(args, &args.second, &args.first, &second_mapping)?;
    let first = party(args, &args.first, &args.second, &first_mapping)?;
    if let Some(to) = &args.write_map {
        output::write(&second_mapping.text(), to)?;
    }
    let how = ComparisonRule {
        allowed: second_mapping.allowed,
        by: args.by,
        interpolates: args.interpolate,
        side: args.side.clone(),
        only: args.only.clone(),
        memory: Some(args.memory.bytes()),
    };
    let paths = [args.first.as_path(), args.second.as_path()];
    let found = compared([first, second], &how)?;
    let outcomes = Outcomes::of_comparison(paths, &found, advice::told);
    if !args.outputs.take_standard() {
        let detail = Detail::asked(args.quiet, args.verbose);
        output::report(&report::text(paths, &found, detail, advice::told, output::columns()))?;
    }
    let written = args.outputs.write(|result| {
        Ok(match result {
            Comparisons::Json => report::json(paths, &found, advice::told),
            Comparisons::Junit => junit::xml(&outcomes),
            Comparisons::Markdown => markdown::text(&outcomes),
        })
    });
    Ok(graver(exit_code::of(&found.verdict), written.code()))
}

/// Refuses options that do not apply to the two compared parties, for example `--map` without a table.
fn check_parties(args: &Args) -> Result<()> {
    let tables = [&args.first, &args.second].map(|path| is_table(path));
    let has_recording =
        [&args.first, &args.second].iter().any(|path| path.extension().is_some_and(|own| own == "mcap"));
    if !args.map.is_empty() && tables == [false; 2] {
        let message = sentences::NEITHER_OF_THE_TWO_IS_A_TABLE;
        return output::refused("--map", message, sentences::SCENARIOS_AND_RECORDINGS_HAVE_CHANNELS);
    }
    if !args.map_a.is_empty() && !tables[0] {
        return output::refused("--map-a", sentences::A_IS_NO_TABLE, sentences::MAP_IS_FOR);
    }
    if args.interpolate && tables.iter().filter(|is_table| **is_table).count() == 0 && !has_recording {
        let message = sentences::BOTH_ARE_SCENARIOS_WHICH_ARE_SOLVED;
        return output::refused("--interpolate", message, sentences::LEAVE_IT_OUT);
    }
    if args.side.is_some() && !has_recording {
        return output::refused("--side", sentences::NEITHER_OF_THE_TWO_IS_A_RECORDING, sentences::LEAVE_IT_OUT);
    }
    Ok(())
}

/// Whether a path names a table: neither a scenario nor a recording.
fn is_table(path: &Path) -> bool {
    !path.extension().is_some_and(|ending| ending == "toml" || ending == "mcap")
}

/// The mapping from the values of an option: each value is a line `EXPR=CHANNEL` or a mapping file.
fn mapping(lines: &[String], option: &str) -> Result<Mapping> {
    let mut mapping = Mapping::default();
    for line in lines {
        match line.ends_with(".toml") && !line.contains('=') {
            true => mapping.extend(Mapping::load(Path::new(line))?),
            false => mapping.push(Mapped::parse(line, option)?),
        }
    }
    Ok(mapping)
}

/// Reads a party; `other` is the path of the other party.
fn party(args: &Args, path: &Path, other: &Path, mapping: &Mapping) -> Result<ComparedParty> {
    let path = if load::is_standard_input(path) { Path::new("/dev/stdin") } else { path };
    let ending = path.extension().and_then(|ending| ending.to_str());
    Ok(match ending {
        Some("toml") => args.start.load(path, &GridArgs::default())?.into(),
        Some("mcap") => ComparedParty::recording(path.display().to_string(), recording::load(path)?),
        Some(_) | None => {
            let claims = mapping.channels.len().max(1);
            let is_solved = other.extension().is_some_and(|ending| ending == "toml");
            let may = |bytes: f64, rows: usize| {
                let most = Some(args.memory.bytes());
                memory::check_input(&sentences::the_table(&path.display()), bytes, most)?;
                // The estimate is a lower limit: it does not count the columns that need no mapping because their names
                // are names of channels.
                let compared = if is_solved && rows > 0 { memory::of_comparison(rows, claims, claims) } else { 0.0 };
                memory::check_input(&sentences::comparing_rows(&rows), compared, most)
            };
            ComparedParty::table_within(path, mapping, &may)?
        }
    })
}
