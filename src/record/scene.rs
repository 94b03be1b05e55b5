//! The moving mechanism: the positions, the frames and the drawing of each side's links.

use super::guides::{Guide, Strip};
use super::placed::{Placed, column};
use super::recording::Side;
use super::shapes::{Paint, extent, grey, point, pose, stamp, turn, vector};
use foxglove::messages::line_primitive::Type as LineType;
use foxglove::messages::{
    CylinderPrimitive, FrameTransform, FrameTransforms, LinePrimitive, Point3, SceneEntity, SceneUpdate,
    SpherePrimitive, TextPrimitive, TriangleListPrimitive,
};
use linkage::math::statistics::ascending;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, Link, Mechanism, ring};

/// Largest number of frames in a recording, unless it is so long that there would be fewer than [`FRAMES_PER_SECOND`].
const FRAMES: f64 = 400.0;
/// Least number of frames per simulated second, if there are as many samples.
const FRAMES_PER_SECOND: f64 = 50.0;

/// Everything that can be drawn of a recording.
pub struct Scene<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The sides that have positions.
    pub sides: Vec<Placed<'a>>,
    /// Length to which all drawing is proportional (m).
    pub size: f64,
    /// Guides and blocks.
    guides: Vec<Guide>,
}

impl<'a> Scene<'a> {
    /// The scene of the sides that have samples and all positions; `None` if there is no such side.
    pub fn new(mechanism: &'a Mechanism, sides: &[Side<'a>]) -> Option<Self> {
        let placed = |(number, side): (usize, &Side<'a>)| {
            let column = |link: &Link, suffix| column(side.trajectory, &format!("link.{}.{suffix}", link.name));
            let columns = |link| Some([column(link, "angle_rad")?, column(link, "x_m")?, column(link, "y_m")?]);
            Some(Placed {
                name: side.name,
                trajectory: side.trajectory,
                paint: Paint::of(number),
                rows: ascending(side.trajectory.times()),
                links: mechanism.links()[1..].iter().map(columns).collect::<Option<_>>()?,
            })
        };
        let sides: Vec<Placed> = sides
            .iter()
            .enumerate()
            .filter(|(_, side)| !side.trajectory.times().is_empty())
            .filter_map(placed)
            .collect();
        let size = mechanism.size();
        let guides = Guide::all(mechanism, &sides, size);
        (!sides.is_empty()).then_some(Scene { mechanism, sides, size, guides })
    }

    /// Height between the sides in the drawing (m). A viewer's depth test can separate them, but the eye must not: a
    /// visible gap would look like a disagreement.
    pub fn layer(&self) -> f64 {
        0.002 * self.size
    }

    /// Times at which the scene is drawn (s), ascending: a selection from the times of the first side.
    pub fn times(&self) -> Vec<f64> {
        let side = &self.sides[0];
        let time = |&row: &usize| side.trajectory.times()[row];
        let (Some(first), Some(last)) = (side.rows.first().map(time), side.rows.last().map(time)) else {
            return Vec::new();
        };
        let enough = FRAMES.larger(FRAMES_PER_SECOND * (last - first));
        let stride = (side.rows.len() as f64 / enough).ceil().larger(1.0) as usize;
        let mut times: Vec<f64> = side.rows.iter().step_by(stride).map(time).collect();
        if !(side.rows.len() - 1).is_multiple_of(stride) {
            times.push(last);
        }
        times
    }

    /// Frames of all links at a time, all sides in one message: viewers that jump in time use only the last message.
    pub fn frames(&self, time: f64, nanoseconds: u64) -> FrameTransforms {
        let mut transforms = Vec::new();
        for side in &self.sides {
            let row = side.row_at(time);
            for (index, link) in self.mechanism.links().iter().enumerate().skip(1) {
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

    /// The drawing of all links, each in its own frame, and of the ground.
    pub fn links(&self) -> SceneUpdate {
        let mut entities = vec![self.ground()];
        for (number, side) in self.sides.iter().enumerate() {
            for link in 1..self.mechanism.links().len() {
                entities.push(self.link(side, link, number == 0));
            }
        }
        SceneUpdate { deletions: Vec::new(), entities }
    }

    /// Places of a link that are drawn: its points, then its joints that have no named point (m, link frame).
    pub fn places(&self, link: usize) -> Vec<Vec2> {
        let mut places: Vec<Vec2> = self.mechanism.links()[link].points.iter().map(|point| point.local).collect();
        for joint in self.mechanism.joints() {
            let new = joint.on(link).filter(|local| !places.contains(local));
            places.extend(new);
        }
        places
    }

    /// Places of the ground that are drawn as pivots: all except those that only lie on a guide.
    pub fn pivots(&self) -> Vec<Vec2> {
        let joints = |at: Vec2| self.mechanism.joints().iter().filter(move |joint| joint.on(GROUND) == Some(at));
        let pivot = |at: &Vec2| joints(*at).count() == 0 || joints(*at).any(|joint| joint.is_pin());
        self.places(GROUND).into_iter().filter(pivot).collect()
    }

    /// Guides and blocks of a link.
    pub fn strips(&self, link: usize) -> impl Iterator<Item = Strip> + '_ {
        self.guides.iter().flat_map(move |guide| guide.strips(link))
    }

    fn link(&self, side: &Placed, index: usize, lettered: bool) -> SceneEntity {
        let link = &self.mechanism.links()[index];
        let (colour, broad) = (Some(side.paint.colour()), side.paint.broad);
        let z = self.layer() * side.paint.layer;
        let places = self.places(index);
        let (outline, closed) = ring(&places);
        let line = LinePrimitive {
            r#type: if closed { LineType::LineLoop } else { LineType::LineStrip } as i32,
            pose: pose(Vec2::zeros(), z, 0.0),
            thickness: 0.02 * self.size * broad,
            points: outline.iter().map(|&local| point(local, 0.0)).collect(),
            color: colour,
            ..Default::default()
        };
        let strip = |strip: Strip| LinePrimitive {
            r#type: if strip.closed { LineType::LineLoop } else { LineType::LineStrip } as i32,
            thickness: (if strip.closed { 0.012 } else { 0.02 }) * self.size * broad,
            points: strip.points.iter().map(|&local| point(local, 0.0)).collect(),
            ..line.clone()
        };
        let strips: Vec<LinePrimitive> = self.strips(index).map(strip).collect();
        let pins = self.mechanism.joints().iter().filter(|joint| joint.is_pin());
        let is_joint = |local: &Vec2| pins.clone().any(|joint| joint.on(index) == Some(*local));
        let (joints, others): (Vec<Vec2>, Vec<Vec2>) = places.iter().partition(|local| is_joint(local));
        let pin = |&local: &Vec2| CylinderPrimitive {
            pose: pose(local, z, 0.0),
            size: extent(0.04 * self.size * broad.sqrt(), self.layer()),
            bottom_scale: 1.0,
            top_scale: 1.0,
            color: colour,
        };
        let ball = |&local: &Vec2| SpherePrimitive {
            pose: pose(local, z, 0.0),
            size: extent(0.03 * self.size * broad.sqrt(), self.layer()),
            color: colour,
        };
        let letters = link.points.iter().filter(|_| lettered).filter(|letter| self.owner(&letter.name) == index);
        SceneEntity {
            timestamp: stamp(0),
            frame_id: format!("{}/{}", side.name, link.name),
            id: format!("{}/{}", side.name, link.name),
            frame_locked: true,
            lines: (outline.len() > 1).then_some(line).into_iter().chain(strips).collect(),
            cylinders: joints.iter().map(pin).collect(),
            spheres: others.iter().map(ball).collect(),
            texts: letters.map(|letter| self.text(&letter.name, letter.local)).collect(),
            ..Default::default()
        }
    }

    /// The first link that has a point of this name; only this link shows the name.
    fn owner(&self, name: &str) -> usize {
        let carries = |link: &Link| link.points.iter().any(|point| point.name == name);
        self.mechanism.links().iter().position(carries).unwrap_or(GROUND)
    }

    fn text(&self, text: &str, at: Vec2) -> TextPrimitive {
        TextPrimitive {
            pose: pose(at, 0.06 * self.size, 0.0),
            billboard: true,
            font_size: 14.0,
            scale_invariant: true,
            color: Some(grey()),
            text: text.into(),
        }
    }

    /// Pivots as triangles below their points, as in textbooks, and the rails of fixed guides.
    fn ground(&self) -> SceneEntity {
        let (half, down) = (0.03 * self.size, -0.05 * self.size);
        let below = -0.01 * self.size;
        let places = self.pivots();
        let mut corners: Vec<Point3> = Vec::new();
        let line = |ends: [Vec2; 2]| LinePrimitive {
            thickness: 0.008 * self.size,
            points: ends.iter().map(|&end| point(end, below)).collect(),
            color: Some(grey()),
            ..Default::default()
        };
        let mut lines = Vec::new();
        for &at in &places {
            let [left, right] = [-half, half].map(|x| at + Vec2::new(x, down));
            corners.extend([at, left, right].map(|corner| point(corner, below)));
            lines.push(line([left - Vec2::new(half, 0.0), right + Vec2::new(half, 0.0)]));
        }
        let rails = self.strips(GROUND).filter_map(|strip| Some([*strip.points.first()?, *strip.points.last()?]));
        lines.extend(rails.map(line));
        let points = &self.mechanism.links()[GROUND].points;
        SceneEntity {
            timestamp: stamp(0),
            frame_id: "world".into(),
            id: "ground".into(),
            frame_locked: true,
            triangles: vec![TriangleListPrimitive { points: corners, color: Some(grey()), ..Default::default() }],
            lines,
            texts: points.iter().map(|p| self.text(&p.name, p.local + Vec2::new(half, down))).collect(),
            ..Default::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_points_off_a_line_close_and_three_on_it_do_not() {
        let places = |y| [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(1.0, y)];
        assert!(ring(&places(1.0)).1);
        let (bar, closed) = ring(&places(0.0));
        assert!(!closed);
        let xs: Vec<f64> = bar.iter().map(|place| place.x).collect();
        assert!(xs.is_sorted() || xs.iter().rev().is_sorted(), "{xs:?}");
        assert!(ring(&[]).0.is_empty());
    }
}
