//! `linkproof new`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::{exit_code, load, output};
use crate::shipped;
use linkage::error::{Error, ErrorKind, Result};
use scenario::Scenario;
use scenario::templates::{self, TEMPLATES, Template};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/new.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Mechanism to start from; without this argument, the templates are listed
    #[arg(value_name = "TEMPLATE")]
    template: Option<String>,
    /// File to write, or `-` for standard output [default: a file named like the template]
    #[arg(short, long, value_name = "FILE", requires = "template", value_parser = target)]
    output: Option<PathBuf>,
    /// Dimension, by its key in `[parameters]`; may be given several times
    #[arg(long, value_name = "KEY=NUMBER", requires = "template", value_parser = load::setting)]
    set: Vec<(String, f64)>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
    /// List the templates
    #[arg(long, conflicts_with_all = ["template", "shipped", "force"])]
    list: bool,
    /// Write the files of all examples, below this directory
    #[arg(long, value_name = "DIR", num_args = 0..=1, default_missing_value = ".", conflicts_with = "template")]
    #[arg(value_parser = output::directory)]
    shipped: Option<PathBuf>,
}

/// A scenario file to write, or `-` for standard output.
pub(super) fn target(text: &str) -> std::result::Result<PathBuf, String> {
    output::writable(text.into())
}

pub(super) fn new(args: &Args) -> Result<u8> {
    match (&args.template, &args.shipped) {
        (Some(name), _) => return begin(name, args),
        (None, Some(directory)) => ship(directory, args)?,
        (None, None) => output::print(&list())?,
    }
    Ok(exit_code::AGREE)
}

/// The templates, one line each.
fn list() -> String {
    let width = TEMPLATES.iter().map(|template| template.name.len()).max().unwrap_or_default();
    let line = |template: &Template| format!("{:width$}  {}\n", template.name, template.title());
    let lines: String = TEMPLATES.iter().map(line).collect();
    sentences::linkproof_new_template_writes_one_its_dimensions(&lines)
}

/// Message about the written file and its use.
fn begun(template: &Template, file: &Path) -> String {
    next(&format!("{}: {}", file.display(), template.title()), file)
}

/// `what`, and the next commands for the scenario `file`.
pub(super) fn next(what: &str, file: &Path) -> String {
    let word = |path: &Path| output::quoted(&path.to_string_lossy());
    let [svg, html] = ["svg", "html"].map(|ending| word(&file.with_extension(ending)));
    sentences::next_after_a_file(&what, &word(file), &svg, &html)
}

/// Refuses to replace an existing file unless `force` is given. The help of the error offers `other` as an alternative
/// to `--force`.
fn free(path: &Path, force: bool, other: &str) -> Result<()> {
    if force || path.symlink_metadata().is_err() {
        return Ok(());
    }
    Err(Error::new(ErrorKind::Input, sentences::is_there_already(&path.display()))
        .help(sentences::or_replace_what_is_there(&other)))
}

fn begin(name: &str, args: &Args) -> Result<u8> {
    let template = templates::named(name)?;
    let own = PathBuf::from(format!("{}.toml", template.scenario_name()));
    let path = args.output.as_ref().unwrap_or(&own);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    load::each_once(&args.set, "--set")?;
    let text = template.scenario(&stem, &args.set).map_err(|error| error.key("--set"))?;
    if output::is_standard(path) {
        output::data(&text)?;
        return Ok(told(&text, Path::new("standard output"), template));
    }
    put(&text, path, args.output.is_some(), args.force)?;
    let code = told(&text, path, template);
    if code == exit_code::AGREE {
        output::print(&begun(template, path))?;
    }
    Ok(code)
}

/// Writes a scenario to a file that the caller named, or whose name the program chose.
/// An existing file is replaced only with `force`.
pub(super) fn put(text: &str, path: &Path, is_named: bool, force: bool) -> Result<()> {
    free(path, force, sentences::GIVE_ANOTHER_NAME_WITH_OUTPUT)?;
    if is_named { output::write(text, path) } else { output::make_by(text.as_bytes(), path, &|_| force) }
}

/// Reports why the mechanism cannot be assembled or its crank cannot rotate; returns the exit code.
fn told(text: &str, path: &Path, template: &Template) -> u8 {
    let Err(error) = Scenario::parse(text, path).and_then(|scenario| prover::run::solve(&scenario.case)) else {
        return exit_code::AGREE;
    };
    output::show(&error);
    output::note(&sentences::is_written_nevertheless_to_be_corrected(&path.display(), &template.dimensions()));
    exit_code::BAD_INPUT
}

fn ship(directory: &Path, args: &Args) -> Result<()> {
    let files = shipped::files();
    for (path, _) in &files {
        free(&directory.join(path), args.force, sentences::NAME_ANOTHER_DIRECTORY_AS_IN_SHIPPED)?;
    }
    for (path, bytes) in &files {
        output::make_below(bytes, &directory.join(path), &|_| args.force)?;
    }
    output::print(&sentences::files_in(&files.len(), &directory.display()))
}
