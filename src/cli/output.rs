//! Functions that write to standard output, files and the terminal.

use crate::sentences;
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use super::{advice, exit_code};
use crate::plain::errors;
use crate::plain::style::{COLUMNS, within};
use anstream::AutoStream;
use files::{self, OutputTarget};
use linkage::error::{Error, ErrorKind, Result};
use terminal_size::{Height, Width, terminal_size_of};

/// Path for results, or `-` for standard output.
/// Scenario files are refused, because a shell expands `-o scenarios/*.toml` to several scenario names.
/// The results would then overwrite the first scenario.
pub(super) fn target(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.extension().is_some_and(|extension| extension == "toml") {
        return Err(sentences::THIS_IS_A_SCENARIO_FILE_AND_WOULD.into());
    }
    writable(path)
}

/// Path for a scenario that the command makes, or `-` for standard output. An existing file is replaced only if an
/// earlier `linkproof synthesize` has written it.
pub(super) fn scenario(text: &str) -> std::result::Result<PathBuf, String> {
    let path = writable(text.into())?;
    let is_new = fs::metadata(&path).map_or(true, |old| !old.is_file() || old.len() == 0);
    let is_ours = || {
        let text = scenario::source::text_of(&path).unwrap_or_default();
        text.lines().next().is_some_and(|head| head.contains("linkproof synthesize"))
    };
    match is_new || is_ours() {
        true => Ok(path),
        false => Err(sentences::THIS_FILE_IS_NOT_OF_SYNTHESIZE.into()),
    }
}

/// A writable path, or `-` for standard output.
/// Obstacles to writing are reported before any work is done.
pub(super) fn writable(path: PathBuf) -> std::result::Result<PathBuf, String> {
    if !is_standard(&path) {
        files::may_write(&path)?;
    }
    Ok(path)
}

/// A word of a command line, quoted for a shell.
pub(super) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.into()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// Whether a path means standard output: `-`, or `-.ENDING` for a drawing.
pub(super) fn is_standard(path: &Path) -> bool {
    path == Path::new("-") || path.to_str().is_some_and(|path| path.starts_with("-.") && !path.contains('/'))
}

/// Refuses two options with the same file, because the second result would replace the first.
pub(super) fn apart(targets: &[(&str, &Path)]) -> Result<()> {
    let place = |path: &Path| match path.starts_with("/dev") || is_standard(path) {
        true => path.to_path_buf(),
        false => fs::canonicalize(path).or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_path_buf()),
    };
    // The command chooses the name for an empty path.
    let is_file = |to: &Path| to != Path::new("/dev/null") && to != Path::new("");
    let files: Vec<_> =
        targets.iter().filter(|(_, to)| is_file(to)).map(|(option, to)| (option, to, place(to))).collect();
    for (k, (one, to, place)) in files.iter().enumerate() {
        if let Some((other, ..)) = files[k + 1..].iter().find(|(.., other)| place == other) {
            let message = match one == other {
                true => sentences::two_results_go_to(&to.display()),
                false => sentences::and_both_name(one, other, &to.display()),
            };
            return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_TWO_FILES_OR_LEAVE_ONE_OF_THE_TWO));
        }
    }
    Ok(())
}

/// Like [`target`], but the directory may be missing; the command creates it.
pub(super) fn page(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.parent().filter(|parent| *parent != Path::new("") && !parent.exists()) {
        Some(parent) => directory(&parent.to_string_lossy()).map(|_| path),
        None => target(text),
    }
}

/// A directory for results. The command creates the directory when it writes the first result.
pub(super) fn directory(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    files::may_fill(&path)?;
    Ok(path)
}

/// Writes text to a file that the caller named, or to standard output for `-`.
pub(super) fn write(text: &str, to: &Path) -> Result<()> {
    write_bytes(text.as_bytes(), to)
}

/// Writes bytes to a file that the caller named, or to standard output for `-`.
pub(super) fn write_bytes(bytes: &[u8], to: &Path) -> Result<()> {
    match is_standard(to) {
        true => printed(|out| out.write_all(bytes)),
        false => put(&OutputTarget::Named(to), to, Some(bytes.len() as u64), |out| out.write_all(bytes)),
    }
}

/// Lets `fill` write piece by piece to a file that the caller named, or to standard output for `-`.
pub(super) fn stream(to: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    if is_standard(to) { printed(fill) } else { put(&OutputTarget::Named(to), to, None, fill) }
}

/// Writes text with its seal, a checksum, to a file whose name the program chose.
/// An existing file is replaced if its text still matches its seal; otherwise the function returns an error.
pub(super) fn make(text: &str, to: &Path) -> Result<()> {
    make_by(files::sealed(text, to).as_bytes(), to, &files::is_sealed)
}

/// Writes a file to the working directory like [`make`], then prints its name, because the user did not choose it.
pub(super) fn make_here(text: &str, name: &str) -> Result<()> {
    make(text, Path::new(name))?;
    print(&format!("{name}\n"))
}

/// Writes bytes, unchanged, to a file whose name the program chose.
/// An existing file is replaced if `is_ours` accepts its bytes; otherwise the function returns an error.
pub(super) fn make_by(bytes: &[u8], to: &Path, is_ours: &dyn Fn(&[u8]) -> bool) -> Result<()> {
    put(&OutputTarget::Made(to, is_ours), to, Some(bytes.len() as u64), |out| out.write_all(bytes))
}

/// Like [`make_by`], but also creates the file's directory.
pub(super) fn make_below(bytes: &[u8], to: &Path, is_ours: &dyn Fn(&[u8]) -> bool) -> Result<()> {
    to.parent().map_or(Ok(()), fs::create_dir_all).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::cannot_make_the_directory_of(&to.display(), &error))
            .help(sentences::CHECK_THAT_THIS_DIRECTORY_MAY)
    })?;
    make_by(bytes, to, is_ours)
}

/// Checks in advance that [`make`] may write to these paths.
/// Returns an error if a file exists that [`make`] may not replace.
pub(super) fn may_make(places: &[PathBuf]) -> Result<()> {
    places.iter().try_for_each(|to| may_make_by(to, &files::is_sealed))
}

/// Checks in advance that [`make_by`] may write to this path.
pub(super) fn may_make_by(to: &Path, is_ours: &dyn Fn(&[u8]) -> bool) -> Result<()> {
    let Some(why) = OutputTarget::Made(to, is_ours).in_the_way() else { return Ok(()) };
    let error = io::Error::new(io::ErrorKind::AlreadyExists, why);
    Err(files::unwritten(&to.display().to_string(), &error, None, ""))
}

fn put(
    target: &OutputTarget,
    to: &Path,
    needs: Option<u64>,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    files::replace(target, |mut file| fill(&mut file)).map_err(|error: io::Error| {
        let usual = sentences::CHECK_THAT_THE_DIRECTORY_EXISTS;
        files::unwritten(&to.display().to_string(), &error, needs, usual)
    })
}

/// Writes text for people to standard output, wrapped to the width of the terminal.
/// A reader that has closed the pipe (`| head`) is not an error.
pub(super) fn print(text: &str) -> Result<()> {
    data(&within(text, width()))
}

/// Writes text for programs to standard output, without changes.
pub(super) fn data(text: &str) -> Result<()> {
    printed(|out| out.write_all(text.as_bytes()))
}

fn printed(fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let mut out = io::stdout().lock();
    match fill(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(files::unwritten("standard output", &error, None, sentences::CHECK_WHERE_IT_GOES_TO))
        }
        _ => Ok(()),
    }
}

/// Smallest width to which text is wrapped, in columns. In a narrower terminal, the terminal itself wraps the lines.
const LEAST: usize = 60;

/// Columns of the terminal. If standard output is not a terminal: the environment variable `COLUMNS`, otherwise 80.
pub(super) fn columns() -> usize {
    width().unwrap_or(COLUMNS)
}

/// Columns of the terminal; `None` if standard output is not a terminal and `COLUMNS` is not set.
pub(super) fn width() -> Option<usize> {
    let out = io::stdout();
    columns_of(if out.is_terminal() { terminal_size_of(&out) } else { None })
}

fn columns_of(terminal: Option<(Width, Height)>) -> Option<usize> {
    let set = || std::env::var("COLUMNS").ok()?.trim().parse().ok();
    terminal.map(|(Width(columns), _)| usize::from(columns)).or_else(set).map(|columns| columns.max(LEAST))
}

/// Writes a report to standard output.
/// On a terminal, colours are kept unless NO_COLOR is set; elsewhere they are kept only with CLICOLOR_FORCE.
pub(super) fn report(report: &str) -> Result<()> {
    let choice = AutoStream::choice(&io::stdout());
    let mut text = AutoStream::new(Vec::new(), choice);
    // Writing to a vector never fails.
    let _ = text.write_all(report.as_bytes());
    print(&String::from_utf8_lossy(&text.into_inner()))
}

/// Outcome of a command or of a part of a command: success, an exit code, or an error that is shown.
pub(super) trait End {
    /// The exit code.
    fn code(self) -> u8;
}

impl End for () {
    fn code(self) -> u8 {
        exit_code::AGREE
    }
}

impl End for u8 {
    fn code(self) -> u8 {
        self
    }
}

impl<T: End> End for Result<T> {
    fn code(self) -> u8 {
        self.map_or_else(
            |error| {
                show(&error);
                exit_code::BAD_INPUT
            },
            End::code,
        )
    }
}

/// Makes a directory for results; messages name the `option` that requested the directory.
pub(super) fn make_directory(path: &Path, option: &str, help: &str) -> Result<()> {
    fs::create_dir_all(path).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::cannot_be_made(&path.display(), &error)).key(option).help(help)
    })
}

/// Refuses an option.
pub(super) fn refused<T>(option: &str, message: impl Into<String>, help: &str) -> Result<T> {
    Err(Error::new(ErrorKind::Input, message).key(option).help(help))
}

/// Shows a line on standard error.
pub(super) fn note(text: &str) {
    say(&format!("note: {text}"));
}

/// Shows a warning on standard error: the reason why a result is incomplete.
pub(super) fn warn(error: &Error) {
    say(&errors::warning(error, advice::told));
}

/// Shows an error on standard error: the line of the file, the invalid value, and the remedy.
pub(super) fn show(error: &Error) {
    say(&errors::text(error, advice::told));
}

fn say(text: &str) {
    let mut stream = io::stderr();
    let width = columns_of(if stream.is_terminal() { terminal_size_of(&stream) } else { None });
    // If standard error is closed, an error cannot be reported, so a failure to write is ignored.
    let _ = writeln!(stream, "{}", within(text, width));
}
