//! A mechanism assembled as far as possible.
//! Every group that can be placed is placed. The gaps at the joints of the remaining links are as small as possible.

mod nearest;

use super::picture::LinkPlacement;
use linkage::error::{Error, ErrorKind};
use linkage::math::{KeepNan, Vec2, cross, turned, unit};
use linkage::mechanism::assembly::{configurations, first_choices};
use linkage::mechanism::{
    AssemblyMode, DrivingLink, GROUND, Group, GroupId, GroupKind, JointId, LinkId, LinkPose, Mechanism, Pose,
    StartGroup, Structure,
};

/// A joint is open if its gap is larger than this fraction of the mechanism's size.
const OPEN: f64 = 1e-6;
/// Gaps smaller than this fraction of the largest gap are ignored.
/// Such small gaps arise only because the least-squares solution spreads the largest gap over the joints.
const SEEN: f64 = 1e-2;

/// A circle on which a link can place a pin. Only an arc of the circle is drawn.
#[derive(Clone, Copy, Debug)]
pub struct PinCircle {
    /// Centre (world, m).
    pub centre: Vec2,
    /// Radius (m).
    pub radius: f64,
    /// Direction of the middle of the arc: towards the other circle of the dyad, or +x if the dyad has one circle.
    pub toward: Vec2,
}

/// A mechanism at one instant, assembled completely or in part.
#[derive(Clone, Debug)]
pub struct Laid {
    /// Pose of every link, and how it was determined.
    pub places: Vec<LinkPlacement>,
    /// Joints that stay open: the joint, and the two world points (m) that should coincide.
    pub gaps: Vec<(JointId, [Vec2; 2])>,
    /// For dyads that cannot be closed: the circles on which the two links can place the inner pin.
    pub reaches: Vec<PinCircle>,
    /// Reasons why the mechanism cannot be assembled completely, group by group.
    pub faults: Vec<Error>,
    /// Assembly mode of each group that is placed.
    pub modes: Vec<GroupPlacement>,
    /// Preliminary poses, used for links whose pose is not known.
    /// In these poses, links on driven joints have the right pose relative to each other.
    shape: Option<Pose>,
}

/// The configuration of a placed group.
#[derive(Clone, Copy, Debug)]
pub struct GroupPlacement {
    /// Number of the group.
    pub group: GroupId,
    /// Assembly mode of the group.
    pub mode: AssemblyMode,
    /// Number of the group's configuration, counted from 1; 0 if unknown.
    pub number: usize,
}

impl Laid {
    /// A mechanism in a known pose.
    pub fn whole(pose: impl IntoIterator<Item = LinkPose>) -> Laid {
        let places = pose.into_iter().map(LinkPlacement::Here).collect();
        Laid { places, gaps: Vec::new(), reaches: Vec::new(), faults: Vec::new(), modes: Vec::new(), shape: None }
    }

    /// Whether the mechanism is assembled completely.
    pub fn is_whole(&self) -> bool {
        self.faults.is_empty() && self.places.iter().all(|place| matches!(place, LinkPlacement::Here(_)))
    }

    fn of_structure(mechanism: &Mechanism, structure: &Structure, angles: &[f64]) -> Laid {
        let laid = Laid::start(mechanism, &structure.drivers, angles);
        Laid { shape: Some(structure.driving_pose(mechanism, angles)), ..laid }
    }

    fn start(mechanism: &Mechanism, drivers: &[DrivingLink], angles: &[f64]) -> Laid {
        let mut laid = Laid::whole([]);
        laid.places = vec![LinkPlacement::Nowhere; mechanism.links().len()];
        laid.places[GROUND] = LinkPlacement::Here(LinkPose::GROUND);
        for (driver, &angle) in drivers.iter().zip(angles).filter(|(driver, _)| !driver.in_group) {
            let joint = &mechanism.joints()[driver.joint];
            if let Some(pose) = laid.places[joint.other(driver.link).link].pose() {
                let placed = joint.driven(driver.link, pose, driver.input, angle);
                laid.places[driver.link] = LinkPlacement::Here(placed);
            }
        }
        laid
    }

    /// The poses of all links.
    /// For a link whose pose is not known, the pose in `shape` is taken. If `shape` is `None`, the link is at the
    /// origin.
    fn pose(&self) -> Pose {
        let shape = |link: LinkId| self.shape.as_ref().map_or(LinkPose::GROUND, |shape| shape.0[link]);
        Pose(
            self.places
                .iter()
                .enumerate()
                .map(|(link, place)| place.pose().copied().unwrap_or_else(|| shape(LinkId(link))))
                .collect(),
        )
    }

    /// Poses of all links: the input from which the configurations of a group are computed.
    /// In a group with driven joints, these joints have the coordinates `angles`.
    fn pose_for(&self, mechanism: &Mechanism, structure: &Structure, group: &Group, angles: &[f64]) -> Pose {
        let mut pose = self.pose();
        if group.kind == GroupKind::Driven {
            structure.place_driven(mechanism, group, angles, &mut pose);
        }
        pose
    }

    fn has(&self, mechanism: &Mechanism, group: &Group) -> bool {
        group.outer.iter().all(|&joint| {
            let joint = &mechanism.joints()[joint];
            let bases = [joint.first.link, joint.second.link].into_iter().filter(|link| !group.links.contains(link));
            bases.into_iter().all(|link| matches!(self.places[link], LinkPlacement::Here(_)))
        })
    }
}

/// Assembles a mechanism with this structure.
/// The driven joints have the coordinates `angles` (rad or m), and `starts` selects the assembly mode of every group.
pub fn lay(mechanism: &Mechanism, structure: &Structure, angles: &[f64], starts: &[StartGroup]) -> Laid {
    let (structure, angles) = (structure.at_start(), &structure.given_at_start(mechanism, angles)[..]);
    let mut laid = Laid::of_structure(mechanism, structure, angles);
    let mut done: Vec<GroupId> = Vec::new();
    for (index, group) in structure.groups.entries() {
        if !laid.has(mechanism, group) {
            continue;
        }
        let mut tried = done.clone();
        tried.push(index);
        let part = structure.of_groups(tried.iter().copied());
        let wanted: Vec<StartGroup> = tried.iter().map(|&index| starts[index].clone()).collect();
        match first_choices(mechanism, &part, angles, &wanted) {
            Ok((pose, choices)) => {
                for &link in &group.links {
                    laid.places[link] = LinkPlacement::Here(pose.0[link]);
                }
                if let Some(choice) = choices.last() {
                    let number = wanted.last().and_then(|own| own.rank).unwrap_or(0);
                    laid.modes.push(GroupPlacement { group: index, mode: choice.mode, number });
                }
                done = tried;
            }
            Err(error) => {
                // If the group cannot be closed, its circles for the inner pin are added. If the group can be closed,
                // only the choice of its assembly mode has failed.
                if configurations(mechanism, group, &laid.pose()).is_err() {
                    laid.reaches.extend(reaches(mechanism, group, &laid));
                }
                laid.faults.push(error);
            }
        }
    }
    close(mechanism, laid)
}

/// Assembles a mechanism that has no structure, because it has too few or too many links or joints.
/// The function assembles the dyads that it finds.
pub fn lay_loose(mechanism: &Mechanism, drivers: &[DrivingLink], angles: &[f64], fault: Error) -> Laid {
    let mut laid = Laid::start(mechanism, drivers, angles);
    laid.faults.push(fault);
    while let Some(group) = dyad(mechanism, &laid) {
        let found = configurations(mechanism, &group, &laid.pose());
        let Some(one) = found.ok().and_then(|all| all.into_iter().next()) else { break };
        for (&link, pose) in group.links.iter().zip(one.links) {
            laid.places[link] = LinkPlacement::Loose(pose);
        }
    }
    close(mechanism, laid)
}

/// Finds a dyad whose two links have no pose yet, and whose outer joints connect them to links that have a pose.
fn dyad(mechanism: &Mechanism, laid: &Laid) -> Option<Group> {
    let is_placed = |link: LinkId| laid.places[link].pose().is_some();
    let joints = mechanism.joints();
    let outer = |link: LinkId| {
        let mut own = joints.entries().filter(|(_, joint)| joint.on(link).is_some());
        own.find(|(_, joint)| is_placed(joint.other(link).link)).map(|(index, _)| index)
    };
    joints.entries().find_map(|(inner, joint)| {
        let mut links = vec![joint.first.link, joint.second.link];
        links.sort_unstable();
        if links.iter().any(|&link| is_placed(link)) {
            return None;
        }
        let outer = [outer(links[0])?, outer(links[1])?];
        let slides = [joints[outer[0]].slides(), joint.slides(), joints[outer[1]].slides()];
        let kind = match slides {
            [false, false, false] => GroupKind::Rrr,
            [true, false, false] | [false, false, true] => GroupKind::Rrp,
            [false, true, false] => GroupKind::Rpr,
            [true, true, false] | [false, true, true] => GroupKind::Rpp,
            [true, false, true] => GroupKind::Prp,
            [true, true, true] => return None,
        };
        Some(Group {
            links,
            inner: vec![inner],
            outer: outer.to_vec(),
            given: Vec::new(),
            trains: Vec::new(),
            class: 2,
            kind,
        })
    })
}

/// Places all remaining links as near to their neighbours as possible, and lists the joints that stay open.
fn close(mechanism: &Mechanism, mut laid: Laid) -> Laid {
    let missing: Vec<LinkId> = mechanism.links().ids().filter(|&link| laid.places[link].pose().is_none()).collect();
    if !missing.is_empty() {
        for (link, pose) in nearest::nearest(mechanism, &laid.pose(), &missing) {
            laid.places[link] = LinkPlacement::Loose(pose);
        }
    }
    let mut gaps = Vec::new();
    for (index, joint) in mechanism.joints().entries() {
        let sides =
            [joint.first, joint.second].map(|side| laid.places[side.link].pose().map(|pose| (*pose, side.local)));
        let [Some(first), Some(second)] = sides else { continue };
        let [from, to] = [first, second].map(|(pose, local)| pose.point(local));
        let gap = match joint.kind.axes() {
            None => [from, to],
            Some(axes) => {
                let axis = linkage::math::rotated(unit(first.0.angle), axes[0]);
                [to - turned(axis) * cross(axis, to - from), to]
            }
        };
        gaps.push((index, gap));
    }
    let size = |gap: &[Vec2; 2]| (gap[1] - gap[0]).norm();
    let largest = gaps.iter().map(|(_, gap)| size(gap)).fold(0.0, f64::larger);
    gaps.retain(|(_, gap)| size(gap) > OPEN * mechanism.size() && size(gap) > SEEN * largest);
    laid.gaps = gaps;
    laid
}

/// The circles on which the two links of a dyad can hold the inner pin: one circle for each link whose outer joint is
/// a pin.
fn reaches(mechanism: &Mechanism, group: &Group, laid: &Laid) -> Vec<PinCircle> {
    let (GroupKind::Rrr | GroupKind::Rrp, Some(&inner)) = (group.kind, group.inner.first()) else { return Vec::new() };
    let of_link = |(&link, &outer): (&LinkId, &JointId)| {
        let joint = &mechanism.joints()[outer];
        let (own, base) = (joint.on(link)?, joint.other(link));
        let pin = mechanism.joints()[inner].on(link)?;
        let centre = laid.places[base.link].pose()?.point(base.local);
        joint.is_pin().then_some((centre, (pin - own).norm()))
    };
    // Driven joints can make one body of several links. The distance between the pins of such a body is not the length
    // of a link, so there are no circles.
    if !group.is_rigid() {
        return Vec::new();
    }
    let circles: Vec<(Vec2, f64)> = group.links.iter().zip(&group.outer).filter_map(of_link).collect();
    let other = |centre: Vec2| circles.iter().map(|own| own.0 - centre).find(|apart| apart.norm() > 0.0);
    let circle =
        |&(centre, radius): &(Vec2, f64)| PinCircle { centre, radius, toward: other(centre).unwrap_or(Vec2::x()) };
    circles.iter().map(circle).collect()
}

/// Returns at most `most` configurations of a mechanism. The driven joints have the coordinates `angles` (rad or m).
/// Each configuration is assembled as far as possible.
/// If the configurations of a group cannot all be computed, the group is placed in the assembly mode that `starts`
/// selects.
pub fn all_modes(
    mechanism: &Mechanism,
    structure: &Structure,
    angles: &[f64],
    starts: &[StartGroup],
    most: usize,
) -> Vec<Laid> {
    let mut found: Vec<Laid> = Vec::new();
    let mut open = vec![(Laid::of_structure(mechanism, structure, angles), 0)];
    while let Some((mut laid, index)) = open.pop().filter(|_| found.len() < most) {
        let Some(group) = structure.groups.get(GroupId(index)) else {
            found.push(close(mechanism, laid));
            continue;
        };
        if !laid.has(mechanism, group) {
            open.push((laid, index + 1));
            continue;
        }
        match configurations(mechanism, group, &laid.pose_for(mechanism, structure, group, angles)) {
            Ok(all) => {
                for (number, one) in all.into_iter().enumerate().rev() {
                    let mut next = laid.clone();
                    for (&link, pose) in group.links.iter().zip(&one.links) {
                        next.places[link] = LinkPlacement::Here(*pose);
                    }
                    next.modes.push(GroupPlacement { group: GroupId(index), mode: one.mode, number: number + 1 });
                    open.push((next, index + 1));
                }
            }
            Err(error) => {
                let placed = (error.kind() == ErrorKind::Unsupported)
                    .then(|| lay(mechanism, structure, angles, starts))
                    .filter(|own| group.links.iter().all(|&link| matches!(own.places[link], LinkPlacement::Here(_))));
                match placed {
                    Some(own) => {
                        for &link in &group.links {
                            laid.places[link] = own.places[link];
                        }
                        laid.modes.push(GroupPlacement {
                            group: GroupId(index),
                            mode: AssemblyMode::Followed,
                            number: 0,
                        });
                    }
                    None => {
                        laid.reaches.extend(reaches(mechanism, group, &laid));
                        laid.faults.push(error.key(group.key(mechanism)).of_group(group.names(mechanism)));
                    }
                }
                open.push((laid, index + 1));
            }
        }
    }
    found
}
