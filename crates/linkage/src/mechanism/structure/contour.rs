//! Class of an Assur group, from its closed contours.

use super::group::Group;
use crate::mechanism::{LinkId, Mechanism};

/// Number of sides of the closed contour with the most sides.
/// A link with three or more inner pairs is a contour. The number of its sides is the number of its inner pairs.
/// Every shortest loop of inner joints is a contour too.
pub(super) fn highest_contour(mechanism: &Mechanism, group: &Group) -> usize {
    let leads = group.leads(mechanism);
    let body = |link: LinkId| leads[group.links.iter().position(|&own| own == link).expect("the joint is inner")];
    let free = group.inner.iter().filter(|joint| !group.given.contains(joint));
    let free = free.map(|&joint| &mechanism.joints()[joint]);
    let pairs: Vec<[LinkId; 2]> = free.map(|joint| [joint.first.link, joint.second.link].map(body)).collect();
    let pairs_on = |link: &LinkId| pairs.iter().filter(|pair| pair.contains(link)).count();
    let rigid = leads.iter().map(pairs_on).max().unwrap_or(0);
    let loops = (0..pairs.len()).filter_map(|index| shortest_loop(&pairs, index)).max().unwrap_or(0);
    rigid.max(loops).max(2)
}

/// Number of bodies in the shortest loop of inner joints through the pair `through`; `None` if there is no loop.
fn shortest_loop(pairs: &[[LinkId; 2]], through: usize) -> Option<usize> {
    let [start, goal] = pairs[through];
    let mut layers = vec![(start, 1)];
    let mut next = 0;
    while let Some(&(body, length)) = layers.get(next) {
        if body == goal {
            return Some(length);
        }
        next += 1;
        for (_, pair) in pairs.iter().enumerate().filter(|(index, pair)| *index != through && pair.contains(&body)) {
            let other = if pair[0] == body { pair[1] } else { pair[0] };
            if !layers.iter().any(|&(seen, _)| seen == other) {
                layers.push((other, length + 1));
            }
        }
    }
    None
}
