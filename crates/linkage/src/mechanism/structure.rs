//! Structural analysis: mobility, and the decomposition into driving links and Assur groups.
//!
//! Every link has three degrees of freedom. Every revolute or prismatic pair removes two degrees of freedom. Every
//! given coordinate and every transmission removes one degree of freedom.
//! Each equation concerns two or three links, and one of these links becomes its owner. Each link owns three equations.
//! This assignment of equations to links is a matching.
//! For every equation that a link owns, the link depends on the other links of the equation.
//! These dependences form a graph. The strongly connected components of this graph are the driving links and the Assur
//! groups.
//! The components are listed in the order in which they can be solved.
//! The components do not depend on the choice of matching (Dulmage and Mendelsohn 1958).
//!
//! A driving link stands on the ground or on an earlier driving link. A given joint that moves
//! no such link belongs to a group.
//! Links connected by a joint with given coordinate form one body, whose shape is known at every instant. A group is
//! therefore classified by its bodies instead of its links.

mod driven;
mod formula;
mod group;
mod owners;
#[cfg(test)]
mod tests;

use crate::sentences;
pub use driven::{DrivenJoint, DrivingLink};
pub use group::{Group, GroupKind, roman};

use super::{GROUND, LinkPose, Mechanism, Pose};
use crate::error::{Error, ErrorKind, Result};
use crate::input::Input;
use crate::mechanism::{AssemblyMode, GroupId, JointId, LinkId, PerGroup, PerLink, TransmissionId};
use group::highest_contour;
use owners::{Owners, Source, check_sparse};

/// Result of the structural analysis of a mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Structure {
    /// Mobility by Chebyshev-Gruebler, W = 3 n - 2 p - t (n moving links, p lower pairs, t transmissions).
    pub mobility: i64,
    /// Driving links, in the order in which the drives were given.
    pub drivers: Vec<DrivingLink>,
    /// Assur groups in the order in which they can be solved.
    pub groups: PerGroup<Group>,
    /// For a mechanism with transmissions: the structure in which the start joint of each transmission replaces the
    /// transmission and has a given coordinate. See [`Structure::at_start`].
    start: Option<Box<Structure>>,
    /// The transmissions, in the order of their start joints. The list is empty except in the structure of the start
    /// pose.
    phases: Vec<TransmissionId>,
}

impl Structure {
    /// Analyses a mechanism with drives at the joints `drives`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if links have no connection to the ground, or if the mobility differs from the number of
    /// drives.
    /// [`ErrorKind::Input`] also if one part of the mechanism is over-constrained while a second part is free to move,
    /// or if prismatic and driven joints alone form a closed loop.
    /// [`ErrorKind::Input`] also if a drive comes before the drive of the link that carries it.
    /// [`ErrorKind::Input`] also if the start joint of a transmission is driven, or if the start joints do not fit the
    /// groups of the mechanism.
    pub fn of<T: Copy + Into<DrivenJoint>>(mechanism: &Mechanism, drives: &[T]) -> Result<Self> {
        let drives: Vec<DrivenJoint> = drives.iter().map(|&drive| drive.into()).collect();
        let structure = Structure::of_driven(mechanism, &drives)?;
        structure.with_start(mechanism, &drives)
    }

    /// The structure in which the start pose is assembled.
    /// Each transmission is replaced by its start joint, which has a given coordinate. In the list of driving links,
    /// the start joints come after the drives.
    /// For a mechanism without transmissions, the result is this structure.
    #[must_use]
    pub fn at_start(&self) -> &Structure {
        self.start.as_deref().unwrap_or(self)
    }

    /// Given coordinates of [`Structure::at_start`]: the coordinates of the drives, then of the transmissions' start
    /// joints.
    #[must_use]
    pub fn given_at_start(&self, mechanism: &Mechanism, drives: &[f64]) -> Vec<f64> {
        let at_start = self.at_start();
        let starts = at_start.phases.iter().map(|&own| mechanism.transmissions()[own].design.start);
        drives.iter().copied().chain(starts).take(at_start.drivers.len()).collect()
    }

    /// This structure with the groups in `groups` only.
    #[must_use]
    pub fn of_groups(&self, groups: impl Iterator<Item = GroupId>) -> Structure {
        Structure { groups: groups.map(|group| self.groups[group].clone()).collect(), ..self.clone() }
    }

    /// Converts assembly modes of the groups of [`Structure::at_start`] to modes of this structure's groups.
    #[must_use]
    pub fn modes(&self, at_start: &[AssemblyMode]) -> Vec<AssemblyMode> {
        carried(self.at_start(), at_start, self)
    }

    /// Converts assembly modes of this structure's groups to modes of the groups of [`Structure::at_start`].
    #[must_use]
    pub fn modes_at_start(&self, modes: &[AssemblyMode]) -> Vec<AssemblyMode> {
        carried(self, modes, self.at_start())
    }

    fn with_start(mut self, mechanism: &Mechanism, drives: &[DrivenJoint]) -> Result<Self> {
        if mechanism.transmissions().is_empty() {
            return Ok(self);
        }
        let is_driven = |joint: JointId| drives.iter().any(|drive| drive.joint == joint);
        if let Some(own) = mechanism.transmissions().iter().find(|own| is_driven(own.design.joint)) {
            let message = sentences::the_start_joint_is_driven(&own.name(), &mechanism.joints()[own.design.joint].name);
            return Err(Error::new(ErrorKind::Input, message)
                .key(format!("transmissions.{}", own.name()))
                .help(sentences::GIVE_A_JOINT_OF_THE_TRANSMISSION));
        }
        let phases = phases(mechanism, drives);
        let phase = |&transmission: &TransmissionId| DrivenJoint {
            joint: mechanism.transmissions()[transmission].design.joint,
            input: Input::Turn,
        };
        let given: Vec<DrivenJoint> = drives.iter().copied().chain(phases.iter().map(phase)).collect();
        let free = mechanism.clone().with_transmissions(Vec::new()).expect("a mechanism without transmissions");
        let start = Structure::of_driven(&free, &given).map_err(|error| {
            let message = sentences::the_start_of_the_transmissions(&error.to_string());
            Error::new(ErrorKind::Input, message).key("transmissions").help(sentences::GIVE_A_JOINT_OF_THE_TRANSMISSION)
        })?;
        let has_modes = |group: &&Group| !group.kind.has_one_configuration() && group.kind != GroupKind::Higher;
        if let Some(changed) = self.groups.iter().filter(has_modes).find(|group| !start.groups.contains(group)) {
            let message = sentences::the_start_joint_of_a_transmission_changes(&changed.names(mechanism));
            return Err(Error::new(ErrorKind::Input, message)
                .key("transmissions")
                .help(sentences::GIVE_A_JOINT_OF_THE_TRANSMISSION));
        }
        self.start = Some(Box::new(Structure { phases, ..start }));
        Ok(self)
    }

    /// The structure of the motion alone, without the structure of the start pose ([`Structure::at_start`]).
    ///
    /// # Errors
    /// The errors of [`Structure::of`] that do not concern the start of transmissions.
    pub fn of_driven(mechanism: &Mechanism, drives: &[DrivenJoint]) -> Result<Self> {
        check_connected(mechanism)?;
        check_angles(mechanism, drives)?;
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
            let is_owned = |of: Source| owners.owner_of(of).is_some_and(|link| part.contains(&link));
            let is_given = |drive: &&DrivenJoint| is_owned(Source::Drive(drive.joint));
            let given: Vec<DrivenJoint> = drives.iter().filter(is_given).copied().collect();
            let in_group =
                !matches!(given[..], [drive] if part.len() == 1 && carries(mechanism, &drivers, drive.joint, part[0]));
            for DrivenJoint { joint, input } in &given {
                let second = mechanism.joints()[*joint].second.link;
                let link = if part.contains(&second) { second } else { mechanism.joints()[*joint].first.link };
                let input = match mechanism.joints()[*joint].slides() {
                    true => Input::Slide,
                    false if in_group => Input::Turn,
                    false => *input,
                };
                drivers.push(DrivingLink { link, joint: *joint, input, in_group });
            }
            let solved = part.clone();
            if in_group {
                let given = given.iter().map(|drive| drive.joint).collect();
                let trains = mechanism.transmissions().ids();
                let trains = trains.filter(|&id| is_owned(Source::Transmission(id))).collect();
                groups.push(group(mechanism, part, given, trains, &known));
            }
            for link in solved {
                known[link] = true;
            }
        }
        drivers.sort_by_key(|driver| drives.iter().position(|drive| drive.joint == driver.joint));
        let structure = Structure { mobility, drivers, groups: groups.into(), start: None, phases: Vec::new() };
        structure.check_order(mechanism)?;
        Ok(structure)
    }

    /// Checks that each driving link comes after the link that carries it.
    fn check_order(&self, mechanism: &Mechanism) -> Result<()> {
        for (index, driver) in self.drivers.iter().enumerate().filter(|(_, driver)| !driver.in_group) {
            let joint = &mechanism.joints()[driver.joint];
            let base = joint.other(driver.link).link;
            if base != GROUND && !self.drivers[..index].iter().any(|before| before.link == base) {
                let name = &mechanism.links()[base].name;
                let message = sentences::joint_hangs_on_link_which_is_driven(&joint.name, &name);
                return Err(Error::new(ErrorKind::Input, message)
                    .key("drive")
                    .help(sentences::GIVE_THE_DRIVES_FROM_THE_GROUND));
            }
        }
        Ok(())
    }

    /// The driving links that stand on the ground or on an earlier driving link, each with the index of its drive.
    pub fn leading(&self) -> impl DoubleEndedIterator<Item = (usize, &DrivingLink)> {
        self.drivers.iter().enumerate().filter(|(_, driver)| !driver.in_group)
    }

    /// A pose in which each driving link is placed at the coordinate of its drive, as in
    /// [`Drive::coordinate`](crate::drive::Drive::coordinate).
    /// In a body with given joints, the body's first link (its lead) has the pose of the ground. The other links of the
    /// body have their poses relative to the lead.
    /// All links outside such bodies, except the driving links, have the pose of the ground.
    #[must_use]
    pub fn driving_pose(&self, mechanism: &Mechanism, coordinates: &[f64]) -> Pose {
        let mut pose = Pose(vec![LinkPose::GROUND; mechanism.links().len()].into());
        let mut place = |link: LinkId, driver: &DrivingLink, coordinate: f64| {
            let joint = &mechanism.joints()[driver.joint];
            pose.0[link] = joint.driven(link, &pose.0[joint.other(link).link], driver.input, coordinate);
        };
        for (index, driver) in self.leading() {
            place(driver.link, driver, coordinates[index]);
        }
        for group in &self.groups {
            let leads = group.leads(mechanism);
            let mut placed: Vec<LinkId> = leads.clone();
            let is_inner =
                |driver: &DrivingLink| group.given.contains(&driver.joint) && group.inner.contains(&driver.joint);
            let mut left: Vec<usize> =
                (0..self.drivers.len()).filter(|&index| is_inner(&self.drivers[index])).collect();
            while !left.is_empty() {
                left.retain(|&index| {
                    let joint = &mechanism.joints()[self.drivers[index].joint];
                    let [first, second] = [joint.first.link, joint.second.link];
                    let link = if placed.contains(&first) { second } else { first };
                    let reaches = placed.contains(&first) || placed.contains(&second);
                    if reaches {
                        place(link, &self.drivers[index], coordinates[index]);
                        placed.push(link);
                    }
                    !reaches
                });
            }
        }
        pose
    }

    /// Places the link of a [driven](GroupKind::Driven) group. The arguments are those of [`Structure::driving_pose`].
    /// The driven joint's other link must already have its pose in `pose`.
    pub fn place_driven(&self, mechanism: &Mechanism, group: &Group, coordinates: &[f64], pose: &mut Pose) {
        let index = self.drivers.iter().position(|driver| driver.joint == group.given[0]).expect("the joint is driven");
        let (driver, joint) = (&self.drivers[index], &mechanism.joints()[group.given[0]]);
        let base = pose.0[joint.other(driver.link).link];
        pose.0[driver.link] = joint.driven(driver.link, &base, driver.input, coordinates[index]);
    }

    /// For every link: the groups on which the link's motion depends if all drives are prescribed.
    /// The list contains the link's group and all earlier groups on which this group depends, as indices in ascending
    /// order.
    /// The list is empty for the ground and for driving links.
    #[must_use]
    pub fn upstream(&self, mechanism: &Mechanism) -> PerLink<Vec<GroupId>> {
        let mut upstream: PerLink<Vec<GroupId>> = vec![Vec::new(); mechanism.links().len()].into();
        for (index, group) in self.groups.entries() {
            let ends = group.outer.iter().map(|&joint| &mechanism.joints()[joint]);
            let trains = group.trains.iter().flat_map(|&id| mechanism.transmissions()[id].links());
            let neighbours = ends.flat_map(|joint| [joint.first.link, joint.second.link]).chain(trains);
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
}

/// Whether the driven joint connects a driving link to the ground or to one of the `drivers` found so far.
fn carries(mechanism: &Mechanism, drivers: &[DrivingLink], joint: JointId, link: LinkId) -> bool {
    let base = mechanism.joints()[joint].other(link).link;
    base == GROUND || drivers.iter().any(|driver| driver.link == base && !driver.in_group)
}

/// Assembly modes of the groups of the structure `to`. `modes` contains the modes of the groups of `from`.
/// A group that exists in both structures keeps its mode.
fn carried(from: &Structure, modes: &[AssemblyMode], to: &Structure) -> Vec<AssemblyMode> {
    let mode = |group: &Group| match from.groups.find(|own| own == group) {
        Some(own) => modes[own],
        None if group.kind.has_one_configuration() => AssemblyMode::Only,
        None => AssemblyMode::Followed,
    };
    to.groups.iter().map(mode).collect()
}

/// The transmissions in an order in which each start joint touches a reached link, if possible. Reached links are the
/// ground, the links on driven joints, and the links on earlier start joints.
fn phases(mechanism: &Mechanism, drives: &[DrivenJoint]) -> Vec<TransmissionId> {
    let ends = |joint: JointId| {
        let joint = &mechanism.joints()[joint];
        [joint.first.link, joint.second.link]
    };
    let joint = |transmission: TransmissionId| mechanism.transmissions()[transmission].design.joint;
    let mut reached: Vec<LinkId> = drives.iter().flat_map(|drive| ends(drive.joint)).chain([GROUND]).collect();
    let mut left: Vec<TransmissionId> = mechanism.transmissions().ids().collect();
    let mut ordered = Vec::with_capacity(left.len());
    while !left.is_empty() {
        let hangs = |&own: &TransmissionId| ends(joint(own)).iter().any(|link| reached.contains(link));
        let next = left.remove(left.iter().position(hangs).unwrap_or(0));
        reached.extend(ends(joint(next)));
        ordered.push(next);
    }
    ordered
}

/// W = 3 n - 2 p - t: every lower pair removes two degrees of freedom, every transmission one.
fn mobility(mechanism: &Mechanism) -> i64 {
    3 * (mechanism.links().len() as i64 - 1) - (mechanism.equations() + mechanism.transmissions().len()) as i64
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

/// Rejects closed loops that consist only of prismatic pairs and driven revolute pairs.
/// Such a loop constrains the angle between its links twice and leaves the links free to slide.
fn check_angles(mechanism: &Mechanism, drives: &[DrivenJoint]) -> Result<()> {
    let mut part: Vec<LinkId> = mechanism.links().ids().collect();
    let is_driven = |index: JointId| drives.iter().any(|drive| drive.joint == index);
    let (sliding, turning): (Vec<JointId>, Vec<JointId>) =
        mechanism.joints().ids().partition(|&index| mechanism.joints()[index].keeps_angle());
    for index in sliding.into_iter().chain(turning.into_iter().filter(|&index| is_driven(index))) {
        let joint = &mechanism.joints()[index];
        let (a, b) = (part[joint.first.link], part[joint.second.link]);
        if a == b {
            let (message, help) = match joint.keeps_angle() {
                true => {
                    (sentences::THE_JOINT_CLOSES_A_LOOP_OF_PRISMATIC, sentences::LINKS_THAT_ARE_JOINED_BY_PRISMATIC)
                }
                false => (sentences::THE_DRIVEN_JOINT_TURNS_LINKS_WITH_KEPT_ANGLES, sentences::DRIVE_ANOTHER_JOINT),
            };
            return Err(Error::new(ErrorKind::Input, message).key(format!("joints.{}", joint.name)).help(help));
        }
        part.iter_mut().filter(|own| **own == b).for_each(|own| *own = a);
    }
    Ok(())
}

fn wrong_mobility(mechanism: &Mechanism, mobility: i64, drives: usize) -> Error {
    let (n, p, t) = (mechanism.links().len() - 1, mechanism.joints().len(), mechanism.transmissions().len());
    let message = match t {
        0 => sentences::the_mobility_is_but_the_number(&n, &p, &mobility, &drives),
        _ => sentences::the_mobility_with_transmissions_is(&n, &p, &t, &mobility, &drives),
    };
    let help = if mobility > drives as i64 {
        sentences::ADD_THE_MISSING_JOINTS_OR_DRIVES
    } else {
        sentences::THE_MECHANISM_IS_OVER_CONSTRAINED
    };
    Error::new(ErrorKind::Input, message).key("joints").help(help)
}

/// The group of `links` with the `given` joints and the transmissions `trains`. All links marked in `known` are already
/// solved.
fn group(
    mechanism: &Mechanism,
    links: Vec<LinkId>,
    given: Vec<JointId>,
    trains: Vec<TransmissionId>,
    known: &[bool],
) -> Group {
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
    let mut group = Group { links, inner, outer, given, trains, class: 1, kind: GroupKind::Driven };
    // The outer joints of a dyad are sorted in the order of its bodies.
    let leads = group.leads(mechanism);
    let lead_of = |joint: &JointId| {
        group.links.iter().position(|&link| mechanism.joints()[*joint].on(link).is_some()).map(|at| leads[at])
    };
    group.outer.sort_by_key(lead_of);
    group.kind = kind(mechanism, &group);
    if group.kind != GroupKind::Driven {
        group.class = highest_contour(mechanism, &group);
    }
    group
}

fn kind(mechanism: &Mechanism, group: &Group) -> GroupKind {
    let leads = group.leads(mechanism);
    match group.links.iter().zip(&leads).filter(|(link, lead)| link == lead).count() {
        1 => return GroupKind::Driven,
        2 if group.trains.is_empty() => {}
        _ => return GroupKind::Higher,
    }
    let slides = |joints: &[JointId]| {
        let free = joints.iter().filter(|joint| !group.given.contains(joint));
        free.filter(|&&joint| mechanism.joints()[joint].slides()).count()
    };
    match (slides(&group.inner), slides(&group.outer)) {
        (0, 0) => GroupKind::Rrr,
        (0, 1) => GroupKind::Rrp,
        (0, _) => GroupKind::Prp,
        (_, 0) => GroupKind::Rpr,
        // The remaining kind is RPP, because a dyad with three prismatic pairs was rejected earlier.
        (_, _) => GroupKind::Rpp,
    }
}
