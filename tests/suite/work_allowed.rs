//! Work limits: every costly operation counts as work, and a search without progress ends early.

use std::path::Path;

use analytic::range::{Range, explained};
use lab::mutate::{FaultyParty, MutationPlan, mutate};
use lab::stress::named;
use linkage::error::{Error, ErrorKind};
use linkage::work::{Count, Work, counted, limited};
use linkproof::parts::Advice;
use prover::run::{Options, Proof, SearchEnd, prove};
use scenario::Scenario;

use crate::common::shipped;

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/work_allowed").join(name);
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn proven(scenario: &Scenario, options: &Options) -> (Proof, Work) {
    counted(|| prove(scenario, options).unwrap_or_else(|error| panic!("{error}")))
}

/// Asserts that no step of an engine was run, and that the verdict states how much work the first runs would take.
fn assert_refused((proof, work): &(Proof, Work)) {
    let reason = proof.verdict.reason(Advice::to_string).unwrap_or_default();
    assert_eq!((proof.verdict.word(), work.of(Count::Steps)), ("inconclusive", 0), "{reason}");
    assert!(reason.contains("the first runs of the engine") && reason.contains("allow more work"), "{reason}");
}

#[test]
fn regress_substeps_count_as_work() {
    assert_refused(&proven(&scenario("substeps.toml"), &Options::default()));
    let many = Options::default().substeps(100_000).budget(1e4);
    assert_refused(&proven(&shipped("crank_rocker.toml"), &many));
    // The proof is also refused if all settings are given, so that no setting is left to search.
    let given = Options::default().step(1e-3).sweeps(64).extrapolated(0).substeps(usize::MAX >> 12);
    assert_refused(&proven(&shipped("crank_rocker.toml"), &given));
}

#[test]
fn regress_work_per_step_grows_with_the_mechanism() {
    let chain = named("chain").expect("there are chains");
    let case = (chain.setup)(100.0, 0, 0).unwrap().case;
    let large = Scenario::of_case("chain", case).unwrap();
    assert_refused(&proven(&large, &Options::default().budget(1e4)));
    // The limit also holds for a mechanism with 21 moving links.
    let (proof, work) = proven(&scenario("n_four_bar_10.toml"), &Options::default().budget(1e6));
    assert_eq!(proof.verdict.word(), "inconclusive");
    assert!(work.of(Count::Sweeps) < 3_000_000, "{work:?}");
}

/// Symptom: the range of a hundred four-bars was computed without end.
/// Cause: the poses of a range did not count as work, although each pose solves the equations of all links.
#[test]
fn regress_computing_a_range_counts_as_work() {
    let chain = named("chain").expect("there are chains");
    let large = (chain.setup)(100.0, 0, 0).unwrap().case;
    let (found, is_over) = limited(1e5, || Range::of(&large));
    let error = found.expect_err("a hundred four-bars are more than 1e5 steps");
    assert!(is_over && error.message().contains("1.0e5 steps") && !error.advice().is_empty(), "{error}");
    // The limit that is too small for the chain is enough for a single four-bar.
    let small = shipped("crank_rocker.toml").case;
    let (found, is_over) = limited(1e5, || Range::of(&small));
    assert!(found.is_ok_and(|range| range.links.len() == 3) && !is_over);
    // If the work limit ends the computation of the range, the error says that the range is not known.
    let out_of_reach = || Error::new(ErrorKind::Geometry, "the poses end").out_of_reach();
    let (told, _) = limited(10.0, || explained(&small, out_of_reach()));
    assert!(told.message().contains("are not known") && told.message().contains("1.0e1 steps"), "{told}");
    assert_eq!(explained(&small, out_of_reach()).message(), "the poses end");
}

/// Symptom: hundreds of faults, each a proof of a large mechanism, ran for hours.
#[test]
fn regress_planting_faults_keeps_to_the_work_limit() {
    let chain = named("chain").expect("there are chains");
    let large = Scenario::of_case("chain", (chain.setup)(100.0, 0, 0).unwrap().case).unwrap();
    let asked = MutationPlan { options: Options::default().budget(1e4), ..MutationPlan::default() };
    let (found, work) = counted(|| mutate(&large, &asked, &mut |_| {}));
    let error = found.err().expect("600 faults in 100 four-bars are too many");
    assert!(error.message().contains("planting") && error.message().contains("the work limit is 1.0e5"), "{error}");
    assert!(error.advice().iter().any(|own| own.to_string().contains("some kinds")), "{error}");
    // The counted work is that of the fault-free solutions of both analytic sides and the exact answers of side 1.
    // No step of an engine was run.
    assert!(work.of(Count::Groups) < 1_000_000 && work.of(Count::Steps) == 0, "{work:?}");
    let few = MutationPlan { kinds: vec!["gravity-sign".into()], parties: vec![FaultyParty::Assur], ..asked };
    assert_eq!(mutate(&large, &few, &mut |_| {}).unwrap().mutants.len(), 1);
}

/// Chains of parallelograms that swing through their change points.
/// The impulses do not converge at change points, and four rounds of the search are enough to show this.
/// Without this early end, the search spends 48 of 51 million sweeps on the impulses.
#[test]
fn regress_forces_without_progress_are_given_up_early() {
    let (proof, work) = proven(&shipped("n_four_bar_1.toml"), &Options::default());
    assert_eq!(proof.verdict.word(), "agree");
    let own = proof.engine().own_forces.as_ref().unwrap();
    assert_eq!(own.search.as_ref().map(|search| search.end), Some(SearchEnd::Pace));
    assert!(own.verdict.reason(Advice::to_string).unwrap().contains("at this rate of progress"), "{:?}", own.verdict);
    assert!(work.of(Count::Sweeps) < 5_000_000, "{work:?}");
}

/// The work for a proof of the engine's own forces has a limit.
/// If the proof of the motion alone takes more work than this limit, no search for settings for the forces follows.
/// Without this limit, the four-bar of this test takes 118 million sweeps.
#[test]
fn regress_forces_are_skipped_if_the_motion_used_their_work() {
    let (proof, work) = proven(&scenario("transmission_1_deg.toml"), &Options::default());
    assert_eq!(proof.verdict.word(), "agree");
    let own = proof.engine().own_forces.as_ref().unwrap();
    let reason = own.verdict.reason(Advice::to_string).unwrap();
    assert!(own.channels.is_empty() && reason.contains("the motion cost"), "{reason}");
    assert!(work.of(Count::Sweeps) < 40_000_000, "{work:?}");
}
