//! Whole proofs on random mechanisms and at unfavourable instants: a correct solution must never have the verdict
//! disagree.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::Path;

use crate::common::draws;
use crate::common::higher::{Among, FAMILIES, mechanism};
use crate::common::random::{SORTS, chain, for_each_of, sample};
use crate::common::sketch::RandomSource;
use lab::specimens::driven::driven_elsewhere;
use lab::specimens::frictional::frictional;
use lab::specimens::geared::geared;
use linkage::error::ErrorKind;
use prover::run::{Options, prove};
use scenario::{EngineSetting, EngineSettings, Scenario};

/// Symptom: correct mechanisms disagree in their velocities, by up to twice the bound.
/// Cause: with too few sweeps, the velocities have an error of first order.
/// In the differences between runs, from which the bound is estimated, this error and the error of second order cancel.
/// A run with fewer sweeps reveals the error.
#[test]
fn regress_random_chains_of_rrr_dyads_never_disagree() {
    never_disagree(&SORTS[..1], draws(6));
}

/// Repeats the test of RRR dyads with all kinds of dyads.
/// Of sixty chains of up to three dyads, one has an error of first order in slide speeds; with 8192 sweeps this error
/// vanishes.
/// The fifteen chains of this test contain every kind of dyad alone, and chains of every length.
#[test]
fn regress_random_mechanisms_with_sliders_never_disagree() {
    never_disagree(&SORTS, draws(15));
}

fn never_disagree(sorts: &[[bool; 3]], count: usize) {
    let [proven, open, refused] = [const { Cell::new(0) }; 3];
    for_each_of(sorts, 3, count as u32, |sample| {
        let mut scenario = sample.scenario.clone();
        scenario.engine.step = EngineSetting::of(0.005 / scenario.case.crank().at(0.0).rate.abs());
        match prove(&scenario, &Options::default()) {
            Ok(proof) => {
                let word = proof.verdict.word();
                let wrong = proof.engine().channels.iter().filter(|channel| channel.verdict.word() == "disagree");
                let wrong: Vec<_> = wrong
                    .map(|c| {
                        format!(
                            "{} {:.2} order {:.3}",
                            c.residual.channel,
                            c.residual.max / c.bound,
                            c.convergence.observed
                        )
                    })
                    .collect();
                proptest::prop_assert!(word != "disagree", "{:?}: {:?}", proof.verdict, wrong);
                let count = if word == "agree" { &proven } else { &open };
                count.set(count.get() + 1);
            }
            // The engine starts a few steps before the grid.
            // In these steps, some mechanisms leave the range in which they can be assembled, so the errors listed
            // below are allowed.
            Err(error) => {
                let says = |words| error.message().contains(words);
                proptest::prop_assert!(
                    says("loop has opened")
                        || says("in one step")
                        || says("arrived at the start of the grid")
                        || says("another assembly mode"),
                    "{}",
                    error
                );
                refused.set(refused.get() + 1);
            }
        }
        Ok(())
    });
    println!("{} agree, {} inconclusive, {} refused", proven.get(), open.get(), refused.get());
    let (proven, open) = (proven.get(), open.get());
    assert!(2 * proven >= count, "only {proven} of {count} mechanisms are proven, {open} are inconclusive");
}

/// Most of these mechanisms are not driven at the crank, but by a slide or by an angle between moving links.
/// Half of the mechanisms get a wheel on gears or a belt; half of these are driven at the crank.
/// Half of all mechanisms have friction.
#[test]
fn random_mechanisms_driven_at_any_joint_never_disagree() {
    let mut random = RandomSource::from_seed(31);
    let mut counts = BTreeMap::new();
    while counts.values().sum::<usize>() < draws(12) {
        let dyads = 1 + random.index(3);
        let Some(specimen) = sample(chain(&mut random, &SORTS, dyads).0) else { continue };
        let case = specimen.scenario.case.clone();
        let case = match random.index(4) {
            0 => geared(&mut random, &case),
            1 => geared(&mut random, &case).and_then(|case| driven_elsewhere(&mut random, &case)),
            _ => driven_elsewhere(&mut random, &case),
        };
        let case = if random.yes() { case.and_then(|case| frictional(&mut random, &case)) } else { case };
        let Some(case) = case else { continue };
        // The proof chooses all settings.
        let scenario = Scenario { case, engine: EngineSettings::default(), ..specimen.scenario };
        let word = match prove(&scenario, &Options::default()) {
            Ok(proof) => {
                let formula = scenario.case.structure.formula(&scenario.case.mechanism);
                assert_ne!(proof.verdict.word(), "disagree", "{formula}: {:?}\n{}", proof.verdict, scenario.text);
                proof.verdict.word()
            }
            // The drive leads some mechanisms out of the range in which they can be assembled.
            Err(error) if matches!(error.kind(), ErrorKind::Geometry | ErrorKind::Numeric) => "refused",
            Err(error) => panic!("{error}"),
        };
        *counts.entry(word).or_insert(0) += 1;
    }
    println!("{counts:?}");
    assert!(2 * counts["agree"] >= counts.values().sum::<usize>(), "{counts:?}");
}

/// Work allowed to a proof, in steps.
/// If a proof is undecided after this work, its verdict is inconclusive, which the tests accept.
const WORK: f64 = 2e4;

/// Tests every family of higher groups.
/// The surroundings of the group change from family to family; with more draws, each family is tested in all
/// surroundings.
/// Symptom: three of the tested mechanisms disagreed falsely in velocities. Cause: the bound did not include the error
/// of the sweeps.
#[test]
fn regress_random_higher_groups_never_disagree() {
    let mut counts = BTreeMap::new();
    for (index, family) in FAMILIES.iter().enumerate() {
        let mut random = RandomSource::from_seed(30 + index as u8);
        let all = [Among::Alone, Among::BehindADyad, Among::CarryingADyad, Among::Alone];
        for among in (0..draws(1).min(all.len())).map(|k| all[(index + k) % all.len()]) {
            let mut drawn = std::iter::repeat_with(|| mechanism(&mut random, family, among).0.scenario()).take(100);
            let mut scenario = drawn.find_map(Result::ok).expect("a mechanism that can be assembled");
            scenario.engine.step = EngineSetting::of(0.005 / scenario.case.crank().at(0.0).rate.abs());
            let word = match prove(&scenario, &Options::default().budget(WORK)) {
                Ok(proof) => {
                    for channel in &proof.engine().channels {
                        let wrong = channel.verdict.word() == "disagree";
                        let used = channel.residual.max / channel.bound;
                        assert!(
                            !wrong,
                            "{family:?} {among:?}: {used:.2} {:?} {:?}\n{}",
                            channel.residual, channel.parts, scenario.text
                        );
                    }
                    proof.verdict.word()
                }
                // The analytic sides or the engine cannot reach a pose of this mechanism, so it counts as refused.
                Err(_) => "refused",
            };
            *counts.entry(word).or_insert(0) += 1;
        }
    }
    println!("{counts:?}");
    assert!(4 * counts["agree"] >= counts.values().sum::<usize>(), "{counts:?}");
}

/// Symptom: reactions disagree by 80 % at an instant a ten-thousandth of a degree before the rocker reverses. Cause:
/// the moment of resistance jumps when the rocker reverses, and the engine's rocker reverses slightly too early. The
/// verdict must not be `disagree`.
#[test]
fn regress_a_load_jump_within_the_engine_error_never_disagrees() {
    let text = include_str!("../../scenarios/crank_rocker.toml");
    let text = &text[..text.find("# The rocker's extreme").unwrap()];
    for extreme in [33.610_819_789_881_56, 234.862_320_107_189_36] {
        for offset in [-1e-4, -1e-6, 0.0, 1e-6, 1e-4] {
            let (from, to) = (extreme + offset - 90.0, extreme + offset + 90.0);
            let text = text.replace("from_deg = 0", &format!("from_deg = {from}"));
            let text = text.replace("to_deg = 360", &format!("to_deg = {to}")).replace("step_deg = 1", "step_deg = 10");
            let scenario = Scenario::parse(&text, Path::new("turning.toml")).unwrap();
            let proof = prove(&scenario, &Options::default()).unwrap();
            assert_ne!(proof.verdict.word(), "disagree", "{extreme} {offset}: {:?}", proof.verdict);
        }
    }
}
