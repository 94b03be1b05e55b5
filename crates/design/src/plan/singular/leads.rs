//! Leads of a group.

use super::point::AssurLead;
use linkage::math::Vec2;
use linkage::mechanism::{Joint, LinkId, Mechanism};

/// Name of the point of `link` in a joint. If the point has no name, the name of the joint is used.
pub(super) fn named(mechanism: &Mechanism, link: LinkId, joint: &Joint) -> Option<String> {
    let local = joint.on(link)?;
    let named = mechanism.links()[link].points.iter().find(|point| point.local == local);
    Some(named.map_or(&joint.name, |point| &point.name).clone())
}

/// A lead between two ends. The velocities of the ends are not known yet and are set to zero.
pub(super) fn lead(link: LinkId, names: [String; 2], ends: [Vec2; 2]) -> AssurLead {
    let along = (ends[1] - ends[0]).normalize();
    AssurLead { names, ends, velocities: [Vec2::zeros(); 2], link, along }
}
