//! `linkproof mutate`, through the command line.

use std::fs;

use super::tools::Place;
use linkproof::report::mutate::kinds_markdown;

#[test]
fn any_number_of_jobs_gives_the_same_bytes() {
    let place = Place::new();
    let with = |jobs: usize| {
        place.ok(&format!("mutate scenarios/crank_rocker.toml --kind load --jobs {jobs} --no-sizes --json -"))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn found_faults_are_reported_with_channel_and_margin() {
    let place = Place::new();
    let json = place.ok("mutate scenarios/crank_rocker.toml --kind gravity-missing --party engine --no-sizes --json -");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let fault = &json["scenarios"][0]["faults"][0];
    assert_eq!((fault["outcome"].as_str(), fault["party"].as_str()), (Some("detected"), Some("engine")));
    assert!(fault["first"]["what"].as_str().unwrap().contains("(rapier)"), "{fault}");
    assert!(fault["first"]["margin"].as_f64().unwrap() > 100.0 && fault["first"]["time_s"].is_number(), "{fault}");
    assert_eq!(json["figures"]["planted"]["found"], 1);
    let text = place.ok("mutate scenarios/crank_rocker.toml --kind gravity-missing --party engine --no-sizes");
    assert!(text.starts_with("ALL FOUND"), "{text}");
}

/// Symptom: for a file without loads, `--kind load` printed "ALL FOUND, 0 of 0 faults" and ended with 0.
#[test]
fn regress_without_a_planted_fault_nothing_is_proven() {
    let place = Place::new();
    let scenario = fs::read_to_string(place.path("scenarios/pendulum.toml")).unwrap();
    assert!(!scenario.contains("[[loads]]") && !scenario.contains("[motor]"));
    // Each kind changes a part that the mechanism lacks: loads, a motor, or a slider.
    for kind in ["load", "motor", "guide-moment-missing"] {
        let outcome = place.run(&format!("mutate scenarios/pendulum.toml --kind {kind} --no-sizes"));
        assert_eq!(outcome.code, 3, "{kind}: {}", outcome.stdout);
        assert!(outcome.stdout.starts_with("NOTHING PLANTED"), "{kind}: {}", outcome.stdout);
        let has = "kinds that change a result: drive, mass, position, rate, acceleration, force";
        assert!(outcome.unbroken().contains(has), "{kind}: {}", outcome.stdout);
        let json = place.run(&format!("mutate scenarios/pendulum.toml --kind {kind} --no-sizes --json -")).json();
        assert_eq!(json["scenarios"][0]["kinds_instead"][1], "mass");
    }
    // Only independent numbers can reveal a fault in code that all parties share.
    // The scenario `bare.toml` has no independent numbers.
    let outcome = place.run("mutate scenarios/scotch_yoke.toml --kind gravity-missing --party trunk --no-sizes");
    let word = if outcome.code == 0 { "ALL FOUND" } else { "SHARED FAULTS NOT FOUND" };
    assert!(outcome.stdout.starts_with(word), "{}", outcome.stdout);
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    fs::write(place.path("bare.toml"), &text[..text.find("[[oracle]]").unwrap()]).unwrap();
    let outcome = place.run("mutate bare.toml --kind gravity-missing --party trunk --no-sizes");
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    assert!(outcome.stdout.starts_with("SHARED FAULTS NOT FOUND"), "{}", outcome.stdout);
}

/// In a proof that already disagrees, every planted fault would count as found, so the command refuses this proof.
#[test]
fn regress_a_proof_that_disagrees_without_a_fault_is_refused() {
    let place = Place::new();
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    let wrong = "\n[[formula]]\nname = \"w\"\nexpression = \"phi\"\nchannel = \"link.crank.omega_rad_s\"\n";
    let bare = &text[..text.find("[[oracle]]").unwrap()];
    fs::write(place.path("wrong.toml"), format!("{bare}{wrong}")).unwrap();
    let words = ["crank_rocker disagrees without a fault", "correct what disagrees"];
    place.refused("mutate wrong.toml --kind gravity-missing --no-sizes", &words);
}

#[test]
fn invalid_requests_are_refused() {
    let place = Place::new();
    let outcome = place.run("mutate scenarios/crank_rocker.toml --kind gravitation");
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("--list"), "{}", outcome.stderr);
    let two = "mutate scenarios/crank_rocker.toml --engine rapier --engine impulse";
    place.refused(two, &["2 engines", "one"]);
    assert_eq!(place.run("mutate").code, 2);
    assert_eq!(place.run("mutate nowhere.toml").code, 2);
}

/// docs/mutate.md and the program have the same table of fault kinds.
#[test]
fn the_document_lists_all_kinds() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/mutate.md");
    let page = std::fs::read_to_string(path).unwrap();
    assert!(page.contains(&kinds_markdown()), "replace the table in docs/mutate.md by:\n{}", kinds_markdown());
}

/// Formulas are a party: `mutate` judges a mistake in a formula as `check` and `run` do.
#[test]
fn mistakes_in_formulas_are_found_and_counted_separately() {
    let place = Place::new();
    let file = "scenarios/formulas/slider_crank_centric.toml";
    let text = place.ok(&format!("mutate {file} --party formulas --no-sizes"));
    assert!(text.starts_with("ALL FOUND  17 kinds\nformulas: "), "{text}");
    let json = place.run(&format!("mutate {file} --party formulas --no-sizes --json -")).json();
    let share = &json["figures"]["formulas"];
    assert!(share["real"].as_u64().unwrap() > 100 && share["found"] == share["real"], "{share}");
    assert_eq!((&json["figures"]["planted"]["real"], &json["figures"]["trunk"]["real"]), (&0.into(), &0.into()));
    let faults = json["scenarios"][0]["faults"].as_array().unwrap();
    for fault in faults {
        let formula = &fault["formula"];
        assert!(fault["party"] == "formulas" && formula["right"] != formula["wrong"], "{fault}");
        if fault["outcome"] == "detected" {
            // Only the judgement of formulas finds the planted fault.
            let checks = fault["checks"].to_string();
            assert!(checks.contains("formulas (assur)") && !checks.contains("closure"), "{fault}");
            assert!(fault["first"]["time_s"].is_number(), "{fault}");
        }
    }
    // The series claims an approximate value, and mistakes are planted only in formulas that claim an exact value.
    assert!(faults.iter().all(|fault| fault["formula"]["name"] != "x_series"), "{json}");
    // `check` also finds that the planted formula is wrong.
    let fault = faults.iter().find(|own| own["formula"]["name"] == "x" && own["kind"] == "formula-sign").unwrap();
    let own = fs::read_to_string(place.path(file)).unwrap();
    let [right, wrong] = ["right", "wrong"].map(|key| fault["formula"][key].as_str().unwrap());
    assert!(own.contains(right), "{right}");
    fs::write(place.path("wrong.toml"), own.replacen(right, wrong, 1)).unwrap();
    assert_eq!(place.run("check wrong.toml").code, 1, "{wrong}");
}

/// The tolerance of a formula hides small mistakes.
/// For each mistake, the command reports the smallest fraction of the mistake that is still found.
#[test]
fn the_smallest_detected_formula_mistake_is_reported() {
    let place = Place::new();
    let json = place.run("mutate scenarios/formulas/slider_crank_centric.toml --kind formula-factor --json -").json();
    let sizes = json["scenarios"][0]["faults"].as_array().unwrap();
    let sizes = sizes.iter().filter(|own| own["outcome"] == "detected").map(|own| own["smallest"].as_f64().unwrap());
    let largest = sizes.fold(0.0, |most: f64, own| if own > most { own } else { most });
    assert!(largest > 1e-14 && largest < 1e-8, "{largest}");
}

#[test]
fn a_file_without_formulas_reports_nothing_planted() {
    let place = Place::new();
    let outcome = place.run("mutate scenarios/pendulum.toml --party formulas --no-sizes");
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    assert!(outcome.stdout.starts_with("NOTHING PLANTED"), "{}", outcome.stdout);
    assert!(outcome.unbroken().contains("no formula of the scenario claims an exact value"), "{}", outcome.stdout);
    // The scenario has no formulas, so no mistake can be planted in a formula.
    // Formulas may be missing if `--kind` also requests a kind of fault that can be planted.
    place.ok("mutate scenarios/pendulum.toml --kind gravity-sign --kind formula --party assur --no-sizes");
}
