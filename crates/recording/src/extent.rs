//! Where a moving scene is, over all of its frames.

use crate::viewers::{FrameTransforms, Point3, Pose, SceneEntity, SceneUpdate};
use linkage::math::{KeepNan, Vec2, rotated, unit};

/// Corners of all that a scene draws, over all of its frames (m).
pub fn corners(links: &SceneUpdate, frames: impl Iterator<Item = FrameTransforms>) -> [Vec2; 2] {
    let mut corners = [Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)];
    let mut take = |at: Vec2| {
        corners = [
            Vec2::new(corners[0].x.smaller(at.x), corners[0].y.smaller(at.y)),
            Vec2::new(corners[1].x.larger(at.x), corners[1].y.larger(at.y)),
        ];
    };
    let reach: Vec<(&str, Vec<Vec2>)> =
        links.entities.iter().map(|entity| (entity.frame_id.as_str(), places(entity))).collect();
    for (_, places) in reach.iter().filter(|(frame, _)| *frame == "world") {
        places.iter().for_each(|&at| take(at));
    }
    for frame in frames.flat_map(|frames| frames.transforms) {
        let (at, turn) = (frame.translation.unwrap_or_default(), frame.rotation.unwrap_or_default());
        let direction = unit(2.0 * turn.z.atan2(turn.w));
        for (_, places) in reach.iter().filter(|(name, _)| *name == frame.child_frame_id) {
            places.iter().for_each(|&local| take(Vec2::new(at.x, at.y) + rotated(local, direction)));
        }
    }
    corners
}

/// Places of what an entity draws, in its frame.
fn places(entity: &SceneEntity) -> Vec<Vec2> {
    let flat = |point: &Point3| Vec2::new(point.x, point.y);
    let lines = entity.lines.iter().flat_map(|line| &line.points).map(flat);
    let areas = entity.triangles.iter().flat_map(|area| &area.points).map(flat);
    lines.chain(areas).chain(entity.cylinders.iter().map(|pin| placed(pin.pose.as_ref()).0)).collect()
}

/// Place and angle of a pose in the plane.
pub fn placed(pose: Option<&Pose>) -> (Vec2, f64) {
    let (at, turn) = pose.map(|pose| (pose.position, pose.orientation)).unwrap_or_default();
    let (at, turn) = (at.unwrap_or_default(), turn.unwrap_or_default());
    (Vec2::new(at.x, at.y), 2.0 * turn.z.atan2(turn.w))
}
