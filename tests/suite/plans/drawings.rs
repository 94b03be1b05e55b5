//! Drawings of plans: well formed, complete, true to scale, legible.

use design::draw;
use linkage::math::{KeepNan, Vec2};

use super::{Named, REVOLUTE, SLIDERS, all, degrees_of, plans};
use crate::common::assert_within;

#[test]
fn drawings_are_well_formed_and_hold_every_vector() {
    let names = REVOLUTE.into_iter().chain(SLIDERS);
    for (name, degrees) in names.flat_map(|name| [0.0, 70.0, 210.0].map(|degrees| (name, degrees))) {
        let plans = plans(name, degrees_of(name, degrees));
        let text = draw::plans(&plans, name, "a < b & \"c\"").svg();
        let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let root = document.root_element();
        let size = |key: &str| root.attribute(key).unwrap().trim_end_matches("mm").parse::<f64>().unwrap();
        assert_eq!(root.attribute("viewBox").unwrap(), format!("0 0 {} {}", size("width"), size("height")));
        let titles: Vec<&str> =
            document.descendants().filter(|n| n.has_tag_name("title")).filter_map(|n| n.text()).collect();
        let words: Vec<String> = document
            .descendants()
            .filter(|node| node.has_tag_name("text"))
            .map(|node| node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect::<String>())
            .map(|text| text.trim().to_string())
            .collect();
        for plan in [&plans.velocity, &plans.acceleration] {
            for vector in &plan.vectors {
                let plain = vector.name.replace(['_', '^'], "");
                assert!(words.contains(&plain), "{name}: {} is not in the table", vector.name);
                let arrow = titles.iter().find(|title| title.trim().starts_with(&format!("{} = ", vector.name)));
                assert!(arrow.is_some() || plan.paper(vector) <= 0.15, "{name}: {} is not drawn", vector.name);
            }
        }
        // Nothing is clipped: every coordinate is on the sheet.
        for (key, most) in
            [("x", "width"), ("x1", "width"), ("x2", "width"), ("y", "height"), ("y1", "height"), ("y2", "height")]
        {
            for value in document.descendants().filter_map(|node| node.attribute(key)) {
                let value: f64 = value.parse().unwrap();
                assert!(value >= 0.0 && value <= size(most), "{name}: {key} = {value}");
            }
        }
        assert_eq!(text, draw::plans(&plans, name, "a < b & \"c\"").svg(), "same input, same bytes");
    }
}

/// Letters overlap neither each other nor a line.
/// The test uses boxes of the size of the letters, slightly smaller than the space that the drawing keeps free.
#[test]
fn letters_do_not_overlap() {
    let (mut letters, mut crossed) = (0, 0);
    for (name, degrees) in all().step_by(2) {
        let text = draw::plans(&plans(name, degrees), name, "").svg();
        let document = roxmltree::Document::parse(&text).unwrap();
        let number = |node: &roxmltree::Node, key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
        let italic = document.descendants().filter(|node| node.attribute("font-style") == Some("italic"));
        let boxes: Vec<(Vec2, Vec2)> = italic
            .map(|node| {
                let signs = node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect::<String>();
                let wide = |sign: char| if matches!(sign, ',' | ' ') { 0.25 } else { 0.5 };
                let several = if signs.trim().len() > 1 { 0.85 } else { 1.0 };
                let wide = 4.2 * several * signs.trim().chars().map(wide).sum::<f64>();
                let middle = node.attribute("text-anchor") == Some("middle");
                let left = number(&node, "x") - if middle { wide / 2.0 } else { 0.0 };
                (Vec2::new(left + wide / 2.0, number(&node, "y") - 1.2), Vec2::new(wide / 2.0, 1.3))
            })
            .collect();
        let arrows: Vec<[Vec2; 2]> = document
            .descendants()
            .filter(|node| node.has_tag_name("line") && node.parent().is_some_and(|parent| parent.has_tag_name("g")))
            .map(|node| [["x1", "y1"], ["x2", "y2"]].map(|[x, y]| Vec2::new(number(&node, x), number(&node, y))))
            .collect();
        for (index, (centre, half)) in boxes.iter().enumerate() {
            letters += 1;
            for (other, size) in &boxes[index + 1..] {
                let gap = (centre - other).abs() - half - size;
                assert!(gap.x > 0.0 || gap.y > 0.0, "{name} at {degrees}: letters at {centre:?} and {other:?}");
            }
            // Parameters at which the line enters and leaves the box, along each axis.
            let inside = |[a, b]: &[Vec2; 2]| {
                let [mut from, mut to] = [0.0f64, 1.0];
                for axis in 0..2 {
                    let (start, way) = (a[axis] - centre[axis], b[axis] - a[axis]);
                    if way == 0.0 {
                        to = if start.abs() < half[axis] { to } else { -1.0 };
                        continue;
                    }
                    let ends = [-half[axis], half[axis]].map(|edge| (edge - start) / way);
                    (from, to) = (from.larger(ends[0].smaller(ends[1])), to.smaller(ends[0].larger(ends[1])));
                }
                from < to
            };
            let is_crossed = arrows.iter().any(inside);
            if is_crossed {
                println!("{name} at {degrees}: the letters at {centre:?}");
            }
            crossed += usize::from(is_crossed);
        }
    }
    assert!(letters > 1000);
    assert_eq!(crossed, 0, "of {letters} letters");
}

/// The arrow's length equals the vector's magnitude divided by the scale factor, to 0.01 mm, the last written digit.
#[test]
fn drawings_are_true_to_scale() {
    let plans = plans("crank_rocker", 70.0);
    let text = draw::plans(&plans, "crank_rocker", "").svg();
    let document = roxmltree::Document::parse(&text).unwrap();
    let mut checked = 0;
    for group in document.descendants().filter(|node| node.has_tag_name("g")) {
        let title =
            group.children().find(|n| n.has_tag_name("title")).and_then(|n| n.text()).unwrap_or_default().trim();
        let name = title.split(" = ").next().unwrap();
        let plan = if name.starts_with('v') { &plans.velocity } else { &plans.acceleration };
        let number = |node: roxmltree::Node, key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
        let line = group.children().find(|n| n.has_tag_name("line")).unwrap();
        let head = group.children().find(|n| n.has_tag_name("path")).unwrap().attribute("d").unwrap().to_string();
        let tip: Vec<f64> = head[1..].split('L').next().unwrap().split(' ').map(|part| part.parse().unwrap()).collect();
        let drawn = Vec2::new(tip[0] - number(line, "x1"), number(line, "y1") - tip[1]);
        let vector = plan.vector(name).unwrap();
        assert_within!((drawn - vector.value / plan.scale).norm(), 0.015, "{name}: {drawn:?}");
        checked += 1;
    }
    assert!(checked > 20);
}
