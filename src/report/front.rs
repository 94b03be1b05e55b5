//! A front of two wishes: text, CSV, JSON and picture.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use super::synthesize::stroke;
use super::table_csv::{as_csv, number};
use crate::plain::cells::table;
use design::synthesize::Achieved;
use design::synthesize::reached::largest_deviations;
use design::synthesize::task::Task;
use drawing::paper::document::Drawing;
use drawing::plot::{PlotAxis, PlotChart, PlotCurve, sheet};
use linkage::error::Result;
use linkage::math::KeepNan;
use prover::numbers;

/// A mechanism on the front.
pub(crate) struct Reached {
    pub(crate) task: Task,
    pub(crate) achieved: Achieved,
    /// Values of the variables (SI).
    pub(crate) values: Vec<f64>,
    /// The verdict of its proof, in one sentence.
    pub(crate) verdict: String,
}

/// A front.
pub(crate) struct Front<'a> {
    pub(crate) task: &'a Task,
    /// Name of the limit that is varied.
    pub(crate) limit: &'a str,
    /// The limit in words, and its unit.
    pub(crate) noun: [String; 2],
    /// Values of the varied limit, each with its mechanism; `None` if no mechanism keeps all limits at this value.
    pub(crate) points: &'a [(f64, Option<Reached>)],
}

impl Reached {
    /// The word in capitals in the verdict, as in `AGREE`; `-` if the verdict has none.
    fn word(&self) -> &str {
        let is_verdict = |word: &&str| word.len() > 1 && word.chars().all(|letter| letter.is_ascii_uppercase());
        self.verdict.split([':', ' ']).find(is_verdict).unwrap_or("-")
    }

    /// Deviation of the mechanism in percent: the largest motion in a dwell as a fraction of the stroke, or the largest
    /// distance from a precision point as a fraction of the extent of all precision points.
    fn deviation(&self) -> f64 {
        let [distance, turned] = largest_deviations(&self.achieved.points);
        let points = distance.map(|own| own / self.task.points.extent()).into_iter().chain(turned);
        100.0 * points.fold(self.achieved.unrest(&self.task), f64::larger)
    }
}

/// The front as text.
pub(crate) fn text(front: &Front) -> String {
    let rows = front.points.iter().map(|(limit, found)| {
        let limit = numbers::significant(*limit, 6);
        let Some(found) = found else { return [limit, "-".into(), "-".into(), "-".into(), "-".into(), "-".into()] };
        let angle = found.achieved.transmission.map_or("-".into(), |own| numbers::fixed(own.to_degrees(), 2));
        let wrong = numbers::fixed(100.0 * found.achieved.wrong(), 3);
        [
            limit,
            numbers::fixed(found.deviation(), 3),
            wrong,
            stroke(&found.task, &found.achieved),
            angle,
            found.word().into(),
        ]
    });
    let mut points = table("limit> | deviation %> | reversed %> | stroke> | transmission deg> | proof");
    points.add_rows(rows);
    let mut text = format!("{}: {}\n\n", front.task.name, front.task.title);
    say!(text, "{points}\n\n{}\n", sentences::the_front_varies(&front.limit));
    text
}

/// The front as CSV: the limit, the deviation, and all dimensions in SI. Empty fields belong to limits without
/// mechanism.
///
/// # Errors
/// The errors of [`as_csv`].
pub(crate) fn rows(front: &Front) -> Result<String> {
    let names =
        front.task.variables.iter().map(|own| format!("{} {}", own.name, if own.is_angle { "rad" } else { "m" }));
    let head = [front.limit.to_string(), "deviation_percent".into()].into_iter().chain(names);
    let row = |(limit, found): &(f64, Option<Reached>)| -> Vec<String> {
        let found = found.as_ref().map(|found| [found.deviation()].into_iter().chain(found.values.iter().copied()));
        let mut fields: Vec<String> = [*limit].into_iter().chain(found.into_iter().flatten()).map(number).collect();
        fields.resize(2 + front.task.variables.len(), String::new());
        fields
    };
    as_csv([head.collect()].into_iter().chain(front.points.iter().map(row)))
}

/// The front as JSON, schema 1.
pub(crate) fn json(front: &Front) -> String {
    let points = list(front.points, |(limit, found)| {
        let dimensions = found.as_ref().map(|found| {
            let names = front.task.variables.iter().map(|own| own.name.clone());
            names.zip(found.values.iter().map(|value| json!(value))).collect::<serde_json::Map<_, _>>()
        });
        json!({"limit": limit, "deviation": found.as_ref().map(|own| own.deviation() / 100.0), "dimensions": dimensions,
               "verdict": found.as_ref().map(Reached::word)})
    });
    pretty(&json!({"schema": 1, "name": front.task.name, "limit": front.limit, "points": points}))
}

/// Deviation over the limit as a picture.
///
/// # Errors
/// The errors of the plot.
pub(crate) fn picture(front: &Front) -> Result<Drawing> {
    let points = front.points.iter().filter_map(|(limit, found)| Some([*limit, found.as_ref()?.deviation()]));
    let points: Vec<[f64; 2]> = points.collect();
    let marks = points.iter().map(|point| (*point, String::new())).collect();
    let axis =
        |name: &str, unit: &str| PlotAxis { name: name.into(), unit: unit.into(), rounded: true, degrees: false };
    let chart = PlotChart {
        axes: [axis(&front.noun[0], &front.noun[1]), axis(sentences::DEVIATION, "%")],
        curves: vec![PlotCurve { points, marks, ..PlotCurve::default() }],
        size: [160.0, 90.0],
        ..PlotChart::default()
    };
    let (figure, size) = sheet(&front.task.title, &[chart])?;
    Ok(Drawing { figure, size, title: front.task.title.clone() })
}
