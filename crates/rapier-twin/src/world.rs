//! A mechanism as a Rapier world. The interface is independent of build and precision.
//! See docs/numerics/twins.md.

use std::f64::consts::TAU;

use super::tree::SpanningTree;
use linkage::drive::Wrench;
use linkage::math::{KeepNan, Vec2, cross, rotated};
use linkage::mechanism::{Joint, JointId, JointSide, LinkId, LinkPose, TransmissionId};

/// A link's angle in the form in which the engine stores it (rad, counter-clockwise positive).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinkAngle {
    /// The angle itself, including full turns.
    /// For a link of the tree, the angle is the sum of the joint coordinates from the ground to the link.
    Whole(f64),
    /// Full turns (rad), to be added to the angle of the link's direction, which is between -pi and pi.
    /// A separate body has a direction only; the arc tangent is computed on demand.
    Turns(f64),
}

/// Frame of a link in the engine after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkFrame {
    /// World position of the frame's origin (m).
    pub origin: Vec2,
    /// Unit vector of the frame's x axis: (cos, sin) of the frame's angle.
    pub direction: Vec2,
    /// Angle of the frame.
    pub angle: LinkAngle,
}

impl LinkFrame {
    /// The ground's frame.
    pub const GROUND: LinkFrame =
        LinkFrame { origin: Vec2::new(0.0, 0.0), direction: Vec2::new(1.0, 0.0), angle: LinkAngle::Whole(0.0) };

    /// If the chord between two directions is shorter than this constant, its length is used as the rotation (rad).
    /// The relative error of the chord is the square of the rotation divided by 24.
    const SMALL: f64 = 0.1;

    /// Angle of the frame's x axis (rad), including full turns.
    pub fn angle(&self) -> f64 {
        match self.angle {
            LinkAngle::Whole(angle) => angle,
            LinkAngle::Turns(turns) => turns + own_angle(self.direction),
        }
    }

    /// World position of the body point `local` (m).
    #[inline]
    pub fn point(&self, local: Vec2) -> Vec2 {
        self.origin + rotated(self.direction, local)
    }

    /// Rotation of the link since the frame `before` (rad, without sign), with a relative error of at most 4.2e-4.
    /// If the frames store only a direction and full turns, the result is at most half a turn.
    #[inline]
    pub fn turn_since(&self, before: &LinkFrame) -> f64 {
        if let (LinkAngle::Whole(angle), LinkAngle::Whole(before)) = (self.angle, before.angle) {
            return (angle - before).abs();
        }
        let chord = (self.direction - before.direction).norm();
        if chord < Self::SMALL {
            return chord;
        }
        cross(before.direction, self.direction).atan2(before.direction.dot(&self.direction)).abs()
    }

    /// Stores the position of a separate body after a step in which the body has turned by less than half a turn.
    #[inline]
    pub(super) fn follow(&mut self, origin: Vec2, direction: Vec2) {
        if let LinkAngle::Turns(turns) = &mut self.angle
            && (self.direction.y < 0.0) != (direction.y < 0.0)
        {
            // The direction crosses the x axis. On the negative side of this axis, the direction's angle jumps by a
            // full turn, so a full turn is added or subtracted.
            let turn = cross(self.direction, direction);
            if turn > 0.0 && direction.y < 0.0 {
                *turns += TAU;
            } else if turn < 0.0 && self.direction.y < 0.0 {
                *turns -= TAU;
            }
        }
        (self.origin, self.direction) = (origin, direction);
    }

    /// Stores a position whose angle is `angle` (rad) up to rounding.
    pub(super) fn put(&mut self, origin: Vec2, direction: Vec2, angle: f64) {
        (self.origin, self.direction) = (origin, direction);
        self.angle = match self.angle {
            LinkAngle::Whole(_) => LinkAngle::Whole(angle),
            LinkAngle::Turns(_) => LinkAngle::Turns(TAU * ((angle - own_angle(direction)) / TAU).round()),
        };
    }
}

/// Angle of a direction (rad), from -pi to pi. Along -x, the angle is pi, whatever the sign of the zero y component.
fn own_angle(direction: Vec2) -> f64 {
    (direction.y + 0.0).atan2(direction.x)
}

/// The Rapier world of a case.
/// All links form one multibody: links in the tree are joined to each other, the links outside the tree float.
/// In a free motion with a large tree, each link that is joined to the ground starts a separate multibody. This
/// multibody also has all links that follow this link in the tree.
/// If the tree has no branches, every link is a separate body.
/// Joints that the tree cuts are impulse joints.
/// Every drive has a separate motor so that the motor's impulse can be read.
/// All numbers are f64, in SI units and world axes.
pub trait World {
    /// The spanning tree. If the tree has no branches, every link is a separate body.
    fn tree(&self) -> &SpanningTree;

    /// Does one time step of Rapier and updates the frames. The step may fail to close loops, and may panic.
    fn step(&mut self);

    /// Does Rapier's step alone. The frames are not updated.
    fn bare_step(&mut self);

    /// Sets the time step (s).
    fn set_step(&mut self, step: f64);

    /// Sets whether the velocities after a step exclude the correction of loop gaps.
    ///
    /// If the correction is excluded, Rapier solves all constraints a second time after the step.
    /// The next step then begins with velocities that satisfy the constraints of the pose at the START of this step.
    /// These velocities are not the velocities that moved the bodies.
    /// In a free motion, each step therefore loses momentum across the constraints of the pose at its start.
    /// The following step regains the lost momentum across the constraints of the following pose.
    fn set_stabilised(&mut self, stabilised: bool);

    /// Sets the speed of a drive's input: rad/s, counter-clockwise positive, or m/s for a slide.
    /// The drive is given by its index in [`drives`](linkage::case::CaseParts::drives).
    fn set_drive(&mut self, drive: usize, omega: f64);

    /// Replaces a prescribed speed by a motor.
    /// The moment on the link (N m) is `damping` (N m s/rad, not negative) times the difference of `target` (rad/s) and
    /// the speed at the END of the step.
    fn set_motor(&mut self, drive: usize, target: f64, damping: f64);

    /// Sets the loads on a link. The loads act until they are set again.
    fn set_load(&mut self, link: LinkId, load: Wrench);

    /// Moves all links into the given poses; velocities stay as they are.
    fn place(&mut self, poses: &[LinkPose]);

    /// Frames of all links after the last step or placement, in the mechanism's order, the ground's first.
    fn frames(&self) -> &[LinkFrame];

    /// Angle of a link's frame (rad), including full turns.
    fn angle(&self, link: LinkId) -> f64 {
        self.frames()[link].angle()
    }

    /// World position of a point of a link (m).
    fn point(&self, side: JointSide) -> Vec2 {
        self.frames()[side.link].point(side.local)
    }

    /// Speed of the joint of branch `index` of the tree at the START of the last step.
    /// (Rapier reports velocities one step late.)
    /// For a revolute joint, the speed is the angular velocity of the child minus the angular velocity of its parent
    /// (rad/s). For a prismatic joint, the speed is the speed of the child along the parent's axis (m/s).
    fn relative_speed(&self, index: usize) -> f64;

    /// Velocity of the mass centre (m/s) and angular velocity (rad/s) of a link outside the tree.
    /// Like the joint speeds, these velocities belong to the START of the last step. `None` for links of the tree.
    fn velocity(&self, link: LinkId) -> Option<(Vec2, f64)>;

    /// Reaction in a joint that the tree cuts, from the impulses of the last step.
    /// The force (N) acts from the first link on the second link.
    /// The moment is about the point on the second link (N m).
    /// `None` for joints of the tree, which report no reaction.
    /// The world must have been built for reading reactions.
    fn reaction(&self, joint: JointId) -> Option<(Vec2, f64)>;

    /// Force of a transmission in its first line of action (N), from the impulse of the last step. The force may have
    /// either sign, because the constraint row of the transmission can push and pull.
    fn transmitted(&self, transmission: TransmissionId) -> f64;

    /// Moment of a drive (N m), or its force for a slide (N), from the motor's impulse in the last step.
    fn torque(&self, drive: usize) -> f64;
}

/// Gap of a joint (m) whose links have the given frames. The gap is the closure error.
/// An angle between the axes of a prismatic joint is multiplied by the mechanism's size `size` (m).
#[inline]
pub(super) fn opening(frames: &[LinkFrame], joint: &Joint, size: f64) -> f64 {
    let sides = [joint.first, joint.second];
    let places = sides.map(|side| frames[side.link].point(side.local));
    if joint.is_pin() {
        return (places[1] - places[0]).norm();
    }
    let (distance, turn) = joint.opening(places, sides.map(|side| frames[side.link].direction));
    distance.larger(turn * size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::math::unit;
    use proptest::prelude::*;

    proptest! {
        /// Rotations begin at any angle. They consist of steps of any size below half a turn, in both senses.
        #[test]
        fn turns_are_counted(start in -20.0f64..20.0, steps in prop::collection::vec(-3.1f64..3.1, 1..40)) {
            let mut frame = LinkFrame { angle: LinkAngle::Turns(0.0), ..LinkFrame::GROUND };
            frame.put(Vec2::zeros(), unit(start), start);
            prop_assert!((frame.angle() - start).abs() <= 1e-14);
            let mut angle = start;
            for step in steps {
                let before = frame;
                angle += step;
                frame.follow(Vec2::zeros(), unit(angle));
                prop_assert!((frame.angle() - angle).abs() <= 1e-13, "{} {angle}", frame.angle());
                let turn = frame.turn_since(&before);
                prop_assert!((turn - step.abs()).abs() <= 4.2e-4 * step.abs() + 1e-13, "{turn} {step}");
            }
        }
    }

    /// The direction moves onto the x axis from either side, with a zero of either sign, and off the axis again.
    #[test]
    fn turns_are_counted_on_the_axis() {
        let back = |y: f64| Vec2::new(-1.0, y);
        for zero in [0.0, -0.0] {
            for (from, to) in [(0.1, -0.1), (-0.1, 0.1), (0.1, 0.1), (-0.1, -0.1)] {
                let mut frame = LinkFrame { angle: LinkAngle::Turns(0.0), ..LinkFrame::GROUND };
                frame.put(Vec2::zeros(), back(from), own_angle(back(from)));
                let start = frame.angle();
                frame.follow(Vec2::zeros(), back(zero));
                assert!((frame.angle() - start).abs() < 0.11, "{from} to {zero}");
                frame.follow(Vec2::zeros(), back(to));
                assert!((frame.angle() - start).abs() < 0.21, "{from} over {zero} to {to}");
            }
        }
    }
}
