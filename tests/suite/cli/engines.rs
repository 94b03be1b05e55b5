//! `run` with several engines and various settings, and `tune`.

use std::fs;

use super::tools::{Place, texts};
use crate::common::{assert_within, rapiers};

#[test]
fn all_engines_are_reported_side_by_side() {
    let place = Place::new();
    let outcome = place.run("run scenarios/crank_rocker.toml --engine all --dt 2e-3 --no-record --json -");
    let document = outcome.json();
    let run = &document["runs"][0];
    let names = texts(&run["engines"], "name");
    assert!(names.starts_with(&rapiers()), "{names:?}");
    // Single precision proves less than double precision, so the result is inconclusive even if the engines in double
    // precision agree.
    // In any build, no engine may disagree.
    let single = cfg!(feature = "f32");
    let expected = if single { (3, Some("inconclusive")) } else { (0, Some("agree")) };
    assert_eq!((outcome.code, run["verdict"].as_str()), expected, "{run}");
    let verdicts = texts(&run["engines"], "verdict");
    assert!(verdicts.contains(&"agree") && verdicts.contains(&"inconclusive") == single, "{verdicts:?}");
    for engine in run["engines"].as_array().unwrap() {
        assert_ne!(engine["verdict"], "disagree", "{engine}");
    }
    assert!(run["disputes"].is_null());

    let report = place.ok("run scenarios/crank_rocker.toml --engine rapier --engine impulse --dt 2e-3 --no-record -v");
    for word in ["All engines", "rapier ", "impulse ", "Any two of these parties differ by at most the sum"] {
        assert!(report.contains(word), "{word}: {report}");
    }
}

#[test]
fn every_engine_is_a_side_of_the_recording() {
    let place = Place::new();
    place.ok("run scenarios/crank_rocker.toml --engine rapier --engine impulse --dt 2e-3");
    let sides = recording::load(&place.path("recordings/crank_rocker.mcap")).unwrap();
    assert_eq!(sides.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["reference", "rapier", "impulse"]);
}

#[test]
fn invalid_settings_are_refused() {
    let place = Place::new();
    place.refused("run scenarios/crank_rocker.toml --sweeps 0", &["'0' for '--sweeps", "at least 1"]);
    place.refused("run scenarios/crank_rocker.toml --substeps 0", &["'0' for '--substeps", "at least 1"]);
    place.refused("run scenarios/crank_rocker.toml --engine bullet", &["bullet", "rapier"]);
    place.refused("run scenarios/crank_rocker.toml --route guess", &["guess", "differences"]);
    place.refused("tune scenarios/crank_rocker.toml --within 0", &["between 0 and 1"]);
    place.refused(
        "tune scenarios/crank_rocker.toml --within 1e-4 --channel joint.X.fx_N",
        &["joint.X.fx_N", "reactions"],
    );
}

#[test]
fn command_line_settings_override_those_of_the_scenario() {
    let place = Place::new();
    let path = place.path("scenarios/crank_rocker.toml");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("[grid]", "[engine]\ndt_s = 1e-3\nsweeps = 256\nextrapolated = true\n[grid]"))
        .unwrap();
    let sweeps = |outcome: super::tools::Outcome| outcome.json()["runs"][0]["engines"][0]["settings"]["sweeps"].clone();
    assert_eq!(sweeps(place.run("run scenarios/crank_rocker.toml --no-record --json -")), "256");
    assert_eq!(sweeps(place.run("run scenarios/crank_rocker.toml --no-record --json - --sweeps 512")), "512");
    fs::write(&path, text.replace("[grid]", "[engine]\ndt_s = 1e-3\nname = \"bullet\"\n[grid]")).unwrap();
    place.refused("run scenarios/crank_rocker.toml", &["engine.name", "bullet", "rapier"]);
    fs::write(&path, text.replace("[grid]", "[engine]\nsweeps = -4\n[grid]")).unwrap();
    place.refused("run scenarios/crank_rocker.toml", &["engine.sweeps", "found -4"]);
}

#[test]
fn tune_writes_settings_that_meet_the_accuracy() {
    let place = Place::new();
    let command = "tune scenarios/crank_rocker.toml --within 1e-3 --engine rapier --extrapolate --route differences";
    let report = place.ok(command);
    assert!(
        report.contains("[engine]") && report.contains("--write") && report.contains("against the reference"),
        "{report}"
    );
    place.ok(&format!("{command} --write"));
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    assert!(text.contains("name = \"rapier\"") && text.contains("# Stable branch of the chosen motor"), "{text}");
    let document = place.run("run scenarios/crank_rocker.toml --no-record --json -").json();
    for channel in document["runs"][0]["engines"][0]["channels"].as_array().unwrap() {
        let [max, scale] = ["max", "scale"].map(|key| channel[key].as_f64().unwrap());
        assert_within!(max, 1e-3 * scale, "{channel}");
    }
    // The output does not depend on measured times: the same command gives the same bytes, including counts of runs.
    let all = "tune scenarios/pendulum.toml --within 1e-3 --channel positions --json -";
    assert_eq!(place.ok(all), place.ok(all));
    let found = place.run(&format!("{command} --json -")).json();
    assert!(found["best"]["dt_s"].as_f64().unwrap() > 0.0, "{found}");
    assert_within!(found["best"]["error"].as_f64().unwrap(), 1e-3, "{found}");
}
