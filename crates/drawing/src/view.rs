//! A mechanism as cells of a sheet: one instant, or the frames of an animation at one scale.

use super::acting::Acting;
use super::body::places;
use super::dimension::{Dimension, dimensions};
use super::lay::Laid;
use super::mark::MarkRole;
use super::paper::figure::DrawnFigure;
use super::picture::{AROUND, Picture};
use super::positions::Series;
use super::sheet::{SheetCell, fit, legend_rows};
use super::sketch::{Lettering, Sketch};
use super::travel::Travels;
use crate::sentences;
use linkage::drive::{Drive, Load};
use linkage::math::{KeepNan, Vec2, corners};
use linkage::mechanism::{GROUND, LinkId, Mechanism};

/// Size (mm) from which a link has space for its number. The size of a bar is its longest piece between two points.
const FREE: f64 = 11.0;

/// In a picture with numbered positions, the work allowed for placing labels is divided by this number.
const NUMBERED: usize = 5;

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct DrawnSubject<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The drives of the mechanism.
    pub drives: &'a [Drive],
    /// The loads on the mechanism.
    pub loads: &'a [Load],
    /// Acceleration of gravity (m/s^2).
    pub gravity: Vec2,
}

/// What is drawn besides links, joints, springs and dampers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extras {
    /// Gravity, mass centres, and the arrows of loads.
    pub loads: bool,
    /// Lengths and angles that define the links and the ground.
    pub dimensions: bool,
    /// Whether the picture is a frame of an animation.
    /// In an animation, only ground points have names, and only links with enough space have numbers.
    /// Because of this restriction, no label jumps between frames.
    pub is_moving: bool,
    /// Whether the picture has no names and numbers.
    pub is_small: bool,
}

/// One instant: positions of the links, and effects of the loads.
#[derive(Clone, Debug)]
pub struct Shot {
    /// Where every link is.
    pub laid: Laid,
    /// Forces and moments that are drawn as arrows.
    pub acting: Vec<Acting>,
}

/// The path of a point: its link, and its positions in the world (m).
pub type Trace = (LinkId, Vec<Vec2>);

/// Motion that a picture shows besides the pose at one instant.
#[derive(Clone, Copy, Debug)]
pub struct ShownMotion<'a> {
    /// Travels of the blocks on their guides.
    pub travels: &'a Travels,
    /// Paths of points.
    pub traces: &'a [Trace],
    /// Further positions, with numbered paths.
    pub series: Option<&'a Series>,
}

/// The shots as figures at one scale. Each figure fits into the size `room` (mm).
/// A figure has a heading only if some of its paths are too small for numbers.
pub fn cells(
    subject: &DrawnSubject,
    shots: &[Shot],
    motion: ShownMotion,
    extras: Extras,
    room: Vec2,
) -> Vec<SheetCell> {
    let [low, high] = corners(extent(subject, shots, motion));
    let around = if extras.is_small { AROUND / 3.0 } else { AROUND };
    let scale = fit(high - low, room - Vec2::repeat(2.0 * around));
    let sketch = Sketch::of(subject.mechanism, motion.travels, scale)
        .with_drives(subject.mechanism, subject.drives)
        .with_loads(subject.mechanism, subject.loads);
    let sketch = if extras.loads { sketch } else { sketch.without(&[MarkRole::MassCentre, MarkRole::MassQuarter]) };
    let dimensions = if extras.dimensions { dimensions(subject.mechanism) } else { Vec::new() };
    let figures: Vec<_> =
        shots.iter().map(|shot| figure(subject, &sketch, shot, motion, extras, &dimensions, shots.len())).collect();
    let bounds = corners(figures.iter().flat_map(|(figure, _)| figure.bounds()));
    let legend = legend(subject.mechanism, bounds, extras, room);
    // Several configurations of one mechanism have one legend.
    let names = |index: usize| if index == 0 || extras.is_moving { legend.clone() } else { Vec::new() };
    let cell = |(index, (figure, heading))| SheetCell {
        heading,
        figure,
        bounds,
        scale,
        legend: names(index),
        faults: Vec::new(),
        dimensions: dimensions.clone(),
    };
    figures.into_iter().enumerate().map(cell).collect()
}

/// The names of the moving links beside their numbers. A moving picture has them only if they fit into one row.
fn legend(mechanism: &Mechanism, [low, high]: [Vec2; 2], extras: Extras, room: Vec2) -> Vec<(LinkId, String)> {
    // A link without points is invisible.
    let seen = mechanism.links().entries().skip(1).filter(|(link, _)| !places(mechanism, *link).is_empty());
    let names: Vec<_> = seen.map(|(link, own)| (link, own.name.clone())).collect();
    let rows = legend_rows(&names, room.x.larger(high.x - low.x)).len();
    if rows > 1 && extras.is_moving { Vec::new() } else { names }
}

/// The figure of a shot, and its heading.
fn figure(
    subject: &DrawnSubject,
    sketch: &Sketch,
    shot: &Shot,
    motion: ShownMotion,
    extras: Extras,
    dimensions: &[Dimension],
    drawings: usize,
) -> (DrawnFigure, Vec<String>) {
    let (laid, scale) = (&shot.laid, sketch.unit);
    let mut picture = Picture::of(sketch, &laid.places, scale);
    for (link, path) in motion.traces {
        picture.draw_trace(path, *link);
    }
    let mut small: Vec<&str> = Vec::new();
    if let Some(series) = motion.series {
        picture.draw_thin(&series.thin);
        small.extend(series.paths.iter().filter(|path| !picture.draw_numbered(path)).map(|path| path.name.as_str()));
    }
    for circle in &laid.reaches {
        picture.draw_reach(circle.centre, circle.radius, circle.toward);
    }
    picture.draw_marks();
    picture.open_wheels();
    for (_, ends) in &laid.gaps {
        picture.draw_gap(*ends);
    }
    if extras.loads {
        picture.draw_loads(&shot.acting);
    }
    picture.draw_dimensions(subject.mechanism, dimensions);
    if extras.is_small {
        return (picture.finish(drawings), Vec::new());
    }
    if extras.is_moving {
        for link in subject.mechanism.links().ids().skip(1) {
            if let Some(local) = super::body::free(subject.mechanism, link, FREE * scale) {
                picture.number_on(link, local);
            }
        }
    } else {
        picture.number_links();
    }
    let is_fixed = |at: &Vec2| {
        subject.mechanism.links()[GROUND].points.iter().any(|point| (point.local / scale - at).norm() < 1e-9)
    };
    let mut names = picture.names(|what| match what {
        Lettering::Point | Lettering::Motor => true,
        Lettering::MassCentre => !extras.is_moving && extras.loads,
        Lettering::Link => false,
    });
    names.retain(|(at, _)| !extras.is_moving || is_fixed(at));
    picture.name(names);
    if extras.loads {
        picture.draw_gravity(subject.gravity);
    }
    let heading = (!small.is_empty()).then(|| sentences::paths_without_numbers(&small.join(", ")));
    // The numbers of the positions lie apart from each other, so less work is enough to place them.
    let share = if motion.series.is_some() { NUMBERED } else { 1 };
    (picture.finish(share * drawings), heading.into_iter().collect())
}

/// All points that the picture must contain (m).
fn extent(subject: &DrawnSubject, shots: &[Shot], motion: ShownMotion) -> Vec<Vec2> {
    let mechanism = subject.mechanism;
    let mut points: Vec<Vec2> = motion.traces.iter().flat_map(|(_, path)| path.iter().copied()).collect();
    points.extend(mechanism.links()[GROUND].points.iter().map(|point| point.local));
    points.extend(motion.series.iter().flat_map(|series| &series.paths).flat_map(|own| own.path.iter().copied()));
    let thin = motion.series.iter().flat_map(|series| &series.thin).map(|(places, _)| places);
    for places in shots.iter().map(|shot| &shot.laid.places).chain(thin) {
        let pose = |link: LinkId| places[link].pose();
        for link in mechanism.links().ids().skip(1) {
            let places = super::body::places(mechanism, link);
            points.extend(pose(link).into_iter().flat_map(|pose| places.iter().map(|&local| pose.point(local))));
        }
        for (index, joint) in mechanism.joints().entries() {
            let Some([guide, _]) = mechanism.guide_and_block(joint) else { continue };
            if let (Some(pose), Some(axis), Some(travel)) =
                (pose(guide.link), joint.axis_on(guide.link), motion.travels.of(index))
            {
                points.extend(travel.map(|way| pose.point(guide.local + axis * way)));
            }
        }
    }
    points.retain(|at| at.iter().all(|part| part.is_finite()));
    let size = points.iter().fold(0.0, |most: f64, at| most.larger(at.norm()));
    if size == 0.0 {
        points.push(Vec2::repeat(mechanism.size()));
    }
    points
}
