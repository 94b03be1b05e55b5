//! The map of a family: errors and bounds of all parties over the dial, as SVG.
//!
//! Colours are told apart in grey too, every party has a mark of its own, and a verdict is the mark's filling.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::summary::names;
use lab::stress::{Family, Group, Outcome, Party};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;

/// Size of a sheet (px): width, height of a panel, of the head with the legend, and of the strip of failures.
const WIDE: u32 = 820;
const HIGH: u32 = 250;
const HEAD: u32 = 92;
/// Smallest and largest number on the axis of errors. What is beyond stands at the edge.
const ERRORS: [f64; 2] = [1e-17, 1e3];
/// Where the strip of failures lies.
const FAILED: f64 = 1e5;
const TOP: f64 = 1e6;
/// Size of a mark (px).
const MARK: i32 = 5;
/// Colours after Okabe and Ito, dark and light ones in turn.
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 0, 0),
    RGBColor(86, 180, 233),
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(230, 159, 0),
    RGBColor(0, 158, 115),
];

/// The map. Panels are positions, rates and forces.
///
/// # Errors
/// [`ErrorKind::Io`] if it cannot be drawn.
pub(crate) fn map(family: &Family, outcomes: &[&Outcome]) -> Result<String> {
    let mut text = String::new();
    drawn(&mut text, family, outcomes)
        .map_err(|error| Error::new(ErrorKind::Io, format!("the map of {} cannot be drawn: {error}", family.name)))?;
    Ok(text)
}

type Drawn = std::result::Result<(), Box<dyn std::error::Error>>;

fn drawn(text: &mut String, family: &Family, outcomes: &[&Outcome]) -> Drawn {
    let groups = Group::ALL;
    let size = (WIDE, HEAD + HIGH * groups.len() as u32);
    let root = SVGBackend::with_string(text, size).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    let names = names(outcomes);
    legend(&head, family, &names)?;
    for (panel, group) in body.split_evenly((groups.len(), 1)).iter().zip(groups) {
        draw(&root, panel, family, outcomes, &names, group)?;
    }
    root.present()?;
    Ok(())
}

fn legend<B: DrawingBackend>(area: &DrawingArea<B, Shift>, family: &Family, names: &[&str]) -> Drawn
where
    B::ErrorType: 'static,
{
    let font = ("sans-serif", 13).into_font();
    area.draw(&Text::new(format!("{}: {}", family.name, family.title), (12, 10), ("sans-serif", 15).into_font()))?;
    for (k, name) in names.iter().enumerate() {
        let x = 20 + 150 * k as i32;
        mark(area, (x, 44), k, "agree")?;
        area.draw(&Text::new((*name).to_string(), (x + 12, 37), font.clone()))?;
    }
    for (k, (verdict, words)) in
        [("agree", "agrees"), ("inconclusive", "inconclusive"), ("disagree", "disagrees"), ("fails", "fails")]
            .into_iter()
            .enumerate()
    {
        let x = 20 + 110 * k as i32;
        mark(area, (x, 70), 0, verdict)?;
        area.draw(&Text::new(words, (x + 12, 63), font.clone()))?;
    }
    area.draw(&PathElement::new([(470, 70), (500, 70)], BLACK))?;
    area.draw(&Text::new("error", (506, 63), font.clone()))?;
    dashes(area, (570, 70), (600, 70), BLACK)?;
    area.draw(&Text::new("bound", (606, 63), font))?;
    Ok(())
}

/// Short strokes from one point to another (px).
fn dashes<B: DrawingBackend>(area: &DrawingArea<B, Shift>, from: (i32, i32), to: (i32, i32), colour: RGBColor) -> Drawn
where
    B::ErrorType: 'static,
{
    const STROKE: f64 = 4.0;
    let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
    let length = dx.hypot(dy);
    let at = |along: f64| {
        let share = (along / length).smaller(1.0);
        (from.0 + (dx * share).round() as i32, from.1 + (dy * share).round() as i32)
    };
    let mut along = 0.0;
    while along < length {
        area.draw(&PathElement::new([at(along), at(along + STROKE)], colour.stroke_width(1)))?;
        along += 2.0 * STROKE;
    }
    Ok(())
}

/// The mark of a party (px): its shape by number, its filling by verdict.
fn mark<B: DrawingBackend>(area: &DrawingArea<B, Shift>, (x, y): (i32, i32), party: usize, verdict: &str) -> Drawn
where
    B::ErrorType: 'static,
{
    let colour = COLOURS[party % COLOURS.len()];
    let corners: Vec<(i32, i32)> = match party % 5 {
        1 => vec![(-1, -1), (1, -1), (1, 1), (-1, 1)],
        2 => vec![(0, -1), (1, 1), (-1, 1)],
        3 => vec![(0, -1), (1, 0), (0, 1), (-1, 0)],
        4 => vec![(-1, -1), (1, -1), (0, 1)],
        _ => Vec::new(),
    };
    let corners: Vec<(i32, i32)> = corners.iter().map(|(dx, dy)| (x + MARK * dx, y + MARK * dy)).collect();
    let cross = |area: &DrawingArea<B, Shift>| -> Drawn {
        for slope in [1, -1] {
            area.draw(&PathElement::new(
                [(x - MARK, y - slope * MARK), (x + MARK, y + slope * MARK)],
                colour.stroke_width(2),
            ))?;
        }
        Ok(())
    };
    if verdict == "fails" {
        return cross(area);
    }
    let fill = if verdict == "agree" { colour } else { WHITE };
    if corners.is_empty() {
        area.draw(&Circle::new((x, y), MARK, fill.filled()))?;
        area.draw(&Circle::new((x, y), MARK, colour.stroke_width(1)))?;
    } else {
        area.draw(&Polygon::new(corners.clone(), fill.filled()))?;
        area.draw(&PathElement::new([corners.clone(), vec![corners[0]]].concat(), colour.stroke_width(1)))?;
    }
    if verdict == "disagree" { cross(area) } else { Ok(()) }
}

/// A panel. The chart tells its pixels as those of the whole sheet, `root`.
fn draw<B: DrawingBackend>(
    root: &DrawingArea<B, Shift>,
    panel: &DrawingArea<B, Shift>,
    family: &Family,
    outcomes: &[&Outcome],
    names: &[&str],
    group: Group,
) -> Drawn
where
    B::ErrorType: 'static,
{
    let dials = || outcomes.iter().map(|own| own.dial);
    let (low, high) = (dials().fold(f64::INFINITY, f64::smaller), dials().fold(0.0, f64::larger));
    let wide = if high > low { (high / low).powf(0.04) } else { 2.0 };
    let (low, high) = (low / wide, high * wide);
    let mut chart = ChartBuilder::on(panel)
        .margin_right(16)
        .margin_top(6)
        .x_label_area_size(42)
        .y_label_area_size(76)
        .build_cartesian_2d((low..high).log_scale(), (ERRORS[0]..TOP).log_scale())?;
    // Where the dial spans less than a decade, its own values are written below the axis.
    let narrow = high / low < 10.0;
    let number = |value: &f64| if narrow { String::new() } else { super::summary::dial(rounded(*value)) };
    let error = |value: &f64| if *value > ERRORS[1] { String::new() } else { format!("{value:.0e}") };
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_desc(family.dial)
        .y_desc(format!("{}: error / scale", group.name()))
        .x_label_formatter(&number)
        .y_label_formatter(&error)
        .x_labels(14)
        .y_labels(8)
        .label_style(("sans-serif", 12))
        .axis_desc_style(("sans-serif", 13))
        .draw()?;
    chart.draw_series([PathElement::new(
        [(low, ERRORS[1] * 10.0), (high, ERRORS[1] * 10.0)],
        RGBColor(150, 150, 150),
    )])?;
    let area = chart.plotting_area();
    let mut written: Vec<f64> = Vec::new();
    for dial in dials().filter(|_| narrow) {
        if !written.contains(&dial) {
            written.push(dial);
            let (x, y) = area.map_coordinate(&(dial, ERRORS[0]));
            root.draw(&PathElement::new([(x, y), (x, y + 5)], BLACK))?;
            root.draw(&Text::new(super::summary::dial(dial), (x - 4, y + 7), ("sans-serif", 12).into_font()))?;
        }
    }
    let place = |dial: f64, error: f64| {
        let clipped = if error.is_nan() { ERRORS[1] } else { error.clamp(ERRORS[0] * 3.0, ERRORS[1]) };
        area.map_coordinate(&(dial, clipped))
    };
    for (index, name) in names.iter().enumerate() {
        let colour = COLOURS[index % COLOURS.len()];
        let party = |own: &Outcome| -> Option<Party> { own.parties.iter().find(|party| party.name == *name).cloned() };
        let mut before: Option<[(i32, i32); 2]> = None;
        let mut marks = Vec::new();
        for own in outcomes {
            let Some(party) = party(own) else { continue };
            // Several samples stand side by side.
            let dial = own.dial * (1.0 + 0.004 * own.sample as f64);
            let Some(reached) = party.reached.iter().find(|own| own.group == group) else {
                if party.verdict == "fails" {
                    let (x, y) = area.map_coordinate(&(dial, FAILED));
                    marks.push(((x + 3 * index as i32, y), "fails".to_string()));
                }
                before = None;
                continue;
            };
            let here = [place(dial, reached.error), place(dial, reached.bound)];
            if let (Some(last), 0) = (before, own.sample) {
                root.draw(&PathElement::new([last[0], here[0]], colour.stroke_width(1)))?;
                dashes(root, last[1], here[1], colour)?;
            }
            marks.push((here[0], party.verdict.clone()));
            before = (own.sample == 0).then_some(here).or(before);
        }
        for (at, verdict) in marks {
            mark(root, at, index, &verdict)?;
        }
    }
    Ok(())
}

fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
