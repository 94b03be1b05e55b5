//! Largest reactions over the range of the grid, and the smallest journals that carry them.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::cells::{fitted, trimmed};
use design::bearings::{Peak, Peaks, journal_diameter};
use linkage::input::Input;
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
    let input = scenario.case.crank().input;
    let shown = |peak: Peak| numbers::fixed(input.shown(peak.crank), 4);
    let joints = scenario.case.mechanism.joints().iter().enumerate();
    let rows = joints.map(|(index, joint)| {
        let reaction = peaks.reactions[index];
        let journal = || numbers::fixed_in(1e3 * diameter(journals, reaction), 3, "mm");
        let [journal, moment, at] = peaks.moments[index].map_or_else(
            || [journal(), String::new(), String::new()],
            |moment| ["slider".into(), numbers::quantity(moment.value, "N m"), shown(moment)],
        );
        let largest = numbers::quantity(reaction.value, "N");
        [joint.name.clone(), largest, shown(reaction), journal, moment, at]
    });
    let at = format!("at {}\n{}", input.word(), input.shown_in().0);
    let header = format!("joint | largest\nreaction> | {at}> | smallest\njournal> | largest\nmoment> | {at}>");
    let table = trimmed(fitted(&header, width).add_rows(rows));
    let mut text = format!("{}: {}\n\n{table}\n\n", scenario.name, scenario.title);
    let (of_first, unit) = effort(input);
    let mut rows =
        vec![("shaking force".into(), peaks.shaking_force, "N"), (of_first.into(), peaks.balancing_moment, unit)];
    for (drive, &peak) in scenario.case.drives.further().iter().zip(&peaks.further_drives) {
        let (effort, unit) = effort(drive.input);
        rows.push((format!("{effort} of {}", scenario.case.mechanism.joints()[drive.joint].name), peak, unit));
    }
    for (transmission, &peak) in scenario.case.mechanism.transmissions().iter().zip(&peaks.transmissions) {
        rows.push((format!("force of {}", transmission.name()), peak, "N"));
    }
    for (name, peak, unit) in rows {
        let at = numbers::input_in(input.at(peak.crank), 4);
        say!(text, sentences::largest_at(&name, &numbers::quantity(peak.value, unit), &at));
    }
    say!(text, sentences::journals_lever_mm_bending_stress(&journals.lever_mm, &journals.stress_mpa));
    if !peaks.frictions.is_empty() {
        text += &frictions(peaks, width);
    }
    text
}

/// The friction of every joint and transmission, its work over the grid, and the efficiency.
fn frictions(peaks: &Peaks, width: Option<usize>) -> String {
    let lost: f64 = peaks.frictions.iter().map(|own| own.work).sum();
    let rows = peaks.frictions.iter().map(|own| {
        let unit = if own.is_force { "N" } else { "N m" };
        let share = if lost > 0.0 { 100.0 * own.work / lost } else { 0.0 };
        [
            own.name.clone(),
            numbers::quantity(own.largest, unit),
            numbers::quantity(own.work, "J"),
            numbers::fixed_in(share, 1, "%"),
            if own.is_mesh { "-".into() } else { numbers::quantity(own.pressure_speed, "W") },
        ]
    });
    let header =
        "joint or\ntransmission | largest\nfriction> | work over\nthe grid> | share> | largest force\nx sliding speed>";
    let mut text = format!("\n{}\n\n", trimmed(fitted(header, width).add_rows(rows)));
    let [drive, lost] = [peaks.drive_work, lost].map(|work| numbers::quantity(work, "J"));
    say!(text, sentences::work_of_the_drives(&drive, &lost));
    if let Some(efficiency) = peaks.efficiency() {
        say!(text, sentences::efficiency_over_the_grid(&numbers::fixed_in(100.0 * efficiency, 2, "%")));
    }
    text
}

/// Name and unit of the moment or force of a drive with this input.
fn effort(input: Input) -> (&'static str, &'static str) {
    match input {
        Input::Angle | Input::Turn => ("balancing moment", "N m"),
        Input::Slide => ("driving force", "N"),
    }
}

/// The largest reactions as JSON, schema 1.
pub(crate) fn json(journals: Journals, scenario: &Scenario, peaks: &Peaks) -> String {
    let input = scenario.case.crank().input;
    let whole = |peak: Peak, unit: &str| json!({unit: peak.value, input.key(): peak.crank});
    let keys = |input: Input| <[&str; 2]>::from(effort(input)).map(|name| name.replace(' ', "_"));
    let [effort, unit] = keys(input);
    let joints = list(scenario.case.mechanism.joints().iter().enumerate(), |(index, joint)| {
        json!({
            "joint": joint.name, "reaction": whole(peaks.reactions[index], "N"),
            "moment": peaks.moments[index].map(|moment| whole(moment, "N_m")),
            "smallest_journal_m": joint.is_pin().then(|| diameter(journals, peaks.reactions[index])),
        })
    });
    let joints_of = scenario.case.mechanism.joints();
    let further = scenario.case.drives.further().iter().zip(&peaks.further_drives);
    let transmissions = scenario.case.mechanism.transmissions().iter().zip(&peaks.transmissions);
    pretty(&json!({
        "schema": 1, "scenario": scenario.name, "lever_m": journals.lever_mm * 1e-3,
        "stress_Pa": journals.stress_mpa * 1e6, "joints": joints, "shaking_force": whole(peaks.shaking_force, "N"),
        effort: whole(peaks.balancing_moment, &unit),
        "further_drives": list(further, |(drive, &peak)| {
            let [name, unit] = keys(drive.input);
            json!({"joint": joints_of[drive.joint].name, name: whole(peak, &unit)})
        }),
        "transmissions": list(transmissions, |(own, &peak)| json!({"name": own.name(), "force": whole(peak, "N")})),
        "drive_work_J": peaks.drive_work, "efficiency": peaks.efficiency(),
        "friction": list(&peaks.frictions, |own| json!({
            (if own.is_mesh { "transmission" } else { "joint" }): own.name, "work_J": own.work,
            "pressure_speed_W": (!own.is_mesh).then_some(own.pressure_speed),
            (if own.is_force { "largest_N" } else { "largest_N_m" }): own.largest,
        })),
    }))
}
