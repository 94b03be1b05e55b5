//! Writing to standard output, files and the terminal.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::advice;
use linkage::error::{Error, ErrorKind, Result};

/// Path that results may be written to, `-` for standard output. Scenario files are refused: in `--json
/// scenarios/*.toml` the first of them would become the target.
pub(super) fn target(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.extension().is_some_and(|extension| extension == "toml") {
        return Err("this is a scenario file and would be overwritten; expected a file for the results, or `-`".into());
    }
    Ok(path)
}

/// Writes text to a file, or to standard output for `-`.
pub(super) fn write(text: &str, to: &Path) -> Result<()> {
    if to == Path::new("-") {
        return print(text);
    }
    fs::write(to, text).map_err(|error| {
        Error::new(ErrorKind::Io, format!("{} cannot be written: {error}", to.display()))
            .help("check that the directory exists and may be written to")
    })
}

/// Writes text to standard output. A reader that has closed the pipe (`| head`) is not an error.
pub(super) fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::new(ErrorKind::Io, format!("standard output cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}

/// Shows the error of a command and returns its exit code.
pub(super) fn exit(result: Result<()>) -> u8 {
    match result {
        Ok(()) => super::exit_code::AGREE,
        Err(error) => {
            show(&error);
            super::exit_code::BAD_INPUT
        }
    }
}

/// Shows an error on standard error: the line of the file concerned, what was found there, and the way out.
pub(super) fn show(error: &Error) {
    let text = render(error);
    // If standard error is closed, nothing can be done.
    let _ = writeln!(io::stderr(), "{text}");
}

fn render(error: &Error) -> String {
    let title = match error.scenario_key() {
        Some(key) => format!("`{key}`: {}", error.message()),
        None => error.message().to_string(),
    };
    let help = error.way_out_by(advice::told);
    let Some(place) = error.place() else {
        // The renderer would draw a margin for lines that do not exist.
        let help = help.map(|help| format!("\n  = help: {help}")).unwrap_or_default();
        return format!("error: {title}{help}");
    };
    let path = place.file.display().to_string();
    let annotation = AnnotationKind::Primary.span(place.span.clone());
    let snippet = Snippet::source(place.text.as_str()).path(path.as_str()).annotation(annotation);
    let mut group = Group::with_title(Level::ERROR.primary_title(title.as_str())).element(snippet);
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help));
    }
    Renderer::plain().render(&[group])
}
