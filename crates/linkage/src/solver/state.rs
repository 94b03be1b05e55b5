//! The state of a mechanism, in the form that all solvers use.

use crate::case::Case;
use crate::math::{KeepNan, Motion, Vec2, cross, unit};
use crate::mechanism::{GROUND, Joint, PerJoint, PerLink};

/// State of the whole mechanism at one instant, in the form that all solvers use.
#[derive(Clone, Debug)]
pub struct State {
    /// Motion of every link's frame. The ground's motion is [`Motion::REST`].
    pub motions: PerLink<Motion>,
    /// Angle of every link's frame, unwrapped (rad).
    pub angles: PerLink<f64>,
    /// Force of the first link on the second in every joint (N).
    pub forces: PerJoint<Vec2>,
    /// Moment of the first link on the second in every joint (N m), about the joint's point on the second link.
    /// The moment is 0 in revolute joints.
    pub moments: PerJoint<f64>,
    /// Balancing moment on every driving link (N m), in the order of
    /// [`CaseParts::drives`](crate::case::CaseParts::drives).
    pub torques: Vec<f64>,
    /// Condition number for the bound on rounding errors while the mechanism passes a change point; `None` elsewhere.
    /// The condition number of the pose itself grows without bound near a change point.
    /// The solver does not compute at the change point itself, so this number is used instead.
    pub passing: Option<f64>,
}

impl State {
    /// A state at rest with all values zero.
    #[must_use]
    pub fn at_rest(case: &Case) -> Self {
        State {
            motions: vec![Motion::REST; case.mechanism.links().len()].into(),
            angles: vec![0.0; case.mechanism.links().len()].into(),
            forces: vec![Vec2::zeros(); case.mechanism.joints().len()].into(),
            moments: vec![0.0; case.mechanism.joints().len()].into(),
            torques: vec![0.0; case.drives.len()],
            passing: None,
        }
    }

    /// Slide of a prismatic joint (m) with its first and second derivative; `None` for a revolute joint.
    /// The slide is s = e . (p2 - p1) along the axis e of the first link.
    /// With p2 - p1 = s e: e . (v2 - v1) = s' and e . (a2 - a1) = s'' - s omega^2.
    #[inline]
    #[must_use]
    pub fn slide(&self, joint: &Joint) -> Option<[f64; 3]> {
        let [first, second] = [joint.first, joint.second].map(|side| (&self.motions[side.link], side.local));
        let axis = first.0.arm(joint.axis_on(joint.first.link)?);
        let slide = axis.dot(&(second.0.point(second.1) - first.0.point(first.1)));
        let speed = axis.dot(&(second.0.point_velocity(second.1) - first.0.point_velocity(first.1)));
        let second_derivative =
            axis.dot(&(second.0.point_acceleration(second.1) - first.0.point_acceleration(first.1)));
        Some([slide, speed, second_derivative + slide * first.0.omega * first.0.omega])
    }

    /// Shaking force (N) and shaking moment about the origin (N m).
    /// Force and moment are the sums of the actions on the frame.
    /// These actions come from joints with the ground, drives, and springs and dampers fastened to the ground.
    #[must_use]
    pub fn shaking(&self, case: &Case) -> (Vec2, f64) {
        // Drives are mounted on the frame. The moment of a drive on the frame is opposite to its balancing moment.
        let (mut force, mut moment) = (Vec2::zeros(), -self.torques.iter().sum::<f64>());
        for (index, joint) in case.mechanism.joints().entries() {
            let sign = match (joint.first.link, joint.second.link) {
                (GROUND, _) => -1.0,
                (_, GROUND) => 1.0,
                _ => continue,
            };
            let place = self.motions[joint.second.link].point(joint.second.local);
            force += self.forces[index] * sign;
            moment += (cross(place, self.forces[index]) + self.moments[index]) * sign;
        }
        case.each_load(&self.motions, &self.angles, |action| {
            if action.link == GROUND {
                force += action.force;
                moment += action.about(Vec2::zeros());
            }
        });
        (force, moment)
    }

    /// Largest opening of a joint (m), and largest distance of a joint from the origin (m).
    /// In a prismatic joint the opening is measured perpendicular to the guide.
    /// The angle between the joint's two axes (rad), multiplied by `size` (m), also counts as an opening.
    #[must_use]
    pub fn opening(&self, case: &Case, size: f64) -> [f64; 2] {
        let mut largest = [0.0; 2];
        for joint in case.mechanism.joints() {
            let sides = [joint.first, joint.second];
            let places = sides.map(|side| self.motions[side.link].point(side.local));
            let (distance, turn) = joint.opening(places, sides.map(|side| self.motions[side.link].direction));
            let own = [distance.larger(turn * size), places[0].norm()];
            largest = [largest[0].larger(own[0]), largest[1].larger(own[1])];
        }
        largest
    }

    /// Largest moment (N m): of a drive, or of a joint's force at `arm` (m).
    #[must_use]
    pub fn largest_moment(&self, arm: f64) -> f64 {
        let torques = self.torques.iter().map(|torque| torque.abs());
        self.forces.iter().map(|force| force.norm() * arm).chain(torques).fold(0.0, f64::larger)
    }

    /// The start pose of the case, at rest.
    #[must_use]
    pub fn at_start(case: &Case) -> Self {
        let mut state = State::at_rest(case);
        for (index, pose) in case.start.0.entries() {
            state.motions[index].origin = pose.origin;
            state.motions[index].direction = unit(pose.angle);
            state.angles[index] = pose.angle;
        }
        state
    }
}
