//! Choice of a motor: the result is the published one.

use std::path::Path;

use design::drive::catalogue;
use design::drive::motor::MotorChoice;

use crate::common::{assert_within, shipped};

fn motors() -> Vec<design::drive::motor::CatalogueMotor> {
    catalogue::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogues/motors.toml")).unwrap()
}

/// Without the crank's own weight, as in the authors' computation, the greatest moment is the recomputed one.
#[test]
fn the_peak_without_the_weight_of_the_crank() {
    let mut text = shipped("crank_rocker.toml").text;
    for (from, to) in
        [("mass_kg = 2.6\n", "mass_kg = 0\n"), ("inertia_kg_m2 = 0.00014641741001640535", "inertia_kg_m2 = 0")]
    {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text = text.replace(from, to);
    }
    // The scenario's published masses are an oracle and not needed here.
    let scenario = scenario::Scenario::parse(&text, Path::new("x.toml")).unwrap();
    let choice = MotorChoice::of(&scenario.case, &motors(), 0.92).unwrap();
    assert_within!((choice.peak.1 - 37.016).abs(), 5e-4, "{}", choice.peak.1);
    assert_eq!(choice.motor.power, 550.0);
}

#[test]
fn the_published_motor_comes_out() {
    let scenario = shipped("crank_rocker.toml");
    let choice = MotorChoice::of(&scenario.case, &motors(), 0.92).unwrap();
    eprintln!("{choice:?}");
    // Printed: 36.98 N m * 13.61 1/s = 0.503 kW, over 0.92 it is 0.547 kW.
    assert_within!((choice.power / 1e3 - 0.503).abs(), 0.01, "{}", choice.power);
    assert_within!((choice.asked / 1e3 - 0.547).abs(), 0.01, "{}", choice.asked);
    let rpm = 60.0 / std::f64::consts::TAU;
    assert_eq!([choice.motor.power, (choice.motor.rated_speed * rpm).round()], [550.0, 2745.0]);
    assert_within!((choice.motor.rated_torque() - 1.913).abs(), 5e-4);
    assert_within!((choice.geared.ratio - 2745.0 / 130.0).abs(), 1e-12);
    // Printed to three digits, and met to all of them.
    assert!((choice.power - 503.0).abs() < 1.0 && (choice.asked - 547.0).abs() < 1.0);
    // The balance of the means without losses, as published: 14.332 rad/s with the law rounded to 22.51 - 0.0716 omega,
    // 14.322 with its full digits.
    let lossless = linkage::drive::Motor { efficiency: 1.0, ..choice.geared.clone() };
    assert_within!(
        (lossless.steady_speed(choice.mean).unwrap() - 14.3217).abs(),
        1e-4,
        "{:?}",
        lossless.steady_speed(choice.mean)
    );
    assert!(choice.averaged < lossless.steady_speed(choice.mean).unwrap());
}
