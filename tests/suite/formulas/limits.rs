//! The search for a cause is counted, and ends: whatever is written, and however much of it.

use prover::check::{CUT, FormulaCause, MOST_WORK};
use prover::run::solved::Claimed;
use scenario::{Claim, Formulas, Scenario};

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

fn cause<'a>(found: &'a Claimed, name: &str) -> Option<&'a FormulaCause> {
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
    assert!(cause(&found, "side").is_some_and(FormulaCause::is_whole), "{:?}", cause(&found, "side"));
    assert!(found.judgement.work < 5_000_000, "{}", found.judgement.work);
}

/// Thousands of formulas, each of the one before, took minutes: all that a formula rests on was evaluated for each of
/// them, and derived, and looked through for what has no value.
#[test]
fn regress_chained_claims_are_judged_once_each() {
    let of = |count: usize, text: &dyn Fn(usize) -> String| {
        let mut scenario = with_formulas((0..count).map(|index| (format!("s{index}"), text(index))));
        let claim = Claim::parse("link.crank.angle_rad", &scenario.case).unwrap();
        scenario.formulas.list.iter_mut().for_each(|own| own.claim = Some(claim.clone()));
        judged(&scenario)
    };
    let after = |index: usize, first: &str, next: &str| match index {
        0 => first.to_string(),
        _ => next.replace('s', &format!("s{}", index - 1)),
    };
    let right = of(3000, &|index| after(index, "phi", "2*phi - s"));
    assert_eq!(right.verdict.word(), "agree");
    assert!(right.judgement.sides.iter().all(|(_, all)| all.len() == 3000 && all[2999].len() == 3));
    // Wrong ones share the work of a search. The first that has no value is told with its place.
    for (first, next) in
        [("phi + 1e-3", "2*phi - s"), ("phi + 0*ln(phi - 1)", "2*phi - s"), ("phi", "s + 0.1*exp(-phi)")]
    {
        let wrong = of(3000, &|index| after(index, first, next)).judgement;
        assert!(wrong.work < 4 * MOST_WORK, "{first}: {}", wrong.work);
        assert!(wrong.causes.len() > 2000 && wrong.unsought.contains("s2999"), "{first}: {}", wrong.causes.len());
        assert_eq!(wrong.undefined("s0").is_some(), first.contains("ln"), "{first}");
    }
}

/// A dictionary of what a formula may lack grew with the square of the steps before it, and was not counted.
#[test]
fn regress_a_wrong_formula_after_thousands_of_steps_is_sought_with_bounded_work() {
    let step = |index: usize| {
        let text = if index == 0 { "sin(phi)".to_string() } else { format!("s{}*cos(phi)", index - 1) };
        (format!("s{index}"), text)
    };
    let last = ("f".to_string(), "s2999 + 1e-3*s2998".to_string());
    let found = judged(&with_formulas((0..3000).map(step).chain([last])));
    assert!(found.judgement.work < 4 * MOST_WORK, "{}", found.judgement.work);
    assert_eq!(found.verdict.word(), "disagree");
}

/// A search that was cut says so to a script as well as to a reader.
#[test]
fn a_search_that_was_cut_is_told_in_the_json_of_check() {
    let place = Place::new();
    let own = std::fs::read_to_string(place.path("scenarios/formulas/slider_crank_centric.toml")).unwrap();
    let own = &own[..own.find("[[formula]]").unwrap()];
    for (text, is_cut) in [(vec!["sin(phi)*cos(phi)"; 550].join("+"), true), ("r*sin(phi)".to_string(), false)] {
        let formula = format!("[[formula]]\nname = \"f\"\nexpression = \"{text}\"\nchannel = \"point.B.x_m\"\n");
        std::fs::write(place.path("own.toml"), format!("{own}{formula}")).unwrap();
        let json = place.run("check own.toml --json -").json();
        assert_eq!((&json["formulas"][0]["search_cut"], json["verdict"].as_str()), (&is_cut.into(), Some("disagree")));
        let json = place.run("run own.toml --no-record --json -").json();
        let checks = json["runs"][0]["checks"].to_string();
        assert_eq!(checks.contains(CUT), is_cut, "{checks}");
    }
}
