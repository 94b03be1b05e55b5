//! Diagrams of error against cost, one panel for each stage of channels, as SVG.

use std::ops::RangeInclusive;

use plotters::coord::Shift;
use plotters::prelude::{
    ChartBuilder, Circle, Color, Cross, DrawingArea, EmptyElement, IntoDrawingArea, IntoLogRange, LineSeries,
    PathElement, RGBColor, Rectangle, SVGBackend, ShapeStyle, Text, WHITE,
};
use plotters::style::IntoFont;

use crate::plain::cells::distinct;
use lab::bench::{Axis, Bench, CLEAR, Party, Point, front};
use linkage::math::KeepNan;
use linkage::trajectory::Stage;

/// Size of a panel (pixels), and of the line of the title.
const PANEL: (u32, u32) = (520, 430);
const TITLE: u32 = 46;
/// Colours of programs: the two sides, engines, peers. They are told apart by colour-blind eyes too.
const KNOWN: [(&str, RGBColor); 7] = [
    ("assur", RGBColor(0, 90, 160)),
    ("newton", RGBColor(86, 180, 233)),
    ("rapier", RGBColor(213, 94, 0)),
    ("impulse", RGBColor(230, 159, 0)),
    ("simbody", RGBColor(0, 130, 95)),
    ("rapier-f32", RGBColor(150, 75, 40)),
    ("impulse-f32", RGBColor(185, 150, 70)),
];
const OTHERS: [RGBColor; 5] = [
    RGBColor(170, 60, 140),
    RGBColor(60, 60, 60),
    RGBColor(120, 100, 200),
    RGBColor(130, 150, 0),
    RGBColor(200, 30, 60),
];
const GREY: RGBColor = RGBColor(110, 110, 110);
const PALE: RGBColor = RGBColor(236, 236, 236);
const ROSE: RGBColor = RGBColor(252, 240, 240);
/// Costs that are drawn: an axis of logarithms counts its decades, and begins with none at zero.
const DRAWN: RangeInclusive<f64> = 1e-20..=1e20;
/// Characters in a line of the legend, and the height of a small one (pixels).
const WIDTH: usize = 72;
const LINE: i32 = 14;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), String>;

/// The diagram of one axis of cost; `None` if no point has that cost.
///
/// # Errors
/// What the library cannot draw.
pub(crate) fn drawing(bench: &Bench, axis: Axis) -> Result<Option<String>, String> {
    if bench.points.iter().all(|point| cost(bench, axis, point).is_none()) {
        return Ok(None);
    }
    let panels = bench.stages.len() + 1;
    let columns = panels.min(3);
    let rows = panels.div_ceil(columns);
    let size = (PANEL.0 * columns as u32, PANEL.1 * rows as u32 + TITLE);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).map_err(told)?;
        let [name, title] = &bench.scenario;
        let [what, _] = words(axis);
        let line = format!("{name}: error against {what}. {title}");
        root.draw(&Text::new(cut(&line, 150), (16, 14), ("sans-serif", 20).into_font())).map_err(told)?;
        let cells = root.margin(TITLE as i32, 0, 0, 0).split_evenly((rows, columns));
        let bounds = costs(bench, axis);
        for (cell, &stage) in cells.iter().zip(&bench.stages) {
            panel(cell, bench, stage, axis, bounds)?;
        }
        legend(&cells[bench.stages.len()], bench)?;
        root.present().map_err(told)?;
    }
    Ok(Some(text))
}

fn told(error: impl std::fmt::Display) -> String {
    format!("the diagram cannot be drawn: {error}")
}

/// The cost in words, and the label of its axis.
fn words(axis: Axis) -> [&'static str; 2] {
    match axis {
        Axis::Time => ["time", "time over that of side 1 (assur)"],
        Axis::Solutions => ["solutions of the mechanism", "evaluations, or steps and probes, or poses"],
        Axis::Inner => ["inner work", "sweeps, factorisations, iterations or groups"],
    }
}

/// Cost of a point in the unit of its axis.
fn cost(bench: &Bench, axis: Axis, point: &Point) -> Option<f64> {
    let own = axis.of(point)?;
    let unit = match axis {
        Axis::Time => bench.unit,
        Axis::Solutions | Axis::Inner => 1.0,
    };
    Some(own / unit).filter(|cost| DRAWN.contains(cost))
}

/// Least and greatest cost of all points, with room beside them.
fn costs(bench: &Bench, axis: Axis) -> [f64; 2] {
    let all = bench.points.iter().filter_map(|point| cost(bench, axis, point));
    let [least, most] =
        all.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], own| [least.smaller(own), most.larger(own)]);
    [least / 2.0, most * 2.0]
}

fn colour(bench: &Bench, program: &str) -> RGBColor {
    if let Some((_, colour)) = KNOWN.iter().find(|(name, _)| *name == program) {
        return *colour;
    }
    let others = programs(bench).into_iter().filter(|name| KNOWN.iter().all(|(known, _)| known != name));
    OTHERS[others.take_while(|name| *name != program).count() % OTHERS.len()]
}

/// Programs in the order in which they first stand in the table.
pub(super) fn programs(bench: &Bench) -> Vec<&str> {
    distinct(bench.points.iter().map(|point| point.program.as_str()))
}

fn panel(area: &Area, bench: &Bench, stage: Stage, axis: Axis, [left, right]: [f64; 2]) -> Drawn {
    let floor = bench.floor.errors[stage as usize];
    let shown = |error: f64| error.larger(floor).smaller(1e3);
    let errors = bench.points.iter().filter_map(|point| point.error(stage)).map(|errors| shown(errors.max));
    let worst = errors.fold(floor * CLEAR, f64::larger);
    // Failures stand in a band above everything that was measured.
    let (low, high) = (floor / 6.0, worst * 3.0);
    let band = high * (high / low).powf(0.09);
    let mut chart = ChartBuilder::on(area)
        .caption(caption(stage), ("sans-serif", 17))
        .margin(10)
        .x_label_area_size(40)
        .y_label_area_size(62)
        .build_cartesian_2d((left..right).log_scale(), (low..band).log_scale())
        .map_err(told)?;
    let shade = |from: f64, to: f64, colour: RGBColor| {
        Rectangle::new([(left, from), (right, to)], ShapeStyle::from(colour).filled())
    };
    chart.draw_series([shade(low, floor, PALE), shade(high, band, ROSE)]).map_err(told)?;
    chart
        .configure_mesh()
        .x_desc(words(axis)[1])
        .y_desc("largest error over the scale")
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_label_formatter(&|value| power(*value))
        .y_label_formatter(&|value| power(*value))
        .y_labels(10)
        .label_style(("sans-serif", 12))
        .axis_desc_style(("sans-serif", 13))
        .draw()
        .map_err(told)?;
    let line = |at: f64, width: u32| PathElement::new(vec![(left, at), (right, at)], GREY.stroke_width(width));
    chart.draw_series([line(floor, 2)]).map_err(told)?;
    let dashes = (0..40).step_by(2).map(|k| {
        let at = |k: i32| left * (right / left).powf(f64::from(k) / 40.0);
        PathElement::new(vec![(at(k), CLEAR * floor), (at(k + 1), CLEAR * floor)], GREY.stroke_width(1))
    });
    chart.draw_series(dashes).map_err(told)?;
    for program in programs(bench) {
        let own = |point: &Point| point.program == program;
        let paint = colour(bench, program);
        let place = |index: &usize| {
            let point = &bench.points[*index];
            Some((cost(bench, axis, point)?, shown(point.error(stage)?.max)))
        };
        let best: Vec<(f64, f64)> = front(&bench.points, stage, axis, floor, &own).iter().filter_map(place).collect();
        chart.draw_series(LineSeries::new(best, paint.stroke_width(2))).map_err(told)?;
        for (index, point) in bench.points.iter().enumerate().filter(|(_, point)| own(point)) {
            if let (Some(at), Some(errors)) = (place(&index), point.error(stage)) {
                let style = if errors.is_limited { paint.stroke_width(1) } else { paint.mix(0.65).filled() };
                chart.draw_series([Circle::new(at, 3, style)]).map_err(told)?;
            } else if point.failure(stage).is_some() {
                let at = (cost(bench, axis, point).unwrap_or(left * 1.15), (high * band).sqrt());
                chart.draw_series([Cross::new(at, 3, paint.stroke_width(1))]).map_err(told)?;
            }
        }
    }
    // The sides are so far ahead that nothing else would have a ring.
    let best = front(&bench.points, stage, axis, floor, &|_| true);
    let others = front(&bench.points, stage, axis, floor, &|point| point.party != Party::Side);
    let rings = best.iter().chain(&others).filter_map(|&index| {
        let point = &bench.points[index];
        Some(Circle::new((cost(bench, axis, point)?, shown(point.error(stage)?.max)), 6, GREY.stroke_width(1)))
    });
    chart.draw_series(rings).map_err(told)?;
    Ok(())
}

/// A power of ten as label, whose last digits may be rounding.
fn power(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if (0.01..10000.0).contains(&rounded) { format!("{rounded}") } else { format!("{rounded:.0e}") }
}

fn caption(stage: Stage) -> &'static str {
    match stage {
        Stage::Positions => "positions",
        Stage::Velocities => "velocities",
        Stage::Accelerations => "accelerations",
        Stage::Reactions => "reactions",
        Stage::BalancingMoment => "balancing moment, shaking force and moment",
    }
}

fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_string(),
    }
}

/// The words of a text in lines of at most `most` characters, where no word is longer.
fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < most => {
                line.push(' ');
                line.push_str(word);
            }
            Some(_) | None => lines.push(word.to_string()),
        }
    }
    lines
}

/// Programs with their colours, what marks mean, and the reasons of failures.
fn legend(area: &Area, bench: &Bench) -> Drawn {
    let mut y = 22;
    let write = |text: &str, x: i32, y: i32, size: i32| {
        area.draw(&Text::new(text.to_string(), (x, y - size / 2), ("sans-serif", size).into_font())).map_err(told)
    };
    for program in programs(bench) {
        let own = || bench.points.iter().filter(|point| point.program == program);
        let paint = colour(bench, program);
        let sample = EmptyElement::at((36, y))
            + PathElement::new(vec![(-18, 0), (18, 0)], paint.stroke_width(2))
            + Circle::new((0, 0), 3, paint.filled());
        area.draw(&sample).map_err(told)?;
        let failed = own().filter(|point| point.run().is_none()).count();
        let version = bench.versions.iter().find(|(name, _)| *name == program).map(|(_, version)| version.as_str());
        let version = version.filter(|version| !version.is_empty()).map_or_else(String::new, |own| format!(" ({own})"));
        let settings = match own().count() {
            1 => "1 setting".to_string(),
            count => format!("{count} settings"),
        };
        let failed = if failed > 0 { format!(", {failed} failed") } else { String::new() };
        write(&format!("{program}{version}, {settings}{failed}"), 64, y, 14)?;
        y += 20;
    }
    y += 6;
    for text in [
        "Line: what no other setting of the same program beats; ring: nothing, or no engine and peer, beats it."
            .to_string(),
        format!("Grey line: the reference's own error ({}).", bench.floor.basis),
        format!("Hollow: less than {CLEAR} times above it (dashes), limited by the reference."),
        "Cross in the band above: failed. Errors: largest over instants and channels.".to_string(),
    ] {
        for line in wrapped(&text, WIDTH) {
            write(&line, 18, y, 12)?;
            y += 16;
        }
    }
    y += 8;
    let failed = reasons(bench).into_iter().map(|(text, times)| format!("x {times}: {text}"));
    let gaps = gaps(bench).into_iter().map(|(text, times)| format!("in part {times}: {text}"));
    let (reasons, mut shown) = (failed.chain(gaps).collect::<Vec<String>>(), 0);
    for text in &reasons {
        let lines = wrapped(&cut(text, 2 * WIDTH), WIDTH);
        if y + LINE * (lines.len() as i32 + 1) > PANEL.1 as i32 {
            break;
        }
        for line in lines {
            write(&line, 18, y, 11)?;
            y += LINE;
        }
        shown += 1;
    }
    if shown < reasons.len() {
        write(&format!("and {} more reasons: see the table", reasons.len() - shown), 18, y, 11)?;
    }
    Ok(())
}

/// Reasons of failures with the number of settings that they stopped, the most frequent first.
pub(crate) fn reasons(bench: &Bench) -> Vec<(String, usize)> {
    let failed = bench.points.iter().flat_map(|point| {
        let of = |stage: &Stage| point.failure(*stage).map(|reason| format!("{}: {reason}", point.program));
        let mut own: Vec<String> = bench.stages.iter().filter_map(of).collect();
        own.dedup();
        own
    });
    counted(failed.chain(bench.absent.iter().map(|(name, reason)| format!("{name}: {reason}"))))
}

/// Channels that peers do not give, stage by stage, with the number of settings that are judged without them.
pub(crate) fn gaps(bench: &Bench) -> Vec<(String, usize)> {
    let of = |point: &Point, stage: Stage| {
        let what = point.without(stage)?;
        Some(format!("{}: {} without {what}", point.program, stage.name().replace('_', " ")))
    };
    counted(bench.points.iter().flat_map(|point| bench.stages.iter().filter_map(move |&stage| of(point, stage))))
}

/// Texts with the number of times that they occur, the most frequent first.
fn counted(all: impl Iterator<Item = String>) -> Vec<(String, usize)> {
    let mut found: Vec<(String, usize)> = Vec::new();
    for reason in all {
        // The same failure at another instant is the same reason.
        let same = |text: &str| text.chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
        match found.iter_mut().find(|(own, _)| same(own) == same(&reason)) {
            Some((_, times)) => *times += 1,
            None => found.push((reason, 1)),
        }
    }
    found.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
    found
}
