//! Accepted figures, in a file beside the scenario. People review this file, and later runs are compared with the
//! figures.
//!
//! The file is TOML but does not end in `.toml`, because `*.toml` files are scenarios.

use crate::sentences;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use toml_edit::Value;

use super::header::check_format;
use super::reader::TomlTable;
use super::source::Source;
use linkage::error::{Error, ErrorKind, Result};

/// Figures of a scenario's reference trajectory.
/// The figures come from a file, after people accepted them, or from the proof of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Accepted {
    /// Name of the scenario.
    pub scenario: String,
    /// The proof's verdict, as a word.
    pub verdict: String,
    /// Number of instants of the grid.
    pub instants: usize,
    /// The instants whose values are kept (s), in the order of the grid.
    pub times: Vec<f64>,
    /// Channels, in the order of columns.
    pub channels: Vec<AcceptedChannel>,
}

/// Figures of one channel, in its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct AcceptedChannel {
    /// Name of the channel.
    pub name: String,
    /// Bound on the error of every figure.
    pub bound: f64,
    /// Values at the instants `times` of [`Accepted`].
    pub at: Vec<f64>,
    /// Smallest value over the run.
    pub least: f64,
    /// Largest value over the run.
    pub greatest: f64,
    /// Root mean square; `None` for an angle, because its count of full turns has no fixed zero.
    pub rms: Option<f64>,
}

/// File name extension of the accepted figures. This extension replaces the extension of the scenario file.
const ENDING: &str = "accepted";

/// The file of a scenario's accepted figures.
#[must_use]
pub fn beside(scenario: &Path) -> PathBuf {
    scenario.with_extension(ENDING)
}

/// Reads the accepted figures in the file at `path`. The file must belong to the scenario called `name`.
/// `None` if the file does not exist.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be read.
/// [`ErrorKind::Input`] for a mistake in the file. The error states the position of the mistake.
pub fn load(path: &Path, name: &str) -> Result<Option<Accepted>> {
    let text = files::text(path).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::the_accepted_figures_cannot_be_read(&path.display(), &error))
            .help(sentences::RESTORE_THE_FILE_OR_DELETE)
    })?;
    text.map(|text| parse(&text, path, name)).transpose()
}

fn parse(text: &str, path: &Path, name: &str) -> Result<Accepted> {
    let source = Source::new(path, text);
    let tree = source.tree()?;
    read(&mut TomlTable::root(&source, &tree), name).map_err(|error| source.located(tree.get_ref(), error))
}

fn read(root: &mut TomlTable, name: &str) -> Result<Accepted> {
    if root.is_empty() {
        let error = root.fault(sentences::THE_FILE_HOLDS_NO_ACCEPTED);
        return Err(error.help(sentences::RESTORE_THE_FILE_OR_DELETE));
    }
    check_format(root)?;
    let scenario = root.string("scenario")?;
    if scenario != name {
        let help = sentences::MOVE_THE_FILE_TO_ITS_OWN;
        return root.refuse("scenario", sentences::these_are_accepted_figures_of_not_of(&scenario, &name), help);
    }
    let verdict = root.string("verdict")?;
    if !["agree", "disagree", "inconclusive"].contains(&verdict.as_str()) {
        let message = sentences::is_no_verdict(&verdict);
        return root.refuse("verdict", message, sentences::WRITE_AGREE_DISAGREE_OR_INCONCLUSIVE);
    }
    let instants = root.integer("instants")?;
    let message = || sentences::found_instants(&instants);
    let instants =
        usize::try_from(instants).or_else(|_| root.refuse("instants", message(), sentences::GIVE_THEIR_NUMBER))?;
    let times = root.numbers("times_s")?;
    let tables = root.tables("channels")?.into_iter();
    let channels: Vec<AcceptedChannel> = tables.map(|table| kept(table, times.len())).collect::<Result<_>>()?;
    root.finish()?;
    twice(root, &channels)?;
    Ok(Accepted { scenario, verdict, instants, times, channels })
}

fn kept(mut table: TomlTable, count: usize) -> Result<AcceptedChannel> {
    let name = table.string("name")?;
    let bound = table.number("bound")?;
    if bound < 0.0 {
        let message = sentences::the_bound_is_negative(&format_args!("{bound:e}"));
        return table.refuse("bound", message, sentences::ACCEPT_THE_FIGURES_ANEW);
    }
    let at = table.numbers("at")?;
    if at.len() != count {
        let help = sentences::GIVE_ONE_VALUE_FOR_EACH_OF_TIMES;
        return table.refuse("at", sentences::values_are_kept_for_instants(&at.len(), &count), help);
    }
    let (least, greatest) = (table.number("least")?, table.number("greatest")?);
    let rms = table.optional_number("rms")?;
    table.finish()?;
    Ok(AcceptedChannel { name, bound, at, least, greatest, rms })
}

/// Refuses a channel that is listed twice.
fn twice(root: &TomlTable, channels: &[AcceptedChannel]) -> Result<()> {
    let mut names: Vec<&str> = channels.iter().map(|own| own.name.as_str()).collect();
    names.sort_unstable();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        None => Ok(()),
        Some(pair) => {
            root.refuse("channels", sentences::the_channel_stands_twice(&pair[0]), sentences::DELETE_ONE_OF_THE_TWO)
        }
    }
}

/// The text of a file of accepted figures. Every number is written to one digit beyond the leading digit of its bound.
#[must_use]
pub fn text(accepted: &Accepted) -> String {
    let quoted = |text: &str| Value::from(text).to_string();
    let Accepted { scenario, verdict, instants, times, channels } = accepted;
    let mut text = format!(
        "# Accepted figures of {scenario}: reference values, each known to within `bound`, in the units of the names.\n\
         # How later runs are judged by these figures: docs/testing.md in the repository of linkproof.\n\
         format = {}\nscenario = {}\nverdict = {}\ninstants = {instants}\ntimes_s = {}\n",
        super::header::FORMAT,
        quoted(scenario),
        quoted(verdict),
        list(times, 0.0)
    );
    for AcceptedChannel { name, bound, at, least, greatest, rms } in channels {
        let [least, greatest] = [least, greatest].map(|figure| number(*figure, *bound));
        let _ = write!(
            text,
            "\n[[channels]]\nname = {}\nbound = {bound:e}\nat = {}\nleast = {least}\ngreatest = {greatest}\n",
            quoted(name),
            list(at, *bound)
        );
        if let Some(rms) = rms {
            let _ = writeln!(text, "rms = {}", number(*rms, *bound));
        }
    }
    text
}

fn list(values: &[f64], bound: f64) -> String {
    let values: Vec<String> = values.iter().map(|&value| number(value, bound)).collect();
    format!("[{}]", values.join(", "))
}

/// Numbers below this limit in magnitude are written with an exponent.
const SMALL: f64 = 1e-4;
/// Numbers of at least this magnitude are written with an exponent.
const LARGE: f64 = 1e9;
/// Number of significant digits of a double. Further digits carry no information.
const MOST_DIGITS: f64 = 17.0;

/// Formats a number. The rounding error of the text is at most a twentieth of `bound`, the number's bound.
/// If `bound` is zero, all digits are written.
/// If the text is read and written again, the text does not change.
fn number(value: f64, bound: f64) -> String {
    if bound == 0.0 {
        return format!("{value:?}");
    }
    let decimals = -(bound / 10.0).log10().floor();
    let magnitude = |value: f64| value.abs().log10().floor();
    // The first rounding may carry over and add a digit, as from 9.96 to 10.0. The number is therefore rounded a
    // second time. The second rounding cannot carry over again.
    let rounded = digits(value, magnitude(value) + decimals).parse().unwrap_or(value);
    if rounded == 0.0 {
        return "0.0".into();
    }
    let is_plain = (SMALL..LARGE).contains(&rounded.abs()) && decimals >= 1.0;
    match is_plain && magnitude(rounded) + decimals < MOST_DIGITS {
        true => format!("{rounded:.*}", decimals as usize),
        false => digits(rounded, magnitude(rounded) + decimals),
    }
}

/// A number with `after_the_first` digits after its first significant digit; zero if `after_the_first` is below -1.
fn digits(value: f64, after_the_first: f64) -> String {
    if value == 0.0 || after_the_first < -1.0 {
        return "0.0".into();
    }
    format!("{value:.*e}", after_the_first.clamp(0.0, MOST_DIGITS - 1.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_at_most_a_twentieth_of_the_bound() {
        for (value, bound, written) in [
            (1.234_567_89, 1e-3, "1.2346"),
            (1.234_567_89, 9.9e-4, "1.23457"),
            (-1234.567, 50.0, "-1.235e3"),
            (0.000_012_345, 1e-8, "1.2345e-5"),
            (3.0, 1e3, "0.0"),
            (99.0, 1e3, "1e2"),
            (-1e-20, 1e-12, "0.0"),
            (0.1, 0.0, "0.1"),
            (9.999_999_6e-6, 1e-11, "1.0000000e-5"),
            (6.02e23, 1e12, "6.020000000000e23"),
        ] {
            assert_eq!(number(value, bound), written, "{value:e} to {bound:e}");
        }
        for exponent in -30..30 {
            for (value, bound) in [(0.987_654_321, 1e-6), (-9.999_999_9, 3e-7), (1.0, 9.9e-3), (5.0, 1e-30)] {
                let size = 10f64.powi(exponent);
                let (value, bound) = (value * size, bound * size);
                let written = number(value, bound);
                let read: f64 = written.parse().unwrap();
                assert!(
                    (read - value).abs() <= 0.0501 * bound + 1e-16 * value.abs(),
                    "{value:e} to {bound:e}: {written}"
                );
                assert_eq!(number(read, bound), written, "{value:e} to {bound:e}");
            }
        }
    }

    #[test]
    fn accepted_figures_are_read_back_as_written() {
        let kept = |name: &str, rms| AcceptedChannel {
            name: name.into(),
            bound: 1e-9,
            at: vec![0.5],
            least: -1.0,
            greatest: 1.0,
            rms,
        };
        let accepted = Accepted {
            scenario: "four_bar".into(),
            verdict: "agree".into(),
            instants: 3,
            times: vec![0.1 + 0.2],
            channels: vec![kept("link.a.angle_rad", None), kept(&format!("joint.{}.fx_N", "B".repeat(100)), Some(0.7))],
        };
        let path = Path::new("four_bar.accepted");
        assert_eq!(parse(&text(&accepted), path, "four_bar").unwrap(), accepted);
        assert_eq!(beside(Path::new("a/four_bar.toml")), Path::new("a/four_bar.accepted"));
    }
}
