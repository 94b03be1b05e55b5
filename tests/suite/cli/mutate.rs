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
