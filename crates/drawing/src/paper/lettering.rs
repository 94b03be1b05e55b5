//! Letters at points: their boxes, and the lines that lead to far ones.

use super::figure::{Figure, Type, solid, width, words};
use super::labels::Label;
use super::style::GREY;
use linkage::math::{KeepNan, Vec2};

/// Font size of labels (mm).
pub const LETTER: f64 = 4.2;
/// Labels farther than this from their point (mm) are connected with it by a line.
const FAR: f64 = 3.2;

/// Box of a label.
/// It is a little larger than its letters in the fonts that viewers fall back on, subscripts included.
#[must_use]
pub fn label_size(text: &str) -> Vec2 {
    Vec2::new(1.05 * width(text, LETTER), 1.15 * LETTER)
}

/// A label at its position, with a line to its point if that is far away.
pub fn letter(figure: &mut Figure, label: &Label, at: Vec2, text: &str, paint: &'static str) {
    let toward = label.anchor - at;
    let half = label.size / 2.0;
    let edge = (half.x / toward.x.abs().larger(1e-9)).smaller(half.y / toward.y.abs().larger(1e-9));
    if toward.norm() * (1.0 - edge) > FAR + label.clear {
        let end = label.anchor - toward.normalize() * (label.clear + 0.2);
        figure.line([at + toward * edge, end], solid(GREY, 0.15));
    }
    let set = Type { anchor: "middle", italic: true, colour: paint, ..words(LETTER) };
    figure.text(at - Vec2::new(0.0, 0.28 * LETTER), text, set);
}
