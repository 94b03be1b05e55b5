//! One velocity or acceleration plan as a figure, and the table of its vectors.

use super::figure::{Figure, Style, Type, scripted, solid, sub, width, words};
use super::labels::{Label, Obstacles, place};
use super::style::{BLACK, GREY, colour, significant};
use super::table::Table;
use crate::diagram::builder::NOTHING;
use crate::diagram::vectors::{Part, Plan, Tip, TipKind, Vector};
use linkage::math::{KeepNan, Vec2};

/// Font size of labels (mm).
pub const LETTER: f64 = 4.2;
/// Points closer to each other on paper than this (mm) share one label.
const ONE: f64 = 0.7;
/// Arrows shorter than this (mm) are drawn as points.
const POINT: f64 = 0.15;
/// Labels farther than this from their point (mm) are connected with it by a line.
const FAR: f64 = 3.2;

/// Line style of each kind of vector.
pub fn style(vector: &Vector) -> Style {
    match vector.part {
        Part::Absolute => solid(BLACK, 0.5),
        Part::MassCentre => Style { colour: GREY, width: 0.3, dash: "2 0.9" },
        Part::Relative => solid(colour(vector.link), 0.5),
        Part::Normal => Style { colour: colour(vector.link), width: 0.35, dash: "1.8 1.1" },
        Part::Tangential => Style { colour: colour(vector.link), width: 0.35, dash: "0.5 1" },
        Part::Sliding => solid(colour(vector.link), 0.5),
        Part::Coriolis => Style { colour: colour(vector.link), width: 0.35, dash: "3 0.9 0.5 0.9" },
    }
}

/// The plan; its pole is the origin.
pub fn plan(plan: &Plan) -> Figure {
    let mut figure = Figure::default();
    let mut obstacles = Obstacles::default();
    let order = [
        Part::MassCentre,
        Part::Absolute,
        Part::Relative,
        Part::Sliding,
        Part::Normal,
        Part::Tangential,
        Part::Coriolis,
    ];
    for vector in order.into_iter().flat_map(|part| plan.vectors.iter().filter(move |vector| vector.part == part)) {
        let ends = [vector.start, vector.start + vector.value].map(|end| end / plan.scale);
        if (ends[1] - ends[0]).norm() > POINT {
            let size = significant(vector.value.norm());
            let title = format!("{} = {size} {}: {}", vector.name, plan.quantity.unit(), vector.meaning);
            figure.arrow(ends, style(vector), title);
            obstacles.segments.push(ends);
        }
    }
    let marks = marks(plan);
    for (index, (at, _)) in marks.iter().enumerate() {
        let radius = if index == 0 { 1.0 } else { 0.55 };
        figure.disc(*at, radius, if index == 0 { "white" } else { BLACK }, solid(BLACK, 0.35));
        obstacles.discs.push((*at, radius));
    }
    let centre = marks.iter().map(|(at, _)| *at).sum::<Vec2>() / marks.len() as f64;
    let labels: Vec<Label> = marks
        .iter()
        .enumerate()
        .map(|(index, (at, text))| Label {
            anchor: *at,
            away: if index == 0 { -centre } else { *at },
            size: label_size(text),
            clear: if index == 0 { 1.0 } else { 0.55 },
        })
        .collect();
    let places = place(&labels, &obstacles);
    for ((label, (_, text)), at) in labels.iter().zip(&marks).zip(places) {
        letter(&mut figure, label, at, text, BLACK);
    }
    figure
}

/// Box of a label.
/// It is a little larger than its letters in the fonts that viewers fall back on, subscripts included.
pub fn label_size(text: &str) -> Vec2 {
    Vec2::new(1.05 * width(text, LETTER), 1.15 * LETTER)
}

/// A label at its position, with a line to its point if that is far away.
pub fn letter(figure: &mut Figure, label: &Label, at: Vec2, text: &str, paint: &'static str) {
    let toward = label.anchor - at;
    let half = label.size / 2.0;
    let edge = (half.x / toward.x.abs().larger(1e-9)).smaller(half.y / toward.y.abs().larger(1e-9));
    if toward.norm() * (1.0 - edge) > FAR + label.clear {
        let end = label.anchor - toward.normalize() * (label.clear + 0.2);
        figure.line([at + toward * edge, end], solid(GREY, 0.15));
    }
    let set = Type { anchor: "middle", italic: true, colour: paint, ..words(LETTER) };
    figure.text(at - Vec2::new(0.0, 0.28 * LETTER), text, set);
}

/// Points of the plan on paper, with the letters of all points that coincide there; the pole is first.
fn marks(plan: &Plan) -> Vec<(Vec2, String)> {
    let mut marks: Vec<(Vec2, String)> = Vec::new();
    for tip in &plan.tips {
        let at = tip.at / plan.scale;
        match marks.iter_mut().find(|(place, _)| (place - at).norm() < ONE) {
            // The end of a part that coincides visibly with another point needs no letter.
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

/// All vectors of the plan with their magnitudes.
pub fn table(plan: &Plan) -> Table {
    let letter = |name: &String| plan.tips.iter().find(|tip| tip.letter == *name).map_or_else(|| name.clone(), letters);
    let rows = plan.vectors.iter().map(|vector| {
        let meaning = vector.meaning.replace(", perpendicular to the ", " ⊥ ").replace(", along the ", " ∥ ");
        let meaning = meaning.replace(", perpendicular to ", " ⊥ ");
        let meaning = meaning.replace("omega^2", "ω²").replace("omega x", "ω ×").replace("alpha", "α");
        // At a dead point some vectors consist of rounding errors only.
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
    Table { head: vec!["vector", "from → to", unit, "mm", "meaning"], rows: rows.collect(), numbers: &[2, 3] }
}
