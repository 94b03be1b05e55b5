//! Loads on links other than gravity and inertia. What each does to the links is written here only.

mod amount;
mod links;
mod sort;

pub use sort::LoadSort;

use super::course::Course;
use crate::math::{Motion, Vec2, angle, cross};
use crate::mechanism::{LinkId, LinkPose, Side};

/// The sense of rotation of the link for which a moment acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// For every motion of the link.
    Always,
    /// While the link turns counter-clockwise, not at standstill.
    CounterClockwise,
    /// While the link turns clockwise, not at standstill.
    Clockwise,
}

/// A load on one link, or between two.
#[derive(Clone, Debug, PartialEq)]
pub enum Load {
    /// Moment of constant size against the link's rotation. Zero while the link stands still.
    Resistance {
        /// The loaded link.
        link: LinkId,
        /// Size of the moment (N m), not negative.
        moment: f64,
    },
    /// Moment that does not depend on the speed. It may act for one sense of the link's rotation only.
    Moment {
        /// The loaded link.
        link: LinkId,
        /// The moment (N m), counter-clockwise positive.
        moment: Course,
        /// When it acts.
        acts: Acts,
    },
    /// Force on a point of a link.
    Force {
        /// The point.
        at: Side,
        /// Components (N), in world axes or in the axes of the link's frame.
        force: [Course; 2],
        /// Whether the components are in the link's frame, so that the force turns with it.
        follows: bool,
    },
    /// Force of constant size against the motion of a point of a link, -F v / |v|. Zero while the point stands still.
    ResistingForce {
        /// The point.
        at: Side,
        /// Size of the force (N), not negative.
        force: f64,
    },
    /// Spring between two points. It pulls them together with stiffness times (length - free length).
    /// Where the points coincide the direction is undefined and the force is zero.
    Spring {
        /// The points.
        ends: [Side; 2],
        /// Stiffness (N/m).
        stiffness: f64,
        /// Length without force (m).
        free_length: f64,
    },
    /// Damper between two points: it pulls them together with damping times the rate of their distance.
    /// The force is zero where they coincide.
    Damper {
        /// The points.
        ends: [Side; 2],
        /// Damping (N s/m).
        damping: f64,
    },
    /// Torsional spring between two links: stiffness times (twist - free twist) on the first link, the opposite on the
    /// second.
    /// The twist is the angle of the second link's frame minus that of the first.
    /// At t = 0 it is in (-pi, pi]; from there on it keeps its turns.
    TorsionSpring {
        /// The links.
        links: [LinkId; 2],
        /// Stiffness (N m/rad).
        stiffness: f64,
        /// Twist without moment (rad).
        free_angle: f64,
    },
    /// Torsional damper between two links: damping times the rate of the twist on the first link, the opposite on the
    /// second.
    TorsionDamper {
        /// The links.
        links: [LinkId; 2],
        /// Damping (N m s/rad).
        damping: f64,
    },
}

/// The motion whose sense a load depends on. Its law changes where that motion reverses, so that nobody integrates over
/// such an instant. It need not jump there: see [`Load::jump`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Senses {
    /// The load does not depend on a sense of motion.
    Nothing,
    /// On the sense of rotation of a link.
    Link(LinkId),
    /// On the sense of motion of a point.
    Point(Side),
}

/// The sort of a load and the quantities it depends on: see [`Load::nature`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nature<'a> {
    /// The sort.
    pub sort: LoadSort,
    /// The motion whose sense it depends on.
    pub senses: Senses,
    /// Whether it depends on the size of speeds, not only on their senses.
    pub is_viscous: bool,
    /// The two links whose [`Setting::twist`] it depends on.
    pub twist: Option<[LinkId; 2]>,
    /// Its quantities that may depend on the crank angle.
    pub courses: &'a [Course],
}

/// The state that loads depend on. Slices have one entry per link.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'a> {
    /// Motions of all links. Loads do not use the accelerations.
    pub motions: &'a [Motion],
    /// Angles of all links (rad), turns kept. Only torsional springs use them.
    pub angles: &'a [f64],
    /// Poses at t = 0.
    pub start: &'a [LinkPose],
    /// Crank angle (rad, as the scenario states it). Only tables use it.
    pub crank: f64,
}

impl Setting<'_> {
    /// Twist between two links (rad): see [`Load::TorsionSpring`].
    #[must_use]
    pub fn twist(&self, [first, second]: [LinkId; 2]) -> f64 {
        let begun = self.start[second].angle - self.start[first].angle;
        self.angles[second] - self.angles[first] - begun + angle::wrapped(begun)
    }
}

/// Action of a load on one link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action {
    /// The link.
    pub link: LinkId,
    /// Force (N, world axes).
    pub force: Vec2,
    /// World place at which the force acts (m).
    pub place: Vec2,
    /// Additional moment besides that of the force (N m), counter-clockwise positive.
    pub moment: f64,
}

impl Action {
    /// Only a moment (N m, counter-clockwise positive), no force.
    #[must_use]
    pub fn of_moment(link: LinkId, moment: f64) -> Self {
        Action { link, force: Vec2::zeros(), place: Vec2::zeros(), moment }
    }

    /// Moment of force and moment together about a world point (N m).
    #[inline]
    #[must_use]
    pub fn about(&self, pole: Vec2) -> f64 {
        cross(self.place - pole, self.force) + self.moment
    }

    /// Power on a link with this motion (W).
    #[inline]
    #[must_use]
    pub fn power(&self, motion: &Motion) -> f64 {
        self.force.dot(&motion.velocity_at(self.place)) + self.moment * motion.omega
    }
}

/// Resultant of all loads on a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force (N, world axes) at the link's mass centre.
    pub force: Vec2,
    /// Moment about the mass centre (N m), counter-clockwise positive.
    pub moment: f64,
}

impl Wrench {
    /// No load.
    pub const ZERO: Wrench = Wrench { force: Vec2::new(0.0, 0.0), moment: 0.0 };
}

impl Load {
    /// Calls `put` with the action of the load on each of its links, the ground included.
    #[inline]
    pub fn act(&self, setting: &Setting, put: &mut impl FnMut(Action)) {
        let motions = setting.motions;
        match self {
            &Load::Resistance { link, .. } => {
                put(Action::of_moment(link, self.moment_in(motions[link].omega, setting.crank)));
            }
            Load::Moment { link, moment, acts: Acts::Always } => {
                put(Action::of_moment(*link, moment.at(setting.crank)));
            }
            &Load::Moment { link, .. } => {
                put(Action::of_moment(link, self.moment_in(motions[link].omega, setting.crank)));
            }
            Load::Force { at, force: [x, y], follows } => {
                let force = Vec2::new(x.at(setting.crank), y.at(setting.crank));
                let force = if *follows { motions[at.link].arm(force) } else { force };
                put(Action { link: at.link, force, place: motions[at.link].point(at.local), moment: 0.0 });
            }
            &Load::ResistingForce { at, .. } => {
                let velocity = motions[at.link].point_velocity(at.local);
                put(Action {
                    link: at.link,
                    force: self.force_in(sense_of(velocity)),
                    place: motions[at.link].point(at.local),
                    moment: 0.0,
                });
            }
            &Load::Spring { ends, stiffness, free_length } => {
                let (places, span) = span(motions, ends);
                let length = span.norm();
                let pull = if length > 0.0 { span * (stiffness * (1.0 - free_length / length)) } else { Vec2::zeros() };
                pull_together(ends, places, pull, put);
            }
            &Load::Damper { ends, damping } => {
                let (places, span) = span(motions, ends);
                let squared = span.norm_squared();
                let [first, second] = ends.map(|end| motions[end.link].point_velocity(end.local));
                let rate = span.dot(&(second - first));
                let pull = if squared > 0.0 { span * (damping * rate / squared) } else { Vec2::zeros() };
                pull_together(ends, places, pull, put);
            }
            &Load::TorsionSpring { links, stiffness, free_angle } => {
                twist_back(links, stiffness * (setting.twist(links) - free_angle), put);
            }
            &Load::TorsionDamper { links, damping } => {
                twist_back(links, damping * (motions[links[1]].omega - motions[links[0]].omega), put);
            }
        }
    }

    /// The sort of the load and the quantities it depends on.
    /// Code that must know a load's variant asks this where it can.
    #[inline]
    #[must_use]
    pub fn nature(&self) -> Nature<'_> {
        let plain = |sort| Nature { sort, senses: Senses::Nothing, is_viscous: false, twist: None, courses: &[] };
        match self {
            &Load::Resistance { link, moment: _ } => {
                Nature { senses: Senses::Link(link), ..plain(LoadSort::Resistance) }
            }
            Load::Moment { link, moment, acts } => {
                let senses = match acts {
                    Acts::Always => Senses::Nothing,
                    Acts::CounterClockwise | Acts::Clockwise => Senses::Link(*link),
                };
                Nature { senses, courses: std::slice::from_ref(moment), ..plain(LoadSort::Moment) }
            }
            Load::Force { at: _, force, follows: _ } => Nature { courses: force, ..plain(LoadSort::Force) },
            &Load::ResistingForce { at, force: _ } => {
                Nature { senses: Senses::Point(at), ..plain(LoadSort::ResistingForce) }
            }
            Load::Spring { ends: _, stiffness: _, free_length: _ } => plain(LoadSort::Spring),
            Load::Damper { ends: _, damping: _ } => Nature { is_viscous: true, ..plain(LoadSort::Damper) },
            &Load::TorsionSpring { links, stiffness: _, free_angle: _ } => {
                Nature { twist: Some(links), ..plain(LoadSort::TorsionSpring) }
            }
            Load::TorsionDamper { links: _, damping: _ } => {
                Nature { is_viscous: true, ..plain(LoadSort::TorsionDamper) }
            }
        }
    }

    /// The points that it acts on; none of a moment.
    #[must_use]
    pub fn points(&self) -> Vec<Side> {
        match self {
            Load::Force { at, .. } | Load::ResistingForce { at, .. } => vec![*at],
            Load::Spring { ends, .. } | Load::Damper { ends, .. } => ends.to_vec(),
            Load::Resistance { .. } | Load::Moment { .. } => Vec::new(),
            Load::TorsionSpring { .. } | Load::TorsionDamper { .. } => Vec::new(),
        }
    }

    /// The link on whose sense of rotation the load depends.
    #[inline]
    #[must_use]
    pub fn sensed_link(&self) -> Option<LinkId> {
        match self.nature().senses {
            Senses::Link(link) => Some(link),
            Senses::Nothing | Senses::Point(_) => None,
        }
    }

    /// The point on whose sense of motion the load depends.
    #[must_use]
    pub fn sensed_point(&self) -> Option<Side> {
        match self.nature().senses {
            Senses::Point(at) => Some(at),
            Senses::Nothing | Senses::Link(_) => None,
        }
    }

    /// Moment (N m) of a load with a [sensed link](Load::sensed_link) while that link turns in the sense of `omega`,
    /// at the crank angle
    /// `crank` (rad). Zero for other loads.
    #[inline]
    #[must_use]
    pub fn moment_in(&self, omega: f64, crank: f64) -> f64 {
        let [turns_forward, turns_back] = [omega > 0.0, omega < 0.0];
        match self {
            Load::Resistance { moment, .. } if turns_forward => -moment,
            Load::Resistance { moment, .. } if turns_back => *moment,
            Load::Moment { moment, acts: Acts::CounterClockwise, .. } if turns_forward => moment.at(crank),
            Load::Moment { moment, acts: Acts::Clockwise, .. } if turns_back => moment.at(crank),
            Load::Resistance { .. } | Load::Moment { .. } => 0.0,
            Load::Force { .. } | Load::ResistingForce { .. } => 0.0,
            Load::Spring { .. } | Load::Damper { .. } => 0.0,
            Load::TorsionSpring { .. } | Load::TorsionDamper { .. } => 0.0,
        }
    }

    /// Force (N) of a load with a [sensed point](Load::sensed_point) while that point moves in the direction `way`: a unit
    /// vector in world axes, or zero for standstill. Zero for other loads.
    #[inline]
    #[must_use]
    pub fn force_in(&self, way: Vec2) -> Vec2 {
        match *self {
            Load::ResistingForce { force, .. } => way * -force,
            Load::Resistance { .. } | Load::Moment { .. } | Load::Force { .. } => Vec2::zeros(),
            Load::Spring { .. } | Load::Damper { .. } => Vec2::zeros(),
            Load::TorsionSpring { .. } | Load::TorsionDamper { .. } => Vec2::zeros(),
        }
    }

    /// By how much the load jumps where the motion that it senses reverses, at the crank angle `crank` (rad): N m, or N
    /// for a force; not negative. Zero where it senses none, and where it vanishes with the speed or at that crank angle:
    /// there it has a kink at most.
    #[must_use]
    pub fn jump(&self, crank: f64) -> f64 {
        match self.nature().senses {
            Senses::Nothing => 0.0,
            Senses::Link(_) => {
                let [ahead, back] = [1.0, -1.0].map(|sense| self.moment_in(sense * f64::MIN_POSITIVE, crank));
                (ahead - back).abs()
            }
            Senses::Point(_) => {
                let [ahead, back] = [1.0, -1.0].map(|sense| self.force_in(Vec2::new(sense, 0.0)));
                (ahead - back).norm()
            }
        }
    }

    /// For a [resistance](Load::Resistance): the loaded link and the size of the moment (N m).
    /// It is the only load that some engines and formats have built in.
    #[inline]
    #[must_use]
    pub fn resistance(&self) -> Option<(LinkId, f64)> {
        match *self {
            Load::Resistance { link, moment } => Some((link, moment)),
            Load::Moment { .. } | Load::Force { .. } | Load::ResistingForce { .. } => None,
            Load::Spring { .. } | Load::Damper { .. } => None,
            Load::TorsionSpring { .. } | Load::TorsionDamper { .. } => None,
        }
    }

    /// Whether the load depends on the size of speeds, not only on their senses.
    #[must_use]
    pub fn is_viscous(&self) -> bool {
        self.nature().is_viscous
    }

    /// Whether the load depends on [`Setting::angles`] or [`Setting::crank`].
    #[must_use]
    pub fn needs_angles(&self) -> bool {
        self.nature().twist.is_some() || self.courses().any(|course| course.knots().is_some())
    }

    /// The quantities that may depend on the crank angle.
    pub fn courses(&self) -> impl Iterator<Item = &Course> {
        self.nature().courses.iter()
    }

    /// Name of the load's sort in scenario files.
    #[must_use]
    pub fn sort(&self) -> &'static str {
        self.nature().sort.name()
    }
}

/// Direction of a velocity: a unit vector, or zero at standstill. The squares of the smallest speeds do not vanish.
#[inline]
#[must_use]
pub fn sense_of(velocity: Vec2) -> Vec2 {
    let most = velocity.amax();
    if most > 0.0 { (velocity / most).normalize() } else { Vec2::zeros() }
}

/// World places of two ends and the vector from the first to the second.
#[inline]
fn span(motions: &[Motion], ends: [Side; 2]) -> ([Vec2; 2], Vec2) {
    let places = ends.map(|end| motions[end.link].point(end.local));
    (places, places[1] - places[0])
}

/// Applies the force `pull` to the first end and its reaction to the second.
/// `pull` points towards the second end if the two attract each other.
#[inline]
fn pull_together(ends: [Side; 2], places: [Vec2; 2], pull: Vec2, put: &mut impl FnMut(Action)) {
    put(Action { link: ends[0].link, force: pull, place: places[0], moment: 0.0 });
    put(Action { link: ends[1].link, force: -pull, place: places[1], moment: 0.0 });
}

#[inline]
fn twist_back(links: [LinkId; 2], moment: f64, put: &mut impl FnMut(Action)) {
    put(Action::of_moment(links[0], moment));
    put(Action::of_moment(links[1], -moment));
}

#[cfg(test)]
mod tests;
