//! Models for MuJoCo, there and back: the solution of the imported scenario is that of the original.

use crate::common::{assert_within, shipped};
use analytic::{AssurSolver, NewtonSolver};
use design::export::mjcf::mjcf;
use design::import::import;
use linkage::case::{Case, Grid};
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use scenario::Scenario;
use std::path::Path;

/// Scenarios with transmissions.
/// The exported models of these scenarios couple joints, but do not state the kind of the transmission.
const COUPLED: [&str; 3] = ["cardan_gears", "geared_five_bar", "planetary_train"];

fn solved(case: &Case) -> Trajectory {
    let times = (0..=10).map(|k| 0.02 * f64::from(k)).collect();
    let case = case.on(Grid::of_times(case.crank(), times)).unwrap();
    NewtonSolver.solve(&case).unwrap_or_else(|error| panic!("{error}"))
}

/// Every shipped scenario that can be exported.
/// A model does not state the direction from which a crank angle is measured, so inputs are not compared.
#[test]
fn every_exported_scenario_comes_back() {
    let (mut count, mut coupled) = (0, Vec::new());
    for path in scenario::files_in(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios")).unwrap() {
        let Scenario { name, case, .. } = Scenario::load(path).unwrap();
        let Ok(model) = mjcf(&case, &AssurSolver, &name, 1e-3) else { continue };
        let found = import(&model, Path::new("model.xml"), &name).unwrap_or_else(|error| panic!("{name}: {error}"));
        if COUPLED.contains(&name.as_str()) {
            assert!(found.told.iter().any(|told| told.contains("couples joints as a transmission")), "{name}");
            assert!(found.problem.unwrap().to_string().contains("the mobility is W"), "{name}");
            coupled.push(name);
            continue;
        }
        assert!(found.problem.is_none(), "{name}: {:?}", found.problem);
        let own = Scenario::parse(&found.text, "own.toml").unwrap_or_else(|error| panic!("{name}: {error}"));
        let (original, own) = (solved(&case), solved(&own.case));
        for (channel, column) in original.iter() {
            let other = own.column(channel).unwrap_or_else(|| panic!("{name}: no {channel}"));
            let scale = column.iter().fold(1e-3, |most: f64, value| most.larger(value.abs()));
            let off = column.iter().zip(other).fold(0.0, |most: f64, (a, b)| most.larger((a - b).abs()));
            assert_within!(off, 1e-9 * scale, "{name}: {channel}");
        }
        count += 1;
    }
    assert!(count >= 25, "{count}");
    assert_eq!(coupled, COUPLED);
}

#[test]
fn what_a_model_has_besides_is_told_or_refused() {
    let case = shipped("crank_rocker.toml").case;
    let model = mjcf(&case, &AssurSolver, "m", 1e-3).unwrap();
    let changed = |from: &str, to: &str| {
        assert!(model.contains(from), "{from}");
        import(&model.replace(from, to), Path::new("model.xml"), "m")
    };
    let told = changed("<equality>", "<contact/><equality>").unwrap().told;
    assert!(told.iter().any(|told| told.contains("`contact` in line")), "{told:?}");
    let told = changed("frictionloss=\"100\"", "frictionloss=\"100\" damping=\"2\"").unwrap().told;
    assert!(told.iter().any(|told| told.contains("`damping` of a `joint`")), "{told:?}");
    for (from, to, what) in [
        ("type=\"hinge\" axis=\"0 0 1\" pos=\"0 0 0\" ref=\"0\"", "type=\"ball\"", "the type \"ball\""),
        ("axisangle=\"0 0 1 0\"", "quat=\"1 0 0 0\"", "`quat` of a `body`"),
        ("axisangle=\"0 0 1 0\"", "axisangle=\"1 0 0 1\"", "not a rotation about z"),
        ("site1=\"B.first\"", "body1=\"coupler\"", "`connect` has no `site1`"),
        ("mass=\"2.6\"", "mass=\"heavy\"", "expected numbers separated by blanks"),
        ("pos=\"0.15 0.015 0\" axisangle", "pos=\"0.15 0.015 3\" axisangle", "third component 3"),
    ] {
        let error = changed(from, to).unwrap_err();
        assert!(error.to_string().contains(what), "{what}: {error}");
        assert!(error.place().is_some_and(|place| place.line() > 1), "{what}");
    }
}
