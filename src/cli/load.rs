//! The common first step of every command: reads a scenario from a file or from standard input.

use crate::sentences;
use std::borrow::Cow;
use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::OnceLock;

use super::grid::GridArgs;
use super::{number, output};
use linkage::error::{Error, ErrorKind, Result};
use scenario::source::text_of;
use scenario::{Draft, Scenario, StartRequest, Undecided};

/// A start that differs from the start in the file.
#[derive(Clone, Debug, clap::Args)]
#[group(skip)]
pub(super) struct StartArgs {
    /// Start a group in a different assembly mode from that of the file. A number as MODE means the configuration with
    /// this number in `inspect --modes`. Published numbers are valid only for the modes of the file; with other modes
    /// they are omitted. May be given for several groups
    #[arg(long, value_name = "LINK,LINK=MODE")]
    pub(super) mode: Vec<String>,
    /// Crank angle (deg), or slide (mm), at t = 0, measured as in the scenario. Replaces the `crank` of the scenario's
    /// `[start]`, or the start of its first drive; published numbers are kept if the new start lies on the same branch
    /// as the start in the file
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = number::finite)]
    pub(super) start_crank_deg: Option<f64>,
    /// Value of a parameter by its key, or of a number of the file by its path (links.crank.mass_kg); may be given several
    /// times
    #[arg(long, value_name = "KEY=NUMBER", value_parser = setting)]
    pub(super) set: Vec<(String, f64)>,
}

impl StartArgs {
    /// Reads a scenario with this start, on the given grid or, without a given grid, on the file's grid.
    pub(super) fn load(&self, file: &Path, grid: &GridArgs) -> Result<Scenario> {
        self.load_as(file, grid, StartRequest::default())
    }

    /// Like `load`, with the additional requests in `besides`.
    pub(super) fn load_as(&self, file: &Path, grid: &GridArgs, besides: StartRequest) -> Result<Scenario> {
        each_once(&self.set, "--set")?;
        grid.on(as_asked(file, &self.request(grid, besides))?)
    }

    /// The request of this start and the given grid, with the additional requests in `besides`.
    pub(super) fn request(&self, grid: &GridArgs, besides: StartRequest) -> StartRequest {
        StartRequest {
            modes: self.mode.clone(),
            crank: self.start_crank_deg,
            is_shown: true,
            without_grid: grid.is_given(),
            set: self.set.clone(),
            ..besides
        }
    }
}

/// The scenario with only the channels that `words` select; unchanged if there are no words.
pub(super) fn only(scenario: Scenario, words: &[String]) -> Result<Scenario> {
    if words.is_empty() { Ok(scenario) } else { scenario.only(words).map_err(|error| error.key("--only")) }
}

/// Reads `KEY=NUMBER`.
pub(super) fn setting(text: &str) -> std::result::Result<(String, f64), String> {
    let (key, value) = text.split_once('=').ok_or(sentences::EXPECTED_KEY_NUMBER_SUCH_AS_A_MM)?;
    Ok((key.trim().into(), number::decimal(value, sentences::A_FINITE_NUMBER_BEHIND_THE_SUCH_AS_A_MM)?))
}

/// Refuses two numbers for the same key.
pub(super) fn each_once(numbers: &[(String, f64)], option: &str) -> Result<()> {
    let mut keys: Vec<&str> = numbers.iter().map(|(key, _)| key.as_str()).collect();
    keys.sort_unstable();
    let Some(twice) = keys.windows(2).find(|pair| pair[0] == pair[1]) else { return Ok(()) };
    let error = Error::new(ErrorKind::Input, sentences::has_two_numbers(&twice[0]));
    Err(error.key(option).help(sentences::GIVE_ONE_NUMBER))
}

/// Reads a scenario without changes.
pub(super) fn plain(file: &Path) -> Result<Scenario> {
    as_asked(file, &StartRequest::default())
}

/// The nominal motion of a scenario. For a free motion, prints `note`.
pub(super) fn nominal(file: &Path, note: &str) -> Result<Scenario> {
    let scenario = plain(file)?;
    if scenario.case.is_free() {
        output::note(note);
    }
    Ok(scenario.nominal())
}

/// Reads a scenario and starts its groups in the given `modes`.
pub(super) fn load(file: &Path, modes: &[String]) -> Result<Scenario> {
    as_asked(file, &StartRequest { modes: modes.to_vec(), ..StartRequest::default() })
}

pub(super) fn as_asked(file: &Path, asked: &StartRequest) -> Result<Scenario> {
    Scenario::parse_as(&text(file)?, named(file), asked).map_err(|error| of_mode(asked, error))
}

/// Reads a scenario like `load`, but also accepts a file that leaves configurations open, so that they can be listed.
/// Also returns the groups whose configuration the file leaves open.
pub(super) fn to_list(file: &Path, asked: &StartRequest) -> Result<(Scenario, Vec<Undecided>)> {
    Scenario::parse_to_list(&text(file)?, named(file), asked).map_err(|error| of_mode(asked, error))
}

/// The readable part of a scenario file whose mechanism is incomplete or cannot be assembled.
pub(super) fn draft(file: &Path, asked: &StartRequest) -> Result<Draft> {
    Draft::parse(&text(file)?, named(file), asked)
}

/// If a requested mode probably caused the error, adds the option `--mode` as the location of the error.
/// An error that a requested mode causes has no location in the file.
fn of_mode(asked: &StartRequest, error: Error) -> Error {
    let is_asked = !asked.modes.is_empty() && error.place().is_none() && error.kind() != ErrorKind::Io;
    if is_asked { error.key("--mode") } else { error }
}

/// Path that means standard input.
const DASH: &str = "-";

/// Name of standard input in messages.
/// If a scenario comes from standard input, its file names are relative to the working directory.
const NAME: &str = "<standard input>";

/// Whether a path means standard input.
pub(super) fn is_standard_input(path: &Path) -> bool {
    path == Path::new(DASH)
}

/// The name of the path in messages.
pub(super) fn named(path: &Path) -> &Path {
    if is_standard_input(path) { Path::new(NAME) } else { path }
}

/// The text of a file, or of standard input, which is read once.
pub(super) fn text(file: &Path) -> Result<Cow<'static, str>> {
    if !is_standard_input(file) {
        return text_of(file).map(Cow::Owned);
    }
    static TEXT: OnceLock<Result<String>> = OnceLock::new();
    let read = || {
        if io::stdin().is_terminal() {
            output::note(sentences::THE_SCENARIO_IS_READ_FROM_STANDARD);
        }
        files::text_from(io::stdin().lock()).map_err(|error| {
            let usual = sentences::GIVE_A_SCENARIO_AS_IN_LINKPROOF;
            Error::new(ErrorKind::Io, sentences::cannot_be_read(&NAME, &error)).help(files::way_out(&error, usual))
        })
    };
    TEXT.get_or_init(read).as_ref().map(|text| Cow::Borrowed(text.as_str())).map_err(Error::clone)
}

/// The text of a file of another program, or of standard input.
pub(super) fn source(file: &Path) -> Result<Cow<'static, str>> {
    if is_standard_input(file) {
        return text(file);
    }
    let read = files::read_text(file).map(Cow::Owned);
    read.map_err(|error| {
        let way = files::way_out(&error, sentences::GIVE_AN_ADDRESS_OR_A_FILE);
        Error::new(ErrorKind::Io, sentences::the_source_cannot_be_read(&file.display(), &error)).help(way)
    })
}

/// Refuses to write settings if the scenario comes from standard input.
pub(super) fn refuse_writing(path: &Path) -> Result<()> {
    if !is_standard_input(path) {
        return Ok(());
    }
    output::refused("--write", sentences::settings_cannot_be_written_to(&NAME), sentences::SAVE_THE_SCENARIO_TO_A_FILE)
}
