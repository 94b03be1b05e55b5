//! Sliders.
//! A single slider on a path is a pin in a slot. The scenario has a massless block for it, with a pin and a slide.
//! Two sliders of one link on the same path become one slide of this link.

use super::build::Builder;
use super::elements::Connector;
use crate::import::parts::{FRAME, JointPart, LinkPart, PartPair};
use crate::sentences;

impl Builder<'_> {
    /// Adds the slides.
    pub(super) fn sliders(&mut self) {
        let mut done: Vec<(usize, usize, [usize; 2])> = Vec::new();
        for at in 0..self.elements.connectors.len() {
            let own = &self.elements.connectors[at];
            let Some(path) = own.path else { continue };
            let point = self.points[at].clone();
            if own.is_curved {
                self.parts.told.push(sentences::the_path_is_curved(&point));
                continue;
            }
            let guide = self.members[path[0]].iter().find(|link| self.members[path[1]].contains(link)).copied();
            let Some((guide, &rider)) = guide.zip(self.members[at].first()) else {
                self.parts.told.push(sentences::the_slider_has_no_guide(&point));
                continue;
            };
            let same = |other: &[usize; 2]| *other == path || [other[1], other[0]] == path;
            if done.iter().any(|(own, to, other)| *own == rider && *to == guide && same(other)) {
                continue;
            }
            done.push((rider, guide, path));
            let [from, to] = path.map(|end| self.elements.connectors[end].place);
            let angle = (to - from).y.atan2((to - from).x);
            let twins = |other: &Connector| other.path.as_ref().is_some_and(same) && !other.is_curved;
            let count = self.elements.connectors.iter().zip(&self.members);
            let count = count.filter(|(other, links)| twins(other) && links.first() == Some(&rider)).count();
            let place = self.elements.connectors[at].place;
            let (block, block_point) = if count > 1 {
                if rider == FRAME {
                    self.parts.links[FRAME].put(&point, place);
                }
                (rider, point.clone())
            } else {
                let name = self.parts.link_names.legal(&format!("block_{point}"));
                let block = self.parts.links.len();
                self.parts.links.push(LinkPart::through(name, vec![(point.clone(), place)], angle));
                let in_rider = self.parts.links[rider].local(place);
                self.parts.links[rider].put(&point, in_rider);
                self.parts.pin(&point, &[rider, block]);
                (block, point.clone())
            };
            let guide_point = self.points[path[0]].clone();
            let in_guide = self.parts.links[guide].local(from);
            self.parts.links[guide].put(&guide_point, in_guide);
            let axes = [guide, block].map(|link| angle - self.parts.links[link].pose.angle);
            let name = self.parts.joint_names.legal(&format!("slide_{point}"));
            let pair = PartPair::Slide { points: [guide_point, block_point], axes };
            self.parts.joints.push(JointPart { name, links: [guide, block], pair });
        }
    }
}
