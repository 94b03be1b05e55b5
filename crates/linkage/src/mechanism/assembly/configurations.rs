//! All real configurations of a group of any kind.

use super::fused::Fused;
use super::mode::{AssemblyMode, Configuration};
use super::{dyads, four_link};
use crate::error::{Error, ErrorKind, Result};
use crate::mechanism::{Group, GroupKind, Mechanism, Pose};
use crate::sentences;

/// All real configurations of a group. `pose` contains the poses of the links of earlier groups.
/// If a group has joints with given coordinates, these joints fuse links to bodies.
/// In `pose`, the links of each body must then have the correct relative pose, as in
/// [`Structure::driving_pose`](crate::mechanism::Structure::driving_pose).
/// A driven link must already be placed in `pose`.
/// A dyad has up to two configurations, a group of four bodies up to six.
///
/// # Errors
/// [`ErrorKind::Geometry`](crate::ErrorKind::Geometry) if there is no configuration, or if the group can move.
/// [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) for groups of more than four bodies and for groups with
/// transmissions, because not all configurations of such groups are known.
pub fn configurations(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Result<Vec<Configuration>> {
    if group.kind == GroupKind::Driven {
        return Ok(vec![Configuration { mode: AssemblyMode::Only, links: vec![pose.0[group.links[0]]] }]);
    }
    if !group.trains.is_empty() {
        let message = sentences::the_configurations_of_the_train(&group.names(mechanism));
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    if !group.is_rigid() {
        let fused = Fused::of(mechanism, group, pose);
        let all = configurations(&fused.mechanism, &fused.group, pose)?;
        return Ok(all.into_iter().map(|one| fused.configuration(one)).collect());
    }
    match group.kind {
        GroupKind::Driven => unreachable!("its pose is known"),
        GroupKind::Higher => four_link::configurations(mechanism, group, pose),
        GroupKind::Rrr | GroupKind::Rrp | GroupKind::Rpr | GroupKind::Rpp | GroupKind::Prp => {
            dyads::configurations(mechanism, group, pose)
        }
    }
}

/// Sine of a dyad's transmission angle in the given pose; `None` for higher groups and driven links.
/// The sine is zero at a dead point.
///
/// - RRR: signed area of the dyad's triangle (first outer, second outer, inner joint) divided by half the product of
///   the two link lengths. The sine is positive in the mode [`AssemblyMode::Left`](super::AssemblyMode::Left).
/// - RRP: e . r / |r| with the direction e of the guide and r from the outer pin to the inner joint.
///   This value is the sine of the angle between the rod and the normal to the guide. The sine is positive in the mode
///   [`AssemblyMode::Ahead`](super::AssemblyMode::Ahead).
/// - RPR: e . d / |d| with the direction e of the guide, and d from the outer pin of the prismatic pair's first link to
///   the outer pin of the pair's second link. The sine is positive in the mode
///   [`AssemblyMode::Ahead`](super::AssemblyMode::Ahead).
/// - RPP: e1 x e2 with the direction e1 of the inner axis and e2 of the outer axis.
/// - PRP: e1 x e2 with the directions of both outer axes, in the order of the group's links.
#[must_use]
pub fn transmission_sine(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Option<f64> {
    if matches!(group.kind, GroupKind::Higher | GroupKind::Driven) {
        return None;
    }
    let sine = |mechanism: &Mechanism, group: &Group| dyads::transmission_sine(mechanism, group, pose).clamp(-1.0, 1.0);
    Some(match group.is_rigid() {
        true => sine(mechanism, group),
        false => {
            let fused = Fused::of(mechanism, group, pose);
            sine(&fused.mechanism, &fused.group)
        }
    })
}
