//! Work that is allowed: whatever costs time counts, and a search that cannot decide is given up early.

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

/// Nothing of an engine was run, and the verdict says what would have to be allowed.
fn assert_refused((proof, work): &(Proof, Work)) {
    let reason = proof.verdict.reason(Advice::to_string).unwrap_or_default();
    assert_eq!((proof.verdict.word(), work.of(Count::Steps)), ("inconclusive", 0), "{reason}");
    assert!(reason.contains("the first runs of the engine") && reason.contains("allow more work"), "{reason}");
}

#[test]
fn regress_substeps_are_work() {
    assert_refused(&proven(&scenario("substeps.toml"), &Options::default()));
    let many = Options::default().substeps(100_000).budget(1e4);
    assert_refused(&proven(&shipped("crank_rocker.toml"), &many));
    // Also where nothing is left to find.
    let given = Options::default().step(1e-3).sweeps(64).extrapolated(0).substeps(usize::MAX >> 12);
    assert_refused(&proven(&shipped("crank_rocker.toml"), &given));
}

#[test]
fn regress_a_step_of_a_large_mechanism_is_more_work() {
    let chain = named("chain").expect("there are chains");
    let case = (chain.setup)(100.0, 0, 0).unwrap().case;
    let large = Scenario::of_case("chain", case).unwrap();
    assert_refused(&proven(&large, &Options::default().budget(1e4)));
    // What a run allows is kept to, whatever the mechanism: here some 21 moving links.
    let (proof, work) = proven(&scenario("n_four_bar_10.toml"), &Options::default().budget(1e6));
    assert_eq!(proof.verdict.word(), "inconclusive");
    assert!(work.of(Count::Sweeps) < 3_000_000, "{work:?}");
}

/// Poses of a range, of which each needs systems of all links, were nobody's work: a hundred four-bars had no end.
#[test]
fn regress_the_range_of_a_large_mechanism_is_work() {
    let chain = named("chain").expect("there are chains");
    let large = (chain.setup)(100.0, 0, 0).unwrap().case;
    let (found, is_over) = limited(1e5, || Range::of(&large));
    let error = found.expect_err("a hundred four-bars are more than 1e5 steps");
    assert!(is_over && error.message().contains("1.0e5 steps") && !error.advice().is_empty(), "{error}");
    // A four-bar is little work, and what is left of it is not lost.
    let small = shipped("crank_rocker.toml").case;
    let (found, is_over) = limited(1e5, || Range::of(&small));
    assert!(found.is_ok_and(|range| range.links.len() == 3) && !is_over);
    // An error is explained as far as that is allowed, and says where it is not.
    let out_of_reach = || Error::new(ErrorKind::Geometry, "the poses end").out_of_reach();
    let (told, _) = limited(10.0, || explained(&small, out_of_reach()));
    assert!(told.message().contains("is not known") && told.message().contains("1.0e1 steps"), "{told}");
    assert_eq!(explained(&small, out_of_reach()).message(), "the poses end");
}

/// Hundreds of faults, each of them a proof of a large mechanism, went on for hours.
#[test]
fn regress_faults_are_planted_within_the_work_that_is_allowed() {
    let chain = named("chain").expect("there are chains");
    let large = Scenario::of_case("chain", (chain.setup)(100.0, 0, 0).unwrap().case).unwrap();
    let asked = MutationPlan { options: Options::default().budget(1e4), ..MutationPlan::default() };
    let (found, work) = counted(|| mutate(&large, &asked, &mut |_| {}));
    let error = found.err().expect("600 faults in 100 four-bars are too many");
    assert!(error.message().contains("planting") && error.message().contains("1.0e5 are allowed"), "{error}");
    assert!(error.advice().iter().any(|own| own.to_string().contains("some kinds")), "{error}");
    // Both sides without a fault, and once more their exact answers; no step of an engine.
    assert!(work.of(Count::Groups) < 1_000_000 && work.of(Count::Steps) == 0, "{work:?}");
    let few = MutationPlan { kinds: vec!["gravity-sign".into()], parties: vec![FaultyParty::Assur], ..asked };
    assert_eq!(mutate(&large, &few, &mut |_| {}).unwrap().mutants.len(), 1);
}

/// Chains that swing through their change points: impulses there do not converge, and four rounds show it. Before, they
/// took 48 of 51 million sweeps.
#[test]
fn regress_forces_that_no_step_makes_better_are_given_up_in_their_first_rounds() {
    let (proof, work) = proven(&shipped("n_four_bar_1.toml"), &Options::default());
    assert_eq!(proof.verdict.word(), "agree");
    let own = proof.engine().own_forces.as_ref().unwrap();
    assert_eq!(own.search.as_ref().map(|search| search.end), Some(SearchEnd::Pace));
    assert!(own.verdict.reason(Advice::to_string).unwrap().contains("at the pace of its rounds"), "{:?}", own.verdict);
    assert!(work.of(Count::Sweeps) < 5_000_000, "{work:?}");
}

/// Where the motion alone has taken more than the forces that the engine exerts may take, these are not begun. Before,
/// this four-bar took 118 million sweeps.
#[test]
fn regress_forces_are_not_searched_where_their_motion_took_more_than_they_may() {
    let (proof, work) = proven(&scenario("transmission_1_deg.toml"), &Options::default());
    assert_eq!(proof.verdict.word(), "agree");
    let own = proof.engine().own_forces.as_ref().unwrap();
    let reason = own.verdict.reason(Advice::to_string).unwrap();
    assert!(own.channels.is_empty() && reason.contains("the motion has taken the work of"), "{reason}");
    assert!(work.of(Count::Sweeps) < 40_000_000, "{work:?}");
}
