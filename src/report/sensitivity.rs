//! Exact derivatives of figures with respect to the numbers of a file, and tolerance stacks.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::cells::{fitted, trimmed};
use design::sensitivity::{FigureSlopes, KeyTolerance, LinearLimit, Sensitivity, ToleranceStack};
use prover::numbers;
use scenario::{CaseKey, Scenario};

/// Everything that the command reports.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sensitivities<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) found: &'a Sensitivity,
    pub(crate) tolerances: &'a [KeyTolerance],
    /// The stacks of the figures; empty without tolerances.
    pub(crate) stacks: &'a [ToleranceStack],
    pub(crate) samples: u32,
    pub(crate) seed: u64,
}

impl Sensitivities<'_> {
    fn limit(&self, key: &CaseKey) -> Option<f64> {
        self.tolerances.iter().find(|own| own.key == key.name).map(|own| own.limit)
    }

    /// Indices of the keys by decreasing effect of their tolerances; without tolerances, as [`FigureSlopes::ranked`].
    fn order(&self, figure: &FigureSlopes) -> Vec<usize> {
        let keys = &self.found.keys;
        let mut order = figure.ranked(keys);
        if !self.tolerances.is_empty() {
            let effect = |key: usize| self.limit(&keys[key]).map_or(-1.0, |limit| (figure.by[key] * limit).abs());
            order.sort_by(|&a, &b| effect(b).total_cmp(&effect(a)));
        }
        order
    }
}

/// A number with the unit of a key or a figure.
fn with_unit(value: f64, unit: &str) -> String {
    numbers::with_unit(&numbers::significant(value, 6), unit)
}

/// A derivative with its unit: `12.3456 N per mm`.
fn derivative(value: f64, unit: &str, key: &CaseKey) -> String {
    if value.is_nan() {
        return sentences::KINK.into();
    }
    let number = with_unit(value, unit);
    if key.unit.is_empty() { number } else { sentences::per_unit(&number, &key.unit) }
}

/// The figures, each with its tolerance stack and the keys that affect it most.
pub(crate) fn text(all: &Sensitivities, most: usize, width: Option<usize>) -> String {
    let keys = &all.found.keys;
    let mut text = format!("{}: {}\n", all.scenario.name, all.scenario.title);
    for (index, figure) in all.found.figures.iter().enumerate() {
        let value = with_unit(figure.sampled.value, &figure.unit);
        let line = match figure.instants.is_empty() {
            true => sentences::figure_over_all_instants(&figure.figure, &value),
            false => sentences::figure_at_instants(&figure.figure, &value, &figure.instants.join(", ")),
        };
        say!(text, "\n{line}");
        if let Some(rival) = &figure.rival {
            say!(text, sentences::another_extreme_is_as_large(rival));
        }
        if figure.has_kink {
            say!(text, sentences::THE_FIGURE_HAS_A_KINK);
        }
        let row = |key: usize| {
            let own = &keys[key];
            let relative = figure.relative(keys, key).filter(|own| own.is_finite());
            let mut row = vec![
                own.name.clone(),
                with_unit(own.value, own.unit),
                derivative(figure.by[key], &figure.unit, own),
                relative.map_or("-".into(), |own| numbers::fixed(own, 4)),
            ];
            if !all.tolerances.is_empty() {
                let effect = all.limit(own).map(|limit| with_unit((figure.by[key] * limit).abs(), &figure.unit));
                row.push(effect.unwrap_or_else(|| "-".into()));
            }
            row
        };
        let mut header = "key | value> | derivative> | % of the figure\nfor 1 %>".to_string();
        if !all.tolerances.is_empty() {
            header += " | effect of\nthe tolerance>";
        }
        let order = all.order(figure);
        let rows = order.iter().take(most).map(|key| row(*key));
        say!(text, "\n{}", trimmed(fitted(&header, width).add_rows(rows)));
        if order.len() > most {
            say!(text, sentences::further_keys(&(order.len() - most)));
        }
        if let Some(stack) = all.stacks.get(index) {
            text += &stack_text(all, figure, stack);
        }
    }
    let kept =
        if all.found.by_input { sentences::INSTANTS_KEEP_THEIR_INPUTS } else { sentences::INSTANTS_KEEP_THEIR_TIMES };
    say!(text, "\n{kept}");
    text
}

fn stack_text(all: &Sensitivities, figure: &FigureSlopes, stack: &ToleranceStack) -> String {
    let mut text = String::from("\n");
    let told = |value: f64| with_unit(value, &figure.unit);
    say!(text, sentences::worst_case_and_root_sum_square(&told(stack.worst), &told(stack.root_sum_square)));
    let deviations = [stack.linear_deviation, stack.sampled_deviation].map(told);
    say!(text, sentences::deviations(&deviations[1], &deviations[0], &all.samples, &all.seed));
    let [least, greatest] = stack.sampled_ends.map(told);
    say!(text, sentences::sampled_shift_and_ends(&told(stack.sampled_shift), &least, &greatest));
    if stack.unsolved > 0 {
        say!(text, sentences::mechanisms_cannot_be_solved(&stack.unsolved, &all.samples));
    }
    let multiple = |own: f64| numbers::significant(own, 2);
    say!(
        text,
        match stack.limit {
            LinearLimit::From(own) => sentences::linear_theory_holds_below(&multiple(own)),
            LinearLimit::UntilUnsolved(own) => sentences::linear_theory_holds_until_unsolved(&multiple(own)),
            LinearLimit::Beyond(own) => sentences::linear_theory_holds_beyond(&multiple(own)),
        }
    );
    text
}

/// All derivatives, one row for each figure and key, the header first.
pub(crate) fn rows(all: &Sensitivities) -> Vec<Vec<String>> {
    let header =
        ["figure", "figure_value", "figure_unit", "key", "value", "unit", "derivative", "relative", "tolerance"];
    let mut rows = vec![header.map(String::from).to_vec()];
    for figure in &all.found.figures {
        for (key, own) in all.found.keys.iter().enumerate() {
            let number = |value: Option<f64>| {
                value.filter(|own| own.is_finite()).map_or(String::new(), |own| format!("{own:e}"))
            };
            rows.push(vec![
                figure.figure.to_string(),
                number(Some(figure.sampled.value)),
                figure.unit.clone(),
                own.name.clone(),
                number(Some(own.value)),
                own.unit.into(),
                number(Some(figure.by[key])),
                number(figure.relative(&all.found.keys, key)),
                number(all.limit(own)),
            ]);
        }
    }
    rows
}

/// Everything as JSON, schema 1. A derivative at a kink is null.
pub(crate) fn json(all: &Sensitivities) -> String {
    let keys = &all.found.keys;
    let known = |value: f64| value.is_finite().then_some(value);
    let figure = |(index, own): (usize, &FigureSlopes)| {
        let slopes = list(keys.iter().enumerate(), |(key, one)| {
            json!({
                "key": one.name, "sort": one.sort.name(), "value": one.value, "unit": one.unit,
                "derivative": known(own.by[key]), "relative": own.relative(keys, key).and_then(known),
            })
        });
        json!({
            "figure": own.figure.to_string(), "unit": own.unit, "value": own.sampled.value,
            "rows": own.sampled.rows, "instants": own.instants, "equal_extreme": own.rival, "kink": own.has_kink,
            "slopes": slopes,
            "stack": all.stacks.get(index).map(|stack| {
                let (limit, multiple) = stack.limit.named();
                json!({
                    "worst": stack.worst, "root_sum_square": stack.root_sum_square,
                    "linear_deviation": stack.linear_deviation, "sampled_deviation": stack.sampled_deviation,
                    "sampled_shift": stack.sampled_shift, "sampled_ends": stack.sampled_ends,
                    "unsolved": stack.unsolved, "linear": limit, "multiple": multiple,
                })
            }),
        })
    };
    pretty(&json!({
        "schema": 1, "scenario": all.scenario.name, "by_input": all.found.by_input,
        "tolerances": list(all.tolerances, |own| json!({"key": own.key, "limit": own.limit})),
        "samples": all.samples, "seed": all.seed,
        "figures": list(all.found.figures.iter().enumerate(), figure),
    }))
}
