//! Sheet that compares several mechanisms: a table of values, and below the table the displacement of every mechanism.

use super::axes::framed;
use super::timing_sheet::{LEFT, LONG, MARGIN, panel, required};
use crate::diagram::comparison::ComparisonSheet;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Tint, Type, rectangle, solid, width, words};
use drawing::paper::style::{BLACK, GREY};
use linkage::math::{KeepNan, Vec2};

/// Font size and distance of the table's lines (mm).
const SIZE: f64 = 3.0;
const LINE: f64 = 4.8;
/// Smallest distance between two columns (mm).
const GAP: f64 = 5.0;
/// Height of a displacement diagram, and space above the diagram for the name of the mechanism (mm).
const HIGH: f64 = 30.0;
const ABOVE: f64 = 7.0;
/// Background of the best value of a row.
const BEST: &str = "#dcefdc";

/// Returns the sheet as a drawing.
pub fn comparison(sheet: &ComparisonSheet) -> Drawing {
    let mut figure = DrawnFigure::default();
    figure.text(Vec2::new(MARGIN, -MARGIN - 4.0), sheet.title.as_str(), Type { bold: true, ..words(5.0) });
    let mut top = -MARGIN - 14.0;
    let table = table(sheet);
    let [low, high] = table.bounds();
    figure.add(&table, Vec2::new(MARGIN, top - high.y));
    top -= high.y - low.y + 6.0;
    for note in &sheet.notes {
        figure.text(Vec2::new(MARGIN, top), note.as_str(), words(2.8));
        top -= 4.2;
    }
    let legend = required(sheet.panels.iter().map(|(_, diagram)| diagram));
    for (index, (name, diagram)) in sheet.panels.iter().enumerate() {
        let last = (index + 1 == sheet.panels.len()).then_some(legend);
        let own = panel(diagram, HIGH, last);
        let [low, high] = own.bounds();
        figure.text(Vec2::new(MARGIN + LEFT, top - ABOVE + 2.0), name.as_str(), Type { bold: true, ..words(3.2) });
        top -= ABOVE;
        figure.add(&own, Vec2::new(MARGIN + LEFT, top - high.y));
        top -= high.y - low.y;
    }
    framed(figure, MARGIN, &sheet.title)
}

/// Draws the table; its upper left corner is the origin. The best value of a row is bold on a green background.
fn table(sheet: &ComparisonSheet) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let names = sheet.rows.iter().map(|row| width(&row.name, SIZE)).fold(0.0, f64::larger);
    let least = sheet.heads.iter().map(|head| 1.1 * width(head, SIZE)).fold(20.0, f64::larger) + GAP;
    let count = sheet.heads.len() as f64;
    let column = ((LONG + LEFT - names) / count).larger(least);
    let right = |index: usize| names + column * (index + 1) as f64;
    let long = names + column * count;
    let number = Type { anchor: "end", ..words(SIZE) };
    for (index, head) in sheet.heads.iter().enumerate() {
        figure.text(Vec2::new(right(index), -SIZE), head.as_str(), Type { bold: true, ..number });
    }
    let mut y = -SIZE - 1.4;
    figure.line([Vec2::new(0.0, y), Vec2::new(long, y)], solid(BLACK, 0.25));
    for row in &sheet.rows {
        y -= LINE;
        figure.text(Vec2::new(0.0, y + 1.2), row.name.as_str(), words(SIZE));
        for (index, (text, is_best)) in row.cells.iter().enumerate() {
            if *is_best {
                let corners =
                    [Vec2::new(right(index + 1) - 2.0 * column + GAP, y), Vec2::new(right(index) + 1.0, y + LINE)];
                figure.area(rectangle(corners), Some(Tint::opaque(BEST)), solid(BEST, 0.1));
            }
            figure.text(Vec2::new(right(index), y + 1.2), text.as_str(), Type { bold: *is_best, ..number });
        }
        figure.line([Vec2::new(0.0, y), Vec2::new(long, y)], solid(GREY, 0.1));
    }
    figure
}
