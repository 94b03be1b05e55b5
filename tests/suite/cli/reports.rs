//! `run --junit` and `run --markdown`.

use std::fs;

use super::tools::Place;

/// Three scenarios: one agrees, one has a wrong published number, one cannot be read.
fn place() -> Place {
    let place = Place::new();
    place.edited("crank_rocker.toml", "wrong.toml", &[("name = \"crank_rocker\"", "name = \"wrong\"")]);
    let path = place.path("scenarios/wrong.toml");
    let text = fs::read_to_string(&path).unwrap();
    let formula = "[[formula]]\nname = \"w\"\nexpression = \"phi\"\nchannel = \"link.crank.omega_rad_s\"\n";
    fs::write(&path, format!("{text}\n{formula}")).unwrap();
    place.edited("pendulum.toml", "broken.toml", &[("joint = \"O\"", "joint = \"Q\"")]);
    place
}

const FILES: &str = "scenarios/pendulum.toml scenarios/wrong.toml scenarios/broken.toml";

#[test]
fn junit_has_a_suite_for_each_scenario_and_a_case_for_each_channel_and_check() {
    let place = place();
    let outcome = place.run(&format!("run {FILES} --no-record --budget 1e5 --junit out.xml --json out.json"));
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    let text = fs::read_to_string(place.path("out.xml")).unwrap();
    let tree = roxmltree::Document::parse(&text).unwrap();
    let suites: Vec<_> = tree.descendants().filter(|node| node.has_tag_name("testsuite")).collect();
    let names: Vec<&str> = suites.iter().map(|suite| suite.attribute("name").unwrap()).collect();
    assert_eq!(names, ["pendulum", "wrong", "scenarios/broken.toml"]);
    let failures = |index: usize| -> Vec<&str> {
        let cases = suites[index].children().filter(|node| node.has_tag_name("testcase"));
        cases.filter(|case| case.has_children()).filter_map(|case| case.attribute("name")).collect()
    };
    assert_eq!(failures(0), Vec::<&str>::new());
    assert!(failures(1).iter().any(|name| name.contains("w as link.crank.omega_rad_s")), "{:?}", failures(1));
    assert_eq!(failures(2), ["proof"]);
    // What disagrees is a failure, what cannot be proven an error: runners tell them apart.
    let kinds = |index: usize| -> Vec<String> {
        let cases = suites[index].children().flat_map(|case| case.children().filter(roxmltree::Node::is_element));
        let names = cases.map(|node| node.tag_name().name().to_string());
        let mut kinds: Vec<String> = names.filter(|name| name != "system-out").collect();
        kinds.dedup();
        kinds
    };
    assert_eq!((kinds(1), kinds(2)), (vec!["failure".to_string()], vec!["error".to_string()]));
    // As many cases as the JSON has channels and checks.
    let json: serde_json::Value = serde_json::from_str(&fs::read_to_string(place.path("out.json")).unwrap()).unwrap();
    let run = &json["runs"][0];
    let engine = &run["engines"][0];
    let parts = [&run["checks"], &engine["channels"], &engine["checks"], &engine["own_forces"]["channels"]];
    let wanted: usize = parts.iter().map(|part| part.as_array().map_or(0, Vec::len)).sum();
    let cases = suites[0].children().filter(|node| node.has_tag_name("testcase")).count();
    assert_eq!(cases, wanted);
    assert_eq!(suites[0].attribute("tests"), Some(cases.to_string().as_str()));
    // Equal runs give equal bytes: no times, no random names.
    place.run(&format!("run {FILES} --no-record --budget 1e5 --junit again.xml"));
    assert_eq!(fs::read_to_string(place.path("again.xml")).unwrap(), text);
}

#[test]
fn markdown_begins_with_the_verdict_and_tells_what_is_wrong() {
    let place = place();
    place.run(&format!("run {FILES} --no-record --budget 1e5 --markdown out.md"));
    let text = fs::read_to_string(place.path("out.md")).unwrap();
    assert!(text.starts_with("**linkproof**: 3 scenarios, 1 disagree, 1 cannot be proven, 1 agree\n"), "{text}");
    assert!(text.contains("| pendulum | agree |") && text.contains("| wrong | **disagree** |"), "{text}");
    assert!(text.contains("w as link.crank.omega_rad_s") && text.contains("joint \"Q\""), "{text}");
    assert!(text.lines().all(|line| !line.contains('\t')), "{text}");
}
