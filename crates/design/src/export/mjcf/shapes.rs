//! Simple shapes for display. The shapes have no mass and no contacts.

use super::model::MjcfModel;
use super::xml::{Xml, about_z, flat, number, numbers};
use linkage::math::{Vec2, rotated, unit};
use linkage::mechanism::{GROUND, JointSide, LinkId};

/// Thickness of the shapes, divided by the mechanism's size.
const THICKNESS: f64 = 0.012;

/// Shapes of a link: rods between its joints, and a block or a guide where it slides.
pub(super) fn draw(xml: &mut Xml, model: &MjcfModel, link: LinkId, colour: &str) {
    let mechanism = &model.case.mechanism;
    let thick = THICKNESS * model.size();
    let rod = |xml: &mut Xml, [from, to]: [Vec2; 2], radius: f64| {
        let (ends, size) = (numbers([from.x, from.y, 0.0, to.x, to.y, 0.0]), number(radius));
        xml.leaf(format_args!(r#"geom type="capsule" fromto="{ends}" size="{size}" rgba="{colour}""#));
    };
    let mut places: Vec<Vec2> = Vec::new();
    for joint in mechanism.joints() {
        let Some(place) = joint.on(link) else { continue };
        // MuJoCo refuses rods without length, so joints at the same position are listed once.
        if places.iter().all(|other| (other - place).norm() > 1e-6 * model.size()) {
            places.push(place);
        }
        let Some(axis) = joint.axis_on(link) else { continue };
        let sides = mechanism.guide_and_block(joint).expect("a prismatic joint has a guide");
        if sides[1].link == link {
            let (at, turn, half) = (flat(place), about_z(axis.y.atan2(axis.x)), [3.0, 2.0, 2.0].map(|k| k * thick));
            let size = numbers(half);
            xml.leaf(format_args!(r#"geom type="box" pos="{at}" axisangle="{turn}" size="{size}" rgba="{colour}""#));
        } else {
            let middle = place + axis * along(model, sides, axis);
            let reach = axis * model.size();
            rod(xml, [middle - reach, middle + reach], 0.4 * thick);
        }
    }
    if link == GROUND || places.len() < 2 {
        for place in places {
            let (at, size) = (flat(place), number(1.8 * thick));
            xml.leaf(format_args!(r#"geom type="sphere" pos="{at}" size="{size}" rgba="{colour}""#));
        }
    } else {
        let closing = (places.len() > 2).then_some([places[places.len() - 1], places[0]]);
        let pairs = places.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing);
        pairs.for_each(|pair| rod(xml, pair, thick));
    }
}

/// Start position of a guide's block along the guide's axis (m).
fn along(model: &MjcfModel, sides: [JointSide; 2], axis: Vec2) -> f64 {
    let [guide, block] = sides.map(|side| model.case.start.0[side.link]);
    rotated(unit(guide.angle), axis).dot(&(block.point(sides[1].local) - guide.point(sides[0].local)))
}
