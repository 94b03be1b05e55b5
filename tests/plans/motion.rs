//! Motion diagrams by chords and by graphical integration.

use std::f64::consts::PI;

use linkproof::diagram::motion::Method;
use linkproof::diagram::{Course, MotionDiagram, Plans, draw};
use linkproof::reference::AssurSolver;

use crate::scenario;

fn motion(name: &str, channel: &str, divisions: usize) -> MotionDiagram {
    let case = scenario(name).case;
    let course = Course::named(&case, channel).unwrap();
    MotionDiagram::of(&case, &AssurSolver, &course, divisions).unwrap()
}

/// The pin of a uniformly turning crank moves as a sine: the chord method makes it smaller by sin(h/2)/(h/2) and its square.
#[test]
fn the_chord_method_on_the_crank_pin_has_its_known_factor() {
    for n in [12, 24, 48] {
        let diagram = motion("crank_rocker", "point.A.x_m", n);
        let half = PI / n as f64;
        let factor = half.sin() / half;
        for (method, factor) in [(Method::ChordVelocity, factor), (Method::ChordAcceleration, factor * factor)] {
            let found = diagram.by(method).unwrap();
            let exact = &diagram.exact[method.gives()];
            for (&row, value) in found.rows.iter().zip(&found.values) {
                // Rounding of positions (1e-15 of their range) over the interval, once or twice.
                let bound = 1e-15 * (n * n) as f64 * diagram.half_range(method.gives());
                assert!((value - factor * exact[row]).abs() <= bound, "{n} {method:?}");
            }
        }
    }
}

#[test]
fn the_error_of_all_four_methods_is_of_second_order() {
    // So many divisions that the next term, of fourth order, no longer shows; the class IV group moves by far the most sharply.
    for (name, channel, divisions) in [
        ("crank_rocker", "point.B.x_m", 48),
        ("crank_rocker", "link.rocker.angle_rad", 48),
        ("ov7_base", "point.9.y_m", 48),
        ("ov7_new", "link.base_345.angle_rad", 48),
        ("fourth_class", "point.E.x_m", 192),
    ] {
        for found in &motion(name, channel, divisions).found {
            for order in found.orders {
                assert!((order.unwrap() - 2.0).abs() <= 0.05, "{name} {channel} {:?}: {order:?}", found.method);
            }
        }
    }
    // What a draughtsman takes: 12 divisions, then 24 and 48.
    for found in &motion("crank_rocker", "link.coupler.angle_rad", 12).found {
        assert!((found.orders[1].unwrap() - 2.0).abs() <= 0.05, "{:?}", found.orders);
    }
}

#[test]
fn a_link_that_turns_uniformly_has_no_error() {
    let diagram = motion("crank_rocker", "link.crank.angle_rad", 12);
    for found in &diagram.found {
        // The angle grows by 2 pi: rounding of it over the interval, once or twice.
        assert!(found.largest <= 1e-11 && found.share <= 1e-11 && found.orders == [None; 2], "{found:?}");
    }
}

#[test]
fn diagrams_are_well_formed_and_carry_their_errors() {
    for (name, channel, n) in [("crank_rocker", "point.B.x_m", 12), ("ov7_base", "link.rocker_87.angle_rad", 36)] {
        let diagram = motion(name, channel, n);
        let text = draw::motion(&diagram, name);
        let document = roxmltree::Document::parse(&text).unwrap();
        let words: String = document.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
        for found in &diagram.found {
            assert!(words.contains(&format!(
                "{}: largest error {}",
                found.method.words(),
                draw::significant(found.largest)
            )));
        }
        let circles = document.descendants().filter(|node| node.has_tag_name("circle")).count();
        // One at every middle and every end but the first, and one in each of two captions.
        assert_eq!(circles, 2 * n + 2);
    }
}

#[test]
fn bad_questions_are_answered_with_the_way_out() {
    let case = scenario("crank_rocker").case;
    for (channel, message, way_out) in [
        ("point.B.z_m", "no channel", "point.B.x_m"),
        ("point.Q.x_m", "no channel", "point.A.x_m"),
        ("link.roker.angle_rad", "no channel", "link.rocker.angle_rad"),
        ("point.B.vx_m_s", "a derivative already", "point.B.x_m"),
        ("joint.B.fx_N", "neither a position nor an angle", "point.B.x_m"),
        ("", "no channel", "point.B.x_m"),
    ] {
        let error = Course::named(&case, channel).unwrap_err();
        assert!(error.message().contains(message), "{channel}: {error}");
        assert!(error.way_out().unwrap().contains(way_out), "{channel}: {error}");
    }
    let course = Course::named(&case, "point.B.x_m").unwrap();
    for divisions in [0, 3, 1001] {
        let error = MotionDiagram::of(&case, &AssurSolver, &course, divisions).unwrap_err();
        assert!(error.way_out().unwrap().contains("from 4 to 1000"), "{error}");
    }
    for crank in [f64::NAN, f64::INFINITY, 1e30] {
        assert!(Plans::at(&case, &AssurSolver, crank).is_err());
    }
}
