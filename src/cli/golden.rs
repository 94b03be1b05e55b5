//! `linkproof golden`.

use std::fs;
use std::path::Path;

use super::outputs::{Outputs, results};
use super::{output, progress};
use crate::report::golden::{CHECKER, Golden, SET, largest_bound, manifest, readme, tables};
use crate::{sentences, shipped};
use analytic::AssurSolver;
use design::export::{mjcf, sdf, urdf, usd};
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

/// A scenario of the set: its path, name, and sort.
type Entry = (&'static str, &'static str, &'static str);

pub(super) fn golden(args: &Args) -> Result<()> {
    let entries: Vec<Entry> = SET.iter().map(|(path, sort)| (*path, name_of(path), *sort)).collect();
    if args.list {
        return output::data(&entries.iter().map(|(_, name, sort)| format!("{name}: {sort}\n")).collect::<String>());
    }
    if let Some(unknown) = args.names.iter().find(|name| entries.iter().all(|(_, own, _)| own != name)) {
        let known: Vec<&str> = entries.iter().map(|(_, name, _)| *name).collect();
        let error = Error::new(ErrorKind::Input, sentences::is_no_mechanism_of_the_set(unknown));
        return Err(error.help(sentences::the_set_has(&known.join(", "))));
    }
    let is_wanted = |name: &str| args.names.is_empty() || args.names.iter().any(|own| own == name);
    let wanted: Vec<Entry> = entries.into_iter().filter(|(_, name, _)| is_wanted(name)).collect();
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
fn one(&(path, name, sort): &Entry, place: &Path) -> Result<Golden> {
    let bytes = shipped::files().into_iter().find(|(own, _)| own == path).expect("a shipped file").1;
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
    let (case, own) = (&scenario.case, &scenario.name);
    let made = [
        ("xml", mjcf::mjcf(case, &AssurSolver, own, step)),
        ("sdf", sdf::sdf(case, &AssurSolver, own, step)),
        ("urdf", urdf::urdf(case, &AssurSolver, own, None)),
        ("usda", usd::usd(case, &AssurSolver, own)),
    ];
    let mut models = Vec::new();
    for (ending, made) in made {
        let why = match made {
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
    let parent = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(parent).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::cannot_make_the_directory_of(&path.display(), &error))
            .help(sentences::CHECK_THAT_THIS_DIRECTORY_MAY)
    })?;
    output::make_by(bytes, path, &|found| found == bytes)
}
