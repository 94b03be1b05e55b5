//! Class of an Assur group, from its closed contours.

use super::group::Group;
use crate::mechanism::{JointId, LinkId, Mechanism};

/// Number of sides of the closed contour with the most sides.
/// A link with three or more inner pairs is a contour. The number of its sides is the number of its inner pairs.
/// Every shortest loop of inner joints is a contour too.
pub(super) fn highest_contour(mechanism: &Mechanism, group: &Group) -> usize {
    let joint = |&index: &JointId| &mechanism.joints()[index];
    let pairs_on = |link: LinkId| group.inner.iter().map(joint).filter(|j| j.on(link).is_some()).count();
    let rigid = group.links.iter().map(|&link| pairs_on(link)).max().unwrap_or(0);
    let loops = group.inner.iter().filter_map(|&index| shortest_loop(mechanism, group, index)).max().unwrap_or(0);
    rigid.max(loops).max(2)
}

/// Number of links in the shortest loop of inner joints through `through`; `None` if there is no loop.
fn shortest_loop(mechanism: &Mechanism, group: &Group, through: JointId) -> Option<usize> {
    let (start, goal) = (mechanism.joints()[through].first.link, mechanism.joints()[through].second.link);
    let mut layers = vec![(start, 1)];
    let mut next = 0;
    while let Some(&(link, length)) = layers.get(next) {
        if link == goal {
            return Some(length);
        }
        next += 1;
        for &index in group.inner.iter().filter(|&&index| index != through) {
            let joint = &mechanism.joints()[index];
            if joint.on(link).is_some() && !layers.iter().any(|&(seen, _)| seen == joint.other(link).link) {
                layers.push((joint.other(link).link, length + 1));
            }
        }
    }
    None
}
