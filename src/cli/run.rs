//! `linkproof run`.

mod args;
mod session;

use crate::sentences;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::html::Pages;
use super::jobs::{Room, side_by_side};
use super::live::Live;
use super::progress::Shared;
use super::{load, output};
use linkage::error::Result;
use linkage::threads::cores;
use prover::run::{Proof, memory, prove_with};
use scenario::{Scenario, StartRequest};
use session::Session;

pub(super) use args::Args;

/// Proves every file. If a file is bad, the remaining files are still proven.
pub(super) fn run(args: &Args) -> Result<u8> {
    // If nothing is recorded and no viewer is served, options of recordings have no effect and are refused.
    if args.live.live.is_none() {
        args.record.refuse_idle()?;
    }
    args.record.target()?;
    let live = args.live.start(&args.files)?;
    let pages = args.outputs.first(args::RunResults::Html).map(|to| Pages::of(to, args.files.len())).transpose()?;
    let mut session = Session::of(args, pages, live.as_ref());
    let what = match args.files.as_slice() {
        [only] => only.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned()),
        several => format!("{} scenarios", several.len()),
    };
    let bar = Shared::new(&what, args.files.len());
    let most = args.engine.memory.bytes();
    let work = |index: usize, file: &PathBuf, room: &Room| prove_file(args, live.as_ref(), file, room, index, &bar);
    side_by_side(&args.files, threads(args), most, work, |index, file, proven| {
        bar.at(index, 1.0);
        bar.hidden(|| session.take(file, proven));
    });
    drop(bar);
    Ok(session.end())
}

/// Number of files that are proven in parallel.
/// With `--write`, the number is one if a file is given twice, because this file must be read again after it was
/// written.
fn threads(args: &Args) -> usize {
    let mut seen = BTreeSet::new();
    let is_new = |file: &PathBuf| seen.insert(fs::canonicalize(file).unwrap_or_else(|_| file.clone()));
    if args.write && !args.files.iter().all(is_new) { 1 } else { args.jobs.map_or_else(cores, usize::from) }
}

/// Waits until enough memory is free, then proves a file.
fn prove_file(
    args: &Args,
    live: Option<&Live>,
    file: &Path,
    room: &Room,
    index: usize,
    bar: &Shared,
) -> Result<(Scenario, Proof)> {
    if args.write {
        load::refuse_writing(file)?;
    }
    let besides = StartRequest { memory: Some(args.engine.memory.bytes()), ..StartRequest::default() };
    let scenario = load::only(args.start.load_as(file, &args.grid, besides)?, &args.only)?;
    let options = args.engine.options(args.reference);
    let needed = memory::of_proof(&scenario.case, options.engine_count()) + memory::of_oracles(&scenario.oracles);
    room.take(index, needed, || bar.hidden(|| args.engine.memory.tell(&scenario.case, needed)));
    if let Some(live) = live {
        bar.hidden(|| output::note(&sentences::viewers_can_listen_at_from_now(&live.address())));
        live.show_reference(&args.record, &scenario, options.reference);
    }
    let proof = prove_with(&scenario, &options, &mut |part| bar.at(index, part))?;
    let proof = match args.tolerance_scale {
        Some(dial) if dial > 0.0 => proof.with_bounds_scaled(dial),
        _ => proof,
    };
    Ok((scenario, proof))
}
