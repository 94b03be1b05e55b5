//! One velocity or acceleration plan as a figure, and the table of its vectors.

use crate::diagram::builder::NOTHING;
use crate::diagram::vectors::{Part, Plan, Tip, TipKind, Vector};
use drawing::paper::figure::{Figure, Style, scripted, solid, sub};
use drawing::paper::labels::{Label, Obstacles, place_among};
use drawing::paper::lettering::{label_size, letter};
use drawing::paper::style::{BLACK, GREY, colour, significant};
use drawing::paper::table::Table;
use linkage::math::{KeepNan, Vec2, cross, turned};

/// Points closer to each other on paper than this (mm) share one label.
const ONE: f64 = 0.7;
/// Distance (mm) of arrows that would lie on each other, and the length that they must share for it.
const APART: f64 = 0.8;
const SHARED: f64 = 1.0;
/// Arrows shorter than this (mm) are drawn as points.
const POINT: f64 = 0.15;

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
    let mut drawn: Vec<[Vec2; 2]> = Vec::new();
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
    for ((label, (_, text)), at) in labels.iter().zip(&marks).zip(place_among(&labels, &obstacles, 1)) {
        letter(&mut figure, label, at, text, BLACK);
    }
    figure
}

/// An arrow beside all those drawn before that would cover it: vectors on one line are set apart, their lengths kept.
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
    // To either side in turn, ever farther.
    let shifts =
        (0..=2 * drawn.len()).map(|k| f64::from(k.div_ceil(2) as u32) * if k.is_multiple_of(2) { 1.0 } else { -1.0 });
    let mut places = shifts.map(|shift| ends.map(|end| end + aside * shift));
    places.find(|place| !drawn.iter().any(|other| covers(place, other))).unwrap_or(ends)
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
