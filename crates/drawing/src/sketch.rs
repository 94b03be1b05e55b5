//! The sketch: all marks of a mechanism.

use super::mark::{Layer, Mark, MarkRole};
use super::sign::LoadSign;
use super::stretched::Stretched;
use super::travel::Travels;
use super::{body, guide, pins, sign, stretched, transmission};
use linkage::case::CaseParts;
use linkage::drive::{Drive, Load};
use linkage::math::{Vec2, turned};
use linkage::mechanism::{GROUND, Joint, JointSide, LinkId, Mechanism};

/// Size of a mechanism in units of its sketch, if the size of the picture is unknown.
const UNITS: f64 = 60.0;
/// Half length of the line drawn across a guide at a ground point, in units of the sketch.
const STOP: f64 = 1.4;

/// The unit (m) of a sketch, for a picture of unknown size. A pin is 2.4 units wide, a block is 10 units long.
/// If the size of the picture is known, a unit of about 1/150 of its width makes the picture easy to read.
pub fn unit(mechanism: &Mechanism) -> f64 {
    mechanism.size() / UNITS
}

/// The drawing of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Sketch {
    /// Unit length (m) of symbols and line widths.
    pub unit: f64,
    /// Every link, in the order of the mechanism. The first is the ground, in world coordinates.
    pub bodies: Vec<LinkMarks>,
    /// Springs and dampers between points.
    pub stretched: Vec<Stretched>,
    /// Forces and moments, drawn as arrows once a state is known.
    pub loads: Vec<LoadSign>,
    /// Names, each with the point that it names.
    pub labels: Vec<SketchLabel>,
}

/// The marks of one link, in the frame of the link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkMarks {
    /// Number of the link.
    pub link: LinkId,
    /// Marks of the link.
    pub marks: Vec<Mark>,
    /// Largest distance between two points of the link (m); infinite for the ground.
    pub size: f64,
    /// Whether the link is a platform carried by sliding links only. A platform is drawn above blocks and pistons.
    pub is_platform: bool,
}

/// What a label names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lettering {
    /// A named point.
    Point,
    /// A link: its number.
    Link,
    /// The mass centre of a link: the letter S and the link's number.
    MassCentre,
    /// A motor: M.
    Motor,
}

/// A text and the point that it names. The caller chooses the position of the text.
#[derive(Clone, Debug, PartialEq)]
pub struct SketchLabel {
    /// The text.
    pub text: String,
    /// What the label names.
    pub names: Lettering,
    /// The point that the label names.
    pub at: JointSide,
}

impl Sketch {
    /// The sketch of the links and joints of a mechanism. `travels` sets the lengths of the guides.
    /// Symbols are multiples of `unit` (m): see [`unit`](self::unit).
    pub fn of(mechanism: &Mechanism, travels: &Travels, unit: f64) -> Sketch {
        let body = |link| {
            let marks = if link == GROUND { ground(mechanism, unit) } else { body::marks(mechanism, link, unit) };
            LinkMarks { link, marks, size: body::size(mechanism, link), is_platform: is_platform(mechanism, link) }
        };
        let mut bodies: Vec<LinkMarks> = mechanism.links().ids().map(body).collect();
        let pairs = guide::marks(mechanism, travels, unit).into_iter().chain(pins::marks(mechanism, unit));
        for (link, mark) in transmission::marks(mechanism, travels).into_iter().chain(pairs) {
            bodies[link].marks.push(mark);
        }
        Sketch { unit, bodies, stretched: Vec::new(), loads: Vec::new(), labels: labels(mechanism) }
    }

    /// The drawing of a whole case: links, joints, drives and loads.
    pub fn of_case(case: &CaseParts, travels: &Travels, unit: f64) -> Sketch {
        let sketch = Sketch::of(&case.mechanism, travels, unit);
        sketch.with_drives(&case.mechanism, &case.drives).with_loads(&case.mechanism, &case.loads)
    }

    /// The sketch with the directions of drives, and with motors.
    pub fn with_drives(mut self, mechanism: &Mechanism, drives: &[Drive]) -> Sketch {
        for drive in drives {
            self.bodies[drive.link].marks.extend(sign::of_drive(mechanism, drive, self.unit));
            if let (Some(_), Some(local)) = (drive.motor(), mechanism.joints()[drive.joint].on(drive.link)) {
                let at = JointSide { link: drive.link, local };
                self.labels.push(SketchLabel { text: "M".into(), names: Lettering::Motor, at });
            }
        }
        self
    }

    /// The sketch with loads. Ground points with springs and dampers are drawn as pivots.
    pub fn with_loads(mut self, mechanism: &Mechanism, loads: &[Load]) -> Sketch {
        self.stretched = stretched::of_loads(loads, self.unit);
        self.loads = loads.iter().enumerate().filter_map(|(k, load)| sign::of_load(mechanism, k, load)).collect();
        let mut hooks: Vec<Vec2> = body::traced(mechanism, GROUND);
        hooks.retain(|at| {
            self.stretched.iter().flat_map(|own| own.ends).any(|end| end.link == GROUND && end.local == *at)
        });
        for at in hooks {
            let crosses = body::tracer(at, self.unit);
            let ground = &mut self.bodies[GROUND].marks;
            ground.retain(|mark| !crosses.contains(mark));
            ground.extend(pins::pivot(at, self.unit));
            ground.push(Mark::circle(MarkRole::Pin, at, pins::PIN * self.unit));
        }
        for (link, marks) in loads.iter().filter_map(|load| sign::twisted(mechanism, load, self.unit)) {
            self.bodies[link].marks.extend(marks);
        }
        self
    }

    /// The sketch without the marks of some roles.
    pub fn without(mut self, roles: &[MarkRole]) -> Sketch {
        for body in &mut self.bodies {
            body.marks.retain(|mark| !roles.contains(&mark.role));
        }
        self
    }

    /// All marks of all links, each with the number of its link, in drawing order.
    /// The marks are ordered by layer; within a layer, larger links come first.
    /// The springs and dampers in `stretched` are not in this list; they belong to [`Layer::Stretched`].
    pub fn in_order(&self) -> Vec<(LinkId, &Mark)> {
        let mut all: Vec<(Layer, f64, LinkId, &Mark)> = Vec::new();
        for body in &self.bodies {
            all.extend(body.marks.iter().map(|mark| {
                let layer = mark.role.look().layer;
                match body.is_platform && layer == Layer::Links {
                    true => (Layer::Blocks, 0.0, body.link, mark),
                    false => (layer, body.size, body.link, mark),
                }
            }));
        }
        // The sort is stable, so the marks of one link keep their order.
        all.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)).then(a.2.cmp(&b.2)));
        all.into_iter().map(|(_, _, link, mark)| (link, mark)).collect()
    }
}

/// Marks on the ground besides guides and pivots: traced points, and a short line across each guide at its ground
/// point.
fn ground(mechanism: &Mechanism, unit: f64) -> Vec<Mark> {
    let mut marks: Vec<Mark> =
        body::traced(mechanism, GROUND).into_iter().flat_map(|at| body::tracer(at, unit)).collect();
    let pivots = pins::pivots(mechanism);
    let points = &mechanism.links()[GROUND].points;
    for joint in mechanism.joints() {
        let (Some(at), Some(axis)) = (joint.on(GROUND), joint.axis_on(GROUND)) else { continue };
        if !pivots.contains(&at) && points.iter().any(|point| point.local == at) {
            let half = turned(axis) * (STOP * unit);
            marks.push(Mark::line(MarkRole::Stop, [at - half, at + half]));
        }
    }
    marks
}

/// Whether a link has more than two joints, and each of them is a pin to a moving link that also has a slide.
fn is_platform(mechanism: &Mechanism, link: LinkId) -> bool {
    let joints = |link| mechanism.joints().iter().filter(move |joint| joint.on(link).is_some());
    let is_carried = |joint: &Joint| {
        let other = joint.other(link).link;
        joint.is_pin() && other != GROUND && joints(other).any(|own| !own.is_pin())
    };
    link != GROUND && joints(link).count() > 2 && joints(link).all(is_carried)
}

fn labels(mechanism: &Mechanism) -> Vec<SketchLabel> {
    let fixed = mechanism.links()[GROUND].points.iter();
    let fixed = fixed.map(|point| (point.name.as_str(), JointSide { link: GROUND, local: point.local }));
    let point = |(name, at): (&str, JointSide)| SketchLabel { text: name.into(), names: Lettering::Point, at };
    let mut labels: Vec<SketchLabel> = fixed.chain(mechanism.moving_points()).map(point).collect();
    for (link, body) in mechanism.links().entries().skip(1) {
        let places = body::places(mechanism, link);
        // A link without points is invisible, so it gets no label.
        if places.is_empty() {
            continue;
        }
        let middle = places.iter().sum::<Vec2>() / places.len() as f64;
        labels.push(SketchLabel {
            text: link.to_string(),
            names: Lettering::Link,
            at: JointSide { link, local: middle },
        });
        if body.mass > 0.0 {
            let at = JointSide { link, local: body.mass_centre };
            labels.push(SketchLabel { text: format!("S{link}"), names: Lettering::MassCentre, at });
        }
    }
    labels
}
