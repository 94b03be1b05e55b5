//! The engine under loads, by every route.

use linkage::engine::Route;
use linkage::error::ErrorKind;
use prover::run::{Options, prove};

use crate::common::shipped;

#[test]
fn val_the_press_agrees_by_every_route() {
    let mut scenario = shipped("loaded_slider.toml");
    // One instant every ten degrees is enough for this test.
    let cranks: Vec<f64> = (0..=36).map(|k| f64::from(10 * k).to_radians()).collect();
    let grid = linkage::case::Grid::of_inputs(scenario.case.crank(), cranks);
    scenario.case = scenario.case.on(grid).unwrap();
    for route in Route::ALL {
        let proof = prove(&scenario, &Options::default().route(route)).unwrap();
        let wrong = proof.engine().channels.iter().filter(|channel| channel.verdict.word() != "agree");
        let wrong: Vec<_> = wrong.map(|c| (c.residual.channel.to_string(), c.residual.max, c.bound)).collect();
        assert_eq!(proof.verdict.word(), "agree", "{route:?}: {:?} {wrong:?}", proof.verdict);
    }
}

#[test]
fn loads_unsupported_by_mujoco_are_refused_by_name() {
    let case = shipped("loaded_slider.toml").case;
    let solver = analytic::named("assur").unwrap();
    let error = design::export::mjcf::mjcf(&case, solver, "press", 1e-3).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("a load of type \"force\"") && error.way_out().is_some(), "{error}");
}
