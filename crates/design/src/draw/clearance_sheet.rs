//! Clearance drawing: the housing, the swept area of every link, and the mechanism with its outlines at the smallest
//! distance or the first collision.

use crate::clearance::{ClearanceResult, PairClearance, RangeVariable, poses};
use crate::sentences;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Tint, solid};
use drawing::paper::style::{GREY, colour, significant};
use drawing::picture::{ALARM, LinkPlacement, Picture};
use drawing::sheet::{SheetCell, fit, sheet};
use drawing::{Lettering, MarkRole, Sketch, Travels};
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{KeepNan, Motion, Vec2};
use linkage::mechanism::LinkPose;
use scenario::clearance::{ClearanceQuestion, Outline};

/// Largest size of the drawing (mm).
const ROOM: Vec2 = Vec2::new(150.0, 150.0);
/// Number of equal parts of the range. A link's swept area is drawn as the link's positions at the ends of all parts.
const POSITIONS: usize = 240;
/// Opacity of swept areas. `OUTLINE` is the opacity of outlines.
const SWEPT: f64 = 0.2;
const OUTLINE: f64 = 0.45;
/// Smallest line width (mm).
const THIN: f64 = 0.2;

/// Draws a clearance question and its result. Many positions of each link show its swept area.
///
/// # Errors
/// The errors of the pose solver.
pub fn clearance(case: &Case, name: &str, asked: &ClearanceQuestion, found: &ClearanceResult) -> Result<Drawing> {
    let [from, to] = found.range;
    let cranks: Vec<f64> = (0..=POSITIONS).map(|k| from + (to - from) * (k as f64 / POSITIONS as f64)).collect();
    let smallest = found.smallest().filter(|pair| pair.smallest.distance.is_finite());
    let collision = found.first_collision();
    let shown = match (collision, smallest) {
        (Some((_, meeting)), _) => meeting.cranks[1],
        (None, Some(pair)) => pair.smallest.crank,
        (None, None) => from,
    };
    let all = poses(case, &cranks)?;
    let here = poses(case, &[shown])?.remove(0);
    let mut travels = Travels::none(&case.mechanism);
    for pose in all.iter().chain([&here]) {
        travels.take_in(&case.mechanism, |link, local| Some(pose[link].point(local)));
    }
    let scale = fit(extent(asked, &all), ROOM);
    let sketch = Sketch::of(&case.mechanism, &travels, scale).with_drives(&case.mechanism, &case.drives);
    let sketch = sketch.without(&[MarkRole::MassCentre, MarkRole::MassQuarter]);
    // If the question has a housing, its walls are drawn. The symbol of a fixed guide would suggest further walls, so
    // the symbol is left out.
    let has_housing = asked.bodies.iter().any(|body| !body.moves());
    let sketch = if has_housing { sketch.without(&[MarkRole::Bore, MarkRole::Rail, MarkRole::Hatch]) } else { sketch };
    let places: Vec<LinkPlacement> = here.iter().map(|own| LinkPlacement::Here(LinkPose::of(own))).collect();
    let mut picture = Picture::of(&sketch, &places, scale);
    for body in asked.bodies.iter().filter(|body| body.moves()) {
        let mut swept = DrawnFigure::default();
        all.iter().for_each(|pose| draw(&mut swept, &body.outline, &pose[body.link], colour(body.link), scale));
        picture.figure.group(swept, SWEPT, sentences::swept_by(&body.name));
    }
    for body in &asked.bodies {
        let (pose, paint, opacity) = match body.moves() {
            true => (&here[body.link], colour(body.link), OUTLINE),
            false => (&Motion::REST, GREY, 1.0),
        };
        let mut own = DrawnFigure::default();
        draw(&mut own, &body.outline, pose, paint, scale);
        picture.figure.group(own, opacity, body.name.clone());
    }
    picture.draw_marks();
    picture.number_links();
    let variable = RangeVariable::of(case);
    let (value, unit) = variable.shown(shown);
    let crank = format!("{} {} {unit}", variable.noun(), significant(value));
    let names = |pair: &PairClearance| pair.bodies.map(|body| asked.bodies[body].name.as_str()).join(" and ");
    let words = if let Some((pair, meeting)) = collision {
        picture.figure.disc(meeting.place / scale, 2.2, "none", solid(ALARM, 0.8));
        sentences::first_collision_at(&names(pair), &crank)
    } else if let Some(pair) = smallest {
        let ends = pair.smallest.points.map(|point| point / scale);
        picture.figure.line(ends, solid(ALARM, 0.8));
        ends.iter().for_each(|end| picture.figure.disc(*end, 0.9, ALARM, solid(ALARM, THIN)));
        let distance = format!("{} mm", significant(1e3 * pair.smallest.distance));
        let middle = (ends[0] + ends[1]) / 2.0;
        picture.letters(middle, Vec2::zeros(), 1.2, distance.clone(), ALARM);
        sentences::smallest_distance_at(&distance, &names(pair), &crank)
    } else {
        crank
    };
    picture.name(picture.names(|what| matches!(what, Lettering::Point | Lettering::Motor)));
    let figure = picture.finish(1);
    let bounds = figure.bounds();
    let cell = SheetCell { figure, bounds, scale, ..SheetCell::default() };
    let title = format!("{name}: clearance");
    let (page, size) = sheet(&title, &words, &[cell], ROOM.x);
    Ok(Drawing { figure: page, size, title })
}

/// Extent of all outlines over all poses (m).
fn extent(asked: &ClearanceQuestion, all: &[Vec<Motion>]) -> Vec2 {
    let (mut low, mut high) = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    for body in &asked.bodies {
        let radius = Vec2::repeat(body.outline.radius());
        for corner in all.iter().flat_map(|pose| body.outline.corners().iter().map(|&own| pose[body.link].point(own))) {
            (low, high) = (low.inf(&(corner - radius)), high.sup(&(corner + radius)));
        }
    }
    high - low
}

/// Draws an outline. The border is a line with round joins, as wide as twice the rounding radius.
fn draw(figure: &mut DrawnFigure, outline: &Outline, pose: &Motion, paint: &'static str, scale: f64) {
    let mut corners: Vec<Vec2> = outline.corners().iter().map(|&corner| pose.point(corner) / scale).collect();
    // A single point is drawn as a line of zero length.
    if let [only] = corners[..] {
        corners.push(only);
    }
    let wide = 2.0 * outline.radius() / scale;
    match outline.is_solid() {
        true => figure.area(corners, Some(Tint::opaque(paint)), solid(paint, wide)),
        false => figure.curve(corners, None, solid(paint, wide.larger(THIN))),
    }
}
