use std::path::Path;

use super::{judged, load};
use crate::cli::tools::Place;
use crate::common::assert_within;
use analytic::PoseSolver;
use analytic::reduced::ReducedModel;
use scenario::{Claim, Formulas, Scenario};

fn scenario(name: &str) -> Scenario {
    load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml")))
}

/// Results of both analytic sides for a quantity reduced to the crank.
/// Each side gives two instants, each with crank angle, value and bound.
fn found(scenario: &Scenario, quantity: &str) -> Vec<[f64; 3]> {
    let mut formulas = Formulas::over(Vec::new());
    // The formula 1e6 is deliberately wrong: the judgement of a wrong formula reports the mechanism's value.
    let formula = formulas.add("other", "1e6").unwrap();
    formula.claim = Some(Claim::parse(quantity, &scenario.case).unwrap());
    let mut asked = scenario.clone();
    asked.formulas = formulas;
    let sides = judged(&asked).judgement.sides;
    let all = sides.iter().flat_map(|(_, all)| [all[0][0].since.unwrap(), all[0][0].worst.unwrap()]);
    all.map(|at| [at.crank, at.mechanism, at.bound]).collect()
}

/// The reduced model computes the reduced inertia and the reduced moment from transfer functions.
/// Each side computes the reduced inertia and the reduced moment from kinetic energy and power; the test compares the
/// results with those of the model.
#[test]
fn reduced_quantities_match_the_equation_of_motion() {
    for name in ["crank_rocker", "crank_rocker_runup", "class3_group", "compressor", "ov7_base", "quick_return"] {
        let scenario = scenario(name);
        let model = ReducedModel::of(&scenario.case).unwrap();
        let mut poses = PoseSolver::new(&scenario.case).unwrap();
        let way = scenario.case.crank().sense();
        for (quantity, is_inertia) in [("drive.reduced_inertia_kg_m2", true), ("drive.reduced_moment_N_m", false)] {
            for [crank, value, bound] in found(&scenario, quantity) {
                let own = model.at(&mut poses, crank, way).unwrap();
                let own = if is_inertia { own.inertia } else { own.applied };
                assert_within!(
                    (value - own).abs(),
                    2.0 * bound + 1e-12 * own.abs(),
                    "{name} {quantity} at {crank}: {value}, {own}"
                );
            }
        }
    }
}

/// A formula may claim a figure of the mechanism, such as the published mean over a revolution.
#[test]
fn figures_of_the_mechanism_may_be_claimed() {
    let place = Place::new();
    let check = |formula: &str| format!("check scenarios/crank_rocker.toml {formula} --channel figure.");
    place.ok(&format!("{}reduced_inertia_mean_kg_m2 --error 5e-7", check("0.164846")));
    // The rocker rotates over 32 degrees and back, against a moment of 100 N m.
    let exact = place.ok(&format!("{}reduced_resistance_mean_N_m", check("100*64/360")));
    assert!(!exact.contains("derivative"), "{exact}");
    let outcome = place.run(&format!("{}reduced_resistance_mean_N_m*2", check("17.7778")));
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
}

#[test]
fn meaningless_claims_are_refused_with_a_reason() {
    let place = Place::new();
    let inertia = "--channel drive.reduced_inertia_kg_m2";
    for (scenario, channel, words) in [
        ("five_bar", inertia, ["belongs to one crank", "2 drives"]),
        ("formulas/four_bar_freudenstein", inertia, ["has a mass", "mass_kg"]),
        ("crank_rocker", "--channel drive.reduced_inertia_kgm2", ["no channel", "drive.reduced_inertia_kg_m2"]),
        ("scotch_yoke", "--channel figure.steady_crank_speed_rad_s", ["a steady speed needs a motor", "[motor]"]),
        ("crank_rocker", "--channel figure.steady_crank_sped_rad_s", ["no channel", "figure.steady_crank_speed_rad_s"]),
    ] {
        place.refused(&format!("check scenarios/{scenario}.toml 1 {channel}"), &words);
    }
}

/// At instants when the crank is at rest, the division by the crank's speed is impossible.
/// Instants at which the crank is at rest are left out.
/// A crank that is at rest at all instants proves nothing.
#[test]
fn a_crank_at_rest_has_no_reduced_inertia() {
    let place = Place::new();
    let check = "check scenarios/crank_rocker_runup.toml 1 --channel drive.reduced_inertia_kg_m2";
    let json = place.run(&format!("{check} --error 10 --json -"));
    assert_eq!(json.code, 0, "{}", json.stderr);
    let json: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(json["formulas"][0]["undefined"].as_u64(), Some(1));
    let outcome = place.run(&format!("{check} --times 0"));
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    let words = "the claimed quantity has no value at any of 1 instants: it divides by zero";
    assert!(outcome.unbroken().contains(words), "{}", outcome.stdout);
}
