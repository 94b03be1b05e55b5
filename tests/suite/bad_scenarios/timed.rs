//! Errors in the crank angles and times of published numbers.

use super::{Bad, GOOD, INPUT, assert_all_refused, assert_refused, parse};

/// The good scenario with a free crank, over a tenth of a second; its published numbers belong to times, not to angles.
fn free() -> String {
    let edits = [
        ("speed_rpm = 130\n", "motion = \"free\"\nspeed_rpm = 130\n"),
        ("from_deg = 0\nto_deg = 360\nstep_deg = 10", "from_ms = 0\nto_ms = 100\nstep_ms = 10"),
        ("crank_deg = 90\nvalues", "time_ms = 50\nvalues"),
    ];
    let text = edits.iter().fold(GOOD.to_string(), |text, (from, to)| text.replacen(from, to, 1));
    let [from, to] = ["a table", "a number"].map(|of| text.find(&format!("[[oracle]]\nsource = \"{of}\"")).unwrap());
    text[..from].to_string() + &text[to..]
}

#[test]
fn a_number_needs_exactly_one_instant() {
    assert_all_refused(&[
        bad!("crank_deg = 90\nvalues" => "values", INPUT, at "[[oracle]]\nsource = \"a number\"", key "oracle[2]",
            ["`crank_deg`, `crank_rad`, `time_s` or `time_ms` is missing", "or a time for each number"]),
        bad!("crank_deg = 90\nvalues" => "crank_deg = 90\ntime_s = 0.1\nvalues", INPUT, at "time_s", key "oracle[2].time_s",
            ["a crank angle and a time are both given", "keep one of the two"]),
        bad!("crank_deg = 90\nvalues" => "time_s = 0.1\ntime_ms = 100\nvalues", INPUT, at "time_ms", key "oracle[2].time_ms",
            ["`time_s` and `time_ms` are both given"]),
        bad!("crank_deg = 90\nvalues" => "time = 0.1\nvalues", INPUT, at "time = ", key "oracle[2].time",
            ["has no unit", "`time_s` or `time_ms`"]),
        bad!("crank_deg = 90\nvalues" => "time_h = 0.1\nvalues", INPUT, at "time_h", key "oracle[2].time_h",
            ["does not end in a unit of a time"]),
        bad!("crank_deg = 90\nvalues" => "time_s = 1e9\nvalues", INPUT, at "time_s", key "oracle[2].time_s",
            ["turns from zero", "within the run"]),
        bad!("crank = \"crank_deg\"\n" => "", INPUT, at "[[oracle]]\nsource = \"a table\"", key "oracle[1]",
            ["`crank` or `time` is missing"]),
        bad!("crank = \"crank_deg\"\n" => "crank = \"crank_deg\"\ntime = \"t_s\"\n", INPUT, at "time =", key "oracle[1].time",
            ["both named", "keep one of the two"]),
        bad!("crank = \"crank_deg\"\n" => "time = \"crank_deg\"\n", INPUT, at "time =", key "oracle[1].time",
            ["does not state its unit", "`_s` or `_ms`"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.B.x_mm\", expect = [{ time_s = 0, finding = \"x\", right = { value = 1, digits = 1 } }]",
            INPUT, at "expect", key "oracle[1].columns.Bx_mm.expect[1].time_s", ["no row with this time"]),
    ]);
}

/// A free motion begins at t = 0 and is solved up to the end of its grid.
/// The angles of its crank are not known in advance.
#[test]
fn times_must_lie_within_the_run() {
    let good = free();
    parse(&good, super::TABLE).unwrap_or_else(|error| panic!("{error}"));
    let own = "time_ms = 50\nvalues";
    for (at, key, words) in [
        ("time_s = 0.1001", "oracle[1].time_s", ["goes from 0 to 0.1 s", "within the run"]),
        ("time_ms = -1", "oracle[1].time_ms", ["-0.001 s", "within the run"]),
        ("crank_deg = 90", "oracle", ["the motion is free", "at times (`time_s`)"]),
    ] {
        let to: &'static str = format!("{at}\nvalues").leak();
        // For a free crank, the message points at the whole block of numbers.
        let at = if key == "oracle" { "[[oracle]]" } else { at };
        assert_refused(&good, &Bad { edits: &[(own, to)], kind: INPUT, at, key, words: &words });
    }
    assert!(parse(&good.replacen(own, "time_ms = 100\nvalues", 1), super::TABLE).is_ok(), "the last instant itself");
}

/// A time beyond the end of a motion law or of a free motion is refused.
/// If the time is in a table of published numbers, the message names the line of the table that contains the time.
#[test]
fn times_must_lie_within_the_law_and_rows_name_their_line() {
    let law = [
        ("speed_rpm = 130\n", "law = \"cycloidal\"\nto_deg = 200\ntime_s = 0.2\n"),
        ("from_deg = 0\nto_deg = 360\nstep_deg = 10", "from_s = 0\nto_s = 0.1\nstep_s = 0.01"),
        ("crank_deg = 90\nvalues", "time_ms = 200.5\nvalues"),
    ];
    let words = ["\"cycloidal\" is defined from 0 to 0.2 s"];
    assert_refused(GOOD, &Bad { edits: &law, kind: INPUT, at: "time_ms", key: "oracle[2].time_ms", words: &words });

    let table = "file = \"table.csv\"\ntime = \"t_ms\"\n[oracle.columns]\nBx_mm = { channel = \"point.B.x_mm\" }\n";
    let text = free() + "\n[[oracle]]\nsource = \"a run\"\n" + table;
    let error = parse(&text, "t_ms,Bx_mm\n0,301.12\n\n100.5,298.5\n").unwrap_err();
    let place = error.place().unwrap();
    assert_eq!((error.kind(), place.line(), error.scenario_key()), (INPUT, 4, Some("oracle[3].time")), "{error}");
    assert!(error.message().contains("0.1005 s is outside the run"), "{error}");
}
