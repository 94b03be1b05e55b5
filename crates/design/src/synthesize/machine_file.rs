//! Machine files. A machine has organs on one main shaft, each with a task and a mechanism.
//! A moment is a named operation of the machine's cycle, such as "pressing".
//! docs/synthesis.md describes the format.

use crate::sentences;
use std::f64::consts::TAU;
use std::path::Path;

use super::target::{OutputNames, in_mechanism};
use super::task::Task;
use super::task_file::{TaskFile, beside, source_text};
use linkage::error::Result;
use linkage::math::KeepNan;
use scenario::Scenario;
use scenario::header::{check_format, name};
use scenario::reader::{Sign, TomlTable};
use scenario::source::Source;
use scenario::unit::ANGLE;
use scenario::words::suggestion;

/// Largest number of organs, and largest number of moments. A larger number is most likely a mistake.
const MOST: usize = 12;
/// A span of angles that phases have in common is ignored if it is smaller than this (rad).
const SAME: f64 = 1e-9;

/// An organ of a machine.
#[derive(Clone, Debug)]
pub struct Organ {
    /// Name of the organ.
    pub name: String,
    /// Task of the organ, with the mechanism that drives the organ.
    pub task: Task,
    /// Scenario of the mechanism that drives the organ.
    pub drive: Scenario,
    /// Angle of the main shaft at which the task begins (rad).
    pub offset: f64,
}

/// A moment of the cycle: an operation for which every organ must be in certain phases.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Name of the moment.
    pub name: String,
    /// Spans of the main shaft's angle: beginning and end (rad).
    /// Within a span, every organ of the moment is in one of the phases that the moment requires of this organ.
    /// A beginning is below a full turn, and an end is larger than its beginning.
    pub spans: Vec<[f64; 2]>,
}

/// A machine.
#[derive(Clone, Debug)]
pub struct Machine {
    /// Short name.
    pub name: String,
    /// Title for the reader, in one line.
    pub title: String,
    /// Remarks for the reader, one line each.
    pub notes: Vec<String>,
    /// Organs.
    pub organs: Vec<Organ>,
    /// Moments.
    pub moments: Vec<Moment>,
}

impl Machine {
    /// Reads the machine file at `path`, and the synthesis files and scenarios that the machine file names.
    ///
    /// # Errors
    /// [`ErrorKind::Io`](linkage::ErrorKind::Io) if a file cannot be read.
    /// [`ErrorKind::Input`](linkage::ErrorKind::Input) for a mistake in a file.
    /// The errors of [`TaskFile::load`], [`Scenario::load`] and [`in_mechanism`].
    pub fn load(path: &Path) -> Result<Self> {
        let text = source_text(path, sentences::GIVE_THE_PATH_OF_A_MACHINE_FILE)?;
        let source = Source::new(path, &text);
        let tree = source.tree()?;
        read(&mut TomlTable::root(&source, &tree)).map_err(|error| source.located(tree.get_ref(), error))
    }
}

fn read(root: &mut TomlTable) -> Result<Machine> {
    check_format(root)?;
    let (own_name, title) = (name(root)?, root.string("title")?);
    let notes = if root.has("notes") { root.strings("notes")? } else { Vec::new() };
    let (organs, moments) = (root.tables("organs")?, root.tables("moments")?);
    root.finish()?;
    for (key, count, least) in [("organs", organs.len(), 1), ("moments", moments.len(), 0)] {
        if !(least..=MOST).contains(&count) {
            let message = sentences::the_machine_has_so_many(&count, &key);
            return root.refuse(key, message, sentences::give_from_to_of_them(&least, &MOST, &key));
        }
    }
    let mut found: Vec<Organ> = Vec::new();
    for table in organs {
        let own = organ(table, &found)?;
        found.push(own);
    }
    let moments = moments.into_iter().map(|table| moment(table, &found)).collect::<Result<_>>()?;
    Ok(Machine { name: own_name, title, notes, organs: found, moments })
}

fn organ(mut table: TomlTable, before: &[Organ]) -> Result<Organ> {
    let name = table.string("name")?;
    if before.iter().any(|own| own.name == name) {
        let message = sentences::two_organs_are_called(&name);
        return table.refuse("name", message, sentences::GIVE_EVERY_ORGAN_ANOTHER_NAME);
    }
    let (of_task, of_drive) = (table.string("task")?, table.string("mechanism")?);
    let listed = |name: Option<String>| name.into_iter().collect();
    let names =
        OutputNames { links: listed(table.optional_string("link")?), points: listed(table.optional_string("point")?) };
    let offset = table.optional_quantity("offset", &ANGLE, Sign::Any)?.unwrap_or(0.0).rem_euclid(TAU);
    table.finish()?;
    let help = sentences::NAME_THE_SYNTHESIS_FILE_BESIDE;
    let TaskFile { task, .. } = beside(&table, "task", &of_task, help, TaskFile::load)?;
    let load = |path: &Path| Scenario::load(path);
    let drive = beside(&table, "mechanism", &of_drive, sentences::NAME_THE_SCENARIO_BESIDE, load)?.nominal();
    let task = in_mechanism(&task, &drive, &names).map_err(|error| {
        let located = table.wrong(error.kind(), "mechanism", error.message());
        match error.way_out() {
            Some(help) => located.help(help.clone()),
            None => located,
        }
    })?;
    Ok(Organ { name, task, drive, offset })
}

fn moment(mut table: TomlTable, organs: &[Organ]) -> Result<Moment> {
    let name = table.string("name")?;
    let mut during = table.table("during")?;
    table.finish()?;
    let mut allowed = Vec::new();
    for key in during.keys() {
        let Some(organ) = organs.iter().find(|organ| organ.name == key) else {
            let help = suggestion(&key, organs.iter().map(|organ| organ.name.as_str()), "\"");
            return during.refuse(&key, sentences::no_organ_is_called(&key), help);
        };
        let phases = organ.task.timing.phases();
        let mut spans = Vec::new();
        for number in during.numbers(&key)? {
            let index = (1..=phases.len()).find(|index| *index as f64 == number);
            let Some(phase) = index.map(|index| &phases[index - 1]) else {
                let message = sentences::the_organ_has_no_phase(&key, &number);
                return during.refuse(&key, message, sentences::give_numbers_from_to(&phases.len()));
            };
            spans.push([phase.from + organ.offset, phase.to + organ.offset]);
        }
        allowed.push(spans);
    }
    during.finish()?;
    let spans = common(&allowed);
    if spans.is_empty() {
        let message = sentences::the_phases_of_the_moment_have_nothing_in_common(&name);
        return table.refuse("during", message, sentences::CHECK_THE_NUMBERS_OF_THE_PHASES);
    }
    Ok(Moment { name, spans })
}

/// The spans of angles (rad) that every list of `allowed` contains. Angles are counted modulo a turn.
fn common(allowed: &[Vec<[f64; 2]>]) -> Vec<[f64; 2]> {
    let mut limits: Vec<f64> = allowed.iter().flatten().flatten().map(|limit| limit.rem_euclid(TAU)).collect();
    limits.sort_by(f64::total_cmp);
    limits.dedup_by(|a, b| (*a - *b).abs() < SAME);
    let holds = |angle: f64, [from, to]: [f64; 2]| (angle - from).rem_euclid(TAU) < to - from;
    let mut spans: Vec<[f64; 2]> = Vec::new();
    for (index, &from) in limits.iter().enumerate() {
        let to = limits.get(index + 1).copied().unwrap_or(limits[0] + TAU);
        let middle = (from + to) / 2.0;
        if to - from < SAME || !allowed.iter().all(|spans| spans.iter().any(|span| holds(middle, *span))) {
            continue;
        }
        match spans.last_mut() {
            Some(last) if (last[1] - from).abs() < SAME => last[1] = to,
            _ => spans.push([from, to]),
        }
    }
    // A span at the end of the turn is joined with the span at the beginning of the turn.
    if let ([first, .., last], Some(&start)) = (&spans[..], limits.first())
        && (first[0] - start).abs() < SAME
        && (last[1] - start - TAU).abs() < SAME
    {
        let joined = [last[0], first[1] + TAU];
        spans.pop();
        spans[0] = joined;
    }
    spans.iter_mut().for_each(|span| span[1] = span[1].smaller(span[0] + TAU));
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_angles_continue_over_the_end_of_the_turn() {
        let deg = |list: &[[f64; 2]]| list.iter().map(|span| span.map(f64::to_radians)).collect::<Vec<_>>();
        let found = |lists: &[Vec<[f64; 2]>]| {
            let spans = common(lists).into_iter().map(|span| span.map(|end| end.to_degrees().round()));
            spans.collect::<Vec<_>>()
        };
        assert_eq!(found(&[deg(&[[0.0, 100.0]]), deg(&[[50.0, 70.0], [70.0, 120.0]])]), [[50.0, 100.0]]);
        assert_eq!(found(&[deg(&[[0.0, 100.0], [300.0, 360.0]]), deg(&[[320.0, 380.0]])]), [[320.0, 380.0]]);
        assert_eq!(found(&[deg(&[[0.0, 100.0]]), deg(&[[100.0, 120.0]])]), Vec::<[f64; 2]>::new());
        assert_eq!(
            found(&[deg(&[[0.0, 90.0], [180.0, 270.0]]), deg(&[[45.0, 225.0]])]),
            [[45.0, 90.0], [180.0, 225.0]]
        );
        assert_eq!(found(&[deg(&[[0.0, 360.0]])]), [[0.0, 360.0]]);
        assert_eq!(found(&[]), Vec::<[f64; 2]>::new());
    }
}
