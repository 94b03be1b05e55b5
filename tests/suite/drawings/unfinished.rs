//! Unfinished files: the readable part is drawn, and every mistake is reported.

use std::fs;
use std::path::Path;

use assert_cmd::Command;

use super::{draw, texts};

/// A four-bar template with the given replacements.
fn edited(directory: &Path, edits: &[(&str, &str)]) -> String {
    let path = directory.join("own.toml");
    let path = path.to_str().unwrap();
    Command::cargo_bin("linkproof").unwrap().args(["new", "four-bar", "--force", "-o", path]).assert().success();
    let mut text = fs::read_to_string(path).unwrap();
    for (from, to) in edits {
        assert!(text.contains(from), "the edit `{from}` does not apply");
        text = text.replacen(from, to, 1);
    }
    fs::write(path, text).unwrap();
    path.into()
}

/// The picture of an edited file, and the text on standard error.
fn drawn(edits: &[(&str, &str)], arguments: &[&str]) -> (String, String) {
    let directory = tempfile::tempdir().unwrap();
    let file = edited(directory.path(), edits);
    let (code, out, told) = draw(&[&[file.as_str(), "-o", "-"], arguments].concat());
    assert!(code == 0 && told.starts_with("warning: "), "{edits:?}: {code} {told}");
    let text = String::from_utf8(out).unwrap();
    assert!(!text.contains("NaN") && roxmltree::Document::parse(&text).is_ok(), "{edits:?}: {text}");
    (text, told)
}

/// Names of points and numbers of links in the picture.
fn names(text: &str) -> Vec<String> {
    let mut names = texts(&roxmltree::Document::parse(text).unwrap());
    names.retain(|name| name.chars().count() == 1);
    names.sort_unstable();
    // Numbers of links are also in the legend.
    names.dedup();
    names
}

const DASHED: &str = "stroke-dasharray=\"2 1.4\"";
const DRIVE: &str = "[drive]\njoint = \"O\"\nspeed_rpm = \"speed_rpm\"\n";
const ALL: [&str; 8] = ["1", "2", "3", "A", "B", "C", "E", "O"];

/// For each mistake: the words on standard error, the labels that are still drawn, and whether the positions of all
/// links are certain.
#[test]
fn readable_parts_are_drawn_and_every_mistake_reported() {
    let without = |names: &[&str]| -> Vec<&str> { ALL.into_iter().filter(|own| !names.contains(own)).collect() };
    for (edit, told, expected, is_whole) in [
        // Three mistakes: a joint that names an unknown link, a missing length, and a load on an unknown link.
        (("[\"coupler\", \"rocker\"]", "[\"coupler\", \"rockre\"]"), "joints.B.links", without(&[]), false),
        (("length_mm = \"point\", ", ""), "links.coupler.points.E", without(&["E"]), true),
        (
            ("[gravity]", "[[loads]]\ntype = \"moment\"\nlink = \"ram\"\nmoment_N_m = 1\n[gravity]"),
            "loads[1].link",
            without(&[]),
            true,
        ),
        // A missing drive, so that the program guesses the crank; and a link without points.
        ((DRIVE, ""), "`drive` is missing", without(&[]), true),
        (
            ("C = { x_mm = 0, y_mm = 0 }\nB = { x_mm = \"rocker\", y_mm = 0 }", ""),
            "links.rocker.points",
            without(&["3"]),
            false,
        ),
        // Too many degrees of freedom.
        (
            ("[[joints]]\nname = \"A\"\ntype = \"revolute\"\nlinks = [\"crank\", \"coupler\"]", ""),
            "no joint connects them",
            without(&[]),
            false,
        ),
        // A misspelt section, an unknown mode, a parameter that cannot be evaluated, and a negative mass.
        (("[start]", "[strat]"), "strat", without(&[]), true),
        (("mode = \"left\"", "mode = \"up\""), "start.groups[1].mode", without(&[]), false),
        (("point_mm = 70", "point_mm = \"70 +\""), "parameters.point_mm", without(&["E"]), true),
        (("mass_kg = \"density*crank\"", "mass_kg = -1"), "links.crank.mass_kg", without(&[]), true),
    ] {
        let (text, error) = drawn(&[edit], &[]);
        assert!(error.contains(told) && error.contains("own.toml:"), "{edit:?}: {error}");
        assert_eq!(names(&text), expected, "{edit:?}");
        assert_eq!(!text.contains(DASHED), is_whole, "{edit:?}");
        assert!(
            texts(&roxmltree::Document::parse(&text).unwrap()).iter().any(|own| own.starts_with("line ")),
            "{text}"
        );
    }
}

#[test]
fn mistakes_are_reported_once_and_the_first_in_the_picture() {
    let edits = [
        ("title =", "titel ="),
        ("[\"coupler\", \"rocker\"]", "[\"coupler\", \"rockre\"]"),
        ("x_m_s2 = 0", "x_m_s2 = true"),
        ("mode = \"left\"", "mode = \"up\""),
        ("step_deg = 2", "step_deg = 0"),
    ];
    let (text, told) = drawn(&edits, &[]);
    assert_eq!(told.matches("warning: ").count(), edits.len(), "{told}");
    let texts = texts(&roxmltree::Document::parse(&text).unwrap());
    assert_eq!(texts.iter().filter(|own| own.starts_with("line ")).count(), 3, "{texts:?}");
    assert!(texts.iter().any(|own| own == "and 2 more"), "{texts:?}");
}

#[test]
fn a_guessed_drive_has_no_arrow_and_is_reported() {
    let (without, told) = drawn(&[(DRIVE, "")], &[]);
    assert!(told.contains("no drive could be read") && told.contains("\"crank\""), "{told}");
    let (with, _) = drawn(&[("step_deg = 2", "step_deg = 0")], &[]);
    assert!(with.matches("<path").count() > without.matches("<path").count(), "the arrow of the drive");
}

#[test]
fn a_path_of_an_unknown_point_is_left_out() {
    let (text, told) = drawn(&[], &["--trace", "Q", "--trace", "E"]);
    assert!(told.contains("called \"Q\"") && told.contains("name one of A, B, E"), "{told}");
    assert_eq!(names(&text), ALL);
    assert!(text.contains("stroke-dasharray=\"1 0.8\""), "the path of E");
    let (_, told) = drawn(&[("[\"coupler\", \"rocker\"]", "[\"coupler\", \"rockre\"]")], &["--trace", "Q"]);
    assert!(told.contains("joints.B.links") && told.contains("called \"Q\""), "{told}");
}

#[test]
fn a_faulty_file_gives_a_motionless_animation() {
    let directory = tempfile::tempdir().unwrap();
    let file = edited(directory.path(), &[("[\"coupler\", \"rocker\"]", "[\"coupler\", \"rockre\"]")]);
    let moving = directory.path().join("own.gif");
    let arguments = [file.as_str(), "-o", moving.to_str().unwrap(), "--frames", "4", "--width", "200"];
    let (code, _, told) = draw(&arguments);
    assert!(code == 0 && told.starts_with("warning: `joints.B.links`"), "{told}");
    let mut decoder = gif::DecodeOptions::new().read_info(fs::File::open(moving).unwrap()).unwrap();
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        frames.push(frame.buffer.to_vec());
    }
    assert!(frames.len() == 4 && frames.windows(2).all(|pair| pair[0] == pair[1]));
}

/// Invalid TOML and files of another format version are not drawn.
#[test]
fn a_file_that_cannot_be_read_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    for (edit, told) in
        [(("[\"coupler\", \"rocker\"]", "[\"coupler\""), "not valid TOML"), (("format = 1", "format = 9"), "format 9")]
    {
        let file = edited(directory.path(), &[edit]);
        let picture = directory.path().join("own.svg");
        let (code, _, error) = draw(&[&file, "-o", picture.to_str().unwrap()]);
        assert!(code == 2 && error.contains(told) && !picture.exists(), "{error}");
    }
}
