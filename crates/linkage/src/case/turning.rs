//! Determines from the joints and the start pose which links can turn, and which links can turn relative to each other.
//!
//! Links connected by a prismatic joint have the same angle up to a constant.
//! The same holds for opposite links of a parallelogram, and for all links in a chain of such pairs of links.
//! If a chain of such pairs connects a link with the ground, the link does not turn: its angular velocity is zero.
//! A nonzero angular velocity that a solver computes for such a link is only rounding error.
//! Loads must not take the sign of a rounding error for a sense of rotation.

use super::CaseParts;
use crate::math::Vec2;
use crate::mechanism::{Joint, LinkId};

/// A quadrilateral counts as a parallelogram if its opposite sides differ by less than this fraction of the mechanism's
/// size.
const EQUAL: f64 = 1e-12;

/// A link that connects two other links by revolute joints.
/// Fields: the two links in ascending order, the world coordinates of the joints, and the connecting link.
struct Bridge {
    ends: [LinkId; 2],
    places: [Vec2; 2],
    link: LinkId,
}

/// For every link, the representative of the link's class.
/// The angles of all links in a class differ only by constants, on the branch of the start pose.
/// Two links with the same representative do not turn relative to each other.
pub(super) fn classes(parts: &CaseParts) -> Vec<LinkId> {
    let mechanism = &parts.mechanism;
    let mut classes: Vec<LinkId> = mechanism.links().ids().collect();
    for joint in mechanism.joints().iter().filter(|joint| joint.keeps_angle()) {
        unite(&mut classes, joint.first.link, joint.second.link);
    }
    let mut bridges = bridges(parts);
    bridges.sort_by_key(|bridge| bridge.ends);
    let equal = EQUAL * mechanism.size();
    for same in bridges.chunk_by(|one, other| one.ends == other.ends) {
        for (index, one) in same.iter().enumerate() {
            for other in same[index + 1..].iter().filter(|other| other.link != one.link) {
                // The two sides of the quadrilateral that lie on the links connected by `one` and `other`.
                let sides = [0, 1].map(|end| other.places[end] - one.places[end]);
                if (sides[0] - sides[1]).norm() <= equal && sides[0].norm() > equal {
                    unite(&mut classes, one.ends[0], one.ends[1]);
                    unite(&mut classes, one.link, other.link);
                }
            }
        }
    }
    // If one member of a transmission is at rest relative to the carrier, the other member is at rest too.
    // With a cam, the follower is at rest if the cam is at rest, but not vice versa.
    let transmissions = mechanism.transmissions();
    for own in transmissions.iter().flat_map(|_| transmissions).filter(|own| own.slide().is_none()) {
        let ([first, second, carrier], is_cam) = (own.links(), own.cam.is_some());
        let is_first = classes[first] == classes[carrier];
        if is_first || (!is_cam && classes[second] == classes[carrier]) {
            unite(&mut classes, if is_first { second } else { first }, carrier);
        }
    }
    classes
}

fn unite(classes: &mut [LinkId], a: LinkId, b: LinkId) {
    let (from, to) = (classes[a], classes[b]);
    classes.iter_mut().filter(|class| **class == from).for_each(|class| *class = to);
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
