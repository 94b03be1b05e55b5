//! A motor chosen from a catalogue.

use std::f64::consts::TAU;

use serde_json::json;

use super::pretty::pretty;
use crate::numbers::fixed_in;
use crate::scenario::Scenario;
use linkage::drive::MotorLaw;
use workshop::motor::Choice;

fn rpm(omega: f64) -> f64 {
    omega * 60.0 / TAU
}

/// Torque at rest and slope of the chosen motor law.
fn line(choice: &Choice) -> [f64; 2] {
    match choice.geared.law {
        MotorLaw::Linear { at_rest, slope } => [at_rest, slope],
        MotorLaw::Constant { .. } | MotorLaw::Kloss { .. } | MotorLaw::Table { .. } => [f64::NAN; 2],
    }
}

/// The choice as text, with the `[motor]` section for the scenario.
pub(crate) fn text(scenario: &Scenario, choice: &Choice) -> String {
    let (motor, geared) = (&choice.motor, &choice.geared);
    let [at_rest, slope] = line(choice);
    let mut text = format!("{}: {}\n\n", scenario.name, scenario.title);
    say!(
        text,
        "power\n  peak      {:.6} N m at {}, times {:.6} rad/s: {:.6} kW\n  asked     {:.6} kW with an efficiency of {}",
        choice.peak.1,
        fixed_in(choice.peak.0.to_degrees(), 4, "deg"),
        choice.wanted,
        choice.power / 1e3,
        choice.asked / 1e3,
        geared.efficiency
    );
    say!(
        text,
        "motor\n  {}: {} kW, {:.0} rpm, synchronous {:.0} rpm, rated torque {:.4} N m\n  ratio     {:.6} ({:.0} rpm to {:.4} rpm)",
        motor.name,
        motor.power / 1e3,
        rpm(motor.rated_speed),
        rpm(motor.synchronous_speed),
        motor.rated_torque(),
        geared.ratio,
        rpm(motor.rated_speed),
        rpm(choice.wanted)
    );
    let share = |torque: f64| torque / motor.rated_torque();
    say!(
        text,
        "on the motor's shaft\n  mean      {:.4} N m, {:.3} of the rated torque\n  peak      {:.4} N m, {:.3} of it, without what inertia carries",
        choice.mean_torque(),
        share(choice.mean_torque()),
        choice.peak_torque(),
        share(choice.peak_torque())
    );
    if let Some(breakdown) = motor.breakdown {
        let holds = if share(choice.peak_torque()) < breakdown { "above the peak" } else { "BELOW THE PEAK" };
        say!(text, "  breakdown {:.4} N m, {breakdown} of it: {holds}", breakdown * motor.rated_torque());
    }
    let off = |omega: f64| 100.0 * (omega / choice.wanted - 1.0);
    let mean = choice.regime.mean_speed.abs();
    say!(
        text,
        "steady speed\n  averaged  crank {:.6} rad/s ({:+.2} % of the wanted), motor {:.4} rad/s\n  periodic  crank {mean:.6} rad/s ({:+.2} %), \
         non-uniformity {:.4}",
        choice.averaged,
        off(choice.averaged),
        choice.averaged * geared.ratio,
        off(mean),
        choice.regime.non_uniformity()
    );
    say!(
        text,
        "\nFor the scenario:\n\n[motor] # {}, {} kW, {:.0} rpm\nlaw = \"linear\"\ntorque_at_rest_N_m = {at_rest:?}\nslope_N_m_s = {slope:?}\nratio = {:?}\nefficiency = {:?}",
        motor.name,
        motor.power / 1e3,
        rpm(motor.rated_speed),
        geared.ratio,
        geared.efficiency
    );
    text
}

/// The choice as JSON, schema 1.
pub(crate) fn json(scenario: &Scenario, choice: &Choice) -> String {
    let (motor, geared) = (&choice.motor, &choice.geared);
    let [at_rest, slope] = line(choice);
    let value = json!({
        "schema": 1, "scenario": scenario.name,
        "peak": {"crank_rad": choice.peak.0, "moment_N_m": choice.peak.1}, "mean_N_m": choice.mean,
        "wanted_rad_s": choice.wanted, "peak_W": choice.power, "asked_W": choice.asked,
        "motor": {
            "name": motor.name, "power_W": motor.power, "rated_rad_s": motor.rated_speed,
            "synchronous_rad_s": motor.synchronous_speed, "rated_N_m": motor.rated_torque(), "breakdown_ratio": motor.breakdown,
            "torque_at_rest_N_m": at_rest, "slope_N_m_s": slope,
        },
        "ratio": geared.ratio, "efficiency": geared.efficiency,
        "shaft_mean_N_m": choice.mean_torque(), "shaft_peak_N_m": choice.peak_torque(),
        "averaged_crank_rad_s": choice.averaged, "averaged_motor_rad_s": choice.averaged * geared.ratio,
        "steady_mean_rad_s": choice.regime.mean_speed, "non_uniformity": choice.regime.non_uniformity(),
    });
    pretty(&value)
}
