use std::collections::BTreeMap;

use prover::check::FormulaCause;

use super::{files, is_wrong, judged, load, rewritten};

/// Textbook results over whole revolutions, by value and by derivative, on both analytic sides.
#[test]
fn the_library_is_right() {
    let mut claims = 0;
    for path in files() {
        let scenario = load(&path);
        let found = judged(&scenario);
        assert_eq!(found.verdict.word(), "agree", "{}: {:?}", path.display(), found.verdict);
        for (formula, _) in scenario.formulas.claims() {
            assert!(formula.source.as_ref().is_some_and(|source| source.len() > 10), "{}", formula.name);
            claims += 1;
        }
    }
    assert!(claims >= 140, "{claims}");
}

/// Names that a diagnosis may give each kind of slip.
/// "Per radian" is also accepted where a power and a moment are confused.
/// Power is moment times the crank's speed, just as a rate per second is the rate per radian times the crank's speed.
const NAMED: &[(&str, &[&str])] = &[
    ("sign", &["a sign"]),
    ("unit", &["a unit", "per radian"]),
    ("factor", &["a factor", "a product for a quotient"]),
    ("offset", &["missing", "an offset", "another reference angle"]),
    ("cos for sin", &["another function"]),
    ("missing square", &["a power"]),
    ("other length", &["another quantity", "two quantities"]),
    ("branch", &["another branch", "a sign"]),
    ("degrees", &["a unit"]),
    ("derivative per radian", &["per radian", "missing"]),
    ("missing term", &["missing", "an offset"]),
];

/// Each claim of the library has a wrong copy, which contains one slip.
/// All wrong copies disagree, and the diagnosis names the slip in nine of ten copies.
#[test]
fn an_altered_copy_of_every_claim_disagrees_and_is_explained() {
    let mut reader = csv::Reader::from_reader(include_bytes!("spoiled.csv").as_slice());
    let mut spoiled: BTreeMap<String, Vec<[String; 3]>> = BTreeMap::new();
    for row in reader.records().map(Result::unwrap) {
        spoiled.entry(row[0].into()).or_default().push([1, 2, 3].map(|column| row[column].into()));
    }
    let (mut all, mut right, mut other) = (0, 0, Vec::new());
    for path in files() {
        let scenario = load(&path);
        let twins = &spoiled[path.file_name().unwrap().to_str().unwrap()];
        assert_eq!(twins.len(), scenario.formulas.claims().count(), "{}", path.display());
        for [formula, slip, expression] in twins {
            let found = judged(&rewritten(&scenario, formula, expression));
            assert!(is_wrong(&found, formula), "{}: {formula} = {expression}", path.display());
            let cause =
                found.judgement.causes.iter().find(|(name, _)| name == formula).and_then(|(_, cause)| cause.clone());
            let words = match &cause {
                Some(FormulaCause::Slip(slip)) => slip.kind.words().to_string(),
                Some(FormulaCause::Offset(_)) => "an offset".into(),
                // A bare factor does not name the slip.
                Some(FormulaCause::Factor(_)) => "a number".into(),
                Some(other) => other.to_string(),
                None => "nothing".into(),
            };
            let (_, names) = NAMED.iter().find(|(kind, _)| kind == slip).unwrap();
            all += 1;
            match names.iter().any(|name| words.contains(name)) {
                true => right += 1,
                false => other.push(format!("{formula} ({slip}): {words}")),
            }
        }
    }
    println!("{right} of {all} explained by their slip; otherwise:\n{}", other.join("\n"));
    assert!(all >= 140 && 10 * right >= 9 * all, "{right} of {all}:\n{}", other.join("\n"));
}
