//! Places labels at points so that they touch neither lines nor each other.
//! Each label takes the position of lowest cost around its anchor, in a few rounds.

use super::figure::{DrawnFigure, Type, solid, width, words};
use super::style::GREY;
use crate::guide::inside;
use linkage::math::{KeepNan, Vec2};

/// Clearance between a label and lines (mm).
const AIR: f64 = 0.5;
/// Directions tried around an anchor.
const DIRECTIONS: usize = 32;
/// Distances tried (mm), nearest first.
const DISTANCES: [f64; 9] = [0.6, 1.2, 2.0, 3.0, 4.5, 6.5, 9.0, 12.0, 16.0];
/// Upper limit of the number of rounds. In practice, labels no longer move after so many rounds.
const ROUNDS: usize = 6;
/// Largest distance (mm) between two points whose labels may exchange positions.
const NEIGHBOURS: f64 = 12.0;

/// Upper limit of the number of all comparisons of labels with their surroundings.
/// Beyond this limit, labels take their first position.
/// A drawing of hundreds of links has no space for their names anyway.
const MOST_COMPARED: usize = 200_000_000;
/// If many drawings are made together, such as frames, each drawing may use at least this number of comparisons.
const LEAST_COMPARED: usize = 10_000_000;

/// Font size of labels (mm).
pub const LETTER: f64 = 4.2;
/// A line connects a label with its point if the distance between the two is larger than this (mm).
/// The value is for labels of the font size [`LETTER`]; for other labels, the distance is proportional to the font
/// size.
const FAR: f64 = 3.2;

/// A label to be placed; paper coordinates (mm), y upwards.
#[derive(Clone, Copy, Debug)]
pub struct PlacedLabel {
    /// The point that the label names.
    pub anchor: Vec2,
    /// Preferred direction from the anchor; zero if there is no preferred direction.
    pub away: Vec2,
    /// Width and height of the label's box (mm).
    pub size: Vec2,
    /// Radius (mm) of the area that the mark at the anchor covers.
    pub clear: f64,
}

/// Elements that labels must not touch.
#[derive(Clone, Debug, Default)]
pub struct Obstacles {
    /// Lines.
    pub segments: Vec<[Vec2; 2]>,
    /// Marks: centre and radius.
    pub discs: Vec<(Vec2, f64)>,
}

/// Centres of the labels' boxes in one of several drawings made together. These drawings share the allowed work.
pub fn place_among(labels: &[PlacedLabel], obstacles: &Obstacles, drawings: usize) -> Vec<Vec2> {
    place_within(labels, obstacles, (MOST_COMPARED / drawings.max(1)).max(LEAST_COMPARED))
}

fn place_within(labels: &[PlacedLabel], obstacles: &Obstacles, most: usize) -> Vec<Vec2> {
    let mut places: Vec<Option<Vec2>> = vec![None; labels.len()];
    // Remaining calls of `cheapest`.
    let each = DIRECTIONS * DISTANCES.len() * (labels.len() + obstacles.segments.len() + obstacles.discs.len());
    let mut left = most / each.max(1);
    for _ in 0..ROUNDS {
        let before = places.clone();
        for index in 0..labels.len() {
            if left == 0 {
                places[index] = places[index].or_else(|| candidates(&labels[index]).next());
                continue;
            }
            left -= 1;
            places[index] = cheapest(index, labels, &places, obstacles);
        }
        trade(labels, &mut places, obstacles, &mut left);
        if places == before {
            break;
        }
    }
    places.into_iter().zip(labels).map(|(place, label)| place.unwrap_or(label.anchor)).collect()
}

/// Lets neighbouring labels exchange positions if the exchange lowers their total cost.
/// Without exchanges, a label would keep its position even if its neighbour needs this position more.
/// Each pair of neighbours needs two calls of `cheapest`. `left` is the number of calls that remain.
fn trade(labels: &[PlacedLabel], places: &mut [Option<Vec2>], obstacles: &Obstacles, left: &mut usize) {
    let both = |a: usize, b: usize, places: &[Option<Vec2>]| {
        let one = |index: usize| places[index].map_or(f64::INFINITY, |at| cost(index, at, labels, places, obstacles));
        one(a) + one(b)
    };
    for a in 0..labels.len() {
        for b in 0..labels.len() {
            if a == b || (labels[a].anchor - labels[b].anchor).norm() > NEIGHBOURS {
                continue;
            }
            if *left < 2 {
                return;
            }
            *left -= 2;
            let (old, was) = ([places[a], places[b]], both(a, b, places));
            places[b] = None;
            places[a] = cheapest(a, labels, places, obstacles);
            places[b] = cheapest(b, labels, places, obstacles);
            // An exchange without gain is undone. Otherwise the two labels would be exchanged back and forth.
            if !(both(a, b, places) < was - 1e-9) {
                [places[a], places[b]] = old;
            }
        }
    }
}

fn cheapest(index: usize, labels: &[PlacedLabel], places: &[Option<Vec2>], obstacles: &Obstacles) -> Option<Vec2> {
    candidates(&labels[index])
        .map(|place| (cost(index, place, labels, places, obstacles), place))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, place)| place)
}

fn candidates(label: &PlacedLabel) -> impl Iterator<Item = Vec2> + '_ {
    let directions = (0..DIRECTIONS).map(|k| linkage::math::unit(std::f64::consts::TAU * k as f64 / DIRECTIONS as f64));
    directions.flat_map(move |direction| {
        DISTANCES.into_iter().map(move |distance| {
            // The box is placed so that its side or corner that faces the anchor touches the end of the ray.
            let half = label.size / 2.0;
            let reach = (half.x / direction.x.abs().larger(1e-9)).smaller(half.y / direction.y.abs().larger(1e-9));
            label.anchor + direction * (label.clear + distance + reach)
        })
    })
}

fn cost(index: usize, place: Vec2, labels: &[PlacedLabel], places: &[Option<Vec2>], obstacles: &Obstacles) -> f64 {
    let label = &labels[index];
    let offset = place - label.anchor;
    let distance = offset.norm();
    let mut cost = 0.5 * (distance - label.clear);
    if label.away.norm() > 0.0 {
        cost += 1.2 * (1.0 - offset.dot(&label.away) / (distance * label.away.norm()));
    }
    let half = label.size / 2.0 + Vec2::new(AIR, AIR);
    for segment in &obstacles.segments {
        let inside = length_inside(segment, place, half);
        if inside > 0.0 {
            cost += 12.0 + 3.0 * inside;
        }
    }
    for &(centre, radius) in &obstacles.discs {
        let gap = (centre - place).abs() - half;
        let gap = Vec2::new(gap.x.larger(0.0), gap.y.larger(0.0)).norm();
        if gap < radius {
            cost += 15.0 + 4.0 * (radius - gap);
        }
    }
    for (other, at) in labels.iter().zip(places).enumerate().filter(|(k, _)| *k != index).map(|(_, pair)| pair) {
        if let Some(at) = at {
            let overlap = (label.size + other.size) / 2.0 + Vec2::new(AIR, AIR) - (place - at).abs();
            if overlap.x > 0.0 && overlap.y > 0.0 {
                cost += 40.0 + 10.0 * overlap.x.smaller(overlap.y);
            }
            // The line from a label to its point must not pass through another label, so crossed labels add to the
            // cost.
            let crossed = length_inside(&[label.anchor, place], *at, other.size / 2.0)
                + length_inside(&[other.anchor, *at], place, label.size / 2.0);
            cost += if crossed > 0.0 { 7.0 } else { 0.0 };
        }
        // A label nearer to another point than to its anchor is misleading, so such a position costs more.
        if (other.anchor - place).norm() < distance {
            cost += 9.0;
        }
    }
    cost
}

/// Length of the part of a segment inside the box around `centre`.
fn length_inside(segment: &[Vec2; 2], centre: Vec2, half: Vec2) -> f64 {
    inside(segment, centre, half).map_or(0.0, |[from, to]| (to - from) * (segment[1] - segment[0]).norm())
}

/// Box of a label at the font size `size` (mm), subscripts included.
/// The box is a little larger than the letters, because viewers may use other fonts than the bundled font.
pub fn label_size(text: &str, size: f64) -> Vec2 {
    Vec2::new(1.05 * width(text, size), 1.15 * size)
}

/// Usual type of labels: centred, italic, font size [`LETTER`].
pub const fn lettering(colour: &'static str) -> Type {
    Type { anchor: "middle", italic: true, colour, ..words(LETTER) }
}

/// Draws a line from a label at the position `at` to the label's point, if the two are far apart.
/// `size` is the font size of the label (mm).
pub fn leader(figure: &mut DrawnFigure, label: &PlacedLabel, at: Vec2, size: f64) {
    let toward = label.anchor - at;
    let half = label.size / 2.0;
    let edge = (half.x / toward.x.abs().larger(1e-9)).smaller(half.y / toward.y.abs().larger(1e-9));
    if toward.norm() * (1.0 - edge) > FAR * (size / LETTER) + label.clear {
        let end = label.anchor - toward.normalize() * (label.clear + 0.2);
        figure.line([at + toward * edge, end], solid(GREY, 0.15));
    }
}

/// Draws a label at the position `at`. If the label's point is far away, a line connects the label with the point.
pub fn letter(figure: &mut DrawnFigure, label: &PlacedLabel, at: Vec2, text: &str, set: Type) {
    leader(figure, label, at, set.size);
    figure.text(at - Vec2::new(0.0, 0.28 * set.size), text, set);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(x: f64, y: f64) -> PlacedLabel {
        PlacedLabel { anchor: Vec2::new(x, y), away: Vec2::new(1.0, 0.0), size: Vec2::new(3.0, 3.0), clear: 0.5 }
    }

    #[test]
    fn the_length_inside_a_box_is_measured() {
        let half = Vec2::new(1.0, 2.0);
        let inside = |a: [f64; 2], b: [f64; 2]| length_inside(&[a.into(), b.into()], Vec2::zeros(), half);
        for (a, b, length) in [
            ([-5.0, 0.0], [5.0, 0.0], 2.0),
            ([0.0, -5.0], [0.0, 1.0], 3.0),
            ([3.0, -5.0], [3.0, 5.0], 0.0),
            ([-5.0, 4.0], [5.0, 4.0], 0.0),
        ] {
            // The tolerance is the rounding error of two quotients, times the segment's length, which is at most ten.
            assert!((inside(a, b) - length).abs() <= 20.0 * f64::EPSILON);
        }
    }

    #[test]
    fn labels_avoid_lines_and_each_other() {
        let obstacles = Obstacles {
            segments: vec![
                [Vec2::new(-20.0, 0.0), Vec2::new(20.0, 0.0)],
                [Vec2::new(0.0, -20.0), Vec2::new(0.0, 20.0)],
            ],
            discs: Vec::new(),
        };
        let labels = [label(0.0, 0.0), label(0.5, 0.0), label(0.0, 0.4), label(-0.3, 0.0)];
        let places = place_among(&labels, &obstacles, 1);
        for (index, at) in places.iter().enumerate() {
            let half = labels[index].size / 2.0;
            assert!(obstacles.segments.iter().all(|line| length_inside(line, *at, half) == 0.0), "{at:?}");
            for other in &places[index + 1..] {
                let gap = (at - other).abs();
                assert!(gap.x >= 3.0 || gap.y >= 3.0, "{at:?} {other:?}");
            }
        }
    }

    #[test]
    fn crowded_labels_still_get_positions() {
        // Each of 2000 labels compares 288 positions with all other labels, twice for every pair of neighbours.
        // In total, these are more than 1e12 comparisons, far above the limit `MOST_COMPARED`.
        let crowd: Vec<PlacedLabel> = (0..2000).map(|k| label(0.01 * f64::from(k), 0.0)).collect();
        let places = place_within(&crowd, &Obstacles::default(), 10_000_000);
        assert!(places.iter().zip(&crowd).all(|(at, own)| (at - own.anchor).norm() < 25.0), "{places:?}");
    }

    #[test]
    fn an_unobstructed_label_is_at_its_preferred_position() {
        let places = place_among(&[label(0.0, 0.0)], &Obstacles::default(), 1);
        assert!(places[0].x > 1.5 && places[0].y.abs() < 1e-9);
    }
}
