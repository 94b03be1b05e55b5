//! What a peer says: its ways and its answer as JSON, its solution as CSV.

use std::ops::RangeInclusive;

use serde_json::{Map, Value};

use crate::bench::{Answer, Effort, Way};
use columns::Twice;
use files::visible;

/// Most ways that a peer may have.
const MOST: usize = 200;
/// Most things that a peer may count.
const COUNTED: usize = 50;
/// Most columns of its table.
const COLUMNS: usize = 100_000;
/// Times that a run can take (s): no clock tells shorter ones, and nobody waits for longer ones.
const TIMES: RangeInclusive<f64> = 1e-12..=1e9;

/// The last line of a program's output, as JSON: libraries print what they like before it.
fn last(output: &str) -> Result<Value, String> {
    let line =
        output.lines().rev().find(|line| !line.trim().is_empty()).ok_or("it wrote nothing to standard output")?;
    serde_json::from_str(line.trim()).map_err(|error| format!("the last line of its output is no JSON: {error}"))
}

fn word(object: &Map<String, Value>, key: &str) -> Option<String> {
    object.get(key).and_then(Value::as_str).map(visible)
}

/// The refusal in a peer's words, if it is one.
fn refused(value: &Value) -> Option<String> {
    value.as_object().and_then(|object| word(object, "refused"))
}

/// Ways in which a peer wants to be run.
///
/// # Errors
/// Why they are none.
pub(super) fn ways(output: &str) -> Result<Vec<Way>, String> {
    let value = last(output)?;
    if let Some(reason) = refused(&value) {
        return Err(format!("it refuses: {reason}"));
    }
    let list = value.as_array().ok_or("its ways are no JSON array")?;
    if list.is_empty() || list.len() > MOST {
        return Err(format!("it has {} ways, and 1 to {MOST} are possible", list.len()));
    }
    let way = |value: &Value| {
        let object = value.as_object()?;
        Some(Way { name: word(object, "name")?, resolution: word(object, "resolution")?, told: value.to_string() })
    };
    list.iter().map(|value| way(value).ok_or_else(|| format!("the way {value} has no name or no resolution"))).collect()
}

/// A peer's answer, from its output and its table.
///
/// # Errors
/// Why it is none.
pub(super) fn answer(output: &str, table: impl FnOnce() -> Result<String, String>) -> Result<Answer, String> {
    let value = last(output)?;
    if let Some(reason) = refused(&value) {
        return Err(format!("it refuses: {reason}"));
    }
    let object = value.as_object().ok_or("its answer is no JSON object")?;
    let seconds = match object.get("seconds") {
        Some(Value::Array(times)) => times.iter().map(seconds).collect::<Result<_, _>>()?,
        Some(one) => vec![seconds(one)?],
        None => return Err("its answer has no \"seconds\"".into()),
    };
    let effort = Effort(counts(object.get("work"))?);
    Ok(Answer { version: word(object, "version").unwrap_or_default(), columns: columns(&table()?)?, seconds, effort })
}

/// A time that a program can have measured (s).
fn seconds(value: &Value) -> Result<f64, String> {
    // A coarse clock says zero; such a time is left out.
    let found = value.as_f64().filter(|seconds| TIMES.contains(seconds) || *seconds == 0.0);
    found.ok_or_else(|| {
        let [least, most] = [TIMES.start(), TIMES.end()];
        format!("its time is {value}, and {least:e} s to {most:e} s can be measured")
    })
}

/// What a program has counted; nothing if it says nothing of it.
fn counts(work: Option<&Value>) -> Result<Vec<(String, u64)>, String> {
    let Some(work) = work.filter(|work| !work.is_null()) else { return Ok(Vec::new()) };
    let all = work.as_object().ok_or("its \"work\" is no JSON object")?;
    if all.len() > COUNTED {
        return Err(format!("it counts {} things, and at most {COUNTED} are shown", all.len()));
    }
    let count = |(name, times): (&String, &Value)| match times.as_u64() {
        Some(count) => Ok((visible(name), count)),
        None => Err(format!("its count of {name} is {times}, which is no whole number")),
    };
    all.iter().map(count).collect()
}

/// The columns of a table.
fn columns(table: &str) -> Result<Vec<(String, Vec<f64>)>, String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let header = reader.headers().map_err(|error| format!("its table cannot be read: {error}"))?.clone();
    if header.len() > COLUMNS {
        return Err(format!("its table has {} columns, and at most {COLUMNS} are read", header.len()));
    }
    if let Some(twice) = Twice::of(&header) {
        return Err(format!("its table: {twice}"));
    }
    let mut columns: Vec<(String, Vec<f64>)> =
        header.iter().map(|name| (name.trim().to_string(), Vec::new())).collect();
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(|error| format!("row {} of its table: {error}", row + 1))?;
        for ((name, values), text) in columns.iter_mut().zip(&record) {
            let value = text.trim().parse().map_err(|_| {
                format!("row {} of {name} is \"{}\"", row + 1, text.chars().take(20).collect::<String>())
            })?;
            values.push(value);
        }
    }
    Ok(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_is_the_last_line_and_a_table() {
        let output =
            "a library greets\n{\"seconds\": [2e-3, 1e-3], \"work\": {\"steps\": 7}, \"version\": \"x 1\"}\n\n";
        let found = answer(output, || Ok("t_s,link.a.angle_rad\n0,1\n0.5,nan\n".into())).unwrap();
        assert_eq!(
            (found.seconds, found.version.as_str(), found.effort.of("steps")),
            (vec![2e-3, 1e-3], "x 1", Some(7))
        );
        assert_eq!(found.columns[0], ("t_s".to_string(), vec![0.0, 0.5]));
        assert!(found.columns[1].1[1].is_nan());
    }

    #[test]
    fn everything_else_is_a_reason() {
        let table = || Ok("t_s\n0\n".to_string());
        for (output, reason) in [
            ("", "nothing"),
            ("hello", "no JSON"),
            ("[]", "no JSON object"),
            ("{}", "no \"seconds\""),
            ("{\"refused\": \"a slider\"}", "refuses: a slider"),
        ] {
            let found = answer(output, table).unwrap_err();
            assert!(found.contains(reason), "{output}: {found}");
        }
        for bad in ["t_s\nx\n", "t_s,a\n0\n", "t_s,a,a\n0,1,2\n"] {
            assert!(answer("{\"seconds\": 1}", || Ok(bad.into())).is_err(), "{bad}");
        }
        for (output, reason) in
            [("[]", "0 ways"), ("[1]", "no name"), ("{}", "no JSON array"), ("7\n", "no JSON array")]
        {
            let found = ways(output).unwrap_err();
            assert!(found.contains(reason), "{output}: {found}");
        }
        let found = ways("[{\"name\": \"RK4\", \"resolution\": \"1 ms\", \"dt\": 0.001}]").unwrap();
        assert_eq!((found[0].name.as_str(), found[0].told.contains("0.001")), ("RK4", true));
    }
}
