//! Reactions as arrows: the force of each joint's first link on its second link, drawn at the joint.

use super::scene::{PlacedSide, ViewerScene, column};
use super::shapes::{colour, pose, short, stamp};
use crate::viewers::{ArrowPrimitive, SceneEntity, SceneUpdate};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::Joint;

/// Length of the longest arrow divided by the mechanism's size.
const LONGEST: f64 = 0.4;
/// Length of the shortest arrow divided by the mechanism's size. Viewers fail on arrows of zero length.
const SHORTEST: f64 = 0.01;

/// The arrows of all sides that have reactions.
pub struct Forces<'a> {
    scene: &'a ViewerScene<'a>,
    /// Sides that have reactions, each with the components of each joint's force.
    sides: Vec<(&'a PlacedSide<'a>, Vec<[&'a [f64]; 2]>)>,
    /// Length of an arrow per newton (m/N).
    pub scale: f64,
}

impl<'a> Forces<'a> {
    /// The arrows of a scene; `None` if no side has reactions.
    pub fn new(scene: &'a ViewerScene<'a>) -> Option<Self> {
        let of_side = |side: &'a PlacedSide<'a>| {
            let column = |joint: &Joint, suffix| column(side.trajectory, &format!("joint.{}.{suffix}", joint.name));
            let columns = |joint| Some([column(joint, "fx_N")?, column(joint, "fy_N")?]);
            Some((side, scene.mechanism.joints().iter().map(columns).collect::<Option<Vec<_>>>()?))
        };
        let sides: Vec<_> = scene.sides.iter().filter_map(of_side).collect();
        let forces = sides.iter().flat_map(|(_, joints)| joints);
        let sizes = forces.flat_map(|[x, y]| x.iter().zip(*y).map(|(x, y)| x.hypot(*y)));
        let largest = sizes.filter(|size| size.is_finite()).fold(0.0, f64::larger);
        let scale = if largest > 0.0 { LONGEST * scene.size / largest } else { 0.0 };
        let scale = if scale.is_finite() { scale } else { 0.0 };
        (!sides.is_empty()).then_some(Forces { scene, sides, scale })
    }

    /// All arrows at one time. The identifier of an arrow is the same at all times.
    pub fn arrows(&self, time: f64, nanoseconds: u64) -> SceneUpdate {
        let mechanism = self.scene.mechanism;
        let mut entities = Vec::new();
        for (side, joints) in &self.sides {
            let row = side.row_at(time);
            for (joint, [x, y]) in mechanism.joints().iter().zip(joints) {
                let at = side.pose(mechanism, joint.second.link, row).point(joint.second.local);
                entities.push(SceneEntity {
                    timestamp: stamp(nanoseconds),
                    frame_id: "world".into(),
                    id: format!("{}/{}", side.name, joint.name),
                    arrows: vec![self.arrow(side, at, Vec2::new(x[row], y[row]))],
                    ..Default::default()
                });
            }
        }
        SceneUpdate { entities }
    }

    fn arrow(&self, side: &PlacedSide, at: Vec2, force: Vec2) -> ArrowPrimitive {
        let size = self.scene.size;
        let length = (self.scale * force.norm()).larger(SHORTEST * size);
        let head = (0.3 * length).smaller(0.06 * size);
        // Arrows are round bodies. A thin arrow at the height of a thick arrow would be inside it, so it lies higher.
        let (broad, z) = (side.paint.broad.sqrt(), (8.0 + 4.0 * side.paint.layer) * self.scene.layer());
        let mut color = colour(side.paint.rgba);
        // Arrows are more transparent than the links below them.
        color.a = 0.8;
        ArrowPrimitive {
            pose: pose(at, z, force.y.atan2(force.x)),
            shaft_length: short(length - head),
            shaft_diameter: 0.014 * size * broad,
            head_length: short(head),
            head_diameter: 0.035 * size * broad,
            color: Some(color),
        }
    }
}
