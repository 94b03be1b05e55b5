//! A diagram with two logarithmic axes, and the marks of the parties, which are the compared programs.

use crate::sentences;
use drawing::palette::SERIES;
use drawing::paper::figure::{DrawnFigure, Style, Tint, Type, rectangle, solid, words};
use drawing::paper::style::GREY;
use linkage::math::Vec2;

/// Margins between a cell and the frame of its diagram (mm): left, right, top, bottom.
const ROOM: [f64; 4] = [22.0, 5.0, 9.0, 12.0];
const GRID: Style = solid("#d4d4d4", 0.15);
/// Thin dashed line.
pub(super) const DASHED: Style = Style { dash: "1.6 1.2", ..solid(GREY, 0.3) };
/// Font size of numbers (mm).
pub(super) const SMALL: f64 = 3.0;
/// Horizontal distance between the marks of parties that fail at the same value of the horizontal axis (mm).
pub(super) const ASIDE: f64 = 2.6;
/// Size of small marks, divided by the usual size. A small mark shows the bound of an error, or is drawn on a cross
/// (`Filling::Cross`).
pub(super) const SMALLER: f64 = 0.55;

/// How a mark is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Filling {
    /// The mark is filled with its colour.
    Full,
    /// The mark is an outline, filled with white.
    Hollow,
    /// The mark is an outline with a cross in it.
    Crossed,
    /// A cross with a small mark on it.
    Cross,
}

/// A diagram; its origin is the upper left corner of its cell.
pub(super) struct Chart {
    pub(super) figure: DrawnFigure,
    /// Lower left corner of the frame, and its size (mm).
    low: Vec2,
    size: Vec2,
    /// First and last value of both axes.
    ends: [[f64; 2]; 2],
}

impl Chart {
    /// An empty diagram in a cell of this size (mm), with first and last value of both axes.
    pub(super) fn new([width, height]: [f64; 2], ends: [[f64; 2]; 2]) -> Self {
        let [left, right, above, below] = ROOM;
        let size = Vec2::new(width - left - right, height - above - below);
        Chart { figure: DrawnFigure::default(), low: Vec2::new(left, below - height), size, ends }
    }

    /// Position on the paper that belongs to a pair of values.
    pub(super) fn at(&self, place: [f64; 2]) -> Vec2 {
        let share = |axis: usize| {
            let [low, high] = self.ends[axis].map(f64::log10);
            (place[axis].log10() - low) / (high - low)
        };
        self.low + Vec2::new(share(0), share(1)).component_mul(&self.size)
    }

    /// A band between two values of the vertical axis.
    pub(super) fn band(&mut self, [from, to]: [f64; 2], fill: &'static str) {
        let [left, right] = self.ends[0];
        let corners = rectangle([self.at([left, from]), self.at([right, to])]);
        self.figure.area(corners, Some(Tint::opaque(fill)), solid(fill, 0.0));
    }

    /// A horizontal line at a value of the vertical axis.
    pub(super) fn level(&mut self, value: f64, style: Style) {
        let ends = self.ends[0].map(|end| self.at([end, value]));
        self.figure.line(ends, style);
    }

    /// Frame, and grid lines with their numbers.
    /// The title is above; the names of the axes are below and on the left.
    pub(super) fn axes(&mut self, [along, up]: [&[f64]; 2], title: &str, [below, beside]: [&str; 2]) {
        let [low, high] = [0, 1].map(|end| self.at([self.ends[0][end], self.ends[1][end]]));
        for &value in along {
            let x = self.at([value, self.ends[1][0]]).x;
            self.figure.line([Vec2::new(x, low.y), Vec2::new(x, high.y)], GRID);
            self.figure.text(Vec2::new(x, low.y - 4.0), label(value), Type { anchor: "middle", ..words(SMALL) });
        }
        for &value in up {
            self.level(value, GRID);
            let y = self.at([self.ends[0][0], value]).y;
            self.figure.text(Vec2::new(low.x - 1.5, y - 1.0), label(value), Type { anchor: "end", ..words(SMALL) });
        }
        self.figure.area(rectangle([low, high]), None, solid(GREY, 0.25));
        self.figure.text(Vec2::new(low.x, high.y + 2.0), title, Type { bold: true, ..words(3.6) });
        let middle = Vec2::new((low.x + high.x) / 2.0, low.y - 9.0);
        self.figure.text(middle, below, Type { anchor: "middle", ..words(3.2) });
        let middle = Vec2::new(low.x - ROOM[0] + 6.0, (low.y + high.y) / 2.0);
        self.figure.text(middle, beside, Type { anchor: "middle", upward: true, ..words(3.2) });
    }

    /// Writes the reason why the diagram is empty into the middle of the frame.
    pub(super) fn empty(&mut self, why: &str) {
        let middle = self.low + self.size / 2.0;
        self.figure.text(middle, sentences::nothing_to_draw(&why), Type { anchor: "middle", ..words(3.6) });
    }
}

/// Powers of ten between two values; if there are more than `most` powers, only every second, third, ... power is
/// returned.
pub(super) fn decades([low, high]: [f64; 2], most: i32) -> Vec<f64> {
    let (first, last) = (low.log10().ceil() as i32, high.log10().floor() as i32);
    let every = (last - first) / most + 1;
    // The power is parsed from text, so that 1e-5 is the nearest double.
    let power = |power: i32| format!("1e{power}").parse().ok();
    (first..=last).filter(|power| power % every == 0).filter_map(power).collect()
}

/// A number of an axis.
pub(super) fn label(value: f64) -> String {
    if (0.01..1e5).contains(&value) { format!("{value}") } else { format!("{value:e}") }
}

/// Corners of the marks, at a distance of about one from the middle; a disc has none.
const SHAPES: [&[[f64; 2]]; 8] = [
    &[],
    &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
    &[[0.0, 1.2], [1.1, -0.9], [-1.1, -0.9]],
    &[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]],
    &[[0.0, -1.2], [1.1, 0.9], [-1.1, 0.9]],
    &[[-1.1, -1.1], [1.1, -1.1], [-1.1, 1.1], [1.1, 1.1]],
    &[
        [-0.4, -1.2],
        [0.4, -1.2],
        [0.4, -0.4],
        [1.2, -0.4],
        [1.2, 0.4],
        [0.4, 0.4],
        [0.4, 1.2],
        [-0.4, 1.2],
        [-0.4, 0.4],
        [-1.2, 0.4],
        [-1.2, -0.4],
        [-0.4, -0.4],
    ],
    &[[-1.1, -1.1], [-1.1, 1.1], [1.1, -1.1], [1.1, 1.1]],
];

/// Colour of the party with this number. Whenever the shapes of marks begin again, the colours are shifted by one, so
/// that a pair of shape and colour repeats only after many parties.
pub(super) fn colour(party: usize) -> &'static str {
    SERIES[(party + party / SHAPES.len()) % SERIES.len()].light
}

/// The mark of a party, `size` (mm) from its middle to its edge.
/// The number of the party selects colour and shape; `filling` selects the filling.
pub(super) fn mark(figure: &mut DrawnFigure, at: Vec2, size: f64, party: usize, filling: Filling) {
    let paint = colour(party);
    let corners = SHAPES[party % SHAPES.len()];
    let around = |[x, y]: [f64; 2]| at + Vec2::new(x, y) * size;
    // A white edge separates overlapping marks.
    let (fill, edge) = if filling == Filling::Full { (paint, "#ffffff") } else { ("#ffffff", paint) };
    let cross = |figure: &mut DrawnFigure| {
        for slope in [1.0, -1.0] {
            figure.line([[-1.0, -slope], [1.0, slope]].map(around), solid(paint, 0.4));
        }
    };
    match filling {
        Filling::Cross => {
            cross(figure);
            mark(figure, at, SMALLER * size, party, Filling::Full);
        }
        Filling::Full | Filling::Hollow | Filling::Crossed if corners.is_empty() => {
            figure.disc(at, size, fill, solid(edge, 0.2));
        }
        Filling::Full | Filling::Hollow | Filling::Crossed => {
            figure.area(corners.iter().copied().map(around).collect(), Some(Tint::opaque(fill)), solid(edge, 0.2));
        }
    }
    if filling == Filling::Crossed {
        cross(figure);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drawing::paper::document::document;
    use std::collections::BTreeSet;

    #[test]
    fn axis_labels_are_powers_of_ten_and_limited_in_number() {
        assert_eq!(
            decades([3e-3, 2e3], 8).into_iter().map(label).collect::<Vec<_>>(),
            ["0.01", "0.1", "1", "10", "100", "1000"]
        );
        for most in 1..12 {
            let found = decades([3e-15, 4e7], most);
            assert!(found.len() <= most as usize + 1, "{most}: {found:?}");
            assert!(found.iter().all(|value| format!("{value:e}").starts_with("1e")), "{found:?}");
        }
    }

    /// Symptom: two parties were orange, and two parties were blue.
    #[test]
    fn regress_no_two_parties_look_alike() {
        let looks = |party: usize, filling: Filling| {
            let mut figure = DrawnFigure::default();
            mark(&mut figure, Vec2::zeros(), 1.0, party, filling);
            document(&figure, [10.0, 10.0], "")
        };
        let fillings = [Filling::Full, Filling::Hollow, Filling::Crossed, Filling::Cross];
        let all: BTreeSet<String> =
            fillings.iter().flat_map(|&own| (0..64).map(move |party| looks(party, own))).collect();
        assert_eq!(all.len(), 4 * 64);
        // The first eight parties differ in colour, and without colours in shape.
        let colours: BTreeSet<&str> = (0..8).map(colour).collect();
        let shapes: BTreeSet<String> = SHAPES.iter().map(|shape| format!("{shape:?}")).collect();
        assert_eq!([colours.len(), shapes.len()], [8; 2]);
    }
}
