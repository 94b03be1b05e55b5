//! Pose of every link at one instant.

use super::{Joint, JointSide, Mechanism};
use crate::input::Input;
use crate::math::{KeepNan, Motion, Vec2, cross, rotated, unit};
use crate::mechanism::{LinkId, PerLink};

/// Pose of one link's frame in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct LinkPose {
    /// World position of the frame's origin (m).
    pub origin: Vec2,
    /// Angle of the frame's x axis, counter-clockwise from world +x (rad).
    pub angle: f64,
}

impl LinkPose {
    /// Pose of the ground: its frame coincides with the world frame.
    pub const GROUND: LinkPose = LinkPose { origin: Vec2::new(0.0, 0.0), angle: 0.0 };

    /// Pose of a link, taken from its motion. The angle is between -pi and pi.
    pub fn of(motion: &Motion) -> LinkPose {
        LinkPose { origin: motion.origin, angle: motion.direction.y.atan2(motion.direction.x) }
    }

    /// The pose at `angle` that puts the body point `local` at the world point `at`.
    pub fn through(local: Vec2, at: Vec2, angle: f64) -> Self {
        LinkPose { origin: at - rotated(unit(angle), local), angle }
    }

    /// The pose that puts the body points `local_a` and `local_b` at two world points.
    /// The distance between the world points must equal the distance between the body points.
    pub fn between(local_a: Vec2, local_b: Vec2, a: Vec2, b: Vec2) -> Self {
        let (local, world) = (local_b - local_a, b - a);
        LinkPose::through(local_a, a, cross(local, world).atan2(local.dot(&world)))
    }

    /// World position of the body point `local` (m).
    #[must_use]
    pub fn point(&self, local: Vec2) -> Vec2 {
        self.origin + rotated(unit(self.angle), local)
    }
}

impl Joint {
    /// Pose of the driven `link` for a given coordinate of the drive at this joint.
    /// `link` is one of the joint's two links. `base` is the pose of the joint's other link.
    /// `coordinate` is the coordinate of `input`, as in [`Drive::coordinate`](crate::drive::Drive::coordinate).
    pub fn driven(&self, link: LinkId, base: &LinkPose, input: Input, coordinate: f64) -> LinkPose {
        let local = self.on(link).expect("the driven joint is on the driving link");
        let other = self.other(link);
        let place = base.point(other.local);
        let signed = if self.second.link == link { coordinate } else { -coordinate };
        match input {
            Input::Angle => LinkPose::through(local, place, coordinate),
            Input::Turn => LinkPose::through(local, place, base.angle + signed),
            Input::Slide => {
                let [own, guide] = [link, other.link].map(|on| self.axis_on(on).expect("the joint slides"));
                let turn = cross(own, guide).atan2(own.dot(&guide));
                LinkPose::through(local, place + rotated(unit(base.angle), guide) * signed, base.angle + turn)
            }
        }
    }

    /// Coordinate of `input` in a pose, as in [`Drive::coordinate`](crate::drive::Drive::coordinate).
    /// `link` is the driven link. An angle as coordinate includes whole turns, as the angles in `pose` do.
    #[must_use]
    pub fn coordinate(&self, link: LinkId, input: Input, pose: &Pose) -> f64 {
        let [first, second] = [self.first, self.second].map(|side| pose.0[side.link]);
        match input {
            Input::Angle => pose.0[link].angle,
            Input::Turn => second.angle - first.angle,
            Input::Slide => {
                let axis = self.axis_on(self.first.link).expect("the joint slides");
                let gap = second.point(self.second.local) - first.point(self.first.local);
                rotated(unit(first.angle), axis).dot(&gap)
            }
        }
    }
}

/// Pose of the whole mechanism: one entry per link, in the mechanism's order.
/// The entry of the ground is [`LinkPose::GROUND`].
#[derive(Clone, Debug, PartialEq)]
pub struct Pose(pub PerLink<LinkPose>);

impl Pose {
    /// Pose of the links, taken from their motions. The angles are between -pi and pi.
    #[must_use]
    pub fn of(motions: &[Motion]) -> Pose {
        Pose(motions.iter().map(LinkPose::of).collect())
    }

    /// Motions of all links, with the frames of this pose and all rates zero.
    #[must_use]
    pub fn motions(&self) -> Vec<Motion> {
        let motion = |pose: &LinkPose| Motion { origin: pose.origin, direction: unit(pose.angle), ..Motion::REST };
        self.0.iter().map(motion).collect()
    }

    /// Largest opening of any joint (m): see [`Joint::opening`]. The sine of an opening angle is multiplied by the
    /// mechanism's size.
    #[must_use]
    pub fn closure(&self, mechanism: &Mechanism) -> f64 {
        let opening = |joint: &Joint| {
            let sides = [joint.first, joint.second];
            let places = sides.map(|side| self.0[side.link].point(side.local));
            let (distance, turn) = joint.opening(places, sides.map(|side| unit(self.0[side.link].angle)));
            distance.larger(turn * mechanism.size())
        };
        mechanism.joints().iter().map(opening).fold(0.0, f64::larger)
    }
}

/// A named point of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct SidePoint {
    /// The point's name.
    pub name: String,
    /// The link, and the position of the point on it.
    pub side: JointSide,
}
