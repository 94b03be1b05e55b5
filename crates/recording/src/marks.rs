//! The marks of a sketch as the primitives of a scene.

use super::shapes::{colour, extent, pose, vector};
use crate::viewers::{
    Color, CylinderPrimitive, LinePrimitive, LineType, SceneEntity, TextPrimitive, TriangleListPrimitive,
};
use drawing::{Fill, Mark, MarkRole, MarkShape};
use linkage::math::Vec2;

/// Opacity of filled areas, out of 255. Shapes beneath these areas remain visible.
const TINT: u8 = 70;
/// The holes in pins: colour, which suits light and dark backgrounds, and radius divided by the radius of the pin.
const HOLE: ([u8; 4], f64) = ([40, 40, 40, 255], 0.5);

/// How marks are drawn.
#[derive(Clone, Copy)]
pub struct Brush {
    /// The sketch's unit (m).
    pub unit: f64,
    /// Red, green, blue, opacity.
    pub rgba: [u8; 4],
    /// Thickness of this side's lines divided by the thickness of the first side's lines.
    pub broad: f64,
    /// Height above the plane of motion (m).
    pub z: f64,
    /// Height between two layers of marks (m).
    pub step: f64,
}

impl Brush {
    /// Adds a mark to an entity. Mass centres are left out, because they look like joints in a moving picture.
    pub fn put(&self, mark: &Mark, entity: &mut SceneEntity) {
        if matches!(mark.role, MarkRole::MassCentre | MarkRole::MassQuarter) {
            return;
        }
        let look = mark.role.look();
        let z = self.z + self.step * f64::from(look.layer as u8);
        if let (MarkRole::Pin, &MarkShape::Circle { centre, radius }) = (mark.role, &mark.shape) {
            let radius = radius * self.broad.sqrt();
            let disc = |z, radius: f64, rgba| CylinderPrimitive {
                pose: pose(centre, z, 0.0),
                size: extent(2.0 * radius, self.step),
                bottom_scale: 1.0,
                top_scale: 1.0,
                color: Some(colour(rgba)),
            };
            entity.cylinders.push(disc(z, radius, self.rgba));
            entity.cylinders.push(disc(z + self.step, HOLE.1 * radius, HOLE.0));
            return;
        }
        let (outline, closed) = (mark.shape.points(), mark.shape.is_closed());
        // Only the first side is filled. An area of a later side would hide the first side, or be hidden by it.
        if closed && look.fill != Fill::None && self.broad >= 1.0 {
            let opacity = if look.fill == Fill::Ink { self.rgba[3] } else { TINT };
            let [red, green, blue, _] = self.rgba;
            entity.triangles.push(TriangleListPrimitive {
                pose: pose(Vec2::zeros(), z - 0.5 * self.step, 0.0),
                points: fan(&outline).into_iter().map(|corner| vector(corner, 0.0)).collect(),
                color: Some(colour([red, green, blue, opacity])),
            });
        }
        entity.lines.push(LinePrimitive {
            r#type: if closed { LineType::LineLoop } else { LineType::LineStrip } as i32,
            pose: pose(Vec2::zeros(), z, 0.0),
            thickness: look.width * self.unit * self.broad,
            points: outline.into_iter().map(|corner| vector(corner, 0.0)).collect(),
            color: Some(colour(self.rgba)),
            ..Default::default()
        });
    }
}

/// Triangles from the centre of a polygon to its sides.
/// These triangles cover exactly the polygon, because every polygon of the sketch is star-shaped about its centre.
fn fan(corners: &[Vec2]) -> Vec<Vec2> {
    let middle = corners.iter().sum::<Vec2>() / corners.len().max(1) as f64;
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).flat_map(|(&from, &to)| [middle, from, to]).collect()
}

/// A name at a position, at the height `z`. The name is always upright and has the same size on the screen.
pub fn letter(text: &str, at: Vec2, z: f64) -> TextPrimitive {
    TextPrimitive {
        pose: pose(at, z, 0.0),
        billboard: true,
        font_size: 18.0,
        scale_invariant: true,
        // Viewers put a dark background behind light letters, so white letters are always readable.
        color: Some(Color { r: 1.0, g: 1.0, b: 1.0, a: 1.0 }),
        text: text.into(),
    }
}
