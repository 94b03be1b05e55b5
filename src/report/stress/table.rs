//! A family as CSV: one row for every group of channels of every party at every point.

use super::super::table_csv::csv;
use lab::stress::{Family, Outcome, Reached};
use linkage::error::Result;

const HEADER: &str = "family dial sample party verdict group error bound channel used closure balance step_s sweeps \
                      extrapolated steps work done silent against why";

/// The table. Errors and bounds are shares of the channel's scale; empty cells are numbers that do not exist.
///
/// # Errors
/// [`ErrorKind::Io`](linkage::ErrorKind::Io) if the table cannot be written.
pub(crate) fn rows<'a>(family: &Family, outcomes: impl Iterator<Item = &'a Outcome>) -> Result<String> {
    let header: Vec<String> = HEADER.split(' ').map(String::from).collect();
    let columns = header.len();
    let mut rows = vec![header];
    let some = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:e}"));
    let count = |value: Option<usize>| value.map_or_else(String::new, |value| value.to_string());
    for own in outcomes {
        let head = [family.name.to_string(), format!("{:e}", own.dial), own.sample.to_string()];
        if !own.refused.is_empty() {
            let mut row = [&head[..], &["", "refused"].map(String::from)].concat();
            row.resize(columns - 1, String::new());
            row.push(own.refused.clone());
            rows.push(row);
        }
        for party in &own.parties {
            let done = party.done.iter().map(|(what, times)| format!("{times} {what}")).collect::<Vec<_>>().join(", ");
            let [closure, balance, step] = [party.closure, party.balance, party.step].map(some);
            let [sweeps, extrapolated] = [party.sweeps, party.extrapolated].map(count);
            let [steps, work] = [party.steps, party.work].map(some);
            let (silent, against, why) = (party.silent.to_string(), party.against.clone(), party.why.clone());
            let tail = [closure, balance, step, sweeps, extrapolated, steps, work, done, silent, against, why];
            let cell = |own: &Reached| {
                let [error, bound, used] = [own.error, own.bound, own.used].map(|value| format!("{value:e}"));
                [own.group.name().into(), error, bound, own.channel.clone(), used]
            };
            let mut cells: Vec<[String; 5]> = party.reached.iter().map(cell).collect();
            if cells.is_empty() {
                cells.push(Default::default());
            }
            for cell in cells {
                rows.push([&head[..], &[party.name.clone(), party.verdict.word().into()], &cell, &tail].concat());
            }
        }
    }
    csv(rows)
}
