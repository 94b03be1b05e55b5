//! `linkproof stress`.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;

use super::tools::Place;

/// All files of a directory with their bytes.
fn files(place: &Place, directory: &str) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(place.path(directory)).unwrap().map(Result::unwrap);
    entries.map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap())).collect()
}

/// The last line, which states what was run.
fn run_of(told: &str) -> &str {
    told.lines().last().unwrap()
}

#[test]
fn a_run_is_independent_of_threads_and_can_be_resumed() {
    let place = Place::new();
    let told = place.ok("stress length_ratio redundant --quick --out one --jobs 1");
    assert!(run_of(&told).contains("5 of 5 points were run"), "{told}");
    assert!(told.starts_with("5 points: no silent wrong number, no panic"), "{told}");
    place.ok("stress length_ratio redundant --quick --out two --jobs 2");
    let whole = files(&place, "one");
    assert_eq!(whole.keys().filter(|name| name.starts_with("length_ratio.")).count(), 3, "{:?}", whole.keys());
    assert!(whole == files(&place, "two"), "two threads give other bytes");

    // The CSV table has the same numbers as the JSON file.
    let json: Value = serde_json::from_slice(&whole["length_ratio.json"]).unwrap();
    let mut table = csv::Reader::from_reader(&whole["length_ratio.csv"][..]);
    let header = table.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let mut closures = 0;
    for (point, party) in json["points"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|own| own["parties"].as_array().unwrap().iter().map(move |party| (own, party)))
    {
        let cell =
            |row: &csv::StringRecord, name: &str| row[header.iter().position(|own| own == name).unwrap()].to_string();
        let is_own = |row: &&csv::StringRecord| {
            cell(row, "dial").parse::<f64>().ok() == point["dial"].as_f64()
                && Some(&*cell(row, "party")) == party["name"].as_str()
        };
        for row in rows.iter().filter(is_own) {
            for key in ["closure", "balance", "step_s"] {
                assert_eq!(cell(row, key).parse::<f64>().ok(), party[key].as_f64(), "{key}: {row:?}");
            }
            closures += usize::from(party["closure"] != party["balance"]);
        }
    }
    assert!(closures > 0);

    // A second call uses the stored results and solves no point again.
    let told = place.ok("stress length_ratio redundant --quick --out one");
    assert!(run_of(&told).contains("0 of 5 points were run"), "{told}");
    assert!(whole == files(&place, "one"), "stored results give other bytes");

    // Lost or stale results are computed anew.
    let path = place.path("one/length_ratio.json");
    let mut kept: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    kept["points"].as_array_mut().unwrap().remove(1);
    kept["points"][0]["key"] = "another case".into();
    fs::write(&path, kept.to_string()).unwrap();
    fs::remove_file(place.path("one/redundant.json")).unwrap();
    let told = place.ok("stress length_ratio redundant --quick --out one");
    assert!(run_of(&told).contains("4 of 5 points were run"), "{told}");
    assert!(whole == files(&place, "one"), "other bytes after an interrupted run");

    // An edited result, valid or not, is computed anew.
    let kept = fs::read_to_string(&path).unwrap();
    for (old, new) in [
        ("\"verdict\": \"agree\"", "\"verdict\": \"disagree\""),
        ("\"verdict\": \"agree\"", "\"verdict\": \"fine\""),
        ("\"silent\": 0", "\"silent\": 1"),
        ("\"group\": \"positions\"", "\"group\": \"places\""),
    ] {
        let changed = kept.replacen(old, new, 1);
        assert_ne!(changed, kept, "{old} is not in the stored results");
        fs::write(&path, changed).unwrap();
        let told = place.ok("stress length_ratio redundant --quick --out one");
        assert!(run_of(&told).contains("1 of 5 points were run"), "{new}: {told}");
        assert!(whole == files(&place, "one"), "{new}: other bytes after a change of the stored results");
    }
}

#[test]
fn an_unusable_directory_is_reported_before_any_run() {
    let place = Place::new();
    fs::write(place.path("file"), "").unwrap();
    place.refused("stress speed --quick --out file", &["file", "is not a directory"]);
    place.refused("stress speed --quick --out file/below", &["--out", "; expected a directory"]);
    // A directory lies at the path of a result.
    fs::create_dir_all(place.path("out/speed.json")).unwrap();
    place.refused("stress speed --quick --out out", &["speed.json"]);
    place.refused("stress sped --quick --out out", &["sped", "speed"]);
    place.refused("stress speed --quick --out out --jobs 0", &["a whole number of at least 1"]);
}

/// If an engine cannot move the mechanism, the engine fails.
/// The failure of an engine is a result with a reason, not an error of the command.
#[test]
fn failures_are_results_with_reasons() {
    let place = Place::new();
    let told = place.ok("stress step --quick --out out --page out/page.md");
    assert!(told.contains("fails at 90"), "{told}");
    let table = fs::read_to_string(place.path("out/step.csv")).unwrap();
    let failed: Vec<&str> = table.lines().filter(|line| line.contains(",fails,")).collect();
    assert!(!failed.is_empty() && failed.iter().all(|line| line.contains("loop has opened")), "{table}");
    let map = fs::read_to_string(place.path("out/page/step.svg")).unwrap();
    assert!(roxmltree::Document::parse(&map).unwrap().root_element().has_tag_name("svg"));
    assert!(fs::read_to_string(place.path("out/page.md")).unwrap().contains("](page/step.svg)"));
}
