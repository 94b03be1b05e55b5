//! The import of a damaged source ends with a message that says where the damage is, and how to go on.

use super::data;
use crate::cli::tools::Place;
use crate::common::shipped;
use crate::common::sketch::RandomSource;
use analytic::AssurSolver;
use design::export::mjcf::mjcf;
use design::import::import;
use std::path::Path;

#[test]
fn a_broken_link_is_refused_with_its_place() {
    let place = Place::empty();
    let refused = |query: &str, words: &[&str]| {
        let outcome = place.given(&["import", query]);
        assert_eq!(outcome.code, 2, "{query}: {}", outcome.stderr);
        for word in words {
            assert!(outcome.stderr.contains(word), "{query}: `{word}` is not in: {}", outcome.stderr);
        }
        assert!(outcome.stderr.contains("help: "), "{}", outcome.stderr);
    };
    refused(
        data("broken.pmks").trim(),
        &["last character of the link", "incomplete or changed", "copy the whole link"],
    );
    refused("https://app.pmksplus.com/?", &["nothing after its `?`"]);
    refused("https://app.pmksplus.com/?pmks2:12345678.e30", &["pmks2:"]);
    refused("?00.VG.K,0.101.6A,A,0,0...N_R", &["`joint 1`", "the record ends before the angle"]);
    refused("?00.VG.K,0.101.6A,A,0,!,0...N_T", &["`joint 1`", "found \"!\" as y"]);
    refused("?00.VG.K,0.901...N_I", &["found \"901\" as units"]);
    refused("?00.VG.K,0.101..YRAB,AB,Fe,Fe,0,0,c5cae9,A,B,,...N_o", &["`AB`", "the joint \"A\" is named"]);
    refused("?mech=ground a RP 0 0 0 tfft", &["`joint 1`", "kind RP"]);
    refused("?mech=a R 0", &["`joint 1`", "two coordinates"]);
    place.refused("import none.pmks", &["the source none.pmks cannot be read"]);
}

/// The import of randomly damaged models and files of Linkage never panics and never takes long.
#[test]
fn damaged_sources_never_panic() {
    let model = mjcf(&shipped("quick_return.toml").case, &AssurSolver, "m", 1e-3).unwrap();
    let texts = [model, data("gears.linkage2"), data("actuator.linkage2"), data("two_sliders.linkage2")];
    for seed in 0..300 {
        let random = &mut RandomSource::of_sample(0x2dea, seed);
        let mut text = texts[random.index(texts.len())].clone().into_bytes();
        for _ in 0..=random.index(3) {
            let at = random.index(text.len());
            match random.index(4) {
                0 => drop(text.remove(at)),
                1 => text[at] = b"0-9 \"<>/etruAnP."[random.index(16)],
                2 => text.insert(at, b"0-9 \"<>/etruAnP."[random.index(16)]),
                _ => {
                    let line: Vec<u8> =
                        text.split_inclusive(|byte| *byte == b'\n').nth(random.index(20)).unwrap_or(b"").into();
                    let lines = text.iter().position(|byte| *byte == b'\n').unwrap_or(0) + 1;
                    text.splice(lines..lines, line);
                }
            }
        }
        let text = String::from_utf8(text).unwrap();
        if let Ok(found) = import(&text, Path::new("source"), "own") {
            assert!(found.text.contains("format = 1"), "{text}");
        }
    }
}

/// The import of randomly damaged links of PMKS+ never panics.
/// The check character at the end of each link fits the damaged text.
#[test]
fn damaged_links_never_panic() {
    let names = ["four_bar", "slot", "force", "welded", "driven_slide"];
    for seed in 0..300 {
        let random = &mut RandomSource::of_sample(0x1dea, seed);
        let own = data(&format!("{}.pmks", names[random.index(names.len())]));
        let mut query: Vec<u8> = own.trim().bytes().skip_while(|byte| *byte != b'?').skip(1).collect();
        query.pop();
        for _ in 0..=random.index(3) {
            let at = random.index(query.len());
            match random.index(3) {
                0 => drop(query.remove(at)),
                1 => query[at] = b"0AZaz_-.,!"[random.index(10)],
                _ => query.insert(at, b"0AZaz_-.,!"[random.index(10)]),
            }
        }
        // The last character is a check character.
        // The check character is made to fit the damaged text, so the program reads the damaged part.
        let digits = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
        query.push(digits[query.len() % 62]);
        let query = format!("?{}", String::from_utf8(query).unwrap());
        if let Ok(found) = import(&query, Path::new("link"), "own") {
            assert!(found.text.contains("format = 1"), "{query}");
        }
    }
}
