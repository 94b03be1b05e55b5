//! Range of motion of mechanisms with sliders, against closed forms.

mod common;

use std::path::Path;

use linkproof::case::{Case, Grid};
use linkproof::reference::range::{Extent, Kind, Range};
use linkproof::reference::{AssurSolver, NewtonSolver};
use linkproof::scenario::Scenario;
use linkproof::solver::Solver;

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

/// The rod just spans from the crank pin to the guide: 0.1 sin(phi) = offset +- rod.
#[test]
fn a_short_rod_limits_the_crank_where_it_stands_across_the_guide() {
    for (rod, offset) in [(0.08, 0.0), (0.06, 0.01), (0.09, -0.03)] {
        let range = Range::of(&slider_crank(rod, offset)).unwrap();
        let Extent::Limited([from, to]) = range.extent else { panic!("{rod}: the crank turns fully") };
        let limit = |sine: f64| if sine.abs() <= 1.0 { Some(sine.asin()) } else { None };
        let expected = [limit((offset - rod) / 0.1), limit((offset + rod) / 0.1)];
        for (found, expected) in [from, to].into_iter().zip(expected) {
            // Where one side of the guide is out of reach, the crank goes round to the same angle on the other side.
            if let Some(expected) = expected {
                assert!((found.crank - expected).abs() < 1e-9, "{rod}, {offset}: {found:?}, {expected}");
            }
            assert_eq!(found.kind, Kind::DeadPoint);
        }
    }
    assert_eq!(Range::of(&slider_crank(0.15, 0.04)).unwrap().extent, Extent::FullTurn(1));
}

/// y = h tan(phi): the slider runs away at +-90 deg, and no solver comes back from beyond.
#[test]
fn parallel_axes_end_the_range_and_no_solver_goes_through_infinity() {
    let case = common::shipped("tangent.toml").case;
    let range = Range::of(&case).unwrap();
    let Extent::Limited(ends) = range.extent else { panic!("the crank turns fully") };
    for (end, degrees) in ends.into_iter().zip([-90.0f64, 90.0]) {
        assert_eq!(end.kind, Kind::ParallelAxes);
        assert!((end.crank - degrees.to_radians()).abs() < 1e-9, "{end:?}");
    }
    for beyond in [90.0f64, 90.5, 100.0, 180.0] {
        let beyond = case.on(Grid::of_cranks(&case.drive, vec![0.0, beyond.to_radians()]));
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            let message = solver.solve(&beyond, &mut |_| {}).unwrap_err().to_string();
            assert!(message.contains("from -90.000000 to 90.000000 deg"), "{}: {message}", solver.name());
        }
    }
}
