//! Bodies: frames, masses and points.

use super::{Body, Model};
use crate::import::parts::{LinkMass, LinkPart, Parts};
use crate::sentences;
use linkage::error::{ErrorKind, Result};
use linkage::math::{rotated, unit};
use linkage::mechanism::LinkPose;
use roxmltree::Node;

impl<'a> Model<'a> {
    /// Reads the bodies in the order of the file. The joint coordinates have the same order.
    pub(super) fn read_bodies(&mut self) -> Result<()> {
        let root = self.file.tree.root_element();
        let Some(world) = root.children().find(|node| node.has_tag_name("worldbody")) else {
            return Err(self.file.wrong(root, sentences::the_element_has_no(&"mujoco", &"worldbody")));
        };
        let all: Vec<Node> = world.descendants().filter(|node| node.has_tag_name("body")).collect();
        Parts::check_count(all.len())?;
        for node in all {
            self.read_body(node)?;
        }
        // Points are read from the sites, except sites whose name contains a dot: these belong to joints and loads.
        let sites: Vec<Node> = world.descendants().filter(|node| node.has_tag_name("site")).collect();
        Parts::check_count(sites.len() / 4)?;
        for site in sites {
            let name = self.file.text(site, "name")?;
            let owner = self.owner(site);
            if owner > 0 && !name.contains('.') {
                let place = self.file.flat(site, "pos")?;
                let name = self.parts.point_names.legal(name);
                self.parts.links[owner].put(&name, place);
            }
        }
        Ok(())
    }

    fn read_body(&mut self, node: Node<'a, 'a>) -> Result<()> {
        let (file, wanted) = (self.file, self.file.text(node, "name")?);
        let parent = self.owner(node);
        let turn = match file.numbers(node, "axisangle")?.as_deref() {
            None => 0.0,
            Some([0.0, 0.0, axis, angle]) if axis.abs() == 1.0 => axis * angle * self.angle_unit(),
            Some(_) => return Err(file.wrong(node, sentences::THE_BODY_TURNS_OUT_OF_THE_PLANE.into())),
        };
        if let Some(other) = ["quat", "euler", "xyaxes", "zaxis"].iter().find(|name| node.has_attribute(**name)) {
            let message = sentences::the_attribute_is_not_understood(other, &"body");
            return Err(file.fault(node, ErrorKind::Unsupported, message, sentences::WRITE_THE_POSE_AS_AXISANGLE));
        }
        let base = self.parts.links[parent].pose;
        let offset = file.flat(node, "pos")?;
        let pose = LinkPose { origin: base.origin + rotated(unit(base.angle), offset), angle: base.angle + turn };
        let name = self.parts.link_names.legal(wanted);
        if name != wanted {
            self.parts.told.push(sentences::the_link_is_called(&wanted, &name));
        }
        let mass = self.mass(node)?;
        self.parts.links.push(LinkPart { name, pose, points: Vec::new(), mass });
        self.bodies.push(Body { node, parent });
        Ok(())
    }

    /// Mass of a body. MuJoCo refuses a mass of zero. A comment before `inertial` states which values of the model
    /// replace zeros.
    fn mass(&mut self, node: Node<'a, 'a>) -> Result<Option<LinkMass>> {
        let Some(inertial) = node.children().find(|node| node.has_tag_name("inertial")) else {
            self.parts.told.push(sentences::the_body_has_no_inertial(&node.attribute("name").unwrap_or_default()));
            return Ok(None);
        };
        let comment = inertial.prev_siblings().skip(1).take_while(|node| !node.is_element()).find(Node::is_comment);
        let comment = comment.and_then(|node| node.text()).map_or("", str::trim);
        if comment == sentences::IT_HAS_NO_MASS {
            return Ok(None);
        }
        let mass = self.file.number(inertial, "mass", 0.0)?;
        let all = self.file.numbers(inertial, "diaginertia")?.unwrap_or_default();
        let [.., inertia] = all[..] else {
            return Err(self.file.wrong(inertial, sentences::the_element_has_no(&"inertial", &"diaginertia")));
        };
        let inertia = if comment == sentences::IT_HAS_NO_INERTIA { 0.0 } else { inertia };
        Ok(Some(LinkMass { mass, centre: self.file.flat(inertial, "pos")?, inertia }))
    }

    /// The file's unit of angles, in radians.
    fn angle_unit(&self) -> f64 {
        let root = self.file.tree.root_element();
        let compiler = root.children().find(|node| node.has_tag_name("compiler"));
        let is_radian = compiler.and_then(|node| node.attribute("angle")) == Some("radian");
        if is_radian { 1.0 } else { std::f64::consts::PI / 180.0 }
    }
}
