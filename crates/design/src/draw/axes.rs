//! Axes with round numbers.

use drawing::paper::document::document;
use drawing::paper::figure::{DrawnFigure, Style, Type, rectangle, solid, words};
use drawing::paper::scale::{factor, round_up};
use drawing::paper::style::BLACK;
use linkage::math::{KeepNan, Vec2};

/// Grid line.
pub const GRID: Style = solid("#c8c8c8", 0.15);

/// Margins of a sheet (mm).
const MARGIN: f64 = 12.0;

/// Spacing on a sheet (mm).
pub struct Room {
    /// Space below the notes.
    pub gap: f64,
    /// Space left of all diagrams.
    pub left: f64,
    /// Space between two diagrams.
    pub between: f64,
}

/// Draws a sheet of diagrams below each other, with a title and notes above.
pub fn stacked(title: &str, notes: &[String], room: &Room, panels: impl Iterator<Item = DrawnFigure>) -> String {
    let mut sheet = DrawnFigure::default();
    sheet.text(Vec2::new(MARGIN, -MARGIN - 4.0), title, Type { bold: true, ..words(5.0) });
    let mut top = -MARGIN - 10.0;
    for note in notes {
        sheet.text(Vec2::new(MARGIN, top), note.as_str(), words(3.2));
        top -= 4.6;
    }
    top -= room.gap;
    for figure in panels {
        let [low, high] = figure.bounds();
        sheet.add(&figure, Vec2::new(MARGIN + room.left, top - high.y));
        top -= high.y - low.y + room.between;
    }
    framed(&sheet, MARGIN, title)
}

/// Returns a sheet as a document. The sheet's upper left corner is the origin.
/// `margin` (mm) is the space to the right of the sheet and below the sheet.
pub fn framed(sheet: &DrawnFigure, margin: f64, title: &str) -> String {
    let [low, high] = sheet.bounds();
    document(sheet, [(high.x + margin).ceil(), (margin - low.y).ceil()], title)
}

/// Vertical axis between two round values.
#[derive(Clone, Copy, Debug)]
pub struct ValueAxis {
    /// Lower end of the axis, in multiples of `step`. `up` is the upper end.
    bottom: f64,
    up: f64,
    /// Difference of the values of two neighbouring grid lines.
    step: f64,
    /// Scale factor (units per millimetre).
    pub scale: f64,
}

impl ValueAxis {
    /// Returns the axis for values from `low` to `high`, at most `room` (mm) long.
    pub fn of([low, high]: [f64; 2], room: f64) -> Self {
        let step = if high > low { round_up((high - low) / 6.0) } else { 1.0 };
        let (bottom, up) = ((low / step).floor(), (high / step).ceil().larger((low / step).floor() + 1.0));
        ValueAxis { bottom, up, step, scale: factor((up - bottom) * step, room) }
    }

    /// Height of a value above the lower end (mm).
    pub fn y(&self, value: f64) -> f64 {
        (value - self.bottom * self.step) / self.scale
    }

    /// Length of the axis (mm).
    pub fn height(&self) -> f64 {
        self.y(self.up * self.step)
    }

    /// Draws grid lines of length `long` (mm) at round values, with their numbers on the left.
    pub fn draw(&self, figure: &mut DrawnFigure, long: f64) {
        let step = self.step;
        for k in 0..=(self.up - self.bottom).round() as i32 {
            let value = (self.bottom + f64::from(k)) * step;
            let y = self.y(value);
            let style = if value == 0.0 { solid(BLACK, 0.25) } else { GRID };
            figure.line([Vec2::new(0.0, y), Vec2::new(long, y)], style);
            figure.text(Vec2::new(-2.0, y - 1.0), number(value, step), Type { anchor: "end", ..words(2.8) });
        }
    }
}

/// Draws the frame of a diagram; its lower left corner is the origin.
pub fn frame(figure: &mut DrawnFigure, size: Vec2, colour: &'static str) {
    figure.area(rectangle([Vec2::zeros(), size]), None, solid(colour, 0.25));
}

/// Formats a multiple of `step` with the decimals of `step`.
/// If `step` is very small or very large, the number has an exponent.
fn number(value: f64, step: f64) -> String {
    if (1e-4..1e6).contains(&step) {
        let decimals = format!("{step}").split_once('.').map_or(0, |(_, decimals)| decimals.len());
        return format!("{value:.decimals$}");
    }
    if value == 0.0 {
        return "0".into();
    }
    // A computed multiple of a round number may differ from the round value by a rounding error.
    // The value is therefore rounded to ten significant digits.
    let round: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    format!("{round:e}")
}
