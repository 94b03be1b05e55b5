//! Constructions of graphical differentiation and integration: ordinates, poles and scale factors give the values.

use std::f64::consts::TAU;

use analytic::AssurSolver;
use design::diagram::construction::result;
use design::diagram::{Construction, ConstructionSort, Method, MotionCurve, MotionDiagram};
use design::draw;

use super::scenario;
use crate::common::assert_within;

fn motion(name: &str, channel: &str, divisions: usize) -> MotionDiagram {
    let case = scenario(name).case;
    let course = MotionCurve::named(&case, channel).unwrap();
    MotionDiagram::of(&case, &AssurSolver, &course, divisions).unwrap()
}

/// The coordinate of a crank pin is a sine of the crank angle.
/// A tangent parallel to the chord of the neighbouring points gives the derivative of this sine times sin(h)/h.
/// Trapezoids give the integral of the sine times (h/2)/tan(h/2), where h is the angle between neighbouring points.
#[test]
fn tangents_and_areas_on_the_crank_pin_have_their_known_factors() {
    for n in [12, 24] {
        let diagram = motion("crank_rocker", "point.A.x_m", n);
        let h = TAU / n as f64;
        for (method, factor) in
            [(Method::TangentVelocity, h.sin() / h), (Method::TangentAcceleration, (h.sin() / h).powi(2))]
        {
            let found = result(&diagram, method);
            assert_eq!(found.values.len(), n, "{method:?}");
            for (&row, value) in found.rows.iter().zip(&found.values) {
                let bound = 1e-14 * (n * n) as f64 * diagram.half_range(method.gives());
                assert_within!((value - factor * diagram.exact[method.gives()][row]).abs(), bound, "{n} {method:?}");
            }
        }
        let factor = (h / 2.0) / (h / 2.0).tan();
        for method in [Method::AreaDisplacement, Method::AreaVelocity] {
            let (found, exact) = (result(&diagram, method), &diagram.exact[method.gives()]);
            for (&row, value) in found.rows.iter().zip(&found.values) {
                let right = exact[0] + factor * (exact[row] - exact[0]);
                assert_within!((value - right).abs(), 1e-13 * diagram.half_range(method.gives()), "{n} {method:?}");
            }
        }
    }
}

/// For small intervals, errors of tangents are four times the errors of chords.
/// Errors of areas are twice the errors of integration by rays.
#[test]
fn errors_of_all_methods_are_of_second_order_in_known_ratios() {
    for (name, channel) in [("crank_rocker", "point.B.x_m"), ("ov7_base", "point.9.y_m"), ("compressor", "point.B.y_m")]
    {
        let diagram = motion(name, channel, 96);
        for found in &diagram.found {
            assert_within!((found.orders[0].unwrap() - 2.0).abs(), 0.05, "{name} {:?}", found.method);
        }
        let rms = |method: Method| result(&diagram, method).rms;
        for (one, other, ratio) in [
            (Method::TangentVelocity, Method::ChordVelocity, 4.0),
            (Method::TangentAcceleration, Method::ChordAcceleration, 4.0),
            (Method::AreaDisplacement, Method::IntegratedDisplacement, 2.0),
            (Method::AreaVelocity, Method::IntegratedVelocity, 2.0),
        ] {
            assert_within!((rms(one) / rms(other) - ratio).abs(), 0.05 * ratio, "{name} {one:?}");
        }
    }
}

/// mu_v = mu_s / (mu_t H): the ordinates, multiplied by the scale factor, are the values.
/// The sums of the areas give the integral.
#[test]
fn ordinates_times_scale_factors_are_the_values() {
    for (name, channel, n) in [("crank_rocker", "point.B.x_m", 12), ("ov7_base", "link.rocker_87.angle_rad", 24)] {
        let diagram = motion(name, channel, n);
        for sort in ConstructionSort::ALL {
            let own = Construction::of(&diagram, sort);
            for step in &own.steps {
                let found = result(&diagram, step.method);
                let (given, scale) = (step.scales[0], step.scales[1]);
                assert!(step.pole >= 1.0 && step.pole.fract() == 0.0, "{step:?}");
                let differentiates = step.method.gives() > step.from;
                let right = if differentiates { given / (own.time * step.pole) } else { given * own.time * step.pole };
                assert_within!((scale / right - 1.0).abs(), 1e-14);
                if differentiates {
                    for (ordinate, value) in step.ordinates.iter().zip(&found.values) {
                        assert_within!((ordinate * scale - value).abs(), 1e-14 * value.abs());
                    }
                    continue;
                }
                // With rays, the line of a division rises by ordinate / H per millimetre.
                // With areas, an area of H mm² gives a rise of 1 mm.
                let width = 180.0 / n as f64;
                let rise =
                    |own: &f64| if sort == ConstructionSort::Areas { own / step.pole } else { own / step.pole * width };
                let mut sum = found.values[0];
                for (ordinate, value) in step.ordinates.iter().zip(&found.values[1..]) {
                    sum += rise(ordinate) * scale;
                    assert_within!((sum - value).abs(), 1e-12 * diagram.half_range(step.method.gives()), "{sort:?}");
                }
                assert_eq!(step.ordinates.len(), n);
            }
        }
    }
}

/// Every ray in the drawing is parallel to its chord.
#[test]
fn rays_in_the_drawing_are_parallel_to_their_chords() {
    let diagram = motion("crank_rocker", "point.B.x_m", 12);
    let own = Construction::of(&diagram, ConstructionSort::Chords);
    let text = draw::construction(&diagram, &own, "crank_rocker").svg();
    let document = roxmltree::Document::parse(&text).unwrap();
    let number = |node: &roxmltree::Node, key: &str| node.attribute(key).unwrap().parse::<f64>().unwrap();
    let lines = document.descendants().filter(|node| node.has_tag_name("line"));
    let rays: Vec<[f64; 2]> = lines
        .filter(|node| {
            let run = number(node, "x2") - number(node, "x1");
            (run - own.steps[0].pole).abs() < 0.02 && node.attribute("stroke-width") == Some("0.25")
        })
        .map(|node| [number(&node, "x2") - number(&node, "x1"), number(&node, "y1") - number(&node, "y2")])
        .collect();
    let exact = &diagram.exact[0];
    let mu = own.steps[0].scales[0];
    for k in 0..12 {
        let rise = (exact[(k + 1) * diagram.stride] - exact[k * diagram.stride]) / mu;
        let slope = rise / (180.0 / 12.0);
        let near = |ray: &[f64; 2]| (ray[1] / ray[0] - slope).abs() < 0.002;
        assert!(rays.iter().any(near), "no ray of slope {slope}: {rays:?}");
    }
    for sort in ConstructionSort::ALL {
        for n in [4, 12, 24, 120] {
            let diagram = motion("compressor", "point.B.y_m", n);
            let text = draw::construction(&diagram, &Construction::of(&diagram, sort), "compressor").svg();
            let document = roxmltree::Document::parse(&text).unwrap();
            let size = |key: &str| {
                document.root_element().attribute(key).unwrap().trim_end_matches("mm").parse::<f64>().unwrap()
            };
            for (key, most) in [("x1", "width"), ("x2", "width"), ("y1", "height"), ("y2", "height")] {
                for value in document.descendants().filter_map(|node| node.attribute(key)) {
                    let value: f64 = value.parse().unwrap();
                    assert!(value >= 0.0 && value <= size(most), "{sort:?} {n}: {key} = {value}");
                }
            }
            let words = document.descendants().filter(|node| node.has_tag_name("text"));
            let words = words.map(|node| node.descendants().filter_map(|n| n.text()).collect::<String>());
            let poles = words.filter(|text| text.trim_start().starts_with('H') && text.contains(" mm")).count();
            assert_eq!(poles, if sort == ConstructionSort::Areas { 0 } else { 2 }, "{sort:?}");
        }
    }
}
