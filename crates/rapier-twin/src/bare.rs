//! What a link of a free motion needs in Rapier beyond its own mass and moment of inertia.

use super::tree::Tree;
use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::mechanism::{GROUND, Joint, LinkId};

/// Mass added to a link without any, as a share of the mean mass.
/// What is light is taken away quickly: the error of a first guess decays with this share from step to step.
const SHARE: f64 = 0.1;
/// Moment of inertia of a slender rod over its mass and the square of its length.
const ROD: f64 = 1.0 / 12.0;

/// Distance of a mass centre from all joints of its link, as a share of the link's extent, from which on a point mass
/// makes the mass matrix of a multibody regular.
const OFF_JOINTS: f64 = 1e-2;

/// Mass (kg) and moment of inertia (kg m^2) that a link of a free motion gets in addition; 0 where it needs none.
/// What it needs depends on whether it is in the tree of the world.
pub(super) fn to_link(case: &Case, link: LinkId, tree: &Tree) -> [f64; 2] {
    if link == GROUND {
        return [0.0; 2];
    }
    let (own, size) = (&case.mechanism.links()[link], case.mechanism.size());
    let rotor = if link == case.crank().link { case.crank().moving_inertia() } else { 0.0 };
    let moving = &case.mechanism.links()[1..];
    let total: f64 = moving.iter().map(|link| link.mass).sum::<f64>() + case.crank().moving_inertia() / (size * size);
    let mean = if total > 0.0 { total / moving.len() as f64 } else { 1.0 };
    let mass = if own.mass > 0.0 { 0.0 } else { SHARE * mean };
    let extent = if own.extent() > 0.0 { own.extent() } else { size };
    let turned_by = |joint: &Joint| joint.on(link).filter(|_| !joint.keeps_angle());
    let arms = case.mechanism.joints().iter().filter_map(turned_by).map(|place| (place - own.mass_centre).norm());
    let separate = tree.branches.iter().all(|branch| branch.link != link);
    let off = !separate && own.mass > 0.0 && arms.fold(f64::INFINITY, f64::smaller) > OFF_JOINTS * extent;
    let is_enough = own.inertia + rotor > 0.0 || off;
    [mass, if is_enough { 0.0 } else { ROD * (own.mass + mass) * extent * extent }]
}
