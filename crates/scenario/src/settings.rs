//! `[channels]`, `[engine]` and `[tolerances]`: the wanted channels, the engine's settings and the limits of judgement.

use super::reader::{Sign, Table};
use super::unit::{ANGLE, TIME};
use super::words::{choice, nearest, suggestion};
use linkage::case::Case;
use linkage::drive::Drive;
use linkage::error::{ErrorKind, Result};
use linkage::trajectory::{Channel, Stage};

/// The words of `[channels]`; there is one at least.
pub fn wanted(table: &mut Table) -> Result<Vec<String>> {
    let names = table.strings("want")?;
    table.finish()?;
    let stages = || Stage::ALL.into_iter().map(Stage::name);
    if names.is_empty() {
        let help =
            format!("name at least one, or leave the section out to get all; {}", suggestion("", stages(), "\""));
        return Err(table.wrong(ErrorKind::Input, "want", "nothing is wanted").help(help));
    }
    Ok(names)
}

/// The case with the channels wanted that the words of `[channels]` ask for.
pub fn wanting(table: &Table, names: &[String], case: Case) -> Result<Case> {
    let channels =
        called(&case, names).map_err(|(message, help)| table.wrong(ErrorKind::Input, "want", message).help(help))?;
    Ok(case.wanting_only(&channels))
}

/// The channels that words ask for.
///
/// # Errors
/// What is wrong with a word, and the way out.
pub fn called(case: &Case, words: &[String]) -> std::result::Result<Vec<Channel>, (String, String)> {
    let mut channels = Vec::new();
    for word in words {
        let own = case.channels_called(word);
        if own.is_empty() {
            let known = case.channel_words();
            let stages = Stage::ALL.into_iter().map(Stage::name);
            let ends = known.iter().find(|known| known.split_once('.').is_some_and(|(_, name)| name == word));
            let near = ends.map(String::as_str).or_else(|| nearest(word, known.iter().map(String::as_str)));
            let help = match near {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => format!(
                    "ask for {}, for a subject such as \"{}\", for its stage, \"{}.positions\", or for one channel",
                    choice(stages, "\""),
                    known[Stage::ALL.len()],
                    known[Stage::ALL.len()],
                ),
            };
            return Err((format!("there are no channels \"{word}\""), help));
        }
        channels.extend(own);
    }
    Ok(channels)
}

/// Settings of the engine in a scenario, besides its step. What is missing is found by the proof, or the engine's
/// default. The format itself knows no engine: names are looked up where engines are known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EngineKeys {
    /// Name of the engine.
    pub name: Option<String>,
    /// Sweeps of the iteration in a step.
    pub sweeps: Option<usize>,
    /// Number of substeps into which the engine divides a step.
    pub substeps: Option<usize>,
    /// Route by which reactions and balancing moment are computed.
    pub route: Option<String>,
    /// How often the engine's state is extrapolated to step zero.
    pub extrapolated: Option<usize>,
}

/// Step of the engine (s), if it is given, and its other keys. What is not given is found by the proof.
pub fn engine(table: &mut Table, drive: &Drive) -> Result<(Option<f64>, EngineKeys)> {
    let keys = EngineKeys {
        name: table.optional_string("name")?,
        sweeps: count(table, "sweeps")?,
        substeps: count(table, "substeps")?,
        route: table.optional_string("route")?,
        extrapolated: times(table)?,
    };
    Ok((engine_step(table, drive)?, keys))
}

/// A whole number greater than zero.
fn count(table: &mut Table, key: &str) -> Result<Option<usize>> {
    let Some(number) = table.optional_integer(key)? else { return Ok(None) };
    match usize::try_from(number) {
        Ok(count) if count > 0 => Ok(Some(count)),
        _ => {
            let error = table.wrong(ErrorKind::Input, key, format!("found {number}, but an engine needs at least one"));
            table.instead(None, error.help("give a whole number greater than zero"))
        }
    }
}

/// How often the state is extrapolated: `true` once, `false` not at all, or a number.
fn times(table: &mut Table) -> Result<Option<usize>> {
    let key = "extrapolated";
    if table.is_boolean(key) {
        return Ok(table.optional_boolean(key)?.map(usize::from));
    }
    let Some(number) = table.optional_integer(key)? else { return Ok(None) };
    match usize::try_from(number) {
        Ok(times) if times <= MOST_TIMES => Ok(Some(times)),
        _ => {
            let error = table.wrong(ErrorKind::Input, key, format!("found {number} extrapolations"));
            table.instead(None, error.help(format!("give a whole number from 0 to {MOST_TIMES}, or true for 1")))
        }
    }
}

/// More extrapolations than this need steps too fine to run.
const MOST_TIMES: usize = 8;

/// Step of the engine (s), if it is given.
fn engine_step(table: &mut Table, drive: &Drive) -> Result<Option<f64>> {
    let time = table.optional_quantity("dt", &TIME, Sign::Positive)?;
    let angle = table.optional_quantity("step", &ANGLE, Sign::NotZero)?;
    table.finish()?;
    let omega = drive.top_speed();
    let dt = match (time, angle) {
        (Some(dt), None) => dt,
        (None, Some(angle)) => (angle / omega).abs(),
        (Some(_), Some(_)) => {
            let error = table.wrong(ErrorKind::Input, "step", "the engine's step is given twice");
            return Err(error.help("keep either `dt` (a time) or `step` (a crank angle)"));
        }
        (None, None) => return Ok(None),
    };
    if dt.is_finite() && dt > 0.0 {
        Ok(Some(dt))
    } else {
        Err(table.fault(format!("the engine's step would be {dt} s")).help("check the step and `drive.speed`"))
    }
}

/// Default share for [`engine_rel`]: chosen, not derived.
pub const ENGINE_REL: f64 = 1e-2;

/// Largest bound on the error of the engine, as a share of a channel's scale, at which agreement is still a proof.
pub fn engine_rel(table: &mut Table) -> Result<f64> {
    let share = table.optional_number("engine_rel")?.unwrap_or(ENGINE_REL);
    table.finish()?;
    if share > 0.0 && share < 1.0 {
        return Ok(share);
    }
    let message = format!("found {share}, but this is a share of a channel's scale");
    Err(table.wrong(ErrorKind::Input, "engine_rel", message).help("give a number between 0 and 1, such as 1e-2"))
}
