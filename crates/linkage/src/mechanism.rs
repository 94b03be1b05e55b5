//! The mechanism: links, joints, structure, and start pose. This module does not depend on time, files or solvers.

pub mod assembly;
pub mod cam;
pub mod contact;
mod ids;
mod name;
mod outline;
mod parts;
mod placing;
pub mod pose;
pub mod spanning_tree;
pub mod structure;
pub mod transmission;

use crate::sentences;
pub use assembly::{AssemblyMode, StartGroup, first_pose};
pub use cam::{Cam, CamContact, CamCurve, CamFigures, CamLaw, CamSegment};
pub use contact::{Contact, LineOfAction};
pub use ids::{GroupId, JointId, LinkId, Ordinal, Per, PerGroup, PerJoint, PerLink, PerTransmission, TransmissionId};
pub use name::{LONGEST_NAME, is_sound_name, is_unseen};
pub use outline::ring;
pub use parts::{GROUND, Guise, Joint, JointKind, JointSide, Link, Point};
pub use placing::Handle;
pub use pose::{LinkPose, Pose};
pub use spanning_tree::{SpanningTree, TreeBranch};
pub use structure::{DrivenJoint, DrivingLink, Group, GroupKind, Structure, roman};
pub use transmission::{Coordinate, Losses, Transmission, TransmissionDesign, TransmissionKind};

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::error::{Error, ErrorKind, Result};
use crate::math::KeepNan;

/// A planar mechanism: links and the joints between them. The first link is the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    links: PerLink<Link>,
    joints: PerJoint<Joint>,
    transmissions: PerTransmission<Transmission>,
    /// Joints on every link, in order.
    on: PerLink<Vec<JointId>>,
    /// For every joint: index of the joint's first equation in the list of all joints' equations.
    /// The last entry is the total number of equations.
    rows: Vec<usize>,
    /// Size of the mechanism (m), used in the computation of every pose.
    /// The size is stored, because its computation compares the distances between all pairs of points of a link.
    /// On a link with many points, the number of pairs is large.
    size: f64,
}

/// Size of a mechanism (m): the largest extent of a link. The size is 1 m if no link has an extent.
fn size_of(links: &[Link]) -> f64 {
    let size = links.iter().map(Link::extent).fold(0.0, f64::larger);
    if size > 0.0 { size } else { 1.0 }
}

impl Mechanism {
    /// A mechanism with these links (the first is the ground) and joints.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for each of the faults below.
    /// The error names the key of the link or joint at fault, except if a name is not allowed.
    /// - names that are not allowed;
    /// - duplicate names;
    /// - an axis that is not a unit vector;
    /// - a joint that connects a link with itself;
    /// - negative or non-finite masses and inertias;
    /// - inertia without mass;
    /// - two links with points of the same name that no joint holds together.
    pub fn new(links: Vec<Link>, joints: Vec<Joint>) -> Result<Self> {
        let mechanism = Mechanism::unchecked(links, joints);
        mechanism.check_names()?;
        for link in &mechanism.links {
            check_masses(link).map_err(|error| error.key(format!("links.{}", link.name)))?;
        }
        mechanism.check_shared_points()?;
        Ok(mechanism)
    }

    /// A mechanism from unchecked links and joints.
    /// This function serves only to look up names in a faulty file, or to draw the existing parts of a faulty file.
    #[must_use]
    pub fn unchecked(links: Vec<Link>, joints: Vec<Joint>) -> Self {
        let (links, joints) = (PerLink::from(links), PerJoint::from(joints));
        let size = size_of(&links);
        let mut on = PerLink::from(vec![Vec::new(); links.len()]);
        for (index, joint) in joints.entries() {
            for side in [joint.first, joint.second] {
                // A joint that connects a link with itself is also added here.
                // `check_names` rejects such a joint later.
                on[side.link].push(index);
            }
        }
        let mut rows = vec![0];
        rows.extend(joints.iter().scan(0, |next, joint| {
            *next += joint.kind.equations();
            Some(*next)
        }));
        Mechanism { links, joints, transmissions: PerTransmission::default(), on, rows, size }
    }

    /// Changes the numerical data of links, and the positions of joints on links, without any check.
    pub(crate) fn renumber(&mut self, change: impl FnOnce(&mut [Link], &mut [Joint])) {
        change(&mut self.links, &mut self.joints);
        self.size = size_of(&self.links);
    }

    /// This mechanism with its transmissions replaced by the given transmissions.
    ///
    /// # Errors
    /// The errors of [`Transmission::of`]; [`ErrorKind::Input`] for two transmissions of one name.
    pub fn with_transmissions(mut self, designs: Vec<TransmissionDesign>) -> Result<Self> {
        let mut taken = BTreeSet::new();
        let mut all = Vec::with_capacity(designs.len());
        for design in designs {
            if !taken.insert(design.name.clone()) {
                return Err(Error::new(ErrorKind::Input, sentences::two_transmissions_are_called(&design.name))
                    .key(format!("transmissions.{}", design.name))
                    .help(sentences::GIVE_EVERY_TRANSMISSION_ITS_OWN_NAME));
            }
            all.push(Transmission::of(&self.links, &self.joints, self.size, design)?);
        }
        self.transmissions = all.into();
        Ok(self)
    }

    /// All links; index 0 is the ground.
    #[must_use]
    pub fn links(&self) -> &PerLink<Link> {
        &self.links
    }

    /// All joints.
    #[must_use]
    pub fn joints(&self) -> &PerJoint<Joint> {
        &self.joints
    }

    /// All transmissions.
    #[must_use]
    pub fn transmissions(&self) -> &PerTransmission<Transmission> {
        &self.transmissions
    }

    /// The given data of all transmissions.
    #[must_use]
    pub fn transmission_designs(&self) -> Vec<TransmissionDesign> {
        self.transmissions.iter().map(|own| own.design.clone()).collect()
    }

    /// Index of the equation of a transmission in the list of all equations.
    /// The equations of the transmissions come after the equations of the joints.
    #[inline]
    #[must_use]
    pub fn row_of_transmission(&self, transmission: TransmissionId) -> usize {
        self.equations() + transmission.index()
    }

    /// Index of the equation of the drive with this number.
    /// The equations of the drives come after the equations of the joints and transmissions.
    #[inline]
    #[must_use]
    pub fn row_of_drive(&self, drive: usize) -> usize {
        self.equations() + self.transmissions.len() + drive
    }

    /// Indices of a joint's equations in the list of all joints' equations. The list is in the order of the joints.
    #[inline]
    #[must_use]
    pub fn rows(&self, joint: JointId) -> Range<usize> {
        self.rows[joint]..self.rows[joint.index() + 1]
    }

    /// Total number of equations of all joints.
    /// A list of equations begins with the equations of the joints.
    /// The equations of the transmissions follow, then the equations of the drives.
    #[inline]
    #[must_use]
    pub fn equations(&self) -> usize {
        self.rows[self.joints.len()]
    }

    /// Joints on a link, as indices in ascending order.
    #[must_use]
    pub fn joints_on(&self, link: LinkId) -> &[JointId] {
        &self.on[link]
    }

    /// Index of the link called `name`.
    #[must_use]
    pub fn link_named(&self, name: &str) -> Option<LinkId> {
        self.links.find(|link| link.name == name)
    }

    /// Index of the joint called `name`.
    #[must_use]
    pub fn joint_named(&self, name: &str) -> Option<JointId> {
        self.joints.find(|joint| joint.name == name)
    }

    /// The first joint between two links.
    #[must_use]
    pub fn joint_between(&self, one: LinkId, other: LinkId) -> Option<JointId> {
        self.joints.find(|joint| joint.on(one).is_some() && joint.on(other).is_some())
    }

    /// Guide and block of a sliding joint; `None` for a joint that does not slide.
    /// If a link is the ground, the ground is the guide.
    /// If the joint is drawn as a cylinder, its first link is the guide.
    /// In all other cases the larger of the two links is the guide.
    /// If the sizes are equal, the joint's first link is the guide.
    #[must_use]
    pub fn guide_and_block(&self, joint: &Joint) -> Option<[JointSide; 2]> {
        let size = |side: JointSide| if side.link == GROUND { f64::INFINITY } else { self.links[side.link].size() };
        let (first, second) = (joint.first, joint.second);
        // A cylinder is the first link of its joint.
        let is_cylinder = joint.drawn == Some(Guise::Cylinder) && joint.on(GROUND).is_none();
        joint
            .slides()
            .then(|| if is_cylinder || size(first) >= size(second) { [first, second] } else { [second, first] })
    }

    /// Points of moving links, each name once. Names of points of the ground are left out.
    /// Each entry has the first link that carries the point, and the position of the point on that link.
    pub fn moving_points(&self) -> impl Iterator<Item = (&str, JointSide)> {
        let mut seen: BTreeSet<&str> = self.links[GROUND].points.iter().map(|point| point.name.as_str()).collect();
        let mut points = Vec::new();
        for (link, body) in self.links.entries().skip(1) {
            for point in &body.points {
                if seen.insert(&point.name) {
                    points.push((point.name.as_str(), JointSide { link, local: point.local }));
                }
            }
        }
        points.into_iter()
    }

    /// Largest extent of a link (m); for the ground, the extent of its points. Closure gaps are compared with this
    /// size.
    /// The size is always positive. If no link has an extent, the size is 1 m.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Whether a link can turn. A link cannot turn if joints that keep the angle connect it with the ground.
    #[must_use]
    pub fn can_turn(&self, link: LinkId) -> bool {
        let mut still = vec![GROUND];
        let mut next = 0;
        while let Some(&own) = still.get(next) {
            next += 1;
            for joint in self.joints.iter().filter(|joint| joint.keeps_angle() && joint.on(own).is_some()) {
                let other = joint.other(own).link;
                if !still.contains(&other) {
                    still.push(other);
                }
            }
        }
        !still.contains(&link)
    }

    fn check_names(&self) -> Result<()> {
        let points = self.links.iter().flat_map(|link| &link.points).map(|point| &point.name);
        let names = self.links.iter().map(|link| &link.name).chain(self.joints.iter().map(|joint| &joint.name));
        if let Some(name) = names.chain(points).find(|name| !is_sound_name(name)) {
            let message = sentences::cannot_be_a_name(&(name.chars().take(LONGEST_NAME).collect::<String>()));
            return Err(Error::new(ErrorKind::Input, message).help(sentences::NAMES_CONSIST_OF_LETTERS_DIGITS));
        }
        let mut taken = BTreeSet::new();
        for link in &self.links {
            if !taken.insert(&link.name) {
                return Err(Error::new(ErrorKind::Input, sentences::two_links_are_called(&link.name))
                    .key(format!("links.{}", link.name))
                    .help(sentences::GIVE_EVERY_LINK_ITS_OWN_NAME));
            }
        }
        let mut taken = BTreeSet::new();
        for joint in &self.joints {
            let wrong = |message: String, help: &str| {
                Err(Error::new(ErrorKind::Input, message).key(format!("joints.{}", joint.name)).help(help))
            };
            if !taken.insert(&joint.name) {
                return wrong(sentences::two_joints_are_called(&joint.name), sentences::GIVE_EVERY_JOINT_ITS_OWN);
            }
            if let Some(axes) = joint.kind.axes()
                && !axes.iter().all(|axis| (axis.norm() - 1.0).abs() <= 1e-12)
            {
                return wrong(sentences::ITS_AXIS_IS_NO_UNIT_VECTOR.into(), sentences::GIVE_THE_AXIS_BY_ITS_ANGLE);
            }
            if joint.first.link == joint.second.link {
                let message = sentences::it_joins_with_itself(&self.links[joint.first.link].name);
                return wrong(message, sentences::NAME_TWO_DIFFERENT_LINKS);
            }
        }
        Ok(())
    }

    fn check_shared_points(&self) -> Result<()> {
        let mut carriers: BTreeMap<&str, Vec<LinkId>> = BTreeMap::new();
        for (link, body) in self.links.entries() {
            for point in &body.points {
                let key = || format!("links.{}.points.{}", body.name, point.name);
                let others = carriers.entry(&point.name).or_default();
                if others.contains(&link) {
                    let message = sentences::THE_LINK_HAS_TWO_POINTS_OF_THIS_NAME;
                    return Err(Error::new(ErrorKind::Input, message).key(key()));
                }
                if let Some(&other) = others.first()
                    && !self.held_together(&point.name, link, other)
                {
                    let other = &self.links[other].name;
                    let message = sentences::links_and_both_have_a_point(other, &body.name, &point.name);
                    let error = Error::new(ErrorKind::Input, message).key(key());
                    return Err(error.help(sentences::RENAME_ONE_OF_THE_POINTS));
                }
                others.push(link);
            }
        }
        Ok(())
    }

    /// Whether revolute joints at points called `name` connect link `a` with link `b`, directly or through other links.
    fn held_together(&self, name: &str, a: LinkId, b: LinkId) -> bool {
        let at = |side: JointSide| self.links[side.link].points.iter().any(|p| p.name == name && p.local == side.local);
        let mut reached = vec![a];
        let mut next = 0;
        while let Some(&link) = reached.get(next) {
            next += 1;
            for joint in self.joints.iter().filter(|joint| joint.is_pin() && joint.on(link).is_some()) {
                let other = joint.other(link).link;
                if !reached.contains(&other) && at(joint.first) && at(joint.second) {
                    // The search stops early, because a visit to all other links would be slow on a link with many
                    // joints.
                    if other == b {
                        return true;
                    }
                    reached.push(other);
                }
            }
        }
        reached.contains(&b)
    }
}

/// Checks mass and moment of inertia of a link.
///
/// # Errors
/// [`ErrorKind::Input`] for a negative or non-finite number, and for a moment of inertia without mass.
pub fn check_masses(link: &Link) -> Result<()> {
    let wrong = |message: String, help: &str| Err(Error::new(ErrorKind::Input, message).help(help));
    for (what, value) in [("mass", link.mass), (sentences::MOMENT_OF_INERTIA, link.inertia)] {
        if !(value >= 0.0 && value.is_finite()) {
            return wrong(sentences::the_is(&what, &value), sentences::GIVE_A_NUMBER_THAT_IS_ZERO);
        }
    }
    if link.mass == 0.0 && link.inertia > 0.0 {
        let message = sentences::the_link_has_a_moment_of_inertia(&link.inertia);
        return wrong(message, sentences::GIVE_THE_MASS_TOO_OR_LEAVE);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::fixtures::*;

    #[test]
    fn a_point_name_on_two_links_needs_a_joint() {
        let links = vec![link("ground", &[("O", 0.0, 0.0)]), link("a", &[("O", 0.0, 0.0), ("P", 1.0, 0.0)]), {
            link("b", &[("P", 0.0, 0.0)])
        }];
        let error = mechanism(links, &[("O", "O", "ground", "a")]).unwrap_err();
        assert!(error.to_string().contains("no joint connects them"), "{error}");
    }

    #[test]
    fn three_links_on_one_pin_are_held_together_by_two_joints() {
        let links = vec![
            link("ground", &[("O", 0.0, 0.0)]),
            link("a", &[("O", 0.0, 0.0), ("P", 1.0, 0.0)]),
            link("b", &[("P", 0.0, 0.0)]),
            link("c", &[("P", 0.0, 0.0)]),
        ];
        let pins = [("O", "O", "ground", "a"), ("P1", "P", "a", "b"), ("P2", "P", "b", "c")];
        let mechanism = mechanism(links, &pins).unwrap();
        assert_eq!(mechanism.moving_points().map(|(name, _)| name).collect::<Vec<_>>(), ["P"]);
    }

    #[test]
    fn equations_are_ordered_by_joint() {
        let mechanism = four_bar();
        let mut next = 0;
        for (index, joint) in mechanism.joints().entries() {
            assert_eq!(mechanism.rows(index), next..next + joint.kind.equations(), "{}", joint.name);
            next += joint.kind.equations();
        }
        assert_eq!((mechanism.equations(), next), (8, 8));
    }

    #[test]
    fn size_is_the_longest_link() {
        assert_eq!(four_bar().size(), 4.0);
    }

    /// Size of a mechanism whose only moving link is hinged at its only point.
    fn of_single_point(mass: f64, centre: f64, inertia: f64) -> f64 {
        let mut own = link("a", &[("O", 0.0, 0.0)]);
        (own.mass, own.mass_centre.x, own.inertia) = (mass, centre, inertia);
        let links = vec![link("ground", &[("O", 0.0, 0.0)]), own];
        mechanism(links, &[("O", "O", "ground", "a")]).unwrap().size()
    }

    #[test]
    fn size_is_positive_however_few_points_a_link_has() {
        assert_eq!(of_single_point(2.0, 0.5, 1.0), 0.5);
        assert_eq!(of_single_point(2.0, 0.0, 8.0), 2.0);
        assert_eq!(of_single_point(2.0, 0.0, 0.0), 1.0);
        assert_eq!(of_single_point(0.0, 0.0, 0.0), 1.0);
    }
}
