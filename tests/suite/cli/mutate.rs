//! `linkproof mutate`, where a user enters.

use std::fs;

use super::tools::Place;
use linkproof::report::mutate::kinds_markdown;

#[test]
fn the_same_bytes_from_any_number_of_threads() {
    let place = Place::new();
    let with = |jobs: usize| {
        place.ok(&format!("mutate scenarios/crank_rocker.toml --kind load --jobs {jobs} --no-sizes --json -"))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn what_is_found_is_told_with_the_first_channel_and_its_margin() {
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

/// Symptom: on a file without loads `--kind load` said "ALL FOUND, 0 of 0 faults" and ended with 0.
#[test]
fn regress_where_nothing_is_planted_nothing_is_shown() {
    let place = Place::new();
    let scenario = fs::read_to_string(place.path("scenarios/pendulum.toml")).unwrap();
    assert!(!scenario.contains("[[loads]]") && !scenario.contains("[motor]"));
    // No part, and a part whose change changes nothing.
    for kind in ["load", "motor", "guide-moment-missing"] {
        let outcome = place.run(&format!("mutate scenarios/pendulum.toml --kind {kind} --no-sizes"));
        assert_eq!(outcome.code, 3, "{kind}: {}", outcome.stdout);
        assert!(outcome.stdout.starts_with("NOTHING PLANTED"), "{kind}: {}", outcome.stdout);
        let has = "kinds that would: drive, mass, position, rate, acceleration, force";
        assert!(outcome.unbroken().contains(has), "{kind}: {}", outcome.stdout);
        let json = place.run(&format!("mutate scenarios/pendulum.toml --kind {kind} --no-sizes --json -")).json();
        assert_eq!(json["scenarios"][0]["kinds_instead"][1], "mass");
    }
    // In what all share, with nothing from outside that could find it.
    let outcome = place.run("mutate scenarios/scotch_yoke.toml --kind gravity-missing --party trunk --no-sizes");
    let word = if outcome.code == 0 { "ALL FOUND" } else { "OPEN IN THE TRUNK" };
    assert!(outcome.stdout.starts_with(word), "{}", outcome.stdout);
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    fs::write(place.path("bare.toml"), &text[..text.find("[[oracle]]").unwrap()]).unwrap();
    let outcome = place.run("mutate bare.toml --kind gravity-missing --party trunk --no-sizes");
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    assert!(outcome.stdout.starts_with("OPEN IN THE TRUNK"), "{}", outcome.stdout);
}

/// Whatever is planted in a proof that disagrees already would count as found.
#[test]
fn regress_a_proof_that_disagrees_without_a_fault_is_refused() {
    let place = Place::new();
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    let wrong = "\n[[formula]]\nname = \"w\"\nexpression = \"phi\"\nchannel = \"link.crank.omega_rad_s\"\n";
    let bare = &text[..text.find("[[oracle]]").unwrap()];
    fs::write(place.path("wrong.toml"), format!("{bare}{wrong}")).unwrap();
    let words = ["crank_rocker disagrees without a fault", "mend what disagrees"];
    place.refused("mutate wrong.toml --kind gravity-missing --no-sizes", &words);
}

#[test]
fn bad_wishes_are_refused() {
    let place = Place::new();
    let outcome = place.run("mutate scenarios/crank_rocker.toml --kind gravitation");
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("--list"), "{}", outcome.stderr);
    let two = "mutate scenarios/crank_rocker.toml --engine rapier --engine impulse";
    place.refused(two, &["2 engines", "one"]);
    assert_eq!(place.run("mutate").code, 2);
    assert_eq!(place.run("mutate nowhere.toml").code, 2);
}

/// The page's table of kinds is that of the program.
#[test]
fn the_page_has_all_kinds() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/mutate.md");
    let page = std::fs::read_to_string(path).unwrap();
    assert!(page.contains(&kinds_markdown()), "replace the table in docs/mutate.md by:\n{}", kinds_markdown());
}

/// Formulas are a party: a mistake in one of them is judged as `check` and `run` judge it.
#[test]
fn mistakes_in_formulas_are_found_and_have_a_line_of_their_own() {
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
            // What sees it is the judgement of formulas, and nothing else.
            let checks = fault["checks"].to_string();
            assert!(checks.contains("formulas (assur)") && !checks.contains("closure"), "{fault}");
            assert!(fault["first"]["time_s"].is_number(), "{fault}");
        }
    }
    // The approximation of the file stays right within the error that it claims; no mistake is planted in it.
    assert!(faults.iter().all(|fault| fault["formula"]["name"] != "x_series"), "{json}");
    // What was planted is wrong for `check` as well.
    let fault = faults.iter().find(|own| own["formula"]["name"] == "x" && own["kind"] == "formula-sign").unwrap();
    let own = fs::read_to_string(place.path(file)).unwrap();
    let [right, wrong] = ["right", "wrong"].map(|key| fault["formula"][key].as_str().unwrap());
    assert!(own.contains(right), "{right}");
    fs::write(place.path("wrong.toml"), own.replacen(right, wrong, 1)).unwrap();
    assert_eq!(place.run("check wrong.toml").code, 1, "{wrong}");
}

/// What a formula is not judged to is lost: of the size of a mistake, the part that is still found is told.
#[test]
fn the_size_at_which_a_mistake_in_a_formula_is_lost_is_found() {
    let place = Place::new();
    let json = place.run("mutate scenarios/formulas/slider_crank_centric.toml --kind formula-factor --json -").json();
    let sizes = json["scenarios"][0]["faults"].as_array().unwrap();
    let sizes = sizes.iter().filter(|own| own["outcome"] == "detected").map(|own| own["smallest"].as_f64().unwrap());
    let largest = sizes.fold(0.0, |most: f64, own| if own > most { own } else { most });
    assert!(largest > 1e-14 && largest < 1e-8, "{largest}");
}

#[test]
fn a_file_without_formulas_says_that_nothing_is_planted() {
    let place = Place::new();
    let outcome = place.run("mutate scenarios/pendulum.toml --party formulas --no-sizes");
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    assert!(outcome.stdout.starts_with("NOTHING PLANTED"), "{}", outcome.stdout);
    assert!(outcome.unbroken().contains("no formula of it claims an exact value"), "{}", outcome.stdout);
    // Where others are asked for, it is no matter.
    place.ok("mutate scenarios/pendulum.toml --kind gravity-sign --kind formula --party assur --no-sizes");
}
