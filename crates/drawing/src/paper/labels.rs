//! Places labels at points so that they touch neither lines nor each other.
//! In each of a few rounds, every label takes the position around its anchor that has the lowest cost.

use super::figure::{DrawnFigure, Type, solid, width, words};
use super::style::GREY;
use crate::guide::inside;
use crate::paths::Glyphs;
use linkage::math::{KeepNan, Vec2};

/// Clearance between a label and lines or other labels (mm).
pub const AIR: f64 = 0.5;
/// Number of directions that are tried around an anchor.
const DIRECTIONS: usize = 32;
/// Distances from the anchor's mark that are tried (mm), the smallest first.
const DISTANCES: [f64; 10] = [0.6, 1.2, 2.0, 3.0, 4.5, 6.5, 9.0, 12.0, 16.0, 21.0];
/// A label that still meets another label after all rounds is moved outwards in steps of this length (mm).
/// `RINGS` is the largest number of steps.
const OUTWARD: f64 = 3.0;
const RINGS: usize = 60;
/// Largest number of rounds. In practice, labels stop moving earlier.
const ROUNDS: usize = 6;
/// Largest distance (mm) between two points whose labels may exchange positions.
const NEIGHBOURS: f64 = 12.0;

/// Largest number of comparisons of labels with other labels, lines and marks. Beyond this limit, labels take their
/// first position.
/// The limit matters only for drawings of hundreds of links, which have no space for all names.
const MOST_COMPARED: usize = 200_000_000;
/// If many drawings are made together, such as frames, each drawing may use at least this number of comparisons.
const LEAST_COMPARED: usize = 20_000_000;

/// Costs of an overlap with another label, a line or a mark: for the overlap itself, and for each millimetre of
/// overlap.
/// A position without an overlap costs less than any position with an overlap, unless a leader crosses a label.
const ON_LABEL: [f64; 2] = [400.0, 10.0];
const ON_LINE: [f64; 2] = [40.0, 3.0];
const ON_MARK: [f64; 2] = [45.0, 4.0];
/// `AWAY` is the cost of a millimetre of distance, and `CROSSED` the cost of a leader that passes through another
/// label.
/// A label is misleading if the point of another label is nearer to it than its own point.
/// `MISLEADING` is the cost of each such point, and the largest total cost of all such points.
const AWAY: f64 = 0.5;
const CROSSED: f64 = 12.0;
const MISLEADING: [f64; 2] = [9.0, 18.0];

/// Font size of labels (mm).
pub const LETTER: f64 = 4.2;
/// A line connects a label with its point if their distance is larger than this (mm), for labels of the font size
/// [`LETTER`].
/// At another font size, this limit is scaled in proportion.
const FAR: f64 = 3.2;
/// How far a slanted letter leans over the end of its text, divided by the font size.
const SLANT: f64 = 0.15;

/// A label that must be placed. Coordinates are on paper (mm), y upwards.
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

impl Obstacles {
    /// The obstacles so near to a label that they matter at the tried distances.
    fn near(&self, label: &PlacedLabel) -> Obstacles {
        let reach = Vec2::repeat(label.clear + DISTANCES[DISTANCES.len() - 1] + label.size.norm() + AIR);
        let (least, most) = (label.anchor - reach, label.anchor + reach);
        let is_near =
            |[low, high]: [Vec2; 2]| low.x <= most.x && low.y <= most.y && high.x >= least.x && high.y >= least.y;
        let segments = self.segments.iter().filter(|[a, b]| is_near([a.inf(b), a.sup(b)])).copied().collect();
        let discs = self.discs.iter().filter(|(at, r)| is_near([at.add_scalar(-r), at.add_scalar(*r)]));
        Obstacles { segments, discs: discs.copied().collect() }
    }
}

/// A position that a label may take, with its cost. The cost includes lines, marks and the points of other labels, but
/// not overlaps with other labels.
#[derive(Clone, Copy)]
struct Spot {
    at: Vec2,
    cost: f64,
}

/// Places the labels of one drawing and returns the centres of their boxes.
/// `drawings` is the number of drawings that are made together: they share the allowed number of comparisons.
pub fn place_among(labels: &[PlacedLabel], obstacles: &Obstacles, drawings: usize) -> Vec<Vec2> {
    Placer::of(labels, obstacles, (MOST_COMPARED / drawings.max(1)).max(LEAST_COMPARED)).placed()
}

struct Placer<'a> {
    labels: &'a [PlacedLabel],
    obstacles: &'a Obstacles,
    /// The positions of each label, cheapest first.
    spots: Vec<Vec<Spot>>,
    /// The chosen position of each label, as an index into `spots`.
    chosen: Vec<Option<usize>>,
    /// Comparisons that remain.
    left: usize,
}

impl<'a> Placer<'a> {
    fn of(labels: &'a [PlacedLabel], obstacles: &'a Obstacles, most: usize) -> Placer<'a> {
        let mut placer = Placer { labels, obstacles, spots: Vec::new(), chosen: vec![None; labels.len()], left: most };
        let work = DIRECTIONS * DISTANCES.len() * (labels.len() + obstacles.segments.len() + obstacles.discs.len());
        for (index, label) in labels.iter().enumerate() {
            let candidates = DISTANCES.into_iter().flat_map(|distance| ring(label, distance));
            let near = obstacles.near(label);
            let mut spots: Vec<Spot> = match placer.spend(work) {
                true => candidates.map(|at| Spot { at, cost: placer.standing(index, at, &near) }).collect(),
                false => candidates.take(1).map(|at| Spot { at, cost: 0.0 }).collect(),
            };
            spots.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            placer.spots.push(spots);
        }
        placer
    }

    /// Subtracts `work` from the comparisons that remain. Returns false if too few remain.
    fn spend(&mut self, work: usize) -> bool {
        let is_left = self.left >= work;
        self.left -= if is_left { work } else { self.left };
        is_left
    }

    fn placed(mut self) -> Vec<Vec2> {
        for _ in 0..ROUNDS {
            let before = self.chosen.clone();
            for index in 0..self.labels.len() {
                self.chosen[index] = self.cheapest(index).or(self.chosen[index]).or(Some(0));
            }
            self.trade();
            if self.chosen == before {
                break;
            }
        }
        self.settled()
    }

    fn at(&self, index: usize) -> Option<Vec2> {
        self.chosen[index].map(|spot| self.spots[index][spot].at)
    }

    /// The cheapest position of a label, given the positions of the other labels. `None` if no comparisons remain.
    fn cheapest(&mut self, index: usize) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        for k in 0..self.spots[index].len() {
            let spot = self.spots[index][k];
            if best.is_some_and(|(cost, _)| spot.cost >= cost) {
                break;
            }
            if !self.spend(self.labels.len()) {
                return None;
            }
            let cost = spot.cost + self.among_labels(index, spot.at);
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, k));
            }
        }
        best.map(|(_, spot)| spot)
    }

    /// Lets neighbouring labels exchange positions if the exchange lowers their total cost.
    /// Without exchanges, a label would keep a position that its neighbour needs more.
    fn trade(&mut self) {
        let one = |own: &Self, index: usize| {
            let spot = own.chosen[index].map(|spot| own.spots[index][spot]);
            spot.map_or(f64::INFINITY, |spot| spot.cost + own.among_labels(index, spot.at))
        };
        for a in 0..self.labels.len() {
            for b in 0..self.labels.len() {
                let apart = (self.labels[a].anchor - self.labels[b].anchor).norm();
                if a == b || apart > NEIGHBOURS {
                    continue;
                }
                let (old, was) = ([self.chosen[a], self.chosen[b]], one(self, a) + one(self, b));
                self.chosen[b] = None;
                let first = self.cheapest(a);
                self.chosen[a] = first.or(old[0]);
                let second = self.cheapest(b);
                self.chosen[b] = second;
                // An exchange that does not lower the cost is undone, because it could be repeated back and forth
                // without end.
                if first.is_none() || second.is_none() || !(one(self, a) + one(self, b) < was - 1e-9) {
                    [self.chosen[a], self.chosen[b]] = old;
                }
                if self.left == 0 {
                    return;
                }
            }
        }
    }

    /// The final positions. A label that still meets an earlier label is moved outwards to a free position.
    fn settled(mut self) -> Vec<Vec2> {
        self.left = self.left.max(LEAST_COMPARED);
        let labels = self.labels;
        let chosen = |index: usize| self.at(index).unwrap_or(labels[index].anchor);
        let mut places: Vec<Vec2> = (0..labels.len()).map(chosen).collect();
        for index in 0..labels.len() {
            let meets = |at: Vec2, others: &[Vec2]| {
                let mut pairs = labels.iter().zip(others).enumerate().filter(|(k, _)| *k != index);
                pairs.any(|(_, (other, place))| overlap(&labels[index], at, other, *place) > 0.0)
            };
            if !meets(places[index], &places[..index]) {
                continue;
            }
            for step in 0..RINGS {
                if !self.spend(DIRECTIONS * (labels.len() + self.obstacles.segments.len())) {
                    return places;
                }
                let distance = OUTWARD * step as f64;
                let free = ring(&labels[index], distance).filter(|at| !meets(*at, &places));
                let cost = |at: Vec2| self.standing(index, at, self.obstacles);
                let best = free.min_by(|a, b| cost(*a).total_cmp(&cost(*b)));
                if let Some(at) = best {
                    places[index] = at;
                    break;
                }
            }
        }
        places
    }

    /// The cost of a position because of lines, marks and the points of other labels.
    fn standing(&self, index: usize, place: Vec2, obstacles: &Obstacles) -> f64 {
        let label = &self.labels[index];
        let offset = place - label.anchor;
        let distance = offset.norm();
        let mut cost = AWAY * (distance - label.clear);
        if label.away.norm() > 0.0 {
            cost += 1.2 * (1.0 - offset.dot(&label.away) / (distance * label.away.norm()));
        }
        let half = label.size / 2.0 + Vec2::new(AIR, AIR);
        for segment in &obstacles.segments {
            let inside = length_inside(segment, place, half);
            if inside > 0.0 {
                cost += ON_LINE[0] + ON_LINE[1] * inside;
            }
        }
        for &(centre, radius) in &obstacles.discs {
            let gap = (centre - place).abs() - half;
            let gap = Vec2::new(gap.x.larger(0.0), gap.y.larger(0.0)).norm();
            if gap < radius {
                cost += ON_MARK[0] + ON_MARK[1] * (radius - gap);
            }
        }
        // A label nearer to another point than to its anchor is misleading, so such a position costs more.
        let others = self.labels.iter().enumerate().filter(|(k, _)| *k != index);
        let nearer = others.filter(|(_, other)| (other.anchor - place).norm() < distance).count();
        cost + (MISLEADING[0] * nearer as f64).smaller(MISLEADING[1])
    }

    /// The cost of a position because of the labels that already have positions.
    fn among_labels(&self, index: usize, place: Vec2) -> f64 {
        let label = &self.labels[index];
        let mut cost = 0.0;
        for (k, other) in self.labels.iter().enumerate().filter(|(k, _)| *k != index) {
            let Some(at) = self.at(k) else { continue };
            let depth = overlap(label, place, other, at);
            cost += if depth > 0.0 { ON_LABEL[0] + ON_LABEL[1] * depth } else { 0.0 };
            // The line from a label to its point must not pass through another label, so crossed labels add to the
            // cost.
            let crossed = length_inside(&[label.anchor, place], at, other.size / 2.0)
                + length_inside(&[other.anchor, at], place, label.size / 2.0);
            cost += if crossed > 0.0 { CROSSED } else { 0.0 };
        }
        cost
    }
}

/// Depth by which the boxes of two labels at these positions overlap, including the clearance (mm).
/// The result is 0 or negative if the boxes do not meet.
fn overlap(label: &PlacedLabel, place: Vec2, other: &PlacedLabel, at: Vec2) -> f64 {
    let depth = (label.size + other.size) / 2.0 + Vec2::new(AIR, AIR) - (place - at).abs();
    depth.x.smaller(depth.y)
}

/// Positions of a label around its anchor. The label's box has this distance from the mark at the anchor.
fn ring(label: &PlacedLabel, distance: f64) -> impl Iterator<Item = Vec2> {
    let (anchor, half, clear) = (label.anchor, label.size / 2.0, label.clear);
    let directions = (0..DIRECTIONS).map(|k| linkage::math::unit(std::f64::consts::TAU * k as f64 / DIRECTIONS as f64));
    directions.map(move |direction| {
        // `reach` is the distance from the centre of the box to its edge, in the direction of the anchor.
        let reach = (half.x / direction.x.abs().larger(1e-9)).smaller(half.y / direction.y.abs().larger(1e-9));
        anchor + direction * (clear + distance + reach)
    })
}

/// Length of the part of a segment inside the box around `centre`.
fn length_inside(segment: &[Vec2; 2], centre: Vec2, half: Vec2) -> f64 {
    let (from, to) = (segment[0] - centre, segment[1] - centre);
    let is_beside = |axis: usize| {
        from[axis] > half[axis] && to[axis] > half[axis] || from[axis] < -half[axis] && to[axis] < -half[axis]
    };
    // Nearly all segments are beside the box.
    if is_beside(0) || is_beside(1) {
        return 0.0;
    }
    inside(segment, centre, half).map_or(0.0, |[from, to]| (to - from) * (segment[1] - segment[0]).norm())
}

/// Box of a label at the font size `size` (mm), subscripts included.
/// The box is a little larger than the letters, because viewers may use other fonts than the bundled font.
pub fn label_size(text: &str, size: f64) -> Vec2 {
    let wide = Glyphs::bundled().width(text, size).larger(width(text, size));
    Vec2::new(1.05 * wide + SLANT * size, 1.15 * size)
}

/// The boxes of all texts of a figure, measured in the bundled font: lower left and upper right corner (mm).
pub fn text_boxes(figure: &DrawnFigure) -> Vec<[Vec2; 2]> {
    let of_text = |(at, text, set): (Vec2, &str, &Type)| {
        let wide = Glyphs::bundled().width(text, set.size);
        let left = match set.anchor {
            "middle" => wide / 2.0,
            "end" => wide,
            _ => 0.0,
        };
        let along = |x: f64, y: f64| at + if set.upward { Vec2::new(-y, x) } else { Vec2::new(x, y) };
        linkage::math::corners([along(-left, -0.2 * set.size), along(wide - left, 0.75 * set.size)])
    };
    figure.texts().map(of_text).collect()
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
    let down = 0.28 * set.size;
    figure.text(at + if set.upward { Vec2::new(down, 0.0) } else { Vec2::new(0.0, -down) }, text, set);
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
        // For every pair of neighbours among the 2000 labels, both labels are compared with all other labels, at 320
        // positions each.
        // Without a limit, these would be more than 1e12 comparisons, far more than `MOST_COMPARED`.
        let crowd: Vec<PlacedLabel> = (0..2000).map(|k| label(0.01 * f64::from(k), 0.0)).collect();
        let places = Placer::of(&crowd, &Obstacles::default(), 10_000_000).placed();
        assert!(
            places.iter().zip(&crowd).all(|(at, own)| (at - own.anchor).norm() < 25.0 + OUTWARD * RINGS as f64),
            "{places:?}"
        );
    }

    /// The positions at the tried distances do not suffice for 24 wide labels at nearly the same point.
    #[test]
    fn no_two_labels_meet_even_where_there_is_no_room() {
        let wide = |k: u32| PlacedLabel { size: Vec2::new(30.0, 9.0), ..label(0.1 * f64::from(k), 0.0) };
        let labels: Vec<PlacedLabel> = (0..24).map(wide).collect();
        let places = place_among(&labels, &Obstacles::default(), 1);
        for (k, at) in places.iter().enumerate() {
            assert!((0..k).all(|other| overlap(&labels[k], *at, &labels[other], places[other]) <= 0.0), "{k}: {at:?}");
        }
    }

    #[test]
    fn an_unobstructed_label_is_at_its_preferred_position() {
        let places = place_among(&[label(0.0, 0.0)], &Obstacles::default(), 1);
        assert!(places[0].x > 1.5 && places[0].y.abs() < 1e-9);
    }
}
