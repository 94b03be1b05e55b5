//! Velocity and acceleration by the chord method, and their errors.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use design::diagram::MotionDiagram;
use design::draw::significant;
use linkage::input::Input;
use prover::numbers;
use scenario::Scenario;

/// The diagram as text: the largest error, the rms error and the observed orders of every method.
pub(crate) fn text(scenario: &Scenario, diagram: &MotionDiagram) -> String {
    let mut text = String::new();
    let range = if diagram.input == Input::Slide { "the stroke" } else { "one turn" };
    say!(text, sentences::over_one_turn_in_divisions(&scenario.name, &diagram.course.0[0], &range, &diagram.divisions));
    for (which, channel) in diagram.course.0.iter().enumerate() {
        let half = significant(diagram.half_range(which));
        say!(text, sentences::half_range(&channel.to_string(), &half, &channel.kind.unit));
    }
    let [method, largest, rms, share, order] = ["method", "largest error", "rms", sentences::OF_HALF_RANGE, "order"];
    say!(text, "\n  {method:34} {largest:>20} {rms:>20} {share:>14} {order:>6} {order:>6}");
    for found in &diagram.found {
        let unit = diagram.course.0[found.method.gives()].kind.unit.symbol();
        let [first, second] =
            found.orders.map(|order| order.map_or_else(|| "-".into(), |order| numbers::fixed(order, 2)));
        let with = |value: f64| numbers::with_unit(&significant(value), unit);
        let ([largest, rms], share) = ([found.largest, found.rms].map(with), 100.0 * found.share);
        say!(text, "  {:34} {largest:>20} {rms:>20} {share:>12.3} % {first:>6} {second:>6}", found.method.words());
    }
    let n = diagram.divisions;
    say!(text, sentences::orders_of_the_rms_error_from_to_and_from_to_divisions(&n, &(2 * n), &(2 * n), &(4 * n)));
    text
}

/// The points as CSV, one row per point, with 17 significant digits.
/// The columns are the method, the channel, the crank angle, the time, the value by the method, and the exact value.
pub(crate) fn points(diagram: &MotionDiagram) -> String {
    let mut text = format!("method,channel,{},t_s,value,exact\n", diagram.input.key());
    for found in &diagram.found {
        let which = found.method.gives();
        for (&row, value) in found.rows.iter().zip(&found.values) {
            let numbers = [diagram.cranks[row], diagram.times[row], *value, diagram.exact[which][row]];
            let numbers = numbers.map(|number| format!("{number:.16e}")).join(",");
            say!(text, "{},{},{numbers}", found.method.words(), quoted(&diagram.course.0[which].to_string()));
        }
    }
    text
}

/// A name chosen in the scenario, quoted as a CSV cell.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.into() }
}

/// The diagram as JSON, schema 1.
pub(crate) fn json(scenario: &Scenario, diagram: &MotionDiagram) -> String {
    let found = list(&diagram.found, |found| {
        let which = found.method.gives();
        let points = list(found.rows.iter().zip(&found.values), |(&row, value)| {
            let (crank, time, exact) = (diagram.cranks[row], diagram.times[row], diagram.exact[which][row]);
            json!({diagram.input.key(): crank, "t_s": time, "value": value, "exact": exact})
        });
        json!({
            "method": found.method.words(), "channel": diagram.course.0[which].to_string(), "largest": found.largest,
            "rms": found.rms, "share_of_half_range": found.share, "orders": found.orders, "points": points,
        })
    });
    let course = list(
        diagram.course.0.iter().enumerate(),
        |(which, channel)| json!({"channel": channel.to_string(), "unit": channel.kind.unit.symbol(), "half_range": diagram.half_range(which)}),
    );
    pretty(&json!({
        "schema": 1, "scenario": scenario.name, "divisions": diagram.divisions, "course": course, "methods": found,
    }))
}
