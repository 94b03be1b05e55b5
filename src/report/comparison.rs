//! Comparison of several mechanisms that have the same task: text, CSV, Markdown, JSON, picture.

use crate::sentences;
use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

use super::pretty::{list, pretty};
use super::synthesize::{Story, diagram};
use super::table_csv::as_csv;
use crate::plain::cells::{fitted, marked, trimmed};
use design::bearings::Peaks;
use design::diagram::comparison::{ComparisonRow, ComparisonSheet};
use design::draw;
use design::synthesize::Achieved;
use design::synthesize::target::OutputAccelerations;
use design::synthesize::task::{OutputQuantity, Task};
use drawing::paper::document::Drawing;
use linkage::error::Result;
use linkage::math::KeepNan;
use prover::numbers;

/// A mechanism at the speed of the comparison, with its results.
#[derive(Debug)]
pub(crate) struct Contender {
    /// Name of the scenario.
    pub(crate) name: String,
    /// The task, with this mechanism and its output.
    pub(crate) task: Task,
    /// How well the motion meets the task.
    pub(crate) achieved: Achieved,
    /// Largest accelerations of the output.
    pub(crate) accelerations: OutputAccelerations,
    /// Largest reactions, shaking force and driving torque.
    pub(crate) peaks: Peaks,
}

impl Contender {
    /// Name and force (N) of the joint with the largest reaction.
    fn hardest(&self) -> (&str, f64) {
        let joints = self.task.case.mechanism.joints().iter().zip(&self.peaks.reactions);
        joints.fold(("", 0.0), |best, (joint, peak)| if peak.value > best.1 { (&joint.name, peak.value) } else { best })
    }

    /// The output in words: the link, and its point if the output is a point.
    fn output(&self) -> String {
        let (link, point) = self.task.output.working_point();
        let link = &self.task.case.mechanism.links()[link];
        match point {
            Some(point) => sentences::link_with_point(&link.name, &link.points[point].name),
            None => link.name.clone(),
        }
    }
}

/// Whether small or large values of a quantity are good.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Good {
    Small,
    Large,
    /// Neither small nor large: the task prescribes the value, so no mechanism is marked as the best.
    Open,
}

/// A row of the comparison: a quantity of all mechanisms.
struct Quantity {
    name: &'static str,
    /// Key of the value in SI units.
    key: &'static str,
    /// Factor from SI to the shown unit, the shown unit, and the number of decimals.
    shown: (f64, &'static str, usize),
    good: Good,
    value: fn(&Contender) -> Option<f64>,
}

/// All quantities that at least one mechanism has, in the order of the table.
fn quantities(all: &[Contender]) -> Vec<Quantity> {
    let degrees = 1f64.to_degrees();
    let of_angle = matches!(all[0].task.output, OutputQuantity::Angle { .. });
    let stroke = if of_angle { (degrees, "deg", 3) } else { (1e3, "mm", 3) };
    let stroke_key = if of_angle { "stroke_rad" } else { "stroke_m" };
    let row = |name, key, shown, good, value| Quantity { name, key, shown, good, value };
    let rows = [
        row(sentences::DEVIATION_OF_EXTREMES, "late_rad", (degrees, "deg", 2), Good::Small, |own| {
            Some(own.achieved.late(&own.task))
        }),
        row(sentences::DWELL_TOO_SHORT, "short_rad", (degrees, "deg", 2), Good::Small, |own| {
            Some(own.achieved.short(&own.task))
        }),
        row(sentences::LARGEST_DWELL_MOTION, "unrest", (100.0, sentences::PERCENT_OF_STROKE, 2), Good::Small, |own| {
            Some(own.achieved.unrest(&own.task))
        }),
        row(sentences::LARGEST_WRONG_MOTION, "wrong", (100.0, sentences::PERCENT_OF_STROKE, 2), Good::Small, |own| {
            Some(own.achieved.wrong())
        }),
        row("stroke", stroke_key, stroke, Good::Open, |own| Some(own.achieved.stroke)),
        row(
            sentences::PEAK_ANGULAR_ACCELERATION,
            "angular_acceleration_rad_s2",
            (1.0, "rad/s²", 1),
            Good::Small,
            |own| own.accelerations.angular,
        ),
        row(sentences::PEAK_POINT_ACCELERATION, "acceleration_m_s2", (1.0, "m/s²", 1), Good::Small, |own| {
            own.accelerations.point
        }),
        row(
            sentences::DIVIDED_BY_SPEED_SQUARED,
            "acceleration_by_speed_squared_m",
            (1e3, "mm", 2),
            Good::Small,
            |own| own.accelerations.point.map(|value| value / own.task.case.crank().top_speed().powi(2)),
        ),
        row(sentences::SMALLEST_TRANSMISSION_ANGLE, "transmission_rad", (degrees, "deg", 1), Good::Large, |own| {
            own.achieved.transmission
        }),
        row(sentences::LARGEST_REACTION, "reaction_N", (1.0, "N", 1), Good::Small, |own| Some(own.hardest().1)),
        row(sentences::LARGEST_SHAKING_FORCE, "shaking_force_N", (1.0, "N", 1), Good::Small, |own| {
            Some(own.peaks.shaking_force.value)
        }),
        row(sentences::LARGEST_DRIVING_TORQUE, "torque_N_m", (1.0, "N m", 3), Good::Small, |own| {
            Some(own.peaks.balancing_moment.value)
        }),
    ];
    rows.into_iter().filter(|row| all.iter().any(|own| (row.value)(own).is_some())).collect()
}

impl Quantity {
    fn heading(&self) -> String {
        format!("{}, {}", self.name, self.shown.1)
    }

    /// The shown values of all mechanisms, and for each value whether it is the best.
    /// Values that are shown with the same digits are equally good. If all values are shown with the same digits, none
    /// of them is best.
    fn cells(&self, all: &[Contender]) -> Vec<(String, bool)> {
        let (factor, _, decimals) = self.shown;
        let values: Vec<Option<f64>> = all.iter().map(|own| (self.value)(own).map(|value| value * factor)).collect();
        let text = |value: f64| numbers::fixed(value, decimals);
        let present = || values.iter().copied().flatten();
        let best = match self.good {
            Good::Small => Some(text(present().fold(f64::INFINITY, f64::smaller))),
            Good::Large => Some(text(present().fold(f64::NEG_INFINITY, f64::larger))),
            Good::Open => None,
        };
        let differ = present().map(text).collect::<BTreeSet<_>>().len() > 1;
        let cell = |value: &Option<f64>| match value {
            Some(value) => (text(*value), differ && best.as_ref() == Some(&text(*value))),
            None => ("-".into(), false),
        };
        values.iter().map(cell).collect()
    }
}

/// For each mechanism, the name of the joint with the largest reaction.
fn joints(all: &[Contender]) -> impl Iterator<Item = String> {
    all.iter().map(|own| own.hardest().0.to_string())
}

fn title(all: &[Contender]) -> String {
    let crank = all[0].task.case.crank().top_speed().abs();
    let rpm = numbers::significant(crank * 60.0 / std::f64::consts::TAU, 6);
    sentences::task_at_one_speed(&all[0].task.name, &rpm, &numbers::significant(crank, 5))
}

fn notes(all: &[Contender]) -> [String; 2] {
    let outputs: Vec<String> = all.iter().map(|own| format!("{} {}", own.name, own.output())).collect();
    [sentences::outputs_compared(&outputs.join("; ")), sentences::MASSES_OF_EACH_FILE.into()]
}

/// The comparison as text. The best values are marked with a star.
pub(crate) fn text(all: &[Contender], width: Option<usize>) -> String {
    let heads: String = all.iter().map(|own| format!(" | {} >", own.name)).collect();
    let mut table = fitted(&format!("quantity{heads}"), width);
    for quantity in quantities(all) {
        let cells =
            quantity.cells(all).into_iter().map(|(text, is_best)| format!("{text}{}", if is_best { "*" } else { " " }));
        table.add_row([quantity.heading()].into_iter().chain(cells));
        if quantity.key == "reaction_N" {
            let names = joints(all).map(|name| format!("{name} "));
            table.add_row([sentences::IN_JOINT.to_string()].into_iter().chain(names));
        }
    }
    let mut text = format!("{}\n\n{}\n\n", title(all), trimmed(&table));
    say!(text, sentences::THE_BEST_OF_A_ROW_IS_MARKED);
    notes(all).iter().for_each(|note| say!(text, note));
    text
}

/// Rows of texts: quantity, unit, then all mechanisms. `put` formats a cell.
fn rows(all: &[Contender], put: impl Fn(&Quantity) -> Vec<String>) -> Vec<Vec<String>> {
    let head = ["quantity", "unit"].map(String::from).into_iter().chain(all.iter().map(|own| own.name.clone()));
    let mut rows = vec![head.collect::<Vec<_>>()];
    for quantity in quantities(all) {
        let own = [quantity.name, quantity.shown.1].map(String::from).into_iter().chain(put(&quantity));
        rows.push(own.collect());
        if quantity.key == "reaction_N" {
            rows.push([sentences::IN_JOINT, ""].map(String::from).into_iter().chain(joints(all)).collect());
        }
    }
    rows
}

/// The comparison as CSV, one row per quantity, with 17 significant digits in the shown units.
///
/// # Errors
/// The errors of [`as_csv`].
pub(crate) fn table(all: &[Contender]) -> Result<String> {
    let exact = |quantity: &Quantity| {
        let number = |own: &Contender| {
            (quantity.value)(own).map_or(String::new(), |value| format!("{:.16e}", value * quantity.shown.0))
        };
        all.iter().map(number).collect()
    };
    as_csv(rows(all, exact))
}

/// The comparison as a table in Markdown. The best values are bold.
pub(crate) fn markdown(all: &[Contender]) -> String {
    let bold = |quantity: &Quantity| {
        let cell = |(text, is_best)| if is_best { format!("**{text}**") } else { text };
        quantity.cells(all).into_iter().map(cell).collect()
    };
    let rows = rows(all, bold);
    let mut text = format!("{}\n\n", title(all));
    for (index, row) in rows.iter().enumerate() {
        say!(text, marked(row));
        if index == 0 {
            say!(text, "|{}", "---|".repeat(row.len()));
        }
    }
    text
}

/// The comparison as JSON, schema 1, in SI units.
pub(crate) fn json(all: &[Contender]) -> String {
    let quantities = quantities(all);
    let one = |own: &Contender| {
        let mut object = Map::new();
        object.insert("name".into(), json!(own.name));
        object.insert("output".into(), json!(own.output()));
        for quantity in &quantities {
            object.insert(quantity.key.into(), json!((quantity.value)(own)));
        }
        object.insert("reaction_joint".into(), json!(own.hardest().0));
        Value::Object(object)
    };
    pretty(&json!({
        "schema": 1, "task": all[0].task.name, "speed_rad_s": all[0].task.case.crank().top_speed().abs(),
        "mechanisms": list(all, one),
    }))
}

/// The comparison as a sheet.
pub(crate) fn sheet(all: &[Contender]) -> Drawing {
    let mut rows = Vec::new();
    for quantity in quantities(all) {
        rows.push(ComparisonRow { name: quantity.heading(), cells: quantity.cells(all) });
        if quantity.key == "reaction_N" {
            let cells = joints(all).map(|name| (name, false)).collect();
            rows.push(ComparisonRow { name: sentences::IN_JOINT.into(), cells });
        }
    }
    let panel = |own: &Contender| {
        let story = Story { task: &own.task, achieved: &own.achieved, search: None };
        (own.name.clone(), diagram(&story))
    };
    draw::comparison(&ComparisonSheet {
        title: title(all),
        heads: all.iter().map(|own| own.name.clone()).collect(),
        rows,
        notes: notes(all).into(),
        panels: all.iter().map(panel).collect(),
    })
}
