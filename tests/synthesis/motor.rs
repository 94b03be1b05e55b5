//! Choice of a motor: the published one comes out.

use std::path::Path;

use linkproof::reference::dynamics::Choice;
use linkproof::scenario::catalogue;

use crate::common::shipped;

fn motors() -> Vec<linkproof::drive::CatalogueMotor> {
    catalogue::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogues/motors.toml")).unwrap()
}

#[test]
fn the_published_motor_comes_out() {
    let scenario = shipped("crank_rocker.toml");
    let choice = Choice::of(&scenario.case, &motors(), 0.92).unwrap();
    eprintln!("{choice:?}");
    // Printed: 36.98 N m * 13.61 1/s = 0.503 kW, over 0.92 it is 0.547 kW.
    assert!((choice.power / 1e3 - 0.503).abs() < 0.01, "{}", choice.power);
    assert!((choice.asked / 1e3 - 0.547).abs() < 0.01, "{}", choice.asked);
    let rpm = 60.0 / std::f64::consts::TAU;
    assert_eq!([choice.motor.power, (choice.motor.rated_speed * rpm).round()], [550.0, 2745.0]);
    assert!((choice.motor.rated_torque() - 1.913).abs() < 5e-4);
    assert!((choice.geared.ratio - 2745.0 / 130.0).abs() < 1e-12);
}
