//! The cheapest settings of an engine that reach a required accuracy.

use crate::sentences;
use std::path::Path;

use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::cells::{table, trimmed};
use lab::tune::{Candidate, Tuning};
use linkage::engine::Settings;
use prover::numbers;
use scenario::Scenario;

/// The `[engine]` section that a scenario needs for the best settings.
pub(crate) struct Section<'a> {
    /// Text of the section.
    pub(crate) text: &'a str,
    /// The scenario's file.
    pub(crate) file: &'a Path,
    /// Whether the section has been written to the scenario's file.
    pub(crate) is_written: bool,
}

/// How the user can continue, in the words of the calling program.
#[derive(Clone, Copy)]
pub(crate) struct Hints<'a> {
    /// For the name of an engine, this function returns the command that shows why the engine cannot run.
    pub(crate) why: &'a dyn Fn(&str) -> String,
    /// Option or function that writes the section, such as `--write`.
    pub(crate) write: &'a str,
}

/// The settings as text.
/// `within` is the largest allowed error, as a fraction of each channel's scale.
pub(crate) fn text(scenario: &Scenario, found: &Tuning, within: f64, section: &Section, hints: Hints) -> String {
    let rows = found.by_engine.iter().map(|candidate| {
        let Settings { resolution, sweeps, substeps, route, extrapolated } = candidate.settings;
        [
            candidate.engine.to_string(),
            numbers::significant(resolution, 4),
            sweeps.to_string(),
            substeps.to_string(),
            extrapolated.to_string(),
            route.name().to_string(),
            numbers::significant(candidate.verified, 3),
            candidate.worst.clone(),
            numbers::fixed(candidate.price / found.best.price, 2),
        ]
    });
    let header = "engine | step> | sweeps> | substeps> | extrapolated | method | error> | worst channel | cost>";
    let table = trimmed(table(header).add_rows(rows));
    let mut text = format!("{}: {}\n\n", scenario.name, scenario.title);
    let within = numbers::error(within);
    say!(text, sentences::the_cheapest_settings_within_of_every_channel(&within, &table));
    for (name, error) in &found.too_coarse {
        match error.is_finite() {
            true => say!(text, sentences::does_not_meet_it_its_smallest(&name, &numbers::error(*error))),
            false => say!(text, sentences::does_not_run_it_with_any(&name, &(hints.why)(name))),
        };
    }
    for name in &found.too_dear {
        say!(text, sentences::costs_more_than_the_cheapest(&name));
    }
    let ([error, expected], runs) = ([found.best.verified, found.predicted].map(numbers::error), found.runs);
    let engine = found.best.engine;
    say!(text, sentences::error_measured_against_the_reference(&engine, &error, &expected, &runs));
    match found.best.is_proven {
        true if found.cheapest.price < found.best.price => {
            let Settings { resolution, sweeps, .. } = found.cheapest.settings;
            let (share, name) = (found.cheapest.price / found.best.price, found.cheapest.engine);
            let step = numbers::significant(resolution, 4);
            put!(text, sentences::a_proof_at_these_settings_agrees_at_with_sweeps(&name, &step, &sweeps));
            say!(text, sentences::of_the_price_but_proves_less(&share))
        }
        true => say!(text, sentences::A_PROOF_AT_THESE_SETTINGS_AGREES),
        false => say!(text, sentences::A_PROOF_AT_THESE_SETTINGS),
    };
    if found.is_spent {
        say!(text, sentences::THE_WORK_THAT_WAS_ALLOWED_IS_DONE);
    }
    let Section { text: section, file, is_written } = section;
    let place = file.display();
    match is_written {
        true => say!(text, "\nWritten to {place}:\n\n{section}"),
        false => say!(text, sentences::for_or_let_put_it_there(&place, &hints.write, &section)),
    };
    text
}

/// The settings as JSON, schema 1.
pub(crate) fn json(scenario: &Scenario, found: &Tuning, within: f64) -> String {
    let candidate = |candidate: &Candidate| {
        let Settings { resolution, sweeps, substeps, route, extrapolated } = candidate.settings;
        let key = if candidate.controls_error { "accuracy" } else { "dt_s" };
        json!({
            "engine": candidate.engine, key: resolution, "sweeps": sweeps,
            "substeps": substeps, "route": route.name(), "extrapolated": extrapolated,
            "error": candidate.verified, "worst_channel": candidate.worst, "price_of_best": candidate.price / found.best.price,
            "proven": candidate.is_proven,
        })
    };
    let coarse = list(&found.too_coarse, |(name, error)| json!({"engine": name, "smallest_error": error}));
    pretty(&json!({
        "schema": 1, "scenario": scenario.name, "within": within, "runs": found.runs,
        "best": candidate(&found.best), "expected_error": found.predicted,
        "engines": list(&found.by_engine, candidate), "too_coarse": coarse, "too_dear": found.too_dear,
        "spent": found.is_spent,
    }))
}
