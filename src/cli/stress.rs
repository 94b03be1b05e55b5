//! `linkproof stress`.

use crate::sentences;
use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;

use super::outputs::{Outputs, results};
use super::progress::Bar;
use super::{exit_code, number, output};
use crate::report::stress as report;
use lab::stress::{FAMILIES, Job, StressFamily, StressOutcome, jobs, run_all};
use linkage::error::{Error, ErrorKind, Result};
use linkage::threads::cores;

/// Output directory if `-o` is not given.
const NAME: &str = "stress";
/// Seed of random mechanisms by default.
const SEED: u64 = 1;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/stress.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Families to run [default: all]
    #[arg(value_name = "FAMILY", value_parser = PossibleValuesParser::new(FAMILIES.iter().map(|family| family.name)))]
    families: Vec<String>,
    #[command(flatten)]
    outputs: Outputs<Stresses>,
    /// Run only a few points of every family
    #[arg(long)]
    quick: bool,
    /// Seed of the random mechanisms
    #[arg(long, value_name = "N", default_value_t = SEED)]
    seed: u64,
    /// Number of points that run in parallel [default: the number of cores]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = number::count)]
    jobs: Option<usize>,
}

results! { Stresses {
    Results = "tables and maps; points already in the directory are not run again [default: stress]",
    Page = "a page; its maps go to a directory of the same name next to it",
} }

/// Runs the points without a stored result, writes all files, and returns the exit code.
pub(super) fn run(args: &Args) -> Result<u8> {
    let chosen =
        |family: &&StressFamily| args.families.is_empty() || args.families.iter().any(|name| name == family.name);
    let families: Vec<&'static StressFamily> = FAMILIES.iter().filter(chosen).collect();
    let out = args.outputs.first(Stresses::Results).unwrap_or(Path::new(NAME));
    output::make_directory(out, "--output", sentences::NAME_A_DIRECTORY_OR_A_PLACE)?;
    let mut all: Vec<Job> = Vec::new();
    for &family in &families {
        let kept = files::text(&json_of(out, family)).map_err(|error| {
            let place = json_of(out, family);
            Error::new(ErrorKind::Io, sentences::cannot_be_read(&place.display(), &error))
                .key("--output")
                .help(sentences::NAME_ANOTHER_DIRECTORY_OR_REMOVE)
        })?;
        all.extend(jobs(family, args.quick, args.seed, &kept.map_or_else(Vec::new, |text| report::outcomes(&text))));
    }
    // Unwritable files are reported before the run, which takes minutes.
    let pictures = families.iter().map(|family| out.join(format!("{}.svg", family.name)));
    output::may_make(&pictures.chain([out.join("report.txt")]).collect::<Vec<_>>())?;
    for &family in &families {
        write_json(args.seed, out, family, &all)?;
    }
    let (total, open) = (all.len(), all.iter().filter(|job| job.outcome.is_none()).count());
    let mut bar = Bar::new("stress");
    let done = |jobs: &[Job], index: usize, finished: usize| -> Result<()> {
        let began = total - open;
        bar.at((finished - began) as f64 / open.max(1) as f64);
        write_json(args.seed, out, jobs[index].family, jobs)
    };
    let threads = args.jobs.unwrap_or_else(cores);
    let all = run_all(all, args.seed, threads, done)?;
    drop(bar);
    let found: Vec<(&StressFamily, Vec<&StressOutcome>)> =
        families.iter().map(|&family| (family, of(family, &all).collect())).collect();
    for (family, outcomes) in &found {
        let place = |extension: &str| out.join(format!("{}.{extension}", family.name));
        let rows = report::rows(family, outcomes.iter().copied())?;
        output::make_by(rows.as_bytes(), &place("csv"), &|old| first_line(old) == first_line(rows.as_bytes()))?;
        output::make(&report::map(family, outcomes), &place("svg"))?;
    }
    for to in args.outputs.of(Stresses::Page) {
        write_page(args, to, &found)?;
    }
    let text = report::text(&found);
    output::make(&text, &out.join("report.txt"))?;
    output::print(&sentences::seed_of_points_were_run_the_others(&text, &args.seed, &open, &total, &out.display()))?;
    let tally = report::Tally::of(found.iter().flat_map(|(_, all)| all.iter().copied()));
    Ok(if tally.silent == 0 && tally.panics == 0 { exit_code::AGREE } else { exit_code::DISAGREE })
}

/// The first line of a table: its header. A file with this header was written by this command and may be replaced.
fn first_line(bytes: &[u8]) -> Option<&[u8]> {
    bytes.split(|&byte| byte == b'\n').next().map(<[u8]>::trim_ascii_end)
}

fn json_of(out: &Path, family: &StressFamily) -> PathBuf {
    out.join(format!("{}.json", family.name))
}

fn of<'a>(family: &'static StressFamily, jobs: &'a [Job]) -> impl Iterator<Item = &'a StressOutcome> {
    jobs.iter().filter(move |job| job.family.name == family.name).filter_map(|job| job.outcome.as_ref())
}

/// Writes the finished results of a family.
fn write_json(seed: u64, out: &Path, family: &'static StressFamily, jobs: &[Job]) -> Result<()> {
    let text = report::json(family, seed, of(family, jobs));
    output::make_by(text.as_bytes(), &json_of(out, family), &|old| report::is_kept(old, family))
}

/// Writes the page, and the maps into a directory with the page's name.
fn write_page(args: &Args, to: &Path, found: &[(&StressFamily, Vec<&StressOutcome>)]) -> Result<()> {
    let stem = to.file_stem().and_then(|stem| stem.to_str()).unwrap_or("stress");
    let maps = to.with_file_name(stem);
    output::make_directory(&maps, "--output", sentences::NAME_A_FILE_IN_A_DIRECTORY)?;
    for (family, outcomes) in found {
        output::make(&report::map(family, outcomes), &maps.join(format!("{}.svg", family.name)))?;
    }
    let quick = if args.quick { " --quick" } else { "" };
    let command = sentences::linkproof_stress_out_dir_page(&quick, &to.display());
    output::write(&report::page(found, &command, stem), to)
}
