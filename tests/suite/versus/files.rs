//! Files: recordings of earlier versions, Parquet, text; damaged ones.

use std::fs;
use std::path::Path;

use crate::cli::tools::Place;

/// Directory of files that other versions and other programs have written.
const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/versus");

fn place() -> Place {
    let place = Place::new();
    for file in fs::read_dir(KEPT).unwrap().map(|entry| entry.unwrap().path()) {
        let name = file.file_name().unwrap().to_str().unwrap();
        if !name.ends_with(".rs") {
            fs::copy(&file, place.path(name)).unwrap();
        }
    }
    place
}

/// Written by the first version that recorded at all.
#[test]
fn a_recording_of_the_first_version_is_read() {
    let place = place();
    let told = place.ok("compare scenarios/crank_rocker.toml first_version.mcap --side reference");
    assert!(told.starts_with("AGREE: all 54 channels"), "{told}");
    let outcome = place.run("compare scenarios/crank_rocker.toml first_version.mcap --side engine --rel 0.01");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{}", outcome.stdout);
    let outcome = place.run("compare scenarios/crank_rocker.toml first_version.mcap --side engine --rel 1e-7");
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
}

/// Both analytic sides are known to rounding: an old and a new recording of one mechanism agree without an allowance.
#[test]
fn two_recordings_are_compared_side_by_side() {
    let place = place();
    place.run("run scenarios/crank_rocker.toml --budget 1e4");
    let told = place.ok("compare first_version.mcap recordings/crank_rocker.mcap --side reference");
    assert!(told.starts_with("AGREE: all 54 channels at 25 times"), "{told}");
    assert!(told.contains("only in the second: frame.fx_N"), "{told}");
    let outcome = place.run("compare first_version.mcap recordings/crank_rocker.mcap");
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    assert!(outcome.stdout.contains("(engine) against") && outcome.stdout.contains("neither is analytic"));
    place.ok("compare first_version.mcap recordings/crank_rocker.mcap --rel 0.01");
}

#[test]
fn parquet_files_of_pandas_and_polars_are_read() {
    let place = place();
    let told = place.ok("compare scenarios/crank_rocker.toml pandas.parquet -v");
    assert!(told.starts_with("AGREE: all 3 channels at 31 times") && told.contains("without a number"), "{told}");
    // Single precision is known by its digits.
    place.ok("compare scenarios/crank_rocker.toml polars_f32.parquet");
    place.ok("compare pandas.parquet polars_f32.parquet --rel 1e-6");
}

/// Whatever bytes a file has: an error or a comparison, never a panic, and soon.
#[test]
fn damaged_parquet_files_are_refused() {
    let path = Path::new(KEPT).join("pandas.parquet");
    let right = fs::read(path).unwrap();
    let directory = tempfile::TempDir::new().unwrap();
    let file = directory.path().join("x.parquet");
    let mut refused = 0;
    for trial in 0..400usize {
        let mut bytes = right.clone();
        let at = (trial * 7919) % bytes.len();
        match trial % 4 {
            0 => bytes.truncate(at),
            1 => bytes[at] ^= 0xff,
            2 => bytes[at] = bytes[at].wrapping_add(1),
            _ => bytes[at..].iter_mut().take(8).for_each(|byte| *byte = 0),
        }
        fs::write(&file, bytes).unwrap();
        match linkproof::tables::load(&file) {
            Ok(_) => {}
            Err(error) => {
                refused += 1;
                assert!(error.message().contains("x.parquet") || error.place().is_some(), "{}", error.message());
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

#[test]
fn the_command_says_what_is_wrong() {
    let place = place();
    fs::write(place.path("plain.csv"), "t,phi3\n0,0.1\n0.1,x\n").unwrap();
    fs::write(place.path("names.csv"), "a,b\n0,0.1\n0.1,0.2\n").unwrap();
    fs::write(place.path("some.csv"), "t,phi3\n0,0.1\n0.1,0.2\n").unwrap();
    fs::write(place.path("bad.toml"), "[at]\ntimes = \"t\"\n").unwrap();
    let of = |rest: &str| format!("compare scenarios/crank_rocker.toml {rest}");
    place.refused(&of("nothing.csv"), &["nothing.csv", "cannot be read"]);
    place.refused(&of("plain.csv"), &["plain.csv:3", "\"x\"", "no number"]);
    place.refused(&of("names.csv"), &["nothing says where the rows", "`a` or `b`", "time_s"]);
    place.refused(&of("some.csv"), &["no column of the table is a channel", "phi3*180/pi=link"]);
    place.refused(&of("some.csv --map phi3"), &["--map", "`=`"]);
    place.refused(&of("some.csv --map bad.toml"), &["bad.toml:2", "`times`", "time_s"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --rel=-1"), &["0 or greater"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --abs 1"), &["CHANNEL=SIZE"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --by crank"), &["no crank angles"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --rel joint.B=1"), &["joint.B"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --side engine"), &["--side", "recording"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --only point.X"), &["point.X"]);
    place.refused(&of("some.csv --map-a phi3=link.rocker.angle_rad"), &["--map-a", "no table"]);
    place.refused("compare scenarios/crank_rocker.toml scenarios/pendulum.toml --map a=b", &["neither", "--map"]);
    place.refused("compare scenarios/crank_rocker_runup.toml some.csv --map t=crank_rad --map phi3=link.rocker.angle_rad --by crank", &["free"]);
}

#[test]
fn the_json_has_both_values_at_the_worst_instant() {
    let place = place();
    fs::write(place.path("some.csv"), "t_s,link.rocker.angle_deg\n0,80\n0.1,60.5\n0.2,70\n0.25,71\n").unwrap();
    let outcome = place.run("compare scenarios/crank_rocker.toml some.csv --json - --write-map kept.toml --rel 0.1");
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    let json: serde_json::Value = serde_json::from_str(&outcome.stdout).unwrap();
    let channel = &json["pairs"][0]["channels"][0];
    let worst = &channel["worst"];
    let number = |of: &serde_json::Value| of.as_f64().unwrap();
    assert_eq!(json["verdict"], "disagree");
    assert!(
        (number(&worst["second"]) - number(&worst["first"]) - number(&worst["difference"])).abs() < 1e-9,
        "{worst}"
    );
    assert!(number(&worst["bound"]) > 0.5 && channel["bound_is"] == "allowed", "{channel}");
    let kept = fs::read_to_string(place.path("kept.toml")).unwrap();
    assert_eq!(kept, "[tolerance]\nall = { rel = 0.1 }\n");
}

/// Reports of tests and comments have the same verdicts, and nothing that is no mapping is written over by one.
#[test]
fn other_programs_read_the_verdicts() {
    let place = place();
    fs::write(place.path("some.csv"), "t_s,link.rocker.angle_deg\n0,80\n0.1,60.5\n0.2,70\n0.25,71\n").unwrap();
    let line = "compare scenarios/crank_rocker.toml some.csv";
    let outcome = place.run(&format!("{line} --junit out.xml --markdown - -q"));
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    let comment = "**linkproof**: 1 comparison, 1 disagree\n\n| comparison | verdict |";
    assert!(outcome.stdout.contains(comment), "{}", outcome.stdout);
    let row = "| some.csv against scenarios/crank_rocker.toml | **disagree** |";
    assert!(outcome.stdout.contains(row), "{}", outcome.stdout);
    let xml = fs::read_to_string(place.path("out.xml")).unwrap();
    assert!(xml.contains("name=\"link.rocker.angle_deg\"") && xml.contains("type=\"disagree\""), "{xml}");
    for (target, words) in [
        ("scenarios/crank_rocker.toml", "no mapping and would be overwritten"),
        ("kept.map", "ends in .toml"),
        ("nowhere/kept.toml", "no directory nowhere"),
    ] {
        place.refused(&format!("{line} --write-map {target}"), &["--write-map", words]);
    }
}
