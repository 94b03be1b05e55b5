//! Builds the mechanism from the records of a share link: links that are not part of another link, pins of two links
//! each, slides, drives and forces.

use super::records::{LinkLength, PmksForce, PmksJoint, PmksLink, PmksRecords};
use crate::import::parts::{DrivePart, FRAME, JointPart, LinkMass, LinkPart, PartPair, Parts, SourceUnits};
use crate::import::write::{number, quoted};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Vec2, rotated, unit};

/// Speed that an input gets if its speed is zero: the speed in a new document of PMKS+ (turns per minute).
const USUAL_SPEED: f64 = 20.0;
/// Speed of a driven slide (in the document's unit of length, per second). A share link does not contain this speed.
const SLIDE_SPEED: f64 = 5.0;
/// Acceleration of gravity along y in the force analysis of PMKS+ (m/s^2).
const GRAVITY: f64 = -9.81;
/// Half of the last decimal place of an angle in a share link (rad).
const ANGLE_DIGIT: f64 = 0.5e-3;

/// Units of the document, and its unit of moments of inertia (kg m^2).
fn units(records: &PmksRecords) -> (SourceUnits, f64) {
    let force = if records.settings.is_pound { "lbf" } else { "N" };
    match records.settings.length {
        LinkLength::Inch => {
            (SourceUnits { length: "in", metres: 0.0254, mass: "lb", force }, 0.453_592_37 * 0.0254 * 0.0254)
        }
        LinkLength::Centimetre => (SourceUnits { length: "cm", metres: 0.01, mass: "g", force }, 1e-4),
        LinkLength::Metre => (SourceUnits { length: "m", metres: 1.0, mass: "kg", force }, 1.0),
    }
}

/// Builds the mechanism from the records of a share link.
pub(super) fn parts(records: PmksRecords) -> Result<Parts> {
    let (units, inertia) = units(&records);
    let mut builder =
        Builder { parts: Parts::new("a link of PMKS+", units), records, pins: Vec::new(), roots: Vec::new() };
    builder.names()?;
    builder.links(inertia)?;
    for joint in 0..builder.records.joints.len() {
        if builder.records.joints[joint].is_slide { builder.slide(joint)? } else { builder.pin(joint) }
    }
    builder.forces()?;
    let settings = &builder.records.settings;
    builder.parts.gravity = settings.has_forces.then(|| Vec2::new(0.0, GRAVITY));
    if builder.parts.drives.is_empty() {
        builder.parts.told.push(sentences::NO_JOINT_IS_THE_INPUT.into());
    }
    for further in &builder.records.further {
        builder.parts.told.push(sentences::the_section_is_left_out(further));
    }
    Ok(builder.parts)
}

struct Builder {
    records: PmksRecords,
    parts: Parts,
    /// Names of the joints in the scenario.
    pins: Vec<String>,
    /// For each link of the records, its link in the scenario; `None` if the link is welded into another link.
    roots: Vec<Option<usize>>,
}

impl Builder {
    /// Gives every joint its name.
    fn names(&mut self) -> Result<()> {
        let joints = &self.records.joints;
        let ids = joints.iter().map(|joint| &joint.id).chain(self.records.links.iter().map(|link| &link.id));
        let mut sorted: Vec<&String> = ids.collect();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(broken(&quoted(pair[0]), sentences::THE_NAME_IS_GIVEN_TWICE.into()));
        }
        for joint in joints {
            let wanted = if joint.name.is_empty() { &joint.id } else { &joint.name };
            let name = self.parts.point_names.legal(wanted);
            if name != *wanted {
                self.parts.told.push(sentences::the_joint_is_called(&wanted, &name));
            }
            self.pins.push(name);
        }
        Ok(())
    }

    fn joint(&self, id: &str, of: &str) -> Result<usize> {
        let found = self.records.joints.iter().position(|joint| joint.id == id);
        found.ok_or_else(|| broken(of, sentences::the_link_has_no_joint(&id)))
    }

    /// Adds the links, except links that are welded into another link.
    fn links(&mut self, unit_of_inertia: f64) -> Result<()> {
        for at in 0..self.records.links.len() {
            let PmksLink { is_root, is_block, name, id, .. } = &self.records.links[at];
            if !is_root {
                self.roots.push(None);
                continue;
            }
            let wanted = if name.is_empty() { id } else { name }.clone();
            let is_block = *is_block;
            let mut places = Vec::new();
            let mut angle = 0.0;
            for id in &self.records.links[at].joints {
                let joint = self.joint(id, &wanted)?;
                let own = &self.records.joints[joint];
                if own.is_slide {
                    angle = self.direction(joint)?;
                } else {
                    places.push((self.pins[joint].clone(), own.place));
                }
            }
            let name = self.parts.link_names.legal(&wanted);
            if name != wanted {
                self.parts.told.push(sentences::the_link_is_called(&wanted, &name));
            }
            let mut link = LinkPart::through(name, places, angle);
            let own = &self.records.links[at];
            if own.mass > 0.0 {
                let centre = if is_block { Vec2::zeros() } else { link.local(own.centre) };
                link.mass = Some(LinkMass { mass: own.mass, centre, inertia: own.inertia.abs() * unit_of_inertia });
            }
            self.roots.push(Some(self.parts.links.len()));
            self.parts.links.push(link);
        }
        Ok(())
    }

    /// Links of the scenario at a joint.
    fn links_at(&self, joint: &PmksJoint) -> Vec<usize> {
        let at = |(link, root): (&PmksLink, &Option<usize>)| root.filter(|_| link.joints.contains(&joint.id));
        self.records.links.iter().zip(&self.roots).filter_map(at).collect()
    }

    /// Adds the joints of a pin. The first link is the ground if the pin is fixed.
    fn pin(&mut self, index: usize) {
        let (joint, name) = (&self.records.joints[index], self.pins[index].clone());
        let mut links = self.links_at(joint);
        if joint.is_ground {
            if links.is_empty() {
                self.parts.told.push(sentences::the_fixed_joint_has_no_link(&name));
                return;
            }
            links.insert(0, FRAME);
            self.parts.links[FRAME].put(&name, joint.place);
        }
        if joint.is_welded && links.len() > 1 {
            self.parts.told.push(sentences::the_weld_is_a_pin(&name));
        }
        let first = self.parts.joints.len();
        self.parts.pin(&name, &links);
        if joint.is_input {
            if links.len() > 2 {
                self.parts.told.push(sentences::the_input_has_several_links(&name));
            }
            let is_pair = links.len() > 1;
            self.drive(index, is_pair.then_some(first));
        }
    }

    /// Adds the slide of a block, on the ground or in a slot of a link.
    fn slide(&mut self, index: usize) -> Result<()> {
        let joint = &self.records.joints[index];
        let name = self.pins[index].clone();
        let blocks = self.links_at(joint);
        let (guide, point, axis) = match &joint.slot {
            None => {
                self.parts.links[FRAME].put(&name, joint.place);
                (FRAME, name.clone(), self.direction(index)?)
            }
            Some([carrier, first, _]) => {
                let at = self.records.links.iter().position(|link| link.id == *carrier);
                let guide = at
                    .and_then(|at| self.root_of(at))
                    .ok_or_else(|| broken(&name, sentences::the_slot_has_no_link(&carrier)))?;
                let point = self.pins[self.joint(first, &name)?].clone();
                (guide, point, self.direction(index)? - self.parts.links[guide].pose.angle)
            }
        };
        let mate = blocks.first().and_then(|&block| self.parts.links[block].points.first()).cloned();
        let (&[block], Some((mate, _))) = (blocks.as_slice(), mate) else {
            return Err(broken(&name, sentences::the_slide_needs_one_block(&blocks.len())));
        };
        if !joint.is_ground && joint.slot.is_none() {
            self.parts.told.push(sentences::the_slide_is_fixed(&name));
        }
        let second = self.direction(index)? - self.parts.links[block].pose.angle;
        let pair = PartPair::Slide { points: [point, mate], axes: [axis, second] };
        let name = self.parts.joint_names.legal(&name);
        self.parts.joints.push(JointPart { name, links: [guide, block], pair });
        if self.records.joints[index].is_input {
            self.drive(index, Some(self.parts.joints.len() - 1));
        }
        Ok(())
    }

    /// The link of the scenario that contains a link of the records.
    fn root_of(&self, at: usize) -> Option<usize> {
        let id = &self.records.links[at].id;
        let holds = |link: &PmksLink| link.is_root && link.parts.contains(id);
        self.roots[at].or_else(|| self.roots[self.records.links.iter().position(holds)?])
    }

    /// World direction of a slide (rad). An angle that differs from a whole degree only by its rounding is rounded to
    /// this degree.
    fn direction(&self, index: usize) -> Result<f64> {
        let joint = &self.records.joints[index];
        if let Some([_, first, second]) = &joint.slot {
            let [first, second] = [self.joint(first, &joint.id)?, self.joint(second, &joint.id)?];
            let along = self.records.joints[second].place - self.records.joints[first].place;
            return Ok(along.y.atan2(along.x));
        }
        let whole = joint.angle.to_degrees().round().to_radians();
        Ok(if (joint.angle - whole).abs() <= ANGLE_DIGIT { whole } else { joint.angle })
    }

    fn drive(&mut self, index: usize, joint: Option<usize>) {
        let (own, settings, name) = (&self.records.joints[index], &self.records.settings, &self.pins[index]);
        let Some(joint) = joint else {
            self.parts.told.push(sentences::the_input_joins_nothing(name));
            return;
        };
        if own.has_speed {
            self.parts.told.push(sentences::its_own_speed_is_left_out(name));
        }
        let speed = if own.is_slide {
            self.parts.told.push(sentences::the_slide_has_the_speed(name, &SLIDE_SPEED, &self.parts.units.length));
            SLIDE_SPEED
        } else if settings.speed == 0.0 {
            self.parts.told.push(sentences::the_speed_is_zero(&USUAL_SPEED));
            USUAL_SPEED
        } else {
            settings.speed
        };
        let is_back = settings.is_clockwise && !own.is_slide;
        let speed = if is_back { -speed } else { speed };
        self.parts.drives.push(DrivePart { joint, speed, turning: "rpm", travel: None, free: None });
    }

    fn forces(&mut self) -> Result<()> {
        for at in 0..self.records.forces.len() {
            let PmksForce { name, link, from, to, turns_with_link, is_outward, size } = &self.records.forces[at];
            let number_of = self.records.links.iter().position(|own| own.id == *link);
            let root = number_of.and_then(|own| self.root_of(own));
            let root = root.ok_or_else(|| broken(name, sentences::the_force_has_no_link(link)))?;
            let along = to - from;
            if along.norm() == 0.0 {
                self.parts.told.push(sentences::the_force_has_no_direction(name));
                continue;
            }
            let mut force = along * (size / along.norm() * if *is_outward { 1.0 } else { -1.0 });
            let own = &mut self.parts.links[root];
            let mut keys = vec![("type".into(), quoted("force")), ("link".into(), quoted(&own.name))];
            let point = self.parts.point_names.legal(if name.is_empty() { "F" } else { name });
            let place = own.local(*from);
            own.put(&point, place);
            keys.push(("point".into(), quoted(&point)));
            if *turns_with_link {
                force = rotated(unit(-own.pose.angle), force);
                keys.push(("frame".into(), quoted("link")));
            }
            let unit = self.parts.units.force;
            keys.push((format!("x_{unit}"), number(rounded(force.x))));
            keys.push((format!("y_{unit}"), number(rounded(force.y))));
            self.parts.tables.push(("[[loads]]", keys));
        }
        Ok(())
    }
}

/// The number without the rounding errors of a rotation.
fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

fn broken(part: &str, message: String) -> Error {
    Error::new(ErrorKind::Input, message).key(part).help(sentences::COPY_THE_WHOLE_LINK)
}
