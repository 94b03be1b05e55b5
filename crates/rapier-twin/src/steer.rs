//! Directions of the rows that close a loop, chosen so that few sweeps are enough.
//!
//! A pin that the tree cuts has two rows.
//! Gauss-Seidel iteration solves the two rows one after the other. The coupling of the rows determines the rate of
//! convergence.
//! Consider the line from a link's pin in the tree to its cut pin.
//! Rotation of the link moves the cut pin across this line, not along it.
//! The rows are therefore laid along and across the line of the link that moves more easily.
//! With these directions, each sweep leaves at most half of the error.
//! The remaining fraction is a cos^2 mu / (a cos^2 mu + b), where mu is the angle between the lines of the two links.
//! Here a and b >= a are the squares of the lengths of the lines, each divided by the moment of inertia of its link
//! about the pin in the tree.
//! If the rows have other directions than along and across this line, the remaining fraction may come close to 1.

use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Joint, Mechanism};
use linkage::mechanism::{LinkId, spanning_tree::SpanningTree};

/// The two links of a cut pin, and the direction of the first row.
/// The link that moves more easily is the first link, and the direction is given in the frame of this link.
/// `masses` are mass (kg) and moment of inertia (kg m^2) of every link. `None` if there is no choice of directions.
pub(super) fn steered(
    tree: &SpanningTree,
    mechanism: &Mechanism,
    masses: &[[f64; 2]],
    joint: &Joint,
) -> Option<([LinkId; 2], Vec2)> {
    if !joint.is_pin() || tree.branches.is_empty() {
        return None;
    }
    let links = [joint.first.link, joint.second.link];
    let arm = |link: LinkId| -> Option<(f64, Vec2)> {
        let Some(branch) = tree.branches.iter().find(|branch| branch.link == link) else {
            // A floating link turns about its mass centre, so its arm begins at the mass centre.
            let arm = joint.on(link)? - mechanism.links()[link].mass_centre;
            return (arm.norm() > 0.0).then(|| (arm.norm_squared() / masses[link][1], arm.normalize()));
        };
        let own = &mechanism.joints()[branch.joint];
        let [mass, inertia] = masses[link];
        match own.axis_on(link) {
            None => {
                let pivot = own.on(link)?;
                let arm = joint.on(link)? - pivot;
                let about = inertia + mass * (mechanism.links()[link].mass_centre - pivot).norm_squared();
                (arm.norm() > 0.0).then(|| (arm.norm_squared() / about, arm.normalize()))
            }
            Some(axis) => Some((mass.recip(), axis)),
        }
    };
    let arms = links.map(|link| if link == GROUND { None } else { arm(link) });
    match arms {
        [Some((one, axis)), other] if other.is_none_or(|(other, _)| one >= other) => Some((links, axis)),
        [_, Some((_, axis))] => Some(([links[1], links[0]], axis)),
        [_, None] => None,
    }
}
