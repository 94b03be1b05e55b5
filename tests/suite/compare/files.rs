//! Comparison of files: recordings of earlier versions, Parquet, text, and damaged files.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::cli::tools::Place;
use crate::common::parquet::{Announced, GZIP};

/// Directory of files written by earlier versions and by foreign programs.
const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/compare");

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

/// The recording of this test comes from the first version that could record.
#[test]
fn a_recording_of_the_first_version_is_read() {
    let place = place();
    let told = place.ok("compare scenarios/crank_rocker.toml first_version.mcap --side reference");
    assert!(told.starts_with("AGREE: all 54 channels agree"), "{told}");
    let outcome = place.run("compare scenarios/crank_rocker.toml first_version.mcap --side engine --rel 0.01");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{}", outcome.stdout);
    let outcome = place.run("compare scenarios/crank_rocker.toml first_version.mcap --side engine --rel 1e-7");
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
}

/// Both recordings contain an analytic side, which is accurate to rounding error.
/// An old and a new recording of one mechanism therefore agree without an allowed difference.
#[test]
fn two_recordings_are_compared_side_by_side() {
    let place = place();
    place.run("run scenarios/crank_rocker.toml --budget 1e4");
    let told = place.ok("compare first_version.mcap recordings/crank_rocker.mcap --side reference");
    assert!(told.starts_with("AGREE: all 54 channels agree at 25 times"), "{told}");
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
    assert!(
        told.starts_with("AGREE: all 3 channels agree at 31 times") && told.contains("without a measured value"),
        "{told}"
    );
    // The program detects single precision from the digits of the numbers.
    place.ok("compare scenarios/crank_rocker.toml polars_f32.parquet");
    place.ok("compare pandas.parquet polars_f32.parquet --rel 1e-6");
}

/// Any bytes lead to an error or a table, never to a panic.
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
        match prover::tables::load(&file) {
            Ok(_) => {}
            Err(error) => {
                refused += 1;
                assert!(error.message().contains("x.parquet") || error.place().is_some(), "{}", error.message());
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

/// A reader would allocate as much memory as a file announces.
/// The announced sizes are therefore checked first.
#[test]
fn sizes_announced_by_a_parquet_file_take_no_memory() {
    let directory = tempfile::TempDir::new().unwrap();
    let path = directory.path().join("x.parquet");
    let load = |own: &Announced| {
        fs::write(&path, own.file()).unwrap();
        prover::tables::load(&path)
    };
    let packed = |bytes: usize| {
        let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        packer.write_all(&vec![0; bytes]).unwrap();
        packer.finish().unwrap()
    };
    let (zeros, run) = (Announced::zeros(1000), Announced::run(1000));
    let of_gzip = |bytes: usize| {
        let body = packed(bytes);
        Announced { codec: GZIP, stored: body.len() as i64, body, ..zeros.clone() }
    };
    let groups = Announced { groups: 3, rows: 3000, ..run.clone() };
    for (own, rows) in [(zeros.clone(), 1000), (run.clone(), 1000), (groups, 3000), (of_gzip(8000), 1000)] {
        let table = load(&own).unwrap();
        assert_eq!(table.names, ["a"]);
        assert!(table.columns[0].len() == rows && table.columns[0].iter().all(|cell| cell.value == 0.0));
    }
    let most = i64::from(i32::MAX);
    for (own, told) in [
        (Announced { children: most, ..zeros.clone() }, "columns that do not exist"),
        (Announced { children: -1, ..zeros.clone() }, "columns that do not exist"),
        (Announced { depth: 100_000, ..zeros.clone() }, "columns are nested"),
        (Announced { held: most, ..zeros.clone() }, "announces 2147483647 bytes"),
        (Announced { stored: most, ..zeros.clone() }, "longer than its column"),
        (Announced { values: most, ..zeros.clone() }, "more values than the 1000 rows"),
        (Announced { dictionary: Some(most), ..run.clone() }, "a dictionary of 8 bytes has 2147483647 values"),
        (Announced { rows: 1, ..zeros.clone() }, "a different number of rows than the file announces"),
        (Announced { of_group: -1, ..zeros.clone() }, "a different number of rows than the file announces"),
        (of_gzip(1 << 26), "more than the 8000 bytes"),
        (Announced { values: 10, ..Announced::zeros(100) }, "fewer values than there are rows"),
        (Announced { rows: most << 20, of_group: most << 20, ..run }, "but the limit is 67108864"),
    ] {
        let error = load(&own).unwrap_err();
        assert!(error.message().contains("x.parquet") && error.message().contains(told), "{told}: {}", error.message());
    }
}

#[test]
fn compare_reports_invalid_input() {
    let place = place();
    fs::write(place.path("plain.csv"), "t,phi3\n0,0.1\n0.1,x\n").unwrap();
    fs::write(place.path("names.csv"), "a,b\n0,0.1\n0.1,0.2\n").unwrap();
    fs::write(place.path("some.csv"), "t,phi3\n0,0.1\n0.1,0.2\n").unwrap();
    fs::write(place.path("bad.toml"), "[at]\ntimes = \"t\"\n").unwrap();
    let of = |rest: &str| format!("compare scenarios/crank_rocker.toml {rest}");
    place.refused(&of("nothing.csv"), &["nothing.csv", "cannot be read"]);
    place.refused(&of("plain.csv"), &["plain.csv:3", "\"phi3\": expected a number, found \"x\""]);
    place.refused(&of("names.csv"), &["has no column of times or crank angles", "`a` or `b`", "time_s"]);
    place.refused(&of("some.csv"), &["no column of the table is a channel", "phi3*180/pi=link"]);
    place.refused(&of("some.csv --map phi3"), &["--map", "`=`"]);
    place.refused(&of("some.csv --map bad.toml"), &["bad.toml:2", "`times`", "time_s"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --rel=-1"), &["0 or greater"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --abs 1"), &["CHANNEL=SIZE"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --by crank"), &["no crank angles"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --rel joint.B=1"), &["joint.B"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --side engine"), &["--side", "recording"]);
    place.refused(&of("some.csv --map phi3=link.rocker.angle_rad --only point.X"), &["point.X"]);
    place.refused(&of("some.csv --map-a phi3=link.rocker.angle_rad"), &["--map-a", "A is not a table"]);
    place.refused("compare scenarios/crank_rocker.toml scenarios/pendulum.toml --map a=b", &["neither", "--map"]);
    place.refused("compare scenarios/crank_rocker_runup.toml some.csv --map t=crank_rad --map phi3=link.rocker.angle_rad --by crank", &["free"]);
}

/// Tables as foreign programs print them: nine digits throughout, or times with fifteen digits and numbers with nine.
#[test]
fn rounded_instants_and_the_digits_of_each_column_are_in_the_bound() {
    let place = place();
    let maps = "--map y=link.piston.y_m --map v=link.piston.vy_m_s --map a=link.piston.ay_m_s2";
    for table in ["piston_9_digits.csv", "piston_times_of_15_digits.csv"] {
        let told = place.ok(&format!("compare engine.toml {table} {maps}"));
        assert!(told.starts_with("AGREE: all 3 channels agree at 73 times, 219 values"), "{told}");
    }
}

/// A diverged simulation writes NaN, which never counts as agreement.
/// Missing values are left out and counted.
#[test]
fn nan_does_not_agree_and_missing_cells_are_counted() {
    let place = place();
    let outcome = place.run("compare scenarios/crank_rocker.toml nan_after_3_rows.csv --rel 1e-6");
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    let json = place.run("compare scenarios/crank_rocker.toml nan_after_3_rows.csv --json -").json();
    let since = &json["pairs"][0]["channels"][0];
    assert!(since["since"]["second"].is_null() && since["reason"].as_str().unwrap().contains("no number"), "{since}");
    let text = fs::read_to_string(place.path("nan_after_3_rows.csv")).unwrap();
    for marker in ["", "-", "NULL", "None", "N/A"] {
        fs::write(place.path("missing.csv"), text.replace("nan", marker).replace("NaN", marker)).unwrap();
        let told = place.ok("compare scenarios/crank_rocker.toml missing.csv");
        assert!(told.starts_with("AGREE: all 15 channels agree at 41 times, 45 of 615 values"), "{marker}: {told}");
        assert!(told.contains("left out: up to 38 instants"), "{marker}: {told}");
    }
    // A row is used for a channel only if every column in the channel's expression has a number in this row.
    fs::write(place.path("some.csv"), "t_s,a,b\n0,0,\n0.01,1,60\n").unwrap();
    let line = "compare scenarios/crank_rocker.toml some.csv --map ln(a-2)+b=link.rocker.angle_deg --rel 100";
    place.refused(line, &["line 3 of the table", "ln(-1) is undefined"]);
    let told = place.ok("compare scenarios/crank_rocker.toml some.csv --map a+b=link.rocker.angle_deg --rel 100");
    assert!(told.starts_with("AGREE: all 1 channels agree at 2 times, 1 of 2 values"), "{told}");
}

/// If two columns have the same name, the table is refused as ambiguous.
#[test]
fn duplicate_column_names_are_refused_in_every_table() {
    let place = place();
    let words = ["two_columns_r.csv:1", "columns 2 and 3", "\"r\"", "a unique name"];
    place.refused(
        "compare scenarios/crank_rocker.toml two_columns_r.csv --map phi_deg=crank_deg --map r=point.B.x_m",
        &words,
    );
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    let oracle = "\n[[oracle]]\nsource = \"s\"\nfile = \"../two_columns_r.csv\"\ncrank = \"phi_deg\"\n\
                  columns = { r = { channel = \"link.rocker.angle_deg\" } }\n";
    fs::write(place.path("scenarios/twice.toml"), text + oracle).unwrap();
    place.refused("run scenarios/twice.toml --no-record", &words);
}

/// If a recording or a table has times and crank angles, the rows match by time and the crank angle is compared too.
#[test]
fn the_crank_angle_is_compared_if_both_files_have_it() {
    let place = place();
    place.run("run scenarios/crank_rocker.toml --budget 1e4");
    place.ok("compare scenarios/crank_rocker.toml recordings/crank_rocker.mcap --side reference");
    let right = "t_s,crank_deg,link.rocker.angle_rad\n";
    let table = place.ok("solve scenarios/crank_rocker.toml --with assur");
    let rows = super::super::cli::tools::Table::of(&table);
    let [times, angles] = ["t_s", "link.rocker.angle_rad"].map(|name| rows.column(name));
    let crank = |row: usize| row as f64;
    let write = |of: &dyn Fn(usize) -> f64| {
        let line = |row: usize| format!("{},{},{}\n", times[row], of(row), angles[row]);
        let lines: String = (1..times.len() - 1).map(line).collect();
        fs::write(place.path("both.csv"), format!("{right}{lines}")).unwrap();
        place.run("compare scenarios/crank_rocker.toml both.csv")
    };
    assert_eq!(write(&crank).code, 0);
    // The angles of a table may differ by whole revolutions.
    assert_eq!(write(&|row| crank(row) - 360.0).code, 0);
    for wrong in [&(|row| -crank(row)) as &dyn Fn(usize) -> f64, &|row| crank(row + 1), &|row| crank(row - 1)] {
        let outcome = write(wrong);
        assert_eq!(outcome.code, 1, "{}", outcome.stdout);
        let told = outcome.unbroken();
        assert!(told.starts_with("DISAGREE: the crank angle disagrees; all 1 channels agree at "), "{told}");
        assert!(told.contains("crank angle: first at t = "), "{told}");
        fs::copy(place.path("both.csv"), place.path("wrong.csv")).unwrap();
        assert_eq!(write(&crank).code, 0);
        let outcome = place.run("compare both.csv wrong.csv --abs crank=0.5");
        assert!(outcome.code == 1 && outcome.stdout.contains("the crank angle"), "{}", outcome.stdout);
        place.ok("compare both.csv wrong.csv --abs crank=0.5 --only link.rocker.angle_rad");
    }
}

/// A Parquet file with an unsupported compression is refused, and the message names the compression.
/// A file compressed with gzip is read.
#[test]
fn compressed_parquet_files_are_read_or_refused_by_name() {
    let place = place();
    for (file, name) in [("brotli.parquet", "Brotli"), ("lz4.parquet", "LZ4")] {
        place.refused(&format!("compare scenarios/crank_rocker.toml {file}"), &[file, name, "zstd"]);
    }
    let told = place.ok("compare scenarios/crank_rocker.toml gzip.parquet");
    assert!(told.starts_with("AGREE: all 1 channels agree at 31 times, 31 values"), "{told}");
}

/// A pipe delivers every byte only once.
/// The program reads the first four bytes of the pipe to see whether the table is Parquet, and keeps these bytes.
#[test]
fn a_table_comes_through_a_pipe_with_all_its_bytes() {
    let place = place();
    let through = |bytes: &[u8]| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_linkproof"))
            .args(["compare", "scenarios/crank_rocker.toml", "-"])
            .current_dir(place.path(""))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(bytes).unwrap();
        let done = child.wait_with_output().unwrap();
        (done.status.code(), String::from_utf8(done.stdout).unwrap() + &String::from_utf8(done.stderr).unwrap())
    };
    let table = place.ok("solve scenarios/crank_rocker.toml --with assur --only link.rocker.angle_rad");
    let (code, told) = through(table.as_bytes());
    assert!(code == Some(0) && told.starts_with("AGREE: all 1 channels agree at 361 times"), "{told}");
    assert_eq!(through(b"t\n").0, Some(2));
    let (code, told) = through(&fs::read(place.path("pandas.parquet")).unwrap());
    assert!(code == Some(2) && told.contains("Parquet file that comes through a pipe"), "{told}");
}

/// The memory for the numbers of a table, for the comparison and for `[[oracle]]` is estimated before it is allocated.
#[test]
fn tables_beyond_the_memory_limit_are_refused() {
    let place = place();
    let words = ["of memory", "are allowed", "--memory"];
    place.refused(
        "compare scenarios/crank_rocker.toml pandas.parquet --memory 1e-6",
        &["the table pandas.parquet", words[0]],
    );
    place.refused("compare scenarios/crank_rocker.toml piston_9_digits.csv --memory 1e-6", &words);
    let line = "compare engine.toml piston_9_digits.csv --map y=link.piston.y_m";
    place.refused(&format!("{line} --memory 0.01"), &["comparing 73 rows", words[0], words[1], words[2]]);
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    let rows: String = (0..200_000).map(|row| format!("{}.5,{}.5\n", row % 360, row % 360)).collect();
    fs::write(place.path("long.csv"), format!("crank_deg,a\n{rows}")).unwrap();
    let oracle = "\n[[oracle]]\nsource = \"s\"\nfile = \"../long.csv\"\ncrank = \"crank_deg\"\n\
                  columns = { a = { channel = \"link.crank.angle_deg\" } }\n";
    fs::write(place.path("scenarios/long.toml"), text + oracle).unwrap();
    place.refused("run scenarios/long.toml --no-record --memory 0.05", &["[[oracle]]", words[0], words[1]]);
    // With less memory, the table is refused before its numbers are read.
    place.refused(
        "run scenarios/long.toml --no-record --memory 0.01",
        &["scenarios/long.toml:", "reading 200000 rows", words[0], words[1], words[2]],
    );
    let line = "compare scenarios/crank_rocker.toml long.csv --map a=link.crank.angle_deg";
    place.refused(&format!("{line} --memory 0.02"), &["comparing 200000 rows", words[0], words[1], words[2]]);
    place.refused(&format!("{line} --memory 1e-3"), &["the table long.csv", words[0], words[1], words[2]]);
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

/// The JUnit report and the Markdown comment of a comparison give the same verdict.
/// A mapping never overwrites a file that is not a mapping.
#[test]
fn junit_and_markdown_reports_have_the_same_verdicts() {
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
        ("scenarios/crank_rocker.toml", "not a mapping and would be overwritten"),
        ("kept.map", "must end in .toml"),
        ("nowhere/kept.toml", "the directory nowhere does not exist"),
    ] {
        place.refused(&format!("{line} --write-map {target}"), &["--write-map", words]);
    }
}

/// Symptom: a missing dictionary page made the reader panic; the panic was caught, but its message was printed.
#[test]
fn regress_a_panic_of_the_parquet_reader_becomes_a_message() {
    let place = Place::new();
    fs::write(place.path("x.parquet"), Announced { encoding: 2, ..Announced::zeros(1000) }.file()).unwrap();
    place.refused(
        "compare x.parquet x.parquet",
        &["x.parquet is cut off or damaged", "the parts of the file contradict each other"],
    );
}
