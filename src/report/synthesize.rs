//! Reports on a motion and its timing: text, JSON, picture.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::cells::table;
use design::diagram::timing::{Stretch, TimingDiagram};
use design::draw;
use design::synthesize::achieved::{BAND, PhaseDone};
use design::synthesize::task::{OutputQuantity, Phase, Sense, Task};
use design::synthesize::{Achieved, SearchResult};
use drawing::paper::document::Drawing;
use prover::numbers;

/// A task, its result, and the search that found it.
pub(crate) struct Story<'a> {
    /// The task.
    pub(crate) task: &'a Task,
    /// How well the motion meets the task.
    pub(crate) achieved: &'a Achieved,
    /// The result of the search, and the dimensions as written to the scenario.
    pub(crate) search: Option<(&'a SearchResult, &'a [f64])>,
}

/// The stroke with its unit.
pub(super) fn stroke(task: &Task, achieved: &Achieved) -> String {
    match task.output {
        OutputQuantity::Angle { .. } => numbers::fixed_in(achieved.stroke.to_degrees(), 4, "deg"),
        OutputQuantity::Coordinate { .. } => numbers::fixed_in(achieved.stroke * 1e3, 4, "mm"),
    }
}

/// The main figures, in two lines.
pub(crate) fn summary(task: &Task, achieved: &Achieved) -> String {
    let angle = |angle: f64| sentences::smallest_transmission_angle_deg(&angle.to_degrees());
    let (stroke, angle) = (stroke(task, achieved), achieved.transmission.map_or(String::new(), angle));
    let [unrest, wrong] = [achieved.unrest(task), achieved.wrong()].map(|share| 100.0 * share);
    let [late, short] = [achieved.late(task), achieved.short(task)].map(f64::to_degrees);
    sentences::stroke_largest_motion_in_a_dwell(&stroke, &angle, &unrest, &wrong, &late, &short)
}

/// The motion and its timing as text.
pub(crate) fn text(story: &Story) -> String {
    let (task, achieved) = (story.task, story.achieved);
    let mut text = format!("{}: {}\n\n", task.name, task.title);
    if let Some((found, values)) = story.search {
        let [drawn, assembled] = found.candidates;
        let worst = found.refined.last().copied().unwrap_or(f64::NAN);
        let [cost, refined, worst] = [found.random_cost, found.cost, worst].map(|cost| numbers::significant(cost, 4));
        say!(text, sentences::random_candidates_of_them_assembled(&drawn, &assembled, &cost, &refined, &worst));
        let rows = task.variables.iter().zip(values).map(|(variable, &value)| {
            let show = |value: f64| match variable.is_angle {
                true => numbers::fixed_in(value.to_degrees(), 4, "deg"),
                false => numbers::fixed_in(value * 1e3, 3, "mm"),
            };
            let [from, to] = variable.bounds;
            [variable.name.clone(), show(value), show(from), show(to)]
        });
        say!(text, "{}\n", table("dimension | value> | from> | to>").add_rows(rows));
    }
    let rows = task.timing.phases().iter().zip(&achieved.phases).map(|(phase, done)| {
        let percent = |share: f64| numbers::fixed(100.0 * share, 3);
        let [from, to] = [phase.from, phase.to].map(|angle| numbers::fixed(angle.to_degrees(), 1));
        let [displacement, motion, level] = [done.displacement, done.motion, done.level].map(percent);
        let wrong = if phase.sense == Sense::Dwell { "-".into() } else { percent(done.wrong) };
        let end = done.end.map_or("-".into(), |end| numbers::fixed(end.to_degrees(), 2));
        [from, to, phase.sense.name().to_string(), displacement, motion, wrong, level, end]
    });
    let header = "from deg> | to deg> | sense | displacement %> | motion %> | reversed %> | level %> | ends at deg>";
    let mut phases = table(header);
    phases.add_rows(rows);
    say!(text, "{phases}\n\n{}", summary(task, achieved));
    say!(text, sentences::a_dwell_ends_where_the_output(&(100.0 * BAND)));
    text
}

/// The motion and its timing as JSON, schema 1.
pub(crate) fn json(story: &Story) -> String {
    let (task, achieved) = (story.task, story.achieved);
    let phases = list(task.timing.phases().iter().zip(&achieved.phases), |(phase, done)| {
        json!({
            "from_rad": phase.from, "to_rad": phase.to, "sense": phase.sense.name(), "displacement": done.displacement,
            "motion": done.motion, "wrong": done.wrong, "level": done.level, "end_rad": done.end,
        })
    });
    let search = story.search.map(|(found, values)| {
        let dimensions = list(task.variables.iter().zip(values), |(variable, value)| {
            let ([from, to], unit) = (variable.bounds, if variable.is_angle { "rad" } else { "m" });
            json!({"name": variable.name, "value": value, "unit": unit, "from": from, "to": to})
        });
        json!({
            "seed": task.effort.seed, "candidates": found.candidates[0], "assembled": found.candidates[1],
            "random_cost": found.random_cost, "cost": found.cost, "refined_costs": found.refined,
            "dimensions": dimensions,
        })
    });
    pretty(&json!({
        "schema": 1, "name": task.name, "stroke": achieved.stroke, "forward": achieved.forward,
        "transmission_rad": achieved.transmission, "unrest": achieved.unrest(task), "wrong": achieved.wrong(),
        "late_rad": achieved.late(task), "short_rad": achieved.short(task), "phases": phases, "search": search,
    }))
}

/// Required and achieved motion as a picture.
pub(crate) fn picture(story: &Story) -> Drawing {
    draw::timing(&diagram(story), &story.task.title)
}

/// Data of the picture: a point for every half degree, and the required curve at the angles where the task states it.
pub(crate) fn diagram(story: &Story) -> TimingDiagram {
    let (task, achieved) = (story.task, story.achieved);
    let rows = (0..achieved.turns.len()).step_by((achieved.turns.len() / 720).max(1));
    let stretch = |(phase, done): (&Phase, &PhaseDone)| {
        let (start, moves) = (achieved.share(phase.from), format!("{:+.1} %", 100.0 * done.displacement));
        let (way, figure) = match phase.sense {
            Sense::Dwell => (0.0, format!("moves {:.2} %", 100.0 * done.motion)),
            Sense::Forward => (phase.least, moves),
            Sense::Back => (-phase.least, moves),
        };
        Stretch {
            from: phase.from,
            to: phase.to,
            word: phase.sense.name(),
            sign: phase.sense.sign(),
            figure,
            least: [start, phase.level.unwrap_or(start + way)],
        }
    };
    let wanted = |deg: u32| {
        let angle = f64::from(deg).to_radians();
        task.timing.wanted(angle).map(|share| [angle, share])
    };
    let summary = summary(task, achieved);
    let rest = summary.split_once(". ").map_or("", |(_, rest)| rest);
    TimingDiagram {
        curve: rows.map(|row| [achieved.turns[row], achieved.shares[row]]).collect(),
        wanted: (0..=360).filter_map(wanted).collect(),
        stretches: task.timing.phases().iter().zip(&achieved.phases).map(stretch).collect(),
        note: format!("stroke {}; {}", stroke(task, achieved), rest.replace(". ", "; ").replace('\n', " ")),
    }
}
