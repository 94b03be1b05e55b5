//! Joint reactions group by group, last group first, and the balancing moment from the driving link's equilibrium.
//!
//! D'Alembert: every link carries m (g - a) at its mass centre, the moment -J alpha, its loads, and the forces of the
//! groups that hang on it; see `dyad` for the equations of the dyads.

mod body;
mod dyad;
mod higher;

use crate::assur::{Plan, Step};
use crate::case::Case;
use crate::math::Motion;
use body::{Action, Body};
use dyad::Dyad;
use higher::Higher;

pub(crate) use body::Reactions;

/// One group, seen from its forces.
#[derive(Clone, Debug)]
enum Part {
    Dyad(Dyad),
    Higher(Higher),
}

/// The force analysis of a case, ready for pose after pose without allocation.
#[derive(Clone, Debug)]
pub(super) struct Kinetostatics {
    parts: Vec<Part>,
    driver: Body,
    pivot: Action,
}

impl Kinetostatics {
    /// Prepares the groups in reverse order, then the driving link.
    pub(super) fn of(case: &Case, plan: &Plan) -> Self {
        let mut settled = vec![false; case.mechanism.joints().len()];
        let mut parts = Vec::with_capacity(case.structure.groups.len());
        for (step, group) in case.structure.groups.iter().enumerate().rev() {
            parts.push(match &plan.steps()[step] {
                Step::Chain(chain) => Part::Higher(Higher::of(case, step, chain, &settled)),
                _ => Part::Dyad(Dyad::of(case, group, &settled)),
            });
            group.inner.iter().chain(&group.outer).for_each(|&joint| settled[joint] = true);
        }
        let driver = Body::of(case, case.drive.link, &settled);
        Kinetostatics { parts, driver, pivot: Action::of(case, case.drive.joint, case.drive.link) }
    }

    /// Fills in what the first link exerts on the second in every joint and returns the balancing moment on the driving
    /// link (N m), from its equilibrium about the pivot. The pose must be the last one that `plan` has solved.
    pub(super) fn solve(&mut self, case: &Case, plan: &Plan, motions: &[Motion], mut reactions: Reactions) -> f64 {
        let reactions = &mut reactions;
        for part in &mut self.parts {
            match part {
                Part::Dyad(dyad) => dyad.solve(case, motions, reactions),
                Part::Higher(higher) => higher.solve(case, plan, motions, reactions),
            }
        }
        let pole = self.pivot.place(motions);
        let (force, moment) = self.driver.resultant(case, motions, reactions, pole);
        self.pivot.put(-force, reactions);
        -moment
    }
}
