//! `run --junit` and `run --markdown`.

use std::fs;

use linkage::error::Advice;
use linkproof::report::outcomes::Outcomes;
use linkproof::report::{junit, markdown};
use linkproof::{Options, Proof, Scenario, Verdict, prove};

use super::tools::Place;

/// Three scenarios: the first agrees, the second has a wrong formula, the third cannot be read.
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
fn junit_has_a_suite_per_scenario_and_a_case_per_result() {
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
    // A disagreement is a failure, and a scenario that cannot be read is an error: test runners distinguish failures
    // from errors.
    let kinds = |index: usize| -> Vec<String> {
        let cases = suites[index].children().flat_map(|case| case.children().filter(roxmltree::Node::is_element));
        let names = cases.map(|node| node.tag_name().name().to_string());
        let mut kinds: Vec<String> = names.filter(|name| name != "system-out").collect();
        kinds.dedup();
        kinds
    };
    assert_eq!((kinds(1), kinds(2)), (vec!["failure".to_string()], vec!["error".to_string()]));
    // The report has as many cases as the JSON has channels and checks.
    let json: serde_json::Value = serde_json::from_str(&fs::read_to_string(place.path("out.json")).unwrap()).unwrap();
    let run = &json["runs"][0];
    let engine = &run["engines"][0];
    let parts = [&run["checks"], &engine["channels"], &engine["checks"], &engine["own_forces"]["channels"]];
    let wanted: usize = parts.iter().map(|part| part.as_array().map_or(0, Vec::len)).sum();
    let cases = suites[0].children().filter(|node| node.has_tag_name("testcase")).count();
    assert_eq!(cases, wanted);
    assert_eq!(suites[0].attribute("tests"), Some(cases.to_string().as_str()));
    // Equal runs give equal bytes: the report contains no times and no random names.
    place.run(&format!("run {FILES} --no-record --budget 1e5 --junit again.xml"));
    assert_eq!(fs::read_to_string(place.path("again.xml")).unwrap(), text);
}

#[test]
fn markdown_starts_with_the_verdict_and_lists_failures() {
    let place = place();
    place.run(&format!("run {FILES} --no-record --budget 1e5 --markdown out.md"));
    let text = fs::read_to_string(place.path("out.md")).unwrap();
    assert!(text.starts_with("**linkproof**: 3 scenarios, 1 disagree, 1 could not be proven, 1 agree\n"), "{text}");
    assert!(text.contains("| pendulum | agree |") && text.contains("| wrong | **disagree** |"), "{text}");
    assert!(text.contains("w as link.crank.omega_rad_s") && text.contains("joint \"Q\""), "{text}");
    assert!(text.lines().all(|line| !line.contains('\t')), "{text}");
}

/// Verdicts of a proof, each with its party and its subject, as the reports list them.
fn verdicts(proof: &Proof) -> Vec<(String, String, &Verdict)> {
    let mut all: Vec<_> = proof.checks.iter().map(|own| ("analytic sides".into(), own.name(), &own.verdict)).collect();
    for engine in &proof.engines {
        let by = engine.info.name.to_string();
        let channels = engine.channels.iter().map(|own| (own.residual.channel.to_string(), &own.verdict));
        let own = engine.own_forces.iter().flat_map(|own| &own.channels);
        let own = own.filter(|own| own.verdict.word() != "inconclusive");
        let own = own.map(|own| (format!("{} as the engine exerts it", own.residual.channel), &own.verdict));
        let checks = engine.checks.iter().map(|own| (own.name(), &own.verdict));
        all.extend(channels.chain(own).chain(checks).map(|(name, verdict)| (by.clone(), name, verdict)));
    }
    all
}

/// Three proofs: the first disagrees in many numbers and has a finding, the second is inconclusive, and in the third
/// the engines failed.
fn proofs() -> [Proof; 3] {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker.toml");
    let scenario = Scenario::load(&path).unwrap();
    let wrong = fs::read_to_string(&path).unwrap().replace("mass_kg = 34.7", "mass_kg = 34.8");
    let wrong = Scenario::parse(&wrong, &path).unwrap();
    let disagrees = prover::run::prove_against(&scenario, &wrong.case, &Options::default().step(2e-3)).unwrap();
    let open = prove(&scenario, &Options::default().step(2e-2)).unwrap();
    let mut failed = open.clone();
    failed.engines.push(failed.engines[0].clone());
    for (engine, why) in failed.engines.iter_mut().zip(["the first fails", "the second fails"]) {
        engine.failure = Some(linkage::Error::new(linkage::ErrorKind::Numeric, why));
    }
    [disagrees, open, failed]
}

/// The JUnit report states party, verdict and reason for each case.
/// The Markdown report counts the verdicts, and lists the first ten reasons of each scenario.
#[test]
fn reports_have_every_verdict_with_judge_and_reason() {
    let proofs = proofs();
    let mut outcomes = Outcomes::told_by(Advice::to_string);
    proofs.iter().for_each(|proof| outcomes.add(proof));
    let xml = junit::xml(&outcomes);
    let tree = roxmltree::Document::parse(&xml).unwrap();
    let suites: Vec<_> = tree.descendants().filter(|node| node.has_tag_name("testsuite")).collect();
    let text = markdown::text(&outcomes);
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("| crank_rocker |")).collect();
    assert_eq!((suites.len(), rows.len()), (3, 3), "{text}");
    assert!(text.starts_with("**linkproof**: 3 scenarios, 1 disagree, 2 could not be decided\n"), "{text}");
    for ((proof, suite), row) in proofs.iter().zip(&suites).zip(rows) {
        let all = verdicts(proof);
        let mut cases = suite.children().filter(|node| node.has_tag_name("testcase"));
        for (by, name, verdict) in &all {
            let case = cases.next().unwrap();
            let class = format!("crank_rocker.{by}");
            assert_eq!((case.attribute("name"), case.attribute("classname")), (Some(&**name), Some(&*class)));
            let said = case.children().find(roxmltree::Node::is_element);
            let (tag, word) = match verdict {
                Verdict::Agree { .. } => (None, None),
                Verdict::Expected { .. } => (Some("system-out"), None),
                Verdict::Disagree { .. } => (Some("failure"), Some("disagree")),
                Verdict::Inconclusive { .. } => (Some("error"), Some("inconclusive")),
            };
            let reason = verdict.reason(Advice::to_string);
            assert_eq!(said.map(|said| said.tag_name().name()), tag, "{name}");
            assert_eq!(said.and_then(|said| said.attribute("type")), word, "{name}");
            let told = said.and_then(|said| said.attribute("message").or(said.text()));
            assert_eq!(told, reason.as_deref(), "{name}");
        }
        // If several engines fail, the report gives the reason of the first engine that failed.
        let failure = cases.next().map(|case| (case.attribute("name"), case.first_element_child().unwrap()));
        let wanted = proof.engines[0].failure.as_ref().map(|_| (Some("proof"), Some("the first fails")));
        assert_eq!(failure.map(|(name, own)| (name, own.attribute("message"))), wanted);
        let count = |word: &str| all.iter().filter(|(_, _, verdict)| verdict.word() == word).count();
        let numbers = ["agree", "expected", "disagree", "inconclusive"].map(count).map(|count| count.to_string());
        assert!(row.ends_with(&format!(" | {} |", numbers.join(" | "))), "{row} {numbers:?}");
    }
    // Each section lists ten reasons and counts the remaining reasons.
    let sections: Vec<&str> = text.split("\n### ").skip(1).collect();
    assert_eq!(sections.len(), 3);
    for ((section, proof), errors) in sections.iter().zip(&proofs).zip([0, 0, 1]) {
        let told = section.lines().filter(|line| line.starts_with("- `")).count();
        let reasons =
            verdicts(proof).iter().filter(|(_, _, own)| ["disagree", "inconclusive"].contains(&own.word())).count();
        assert!(told == 10 && section.contains(&format!("- ... and {} more", reasons - 10)), "{reasons}: {section}");
        assert_eq!(section.lines().filter(|line| *line == "- the first fails").count(), errors, "{section}");
    }
}

/// A scenario that cannot be read has an entry in both reports, although it has no verdict.
#[test]
fn an_error_is_reported_without_any_verdict() {
    let mut outcomes = Outcomes::told_by(Advice::to_string);
    outcomes.add_failure("a.toml", &linkage::Error::new(linkage::ErrorKind::Input, "line 3 is bad"));
    let text = markdown::text(&outcomes);
    assert!(text.contains("1 could not be proven") && text.contains("\n### a.toml\n\n- line 3 is bad\n"), "{text}");
    let xml = junit::xml(&outcomes);
    assert!(xml.contains("message=\"line 3 is bad\"") && xml.contains("type=\"error\""), "{xml}");
}
