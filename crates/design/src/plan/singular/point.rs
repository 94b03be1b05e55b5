//! Data of the singular (Assur) point and of its construction.

use crate::plan::names::pair;
use crate::sentences;
use linkage::error::{Error, ErrorKind};
use linkage::math::{Vec2, cross, turned};
use linkage::mechanism::LinkId;

/// If the sine of the angle between two lines is below this limit, the lines count as parallel.
/// The intersection of such lines would have too few correct digits.
pub(super) const PARALLEL: f64 = 1e-9;

/// A lead whose line goes through the singular point, with the velocities of the lead's ends.
#[derive(Clone, Debug, PartialEq)]
pub struct AssurLead {
    /// Names of the ends. The first end is on the base link that carries the singular point.
    pub names: [String; 2],
    /// World positions of the ends (m).
    pub ends: [Vec2; 2],
    /// Velocities of the ends (m/s).
    pub velocities: [Vec2; 2],
    /// Number of the lead.
    pub(super) link: LinkId,
    /// Unit vector from the first end to the second.
    pub(super) along: Vec2,
}

impl AssurLead {
    /// Distance between the ends (m).
    pub(super) fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    /// Angular velocity (rad/s) or angular acceleration (rad/s^2) from the velocities or accelerations of the ends.
    pub(super) fn turning(&self, [near, far]: [Vec2; 2]) -> f64 {
        cross(self.along, far - near) / self.length()
    }

    /// Adds two normal accelerations to `far`, the acceleration of the lead's second end.
    /// This is the first step in constructing the acceleration of the singular point, whose position is `at`.
    /// The first is the normal acceleration of the lead's first end relative to the second end. It is omega^2 l, where
    /// omega is the lead's angular velocity `lead` (rad/s).
    /// The second is the normal acceleration of the singular point relative to the lead's first end. Here omega is the
    /// angular velocity `base` of the base link (rad/s).
    /// Both normal accelerations are parallel to the lead; the tangential accelerations are perpendicular to the lead.
    pub(super) fn foot(&self, at: Vec2, far: Vec2, lead: f64, base: f64) -> Vec2 {
        far + self.along * (lead.powi(2) * self.length()) + (self.ends[0] - at) * base.powi(2)
    }
}

/// Construction of the singular point's acceleration from the accelerations of the leads' second ends.
/// Each lead gives a line: across the lead, through the end of the lead's normal parts.
/// The two lines meet at the end of the point's acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssurTrial {
    /// Accelerations of the second ends of both leads (m/s^2).
    pub far: [Vec2; 2],
    /// For each lead: `far` plus the normal part of the relative acceleration (m/s^2).
    pub feet: [Vec2; 2],
    /// Acceleration of the point (m/s^2).
    pub at: Vec2,
}

/// How the acceleration of the point is found.
#[derive(Clone, Debug, PartialEq)]
pub enum AssurAcceleration {
    /// Class III: the accelerations of the leads' second ends are known.
    Known(AssurTrial),
    /// Class IV: the leads' second ends are on a link whose angular acceleration is unknown.
    /// Two assumed values of this angular acceleration give two false positions of the end of the point's acceleration.
    /// The end of the true acceleration lies on the line through the two false positions.
    /// The end of the true acceleration also lies on a line across the arm from the base link's outer joint to the
    /// singular point.
    FalsePositions(FalsePositions),
}

/// The acceleration of the point by two false positions.
#[derive(Clone, Debug, PartialEq)]
pub struct FalsePositions {
    /// Link with the unknown angular acceleration.
    pub driver: LinkId,
    /// The two assumed angular accelerations of `driver` (rad/s^2), each with the construction that results from it.
    pub trials: [(f64, AssurTrial); 2],
    /// Acceleration of the outer joint of the base link that carries the point (m/s^2).
    pub outer: Vec2,
    /// A point of the line of true positions: `outer` plus the normal part (m/s^2).
    pub foot: Vec2,
    /// The acceleration of the point, where the line of false positions meets the line of true positions (m/s^2).
    pub at: Vec2,
    /// Resulting angular accelerations of `driver` and of the base link that carries the point (rad/s^2).
    pub alphas: [f64; 2],
}

/// Singular point of a group, with the motion of the group's links computed from this point.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularPoint {
    /// Class of the group: 3 or 4.
    pub class: usize,
    /// The two leads whose lines meet in the point.
    pub leads: [AssurLead; 2],
    /// World position of the point (m).
    pub at: Vec2,
    /// Velocity of the point (m/s). In a group of class IV, the velocity is the same on both base links.
    pub velocity: Vec2,
    /// Accelerations of the point on each base link (m/s^2): one for class III, two for class IV.
    pub accelerations: Vec<Vec2>,
    /// Construction of the first of `accelerations`.
    pub acceleration: AssurAcceleration,
    /// Links with angular velocity (rad/s) and angular acceleration (rad/s^2): the base links, then the leads.
    pub links: Vec<(LinkId, f64, f64)>,
}

impl SingularPoint {
    /// Formats the point in the usual notation: `BD x CE`.
    pub fn lines(&self) -> String {
        self.leads.each_ref().map(|lead| pair(&lead.names[0], &lead.names[1])).join(" x ")
    }
}

/// The vector whose projections onto the directions of two leads are `parts`.
pub(super) fn oblique(leads: [&AssurLead; 2], parts: [f64; 2]) -> Vec2 {
    let [first, second] = leads.map(|lead| lead.along);
    (turned(first) * parts[1] - turned(second) * parts[0]) / cross(first, second)
}

/// The point in which the lines of two leads meet.
pub(super) fn meeting(leads: [&AssurLead; 2]) -> Vec2 {
    let [first, second] = leads;
    let slant = cross(first.along, second.along);
    first.ends[0] + first.along * (cross(second.ends[0] - first.ends[0], second.along) / slant)
}

/// Construction of an acceleration. For each lead, a line across the lead goes through its point of `feet`.
/// The two lines meet at the end of the acceleration.
pub(super) fn trial(leads: [&AssurLead; 2], far: [Vec2; 2], feet: [Vec2; 2]) -> AssurTrial {
    let parts = [0, 1].map(|side| feet[side].dot(&leads[side].along));
    AssurTrial { far, feet, at: oblique(leads, parts) }
}

/// Error about two leads. `between` separates the names of the leads in the message.
pub(super) fn wrong(leads: [&AssurLead; 2], between: &str, message: impl FnOnce(String) -> String) -> Error {
    let names = leads.map(|lead| pair(&lead.names[0], &lead.names[1]));
    Error::new(ErrorKind::Geometry, message(names.join(between))).help(sentences::TAKE_A_CRANK_ANGLE_A_LITTLE)
}
