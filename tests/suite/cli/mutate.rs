//! `linkproof mutate`, where a user enters.

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
