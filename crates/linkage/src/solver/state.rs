//! The state of a mechanism, in the form that all solvers use.

use crate::case::{Case, JointReactions};
use crate::math::{KeepNan, Motion, Vec2, cross, unit};
use crate::mechanism::{GROUND, Joint, PerJoint, PerLink, PerTransmission};

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
    /// Force of every transmission on its second member along its first line of action (N).
    /// A negative force acts along the second line.
    pub transmitted: PerTransmission<f64>,
    /// Balancing moment (N m) or driving force (N) of every drive, in the order of
    /// [`CaseParts::drives`](crate::case::CaseParts::drives).
    /// At a joint between moving links, moment and force act from the first link on the second.
    pub torques: Vec<f64>,
    /// Condition number for the bound on rounding errors while the mechanism passes a change point; `None` elsewhere.
    /// The condition number of the pose itself grows without bound near a change point.
    /// Near the change point the solver interpolates between poses on both sides of it and solves no equations.
    /// This number therefore replaces the condition number of the pose.
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
            transmitted: vec![0.0; case.mechanism.transmissions().len()].into(),
            torques: vec![0.0; case.drives.len()],
            passing: None,
        }
    }

    /// Slide of a joint in this state and its first two derivatives, as in [`Joint::slide`].
    #[inline]
    #[must_use]
    pub fn slide(&self, joint: &Joint) -> Option<[f64; 3]> {
        joint.slide(&self.motions)
    }

    /// Shaking force (N) and shaking moment about the origin (N m).
    /// Force and moment are the sums of the actions on the frame.
    /// These actions come from joints, transmissions and loads on the ground, and from drives.
    #[must_use]
    pub fn shaking(&self, case: &Case) -> (Vec2, f64) {
        let (mut force, mut moment) = (Vec2::zeros(), 0.0);
        for (drive, effort) in case.drives.iter().zip(&self.torques) {
            for action in case.effort(drive, *effort, &self.motions).into_iter().filter(|own| own.link == GROUND) {
                force += action.force;
                moment += action.about(Vec2::zeros());
            }
        }
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
        for (transmission, transmitted) in case.mechanism.transmissions().iter().zip(&*self.transmitted) {
            transmission.each_action(case.mechanism.joints(), *transmitted, &self.motions, |link, own, place| {
                if link == GROUND {
                    force += own;
                    moment += cross(place, own);
                }
            });
        }
        case.each_load(&self.motions, &self.angles, self.reactions(), |action| {
            if action.link == GROUND {
                force += action.force;
                moment += action.about(Vec2::zeros());
            }
        });
        (force, moment)
    }

    /// Forces (N) and moments (N m) of all joints, and forces of all transmissions (N).
    #[must_use]
    pub fn reactions(&self) -> JointReactions<'_> {
        JointReactions { forces: &self.forces, moments: &self.moments, transmitted: &self.transmitted }
    }

    /// Power of all drives on their links (W).
    #[must_use]
    pub fn drive_power(&self, case: &Case) -> f64 {
        let efforts = case.drives.iter().zip(&self.torques);
        efforts.map(|(drive, effort)| effort * case.drive_state(drive, &self.motions, &self.angles).rate).sum()
    }

    /// Largest opening of a joint (m), and largest distance of a joint from the origin (m).
    /// The opening is the distance between the joint's points on its two links.
    /// In a prismatic joint the opening is measured perpendicular to the guide.
    /// The sine of the angle between the joint's two axes, multiplied by `size` (m), also counts as an opening.
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

    /// The largest of the drives' moments (N m) and of the forces of joints and drives times the lever arm `arm` (m).
    #[must_use]
    pub fn largest_moment(&self, case: &Case, arm: f64) -> f64 {
        // Only forces are multiplied by the lever arm.
        let efforts = case.drives.iter().zip(&self.torques);
        let torques = efforts.map(|(drive, effort)| effort.abs() * drive.input.span(arm));
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
