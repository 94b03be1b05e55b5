//! Prismatic joints in plans and drawings: the guide's link, the sliding point and the coincident point of the guide.

use super::names::{Named, NamedPoint, primed};
use linkage::case::{Case, Wanted};
use linkage::math::{KeepNan, Vec2, rotated};
use linkage::mechanism::{GROUND, JointId, JointSide, Mechanism};
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// Prismatic joint: a point of the block slides on a line of the guide.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide {
    /// Index of the joint.
    pub joint: JointId,
    /// The link of the guide, and the joint's point on this link.
    pub guide: JointSide,
    /// The link of the block, and the sliding point on this link.
    pub block: JointSide,
    /// Sliding point. If a rod slides in a block that only swings, the sliding point is a ground point.
    pub place: NamedPoint,
    /// Coincident point of a moving guide's link; `None` for a fixed guide.
    pub under: Option<Named>,
}

impl Slide {
    /// Position of the coincident point on the guide's link (m, link frame).
    pub fn place_under(&self, state: &State) -> Vec2 {
        let (guide, block) = (&state.motions[self.guide.link], &state.motions[self.block.link]);
        let back = Vec2::new(guide.direction.x, -guide.direction.y);
        rotated(back, block.point(self.block.local) - guide.origin)
    }

    /// Velocity and acceleration of the sliding point along the guide, relative to the guide's link, as world vectors
    /// (SI).
    pub fn rates(&self, mechanism: &Mechanism, state: &State) -> Option<[Vec2; 2]> {
        let joint = &mechanism.joints()[self.joint];
        let [_, speed, growth] = state.slide(joint)?;
        let axis = state.motions[self.guide.link].arm(joint.axis_on(self.guide.link)?);
        // A slide is measured from the first link to the second. If the guide is on the second link, the axis is
        // reversed.
        let axis = if joint.first.link == self.guide.link { axis } else { -axis };
        Some([axis * speed, axis * growth])
    }

    /// Distance along the guide's axis from the joint's point on the guide to the sliding point (m).
    fn way(&self, mechanism: &Mechanism, state: &State) -> f64 {
        let joint = &mechanism.joints()[self.joint];
        let slide = state.slide(joint).map_or(0.0, |slide| slide[0]);
        if joint.first.link == self.guide.link { slide } else { -slide }
    }
}

/// Returns all prismatic joints.
/// A sliding point without a name takes the name of its joint and is added to `places`.
pub fn slides(mechanism: &Mechanism, places: &mut Vec<NamedPoint>) -> Vec<Slide> {
    let mut all = Vec::new();
    // Coincident points must not have the letters of mass centres.
    let mut unders: Vec<Named> = mechanism
        .links()
        .ids()
        .skip(1)
        .map(|number| Named { name: format!("S{number}"), letter: format!("s{number}") })
        .collect();
    for (index, joint) in mechanism.joints().entries() {
        let Some([guide, block]) = mechanism.guide_and_block(joint) else { continue };
        let mut named = mechanism.links()[block.link].points.iter();
        let point = named.find(|point| point.local == block.local).map(|point| point.name.clone());
        let place = point.and_then(|name| places.iter().find(|place| place.named.name == name).cloned());
        let place = place.unwrap_or_else(|| {
            let new = NamedPoint { named: unused(joint.name.clone(), places, &[]), side: block, fixed: false };
            places.push(new.clone());
            new
        });
        let under = (guide.link != GROUND).then(|| {
            let name = &place.named.name;
            let apart = if name.ends_with(|sign: char| sign.is_ascii_digit()) { "/" } else { "" };
            unused(format!("{name}{apart}{}", guide.link), places, &unders)
        });
        unders.extend(under.clone());
        all.push(Slide { joint: index, guide, block, place, under });
    }
    all
}

/// Returns `name` and its letter in the plans.
/// If the name or the letter is taken, primes are appended to both.
fn unused(name: String, places: &[NamedPoint], others: &[Named]) -> Named {
    let name = primed(name, |name| {
        let letter = name.to_lowercase();
        // The poles of both plans have letters too, so these letters also count as taken.
        let mut taken = places.iter().map(|place| &place.named).chain(others);
        ["p", "π"].contains(&letter.as_str()) || taken.any(|other| other.name == name || other.letter == letter)
    });
    Named { letter: name.to_lowercase(), name }
}

/// For each slide: smallest and largest signed distance (m), along the guide's axis, from the joint's point on the
/// guide to the sliding point.
/// The distances are computed at `state` and on the case's grid, as far as the solver can follow the motion.
pub fn travels(case: &Case, solver: &dyn Solver, state: &State, slides: &[Slide]) -> Vec<[f64; 2]> {
    let mut travels: Vec<[f64; 2]> = slides.iter().map(|slide| [slide.way(&case.mechanism, state); 2]).collect();
    if slides.is_empty() {
        return travels;
    }
    let mut visit = |_: usize, state: &State| {
        for (travel, slide) in travels.iter_mut().zip(slides) {
            let way = slide.way(&case.mechanism, state);
            *travel = [travel[0].smaller(way), travel[1].larger(way)];
        }
        Ok(())
    };
    let case = case.wanting(Wanted::of(&[Stage::Positions]));
    // If the crank cannot reach the end of the grid, only the travel up to the last solved instant counts.
    let _ = solver.each(&case, &mut visit);
    travels
}
