//! Joint reactions group by group, last group first, and the balancing moments from the equilibrium of the driving
//! links.
//!
//! By d'Alembert's principle, every link carries m (g - a) at its mass centre, the moment -J alpha, its loads, and the
//! forces of the groups attached to it.
//! The files `rrr`, `sliding`, `shaped` and `higher` treat the groups, `driving` the driving links.

mod body;
mod driving;
mod friction;
mod higher;
mod rrr;
mod shaped;
mod sliding;

use crate::assur::groups::{SolutionPlan, Step};
use body::{Reactions, Settled};
use driving::Driving;
pub(crate) use friction::Dry;
use higher::Higher;
use linkage::case::Case;
use linkage::drive::{Load, Wrench};
use linkage::error::Result;
use linkage::input::Input;
use linkage::math::{Motion, Vec2};
use linkage::mechanism::LinkId;
use linkage::solver::State;
use linkage::work::{Count, WorkTally};
use rrr::Pinned;
use shaped::Formed;
use sliding::Sliding;

/// Force analysis of one group.
#[derive(Clone, Debug)]
enum Part {
    Pinned(Pinned),
    Sliding(Sliding),
    Formed(Formed),
    Higher(Higher),
}

/// The force analysis of a case, prepared to solve many poses without allocation.
#[derive(Clone, Debug)]
pub(super) struct Kinetostatics {
    parts: Vec<Part>,
    /// The driving links, outermost link first.
    drivers: Vec<Driving>,
    /// Loads on every link; empty if the case has neither loads nor friction.
    loads: Vec<Wrench>,
    /// One load per loaded link, if all loads are moments of resistance and there is no friction; otherwise `None`.
    /// Moments of resistance do not depend on the link's position.
    resistances: Option<Vec<(LinkId, Load)>>,
    /// Whether any drive moves a slide or a joint between moving links.
    drives_joints: bool,
    /// Two items: the solver for friction in joints and losses in transmissions, and the loads without friction.
    /// `None` if no joint has friction and no transmission has losses.
    dry: Option<Box<(Dry, Vec<Wrench>)>>,
    tally: WorkTally,
}

impl Kinetostatics {
    /// Prepares the groups in reverse order, then the driving links.
    pub(super) fn of(case: &Case, plan: &SolutionPlan) -> Self {
        let mut settled = Settled::nothing(&case.mechanism);
        let mut parts = Vec::with_capacity(case.structure.groups.len());
        for (step, group) in case.structure.groups.entries().rev() {
            parts.push(match &plan.steps()[step] {
                Step::Chain(chain) => Part::Higher(Higher::of(case, step, chain, &settled)),
                Step::Rrr(_) => Part::Pinned(Pinned::of(case, step, group, &settled)),
                Step::Shaped(dyad) => Part::Formed(Formed::of(case, step, group, dyad, &settled)),
                Step::Rrp(_) | Step::Rpr(_) | Step::Rpp(_) | Step::Prp(_) => {
                    Part::Sliding(Sliding::of(case, group, &settled))
                }
            });
            settled.add_group(group);
        }
        let mut drivers = Vec::with_capacity(case.drives.len());
        for (index, driver) in case.structure.leading().rev() {
            drivers.push(Driving::of(case, driver.link, driver.joint, index, &settled));
            settled.add(driver.joint);
        }
        let is_loaded = !case.loads.is_empty() || case.has_friction();
        let loads = if is_loaded { case.mechanism.links().len() } else { 0 };
        let dry = Dry::of(case).map(|dry| Box::new((dry, vec![Wrench::ZERO; loads])));
        let resistances = case.loads.iter().map(Load::resistance).collect::<Option<Vec<_>>>().map(merged);
        let resistances = resistances.filter(|_| dry.is_none());
        Kinetostatics {
            parts,
            drivers,
            loads: vec![Wrench::ZERO; loads],
            resistances,
            drives_joints: case.drives.iter().any(|drive| drive.input != Input::Angle),
            dry,
            tally: WorkTally::default(),
        }
    }

    /// Writes to `state` the reaction in every joint (first link on second; N, N m), the forces of the transmissions
    /// (N), and the balancing moments and driving forces (N m, N).
    /// The pose must be the last one that `plan` has solved. Loads that depend on link angles read them from `state`.
    ///
    /// # Errors
    /// The errors of [`Dry::settle`].
    pub(super) fn solve(&mut self, case: &Case, plan: &SolutionPlan, state: &mut State) -> Result<()> {
        if let Some(resistances) = &self.resistances {
            // The loads on links without a moment of resistance stay zero.
            for (link, load) in resistances {
                let moment = load.moment_in(case.spin(&state.motions, *link), 0.0);
                self.loads[*link] = Wrench { force: Vec2::zeros(), moment };
            }
        } else {
            case.loads_on(&state.motions, &state.angles, &mut self.loads);
        }
        if self.dry.is_some() {
            return self.rub(case, plan, state);
        }
        self.balance(case, plan, state);
        Ok(())
    }

    /// The solver for friction and losses; `None` if the case has neither.
    pub(super) fn dry(&mut self) -> Option<&mut Dry> {
        self.dry.as_mut().map(|dry| &mut dry.0)
    }

    /// Adds the friction to the loads, and solves.
    #[cold]
    fn rub(&mut self, case: &Case, plan: &SolutionPlan, state: &mut State) -> Result<()> {
        let Some(mut own) = self.dry.take() else { return Ok(()) };
        let (dry, loads) = &mut *own;
        loads.copy_from_slice(&self.loads);
        dry.sense(case, &state.motions);
        let found = dry.settle(case, state, &mut |efforts, state| {
            self.loads.copy_from_slice(loads);
            case.add_friction(efforts, &state.motions, &mut self.loads);
            self.balance(case, plan, state);
            Ok(())
        });
        self.dry = Some(own);
        found
    }

    /// Like [`Kinetostatics::solve`], with the given loads on all links.
    pub(super) fn solve_under(&mut self, loads: &[Wrench], case: &Case, plan: &SolutionPlan, state: &mut State) {
        let count = self.loads.len();
        self.loads.copy_from_slice(&loads[..count]);
        self.balance(case, plan, state);
    }

    fn balance(&mut self, case: &Case, plan: &SolutionPlan, state: &mut State) {
        self.tally.one(Count::Forces);
        let State { motions, forces, moments, transmitted, torques, .. } = state;
        let reactions = &mut Reactions { forces, moments, transmitted, efforts: torques, loads: &self.loads };
        for part in &mut self.parts {
            match part {
                Part::Pinned(part) => {
                    let Step::Rrr(dyad) = &plan.steps()[part.step] else { unreachable!("the step is an RRR dyad") };
                    part.solve(case, dyad, motions, reactions);
                }
                Part::Sliding(dyad) => dyad.solve(case, motions, reactions),
                Part::Formed(part) => {
                    let Step::Shaped(dyad) = &plan.steps()[part.step] else { unreachable!("the step is shaped") };
                    part.solve(case, dyad, motions, reactions);
                }
                Part::Higher(higher) => higher.solve(case, plan, motions, reactions),
            }
        }
        self.drivers.iter().for_each(|driver| driver.solve(case, motions, reactions));
        if self.drives_joints {
            self.part_efforts(case, motions, reactions);
        }
    }

    /// Subtracts the driving forces and moments from the reactions of the driven joints.
    fn part_efforts(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        for (drive, effort) in case.drives.iter().zip(reactions.efforts.iter()) {
            let joint = &case.mechanism.joints()[drive.joint];
            match drive.input {
                Input::Angle => {}
                Input::Turn => reactions.moments[drive.joint] = 0.0,
                Input::Slide => {
                    let axis = motions[joint.first.link].arm(joint.axis_on(joint.first.link).expect("it slides"));
                    reactions.forces[drive.joint] -= axis * *effort;
                }
            }
        }
    }
}

/// Merges the moments of resistance on the same link.
fn merged(resistances: Vec<(LinkId, f64)>) -> Vec<(LinkId, Load)> {
    let mut all: Vec<(LinkId, f64)> = Vec::new();
    for (link, moment) in resistances {
        match all.iter_mut().find(|(known, _)| *known == link) {
            Some((_, sum)) => *sum += moment,
            None => all.push((link, moment)),
        }
    }
    all.into_iter().map(|(link, moment)| (link, Load::Resistance { link, moment })).collect()
}
