//! Four-bars through precision points.

use crate::sentences;
use serde_json::{Value, json};

use super::closed_form::Told;
use super::pretty::{list, pretty};
use crate::plain::cells::table;
use design::synthesize::precision::{CrankTravel, FourBarChecks, PrecisionFourBar, PrecisionSynthesis};
use linkage::math::Complex;
use prover::numbers::{fixed, significant};

/// Decimals of angles in degrees.
const DECIMALS: usize = 4;

/// The four-bars found for a `task`. The four-bar at index `taken` was written and proven; `proof` is its verdict.
pub(crate) fn precision(task: &str, found: &PrecisionSynthesis, taken: usize, proof: &str) -> Told {
    let own = &found.best[taken];
    let mut text = format!("{task}\n");
    say!(text, sentences::four_bars_pass_all(&found.found, &found.keep_branch, &found.keep_order, &found.turn_fully));
    if found.is_scanned {
        say!(text, sentences::FREE_ROTATIONS_WERE_SCANNED);
    }
    let rows = found.best.iter().enumerate().map(|(index, own)| {
        let [frame, crank, coupler, rocker] = own.checks.lengths.map(|length| significant(length * 1e3, 6));
        let angle = fixed(own.checks.transmission.to_degrees(), 2);
        [
            (index + 1).to_string(),
            frame,
            crank,
            coupler,
            rocker,
            kind(&own.checks).into(),
            angle,
            defect(&own.checks).into(),
        ]
    });
    let header =
        "no.> | frame\nmm> | crank\nmm> | coupler\nmm> | rocker\nmm> | type | transmission\nat least, deg> | defect";
    say!(text, "\n{}\n", table(header).add_rows(rows));
    say!(text, sentences::four_bar_of_the_table(&(taken + 1)));
    let [[o, c], [a, b]] = [own.pivots, own.pins].map(|pair| pair.map(at));
    say!(text, sentences::pivots_and_pins(&o, &c, &a, &b));
    if let Some(point) = own.point {
        let local = at(own.frames[1].local(point));
        let [a, b] = own.pins.map(|pin| at(own.frames[1].local(pin)));
        say!(text, sentences::points_of_the_coupler(&local, &a, &b));
    }
    let cranks: Vec<String> = angles(own).map(|angle| fixed(angle.to_degrees(), DECIMALS)).collect();
    say!(text, sentences::crank_at_the_positions(&cranks.join(", ")));
    say!(text, sentences::travel_of_the_crank(&travel(own)));
    say!(text, sentences::transmission_and_mode(&own.checks.transmission.to_degrees(), &own.checks.mode.name()));
    say!(text, sentences::proof_of_the_scenario(&proof));
    let json = pretty(&json!({
        "schema": 1, "task": task, "found": found.found, "keep_branch": found.keep_branch,
        "keep_order": found.keep_order, "turn_fully": found.turn_fully, "is_scanned": found.is_scanned,
        "four_bars": list(&found.best, four_bar), "taken": taken + 1, "proof": proof,
    }));
    Told { text, json }
}

/// Grashof's type in one word.
fn kind(checks: &FourBarChecks) -> &'static str {
    checks.of_type.name().split([' ', ',']).next().unwrap_or_default()
}

fn defect(checks: &FourBarChecks) -> &'static str {
    match (checks.keeps_branch, checks.keeps_order) {
        (false, _) => "branch",
        (true, false) => "order",
        (true, true) => "-",
    }
}

/// A point in millimetres.
fn at(point: Complex) -> String {
    format!("({}, {})", significant(point.re * 1e3, 7), significant(point.im * 1e3, 7))
}

/// Crank angles at the positions (rad).
fn angles(own: &PrecisionFourBar) -> impl Iterator<Item = f64> + '_ {
    own.crank_turns.iter().map(|turn| own.frames[0].angle + turn)
}

fn travel(own: &PrecisionFourBar) -> String {
    match own.checks.travel {
        CrankTravel::FullTurn { sense } if sense < 0.0 => sentences::FULL_TURN_CLOCKWISE.into(),
        CrankTravel::FullTurn { .. } => sentences::FULL_TURN_COUNTER_CLOCKWISE.into(),
        CrankTravel::Between(ends) => {
            let [from, to] = ends.map(|end| fixed((own.frames[0].angle + end).to_degrees(), DECIMALS));
            sentences::from_to_deg(&from, &to)
        }
    }
}

fn four_bar(own: &PrecisionFourBar) -> Value {
    let [frame, crank, coupler, rocker] = own.checks.lengths;
    let pair = |point: Complex| [point.re, point.im];
    json!({
        "frame_m": frame, "crank_m": crank, "coupler_m": coupler, "rocker_m": rocker, "type": kind(&own.checks),
        "mode": own.checks.mode.name(), "transmission_rad": own.checks.transmission, "length_ratio": own.checks.ratio,
        "keeps_branch": own.checks.keeps_branch, "keeps_order": own.checks.keeps_order,
        "turns_fully": own.checks.turns_fully(), "pivots_m": own.pivots.map(pair), "pins_m": own.pins.map(pair),
        "point_m": own.point.map(pair), "crank_rad": angles(own).collect::<Vec<_>>(),
    })
}
