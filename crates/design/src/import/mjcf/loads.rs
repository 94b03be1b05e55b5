//! Loads: frictions, actuators and spatial tendons.

use super::Model;
use crate::import::write::{number, quoted};
use crate::sentences;
use linkage::error::Result;
use linkage::math::angle;
use roxmltree::Node;

/// A sum of joint coordinates: the joints with their factors.
type Sum = Vec<(usize, f64)>;

impl<'a> Model<'a> {
    /// Reads the loads: first frictions of joints, then tendons, then actuators.
    pub(super) fn read_loads(&mut self) -> Result<()> {
        for at in 0..self.joints.len() {
            let (node, link) = (self.joints[at].node, self.joints[at].link);
            let moment = self.file.number(node, "frictionloss", 0.0)?;
            if moment > 0.0 {
                self.resistance(link, moment);
            }
            for name in ["damping", "stiffness"] {
                if self.file.number(node, name, 0.0)? != 0.0 {
                    self.parts.told.push(sentences::the_attribute_is_not_understood(&name, &"joint"));
                }
            }
        }
        for node in self.section("tendon") {
            let moment = self.file.number(node, "frictionloss", 0.0)?;
            let name = node.attribute("name").unwrap_or_default();
            if node.has_tag_name("fixed") && moment > 0.0 {
                if let Some(link) = self.sum(node)?.iter().map(|&(at, _)| self.joints[at].link).max() {
                    self.resistance(link, moment);
                }
            } else if node.has_tag_name("spatial") {
                self.spatial(node, name)?;
            } else if name.starts_with("transmission.") {
                self.parts.told.push(sentences::the_transmission_is_left_out(&name));
            }
        }
        for node in self.section("actuator") {
            self.actuator(node)?;
        }
        Ok(())
    }

    fn load(&mut self, kind: &str, keys: Vec<(&str, String)>) {
        let keys = keys.into_iter().map(|(key, value)| (key.to_string(), value));
        self.parts.tables.push(("[[loads]]", std::iter::once(("type".into(), quoted(kind))).chain(keys).collect()));
    }

    fn link(&self, link: usize) -> String {
        quoted(&self.parts.links[link].name)
    }

    fn resistance(&mut self, link: usize, moment: f64) {
        self.load("resistance", vec![("link", self.link(link)), ("moment_N_m", number(moment))]);
    }

    /// The terms of a fixed tendon.
    fn sum(&self, node: Node<'a, 'a>) -> Result<Sum> {
        let mut sum = Vec::new();
        for own in node.children().filter(|node| node.has_tag_name("joint")) {
            let name = self.file.text(own, "joint")?;
            sum.extend(self.joint(name).map(|at| Ok((at, self.file.number(own, "coef", 1.0)?))).transpose()?);
        }
        Ok(sum)
    }

    fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.node.attribute("name") == Some(name))
    }

    /// A spring or damper between two sites.
    fn spatial(&mut self, node: Node<'a, 'a>, name: &str) -> Result<()> {
        let sites: Vec<&str> = node.children().filter_map(|own| own.attribute("site")).collect();
        let found: Vec<_> = sites.iter().filter_map(|site| self.site(site)).collect();
        let [(first, _), (second, _)] = found[..] else {
            self.tell(node);
            return Ok(());
        };
        let mut points = Vec::new();
        for (link, site) in &found {
            let place = self.file.flat(*site, "pos")?;
            points.push(quoted(&self.point(*link, place, 0.0, name)));
        }
        let links = format!("[{}, {}]", self.link(first), self.link(second));
        let common = vec![("links", links), ("points", format!("[{}]", points.join(", ")))];
        let [stiffness, damping] = [self.file.number(node, "stiffness", 0.0)?, self.file.number(node, "damping", 0.0)?];
        if stiffness != 0.0 {
            let free = self.file.number(node, "springlength", 0.0)?;
            let own = vec![("stiffness_N_m", number(stiffness)), ("free_length_m", number(free))];
            self.load("spring", [common.clone(), own].concat());
        }
        if damping != 0.0 {
            self.load("damper", [common, vec![("damping_N_s_m", number(damping))]].concat());
        }
        Ok(())
    }

    /// Reads an actuator as a moment, a force, a torsional spring or a torsional damper. Motors are read with the
    /// drives.
    fn actuator(&mut self, node: Node<'a, 'a>) -> Result<()> {
        let name = node.attribute("name").unwrap_or_default();
        if name.ends_with(".motor") || name.ends_with(".motor.drives") || name.ends_with(".motor.brakes") {
            return Ok(());
        }
        let bias = self.file.numbers(node, "biasprm")?.unwrap_or_default();
        let ([constant, stiffness, damping], Some("affine")) =
            (<[f64; 3]>::try_from(bias).unwrap_or_default(), node.attribute("biastype"))
        else {
            self.parts.told.push(sentences::the_actuator_is_left_out(&name, &self.file.line(node)));
            return Ok(());
        };
        if let Some((link, site)) = node.attribute("site").and_then(|site| self.site(site)) {
            let gear = self.file.numbers(node, "gear")?.unwrap_or_default();
            let about = gear.get(5).copied().unwrap_or_default() * constant;
            if about != 0.0 {
                self.load("moment", vec![("link", self.link(link)), ("moment_N_m", number(about))]);
            }
            if gear.iter().take(2).all(|part| *part == 0.0) {
                return Ok(());
            }
            let place = self.file.flat(site, "pos")?;
            let point = quoted(&self.point(link, place, 0.0, name));
            let [x, y] = [0, 1].map(|k| number(gear.get(k).copied().unwrap_or_default() * constant));
            let frame = if node.has_attribute("refsite") { "world" } else { "link" };
            let keys =
                vec![("link", self.link(link)), ("point", point), ("x_N", x), ("y_N", y), ("frame", quoted(frame))];
            self.load("force", keys);
            return Ok(());
        }
        let Some([first, second]) = self.turned(node)? else {
            self.parts.told.push(sentences::the_actuator_is_left_out(&name, &self.file.line(node)));
            return Ok(());
        };
        if stiffness == 0.0 && damping == 0.0 {
            self.load("moment", vec![("link", self.link(second)), ("moment_N_m", number(constant))]);
            return Ok(());
        }
        let links = ("links", format!("[{}, {}]", self.link(first), self.link(second)));
        if stiffness != 0.0 {
            // In the model, the angle between the links includes the whole turns that it has in the start pose.
            // In a scenario, the spring's twist in the start pose lies between -pi and pi.
            let begun = self.parts.links[second].pose.angle - self.parts.links[first].pose.angle;
            let free = constant / -stiffness - begun + angle::wrapped(begun);
            let own = vec![links.clone(), ("stiffness_N_m_rad", number(-stiffness)), ("free_angle_rad", number(free))];
            self.load("torsion_spring", own);
        }
        if damping != 0.0 {
            self.load("torsion_damper", vec![links, ("damping_N_m_s", number(-damping))]);
        }
        Ok(())
    }

    /// The two links whose relative angle is the coordinate of an actuator.
    /// Joints with a positive factor lead to the second link, and joints with a negative factor lead to the first link.
    fn turned(&self, node: Node<'a, 'a>) -> Result<Option<[usize; 2]>> {
        let sum = match (node.attribute("joint"), node.attribute("tendon")) {
            (Some(joint), _) => self.joint(joint).map(|at| vec![(at, 1.0)]).unwrap_or_default(),
            (None, Some(tendon)) => {
                let own = self.section("tendon").find(|own| own.attribute("name") == Some(tendon));
                own.map(|own| self.sum(own)).transpose()?.unwrap_or_default()
            }
            (None, None) => Vec::new(),
        };
        let joints = |sign: f64| sum.iter().filter(move |(_, factor)| *factor == sign).map(|&(at, _)| at);
        // In the file, a body comes after the body that carries it. The largest index is therefore the end of the
        // chain.
        let end = |sign: f64| joints(sign).max().map(|at| self.joints[at].link);
        let base = |sign: f64| joints(sign).min().map(|at| self.bodies[at].parent);
        Ok(match (end(-1.0), end(1.0)) {
            (Some(first), Some(second)) => Some([first, second]),
            (None, Some(second)) => base(1.0).map(|first| [first, second]),
            (Some(first), None) => base(-1.0).map(|second| [first, second]),
            (None, None) => None,
        })
    }
}
