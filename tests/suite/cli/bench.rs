//! `linkproof bench`, with well-behaved and faulty peers.

use std::fs;
use std::os::unix::fs::PermissionsExt;

use drawing::palette::SERIES;
use linkage::mechanism::is_unseen;
use serde_json::Value;

use super::tools::Place;

const QUICK: &str = "--quick --engine rapier --only positions";

/// A peer as a shell script.
/// When the peer is asked to solve a case, it runs the shell commands in `solve`. These commands write the table of the
/// answer to the path in `$csv`.
fn peer(place: &Place, name: &str, solve: &str) {
    let ways = r#"echo '[{"name": "as it is", "resolution": "none"}]'"#;
    let csv = r#"csv=$(sed -n 's/.*"csv":"\([^"]*\)".*/\1/p' "$2")"#;
    let text = format!("#!/bin/sh\nif [ \"$1\" = ways ]; then\n{ways}\nelse\n{csv}\n{solve}\nfi\n");
    fs::write(place.path(name), text).unwrap();
    fs::set_permissions(place.path(name), fs::Permissions::from_mode(0o755)).unwrap();
}

const TIME: &str = r#"echo '{"seconds": [0.5], "version": "script 1", "work": {"steps": 3}}'"#;

#[test]
fn diagrams_and_numbers_are_written() {
    let place = Place::new();
    let text = place.ok(&format!("bench scenarios/five_bar.toml --out out/deep {QUICK} --page page.md"));
    assert!(text.contains("positions: error of the reference "), "{text}");
    for end in ["time", "solutions", "inner"] {
        let drawn = fs::read_to_string(place.path(&format!("out/deep/five_bar.{end}.svg"))).unwrap();
        let drawn = roxmltree::Document::parse(&drawn).unwrap();
        // Each of the two sides has a mark in the legend and a mark in the only panel; the sides have the first two
        // colours.
        for colour in [SERIES[0].light, SERIES[1].light] {
            let marks = drawn.descendants().filter(|node| {
                !node.has_tag_name("line") && ["fill", "stroke"].iter().any(|key| node.attribute(*key) == Some(colour))
            });
            assert_eq!(marks.count(), 2, "{end} {colour}");
        }
        assert!(!drawn.descendants().any(|node| node.text().is_some_and(|text| text.contains("no data to draw"))));
    }
    let table = fs::read_to_string(place.path("out/deep/five_bar.csv")).unwrap();
    assert!(table.starts_with("# cpu: ") && table.contains("# cores: ") && table.contains("# build: "), "{table}");
    let rows = table.lines().filter(|line| !line.starts_with('#')).count();
    let found: Value = serde_json::from_str(&fs::read_to_string(place.path("out/deep/bench.json")).unwrap()).unwrap();
    let points = found["scenarios"][0]["points"].as_array().unwrap();
    assert_eq!(rows, points.len() + 1);
    assert_eq!(points[0]["ratio"], 1.0);
    // The CSV table and the text report have the same numbers as the JSON file.
    let lines: String = table.lines().filter(|line| !line.starts_with('#')).map(|line| format!("{line}\n")).collect();
    let mut reader = csv::Reader::from_reader(lines.as_bytes());
    let header = reader.headers().unwrap().clone();
    for (row, point) in reader.records().map(Result::unwrap).zip(points) {
        let cell = |name: &str| &row[header.iter().position(|own| own == name).unwrap()];
        let same = |name: &str, value: &Value| match value.as_f64() {
            Some(value) => {
                assert!((cell(name).parse::<f64>().unwrap() - value).abs() <= 1e-6 * value, "{name}: {row:?}")
            }
            None => assert_eq!(cell(name), "", "{row:?}"),
        };
        assert_eq!(Some(cell("program")), point["program"].as_str());
        same("ratio", &point["ratio"]);
        for part in ["max", "rms"] {
            same(&format!("positions_{part}"), &point["errors"]["positions"][part]);
        }
    }
    let section = text.split("positions: error of the reference ").nth(1).unwrap().split("\n\n").next().unwrap();
    for within in [1e-3, 1e-6, 1e-9, 1e-12] {
        let meets = |own: &&Value| {
            own["party"] != "side" && own["errors"]["positions"]["max"].as_f64().is_some_and(|error| error <= within)
        };
        let ratios = points.iter().filter(meets).filter_map(|own| own["ratio"].as_f64());
        let fastest = ratios.min_by(f64::total_cmp);
        let start = format!("fastest other program with an error of at most {within:e}: ");
        let told = section.lines().find_map(|line| line.trim().strip_prefix(&start));
        let number = told.unwrap().split(' ').next().unwrap().parse::<f64>().ok();
        // The text shows three digits.
        let same = |(told, right): (f64, f64)| (told - right).abs() <= 0.006 * right;
        assert!(number.is_some() == fastest.is_some() && number.zip(fastest).is_none_or(same), "{within:e}: {section}");
    }
    let page = fs::read_to_string(place.path("page.md")).unwrap();
    assert!(
        page.contains("## five_bar") && page.contains("out/deep/five_bar.time.svg") && page.contains("linkproof bench"),
        "{page}"
    );
}

#[test]
fn failing_peers_become_points_and_never_crash_the_bench() {
    let place = Place::new();
    place.ok("solve scenarios/five_bar.toml --with newton --only positions --csv good.csv");
    let copy = format!("cp {} \"$csv\"", place.path("good.csv").display());
    peer(&place, "good", &format!("echo a library greets; {copy}; {TIME}"));
    peer(&place, "hangs", &format!("sleep 900 & echo $! > {}; sleep 30", place.path("started").display()));
    peer(&place, "garbage", "head -c 2000 /dev/urandom");
    peer(&place, "fails", "echo it went wrong >&2; exit 3");
    peer(&place, "silent", TIME);
    peer(&place, "nan", &format!("sed '2,$s/[^,]*$/nan/' {} > \"$csv\"; {TIME}", place.path("good.csv").display()));
    peer(&place, "refuses", r#"echo '{"refused": "five bars are too many"}'"#);
    peer(&place, "half", &format!("cut -d, -f1-4 {} > \"$csv\"; {TIME}", place.path("good.csv").display()));
    let names = ["good", "hangs", "garbage", "fails", "silent", "nan", "refuses", "half", "absent"];
    let peers: Vec<String> = names.iter().map(|name| format!("--peer {name}=./{name}")).collect();
    // Without `--out`, results go to the directory `bench`.
    let line = format!("bench scenarios/five_bar.toml {QUICK} --peer-limit 1 {}", peers.join(" "));
    let told = place.ok(&line);
    assert!(told.contains("half: positions without "), "{told}");
    // Ending the peer also ended the processes that it had started.
    let started = fs::read_to_string(place.path("started")).unwrap();
    let left = fs::read(format!("/proc/{}/cmdline", started.trim())).unwrap_or_default();
    assert!(left.is_empty(), "{}", String::from_utf8_lossy(&left));
    let found: Value = serde_json::from_str(&fs::read_to_string(place.path("bench/bench.json")).unwrap()).unwrap();
    let points = found["scenarios"][0]["points"].as_array().unwrap();
    let of = |name: &str| &points.iter().find(|point| point["program"] == name).unwrap()["errors"]["positions"];
    assert!(of("good")["max"].as_f64().unwrap() < 1e-9, "{}", of("good"));
    assert_eq!(found["scenarios"][0]["versions"]["good"], "script 1");
    for (name, reason) in [
        ("hangs", "stopped after 1 s"),
        ("garbage", "output"),
        ("fails", "it went wrong"),
        ("silent", "answer.csv does not exist"),
        ("nan", "NaN"),
        ("refuses", "five bars are too many"),
    ] {
        let told = of(name)["failed"].as_str().unwrap_or_default();
        assert!(told.contains(reason), "{name}: {told}");
    }
    // The channels that the peer gives are right; the missing channels are reported.
    let half = of("half");
    assert!(half["max"].as_f64().unwrap() < 1e-9 && half["without"].as_str().unwrap().contains("more"), "{half}");
    let absent = found["scenarios"][0]["absent"].as_array().unwrap();
    assert!(absent.len() == 1 && absent[0]["peer"] == "absent", "{absent:?}");
    let drawn = fs::read_to_string(place.path("bench/five_bar.time.svg")).unwrap();
    assert!(
        drawn.contains("hangs: it was stopped after 1 s") && drawn.contains("more reasons"),
        "the picture states failures"
    );
}

/// Symptoms: a time of 5e-324 s drew an endless axis.
/// A pipe or a device in place of an answer was read beyond the time limit.
/// Words of a peer controlled the terminal and became markup on the page.
#[test]
fn peer_numbers_are_checked_and_peer_texts_escaped() {
    let place = Place::new();
    place.ok("solve scenarios/five_bar.toml --with newton --only positions --csv good.csv");
    let copy = format!("cp {} \"$csv\"", place.path("good.csv").display());
    let answers = |rest: &str| format!("{copy}; echo '{{{rest}}}'");
    let reasons = [
        ("tiny", answers(r#""seconds": [5e-324]"#), "5e-324"),
        ("huge", answers(r#""seconds": [0.1, 1e300]"#), "1e+300"),
        ("negative", answers(r#""seconds": -1"#), "expected 1e-12 s to 1e9 s"),
        ("word", answers(r#""seconds": ["soon"]"#), "expected 1e-12 s to 1e9 s"),
        ("half", answers(r#""seconds": 1, "work": {"steps": 1.5}"#), "not a whole number"),
        ("list", answers(r#""seconds": 1, "work": [7]"#), "not a JSON object"),
        ("pipe", format!("mkfifo \"$csv\"; {TIME}"), "answer.csv is not a regular file"),
        ("long", format!("head -c 67108865 /dev/zero > \"$csv\"; {TIME}"), "answer.csv is larger than 67108864 bytes"),
        ("device", format!("ln -s /dev/zero \"$csv\"; {TIME}"), "answer.csv is not a regular file"),
        (
            "output",
            format!("{copy}; cd $(dirname \"$csv\"); rm stdout; ln -s /dev/zero stdout"),
            "stdout is not a regular file",
        ),
        ("red", r"printf '\033[31mred\033]0;x\007\342\200\256' >&2; exit 1".into(), r"\u{1b}[31mred"),
    ];
    for (name, solve, _) in &reasons {
        peer(&place, name, solve);
    }
    let version = r#""version": "<img src=x onerror=y> | [a](b) `c` \\u001b[2J\\u202e""#;
    peer(&place, "words", &answers(&format!(r#""seconds": 0.5, {version}, "work": {{"st\\u001beps": 1}}"#)));
    let names: Vec<&str> = reasons.iter().map(|(name, ..)| *name).chain(["words"]).collect();
    let peers: Vec<String> = names.iter().map(|name| format!("--peer {name}=./{name}")).collect();
    let told = place.ok(&format!(
        "bench scenarios/five_bar.toml --out out {QUICK} --peer-limit 20 --page page.md {}",
        peers.join(" ")
    ));
    let found: Value = serde_json::from_str(&fs::read_to_string(place.path("out/bench.json")).unwrap()).unwrap();
    let points = found["scenarios"][0]["points"].as_array().unwrap();
    for (name, _, reason) in &reasons {
        let point = points.iter().find(|point| point["program"] == *name).unwrap();
        let told = point["errors"]["positions"]["failed"].as_str().unwrap_or_default();
        assert!(told.contains(reason), "{name}: {told}");
    }
    let page = fs::read_to_string(place.path("page.md")).unwrap();
    assert!(!page.contains("<img") && page.contains(r"&lt;img src=x onerror=y\> \| \[a\](b) \`c\`"), "{page}");
    let mut shown = vec![told, page];
    for name in ["five_bar.csv", "five_bar.time.svg", "bench.json"] {
        shown.push(fs::read_to_string(place.path("out").join(name)).unwrap());
    }
    for text in shown {
        assert!(!text.replace('\n', "").contains(is_unseen), "{text:?}");
    }
}

#[test]
fn wrong_requests_are_refused() {
    let place = Place::new();
    place.refused("bench scenarios/five_bar.toml -o out.txt", &["--output", "found .txt"]);
    place.refused("bench scenarios/five_bar.toml --out out --peer sh", &["NAME=COMMAND"]);
    place.refused("bench scenarios/five_bar.toml --out out --peer a/b=sh", &["\"a/b\" is not a valid name"]);
    place.refused("bench scenarios/five_bar.toml scenarios/five_bar.toml --out out", &["two scenarios", "five_bar"]);
    place.refused("bench scenarios/five_bar.toml --out scenarios/five_bar.toml", &["--out"]);
    place.refused("bench scenarios/five_bar.toml --out out --only up", &["--only"]);
    place.refused("bench scenarios/five_bar.toml --out out --budget 0", &["greater than 0"]);
}
