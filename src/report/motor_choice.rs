//! A motor chosen from a catalogue.

use crate::sentences;
use std::f64::consts::TAU;

use serde_json::json;

use super::drive::{limits_json, told};
use super::pretty::pretty;
use design::drive::motor::MotorChoice;
use linkage::drive::MotorLaw;
use prover::numbers::{fixed_in, quantity};
use scenario::Scenario;

fn rpm(omega: f64) -> f64 {
    omega * 60.0 / TAU
}

/// Torque at rest and slope of the chosen motor law.
fn line(choice: &MotorChoice) -> [f64; 2] {
    match choice.geared.law {
        MotorLaw::Linear { at_rest, slope } => [at_rest, slope],
        MotorLaw::Constant { .. } | MotorLaw::Kloss { .. } | MotorLaw::Table { .. } => [f64::NAN; 2],
    }
}

/// The choice as text, with the `[motor]` section for the scenario.
pub(crate) fn text(scenario: &Scenario, choice: &MotorChoice, width: usize) -> String {
    let (motor, geared) = (&choice.motor, &choice.geared);
    let [at_rest, slope] = line(choice);
    let mut text = format!("{}: {}\n\n", scenario.name, scenario.title);
    let (at, peak) = (fixed_in(choice.peak.0.to_degrees(), 4, "deg"), choice.peak.1);
    let wanted = choice.wanted;
    say!(
        text,
        sentences::power_peak_at_times_rad_kw(&quantity(peak, "N m"), &at, &wanted, &quantity(choice.power, "W"))
    );
    say!(text, sentences::asked_kw_with_an_efficiency(&quantity(choice.asked, "W"), &geared.efficiency));
    let [rated, synchronous, turning] = [motor.rated_speed, motor.synchronous_speed, wanted].map(rpm);
    let (name, kilowatts, torque) = (&motor.name, motor.power / 1e3, motor.rated_torque());
    say!(
        text,
        sentences::motor_kw_rpm_synchronous_rpm(&name, &kilowatts, &rated, &synchronous, &quantity(torque, "N m"))
    );
    say!(text, sentences::ratio_rpm_to_rpm(&geared.ratio, &rated, &turning));
    let share = |torque: f64| torque / motor.rated_torque();
    let [mean, peak] = [choice.mean_torque(), choice.peak_torque()];
    say!(text, sentences::on_the_motor_shaft_mean_of_the_rated(&quantity(mean, "N m"), &share(mean)));
    say!(text, sentences::peak_of_it_without_what_inertia(&quantity(peak, "N m"), &share(peak)));
    if let Some(breakdown) = motor.breakdown {
        let holds = if share(choice.peak_torque()) < breakdown { sentences::ABOVE_THE_PEAK } else { "BELOW THE PEAK" };
        say!(text, sentences::breakdown_of_it(&quantity(breakdown * motor.rated_torque(), "N m"), &breakdown, &holds));
    }
    let off = |omega: f64| 100.0 * (omega / choice.wanted - 1.0);
    let mean = choice.regime.mean_speed.abs();
    let (averaged, geared_up) = (choice.averaged, choice.averaged * geared.ratio);
    let [off_averaged, off_mean, unrest] = [off(averaged), off(mean), choice.regime.non_uniformity()];
    say!(text, sentences::steady_speed_averaged_crank_rad(&averaged, &off_averaged, &geared_up));
    say!(text, sentences::periodic_crank_rad_non_uniformity(&mean, &off_mean, &unrest));
    match motor.rotor {
        Some(rotor) => say!(text, sentences::rotor_inertia(&quantity(rotor, "kg m^2"))),
        None => say!(text, sentences::ROTOR_WITHOUT_INERTIA),
    }
    text += &told(&choice.limits(), width);
    say!(text, "\nFor the scenario:\n\n[motor] # {name}, {kilowatts} kW, {rated:.0} rpm\nlaw = \"linear\"");
    say!(text, "torque_at_rest_N_m = {at_rest:?}\nslope_N_m_s = {slope:?}");
    say!(
        text,
        sentences::ratio_efficiency(&format_args!("{:?}", geared.ratio), &format_args!("{:?}", geared.efficiency))
    );
    say!(text, "rated_torque_N_m = {torque:?}");
    if let Some(rotor) = motor.rotor {
        say!(text, "rotor_inertia_kg_m2 = {rotor:?}");
    }
    text
}

/// The choice as JSON, schema 1.
pub(crate) fn json(scenario: &Scenario, choice: &MotorChoice) -> String {
    let (motor, geared) = (&choice.motor, &choice.geared);
    let [at_rest, slope] = line(choice);
    pretty(&json!({
        "schema": 1, "scenario": scenario.name,
        "peak": {"crank_rad": choice.peak.0, "moment_N_m": choice.peak.1}, "mean_N_m": choice.mean,
        "wanted_rad_s": choice.wanted, "peak_W": choice.power, "asked_W": choice.asked,
        "motor": {
            "name": motor.name, "power_W": motor.power, "rated_rad_s": motor.rated_speed,
            "synchronous_rad_s": motor.synchronous_speed, "rated_N_m": motor.rated_torque(), "breakdown_ratio": motor.breakdown,
            "rotor_inertia_kg_m2": motor.rotor,
            "torque_at_rest_N_m": at_rest, "slope_N_m_s": slope,
        },
        "ratio": geared.ratio, "efficiency": geared.efficiency,
        "shaft_mean_N_m": choice.mean_torque(), "shaft_peak_N_m": choice.peak_torque(),
        "averaged_crank_rad_s": choice.averaged, "averaged_motor_rad_s": choice.averaged * geared.ratio,
        "motor_limits": limits_json(&choice.limits()),
        "steady_mean_rad_s": choice.regime.mean_speed, "non_uniformity": choice.regime.non_uniformity(),
    }))
}
