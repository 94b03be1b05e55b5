//! The moving mechanism: the positions, the frames and the drawing of each side's links.

use super::marks::{Brush, letter};
use super::recording::RecordedSide;
use super::shapes::{GREY, SidePaint, stamp, turn, vector};
use crate::viewers::{FrameTransform, FrameTransforms, SceneEntity, SceneUpdate};
use drawing::{Lettering, Sketch, Travels};
use linkage::math::statistics::ascending;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, Link, LinkId, LinkPose, Mechanism};
use linkage::trajectory::{Channel, Trajectory};

/// Upper limit of the number of frames. In a long recording, [`FRAMES_PER_SECOND`] allows more frames.
const FRAMES: f64 = 400.0;
/// Upper limit of the number of frames per second of log time. If there are enough samples, the number of frames is at
/// least half of the limit.
const FRAMES_PER_SECOND: f64 = 50.0;

/// Everything that can be drawn of a recording.
pub struct ViewerScene<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The sides that have positions.
    pub sides: Vec<PlacedSide<'a>>,
    /// Length to which all dimensions of the drawing are proportional (m).
    pub size: f64,
    /// The marks and labels of the mechanism.
    sketch: Sketch,
}

impl<'a> ViewerScene<'a> {
    /// The scene of all sides that have samples and the positions of all links; `None` if there is no such side.
    pub fn new(mechanism: &'a Mechanism, sides: &[RecordedSide<'a>]) -> Option<Self> {
        let placed = |(number, side): (usize, &RecordedSide<'a>)| {
            let column = |link: &Link, suffix| column(side.trajectory, &format!("link.{}.{suffix}", link.name));
            let columns = |link| Some([column(link, "angle_rad")?, column(link, "x_m")?, column(link, "y_m")?]);
            Some(PlacedSide {
                name: side.name,
                trajectory: side.trajectory,
                paint: SidePaint::of(number),
                rows: ascending(side.trajectory.times()),
                links: mechanism.links()[1..].iter().map(columns).collect::<Option<_>>()?,
            })
        };
        let sides: Vec<PlacedSide> = sides
            .iter()
            .enumerate()
            .filter(|(_, side)| !side.trajectory.times().is_empty())
            .filter_map(placed)
            .collect();
        let size = mechanism.size();
        let mut travels = Travels::none(mechanism);
        for side in sides.iter().filter(|_| mechanism.joints().iter().any(|joint| !joint.is_pin())) {
            for row in 0..side.trajectory.times().len() {
                travels.take_in(mechanism, |link, local| Some(side.pose(mechanism, link, row).point(local)));
            }
        }
        let sketch = Sketch::of(mechanism, &travels, drawing::unit(mechanism));
        (!sides.is_empty()).then_some(ViewerScene { mechanism, sides, size, sketch })
    }

    /// Distance, perpendicular to the plane of motion, between the pictures of two successive sides (m).
    /// The distance is enough for a viewer's depth test but too small to be seen. A visible gap would look like a
    /// disagreement.
    pub fn layer(&self) -> f64 {
        0.002 * self.size
    }

    /// Times of the frames (s), ascending.
    /// The frame times are selected from the times of the first side, for playback `slow` times slower than the
    /// simulation.
    pub fn times(&self, slow: f64) -> Vec<f64> {
        let side = &self.sides[0];
        let time = |&row: &usize| side.trajectory.times()[row];
        let (Some(first), Some(last)) = (side.rows.first().map(time), side.rows.last().map(time)) else {
            return Vec::new();
        };
        let enough = FRAMES.larger(FRAMES_PER_SECOND * slow * (last - first));
        let stride = (side.rows.len() as f64 / enough).ceil().larger(1.0) as usize;
        let mut times: Vec<f64> = side.rows.iter().step_by(stride).map(time).collect();
        if !(side.rows.len() - 1).is_multiple_of(stride) {
            times.push(last);
        }
        times
    }

    /// Coordinate frames of all links at a time.
    /// All sides are in one message, because a viewer that jumps in time uses only the last message.
    pub fn frames(&self, time: f64, nanoseconds: u64) -> FrameTransforms {
        let mut transforms = Vec::new();
        for side in &self.sides {
            let row = side.row_at(time);
            for (index, link) in self.mechanism.links().entries().skip(1) {
                let at = side.pose(self.mechanism, index, row);
                transforms.push(FrameTransform {
                    timestamp: stamp(nanoseconds),
                    parent_frame_id: "world".into(),
                    child_frame_id: format!("{}/{}", side.name, link.name),
                    translation: Some(vector(at.origin, 0.0)),
                    rotation: Some(turn(at.angle)),
                });
            }
        }
        FrameTransforms { transforms }
    }

    /// The drawing of all links, each in its frame, and of the ground.
    pub fn links(&self) -> SceneUpdate {
        let brush = Brush { unit: self.sketch.unit, rgba: GREY, broad: 1.0, z: 0.0, step: 0.1 * self.layer() };
        let mut entities = vec![self.lettered(self.entity("world", "ground", &brush, GROUND), GROUND)];
        for (number, side) in self.sides.iter().enumerate() {
            let SidePaint { rgba, broad, layer } = side.paint;
            let brush = Brush { rgba, broad, z: self.layer() * (1.0 + layer), ..brush };
            for (index, link) in self.mechanism.links().entries().skip(1) {
                let name = format!("{}/{}", side.name, link.name);
                let entity = self.entity(&name, &name, &brush, index);
                entities.push(if number == 0 { self.lettered(entity, index) } else { entity });
            }
        }
        SceneUpdate { entities }
    }

    /// The marks of a link in its frame.
    fn entity(&self, frame: &str, id: &str, brush: &Brush, link: LinkId) -> SceneEntity {
        let mut entity = SceneEntity {
            timestamp: stamp(0),
            frame_id: frame.into(),
            id: id.into(),
            frame_locked: true,
            ..Default::default()
        };
        for (_, mark) in self.sketch.in_order().into_iter().filter(|&(of, _)| of == link) {
            brush.put(mark, &mut entity);
        }
        entity
    }

    /// The entity with the names of the link's points.
    fn lettered(&self, mut entity: SceneEntity, link: LinkId) -> SceneEntity {
        // The names of ground points are written below the points, where no link passes.
        let aside = if link == GROUND { Vec2::new(0.03, -0.05) * self.size } else { Vec2::zeros() };
        let own = |names, at| names == Lettering::Point && at == link;
        let labels = self.sketch.labels.iter().filter(|label| own(label.names, label.at.link));
        entity.texts = labels.map(|label| letter(&label.text, label.at.local + aside, 0.06 * self.size)).collect();
        entity
    }
}

/// A side with the positions of its links.
pub struct PlacedSide<'a> {
    /// Name of the side.
    pub name: &'a str,
    /// Values of the side.
    pub trajectory: &'a Trajectory,
    /// Colour, thickness and height of the side in drawings.
    pub paint: SidePaint,
    /// Rows in ascending order of time.
    rows: Vec<usize>,
    /// Columns for each moving link: angle and coordinates of the mass centre.
    links: Vec<[&'a [f64]; 3]>,
}

impl PlacedSide<'_> {
    /// Row of the last sample at or before `time`. If all samples are later than `time`, the row of the first sample is
    /// returned.
    pub fn row_at(&self, time: f64) -> usize {
        let times = self.trajectory.times();
        let after = self.rows.partition_point(|&row| times[row] <= time);
        self.rows[after.max(1) - 1]
    }

    /// Pose of a link's frame, from the mass centre in the trajectory.
    pub fn pose(&self, mechanism: &Mechanism, link: LinkId, row: usize) -> LinkPose {
        if link == GROUND {
            return LinkPose::GROUND;
        }
        let [angle, x, y] = self.links[link.index() - 1].map(|column| column[row]);
        LinkPose::through(mechanism.links()[link].mass_centre, Vec2::new(x, y), angle)
    }
}

/// Column of the channel called `name`, if the trajectory has it.
pub fn column<'a>(trajectory: &'a Trajectory, name: &str) -> Option<&'a [f64]> {
    trajectory.column(&Channel::named(name)?)
}
