//! Models for MuJoCo, as `linkproof export` writes them: the plane XOY, bodies along a spanning tree, loops closed by
//! `connect`, prescribed drives as heavy rotors.

mod bodies;
mod drives;
mod joints;
mod loads;

use super::parts::{Parts, SI};
use super::xml::XmlFile;
use crate::sentences;
use linkage::error::Result;
use roxmltree::Node;

/// Top-level elements that the import reads, or that have no effect on the mechanism.
const KNOWN: [&str; 11] = [
    "compiler",
    "option",
    "statistic",
    "visual",
    "default",
    "worldbody",
    "equality",
    "tendon",
    "actuator",
    "sensor",
    "keyframe",
];
/// Elements of a body that the import reads, or that only affect the body's appearance.
const KNOWN_IN_BODIES: [&str; 8] = ["body", "inertial", "joint", "site", "geom", "light", "camera", "worldbody"];

/// A model while it is read.
struct Model<'a> {
    file: &'a XmlFile<'a>,
    parts: Parts,
    bodies: Vec<Body<'a>>,
    joints: Vec<ModelJoint<'a>>,
}

/// A body of the model. The body with the index i is the link with the index i + 1, because link 0 is the ground.
struct Body<'a> {
    node: Node<'a, 'a>,
    /// Link that carries the body.
    parent: usize,
}

/// A joint of the tree. The joints have the order of the coordinates.
struct ModelJoint<'a> {
    node: Node<'a, 'a>,
    /// Link of the body.
    link: usize,
    is_slide: bool,
    /// Rate of the coordinate at the start.
    rate: f64,
    /// Index of the joint in the scenario.
    number: usize,
}

/// The mechanism of a model.
pub(super) fn parts(file: &XmlFile) -> Result<Parts> {
    let mut model = Model { file, parts: Parts::new("a model for MuJoCo", SI), bodies: Vec::new(), joints: Vec::new() };
    model.parts.is_exact = true;
    let root = file.tree.root_element();
    if let Some(name) = root.attribute("model") {
        model.parts.title = name.into();
    }
    model.check();
    model.read_bodies()?;
    model.read_joints()?;
    model.read_loads()?;
    model.read_drives()?;
    let option = root.children().find(|node| node.has_tag_name("option"));
    let gravity = option.map(|node| file.flat(node, "gravity")).transpose()?;
    model.parts.gravity = gravity.filter(|gravity| gravity.norm() > 0.0);
    Ok(model.parts)
}

impl<'a> Model<'a> {
    /// The elements in the top-level sections called `name`.
    fn section(&self, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> + use<'a> {
        let root = self.file.tree.root_element();
        let sections = root.children().filter(move |node| node.has_tag_name(name));
        sections.flat_map(|node| node.children().filter(Node::is_element))
    }

    /// Adds a remark for each element that the import does not understand.
    fn check(&mut self) {
        let root = self.file.tree.root_element();
        let top = root.children().filter(|node| node.is_element() && !KNOWN.contains(&node.tag_name().name()));
        let world = root.children().filter(|node| node.has_tag_name("worldbody"));
        let inside = world.flat_map(|node| node.descendants());
        let inside = inside.filter(|node| node.is_element() && !KNOWN_IN_BODIES.contains(&node.tag_name().name()));
        for node in top.chain(inside) {
            self.tell(node);
        }
    }

    /// Adds the remark that an element is left out.
    fn tell(&mut self, node: Node) {
        let name = node.attribute("name").map(|name| format!(" \"{name}\"")).unwrap_or_default();
        let told = sentences::the_element_is_left_out(&node.tag_name().name(), &name, &self.file.line(node));
        self.parts.told.push(told);
    }

    /// The link that carries a site, and the site's element.
    fn site(&self, name: &str) -> Option<(usize, Node<'a, 'a>)> {
        let root = self.file.tree.root_element();
        let world = root.children().find(|node| node.has_tag_name("worldbody"))?;
        let mut sites = world.descendants().filter(|node| node.has_tag_name("site"));
        let node = sites.find(|node| node.attribute("name") == Some(name))?;
        Some((self.owner(node), node))
    }

    /// The link to which an element belongs.
    fn owner(&self, node: Node<'a, 'a>) -> usize {
        let parent = node.ancestors().skip(1).find(|own| own.has_tag_name("body"));
        parent.map_or(0, |parent| 1 + self.bodies.iter().position(|body| body.node == parent).unwrap_or_default())
    }
}
