//! Motion diagrams by graphical methods, and the errors of these methods.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::cells::{trimmed, worded};
use design::diagram::construction::result;
use design::diagram::{Construction, ConstructionSort, MotionDiagram};
use design::draw::{per_millimetre, scale_shown, significant};
use linkage::input::Input;
use prover::numbers;
use scenario::Scenario;

/// The diagram as text: the largest error, the rms error and the observed orders of every method.
/// If a construction is given, its poles, scale factors and ordinates follow. `width` is the number of columns.
pub(crate) fn text(
    scenario: &Scenario,
    diagram: &MotionDiagram,
    construction: Option<&Construction>,
    width: Option<usize>,
) -> String {
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
    if let Some(construction) = construction {
        construction_text(&mut text, diagram, construction, width);
    }
    text
}

fn construction_text(text: &mut String, diagram: &MotionDiagram, own: &Construction, width: Option<usize>) {
    say!(text, sentences::construction_scale_of_time(&own.sort.word(), &scale_shown(own.time)));
    for step in &own.steps {
        let [from, to] = [step.from, step.method.gives()];
        let units = [from, to].map(|which| numbers::shown(diagram.course.0[which].kind.unit.symbol()));
        let per = units.each_ref().map(|unit| per_millimetre(unit));
        let [given, scale] = step.scales.map(scale_shown);
        let [symbol, other] = [from, to].map(|which| ["s", "v", "a"][which]);
        let name = step.method.words();
        let told = if own.sort == ConstructionSort::Areas {
            sentences::areas_of_width(&name, &symbol, &given, &per[0], &other, &step.pole, &scale, &per[1])
        } else {
            sentences::rays_from_the_pole(&name, &symbol, &given, &per[0], &other, &step.pole, &scale, &per[1])
        };
        say!(text, told);
        let areas = own.sort == ConstructionSort::Areas;
        let header = format!("no | {}> | {}> | exact>", if areas { "area, mm²" } else { "ordinate, mm" }, units[1]);
        let found = result(diagram, step.method);
        // An integral has one value more than it has divisions: the value from which it starts.
        let skipped = found.values.len() - step.ordinates.len();
        let rows = step.ordinates.iter().zip(found.rows.iter().zip(&found.values).skip(skipped)).enumerate();
        let rows = rows.map(|(index, (ordinate, (&row, value)))| {
            let [value, exact] = [*value, diagram.exact[to][row]].map(significant);
            [(index + 1).to_string(), numbers::fixed(*ordinate, 2), value, exact]
        });
        say!(text, "{}", trimmed(worded(&header, width).add_rows(rows)));
    }
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
pub(crate) fn json(scenario: &Scenario, diagram: &MotionDiagram, construction: Option<&Construction>) -> String {
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
    let mut document = json!({
        "schema": 1, "scenario": scenario.name, "divisions": diagram.divisions, "course": course, "methods": found,
    });
    if let Some(own) = construction {
        let areas = own.sort == ConstructionSort::Areas;
        let steps = list(&own.steps, |step| {
            json!({
                "method": step.method.words(), "given_per_mm": step.scales[0], "found_per_mm": step.scales[1],
                "pole_mm": step.pole, if areas { "areas_mm2" } else { "ordinates_mm" }: step.ordinates,
            })
        });
        document["construction"] = json!({"method": own.sort.word(), "time_s_per_mm": own.time, "steps": steps});
    }
    pretty(&document)
}
