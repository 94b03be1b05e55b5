//! Figure that constructs the acceleration of a group's singular point: from the leads, or by two false positions.
//! Leads are links of the group with two joints; their lines meet in the singular point.

use super::scheme_figure::CONSTRUCTION;
use crate::plan::names::SINGULAR;
use crate::plan::singular::{AssurAcceleration, AssurTrial, SingularPoint};
use crate::sentences;
use drawing::paper::figure::{DrawnFigure, Style, solid, sub};
use drawing::paper::labels::{LETTER, Obstacles, PlacedLabel, label_size, letter, lettering, place_among};
use drawing::paper::scale::factor;
use drawing::paper::style::{BLACK, COLOURS, GREY, significant};
use drawing::paper::table::LegendTable;
use linkage::math::{KeepNan, Vec2};

/// Largest distance of a point of the figure from the pole (mm).
const ROOM: f64 = 110.0;
/// Points closer to each other on paper than this (mm) share one label.
const ONE: f64 = 0.7;
/// Line styles of the accelerations of ends of leads and outer joints, and of the normal accelerations added to them.
const ENDS: Style = Style { colour: GREY, width: 0.3, dash: "2 0.9" };
const NORMAL: Style = Style { colour: COLOURS[0], width: 0.35, dash: "1.8 1.1" };
/// Line styles of two lines of the construction by two false positions, which meet in the true acceleration.
/// `FALSE` is the line through the two false positions.
/// `TRUE` is perpendicular to the arm from the outer joint to the point.
const FALSE: Style = solid(COLOURS[1], 0.35);
const TRUE: Style = solid(COLOURS[0], 0.35);

/// Heading of the figure.
pub fn title(point: &SingularPoint) -> String {
    let [name, _] = SINGULAR;
    match point.acceleration {
        AssurAcceleration::Known(_) => sentences::acceleration_of_by_its_leads(&name, &point.lines()),
        AssurAcceleration::FalsePositions(_) => sentences::acceleration_of_by_false_positions(&name, &point.lines()),
    }
}

/// Scale factor of the figure ((m/s^2)/mm): the scale factor `plan` of the acceleration plan, or a larger factor if
/// the figure would not fit on paper.
pub fn scale(point: &SingularPoint, plan: f64) -> f64 {
    let marks = marks(point);
    let largest = marks.iter().map(|(at, _)| at.norm()).fold(0.0, f64::larger);
    plan.larger(factor(largest, ROOM))
}

/// Points of one construction of the acceleration (SI, from the pole) with their letters. `stars` is added to each
/// letter.
fn of_trial(point: &SingularPoint, trial: &AssurTrial, stars: &str) -> Vec<(Vec2, String)> {
    let ends =
        point.leads.iter().zip(trial.far).map(|(lead, at)| (at, format!("{}{stars}", lead.names[1].to_lowercase())));
    ends.chain([(trial.at, format!("{}{stars}", SINGULAR[1]))]).collect()
}

/// Points of the figure (SI, from the pole) with their letters. The pole is first.
fn marks(point: &SingularPoint) -> Vec<(Vec2, String)> {
    let pole = (Vec2::zeros(), "π".to_string());
    let rest = match &point.acceleration {
        AssurAcceleration::Known(trial) => of_trial(point, trial, ""),
        AssurAcceleration::FalsePositions(found) => {
            let [(_, first), (_, second)] = &found.trials;
            let own = [(found.at, SINGULAR[1].to_string()), (found.foot, format!("n{}", sub(SINGULAR[0])))];
            let trials = [of_trial(point, first, "*"), of_trial(point, second, "**")].concat();
            trials.into_iter().chain(own).collect()
        }
    };
    std::iter::once(pole).chain(rest).collect()
}

/// Draws the construction; the pole is the origin.
pub fn figure(point: &SingularPoint, scale: f64) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let mut obstacles = Obstacles::default();
    let mut line = |figure: &mut DrawnFigure, ends: [Vec2; 2], style: Style, is_arrow: bool| {
        let ends = ends.map(|end| end / scale);
        if (ends[1] - ends[0]).norm() > 0.1 {
            if is_arrow {
                figure.arrow(ends, style, String::new())
            } else {
                figure.line(ends, style)
            }
            obstacles.segments.push(ends);
        }
    };
    let mut chain = |figure: &mut DrawnFigure, trial: &AssurTrial| {
        for (far, foot) in trial.far.into_iter().zip(trial.feet) {
            line(figure, [Vec2::zeros(), far], ENDS, true);
            line(figure, [far, foot], NORMAL, true);
            line(figure, [foot, trial.at], CONSTRUCTION, false);
        }
    };
    match &point.acceleration {
        AssurAcceleration::Known(trial) => {
            chain(&mut figure, trial);
            line(&mut figure, [Vec2::zeros(), trial.at], solid(BLACK, 0.5), true);
        }
        AssurAcceleration::FalsePositions(found) => {
            let [(_, first), (_, second)] = &found.trials;
            chain(&mut figure, first);
            chain(&mut figure, second);
            line(&mut figure, span(&[first.at, second.at, found.at]), FALSE, false);
            line(&mut figure, [Vec2::zeros(), found.outer], ENDS, true);
            line(&mut figure, [found.outer, found.foot], NORMAL, true);
            line(&mut figure, [found.foot, found.at], TRUE, false);
            line(&mut figure, [Vec2::zeros(), found.at], solid(BLACK, 0.5), true);
        }
    }
    let mut marked: Vec<(Vec2, String)> = Vec::new();
    for (at, text) in marks(point) {
        match marked.iter_mut().find(|(place, _)| (*place - at).norm() < ONE * scale) {
            Some((_, letters)) => *letters += &format!(", {text}"),
            None => marked.push((at, text)),
        }
    }
    let labels: Vec<PlacedLabel> = marked
        .iter()
        .map(|(at, text)| PlacedLabel {
            anchor: at / scale,
            away: Vec2::zeros(),
            size: label_size(text, LETTER),
            clear: 0.8,
        })
        .collect();
    for (index, label) in labels.iter().enumerate() {
        let (radius, fill) = if index == 0 { (1.0, "white") } else { (0.55, BLACK) };
        figure.disc(label.anchor, radius, fill, solid(BLACK, 0.35));
        obstacles.discs.push((label.anchor, radius));
    }
    for ((label, (_, text)), at) in labels.iter().zip(&marked).zip(place_among(&labels, &obstacles, 1)) {
        letter(&mut figure, label, at, text, lettering(BLACK));
    }
    figure
}

/// Ends of the segment that contains all `points`, which lie on one line.
fn span(points: &[Vec2]) -> [Vec2; 2] {
    let pairs = points.iter().flat_map(|one| points.iter().map(move |other| [*one, *other]));
    pairs.max_by(|a, b| (a[1] - a[0]).norm().total_cmp(&(b[1] - b[0]).norm())).unwrap_or([Vec2::zeros(); 2])
}

/// Table of the vectors in the figure.
pub fn table(point: &SingularPoint, scale: f64) -> LegendTable {
    let [name, own] = SINGULAR;
    let row = |style: Style, letter: String, at: Vec2, meaning: String| {
        (style, vec![letter, significant(at.norm()), format!("{:.1}", at.norm() / scale), meaning])
    };
    let normals = (NORMAL, vec![String::new(), String::new(), String::new(), sentences::NORMAL_PARTS_ALONG.into()]);
    let mut rows = Vec::new();
    match &point.acceleration {
        AssurAcceleration::Known(trial) => {
            rows.push((CONSTRUCTION, blank(sentences::TANGENTIAL_PARTS_ACROSS)));
            rows.push(row(solid(BLACK, 0.5), format!("π → {own}"), trial.at, sentences::acceleration_of(&name)));
        }
        AssurAcceleration::FalsePositions(found) => {
            let driver = found.driver;
            for (stars, (alpha, trial)) in ["*", "**"].into_iter().zip(&found.trials) {
                let meaning = sentences::false_position_for_alpha(&driver, &significant(*alpha));
                rows.push(row(CONSTRUCTION, format!("π → {own}{stars}"), trial.at, meaning));
            }
            rows.push((FALSE, blank(sentences::LINE_OF_FALSE_POSITIONS)));
            rows.push((TRUE, blank(sentences::LINE_OF_TRUE_POSITIONS)));
            let [first, second] = found.alphas.map(significant);
            let meaning = sentences::acceleration_of_with_alphas(&name, &driver, &first, &point.links[0].0, &second);
            rows.push(row(solid(BLACK, 0.5), format!("π → {own}"), found.at, meaning));
        }
    }
    rows.insert(0, normals);
    LegendTable { head: vec!["vector", "m/s²", "mm", "meaning"], rows, numbers: &[1, 2] }
}

fn blank(meaning: &str) -> Vec<String> {
    vec![String::new(), String::new(), String::new(), meaning.into()]
}
