//! The results of a stress family as CSV: one row for each point, each solver or engine, and each group of channels.

use super::super::table_csv::as_csv;
use lab::stress::{StressFamily, StressOutcome};
use linkage::error::Result;

const HEADER: &str = "family dial sample party verdict group error bound channel used closure balance step_s sweeps \
                      extrapolated steps work done silent against why";

/// The table.
/// Errors and bounds are divided by the channel's scale; missing numbers are empty cells.
///
/// # Errors
/// [`ErrorKind::Io`](linkage::error::ErrorKind::Io) if the table cannot be written.
pub(crate) fn rows<'a>(family: &StressFamily, outcomes: impl Iterator<Item = &'a StressOutcome>) -> Result<String> {
    let mut rows = vec![HEADER.split(' ').map(String::from).collect::<Vec<_>>()];
    let width = rows[0].len();
    let some = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:e}"));
    let count = |value: Option<usize>| value.map_or_else(String::new, |value| value.to_string());
    for own in outcomes {
        let head = [family.name.to_string(), format!("{:e}", own.dial), own.sample.to_string()];
        if !own.refused.is_empty() {
            let mut row: Vec<String> = head.clone().into();
            row.extend(["", "refused"].map(String::from));
            row.resize(width - 1, String::new());
            row.push(own.refused.clone());
            rows.push(row);
        }
        for party in &own.parties {
            let tail = [
                some(party.closure),
                some(party.balance),
                some(party.step),
                count(party.sweeps),
                count(party.extrapolated),
                some(party.steps),
                some(party.work),
                party.done.iter().map(|(what, times)| format!("{times} {what}")).collect::<Vec<_>>().join(", "),
                party.silent.to_string(),
                party.against.clone(),
                party.why.clone(),
            ];
            let mut cells: Vec<[String; 5]> = party
                .reached
                .iter()
                .map(|own| {
                    let [error, bound, used] = [own.error, own.bound, own.used].map(|value| format!("{value:e}"));
                    [own.group.name().into(), error, bound, own.channel.clone(), used]
                })
                .collect();
            if cells.is_empty() {
                cells.push(std::array::from_fn(|_| String::new()));
            }
            for cell in cells {
                rows.push([&head[..], &[party.name.clone(), party.verdict.word().into()], &cell, &tail].concat());
            }
        }
    }
    as_csv(rows)
}
