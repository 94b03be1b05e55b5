//! Guides and blocks of the kinematic diagram.
//! The ground's guides are hatched rails, moving links' guides are lines, and the blocks on them are rectangles.

use super::figure::{Figure, Style, solid};
use super::labels::{Obstacles, inside};
use super::style::{BLACK, GREY, colour};
use crate::diagram::scheme::{Scheme, SchemeGuide};
use linkage::math::{KeepNan, Vec2, turned};

/// Half length and half width (mm) of a block in a fixed guide, and on a moving one.
/// They differ so that both are visible if they sit on the same joint.
const FIXED: [f64; 2] = [5.0, 3.2];
const MOVING: [f64; 2] = [3.8, 2.0];
/// Clearance (mm) between a block and the rail beside it.
const PLAY: f64 = 0.4;
/// Length (mm) of hatching lines, and their spacing along the rail.
const HATCH: f64 = 1.6;
const PITCH: f64 = 2.0;
/// Longest extension of an axis beyond the rail (mm) towards the ground point that it goes through.
const AXIS: f64 = 150.0;

/// Half length and half width (mm) of the block on a guide.
fn half(guide: &SchemeGuide) -> [f64; 2] {
    if guide.link == 0 { FIXED } else { MOVING }
}

/// End points on paper of the path that the block itself covers.
fn covered(guide: &SchemeGuide, scale: f64) -> [Vec2; 2] {
    let reach = guide.axis * half(guide)[0];
    [guide.ends[0] / scale - reach, guide.ends[1] / scale + reach]
}

/// Rails and axes of the fixed guides, drawn beneath the links.
/// Rails leave the boxes of `pivots` free: centre and half size of each.
pub fn rails(figure: &mut Figure, scheme: &Scheme, pivots: &[[Vec2; 2]], obstacles: &mut Obstacles) {
    let mut drawn: Vec<[Vec2; 2]> = Vec::new();
    for guide in scheme.guides.iter().filter(|guide| guide.link == 0) {
        let ends = covered(guide, scheme.scale);
        let origin = guide.origin / scheme.scale;
        let along = |at: Vec2| (at - ends[0]).dot(&guide.axis);
        let length = along(ends[1]);
        // From the ground point, or the rail's own ends, a little beyond both.
        let near = along(origin).clamp(-AXIS, length + AXIS);
        let axis = [near.smaller(0.0) - 2.0, near.larger(length) + 2.0].map(|way| ends[0] + guide.axis * way);
        figure.line(axis, Style { colour: GREY, width: 0.2, dash: "4 1 0.5 1" });
        obstacles.segments.push(axis);
        for side in [1.0, -1.0].map(|side| turned(guide.axis) * side) {
            let rail = ends.map(|end| end + side * (FIXED[1] + PLAY));
            for piece in pieces(rail, pivots) {
                figure.line(piece, solid(BLACK, 0.5));
                // Hatching of two guides on the same axis would fill each other's gaps.
                let feet = feet(piece).filter(|foot| !drawn.iter().any(|other| on(*foot, other)));
                for foot in feet {
                    figure.line([foot, foot + (side - guide.axis) * HATCH], solid(BLACK, 0.2));
                }
                obstacles.segments.extend([piece, piece.map(|end| end + side * HATCH)]);
                drawn.push(piece);
            }
        }
    }
}

/// The parts of a rail outside all boxes.
fn pieces(rail: [Vec2; 2], boxes: &[[Vec2; 2]]) -> Vec<[Vec2; 2]> {
    boxes.iter().fold(vec![rail], |pieces, &[centre, half]| {
        let cut = |piece: [Vec2; 2]| match inside(&piece, centre, half) {
            None => vec![piece],
            Some(shares) => {
                let [from, to] = shares.map(|share| piece[0] + (piece[1] - piece[0]) * share);
                vec![[piece[0], from], [to, piece[1]]]
            }
        };
        pieces.into_iter().flat_map(cut).filter(|[a, b]| (b - a).norm() > PITCH).collect()
    })
}

/// Start points of the hatching lines of a rail.
fn feet([start, end]: [Vec2; 2]) -> impl Iterator<Item = Vec2> {
    let (length, axis) = ((end - start).norm(), (end - start).normalize());
    let strokes = ((length - HATCH) / PITCH).floor().larger(0.0) + 1.0;
    let inset = (length - HATCH - PITCH * (strokes - 1.0)) / 2.0 + HATCH;
    (0..strokes as usize).map(move |k| start + axis * (inset + PITCH * k as f64))
}

/// Whether the start point of a hatching line lies on a rail from `a` to `b`.
fn on(foot: Vec2, &[a, b]: &[Vec2; 2]) -> bool {
    let axis = (b - a).normalize();
    let way = (foot - a).dot(&axis);
    turned(axis).dot(&(foot - a)).abs() < 0.1 && way > 0.0 && way < (b - a).norm()
}

/// The lines of moving guides.
pub fn slots(figure: &mut Figure, scheme: &Scheme, obstacles: &mut Obstacles) {
    for guide in scheme.guides.iter().filter(|guide| guide.link != 0) {
        let [start, end] = covered(guide, scheme.scale);
        // A guide's line begins at the joint's point on its link, wherever the block is.
        let origin = guide.origin / scheme.scale;
        let way = (origin - start).dot(&guide.axis);
        let ends = [start + guide.axis * way.smaller(0.0), start + guide.axis * way.larger((end - start).norm())];
        obstacles.segments.push(ends);
        figure.line(ends, solid(colour(guide.link), 0.9));
    }
}

/// The blocks; those in fixed guides come first because they are larger.
pub fn blocks(figure: &mut Figure, scheme: &Scheme, obstacles: &mut Obstacles) {
    let (fixed, moving): (Vec<&SchemeGuide>, Vec<&SchemeGuide>) =
        scheme.guides.iter().partition(|guide| guide.link == 0);
    for guide in fixed.into_iter().chain(moving) {
        let [long, wide] = half(guide);
        let at = guide.at / scheme.scale;
        let (along, aside) = (guide.axis * long, turned(guide.axis) * wide);
        let corners = [along + aside, aside - along, -along - aside, along - aside].map(|corner| at + corner);
        for k in 0..4 {
            obstacles.segments.push([corners[k], corners[(k + 1) % 4]]);
        }
        obstacles.discs.push((at, wide));
        figure.shape(corners.to_vec(), true, Some(("white", 1.0)), solid(colour(guide.block), 0.6));
    }
}

/// A ground point that is not a pivot: a short stroke across the axis it lies on.
pub fn mark(figure: &mut Figure, at: Vec2, axis: Vec2) {
    let half = turned(axis) * 1.4;
    figure.line([at - half, at + half], solid(BLACK, 0.4));
}
