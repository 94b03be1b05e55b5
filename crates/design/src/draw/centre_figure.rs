//! Figure of the instant centres and acceleration centres, with the construction lines of the instant centres.

use crate::plan::centre_sheet::{CentreSheet, position};
use crate::plan::centres::{CentreLine, CentreOrigin, InstantCentre};
use crate::sentences;
use drawing::inside;
use drawing::paper::figure::{DrawnFigure, Style, Tint, solid, sub};
use drawing::paper::style::{BLACK, GREY, colour, significant};
use drawing::paper::table::LegendTable;
use drawing::picture::Picture;
use linkage::math::Vec2;
use linkage::math::centre::MotionCentre;
use linkage::mechanism::LinkId;

/// Style of construction lines.
const LINE: Style = Style { colour: GREY, width: 0.2, dash: "4 1 0.5 1" };
/// Length of an arrow towards a centre outside the drawing (mm).
const ARROW: f64 = 9.0;
/// Half the width of the mark of an acceleration centre (mm).
const MARK: f64 = 1.1;
/// A length on paper that is greater than every drawing (mm).
const BEYOND: f64 = 1e5;

/// Draws the mechanism with the centres; the world origin is the figure's origin.
pub fn figure(sheet: &CentreSheet) -> DrawnFigure {
    let scheme = &sheet.scheme;
    let paper = Paper { window: sheet.window.map(|corner| corner / scheme.scale), scale: scheme.scale };
    let mut picture = Picture::of(&scheme.sketch, &scheme.places, scheme.scale);
    picture.draw_marks();
    let mut names: Vec<(Vec2, String)> = Vec::new();
    for centre in sheet.instant() {
        let mut reaches = None;
        if let CentreOrigin::Lines(lines) = &centre.origin {
            for line in lines {
                if let Some(ends) = paper.line(sheet, centre, line) {
                    picture.figure.line(ends, LINE);
                    picture.obstacles.segments.push(ends);
                    reaches = reaches.or(Some(ends));
                }
            }
        }
        let name = format!("P{}", sub(&centre.numbers()));
        match paper.place(centre.place) {
            Some(at) => names.push((at, name)),
            None => {
                if let Some([start, tip]) = paper.toward(centre, reaches) {
                    picture.figure.arrow([start, tip], solid(GREY, 0.25), format!("P{}", centre.numbers()));
                    picture.obstacles.segments.push([start, tip]);
                    picture.letters(tip, tip - start, 0.5, name, BLACK);
                }
            }
        }
    }
    // Construction lines may go through centres of links that are not chosen. These centres are named too.
    let supports: Vec<_> = sheet.instant().flat_map(|centre| supports(sheet, centre)).collect();
    for centre in supports {
        let name = (paper.place(centre.place), format!("P{}", sub(&centre.numbers())));
        if let (Some(at), name) = name
            && !names.contains(&(at, name.clone()))
        {
            names.push((at, name));
        }
    }
    for (at, _) in &names {
        picture.figure.disc(*at, 0.55, BLACK, solid(BLACK, 0.2));
    }
    for (link, place) in sheet.acceleration() {
        if let Some(at) = paper.place(place) {
            let corners = [Vec2::x(), Vec2::y(), -Vec2::x(), -Vec2::y()].map(|way| at + way * MARK);
            picture.figure.area(corners.to_vec(), Some(Tint::opaque("white")), solid(colour(link), 0.45));
            picture.obstacles.discs.push((at, MARK));
            names.push((at, format!("π{}", sub(&link.to_string()))));
        }
    }
    picture.number_links();
    picture.name(names);
    picture.finish(1)
}

/// The centres through which the construction lines of `centre` go.
fn supports<'a>(sheet: &'a CentreSheet, centre: &'a InstantCentre) -> Vec<&'a InstantCentre> {
    let CentreOrigin::Lines(lines) = &centre.origin else { return Vec::new() };
    let third = |line: &CentreLine| match line {
        CentreLine::Through(third) => Some(*third),
        CentreLine::Contact { .. } => None,
    };
    let pairs = lines.iter().filter_map(third).flat_map(|third| centre.links.map(|own| [own, third]));
    pairs.filter_map(|[own, third]| sheet.centres.between(own, third)).collect()
}

/// The drawn part of the plane, on paper (mm).
struct Paper {
    window: [Vec2; 2],
    scale: f64,
}

impl Paper {
    /// Position of a centre on paper; `None` if the centre is outside the window.
    fn place(&self, place: MotionCentre) -> Option<Vec2> {
        let at = position(place)? / self.scale;
        let [low, high] = self.window;
        (at == at.sup(&low).inf(&high)).then_some(at)
    }

    /// The part of a segment inside the window.
    fn clipped(&self, ends: [Vec2; 2]) -> Option<[Vec2; 2]> {
        let [low, high] = self.window;
        let [from, to] = inside(&ends, (low + high) / 2.0, (high - low) / 2.0)?;
        Some([from, to].map(|share| ends[0] + (ends[1] - ends[0]) * share))
    }

    /// The drawn part of a construction line of `centre`.
    /// A line through two other centres is drawn as far as it connects `centre` and these centres.
    /// The line of action of a transmission is drawn from `centre` to the point at which the force acts.
    /// The line is cut off at the edge of the window.
    fn line(&self, sheet: &CentreSheet, centre: &InstantCentre, line: &CentreLine) -> Option<[Vec2; 2]> {
        let places = match line {
            CentreLine::Through(third) => {
                let others = centre.links.map(|own| sheet.centres.between(own, *third).map(|centre| centre.place));
                [Some(centre.place), others[0], others[1]]
            }
            CentreLine::Contact { foot, .. } => [Some(centre.place), Some(MotionCentre::At(*foot)), None],
        };
        let points: Vec<Vec2> = places.into_iter().flatten().filter_map(position).map(|at| at / self.scale).collect();
        let away = places.into_iter().flatten().find_map(|place| match place {
            MotionCentre::AtInfinity(direction) => Some(direction),
            MotionCentre::At(_) | MotionCentre::Nowhere | MotionCentre::Everywhere => None,
        });
        let base = *points.first()?;
        let farthest = points.iter().map(|at| at - base).max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let along = away.or_else(|| (farthest.norm() > 0.0).then(|| farthest.normalize()))?;
        let way = |at: &Vec2| (at - base).dot(&along);
        let first = points.iter().min_by(|a, b| way(a).total_cmp(&way(b)))?;
        let last = points.iter().max_by(|a, b| way(a).total_cmp(&way(b)))?;
        let last = if away.is_some() { first + along * BEYOND } else { *last };
        self.clipped([*first, last])
    }

    /// An arrow towards a centre outside the window.
    /// The arrow starts at the centre's guide, or else at an end of `line`.
    /// If there is neither a guide nor a line, an arrow to a centre at infinity starts at the edge of the window, and
    /// an arrow to any other centre starts in the middle of the window.
    fn toward(&self, centre: &InstantCentre, line: Option<[Vec2; 2]>) -> Option<[Vec2; 2]> {
        let middle = (self.window[0] + self.window[1]) / 2.0;
        let (start, direction) = match (centre.place, &centre.origin) {
            (MotionCentre::AtInfinity(direction), CentreOrigin::Guide { block, .. }) => {
                let at = block / self.scale;
                (at, if (at - middle).dot(&direction) < 0.0 { -direction } else { direction })
            }
            (MotionCentre::AtInfinity(direction), _) => {
                let end = line.map_or([middle, middle + direction * BEYOND], |line| line);
                let end = self.clipped(end)?;
                (end[1], if (end[1] - end[0]).dot(&direction) < 0.0 { -direction } else { direction })
            }
            (MotionCentre::At(at), _) => {
                let at = at / self.scale;
                let from = line.map_or(
                    middle,
                    |[one, other]| {
                        if (one - at).norm() < (other - at).norm() { one } else { other }
                    },
                );
                (from, (at - from).normalize())
            }
            (MotionCentre::Nowhere | MotionCentre::Everywhere, _) => return None,
        };
        Some([start, start + direction * ARROW])
    }
}

/// Table of the centres.
pub fn table(sheet: &CentreSheet) -> LegendTable {
    let cells = |name: String, place: MotionCentre, found: String| {
        let [x, y] = match place {
            MotionCentre::At(at) => [at.x, at.y].map(significant),
            MotionCentre::AtInfinity(direction) => [sentences::AT_INFINITY.into(), toward(direction)],
            MotionCentre::Nowhere => [sentences::NOWHERE.into(), String::new()],
            MotionCentre::Everywhere => [sentences::EVERYWHERE.into(), String::new()],
        };
        vec![name, x, y, found]
    };
    let instant = sheet.instant().map(|centre| {
        (LINE, cells(format!("P{}", sub(&centre.numbers())), centre.place, centre.told().replace(" x ", " × ")))
    });
    let acceleration = sheet.acceleration().map(|(link, place): (LinkId, MotionCentre)| {
        let name = format!("π{}", sub(&link.to_string()));
        (solid(colour(link), 0.5), cells(name, place, sentences::acceleration_centre_of_link(&link)))
    });
    LegendTable {
        head: vec!["centre", "x, m", "y, m", "found"],
        rows: instant.chain(acceleration).collect(),
        numbers: &[1, 2],
    }
}

/// Direction of a centre at infinity as text. The angle is above -90 deg and at most 90 deg.
pub fn toward(direction: Vec2) -> String {
    let degrees = (direction.y / direction.x).atan().to_degrees();
    let degrees = (degrees * 100.0).round() / 100.0 + 0.0;
    format!("{:.2}°", if degrees > -90.0 { degrees } else { 90.0 })
}
