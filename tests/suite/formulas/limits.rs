//! The search for a cause counts its work and always ends, whatever the number and form of the formulas.

use prover::check::{CUT, FormulaCause, MOST_WORK};
use prover::run::solved::Claimed;
use scenario::{Claim, Formulas, Scenario};

use super::{files, judged, load, rewritten};
use crate::cli::tools::Place;

/// A shipped scenario with only the given formulas.
/// Formulas whose name begins with `f` claim the piston's position.
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

/// Symptom: a formula of one page used more than 4 GB of memory.
/// Cause: the search kept one copy of the formula for every slip.
#[test]
fn a_page_long_formula_stops_at_the_work_limit() {
    let text = vec!["sin(phi)*cos(phi)"; 550].join("+");
    let scenario = with_formulas([("f".to_string(), text)].into_iter());
    let found = judged(&scenario);
    // The search checks its work limit only between changes. Judging one change of a long formula at all instants takes
    // many operations, so the total work may exceed the limit a little.
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

/// Each step uses the previous step twice, but is evaluated only once.
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

/// All wrong formulas of a file share one work limit.
/// Formulas that are not examined because of this limit are reported.
#[test]
fn many_wrong_formulas_share_one_limit() {
    let text = |index: usize| format!("{}+{index}", vec!["sin(phi)*cos(phi)"; 400].join("+"));
    let found = judged(&with_formulas((0..6).map(|index| (format!("f{index}"), text(index)))));
    assert!(found.judgement.work <= 2 * MOST_WORK, "{}", found.judgement.work);
    assert_eq!((found.judgement.causes.len(), found.judgement.unsought.len()), (6, 6));
}

/// Formulas that the wrong formula does not use add no work to the search for its cause.
#[test]
fn unused_formulas_add_no_work_to_a_search() {
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

/// Symptom: changing one letter in a shipped file took six seconds.
#[test]
fn a_letter_changed_in_a_shipped_file_is_found_with_little_work() {
    let scenario = load(&files()[0].with_file_name("slider_crank_balance.toml"));
    let found = judged(&rewritten(&scenario, "side", "tan(beta)*osc*w^2*k"));
    assert!(cause(&found, "side").is_some_and(FormulaCause::is_whole), "{:?}", cause(&found, "side"));
    assert!(found.judgement.work < 5_000_000, "{}", found.judgement.work);
}

/// Symptom: thousands of formulas, each using the previous one, took minutes.
/// Cause: for each formula, all formulas on which it depends were evaluated, differentiated, and searched for undefined
/// values again.
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
    // All wrong formulas share the work limit of one search.
    // The first undefined formula is reported with its location.
    for (first, next) in
        [("phi + 1e-3", "2*phi - s"), ("phi + 0*ln(phi - 1)", "2*phi - s"), ("phi", "s + 0.1*exp(-phi)")]
    {
        let wrong = of(3000, &|index| after(index, first, next)).judgement;
        assert!(wrong.work < 4 * MOST_WORK, "{first}: {}", wrong.work);
        assert!(wrong.causes.len() > 2000 && wrong.unsought.contains("s2999"), "{first}: {}", wrong.causes.len());
        assert_eq!(wrong.undefined.contains_key("s0"), first.contains("ln"), "{first}");
    }
}

/// Symptom: the dictionary of possibly missing terms grew with the square of the number of previous steps.
/// The work of building the dictionary was not counted.
#[test]
fn regress_a_search_after_many_steps_has_bounded_work() {
    let step = |index: usize| {
        let text = if index == 0 { "sin(phi)".to_string() } else { format!("s{}*cos(phi)", index - 1) };
        (format!("s{index}"), text)
    };
    let last = ("f".to_string(), "s2999 + 1e-3*s2998".to_string());
    let found = judged(&with_formulas((0..3000).map(step).chain([last])));
    assert!(found.judgement.work < 4 * MOST_WORK, "{}", found.judgement.work);
    assert_eq!(found.verdict.word(), "disagree");
}

/// A search that reached its limit is reported in the JSON of `check` and of `run`.
#[test]
fn a_truncated_search_is_reported_in_the_json_of_check() {
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
