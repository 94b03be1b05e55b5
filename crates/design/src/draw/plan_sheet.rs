//! Sheet of a mechanism's plans: kinematic diagram, velocity plan and acceleration plan below each other.
//! The table of each plan is below the plan. The sheet is narrow, so that letters stay legible at the width of a web
//! page.

use super::scheme_figure::CONSTRUCTION;
use super::{assur_figure, centre_figure, scheme_figure};
use crate::plan::builder::NOTHING;
use crate::plan::vectors::{Tip, TipKind, Vector, VectorKind, VectorPlan};
use crate::plan::{PlanTurn, Plans, Quantity};
use crate::sentences;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Style, Type, scripted, solid, sub, words};
use drawing::paper::labels::{LETTER, Obstacles, PlacedLabel, label_size, letter, lettering, place_among};
use drawing::paper::style::{BLACK, GREY, colour, significant};
use drawing::paper::table::LegendTable;
use linkage::math::{KeepNan, Vec2, cross, turned};

/// Margin of the sheet (mm).
/// `GAP` is the distance between plans (mm), and `SPACE` the distance between a figure and its table (mm).
const MARGIN: f64 = 8.0;
const GAP: f64 = 12.0;
const SPACE: f64 = 6.0;
/// Height of the sheet's title (mm). `HEADING` is the height of a plan's heading (mm).
const TITLE: f64 = 18.0;
const HEADING: f64 = 15.0;
/// Points closer to each other on paper than this (mm) share one label.
const ONE: f64 = 0.7;
/// Distance between arrows that would coincide and are therefore drawn beside each other (mm).
/// Arrows are drawn beside each other if their common length exceeds `SHARED` (mm).
const APART: f64 = 0.8;
const SHARED: f64 = 1.0;
/// Length below which an arrow is drawn as a point (mm).
const POINT: f64 = 0.15;

/// Returns the plans as a drawing true to scale, with `name` and `title` above them.
pub fn plans(plans: &Plans, name: &str, title: &str) -> Drawing {
    let scheme = &plans.scheme;
    let mut parts = vec![
        heading("Kinematic diagram", "l", scheme.scale, "m/mm", PlanTurn::Upright)
            .with(scheme_figure::scheme(scheme), scheme_figure::table(scheme)),
        of_plan(&plans.velocity, "Velocity plan"),
        of_plan(&plans.acceleration, "Acceleration plan"),
    ];
    let is_whole = plans.velocity.tips.iter().any(|tip| tip.kind == TipKind::Singular);
    for point in scheme.singular.iter().filter(|_| is_whole) {
        let scale = assur_figure::scale(point, plans.acceleration.scale);
        parts.push(
            heading(&assur_figure::title(point), "a", scale, &unit(Quantity::Acceleration), PlanTurn::Upright)
                .with(assur_figure::figure(point, scale), assur_figure::table(point, scale)),
        );
    }
    if let Some(sheet) = &plans.centres {
        parts.push(
            heading(sentences::INSTANT_CENTRES, "l", sheet.scheme.scale, "m/mm", PlanTurn::Upright)
                .with(centre_figure::figure(sheet), centre_figure::table(sheet)),
        );
    }
    let mut sheet = DrawnFigure::default();
    let large = Type { bold: true, ..words(5.5) };
    let heading = format!("{name}, {}", plans.input.marked(plans.crank));
    sheet.text(Vec2::new(MARGIN, -MARGIN - 4.0), heading, large);
    sheet.text(Vec2::new(MARGIN, -MARGIN - 10.0), title, words(3.6));
    let wide = |figure: &DrawnFigure| figure.bounds()[1].x - figure.bounds()[0].x;
    let widest = parts.iter().map(|part| wide(&part.figure).larger(wide(&part.table))).fold(0.0, f64::larger);
    let mut top = -MARGIN - TITLE;
    for SheetPart { title, scale, figure, table } in &parts {
        sheet.text(Vec2::new(MARGIN, top - 4.5), title.as_str(), Type { bold: true, ..words(4.8) });
        sheet.text(Vec2::new(MARGIN, top - 10.0), scale.as_str(), words(3.6));
        let [low, high] = figure.bounds();
        let inset = (widest - wide(figure)) / 2.0;
        sheet.add(figure, Vec2::new(MARGIN + inset - low.x, top - HEADING - high.y));
        top -= HEADING + (high.y - low.y) + SPACE;
        let [table_low, table_high] = table.bounds();
        sheet.add(table, Vec2::new(MARGIN - table_low.x, top - table_high.y));
        top -= table_high.y - table_low.y + GAP;
    }
    let [low, high] = sheet.bounds();
    let size = [(high.x.larger(MARGIN + widest) + MARGIN).ceil(), (MARGIN - low.y).ceil()];
    Drawing { figure: sheet, size, title: name.into() }
}

/// Part of the sheet: a figure with its heading, and its table below.
struct SheetPart {
    title: String,
    scale: String,
    figure: DrawnFigure,
    table: DrawnFigure,
}

impl SheetPart {
    fn with(self, figure: DrawnFigure, table: LegendTable) -> Self {
        SheetPart { figure, table: table.figure(), ..self }
    }
}

fn heading(title: &str, index: &str, scale: f64, unit: &str, turn: PlanTurn) -> SheetPart {
    let scale = sentences::scale_factor_3(&"μ", &sub(index), &scale_shown(scale), &scripted(unit));
    let scale = match turn {
        PlanTurn::Upright => scale,
        PlanTurn::Clockwise | PlanTurn::CounterClockwise => sentences::turned_by(&scale, &turn.word()),
    };
    SheetPart { title: title.into(), scale, figure: DrawnFigure::default(), table: DrawnFigure::default() }
}

fn of_plan(plan: &VectorPlan, title: &str) -> SheetPart {
    heading(title, plan.quantity.symbol(), plan.scale, &unit(plan.quantity), plan.turn).with(figure(plan), table(plan))
}

/// Unit of a scale factor, such as `(m/s)/mm`.
fn unit(quantity: Quantity) -> String {
    format!("({})/mm", quantity.unit()).replace("s^2", "s²")
}

/// A scale factor, rounded to six significant digits.
pub fn scale_shown(scale: f64) -> String {
    format!("{:.5e}", scale).parse::<f64>().unwrap_or(scale).to_string()
}

/// Line style of each kind of vector.
fn style(vector: &Vector) -> Style {
    match vector.part {
        VectorKind::Absolute => solid(BLACK, 0.5),
        VectorKind::MassCentre => Style { colour: GREY, width: 0.3, dash: "2 0.9" },
        VectorKind::Relative => solid(colour(vector.link), 0.5),
        VectorKind::Normal => Style { colour: colour(vector.link), width: 0.35, dash: "1.8 1.1" },
        VectorKind::Tangential => Style { colour: colour(vector.link), width: 0.35, dash: "0.5 1" },
        VectorKind::Sliding => solid(colour(vector.link), 0.5),
        VectorKind::Coriolis => Style { colour: colour(vector.link), width: 0.35, dash: "3 0.9 0.5 0.9" },
    }
}

/// Draws the plan; its pole is the origin.
fn figure(plan: &VectorPlan) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let mut obstacles = Obstacles::default();
    let mut drawn: Vec<[Vec2; 2]> = Vec::new();
    for ends in plan.lines.iter().map(|ends| ends.map(|end| plan.on_paper(end))) {
        figure.line(ends, CONSTRUCTION);
        obstacles.segments.push(ends);
    }
    let order = [
        VectorKind::MassCentre,
        VectorKind::Absolute,
        VectorKind::Relative,
        VectorKind::Sliding,
        VectorKind::Normal,
        VectorKind::Tangential,
        VectorKind::Coriolis,
    ];
    for vector in order.into_iter().flat_map(|part| plan.vectors.iter().filter(move |vector| vector.part == part)) {
        let ends = [vector.start, vector.start + vector.value].map(|end| plan.on_paper(end));
        if (ends[1] - ends[0]).norm() > POINT {
            let size = significant(vector.value.norm());
            let title = format!("{} = {size} {}: {}", vector.name, plan.quantity.unit(), vector.meaning);
            let ends = beside(ends, &drawn);
            figure.arrow(ends, style(vector), title);
            obstacles.segments.push(ends);
            drawn.push(ends);
        }
    }
    let marks = marks(plan);
    for (index, (at, _)) in marks.iter().enumerate() {
        let radius = if index == 0 { 1.0 } else { 0.55 };
        figure.disc(*at, radius, if index == 0 { "white" } else { BLACK }, solid(BLACK, 0.35));
        obstacles.discs.push((*at, radius));
    }
    let centre = marks.iter().map(|(at, _)| *at).sum::<Vec2>() / marks.len() as f64;
    let labels: Vec<PlacedLabel> = marks
        .iter()
        .enumerate()
        .map(|(index, (at, text))| PlacedLabel {
            anchor: *at,
            away: if index == 0 { -centre } else { *at },
            size: label_size(text, LETTER),
            clear: if index == 0 { 1.0 } else { 0.55 },
        })
        .collect();
    for ((label, (_, text)), at) in labels.iter().zip(&marks).zip(place_among(&labels, &obstacles, 1)) {
        letter(&mut figure, label, at, text, lettering(BLACK));
    }
    figure
}

/// Shifts an arrow sideways until it no longer coincides with an arrow drawn before. The shift keeps the arrow's
/// length.
fn beside(ends: [Vec2; 2], drawn: &[[Vec2; 2]]) -> [Vec2; 2] {
    let along = (ends[1] - ends[0]).normalize();
    let aside = turned(along) * APART;
    let covers = |ends: &[Vec2; 2], other: &[Vec2; 2]| {
        let off = |at: &Vec2| cross(along, at - ends[0]).abs();
        let way = |at: &Vec2| (at - ends[0]).dot(&along);
        let [low, high] = [way(&other[0]).smaller(way(&other[1])), way(&other[0]).larger(way(&other[1]))];
        let common = high.smaller((ends[1] - ends[0]).norm()) - low.larger(0.0);
        other.iter().all(|at| off(at) < APART / 2.0) && common > SHARED
    };
    // The shifts go alternately to both sides, with growing distance.
    let shifts =
        (0..=2 * drawn.len()).map(|k| f64::from(k.div_ceil(2) as u32) * if k.is_multiple_of(2) { 1.0 } else { -1.0 });
    let mut places = shifts.map(|shift| ends.map(|end| end + aside * shift));
    places.find(|place| !drawn.iter().any(|other| covers(place, other))).unwrap_or(ends)
}

/// Points of the plan on paper, each with the letters of all points that coincide with it. The pole is the first point.
fn marks(plan: &VectorPlan) -> Vec<(Vec2, String)> {
    let mut marks: Vec<(Vec2, String)> = Vec::new();
    for tip in &plan.tips {
        let at = plan.on_paper(tip.at);
        match marks.iter_mut().find(|(place, _)| (place - at).norm() < ONE) {
            // The end of a normal or Coriolis acceleration needs no letter if it coincides on paper with another point
            // of the plan.
            Some(_) if matches!(tip.kind, TipKind::Normal | TipKind::Coriolis) => {}
            Some((_, text)) => *text += &format!(", {}", letters(tip)),
            None => marks.push((at, letters(tip))),
        }
    }
    marks
}

fn letters(tip: &Tip) -> String {
    let mut signs = tip.letter.chars();
    match (tip.kind, signs.next()) {
        (TipKind::MassCentre | TipKind::Normal | TipKind::Coincident | TipKind::Coriolis, Some(first)) => {
            format!("{first}{}", sub(signs.as_str()))
        }
        _ => tip.letter.clone(),
    }
}

/// Table of all vectors of the plan with their magnitudes.
fn table(plan: &VectorPlan) -> LegendTable {
    let letter = |name: &String| plan.tips.iter().find(|tip| tip.letter == *name).map_or_else(|| name.clone(), letters);
    let rows = plan.vectors.iter().map(|vector| {
        let meaning = vector.meaning.replace(", perpendicular to the ", " ⊥ ").replace(", along the ", " ∥ ");
        let meaning = meaning.replace(", perpendicular to ", " ⊥ ");
        let meaning = meaning.replace("omega^2", "ω²").replace("omega x", "ω ×").replace("alpha", "α");
        // At a dead point some vectors are only rounding error. The table shows the magnitude of such vectors as zero.
        let size = if plan.paper(vector) > NOTHING { vector.value.norm() } else { 0.0 };
        let cells = vec![
            scripted(&vector.name),
            format!("{} → {}", letter(&vector.from), letter(&vector.to)),
            significant(size),
            format!("{:.1}", plan.paper(vector)),
            meaning,
        ];
        (style(vector), cells)
    });
    let unit = if plan.quantity.unit() == "m/s" { "m/s" } else { "m/s²" };
    LegendTable {
        head: vec!["vector", sentences::FROM_TO, unit, "mm", "meaning"],
        rows: rows.collect(),
        numbers: &[2, 3],
    }
}
