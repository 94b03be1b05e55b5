//! Formulas that are wrong by a fixed share of themselves, not by a multiple of their bounds.

use std::path::Path;

use linkproof::claims::Outcome;
use linkproof::scenario::Scenario;

use super::{judged, load, rewritten};

/// Whether both sides call a formula right, or wrong, by value.
fn outcomes(scenario: &Scenario, name: &str) -> Vec<Outcome> {
    let all = judged(scenario).judgement.sides;
    let own = all.iter().flat_map(|(_, all)| all.iter().flatten()).filter(|own| own.name == name && own.order == 0);
    own.map(|own| own.outcome()).collect()
}

/// Positions are known to 1e-12 of their size, accelerations and forces to 1e-10: a billionth more is wrong.
#[test]
fn a_formula_that_is_a_billionth_too_large_is_wrong() {
    for file in ["slider_crank_centric", "four_bar_centres", "slider_crank_balance", "unbalanced_rotor"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenarios/formulas/{file}.toml"));
        let scenario = load(&path);
        let mut count = 0;
        for (formula, _) in scenario.formulas.claims().filter(|(formula, _)| formula.error.is_none()) {
            let (name, text) = (&formula.name, &formula.text);
            let right = outcomes(&rewritten(&scenario, name, text), name);
            assert!(right.iter().all(|own| *own == Outcome::Right), "{file}: {name}: {right:?}");
            let more = rewritten(&scenario, name, &format!("({text})*(1 + 1e-9)"));
            let wrong = outcomes(&more, name);
            // What is zero is zero a billionth larger, too.
            let vanishes = ["0", "0.0"].contains(&text.as_str());
            assert!(vanishes || wrong.iter().all(|own| *own == Outcome::Wrong), "{file}: {name} = {text}: {wrong:?}");
            count += usize::from(!vanishes);
        }
        assert!(count >= 3, "{file}: {count}");
    }
}

/// The same in degrees, to the tenth part: the factor of a unit is known to its last digit.
#[test]
fn a_formula_in_degrees_is_judged_as_sharply() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let claimed = |text: &str| {
        let more =
            format!("\n[[formula]]\nname = \"turned\"\nexpression = \"{text}\"\nchannel = \"link.crank.angle_deg\"\n");
        let whole = std::fs::read_to_string(&path).unwrap() + &more;
        outcomes(&Scenario::parse(&whole, &path).unwrap(), "turned")
    };
    assert!(claimed("phi*180/pi").iter().all(|own| *own == Outcome::Right));
    assert!(claimed("phi*180/pi*(1 + 1e-10)").iter().all(|own| *own == Outcome::Wrong));
}

/// Digits that cancel: at more and more instants less than six are left. A few do no harm, nine of ten prove nothing.
#[test]
fn a_formula_that_loses_its_digits_at_most_instants_proves_nothing() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/formulas/slider_crank_centric.toml");
    let scenario = load(&path);
    // A number that grows is added and taken away again; 40 deg after this crank angle it has taken too many digits.
    let with = |from_deg: f64| {
        let large = format!("1e3*exp(20*(phi - {from_deg}*pi/180))");
        let text = format!("r*cos(phi) + sqrt(l^2 - r^2*sin(phi)^2) + {large} - {large}");
        outcomes(&rewritten(&scenario, "x", &text), "x")
    };
    for own in with(36.0) {
        assert!(matches!(&own, Outcome::Open { reason, .. } if reason.contains("less than six digits")), "{own:?}");
    }
    assert!(with(340.0).iter().all(|own| *own == Outcome::Right), "{:?}", with(340.0));
}
