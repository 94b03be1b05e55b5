//! `linkproof import`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::{exit_code, load, new, output};
use design::import;
use linkage::error::Result;
use scenario::header::is_name;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/import.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Share link of PMKS+ in quotes, or a file: such a link, a model for MuJoCo or a file of Linkage; `-` for
    /// standard input
    #[arg(value_name = "SOURCE")]
    source: PathBuf,
    /// Scenario file to write, or `-` for standard output [default: the name of the source, in this directory]
    #[arg(short, long, value_name = "FILE", value_parser = new::target)]
    output: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
}

pub(super) fn import(args: &Args) -> Result<u8> {
    let address = args.source.to_str().filter(|source| is_address(source));
    let text = address.map_or_else(|| load::source(&args.source), |address| Ok(address.into()))?;
    let named = if address.is_some() { Path::new("pmks") } else { load::named(&args.source) };
    let file = args.output.as_deref().filter(|path| !output::is_standard(path)).unwrap_or(named);
    let name = short(&file.file_stem().unwrap_or_default().to_string_lossy());
    let found = import::import(&text, load::named(&args.source), &name)?;
    let own = PathBuf::from(format!("{name}.toml"));
    let path = args.output.as_ref().unwrap_or(&own);
    if output::is_standard(path) {
        output::data(&found.text)?;
    } else {
        new::put(&found.text, path, args.output.is_some(), args.force)?;
    }
    found.told.iter().for_each(|told| output::note(&files::visible(told)));
    if let Some(problem) = &found.problem {
        output::show(problem);
        output::note(&sentences::the_import_is_to_be_completed(&path.display()));
        return Ok(exit_code::BAD_INPUT);
    }
    if !output::is_standard(path) {
        output::print(&new::next(&path.display().to_string(), path))?;
    }
    Ok(exit_code::AGREE)
}

/// Whether the source is a link and not a file. The query of a link, without the address before it, also counts.
fn is_address(source: &str) -> bool {
    source.contains("://") || (source.contains('?') && !Path::new(source).exists())
}

/// The text as the name of a scenario.
fn short(text: &str) -> String {
    let sign = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '_' };
    let name: String = text.chars().take(50).map(sign).collect();
    let name = name.trim_matches('_');
    if is_name(name) { name.into() } else { "imported".into() }
}
