//! The sheet of a mechanism's plans: kinematic diagram, velocity plan and acceleration plan side by side.
//! Each stands above its table.

use super::document::document;
use super::figure::{Figure, Type, scripted, sub, words};
use super::{plan_figure, scheme_figure};
use crate::diagram::plan::Plans;
use crate::diagram::vectors::Plan;
use linkage::math::{KeepNan, Vec2};

/// Margin of the sheet, distance between columns, and distance between a figure and its table (mm).
const MARGIN: f64 = 10.0;
const GAP: f64 = 14.0;
const SPACE: f64 = 6.0;
/// Height of the sheet's title and of a column's heading (mm).
const TITLE: f64 = 18.0;
const HEADING: f64 = 13.0;

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
    sheet.text(Vec2::new(MARGIN, -MARGIN - 10.0), title, words(3.4));
    let mut left = MARGIN;
    let top = -MARGIN - TITLE;
    for ((name, scale), figure, table) in columns {
        sheet.text(Vec2::new(left, top - 4.0), name, Type { bold: true, ..words(4.2) });
        sheet.text(Vec2::new(left, top - 9.0), scale, words(3.4));
        let [low, high] = figure.bounds();
        let table = table.figure();
        let [table_low, table_high] = table.bounds();
        let wide = (high.x - low.x).larger(table_high.x - table_low.x).larger(60.0);
        let inset = (wide - (high.x - low.x)) / 2.0;
        sheet.add(&figure, Vec2::new(left + inset - low.x, top - HEADING - high.y));
        sheet.add(&table, Vec2::new(left - table_low.x, top - HEADING - (high.y - low.y) - SPACE));
        left += wide + GAP;
    }
    let [low, high] = sheet.bounds();
    document(&sheet, [(high.x.larger(left - GAP) + MARGIN).ceil(), (MARGIN - low.y).ceil()], name)
}

/// An angle in degrees, without digits that are only rounding.
fn degrees(angle: f64) -> String {
    let degrees = (angle.to_degrees() * 1e6).round() / 1e6 + 0.0;
    format!("{degrees}")
}
