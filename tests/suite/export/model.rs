//! An MJCF file as data.
//! The motion is computed body by body from the root.

use std::collections::BTreeSet;

use linkage::math::{Vec2, rotated, turned, unit};
use roxmltree::Node;

/// Type of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Hinge,
    Slide,
}

/// A body, its joint and its pose.
#[derive(Clone, Debug)]
pub struct Body {
    pub name: String,
    pub parent: Option<String>,
    pub offset: Vec2,
    pub turn: f64,
    pub mass: f64,
    pub centre: Vec2,
    pub inertia: [f64; 3],
    pub joint: String,
    pub kind: Kind,
    /// Place of a hinge.
    pub place: Vec2,
    /// Direction of a slide.
    pub axis: Vec2,
    pub reference: f64,
    pub armature: f64,
    pub friction: f64,
}

/// Motion of a body's frame.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    pub origin: Vec2,
    pub angle: f64,
    pub velocity: Vec2,
    pub omega: f64,
}

impl Motion {
    pub fn place(&self, local: Vec2) -> Vec2 {
        self.origin + rotated(unit(self.angle), local)
    }

    pub fn speed(&self, local: Vec2) -> Vec2 {
        self.velocity + turned(rotated(unit(self.angle), local)) * self.omega
    }
}

/// Name of a tendon, its moment of friction, and its joints with their coefficients.
pub type Tendon = (String, f64, Vec<(String, f64)>);

/// A file, read back.
#[derive(Debug)]
pub struct Document {
    pub name: String,
    pub step: f64,
    pub gravity: Vec2,
    /// Bodies in the order of coordinates.
    pub bodies: Vec<Body>,
    /// Name and sites of each loop.
    pub loops: Vec<(String, String, String)>,
    pub tendons: Vec<Tendon>,
    pub coordinates: Vec<f64>,
    pub rates: Vec<f64>,
    pub nothing_touches: bool,
    /// Owner, name, place.
    sites: Vec<(Option<String>, String, Vec2)>,
    /// Owner and ends.
    rods: Vec<(Option<String>, [Vec2; 2])>,
    /// Kind and name of each element.
    names: Vec<(String, String)>,
}

fn numbers(node: Node, name: &str) -> Vec<f64> {
    let text = node.attribute(name).unwrap_or_else(|| panic!("{} has no {name}", node.tag_name().name()));
    text.split_whitespace().map(|number| number.parse().unwrap_or_else(|_| panic!("{name} = {text}"))).collect()
}

fn number(node: Node, name: &str) -> f64 {
    numbers(node, name)[0]
}

/// A vector of the plane, whose third component is zero.
fn flat(node: Node, name: &str) -> Vec2 {
    let all = numbers(node, name);
    assert!(all.len() == 3 && all[2] == 0.0, "{name} = {all:?}");
    Vec2::new(all[0], all[1])
}

fn child<'a>(node: Node<'a, 'a>, name: &str) -> Node<'a, 'a> {
    let mut found = node.children().filter(|node| node.has_tag_name(name));
    let first = found.next().unwrap_or_else(|| panic!("{} has no {name}", node.tag_name().name()));
    assert!(found.next().is_none(), "{} has two {name}", node.tag_name().name());
    first
}

fn owner(node: Node) -> Option<String> {
    let parent = node.parent().unwrap();
    parent.has_tag_name("body").then(|| parent.attribute("name").unwrap().to_string())
}

fn body(node: Node) -> Body {
    let turn = numbers(node, "axisangle");
    assert_eq!(turn[..3], [0.0, 0.0, 1.0]);
    let (inertial, joint) = (child(node, "inertial"), child(node, "joint"));
    let kind = match joint.attribute("type") {
        Some("hinge") => Kind::Hinge,
        Some("slide") => Kind::Slide,
        other => panic!("{other:?}"),
    };
    let optional = |name: &str| joint.attribute(name).map_or(0.0, |text| text.parse().unwrap());
    let (place, axis) = match kind {
        Kind::Hinge => {
            assert_eq!(numbers(joint, "axis"), [0.0, 0.0, 1.0]);
            (flat(joint, "pos"), Vec2::zeros())
        }
        Kind::Slide => (Vec2::zeros(), flat(joint, "axis")),
    };
    Body {
        name: node.attribute("name").unwrap().into(),
        parent: owner(node),
        offset: flat(node, "pos"),
        turn: turn[3],
        mass: number(inertial, "mass"),
        centre: flat(inertial, "pos"),
        inertia: numbers(inertial, "diaginertia").try_into().unwrap(),
        joint: joint.attribute("name").unwrap().into(),
        kind,
        place,
        axis,
        reference: number(joint, "ref"),
        armature: optional("armature"),
        friction: optional("frictionloss"),
    }
}

impl Document {
    /// Reads a file.
    pub fn read(text: &str) -> Document {
        let tree = roxmltree::Document::parse(text).unwrap_or_else(|error| panic!("{error}: {text}"));
        let root = tree.root_element();
        assert!(root.has_tag_name("mujoco"));
        let option = child(root, "option");
        let world = child(root, "worldbody");
        let within = |name: &'static str| world.descendants().filter(move |node| node.has_tag_name(name));
        let part = |name: &str| root.children().find(|node| node.has_tag_name(name));
        let text = |node: Node, name: &str| node.attribute(name).unwrap().to_string();
        let loops = part("equality").map_or_else(Vec::new, |part| {
            let all = part.children().filter(|node| node.is_element());
            all.map(|node| {
                assert!(node.has_tag_name("connect"));
                (text(node, "name"), text(node, "site1"), text(node, "site2"))
            })
            .collect()
        });
        let tendons = part("tendon").map_or_else(Vec::new, |part| {
            let all = part.children().filter(|node| node.has_tag_name("fixed"));
            all.map(|node| {
                let joints = node.children().filter(|node| node.has_tag_name("joint"));
                let joints = joints.map(|node| (text(node, "joint"), number(node, "coef"))).collect();
                (text(node, "name"), number(node, "frictionloss"), joints)
            })
            .collect()
        });
        let key = child(child(root, "keyframe"), "key");
        let geom = child(child(root, "default"), "geom");
        let named = root.descendants().filter(|node| node.attribute("name").is_some() && !node.has_tag_name("key"));
        let kind = |node: Node| match node.parent().unwrap().tag_name().name() {
            // All sensors share one namespace, all equality constraints a second one, and all tendons a third one.
            parent @ ("sensor" | "equality" | "tendon") => parent.to_string(),
            _ => node.tag_name().name().to_string(),
        };
        let ends = |node: Node| {
            let all = numbers(node, "fromto");
            [Vec2::new(all[0], all[1]), Vec2::new(all[3], all[4])]
        };
        Document {
            name: text(root, "model"),
            step: number(option, "timestep"),
            gravity: flat(option, "gravity"),
            bodies: within("body").map(body).collect(),
            loops,
            tendons,
            coordinates: numbers(key, "qpos"),
            rates: numbers(key, "qvel"),
            nothing_touches: geom.attribute("contype") == Some("0") && geom.attribute("conaffinity") == Some("0"),
            sites: within("site").map(|node| (owner(node), text(node, "name"), flat(node, "pos"))).collect(),
            rods: within("geom")
                .filter(|node| node.attribute("fromto").is_some())
                .map(|node| (owner(node), ends(node)))
                .collect(),
            names: named.map(|node| (kind(node), text(node, "name"))).collect(),
        }
    }

    /// The body called `name`.
    pub fn body(&self, name: &str) -> &Body {
        self.bodies.iter().find(|body| body.name == name).unwrap_or_else(|| panic!("no body is given {name}"))
    }

    /// Rate of the joint of the named body.
    pub fn rate_of(&self, name: &str) -> f64 {
        self.rates[self.bodies.iter().position(|body| body.name == name).unwrap()]
    }

    /// Owner (`None` for the ground) and position of a site.
    pub fn site(&self, name: &str) -> (Option<&str>, Vec2) {
        let mut found = self.sites.iter().filter(|site| site.1 == name);
        let site = found.next().unwrap_or_else(|| panic!("there is no site {name}"));
        assert!(found.next().is_none());
        (site.0.as_deref(), site.2)
    }

    /// Ends of the rods drawn for a body.
    pub fn rods(&self, name: &str) -> Vec<[Vec2; 2]> {
        self.rods.iter().filter(|rod| rod.0.as_deref() == Some(name)).map(|rod| rod.1).collect()
    }

    /// Asserts that names are unique in each namespace.
    /// No name may be empty or reserved by MuJoCo.
    pub fn names_are_unique(&self) {
        let mut seen = BTreeSet::new();
        for name in &self.names {
            assert!(seen.insert(name), "{name:?} occurs twice");
            assert!(!name.1.is_empty() && name.1 != "world");
        }
    }

    /// Motions of all bodies in the keyframe, each computed from the motion of the body's parent.
    pub fn motions(&self) -> Vec<Motion> {
        let mut motions: Vec<Motion> = Vec::new();
        for (body, &rate) in self.bodies.iter().zip(&self.rates) {
            let parent = self.motion_of(&motions, body.parent.as_deref());
            let angle = parent.angle + body.turn;
            let mut own = Motion {
                origin: parent.place(body.offset),
                angle,
                velocity: parent.speed(body.offset),
                omega: parent.omega,
            };
            match body.kind {
                Kind::Hinge => {
                    own.omega += rate;
                    own.velocity -= turned(rotated(unit(angle), body.place)) * rate;
                }
                Kind::Slide => own.velocity += rotated(unit(angle), body.axis) * rate,
            }
            motions.push(own);
        }
        motions
    }

    /// Motion of a body, or of the ground.
    pub fn motion_of(&self, motions: &[Motion], name: Option<&str>) -> Motion {
        let index = name.map(|name| self.bodies.iter().position(|body| body.name == name).unwrap());
        let still = Motion { origin: Vec2::zeros(), angle: 0.0, velocity: Vec2::zeros(), omega: 0.0 };
        index.map_or(still, |index| motions[index])
    }
}
