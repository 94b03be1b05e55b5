//! Dimensions on paper: dimension lines, extension lines, angles and their numbers.

use super::dimension::{Dimension, DimensionLine, Measure};
use super::mark::MarkShape;
use super::paper::figure::{Style, Type, solid};
use super::paper::labels::lettering;
use super::paper::style::{BLACK, colour};
use super::picture::Picture;
use linkage::math::{Vec2, corners, turned, unit};
use linkage::mechanism::{GROUND, Mechanism};

/// Distance of the first dimension line from a link, and of further lines from each other (mm).
const FIRST: f64 = 7.0;
const APART: f64 = 6.5;
/// Distance of an extension line from its point, and its length beyond the dimension line (mm).
const FREE: f64 = 1.6;
const BEYOND: f64 = 1.2;
/// Half length of the stroke at an end of a dimension line (mm).
const STROKE: f64 = 0.8;
/// Line widths (mm).
const THIN: f64 = 0.2;
const THINNEST: f64 = 0.13;
/// Radius of the arc of an angle, and length of its sides (mm).
const ARC: f64 = 9.0;
const SIDE: f64 = 11.0;

impl Picture<'_> {
    /// Draws dimensions. The marks must be drawn first, because distances of the ground are drawn outside all marks.
    pub fn draw_dimensions(&mut self, mechanism: &Mechanism, all: &[Dimension]) {
        let bounds = self.figure.bounds();
        self.figure.set_layer("dimensions");
        let middle = self.middle(mechanism);
        for own in all {
            let places = super::body::places(mechanism, own.link);
            let ends =
                |[from, to]: [usize; 2]| Some([self.at(own.link, places[from])?, self.at(own.link, places[to])?]);
            match &own.measure {
                Measure::Length { from, to, line } => {
                    if let Some(ends) = ends([*from, *to]) {
                        self.draw_length(own, ends, *line, middle);
                    }
                }
                Measure::Offset { axis, from, to, row } => {
                    let points: Vec<Vec2> = std::iter::once(from).chain(to).map(|&k| places[k] / self.scale).collect();
                    self.draw_offset(own, &points, *axis, *row, bounds);
                }
                Measure::Angle { at, sides, .. } => self.draw_angle(own, *at, *sides),
                Measure::Radius { at, radius } => {
                    // The number is beside the wheel, at 45 degrees above the horizontal.
                    let Some(axle) = self.at(own.link, *at) else { continue };
                    let away = unit(std::f64::consts::FRAC_PI_4);
                    self.letters(axle + away * (radius / self.scale), away, 0.6, own.text.clone(), BLACK);
                }
            }
        }
    }

    /// The middle of all joints on paper.
    /// Dimension lines are drawn on the side of a link that faces away from this middle.
    fn middle(&self, mechanism: &Mechanism) -> Vec2 {
        let joints = mechanism.joints().iter().filter_map(|joint| self.at(joint.first.link, joint.first.local));
        let [low, high] = corners(joints);
        if low.x <= high.x { (low + high) / 2.0 } else { Vec2::zeros() }
    }

    fn draw_length(&mut self, own: &Dimension, ends: [Vec2; 2], line: DimensionLine, middle: Vec2) {
        let (paint, between) = (colour(own.link), (ends[0] + ends[1]) / 2.0);
        match line {
            DimensionLine::Edge => self.letters(between, Vec2::zeros(), 0.4, own.text.clone(), BLACK),
            DimensionLine::Across => {
                self.thin_line(ends, solid(paint, THIN));
                self.letters(between, Vec2::zeros(), 0.4, own.text.clone(), BLACK);
            }
            DimensionLine::Outside(row) => {
                let normal = turned(ends[1] - ends[0]).normalize();
                let away = if normal.dot(&(between - middle)) < 0.0 { -normal } else { normal };
                let level = FIRST + APART * row as f64;
                for end in ends {
                    self.thin_line([FREE, level + BEYOND].map(|way| end + away * way), solid(paint, THINNEST));
                }
                self.dimension_line(ends.map(|end| end + away * level), away, own, lettering(BLACK));
            }
        }
    }

    /// Draws a distance between points of the ground, with extension lines to these points.
    /// A horizontal distance is drawn below all marks, and a vertical distance is drawn to the right of all marks.
    fn draw_offset(&mut self, own: &Dimension, points: &[Vec2], axis: usize, row: usize, [low, high]: [Vec2; 2]) {
        let [_, to, ..] = points else { return };
        let level = FIRST + APART * row as f64;
        let away = if axis == 0 { -Vec2::y() } else { Vec2::x() };
        let onto = |at: Vec2| match axis {
            0 => Vec2::new(at.x, low.y - level),
            _ => Vec2::new(high.x + level, at.y),
        };
        // If several points have the same distance, the extension line of the point farthest from the dimension line
        // passes all others.
        let far = points[1..].iter().max_by(|a, b| (*a - onto(**a)).norm().total_cmp(&(*b - onto(**b)).norm()));
        for at in [Some(&points[0]), far].into_iter().flatten() {
            self.thin_line([at + away * FREE, onto(*at) + away * BEYOND], solid(colour(GROUND), THINNEST));
        }
        let set = Type { upward: axis == 1, ..lettering(BLACK) };
        self.dimension_line([onto(points[0]), onto(*to)], away, own, set);
    }

    fn draw_angle(&mut self, own: &Dimension, at: Vec2, sides: [f64; 2]) {
        let Some([vertex, toward]) =
            self.at(own.link, at).zip(self.at(own.link, at + Vec2::x() * self.scale)).map(|(a, b)| [a, b - a])
        else {
            return;
        };
        let (paint, turn) = (colour(own.link), toward.y.atan2(toward.x));
        let [from, to] = sides.map(|side| side + turn);
        for side in [from, to] {
            self.thin_line([vertex, vertex + unit(side) * SIDE], solid(paint, THINNEST));
        }
        let arc = MarkShape::Arc { centre: vertex, radius: ARC, from, sweep: to - from }.points();
        self.obstacles.segments.extend(arc.windows(2).map(|pair| [pair[0], pair[1]]));
        self.figure.curve(arc, None, solid(paint, THIN));
        let away = unit((from + to) / 2.0);
        self.letters(vertex + away * ARC, away, 0.4, own.text.clone(), BLACK);
    }

    /// A dimension line with oblique strokes at its ends, and its number on the side `away`.
    fn dimension_line(&mut self, ends: [Vec2; 2], away: Vec2, own: &Dimension, set: Type) {
        let paint = colour(own.link);
        self.thin_line(ends, solid(paint, THIN));
        let along = (ends[1] - ends[0]).normalize();
        let stroke = (along + turned(along)) * STROKE;
        for end in ends {
            self.figure.line([end - stroke, end + stroke], solid(paint, THIN));
        }
        self.set_letters((ends[0] + ends[1]) / 2.0, away, 0.2, own.text.clone(), set);
    }

    /// A line that labels must not touch.
    fn thin_line(&mut self, ends: [Vec2; 2], style: Style) {
        self.obstacles.segments.push(ends);
        self.figure.line(ends, style);
    }
}
