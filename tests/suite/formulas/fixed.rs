//! Formulas that are wrong by a fixed relative error, not by a multiple of their bounds.

use std::path::Path;

use linkproof::{Options, prove};
use prover::check::FormulaOutcome;
use scenario::Scenario;

use super::{judged, load, rewritten};

/// Outcomes of both analytic sides for the value of a formula.
fn outcomes(scenario: &Scenario, name: &str) -> Vec<FormulaOutcome> {
    let all = judged(scenario).judgement.sides;
    let own = all.iter().flat_map(|(_, all)| all.iter().flatten()).filter(|own| own.name == name && own.order == 0);
    own.map(|own| own.outcome()).collect()
}

/// Positions are known to a relative error of 1e-12, accelerations and forces to 1e-10.
/// A relative error of 1e-9 is therefore wrong.
#[test]
fn a_formula_that_is_a_billionth_too_large_is_wrong() {
    for file in ["slider_crank_centric", "four_bar_centres", "slider_crank_balance", "unbalanced_rotor"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenarios/formulas/{file}.toml"));
        let scenario = load(&path);
        let mut count = 0;
        for (formula, _) in scenario.formulas.claims().filter(|(formula, _)| formula.error.is_none()) {
            let (name, text) = (&formula.name, &formula.text);
            let right = outcomes(&rewritten(&scenario, name, text), name);
            assert!(right.iter().all(|own| *own == FormulaOutcome::Right), "{file}: {name}: {right:?}");
            let more = rewritten(&scenario, name, &format!("({text})*(1 + 1e-9)"));
            let wrong = outcomes(&more, name);
            // A formula that is zero stays zero when multiplied by 1 + 1e-9.
            let vanishes = ["0", "0.0"].contains(&text.as_str());
            assert!(
                vanishes || wrong.iter().all(|own| *own == FormulaOutcome::Wrong),
                "{file}: {name} = {text}: {wrong:?}"
            );
            count += usize::from(!vanishes);
        }
        assert!(count >= 3, "{file}: {count}");
    }
}

/// A formula in degrees is already wrong with a relative error of 1e-10.
/// The conversion to degrees does not widen the bound, because the conversion factor is known to its last digit.
#[test]
fn a_formula_in_degrees_is_judged_as_strictly() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let claimed = |text: &str| {
        let more =
            format!("\n[[formula]]\nname = \"turned\"\nexpression = \"{text}\"\nchannel = \"link.crank.angle_deg\"\n");
        let whole = std::fs::read_to_string(&path).unwrap() + &more;
        outcomes(&Scenario::parse(&whole, &path).unwrap(), "turned")
    };
    assert!(claimed("phi*180/pi").iter().all(|own| *own == FormulaOutcome::Right));
    assert!(claimed("phi*180/pi*(1 + 1e-10)").iter().all(|own| *own == FormulaOutcome::Wrong));
}

/// A few instants at which cancellation leaves fewer than six digits do no harm.
/// If cancellation affects most instants, the formula is neither right nor wrong.
#[test]
fn a_formula_that_loses_its_digits_at_most_instants_proves_nothing() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/formulas/slider_crank_centric.toml");
    let scenario = load(&path);
    // A number that grows with the crank angle is added and subtracted again.
    // From 40 deg after `from_deg` on, the cancellation loses too many digits.
    let with = |from_deg: f64| {
        let large = format!("1e3*exp(20*(phi - {from_deg}*pi/180))");
        let text = format!("r*cos(phi) + sqrt(l^2 - r^2*sin(phi)^2) + {large} - {large}");
        outcomes(&rewritten(&scenario, "x", &text), "x")
    };
    for own in with(36.0) {
        assert!(
            matches!(&own, FormulaOutcome::Open { reason, .. } if reason.contains("fewer than six digits")),
            "{own:?}"
        );
    }
    assert!(with(340.0).iter().all(|own| *own == FormulaOutcome::Right), "{:?}", with(340.0));
}

/// A wave that vanishes at every instant of the grid is invisible in the value, but its derivative reveals it.
/// If a formula is claimed for one instant only, its derivative is not judged.
#[test]
fn a_formula_right_only_at_the_instants_fails_by_its_rate() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/formulas/slider_crank_centric.toml");
    let scenario = load(&path);
    let orders = |scenario: &Scenario| -> Vec<Vec<(usize, bool)>> {
        let sides = judged(scenario).judgement.sides;
        let of = |all: &Vec<Vec<prover::check::JudgedFormula>>| {
            all.iter().flatten().map(|own| (own.order, own.outcome() == FormulaOutcome::Right)).collect()
        };
        sides.iter().map(|(_, all)| of(all)).collect()
    };
    // The grid has steps of 4 deg, and the added wave and its curvature are zero at every step.
    let wave = rewritten(&scenario, "x", "r*cos(phi) + sqrt(l^2 - r^2*sin(phi)^2) + 1e-3*sin(45*phi)");
    assert_eq!(orders(&wave), vec![vec![(0, true), (1, false), (2, true)]; 2]);
    let mut instant = rewritten(&scenario, "x", "r*cos(pi/3) + sqrt(l^2 - r^2*sin(pi/3)^2)");
    for own in instant.formulas.list.iter_mut().filter(|own| own.name == "x") {
        own.valid = [Some(60f64.to_radians()); 2];
    }
    assert_eq!(orders(&instant), vec![vec![(0, true)]; 2]);
}

/// The check of a wrong formula has the verdict "disagree", and its value is the largest difference.
#[test]
fn a_formula_check_gives_the_largest_difference() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/formulas/slider_crank_centric.toml");
    let scenario = rewritten(&load(&path), "x", "r*cos(phi) + sqrt(l^2 - r^2*sin(phi)^2) + 1e-6");
    assert_eq!(judged(&scenario).verdict.word(), "disagree");
    let proof = prove(&scenario, &Options::default().step(1e-3).sweeps(16).extrapolated(0)).unwrap();
    let own =
        proof.all_checks().filter(|check| check.family.starts_with("formulas") && check.detail.starts_with("x as"));
    let own: Vec<_> = own.map(|check| (check.verdict.word(), (check.value * 1e9).round())).collect();
    assert_eq!(own, [("disagree", 1000.0); 2]);
}

/// A formula with a finding must disagree.
/// A finding states that a formula is wrong, so a right formula with a finding is a fault of the file.
#[test]
fn a_formula_with_a_finding_must_disagree() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/formulas/yoke_drive.toml");
    let with = |expression: &str| {
        let more = format!(
            "\n[[formula]]\nname = \"printed\"\nexpression = \"{expression}\"\nchannel = \"point.A.vx_m_s\"\n\
             finding = \"why\"\n"
        );
        Scenario::parse(&(std::fs::read_to_string(&path).unwrap() + &more), &path).unwrap()
    };
    let [right, wrong] = ["-r*w*sin(phi)", "-r*sin(phi)"].map(with);
    let expected = FormulaOutcome::Expected { finding: "why".into() };
    assert_eq!(outcomes(&wrong, "printed"), vec![expected; 2]);
    assert_eq!(outcomes(&right, "printed"), vec![FormulaOutcome::Wrong; 2]);
    assert_eq!(judged(&wrong).verdict.word(), "agree");
    let found = judged(&right);
    assert_eq!(found.verdict.word(), "disagree");
    assert!(found.judgement.causes.is_empty(), "{:?}", found.judgement.causes);
    let proof = prove(&wrong, &Options::default()).unwrap();
    let check = proof.all_checks().find(|check| check.name().contains("printed as")).unwrap();
    assert_eq!((proof.verdict.word(), check.verdict.word()), ("agree", "expected"));
}
