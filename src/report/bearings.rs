//! Largest reactions over the range of the grid, and the smallest journals that carry them.

use serde_json::json;

use super::pretty::pretty;
use crate::plain::cells::{table, trimmed};
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
pub(crate) fn text(journals: Journals, scenario: &Scenario, peaks: &Peaks) -> String {
    let header = ["joint", "largest reaction", "at crank deg", "smallest journal", "largest moment", "at crank deg"];
    let mut table = table(header, &[1, 2, 3, 4, 5]);
    let degrees = |peak: Peak| numbers::fixed(peak.crank.to_degrees(), 4);
    for (index, joint) in scenario.case.mechanism.joints().entries() {
        let reaction = peaks.reactions[index];
        let mut row = vec![joint.name.clone(), numbers::fixed_in(reaction.value, 6, "N"), degrees(reaction)];
        match peaks.moments[index] {
            None => row.extend([
                numbers::fixed_in(1e3 * diameter(journals, reaction), 3, "mm"),
                String::new(),
                String::new(),
            ]),
            Some(moment) => row.extend(["slider".into(), numbers::fixed_in(moment.value, 6, "N m"), degrees(moment)]),
        }
        table.add_row(row);
    }
    let mut text = format!("{}: {}\n\n{}\n\n", scenario.name, scenario.title, trimmed(&table));
    for (name, peak, unit) in
        [("shaking force", peaks.shaking_force, "N"), ("balancing moment", peaks.balancing_moment, "N m")]
    {
        say!(text, "largest {name:16} {:.6} {unit} at {} deg", peak.value, degrees(peak));
    }
    say!(text, "\njournals: lever {} mm, bending stress {} MPa", journals.lever_mm, journals.stress_mpa);
    text
}

/// The largest reactions as JSON, schema 1.
pub(crate) fn json(journals: Journals, scenario: &Scenario, peaks: &Peaks) -> String {
    let whole = |peak: Peak, unit: &str| json!({unit: peak.value, "crank_rad": peak.crank});
    let joints = scenario.case.mechanism.joints().entries().map(|(index, joint)| {
        json!({
            "joint": joint.name, "reaction": whole(peaks.reactions[index], "N"),
            "moment": peaks.moments[index].map(|moment| whole(moment, "N_m")),
            "smallest_journal_m": joint.is_pin().then(|| diameter(journals, peaks.reactions[index])),
        })
    });
    let value = json!({
        "schema": 1, "scenario": scenario.name, "lever_m": journals.lever_mm * 1e-3, "stress_Pa": journals.stress_mpa * 1e6,
        "joints": joints.collect::<Vec<_>>(), "shaking_force": whole(peaks.shaking_force, "N"),
        "balancing_moment": whole(peaks.balancing_moment, "N_m"),
    });
    pretty(&value)
}
