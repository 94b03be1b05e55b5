use std::collections::BTreeSet;

use super::kinds::{all, named};
use super::mutant::FaultyParty;
use super::plan::{MutationPlan, mutate};
use super::seen::FaultyProof;
use super::stage::Fault;
use super::stage::Stage;
use fixtures::of_repository;
use linkage::drive::load::Acts;
use linkage::drive::{Course, Load};
use prover::run::Options;
use scenario::Scenario;

fn scenario(name: &str) -> Scenario {
    of_repository(&format!("scenarios/{name}.toml"))
}

fn fault(name: &str, size: Option<f64>) -> Fault {
    let kind = named(name).unwrap_or_else(|| panic!("{name}"));
    Fault { kind, size: size.or(kind.size).unwrap_or(1.0) }
}

#[test]
fn kinds_of_faults_have_unique_names_and_descriptions() {
    let (names, sentences): (BTreeSet<&str>, BTreeSet<&str>) = all().map(|kind| (kind.name, kind.says)).unzip();
    assert!(all().count() >= 60);
    assert_eq!((names.len(), sentences.len()), (all().count(), all().count()));
    assert!(all().all(|kind| kind.size.is_none_or(|size| size > 0.0)));
    // `--kind` accepts names of kinds and of families, so no name may be both.
    assert!(all().all(|kind| !names.contains(kind.family.name())));
}

/// Reused runs give exactly the same outcomes and margins as new runs.
#[test]
fn reused_runs_give_the_same_outcome_as_new_ones() {
    let options = Options::default();
    for name in ["crank_rocker", "rotary_engine", "pendulum"] {
        let scenario = scenario(name);
        let used = Stage::new(&scenario, &options).unwrap();
        // `used` keeps the runs of the proof without a fault and of every earlier fault.
        // `new` keeps only the runs of the proof without a fault.
        for (kind, size) in [("moment", Some(1e-7)), ("angle", None), ("reaction", Some(1e-9)), ("omega", Some(1e-6))] {
            for party in [FaultyParty::Newton, FaultyParty::Engine] {
                let fault = fault(kind, size);
                let new = Stage::new(&scenario, &options).unwrap();
                assert_eq!(used.proven(fault, party), new.proven(fault, party), "{name}: {kind} in {}", party.name());
            }
        }
    }
}

/// At constant speed, the crank's moment of inertia has no effect. A fault in this moment of inertia does not count.
#[test]
fn a_fault_without_effect_is_not_counted() {
    let scenario = scenario("crank_rocker");
    let asked = MutationPlan { kinds: vec!["inertia-crank".into(), "inertia".into()], ..MutationPlan::default() };
    let found = mutate(&scenario, &asked, &mut |_| {}).unwrap();
    for mutant in &found.mutants {
        let is_none = matches!(mutant.outcome, FaultyProof::Equivalent(_));
        assert_eq!(is_none, mutant.kind.name == "inertia-crank", "{:?}", mutant.outcome);
    }
}

/// The rods of a parallelogram only translate, so their moments of inertia have no effect.
/// Symptom: a fault in such a moment of inertia was counted as a fault that the proof misses, although it changed only
/// the integration steps.
#[test]
fn regress_a_change_of_integration_steps_only_is_no_effect() {
    let scenario = scenario("n_four_bar_1");
    let asked = MutationPlan {
        kinds: vec!["inertia-about-joint".into()],
        parties: vec![FaultyParty::Assur],
        ..MutationPlan::default()
    };
    let options = Options::default().budget(1e6);
    let found = mutate(&scenario, &MutationPlan { options, ..asked }, &mut |_| {}).unwrap();
    assert!(matches!(found.mutants[0].outcome, FaultyProof::Equivalent(_)), "{:?}", found.mutants[0].outcome);
}

/// The smallest size is found to a factor of two: the returned size is detected, and half of the returned size is not.
#[test]
fn half_the_smallest_detected_size_is_not_detected() {
    let (scenario, options) = (scenario("crank_rocker"), Options::default());
    let stage = Stage::new(&scenario, &options).unwrap();
    for (name, party) in [("mass-heaviest", FaultyParty::Assur), ("moment", FaultyParty::Engine)] {
        let asked = MutationPlan {
            kinds: vec![name.into()],
            parties: vec![party],
            with_sizes: true,
            ..MutationPlan::default()
        };
        let found = mutate(&scenario, &asked, &mut |_| {}).unwrap();
        let smallest = found.mutants[0].smallest.unwrap();
        assert!(stage.proven(fault(name, Some(smallest)), party).is_found(), "{name}: {smallest:e}");
        assert!(!stage.proven(fault(name, Some(0.49 * smallest)), party).is_found(), "{name}: {smallest:e}");
    }
}

/// Symptom: no shipped scenario revealed these faults of sliders and guides, because none had the affected features.
/// The three scenarios of this test have the affected features: a slider on a moving guide, the moment of a guide in a
/// higher group, and a slider of the spanning tree that carries another slider.
#[test]
fn faults_of_sliders_on_moving_guides_are_found_in_every_party() {
    let kinds = ["coriolis-missing", "velocity-guide", "guide-moment-missing", "guide-moment-sign", "guide-aside"];
    for (name, without) in [("rotary_engine", 0), ("guided_group", 0), ("offset_press", 2)] {
        let asked = MutationPlan { kinds: kinds.map(String::from).to_vec(), ..MutationPlan::default() };
        let found = mutate(&scenario(name), &asked, &mut |_| {}).unwrap();
        assert_eq!((found.verdict, found.without.len()), ("agree", without), "{name}: {:?}", found.without);
        for mutant in &found.mutants {
            assert!(mutant.outcome.is_found(), "{name}: {} in {}", mutant.kind.name, mutant.party.name());
        }
    }
}

/// The fault `load-always` has an effect only if the loaded link reverses.
/// No shipped scenario has a reversing crank with such a load, so the moment acts on a rocker here.
#[test]
fn a_one_sided_moment_that_always_acts_is_found_in_every_party() {
    let mut rocking = scenario("crank_rocker");
    let rocker = rocking.case.mechanism.link_named("rocker").unwrap();
    let load = Load::Moment { link: rocker, moment: Course::Constant(-0.5), acts: Acts::Clockwise };
    rocking.case = rocking.case.with(|parts| parts.loads.push(load)).unwrap();
    rocking.oracles.clear();
    let asked = MutationPlan { kinds: vec!["load-always".into()], ..MutationPlan::default() };
    let found = mutate(&rocking, &asked, &mut |_| {}).unwrap();
    assert_eq!((found.verdict, found.mutants.len()), ("agree", 4));
    for mutant in found.mutants.iter().filter(|mutant| mutant.party != FaultyParty::All) {
        assert!(mutant.outcome.is_found(), "in {}", mutant.party.name());
    }
}

/// The comparison of the parties cannot find a fault in code that all parties share. External reference numbers reveal
/// such a fault.
#[test]
fn a_shared_gravity_fault_is_found_only_by_external_numbers() {
    let asked =
        MutationPlan { kinds: vec!["gravity-sign".into()], parties: vec![FaultyParty::All], ..MutationPlan::default() };
    let with = scenario("quick_return");
    let without = Scenario { oracles: Vec::new(), ..with.clone() };
    let outcome = |scenario: &Scenario| mutate(scenario, &asked, &mut |_| {}).unwrap().mutants.remove(0).outcome;
    assert!(outcome(&with).is_found());
    assert_eq!(outcome(&without), FaultyProof::Escaped);
}
