//! Sheet of a timing diagram.

use crate::sentences;
use std::f64::consts::TAU;

use super::axes::{GRID, frame, framed};
use crate::diagram::timing::TimingDiagram;
use drawing::paper::figure::{DrawnFigure, Style, Tint, Type, rectangle, solid, words};
use drawing::paper::style::{BLACK, COLOURS, GREY};
use linkage::math::Vec2;

/// Length of the crank angle axis (mm): two degrees per millimetre.
const LONG: f64 = 180.0;
/// Height of the diagram, which represents the whole stroke (mm).
const HIGH: f64 = 80.0;
/// Height of the strip of phases above the diagram (mm).
const STRIP: f64 = 11.0;
/// Space to the left of the diagram for the numbers of its axis (mm). `MARGIN` is the margin of the sheet (mm).
const LEFT: f64 = 14.0;
const MARGIN: f64 = 12.0;
/// Required motion.
const WANTED: Style = Style { colour: COLOURS[1], width: 0.45, dash: "2 1.2" };
/// Background of a phase in which the output should dwell.
const REST: &str = "#e3edf4";

/// Returns the diagram as an SVG document with `title` above it.
pub fn timing(diagram: &TimingDiagram, title: &str) -> String {
    let mut figure = DrawnFigure::default();
    let x = |crank: f64| LONG * crank / TAU;
    let at = |[crank, share]: [f64; 2]| Vec2::new(x(crank), HIGH * share);
    for stretch in &diagram.stretches {
        let [from, to] = [x(stretch.from), x(stretch.to)];
        if stretch.rests {
            let corners = rectangle([Vec2::new(from, 0.0), Vec2::new(to, HIGH + STRIP)]);
            figure.area(corners, Some(Tint::opaque(REST)), solid(REST, 0.1));
        }
    }
    axes(&mut figure, &x);
    for stretch in &diagram.stretches {
        let [from, to] = [x(stretch.from), x(stretch.to)];
        figure.line([Vec2::new(to, 0.0), Vec2::new(to, HIGH + STRIP)], solid(GREY, 0.25));
        // Narrow phases use a smaller font.
        let size = ((to - from) / 6.0).clamp(1.8, 2.8);
        let middle = (from + to) / 2.0;
        let set = Type { anchor: "middle", ..words(size) };
        figure.text(Vec2::new(middle, HIGH + STRIP - 4.0), stretch.word, set);
        figure.text(Vec2::new(middle, HIGH + STRIP - 8.5), stretch.figure.as_str(), set);
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
    legend(&mut figure, diagram);
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
    framed(&sheet, MARGIN, title)
}

/// Draws frame, grid and numbers.
fn axes(figure: &mut DrawnFigure, x: &dyn Fn(f64) -> f64) {
    for share in 0..=4 {
        let y = HIGH * f64::from(share) / 4.0;
        figure.line([Vec2::new(0.0, y), Vec2::new(LONG, y)], GRID);
        let text = format!("{} %", 25 * share);
        figure.text(Vec2::new(-2.0, y - 1.0), text, Type { anchor: "end", ..words(2.8) });
    }
    for deg in (0..=360).step_by(30) {
        let at = x(f64::from(deg).to_radians());
        figure.line([Vec2::new(at, 0.0), Vec2::new(at, HIGH)], GRID);
        figure.text(Vec2::new(at, -4.0), format!("{deg}°"), Type { anchor: "middle", ..words(2.8) });
    }
    frame(figure, Vec2::new(LONG, HIGH), BLACK);
}

fn legend(figure: &mut DrawnFigure, diagram: &TimingDiagram) {
    let mut left = 0.0;
    let mut entry = |style: Style, text: &str| {
        figure.line([Vec2::new(left, -9.0), Vec2::new(left + 8.0, -9.0)], style);
        figure.text(Vec2::new(left + 10.0, -10.0), text, words(2.8));
        left += 62.0;
    };
    entry(solid(COLOURS[0], 0.5), sentences::ACHIEVED_SHARE_OF_THE_STROKE);
    entry(
        WANTED,
        if diagram.wanted.is_empty() { sentences::WANTED_REST_OR_AT_LEAST_SO } else { "required, cycloidal" },
    );
}
