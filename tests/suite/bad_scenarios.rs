//! Errors in a scenario file and their messages.
//! Each case is a good scenario with one or a few edits, and asserts the kind of error, the line, the key, and the
//! words that help the user.

use std::path::Path;

use linkage::mechanism::LinkId;
use linkage::{Error, ErrorKind};
use scenario::Scenario;

const GOOD: &str = include_str!("bad_scenarios/good.toml");

const TABLE: &str = "crank_deg,Bx_mm\n0,301.12\n90,298.5\n";

/// One bad scenario.
struct Bad<'a> {
    /// Replacements in the good scenario; each text to be replaced must occur in it.
    edits: &'a [(&'static str, &'static str)],
    kind: ErrorKind,
    /// Text of the edited scenario; the error must point at the line of its first occurrence.
    at: &'static str,
    /// Key that the error names.
    key: &'static str,
    /// Words of the message or the help.
    words: &'a [&'static str],
}

fn parse(text: &str, table: &str) -> Result<Scenario, Error> {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("table.csv"), table).unwrap();
    Scenario::parse(text, directory.path().join("scenario.toml"))
}

fn line_of(text: &str, marker: &str) -> usize {
    let start = text.find(marker).unwrap_or_else(|| panic!("`{marker}` is not in the edited scenario"));
    text[..start].matches('\n').count() + 1
}

/// Applies the edits, parses, and asserts all expected properties of the error.
fn assert_refused(good: &str, bad: &Bad) {
    let mut text = good.to_string();
    for (from, to) in bad.edits {
        assert!(text.contains(from), "the edit `{from}` does not apply");
        text = text.replacen(from, to, 1);
    }
    let what = bad.edits.iter().map(|(_, to)| *to).collect::<Vec<_>>().join(" | ");
    let Err(error) = parse(&text, TABLE) else { panic!("accepted: {what}") };
    assert_eq!(error.kind(), bad.kind, "{what}: {error}");
    assert_eq!(error.scenario_key(), Some(bad.key), "{what}: {error}");
    let place = error.place().unwrap_or_else(|| panic!("no place: {error}"));
    assert_eq!(place.line(), line_of(&text, bad.at), "{what}: {error}");
    let says = format!("{}; {}", error.message(), error.way_out().unwrap_or_default());
    for word in bad.words {
        assert!(says.contains(word), "{what}: `{word}` is not in: {says}");
    }
}

fn assert_all_refused(cases: &[Bad]) {
    cases.iter().for_each(|bad| assert_refused(GOOD, bad));
}

const INPUT: ErrorKind = ErrorKind::Input;

/// A bad scenario that differs from the good one by one edit.
macro_rules! bad {
    ($from:expr => $to:expr, $kind:expr, at $at:expr, key $key:expr, [$($word:expr),+ $(,)?]) => {
        Bad { edits: &[($from, $to)], kind: $kind, at: $at, key: $key, words: &[$($word),+] }
    };
}

mod clearance;
mod laws;
mod loads;
mod masses;
mod motors;
mod remedies;
mod several;
mod sliders;
mod timed;

#[test]
fn the_unedited_scenario_is_valid() {
    let scenario = parse(GOOD, TABLE).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scenario.case.grid.len(), 37);
    assert_eq!(scenario.oracles[0].series[0].points[1].digits, 2);
}

/// Symptoms: masses of 1e300 gave NaN and the verdict DISAGREE; with a start at 1e18 deg the program did not end.
#[test]
fn regress_numbers_of_extreme_size_are_refused() {
    let mass = ["found 1e", "a mass must be zero or of a magnitude from 1e-100 to 1e30 kg", "check the unit"];
    assert_all_refused(&[
        bad!("mass_kg = 2.6" => "mass_kg = 1e300", INPUT, at "mass_kg = 1e300", key "links.crank.mass_kg", [mass[0], mass[1], mass[2]]),
        bad!("mass_kg = 2.6" => "mass_kg = 1e-300", INPUT, at "mass_kg = 1e-300", key "links.crank.mass_kg", [mass[0], mass[1]]),
        bad!("inertia_kg_m2 = 0.0002" => "inertia_kg_m2 = 1e31", INPUT, at "inertia_kg_m2 = 1e31",
            key "links.crank.inertia_kg_m2", ["to 1e30 kg_m2"]),
        bad!("crank_deg = 0\n[[start" => "crank_deg = 1e10\n[[start", INPUT, at "[start]", key "start.crank",
            ["starts 2.8e7 turns from zero", "the limit is 1e5", "within a turn"]),
    ]);
}

/// Symptoms: 1e18 rpm ended in DISAGREE; with lengths of 1e12 m, a pose was called singular.
/// Cause: one limit of 1e30 for every quantity, far beyond what the analytic sides and an engine can resolve.
#[test]
fn regress_values_beyond_any_machine_are_refused() {
    assert_all_refused(&[
        bad!("speed_rpm = 130" => "speed_rpm = 1e18", INPUT, at "speed_rpm", key "drive.speed_rpm",
            ["found 1e18", "an angular velocity must be zero or of a magnitude from 1e-100 to 1e9 rad_s",
                "check the unit"]),
        bad!("speed_rpm = 130" => "speed_rpm = 1e30", INPUT, at "speed_rpm", key "drive.speed_rpm", ["to 1e9 rad_s"]),
        bad!("y_m_s2 = -9.81" => "y_m_s2 = -1e30", INPUT, at "y_m_s2 = -1e30", key "gravity.y_m_s2", ["to 1e12 m_s2"]),
        bad!("mass_kg = 2.6" => "mass_g = 1e34", INPUT, at "mass_g = 1e34", key "links.crank.mass_g", ["to 1e30 kg"]),
    ]);
    // Two values may each be allowed, but their combination may be too large.
    let fast = GOOD.replacen("speed_rpm = 130", "speed_rpm = 9e9", 1).replace("_mm = ", "_m = ");
    let error = parse(&fast, TABLE).unwrap_err();
    assert!(error.message().contains("faster than light"), "{error}");
    assert_eq!((error.scenario_key(), error.place().is_some()), (Some("drive"), true));
}

/// Symptom: a file of 5 MB with 100 000 points took 28 s to inspect, and minutes to draw.
#[test]
fn regress_more_parts_than_can_be_drawn_are_refused() {
    let points = |count: usize| -> String {
        (0..count).map(|k| format!("[links.rocker.points.P{k}]\nx_mm = {k}\ny_mm = 1\n")).collect()
    };
    let body = GOOD.split("[[oracle]]").next().unwrap();
    assert!(parse(&format!("{body}\n{}", points(1000)), TABLE).is_ok());
    let text = format!("{body}\n{}", points(30_000));
    let error = parse(&text, TABLE).unwrap_err();
    assert!(error.message().contains("more than 30000 parts"), "{error}");
    assert!(error.place().is_some() && error.way_out().is_some());
    assert!(error.scenario_key().is_some_and(|key| key.starts_with("links.rocker.points.P29")), "{error}");
}

/// Symptom: an array of 31 million numbers took 5.95 GB before the required memory was estimated.
/// Cause: the memory was estimated only after the file had been parsed.
#[test]
fn regress_more_values_than_memory_can_hold_are_counted_before_they_are_read() {
    let text = format!("{GOOD}\n[x]\na = [{}1]\n", "1,".repeat(2_000_000));
    let error = parse(&text, TABLE).unwrap_err();
    assert!(error.message().contains("more than 2000000 values"), "{error}");
    assert_eq!(error.place().unwrap().line(), line_of(&text, "a = [1,"));
    assert!(error.way_out().is_some());
}

/// Symptom: 20 000 parameters took 19 s.
/// Cause: the dependency graph stored all names of the file for every single expression.
/// Every search for a key or a name also began at the start of the file.
#[test]
fn regress_twenty_thousand_parameters_and_points_are_read() {
    let parameters: String = (0..20_000)
        .map(|index| match index {
            0 => "p0_mm = 1\n".to_string(),
            _ => format!("p{index}_mm = \"p{} + 1\"\n", index - 1),
        })
        .collect();
    let points: String = (0..20_000).map(|index| format!("Q{index} = {{ x_mm = \"p{index}\", y_mm = 0 }}\n")).collect();
    let text = GOOD.replacen("[ground.points]\n", &format!("[parameters]\n{parameters}\n[ground.points]\n{points}"), 1);
    let scenario = parse(&text, TABLE).unwrap();
    let ground = &scenario.case.mechanism.links()[LinkId(0)];
    let last = ground.points.iter().find(|point| point.name == "Q19999").unwrap();
    assert!((last.local.x - 20.0).abs() < 1e-12, "{last:?}");
    // In a file with this many names, a wrong name is compared with only a limited number of the names.
    let wrong = text.replacen("\"p19998 + 1\"", "\"pp\"", 1);
    let error = parse(&wrong, TABLE).unwrap_err();
    assert!(error.to_string().contains("it is not among the more than 1000 names"), "{error}");
}

#[test]
fn keys_and_sections() {
    assert_all_refused(&[
        bad!("format = 1\n" => "", INPUT, at "name = ", key "format", ["`format` is missing"]),
        bad!("format = 1" => "format = 2", ErrorKind::Unsupported, at "format = 2", key "format",
            ["format 2", "this version reads `format = 1`"]),
        bad!("format = 1" => "format = \"1\"", INPUT, at "format", key "format", ["found \"1\"", "whole number"]),
        bad!("name = \"good\"" => "name = \"Good one\"", INPUT, at "Good one", key "name",
            ["\"Good one\"", "lower-case letters"]),
        bad!("title = \"A four-bar\"" => "titel = \"A four-bar\"", INPUT, at "titel", key "title",
            ["`title` is missing", "did you mean `title`"]),
        bad!("[gravity]" => "[gravty]", INPUT, at "[gravty]", key "gravty", ["not known", "did you mean `gravity`?"]),
        bad!("mass_kg = 2.6" => "mass_kg = 2.6\ncolour = \"red\"", INPUT, at "colour", key "links.crank.colour",
            ["not known", "known here: `points`, `mass_kg`, `mass_g`"]),
        bad!("mass_kg = 2.6" => "mas_kg = 2.6", INPUT, at "mas_kg", key "links.crank.mas_kg", ["did you mean `mass_kg`?"]),
        bad!("name = \"A\"\n" => "name = \"A\"\npiont = \"A\"\n", INPUT, at "piont", key "joints.A.piont",
            ["did you mean `point`?"]),
        bad!("[drive]" => "[drives]", INPUT, at "[drives]", key "drive", ["`drive` is missing", "there is `drives`"]),
        bad!("[gravity]" => "[[gravity]]", INPUT, at "[[gravity]]", key "gravity", ["an array", "a table is needed", "[gravity]"]),
        bad!("[drive]" => "[[drive]]\njoint = \"O\"\nspeed_rpm = 10\n[[drive]]", INPUT, at "[[drive]]\njoint = \"O\"\nspeed_rpm = 130",
            key "drive[2]", ["`start_rad` or `start_deg`"]),
        bad!("[drive]" => "[[drive]]\njoint = \"O\"\nspeed_rpm = 10\n[[drive]]\nstart_deg = 0", INPUT,
            at "joint = \"O\"\nspeed_rpm = 130", key "drive[2].joint", ["already driven"]),
        bad!("[drive]" => "[[drive]]\njoint = \"C\"\nspeed_rpm = 10\n[[drive]]\nstart_deg = 0", INPUT,
            at "[[joints]]", key "joints", ["number of drives is 2"]),
        bad!("[[loads]]" => "[loads]", INPUT, at "[loads]", key "loads", ["a table", "write [[loads]]"]),
        bad!("links = [\"crank\", \"coupler\"]" => "links = \"crank\"", INPUT, at "links = \"crank\"",
            key "joints.A.links", ["found \"crank\"", "an array"]),
        bad!("links = [\"crank\", \"coupler\"]" => "links = [\"crank\", 2]", INPUT, at "links = [\"crank\", 2]",
            key "joints.A.links", ["found 2", "quotes"]),
    ]);
}

#[test]
fn numbers_and_units() {
    assert_all_refused(&[
        bad!("mass_kg = 2.6" => "mass = 2.6", INPUT, at "mass = 2.6", key "links.crank.mass",
            ["has no unit", "`mass_kg` or `mass_g`"]),
        bad!("length_mm = 26" => "length = 26", INPUT, at "length = 26", key "links.crank.points.A.length",
            ["has no unit", "`length_m` or `length_mm`"]),
        bad!("length_mm = 26" => "length_ft = 2.6", INPUT, at "length_ft", key "links.crank.points.A.length_ft",
            ["`length_ft` is in feet, which are not supported", "`length_m` or `length_mm`", "1 ft = 304.8 mm"]),
        bad!("length_mm = 26" => "length_mm = 26, length_m = 0.026", INPUT, at "length_mm = 26",
            key "links.crank.points.A.length_m", ["both given", "keep one"]),
        bad!("speed_rpm = 130" => "speed_rps = 2", INPUT, at "speed_rps", key "drive.speed_rps",
            ["in turns per second, which are not supported", "`speed_rad_s` or `speed_rpm`", "1 turn/s = 60 rpm"]),
        bad!("mass_kg = 2.6" => "mass_kg = nan", INPUT, at "mass_kg = nan", key "links.crank.mass_kg",
            ["found nan", "finite number"]),
        bad!("x_mm = 347" => "x_mm = -inf", INPUT, at "x_mm = -inf", key "links.coupler.points.B.x_mm",
            ["found -inf", "finite number"]),
        bad!("speed_rpm = 130" => "speed_rpm = 1e308", INPUT, at "1e308", key "drive.speed_rpm", ["1e-100 to 1e9"]),
        bad!("mass_kg = 2.6" => "mass_kg = -2.6", INPUT, at "mass_kg = -2.6", key "links.crank.mass_kg",
            ["found -2.6", "a mass must not be negative"]),
        bad!("mass_kg = 2.6" => "mass_kg = \"2,6\"", INPUT, at "\"2,6\"", key "links.crank.mass_kg",
            ["a comma is allowed only between the arguments", "decimal point"]),
        bad!("mass_kg = 2.6\n" => "", INPUT, at "inertia_kg_m2", key "links.crank.inertia_kg_m2", ["no mass", "mass_kg"]),
        bad!("mass_centre = { x_mm = 13, y_mm = 0 }\n" => "", INPUT, at "mass_kg", key "links.crank.mass_kg",
            ["no mass centre", "mass_centre ="]),
        bad!("mass_kg = 2.6\ninertia_kg_m2 = 0.0002" => "", INPUT, at "mass_centre", key "links.crank.mass_centre",
            ["mass centre but no mass"]),
        bad!("moment_N_m = 100" => "moment_N_m = -100", INPUT, at "-100", key "loads[1].moment_N_m",
            ["a moment must not be negative"]),
        bad!("engine_rel = 1e-2" => "engine_rel = 1.5", INPUT, at "engine_rel", key "tolerances.engine_rel",
            ["found 1.5", "between 0 and 1"]),
    ]);
}

#[test]
fn toml_itself() {
    for (text, line, word) in [
        (GOOD.replace("title = \"A four-bar\"", "title = \"A four-bar"), 3, "not valid TOML"),
        (GOOD.replace("[drive]", "[drive"), line_of(GOOD, "[drive]"), "not valid TOML"),
        (GOOD.replace("mass_kg = 2.6", "mass_kg = 2,6"), line_of(GOOD, "mass_kg"), "not valid TOML"),
        (GOOD.replace("name = \"good\"", "name = \"good\"\nname = \"twice\""), 3, "duplicate key"),
        (String::new(), 1, "contains no scenario"),
    ] {
        let error = parse(&text, TABLE).unwrap_err();
        assert_eq!((error.kind(), error.place().unwrap().line()), (INPUT, line), "{error}");
        assert!(error.message().contains(word) && error.way_out().is_some(), "{error}");
    }
}

#[test]
fn links_and_joints() {
    assert_all_refused(&[
        bad!("B = { x_mm = 250, y_mm = 0 }" => "E = { x_mm = 250, y_mm = 0 }", INPUT, at "name = \"B\"",
            key "joints.B.name", ["link \"rocker\" has no point \"B\"", "\"C\" or \"E\""]),
        bad!("name = \"B\"\n" => "name = \"B\"\npoint = \"F\"\n", INPUT, at "point = \"F\"", key "joints.B.point",
            ["link \"coupler\" has no point \"F\""]),
        bad!("A = { from = \"O\"" => "A = { from = \"Q\"", INPUT, at "from = \"Q\"", key "links.crank.points.A.from",
            ["no point \"Q\" is defined before", "\"O\""]),
        bad!("O = { x_mm = 0, y_mm = 0 }\nA =" => "O = { from = \"A\", length_mm = 26, angle_deg = 0 }\nA =", INPUT,
            at "from = \"A\"", key "links.crank.points.O.from", ["no point \"A\" is defined before"]),
        bad!("B = { x_mm = 347, y_mm = 0 }" => "B = { x_mm = 347 }", INPUT, at "x_mm = 347",
            key "links.coupler.points.B", ["`y_m` or `y_mm` is missing"]),
        bad!("[links.rocker.points]" => "[links.ground.points]\nE = { x_mm = 1, y_mm = 0 }\n[links.rocker.points]", INPUT,
            at "[links.ground.points]", key "links.ground", ["\"ground\""]),
        bad!("[[joints]]\nname = \"A\"" => "[links.loose.points]\nE = { x_mm = 1, y_mm = 0 }\n[[joints]]\nname = \"A\"",
            INPUT, at "[links.loose.points]", key "links.loose", ["not connected to the ground"]),
        bad!("links = [\"crank\", \"coupler\"]" => "links = [\"crank\", \"coupler\", \"rocker\"]", INPUT,
            at "\"coupler\", \"rocker\"]", key "joints.A.links", ["found 3 links", "two"]),
        bad!("links = [\"crank\", \"coupler\"]" => "links = [\"crank\", \"cuopler\"]", INPUT, at "cuopler",
            key "joints.A.links", ["no link \"cuopler\"", "did you mean \"coupler\""]),
        bad!("[links.rocker.points]" => "[links.rocker.points]\nA = { x_mm = 1, y_mm = 0 }", INPUT,
            at "A = { x_mm = 1,", key "links.rocker.points.A", ["no joint connects them", "rename"]),
        bad!("[links.coupler.points]" => "[links.coupler.points]\n\"A B\" = { x_mm = 1, y_mm = 0 }", INPUT,
            at "\"A B\"", key "links.coupler.points.A B", ["cannot be the name of a point", "letters"]),
        bad!("links = [\"crank\", \"coupler\"]" => "links = [\"crank\", \"crank\"]", INPUT, at "\"crank\", \"crank\"",
            key "joints.A.links", ["with itself"]),
        bad!("name = \"B\"" => "name = \"A\"", INPUT, at "name = \"A\"\ntype = \"revolute\"\nlinks = [\"coupler\"",
            key "joints.A.name", ["two joints are called \"A\"", "point ="]),
        bad!("name = \"B\"" => "name = \"B.1\"", INPUT, at "B.1", key "joints.B.1.name", ["letters, digits"]),
        bad!("type = \"revolute\"" => "type = \"prismatic\"", INPUT, at "[[joints]]", key "joints.O", ["`axis_rad` or `axis_deg`"]),
        bad!("type = \"revolute\"" => "type = \"prismatic\"\naxis_deg = 0", INPUT, at "[[joints]]", key "joints.O",
            ["`points`"]),
        bad!("type = \"revolute\"" => "type = \"prismatic\"\naxis_deg = 0\npoints = [\"O\"]", INPUT, at "[\"O\"]", key "joints.O.points",
            ["found 1 points", "slides along this line"]),
        bad!("type = \"revolute\"" => "type = \"prismatic\"\naxis_deg = 0\npoints = [\"O\", \"Z\"]", INPUT, at "[\"O\", \"Z\"]",
            key "joints.O.points", ["no point \"Z\""]),
        bad!("type = \"revolute\"" => "type = \"prismatic\"\naxis_deg = 0\npoints = [\"O\", \"O\"]", INPUT,
            at "O = { x_mm = 0, y_mm = 0 }\nA", key "links.crank.points.O", ["no joint connects them"]),
        bad!("type = \"revolute\"" => "type = \"hinge\"", INPUT, at "hinge", key "joints.O.type",
            ["not a type of joint", "\"revolute\""]),
        bad!("[drive]" => "[[joints]]\nname = \"B2\"\npoint = \"B\"\ntype = \"revolute\"\nlinks = [\"coupler\", \"rocker\"]\n[drive]",
            INPUT, at "links = [\"coupler\", \"rocker\"]\n[drive]", key "joints.B2.links",
            ["\"B\" already joins \"coupler\" and \"rocker\"", "lock"]),
    ]);
}

#[test]
fn structure_and_drive() {
    assert_all_refused(&[
        // A fourth bar joins crank and rocker, so the mobility falls from 1 to 0.
        Bad {
            edits: &[
                (
                    "\n[links.rocker.points]",
                    "[links.brace.points]\nA = { x_mm = 0, y_mm = 0 }\nB = { x_mm = 347, y_mm = 0 }\n\n[links.rocker.points]",
                ),
                (
                    "[drive]",
                    "[[joints]]\nname = \"A2\"\npoint = \"A\"\ntype = \"revolute\"\nlinks = [\"crank\", \"brace\"]\n[[joints]]\nname = \"B2\"\npoint = \"B\"\ntype = \"revolute\"\nlinks = [\"rocker\", \"brace\"]\n[drive]",
                ),
            ],
            kind: INPUT,
            at: "[[joints]]",
            key: "joints",
            words: &["W = 3*4 - 2*6 = 0", "over-constrained"],
        },
        // A pendulum on the rocker: mobility 2.
        Bad {
            edits: &[
                ("\n[links.rocker.points]", "[links.bob.points]\nB = { x_mm = 0, y_mm = 0 }\n\n[links.rocker.points]"),
                (
                    "[drive]",
                    "[[joints]]\nname = \"B2\"\npoint = \"B\"\ntype = \"revolute\"\nlinks = [\"rocker\", \"bob\"]\n[drive]",
                ),
            ],
            kind: INPUT,
            at: "[[joints]]",
            key: "joints",
            words: &["W = 3*4 - 2*5 = 2", "missing joints"],
        },
        bad!("joint = \"O\"" => "joint = \"B\"\nstart_deg = 40", INPUT, at "crank_deg", key "start.crank_deg",
            ["its input is a joint angle", "`start_mm = 300` or `start_deg = 30`"]),
        bad!("joint = \"O\"" => "joint = \"P\"", INPUT, at "joint = \"P\"", key "drive.joint", ["no joint \"P\""]),
        bad!("speed_rpm = 130" => "speed_rpm = 0", INPUT, at "speed_rpm = 0", key "drive.speed_rpm",
            ["found 0", "an angular velocity must not be zero"]),
        bad!("speed_rpm = 130\n" => "", INPUT, at "[drive]", key "drive", ["`speed_rad_s` or `speed_rpm` is missing"]),
        bad!("link = \"rocker\"" => "link = \"ground\"", INPUT, at "link = \"ground\"", key "loads[1].link",
            ["does not turn"]),
        bad!("type = \"resistance\"" => "type = \"sprong\"", INPUT, at "sprong", key "loads[1].type",
            ["not a type of load", "did you mean \"spring\""]),
    ]);
}

#[test]
fn first_pose() {
    const GROUP: &str = "start.groups (coupler, rocker)";
    assert_all_refused(&[
        bad!("x_mm = 347" => "x_mm = 47", ErrorKind::Geometry, at "[[start.groups]]", key GROUP,
            ["cannot be assembled", "check the lengths"]),
        bad!("mode = \"left\"" => "near = { point = \"B\", x_mm = 90, y_mm = 10 }", ErrorKind::Geometry,
            at "[[start.groups]]", key GROUP, ["it decides for neither"]),
        bad!("mode = \"left\"" => "mode = \"right\"\nnear = { point = \"B\", x_mm = 200, y_mm = 260 }", ErrorKind::Geometry,
            at "[[start.groups]]", key GROUP, ["nearer to another configuration"]),
        bad!("mode = \"left\"\n" => "", INPUT, at "[[start.groups]]", key GROUP, ["neither an assembly mode"]),
        bad!("mode = \"left\"" => "mode = \"up\"", INPUT, at "mode = \"up\"", key "start.groups[1].mode",
            ["\"up\"", "\"left\", \"right\", \"ahead\" or \"behind\""]),
        bad!("mode = \"left\"" => "near = { point = \"O\", x_mm = 0, y_mm = 0 }", INPUT, at "near", key "start.groups[1].near.point",
            ["no link of the group has a point \"O\""]),
        bad!("[[start.groups]]\nlinks = [\"coupler\", \"rocker\"]\nmode = \"left\"\n" => "", INPUT, at "[start]", key "start",
            ["(coupler, rocker)", "[[start.groups]]\nlinks = [\"coupler\", \"rocker\"]\nmode = \"left\""]),
        bad!("links = [\"coupler\", \"rocker\"]\nmode" => "links = [\"crank\", \"rocker\"]\nmode", INPUT,
            at "links = [\"crank\", \"rocker\"]", key "start.groups[1].links",
            ["no Assur group (crank, rocker)", "links = [\"coupler\", \"rocker\"]"]),
        bad!("mode = \"left\"" => "mode = \"left\"\n[[start.groups]]\nlinks = [\"rocker\", \"coupler\"]", INPUT,
            at "links = [\"rocker\", \"coupler\"]", key "start.groups[2].links", ["given twice"]),
    ]);
}

#[test]
fn grid_channels_and_engine() {
    assert_all_refused(&[
        bad!("step_deg = 10" => "step_deg = 0", INPUT, at "step_deg = 0", key "grid.step_deg", ["must not be zero"]),
        bad!("step_deg = 10" => "step_deg = -10", INPUT, at "step_deg = -10", key "grid.step_deg",
            ["leads away from the end"]),
        bad!("step_deg = 10" => "step_deg = 1e-4", INPUT, at "step_deg = 1e-4", key "grid.step_deg",
            ["more than 1000000 points"]),
        bad!("to_deg = 360" => "to_s = 1", INPUT, at "to_s = 1", key "grid.to_s", ["`to_rad` or `to_deg`"]),
        bad!("from_deg = 0\n" => "", INPUT, at "[grid]", key "grid", ["is missing", "by crank angle"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "times_s = []", INPUT, at "times_s", key "grid.times_s",
            ["the list is empty", "times_s = [0, 0.1, 0.3]"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "angles_deg = [\n0,\n true]", INPUT, at " true]",
            key "grid.angles_deg", ["found true, but a number is needed"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "angles_deg = [0, nan]", INPUT, at "angles_deg",
            key "grid.angles_deg", ["a finite number"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "angles_deg = [0, 30, 0]", INPUT, at "angles_deg",
            key "grid.angles_deg", ["values 1 and 3 of the list are the same"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "times_s = 0.1", INPUT, at "times_s", key "grid.times_s",
            ["an array of numbers"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "times = [0, 1]", INPUT, at "times", key "grid.times",
            ["`times` has no unit", "`times_s` or `times_ms`"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "times_s = [0]\ntimes_ms = [1]", INPUT, at "times_ms",
            key "grid.times_ms", ["both given"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "times_s = [0]\nangles_rad = [1]", INPUT, at "times_s",
            key "grid.times_s", ["given twice", "keep one of"]),
        bad!("from_deg = 0" => "from_deg = 0\nangles_deg = [1]", INPUT, at "angles_deg", key "grid.angles_deg",
            ["given twice", "keep one of"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "times_s = [0]\nstep_s = 1", INPUT, at "step_s",
            key "grid.step_s", ["not known here"]),
        bad!("from_deg = 0\nto_deg = 360\nstep_deg = 10" => "times_s = [0, 1e12]", INPUT, at "[grid]", key "grid",
            ["turns from zero; the limit is"]),
        bad!("from_deg = 0" => "from_deg = 0\nfrom_s = 0", INPUT, at "from_s = 0", key "grid.from_s", ["both given"]),
        bad!("\"velocities\"" => "\"velocity\"", INPUT, at "want", key "channels.want",
            ["no channel \"velocity\"", "did you mean \"velocities\""]),
        bad!("\"positions\", \"velocities\"" => "", INPUT, at "want", key "channels.want", ["no channel is requested"]),
        bad!("dt_s = 1e-3" => "dt_s = 0", INPUT, at "dt_s = 0", key "engine.dt_s", ["a time must be positive"]),
        bad!("dt_s = 1e-3" => "dt_s = 1e-3\nstep_deg = 1", INPUT, at "step_deg = 1\n\n[tol", key "engine.step_deg",
            ["given twice"]),
        bad!("dt_s = 1e-3" => "extrapolated = 9", INPUT, at "extrapolated = 9", key "engine.extrapolated",
            ["9 extrapolations", "from 0 to 8", "true for 1"]),
        bad!("dt_s = 1e-3" => "extrapolated = \"no\"", INPUT, at "extrapolated", key "engine.extrapolated",
            ["a whole number"]),
    ]);
}

#[test]
fn motors() {
    let motor = |text: &'static str| [("[start]", text)];
    let law = motor("[motor]\nlaw = \"kubic\"\ntorque_at_rest_N_m = 1\nslope_N_m_s = -1\nratio = 1\n[start]");
    let slope = motor("[motor]\nlaw = \"linear\"\ntorque_at_rest_N_m = 1\nslope_N_m_s = 1\nratio = 1\n[start]");
    let ratio = motor("[motor]\nlaw = \"linear\"\ntorque_at_rest_N_m = 1\nslope_N_m_s = -1\nratio = 0\n[start]");
    for (edits, at, key, words) in [
        (law, "law =", "motor.law", ["not a law of a motor", "\"linear\""]),
        (slope, "slope_N", "motor.slope_N_m_s", ["must be negative", "less than zero"]),
        (ratio, "ratio =", "motor.ratio", ["found 0", "without a reducer"]),
    ] {
        assert_refused(GOOD, &Bad { edits: &edits, kind: INPUT, at, key, words: &words });
    }
}

#[test]
fn oracles() {
    assert_all_refused(&[
        bad!("source = \"a table\"\n" => "", INPUT, at "[[oracle]]", key "oracle[1]", ["`source` is missing"]),
        bad!("file = \"table.csv\"" => "file = \"tables.csv\"", ErrorKind::Io, at "tables.csv", key "oracle[1].file",
            ["cannot be read", "relative to the scenario's directory"]),
        bad!("crank = \"crank_deg\"" => "crank = \"crank\"", INPUT, at "crank = \"crank\"", key "oracle[1].crank",
            ["does not state its unit"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.E.x_mm\"", INPUT, at "point.E", key
            "oracle[1].columns.Bx_mm.channel", ["no channel \"point.E.x_mm\"", "\"A\" or \"B\""]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.C.x_cm\"", INPUT, at "point.C", key
            "oracle[1].columns.Bx_mm.channel", ["no channel \"point.C.x_cm\"", "did you mean `x_m`"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"link.crank.alpha_rad_s2\"", INPUT, at "alpha_rad_s2", key
            "oracle[1].columns.Bx_mm.channel", ["accelerations", "channels.want"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.B.x_mm\", offset_deg = 3", INPUT, at "offset_deg", key
            "oracle[1].columns.Bx_mm.offset_deg", ["`offset_m` or `offset_mm`"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.B.x_mm\", expect = [{ crank_deg = 45, finding = \"misprint\", right = { value = 1, digits = 1 } }]",
            INPUT, at "expect", key "oracle[1].columns.Bx_mm.expect[1].crank_deg", ["no row with this crank angle"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.B.x_mm\", expect = [{ crank_deg = 90 }]",
            INPUT, at "expect", key "oracle[1].columns.Bx_mm.expect[1]", ["`finding` is missing"]),
        bad!(", digits = 1 }" => " }", INPUT, at "values =", key "oracle[2].values[1]", ["`digits` is missing"]),
        bad!("digits = 1 }" => "digits = 1.5 }", INPUT, at "values =", key "oracle[2].values[1].digits",
            ["found 1.5", "a whole number"]),
        bad!("digits = 1 }" => "digits = 99 }", INPUT, at "values =", key "oracle[2].values[1].digits",
            ["found 99", "from -20 to 20"]),
        bad!("reduced_inertia_mean_kg_m2" => "reduced_inertia_kg_m2", INPUT, at "figures =", key
            "oracle[3].figures[1].figure", ["no figure", "reduced_inertia_mean_kg_m2"]),
        bad!("\"reduced_inertia_mean_kg_m2\"" => "\"steady_motor_speed_rad_s\"", INPUT, at "figures =", key
            "oracle[3].figures[1].figure", ["needs a motor", "[motor]"]),
        bad!("\"reduced_inertia_mean_kg_m2\"" => "\"distance_mm\", points = [\"A\"]", INPUT, at "figures =", key
            "oracle[3].figures[1].points", ["needs two points, found 1"]),
        bad!("\"reduced_inertia_mean_kg_m2\"" => "\"distance_mm\", points = [\"A\", \"X\"]", INPUT, at "figures =", key
            "oracle[3].figures[1].points", ["no point \"X\""]),
        // `figures` must not name the mass or the length of a link: the file itself gives these values, so the
        // comparison would prove nothing.
        bad!("\"reduced_inertia_mean_kg_m2\"" => "\"mass_kg\", link = \"crank\"", INPUT, at "figures =", key
            "oracle[3].figures[1].figure", ["no figure \"mass_kg\""]),
        bad!("\"reduced_inertia_mean_kg_m2\"" => "\"distance_mm\", points = [\"C\", \"C\"]", INPUT, at "figures =", key
            "oracle[3].figures[1].points", ["is given in the file"]),
        bad!("digits = 1 }" => "digits = 1, finding = \"misprint\" }", INPUT, at "values =", key "oracle[2].values[1]",
            ["`right` is missing", "right = {"]),
        bad!("digits = 1 }" => "digits = 1, right = { value = 71, digits = 1 } }", INPUT, at "values =", key
            "oracle[2].values[1]", ["`finding` is missing"]),
        bad!("digits = 1 }" => "digits = 1, finding = \"misprint\", right = { value = 70.05, digits = 2 } }", INPUT, at
            "values =", key "oracle[2].values[1].right",
            ["70.05 with 2 decimals cannot be distinguished from the printed 70"]),
        bad!("digits = 1 }" => "digits = 1, finding = \"misprint\", right = { value = 71 } }", INPUT, at "values =", key
            "oracle[2].values[1].right", ["`digits` is missing"]),
        bad!("digits = 2 }" => "digits = 2, finding = \"misprint\" }", INPUT, at "figures =", key "oracle[3].figures[1]",
            ["`right` is missing"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.B.x_mm\", finding = \"misprint\"", INPUT, at "Bx_mm", key
            "oracle[1].columns.Bx_mm", ["`right` is missing"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.B.x_mm\", finding = \"x\", right = { values = [1], digits = 1 }",
            INPUT, at "Bx_mm", key "oracle[1].columns.Bx_mm.right.values", ["found 1 right values", "2 rows"]),
        bad!("channel = \"point.B.x_mm\"" => "channel = \"point.B.x_mm\", expect = [{ crank_deg = 90, finding = \"x\" }]",
            INPUT, at "expect", key "oracle[1].columns.Bx_mm.expect[1]", ["`right` is missing"]),
        bad!("source = \"a number\"" => "source = \"a number\"\nbasis = \"guessed\"", INPUT, at "basis", key "oracle[2].basis",
            ["\"guessed\" is not a basis of published numbers", "\"published\""]),
        bad!("figures = [" => "file = \"table.csv\"\nfigures = [", INPUT, at "[[oracle]]\nsource = \"a figure\"",
            key "oracle[3]", ["exactly one of"]),
    ]);
}

#[test]
fn tables_name_their_own_file_and_line() {
    for (table, line, key, words) in [
        ("crank_deg,Cx_mm\n0,1\n", 1, "oracle[1].columns.Bx_mm", ["no column \"Bx_mm\"", "did you mean \"Cx_mm\""]),
        ("angle_deg,Bx_mm\n0,1\n", 1, "oracle[1].crank", ["no column \"crank_deg\"", "\"angle_deg\""]),
        ("crank_deg,Bx_mm\n0,301.12\n90,many\n", 3, "oracle[1].columns.Bx_mm", ["found \"many\"", "decimal number"]),
        ("crank_deg,Bx_mm\n0,301.12\n\n90,\n", 4, "oracle[1].columns.Bx_mm", ["found \"\"", "`expect`"]),
        ("crank_deg,Bx_mm\n0,301.12\nx,1\n", 3, "oracle[1].crank", ["found \"x\"", "decimal number"]),
        ("crank_deg,Bx_mm\n0,301,12\n", 2, "oracle[1].file", ["3 cells", "as many cells"]),
        ("crank_deg,Bx_mm\n", 1, "oracle[1].file", ["no rows", "at least one row"]),
    ] {
        let error = parse(GOOD, table).unwrap_err();
        let place = error.place().unwrap();
        assert_eq!(place.file.file_name(), Some(Path::new("table.csv").as_os_str()), "{error}");
        assert_eq!((error.kind(), place.line(), error.scenario_key()), (INPUT, line, Some(key)), "{error}");
        let says = format!("{}; {}", error.message(), error.way_out().unwrap_or_default());
        assert!(words.iter().all(|word| says.contains(word)), "{says}");
    }
}

#[test]
fn a_missing_scenario_is_reported() {
    let error = Scenario::load(Path::new("no/such/scenario.toml")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    assert!(error.message().contains("no/such/scenario.toml") && error.way_out().is_some(), "{error}");
}
