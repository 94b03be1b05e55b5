//! Drawn graphs against the crank angle.

use crate::common::assert_within;
use std::f64::consts::TAU;

use design::diagram::{CrankGraph, GraphPoint, Graphs};
use design::draw;

/// A cosine with mean 3 N over one revolution from 90 deg on, in the direction `way`.
fn cosine(amplitude: f64, way: f64) -> Graphs {
    let start = TAU / 4.0;
    let points = (0..=360).map(|k| way * TAU * f64::from(k) / 360.0).map(|x| [start + x, 3.0 + amplitude * x.cos()]);
    // The first mark lies outside the drawn revolution.
    let marks = [("least", -TAU / 2.0, -1.0), ("greatest", 0.0, 1.0)];
    let marks = marks.map(|(word, x, side)| GraphPoint { at: [start + way * x, 3.0 + side * amplitude], word });
    let (points, size) = (points.collect(), 3.0 + amplitude);
    let graph =
        CrankGraph { name: "force", symbol: "F_x", unit: "N", points, mean: 3.0, mean_word: "mean", marks, size };
    Graphs { period: [start, start + way * TAU], graphs: vec![graph], notes: vec!["a < b & c".into()] }
}

fn numbers(path: &str) -> Vec<[f64; 2]> {
    let pairs = path[1..].split('L').map(|pair| pair.split_once(' ').unwrap());
    pairs.map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()]).collect()
}

#[test]
fn curves_are_true_to_scale_and_marks_lie_on_them() {
    for (amplitude, way) in [(2.0, 1.0), (2e-5, 1.0), (700.0, -1.0)] {
        let text = draw::graphs(&cosine(amplitude, way), "cosine").svg();
        let document = roxmltree::Document::parse(&text).unwrap();
        let words: Vec<String> = document
            .descendants()
            .filter(|node| node.has_tag_name("text"))
            .map(|node| node.descendants().filter(|part| part.is_text()).filter_map(|part| part.text()).collect())
            .collect();
        let heading = words.iter().find(|words| words.starts_with("force Fx, N; scale factor ")).unwrap();
        let scale: f64 = heading.split(' ').rev().nth(1).unwrap().parse().unwrap();
        let paths = document.descendants().filter_map(|node| node.attribute("d"));
        let [curve] = paths.filter(|path| !path.ends_with('Z')).map(numbers).collect::<Vec<_>>().try_into().unwrap();
        // The curve starts and ends high, is lowest in the middle, and is 180 mm long.
        let [first, middle, last] = [curve[0], curve[180], curve[360]];
        assert!(first[1] == last[1]);
        assert_within!((last[0] - first[0] - 180.0).abs(), 0.011);
        assert_within!(((middle[1] - first[1]) * scale - 2.0 * amplitude).abs(), 0.011 * scale, "{scale} {amplitude}");
        let circles = document.descendants().filter(|node| node.has_tag_name("circle"));
        let centres: Vec<[f64; 2]> =
            circles.map(|node| ["cx", "cy"].map(|key| node.attribute(key).unwrap().parse().unwrap())).collect();
        assert_eq!(centres, [middle, first]);
        let degrees = if way > 0.0 { ["at 270.0°", "at 90.0°"] } else { ["at -90.0°", "at 90.0°"] };
        for (word, degrees) in ["least", "greatest"].iter().zip(degrees) {
            assert!(words.iter().any(|text| text.starts_with(word) && text.ends_with(degrees)), "{degrees}: {words:?}");
        }
        // Numbers at the axes show no rounding errors.
        assert!(words.iter().all(|text| text.chars().filter(char::is_ascii_digit).count() < 12), "{words:?}");
        assert!(words.contains(&"mean 3.000".to_string()) && words.contains(&"a < b & c".to_string()));
    }
}
#[test]
fn rounding_is_drawn_as_a_constant() {
    let mut graphs = cosine(1e-15, 1.0);
    assert!(graphs.graphs[0].is_constant());
    let text = draw::graphs(&graphs, "constant").svg();
    assert!(text.contains(">constant 3.000<") && !text.contains("<circle") && !text.contains("least"), "{text}");
    // The values of this graph are zero except for rounding error, although the graph's scale is 3.
    let graph = &mut graphs.graphs[0];
    graph.points.iter_mut().for_each(|point| point[1] -= 3.0);
    graph.marks.iter_mut().for_each(|mark| mark.at[1] -= 3.0);
    graph.mean = 1e-17;
    assert!(graph.is_constant());
    let text = draw::graphs(&graphs, "zero").svg();
    assert!(text.contains(">constant 0<") && !text.contains("NaN") && !text.contains("e-1"), "{text}");
    assert!(!cosine(1e-6, 1.0).graphs[0].is_constant());
}
