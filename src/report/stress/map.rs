//! The map of a stress family as SVG: errors and bounds of all solvers and engines over the varied parameter.
//!
//! Every party has a separate colour and mark; the filling of a mark shows the verdict.

use super::super::chart::{ASIDE, Chart, DASHED, Filling, SMALLER, colour, decades, mark};
use super::summary::names;
use crate::sentences;
use drawing::paper::document::document;
use drawing::paper::figure::{DrawnFigure, Style, solid, width, words};
use drawing::paper::style::GREY;
use lab::stress::{PartyAtPoint, PointEnd, QuantityGroup, StressFamily, StressOutcome};
use linkage::math::statistics::distinct;
use linkage::math::{KeepNan, Vec2};

/// Size of a panel, and height of the head with the legend (mm).
const PANEL: [f64; 2] = [217.0, 72.0];
const HEAD: f64 = 24.0;
/// Smallest and largest number on the axis of errors; numbers outside are drawn at the edge.
const ERRORS: [f64; 2] = [1e-17, 1e3];
/// Lower end of the strip of failures, its middle, and its upper end.
const FAILED: [f64; 3] = [1e4, 1e5, 1e6];
/// Size of a mark (mm).
const MARK: f64 = 1.3;
/// Font size of the legend (mm).
const LETTER: f64 = 3.4;

/// The map of a family, with one panel each for positions, rates and forces.
pub(crate) fn map(family: &StressFamily, outcomes: &[&StressOutcome]) -> String {
    let names = names(outcomes);
    let title = format!("{}: {}", family.name, family.title);
    let mut sheet = legend(&title, &names, outcomes);
    for (row, group) in QuantityGroup::ALL.into_iter().enumerate() {
        sheet.add(&panel(family, outcomes, &names, group), Vec2::new(0.0, -HEAD - row as f64 * PANEL[1]));
    }
    document(&sheet, [PANEL[0], HEAD + PANEL[1] * QuantityGroup::ALL.len() as f64], &title)
}

fn filling(verdict: PointEnd) -> Filling {
    match verdict {
        PointEnd::Agree => Filling::Full,
        PointEnd::Inconclusive => Filling::Hollow,
        PointEnd::Disagree => Filling::Crossed,
        PointEnd::Fails => Filling::Cross,
    }
}

fn legend(title: &str, names: &[&str], outcomes: &[&StressOutcome]) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    figure.text(Vec2::new(4.0, -6.0), title, words(4.2));
    let write = |figure: &mut DrawnFigure, x: &mut f64, y: f64, text: &str| {
        figure.text(Vec2::new(*x, y - 1.2), text, words(LETTER));
        *x += width(text, LETTER) + 9.0;
    };
    let mut x = 6.0;
    for (number, name) in names.iter().enumerate() {
        mark(&mut figure, Vec2::new(x, -13.0), MARK, number, Filling::Full);
        x += 3.0;
        let mut own = outcomes.iter().flat_map(|own| &own.parties).filter(|party| party.name == *name);
        let has_numbers = own.any(|party| !party.reached.is_empty());
        let absent = if has_numbers { "" } else { sentences::WITHOUT_NUMBERS };
        write(&mut figure, &mut x, -13.0, &format!("{name}{absent}"));
    }
    let mut x = 6.0;
    for (verdict, text) in PointEnd::ALL.into_iter().zip(["agrees", "inconclusive", "disagrees", "fails"]) {
        mark(&mut figure, Vec2::new(x, -19.5), MARK, 0, filling(verdict));
        x += 3.0;
        write(&mut figure, &mut x, -19.5, text);
    }
    for (style, size, text) in [(solid(GREY, 0.3), MARK, "error"), (DASHED, SMALLER * MARK, "bound")] {
        figure.line([Vec2::new(x, -19.5), Vec2::new(x + 9.0, -19.5)], Style { colour: colour(0), ..style });
        mark(&mut figure, Vec2::new(x + 4.5, -19.5), size, 0, Filling::Full);
        x += 11.0;
        write(&mut figure, &mut x, -19.5, text);
    }
    figure
}

fn panel(family: &StressFamily, outcomes: &[&StressOutcome], names: &[&str], group: QuantityGroup) -> DrawnFigure {
    let dials = || outcomes.iter().map(|own| own.dial);
    let (low, high) = (dials().fold(f64::INFINITY, f64::smaller), dials().fold(0.0, f64::larger));
    let wide = if high > low { (high / low).powf(0.04) } else { 2.0 };
    let along = [low / wide, high * wide];
    let mut chart = Chart::new(PANEL, [along, [ERRORS[0], FAILED[2]]]);
    // An axis of less than a decade shows the values of the parameter.
    let numbers = if along[1] / along[0] < 10.0 { distinct(dials()) } else { decades(along, 13) };
    let names_of_axes = [family.dial, sentences::LARGEST_ERROR_OVER_THE_SCALE];
    chart.axes([&numbers, &decades(ERRORS, 7)], group.name(), names_of_axes);
    chart.level(FAILED[0], solid(GREY, 0.3));
    let clipped = |error: f64| if error.is_nan() { ERRORS[1] } else { error.clamp(3.0 * ERRORS[0], ERRORS[1]) };
    let mut is_empty = true;
    // The last party is drawn first: the marks of the first parties are the smallest and stay visible.
    for (number, name) in names.iter().enumerate().rev() {
        // Each party has two lines: one through its errors, and one through its bounds.
        // Both lines are interrupted where the party has no numbers.
        let mut lines: Vec<[Vec<Vec2>; 2]> = vec![Default::default()];
        let mut marks = Vec::new();
        for own in outcomes {
            let has_failed = |party: &&PartyAtPoint| {
                party.verdict == PointEnd::Fails && !party.reached.iter().any(|own| own.group == group)
            };
            let Some(party) = own.parties.iter().find(|party| party.name == *name) else { continue };
            // Several samples at one parameter value are drawn side by side.
            let dial = own.dial * (1.0 + 0.004 * own.sample as f64);
            let Some(reached) = party.reached.iter().find(|own| own.group == group) else {
                let mut failed = own.parties.iter().filter(has_failed);
                if let Some(rank) = failed.position(|party| party.name == *name) {
                    marks.push((chart.at([dial, FAILED[1]]) + Vec2::new(ASIDE * rank as f64, 0.0), Filling::Cross));
                }
                lines.push(Default::default());
                continue;
            };
            let [error, bound] = [reached.error, reached.bound].map(|value| chart.at([dial, clipped(value)]));
            marks.push((error, filling(party.verdict)));
            if let ([errors, bounds], 0) = (lines.last_mut().expect("there is one"), own.sample) {
                errors.push(error);
                bounds.push(bound);
            }
        }
        for &bound in lines.iter().flat_map(|[_, bounds]| bounds) {
            mark(&mut chart.figure, bound, SMALLER * MARK, number, Filling::Full);
        }
        for [errors, bounds] in lines.into_iter().filter(|[errors, _]| errors.len() > 1) {
            chart.figure.curve(errors, None, solid(colour(number), 0.3));
            chart.figure.curve(bounds, None, Style { colour: colour(number), ..DASHED });
        }
        is_empty &= marks.is_empty();
        for (at, filling) in marks {
            mark(&mut chart.figure, at, MARK, number, filling);
        }
    }
    if is_empty {
        chart.empty(sentences::NO_SOLVER_AND_NO_ENGINE_HAS_NUMBERS);
    }
    chart.figure
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab::stress::named;

    /// Symptom: diagrams were empty and showed no message.
    #[test]
    fn regress_a_map_without_data_is_labelled_as_empty() {
        let family = named("step").unwrap();
        let refused = String::from("not a valid mechanism");
        let outcome = StressOutcome { dial: 1.0, sample: 0, key: String::new(), refused, parties: Vec::new() };
        assert_eq!(map(family, &[&outcome]).matches("no data to draw").count(), QuantityGroup::ALL.len());
    }
}
