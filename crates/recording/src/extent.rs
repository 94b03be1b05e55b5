//! Extent of a moving scene over all of its frames.

use crate::viewers::{FrameTransform, FrameTransforms, Pose, SceneEntity, SceneUpdate, Vector3};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::LinkPose;

/// Lower left and upper right corner of all lines, areas and cylinders of a scene, over all of its frames (m).
pub fn corners<'a>(links: &SceneUpdate, frames: impl Iterator<Item = &'a FrameTransforms>) -> [Vec2; 2] {
    let mut corners = [Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)];
    let mut take = |at: Vec2| {
        let [low, high] = corners;
        corners = [low.zip_map(&at, f64::smaller), high.zip_map(&at, f64::larger)];
    };
    let reach: Vec<(&str, Vec<Vec2>)> =
        links.entities.iter().map(|entity| (entity.frame_id.as_str(), places(entity))).collect();
    let still = ("world", LinkPose::GROUND);
    let moving =
        frames.flat_map(|frames| &frames.transforms).map(|frame| (frame.child_frame_id.as_str(), frame.pose()));
    for (frame, pose) in std::iter::once(still).chain(moving) {
        for (_, places) in reach.iter().filter(|(name, _)| *name == frame) {
            places.iter().for_each(|&local| take(pose.point(local)));
        }
    }
    corners
}

/// Positions of the parts of an entity, in its frame.
fn places(entity: &SceneEntity) -> Vec<Vec2> {
    let flat = |point: &Vector3| Vec2::new(point.x, point.y);
    let lines = entity.lines.iter().flat_map(|line| &line.points).map(flat);
    let areas = entity.triangles.iter().flat_map(|area| &area.points).map(flat);
    lines.chain(areas).chain(entity.cylinders.iter().map(|pin| placed(pin.pose).origin)).collect()
}

/// Position and angle of a pose in the plane.
pub fn placed(pose: Option<Pose>) -> LinkPose {
    let Pose { position, orientation } = pose.unwrap_or_default();
    let (at, turn) = (position.unwrap_or_default(), orientation.unwrap_or_default());
    LinkPose { origin: Vec2::new(at.x, at.y), angle: 2.0 * turn.z.atan2(turn.w) }
}

impl FrameTransform {
    /// Position and angle of the frame in the plane.
    pub fn pose(&self) -> LinkPose {
        placed(Some(Pose { position: self.translation, orientation: self.rotation }))
    }
}
