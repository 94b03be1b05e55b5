//! `linkproof run`.

use std::collections::BTreeSet;
use std::fs;

use assert_cmd::cargo::CommandCargoExt;
use linkage::trajectory::Stage;
use serde_json::Value;

use super::tools::{Place, texts};
use crate::common::{assert_within, from_outside, shipped};

const BOTH: &str = "scenarios/crank_rocker.toml scenarios/ov7_base.toml";

/// The keys of an object, each with the type of its value, in alphabetical order.
fn keys(object: &Value) -> String {
    let sort = |value: &Value| match value {
        Value::Null => "null",
        Value::Bool(_) => "bool",
        Value::Number(_) => "number",
        Value::String(_) => "text",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let mut all: Vec<String> =
        object.as_object().unwrap().iter().map(|(key, value)| format!("{key}:{}", sort(value))).collect();
    all.sort();
    all.join(" ")
}

/// Names of the checks of the analytic sides and of the first engine.
fn all_checks(run: &Value) -> Vec<&str> {
    [texts(&run["checks"], "name"), texts(&run["engines"][0]["checks"], "name")].concat()
}

#[test]
fn both_scenarios_agree_and_the_json_is_as_documented() {
    let place = Place::new();
    let outcome = place.run(&format!("run {BOTH} --no-record --json -"));
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{}", outcome.stdout);
    let document = outcome.json();
    assert_eq!(keys(&document), "runs:array schema:number");
    assert_eq!(document["schema"], 2);
    assert_eq!(texts(&document["runs"], "scenario"), ["crank_rocker", "ov7_base"]);
    for run in document["runs"].as_array().unwrap() {
        assert_eq!(
            keys(run),
            "checks:array engines:array figures:array left_out:object machine:object reason:null reference:object scenario:text structure:text title:text verdict:text work:array"
        );
        assert_eq!(run["verdict"], "agree");
        assert_eq!(keys(&run["reference"]), "from_s:number name:text samples:number to_s:number");
        let engine = &run["engines"][0];
        assert_eq!(
            keys(engine),
            "channels:array checks:array dt_s:number name:text own_forces:object provides:object reason:null search:object settings:object verdict:text version:text"
        );
        let provides = "accelerations:text balancing_moment:text positions:text reactions:text velocities:text";
        assert_eq!(keys(&engine["provides"]), provides);
        let own = &engine["own_forces"];
        assert_eq!(
            keys(own),
            "channels:array dt_s:number fault:null reason:null route:text search:object settings:object verdict:text"
        );
        let both = engine["channels"].as_array().unwrap().iter().chain(own["channels"].as_array().unwrap());
        for channel in both {
            let promised =
                "basis:text bound:number channel:text discretisation:number iteration:number left_out:number";
            let limit = if channel["limit"].is_null() { "null" } else { "number" };
            let rest = "origin:text q75:number q99:number reason:null reference:number rms:number rounding:number scale:number source:text unit:text verdict:text worst_crank_rad:number worst_t_s:number";
            // The order of convergence is null if rounding hides it.
            let order = if channel["observed_order"].is_null() { "null" } else { "number" };
            assert_eq!(keys(channel), format!("{promised} limit:{limit} max:number observed_order:{order} {rest}"));
            assert_eq!(channel["verdict"], "agree", "{channel}");
            let [q75, q99, max, bound] = ["q75", "q99", "max", "bound"].map(|key| channel[key].as_f64().unwrap());
            assert!(q75 <= q99 && q99 <= max && max <= bound, "{channel}");
        }
        for check in run["checks"].as_array().unwrap().iter().chain(engine["checks"].as_array().unwrap()) {
            let (finding, off, reason) = match check["verdict"] == "expected" {
                true => (" finding:text", " printed_off:number", "text"),
                false => ("", "", "null"),
            };
            let rest = format!("name:text origin:text{off} reason:{reason} unit:text value:number verdict:text");
            assert_eq!(keys(check), format!("basis:text bound:number{finding} {rest}"));
            assert!(check["value"].as_f64() <= check["bound"].as_f64(), "{check}");
            let known_wrong = check["name"].as_str().unwrap().contains("known to be wrong");
            assert!(!known_wrong || check["printed_off"].as_f64() > check["bound"].as_f64(), "{check}");
            assert!(check["basis"].as_str().unwrap().starts_with(check["origin"].as_str().unwrap()), "{check}");
            assert_eq!(check["verdict"], if known_wrong { "expected" } else { "agree" }, "{check}");
            assert_eq!(check["finding"].is_string(), known_wrong, "{check}");
        }
        for list in [texts(&engine["channels"], "channel"), texts(&run["checks"], "name")] {
            assert_eq!(list.iter().collect::<BTreeSet<_>>().len(), list.len(), "every name once: {list:?}");
        }
    }
    for (run, name) in document["runs"].as_array().unwrap().iter().zip(["crank_rocker", "ov7_base"]) {
        let expected: Vec<String> =
            shipped(&format!("{name}.toml")).case.channels().iter().map(ToString::to_string).collect();
        assert_eq!(texts(&run["engines"][0]["channels"], "channel"), expected);
    }
    assert!(document["runs"][0]["engines"][0]["dt_s"].is_f64());
}

#[test]
fn every_check_is_in_the_json() {
    let place = Place::new();
    let document = place.run(&format!("run {BOTH} --no-record --json -")).json();
    let stages = ["positions", "velocities", "accelerations", "reactions", "balancing_moment"];
    let common = |names: &BTreeSet<&str>| {
        for side in ["assur", "newton", "rapier"] {
            assert!(names.contains(format!("closure of all joints ({side})").as_str()), "{side}");
        }
        for stage in stages {
            assert!(names.contains(format!("assur against newton, {stage}").as_str()), "{stage}");
        }
        for side in ["assur", "newton"] {
            let name = format!("balancing moment from equilibrium and from powers ({side})");
            assert!(names.contains(name.as_str()), "{side}");
        }
        assert!(names.contains("driving moment from reactions and from powers (rapier)"));
    };
    let names = [0, 1].map(|k| all_checks(&document["runs"][k]));
    let [crank_rocker, ov7] = [0, 1].map(|k| names[k].iter().copied().collect::<BTreeSet<&str>>());
    common(&crank_rocker);
    common(&ov7);
    // Columns of the published tables except the crank angle, each checked against both sides.
    let tables = ["positions", "velocities", "accelerations", "angles", "angular_velocities", "angular_accelerations"];
    for table in tables {
        let text = fs::read_to_string(place.path(&format!("scenarios/ov7_base/{table}.csv"))).unwrap();
        for column in text.lines().next().unwrap().split(',').skip(1) {
            for side in ["assur", "newton"] {
                let name = format!("published {table}.csv ({side}), {column}");
                assert!(ov7.contains(name.as_str()), "{name}");
            }
        }
    }
    let figures = [
        "link.rocker.angle_deg",
        "reduced_inertia_mean_kg_m2",
        "reduced_resistance_mean_N_m",
        "steady_motor_speed_rad_s",
    ];
    for figure in figures {
        assert!(crank_rocker.iter().any(|name| !name.starts_with("published") && name.ends_with(figure)), "{figure}");
    }
    // Printed numbers that are known to be wrong: the program compares its own two lengths and two steady speeds with
    // them.
    for side in ["assur", "newton"] {
        for (oracle, wrong) in [
            ("lengths", ["distance_m of O A", "distance_m of A B"]),
            ("steady speed as printed", ["steady_crank_speed_rad_s", "steady_motor_speed_rad_s"]),
        ] {
            for figure in wrong {
                let name = format!("published {oracle}, known to be wrong ({side}), {figure}");
                assert!(crank_rocker.contains(name.as_str()), "{name}");
            }
        }
    }
}

#[test]
fn recordings_go_to_the_given_directory_reproducibly() {
    let place = Place::new();
    let report = place.ok("run scenarios/crank_rocker.toml");
    assert!(report.contains("AGREE: ") && report.contains("recordings/crank_rocker.mcap"), "{report}");
    place.ok("run scenarios/crank_rocker.toml --record deep/er");
    let [first, second] =
        ["recordings", "deep/er"].map(|dir| fs::read(place.path(dir).join("crank_rocker.mcap")).unwrap());
    assert!(first.starts_with(b"\x89MCAP") && first == second, "two equal runs give different recordings");
    assert_eq!(
        fs::read_dir(place.path("deep/er")).unwrap().count(),
        2,
        "the directory contains more than the recording and its layout"
    );

    let quiet = place.run("run scenarios/crank_rocker.toml --record third --json -");
    assert_eq!(quiet.json()["runs"][0]["recording"], "third/crank_rocker.mcap");
}

#[test]
fn without_recording_nothing_is_written() {
    let place = Place::new();
    place.ok("run scenarios/crank_rocker.toml --no-record");
    let left: Vec<_> = fs::read_dir(place.path("")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["scenarios"]);
}

#[test]
fn json_in_a_file_leaves_the_report_on_the_terminal() {
    let place = Place::new();
    let report = place.ok("run scenarios/crank_rocker.toml --no-record --json out.json --reference newton -v");
    assert!(report.contains("reference  newton") && report.contains("AGREE: "));
    let document: Value = serde_json::from_str(&fs::read_to_string(place.path("out.json")).unwrap()).unwrap();
    assert_eq!(document["runs"][0]["reference"]["name"], "newton");
}

#[test]
fn a_bad_file_does_not_stop_the_proof_of_good_ones() {
    let place = Place::new();
    place.edited("crank_rocker.toml", "bad.toml", &[("speed_rpm = 130", "speed = 130")]);
    let outcome = place.run("run scenarios/bad.toml scenarios/crank_rocker.toml gone.toml --no-record --json -");
    let document = outcome.json();
    assert_eq!(outcome.code, 2);
    assert_eq!(
        (texts(&document["runs"], "scenario"), document["runs"][0]["verdict"].as_str()),
        (vec!["crank_rocker"], Some("agree"))
    );
    assert_eq!(texts(&document["errors"], "scenario"), ["scenarios/bad.toml", "gone.toml"]);
    let [bad, gone] = [0, 1].map(|k| &document["errors"][k]);
    assert_eq!(keys(bad), "help:text key:text line:number message:text scenario:text");
    assert_eq!(keys(gone), "help:text key:null line:null message:text scenario:text");
    assert!(
        outcome.stderr.contains("scenarios/bad.toml:") && outcome.stderr.contains("speed_rpm"),
        "{}",
        outcome.stderr
    );
}

#[test]
fn a_wrong_published_number_disagrees_by_name() {
    let place = Place::new();
    place.edited("crank_rocker.toml", "wrong.toml", &[("_N_m\", value = 17.7778", "_N_m\", value = 17.7781")]);
    let outcome = place.run("run scenarios/wrong.toml --no-record");
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("DISAGREE: 2 of "), "one for each side: {}", outcome.stdout);
    assert!(outcome.stdout.contains("(assur), reduced_resistance_mean_N_m: 3.2"), "{}", outcome.stdout);

    // A table cell is changed by three units of its last digit.
    place.edited("ov7_base.toml", "wrong.toml", &[]);
    let table = place.path("scenarios/ov7_base/positions.csv");
    let text = fs::read_to_string(&table).unwrap();
    fs::write(&table, text.replacen("87.13", "87.16", 1)).unwrap();
    let outcome = place.run("run scenarios/wrong.toml scenarios/crank_rocker.toml --no-record --json -");
    let document = outcome.json();
    assert_eq!(outcome.code, 1, "the more serious of two outcomes determines the exit code");
    assert_eq!(texts(&document["runs"], "verdict"), ["disagree", "agree"]);
    let checks = document["runs"][0]["checks"].as_array().unwrap();
    let wrong: Vec<&Value> = checks.iter().filter(|check| check["verdict"] != "agree").collect();
    assert_eq!(wrong.len(), 2, "one for each side");
    assert_eq!(wrong[0]["name"], "published positions.csv (assur), P3y_mm");
    assert!(wrong[0]["reason"].as_str().unwrap().contains("at crank angle -30.000 deg"), "{}", wrong[0]);
}

#[test]
fn a_coarse_step_is_inconclusive_and_a_hopeless_one_refused() {
    let place = Place::new();
    let outcome = place.run("run scenarios/crank_rocker.toml --no-record --verbose --dt 2e-2");
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    assert!(
        outcome.stdout.contains("INCONCLUSIVE: ")
            && outcome.stdout.contains("choose a smaller time step, such as --dt 1e-2")
    );
    place.refused(
        "run scenarios/crank_rocker.toml --no-record --dt 3e-2",
        &["the run at 0.06 s", "smaller time step, such as --dt 1.5e-2"],
    );
    place.refused(
        "run scenarios/crank_rocker.toml --no-record --dt 2e-1",
        &["in one step", "crank angle", "smaller time step, such as --dt 1e-1"],
    );
}

#[test]
fn a_finer_step_agrees_within_finer_bounds() {
    let place = Place::new();
    let bound = |step: &str| {
        let run = place.run(&format!("run scenarios/crank_rocker.toml --no-record --json - --dt {step}")).json();
        let channels = run["runs"][0]["engines"][0]["channels"].as_array().unwrap().clone();
        let torque = channels.iter().find(|channel| channel["channel"] == "drive.torque_N_m").unwrap();
        assert_eq!(torque["verdict"], "agree");
        torque["bound"].as_f64().unwrap()
    };
    let quotient = bound("2e-3") / bound("5e-4");
    assert_within!(
        (quotient - 16.0).abs(),
        0.8,
        "second order: a quarter of the step, a sixteenth of the bound: {quotient}"
    );
}

/// Symptom: if a coarse run failed, the command ended, although finer runs were possible.
#[test]
fn regress_too_little_work_is_inconclusive() {
    let place = Place::new();
    for scenario in ["tangent", "pendulum", "fourth_class"] {
        let outcome = place.run(&format!("run scenarios/{scenario}.toml --budget 1 --no-record"));
        assert_eq!((outcome.code, outcome.stderr.as_str()), (3, ""), "{scenario}: {}", outcome.stdout);
        assert!(outcome.unbroken().contains("work limit was reached"), "{scenario}: {}", outcome.stdout);
        assert!(outcome.stdout.contains("--budget"), "{scenario}: {}", outcome.stdout);
    }
}

#[test]
fn invalid_steps_are_refused_at_once() {
    let place = Place::new();
    for (step, word) in [
        ("0", "'0'"),
        ("-1", "'-1'"),
        ("nan", "'nan'"),
        ("inf", "'inf'"),
        ("0,01", "point: 0.01"),
        ("1e-15", "the limit is"),
    ] {
        let start = std::time::Instant::now();
        place.refused(&format!("run {BOTH} --no-record --dt {step}"), &[word]);
        place.refused(&format!("solve scenarios/ov7_base.toml --with rapier --dt {step}"), &[word]);
        assert!(start.elapsed().as_secs() < 5, "--dt {step} took {:?}", start.elapsed());
    }
    place.refused("run scenarios/crank_rocker.toml --dt soon", &["soon", "--dt"]);
}

#[test]
fn a_proof_is_reported_even_if_its_recording_fails() {
    let place = Place::new();
    fs::write(place.path("plain"), "a file, not a directory").unwrap();
    // An error that can be known in advance is reported before any proof is run.
    let outcome =
        place.refused("run scenarios/crank_rocker.toml --record plain/below --json -", &["plain/below", "--no-record"]);
    assert_eq!(outcome.stdout, "");
    let run = "ulimit -f 4; trap '' XFSZ; exec \"$0\" run scenarios/crank_rocker.toml --record out --json -";
    let linkproof = std::process::Command::cargo_bin("linkproof").unwrap().get_program().to_owned();
    let mut command = std::process::Command::new("sh");
    let output = command.current_dir(place.path("")).args(["-c", run]).arg(linkproof).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("out/crank_rocker.mcap cannot be written"), "{told}");
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(texts(&document["runs"], "verdict"), ["agree"]);
    assert!(document["runs"][0]["recording"].is_null());
    assert_eq!(texts(&document["errors"], "scenario"), ["scenarios/crank_rocker.toml"]);
}

#[test]
fn scenarios_of_one_name_do_not_overwrite_each_other() {
    let place = Place::new();
    place.edited("crank_rocker.toml", "other.toml", &[("title = \"", "title = \"Another, ")]);
    place.ok("run scenarios/crank_rocker.toml --record alone");
    let both = "run scenarios/crank_rocker.toml scenarios/other.toml --record both";
    let told = place.ok(both);
    assert!(told.contains("both/crank_rocker-2.mcap (") && told.contains("its scenario text differs"), "{told}");
    let [alone, both] = ["alone", "both"].map(|dir| fs::read(place.path(dir).join("crank_rocker.mcap")).unwrap());
    assert!(alone == both, "the recording of the first scenario is kept");
    place.ok("run scenarios/crank_rocker.toml scenarios/crank_rocker.toml");
}

#[test]
fn unrequested_channels_are_neither_compared_nor_checked() {
    let place = Place::new();
    let only = "[channels]\nwant = [\"positions\", \"velocities\"]\n\n[grid]";
    // Given numbers of a channel that is not requested are refused. Some of the foreign program's numbers at the end of
    // the file are forces, so the test removes these numbers.
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    place.edited("crank_rocker.toml", "few.toml", &[("[grid]", only), (from_outside(&text), "")]);
    let document = place.run("run scenarios/few.toml --no-record --json -").json();
    let run = &document["runs"][0];
    assert_eq!(run["verdict"], "agree");
    let channels = shipped("crank_rocker.toml").case.channels();
    let wanted = channels.iter().filter(|channel| channel.kind.stage <= Stage::Velocities);
    let wanted: Vec<String> = wanted.map(ToString::to_string).collect();
    assert_eq!(texts(&run["engines"][0]["channels"], "channel"), wanted);
    assert!(
        ![texts(&run["checks"], "name"), texts(&run["engines"][0]["checks"], "name")]
            .concat()
            .iter()
            .any(|name| name.contains("moment from"))
    );
}

/// The option `--tolerance-scale` multiplies every bound by one factor.
/// With a factor of 1e-9, even correct numbers disagree.
/// A factor of zero is an exception: the verdicts are those of factor 1, and the report prints every channel and check
/// with its bound.
#[test]
fn the_tolerance_scale_applies_to_every_bound() {
    let place = Place::new();
    let command = "run scenarios/crank_rocker.toml --dt 2e-3 --no-record --tolerance-scale";
    let document = place.run(&format!("{command} 1e-9 --json -")).json();
    let run = &document["runs"][0];
    assert_eq!(run["verdict"], "disagree");
    let (bound, plain) = (
        |run: &Value| run["engines"][0]["channels"][3]["bound"].as_f64().unwrap(),
        place.run(&command.replace("--tolerance-scale", "--json -")).json(),
    );
    assert_within!((bound(run) / bound(&plain["runs"][0]) - 1e-9).abs(), 1e-20);
    let listed = place.ok(&format!("{command} 0"));
    let names = [texts(&run["engines"][0]["channels"], "channel"), all_checks(run)].concat();
    for name in names {
        assert!(listed.contains(name), "{name}: {listed}");
    }
    assert!(listed.contains("AGREE: "), "{listed}");
    place.refused(&format!("{command} -1"), &["--tolerance-scale", "0 or greater"]);
    place.refused(&format!("{command} x"), &["invalid"]);
}
