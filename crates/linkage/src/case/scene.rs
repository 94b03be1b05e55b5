//! Reduces a case to the parts on which the requested channels depend. See docs/skip.md and docs/numerics/settings.md.

use super::{Case, CaseParts, Seat};
use crate::drive::{Drive, Drives, Load};
use crate::error::Result;
use crate::mechanism::{
    AssemblyMode, DrivingLink, GROUND, Group, GroupId, Joint, JointId, JointSide, Link, LinkId, Mechanism, Ordinal,
    PerLink, Pose, Structure, Transmission, TransmissionDesign,
};
use crate::trajectory::{Channel, Stage};

/// Before a number is appended to a point's name, the name is cut to this number of characters.
const SHORT: usize = 80;

/// The part of a case on which its requested channels depend.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The needed part of the case, as a case; the whole case if everything is needed.
    pub case: Case,
    /// Parts that do not affect any requested channel.
    pub left_out: LeftOut,
}

/// Names of the parts that the reduced case leaves out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Links.
    pub links: Vec<String>,
    /// Joints.
    pub joints: Vec<String>,
    /// Assur groups, each named by its links.
    pub groups: Vec<String>,
    /// Driven joints.
    pub drives: Vec<String>,
    /// Number of loads.
    pub loads: usize,
}

impl LeftOut {
    /// Whether nothing is left out.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == LeftOut::default()
    }
}

impl Case {
    /// Returns the part of the case on which the requested channels depend.
    /// The values of these channels agree with those of the whole case up to rounding error.
    /// For a free motion, and for a case that requests all channels of its stages, the whole case is returned.
    ///
    /// # Errors
    /// The errors of [`Case::new`], if the part is not a complete mechanism.
    pub fn scene(&self) -> Result<Scene> {
        let whole = || Scene { case: self.clone(), left_out: LeftOut::default() };
        let channels = match &self.only {
            Some(channels) if !self.is_free() => channels,
            Some(_) | None => return Ok(whole()),
        };
        let (mut needs, seats) = (Needs::none(self), self.seats());
        for channel in channels {
            needs.add(channel, seats.of(channel).expect("a channel of the case"));
        }
        needs.close();
        let left_out = needs.left_out();
        if left_out.is_empty() { Ok(whole()) } else { Ok(Scene { case: needs.case()?, left_out }) }
    }
}

/// Marks the parts of a case that the requested channels need.
struct Needs<'a> {
    case: &'a Case,
    /// For every link, the groups on which the motion of the link depends.
    /// The last group of the list is the group of the link itself.
    upstream: PerLink<Vec<GroupId>>,
    /// For every link: whether its motion is needed.
    moves: PerLink<bool>,
    /// For every link: whether the forces on the link are needed.
    carries: PerLink<bool>,
}

impl<'a> Needs<'a> {
    fn none(case: &'a Case) -> Self {
        let none = || case.mechanism.links().iter().map(|_| false).collect();
        let upstream = case.structure.upstream(&case.mechanism);
        let mut needs = Needs { case, upstream, moves: none(), carries: none() };
        // The crank's angle identifies the instant, so the crank's motion is always needed.
        (needs.moves[GROUND], needs.moves[case.crank().link]) = (true, true);
        needs
    }

    /// Adds the parts on which the channel depends directly.
    fn add(&mut self, channel: &Channel, seat: Seat) {
        match seat {
            Seat::Link(link) => self.moves[link] = true,
            Seat::Point(_) => {
                let carrier = self.carrier(&channel.of);
                self.moves[carrier] = true;
            }
            Seat::Joint(joint) => {
                let link = self.owner(joint);
                self.moves[link] = true;
                self.carries[link] |= channel.kind.stage >= Stage::Reactions;
            }
            Seat::Transmission(transmission) => {
                let links = self.case.mechanism.transmissions()[transmission].links();
                links.into_iter().for_each(|link| self.carries[link] = true);
            }
            Seat::Frame => self.carries.fill(true),
            Seat::Drive(drive) => self.carries[self.case.drives[drive].link] = true,
        }
    }

    /// The link with this point. If several links have the point, the link that depends on the fewest groups.
    fn carrier(&self, point: &str) -> LinkId {
        let links = self.case.mechanism.links().entries().skip(1);
        let own = links.filter(|(_, link)| link.points.iter().any(|own| own.name == point)).map(|(index, _)| index);
        own.min_by_key(|&link| self.upstream[link].len()).expect("a channel of the case")
    }

    /// Of the joint's two links, the link that is solved later. The joint belongs to the group of this link.
    /// A driven joint belongs to the driving link.
    fn owner(&self, joint: JointId) -> LinkId {
        let joint = &self.case.mechanism.joints()[joint];
        let place = |link: LinkId| match self.case.structure.leading().find(|(_, driver)| driver.link == link) {
            Some((driver, _)) => (1, driver),
            None => self.upstream[link].last().map_or((0, 0), |&group| (2, group.index())),
        };
        let (first, second) = (joint.first.link, joint.second.link);
        if place(first) > place(second) { first } else { second }
    }

    /// Adds everything that the needed parts depend on.
    fn close(&mut self) {
        let (case, structure) = (self.case, &self.case.structure);
        let ends = |joint: JointId| {
            let joint = &case.mechanism.joints()[joint];
            [joint.first.link, joint.second.link]
        };
        let outer = |group: &Group| {
            let trains = group.trains.iter().flat_map(|&id| case.mechanism.transmissions()[id].links());
            group.outer.iter().flat_map(|&joint| ends(joint)).chain(trains).collect::<Vec<LinkId>>()
        };
        // If the forces on a link are needed, the forces on all links whose motion depends on this link, directly or
        // through further links, are needed too.
        let carries = &mut self.carries;
        for (_, &DrivingLink { link, joint, .. }) in structure.leading() {
            carries[link] |= ends(joint).into_iter().any(|base| base != GROUND && carries[base]);
        }
        for group in &structure.groups {
            let own = |link: &LinkId| group.links.contains(link);
            let hangs = outer(group).into_iter().filter(|link| *link != GROUND && !own(link)).any(|link| carries[link]);
            if hangs || group.links.iter().any(|&link| carries[link]) {
                group.links.iter().for_each(|&link| carries[link] = true);
            }
        }
        for link in self.moves.ids().skip(1) {
            self.moves[link] |= self.carries[link];
        }
        // Loads on the links marked in `carries` may depend on the motion of other links.
        // The motion of these other links is then needed too.
        for load in &case.loads {
            let links = load.links();
            if links.iter().any(|&link| link != GROUND && self.carries[link]) {
                links.iter().for_each(|&link| self.moves[link] = true);
            }
        }
        // A group's motion depends on the links at its outer joints, so the motion of these links is needed too.
        for group in structure.groups.iter().rev() {
            if group.links.iter().any(|&link| self.moves[link]) {
                group.links.iter().for_each(|&link| self.moves[link] = true);
                outer(group).into_iter().for_each(|link| self.moves[link] = true);
                let phases = group.trains.iter().map(|&id| case.mechanism.transmissions()[id].design.joint);
                phases.flat_map(ends).for_each(|link| self.moves[link] = true);
            }
        }
        for (_, &DrivingLink { link, joint, .. }) in structure.leading().rev() {
            if self.moves[link] {
                ends(joint).into_iter().for_each(|base| self.moves[base] = true);
            }
        }
    }

    fn has_joint(&self, joint: &Joint) -> bool {
        self.moves[joint.first.link] && self.moves[joint.second.link]
    }

    /// Whether the reduced case keeps a load.
    /// A load is kept if the reduced case needs any forces and contains all links of the load.
    fn has_load(&self, load: &Load) -> bool {
        // The friction of a joint depends on the joint's reaction.
        let is_known = !load.is_friction() || load.joint().is_none_or(|joint| self.carries[self.owner(joint)]);
        self.carries.contains(&true) && load.links().iter().all(|&link| self.moves[link]) && is_known
    }

    fn left_out(&self) -> LeftOut {
        let (case, mechanism) = (self.case, &self.case.mechanism);
        let links = mechanism.links().iter().zip(&self.moves).filter(|(_, moves)| !**moves);
        let joints = mechanism.joints().iter().filter(|joint| !self.has_joint(joint));
        let groups = case.structure.groups.iter().filter(|group| !self.moves[group.links[0]]);
        let drives = case.drives.iter().filter(|drive| !self.moves[drive.link]);
        LeftOut {
            links: links.map(|(link, _)| link.name.clone()).collect(),
            joints: joints.map(|joint| joint.name.clone()).collect(),
            groups: groups.map(|group| group.names(mechanism)).collect(),
            drives: drives.map(|drive| mechanism.joints()[drive.joint].name.clone()).collect(),
            loads: case.loads.iter().filter(|load| !self.has_load(load)).count(),
        }
    }

    /// Returns the needed part as a case.
    fn case(&self) -> Result<Case> {
        let (case, whole) = (self.case, &self.case.mechanism);
        let link_number = numbers(self.moves.iter().copied());
        let joint_number = numbers(whole.joints().iter().map(|joint| self.has_joint(joint)));
        let own_joint = |joint: &Joint| {
            let on = |side: JointSide| JointSide { link: link_number[side.link], ..side };
            Joint { first: on(joint.first), second: on(joint.second), ..joint.clone() }
        };
        let joints = whole.joints().iter().filter(|joint| self.has_joint(joint)).map(own_joint).collect();
        let stays = |own: &&Transmission| own.links().into_iter().all(|link| self.moves[link]);
        let own_transmission = |own: &Transmission| {
            let design = own.design.renumbered(|link| link_number[link], |joint| joint_number[joint]);
            // The losses of a transmission depend on the transmission's force.
            let is_known = own.links().into_iter().any(|link| link != GROUND && self.carries[link]);
            if is_known { design } else { TransmissionDesign { efficiency: [1.0; 2], ..design } }
        };
        let transmissions = whole.transmissions().iter().filter(stays).map(own_transmission).collect();
        let mechanism = Mechanism::new(self.links(), joints)?.with_transmissions(transmissions)?;
        let own_drive =
            |drive: &Drive| Drive { link: link_number[drive.link], joint: joint_number[drive.joint], ..drive.clone() };
        let further = case.drives.further().iter().filter(|drive| self.moves[drive.link]).map(own_drive).collect();
        let drives = Drives::new(own_drive(case.crank()), further);
        let structure = Structure::of(&mechanism, &drives.joints())?;
        let modes = structure.groups.iter().map(|group| self.mode(group, &link_number)).collect();
        let poses = case.start.0.iter().zip(&self.moves).filter(|(_, moves)| **moves).map(|(pose, _)| *pose);
        let loads = case.loads.iter().filter(|load| self.has_load(load));
        let scene = Case::new(CaseParts {
            mechanism,
            structure,
            drives,
            loads: loads.map(|load| load.renumbered(|link| link_number[link], |joint| joint_number[joint])).collect(),
            start: Pose(poses.collect()),
            modes,
            gravity: case.gravity,
            grid: case.grid.clone(),
            wanted: case.wanted,
            only: None,
        })?;
        Ok(scene.wanting_only(case.only.as_deref().unwrap_or_default()))
    }

    /// The links of the reduced case.
    /// If a joint is left out, its two links still have a point with the joint's name.
    /// [`Mechanism::new`] rejects two points with the same name if no joint connects them.
    /// A number is therefore added to the name of the point on the link that depends on more groups.
    fn links(&self) -> Vec<Link> {
        let whole = &self.case.mechanism;
        let stays = |index: &LinkId| self.moves[*index];
        let mut links: Vec<(LinkId, Link)> =
            whole.links().ids().filter(stays).map(|index| (index, whole.links()[index].clone())).collect();
        let carriers = |name: &str| -> Vec<LinkId> {
            let all = whole.links().ids().filter(stays);
            all.filter(|&link| whole.links()[link].points.iter().any(|point| point.name == name)).collect()
        };
        let pinned = |name: &str, [a, b]: [LinkId; 2]| {
            whole.joints().iter().any(|joint| {
                let at = |side: JointSide| {
                    whole.links()[side.link].points.iter().any(|own| own.name == name && own.local == side.local)
                };
                joint.is_pin() && joint.on(a).is_some() && joint.on(b).is_some() && at(joint.first) && at(joint.second)
            })
        };
        for (index, link) in &mut links {
            for point in &mut link.points {
                let all = carriers(&point.name);
                if all.len() < 2 {
                    continue;
                }
                let first = *all.iter().min_by_key(|&&own| (self.upstream[own].len(), own)).expect("there are two");
                // Finds all links that are connected with the first link by revolute joints of this name.
                let mut reached = vec![first];
                let mut next = 0;
                while let Some(&own) = reached.get(next) {
                    next += 1;
                    let new =
                        all.iter().filter(|&&other| !reached.contains(&other) && pinned(&point.name, [own, other]));
                    let new: Vec<LinkId> = new.copied().collect();
                    reached.extend(new);
                }
                if !reached.contains(index) {
                    let short: String = point.name.chars().take(SHORT).collect();
                    point.name = format!("{short}'{index}");
                }
            }
        }
        links.into_iter().map(|(_, link)| link).collect()
    }

    /// Assembly mode of a group of the reduced case. `link_number` gives the new numbers of the links.
    fn mode(&self, group: &Group, link_number: &[LinkId]) -> AssemblyMode {
        let links = |of: &Group| -> Vec<LinkId> { of.links.iter().map(|&link| link_number[link]).collect() };
        let is_same = |own: &Group| self.moves[own.links[0]] && links(own) == group.links;
        let place = self.case.structure.groups.iter().position(is_same);
        self.case.modes[place.expect("groups that stay are groups of the part")]
    }
}

/// New number of every item, counted without the removed items. The entry of a removed item is only a placeholder.
fn numbers<I: Ordinal>(stays: impl Iterator<Item = bool>) -> Vec<I> {
    let mut next = 0;
    stays
        .map(|stays| {
            let own = I::at(next);
            next += usize::from(stays);
            own
        })
        .collect()
}
