//! Structural analysis: mobility, and the decomposition into driving links and Assur groups.
//!
//! Every link has three degrees of freedom. Every revolute or prismatic pair removes two, every drive one.
//! Each equation concerns two links, and one of the two links becomes its owner. A link owns three equations (a
//! matching).
//! For every equation that a link owns, the link depends on the other of the equation's two links.
//! These dependences form a graph. Its strongly connected components are the driving links and the Assur groups.
//! The components are listed in the order in which they can be solved.
//! The components do not depend on the choice of matching (Dulmage and Mendelsohn 1958).

mod contour;
mod group;
mod owners;
#[cfg(test)]
mod tests;

use crate::sentences;
pub use group::{Group, GroupKind};

use super::{GROUND, Mechanism};
use crate::error::{Error, ErrorKind, Result};
use crate::mechanism::{GroupId, JointId, LinkId, PerGroup, PerLink};
use contour::highest_contour;
use owners::{Owners, check_sparse};

/// Result of the structural analysis of a mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Structure {
    /// Mobility by Chebyshev-Gruebler, W = 3 n - 2 p (n moving links, p lower pairs).
    pub mobility: i64,
    /// Driving links as (link, driven joint), in the order in which the drives were given.
    pub drivers: Vec<(LinkId, JointId)>,
    /// Assur groups in the order in which they can be solved.
    pub groups: PerGroup<Group>,
}

impl Structure {
    /// Analyses a mechanism with drives at the joints `drives`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if links have no connection to the ground, or if the mobility differs from the number of
    /// drives.
    /// [`ErrorKind::Input`] also if one part is over-constrained while a second part is free to move.
    /// [`ErrorKind::Unsupported`] if a drive does not act on a link hinged to the ground.
    pub fn of(mechanism: &Mechanism, drives: &[JointId]) -> Result<Self> {
        check_connected(mechanism)?;
        check_sliders(mechanism)?;
        let mobility = mobility(mechanism);
        if mobility != drives.len() as i64 {
            return Err(wrong_mobility(mechanism, mobility, drives.len()));
        }
        check_sparse(mechanism, drives)?;
        let owners = Owners::find(mechanism, drives)?;
        let (mut drivers, mut groups) = (Vec::new(), Vec::new());
        let mut known = vec![false; mechanism.links().len()];
        known[GROUND] = true;
        for part in owners.parts(mechanism) {
            let solved = part.clone();
            let drive = drives
                .iter()
                .copied()
                .find(|&joint| owners.owner_of_drive(joint).is_some_and(|link| part.contains(&link)));
            match drive {
                None => groups.push(group(mechanism, part, &known)),
                Some(joint) if part.len() == 1 && carries(mechanism, &drivers, joint, part[0]) => {
                    drivers.push((part[0], joint));
                }
                Some(joint) => return Err(unsupported_drive(mechanism, joint)),
            }
            for link in solved {
                known[link] = true;
            }
        }
        drivers.sort_by_key(|&(_, joint)| drives.iter().position(|&drive| drive == joint));
        let structure = Structure { mobility, drivers, groups: groups.into() };
        structure.check_order(mechanism)?;
        Ok(structure)
    }

    /// Checks that each driving link comes after the link that carries it.
    fn check_order(&self, mechanism: &Mechanism) -> Result<()> {
        for (index, &(link, joint)) in self.drivers.iter().enumerate() {
            let joint = &mechanism.joints()[joint];
            let base = joint.other(link).link;
            if base != GROUND && !self.drivers[..index].iter().any(|&(before, _)| before == base) {
                let name = &mechanism.links()[base].name;
                let message = sentences::joint_hangs_on_link_which_is_driven(&joint.name, &name);
                return Err(Error::new(ErrorKind::Input, message)
                    .key("drive")
                    .help(sentences::GIVE_THE_DRIVES_FROM_THE_GROUND));
            }
        }
        Ok(())
    }

    /// For every link: the groups on which its motion depends if all drives are prescribed.
    /// These are the group of the link and all earlier groups on which this group depends, as indices in ascending
    /// order.
    /// The list is empty for the ground and for driving links.
    #[must_use]
    pub fn upstream(&self, mechanism: &Mechanism) -> PerLink<Vec<GroupId>> {
        let mut upstream: PerLink<Vec<GroupId>> = vec![Vec::new(); mechanism.links().len()].into();
        for (index, group) in self.groups.entries() {
            let ends = group.outer.iter().map(|&joint| &mechanism.joints()[joint]);
            let neighbours = ends.flat_map(|joint| [joint.first.link, joint.second.link]);
            let mut all: Vec<GroupId> = neighbours.flat_map(|link| upstream[link].iter().copied()).collect();
            all.push(index);
            all.sort_unstable();
            all.dedup();
            for &link in &group.links {
                upstream[link].clone_from(&all);
            }
        }
        upstream
    }

    /// Structural formula, for example `I(ground, crank) -> II.2 RRR(coupler, rocker)`.
    #[must_use]
    pub fn formula(&self, mechanism: &Mechanism) -> String {
        const ROMAN: [&str; 9] = ["", "I", "II", "III", "IV", "V", "VI", "VII", "VIII"];
        let name = |&(link, joint): &(LinkId, JointId)| {
            let base = mechanism.joints()[joint].other(link).link;
            format!("I({}, {})", mechanism.links()[base].name, mechanism.links()[link].name)
        };
        let mut parts: Vec<String> = self.drivers.iter().map(name).collect();
        for group in &self.groups {
            let class = ROMAN.get(group.class).map_or_else(|| group.class.to_string(), ToString::to_string);
            let pairs = group.kind.letters().map_or_else(String::new, |letters| format!(" {letters}"));
            parts.push(format!("{class}.{}{pairs}({})", group.order(), group.names(mechanism)));
        }
        parts.join(" -> ")
    }
}

/// Whether a drivable joint connects a driving link to the ground or to one of the `drivers` found so far.
fn carries(mechanism: &Mechanism, drivers: &[(LinkId, JointId)], joint: JointId, link: LinkId) -> bool {
    let joint = &mechanism.joints()[joint];
    let base = joint.other(link).link;
    joint.kind.input().is_some() && (base == GROUND || drivers.iter().any(|&(driving, _)| driving == base))
}

/// W = 3 n - 2 p: every lower pair removes two degrees of freedom.
fn mobility(mechanism: &Mechanism) -> i64 {
    3 * (mechanism.links().len() as i64 - 1) - mechanism.equations() as i64
}

fn check_connected(mechanism: &Mechanism) -> Result<()> {
    let mut reached = vec![false; mechanism.links().len()];
    reached[GROUND] = true;
    while let Some(joint) = mechanism.joints().iter().find(|j| reached[j.first.link] != reached[j.second.link]) {
        reached[joint.first.link] = true;
        reached[joint.second.link] = true;
    }
    match mechanism.links().ids().find(|&link| !reached[link]) {
        None => Ok(()),
        Some(link) => {
            let name = &mechanism.links()[link].name;
            Err(Error::new(ErrorKind::Input, sentences::THE_LINK_IS_NOT_CONNECTED)
                .key(format!("links.{name}"))
                .help(sentences::join_to_another_link_or_take(&name)))
        }
    }
}

/// Rejects closed loops of prismatic pairs alone.
/// Such a loop constrains the angle between its links twice and leaves the links free to slide.
fn check_sliders(mechanism: &Mechanism) -> Result<()> {
    let mut part: Vec<LinkId> = mechanism.links().ids().collect();
    for joint in mechanism.joints().iter().filter(|joint| joint.keeps_angle()) {
        let (a, b) = (part[joint.first.link], part[joint.second.link]);
        if a == b {
            return Err(Error::new(ErrorKind::Input, sentences::THE_JOINT_CLOSES_A_LOOP_OF_PRISMATIC)
                .key(format!("joints.{}", joint.name))
                .help(sentences::LINKS_THAT_ARE_JOINED_BY_PRISMATIC));
        }
        part.iter_mut().filter(|own| **own == b).for_each(|own| *own = a);
    }
    Ok(())
}

fn wrong_mobility(mechanism: &Mechanism, mobility: i64, drives: usize) -> Error {
    let (n, p) = (mechanism.links().len() - 1, mechanism.joints().len());
    let help = if mobility > drives as i64 {
        sentences::ADD_THE_MISSING_JOINTS_OR_DRIVES
    } else {
        sentences::THE_MECHANISM_IS_OVER_CONSTRAINED
    };
    Error::new(ErrorKind::Input, sentences::the_mobility_is_but_the_number(&n, &p, &mobility, &drives))
        .key("joints")
        .help(help)
}

fn unsupported_drive(mechanism: &Mechanism, joint: JointId) -> Error {
    Error::new(ErrorKind::Unsupported, sentences::the_driven_joint_does_not_turn(&mechanism.joints()[joint].name))
        .key("drive.joint")
        .help(sentences::DRIVE_A_LINK_THAT_IS_HINGED)
}

/// The group of `links`. All links marked in `known` are already solved.
fn group(mechanism: &Mechanism, links: Vec<LinkId>, known: &[bool]) -> Group {
    let inside = |link: LinkId| links.contains(&link);
    let (mut inner, mut outer) = (Vec::new(), Vec::new());
    let mut own: Vec<JointId> = links.iter().flat_map(|&link| mechanism.joints_on(link)).copied().collect();
    own.sort_unstable();
    own.dedup();
    for index in own {
        let joint = &mechanism.joints()[index];
        let (a, b) = (joint.first.link, joint.second.link);
        if inside(a) && inside(b) {
            inner.push(index);
        } else if inside(a) && known[b] || inside(b) && known[a] {
            outer.push(index);
        }
    }
    // A dyad's outer joints are in the order of its links.
    outer.sort_by_key(|&j| links.iter().position(|&link| mechanism.joints()[j].on(link).is_some()));
    let kind = kind(mechanism, &links, &inner, &outer);
    let mut group = Group { links, inner, outer, class: 2, kind };
    group.class = highest_contour(mechanism, &group);
    group
}

fn kind(mechanism: &Mechanism, links: &[LinkId], inner: &[JointId], outer: &[JointId]) -> GroupKind {
    if links.len() != 2 {
        return GroupKind::Higher;
    }
    let slides = |joints: &[JointId]| joints.iter().filter(|&&joint| mechanism.joints()[joint].slides()).count();
    match (slides(inner), slides(outer)) {
        (0, 0) => GroupKind::Rrr,
        (0, 1) => GroupKind::Rrp,
        (0, _) => GroupKind::Prp,
        (_, 0) => GroupKind::Rpr,
        // Only RPP remains, because a dyad with three prismatic pairs was rejected earlier.
        (_, _) => GroupKind::Rpp,
    }
}
