//! `linkproof golden`.

use std::path::Path;

use super::outputs::{Outputs, results};
use super::{output, progress};
use crate::report::case_json;
use crate::report::golden::{CHECKER, Golden, SET, largest_bound, manifest, readme, tables};
use crate::{sentences, shipped};
use analytic::AssurSolver;
use design::export::{ModelFormat, first_state};
use linkage::error::{Error, ErrorKind, Result};
use linkage::threads::{cores, made};
use prover::bounds::Verdict;
use prover::engines::usual_step;
use prover::run::{Options, prove};
use scenario::Scenario;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/golden.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Mechanisms of the set, by name [default: all]
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    #[command(flatten)]
    outputs: Outputs<GoldenSets>,
    /// List the mechanisms of the set, and write nothing
    #[arg(long)]
    list: bool,
}

results! { GoldenSets {
    Results = "directory of the set [default: golden]",
} }

/// A scenario of the set.
struct Entry {
    path: &'static str,
    name: &'static str,
    sort: &'static str,
    bytes: &'static [u8],
}

pub(super) fn golden(args: &Args) -> Result<()> {
    let files = shipped::files();
    let bytes_of = |path: &str| files.iter().find(|(own, _)| own == path).expect("a shipped file").1;
    let entry = |&(path, sort)| Entry { path, name: name_of(path), sort, bytes: bytes_of(path) };
    let entries: Vec<Entry> = SET.iter().map(entry).collect();
    if args.list {
        return output::data(&entries.iter().map(|own| format!("{}: {}\n", own.name, own.sort)).collect::<String>());
    }
    if let Some(unknown) = args.names.iter().find(|name| entries.iter().all(|own| own.name != *name)) {
        let known: Vec<&str> = entries.iter().map(|own| own.name).collect();
        let error = Error::new(ErrorKind::Input, sentences::is_no_mechanism_of_the_set(unknown));
        return Err(error.help(sentences::the_set_has(&known.join(", "))));
    }
    let is_wanted = |entry: &Entry| args.names.is_empty() || args.names.iter().any(|name| name == entry.name);
    let wanted: Vec<Entry> = entries.into_iter().filter(is_wanted).collect();
    let place = args.outputs.first(GoldenSets::Results).unwrap_or(Path::new("golden"));
    let mut bar = progress::Bar::new("golden");
    let found = made(&wanted, cores(), |entry| one(entry, place), |done| bar.at(done as f64 / wanted.len() as f64));
    let set = found.into_iter().collect::<Result<Vec<Golden>>>()?;
    drop(bar);
    for (name, text) in [("README.md", readme(&set)), ("check.py", CHECKER.into()), ("manifest.json", manifest(&set))] {
        put(&place.join(name), text.as_bytes())?;
    }
    output::print(&sentences::mechanisms_are_in(&set.len(), &place.display()))
}

fn name_of(path: &'static str) -> &'static str {
    path.rsplit('/').next().and_then(|file| file.strip_suffix(".toml")).expect("a scenario file")
}

/// Proves a mechanism and writes its files.
fn one(&Entry { path, name, sort, bytes }: &Entry, place: &Path) -> Result<Golden> {
    let text = std::str::from_utf8(bytes).expect("a scenario is text");
    let scenario = Scenario::parse(text, Path::new(path))?;
    let proof = prove(&scenario, &Options::default())?;
    if !matches!(proof.verdict, Verdict::Agree { .. }) {
        return Err(Error::new(ErrorKind::Numeric, sentences::has_the_verdict(&name, &proof.verdict.word())));
    }
    let directory = place.join(name);
    put(&directory.join(format!("{name}.toml")), bytes)?;
    for (file, bytes) in tables(&proof)? {
        put(&directory.join(file), &bytes)?;
    }
    let step = scenario.engine.step.get().unwrap_or_else(|| usual_step(&scenario.case));
    // The JSON contains the case as numbers, so it can describe every mechanism.
    let numbers = case_json::text(&scenario.name, &scenario.case, &first_state(&scenario.case, &AssurSolver)?);
    put(&directory.join(format!("{name}.json")), numbers.as_bytes())?;
    let mut models = vec![("json", None)];
    for format in ModelFormat::ALL {
        let ending = format.ending();
        let why = match format.model(&scenario.case, &AssurSolver, &scenario.name, step) {
            Ok(text) => put(&directory.join(format!("{name}.{ending}")), text.as_bytes()).map(|()| None)?,
            Err(error) => Some(error.message().to_string()),
        };
        models.push((ending, why));
    }
    let truth = &proof.reference_trajectory;
    Ok(Golden {
        name: name.into(),
        title: scenario.title,
        sort,
        models,
        size: [truth.times().len(), truth.channels().len()],
        bound: largest_bound(truth, &proof.reference_bounds),
    })
}

/// Writes a file, and its directory. A file with other contents is not replaced.
fn put(path: &Path, bytes: &[u8]) -> Result<()> {
    output::make_below(bytes, path, &|found| found == bytes)
}
