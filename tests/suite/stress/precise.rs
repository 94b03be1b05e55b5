//! Mechanisms in double-double arithmetic: against closed forms by hand, and the two methods against each other.

use lab::stress::{FAMILIES, named};
use linkage::drive::Load;
use linkage::error::ErrorKind;
use linkage::math::KeepNan;
use linkage::mechanism::{AssemblyMode, LinkId};
use linkage::trajectory::Trajectory;
use linkproof::{Case, Scenario};
use precise::{dyads, whole};
use prover::bounds::{difference, magnitudes};

use crate::common::assert_within;
use crate::common::random::for_each;

/// Largest difference in any channel, divided by the magnitude of the channel's values.
fn apart(one: &Trajectory, two: &Trajectory) -> f64 {
    let sizes = magnitudes(one);
    let errors = difference(one, two).unwrap();
    let of = |((_, values), size): ((_, &[f64]), &f64)| {
        values.iter().map(|value| if *value == 0.0 { 0.0 } else { (value / size).abs() }).fold(0.0, f64::larger)
    };
    errors.iter().zip(&sizes).map(of).fold(0.0, f64::larger)
}

/// Both methods round their results to doubles.
/// The results differ at most in the last digit, even near a dead point.
#[test]
fn closed_form_and_all_equations_agree_to_the_last_digit() {
    for (family, dial) in
        [("mass_ratio", 1e8), ("length_ratio", 1e4), ("transmission_angle", 0.01), ("size", 1e-6), ("chain", 5.0)]
    {
        let case = (named(family).unwrap().setup)(dial, 0, 0).unwrap().case;
        let off = apart(&dyads::solve(&case).unwrap(), &whole::solve(&case).unwrap());
        println!("{family} {dial}: {off:.1e}");
        assert_within!(off, 2.0 * f64::EPSILON, "{family} {dial}");
    }
}

/// A slider-crank by textbook formulas, computed in doubles.
#[test]
fn a_slider_crank_matches_the_textbook() {
    let (r, l, omega, mass) = (0.05, 0.17, 30.0, 2.0);
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("G", [0.0, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [r, 0.0])])
        .link("rod", &[("A", [0.0, 0.0]), ("B", [l, 0.0])])
        .link("piston", &[("B", [0.0, 0.0]), ("P", [0.0, 0.0])])
        .mass("piston", mass, [0.0, 0.0], 1e-3)
        .pin("O", "ground", "crank")
        .pin("A", "crank", "rod")
        .pin("B", "rod", "piston")
        .slider("guide", ("ground", "G"), ("piston", "P"), [0.0, 0.0])
        .crank("O", omega)
        .start(0.2)
        .mode(&["rod", "piston"], AssemblyMode::Ahead)
        .instants(24)
        .build()
        .unwrap();
    assert_eq!(precise::method(&case), "all equations in double-double");
    let found = precise::solve(&case).unwrap();
    let column = |name: &str| found.named(name).unwrap_or_else(|| panic!("{name}"));
    for (row, &t) in found.times().iter().enumerate() {
        let (s, c) = (0.2 + omega * t).sin_cos();
        let root = (l * l - r * r * s * s).sqrt();
        let x = r * c + root;
        let v = -r * omega * (s + r * s * c / root);
        let a = -r * omega * omega * (c + r * (c * c - s * s) / root + r.powi(3) * s * s * c * c / root.powi(3));
        for (name, own, size) in
            [("slide_m", x, 0.2), ("slide_speed_m_s", v, 2.0), ("slide_acceleration_m_s2", a, 60.0)]
        {
            let off = column(&format!("joint.guide.{name}"))[row] - own;
            assert_within!(off.abs() / size, 1e-15, "{name} at {t}: {off}");
        }
        // The massless rod carries only a force along its axis; the crank's power equals the piston's power.
        let torque = mass * a * v / omega;
        assert_within!((column("drive.torque_N_m")[row] - torque).abs(), 1e-14, "torque at {t}");
        assert_within!((column("joint.B.fx_N")[row] - mass * a).abs(), 2e-13, "force at {t}");
        assert_within!((column("joint.B.fy_N")[row] + mass * a * r * s / root).abs(), 1e-13, "side force at {t}");
    }
}

/// Compares the analytic sides with the reference on random dyads of all five kinds, including dyads with prismatic
/// joints.
#[test]
fn random_dyads_agree_with_the_sides() {
    for_each(12, |sample| {
        let case = sample.scenario.case.with(|parts| parts.loads.clear()).unwrap();
        // The instants lie within the grid; outside the grid a sample may reach a dead point.
        let times = (0..8).map(|k| 0.04 * f64::from(k) / case.crank().top_speed().abs()).collect();
        let case = case.on(linkage::case::Grid::of_times(case.crank(), times)).unwrap();
        let truth = precise::solve(&case).unwrap_or_else(|error| panic!("{error}"));
        let found = prover::run::beside::sides(&case, Some(&truth)).unwrap();
        for own in found.sides.iter().flat_map(|side| &side.deviations) {
            assert_within!(own.used, 1.0, "{} {own:?}", sample.spec.toml());
        }
        Ok(())
    });
}

#[test]
fn unsupported_cases_are_refused() {
    let case = (FAMILIES[0].setup)(1.0, 0, 0).unwrap().case;
    let refused = |case: &Case, part: &str| {
        let error = precise::solve(case).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(error.message().contains(part), "{error}");
    };
    let rubbed = case
        .with(|parts| {
            let links = [LinkId(0), LinkId(1)];
            parts.loads.push(Load::Friction {
                joint: parts.drives.crank().joint,
                links,
                coefficient: 0.1,
                length: 0.01,
            });
        })
        .unwrap();
    refused(&rubbed, "friction");
    refused(&case.with(|parts| parts.drives.crank_mut().through = true).unwrap(), "change points");
    let early = linkage::case::Grid::of_times(case.crank(), vec![-0.1, 0.0]);
    refused(&case.on(early).unwrap(), "before t = 0");
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker_runup.toml");
    refused(&Scenario::load(&path).unwrap().case, "free");
}
