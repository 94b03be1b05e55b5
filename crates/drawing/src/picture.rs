//! The picture of a sketch on paper: links at their poses, names, arrows, dimensions and gaps.

use super::acting::Acting;
use super::mark::{Fill, Ink, Layer, Look, Mark, MarkRole, MarkShape};
use super::palette::LOAD;
use super::paper::figure::{DrawnFigure, Style, Tint, Type, solid, sub, words};
use super::paper::labels::{self, LETTER, Obstacles, label_size, letter, lettering, place_among};
use super::paper::style::{BLACK, GREY, colour, significant};
use super::sign::{arrow, turning};
use super::sketch::{Lettering, Sketch, SketchLabel};
use super::stretched::Stretched;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, LinkId, LinkPose};

/// Radius (mm) of the disc around a link's number. `CLEAR` is the radius of the area that a pin covers.
pub(super) const NUMBER: f64 = 2.3;
const CLEAR: f64 = 1.4;
/// Radius (mm) above which a circle has space for labels inside.
const WHEEL: f64 = 6.0;
/// If points are closer to each other on paper than this distance (mm), they share one label.
const ONE: f64 = 0.7;
/// Dimensions of arrows (mm): `FORCE` is the length for the largest force, and `GRAVITY` the length for gravity.
/// `MOMENT` is the radius of the arrows of moments.
const FORCE: f64 = 22.0;
const GRAVITY: f64 = 12.0;
const MOMENT: f64 = 6.5;
/// A force or moment is not drawn if it is a rounding error: below `LEAST` times the largest force or moment, or below
/// `NOTHING` (N, N m).
const LEAST: f64 = 1e-6;
const NOTHING: f64 = 1e-9;
/// Dash patterns: `LOOSE` for links whose pose is uncertain, `CONSTRUCTION` for construction lines.
const LOOSE: &str = "2 1.4";
const CONSTRUCTION: &str = "4 1 0.5 1";
/// Half the angle of the arc that represents a circle of reachable points (rad).
const REACH: f64 = 0.7;
/// For the placement of labels, a path is replaced by at most this number of straight pieces. Labels must not touch
/// these pieces.
const PIECES: usize = 60;
/// Opacity of tints.
const TINT: f64 = 0.14;

/// Colour of faults.
pub const ALARM: &str = "#d11149";

/// Pose of a link in a picture, and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinkPlacement {
    /// Exact pose.
    Here(LinkPose),
    /// Approximate pose: the link is drawn with dashes.
    Loose(LinkPose),
    /// No pose: the link is not drawn.
    Nowhere,
}

impl LinkPlacement {
    /// The pose, if the link has one.
    pub fn pose(&self) -> Option<&LinkPose> {
        match self {
            LinkPlacement::Here(pose) | LinkPlacement::Loose(pose) => Some(pose),
            LinkPlacement::Nowhere => None,
        }
    }
}

/// A picture under construction; the world's origin is the figure's origin.
pub struct Picture<'a> {
    pub(super) sketch: &'a Sketch,
    places: &'a [LinkPlacement],
    /// Length in the world that corresponds to a millimetre on paper (m).
    pub(super) scale: f64,
    /// The figure so far.
    pub figure: DrawnFigure,
    /// Elements that labels must not touch.
    pub obstacles: Obstacles,
    written: Vec<Written>,
}

/// A text that is still to be placed.
struct Written {
    sort: Sort,
    label: labels::PlacedLabel,
    text: String,
    set: Type,
}

/// Kind of a text. Numbers are placed first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Sort {
    Number,
    Letters,
}

impl<'a> Picture<'a> {
    /// A picture of a sketch with its links at the poses `places`, at a scale (m/mm).
    /// No mark is drawn yet.
    pub fn of(sketch: &'a Sketch, places: &'a [LinkPlacement], scale: f64) -> Picture<'a> {
        let (figure, obstacles) = (DrawnFigure::default(), Obstacles::default());
        Picture { sketch, places, scale, figure, obstacles, written: Vec::new() }
    }

    /// A point of a link on paper.
    pub fn at(&self, link: LinkId, local: Vec2) -> Option<Vec2> {
        self.places[link].pose().map(|pose| pose.point(local) / self.scale)
    }

    /// Draws all marks of the sketch.
    pub fn draw_marks(&mut self) {
        let sketch = self.sketch;
        let marks = sketch.in_order();
        let below = marks.partition_point(|(_, mark)| mark.role.look().layer <= Layer::Stretched);
        self.draw_bodies(&marks[..below]);
        for own in &sketch.stretched {
            let [first, second] = own.ends.map(|end| self.at(end.link, end.local));
            let (Some(first), Some(second)) = (first, second) else { continue };
            let scaled = Stretched { width: own.width / self.scale, ..own.clone() };
            own.marks.iter().for_each(|mark| self.put(mark, GROUND, |at| scaled.at(at, [first, second])));
        }
        self.draw_bodies(&marks[below..]);
    }

    fn draw_bodies(&mut self, marks: &[(LinkId, &Mark)]) {
        let (places, scale) = (self.places, self.scale);
        for &(link, mark) in marks {
            if let Some(pose) = places[link].pose() {
                self.put(mark, link, |local| pose.point(local) / scale);
            }
        }
    }

    /// Draws a mark of a link: `at` maps the mark's points to paper.
    fn put(&mut self, mark: &Mark, link: LinkId, at: impl Fn(Vec2) -> Vec2) {
        let (style, fill) = style(mark.role.look(), link, &self.places[link]);
        self.figure.set_layer(&layer(mark.role.look().layer, link));
        if let MarkShape::Circle { centre, radius } = mark.shape {
            let (at, radius) = (at(centre), radius / self.scale);
            self.figure.disc(at, radius, fill.map_or("none", |fill| fill.colour), style);
            self.obstacles.discs.push((at, radius));
            return;
        }
        let (points, closed) = (mark.shape.points().into_iter().map(at).collect::<Vec<_>>(), mark.shape.is_closed());
        if !matches!(mark.role, MarkRole::Weld | MarkRole::MassQuarter | MarkRole::LoadHead) {
            self.obstacles.segments.extend(points.windows(2).map(|pair| [pair[0], pair[1]]));
            if let (true, [first, .., last]) = (closed, &points[..]) {
                self.obstacles.segments.push([*last, *first]);
            }
        }
        match points[..] {
            _ if closed => self.figure.area(points, fill, style),
            [a, b] => self.figure.line([a, b], style),
            _ => self.figure.curve(points, fill, style),
        }
    }

    /// Positions on paper and texts of the labels for which `wanted` returns true, as [`Picture::name`] requires them.
    pub fn names(&self, wanted: impl Fn(Lettering) -> bool) -> Vec<(Vec2, String)> {
        let labels = self.sketch.labels.iter().filter(|label| wanted(label.names));
        let one = |label: &SketchLabel| {
            let text = match label.names {
                Lettering::Point | Lettering::Motor | Lettering::Link => label.text.clone(),
                Lettering::MassCentre => format!("S{}", sub(label.text.trim_start_matches('S'))),
            };
            Some((self.at(label.at.link, label.at.local)?, text))
        };
        labels.filter_map(one).collect()
    }

    /// Writes names at their positions on paper. Names at the same position are written together.
    pub fn name(&mut self, names: Vec<(Vec2, String)>) {
        let mut named: Vec<(Vec2, String)> = Vec::new();
        for (at, text) in names {
            match named.iter_mut().find(|(place, _)| (*place - at).norm() < ONE) {
                Some((_, names)) => *names += &format!(", {text}"),
                None => named.push((at, text)),
            }
        }
        for (at, text) in named {
            self.letters(at, Vec2::zeros(), CLEAR, text, BLACK);
        }
    }

    /// Writes the number of every link beside the link.
    pub fn number_links(&mut self) {
        for label in self.sketch.labels.iter().filter(|label| label.names == Lettering::Link) {
            if let Some(at) = self.at(label.at.link, label.at.local) {
                let size = Vec2::new(2.0 * NUMBER, 2.0 * NUMBER);
                let place = labels::PlacedLabel { anchor: at, away: Vec2::zeros(), size, clear: 0.3 };
                let (text, set) = (label.text.clone(), lettering(colour(label.at.link)));
                self.written.push(Written { sort: Sort::Number, label: place, text, set });
            }
        }
    }

    /// Writes the number of a link at the point `local` of its frame (m). The number stays at this point while the link
    /// moves.
    pub fn number_on(&mut self, link: LinkId, local: Vec2) {
        if let Some(at) = self.at(link, local) {
            let half = Vec2::repeat(NUMBER);
            self.obstacles.discs.push((at, NUMBER));
            self.figure.labels.push([at - half, at + half]);
            draw_number(&mut self.figure, at, link.to_string(), colour(link));
        }
    }

    /// Adds a text near a point on paper. `away` is the preferred direction from the point; a zero vector means no
    /// preference.
    pub fn letters(&mut self, anchor: Vec2, away: Vec2, clear: f64, text: String, paint: &'static str) {
        self.set_letters(anchor, away, clear, text, lettering(paint));
    }

    /// Adds a text near a point on paper like [`Picture::letters`], but with the typography `set`.
    pub(super) fn set_letters(&mut self, anchor: Vec2, away: Vec2, clear: f64, text: String, set: Type) {
        let size = label_size(&text, set.size);
        let size = if set.upward { size.yx() } else { size };
        let label = labels::PlacedLabel { anchor, away, size, clear };
        self.written.push(Written { sort: Sort::Letters, label, text, set });
    }

    /// Draws arrows of forces and moments, each with its value. The largest force is 22 mm long.
    /// The arrows begin at the points on which the loads act.
    pub fn draw_loads(&mut self, all: &[Acting]) {
        let largest = all.iter().map(|own| own.force.norm()).fold(0.0, f64::larger);
        let moments = all.iter().map(|own| own.moment.abs()).fold(0.0, f64::larger);
        for own in all {
            let at = own.at / self.scale;
            if own.force.norm() > NOTHING.larger(LEAST * largest) {
                let tip = own.force * (FORCE / largest);
                self.sign(&arrow(tip, 1.0), at);
                self.letters(at + tip, tip, 0.6, format!("{} N", short(own.force.norm())), LOAD.light);
            }
            if own.moment.abs() > NOTHING.larger(LEAST * moments) {
                self.sign(&turning(own.moment, MOMENT, 0.4, 1.0), at);
                let beside = Vec2::new(0.0, MOMENT * own.moment.signum());
                self.letters(at + beside, beside, 0.8, format!("{} N m", short(own.moment.abs())), LOAD.light);
            }
        }
    }

    /// Allows labels inside large circles, such as wheels. Only the circumferences of these circles remain obstacles.
    pub fn open_wheels(&mut self) {
        let (wheels, discs): (Vec<_>, Vec<_>) = self.obstacles.discs.drain(..).partition(|&(_, radius)| radius > WHEEL);
        self.obstacles.discs = discs;
        for (centre, radius) in wheels {
            let corners = MarkShape::Circle { centre, radius }.points();
            let next = corners.iter().cycle().skip(1);
            self.obstacles.segments.extend(corners.iter().zip(next).map(|(&a, &b)| [a, b]));
        }
    }

    /// Draws an arrow in the direction of gravity, at the upper left of the drawing.
    pub fn draw_gravity(&mut self, gravity: Vec2) {
        if !(gravity.norm() > 0.0) {
            return;
        }
        let tip = gravity * (GRAVITY / gravity.norm());
        let [low, high] = self.figure.bounds();
        let at = Vec2::new(low.x - 4.0 - tip.x.larger(0.0), high.y - tip.y.larger(0.0));
        self.sign(&arrow(tip, 1.0), at);
        self.letters(at + tip / 2.0, Vec2::new(-1.0, 0.0), 0.6, "g".into(), LOAD.light);
    }

    fn sign(&mut self, marks: &[Mark], at: Vec2) {
        marks.iter().for_each(|mark| self.put(mark, GROUND, |own| own + at));
    }

    /// Draws the path of a point in the world (m). Marks that are drawn later cover the path.
    pub fn draw_trace(&mut self, path: &[Vec2], link: LinkId) {
        let points: Vec<Vec2> = path.iter().map(|at| at / self.scale).collect();
        self.keep_clear(&points);
        if points.len() > 1 {
            self.figure.curve(points, None, Style { colour: colour(link), width: 0.35, dash: "1 0.8" });
        }
    }

    /// Keeps labels off a path on paper.
    pub(super) fn keep_clear(&mut self, path: &[Vec2]) {
        let coarse: Vec<Vec2> = path.iter().copied().step_by(path.len().div_ceil(PIECES).max(1)).collect();
        self.obstacles.segments.extend(coarse.windows(2).map(|pair| [pair[0], pair[1]]));
    }

    /// Draws a part of the circle on which a point can lie (world, m), as a construction line.
    /// The middle of the part lies in the direction `toward` from the centre.
    pub fn draw_reach(&mut self, centre: Vec2, radius: f64, toward: Vec2) {
        let from = toward.y.atan2(toward.x) - REACH;
        let (centre, radius) = (centre / self.scale, radius / self.scale);
        let points = MarkShape::Arc { centre, radius, from, sweep: 2.0 * REACH }.points();
        self.figure.curve(points, None, Style { colour: GREY, width: 0.3, dash: CONSTRUCTION });
    }

    /// Draws the gap between two points (world, m) that should coincide in a joint, and writes the size of the gap.
    pub fn draw_gap(&mut self, [from, to]: [Vec2; 2]) {
        let ends = [from, to].map(|at| at / self.scale);
        let style = solid(ALARM, 0.7);
        self.figure.line(ends, style);
        for end in ends {
            self.figure.disc(end, 1.2, "none", style);
            self.obstacles.discs.push((end, 1.2));
        }
        let text = format!("gap {}", millimetres((to - from).norm()));
        self.letters((ends[0] + ends[1]) / 2.0, Vec2::zeros(), 1.0, text, ALARM);
    }

    /// Places all labels and returns the figure.
    /// `drawings` is the number of figures that are made together: they share the allowed number of comparisons for
    /// placing labels.
    pub fn finish(mut self, drawings: usize) -> DrawnFigure {
        self.written.sort_by_key(|own| own.sort);
        let boxes: Vec<labels::PlacedLabel> = self.written.iter().map(|own| own.label).collect();
        let places = place_among(&boxes, &self.obstacles, drawings);
        self.figure.set_layer("labels");
        for (Written { sort, label, text, set }, at) in self.written.into_iter().zip(places) {
            self.figure.labels.push([at - label.size / 2.0, at + label.size / 2.0]);
            match sort {
                Sort::Number => {
                    labels::leader(&mut self.figure, &label, at, set.size);
                    draw_number(&mut self.figure, at, text, set.colour);
                }
                Sort::Letters => letter(&mut self.figure, &label, at, &text, set),
            }
        }
        self.figure
    }
}

/// Draws the number of a link in a circle of the colour `paint`.
pub(super) fn draw_number(figure: &mut DrawnFigure, at: Vec2, text: String, paint: &'static str) {
    figure.disc(at, NUMBER, "white", solid(paint, 0.4));
    let set = Type { anchor: "middle", bold: true, ..words(3.2) };
    figure.text(at - Vec2::new(0.0, 1.15), text, set);
}

/// A length (m) in mm, with four significant digits.
pub fn millimetres(length: f64) -> String {
    format!("{} mm", short(length * 1e3))
}

/// Four significant digits, without trailing zeros.
pub fn short(value: f64) -> String {
    let digits = significant(value);
    match digits.contains('.') && !digits.contains('e') {
        true => digits.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => digits,
    }
}

/// The layer of a mark in files that have layers.
fn layer(layer: Layer, link: LinkId) -> String {
    match layer {
        Layer::Links | Layer::Blocks | Layer::Ground if link != GROUND => format!("link_{link}"),
        Layer::Links | Layer::Blocks | Layer::Ground => "ground".into(),
        Layer::Joints => "joints".into(),
        Layer::Stretched | Layer::Signs => "loads".into(),
    }
}

/// Line style and fill of a mark with the look `look`. The style also depends on the placement of the mark's link.
fn style(look: Look, link: LinkId, place: &LinkPlacement) -> (Style, Option<Tint>) {
    let paint = match look.ink {
        Ink::Link => colour(link),
        Ink::Text => BLACK,
        Ink::Quiet => GREY,
        Ink::Load => LOAD.light,
    };
    let fill = match look.fill {
        Fill::None => None,
        Fill::Paper => Some(Tint::opaque("white")),
        Fill::Tint => Some(Tint { colour: paint, opacity: TINT }),
        Fill::Ink => Some(Tint::opaque(paint)),
    };
    let dash = if matches!(place, LinkPlacement::Loose(_)) && look.layer == Layer::Links { LOOSE } else { "" };
    let dash = if look.ink == Ink::Quiet && look.layer == Layer::Ground { CONSTRUCTION } else { dash };
    (Style { colour: paint, width: look.width, dash }, fill)
}

/// Space that letters and symbols need around a mechanism (mm), on each side.
pub const AROUND: f64 = 3.0 * LETTER;
