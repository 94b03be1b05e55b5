//! Hostile names and texts do not leave the output folder, forge no line and break no format.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use linkage::mechanism::is_unseen;
use scenario::Scenario;

use crate::cli::tools::{Place, Table};
use crate::common::entries::explains;

const GOOD: &str = include_str!("../bad_scenarios/good.toml");

/// Texts that must be refused as names.
fn hostile() -> Vec<String> {
    let short = [
        "",
        ".",
        "..",
        "../x",
        "/etc/passwd",
        "a/b",
        "a\\b",
        "C:x",
        "x\u{0}",
        "x\ny",
        "x\r",
        "\t",
        "\u{1b}[2J",
        "\u{7f}",
        "\u{9b}31m",
        "x\u{202e}y",
        "x\u{2066}y",
        "\u{200b}",
        "x\u{2028}y",
        "\u{feff}x",
        "\u{e0041}",
        "a b",
        "a.b",
        "a,b",
        "a;b",
        "a\"b",
        "a|b",
        "a*b",
        "a?b",
        "<a>",
        "a&b",
        "=1+1",
        "@a",
        "%n",
        "$x",
        "`x`",
        "~",
    ];
    short.into_iter().map(String::from).chain(["x".repeat(101), "x".repeat(1 << 20)]).collect()
}

/// A text as TOML writes it in quotes.
fn quoted(text: &str) -> String {
    let letters = text.chars().map(|letter| match letter {
        '"' | '\\' => format!("\\{letter}"),
        _ if is_unseen(letter) => format!("\\U{:08x}", letter as u32),
        _ => letter.to_string(),
    });
    format!("\"{}\"", letters.collect::<String>())
}

#[test]
fn no_hostile_text_becomes_a_name() {
    let reserved = ["con", "nul", "aux", "prn", "com1", "lpt9", "-x", "Good", "ё"].map(String::from);
    let places: [(&str, &str, &[String]); 4] = [
        ("name = \"good\"", "name = NAME", &reserved),
        ("[links.coupler.points]", "[links.NAME.points]", &[]),
        ("A = { x_mm = 0, y_mm = 0 }", "NAME = { x_mm = 0, y_mm = 0 }", &[]),
        ("[[joints]]\nname = \"A\"", "[[joints]]\nname = NAME", &[]),
    ];
    for (old, new, more) in places {
        for name in hostile().iter().chain(more) {
            let text = GOOD.replacen(old, &new.replace("NAME", &quoted(name)), 1);
            let error = Scenario::parse(&text, Path::new("scenario.toml")).expect_err("refused");
            explains(&error, &text);
        }
    }
}

/// Titles and sources may contain any visible character.
/// Invisible characters in titles and sources are refused.
#[test]
fn no_text_may_hold_invisible_characters() {
    for text in hostile().iter().filter(|text| text.contains(is_unseen) || text.len() > 10_000) {
        for (old, new) in [("title = \"A four-bar\"", "title = "), ("name = \"good\"", "name = \"good\"\nsource = ")] {
            let text = GOOD.replacen(old, &format!("{new}{}", quoted(text)), 1);
            let error = Scenario::parse(&text, Path::new("scenario.toml")).expect_err("refused");
            explains(&error, &text);
        }
    }
}

/// A refused text is shown shortened and without the dangerous characters of the text.
#[test]
fn messages_show_no_terminal_control_characters() {
    let place = Place::new();
    for name in hostile() {
        for (old, new) in [("name = \"good\"", "name = NAME"), ("[links.coupler.points]", "[links.NAME.points]")] {
            let text = GOOD.replacen(old, &new.replace("NAME", &quoted(&name)), 1);
            fs::write(place.path("bad.toml"), text).unwrap();
            let told = place.run("run bad.toml --no-record");
            let outcome = told.stderr.replace('\n', "");
            assert!(told.code == 2 && !outcome.contains(is_unseen), "{name:?}: {outcome:?}");
            assert!(told.stdout.is_empty() && told.stderr.len() < 1 << 14, "{} bytes", told.stderr.len());
        }
    }
    // A scenario names an endless file as its table.
    // The program refuses this file and does not read it.
    fs::write(place.path("bad.toml"), GOOD.replacen("table.csv", "/dev/zero", 1)).unwrap();
    #[cfg(unix)]
    place.refused("run bad.toml --no-record", &["not a regular file"]);
    #[cfg(unix)]
    place.refused("run /dev/zero --no-record", &["/dev/zero", "64 MiB"]);
    // A long formula is cut in the message.
    // The formula consists of characters of two bytes, or of invisible characters of three bytes.
    // With the different beginnings, the cut also falls between the bytes of a character.
    for letter in ["\u{e9}", "\u{202e}"] {
        for start in ["", "p", "ph"] {
            let text = format!("{start}{}", letter.repeat(12_000));
            let told = place.run(&format!("check scenarios/crank_rocker.toml {text} --channel link.rocker.angle_rad"));
            assert!(told.code == 2 && told.stderr.contains("more than 20000"), "{:.300}", told.stderr);
        }
    }
}

/// Allowed text that is as bad as possible: every output keeps its format and stays in its folder.
#[test]
fn allowed_text_breaks_no_output() {
    let place = Place::new();
    let title = "a \"b\" 'c' <d> &e; -- --> ]]> </svg> =1+1, %n $(x) {{y}} \\n ё 中 مرحبا |";
    let mut text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    text.truncate(text.find("[[oracle]]").unwrap());
    let old = text.lines().find(|line| line.starts_with("title")).unwrap().to_string();
    let text = text.replacen(&old, &format!("title = {}", quoted(title)), 1);
    let plain = text.replacen("name = \"crank_rocker\"", "name = \"plain\"", 1);
    // Links, joints and points with the worst allowed names.
    let odd = text.replacen("name = \"crank_rocker\"", "name = \"_\"", 1);
    let odd = odd.replace("links.crank", "links.\"-'ё中\"").replace("\"crank\"", "\"-'ё中\"");
    let odd = odd.replace("\nA = {", "\n\"--\" = {").replace("name = \"A\"", "name = \"--\"");
    let odd =
        odd.replace("\nD = {", "\n_ = {").replace("links.rocker", "links.\"مرحبا\"").replace("\"rocker\"", "\"مرحبا\"");
    fs::write(place.path("plain.toml"), plain).unwrap();
    fs::write(place.path("odd.toml"), odd).unwrap();
    fs::create_dir(place.path("out")).unwrap();
    let before = files(&place.path(""));
    let lines = |file: &str| {
        let told = place.ok(&format!("run {file}.toml --record out"));
        assert!(!told.replace('\n', "").contains(is_unseen));
        told.lines().count()
    };
    assert_eq!(lines("plain"), lines("odd"));
    for file in ["plain", "odd"] {
        place.run(&format!("run {file}.toml --no-record --json -")).json();
        place.run(&format!("inspect {file}.toml --json -")).json();
        place.run(&format!("bearings {file}.toml --json -")).json();
        Table::of(&place.ok(&format!("solve {file}.toml --with assur --crank-deg 0:20:10")));
        let channel = if file == "odd" { "point.--.x_m" } else { "point.A.x_m" };
        for drawing in [
            format!("plan {file}.toml --svg -"),
            format!("diagram {file}.toml --channel {channel} --svg -"),
            format!("export {file}.toml --mjcf -"),
        ] {
            let text = place.ok(&drawing);
            let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{drawing}: {error}"));
            assert!(
                document.descendants().all(|node| !node.is_element() || node.tag_name().name() != "d"),
                "{drawing}"
            );
        }
        place.ok(&format!("export {file}.toml --mjcf"));
    }
    let name = if cfg!(windows) { "out\\" } else { "out/" };
    let new: BTreeSet<String> = files(&place.path("")).difference(&before).cloned().collect();
    let recorded =
        ["_", "plain"].into_iter().flat_map(|own| [".mcap", ".foxglove.json"].map(|end| format!("{name}{own}{end}")));
    let expected = recorded.chain(["_.xml".into(), "plain.xml".into()]);
    assert_eq!(new, expected.collect::<BTreeSet<String>>());
}

/// Paths of all files below a directory, relative to this directory.
fn files(root: &Path) -> BTreeSet<String> {
    let (mut found, mut open) = (BTreeSet::new(), vec![root.to_path_buf()]);
    while let Some(directory) = open.pop() {
        for entry in fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                found.insert(path.strip_prefix(root).unwrap().display().to_string());
            }
        }
    }
    found
}
