//! Groups drawn apart, in the order in which they are solved.

use assert_cmd::Command;
use linkproof::Scenario;
use roxmltree::Document;

use super::{file, pins, svg, texts};

fn inspect(arguments: &[&str]) -> (i32, Vec<u8>, String) {
    let output = Command::cargo_bin("linkproof").unwrap().arg("inspect").args(arguments).output().unwrap();
    (output.status.code().unwrap(), output.stdout, String::from_utf8(output.stderr).unwrap())
}

/// Asserts that the document contains each line, as one text or, if a long heading is broken, as several successive
/// texts.
fn assert_has(document: &Document, lines: &[&str]) {
    let all = texts(document);
    let joined = format!(" {} ", all.join(" "));
    for line in lines {
        assert!(joined.contains(&format!(" {line} ")), "{line}: {all:?}");
    }
}

#[test]
fn a_class_iv_group_is_drawn_beside_its_driving_link() {
    let text = svg(&[&file("fourth_class"), "--groups"]);
    let document = Document::parse(&text).unwrap();
    assert_has(
        &document,
        &[
            "I(0,1) → IV(2,3,4,5), class IV",
            "1. I(0,1)",
            "driving link crank",
            "outer joints O on ground",
            "2. IV(2,3,4,5)",
            "class IV, order 2: link_2, link_3, link_4, link_5",
            "outer joints A on crank, K on ground; inner joints B, C, D, E",
        ],
    );
    // The subscript of an outer joint is the number of the link that is solved earlier.
    assert_has(&document, &["O0", "A1", "K0", "B", "C", "D", "E"]);
    // The driving link is drawn with one pin, and the group with six pins.
    assert_eq!(pins(&document).len(), 7);
}

/// For every scenario, the drawn parts are the driving links and groups of its structure.
#[test]
fn every_scenario_has_its_groups_drawn_apart() {
    for entry in std::fs::read_dir("scenarios").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let text = svg(&[path.to_str().unwrap(), "--groups"]);
            let document = Document::parse(&text).unwrap();
            let case = Scenario::load(&path).unwrap().case;
            for (number, part) in (1..).zip(case.structure.numbered_parts(&case.mechanism)) {
                assert_has(&document, &[&format!("{number}. {part}")]);
            }
            assert!(!text.contains("NaN"), "{path:?}");
            // Each moving link is drawn with its number.
            for link in case.mechanism.links().ids().skip(1) {
                assert!(texts(&document).contains(&link.to_string()), "{path:?}: {link}");
            }
        }
    }
}

#[test]
fn inspect_draws_the_groups_of_another_driving_link() {
    let (code, out, told) = inspect(&[&file("class3_group"), "--driver", "lead_1", "-o", "-.svg"]);
    assert_eq!(code, 0, "{told}");
    let text = String::from_utf8(out).unwrap();
    let document = Document::parse(&text).unwrap();
    assert_has(&document, &["1. I(0,2)", "2. II(3,5)", "3. II(1,4)", "class II, order 2, RRR: crank, lead_3"]);
    let (_, own, _) = inspect(&[&file("class3_group"), "-o", "-.svg"]);
    assert_eq!(String::from_utf8(own).unwrap(), svg(&[&file("class3_group"), "--groups"]));
}

#[test]
fn drawings_of_inspect_refuse_lists() {
    for (option, found) in [(&["--driver"][..], "`--driver`"), (&["--modes"], "`--modes`"), (&["--range"], "`--range`")]
    {
        let (code, _, told) = inspect(&[&[file("class3_group").as_str(), "-o", "-.svg"], option].concat());
        assert_eq!(code, 2, "{told}");
        assert!(told.contains("a drawing shows the groups of one structure") && told.contains(found), "{told}");
    }
}
