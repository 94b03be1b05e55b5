//! Largest reactions over the range of the grid, and the smallest journals that carry them.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::cells::{fitted, trimmed};
use design::bearings::{Peak, Peaks, journal_diameter};
use prover::numbers;
use scenario::Scenario;

/// Lever and stress for which the journals are chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Journals {
    /// Lever of the reaction on its journal (mm).
    pub(crate) lever_mm: f64,
    /// Bending stress that the journals may carry (MPa).
    pub(crate) stress_mpa: f64,
}

fn diameter(journals: Journals, peak: Peak) -> f64 {
    journal_diameter(peak.value, journals.lever_mm * 1e-3, journals.stress_mpa * 1e6)
}

/// The largest reactions as text.
pub(crate) fn text(journals: Journals, scenario: &Scenario, peaks: &Peaks, width: Option<usize>) -> String {
    let degrees = |peak: Peak| numbers::fixed(peak.crank.to_degrees(), 4);
    let joints = scenario.case.mechanism.joints().iter().enumerate();
    let rows = joints.map(|(index, joint)| {
        let reaction = peaks.reactions[index];
        let journal = || numbers::fixed_in(1e3 * diameter(journals, reaction), 3, "mm");
        let [journal, moment, at] = peaks.moments[index].map_or_else(
            || [journal(), String::new(), String::new()],
            |moment| ["slider".into(), numbers::quantity(moment.value, "N m"), degrees(moment)],
        );
        let largest = numbers::quantity(reaction.value, "N");
        [joint.name.clone(), largest, degrees(reaction), journal, moment, at]
    });
    let header = "joint | largest\nreaction> | at crank\ndeg> | smallest\njournal> | largest\nmoment> | at crank\ndeg>";
    let table = trimmed(fitted(header, width).add_rows(rows));
    let mut text = format!("{}: {}\n\n{table}\n\n", scenario.name, scenario.title);
    for (name, peak, unit) in
        [("shaking force", peaks.shaking_force, "N"), ("balancing moment", peaks.balancing_moment, "N m")]
    {
        say!(text, sentences::largest_at_deg(&name, &numbers::quantity(peak.value, unit), &degrees(peak)));
    }
    say!(text, sentences::journals_lever_mm_bending_stress(&journals.lever_mm, &journals.stress_mpa));
    text
}

/// The largest reactions as JSON, schema 1.
pub(crate) fn json(journals: Journals, scenario: &Scenario, peaks: &Peaks) -> String {
    let whole = |peak: Peak, unit: &str| json!({unit: peak.value, "crank_rad": peak.crank});
    let joints = list(scenario.case.mechanism.joints().iter().enumerate(), |(index, joint)| {
        json!({
            "joint": joint.name, "reaction": whole(peaks.reactions[index], "N"),
            "moment": peaks.moments[index].map(|moment| whole(moment, "N_m")),
            "smallest_journal_m": joint.is_pin().then(|| diameter(journals, peaks.reactions[index])),
        })
    });
    pretty(&json!({
        "schema": 1, "scenario": scenario.name, "lever_m": journals.lever_mm * 1e-3,
        "stress_Pa": journals.stress_mpa * 1e6, "joints": joints, "shaking_force": whole(peaks.shaking_force, "N"),
        "balancing_moment": whole(peaks.balancing_moment, "N_m"),
    }))
}
