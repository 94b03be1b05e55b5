//! Mechanisms with sliders where they cannot go on: axes that become parallel, dead points.

mod common;

use std::f64::consts::FRAC_PI_2;
use std::time::{Duration, Instant};

use common::shipped;
use common::sliders::short_rod;
use linkproof::ErrorKind;
use linkproof::case::{Case, Grid};
use linkproof::reference::range::{Extent, Kind, Range};
use linkproof::reference::{self, AssurSolver};

fn on_cranks(case: &Case, cranks: &[f64]) -> Case {
    case.on(Grid::of_cranks(&case.drive, cranks.iter().map(|degrees| degrees.to_radians()).collect()))
}

/// Symptom: the range of a mechanism whose slide goes to infinity is an error, and every message that names the range takes 20 s. Cause: its curve
/// is infinitely long. The tangent mechanism's slide is h tan(phi): its limits are 90 deg to either side.
#[test]
fn regress_a_slide_that_goes_to_infinity_ends_the_range() {
    let begun = Instant::now();
    let range = Range::of(&shipped("tangent.toml").case).unwrap();
    let Extent::Limited(limits) = range.extent else { panic!("{:?}", range.extent) };
    for (limit, expected) in limits.iter().zip([-FRAC_PI_2, FRAC_PI_2]) {
        assert_eq!((limit.kind, limit.group), (Kind::ParallelAxes, 0));
        // To what limits are promised.
        assert!((limit.crank - expected).abs() <= 1e-9, "{:e}", limit.crank - expected);
    }
    // Less than a tenth of a second was measured; 20 s are what must not come back.
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
}

/// Beyond the pose with parallel axes the block has passed through infinity.
#[test]
fn no_solver_goes_on_behind_parallel_axes() {
    let case = shipped("tangent.toml").case;
    for solver in reference::all() {
        for cranks in [vec![0.0, 85.0, 95.0], vec![0.0, 120.0], vec![-60.0, 91.0]] {
            let error = solver.solve(&on_cranks(&case, &cranks), &mut |_| {}).err();
            let error = error.unwrap_or_else(|| panic!("{} solves {cranks:?}", solver.name()));
            assert!(error.message().contains("crank angle") && error.way_out().is_some(), "{error}");
        }
    }
}

/// The rod of `short_rod` is in line with the normal of the guide at 244.158 deg from it: a dead point.
#[test]
fn a_start_at_a_dead_point_of_a_slider_says_so() {
    let mut case = short_rod();
    let range = Range::of(&case).unwrap();
    let Extent::Limited([_, to]) = range.extent else { panic!("{:?}", range.extent) };
    assert!((to.crank.to_degrees() - 261.347).abs() < 1e-3, "{}", to.crank.to_degrees());
    let end = on_cranks(&case, &[case.drive.start.to_degrees(), (to.crank - 1e-12).to_degrees()]);
    let states = common::states(&AssurSolver, &end, &end.grid.times).unwrap();
    let last = &states[1];
    case.start.0 = last
        .motions
        .iter()
        .zip(&last.angles)
        .map(|(motion, &angle)| linkproof::mechanism::LinkPose { origin: motion.origin, angle })
        .collect();
    case.drive.start = to.crank;
    let case = on_cranks(&case, &[to.crank.to_degrees(), to.crank.to_degrees() + 5.0]);
    let error = Range::of(&case).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Geometry, "{error}");
    assert!(error.message().contains("singular") && error.way_out().is_some(), "{error}");
    for solver in reference::all() {
        let error = solver.solve(&case, &mut |_| {}).unwrap_err();
        assert!(error.way_out().is_some(), "{error}");
    }
}
