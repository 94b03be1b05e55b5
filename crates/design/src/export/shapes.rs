//! Simple shapes that show the links: they have no mass and no contacts.

use crate::rigid::RigidModel;
use linkage::math::{Vec2, rotated, unit};
use linkage::mechanism::{GROUND, JointSide, LinkId};

/// Thickness of the shapes, divided by the mechanism's size.
const THICKNESS: f64 = 0.012;
/// Colours of links (red, green, blue, opacity), used one after the other.
const COLOURS: [[f64; 4]; 6] = [
    [0.20, 0.42, 0.70, 1.0],
    [0.85, 0.45, 0.13, 1.0],
    [0.25, 0.60, 0.30, 1.0],
    [0.62, 0.30, 0.62, 1.0],
    [0.75, 0.62, 0.15, 1.0],
    [0.30, 0.62, 0.65, 1.0],
];

/// A shape in the frame of its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// Cylinder between two points (m), with its radius (m).
    Rod { ends: [Vec2; 2], radius: f64 },
    /// Box with its centre (m), the angle of its first edge (rad) and half the length of each edge (m).
    Block { at: Vec2, angle: f64, half: [f64; 3] },
    /// Sphere with its centre and its radius (m).
    Ball { at: Vec2, radius: f64 },
}

/// Colour of a link's shapes: red, green, blue, opacity, each from 0 to 1.
pub(super) fn colour(link: LinkId) -> [f64; 4] {
    if link == GROUND { [0.45, 0.45, 0.45, 1.0] } else { COLOURS[(link.index() - 1) % COLOURS.len()] }
}

/// Shapes of a link: rods between the link's joints, and a block or a guide at each prismatic joint.
pub(super) fn shapes(model: &RigidModel, link: LinkId) -> Vec<Shape> {
    let mechanism = &model.case.mechanism;
    let thick = THICKNESS * model.size();
    let (mut found, mut places): (Vec<Shape>, Vec<Vec2>) = (Vec::new(), Vec::new());
    for joint in mechanism.joints() {
        let Some(place) = joint.on(link) else { continue };
        // MuJoCo refuses rods without length, so joints at the same position are listed once.
        if places.iter().all(|other| (other - place).norm() > 1e-6 * model.size()) {
            places.push(place);
        }
        let Some(axis) = joint.axis_on(link) else { continue };
        let sides = mechanism.guide_and_block(joint).expect("a prismatic joint has a guide");
        found.push(if sides[1].link == link {
            Shape::Block { at: place, angle: axis.y.atan2(axis.x), half: [3.0, 2.0, 2.0].map(|k| k * thick) }
        } else {
            let (middle, reach) = (place + axis * along(model, sides, axis), axis * model.size());
            Shape::Rod { ends: [middle - reach, middle + reach], radius: 0.4 * thick }
        });
    }
    if link == GROUND || places.len() < 2 {
        found.extend(places.into_iter().map(|at| Shape::Ball { at, radius: 1.8 * thick }));
    } else {
        let closing = (places.len() > 2).then_some([places[places.len() - 1], places[0]]);
        let pairs = places.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing);
        found.extend(pairs.map(|ends| Shape::Rod { ends, radius: thick }));
    }
    found
}

/// Start position of a guide's block along the guide's axis (m).
fn along(model: &RigidModel, sides: [JointSide; 2], axis: Vec2) -> f64 {
    let [guide, block] = sides.map(|side| model.pose(side.link));
    rotated(unit(guide.angle), axis).dot(&(block.point(sides[1].local) - guide.point(sides[0].local)))
}
