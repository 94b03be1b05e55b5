//! Bodies, pins and drives.
//! Links of the file form one body if they are fastened to each other or share two connectors.
//! A link with two anchors belongs to the ground.

use super::elements::{Connector, DECIMALS, DrawnLink, Elements};
use crate::import::parts::{DrivePart, FRAME, JointPart, LinkPart, PartPair, Parts};
use crate::import::xml::XmlFile;
use crate::sentences;
use linkage::error::Result;

/// Speed of an input for which the file states no speed (turns per minute), as in Linkage.
const USUAL_SPEED: f64 = 15.0;

/// A mechanism while it is built.
pub(super) struct Builder<'a> {
    pub(super) file: &'a XmlFile<'a>,
    pub(super) elements: Elements<'a>,
    pub(super) parts: Parts,
    /// Names of the connectors in the scenario.
    pub(super) points: Vec<String>,
    /// For each link of the file, its link in the scenario; `None` for a link that is only a point.
    pub(super) bodies: Vec<Option<usize>>,
    /// For each connector, the links of the scenario that are joined there, the ground first.
    pub(super) members: Vec<Vec<usize>>,
    /// For each actuator, its slide joint, its stroke, and its cycles per minute.
    actuators: Vec<(usize, [f64; 2])>,
}

impl<'a> Builder<'a> {
    /// The bodies with their points.
    pub(super) fn of(file: &'a XmlFile<'a>, mut elements: Elements<'a>) -> Result<Builder<'a>> {
        let mut parts = Parts::new("a file of Linkage", elements.units);
        parts.told = std::mem::take(&mut elements.told);
        parts.rounding = 1.0 / DECIMALS;
        let points = names(&elements.connectors, &mut parts);
        let count = elements.connectors.len();
        let bodies = vec![None; elements.links.len()];
        let mut builder =
            Builder { file, elements, parts, points, bodies, members: vec![Vec::new(); count], actuators: Vec::new() };
        let groups = builder.groups();
        for at in 0..count {
            if builder.elements.connectors[at].is_anchor {
                builder.member(at, FRAME);
            }
        }
        for (at, &group) in groups.iter().enumerate() {
            builder.body(at, group, &groups);
        }
        for at in 0..count {
            let fastened = builder.elements.connectors[at].fastened.clone();
            if let Some(body) = fastened.and_then(|id| builder.body_of(&id)) {
                builder.member(at, body);
            }
        }
        Ok(builder)
    }

    /// For each link, the index of the first link of the body to which the link belongs; `None` if the body is the
    /// ground.
    fn groups(&self) -> Vec<Option<usize>> {
        let links = &self.elements.links;
        let anchors =
            |at: usize| links[at].connectors.iter().filter(|&&own| self.elements.connectors[own].is_anchor).count();
        let mut groups: Vec<Option<usize>> =
            (0..links.len()).map(|at| Some(at).filter(|_| !links[at].is_fixed && anchors(at) < 2)).collect();
        for (at, link) in links.iter().enumerate() {
            for (other, own) in links.iter().enumerate().take(at) {
                let is_rigid = |link: &DrawnLink| link.actuator.is_none();
                let common = link.connectors.iter().filter(|at| own.connectors.contains(at));
                let is_fastened = link.fastened.as_ref() == Some(&own.id) || own.fastened.as_ref() == Some(&link.id);
                let is_one = is_rigid(link) && is_rigid(own) && (is_fastened || common.count() > 1);
                if is_one && groups[at] != groups[other] {
                    let (from, to) = (groups[at], groups[other]);
                    let (from, to) = if from.is_none() { (to, from) } else { (from, to) };
                    groups.iter_mut().filter(|group| **group == from).for_each(|group| *group = to);
                }
            }
        }
        groups
    }

    /// Adds the body of a link.
    /// If an earlier link has added the same body, only the link's connectors are added to the body.
    fn body(&mut self, at: usize, group: Option<usize>, groups: &[Option<usize>]) {
        let own: Vec<usize> = self.elements.links[at].connectors.clone();
        let link = &self.elements.links[at];
        let Some(first) = group else {
            self.bodies[at] = Some(FRAME);
            own.into_iter().for_each(|at| self.member(at, FRAME));
            return;
        };
        if first != at
            && let Some(body) = self.bodies[first]
        {
            self.bodies[at] = Some(body);
            own.into_iter().for_each(|at| self.member(at, body));
            return;
        }
        let is_alone = groups.iter().filter(|own| **own == group).count() == 1;
        if own.is_empty() || (own.len() == 1 && !link.is_gear && is_alone) {
            return;
        }
        let (name, actuator) = (self.parts.link_names.legal(&link.name), link.actuator);
        if name != link.name {
            self.parts.told.push(sentences::the_link_is_called(&link.name, &name));
        }
        let place = |at: usize| (self.points[at].clone(), self.elements.connectors[at].place);
        let body = self.parts.links.len();
        self.bodies[at] = Some(body);
        let Some(stroke) = actuator else {
            let places = own.iter().map(|&at| place(at)).collect();
            self.parts.links.push(LinkPart::through(name, places, 0.0));
            own.into_iter().for_each(|at| self.member(at, body));
            return;
        };
        // An actuator becomes two links: a cylinder at its first connector, and a rod at its second connector.
        let along = place(own[1]).1 - place(own[0]).1;
        let angle = along.y.atan2(along.x);
        let rod = self.parts.link_names.legal(&format!("{name}_rod"));
        let [first, second] = [own[0], own[1]].map(place);
        let points = [first.0.clone(), second.0.clone()];
        self.parts.links.push(LinkPart::through(name.clone(), vec![first], angle));
        self.parts.links.push(LinkPart::through(rod, vec![second], angle));
        self.member(own[0], body);
        self.member(own[1], body + 1);
        let joint = self.parts.joint_names.legal(&name);
        self.actuators.push((self.parts.joints.len(), stroke));
        let pair = PartPair::Slide { points, axes: [0.0, 0.0] };
        self.parts.joints.push(JointPart { name: joint, links: [body, body + 1], pair });
    }

    /// Adds a link to the links of a connector, and the connector's point to the link.
    fn member(&mut self, connector: usize, link: usize) {
        if !self.members[connector].contains(&link) {
            self.members[connector].push(link);
        }
        let place = self.parts.links[link].local(self.elements.connectors[connector].place);
        if link != FRAME {
            self.parts.links[link].put(&self.points[connector], place);
        }
    }

    /// The link of the scenario for a link of the file.
    pub(super) fn body_of(&self, id: &str) -> Option<usize> {
        self.bodies[self.elements.links.iter().position(|link| link.id == id)?]
    }

    /// Adds the pins.
    pub(super) fn joints(&mut self) -> Result<()> {
        for at in 0..self.elements.connectors.len() {
            let links = self.members[at].clone();
            if links.len() > 1 && links[0] == FRAME {
                self.parts.links[FRAME].put(&self.points[at], self.elements.connectors[at].place);
            }
            self.parts.pin(&self.points[at], &links);
        }
        Parts::check_count(self.parts.joints.len())
    }

    /// Adds the drives: inputs on the ground, then actuators.
    pub(super) fn drives(&mut self) {
        for (at, own) in self.elements.connectors.iter().enumerate().filter(|(_, own)| own.is_input) {
            let point = &self.points[at];
            let is_own = |joint: &JointPart| {
                joint.links[0] == FRAME && matches!(&joint.pair, PartPair::Pin(name) if name == point)
            };
            let Some(joint) = self.parts.joints.iter().position(is_own) else {
                self.parts.told.push(sentences::the_input_joins_nothing(point));
                continue;
            };
            if self.members[at].len() > 2 {
                self.parts.told.push(sentences::the_input_has_several_links(point));
            }
            let speed = if own.speed == 0.0 {
                self.parts.told.push(sentences::the_speed_is_zero(&USUAL_SPEED));
                -USUAL_SPEED
            } else {
                -own.speed
            };
            self.parts.drives.push(DrivePart { joint, speed, turning: "rpm", travel: None, free: None });
        }
        for &(joint, [stroke, cycles]) in &self.actuators {
            // One cycle is the stroke forward and the stroke back.
            let speed = 2.0 * stroke * cycles / 60.0;
            let name = &self.parts.joints[joint].name;
            if speed == 0.0 {
                self.parts.told.push(sentences::the_actuator_stands_still(name));
                continue;
            }
            self.parts.told.push(sentences::the_actuator_makes_one_stroke(name, &stroke, &self.parts.units.length));
            let travel = Some(stroke);
            self.parts.drives.push(DrivePart { joint, speed, turning: "rpm", travel, free: None });
        }
        if self.parts.drives.is_empty() {
            self.parts.told.push(sentences::NO_JOINT_IS_THE_INPUT.into());
        }
    }
}

/// Names of the connectors in the scenario, changed where scenario files do not allow the names of the source.
fn names(connectors: &[Connector], parts: &mut Parts) -> Vec<String> {
    let mut points = Vec::new();
    for own in connectors {
        let name = parts.point_names.legal(&own.name);
        if name != own.name {
            parts.told.push(sentences::the_joint_is_called(&own.name, &name));
        }
        points.push(name);
    }
    points
}
