//! Errors in the motion law of `[drive]`, and grids that the law does not reach.

use super::{Bad, GOOD, INPUT, assert_refused};

#[test]
fn laws_and_their_grids() {
    let table = |points: &str| format!("law = \"table\"\npoints = [{points}]\n");
    let cases: [(String, &'static str, &'static str, &[&str]); 9] = [
        ("law = \"sine\"\n".into(), "law =", "drive.law", &["not a law of motion", "\"cycloidal\""]),
        ("law = \"ramp\"\nspeed_rpm = 130\n".into(), "[drive]", "drive", &["`time_s` or `time_ms` is missing"]),
        ("law = \"ramp\"\nspeed_rpm = 130\ntime_s = 0\n".into(), "time_s", "drive.time_s", &["must be positive"]),
        (
            "law = \"cycloidal\"\nto_deg = 0\ntime_s = 1\n".into(),
            "to_deg = 0",
            "drive.to_deg",
            &["the input would not change"],
        ),
        (
            "law = \"cycloidal\"\nto_deg = 90\ntime_s = 1\n".into(),
            "[grid]",
            "grid",
            &["reaches the requested crank angle 100.000 deg never or more than once"],
        ),
        (table("{ time_s = 0, angle_deg = 0 }"), "points = [{ time_s", "drive.points", &["at least two points"]),
        (
            table("{ time_s = 0, angle_deg = 5 }, { time_s = 1, angle_deg = 9 }"),
            "points = [{ time_s",
            "drive.points",
            &["the law begins with 5 deg"],
        ),
        (
            table("{ time_s = 0, angle_deg = 0 }, { time_s = 1, angle_deg = 9 }, { time_s = 1, angle_deg = 19 }"),
            "points = [{ time_s",
            "drive.points[3]",
            &["do not ascend"],
        ),
        (
            table("{ time_s = 0, angle_deg = 0 }, { time_s = 1, angle_deg = 9 }"),
            "[grid]",
            "grid",
            &["deg never or more than once; expected exactly one time"],
        ),
    ];
    for (text, at, key, words) in cases {
        let law: &'static str = Box::leak(text.into_boxed_str());
        assert_refused(GOOD, &Bad { edits: &[("speed_rpm = 130\n", law)], kind: INPUT, at, key, words });
    }
}

/// If the crank angle of `[start]` is missing, the first angle of the law does not contradict it.
#[test]
fn regress_a_missing_start_is_the_only_mistake() {
    let law = "law = \"table\"\npoints = [{ time_s = 0, angle_deg = -12 }, { time_s = 1, angle_deg = 9 }]\n";
    let text = GOOD.replace("speed_rpm = 130\n", law).replace("crank_deg = 0\n[[start", "[[start");
    let found = scenario::Scenario::parse(&text, std::path::Path::new("a.toml")).unwrap_err().to_string();
    assert!(found.contains("crank_deg") && !found.contains("the law begins"), "{found}");
}
