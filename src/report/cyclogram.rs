//! Cyclogram of a machine: text, CSV, JSON, picture.

use serde_json::json;

use super::pretty::{list, pretty};
use super::synthesize::{Story, diagram, stroke};
use super::table_csv::as_csv;
use crate::plain::cells::{fitted, trimmed};
use crate::sentences;
use design::diagram::cyclogram::{Cyclogram, CyclogramRing};
use design::draw;
use design::synthesize::Achieved;
use design::synthesize::machine_file::{Machine, Organ};
use drawing::paper::document::Drawing;
use linkage::error::Result;
use prover::numbers;
use std::f64::consts::TAU;

/// A machine, and the achieved motions of its organs in their order.
#[derive(Debug)]
pub(crate) struct Cycle {
    /// The machine.
    pub(crate) machine: Machine,
    /// The motions.
    pub(crate) achieved: Vec<Achieved>,
}

impl Cycle {
    fn organs(&self) -> impl Iterator<Item = (&Organ, &Achieved)> {
        self.machine.organs.iter().zip(&self.achieved)
    }

    /// The moments of the cycle, each a name and a span of the main shaft's angle, in the order of their beginnings.
    /// Moments with the same span are joined into one with all their names.
    fn moments(&self) -> Vec<(String, [f64; 2])> {
        let spans = |own: &design::synthesize::machine_file::Moment| {
            own.spans.iter().map(|span| (own.name.clone(), *span)).collect::<Vec<_>>()
        };
        let mut joined: Vec<(String, [f64; 2])> = Vec::new();
        for (name, span) in self.machine.moments.iter().flat_map(spans) {
            match joined.iter_mut().find(|(_, own)| *own == span) {
                Some((own, _)) => *own = format!("{own}, {name}"),
                None => joined.push((name, span)),
            }
        }
        joined.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
        joined
    }
}

/// The drive of an organ in one line: stroke, motion in dwells and deviation of the extreme positions.
fn drive(organ: &Organ, achieved: &Achieved) -> String {
    let task = &organ.task;
    let late = achieved.late(task).to_degrees();
    sentences::drive_of_an_organ(&organ.drive.name, &stroke(task, achieved), &(100.0 * achieved.unrest(task)), &late)
}

/// An angle of the main shaft in degrees.
fn shaft(angle: f64) -> String {
    numbers::significant((angle.rem_euclid(TAU)).to_degrees(), 6)
}

/// The end of a span; a whole turn is 360, not 0.
fn end(angle: f64) -> String {
    if (angle - TAU).abs() < 1e-9 { "360".into() } else { shaft(angle) }
}

/// Rows of all phases over the main shaft: organ, number, from, to, sense, achieved displacement in percent.
fn phases(cycle: &Cycle) -> Vec<[String; 6]> {
    let of_organ = |(organ, achieved): (&Organ, &Achieved)| {
        let phases = organ.task.timing.phases().iter().zip(&achieved.phases).enumerate();
        let row = |(index, (phase, done)): (usize, (&design::synthesize::task::Phase, &_))| {
            let done: &design::synthesize::achieved::PhaseDone = done;
            let [from, to] = [shaft(phase.from + organ.offset), end(phase.to + organ.offset)];
            let moved = numbers::fixed(100.0 * done.displacement, 2);
            [organ.name.clone(), (index + 1).to_string(), from, to, phase.sense.name().into(), moved]
        };
        phases.map(row).collect::<Vec<_>>()
    };
    cycle.organs().flat_map(of_organ).collect()
}

/// The cyclogram as text.
pub(crate) fn text(cycle: &Cycle, width: Option<usize>) -> String {
    let machine = &cycle.machine;
    let mut table = fitted("organ | phase> | from deg> | to deg> | sense | displacement %>", width);
    table.add_rows(phases(cycle));
    let mut text = format!("{}: {}\n\n{}\n\n", machine.name, machine.title, trimmed(&table));
    for (organ, achieved) in cycle.organs() {
        say!(text, "{}: {}", organ.name, drive(organ, achieved));
    }
    if !machine.moments.is_empty() {
        say!(text, "\n{}", sentences::MOMENTS_OF_THE_CYCLE);
        let mut table = fitted("moment | from deg> | to deg>", width);
        table.add_rows(cycle.moments().into_iter().map(|(name, [from, to])| [name, shaft(from), end(to)]));
        say!(text, "{}", trimmed(&table));
    }
    if !machine.notes.is_empty() {
        say!(text, "\n{}", machine.notes.join("\n"));
    }
    text
}

/// The displacements as CSV, in steps of one degree of the main shaft. Every organ has a column with the achieved
/// displacement and, if the task states it, a column with the required displacement, as fractions of the stroke.
///
/// # Errors
/// The errors of [`as_csv`].
pub(crate) fn table(cycle: &Cycle) -> Result<String> {
    let mut rows = vec![vec!["shaft_deg".to_string()]];
    rows.extend((0..=360).map(|deg: u32| vec![deg.to_string()]));
    for (organ, achieved) in cycle.organs() {
        let is_stated = organ.task.timing.wanted(0.0).is_some();
        rows[0].push(organ.name.clone());
        rows[0].extend(is_stated.then(|| sentences::required_of(&organ.name)));
        for (deg, row) in (0..=360u32).zip(&mut rows[1..]) {
            let crank = (f64::from(deg).to_radians() - organ.offset).rem_euclid(TAU);
            row.push(format!("{:.16e}", achieved.share(crank)));
            row.extend(organ.task.timing.wanted(crank).map(|share| format!("{share:.16e}")));
        }
    }
    as_csv(rows)
}

/// The cyclogram as JSON, schema 1; angles of the main shaft in rad.
pub(crate) fn json(cycle: &Cycle) -> String {
    let machine = &cycle.machine;
    let organs = list(cycle.organs(), |(organ, achieved)| {
        let phases = list(organ.task.timing.phases().iter().zip(&achieved.phases), |(phase, done)| {
            json!({
                "from_rad": phase.from + organ.offset, "to_rad": phase.to + organ.offset,
                "sense": phase.sense.name(), "displacement": done.displacement,
            })
        });
        json!({
            "name": organ.name, "task": organ.task.name, "mechanism": organ.drive.name, "offset_rad": organ.offset,
            "unrest": achieved.unrest(&organ.task), "late_rad": achieved.late(&organ.task), "phases": phases,
        })
    });
    let moments = list(&machine.moments, |own| json!({"name": own.name, "spans_rad": own.spans}));
    pretty(&json!({
        "schema": 1, "name": machine.name, "organs": organs, "moments": moments, "notes": machine.notes,
    }))
}

/// The cyclogram as a sheet.
pub(crate) fn sheet(cycle: &Cycle) -> Drawing {
    let ring = |(organ, achieved): (&Organ, &Achieved)| CyclogramRing {
        name: organ.name.clone(),
        drive: drive(organ, achieved),
        diagram: diagram(&Story { task: &organ.task, achieved, search: None }),
        offset: organ.offset,
    };
    draw::cyclogram(&Cyclogram {
        title: cycle.machine.title.clone(),
        notes: cycle.machine.notes.clone(),
        rings: cycle.organs().map(ring).collect(),
        moments: cycle.moments(),
    })
}
