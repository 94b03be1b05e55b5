//! Undefined values of formulas: wherever an undefined value occurs, it does not count as right and is not ignored.

use prover::check::FormulaOutcome;
use prover::run::Reference;
use scenario::Scenario;

use crate::cli::tools::Place;
use crate::common::shipped;

/// Operations on constants outside their domains, each with the words of the message.
const OUTSIDE: [(&str, &str); 14] = [
    ("0*ln(-1)", "ln(-1) is undefined"),
    ("0*(1/0)", "1/0 is undefined"),
    ("ln(-1)^0 - 1", "ln(-1) is undefined"),
    ("0/sqrt(-4)", "sqrt(-4) is undefined"),
    ("0*asin(2)", "asin(2) is undefined"),
    ("atan2(0, 0)", "atan2(0, 0) is undefined"),
    ("1/(1/0)", "1/0 is undefined"),
    ("0*(-8)^(1/3)", "(-8)^0.333333 is undefined"),
    ("(1/0)^0 - 1", "1/0 is undefined"),
    ("0*acos(-1.5)", "acos(-1.5) is undefined"),
    ("0*0^(-1)", "0^-1 is undefined"),
    ("sign(ln(-1))*0", "ln(-1) is undefined"),
    ("0*abs(sqrt(-1))", "sqrt(-1) is undefined"),
    ("0*exp(-1/0)", "(-1)/0 is undefined"),
];

/// Symptom: the formula `phi*180/pi + 0*ln(-1)` was judged right.
/// First cause: the parser simplified 0*x, 0/x and x^0, although only derivatives need these simplifications.
/// Second cause: IEEE 754 gives 1/(1/0) a value.
#[test]
fn regress_undefined_constants_are_refused_in_every_input() {
    let place = Place::new();
    let own = std::fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    std::fs::write(place.path("table.csv"), "time_s,a\n0,0\n0.1,1\n").unwrap();
    for (operation, says) in OUTSIDE {
        let operation = operation.replace(' ', "");
        let check = "check scenarios/crank_rocker.toml";
        for door in [
            format!("{check} phi --channel link.crank.angle_rad+{operation}"),
            format!("compare scenarios/crank_rocker.toml table.csv --rel 1 --map a+{operation}=link.crank.angle_deg"),
        ] {
            place.refused(&door, &[says, "^", "help: "]);
        }
        // `check` judges a formula with an operation outside its domain instead of refusing the formula, because the
        // diagnosis of the slip is more useful.
        for formula in [format!("phi*180/pi+{operation}"), format!("u+phi*180/pi --let u={operation}")] {
            let outcome = place.run(&format!("{check} {formula} --channel link.crank.angle_deg"));
            assert_eq!(outcome.code, 1, "{formula}: {}", outcome.stdout);
            let told = outcome.unbroken();
            assert!(told.contains(&format!("but {says} at crank angle 0.000 deg")), "{formula}: {told}");
        }
        for section in [
            format!("[parameters]\nq = \"{operation}\"\n"),
            format!("[tolerances]\nengine_rel = \"0.01 + {operation}\"\n"),
        ] {
            let error = Scenario::parse(&format!("{own}\n{section}"), "own.toml").expect_err(&section);
            assert!(error.to_string().contains(says), "{section}: {error}");
            let at = error.place().unwrap().span.start;
            assert!(at > own.len(), "{section}: {error}");
        }
    }
}

/// An operation outside its domain may depend on the crank angle or the time.
/// The formula then disagrees at the first instant without a value.
/// The message names the operation and its location, even in a step of the derivation.
#[test]
fn operations_outside_their_domain_disagree_with_a_position() {
    let scenario = shipped("crank_rocker.toml");
    let right = "phi*180/pi";
    for (steps, text, of, written, crank) in [
        (vec![], "phi*180/pi + 0*sqrt(1 - phi)", "formula", "sqrt(1 - phi)", 58.0),
        (vec![], "phi*180/pi + 0*ln(phi)", "formula", "ln(phi)", 0.0),
        (vec![("u", "acos(1 + t)")], "phi*180/pi + 0*u^2", "u", "acos(1 + t)", 1.0),
        (vec![("u", "2 - phi"), ("v", "u^0.5")], "v^0*phi*180/pi", "v", "u^0.5", 115.0),
        (vec![], "phi*180/pi*(1/(phi - phi))^0", "formula", "(1/(phi - phi))", 0.0),
        (vec![], "phi*180/pi + exp(-1/(t - t))", "formula", "-1/(t - t)", 0.0),
        (vec![], "phi*180/pi + 0*asin(phi/3)", "formula", "asin(phi/3)", 172.0),
        (vec![], "phi*180/pi + 0*atan2(sin(phi)*0, cos(phi)*0)", "formula", "atan2(sin(phi)*0, cos(phi)*0)", 0.0),
        (vec![("u", "ln(3 - phi)")], "phi*180/pi*u^0", "u", "ln(3 - phi)", 172.0),
        (vec![], "phi*180/pi + 0*sign(acos(phi))", "formula", "acos(phi)", 58.0),
        (vec![], "phi*180/pi + 0*abs(phi - 1)^(-1/(phi - phi))", "formula", "(-1/(phi - phi))", 0.0),
    ] {
        let mut scenario = scenario.clone();
        for (name, text) in steps {
            scenario.formulas.add(name, text).unwrap();
        }
        let claim = scenario::Claim::parse("link.crank.angle_deg", &scenario.case).unwrap();
        for (name, text) in [("formula", text), ("right", right)] {
            scenario.formulas.add(name, text).unwrap().claim = Some(claim.clone());
        }
        let found = super::judged(&scenario);
        for (_, all) in found.judgement.sides.iter() {
            let outcomes: Vec<FormulaOutcome> = all.iter().map(|orders| orders[0].outcome()).collect();
            assert_eq!(outcomes, [FormulaOutcome::Wrong, FormulaOutcome::Right], "{text}");
        }
        let undefined = found.judgement.undefined.get("formula").unwrap();
        let (formula, operation, at) = (&undefined.formula, &undefined.written, undefined.crank);
        assert_eq!((formula.as_str(), operation.as_str(), at.to_degrees().round()), (of, written, crank), "{text}");
    }
}

/// A pole between two instants is not an operation outside its domain.
/// A formula with such a pole is right if its value is right at every instant, but its bound is wider near the pole.
/// If rounding hides a pole at an instant, the formula is not judged at this instant; the remaining instants decide the
/// verdict.
#[test]
fn poles_between_instants_and_poles_that_rounding_hides() {
    let scenario = shipped("crank_rocker.toml");
    let claim = scenario::Claim::parse("link.crank.angle_deg", &scenario.case).unwrap();
    let outcome = |text: &str| {
        let mut scenario = scenario.clone();
        scenario.formulas.add("formula", text).unwrap().claim = Some(claim.clone());
        let found = super::judged(&scenario);
        assert!(!found.judgement.undefined.contains_key("formula"), "{text}");
        found.judgement.sides[Reference::Assur][0][0].clone()
    };
    // The instants are at whole degrees; the divisor of this formula is zero between 57 and 58 deg.
    let crossing = outcome("phi*180/pi*(phi - 1)/(phi - 1)");
    assert_eq!((crossing.outcome(), crossing.lost), (FormulaOutcome::Right, 0));
    // At 90 and 270 deg, rounding error leaves no known digit of the tangent or of a product with the tangent.
    for text in ["phi*180/pi + 0*tan(phi)", "phi*180/pi + 0/cos(phi)"] {
        let pole = outcome(text);
        assert_eq!((pole.outcome(), pole.lost), (FormulaOutcome::Right, 2), "{text}");
    }
    let wrong = outcome("phi*180/pi + 1e-3*tan(phi)");
    assert_eq!(wrong.outcome(), FormulaOutcome::Wrong);
}

/// A number that overflows a double is not undefined: it neither proves nor disproves anything.
#[test]
fn overflow_is_inconclusive() {
    let mut scenario = shipped("crank_rocker.toml");
    let claim = scenario::Claim::parse("link.crank.angle_deg", &scenario.case).unwrap();
    let formula = scenario.formulas.add("formula", "phi*180/pi + 0*exp(1000*phi)").unwrap();
    formula.claim = Some(claim);
    let found = super::judged(&scenario);
    let outcome = found.judgement.sides[Reference::Assur][0][0].outcome();
    assert!(matches!(outcome, FormulaOutcome::Open { .. }), "{outcome:?}");
}

/// An empty cell is a missing value.
/// If the expression of a mapping is undefined for a number of the table, the error names the row of this number.
#[test]
fn a_mapping_undefined_in_a_row_is_refused() {
    let place = Place::new();
    std::fs::write(place.path("table.csv"), "time_s,a\n0,1.0\n0.1,-1.0\n0.2,\n").unwrap();
    let compare = "compare scenarios/crank_rocker.toml table.csv --rel 1 --map";
    let words = ["in line 3 of the table sqrt(-1) is undefined", "zero or a positive number", "leave out the row"];
    place.refused(&format!("{compare} a+0*sqrt(a)=link.crank.angle_deg"), &words);
    assert_ne!(place.run(&format!("{compare} a+0*sqrt(a+2)=link.crank.angle_deg")).code, 2);
}
