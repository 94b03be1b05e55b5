//! Small constructors of the viewers' messages, and the colours of the sides.

use crate::viewers::{Color, Pose, Quaternion, Vector3};
use prost_types::Timestamp;

use linkage::math::Vec2;

/// Paint of one side.
/// The sides are drawn on top of each other.
/// The first side is broad and pale. Each later side is in front of the previous side and, up to the fourth, thinner.
/// Where two sides agree, the thinner line lies on the broader line and both colours are visible. Where the sides
/// differ, the lines lie apart.
#[derive(Clone, Copy)]
pub struct SidePaint {
    /// Red, green, blue, opacity, each 0 to 255.
    pub rgba: [u8; 4],
    /// Thickness of this side's lines divided by the thickness of the first side's lines.
    pub broad: f64,
    /// Height above the plane of motion, in layers.
    pub layer: f64,
}

impl SidePaint {
    /// Paint of the side with number `side`. The colours are those of Okabe and Ito, which colour-blind people can
    /// distinguish.
    pub fn of(side: usize) -> SidePaint {
        const COLOURS: [[u8; 3]; 4] = [[86, 180, 233], [230, 120, 0], [0, 158, 115], [204, 121, 167]];
        let [red, green, blue] = COLOURS[side % COLOURS.len()];
        SidePaint { rgba: [red, green, blue, 255], broad: 0.4f64.powi(side.min(3) as i32), layer: side as f64 }
    }
}

/// A colour in the form that messages need.
pub fn colour(rgba: [u8; 4]) -> Color {
    let [r, g, b, a] = rgba.map(|part| f64::from(part) / 255.0);
    Color { r, g, b, a }
}

/// Red, green, blue and opacity of a message's colour, each 0 to 255; the ground's colour for `None`.
pub fn rgba(colour: Option<Color>) -> [u8; 4] {
    colour.map_or(GREY, |Color { r, g, b, a }| [r, g, b, a].map(|part| (part * 255.0).round() as u8))
}

/// Colour of the ground: readable on black and on white.
pub const GREY: [u8; 4] = [128, 128, 128, 255];

/// Log time as a time stamp of the viewers.
pub fn stamp(nanoseconds: u64) -> Option<Timestamp> {
    let seconds = u32::try_from(nanoseconds / 1_000_000_000).unwrap_or(u32::MAX);
    Some(Timestamp { seconds: seconds.into(), nanos: (nanoseconds % 1_000_000_000) as i32 })
}

/// Rounds to single precision, which is enough for pictures.
/// The last bits of a rounded number are zero, so the numbers compress to half the size.
pub fn short(value: f64) -> f64 {
    f64::from(value as f32)
}

/// A vector, or a point, at height `z`.
pub fn vector(at: Vec2, z: f64) -> Vector3 {
    Vector3 { x: short(at.x), y: short(at.y), z: short(z) }
}

/// Extents of a box that has a square base in the plane.
pub fn extent(width: f64, height: f64) -> Option<Vector3> {
    Some(Vector3 { x: short(width), y: short(width), z: short(height) })
}

/// Rotation about z by `angle` (rad).
pub fn turn(angle: f64) -> Quaternion {
    let (sin, cos) = (angle / 2.0).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z: short(sin), w: short(cos) }
}

/// Pose in the plane, at height `z`.
pub fn pose(at: Vec2, z: f64, angle: f64) -> Option<Pose> {
    Some(Pose { position: Some(vector(at, z)), orientation: Some(turn(angle)) })
}
