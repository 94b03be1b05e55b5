//! A mechanism as another program describes it: links in their start pose, joints, drives and loads.
//! Lengths, masses and forces stay in the units of the other program. The scenario then shows the numbers of its
//! source.

use super::names::Names;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Vec2, rotated, unit};
use linkage::mechanism::LinkPose;

use crate::sentences;

/// Index of the ground in the list of links.
pub(super) const FRAME: usize = 0;
/// Largest number of links, of joints and of loads. No mechanism that was drawn by hand has more.
const MOST_PARTS: usize = 300;

/// The units of a source, as the endings of scenario keys. `metres` is the source's unit of length in m.
#[derive(Clone, Copy, Debug)]
pub(super) struct SourceUnits {
    pub(super) length: &'static str,
    pub(super) metres: f64,
    pub(super) mass: &'static str,
    pub(super) force: &'static str,
}

/// Units of a source that uses SI.
pub(super) const SI: SourceUnits = SourceUnits { length: "m", metres: 1.0, mass: "kg", force: "N" };

/// Mass of a link.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkMass {
    pub(super) mass: f64,
    /// Mass centre in the frame of the link.
    pub(super) centre: Vec2,
    /// Moment of inertia about the mass centre (kg m^2).
    pub(super) inertia: f64,
}

/// A link with its frame in the start pose.
#[derive(Clone, Debug)]
pub(super) struct LinkPart {
    pub(super) name: String,
    pub(super) pose: LinkPose,
    /// Points in the frame of the link.
    pub(super) points: Vec<(String, Vec2)>,
    pub(super) mass: Option<LinkMass>,
}

impl LinkPart {
    /// A link whose frame has its origin at the first of `places` (world) and its x axis towards the second.
    /// If `places` has only one entry, the frame has the direction `otherwise` (rad).
    pub(super) fn through(name: String, places: Vec<(String, Vec2)>, otherwise: f64) -> LinkPart {
        let origin = places.first().map_or(Vec2::zeros(), |(_, place)| *place);
        let along = places.iter().map(|(_, place)| place - origin).find(|along| along.norm() > 0.0);
        let pose = LinkPose { origin, angle: along.map_or(otherwise, |along| along.y.atan2(along.x)) };
        let points = places.into_iter().map(|(name, place)| (name, local(&pose, place))).collect();
        LinkPart { name, pose, points, mass: None }
    }

    /// Converts a world position into the frame of this link.
    pub(super) fn local(&self, place: Vec2) -> Vec2 {
        local(&self.pose, place)
    }

    /// Position of a point in the frame of the link.
    pub(super) fn place_of(&self, point: &str) -> Option<Vec2> {
        self.points.iter().find(|(name, _)| name == point).map(|(_, place)| *place)
    }

    /// Adds a point, unless the link already has a point of this name.
    pub(super) fn put(&mut self, name: &str, place: Vec2) {
        if self.place_of(name).is_none() {
            self.points.push((name.into(), place));
        }
    }
}

fn local(pose: &LinkPose, place: Vec2) -> Vec2 {
    rotated(unit(-pose.angle), place - pose.origin)
}

/// The pair of a joint.
#[derive(Clone, Debug)]
pub(super) enum PartPair {
    /// A pin. Both links have a point of this name, and the two points coincide.
    Pin(String),
    /// A slide through a point of the first link and a point of the second. `axes` are the directions of the slide in
    /// the frames of the two links (rad).
    Slide { points: [String; 2], axes: [f64; 2] },
}

/// A joint between two links.
#[derive(Clone, Debug)]
pub(super) struct JointPart {
    pub(super) name: String,
    pub(super) links: [usize; 2],
    pub(super) pair: PartPair,
}

/// A drive at a joint.
#[derive(Clone, Debug)]
pub(super) struct DrivePart {
    pub(super) joint: usize,
    /// Speed: an angular velocity in the unit `turning`, or a rate of a slide in the source's unit of length per
    /// second.
    pub(super) speed: f64,
    /// Unit of an angular velocity, as a key ending in scenarios.
    pub(super) turning: &'static str,
    /// Largest travel of a slide from the start in the direction of its motion, in the source's unit of length.
    pub(super) travel: Option<f64>,
    /// Only for a drive whose motion is determined by forces: the rate at t = 0 in the unit of `speed`, and the link
    /// whose world angle is the input.
    /// The link is `None` if the input is not a world angle.
    pub(super) free: Option<(f64, Option<usize>)>,
}

/// A table in the text of the scenario: its heading, and its keys with their values.
pub(super) type WrittenTable = (&'static str, Vec<(String, String)>);

/// A mechanism of another program.
#[derive(Debug)]
pub(super) struct Parts {
    /// The program and its kind of file, for the comment at the top of the scenario.
    pub(super) source: &'static str,
    pub(super) title: String,
    pub(super) units: SourceUnits,
    /// Links, the ground first.
    pub(super) links: Vec<LinkPart>,
    pub(super) joints: Vec<JointPart>,
    pub(super) drives: Vec<DrivePart>,
    /// Transmissions, motors and loads.
    pub(super) tables: Vec<WrittenTable>,
    /// Acceleration of gravity (m/s^2).
    pub(super) gravity: Option<Vec2>,
    /// Remarks for the user: parts of the source that were not understood, and assumptions of the import.
    pub(super) told: Vec<String>,
    /// Whether coordinates are written with all digits.
    /// If not, coordinates are rounded to the twelfth digit of the mechanism's size.
    pub(super) is_exact: bool,
    /// Step to which the source rounds its coordinates, in the source's unit of length; 0 if the source has more than
    /// twelve digits.
    pub(super) rounding: f64,
    pub(super) link_names: Names,
    pub(super) point_names: Names,
    pub(super) joint_names: Names,
}

impl Parts {
    /// A mechanism without moving links.
    pub(super) fn new(source: &'static str, units: SourceUnits) -> Parts {
        let ground = LinkPart { name: "ground".into(), pose: LinkPose::GROUND, points: Vec::new(), mass: None };
        Parts {
            source,
            title: sentences::imported_from(&source),
            units,
            links: vec![ground],
            joints: Vec::new(),
            drives: Vec::new(),
            tables: Vec::new(),
            gravity: None,
            told: Vec::new(),
            is_exact: false,
            rounding: 0.0,
            link_names: Names::with(&["ground", "housing"]),
            point_names: Names::with(&[]),
            joint_names: Names::with(&[]),
        }
    }

    /// Joins the first link on a pin with each further link on the pin.
    /// The first joint has the name of the pin. Further joints have this name with a number.
    pub(super) fn pin(&mut self, point: &str, links: &[usize]) {
        for &link in links.iter().skip(1) {
            let name = self.joint_names.legal(point);
            self.joints.push(JointPart { name, links: [links[0], link], pair: PartPair::Pin(point.into()) });
        }
    }

    /// World position of a point of a link, in the source's unit of length.
    pub(super) fn world(&self, link: usize, point: &str) -> Vec2 {
        let own = &self.links[link];
        own.pose.point(own.place_of(point).unwrap_or_else(Vec2::zeros))
    }

    /// The value of a drive's input in the start pose.
    /// The value is an angle (rad), or the position of a slide in the source's unit of length.
    pub(super) fn start(&self, drive: &DrivePart) -> f64 {
        let joint = &self.joints[drive.joint];
        let [first, second] = joint.links;
        if let Some((_, Some(link))) = drive.free {
            return self.links[link].pose.angle;
        }
        match &joint.pair {
            PartPair::Pin(_) if second == FRAME => self.links[first].pose.angle,
            PartPair::Pin(_) => self.links[second].pose.angle - self.links[first].pose.angle,
            PartPair::Slide { points, axes } => {
                let gap = self.world(second, &points[1]) - self.world(first, &points[0]);
                unit(self.links[first].pose.angle + axes[0]).dot(&gap)
            }
        }
    }

    /// Size of the mechanism: the largest distance between two ground points, or between a point and the origin of its
    /// link's frame.
    pub(super) fn size(&self) -> f64 {
        let ground = &self.links[FRAME].points;
        let apart = ground.iter().flat_map(|(_, a)| ground.iter().map(move |(_, b)| (a - b).norm()));
        let own = self.links[1..].iter().flat_map(|link| link.points.iter().map(|(_, place)| place.norm()));
        apart.chain(own).fold(0.0, f64::larger)
    }

    /// Refuses a source with more parts than a mechanism drawn by hand has.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] above the limit.
    pub(super) fn check_count(count: usize) -> Result<()> {
        if count <= MOST_PARTS {
            return Ok(());
        }
        let message = sentences::the_source_has_too_many_parts(&count, &MOST_PARTS);
        Err(Error::new(ErrorKind::Unsupported, message).help(sentences::IMPORT_A_PART_OF_IT))
    }
}
