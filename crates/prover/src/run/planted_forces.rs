//! Faults that only one of the two judgements of an engine's forces can find.

use super::judge::Judge;
use super::known::Known;
use super::ledger::Ledger;
use super::observe::{Watch, observe};
use super::options::Chosen;
use super::problem::Problem;
use super::{EngineProof, ForceFault, engines, settle};
use crate::engines::coarse_step;
use analytic::{AssurSolver, NewtonSolver};
use fixtures::of_repository;
use linkage::case::Case;
use linkage::engine::{Engine, Hook, Route, Settings, Wrapped};
use linkage::math::rotated;
use linkage::mechanism::{JointId, LinkId};
use linkage::solver::{Solver, State};
use rapier_twin::{Build, Precision, Rapier};
use scenario::EngineSettings;

/// Effect of a fault on every state.
type Fault = fn(&mut State);

/// A fault in an engine's states that occurs only with some routes to the forces.
#[derive(Clone, Copy)]
struct ByRoute {
    fault: Fault,
    by: &'static [Route],
    /// The route of the engine.
    route: Route,
}

impl Hook for ByRoute {
    fn answer(&self, _: &Case, _: usize, state: &mut State) {
        if self.by.contains(&self.route) {
            (self.fault)(state);
        }
    }

    fn with(&self, _: Settings, to: Settings) -> Self {
        ByRoute { route: to.route, ..*self }
    }
}

fn proven(name: &str, by: &'static [Route], fault: Fault) -> EngineProof {
    let scenario = of_repository(&format!("scenarios/{name}.toml"));
    let case = &scenario.case;
    let seen = |solver: &dyn Solver| {
        observe(case, solver, Watch::Side, &mut |_| {}).unwrap_or_else(|stopped| panic!("{}", stopped.error))
    };
    let sides = [seen(&AssurSolver), seen(&NewtonSolver)];
    let known = Known::of(case, [&sides[0].trajectory, &sides[1].trajectory]).unwrap();
    let inner: Box<dyn Engine> = Box::new(Rapier::new(Build::Multibody, Precision::Double, coarse_step(case)));
    let hook = ByRoute { fault, by, route: inner.settings().route };
    let engine = Box::new(Wrapped { hook, inner });
    let chosen = Chosen { engine, given: EngineSettings::default(), budget: settle::BUDGET };
    let judge = Judge::new(Problem::of(&scenario, case), &sides[0], &known, chosen.engine.settings());
    engines::prove(&judge, case, &chosen, &mut Ledger::default(), &mut |_| {}).unwrap()
}

const EXERTED: &[Route] = &[Route::Native, Route::Probe];
const FOLLOWED: &[Route] = &[Route::Differences];

/// Disagreeing channels of the engine's own forces.
fn against(proof: &EngineProof) -> Vec<String> {
    let own = proof.own_forces.as_ref().expect("there are own forces");
    let wrong = own.channels.iter().filter(|own| own.verdict.word() == "disagree");
    wrong.map(|own| own.residual.channel.to_string()).collect()
}

fn nothing(_: &mut State) {}

/// The components of one force are given in the frame of a link instead of the world frame.
fn in_a_link_s_frame(state: &mut State) {
    state.forces[JointId(1)] = rotated(state.motions[LinkId(1)].direction, state.forces[JointId(1)]);
}

fn a_fiftieth_more(state: &mut State) {
    state.forces.iter_mut().for_each(|force| *force *= 1.02);
}

#[test]
fn correct_forces_agree_by_both_methods() {
    for name in ["crank_rocker", "scotch_yoke", "double_pendulum"] {
        let proof = proven(name, EXERTED, nothing);
        assert_eq!((proof.verdict.word(), proof.force_fault()), ("agree", None), "{name}");
    }
}

#[test]
fn wrong_impulses_are_found_despite_a_correct_motion() {
    for name in ["crank_rocker", "double_pendulum"] {
        let proof = proven(name, EXERTED, a_fiftieth_more);
        assert!(proof.channels.iter().all(|channel| channel.verdict.word() == "agree"), "{name}");
        assert_eq!((proof.verdict.word(), proof.force_fault()), ("disagree", Some(ForceFault::Exerted)), "{name}");
        assert!(!against(&proof).is_empty(), "{name}");
    }
}

#[test]
fn a_force_in_the_wrong_frame_is_found_in_dependent_channels() {
    let proof = proven("crank_rocker", EXERTED, in_a_link_s_frame);
    assert_eq!(proof.force_fault(), Some(ForceFault::Exerted));
    let found = against(&proof);
    assert!(found.contains(&"joint.A.fx_N".to_string()), "{found:?}");
    assert!(!found.iter().any(|name| name.starts_with("joint.C") || name.starts_with("drive")), "{found:?}");
}

#[test]
fn wrong_newton_euler_equations_are_identified() {
    let proof = proven("crank_rocker", FOLLOWED, in_a_link_s_frame);
    assert_eq!((proof.verdict.word(), proof.force_fault()), ("disagree", Some(ForceFault::Reading)));
    assert!(against(&proof).is_empty());
}

#[test]
fn a_fault_in_both_methods_is_identified() {
    let proof = proven("crank_rocker", &Route::ALL, a_fiftieth_more);
    assert_eq!((proof.verdict.word(), proof.force_fault()), ("disagree", Some(ForceFault::Both)));
}
