//! `linkproof golden`.

use std::path::{Path, PathBuf};

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
    let found = made(&wanted, cores(), one, |done| bar.at(done as f64 / wanted.len() as f64));
    let (set, files): (Vec<Golden>, Vec<Vec<File>>) =
        found.into_iter().collect::<Result<Vec<_>>>()?.into_iter().unzip();
    drop(bar);
    let of_set = [("README.md", readme(&set)), ("check.py", CHECKER.into()), ("manifest.json", manifest(&set))];
    let of_set = of_set.map(|(name, text)| File { path: name.into(), bytes: text.into_bytes() });
    let files: Vec<File> = files.into_iter().flatten().chain(of_set).collect();
    // The set is written completely or not at all.
    for File { path, bytes } in &files {
        output::may_make_by(&place.join(path), &|found| found == bytes)
            .map_err(|error| error.help(sentences::NAME_A_NEW_DIRECTORY_FOR_THE_SET))?;
    }
    for File { path, bytes } in &files {
        output::make_below(bytes, &place.join(path), &|found| found == bytes)?;
    }
    output::print(&sentences::mechanisms_are_in(&set.len(), &place.display()))
}

fn name_of(path: &'static str) -> &'static str {
    path.rsplit('/').next().and_then(|file| file.strip_suffix(".toml")).expect("a scenario file")
}

/// A file of the set: its path within the set's directory, and its contents.
struct File {
    path: PathBuf,
    bytes: Vec<u8>,
}

/// Proves a mechanism and makes its files.
fn one(&Entry { path, name, sort, bytes }: &Entry) -> Result<(Golden, Vec<File>)> {
    let text = std::str::from_utf8(bytes).expect("a scenario is text");
    let scenario = Scenario::parse(text, Path::new(path))?;
    let proof = prove(&scenario, &Options::default())?;
    if !matches!(proof.verdict, Verdict::Agree { .. }) {
        return Err(Error::new(ErrorKind::Numeric, sentences::has_the_verdict(&name, &proof.verdict.word())));
    }
    let mut files = Vec::new();
    let mut put = |file: &str, bytes: Vec<u8>| files.push(File { path: Path::new(name).join(file), bytes });
    put(&format!("{name}.toml"), bytes.to_vec());
    tables(&proof)?.into_iter().for_each(|(file, bytes)| put(file, bytes));
    let step = scenario.engine.step.get().unwrap_or_else(|| usual_step(&scenario.case));
    // The JSON contains the case as numbers, so it can describe every mechanism.
    let numbers = case_json::text(&scenario.name, &scenario.case, &first_state(&scenario.case, &AssurSolver)?);
    put(&format!("{name}.json"), numbers.into_bytes());
    let mut models = vec![("json", None)];
    for format in ModelFormat::ALL {
        let ending = format.ending();
        let why = match format.model(&scenario.case, &AssurSolver, &scenario.name, step) {
            Ok(text) => {
                put(&format!("{name}.{ending}"), text.into_bytes());
                None
            }
            Err(error) => Some(error.message().to_string()),
        };
        models.push((ending, why));
    }
    let truth = &proof.reference_trajectory;
    let golden = Golden {
        name: name.into(),
        title: scenario.title,
        sort,
        models,
        size: [truth.times().len(), truth.channels().len()],
        bound: largest_bound(truth, &proof.reference_bounds),
    };
    Ok((golden, files))
}
