//! Sheet of a timing diagram, and panels of timing diagrams for other sheets.

use crate::sentences;
use std::f64::consts::TAU;

use super::axes::{GRID, frame, framed};
use crate::diagram::timing::TimingDiagram;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Style, Tint, Type, rectangle, solid, width, words};
use drawing::paper::style::{BLACK, COLOURS, GREY};
use linkage::math::Vec2;

/// Length of the crank angle axis (mm): two degrees per millimetre.
pub(super) const LONG: f64 = 180.0;
/// Height of the diagram on a sheet with one diagram (mm). The height represents the whole stroke.
const HIGH: f64 = 80.0;
/// Height of the strip of phases above the diagram (mm).
const STRIP: f64 = 11.0;
/// Diagrams lower than this (mm) have grid lines at every half of the stroke, higher diagrams at every quarter.
const LOW: f64 = 50.0;
/// Space to the left of the diagram for the numbers of its axis (mm). `MARGIN` is the margin of the sheet (mm).
pub(super) const LEFT: f64 = 14.0;
pub(super) const MARGIN: f64 = 12.0;
/// Required motion.
const WANTED: Style = Style { colour: COLOURS[1], width: 0.45, dash: "2 1.2" };
/// Background of a phase in which the output should dwell.
pub(super) const REST: &str = "#e3edf4";

/// Returns the diagram as a drawing with `title` above it.
pub fn timing(diagram: &TimingDiagram, title: &str) -> Drawing {
    let figure = panel(diagram, HIGH, Some(required([diagram])));
    let mut sheet = DrawnFigure::default();
    let [low, high] = figure.bounds();
    sheet.text(Vec2::new(MARGIN, -MARGIN), title, Type { bold: true, ..words(4.4) });
    sheet.add(&figure, Vec2::new(MARGIN + LEFT, -MARGIN - 6.0 - high.y));
    let bottom = -MARGIN - 6.0 - high.y + low.y;
    let mut line = bottom - 5.0;
    for part in diagram.note.split("; ") {
        sheet.text(Vec2::new(MARGIN, line), part, words(2.8));
        line -= 4.2;
    }
    framed(sheet, MARGIN, title)
}

/// Draws the diagram with the height `tall` (mm). The lower left corner of its frame is the origin.
/// `last` is `Some` only for the lowest of several diagrams. It describes the required motions for the legend.
/// Only the lowest diagram has a legend and the numbers of the crank angle axis.
pub(super) fn panel(diagram: &TimingDiagram, tall: f64, last: Option<&str>) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let x = |crank: f64| LONG * crank / TAU;
    let at = |[crank, share]: [f64; 2]| Vec2::new(x(crank), tall * share);
    for stretch in &diagram.stretches {
        let [from, to] = [x(stretch.from), x(stretch.to)];
        if stretch.sign == 0.0 {
            let corners = rectangle([Vec2::new(from, 0.0), Vec2::new(to, tall + STRIP)]);
            figure.area(corners, Some(Tint::opaque(REST)), solid(REST, 0.1));
        }
    }
    axes(&mut figure, &x, tall, last.is_some());
    for stretch in &diagram.stretches {
        let [from, to] = [x(stretch.from), x(stretch.to)];
        figure.line([Vec2::new(to, 0.0), Vec2::new(to, tall + STRIP)], solid(GREY, 0.25));
        // Narrow phases use a smaller font.
        for (text, below) in [(stretch.word, 4.0), (stretch.figure.as_str(), 8.5)] {
            let size = (0.95 * (to - from) / width(text, 1.0)).clamp(1.6, 2.8);
            let set = Type { anchor: "middle", ..words(size) };
            figure.text(Vec2::new((from + to) / 2.0, tall + STRIP - below), text, set);
        }
    }
    if diagram.wanted.is_empty() {
        for stretch in &diagram.stretches {
            let [from, to] = stretch.least;
            figure.line([at([stretch.from, from]), at([stretch.to, to])], WANTED);
        }
    } else {
        figure.curve(diagram.wanted.iter().copied().map(at).collect(), None, WANTED);
    }
    figure.curve(diagram.curve.iter().copied().map(at).collect(), None, solid(COLOURS[0], 0.5));
    if let Some(required) = last {
        legend(&mut figure, required);
    }
    figure
}

/// Description of the required motions of `diagrams` for the legend.
pub(super) fn required<'a>(diagrams: impl IntoIterator<Item = &'a TimingDiagram>) -> &'static str {
    let (curves, lines): (Vec<_>, Vec<_>) = diagrams.into_iter().partition(|diagram| !diagram.wanted.is_empty());
    match (curves.is_empty(), lines.is_empty()) {
        (_, true) => "required, cycloidal",
        (true, false) => sentences::WANTED_REST_OR_AT_LEAST_SO,
        (false, false) => sentences::WANTED_CURVE_REST_OR_AT_LEAST_SO,
    }
}

/// Draws frame, grid and numbers.
fn axes(figure: &mut DrawnFigure, x: &dyn Fn(f64) -> f64, tall: f64, is_last: bool) {
    for percent in (0..=100).step_by(if tall < LOW { 50 } else { 25 }) {
        let y = tall * f64::from(percent) / 100.0;
        figure.line([Vec2::new(0.0, y), Vec2::new(LONG, y)], GRID);
        figure.text(Vec2::new(-2.0, y - 1.0), format!("{percent} %"), Type { anchor: "end", ..words(2.8) });
    }
    for deg in (0..=360).step_by(30) {
        let at = x(f64::from(deg).to_radians());
        figure.line([Vec2::new(at, 0.0), Vec2::new(at, tall)], GRID);
        if is_last {
            figure.text(Vec2::new(at, -4.0), format!("{deg}°"), Type { anchor: "middle", ..words(2.8) });
        }
    }
    frame(figure, Vec2::new(LONG, tall), BLACK);
}

fn legend(figure: &mut DrawnFigure, required: &str) {
    let mut left = 0.0;
    let mut entry = |style: Style, text: &str| {
        figure.line([Vec2::new(left, -9.0), Vec2::new(left + 8.0, -9.0)], style);
        figure.text(Vec2::new(left + 10.0, -10.0), text, words(2.8));
        left += 62.0;
    };
    entry(solid(COLOURS[0], 0.5), sentences::ACHIEVED_SHARE_OF_THE_STROKE);
    entry(WANTED, required);
}
