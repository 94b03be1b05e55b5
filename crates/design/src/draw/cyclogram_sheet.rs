//! Sheet of a cyclogram: concentric rings of phases, and displacement diagrams of all organs below each other.

use std::f64::consts::TAU;

use super::axes::framed;
use super::timing_sheet::{LEFT, LONG, MARGIN, REST, panel, required};
use crate::diagram::cyclogram::{Cyclogram, CyclogramRing};
use crate::diagram::timing::Stretch;
use crate::sentences;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Tint, Type, rectangle, solid, words};
use drawing::paper::style::{BLACK, COLOURS, GREY};
use linkage::math::{KeepNan, Vec2};

/// Outer radius of the outermost ring, and smallest inner radius of the innermost ring (mm).
const OUTER: f64 = 62.0;
const INNER: f64 = 24.0;
/// Largest width of a ring (mm), and the space between two rings.
const WIDE: f64 = 9.0;
const GAP: f64 = 1.0;
/// Distance of the arc of a moment (an operation of the cycle) from the outermost ring, and distance of its name from
/// the arc (mm).
const ARC: f64 = 3.0;
const NAME: f64 = 3.0;
/// Largest angle between two corners of a drawn arc (rad).
const STEP: f64 = TAU / 90.0;
/// Backgrounds of forward and backward motion.
const FORWARD: &str = "#f3c9a5";
const BACK: &str = "#fbe9da";
/// Height of a displacement diagram, and space above the diagram for the name of the organ (mm).
const HIGH: f64 = 24.0;
const ABOVE: f64 = 6.0;
/// Roman numerals of the rings.
const NUMERALS: [&str; 12] = ["I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII"];

/// Largest number of organs on a sheet.
pub const MOST_RINGS: usize = NUMERALS.len();

/// Returns the sheet as a drawing.
pub fn cyclogram(cyclogram: &Cyclogram) -> Drawing {
    let mut figure = DrawnFigure::default();
    figure.text(Vec2::new(MARGIN, -MARGIN - 4.0), cyclogram.title.as_str(), Type { bold: true, ..words(5.0) });
    let circle = circle(cyclogram);
    let [low, high] = circle.bounds();
    let mut top = -MARGIN - 10.0;
    figure.add(&circle, Vec2::new(MARGIN + (LONG + LEFT) / 2.0, top - high.y));
    top -= high.y - low.y + 7.0;
    legend(&mut figure, top);
    for (ring, numeral) in cyclogram.rings.iter().zip(NUMERALS) {
        top -= 4.6;
        let line = format!("{numeral}  {}: {}", ring.name, sectors(ring));
        figure.text(Vec2::new(MARGIN, top), line, words(2.6));
    }
    for note in &cyclogram.notes {
        top -= 4.4;
        figure.text(Vec2::new(MARGIN, top), note.as_str(), words(2.6));
    }
    top -= 3.0;
    let required = required(cyclogram.rings.iter().map(|ring| &ring.diagram));
    for (index, (ring, numeral)) in cyclogram.rings.iter().zip(NUMERALS).enumerate() {
        let last = (index + 1 == cyclogram.rings.len()).then_some(required);
        let own = panel(&ring.diagram.clone().shifted(ring.offset), HIGH, last);
        let [low, high] = own.bounds();
        let name = format!("{numeral}  {}: {}", ring.name, ring.drive);
        figure.text(Vec2::new(MARGIN + LEFT, top - ABOVE + 2.0), name, Type { bold: true, ..words(2.8) });
        top -= ABOVE;
        figure.add(&own, Vec2::new(MARGIN + LEFT, top - high.y));
        top -= high.y - low.y;
    }
    framed(figure, MARGIN, &cyclogram.title)
}

/// The phases of a ring in one line, with their numbers.
fn sectors(ring: &CyclogramRing) -> String {
    let one = |(number, own): (usize, &Stretch)| {
        let [from, to] = [own.from, own.to].map(|at| (at + ring.offset).to_degrees());
        let turn = (from / 360.0).floor() * 360.0;
        format!("{} {} {:.0}–{:.0}°", number + 1, own.word, from - turn, to - turn)
    };
    ring.diagram.stretches.iter().enumerate().map(one).collect::<Vec<_>>().join(", ")
}

/// Unit vector on paper at an angle of the main shaft (rad). The angle is zero at the top and increases clockwise.
fn direction(shaft: f64) -> Vec2 {
    Vec2::new(shaft.sin(), shaft.cos())
}

/// Points of an arc from `from` to `to` (rad).
fn arc(radius: f64, [from, to]: [f64; 2]) -> impl DoubleEndedIterator<Item = Vec2> {
    let parts = ((to - from) / STEP).ceil().larger(1.0) as usize;
    (0..=parts).map(move |k| direction(from + (to - from) * k as f64 / parts as f64) * radius)
}

/// Draws the rings, the angles of the main shaft and the moments; the centre is the origin.
fn circle(cyclogram: &Cyclogram) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let pitch = ((OUTER - INNER) / cyclogram.rings.len().max(1) as f64).smaller(WIDE + GAP);
    let middle = |at: Vec2| at - Vec2::new(0.0, 1.0);
    let centred = Type { anchor: "middle", ..words(2.8) };
    for (index, (ring, numeral)) in cyclogram.rings.iter().zip(NUMERALS).enumerate() {
        let outer = OUTER - pitch * index as f64;
        let inner = outer - pitch + GAP;
        for (number, own) in ring.diagram.stretches.iter().enumerate() {
            let span = [own.from + ring.offset, own.to + ring.offset];
            let corners = arc(outer, span).chain(arc(inner, span).rev()).collect();
            let colour = match own.sign {
                sign if sign > 0.0 => FORWARD,
                sign if sign < 0.0 => BACK,
                _ => REST,
            };
            figure.area(corners, Some(Tint::opaque(colour)), solid(BLACK, 0.25));
            let at = direction((span[0] + span[1]) / 2.0) * ((outer + inner) / 2.0);
            figure.text(middle(at), format!("{}", number + 1), centred);
        }
        // The numeral stands left of the direction of zero degrees, at the end of the last sector.
        let at = Vec2::new(-2.6, (outer + inner) / 2.0);
        figure.text(middle(at), numeral, Type { bold: true, ..centred });
    }
    let inner = OUTER - pitch * cyclogram.rings.len() as f64;
    for deg in (0..360).step_by(30) {
        let way = direction(f64::from(deg).to_radians());
        figure.line([way * (inner - 1.5), way * inner], solid(GREY, 0.25));
        figure.text(middle(way * (inner - 5.0)), format!("{deg}°"), Type { size: 2.4, ..centred });
    }
    figure.text(middle(Vec2::zeros()), sentences::MAIN_SHAFT, centred);
    for (name, span) in &cyclogram.moments {
        figure.curve(arc(OUTER + ARC, *span).collect(), None, solid(COLOURS[0], 0.9));
        for end in span {
            figure.line(
                [direction(*end) * (OUTER + ARC - 1.5), direction(*end) * (OUTER + ARC + 1.5)],
                solid(COLOURS[0], 0.4),
            );
        }
        let way = direction((span[0] + span[1]) / 2.0);
        // Names right of the circle are aligned left, names left of the circle are aligned right.
        // Names above or below the circle are centred.
        let anchor = match way.x {
            x if x > 0.1 => "start",
            x if x < -0.1 => "end",
            _ => "middle",
        };
        let lower = if way.y < 0.0 { way.y * 2.0 } else { 0.0 };
        let at = way * (OUTER + ARC + NAME) + Vec2::new(0.0, lower - 1.0 + way.y.larger(0.0));
        figure.text(at, name.as_str(), Type { anchor, ..words(3.0) });
    }
    figure
}

/// Draws the legend of the colours for senses and moments, in one line at the height `top` (mm).
fn legend(figure: &mut DrawnFigure, top: f64) {
    let mut left = MARGIN;
    for (colour, text) in [(FORWARD, "forward"), (BACK, "back"), (REST, "dwell")] {
        let corners = rectangle([Vec2::new(left, top - 0.6), Vec2::new(left + 6.0, top + 2.6)]);
        figure.area(corners, Some(Tint::opaque(colour)), solid(BLACK, 0.2));
        figure.text(Vec2::new(left + 8.0, top), text, words(2.8));
        left += 28.0;
    }
    figure.line([Vec2::new(left, top + 1.0), Vec2::new(left + 6.0, top + 1.0)], solid(COLOURS[0], 0.9));
    figure.text(Vec2::new(left + 8.0, top), sentences::MOMENT_THAT_ALL_PHASES_ALLOW, words(2.8));
}
