//! Limits of mechanisms with sliders: axes that become parallel, and dead points.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use crate::common::sliders::short_rod;
use crate::common::{assert_within, shipped};
use analytic::range::{Extent, Range, SingularityKind, explained};
use analytic::{self, AssurSolver};
use linkage::ErrorKind;
use linkage::case::{Case, Grid};
use linkage::mechanism::GroupId;
use scenario::Scenario;

fn on_cranks(case: &Case, cranks: &[f64]) -> Case {
    case.on(Grid::of_inputs(case.crank(), cranks.iter().map(|degrees| degrees.to_radians()).collect())).unwrap()
}

/// Symptom: the range of a mechanism whose slide goes to infinity is an error, and every message with the range takes
/// 20 s.
/// Cause: the slide goes to infinity, so the curve of the poses is infinitely long.
/// The slide of the tangent mechanism is h tan(phi), so its limits are at -90 and 90 deg.
#[test]
fn regress_a_slide_that_goes_to_infinity_ends_the_range() {
    let range = Range::of(&shipped("tangent.toml").case).unwrap();
    let Extent::Limited(limits) = range.extent else { panic!("{:?}", range.extent) };
    for (limit, expected) in limits.iter().zip([-FRAC_PI_2, FRAC_PI_2]) {
        assert_eq!((limit.kind, limit.group), (SingularityKind::ParallelAxes, GroupId(0)));
        // Promised accuracy of limits.
        assert_within!((limit.crank - expected).abs(), 1e-9, "{:e}", limit.crank - expected);
    }
    // The test limits poses, not seconds; before the fix, the endless curve took the largest allowed number of poses.
    println!("{} poses", range.samples.len());
    assert!(range.samples.len() < 10_000, "{}", range.samples.len());
}

/// Beyond the pose with parallel axes the block has passed through infinity.
#[test]
fn no_solver_continues_beyond_parallel_axes() {
    let case = shipped("tangent.toml").case;
    for solver in analytic::all() {
        for cranks in [vec![0.0, 85.0, 95.0], vec![0.0, 120.0], vec![-60.0, 91.0]] {
            let error = solver.solve(&on_cranks(&case, &cranks)).err();
            let error = error.unwrap_or_else(|| panic!("{} solves {cranks:?}", solver.name()));
            assert!(error.message().contains("crank angle") && error.way_out().is_some(), "{error}");
        }
        for beyond in [90.0, 90.5, 100.0, 180.0] {
            let error = solver.solve(&on_cranks(&case, &[0.0, beyond])).unwrap_err();
            let message = explained(&case, error).to_string();
            assert!(message.contains("from -90.000000 to 90.000000 deg"), "{}: {message}", solver.name());
        }
    }
}

/// At crank angle 261.347 deg the rod of `short_rod` is in line with the normal of the guide: a dead point.
#[test]
fn a_start_at_a_dead_point_of_a_slider_is_reported() {
    let case = short_rod();
    let range = Range::of(&case).unwrap();
    let Extent::Limited([_, to]) = range.extent else { panic!("{:?}", range.extent) };
    assert_within!((to.crank.to_degrees() - 261.347).abs(), 1e-3, "{}", to.crank.to_degrees());
    let end = on_cranks(&case, &[case.crank().start.to_degrees(), (to.crank - 1e-12).to_degrees()]);
    let states = crate::common::states(&AssurSolver, &end, &end.grid.times).unwrap();
    let last = &states[1];
    let pose = last
        .motions
        .iter()
        .zip(&last.angles)
        .map(|(motion, &angle)| linkage::mechanism::LinkPose { origin: motion.origin, angle })
        .collect();
    let case = case.with(|parts| (parts.start.0, parts.drives.crank_mut().start) = (pose, to.crank)).unwrap();
    let case = on_cranks(&case, &[to.crank.to_degrees(), to.crank.to_degrees() + 5.0]);
    let error = Range::of(&case).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Geometry, "{error}");
    assert!(error.message().contains("singular") && error.way_out().is_some(), "{error}");
    for solver in analytic::all() {
        let error = solver.solve(&case).unwrap_err();
        assert!(error.way_out().is_some(), "{error}");
    }
}

/// A slider-crank of crank 0.1 m and a rod of the given length, its guide `offset` m above the crank's pivot.
fn slider_crank(rod: f64, offset: f64) -> Case {
    let text = format!(
        "format = 1\nname = \"t\"\ntitle = \"t\"\n[ground.points]\nO = {{ x_m = 0, y_m = 0 }}\nG = {{ x_m = 0, y_m = {offset:?} }}\n\
         [links.crank.points]\nO = {{ x_m = 0, y_m = 0 }}\nA = {{ x_m = 0.1, y_m = 0 }}\n[links.rod.points]\nA = {{ x_m = 0, y_m = 0 }}\n\
         B = {{ x_m = {rod:?}, y_m = 0 }}\n[links.slider.points]\nB = {{ x_m = 0, y_m = 0 }}\n\
         [[joints]]\nname = \"O\"\ntype = \"revolute\"\nlinks = [\"ground\", \"crank\"]\n\
         [[joints]]\nname = \"A\"\ntype = \"revolute\"\nlinks = [\"crank\", \"rod\"]\n\
         [[joints]]\nname = \"B\"\ntype = \"revolute\"\nlinks = [\"rod\", \"slider\"]\n\
         [[joints]]\nname = \"guide\"\ntype = \"prismatic\"\nlinks = [\"ground\", \"slider\"]\npoints = [\"G\", \"B\"]\naxis_deg = 0\n\
         [drive]\njoint = \"O\"\nspeed_rad_s = 1\n[start]\ncrank_deg = 0\n[[start.groups]]\nlinks = [\"rod\", \"slider\"]\nmode = \"ahead\"\n\
         [grid]\nfrom_deg = 0\nto_deg = 10\nstep_deg = 1\n[engine]\nstep_deg = 1\n"
    );
    Scenario::parse(&text, Path::new("t.toml")).unwrap().case
}

/// At a limit, the rod is as long as the distance from the crank pin to the guide: 0.1 sin(phi) = offset +- rod.
#[test]
fn a_short_rod_limits_the_crank_when_perpendicular_to_the_guide() {
    for (rod, offset) in [(0.08, 0.0), (0.06, 0.01), (0.09, -0.03)] {
        let range = Range::of(&slider_crank(rod, offset)).unwrap();
        let Extent::Limited([from, to]) = range.extent else { panic!("{rod}: the crank turns fully") };
        let limit = |sine: f64| if sine.abs() <= 1.0 { Some(sine.asin()) } else { None };
        let expected = [limit((offset - rod) / 0.1), limit((offset + rod) / 0.1)];
        for (found, expected) in [from, to].into_iter().zip(expected) {
            // If the sine for one side of the guide exceeds 1, the rod sets no limit on this side.
            // Both limits of the crank angle then lie on the opposite side, and the test compares only one of them.
            if let Some(expected) = expected {
                assert_within!((found.crank - expected).abs(), 1e-9, "{rod}, {offset}: {found:?}, {expected}");
            }
            assert_eq!(found.kind, SingularityKind::DeadPoint);
        }
    }
    assert_eq!(Range::of(&slider_crank(0.15, 0.04)).unwrap().extent, Extent::FullTurn(1));
}
