//! The links as point clouds, for viewers that draw no scenes.

use super::scene::Scene;
use super::shapes::{GREY, pose, stamp};
use foxglove::messages::packed_element_field::NumericType;
use foxglove::messages::{PackedElementField, PointCloud};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, ring};

/// Points per mechanism size along a segment of the first side; closer points would only fill the disk.
const POINTS: f64 = 64.0;
/// Grid steps per mechanism size to which points are rounded: round numbers compress well, and the rounding is
/// invisible.
const STEPS: f64 = 1024.0;
/// Bytes of one point: three single precision coordinates and four bytes of colour.
const STRIDE: u32 = 16;

/// The outlines of all sides' links as points in their own frames. They are made once and placed at each time.
pub struct Outline<'a> {
    scene: &'a Scene<'a>,
    /// Points of each link, in its frame.
    links: Vec<Vec<Vec2>>,
    quantum: f64,
}

impl<'a> Outline<'a> {
    /// The outlines of a scene.
    pub fn new(scene: &'a Scene<'a>) -> Self {
        let links = (0..scene.mechanism.links().len()).map(|link| of_link(scene, link)).collect();
        // A power of two, so that the rounded numbers end in zeros.
        let quantum = (scene.size / STEPS).log2().floor().exp2();
        Outline { scene, links, quantum }
    }

    /// The point cloud at a time.
    pub fn cloud(&self, time: f64, nanoseconds: u64) -> PointCloud {
        let mut data: Vec<u8> = Vec::new();
        let mut put = |at: Vec2, z: f64, rgba: [u8; 4]| {
            for value in [at.x, at.y] {
                data.extend((((value / self.quantum).round() * self.quantum) as f32).to_le_bytes());
            }
            data.extend((z as f32).to_le_bytes());
            data.extend(rgba);
        };
        for &at in &self.links[GROUND] {
            put(at, 0.0, GREY);
        }
        for (number, side) in self.scene.sides.iter().enumerate() {
            let row = side.row_at(time);
            // Later sides are drawn as dots over the line of the first side, so that both are visible where they agree.
            let (stride, z) = (if number == 0 { 1 } else { 4 }, self.scene.layer() * side.paint.layer);
            for (link, places) in self.links.iter().enumerate().skip(1) {
                let pose = side.pose(self.scene.mechanism, link, row);
                for &local in places.iter().step_by(stride) {
                    put(pose.point(local), z, side.paint.rgba);
                }
            }
        }
        PointCloud {
            timestamp: stamp(nanoseconds),
            frame_id: "world".into(),
            pose: pose(Vec2::zeros(), 0.0, 0.0),
            point_stride: STRIDE,
            fields: fields(),
            data: data.into(),
        }
    }
}

fn fields() -> Vec<PackedElementField> {
    let coordinates = ["x", "y", "z"].map(|name| (name, NumericType::Float32));
    let colours = ["red", "green", "blue", "alpha"].map(|name| (name, NumericType::Uint8));
    let mut offset = 0;
    let mut fields = Vec::new();
    for (name, kind) in coordinates.into_iter().chain(colours) {
        fields.push(PackedElementField { name: name.into(), offset, r#type: kind as i32 });
        offset += if kind == NumericType::Float32 { 4 } else { 1 };
    }
    debug_assert_eq!(offset, STRIDE);
    fields
}

/// Points along a link's outline, its guides and its blocks. The ground has only its pivots and rails.
fn of_link(scene: &Scene, link: usize) -> Vec<Vec2> {
    let mut points = if link == GROUND {
        ring(&scene.pivots()).0
    } else {
        let (corners, closed) = ring(&scene.places(link));
        along(&corners, closed, scene.size)
    };
    points.extend(scene.strips(link).flat_map(|strip| along(&strip.points, strip.closed, scene.size)));
    points
}

/// Points along a line; a line with one corner is that corner.
fn along(corners: &[Vec2], closed: bool, size: f64) -> Vec<Vec2> {
    let segments = if closed { corners.len() } else { corners.len().saturating_sub(1) };
    let mut points = Vec::new();
    for start in 0..segments {
        let (a, b) = (corners[start], corners[(start + 1) % corners.len()]);
        let count = (POINTS * (b - a).norm() / size).ceil().larger(2.0);
        points.extend((0..count as usize).map(|k| a + (b - a) * (k as f64 / count)));
    }
    points.extend(if closed { None } else { corners.last().copied() });
    points
}
