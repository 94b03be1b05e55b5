//! Joints of the tree and joints that close loops, with their points.

use super::{Model, ModelJoint};
use crate::import::parts::{JointPart, PartPair, Parts};
use crate::sentences;
use linkage::error::{ErrorKind, Result};
use linkage::math::{KeepNan, Vec2};
use roxmltree::Node;

/// A joint with its positions on both links. The points at these positions have no names yet.
struct Placed {
    name: String,
    links: [usize; 2],
    places: [Vec2; 2],
    /// Directions of a slide in the frames of both links (rad).
    axes: Option<[f64; 2]>,
}

impl<'a> Model<'a> {
    /// Reads the joints.
    pub(super) fn read_joints(&mut self) -> Result<()> {
        let rates = self.rates()?;
        let mut placed = Vec::new();
        for at in 0..self.bodies.len() {
            let node = self.bodies[at].node;
            let own: Vec<Node> = node.children().filter(|node| node.has_tag_name("joint")).collect();
            let [joint] = own[..] else {
                let message = sentences::the_body_has_so_many_joints(&own.len());
                return Err(self.unsupported(node, message));
            };
            let is_slide = match joint.attribute("type").unwrap_or("hinge") {
                "hinge" => false,
                "slide" => true,
                other => return Err(self.unsupported(joint, sentences::the_joint_has_the_type(&other))),
            };
            let rate = rates.get(at).copied().unwrap_or_default();
            self.joints.push(ModelJoint { node: joint, link: at + 1, is_slide, rate, number: at });
            placed.push(self.in_tree(joint, at, is_slide)?);
        }
        for node in self.section("equality") {
            match node.tag_name().name() {
                "connect" => placed.push(self.closing(node)?),
                // `read_loads` reports the tendon of a transmission as left out.
                "tendon" => {}
                _ => self.tell(node),
            }
        }
        Parts::check_count(placed.len())?;
        self.put(placed);
        Ok(())
    }

    fn unsupported(&self, node: Node, message: String) -> linkage::error::Error {
        self.file.fault(node, ErrorKind::Unsupported, message, sentences::IMPORT_MODELS_THAT_EXPORT_WROTE)
    }

    /// Rates of the coordinates at the start.
    fn rates(&mut self) -> Result<Vec<f64>> {
        let key = self.section("keyframe").next();
        Ok(key.map(|key| self.file.numbers(key, "qvel")).transpose()?.flatten().unwrap_or_default())
    }

    /// The two sites of a joint, if the file has them.
    fn sides(&self, name: &str) -> Result<Option<[(usize, Vec2); 2]>> {
        let side = |end: &str| {
            let found = self.site(&format!("{name}.{end}"));
            found.map(|(link, node)| Ok((link, self.file.flat(node, "pos")?))).transpose()
        };
        Ok(side("first")?.zip(side("second")?).map(|(first, second)| [first, second]))
    }

    fn in_tree(&self, node: Node<'a, 'a>, at: usize, is_slide: bool) -> Result<Placed> {
        let name = self.file.text(node, "name")?.to_string();
        let (child, parent) = (at + 1, self.bodies[at].parent);
        let [own, base] = [child, parent].map(|link| self.parts.links[link].pose);
        let sides = self.sides(&name)?.filter(|sides| {
            let links = sides.map(|(link, _)| link);
            links == [parent, child] || links == [child, parent]
        });
        // Without sites of the joint, the joint's position on the parent follows from the pose of the body.
        let pos = self.file.flat(node, "pos")?;
        let sides = sides.unwrap_or_else(|| [(parent, self.parts.links[parent].local(own.point(pos))), (child, pos)]);
        let (links, places) = (sides.map(|(link, _)| link), sides.map(|(_, place)| place));
        if !is_slide {
            return Ok(Placed { name, links, places, axes: None });
        }
        let sense = if links[1] == child { 1.0 } else { -1.0 };
        let axis = self.file.flat(node, "axis")? * sense;
        let in_child = axis.y.atan2(axis.x);
        let in_parent = in_child + own.angle - base.angle;
        let axes = if links[1] == child { [in_parent, in_child] } else { [in_child, in_parent] };
        Ok(Placed { name, links, places, axes: Some(axes) })
    }

    fn closing(&self, node: Node<'a, 'a>) -> Result<Placed> {
        let name = self.file.text(node, "name")?.to_string();
        let ends = ["site1", "site2"].map(|key| self.file.text(node, key));
        let [first, second] = ends;
        let found = [first?, second?].map(|site| self.site(site));
        let [Some(first), Some(second)] = found else {
            return Err(self.unsupported(node, sentences::THE_LOOP_HAS_NO_SITES.into()));
        };
        let places = [self.file.flat(first.1, "pos")?, self.file.flat(second.1, "pos")?];
        Ok(Placed { name, links: [first.0, second.0], places, axes: None })
    }

    /// Names the points of the joints and adds the joints.
    /// If one link of a pin has a named point at the pin, the other link gets a point with the same name.
    /// Another pin of that link can be at the same point, so passes over all pins are repeated until nothing changes.
    fn put(&mut self, placed: Vec<Placed>) {
        let mut points: Vec<Option<String>> = placed.iter().map(|_| None).collect();
        let nearest = 1e-12
            * self
                .parts
                .links
                .iter()
                .flat_map(|link| &link.points)
                .fold(1e-3, |size, (_, place)| size.larger(place.norm()));
        loop {
            let mut is_changed = false;
            for (joint, point) in placed.iter().zip(&mut points) {
                if point.is_some() || joint.axes.is_some() {
                    continue;
                }
                let at = |side: usize| self.point_at(joint.links[side], joint.places[side], nearest, &joint.name);
                *point = at(0).or_else(|| at(1));
                if let Some(point) = point {
                    (0..2).for_each(|side| self.parts.links[joint.links[side]].put(point, joint.places[side]));
                    is_changed = true;
                }
            }
            if !is_changed {
                break;
            }
        }
        for (joint, point) in placed.into_iter().zip(points) {
            let [first, second] = joint.links;
            let own = point.unwrap_or_else(|| self.point(first, joint.places[0], nearest, &joint.name));
            let pair = match joint.axes {
                None => {
                    self.parts.links[second].put(&own, joint.places[1]);
                    PartPair::Pin(own)
                }
                Some(axes) => {
                    let other = self.point(second, joint.places[1], nearest, &joint.name);
                    PartPair::Slide { points: [own, other], axes }
                }
            };
            let name = self.parts.joint_names.legal(&joint.name);
            self.parts.joints.push(JointPart { name, links: joint.links, pair });
        }
    }

    /// The name of a link's point at this place. If there is no such point, a point is added.
    pub(super) fn point(&mut self, link: usize, place: Vec2, nearest: f64, wanted: &str) -> String {
        self.point_at(link, place, nearest, wanted).unwrap_or_else(|| {
            let name = self.parts.point_names.legal(wanted);
            self.parts.links[link].put(&name, place);
            name
        })
    }

    /// The name of a link's point at this place. If several points lie there, the one called `wanted` is preferred.
    fn point_at(&self, link: usize, place: Vec2, nearest: f64, wanted: &str) -> Option<String> {
        let points = &self.parts.links[link].points;
        let here = || points.iter().filter(|(_, own)| (own - place).norm() <= nearest).map(|(name, _)| name);
        here().find(|name| *name == wanted).or_else(|| here().next()).cloned()
    }
}
