//! The range in which a mechanism can be followed: limits, singular and extreme positions, transmission angles.

use crate::sentences;
use std::f64::consts::TAU;

use serde_json::{Value, json};

use super::pretty::list;
use crate::plain::cells::{at_column, fitted, trimmed, worded};
use analytic::range::{Extent, ExtremePosition, GroupCondition, LinkRange, Range, Singularity, ValueAtCrank};
use linkage::input::Input;
use linkage::mechanism::GroupId;
use prover::numbers;
use scenario::Scenario;

/// Number of extreme positions of one link that are shown in full; further positions are only counted.
const EXTREMES: usize = 8;

/// The range as text.
pub(crate) fn text(scenario: &Scenario, range: &Range, width: Option<usize>) -> String {
    let mut text = format!("{}: {}\n", scenario.name, scenario.title);
    let input = scenario.case.crank().input;
    say!(text, "{:11}{}", input.word(), extent(range, input));
    if let Some(four_bar) = &range.four_bar {
        let [frame, driver, coupler, output] = four_bar.lengths;
        say!(text, "four-bar   {}", four_bar.of_type.name());
        say!(text, sentences::frame_driving_link_coupler_output(&frame, &driver, &coupler, &output));
    }
    say!(text, "\n{}", singularities(scenario, range, width));
    say!(text, sentences::groups_nearest_to_a_singular(&groups(scenario, range, width)));
    say!(text, "\nLinks:\n{}", links(scenario, range, width));
    text
}

fn extent(range: &Range, input: Input) -> String {
    match range.extent {
        Extent::FullTurn(1) => "turns fully".into(),
        Extent::FullTurn(turns) => sentences::turns_fully_the_mechanism_is_back(&turns),
        Extent::Limited([from, to]) => {
            let span = numbers::fixed(input.shown(to.crank - from.crank), 6);
            let [from, to] = [from, to].map(|end| shown(end.crank, range, input));
            sentences::from_to_in_all(&from, &to, &span, &input.shown_in().0)
        }
    }
}

/// A value of the input. If the pose repeats after one turn of the crank, the angle is reduced to the first turn.
fn shown(crank: f64, range: &Range, input: Input) -> String {
    numbers::fixed(input.shown(in_turn(crank, range)), 6)
}

fn in_turn(crank: f64, range: &Range) -> f64 {
    match range.extent {
        // If rounding puts an angle just below a whole revolution, it is shown as zero.
        Extent::FullTurn(1) => (crank + 1e-12).rem_euclid(TAU) - 1e-12,
        Extent::FullTurn(_) | Extent::Limited(_) => crank,
    }
}

fn names(scenario: &Scenario, group: GroupId) -> String {
    scenario.case.structure.groups[group].names(&scenario.case.mechanism)
}

/// Transmission angle (rad) of a group from the group's determinant; `None` if the group is not a dyad.
fn transmission(scenario: &Scenario, group: GroupId, determinant: f64) -> Option<f64> {
    scenario.case.structure.groups[group].kind.letters().map(|_| determinant.abs().asin())
}

fn singularities(scenario: &Scenario, range: &Range, width: Option<usize>) -> String {
    if range.singularities.is_empty() {
        return sentences::NO_SINGULAR_POSE_ON_THE_WAY.into();
    }
    let input = scenario.case.crank().input;
    let rows = range.singularities.iter().map(|Singularity { kind, crank, group, determinant }| {
        let (crank, determinant) = (shown(*crank, range, input), numbers::significant(*determinant, 2));
        [kind.name().to_string(), crank, determinant, names(scenario, *group)]
    });
    let header = format!("singular pose | {}, {}> | determinant> | group", input.word(), input.shown_in().0);
    format!("{}\n", trimmed(worded(&header, width).add_rows(rows)))
}

fn groups(scenario: &Scenario, range: &Range, width: Option<usize>) -> String {
    let input = scenario.case.crank().input;
    let rows = range.groups.entries().map(|(index, group)| {
        let ValueAtCrank { crank, value } = group.determinant;
        let transmission = transmission(scenario, index, value);
        let transmission = transmission.map_or("-".into(), |angle| numbers::fixed(angle.to_degrees(), 4));
        let (condition, at) = match group.condition {
            Some(worst) => (numbers::fixed(worst.value, 4), shown(worst.crank, range, input)),
            None => ("unbounded".into(), shown(crank, range, input)),
        };
        let (least, crank) = (numbers::fixed(value, 6), shown(crank, range, input));
        [names(scenario, index), least, transmission, crank, condition, at]
    });
    let at = at_column(input.noun(), input.shown_in().0);
    let header =
        format!("group | smallest\ndeterminant> | transmission\nangle, deg> | {at}> | largest\ncondition> | {at}>");
    trimmed(fitted(&header, width).add_rows(rows))
}

fn links(scenario: &Scenario, range: &Range, width: Option<usize>) -> String {
    let input = scenario.case.crank().input;
    let rows = range.links.iter().map(|link| {
        // If a link rotates fully, the interval of its angle has no meaning and is not shown.
        let end =
            |at: ValueAtCrank| if link.turns == 0 { numbers::fixed(at.value.to_degrees(), 6) } else { "-".into() };
        let [least, most] = link.angles.map(end);
        let name = scenario.case.mechanism.links()[link.link].name.clone();
        [name, motion(link), least, most, positions(&link.extremes, range, input)]
    });
    let (noun, unit) = (input.noun(), input.shown_in().0);
    let header = format!("link | motion | from, deg> | to, deg> | extreme positions, at {noun}, {unit}");
    trimmed(worded(&header, width).add_rows(rows))
}

fn motion(link: &LinkRange) -> String {
    let swing = (link.angles[1].value - link.angles[0].value).to_degrees();
    match link.turns {
        0 if swing < 1e-9 => sentences::DOES_NOT_TURN.into(),
        0 => sentences::over_deg(&swing),
        1 | -1 => "turns fully".into(),
        turns => sentences::turns_fully_times(&turns.abs()),
    }
}

fn positions(extremes: &[ExtremePosition], range: &Range, input: Input) -> String {
    let one = |extreme: &ExtremePosition| {
        let word = if extreme.is_greatest { "greatest" } else { "smallest" };
        let at = shown(extreme.crank, range, input);
        format!("{} ({word}, {at})", numbers::fixed(extreme.angle.to_degrees(), 6))
    };
    let more = extremes.len().saturating_sub(EXTREMES);
    let more = (more > 0).then(|| sentences::and_more(&more));
    extremes.iter().take(EXTREMES).map(one).chain(more).collect::<Vec<_>>().join("\n")
}

/// The range as JSON.
pub(super) fn json(scenario: &Scenario, range: &Range) -> Value {
    let input = scenario.case.crank().input;
    let at = |at: &ValueAtCrank, key: &str| json!({input.key(): at.crank, key: at.value});
    let [from_key, to_key] = ["from", "to"].map(|end| format!("{end}_{}", input.unit()));
    let extent = match range.extent {
        Extent::FullTurn(turns) => json!({"full_turn": true, "turns_to_same_pose": turns}),
        Extent::Limited([from, to]) => json!({"full_turn": false, from_key: from.crank, to_key: to.crank}),
    };
    let singularities = list(&range.singularities, |own| {
        json!({
            "kind": own.kind.name(), input.key(): own.crank, "group": names(scenario, own.group),
            "determinant": own.determinant,
            "transmission_angle_rad": transmission(scenario, own.group, own.determinant),
        })
    });
    let groups = list(range.groups.entries(), |(index, group)| {
        let mut value = json!({
            "links": names(scenario, index), "least_determinant": at(&group.determinant, "determinant"),
            "least_transmission_angle_rad": transmission(scenario, index, group.determinant.value),
            "largest_condition": group.condition.as_ref().map(|worst| at(worst, "condition")),
        });
        if group.condition.is_none() {
            value["largest_condition_absent"] = sentences::THE_GROUP_IS_SINGULAR_AT_A_LIMIT.into();
        }
        value
    });
    let extreme =
        |own: &ExtremePosition| json!({input.key(): own.crank, "angle_rad": own.angle, "greatest": own.is_greatest});
    let links = list(&range.links, |link| {
        json!({
            "name": scenario.case.mechanism.links()[link.link].name, "least": at(&link.angles[0], "angle_rad"),
            "greatest": at(&link.angles[1], "angle_rad"), "turns": link.turns,
            "extremes": list(&link.extremes, extreme),
        })
    });
    let sampled = list(range.groups.ids(), |group| {
        let of = |of: fn(&GroupCondition) -> f64| list(&range.samples, |sample| json!(of(&sample.groups[group])));
        json!({
            "links": names(scenario, group), "determinant": of(|own| own.determinant),
            "condition": of(|own| own.condition),
        })
    });
    let four_bar = range.four_bar.as_ref().map(|bar| {
        let [frame, driver, coupler, output] = bar.lengths;
        json!({"type": bar.of_type.name(), "frame_m": frame, "driver_m": driver, "coupler_m": coupler, "output_m": output})
    });
    json!({
        "extent": extent, "four_bar": four_bar, "singularities": singularities, "groups": groups, "links": links,
        "samples": { input.key(): list(&range.samples, |sample| json!(sample.crank)), "groups": sampled },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixtures::of_repository;

    /// If the mechanism returns to its first pose only after two turns of the crank, text and JSON say so.
    #[test]
    fn turns_to_the_same_pose_are_reported() {
        let scenario = of_repository("scenarios/crank_rocker.toml");
        let range = Range { extent: Extent::FullTurn(2), ..Range::of(&scenario.case).unwrap() };
        assert_eq!(json(&scenario, &range)["extent"], json!({"full_turn": true, "turns_to_same_pose": 2}));
        assert!(text(&scenario, &range, None).contains("returns to its first pose after 2 turns"));
    }
}
