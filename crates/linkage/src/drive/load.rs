//! Loads on links, apart from gravity and inertia.
//! This file alone defines each kind of load.
//! Each kind is defined by a variant and three methods.
//! [`Load::act`] gives the action on the links, [`Load::nature`] the dependencies, [`Load::parts`] the numbers.
//! Code in other files calls these methods. The scenario reader defines how loads are written in scenario files.

mod change;
mod parts;
mod state;

pub use parts::{Acts, LoadNature, LoadPart, LoadRole, On, Senses};
pub use state::{Action, LoadState, Wrench};

use super::course::Course;
use crate::math::{Motion, Vec2};
use crate::mechanism::{JointId, JointSide, LinkId};

/// A load on one link, or between two links.
#[derive(Clone, Debug, PartialEq)]
pub enum Load {
    /// Moment of constant magnitude, opposite to the link's rotation. The moment is zero at standstill.
    Resistance {
        /// The loaded link.
        link: LinkId,
        /// Magnitude of the moment (N m), not negative.
        moment: f64,
    },
    /// Moment that does not depend on the magnitude of the speed. The moment may be limited to one sense of the link's
    /// rotation.
    Moment {
        /// The loaded link.
        link: LinkId,
        /// The moment (N m), counter-clockwise positive.
        moment: Course,
        /// Sense of rotation for which the moment acts.
        acts: Acts,
    },
    /// Force on a point of a link.
    Force {
        /// Point of application.
        at: JointSide,
        /// Components (N), along world axes or the link's axes.
        force: [Course; 2],
        /// Whether the components are along the link's axes, so that the force turns with the link.
        follows: bool,
    },
    /// Force of constant magnitude, opposite to the motion of a point of a link: -F v / |v|. The force is zero at
    /// standstill.
    ResistingForce {
        /// Point of application.
        at: JointSide,
        /// Magnitude of the force (N), not negative.
        force: f64,
    },
    /// Spring between two points.
    /// The force is stiffness times (length - free length). A positive force pulls the points together.
    /// If the points coincide, the direction is undefined and the force is zero.
    Spring {
        /// End points.
        ends: [JointSide; 2],
        /// Stiffness (N/m).
        stiffness: f64,
        /// Unloaded length (m).
        free_length: f64,
    },
    /// Damper between two points.
    /// The force is damping times the rate of change of the points' distance. A positive force pulls the points
    /// together.
    /// If the points coincide, the force is zero.
    Damper {
        /// End points.
        ends: [JointSide; 2],
        /// Damping (N s/m).
        damping: f64,
    },
    /// Torsion spring between two links.
    /// The moment on the first link is stiffness times (twist - free twist). The moment on the second link is opposite.
    /// The twist is the angle of the second link's frame minus the angle of the first link's frame.
    /// At t = 0 the twist is in (-pi, pi]. Later the twist counts whole turns.
    /// If `acts` names one side of the free twist, the spring acts only on this side, like a stop.
    TorsionSpring {
        /// The links.
        links: [LinkId; 2],
        /// Stiffness (N m/rad).
        stiffness: f64,
        /// Unloaded twist (rad).
        free_angle: f64,
        /// Side of the free twist on which the spring acts: [`Acts::CounterClockwise`] means larger twists.
        acts: Acts,
    },
    /// Torsion damper between two links.
    /// The moment on the first link is damping times the rate of change of the twist. The moment on the second link is
    /// opposite.
    TorsionDamper {
        /// The links.
        links: [LinkId; 2],
        /// Damping (N m s/rad).
        damping: f64,
    },
    /// Force along the axis of a prismatic joint.
    /// The force acts on the joint's second link; a positive force pushes towards larger slides.
    /// The opposite force acts on the first link. The force may be limited to one sense of the sliding.
    SlideForce {
        /// The joint.
        joint: JointId,
        /// First and second link of the joint.
        links: [LinkId; 2],
        /// The force (N).
        force: Course,
        /// Sense of the sliding for which the force acts: [`Acts::CounterClockwise`] means an increasing slide.
        acts: Acts,
    },
    /// Spring along the axis of a prismatic joint. The force on the second link is -stiffness (slide - free slide).
    /// If `acts` names one side of the free slide, the spring acts only on this side, like a stop.
    SlideSpring {
        /// The joint.
        joint: JointId,
        /// First and second link of the joint.
        links: [LinkId; 2],
        /// Stiffness (N/m).
        stiffness: f64,
        /// Unloaded slide (m).
        free_slide: f64,
        /// Side of the free slide on which the spring acts: [`Acts::CounterClockwise`] means larger slides.
        acts: Acts,
    },
    /// Damper along the axis of a prismatic joint.
    /// The force on the second link is -damping times the rate of the slide.
    SlideDamper {
        /// The joint.
        joint: JointId,
        /// First and second link of the joint.
        links: [LinkId; 2],
        /// Damping (N s/m).
        damping: f64,
    },
    /// Dry friction in a joint, against its sliding: see [`Friction`](crate::case::Friction).
    /// The friction depends on the joint's reaction, so the solvers compute friction and reaction together.
    Friction {
        /// The joint.
        joint: JointId,
        /// First and second link of the joint.
        links: [LinkId; 2],
        /// Coefficient of friction.
        /// A negative coefficient would drive the joint; the scenario reader rejects negative coefficients.
        coefficient: f64,
        /// Radius of the journal of a revolute joint, or length of the guide of a prismatic joint (m), not negative.
        /// The length 0 means that the moment of the guide causes no friction.
        length: f64,
    },
}

impl Load {
    /// Calls `put` with the action of the load on each of its links, the ground included.
    /// For friction, `put` is not called: see [`Friction::act`](crate::case::Friction::act).
    #[inline]
    pub fn act(&self, setting: &LoadState, put: &mut impl FnMut(Action)) {
        let motions = setting.motions;
        match self {
            Load::Moment { link, moment, acts: Acts::Always } => {
                put(Action::of_moment(*link, moment.at(setting.crank)));
            }
            &(Load::Resistance { link, .. } | Load::Moment { link, .. }) => {
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
            &Load::TorsionSpring { links, stiffness, free_angle, acts } => {
                twist_back(links, spring(stiffness, setting.twist(links) - free_angle, acts), put);
            }
            &Load::TorsionDamper { links, damping } => {
                twist_back(links, damping * (motions[links[1]].omega - motions[links[0]].omega), put);
            }
            Load::SlideForce { joint, .. } => {
                let joint = &setting.joints[*joint];
                let effort = self.moment_in(joint.rates(motions)[0], setting.crank);
                Action::pair(joint, effort, motions).into_iter().for_each(put);
            }
            &Load::SlideSpring { joint, stiffness, free_slide, acts, .. } => {
                let joint = &setting.joints[joint];
                let stretch = joint.slide(motions).map_or(0.0, |[slide, ..]| slide - free_slide);
                Action::pair(joint, -spring(stiffness, stretch, acts), motions).into_iter().for_each(put);
            }
            &Load::SlideDamper { joint, damping, .. } => {
                let joint = &setting.joints[joint];
                Action::pair(joint, -damping * joint.rates(motions)[0], motions).into_iter().for_each(put);
            }
            // The action needs the joint's reaction.
            Load::Friction { .. } => {}
        }
    }

    /// Name of the load, its point or link of action, and the quantities on which it depends.
    /// Code should distinguish loads by this information, not by the variant.
    #[inline]
    #[must_use]
    pub fn nature(&self) -> LoadNature<'_> {
        let plain =
            |sort, on| LoadNature { sort, on, senses: Senses::Nothing, is_viscous: false, twist: None, courses: &[] };
        match self {
            &Load::Resistance { link, moment: _ } => {
                LoadNature { senses: Senses::Link(link), ..plain("resistance", On::Link(link)) }
            }
            Load::Moment { link, moment, acts } => {
                let senses = match acts {
                    Acts::Always => Senses::Nothing,
                    Acts::CounterClockwise | Acts::Clockwise => Senses::Link(*link),
                };
                LoadNature { senses, courses: std::slice::from_ref(moment), ..plain("moment", On::Link(*link)) }
            }
            Load::Force { at, force, follows: _ } => LoadNature { courses: force, ..plain("force", On::Point(*at)) },
            &Load::ResistingForce { at, force: _ } => {
                LoadNature { senses: Senses::Point(at), ..plain("resisting_force", On::Point(at)) }
            }
            &Load::Spring { ends, stiffness: _, free_length: _ } => plain("spring", On::Points(ends)),
            &Load::Damper { ends, damping: _ } => LoadNature { is_viscous: true, ..plain("damper", On::Points(ends)) },
            &Load::TorsionSpring { links, .. } => {
                LoadNature { twist: Some(links), ..plain("torsion_spring", On::Links(links)) }
            }
            &Load::TorsionDamper { links, damping: _ } => {
                LoadNature { is_viscous: true, ..plain("torsion_damper", On::Links(links)) }
            }
            Load::SlideForce { joint, links, force, acts } => {
                let senses = if *acts == Acts::Always { Senses::Nothing } else { Senses::Joint(*joint) };
                let courses = std::slice::from_ref(force);
                LoadNature { senses, courses, ..plain("slide_force", On::Joint(*joint, *links)) }
            }
            &Load::SlideSpring { joint, links, .. } => plain("slide_spring", On::Joint(joint, links)),
            &Load::SlideDamper { joint, links, damping: _ } => {
                LoadNature { is_viscous: true, ..plain("slide_damper", On::Joint(joint, links)) }
            }
            &Load::Friction { joint, links, coefficient: _, length: _ } => {
                LoadNature { senses: Senses::Joint(joint), ..plain("friction", On::Joint(joint, links)) }
            }
        }
    }

    /// The parts of the load except its joint, for reading or changing. Links and points come first.
    /// A torsion spring has the part [`LoadPart::Acts`] only if it acts on one side.
    pub fn parts(&mut self) -> Vec<LoadPart<'_>> {
        fn amount<'a>(name: &'static str, value: &'a mut f64) -> LoadPart<'a> {
            LoadPart::Number { role: LoadRole::Amount, name, value }
        }
        fn size<'a>(name: &'static str, value: &'a mut f64) -> LoadPart<'a> {
            LoadPart::Number { role: LoadRole::Size, name, value }
        }
        match self {
            Load::Resistance { link, moment } => vec![LoadPart::Link(link), size("moment_N_m", moment)],
            Load::Moment { link, moment, acts } => {
                let values = std::slice::from_mut(moment);
                vec![LoadPart::Link(link), LoadPart::Courses { name: "moment_N_m", values }, LoadPart::Acts(acts)]
            }
            Load::Force { at, force, follows } => {
                vec![
                    LoadPart::Point(at),
                    LoadPart::Courses { name: "force_N", values: force },
                    LoadPart::Follows(follows),
                ]
            }
            Load::ResistingForce { at, force } => vec![LoadPart::Point(at), size("force_N", force)],
            Load::Spring { ends: [first, second], stiffness, free_length } => vec![
                LoadPart::Point(first),
                LoadPart::Point(second),
                amount("stiffness_N_m", stiffness),
                LoadPart::Number { role: LoadRole::Rest { unit: "m" }, name: "free_length_m", value: free_length },
            ],
            Load::Damper { ends: [first, second], damping } => {
                vec![LoadPart::Point(first), LoadPart::Point(second), amount("damping_N_s_m", damping)]
            }
            Load::TorsionSpring { links: [first, second], stiffness, free_angle, acts } => {
                let role = LoadRole::Rest { unit: "rad" };
                let mut parts = vec![
                    LoadPart::Link(first),
                    LoadPart::Link(second),
                    amount("stiffness_N_m_rad", stiffness),
                    LoadPart::Number { role, name: "free_angle_rad", value: free_angle },
                ];
                parts.extend((*acts != Acts::Always).then_some(LoadPart::Acts(acts)));
                parts
            }
            Load::TorsionDamper { links: [first, second], damping } => {
                vec![LoadPart::Link(first), LoadPart::Link(second), amount("damping_N_m_s_rad", damping)]
            }
            Load::SlideForce { joint: _, links: [first, second], force, acts } => {
                let values = std::slice::from_mut(force);
                let courses = LoadPart::Courses { name: "force_N", values };
                vec![LoadPart::Link(first), LoadPart::Link(second), courses, LoadPart::Acts(acts)]
            }
            Load::SlideSpring { joint: _, links: [first, second], stiffness, free_slide, acts } => vec![
                LoadPart::Link(first),
                LoadPart::Link(second),
                amount("stiffness_N_m", stiffness),
                LoadPart::Number { role: LoadRole::Rest { unit: "m" }, name: "free_slide_m", value: free_slide },
                LoadPart::Acts(acts),
            ],
            Load::SlideDamper { joint: _, links: [first, second], damping } => {
                vec![LoadPart::Link(first), LoadPart::Link(second), amount("damping_N_s_m", damping)]
            }
            Load::Friction { joint: _, links: [first, second], coefficient, length } => vec![
                LoadPart::Link(first),
                LoadPart::Link(second),
                amount("coefficient", coefficient),
                LoadPart::Number { role: LoadRole::Extent, name: "length_m", value: length },
            ],
        }
    }

    /// Link on whose sense of rotation the load depends; `None` if there is no such link.
    #[inline]
    #[must_use]
    pub fn sensed_link(&self) -> Option<LinkId> {
        match self.nature().senses {
            Senses::Link(link) => Some(link),
            Senses::Nothing | Senses::Point(_) | Senses::Joint(_) => None,
        }
    }

    /// Point on whose direction of motion the load depends; `None` if there is no such point.
    #[must_use]
    pub fn sensed_point(&self) -> Option<JointSide> {
        match self.nature().senses {
            Senses::Point(at) => Some(at),
            Senses::Nothing | Senses::Link(_) | Senses::Joint(_) => None,
        }
    }

    /// Whether the load depends on a sense of motion.
    #[must_use]
    pub fn has_sense(&self) -> bool {
        self.nature().senses != Senses::Nothing
    }

    /// The joint on which the load acts; `None` for a load that acts on links or points.
    #[must_use]
    pub fn joint(&self) -> Option<JointId> {
        if let On::Joint(joint, _) = self.nature().on { Some(joint) } else { None }
    }

    /// Whether the load is a [`Load::Friction`].
    #[must_use]
    pub fn is_friction(&self) -> bool {
        self.friction().is_some()
    }

    /// Moment (N m) of a load with a [sensed link](Load::sensed_link), or force (N) of a [`Load::SlideForce`].
    /// The sign of `omega` is the link's sense of rotation or the sense of the sliding. `crank` is the crank angle
    /// (rad).
    /// A moment is zero at standstill, and so is a force limited to one sense of the sliding.
    /// The result is zero for any other load.
    #[inline]
    #[must_use]
    pub fn moment_in(&self, omega: f64, crank: f64) -> f64 {
        let [turns_forward, turns_back] = [omega > 0.0, omega < 0.0];
        if let Load::Resistance { moment, .. } = self {
            let back = if turns_back { *moment } else { 0.0 };
            return if turns_forward { -moment } else { back };
        }
        if let Load::SlideForce { force, acts, .. } = self {
            return if acts.has(omega) { force.at(crank) } else { 0.0 };
        }
        let Load::Moment { moment, acts, .. } = self else { return 0.0 };
        if *acts != Acts::Always && acts.has(omega) { moment.at(crank) } else { 0.0 }
    }

    /// Force (N) of a load with a [sensed point](Load::sensed_point).
    /// `way` is the point's direction of motion: a unit vector in world axes, or zero for standstill.
    /// The force is zero for a load without a sensed point.
    #[inline]
    #[must_use]
    pub fn force_in(&self, way: Vec2) -> Vec2 {
        if let Load::ResistingForce { force, .. } = self { way * -force } else { Vec2::zeros() }
    }

    /// Magnitude of the load's jump at the crank angle `crank` (rad), if the motion that determines the load's sense
    /// reverses at this angle.
    /// The jump is in N m, or in N for a force.
    /// For friction, the result is the jump per newton of the normal force.
    /// A load that depends on no sense of motion, or is zero at this crank angle, has no jump.
    /// A load without a jump has at most a kink.
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
            Senses::Joint(_) => {
                let [ahead, back] = [1.0, -1.0].map(|sense| self.moment_in(sense, crank));
                self.friction().map_or((ahead - back).abs(), |coefficient| 2.0 * coefficient)
            }
        }
    }

    /// Absolute value of the coefficient of a [friction](Load::Friction).
    fn friction(&self) -> Option<f64> {
        if let &Load::Friction { coefficient, .. } = self { Some(coefficient.abs()) } else { None }
    }

    /// For a [resistance](Load::Resistance): the loaded link and the magnitude of the moment (N m).
    /// Some engines and formats directly support no other load than a resistance.
    #[inline]
    #[must_use]
    pub fn resistance(&self) -> Option<(LinkId, f64)> {
        if let &Load::Resistance { link, moment } = self { Some((link, moment)) } else { None }
    }

    /// Whether the load depends on the magnitudes of speeds, and not only on their signs.
    #[must_use]
    pub fn is_viscous(&self) -> bool {
        self.nature().is_viscous
    }

    /// Whether the load depends on [`LoadState::angles`] or [`LoadState::crank`].
    #[must_use]
    pub fn needs_angles(&self) -> bool {
        self.nature().twist.is_some() || self.courses().any(|course| course.knots().is_some())
    }

    /// The parameters of the load that may depend on the crank angle.
    pub fn courses(&self) -> impl Iterator<Item = &Course> {
        self.nature().courses.iter()
    }

    /// Name of this kind of load in scenario files.
    #[must_use]
    pub fn sort(&self) -> &'static str {
        self.nature().sort
    }
}

/// Direction of a velocity: a unit vector, or zero at standstill.
/// The computation avoids squares of very small speeds, because they would underflow.
#[inline]
#[must_use]
pub fn sense_of(velocity: Vec2) -> Vec2 {
    let most = velocity.amax();
    if most > 0.0 { (velocity / most).normalize() } else { Vec2::zeros() }
}

/// World coordinates of both ends, and the vector from the first end to the second.
#[inline]
fn span(motions: &[Motion], ends: [JointSide; 2]) -> ([Vec2; 2], Vec2) {
    let places = ends.map(|end| motions[end.link].point(end.local));
    (places, places[1] - places[0])
}

/// Applies the force `pull` (N) to the first end and its reaction to the second end.
/// `pull` points towards the second end if the two ends attract each other.
#[inline]
fn pull_together(ends: [JointSide; 2], places: [Vec2; 2], pull: Vec2, put: &mut impl FnMut(Action)) {
    put(Action { link: ends[0].link, force: pull, place: places[0], moment: 0.0 });
    put(Action { link: ends[1].link, force: -pull, place: places[1], moment: 0.0 });
}

/// Force (N) or moment (N m) of a spring. The spring may act on only one side of its unloaded state.
#[inline]
fn spring(stiffness: f64, stretch: f64, acts: Acts) -> f64 {
    if acts.has(stretch) { stiffness * stretch } else { 0.0 }
}

#[inline]
fn twist_back(links: [LinkId; 2], moment: f64, put: &mut impl FnMut(Action)) {
    put(Action::of_moment(links[0], moment));
    put(Action::of_moment(links[1], -moment));
}

#[cfg(test)]
mod tests;
