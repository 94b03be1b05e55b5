//! Sliding pairs in plans and diagrams.
//! The tests check the known directions and the drawn guides.
//! Numerical derivatives check the Coriolis component and the relative acceleration.

use analytic::{AssurSolver, NewtonSolver};
use design::draw;
use design::plan::state_at;
use design::plan::{TipKind, VectorKind};
use linkage::case::{Case, When};
use linkage::math::{KeepNan, Vec2, cross, rotated, turned};
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;
use scenario::Scenario;

use super::{Named, SLIDERS, angles, contours, degrees_of, longest, plans, plans_of, plans_with, scenario};
use crate::common::assert_within;
use linkage::mechanism::LinkId;

/// For each scenario: a joint, its sliding point, and the name of the coincident point on the moving guide.
const MOVING: [(&str, &str, &str, &str); 3] =
    [("quick_return", "slot", "A", "A3"), ("scotch_yoke", "slot", "A", "A3"), ("tangent", "slot", "B", "B1")];

fn state(case: &Case, degrees: f64) -> State {
    state_at(case, &AssurSolver, When::Crank(degrees.to_radians())).unwrap()
}

#[test]
fn points_in_fixed_guides_move_along_them() {
    for (name, point, axis) in [
        ("compressor", "B", Vec2::y()),
        ("compressor", "D", Vec2::y()),
        ("six_bar_slider", "D", Vec2::y()),
        ("quick_return", "C", Vec2::x()),
        ("scotch_yoke", "Y", Vec2::x()),
        ("scotch_yoke", "P", Vec2::x()),
        ("tangent", "B", Vec2::y()),
    ] {
        for degrees in angles() {
            let plans = plans_with(name, &NewtonSolver, degrees_of(name, degrees));
            for plan in [&plans.velocity, &plans.acceleration] {
                let vector = plan.vector(&format!("{}_{point}", plan.quantity.symbol())).unwrap();
                assert!(vector.meaning.contains(", along the guide "), "{}", vector.meaning);
                // The bound is the promised accuracy of the solvers' velocities and accelerations.
                assert_within!(cross(axis, vector.value).abs(), 1e-11 * longest(plan), "{name} {point} at {degrees}");
            }
        }
    }
}

/// Numerical differentiation of the sliding point's position, in the axes of the guide's link, gives the relative
/// velocity and acceleration.
/// The Coriolis component is 2 omega x the relative velocity.
/// The test uses neither the solvers' derivatives nor the slide's channels.
#[test]
fn relative_and_coriolis_parts_match_numerical_derivatives() {
    // The errors are the rounding error of five positions (1e-16 of each) divided by h^2, and the truncation error of
    // order h^4.
    // Both errors are below 1e-8 of the derivative.
    let h = 2e-3f64;
    let mut worst = 0.0f64;
    for (name, joint, point, under) in MOVING {
        let case = scenario(name).case;
        let mechanism = &case.mechanism;
        let joint = &mechanism.joints()[mechanism.joint_named(joint).unwrap()];
        let [guide, block] = mechanism.guide_and_block(joint).unwrap();
        let relative = |degrees: f64| {
            let motions = state(&case, degrees).motions;
            let direction = motions[guide.link].direction;
            let place = motions[block.link].point(block.local) - motions[guide.link].origin;
            rotated(Vec2::new(direction.x, -direction.y), place)
        };
        for degrees in angles().map(|degrees| degrees_of(name, degrees)) {
            let omega = case.crank().at(0.0).rate;
            let at = |k: f64| relative(degrees + (k * h).to_degrees());
            let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(at);
            let here = &state(&case, degrees).motions[guide.link];
            let first = here.arm((a - b * 8.0 + d * 8.0 - e) / (12.0 * h)) * omega;
            let second = here.arm((-a + b * 16.0 - c * 30.0 + d * 16.0 - e) / (12.0 * h * h)) * omega * omega;
            let plans = plans(name, degrees);
            let [v, growth] = [("v", ""), ("a", "^r")].map(|(symbol, part)| format!("{symbol}_{point},{under}{part}"));
            let (velocity, acceleration) = (&plans.velocity, &plans.acceleration);
            let gap = (velocity.vector(&v).unwrap().value - first).norm() / longest(velocity);
            worst = worst
                .larger(gap)
                .larger((acceleration.vector(&growth).unwrap().value - second).norm() / longest(acceleration));
            let coriolis = turned(first) * (2.0 * here.omega);
            match acceleration.vector(&format!("a_{point},{under}^cor")) {
                Some(found) => worst = worst.larger((found.value - coriolis).norm() / longest(acceleration)),
                None => assert_eq!((name, here.omega), ("scotch_yoke", 0.0)),
            }
        }
    }
    assert_within!(worst, 1e-8, "{worst:e}");
}

/// At least one contour contains the sliding pair: without the relative vectors of this pair, fewer contours close.
#[test]
fn contours_with_sliding_pairs_need_their_relative_vectors() {
    for (name, _, point, under) in MOVING {
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            let plans = plans_with(name, solver, degrees_of(name, 67.0));
            for plan in [&plans.velocity, &plans.acceleration] {
                let mut without = plan.clone();
                without.vectors.retain(|vector| !matches!(vector.part, VectorKind::Sliding | VectorKind::Coriolis));
                assert_eq!(contours(plan).0, contours(&without).0 + 1, "{name}");
                let (tip, letter) = (plan.tip(&under.to_lowercase()).unwrap(), point.to_lowercase());
                let parts = plan
                    .vectors
                    .iter()
                    .filter(|vector| matches!(vector.part, VectorKind::Sliding | VectorKind::Coriolis));
                let sum: Vec2 = parts.map(|vector| vector.value).sum();
                assert_within!((tip + sum - plan.tip(&letter).unwrap()).norm(), 1e-11 * longest(plan), "{name}");
            }
        }
    }
}

/// A link that only slides has no vectors between its points. All letters are unique.
#[test]
fn links_that_never_turn_have_no_relative_vectors() {
    for name in SLIDERS {
        for degrees in angles().map(|degrees| degrees_of(name, degrees)) {
            let plans = plans_with(name, &NewtonSolver, degrees);
            for plan in [&plans.velocity, &plans.acceleration] {
                let still = |link: LinkId| plans.scheme.links[link.index() - 1].omega.abs() < 1e-12;
                let between = |part: VectorKind| {
                    matches!(
                        part,
                        VectorKind::Relative | VectorKind::Normal | VectorKind::Tangential | VectorKind::Coriolis
                    )
                };
                let silly = plan.vectors.iter().find(|vector| between(vector.part) && still(vector.link));
                assert!(silly.is_none(), "{name} at {degrees}: {:?}", silly);
                let mut letters: Vec<&str> = plan.tips.iter().map(|tip| tip.letter.as_str()).collect();
                let all = letters.len();
                letters.sort_unstable();
                letters.dedup();
                assert_eq!(letters.len(), all, "{name}");
            }
        }
    }
}

/// The plan names the point of a guide that coincides with a sliding point.
/// In this slider-crank, a point of the scenario already has such a name.
/// The rod of this slider-crank slides through a block that only rotates.
#[test]
fn contours_of_a_swinging_block_close_with_unique_letters() {
    let text = r#"
format = 1
name = "swinging_block"
title = "Swinging block"
source = "none"
[ground.points]
O = { x_mm = 0, y_mm = 0 }
K = { x_mm = 300, y_mm = 0 }
[links.crank.points]
O = { x_mm = 0, y_mm = 0 }
A = { x_mm = 100, y_mm = 0 }
[links.rod.points]
A = { x_mm = 0, y_mm = 0 }
K2 = { x_mm = 500, y_mm = 20 }
[links.block.points]
K = { x_mm = 0, y_mm = 0 }
[[joints]]
name = "O"
type = "revolute"
links = ["ground", "crank"]
[[joints]]
name = "A"
type = "revolute"
links = ["crank", "rod"]
[[joints]]
name = "bore"
type = "prismatic"
links = ["rod", "block"]
points = ["A", "K"]
axis_deg = 0
[[joints]]
name = "K"
type = "revolute"
links = ["ground", "block"]
[drive]
joint = "O"
speed_rad_s = 5
[start]
crank_deg = 20
[[start.groups]]
links = ["rod", "block"]
mode = "ahead"
[grid]
from_deg = 0
to_deg = 360
step_deg = 5
[engine]
step_deg = 0.5
"#;
    let scenario = Scenario::parse(text, std::path::Path::new("swinging_block.toml")).unwrap_or_else(|e| panic!("{e}"));
    for degrees in angles() {
        let plans = plans_of(&scenario.case, &AssurSolver, degrees).unwrap();
        for plan in [&plans.velocity, &plans.acceleration] {
            let (count, gap) = contours(plan);
            assert!(count > 0, "{degrees}: {gap:e}");
            assert_within!(gap, 1e-11 * longest(plan), "{degrees}: {gap:e}");
            let under = plan.tips.iter().find(|tip| tip.kind == TipKind::Coincident).unwrap();
            assert_eq!(under.letter, "k2'");
        }
        // The block only turns about the fixed pivot K, so the point of the rod that coincides with K has a velocity
        // along the rod.
        let rod = scenario.case.mechanism.link_named("rod").unwrap();
        let along = state(&scenario.case, degrees).motions[rod].direction;
        let under = plans.velocity.vector("v_K2'").unwrap().value;
        assert_within!(cross(along, under).abs(), 1e-11 * longest(&plans.velocity));
        assert!(!draw::plans(&plans, "swinging_block", "").svg().is_empty());
    }
}

/// A drawn guide is as long as the slide's travel over the grid, and has the direction of the slide's axis.
#[test]
fn guides_in_the_diagram_span_the_travel() {
    for name in SLIDERS {
        let case = scenario(name).case;
        let wanted = linkage::case::Wanted::of(&[Stage::Positions]);
        let trajectory = AssurSolver.solve(&case.wanting(wanted)).unwrap();
        let plans = plans(name, degrees_of(name, 67.0));
        let sliding: Vec<_> = case.mechanism.joints().iter().filter(|joint| joint.slides()).collect();
        assert_eq!(plans.scheme.guides.len(), sliding.len());
        for (guide, joint) in plans.scheme.guides.iter().zip(sliding) {
            let channel = format!("joint.{}.slide_m", joint.name);
            let (_, slide) = trajectory.iter().find(|(own, _)| own.to_string() == channel).unwrap();
            let (low, high) = slide.iter().fold((f64::MAX, f64::MIN), |(l, h), s| (l.smaller(*s), h.larger(*s)));
            // The extreme position may lie between two angles of the grid, a degree apart.
            // The length of the guide is then wrong by at most 1e-4 of the travel.
            let near = |end: Vec2, way: f64| ((end - guide.origin).dot(&guide.axis) - way).abs() <= 1e-4 * (high - low);
            assert!(near(guide.ends[0], low) && near(guide.ends[1], high), "{name} {}", joint.name);
            assert_within!(cross(guide.axis, guide.at - guide.origin).abs(), 1e-12);
        }
    }
}
