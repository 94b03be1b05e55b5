//! Masses of links in Rapier: the masses of the case, and the additions that Rapier needs.

use super::tree::SpanningTree;
use linkage::case::Case;
use linkage::engine::bodies::stand_in;
use linkage::input::Input;
use linkage::math::KeepNan;
use linkage::mechanism::{GROUND, Joint, Link, LinkId};

/// Mass added to a massless link, divided by the mean mass of the links.
/// The smaller the added mass, the faster the compensating loads become exact: each step multiplies their error by
/// about this fraction.
const SHARE: f64 = 0.1;
/// Moment of inertia of a slender rod, divided by its mass and the square of its length.
const ROD: f64 = 1.0 / 12.0;

/// If a mass centre is farther from all joints of its link than this fraction of the link's extent, the link needs a
/// mass but no moment of inertia.
/// The mass matrix of a multibody is regular even with a point mass, if the point mass does not lie in a joint.
const OFF_JOINTS: f64 = 1e-2;

/// Additional moment of inertia of driving links, divided by the total mass times the square of the mechanism's size.
/// A link with prescribed speed may have any additional moment of inertia, because the addition affects neither the
/// motion nor the reactions.
/// The additional moment of inertia affects the driving moment only where the speed changes.
/// This contribution to the driving moment is subtracted ([`Ghost`](super::ghost::Ghost)).
/// With a large moment of inertia, the constraint rows of the drives hardly depend on the rows of the loops, and the
/// sweeps converge.
/// On a four-bar whose coupler is thirteen times as heavy as its crank, 32 sweeps with the flywheel achieve as much as
/// 1024 sweeps without the flywheel.
/// A flywheel ten times as large gives no further gain.
const FLYWHEEL: f64 = 1.0;

/// Mass (kg) and moment of inertia (kg m^2) of every link in Rapier, without flywheels.
/// Rapier cannot move a body without mass and inertia.
///
/// If the speed is prescribed, the motion does not depend on the masses, but the convergence of the sweeps does.
/// The sweeps hardly converge if the masses of neighbours differ much.
/// Each link therefore has at least the mean mass, and at least the moment of inertia of a rod of that mass.
/// The contribution of the added masses and moments of inertia to the reactions is subtracted again
/// ([`Ghost`](super::ghost::Ghost)).
///
/// In a free motion, the moment of inertia of the crank includes that of rotor and gearbox.
/// In a free motion, the additions depend on the world's tree, and loads compensate the additions
/// ([`Added`](super::added::Added)).
pub(super) fn masses(case: &Case, tree: &SpanningTree) -> Vec<[f64; 2]> {
    let mut masses = bare_masses(case, tree);
    if case.is_free() {
        return masses;
    }
    let moving = &case.mechanism.links()[1..];
    let mean = moving.iter().map(|link| link.mass).sum::<f64>() / moving.len() as f64;
    for ([mass, inertia], link) in masses.iter_mut().zip(case.mechanism.links()).skip(1) {
        let length = length(case, link);
        (*mass, *inertia) = (mass.larger(mean), inertia.larger(ROD * mean * length * length));
    }
    masses
}

/// Masses and moments of inertia of the links in Rapier.
/// Links that have both mass and moment of inertia get no addition.
fn bare_masses(case: &Case, tree: &SpanningTree) -> Vec<[f64; 2]> {
    let of = |(index, link): (LinkId, &Link)| {
        let [mass, inertia] = if case.is_free() { added(case, index, tree) } else { stand_in(case, index) };
        [link.mass + mass, link.inertia + inertia]
    };
    let mut masses: Vec<[f64; 2]> = case.mechanism.links().entries().map(of).collect();
    masses[GROUND] = [0.0; 2];
    masses[case.crank().link][1] += case.crank().moving_inertia();
    masses
}

/// Masses of a world that only provides a motion with prescribed speeds.
/// All links have equal masses. Each link has the moment of inertia of a rod of the link's extent.
/// The motion does not depend on the masses, but the sweeps do: the sweeps hardly converge if the masses differ much.
fn even_masses(case: &Case) -> Vec<[f64; 2]> {
    let of = |link: &Link| [1.0, ROD * length(case, link) * length(case, link)];
    let mut masses: Vec<[f64; 2]> = case.mechanism.links().iter().map(of).collect();
    masses[GROUND] = [0.0; 2];
    masses
}

/// Use of a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loading {
    /// Only the motion of the world is read. Under prescribed speeds the world has [`even_masses`].
    Moving,
    /// The forces of the world are read, and the contribution of the added masses is subtracted.
    Read,
    /// The forces of the world are read, and nothing is subtracted.
    Bare,
}

/// Masses of a world.
pub(super) fn world_masses(case: &Case, tree: &SpanningTree, loading: Loading) -> Vec<[f64; 2]> {
    match loading {
        Loading::Moving if !case.is_free() => with_flywheels(case, even_masses(case)),
        Loading::Moving | Loading::Read => masses_with_flywheels(case, tree),
        Loading::Bare => with_flywheels(case, bare_masses(case, tree)),
    }
}

/// The masses of the links in Rapier, with flywheels on the driving links whose speed is prescribed.
pub(super) fn masses_with_flywheels(case: &Case, tree: &SpanningTree) -> Vec<[f64; 2]> {
    with_flywheels(case, masses(case, tree))
}

fn with_flywheels(case: &Case, mut masses: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    if case.is_free() {
        return masses;
    }
    let total: f64 = masses.iter().map(|[mass, _]| mass).sum();
    let size = case.mechanism.size();
    for drive in &case.drives {
        let [mass, inertia] = &mut masses[drive.link];
        match drive.input {
            Input::Angle => *inertia += FLYWHEEL * total * size * size,
            Input::Slide if case.mechanism.joints()[drive.joint].on(GROUND).is_some() => *mass += FLYWHEEL * total,
            // Both links of the joint move, so a flywheel on one of them does not improve the convergence of the
            // drive's constraint row.
            Input::Turn | Input::Slide => {}
        }
    }
    masses
}

/// Mass (kg) and moment of inertia (kg m^2) that are added to a link in a free motion. A value is 0 if no addition is
/// needed.
/// The values depend on whether the link is in the tree of the world.
pub(super) fn added(case: &Case, link: LinkId, tree: &SpanningTree) -> [f64; 2] {
    if link == GROUND {
        return [0.0; 2];
    }
    let (own, size) = (&case.mechanism.links()[link], case.mechanism.size());
    let rotor = if link == case.crank().link { case.crank().moving_inertia() } else { 0.0 };
    let moving = &case.mechanism.links()[1..];
    let total: f64 = moving.iter().map(|link| link.mass).sum::<f64>() + case.crank().moving_inertia() / (size * size);
    let mean = if total > 0.0 { total / moving.len() as f64 } else { 1.0 };
    let mass = if own.mass > 0.0 { 0.0 } else { SHARE * mean };
    let extent = length(case, own);
    let turned_by = |joint: &Joint| joint.on(link).filter(|_| !joint.keeps_angle());
    let arms = case.mechanism.joints().iter().filter_map(turned_by).map(|place| (place - own.mass_centre).norm());
    let separate = tree.branches.iter().all(|branch| branch.link != link);
    let off = !separate && own.mass > 0.0 && arms.fold(f64::INFINITY, f64::smaller) > OFF_JOINTS * extent;
    let is_enough = own.inertia + rotor > 0.0 || off;
    [mass, if is_enough { 0.0 } else { ROD * (own.mass + mass) * extent * extent }]
}

/// Length (m) of the rod that replaces a link without a moment of inertia.
fn length(case: &Case, link: &Link) -> f64 {
    let extent = link.extent();
    if extent > 0.0 { extent } else { case.mechanism.size() }
}
