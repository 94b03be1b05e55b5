//! Diagrams of error against cost, one panel for each stage of channels, as SVG.

use crate::plain::style::wrapped;
use crate::sentences;
use std::ops::RangeInclusive;

use super::chart::{ASIDE, Chart, DASHED, Filling, colour, decades, mark};
use drawing::paper::document::document;
use drawing::paper::figure::{DrawnFigure, solid, words};
use drawing::paper::style::{GREY, significant};
use lab::bench::{Bench, BenchPoint, CLEAR, CostAxis, MethodOwner, front};
use linkage::math::statistics::distinct;
use linkage::math::{KeepNan, Vec2};
use linkage::trajectory::Stage;

/// Size of a panel, height of a title of one line, and mean width of a letter of the title (mm).
const PANEL: [f64; 2] = [138.0, 112.0];
const TITLE: f64 = 12.0;
const LETTER: f64 = 2.6;
/// Colour of the area below the reference error, and of the band of failures.
const PALE: &str = "#ececec";
const ROSE: &str = "#fcf0f0";
/// Size of a mark, and of the ring around a mark (mm).
const MARK: f64 = 1.0;
const RING: f64 = 1.7;
/// Range of costs that are drawn: a logarithmic axis has no place for zero, and room for a limited number of decades.
const DRAWN: RangeInclusive<f64> = 1e-20..=1e20;
/// Number of characters in a line of the legend, and height of a small line (mm).
const WIDTH: usize = 72;
const LINE: f64 = 3.8;

/// The diagram with this cost on the horizontal axis; `None` if no point has this cost.
pub(crate) fn drawing(bench: &Bench, axis: CostAxis) -> Option<String> {
    let costs = costs(bench, axis)?;
    let panels = bench.stages.iter().map(|&stage| panel(bench, stage, axis, costs));
    let columns = (bench.stages.len() + 1).min(3);
    let [name, about] = &bench.scenario;
    let title = sentences::error_against(&name, &short(axis), &about);
    let lines = wrapped(&title, Some((columns as f64 * PANEL[0] / LETTER) as usize), 0);
    let mut sheet = DrawnFigure::default();
    let mut top = 0.0;
    for line in lines.lines() {
        top -= TITLE / 1.5;
        sheet.text(Vec2::new(5.0, top), line, words(5.0));
    }
    top -= TITLE / 3.0;
    for (index, cell) in panels.chain([legend(bench, axis)]).enumerate() {
        let [column, row] = [index % columns, index / columns].map(|count| count as f64);
        sheet.add(&cell, Vec2::new(column * PANEL[0], top - row * PANEL[1]));
    }
    let rows = (bench.stages.len() + 1).div_ceil(columns);
    Some(document(&sheet, [PANEL[0] * columns as f64, PANEL[1] * rows as f64 - top], &title))
}

/// The cost in a few words.
fn short(axis: CostAxis) -> &'static str {
    match axis {
        CostAxis::Time => sentences::PROCESSOR_TIME,
        CostAxis::Solutions => sentences::NUMBER_OF_SOLUTIONS,
        CostAxis::Inner => sentences::NUMBER_OF_INNER_OPERATIONS,
    }
}

/// The cost in words, with its unit.
fn label(bench: &Bench, axis: CostAxis) -> String {
    match axis {
        CostAxis::Time => {
            let [own, motion] = [bench.unit * 1e3, bench.span[1] - bench.span[0]].map(significant);
            sentences::processor_time_over_that_of_side_assur(&own, &motion)
        }
        CostAxis::Solutions => sentences::EVALUATIONS_OR_STEPS_AND_PROBES.into(),
        CostAxis::Inner => sentences::SWEEPS_FACTORISATIONS_ITERATIONS_OR_GROUPS.into(),
    }
}

/// Cost of a point in the unit of its axis.
fn cost(bench: &Bench, axis: CostAxis, point: &BenchPoint) -> Option<f64> {
    let own = axis.of(point)?;
    let unit = match axis {
        CostAxis::Time => bench.unit,
        CostAxis::Solutions | CostAxis::Inner => 1.0,
    };
    Some(own / unit).filter(|cost| DRAWN.contains(cost))
}

/// Smallest and largest cost of all points, with a margin; `None` without points.
fn costs(bench: &Bench, axis: CostAxis) -> Option<[f64; 2]> {
    let all = || bench.points.iter().filter_map(|point| cost(bench, axis, point));
    Some([all().reduce(f64::smaller)? / 2.0, all().reduce(f64::larger)? * 2.0])
}

/// Programs in the order of their first occurrence in the table.
/// A program's number in this order selects its colour and mark.
pub(super) fn programs(bench: &Bench) -> Vec<&str> {
    distinct(bench.points.iter().map(|point| point.program.as_str()))
}

fn panel(bench: &Bench, stage: Stage, axis: CostAxis, [left, right]: [f64; 2]) -> DrawnFigure {
    let floor = bench.floor.errors[stage as usize];
    let shown = |error: f64| error.larger(floor).smaller(1e3);
    let errors = bench.points.iter().filter_map(|point| point.error(stage)).map(|errors| shown(errors.max));
    let worst = errors.fold(floor * CLEAR, f64::larger);
    // Failures are drawn in a band above all measured points.
    let (low, high) = (floor / 6.0, worst * 3.0);
    let band = high * (high / low).powf(0.09);
    let mut chart = Chart::new(PANEL, [[left, right], [low, band]]);
    chart.band([low, floor], PALE);
    chart.band([high, band], ROSE);
    let names = [&label(bench, axis), sentences::LARGEST_ERROR_OVER_THE_SCALE];
    chart.axes([&decades([left, right], 8), &decades([low, high], 9)], caption(stage), names);
    chart.level(floor, solid(GREY, 0.5));
    chart.level(CLEAR * floor, DASHED);
    let place = |index: &usize| {
        let point = &bench.points[*index];
        Some([cost(bench, axis, point)?, shown(point.error(stage)?.max)])
    };
    let mut is_empty = true;
    // The last program is drawn first, so that the marks of the first programs are on top.
    for (number, program) in programs(bench).into_iter().enumerate().rev() {
        let own = |point: &BenchPoint| point.program == program;
        let best = front(&bench.points, stage, axis, floor, &own);
        let best: Vec<Vec2> = best.iter().filter_map(place).map(|at| chart.at(at)).collect();
        if best.len() > 1 {
            chart.figure.curve(best, None, solid(colour(number), 0.5));
        }
        for (index, point) in bench.points.iter().enumerate().filter(|(_, point)| own(point)) {
            let (at, filling) = match (place(&index), point.error(stage)) {
                (Some(at), Some(errors)) if errors.is_limited => (at, Filling::Hollow),
                (Some(at), Some(_)) => (at, Filling::Full),
                (None, _) | (_, None) if point.failure(stage).is_some() => {
                    ([cost(bench, axis, point).unwrap_or(left * 1.15), (high * band).sqrt()], Filling::Cross)
                }
                (None, _) | (_, None) => continue,
            };
            let aside = if filling == Filling::Cross { ASIDE * number as f64 } else { 0.0 };
            let at = chart.at(at) + Vec2::new(aside, 0.0);
            mark(&mut chart.figure, at, MARK, number, filling);
            is_empty = false;
        }
    }
    // On a Pareto front of all programs, only the analytic sides would appear, because they are so fast.
    // A second front is therefore drawn without the sides.
    let best = front(&bench.points, stage, axis, floor, &|_| true);
    let others = front(&bench.points, stage, axis, floor, &|point| point.party != MethodOwner::Side);
    for at in best.iter().chain(&others).filter_map(place).map(|at| chart.at(at)).collect::<Vec<_>>() {
        chart.figure.disc(at, RING, "none", solid(GREY, 0.25));
    }
    if is_empty {
        chart.empty(sentences::NO_SETTING_THAT_ANSWERED_COUNTS);
    }
    chart.figure
}

fn caption(stage: Stage) -> &'static str {
    match stage {
        Stage::Positions => "positions",
        Stage::Velocities => "velocities",
        Stage::Accelerations => "accelerations",
        Stage::Reactions => "reactions",
        Stage::BalancingMoment => sentences::BALANCING_MOMENT_SHAKING_FORCE_AND_MOMENT,
    }
}

fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_string(),
    }
}

/// Programs with their colours, the meaning of the marks, and the reasons of failures.
fn legend(bench: &Bench, axis: CostAxis) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let mut y = -6.0;
    for (number, program) in programs(bench).into_iter().enumerate() {
        let own = || bench.points.iter().filter(|point| point.program == program);
        figure.line([Vec2::new(5.0, y), Vec2::new(14.0, y)], solid(colour(number), 0.5));
        mark(&mut figure, Vec2::new(9.5, y), 1.2, number, Filling::Full);
        let failed = own().filter(|point| point.run().is_none()).count();
        let version = bench.versions.iter().find(|(name, _)| *name == program).map(|(_, version)| version.as_str());
        let version = version.filter(|version| !version.is_empty()).map_or_else(String::new, |own| format!(" ({own})"));
        let settings = match own().count() {
            1 => "1 setting".to_string(),
            count => format!("{count} settings"),
        };
        let failed = if failed > 0 { format!(", {failed} failed") } else { String::new() };
        let is_drawn = own().any(|point| cost(bench, axis, point).is_some());
        let absent = if is_drawn { "" } else { sentences::IT_COUNTS_NONE_OF_THESE };
        figure.text(Vec2::new(17.0, y - 1.2), format!("{program}{version}, {settings}{failed}{absent}"), words(3.7));
        y -= 5.3;
    }
    y -= 2.0;
    let mut write = |y: &mut f64, text: &str, size: f64| {
        for line in wrapped(text, Some(WIDTH), 0).lines() {
            figure.text(Vec2::new(5.0, *y), line, words(size));
            *y -= 1.28 * size;
        }
    };
    for text in [
        sentences::LINE_WHAT_NO_OTHER_SETTING,
        &sentences::grey_line_the_reference_own(&bench.floor.basis),
        &sentences::hollow_less_than_times_above(&CLEAR),
        sentences::CROSS_IN_THE_BAND_ABOVE_FAILED,
        sentences::ERRORS_LARGEST_OVER_INSTANTS_AND_CHANNELS,
    ] {
        write(&mut y, text, 3.2);
    }
    y -= 2.0;
    let failed = reasons(bench).into_iter().map(|(text, times)| format!("x {times}: {text}"));
    let gaps = gaps(bench).into_iter().map(|(text, times)| sentences::in_part(&times, &text));
    let reasons: Vec<String> = failed.chain(gaps).map(|text| cut(&text, 2 * WIDTH)).collect();
    let mut left = reasons.len();
    for text in &reasons {
        let high = LINE * wrapped(text, Some(WIDTH), 0).lines().count() as f64;
        if y - high < -PANEL[1] {
            break;
        }
        write(&mut y, text, 2.9);
        left -= 1;
    }
    if left > 0 {
        write(&mut y, &sentences::and_more_reasons_see_the_table(&left), 2.9);
    }
    figure
}

/// Reasons of failures, each with the number of settings that failed for this reason, the most frequent first.
pub(crate) fn reasons(bench: &Bench) -> Vec<(String, usize)> {
    let failed = bench.points.iter().flat_map(|point| {
        let of = |stage: &Stage| point.failure(*stage).map(|reason| format!("{}: {reason}", point.program));
        let mut own: Vec<String> = bench.stages.iter().filter_map(of).collect();
        own.dedup();
        own
    });
    counted(failed.chain(bench.absent.iter().map(|(name, reason)| format!("{name}: {reason}"))))
}

/// Channels that peers do not provide, stage by stage, each with the number of settings that are judged without it.
pub(crate) fn gaps(bench: &Bench) -> Vec<(String, usize)> {
    let of = |point: &BenchPoint, stage: Stage| {
        let what = point.without(stage)?;
        Some(format!("{}: {} without {what}", point.program, stage.name().replace('_', " ")))
    };
    counted(bench.points.iter().flat_map(|point| bench.stages.iter().filter_map(move |&stage| of(point, stage))))
}

/// Texts with their number of occurrences, the most frequent first.
fn counted(all: impl Iterator<Item = String>) -> Vec<(String, usize)> {
    let mut found: Vec<(String, usize)> = Vec::new();
    for reason in all {
        // Digits are ignored: the same failure at a different instant is the same reason.
        let same = |text: &str| text.chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
        match found.iter_mut().find(|(own, _)| same(own) == same(&reason)) {
            Some((_, times)) => *times += 1,
            None => found.push((reason, 1)),
        }
    }
    found.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
    found
}
