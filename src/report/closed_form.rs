//! Mechanisms found in closed form.

use serde_json::json;

use super::pretty::pretty;
use design::synthesis::crank_rocker::{CrankRocker, Extreme};
use design::synthesis::slider_crank::SliderCrank;
use prover::numbers::fixed_in;

/// A result as text and as JSON.
#[derive(Debug)]
pub(crate) struct Told {
    /// As text.
    pub(crate) text: String,
    /// As JSON, schema 1.
    pub(crate) json: String,
}

/// A crank-rocker with a rocker of the given length (m).
pub(crate) fn crank_rocker(found: &CrankRocker, rocker: f64) -> Told {
    let mut text = String::from("crank-rocker from two extreme positions\n");
    let &CrankRocker { crank, coupler, transmission, time_ratio, .. } = found;
    say!(text, "  crank OA      {crank:.15} m\n  coupler AB    {coupler:.15} m\n  rocker CB     {rocker:.15} m");
    for (name, extreme) in [("stretched", found.stretched), ("folded", found.folded)] {
        let [crank, rocker] = [extreme.crank, extreme.rocker].map(|angle| fixed_in(angle.to_degrees(), 9, "deg"));
        say!(text, "  {name:13} crank {crank}, rocker {rocker}");
    }
    let at = fixed_in(found.transmission_at.to_degrees(), 4, "deg");
    say!(text, "  transmission  {:.4} deg at least, at crank {at}", transmission.to_degrees());
    say!(text, "  time ratio    {time_ratio:.6}\n  mode          {}", found.mode.name());
    let extreme = |extreme: Extreme| json!({"crank_rad": extreme.crank, "rocker_rad": extreme.rocker});
    let json = pretty(&json!({
        "schema": 1, "crank_m": found.crank, "coupler_m": found.coupler, "rocker_m": rocker,
        "stretched": extreme(found.stretched), "folded": extreme(found.folded), "mode": found.mode.name(),
        "transmission_rad": found.transmission, "transmission_crank_rad": found.transmission_at, "time_ratio": found.time_ratio,
    }));
    Told { text, json }
}

/// A slider-crank.
pub(crate) fn slider_crank(found: &SliderCrank) -> Told {
    let mut text = String::from("slider-crank from stroke and offset\n");
    say!(text, "  crank         {:.15} m\n  rod           {:.15} m", found.crank, found.rod);
    for (name, [crank, place]) in [("farthest", found.far), ("nearest", found.near)] {
        say!(text, "  {name:13} crank {}, slider {}", fixed_in(crank.to_degrees(), 9, "deg"), fixed_in(place, 12, "m"));
    }
    say!(text, "  pressure      {:.4} deg at most between rod and slider's line", found.pressure.to_degrees());
    say!(text, "  time ratio    {:.6}", found.time_ratio);
    let end = |[crank, place]: [f64; 2]| json!({"crank_rad": crank, "slider_m": place});
    let json = pretty(&json!({
        "schema": 1, "crank_m": found.crank, "rod_m": found.rod, "farthest": end(found.far), "nearest": end(found.near),
        "pressure_rad": found.pressure, "time_ratio": found.time_ratio,
    }));
    Told { text, json }
}
