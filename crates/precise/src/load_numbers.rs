//! The numbers of loads, in any scalar.

use linkage::case::CaseNumber;
use linkage::drive::{Acts, Course, Load};
use linkage::mechanism::{JointId, JointSide, LinkId};

use super::scalar::{Lift, LiftTable, Scalar};
use super::vector::Vector;

/// A load with its numbers.
#[derive(Clone, Debug)]
pub(crate) enum LoadNumbers<S> {
    Resistance {
        link: LinkId,
        moment: S,
    },
    Moment {
        link: LinkId,
        moment: CourseNumbers<S>,
        acts: Acts,
    },
    Force {
        link: LinkId,
        place: Vector<S>,
        force: [CourseNumbers<S>; 2],
        follows: bool,
    },
    ResistingForce {
        link: LinkId,
        place: Vector<S>,
        force: S,
    },
    Spring {
        links: [LinkId; 2],
        places: [Vector<S>; 2],
        stiffness: S,
        free_length: S,
    },
    Damper {
        links: [LinkId; 2],
        places: [Vector<S>; 2],
        damping: S,
    },
    TorsionSpring {
        links: [LinkId; 2],
        stiffness: S,
        free_angle: S,
        acts: Acts,
    },
    TorsionDamper {
        links: [LinkId; 2],
        damping: S,
    },
    SlideForce {
        joint: JointId,
        force: CourseNumbers<S>,
        acts: Acts,
    },
    SlideSpring {
        joint: JointId,
        stiffness: S,
        free_slide: S,
        acts: Acts,
    },
    SlideDamper {
        joint: JointId,
        damping: S,
    },
    /// Friction. Cases with friction are refused, so this load never acts.
    Friction,
}

/// A quantity that may depend on the input of the first drive.
#[derive(Clone, Debug)]
pub(crate) enum CourseNumbers<S> {
    Constant(S),
    /// A table, evaluated in doubles. `slopes` has one derivative of the table for each direction of differentiation.
    Table {
        table: Course,
        slopes: Vec<(S, Course)>,
    },
}

impl<S: Scalar> CourseNumbers<S> {
    /// The quantity at an input of the first drive.
    pub(crate) fn at(&self, input: S) -> S {
        match self {
            CourseNumbers::Constant(value) => *value,
            CourseNumbers::Table { table, slopes } => {
                let x = input.value();
                let steep = if let Course::Table { function, .. } = table { function.at(x)[1] } else { 0.0 };
                let own = S::of(table.at(x)) + (input - S::of(x)) * S::of(steep);
                slopes.iter().fold(own, |sum, (direction, slope)| sum + *direction * S::of(slope.at(x)))
            }
        }
    }
}

impl<S: Scalar> LoadNumbers<S> {
    pub(crate) fn of(load: &Load, number: usize, lift: Lift<S>, table: LiftTable<S>) -> Self {
        let part = |part: usize, value: f64| lift(CaseNumber::Load { load: number, part }, value);
        let course = |index: usize, own: &Course| match own {
            Course::Constant(value) => CourseNumbers::Constant(part(index, *value)),
            Course::Table { .. } => CourseNumbers::Table { table: own.clone(), slopes: table(number, index) },
        };
        let place = |end: usize, at: &JointSide| {
            let coordinate = |axis: usize, value: f64| lift(CaseNumber::LoadPlace { load: number, end, axis }, value);
            Vector { x: coordinate(0, at.local.x), y: coordinate(1, at.local.y) }
        };
        let places = |ends: &[JointSide; 2]| [place(0, &ends[0]), place(1, &ends[1])];
        let links = |ends: &[JointSide; 2]| ends.map(|end| end.link);
        match load {
            Load::Resistance { link, moment } => LoadNumbers::Resistance { link: *link, moment: part(0, *moment) },
            Load::Moment { link, moment, acts } => {
                LoadNumbers::Moment { link: *link, moment: course(0, moment), acts: *acts }
            }
            Load::Force { at, force, follows } => LoadNumbers::Force {
                link: at.link,
                place: place(0, at),
                force: [course(0, &force[0]), course(1, &force[1])],
                follows: *follows,
            },
            Load::ResistingForce { at, force } => {
                LoadNumbers::ResistingForce { link: at.link, place: place(0, at), force: part(0, *force) }
            }
            Load::Spring { ends, stiffness, free_length } => LoadNumbers::Spring {
                links: links(ends),
                places: places(ends),
                stiffness: part(0, *stiffness),
                free_length: part(1, *free_length),
            },
            Load::Damper { ends, damping } => {
                LoadNumbers::Damper { links: links(ends), places: places(ends), damping: part(0, *damping) }
            }
            Load::TorsionSpring { links, stiffness, free_angle, acts } => LoadNumbers::TorsionSpring {
                links: *links,
                stiffness: part(0, *stiffness),
                free_angle: part(1, *free_angle),
                acts: *acts,
            },
            Load::TorsionDamper { links, damping } => {
                LoadNumbers::TorsionDamper { links: *links, damping: part(0, *damping) }
            }
            Load::SlideForce { joint, links: _, force, acts } => {
                LoadNumbers::SlideForce { joint: *joint, force: course(0, force), acts: *acts }
            }
            Load::SlideSpring { joint, links: _, stiffness, free_slide, acts } => LoadNumbers::SlideSpring {
                joint: *joint,
                stiffness: part(0, *stiffness),
                free_slide: part(1, *free_slide),
                acts: *acts,
            },
            Load::SlideDamper { joint, links: _, damping } => {
                LoadNumbers::SlideDamper { joint: *joint, damping: part(0, *damping) }
            }
            Load::Friction { .. } => LoadNumbers::Friction,
        }
    }
}
