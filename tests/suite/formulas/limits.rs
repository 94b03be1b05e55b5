//! The search for a cause is counted, and ends: whatever is written, and however much of it.

use linkproof::claims::{CUT, Cause, MOST_WORK};
use linkproof::proof::claimed::Claimed;
use linkproof::scenario::{Claim, Formulas, Scenario};

use super::{files, judged, load, rewritten};
use crate::cli::tools::Place;

/// A shipped scenario with these formulas alone; those whose name begins with `f` claim the piston's place.
fn with_formulas(formulas: impl Iterator<Item = (String, String)>) -> Scenario {
    let mut scenario = load(&files()[0].with_file_name("slider_crank_centric.toml"));
    let claim = Claim::parse("point.B.x_m", &scenario.case).unwrap();
    let mut own = Formulas::over(scenario.formulas.parameters.clone());
    for (name, text) in formulas {
        own.add(&name, &text).unwrap().claim = name.starts_with('f').then(|| claim.clone());
    }
    scenario.formulas = own;
    scenario
}

fn cause<'a>(found: &'a Claimed, name: &str) -> Option<&'a Cause> {
    found.judgement.causes.iter().find(|(own, _)| own == name).and_then(|(_, cause)| cause.as_ref())
}

/// A formula of a page took all memory, 4 GB and more, because a copy of it was kept for every slip.
#[test]
fn a_formula_of_a_page_ends_at_the_limit_of_work_and_says_so() {
    let text = vec!["sin(phi)*cos(phi)"; 550].join("+");
    let scenario = with_formulas([("f".to_string(), text)].into_iter());
    let found = judged(&scenario);
    // A single change of a long formula, judged at all instants, may be beyond.
    assert!(found.judgement.work <= MOST_WORK + MOST_WORK / 10, "{}", found.judgement.work);
    assert!(found.judgement.unsought.contains("f") && cause(&found, "f").is_none());
    let place = Place::new();
    let text = std::fs::read_to_string(place.path("scenarios/formulas/slider_crank_centric.toml")).unwrap();
    let own = format!(
        "[[formula]]\nname = \"f\"\nexpression = \"{}\"\nchannel = \"point.B.x_m\"\n",
        scenario.formulas.list[0].text
    );
    std::fs::write(place.path("long.toml"), format!("{}{own}", &text[..text.find("[[formula]]").unwrap()])).unwrap();
    let said = place.run("check long.toml").stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains(CUT), "{said}");
}

/// Steps that each use the one before them twice are evaluated once each.
#[test]
fn chained_formulas_do_not_double_the_work() {
    let of = |steps: usize| {
        let step = |index: usize| match index {
            0 => ("s0".to_string(), "sin(phi)".to_string()),
            _ => (format!("s{index}"), format!("s{}*cos(phi) + s{}/2", index - 1, index - 1)),
        };
        let last = ("f".to_string(), format!("s{}", steps - 1));
        judged(&with_formulas((0..steps).map(step).chain([last]))).judgement.work
    };
    let [half, whole] = [20, 40].map(of);
    assert!(whole < MOST_WORK && whole < 8 * half, "{half} {whole}");
}

/// All wrong formulas of a file share one limit; those that it leaves without a search are called so.
#[test]
fn many_wrong_formulas_share_one_limit() {
    let text = |index: usize| format!("{}+{index}", vec!["sin(phi)*cos(phi)"; 400].join("+"));
    let found = judged(&with_formulas((0..6).map(|index| (format!("f{index}"), text(index)))));
    assert!(found.judgement.work <= 2 * MOST_WORK, "{}", found.judgement.work);
    assert_eq!((found.judgement.causes.len(), found.judgement.unsought.len()), (6, 6));
}

/// What stands before a wrong formula in a long file, and is not used by it, costs nothing.
#[test]
fn a_wrong_formula_of_a_long_file_is_sought_as_in_a_short_one() {
    let of = |count: usize| {
        let step = |index: usize| (format!("s{index}"), format!("{index}*sin(phi)"));
        let wrong = ("f".to_string(), "r*sin(phi) + sqrt(l^2 - r^2*sin(phi)^2)".to_string());
        let found = judged(&with_formulas((1..=count).map(step).chain([wrong])));
        assert!(cause(&found, "f").unwrap().to_string().contains("another function"), "{:?}", cause(&found, "f"));
        found.judgement.work
    };
    let [short, long] = [30, 1000].map(of);
    assert!(long < short + short / 4, "{short} {long}");
}

/// A letter changed in a shipped file took six seconds.
#[test]
fn a_letter_changed_in_a_shipped_file_is_found_with_little_work() {
    let scenario = load(&files()[0].with_file_name("slider_crank_balance.toml"));
    let found = judged(&rewritten(&scenario, "side", "tan(beta)*osc*w^2*k"));
    assert!(cause(&found, "side").is_some_and(Cause::is_whole), "{:?}", cause(&found, "side"));
    assert!(found.judgement.work < 5_000_000, "{}", found.judgement.work);
}
