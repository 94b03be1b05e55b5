//! Simple shapes for display: they have no mass and no contacts.

use super::model::Model;
use linkage::math::{Vec2, rotated, unit};
use linkage::mechanism::{GROUND, LinkId};

/// Thickness of the shapes as a share of the mechanism's size.
const THICKNESS: f64 = 0.012;

/// A shape in the frame of a link (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// Ball.
    Ball(Vec2, f64),
    /// Rod with round ends, and its radius.
    Rod([Vec2; 2], f64),
    /// Block about a point, turned by an angle, with half its length and half its width.
    Block(Vec2, f64, [f64; 2]),
}

/// Shapes of a link: rods between its joints, and a block or a guide where it slides.
pub(super) fn of_link(model: &Model, link: LinkId) -> Vec<Shape> {
    let mechanism = &model.case.mechanism;
    let thick = THICKNESS * model.size();
    let mut places: Vec<Vec2> = Vec::new();
    let mut shapes = Vec::new();
    for joint in mechanism.joints() {
        let Some(place) = joint.on(link) else { continue };
        // MuJoCo refuses rods without length.
        if places.iter().all(|other| (other - place).norm() > 1e-6 * model.size()) {
            places.push(place);
        }
        let Some(axis) = joint.axis_on(link) else { continue };
        let sides = mechanism.guide_and_block(joint).expect("a prismatic joint has a guide");
        if sides[1].link == link {
            shapes.push(Shape::Block(place, axis.y.atan2(axis.x), [3.0 * thick, 2.0 * thick]));
        } else {
            let middle = place + axis * along(model, link, axis, place, sides[1].link, sides[1].local);
            let reach = axis * model.size();
            shapes.push(Shape::Rod([middle - reach, middle + reach], 0.4 * thick));
        }
    }
    if link == GROUND || places.len() < 2 {
        shapes.extend(places.iter().map(|&place| Shape::Ball(place, 1.8 * thick)));
    } else {
        let closing = (places.len() > 2).then_some([places[places.len() - 1], places[0]]);
        let pairs = places.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing);
        shapes.extend(pairs.map(|pair| Shape::Rod(pair, thick)));
    }
    shapes
}

/// Start position of a guide's block along the guide's axis (m).
fn along(model: &Model, guide: LinkId, axis: Vec2, place: Vec2, block: LinkId, local: Vec2) -> f64 {
    let [guide, block] = [guide, block].map(|link| model.case.start.0[link]);
    rotated(unit(guide.angle), axis).dot(&(block.point(local) - guide.point(place)))
}
