//! The sheet of a mechanism's plans: kinematic diagram, velocity plan and acceleration plan below each other.
//! Each stands above its table. So the sheet is narrow, and its letters can be read at the width of a web page.

use super::{plan_figure, scheme_figure};
use crate::diagram::plan::Plans;
use crate::diagram::vectors::Plan;
use drawing::paper::document::document;
use drawing::paper::figure::{Figure, Type, scripted, sub, words};
use linkage::math::{KeepNan, Vec2};

/// Margin of the sheet, distance between plans, and distance between a figure and its table (mm).
const MARGIN: f64 = 8.0;
const GAP: f64 = 12.0;
const SPACE: f64 = 6.0;
/// Height of the sheet's title and of a column's heading (mm).
const TITLE: f64 = 18.0;
const HEADING: f64 = 15.0;

/// The plans as an SVG document, true to scale; `name` and `title` are written above them.
#[must_use]
pub fn plans(plans: &Plans, name: &str, title: &str) -> String {
    let heading = |words: &str, symbol: &str, index: &str, scale: f64, unit: &str| {
        (words.to_string(), format!("scale factor {symbol}{} = {scale} {}", sub(index), scripted(unit)))
    };
    let of_plan = |plan: &Plan, words: &str| {
        let unit = format!("({})/mm", plan.quantity.unit());
        let unit = unit.replace("s^2", "s²");
        (
            heading(words, "μ", plan.quantity.symbol(), plan.scale, &unit),
            plan_figure::plan(plan),
            plan_figure::table(plan),
        )
    };
    let scheme = &plans.scheme;
    let columns = [
        (
            heading("Kinematic diagram", "μ", "l", scheme.scale, "m/mm"),
            scheme_figure::scheme(scheme),
            scheme_figure::table(scheme),
        ),
        of_plan(&plans.velocity, "Velocity plan"),
        of_plan(&plans.acceleration, "Acceleration plan"),
    ];
    let mut sheet = Figure::default();
    let large = Type { bold: true, ..words(5.5) };
    sheet.text(Vec2::new(MARGIN, -MARGIN - 4.0), format!("{name}, crank at {}°", degrees(plans.crank)), large);
    sheet.text(Vec2::new(MARGIN, -MARGIN - 10.0), title, words(3.6));
    let columns = columns.map(|(heading, figure, table)| (heading, figure, table.figure()));
    let wide = |figure: &Figure| figure.bounds()[1].x - figure.bounds()[0].x;
    let widest = columns.iter().map(|(_, figure, table)| wide(figure).larger(wide(table))).fold(0.0, f64::larger);
    let mut top = -MARGIN - TITLE;
    for ((name, scale), figure, table) in &columns {
        sheet.text(Vec2::new(MARGIN, top - 4.5), name.as_str(), Type { bold: true, ..words(4.8) });
        sheet.text(Vec2::new(MARGIN, top - 10.0), scale.as_str(), words(3.6));
        let [low, high] = figure.bounds();
        let inset = (widest - wide(figure)) / 2.0;
        sheet.add(figure, Vec2::new(MARGIN + inset - low.x, top - HEADING - high.y));
        top -= HEADING + (high.y - low.y) + SPACE;
        let [table_low, table_high] = table.bounds();
        sheet.add(table, Vec2::new(MARGIN - table_low.x, top - table_high.y));
        top -= table_high.y - table_low.y + GAP;
    }
    let [low, high] = sheet.bounds();
    document(&sheet, [(high.x.larger(MARGIN + widest) + MARGIN).ceil(), (MARGIN - low.y).ceil()], name)
}

/// An angle in degrees, without digits that are only rounding.
fn degrees(angle: f64) -> String {
    let degrees = (angle.to_degrees() * 1e6).round() / 1e6 + 0.0;
    format!("{degrees}")
}
