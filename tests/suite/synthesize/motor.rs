//! Choice of a motor: the result equals the published choice.

use std::path::Path;

use design::drive::catalogue;
use design::drive::motor::MotorChoice;

use crate::common::{assert_within, shipped};

fn motors() -> Vec<design::drive::motor::CatalogueMotor> {
    catalogue::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogues/motors.toml")).unwrap()
}

/// The authors neglect the crank's mass.
/// Without the crank's mass, the greatest moment is 37.016 N m, the value recomputed from the authors' formula.
#[test]
fn the_peak_moment_without_the_crank_mass_is_as_recomputed() {
    let mut text = shipped("crank_rocker.toml").text;
    for (from, to) in
        [("mass_kg = 2.6\n", "mass_kg = 0\n"), ("inertia_kg_m2 = 0.00014641741001640535", "inertia_kg_m2 = 0")]
    {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text = text.replace(from, to);
    }
    // The scenario's published numbers belong to the crank with mass; this test does not compare them.
    let scenario = scenario::Scenario::parse(&text, Path::new("x.toml")).unwrap();
    let choice = MotorChoice::of(&scenario.case, &motors(), 0.92).unwrap();
    assert_within!((choice.peak.1 - 37.016).abs(), 5e-4, "{}", choice.peak.1);
    assert_eq!(choice.motor.power, 550.0);
}

#[test]
fn the_published_motor_is_selected() {
    let scenario = shipped("crank_rocker.toml");
    let choice = MotorChoice::of(&scenario.case, &motors(), 0.92).unwrap();
    eprintln!("{choice:?}");
    // The printed values are 36.98 N m * 13.61 1/s = 0.503 kW, and 0.547 kW after division by 0.92.
    assert_within!((choice.power / 1e3 - 0.503).abs(), 0.01, "{}", choice.power);
    assert_within!((choice.asked / 1e3 - 0.547).abs(), 0.01, "{}", choice.asked);
    let rpm = 60.0 / std::f64::consts::TAU;
    assert_eq!([choice.motor.power, (choice.motor.rated_speed * rpm).round()], [550.0, 2745.0]);
    assert_within!((choice.motor.rated_torque() - 1.913).abs(), 5e-4);
    assert_within!((choice.geared.ratio - 2745.0 / 130.0).abs(), 1e-12);
    // The values are printed to three digits, and all digits agree.
    assert!((choice.power - 503.0).abs() < 1.0 && (choice.asked - 547.0).abs() < 1.0);
    // The steady speed from mean values without losses is published as 14.332 rad/s, with the motor law rounded to
    // 22.51 - 0.0716 omega.
    // With all digits of the law the steady speed is 14.322 rad/s.
    let lossless = linkage::drive::Motor { efficiency: 1.0, ..choice.geared.clone() };
    assert_within!(
        (lossless.steady_speed(choice.mean).unwrap() - 14.3217).abs(),
        1e-4,
        "{:?}",
        lossless.steady_speed(choice.mean)
    );
    assert!(choice.averaged < lossless.steady_speed(choice.mean).unwrap());
}
