//! Several positions in one drawing, and paths enlarged beside it.

use std::collections::BTreeMap;

use analytic::AssurSolver;
use design::plan::state_at;
use linkage::case::When;
use linkage::math::{KeepNan, Vec2};
use linkproof::Scenario;
use roxmltree::{Document, Node};

use super::{draw, file, svg, texts};
use crate::common::assert_within;

fn number(node: Node, key: &str) -> f64 {
    node.attribute(key).unwrap().parse().unwrap()
}

/// The titles of the positions that are drawn with thin lines.
fn thin(document: &Document) -> Vec<String> {
    let groups = document.descendants().filter(|node| node.has_tag_name("g") && node.attribute("opacity") == Some("1"));
    groups.map(|group| group.first_element_child().unwrap().text().unwrap().to_string()).collect()
}

/// Places on paper of the dots at numbered positions, by colour, in the order of the document.
fn dots(document: &Document) -> BTreeMap<String, Vec<Vec2>> {
    let mut dots: BTreeMap<String, Vec<Vec2>> = BTreeMap::new();
    for node in document.descendants().filter(|node| node.has_tag_name("circle") && number(*node, "r") == 0.5) {
        let at = Vec2::new(number(node, "cx"), -number(node, "cy"));
        dots.entry(node.attribute("fill").unwrap().into()).or_default().push(at);
    }
    dots
}

/// The numbers of positions as text, with the corners of the text's box on paper.
fn numbers(document: &Document) -> Vec<(String, [Vec2; 2])> {
    let words = document.descendants().filter(|node| node.has_tag_name("text") && number(*node, "font-size") == 2.8);
    let of = |node: Node| {
        let text = node.text().unwrap().to_string();
        let half = Vec2::new(0.28 * 2.8 * text.chars().count() as f64, 0.35 * 2.8);
        let middle = Vec2::new(number(node, "x"), -number(node, "y") + 0.28 * 2.8);
        (text, [middle - half, middle + half])
    };
    words.map(of).collect()
}

fn has(document: &Document, line: &str) -> bool {
    texts(document).iter().any(|text| text == line)
}

#[test]
fn twelve_positions_of_a_turn_are_drawn_and_numbered() {
    let text = svg(&[&file("crank_rocker"), "--positions", "12"]);
    let document = Document::parse(&text).unwrap();
    assert!(has(&document, "12 positions, 30° apart, from crank at 0°"), "{:?}", texts(&document));
    assert!(has(&document, "position 0 drawn fully"));
    let expected: Vec<String> = (1..12).map(|k| format!("position {k}")).collect();
    assert_eq!(thin(&document), expected);
    // The colour of link 1, the crank, is `#0072b2`.
    // The crank pin has twelve positions, 30 deg apart, on a circle around O.
    let all = dots(&document);
    let pin = &all["#0072b2"];
    assert_eq!(pin.len(), 12);
    let centre = pin.iter().sum::<Vec2>() / 12.0;
    for (k, at) in pin.iter().enumerate() {
        let (arm, next) = (at - centre, pin[(k + 1) % 12] - centre);
        let turn = (arm.x * next.y - arm.y * next.x).atan2(arm.dot(&next)).to_degrees();
        // Error of the angle between two positions that are rounded to 0.01 mm, at a radius of more than 5 mm:
        // 2 * 0.0071 mm / 5 mm = 0.16 deg.
        assert!(arm.norm() > 5.0);
        assert_within!(turn - 30.0, 0.17, "{k}");
    }
    // Each position of the crank pin has its number, and no two numbers cover each other.
    let shown = numbers(&document);
    for k in 0..12 {
        assert!(shown.iter().any(|(text, _)| text.split(',').any(|own| own == k.to_string())), "{k}: {shown:?}");
    }
    assert_apart(&shown);
}

/// No two numbers cover each other.
fn assert_apart(shown: &[(String, [Vec2; 2])]) {
    for (k, (text, [low, high])) in shown.iter().enumerate() {
        for (other, [left, right]) in &shown[k + 1..] {
            let gap = (low - right).sup(&(left - high));
            assert!(gap.x > 0.0 || gap.y > 0.0, "{text} covers {other}");
        }
    }
}

#[test]
fn the_position_of_the_requested_crank_angle_is_drawn_fully() {
    let at = |degrees: &str| svg(&[&file("crank_rocker"), "--positions", "12", "--crank-deg", degrees]);
    let (third, between) = (at("90"), at("100"));
    let [third, between] = [&third, &between].map(|text| Document::parse(text).unwrap());
    assert!(has(&third, "position 3 drawn fully"));
    assert!(thin(&third).len() == 11 && !thin(&third).contains(&"position 3".to_string()));
    // The crank angle of 100 deg is not one of the twelve positions, so all twelve positions are drawn with thin lines.
    assert!(!texts(&between).iter().any(|text| text.ends_with("drawn fully")));
    assert_eq!(thin(&between).len(), 12);
}

#[test]
fn positions_cover_a_limited_range_or_a_time() {
    for (name, count, heading) in [
        ("boom_lift", "6", "6 positions, 50 mm apart, from slide at 300 mm"),
        ("pendulum", "5", "5 positions, 0.75 s apart, from 0 s"),
        ("robot_arm", "7", "7 positions, 0.25 s apart, from 0 s"),
        ("planetary_train", "72", "72 positions, 5° apart, from crank at 30°"),
    ] {
        let text = svg(&[&file(name), "--positions", count]);
        let document = Document::parse(&text).unwrap();
        assert!(has(&document, heading), "{name}: {:?}", texts(&document));
        assert!(has(&document, "position 0 drawn fully"), "{name}");
        assert_eq!(thin(&document).len() + 1, count.parse::<usize>().unwrap(), "{name}");
        assert!(!text.contains("NaN"), "{name}");
    }
}

#[test]
fn every_scenario_can_be_drawn_in_several_positions() {
    for entry in std::fs::read_dir("scenarios").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let text = svg(&[path.to_str().unwrap(), "--positions", "12"]);
            let document = Document::parse(&text).unwrap();
            assert!(texts(&document).iter().any(|text| text.starts_with("12 positions, ")), "{path:?}");
            assert!((11..=12).contains(&thin(&document).len()) && !text.contains("NaN"), "{path:?}");
        }
    }
}

#[test]
fn a_path_is_enlarged_at_the_stated_scale() {
    let name = "ov7_new";
    let text = svg(&[&file(name), "--enlarge", "8,4"]);
    let document = Document::parse(&text).unwrap();
    let case = Scenario::load(file(name)).unwrap().case;
    for point in ["8", "4"] {
        let (_, side) = case.mechanism.moving_points().find(|(own, _)| *own == point).unwrap();
        let start = case.crank().start;
        let at = |k: usize| {
            let crank = start + case.crank().sense() * std::f64::consts::TAU * k as f64 / 12.0;
            state_at(&case, &AssurSolver, When::Crank(crank)).unwrap().motions[side.link].point(side.local)
        };
        let heading = texts(&document).into_iter().find_map(|text| {
            text.strip_prefix(&format!("path of {point}, scale "))?.strip_suffix(" : 1").map(str::to_string)
        });
        let ratio: f64 = heading.unwrap_or_else(|| panic!("{:?}", texts(&document))).parse().unwrap();
        assert!(ratio >= 2.0, "{ratio}");
        let colour = drawing::palette::link(side.link).light;
        let drawn = &dots(&document)[colour];
        // The dots of all paths of a link have the same colour.
        // The dots of this path are therefore the twelve successive dots that fit the computed places best.
        let (places, from): (Vec<Vec2>, Vec2) = ((0..12).map(at).collect(), at(0));
        let fits = |first: usize| {
            let own = &drawn[first..first + 12];
            let off = |k: usize| ((own[k] - own[0]) - (places[k] - from) * (1e3 * ratio)).norm();
            (0..12).map(off).fold(0.0, f64::larger)
        };
        let best = (0..drawn.len() / 12).map(|k| fits(12 * k)).fold(f64::INFINITY, f64::smaller);
        // The bound is the rounding error of two dots, whose coordinates are rounded to 0.01 mm.
        assert_within!(best, 0.02, "{point}");
    }
    assert_apart(&numbers(&document));
}

#[test]
fn mass_centres_have_paths_and_unknown_points_are_told() {
    let text =
        svg(&[&file("crank_rocker"), "--positions", "12", "--trace", "link.coupler", "--enlarge", "link.coupler"]);
    let document = Document::parse(&text).unwrap();
    assert!(texts(&document).iter().any(|text| text.starts_with("path of link.coupler, scale ")));
    // Twelve dots for the path in the picture, and twelve for the enlarged path.
    assert_eq!(dots(&document)["#d55e00"].len(), 24);
    let (code, _, told) = draw(&[&file("crank_rocker"), "--enlarge", "Q", "-o", "-"]);
    assert_eq!(code, 0);
    assert!(told.contains("no moving point is called \"Q\"") && told.contains("link.coupler"), "{told}");
}

#[test]
fn options_that_do_not_go_together_are_refused() {
    for (arguments, message) in [
        (&["--positions", "1"][..], "1 positions are requested"),
        (&["--positions", "73"][..], "73 positions are requested"),
        (&["--positions", "12", "--each-mode"][..], "all configurations are drawn as a whole"),
        (&["--positions", "12", "--groups"][..], "groups are drawn apart at one instant"),
        (&["--groups", "--each-mode"][..], "all configurations are drawn as a whole"),
    ] {
        let (code, _, told) = draw(&[&[file("crank_rocker").as_str(), "-o", "-"], arguments].concat());
        assert_eq!(code, 2, "{told}");
        assert!(told.contains(message), "{told}");
    }
    let place = tempfile::tempdir().unwrap();
    for (option, ending) in [(&["--positions", "12"][..], "gif"), (&["--enlarge", "B"], "webp"), (&["--groups"], "gif")]
    {
        let picture = place.path().join(format!("picture.{ending}"));
        let (code, _, told) =
            draw(&[&[file("crank_rocker").as_str(), "-o", picture.to_str().unwrap()], option].concat());
        assert_eq!(code, 2, "{told}");
        assert!(told.contains("an animation shows one position at a time") && told.contains(option[0]), "{told}");
        assert!(!picture.exists());
    }
}
