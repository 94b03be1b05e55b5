//! Motion diagrams by chords and by graphical integration.

use linkage::case::When;
use linkage::math::KeepNan;
use std::f64::consts::{PI, TAU};

use analytic::AssurSolver;
use design::diagram::{ConstructionSort, Method, MotionCurve, MotionDiagram};
use design::draw;
use design::plan::state_at;

use super::scenario;
use crate::common::assert_within;

fn motion(name: &str, channel: &str, divisions: usize) -> MotionDiagram {
    let case = scenario(name).case;
    let course = MotionCurve::named(&case, channel).unwrap();
    MotionDiagram::of(&case, &AssurSolver, &course, divisions).unwrap()
}

/// The pin of a uniformly rotating crank moves sinusoidally.
/// The chord method reduces the velocity by the factor sin(h/2)/(h/2), and the acceleration by the square of this
/// factor.
#[test]
fn the_chord_method_on_the_crank_pin_has_its_known_factor() {
    for n in [12, 24, 48] {
        let diagram = motion("crank_rocker", "point.A.x_m", n);
        let half = PI / n as f64;
        let factor = half.sin() / half;
        for (method, factor) in [(Method::ChordVelocity, factor), (Method::ChordAcceleration, factor * factor)] {
            let found = diagram.found.iter().find(|found| found.method == method).unwrap();
            let exact = &diagram.exact[method.gives()];
            for (&row, value) in found.rows.iter().zip(&found.values) {
                // The bound is the rounding error of positions (1e-15 of their range), divided by the interval once or
                // twice.
                let bound = 1e-15 * (n * n) as f64 * diagram.half_range(method.gives());
                assert_within!((value - factor * exact[row]).abs(), bound, "{n} {method:?}");
            }
        }
    }
}

#[test]
fn the_error_of_all_methods_is_of_second_order() {
    // A tangent spans two divisions instead of one.
    // The error's term of fourth order, divided by its term of second order, is therefore four times as large.
    let bound = |method: Method| match method {
        Method::TangentVelocity | Method::TangentAcceleration => 0.2,
        Method::ChordVelocity
        | Method::ChordAcceleration
        | Method::IntegratedDisplacement
        | Method::IntegratedVelocity
        | Method::AreaDisplacement
        | Method::AreaVelocity => 0.05,
    };
    // The number of divisions makes the fourth-order term of the error negligible.
    // The motion of the class IV group changes much more sharply than the remaining motions, so it needs more
    // divisions.
    for (name, channel, divisions) in [
        ("crank_rocker", "point.B.x_m", 48),
        ("crank_rocker", "link.rocker.angle_rad", 48),
        ("ov7_base", "point.9.y_m", 48),
        ("ov7_new", "link.base_345.angle_rad", 48),
        ("fourth_class", "point.E.x_m", 192),
    ] {
        for found in &motion(name, channel, divisions).found {
            for order in found.orders {
                let bound = bound(found.method);
                assert_within!((order.unwrap() - 2.0).abs(), bound, "{name} {channel} {:?}: {order:?}", found.method);
            }
        }
    }
    // A draughtsman's usual numbers of divisions: 12, then 24 and 48.
    for found in &motion("crank_rocker", "link.coupler.angle_rad", 12).found {
        assert_within!((found.orders[1].unwrap() - 2.0).abs(), bound(found.method), "{:?}", found.orders);
    }
}

/// The example of a published graphical course: a piston of the two-stage compressor.
/// Chords give velocity and acceleration of the piston from its displacement.
/// Graphical integration gives velocity from acceleration, and displacement from velocity.
/// Displacement, velocity and acceleration follow the authors' closed form (phi clockwise from +y).
/// From this closed form, the test recomputes the results of all eight methods.
#[test]
fn chord_errors_of_a_piston_match_the_closed_form() {
    let (crank, rod, omega) = (0.06, 0.24, 104.71975511965978);
    let at = |phi: f64| {
        let (s1, c1) = phi.sin_cos();
        let (s2, c2) = (-(crank * s1 / rod).asin()).sin_cos();
        let omega2 = -crank * omega * c1 / (rod * c2);
        let eps2 = (crank * omega * omega * s1 + rod * omega2 * omega2 * s2) / (rod * c2);
        let velocity = -crank * omega * s1 + crank * omega * c1 * (s2 / c2);
        let acceleration = -crank * omega * omega * c1 - rod * omega2 * omega2 * c2 - rod * eps2 * s2;
        [crank * c1 + rod * c2, velocity, acceleration]
    };
    let largest = [12, 24].map(|n| {
        let diagram = motion("compressor", "point.B.y_m", n);
        let angle = |row: usize| TAU * row as f64 / (n * diagram.stride) as f64;
        let scale = |which: usize| diagram.half_range(which);
        for which in 0..3 {
            let gap = |row: usize| (diagram.exact[which][row] - at(angle(row))[which]).abs();
            let worst = (0..diagram.cranks.len()).map(gap).fold(0.0, f64::larger);
            // The bound is the rounding error of lengths of 0.3 m, and of the values computed from these lengths.
            assert_within!(worst, 1e-12 * scale(which), "{worst:e}");
        }
        let h = TAU / n as f64;
        let step = h / omega;
        let middle = |k: usize| at((k as f64 + 0.5) * h);
        let chord = |k: usize| (at((k + 1) as f64 * h)[0] - at(k as f64 * h)[0]) / step;
        // `tangent` is the velocity by the tangent at a row.
        // `strip` is the area of one trapezoid below the curve of the derivative of order `of`.
        let tangent = |row: f64| (at((row + 1.0) * h)[0] - at((row - 1.0) * h)[0]) / (2.0 * step);
        let strip = |j: usize, of: usize| f64::midpoint(at(j as f64 * h)[of], at((j + 1) as f64 * h)[of]) * step;
        let by_hand = |method: Method, k: usize| match method {
            Method::TangentVelocity => tangent((k + 1) as f64),
            Method::TangentAcceleration => (tangent((k + 2) as f64) - tangent(k as f64)) / (2.0 * step),
            Method::AreaDisplacement => at(0.0)[0] + (0..k).map(|j| strip(j, 1)).sum::<f64>(),
            Method::AreaVelocity => at(0.0)[1] + (0..k).map(|j| strip(j, 2)).sum::<f64>(),
            Method::ChordVelocity => chord(k),
            Method::ChordAcceleration => (chord(k + 1) - chord(k)) / step,
            Method::IntegratedDisplacement => at(0.0)[0] + (0..k).map(|j| middle(j)[1] * step).sum::<f64>(),
            Method::IntegratedVelocity => at(0.0)[1] + (0..k).map(|j| middle(j)[2] * step).sum::<f64>(),
        };
        diagram
            .found
            .iter()
            .map(|found| {
                for (k, value) in found.values.iter().enumerate() {
                    // The bound exceeds the rounding error of displacements (1e-16 of 0.3 m) divided by the square of
                    // the step.
                    let bound = 1e-12 * scale(found.method.gives());
                    assert_within!((value - by_hand(found.method, k)).abs(), bound, "{:?} {k}", found.method);
                }
                found.share
            })
            .collect::<Vec<f64>>()
    });
    // The figures of docs/plans.md.
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/plans.md")).unwrap();
    for (found, (coarse, fine)) in Method::ALL.iter().zip(largest[0].iter().zip(&largest[1])) {
        let row = format!("| {} | {:.2} % | {:.2} % |", found.words(), coarse * 100.0, fine * 100.0);
        assert!(text.contains(&row), "{row}");
    }
}

#[test]
fn a_link_that_turns_uniformly_has_no_error() {
    let diagram = motion("crank_rocker", "link.crank.angle_rad", 12);
    for found in &diagram.found {
        // The angle grows by 2 pi.
        // The only error is the angle's rounding error, divided by the interval once or twice.
        // This error has no order.
        assert!(found.orders == [None; 2], "{found:?}");
        assert_within!(found.largest, 1e-11, "{found:?}");
        assert_within!(found.share, 1e-11, "{found:?}");
    }
}

#[test]
fn diagrams_are_well_formed_and_carry_their_errors() {
    for (name, channel, n) in [("crank_rocker", "point.B.x_m", 12), ("ov7_base", "link.rocker_87.angle_rad", 36)] {
        let diagram = motion(name, channel, n);
        let text = draw::motion(&diagram, name).svg();
        let document = roxmltree::Document::parse(&text).unwrap();
        let words: String = document.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
        let drawn = [ConstructionSort::Chords, ConstructionSort::Integration].map(ConstructionSort::methods).concat();
        for found in diagram.found.iter().filter(|found| drawn.contains(&found.method)) {
            assert!(words.contains(&format!(
                "{}: largest error {}",
                found.method.words(),
                draw::significant(found.largest)
            )));
        }
        let circles = document.descendants().filter(|node| node.has_tag_name("circle")).count();
        // The drawing has one circle at every midpoint, one at every end except the first, and one in each of two
        // captions.
        assert_eq!(circles, 2 * n + 2);
    }
}

#[test]
fn invalid_channels_are_refused_with_a_remedy() {
    let case = scenario("crank_rocker").case;
    for (channel, message, way_out) in [
        ("point.B.z_m", "no channel", "point.B.x_m"),
        ("point.Q.x_m", "no channel", "point.A.x_m"),
        ("link.roker.angle_rad", "no channel", "link.rocker.angle_rad"),
        ("point.B.vx_m_s", "already a derivative", "point.B.x_m"),
        ("joint.B.fx_N", "neither a position nor an angle", "point.B.x_m"),
        ("", "no channel", "point.B.x_m"),
    ] {
        let error = MotionCurve::named(&case, channel).unwrap_err();
        assert!(error.message().contains(message), "{channel}: {error}");
        assert!(error.way_out().unwrap().contains(way_out), "{channel}: {error}");
    }
    let course = MotionCurve::named(&case, "point.B.x_m").unwrap();
    for divisions in [0, 3, 1001] {
        let error = MotionDiagram::of(&case, &AssurSolver, &course, divisions).unwrap_err();
        assert!(error.way_out().unwrap().contains("from 4 to 1000"), "{error}");
    }
    for crank in [f64::NAN, f64::INFINITY, 1e30] {
        assert!(state_at(&case, &AssurSolver, When::Crank(crank)).is_err());
    }
}
