//! Marks of a drawing: legend, drives, paths of joints, and files for computer-aided design.

use std::fs;

use linkage::math::{KeepNan, Vec2};
use linkproof::Scenario;
use roxmltree::Document;

use super::{draw, file, svg, texts};
use crate::common::assert_within;

/// The names of the links stand below the picture, each beside its number.
#[test]
fn a_legend_names_the_links_by_their_numbers() {
    let text = svg(&[&file("crank_rocker")]);
    let all = texts(&Document::parse(&text).unwrap());
    for pair in ["1 crank", "2 coupler", "3 rocker"] {
        assert!(all.windows(2).any(|own| own.join(" ") == pair), "{pair}: {all:?}");
    }
}

/// The only black areas of a picture are the arrowheads of its drives, so counting black areas counts the drives.
#[test]
fn a_link_that_only_forces_move_has_no_arrow_of_a_drive() {
    let heads = |name: &str| {
        let text = svg(&[&file(name)]);
        let document = Document::parse(&text).unwrap();
        let paths = document.descendants().filter(|node| node.has_tag_name("path"));
        paths.filter(|node| node.attribute("fill") == Some("#1a1a1a") && !node.has_attribute("fill-opacity")).count()
    };
    assert_eq!((heads("crank_rocker"), heads("double_pendulum"), heads("five_bar")), (1, 0, 2));
}

/// In the inversor, the point opposite the crank pin is a joint, and its path is the straight line.
/// The paths of joints on cranks are circles, which are left out.
#[test]
fn paths_of_joints_are_drawn_unless_they_are_circles() {
    let paths = |name: &str| {
        let text = svg(&[&file(name), "--traces"]);
        let document = Document::parse(&text).unwrap();
        let paths = document.descendants().filter(|node| node.attribute("stroke-dasharray") == Some("1 0.8"));
        let number = |text: &str| -> Vec<f64> {
            let numbers = text.split(|sign: char| !matches!(sign, '0'..='9' | '.' | '-'));
            numbers.filter(|own| !own.is_empty()).map(|own| own.parse().unwrap()).collect()
        };
        let path = |node: roxmltree::Node| -> Vec<Vec2> {
            number(node.attribute("d").unwrap()).chunks(2).map(|pair| Vec2::new(pair[0], pair[1])).collect()
        };
        paths.map(path).collect::<Vec<_>>()
    };
    let drawn = paths("formulas/peaucellier_inversor");
    let straight = drawn.iter().filter(|path| {
        let [low, high] = linkage::math::corners(path.iter().copied());
        // Coordinates are rounded to a hundredth of a millimetre.
        (high - low).min() <= 0.011 && (high - low).max() > 5.0
    });
    assert_eq!(straight.count(), 1, "{}", drawn.len());
    // The crank-rocker has one point that is not a joint, and two joints on circles.
    assert_eq!(paths("crank_rocker").len(), 1);
}

/// In a DXF file, the distance between the two pins of a link is the length of the link.
/// The pins are on the layer of the joints.
#[test]
fn a_dxf_file_has_full_size_and_layers() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("x.dxf");
    let (code, _, told) = draw(&[&file("crank_rocker"), "--dimensions", "-o", path.to_str().unwrap()]);
    assert_eq!(code, 0, "{told}");
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let codes: Vec<(&str, &str)> = lines.chunks(2).map(|pair| (pair[0], pair[1])).collect();
    assert_eq!(codes.last(), Some(&("0", "EOF")));
    for layer in ["ground", "link_1", "link_3", "joints", "dimensions", "labels"] {
        assert!(codes.contains(&("8", layer)), "{layer}");
    }
    assert!(codes.contains(&("1", "250 mm")), "the numbers of dimensions are texts");
    let number = |index: usize| codes[index].1.parse::<f64>().unwrap();
    let circles = (0..codes.len()).filter(|&k| codes[k] == ("0", "CIRCLE") && codes[k + 1].1 == "joints");
    let pins: &[Vec2] = &circles.map(|k| Vec2::new(number(k + 2), number(k + 3))).collect::<Vec<_>>();
    let apart = |length: f64| pins.iter().flat_map(move |a| pins.iter().map(move |b| ((a - b).norm() - length).abs()));
    // The pose is exact up to rounding.
    let case = Scenario::load(file("crank_rocker")).unwrap().case;
    for link in ["crank", "coupler"] {
        let length = 1e3 * case.mechanism.links()[case.mechanism.link_named(link).unwrap()].size();
        assert_within!(apart(length).fold(f64::INFINITY, f64::smaller), 1e-9, "{link}");
    }
}
