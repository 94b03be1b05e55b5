//! Mechanisms from closed forms.

use crate::sentences;
use serde_json::json;

use super::pretty::pretty;
use design::synthesize::crank_rocker::{CrankRocker, RockerExtreme};
use design::synthesize::slider_crank::SliderCrank;
use prover::numbers::fixed_in;

/// A result as text and as JSON.
pub(crate) struct Told {
    /// As text.
    pub(crate) text: String,
    /// As JSON, schema 1.
    pub(crate) json: String,
}

/// A crank-rocker with a rocker of the given length (m), and the verdict on its scenario.
pub(crate) fn crank_rocker(found: &CrankRocker, rocker: f64, proof: &str) -> Told {
    let mut text = String::from(sentences::CRANK_ROCKER_FROM_TWO_EXTREME_POSITIONS);
    let &CrankRocker { crank, coupler, transmission, time_ratio, .. } = found;
    say!(text, sentences::crank_oa_coupler_ab_rocker(&crank, &coupler, &rocker));
    for (name, extreme) in [("stretched", found.stretched), ("folded", found.folded)] {
        let [crank, rocker] = [extreme.crank, extreme.rocker].map(|angle| fixed_in(angle.to_degrees(), 6, "deg"));
        say!(text, sentences::crank_rocker(&name, &crank, &rocker));
    }
    let at = fixed_in(found.transmission_at.to_degrees(), 4, "deg");
    say!(text, sentences::transmission_deg_at_least_at_crank(&transmission.to_degrees(), &at));
    say!(text, sentences::time_ratio_mode(&time_ratio, &found.mode.name()));
    say!(text, sentences::proof_of_the_scenario(&proof));
    let extreme = |extreme: RockerExtreme| json!({"crank_rad": extreme.crank, "rocker_rad": extreme.rocker});
    let json = pretty(&json!({
        "schema": 1, "crank_m": found.crank, "coupler_m": found.coupler, "rocker_m": rocker,
        "stretched": extreme(found.stretched), "folded": extreme(found.folded), "mode": found.mode.name(),
        "transmission_rad": found.transmission, "transmission_crank_rad": found.transmission_at, "time_ratio": found.time_ratio,
        "proof": proof,
    }));
    Told { text, json }
}

/// A slider-crank, and the verdict on its scenario.
pub(crate) fn slider_crank(found: &SliderCrank, proof: &str) -> Told {
    let mut text = String::from(sentences::SLIDER_CRANK_FROM_STROKE_AND_OFFSET_2);
    say!(text, sentences::crank_rod(&found.crank, &found.rod));
    for (name, [crank, place]) in [("farthest", found.far), ("nearest", found.near)] {
        say!(text, sentences::crank_slider(&name, &fixed_in(crank.to_degrees(), 6, "deg"), &fixed_in(place, 6, "m")));
    }
    say!(text, sentences::pressure_deg_at_most_between_rod(&found.pressure.to_degrees()));
    say!(text, sentences::time_ratio(&found.time_ratio));
    say!(text, sentences::proof_of_the_scenario(&proof));
    let end = |[crank, place]: [f64; 2]| json!({"crank_rad": crank, "slider_m": place});
    let json = pretty(&json!({
        "schema": 1, "crank_m": found.crank, "rod_m": found.rod, "farthest": end(found.far), "nearest": end(found.near),
        "pressure_rad": found.pressure, "time_ratio": found.time_ratio, "proof": proof,
    }));
    Told { text, json }
}
