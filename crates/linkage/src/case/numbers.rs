//! Names of the numbers of a case. Results can be differentiated with respect to these numbers.

use super::Case;
use crate::drive::{Course, DriveMotion, Load, MotionLaw};
use crate::math::{Curve, Vec2};
use crate::mechanism::{JointId, JointSide, LinkId};

/// Name of one number of a case. `axis` is 0 for x and 1 for y.
/// `side` is 0 for the first link of a joint and 1 for the second link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CaseNumber {
    /// Coordinate of a point of a link (m).
    Point {
        /// The link.
        link: LinkId,
        /// Index of the point in the list of the link.
        point: usize,
        /// 0 for x, 1 for y.
        axis: usize,
    },
    /// Mass of a link (kg).
    Mass(LinkId),
    /// Coordinate of the mass centre of a link (m).
    Centre {
        /// The link.
        link: LinkId,
        /// 0 for x, 1 for y.
        axis: usize,
    },
    /// Moment of inertia of a link about its mass centre (kg m^2).
    Inertia(LinkId),
    /// Coordinate of a joint on one of the joint's links (m).
    Place {
        /// The joint.
        joint: JointId,
        /// 0 for the first link, 1 for the second.
        side: usize,
        /// 0 for x, 1 for y.
        axis: usize,
    },
    /// Component of the unit vector along the axis of a prismatic joint.
    Guide {
        /// The joint.
        joint: JointId,
        /// 0 for the first link, 1 for the second.
        side: usize,
        /// 0 for x, 1 for y.
        axis: usize,
    },
    /// Component of the acceleration of gravity (m/s^2).
    Gravity {
        /// 0 for x, 1 for y.
        axis: usize,
    },
    /// Coordinate of the driven joint at zero input (rad or m).
    Zero(usize),
    /// Input of a drive at t = 0 (rad or m).
    Start(usize),
    /// A number of a drive's law.
    /// Depending on the law, the numbers are: speed; speed and time; rise and time; amplitude, period and phase.
    /// A free motion has nominal and initial speed.
    Law {
        /// Number of the drive.
        drive: usize,
        /// Index of the number in this order.
        part: usize,
    },
    /// Coordinate of a point on which a load acts (m).
    LoadPlace {
        /// Number of the load.
        load: usize,
        /// 0 for the first or only point, 1 for the second.
        end: usize,
        /// 0 for x, 1 for y.
        axis: usize,
    },
    /// A number of a load, in the order of the fields of [`Load`].
    Load {
        /// Number of the load.
        load: usize,
        /// Index of the number.
        part: usize,
    },
}

impl Case {
    /// All numbers of the case with their names.
    /// Plane coordinates and vectors come first (links, joints, gravity, loads).
    /// Masses and moments of inertia, the numbers of drives and the numbers of loads follow.
    /// Tables, formulas, motors and transmissions are not included.
    /// Pose and grid are not included, because they follow from other numbers.
    #[must_use]
    pub fn numbers(&self) -> Vec<(CaseNumber, f64)> {
        let mut all = Vec::new();
        let mut plane = |of: &dyn Fn(usize) -> CaseNumber, v: Vec2| all.extend([(of(0), v.x), (of(1), v.y)]);
        for (link, body) in self.mechanism.links().entries() {
            for (point, own) in body.points.iter().enumerate() {
                plane(&|axis| CaseNumber::Point { link, point, axis }, own.local);
            }
            plane(&|axis| CaseNumber::Centre { link, axis }, body.mass_centre);
        }
        for (joint, own) in self.mechanism.joints().entries() {
            for (side, at) in [own.first, own.second].into_iter().enumerate() {
                plane(&|axis| CaseNumber::Place { joint, side, axis }, at.local);
            }
            for (side, guide) in own.kind.axes().into_iter().flatten().enumerate() {
                plane(&|axis| CaseNumber::Guide { joint, side, axis }, guide);
            }
        }
        plane(&|axis| CaseNumber::Gravity { axis }, self.gravity);
        for (load, own) in self.loads.iter().enumerate() {
            for (end, at) in load_places(own).into_iter().flatten().enumerate() {
                plane(&|axis| CaseNumber::LoadPlace { load, end, axis }, at.local);
            }
        }
        for (link, body) in self.mechanism.links().entries() {
            all.extend([(CaseNumber::Mass(link), body.mass), (CaseNumber::Inertia(link), body.inertia)]);
        }
        for (drive, own) in self.drives.iter().enumerate() {
            all.extend([(CaseNumber::Zero(drive), own.zero), (CaseNumber::Start(drive), own.start)]);
            let parts = law_numbers(&own.motion);
            all.extend(parts.into_iter().enumerate().map(|(part, value)| (CaseNumber::Law { drive, part }, value)));
        }
        for (load, own) in self.loads.iter().enumerate() {
            let parts = load_numbers(own).into_iter().enumerate();
            all.extend(parts.filter_map(|(part, value)| Some((CaseNumber::Load { load, part }, value?))));
        }
        all
    }
}

/// The numbers of a law, in the order of [`CaseNumber::Law`].
fn law_numbers(motion: &DriveMotion) -> Vec<f64> {
    match motion {
        DriveMotion::Prescribed { law, .. } => match law {
            MotionLaw::ConstantSpeed(speed) => vec![*speed],
            MotionLaw::Ramp { speed, time } => vec![*speed, *time],
            MotionLaw::Cycloidal { rise, time } => vec![*rise, *time],
            MotionLaw::Curve(curve) => match curve.as_ref() {
                Curve::Harmonic { amplitude, period, phase } => vec![*amplitude, *period, *phase],
                Curve::Table(_) | Curve::Formula(_) => Vec::new(),
            },
        },
        DriveMotion::Free { initial_speed, nominal_speed, .. } => vec![*nominal_speed, *initial_speed],
    }
}

/// The points on which a load acts, in the order of [`CaseNumber::LoadPlace`]. `None` for a load without points.
#[must_use]
pub fn load_places(load: &Load) -> Option<Vec<JointSide>> {
    match load {
        Load::Force { at, .. } | Load::ResistingForce { at, .. } => Some(vec![*at]),
        Load::Spring { ends, .. } | Load::Damper { ends, .. } => Some(ends.to_vec()),
        Load::Resistance { .. }
        | Load::Moment { .. }
        | Load::TorsionSpring { .. }
        | Load::TorsionDamper { .. }
        | Load::SlideForce { .. }
        | Load::SlideSpring { .. }
        | Load::SlideDamper { .. }
        | Load::Friction { .. } => None,
    }
}

/// The numbers of a load, in the order of its fields; `None` in place of a table.
fn load_numbers(load: &Load) -> Vec<Option<f64>> {
    let constant = |course: &Course| match course {
        Course::Constant(value) => Some(*value),
        Course::Table { .. } => None,
    };
    match load {
        Load::Resistance { moment, .. } => vec![Some(*moment)],
        Load::Moment { moment, .. } => vec![constant(moment)],
        Load::Force { force, .. } => force.iter().map(constant).collect(),
        Load::ResistingForce { force, .. } => vec![Some(*force)],
        Load::Spring { stiffness, free_length, .. } => vec![Some(*stiffness), Some(*free_length)],
        Load::Damper { damping, .. } | Load::TorsionDamper { damping, .. } | Load::SlideDamper { damping, .. } => {
            vec![Some(*damping)]
        }
        Load::TorsionSpring { stiffness, free_angle, .. } => vec![Some(*stiffness), Some(*free_angle)],
        Load::SlideForce { force, .. } => vec![constant(force)],
        Load::SlideSpring { stiffness, free_slide, .. } => vec![Some(*stiffness), Some(*free_slide)],
        Load::Friction { coefficient, length, .. } => vec![Some(*coefficient), Some(*length)],
    }
}
