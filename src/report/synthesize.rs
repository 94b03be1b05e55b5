//! Reports on a motion and its timing: text, JSON, picture.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::cells::table;
use design::diagram::timing::{Stretch, TimingDiagram};
use design::draw;
use design::synthesize::achieved::{BAND, PATH, PhaseDone};
use design::synthesize::reached::{ReachedPoint, largest_deviations};
use design::synthesize::task::{OutputQuantity, Phase, PrecisionPoint, Refinement, Sense, Task};
use design::synthesize::{Achieved, SearchResult};
use drawing::paper::document::Drawing;
use drawing::plot::{PlotAxis, PlotChart, PlotCurve, sheet};
use linkage::error::Result;
use prover::numbers;
use std::f64::consts::TAU;

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

/// The main figures.
pub(crate) fn summary(task: &Task, achieved: &Achieved) -> String {
    let angle = |angle: f64| sentences::smallest_transmission_angle_deg(&angle.to_degrees());
    if achieved.phases.is_empty() {
        let angle = achieved.transmission.map(|own| sentences::the_smallest_transmission_angle(&own.to_degrees()));
        return [reached(achieved)].into_iter().chain(angle).collect::<Vec<_>>().join(" ");
    }
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
        say!(text, effort(task, found));
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
    let parts = [phases(task, achieved), points(task, achieved)];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    text + &parts.join("\n")
}

/// Effort and success of a search.
fn effort(task: &Task, found: &SearchResult) -> String {
    let ([drawn, assembled], [random, refined]) = (found.candidates, found.poses);
    let worst = found.refined.last().copied().unwrap_or(f64::NAN);
    let costs = match task.effort.refinement {
        Refinement::Evolution => {
            let [cost, refined, worst] =
                [found.random_cost, found.cost, worst].map(|cost| numbers::significant(cost, 4));
            sentences::refined_without_derivatives(&cost, &refined, &worst)
        }
        Refinement::Gradients => {
            let [refined, worst] = [found.cost, worst].map(|cost| numbers::significant(100.0 * cost, 4));
            sentences::refined_with_derivatives(&refined, &worst)
        }
    };
    let poses = sentences::poses_solved(&(random + refined), &random, &refined);
    sentences::random_candidates(&drawn, &assembled) + &costs + &poses
}

/// The phases as a table; `None` for a task without phases.
fn phases(task: &Task, achieved: &Achieved) -> Option<String> {
    if achieved.phases.is_empty() {
        return None;
    }
    let mut text = String::new();
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
    Some(text)
}

/// The precision points as a table; `None` for a task without precision points.
fn points(task: &Task, achieved: &Achieved) -> Option<String> {
    if achieved.points.is_empty() {
        return None;
    }
    let missing = || "-".to_string();
    let rows = task.points.all().iter().zip(&achieved.points).map(|(wanted, found)| {
        let place = |value: f64| wanted.place.map_or_else(missing, |_| numbers::fixed(value * 1e3, 4));
        let [x, y] = [found.place.x, found.place.y].map(place);
        let angle = wanted.angle.map_or_else(missing, |_| numbers::fixed(found.angle.to_degrees(), 4));
        let distance = found.distance.map_or_else(missing, |own| numbers::error(own * 1e3));
        let turned = found.turned.map_or_else(missing, |own| numbers::error(own.abs().to_degrees()));
        [numbers::fixed(found.turn.to_degrees(), 4), x, y, angle, distance, turned]
    });
    let mut points = table("crank deg> | x mm> | y mm> | angle deg> | distance mm> | deviation deg>");
    points.add_rows(rows);
    let largest = match achieved.phases.is_empty() {
        true => summary(task, achieved),
        false => reached(achieved),
    };
    Some(format!("{points}\n\n{largest}\n"))
}

/// The largest deviations from the precision points.
fn reached(achieved: &Achieved) -> String {
    let [distance, angle] = largest_deviations(&achieved.points);
    let distance = distance.map(|own| sentences::largest_distance(&numbers::error(own * 1e3)));
    let angle = angle.map(|own| sentences::largest_turned(&numbers::error(own.to_degrees())));
    distance.into_iter().chain(angle).collect::<Vec<_>>().join(" ")
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
    let points = list(task.points.all().iter().zip(&achieved.points), |(wanted, found)| {
        let place = wanted.place.map(|_| found.place);
        json!({
            "crank_rad": found.turn, "x_m": place.map(|own| own.x), "y_m": place.map(|own| own.y),
            "angle_rad": wanted.angle.map(|_| found.angle), "distance_m": found.distance, "deviation_rad": found.turned,
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
            "refinement": task.effort.refinement.name(), "poses": found.poses, "dimensions": dimensions,
        })
    });
    pretty(&json!({
        "schema": 1, "name": task.name, "stroke": achieved.stroke, "forward": achieved.forward,
        "transmission_rad": achieved.transmission, "unrest": achieved.unrest(task), "wrong": achieved.wrong(),
        "late_rad": achieved.late(task), "short_rad": achieved.short(task), "phases": phases, "points": points,
        "search": search,
    }))
}

/// Required and achieved motion as a picture. For a task without phases: the path of the working point, or the angle of
/// the output link over the crank angle, with the precision points.
///
/// # Errors
/// The errors of [`sheet`].
pub(crate) fn picture(story: &Story) -> Result<Drawing> {
    let (task, achieved) = (story.task, story.achieved);
    if !achieved.phases.is_empty() {
        return Ok(draw::timing(&diagram(story), &task.title));
    }
    let axis = |name: &str, unit: &str, rounded: bool| PlotAxis {
        name: name.into(),
        unit: unit.into(),
        degrees: !rounded,
        rounded,
    };
    let wanted = || task.points.all().iter().zip(&achieved.points).enumerate();
    let has_path = task.points.all().iter().any(|point| point.place.is_some());
    let chart = if has_path {
        let mark = |(index, (own, _)): (usize, (&PrecisionPoint, &ReachedPoint))| {
            own.place.map(|place| ([place.x * 1e3, place.y * 1e3], (index + 1).to_string()))
        };
        PlotChart {
            axes: [axis("x", "mm", true), axis("y", "mm", true)],
            curves: vec![PlotCurve {
                points: achieved.path.iter().map(|(place, _)| [place.x * 1e3, place.y * 1e3]).collect(),
                marks: wanted().filter_map(mark).collect(),
                directed: true,
                ..PlotCurve::default()
            }],
            equal: true,
            size: [120.0, 120.0],
            ..PlotChart::default()
        }
    } else {
        let turns = achieved.turns.iter().step_by(PATH);
        let near = |angle: f64| angle - TAU * ((angle - achieved.path[0].1) / TAU).round();
        let mark = |(index, (own, found)): (usize, (&PrecisionPoint, &ReachedPoint))| {
            let angle = near(own.angle?).to_degrees();
            Some(([found.turn.to_degrees(), angle], (index + 1).to_string()))
        };
        PlotChart {
            axes: [axis(sentences::CRANK_ANGLE, "deg", false), axis(sentences::ANGLE_OF_THE_OUTPUT, "deg", true)],
            curves: vec![PlotCurve {
                points: turns
                    .zip(&achieved.path)
                    .map(|(turn, own)| [turn.to_degrees(), near(own.1).to_degrees()])
                    .collect(),
                marks: wanted().filter_map(mark).collect(),
                ..PlotCurve::default()
            }],
            size: [160.0, 90.0],
            ..PlotChart::default()
        }
    };
    let (figure, size) = sheet(&task.title, &[chart])?;
    Ok(Drawing { figure, size, title: task.title.clone() })
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
