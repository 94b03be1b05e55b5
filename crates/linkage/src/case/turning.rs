//! Determines which links can turn, from the joints and the start pose.
//!
//! Links connected by a prismatic joint have the same angle up to a constant.
//! Opposite links of a parallelogram also have the same angle up to a constant, and so do all links in a chain of such
//! pairs.
//! A link connected with the ground by such pairs only translates: its angular velocity is zero.
//! A solver may compute a nonzero angular velocity for such a link. This value is only rounding error.
//! Loads must not infer a sense of rotation from this error.

use super::CaseParts;
use crate::math::Vec2;
use crate::mechanism::{GROUND, Joint, LinkId};

/// If opposite sides of a quadrilateral differ by less than this fraction of the mechanism's size, they count as equal.
/// The quadrilateral is then a parallelogram.
const EQUAL: f64 = 1e-12;

/// A link that connects two other links by revolute joints.
/// Fields: the two links in ascending order, the world coordinates of the joints, and the connecting link.
struct Bridge {
    ends: [LinkId; 2],
    places: [Vec2; 2],
    link: LinkId,
}

/// For every link, whether it can turn while the mechanism stays on the branch of its start pose.
pub(super) fn turning(parts: &CaseParts) -> Vec<bool> {
    let mechanism = &parts.mechanism;
    let mut classes: Vec<LinkId> = mechanism.links().ids().collect();
    let mut unite = |a: LinkId, b: LinkId| {
        let (from, to) = (classes[a], classes[b]);
        classes.iter_mut().filter(|class| **class == from).for_each(|class| *class = to);
    };
    for joint in mechanism.joints().iter().filter(|joint| joint.keeps_angle()) {
        unite(joint.first.link, joint.second.link);
    }
    let mut bridges = bridges(parts);
    bridges.sort_by_key(|bridge| bridge.ends);
    let equal = EQUAL * mechanism.size();
    for same in bridges.chunk_by(|one, other| one.ends == other.ends) {
        for (index, one) in same.iter().enumerate() {
            for other in same[index + 1..].iter().filter(|other| other.link != one.link) {
                // Two opposite sides of the quadrilateral: one on each of the two links that `one` and `other` connect.
                let sides = [0, 1].map(|end| other.places[end] - one.places[end]);
                if (sides[0] - sides[1]).norm() <= equal && sides[0].norm() > equal {
                    unite(one.ends[0], one.ends[1]);
                    unite(one.link, other.link);
                }
            }
        }
    }
    classes.iter().map(|&class| class != classes[GROUND]).collect()
}

fn bridges(parts: &CaseParts) -> Vec<Bridge> {
    let (links, joints) = (parts.mechanism.links(), parts.mechanism.joints());
    let mut found = Vec::new();
    for link in links.ids() {
        let on = parts.mechanism.joints_on(link).iter().map(|&index| &joints[index]);
        let on: Vec<&Joint> = on.filter(|joint| !joint.keeps_angle()).collect();
        for (index, first) in on.iter().enumerate() {
            for second in &on[index + 1..] {
                let mut ends = [first, second].map(|joint| joint.other(link));
                ends.sort_by_key(|end| end.link);
                if ends[0].link != ends[1].link {
                    let places = ends.map(|end| parts.start.0[end.link].point(end.local));
                    found.push(Bridge { ends: ends.map(|end| end.link), places, link });
                }
            }
        }
    }
    found
}
