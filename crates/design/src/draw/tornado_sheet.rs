//! Tornado diagrams: for each figure (a number in the result), bars for the scenario keys that change it most.

use super::axes::{GRID, Room, stacked};
use crate::sensitivity::{KeyTolerance, Sensitivity};
use crate::sentences;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Tint, Type, rectangle, solid, width, words};
use drawing::paper::scale::{multiple, round_up};
use drawing::paper::style::{BLACK, COLOURS, significant};
use linkage::math::{KeepNan, Vec2};

/// Largest number of bars of a diagram.
const MOST: usize = 10;
/// Length of the axis (mm), and height and distance of the bars (mm).
const LONG: f64 = 120.0;
const HIGH: f64 = 4.0;
const STEP: f64 = 6.0;
const ROOM: Room = Room { gap: 3.0, left: 0.0, between: 9.0 };

/// Draws a tornado diagram for each figure.
/// Without tolerances, a bar is the change of the figure in per cent if the key grows by one per cent.
/// With tolerances, a bar is the change of the figure in its unit if the key grows by its tolerance.
#[must_use]
pub fn tornado(found: &Sensitivity, tolerances: &[KeyTolerance], title: &str) -> Drawing {
    let notes = match tolerances.is_empty() {
        true => [sentences::EFFECT_OF_ONE_PER_CENT.to_string()],
        false => [sentences::EFFECT_OF_THE_TOLERANCE.to_string()],
    };
    // The names of the keys are left of all bars.
    let names = found.keys.iter().map(|key| width(&key.name, 3.0)).fold(0.0, f64::larger);
    let panels = (0..found.figures.len()).map(|figure| panel(found, tolerances, figure));
    stacked(title, &notes, &Room { left: names + 3.0, ..ROOM }, panels)
}

/// The bars of a figure: names of keys, and effects.
fn bars(found: &Sensitivity, tolerances: &[KeyTolerance], figure: usize) -> Vec<(String, f64)> {
    let own = &found.figures[figure];
    let effect = |key: usize| match tolerances.is_empty() {
        true => own.relative(&found.keys, key),
        false => tolerances.iter().find(|one| one.key == found.keys[key].name).map(|one| own.by[key] * one.limit),
    };
    let all = (0..found.keys.len()).filter_map(|key| Some((found.keys[key].name.clone(), effect(key)?)));
    let mut all: Vec<(String, f64)> = all.filter(|(_, effect)| effect.is_finite() && *effect != 0.0).collect();
    all.sort_by(|(_, a), (_, b)| b.abs().total_cmp(&a.abs()));
    all.truncate(MOST);
    all
}

fn panel(found: &Sensitivity, tolerances: &[KeyTolerance], figure: usize) -> DrawnFigure {
    let (own, bars) = (&found.figures[figure], bars(found, tolerances, figure));
    let mut drawn = DrawnFigure::default();
    let most = bars.iter().map(|(_, effect)| effect.abs()).fold(0.0, f64::larger);
    let step = if most > 0.0 { round_up(most / 3.0) } else { 1.0 };
    let ends = (most / step).ceil().larger(1.0);
    let x = |effect: f64| LONG / 2.0 * (1.0 + effect / (ends * step));
    let bottom = -STEP * bars.len() as f64;
    for k in -(ends as i32)..=(ends as i32) {
        let at = x(f64::from(k) * step);
        let style = if k == 0 { solid(BLACK, 0.25) } else { GRID };
        drawn.line([Vec2::new(at, 0.0), Vec2::new(at, bottom)], style);
        let set = Type { anchor: "middle", ..words(2.8) };
        drawn.text(Vec2::new(at, bottom - 4.0), multiple(f64::from(k) * step, step), set);
    }
    for (row, (name, effect)) in bars.iter().enumerate() {
        let middle = -STEP * (row as f64 + 0.5);
        let [low, high] = [x(effect.smaller(0.0)), x(effect.larger(0.0))];
        let corners = rectangle([Vec2::new(low, middle - HIGH / 2.0), Vec2::new(high, middle + HIGH / 2.0)]);
        let colour = COLOURS[usize::from(*effect < 0.0)];
        drawn.area(corners, Some(Tint { colour, opacity: 0.6 }), solid(colour, 0.25));
        drawn.text(Vec2::new(-3.0, middle - 1.0), name.as_str(), Type { anchor: "end", ..words(3.0) });
        drawn.text(Vec2::new(LONG + 3.0, middle - 1.0), significant(*effect), words(2.8));
    }
    let unit = if tolerances.is_empty() { "%" } else { own.unit.as_str() };
    drawn.text(Vec2::new(LONG / 2.0, bottom - 8.4), unit, Type { anchor: "middle", ..words(2.8) });
    let value = significant(own.sampled.value);
    let heading = sentences::figure_with_its_value(&own.figure, &value, &own.unit);
    drawn.text(Vec2::new(0.0, 3.0), heading.trim_end(), Type { bold: true, ..words(3.6) });
    drawn
}
