//! An Assur group, its kind, and its class from its closed contours.

use crate::error::KeyPath;
use crate::mechanism::{AssemblyMode, JointId, LinkId, Mechanism, TransmissionId};
use crate::sentences;

/// Kind of Assur group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupKind {
    /// Dyad with three revolute pairs. Class II and order 2, like all dyads.
    Rrr,
    /// Dyad with an outer revolute pair, the inner revolute pair and an outer prismatic pair: connecting rod and
    /// slider.
    Rrp,
    /// Dyad with two outer revolute pairs and an inner prismatic pair: swinging guide and block.
    Rpr,
    /// Dyad with an outer revolute pair. The inner pair and the second outer pair are prismatic.
    Rpp,
    /// Dyad with two outer prismatic pairs and an inner revolute pair.
    Prp,
    /// Any group with more than two rigid bodies, and any group of two bodies with a transmission.
    Higher,
    /// A driving link (class I). The pose of the link follows from a joint with given coordinate between the link and a
    /// link of an earlier group, or from a transmission that couples the link to earlier links.
    Driven,
}

impl GroupKind {
    /// The two assembly modes of an RRR, RRP or RPR dyad; `None` for other kinds.
    /// The first mode is the mode in which the sine of the transmission angle is positive.
    #[must_use]
    pub const fn modes(self) -> Option<&'static [AssemblyMode; 2]> {
        match self {
            GroupKind::Rrr => Some(&[AssemblyMode::Left, AssemblyMode::Right]),
            GroupKind::Rrp | GroupKind::Rpr => Some(&[AssemblyMode::Ahead, AssemblyMode::Behind]),
            GroupKind::Rpp | GroupKind::Prp | GroupKind::Higher | GroupKind::Driven => None,
        }
    }

    /// Whether a group of this kind has only one configuration, whatever its dimensions.
    #[must_use]
    pub fn has_one_configuration(self) -> bool {
        match self {
            GroupKind::Rpp | GroupKind::Prp | GroupKind::Driven => true,
            GroupKind::Rrr | GroupKind::Rrp | GroupKind::Rpr | GroupKind::Higher => false,
        }
    }

    /// Letters of a dyad's pairs, in the order outer, inner, outer; `None` for higher groups and driven links.
    #[must_use]
    pub fn letters(self) -> Option<&'static str> {
        match self {
            GroupKind::Rrr => Some("RRR"),
            GroupKind::Rrp => Some("RRP"),
            GroupKind::Rpr => Some("RPR"),
            GroupKind::Rpp => Some("RPP"),
            GroupKind::Prp => Some("PRP"),
            GroupKind::Higher | GroupKind::Driven => None,
        }
    }
}

/// A class in Roman numerals; a class above VIII in digits.
#[must_use]
pub fn roman(class: usize) -> String {
    const ROMAN: [&str; 9] = ["", "I", "II", "III", "IV", "V", "VI", "VII", "VIII"];
    ROMAN.get(class).map_or_else(|| class.to_string(), ToString::to_string)
}

/// Assur group: a set of links that has no mobility if its outer joints are fixed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The group's links, in the mechanism's order.
    pub links: Vec<LinkId>,
    /// Joints between two links of the group.
    pub inner: Vec<JointId>,
    /// Joints between a link of the group and a link whose pose is known before the group is solved.
    pub outer: Vec<JointId>,
    /// The joints of `inner` and `outer` whose coordinate is given.
    /// Links connected by a joint with given coordinate count as one body. The shape of this body changes with time,
    /// but is known at every instant. Class and kind of the group are found from its bodies.
    pub given: Vec<JointId>,
    /// The transmissions that the group contains. Each transmission couples a coordinate of the group to coordinates of
    /// the same group or of earlier links.
    pub trains: Vec<TransmissionId>,
    /// Class: 1 for a driven link, 2 for dyads. For other groups, the number of sides of the closed contour with the
    /// most sides (Artobolevsky).
    pub class: usize,
    /// Kind of the group.
    pub kind: GroupKind,
}

impl Group {
    /// Order: the number of outer joints.
    #[must_use]
    pub fn order(&self) -> usize {
        self.outer.len()
    }

    /// Whether the group has neither joints with given coordinates nor transmissions. Every body is then one link.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.given.is_empty() && self.trains.is_empty()
    }

    /// For every link of the group, the first link of its body: the lead of the body.
    #[must_use]
    pub fn leads(&self, mechanism: &Mechanism) -> Vec<LinkId> {
        let mut leads = self.links.clone();
        for joint in self.given.iter().map(|&joint| &mechanism.joints()[joint]) {
            let lead = |link: LinkId| self.links.iter().position(|&own| own == link).map(|at| leads[at]);
            if let (Some(a), Some(b)) = (lead(joint.first.link), lead(joint.second.link)) {
                leads.iter_mut().filter(|lead| **lead == a.max(b)).for_each(|lead| *lead = a.min(b));
            }
        }
        leads
    }

    /// The group's bodies by name, for messages: `boom, cylinder+rod`.
    #[must_use]
    pub fn bodies(&self, mechanism: &Mechanism) -> String {
        self.bodies_by(mechanism, &|link: LinkId| mechanism.links()[link].name.clone(), ", ")
    }

    /// The group's bodies, with `+` between the links of one body and `between` between bodies. `name` names a link.
    pub(super) fn bodies_by(&self, mechanism: &Mechanism, name: &dyn Fn(LinkId) -> String, between: &str) -> String {
        let leads = self.leads(mechanism);
        let named = |lead: &LinkId| {
            let members = self.links.iter().zip(&leads).filter(|(_, own)| *own == lead);
            members.map(|(&link, _)| name(link)).collect::<Vec<_>>().join("+")
        };
        let bodies = self.links.iter().zip(&leads).filter(|(link, lead)| link == lead);
        bodies.map(|(_, lead)| named(lead)).collect::<Vec<_>>().join(between)
    }

    /// The group's outer joint on `link`, for a link that has exactly one outer joint.
    #[must_use]
    pub fn outer_on(&self, mechanism: &Mechanism, link: LinkId) -> Option<JointId> {
        let mut found = self.outer.iter().copied().filter(|&joint| mechanism.joints()[joint].on(link).is_some());
        let first = found.next()?;
        found.next().is_none().then_some(first)
    }

    /// Letters of a dyad's pairs ("RRP"); for any other group the numbers of inner and outer pairs, in words.
    #[must_use]
    pub fn pairs(&self) -> String {
        self.kind
            .letters()
            .map_or_else(|| sentences::inner_and_outer_pairs(&self.inner.len(), &self.outer.len()), ToString::to_string)
    }

    /// The group's links by name, for messages: `coupler, rocker`.
    #[must_use]
    pub fn names(&self, mechanism: &Mechanism) -> String {
        let names: Vec<&str> = self.links.iter().map(|&link| mechanism.links()[link].name.as_str()).collect();
        names.join(", ")
    }

    /// The group's key in a scenario file: the entry of `start.groups` with the group's links.
    pub fn key(&self, mechanism: &Mechanism) -> KeyPath {
        let links = self.links.iter().map(|&link| mechanism.links()[link].name.clone());
        KeyPath::of_group("start.groups", links.collect())
    }
}

/// Number of sides of the closed contour with the most sides.
/// A link with three or more inner pairs is a contour with as many sides as inner pairs.
/// For each inner joint, the shortest loop of inner joints through it is a contour too.
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
