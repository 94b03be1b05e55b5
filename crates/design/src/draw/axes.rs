//! Axes with round numbers.

use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Style, Type, rectangle, solid, words};
use drawing::paper::scale::{factor, multiple, round_up};
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
pub fn stacked(title: &str, notes: &[String], room: &Room, panels: impl Iterator<Item = DrawnFigure>) -> Drawing {
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
    framed(sheet, MARGIN, title)
}

/// Returns a sheet as a drawing. The sheet's upper left corner is the origin.
/// `margin` (mm) is the space to the right of the sheet and below the sheet.
pub fn framed(sheet: DrawnFigure, margin: f64, title: &str) -> Drawing {
    let [low, high] = sheet.bounds();
    let size = [(high.x + margin).ceil(), (margin - low.y).ceil()];
    Drawing { figure: sheet, size, title: title.into() }
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

    /// Returns the axis for values from `low` to `high` at a given scale factor (units per millimetre).
    pub fn scaled([low, high]: [f64; 2], scale: f64) -> Self {
        ValueAxis { scale, ..ValueAxis::of([low, high], 1.0) }
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
        self.draw_numbered(figure, long, (-2.0, "end"));
    }

    /// Draws grid lines of length `long` (mm) at round values, with their numbers at `x` (mm).
    pub fn draw_numbered(&self, figure: &mut DrawnFigure, long: f64, (x, anchor): (f64, &'static str)) {
        let step = self.step;
        for k in 0..=(self.up - self.bottom).round() as i32 {
            let value = (self.bottom + f64::from(k)) * step;
            let y = self.y(value);
            let style = if value == 0.0 { solid(BLACK, 0.25) } else { GRID };
            figure.line([Vec2::new(0.0, y), Vec2::new(long, y)], style);
            figure.text(Vec2::new(x, y - 1.0), multiple(value, step), Type { anchor, ..words(2.8) });
        }
    }
}

/// Unit of a scale factor, such as `(m/s)/mm` for values in `m/s`.
pub fn per_millimetre(unit: &str) -> String {
    if unit.contains([' ', '/', '·']) { format!("({unit})/mm") } else { format!("{unit}/mm") }
}

/// Draws the frame of a diagram; its lower left corner is the origin.
pub fn frame(figure: &mut DrawnFigure, size: Vec2, colour: &'static str) {
    figure.area(rectangle([Vec2::zeros(), size]), None, solid(colour, 0.25));
}
