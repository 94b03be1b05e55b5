//! Output of a peer: its methods and its answer as JSON, its solution as CSV.

use crate::sentences;
use std::ops::RangeInclusive;

use serde_json::{Map, Value};

use crate::bench::{Answer, RunEffort, Way};
use columns::Twice;
use files::visible;

/// Largest number of methods of a peer.
const MOST: usize = 200;
/// Largest number of named counters (`work`) in a peer's answer.
const COUNTED: usize = 50;
/// Largest number of columns in a peer's table.
const COLUMNS: usize = 100_000;
/// Range of plausible run times (s). Shorter times are below the resolution of clocks.
/// Longer times are too long for a measurement.
const TIMES: RangeInclusive<f64> = 1e-12..=1e9;

/// The last line of a program's output, as JSON. The program's libraries may print other lines before the last line.
fn last(output: &str) -> Result<Value, String> {
    let line =
        output.lines().rev().find(|line| !line.trim().is_empty()).ok_or(sentences::IT_WROTE_NOTHING_TO_STANDARD)?;
    serde_json::from_str(line.trim()).map_err(|error| sentences::the_last_line_of_its_output(&error))
}

fn word(object: &Map<String, Value>, key: &str) -> Option<String> {
    object.get(key).and_then(Value::as_str).map(visible)
}

/// The peer's reason for refusing to solve; `None` if the peer has not refused.
fn refused(value: &Value) -> Option<String> {
    value.as_object().and_then(|object| word(object, "refused"))
}

/// The methods that a peer offers.
///
/// # Errors
/// The reason why the output is not a list of methods.
pub(super) fn ways(output: &str) -> Result<Vec<Way>, String> {
    let value = last(output)?;
    if let Some(reason) = refused(&value) {
        return Err(sentences::it_refuses(&reason));
    }
    let list = value.as_array().ok_or(sentences::ITS_WAYS_ARE_NO_JSON_ARRAY)?;
    if list.is_empty() || list.len() > MOST {
        return Err(sentences::it_has_ways_and_to_are_possible(&list.len(), &MOST));
    }
    let way = |value: &Value| {
        let object = value.as_object()?;
        Some(Way { name: word(object, "name")?, resolution: word(object, "resolution")?, told: value.to_string() })
    };
    list.iter().map(|value| way(value).ok_or_else(|| sentences::the_way_has_no_name_or_no_resolution(&value))).collect()
}

/// A peer's answer, from its output and its table.
///
/// # Errors
/// The reason why the output is not an answer.
pub(super) fn answer(output: &str, table: impl FnOnce() -> Result<String, String>) -> Result<Answer, String> {
    let value = last(output)?;
    if let Some(reason) = refused(&value) {
        return Err(sentences::it_refuses(&reason));
    }
    let object = value.as_object().ok_or(sentences::ITS_ANSWER_IS_NO_JSON_OBJECT)?;
    let seconds = match object.get("seconds") {
        Some(Value::Array(times)) => times.iter().map(seconds).collect::<Result<_, _>>()?,
        Some(one) => vec![seconds(one)?],
        None => return Err(sentences::ITS_ANSWER_HAS_NO_SECONDS.into()),
    };
    let effort = RunEffort(counts(object.get("work"))?);
    Ok(Answer { version: word(object, "version").unwrap_or_default(), columns: columns(&table()?)?, seconds, effort })
}

/// Reads a measured time (s); an implausible time is an error.
fn seconds(value: &Value) -> Result<f64, String> {
    // Zero is accepted, because a coarse clock may give zero. The caller ignores a time of zero.
    let found = value.as_f64().filter(|seconds| TIMES.contains(seconds) || *seconds == 0.0);
    found.ok_or_else(|| {
        let [least, most] = [TIMES.start(), TIMES.end()];
        sentences::its_time_is_and_to_can_be_measured(&value, &format_args!("{least:e}"), &format_args!("{most:e}"))
    })
}

/// Counts reported by a program; empty if it reports none.
fn counts(work: Option<&Value>) -> Result<Vec<(String, u64)>, String> {
    let Some(work) = work.filter(|work| !work.is_null()) else { return Ok(Vec::new()) };
    let all = work.as_object().ok_or(sentences::ITS_WORK_IS_NO_JSON_OBJECT)?;
    if all.len() > COUNTED {
        return Err(sentences::it_counts_things_and_at_most(&all.len(), &COUNTED));
    }
    let count = |(name, times): (&String, &Value)| match times.as_u64() {
        Some(count) => Ok((visible(name), count)),
        None => Err(sentences::its_count_of_is_which_is_no_whole(&name, &times)),
    };
    all.iter().map(count).collect()
}

/// The columns of a table.
fn columns(table: &str) -> Result<Vec<(String, Vec<f64>)>, String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let header = reader.headers().map_err(|error| sentences::its_table_cannot_be_read(&error))?.clone();
    if header.len() > COLUMNS {
        return Err(sentences::its_table_has_columns_and_at_most(&header.len(), &COLUMNS));
    }
    if let Some(twice) = Twice::of(&header) {
        return Err(sentences::its_table(&twice));
    }
    let mut columns: Vec<(String, Vec<f64>)> =
        header.iter().map(|name| (name.trim().to_string(), Vec::new())).collect();
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(|error| sentences::row_of_its_table(&(row + 1), &error))?;
        for ((name, values), text) in columns.iter_mut().zip(&record) {
            let value = text
                .trim()
                .parse()
                .map_err(|_| sentences::row_of_is(&(row + 1), &name, &(text.chars().take(20).collect::<String>())))?;
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
    fn any_other_output_is_a_failure_with_a_reason() {
        let table = || Ok("t_s\n0\n".to_string());
        for (output, reason) in [
            ("", "empty"),
            ("hello", "not JSON"),
            ("[]", "not a JSON object"),
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
            [("[]", "0 settings"), ("[1]", "no name"), ("{}", "is not a JSON array"), ("7\n", "is not a JSON array")]
        {
            let found = ways(output).unwrap_err();
            assert!(found.contains(reason), "{output}: {found}");
        }
        let found = ways("[{\"name\": \"RK4\", \"resolution\": \"1 ms\", \"dt\": 0.001}]").unwrap();
        assert_eq!((found[0].name.as_str(), found[0].told.contains("0.001")), ("RK4", true));
    }
}
