//! Chosen scales and the turned velocity plan, read back from the drawing.

use analytic::AssurSolver;
use design::draw;
use design::plan::{PlanScale, Plans, VectorKind, state_at};
use linkage::case::When;
use linkage::math::{Vec2, rotated, unit};

use super::{Named, scenario};
use crate::common::assert_within;

fn scaled(name: &str, degrees: f64, wishes: &[&str], turned: bool) -> linkage::Result<Plans> {
    let case = scenario(name).case;
    let crank = degrees.to_radians();
    let state = state_at(&case, &AssurSolver, When::Crank(crank)).unwrap();
    let wishes: Vec<PlanScale> = wishes.iter().map(|wish| PlanScale::read(wish).unwrap()).collect();
    let plans = Plans::of(&case, &AssurSolver, &state, crank).scaled(&case, &state, &wishes)?;
    Ok(if turned { plans.turned() } else { plans })
}

/// The arrow of a vector, read from the drawing (mm, y upwards).
fn arrow(text: &str, name: &str) -> Vec2 {
    let document = roxmltree::Document::parse(text).unwrap();
    let titled = |node: &roxmltree::Node| {
        let title = node.children().find(|own| own.has_tag_name("title")).and_then(|own| own.text());
        title.is_some_and(|title| title.trim().starts_with(&format!("{name} = ")))
    };
    let group = document.descendants().find(|node| node.has_tag_name("g") && titled(node)).unwrap();
    let line = group.children().find(|node| node.has_tag_name("line")).unwrap();
    let number = |key: &str| line.attribute(key).unwrap().parse::<f64>().unwrap();
    let head = group.children().find(|node| node.has_tag_name("path")).unwrap().attribute("d").unwrap();
    let tip: Vec<f64> = head[1..].split('L').next().unwrap().split(' ').map(|part| part.parse().unwrap()).collect();
    Vec2::new(tip[0] - number("x1"), number("y1") - tip[1])
}

/// Bound of errors of lengths in the drawing (mm): the coordinates of both ends are rounded to 0.01 mm.
const DIGIT: f64 = 0.015;

#[test]
fn a_vector_has_its_chosen_length_on_paper() {
    for (wish, vector, length) in
        [("pa=100mm", "v_A", 100.0), ("v_B=60", "v_B", 60.0), ("πa=100mm", "a_A", 100.0), ("a_BA^n=5mm", "a_BA^n", 5.0)]
    {
        let plans = scaled("crank_rocker", 70.0, &[wish], false).unwrap();
        let text = draw::plans(&plans, "crank_rocker", "").svg();
        assert_within!((arrow(&text, vector).norm() - length).abs(), DIGIT, "{wish}");
        // Only the plan with the chosen vector changes its scale; the scale of the second plan stays the same.
        let [velocity, acceleration] = [plans.velocity.scale == 0.01, plans.acceleration.scale == 0.2];
        assert!(velocity != acceleration, "{wish}");
    }
    // The textbook formula mu_v = v_A / pa.
    let plans = scaled("crank_rocker", 70.0, &["pa=100mm"], false).unwrap();
    let size = plans.velocity.vector("v_A").unwrap().value.norm();
    assert_within!((plans.velocity.scale - size / 100.0).abs(), 1e-15);
}

/// Names of the crank's pin and pivot.
fn ends_of_the_crank(name: &str) -> (&'static str, &'static str) {
    match name {
        "ov7_base" => ("2", "1"),
        "quick_return" => ("A", "O1"),
        _ => ("A", "O"),
    }
}

#[test]
fn at_the_scale_of_the_crank_velocity_and_acceleration_are_as_long_as_the_crank() {
    for (name, degrees) in [("crank_rocker", 70.0), ("quick_return", 40.0), ("ov7_base", -30.0)] {
        for drawing in [&["crank"][..], &["crank", "1:2"]] {
            let plans = scaled(name, degrees, drawing, false).unwrap();
            let text = draw::plans(&plans, name, "").svg();
            let (pin, pivot) = ends_of_the_crank(name);
            let place = |name: &str| plans.scheme.points.iter().find(|(own, _)| own == name).unwrap().1;
            let crank = (place(pin) - place(pivot)).norm() / plans.scheme.scale;
            for vector in [format!("v_{pin}"), format!("a_{pin}")] {
                assert_within!((arrow(&text, &vector).norm() - crank).abs(), DIGIT, "{name} {vector}");
            }
            assert!(drawing.len() == 1 || plans.scheme.scale == 0.002);
        }
    }
}

/// In the turned plan, the velocity of the crank pin points from the pivot to the pin.
/// The sides of a link's image are parallel to the link.
#[test]
fn a_turned_plan_is_parallel_to_the_mechanism() {
    for (name, degrees, sense) in [("crank_rocker", 70.0, 1.0), ("ov7_base", -30.0, -1.0)] {
        let plans = scaled(name, degrees, &["crank"], true).unwrap();
        assert_eq!(plans.velocity.turn.degrees(), -90.0 * sense);
        let text = draw::plans(&plans, name, "").svg();
        let place = |name: &str| plans.scheme.points.iter().find(|(own, _)| own == name).unwrap().1;
        let (pin, pivot) = ends_of_the_crank(name);
        let crank = (place(pin) - place(pivot)) / plans.scheme.scale;
        assert_within!((arrow(&text, &format!("v_{pin}")) - crank).norm(), DIGIT, "{name}");
        let mut sides = 0;
        for vector in
            plans.velocity.vectors.iter().filter(|own| own.part == VectorKind::Relative && own.name.len() == 4)
        {
            let (to, from) = (&vector.name[2..3], &vector.name[3..4]);
            let side = place(to) - place(from);
            let link = plans.scheme.links.iter().find(|link| link.number == vector.link).unwrap();
            let drawn = arrow(&text, &vector.name) * plans.velocity.scale;
            assert_within!((drawn - side * link.omega * sense).norm(), DIGIT * plans.velocity.scale, "{}", vector.name);
            sides += 1;
        }
        assert!(name == "ov7_base" || sides == 2, "{name}: {sides}");
        // Turning the plan on paper does not change the values of its vectors.
        let straight = scaled(name, degrees, &["crank"], false).unwrap();
        let own = plans.velocity.vector(&format!("v_{pin}")).unwrap().value;
        assert_eq!(own, straight.velocity.vector(&format!("v_{pin}")).unwrap().value);
        let upright = arrow(&draw::plans(&straight, name, "").svg(), &format!("v_{pin}"));
        let turned = arrow(&text, &format!("v_{pin}"));
        assert_within!((rotated(unit(-sense * std::f64::consts::FRAC_PI_2), upright) - turned).norm(), 2.0 * DIGIT);
        assert!(text.contains("against the driving link"));
    }
}

#[test]
fn factors_set_one_drawing_each() {
    let plans = scaled("fourth_class", 70.0, &["mu_v=0.0254", "mu_a=2(m/s^2)/mm", "OA=20mm"], false).unwrap();
    assert_eq!((plans.velocity.scale, plans.acceleration.scale), (0.0254, 2.0));
    // In the published plan of the class IV mechanism, the velocity of A is 39.4 mm long.
    let paper = plans.velocity.paper(plans.velocity.vector("v_A").unwrap());
    assert_within!((paper - 39.37).abs(), 0.005, "{paper}");
    assert_within!((plans.scheme.scale - 0.0005).abs(), 1e-15);
}

#[test]
fn impossible_scales_are_refused_with_a_remedy() {
    for (name, degrees, wishes, message, help) in [
        ("crank_rocker", 70.0, &["pq=10"][..], "called \"pq\"", "pa"),
        ("crank_rocker", 70.0, &["mu_v=1e-9"], "mm large", "mu_v from"),
        ("crank_rocker", 70.0, &["mu_a=1e9"], "mm large", "mu_a from"),
        ("crank_rocker", 70.0, &["mu_l=1e-8"], "mm large", "mu_l from"),
        ("crank_rocker", 70.0, &["pa=1e9mm"], "mm large", "mu_v from"),
        ("crank_rocker", 70.0, &["mu_v=1", "pa=100"], "mu_v is given twice", "one scale"),
        ("crank_rocker", 70.0, &["crank", "mu_a=1"], "mu_a is given twice", "crank"),
        ("crank_rocker", 70.0, &["1:2", "OA=10"], "mu_l is given twice", "one scale"),
        ("crank_rocker", 70.0, &["OO=10"], "zero", "another"),
    ] {
        let error = scaled(name, degrees, wishes, false).unwrap_err();
        assert!(error.message().contains(message), "{wishes:?}: {error}");
        assert!(error.way_out().unwrap().contains(help), "{wishes:?}: {error:?}");
    }
}
