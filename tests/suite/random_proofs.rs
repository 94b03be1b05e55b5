//! Whole proofs on random mechanisms and at unfavourable instants: a correct solution must never be a disagreement.

use std::cell::Cell;
use std::path::Path;

use crate::common::higher::{Among, FAMILIES, mechanism};
use crate::common::random::{SORTS, for_each_of};
use crate::common::sketch::Random;
use linkproof::proof::{Options, prove};
use linkproof::scenario::{Scenario, Setting};

/// Symptom: correct mechanisms disagree in their velocities, by up to twice the bound. Cause: too few sweeps leave an
/// error of first order there. In the differences from which the bound is made, it cancels against the error of second
/// order. The run with fewer sweeps shows it.
#[test]
fn regress_random_chains_of_rrr_dyads_never_disagree() {
    never_disagree(&SORTS[..1], 3);
}

/// The same with all kinds of dyads. Of sixty chains of up to three, one keeps an error of first order in slide speeds,
/// which vanishes with 8192 sweeps.
#[test]
fn regress_random_mechanisms_with_sliders_never_disagree() {
    never_disagree(&SORTS, 3);
}

fn never_disagree(sorts: &[[bool; 3]], most: usize) {
    let [proven, open, refused] = [const { Cell::new(0) }; 3];
    for_each_of(sorts, most, 60, |sample| {
        let mut scenario = sample.scenario.clone();
        scenario.engine.step = Setting::of(0.005 / scenario.case.crank().at(0.0).omega.abs());
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
            // The run-up leads some mechanisms beyond the poses that can be assembled.
            Err(error) => {
                let says = |words| error.message().contains(words);
                proptest::prop_assert!(
                    says("loop has opened")
                        || says("in one step")
                        || says("came back to the start")
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
    assert!(proven.get() >= 30, "only {} of 60 mechanisms are proven, {} are left open", proven.get(), open.get());
}

/// A few of every family of higher groups in each surrounding. Before the error of the sweeps was counted, three of
/// these disagreed falsely in velocities.
#[test]
fn regress_random_higher_groups_never_disagree() {
    let mut counts = std::collections::BTreeMap::new();
    for (index, family) in FAMILIES.iter().enumerate() {
        let mut random = Random::from_seed(30 + index as u8);
        for among in [Among::Alone, Among::Alone, Among::BehindADyad, Among::CarryingADyad] {
            let (spec, _) = mechanism(&mut random, family, among);
            let Ok(mut scenario) = spec.scenario() else { continue };
            scenario.engine.step = Setting::of(0.005 / scenario.case.crank().at(0.0).omega.abs());
            let word = match prove(&scenario, &Options::default()) {
                Ok(proof) => {
                    for channel in &proof.engine().channels {
                        let wrong = channel.verdict.word() == "disagree";
                        let used = channel.residual.max / channel.bound;
                        assert!(
                            !wrong,
                            "{family:?} {among:?}: {used:.2} {:?} {:?}\n{}",
                            channel.residual,
                            channel.parts,
                            spec.toml()
                        );
                    }
                    proof.verdict.word()
                }
                // The pose is out of reach, for the references or for the engine.
                Err(_) => "refused",
            };
            *counts.entry(word).or_insert(0) += 1;
        }
    }
    println!("{counts:?}");
    assert!(counts["agree"] >= FAMILIES.len(), "{counts:?}");
}

/// Symptom: reactions disagree by 80 % at an instant a ten-thousandth of a degree before the rocker reverses. Cause:
/// the moment of resistance jumps there, and the engine's rocker reverses a moment earlier. The verdict must be
/// inconclusive.
#[test]
fn regress_a_load_that_jumps_within_the_engines_error_is_no_disagreement() {
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
