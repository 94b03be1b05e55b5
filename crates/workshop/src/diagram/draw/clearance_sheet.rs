//! Clearance as a drawing: the housing, the positions of all links over the range, the links at the start, and the
//! smallest distance.

use crate::clearance::{Clearance, Outline, Question, poses};
use drawing::paper::figure::clean;
use drawing::paper::style::{BLACK, colour, significant};
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{KeepNan, Motion, Vec2};
use linkage::mechanism::GROUND;
use svg::Document;
use svg::node::element::{Circle, Group, Line, Path, Rectangle, Text, Title};

/// Longer side of the drawing, margin and size of letters (mm on paper).
const LONG: f64 = 200.0;
const MARGIN: f64 = 10.0;
const LETTERS: f64 = 4.0;
/// Height of the words below.
const CAPTION: f64 = 14.0;
/// Positions of a link that make its swept area.
const POSITIONS: usize = 240;

/// Colour of the smallest distance and of a collision.
const ALARM: &str = "#d11149";

/// Draws a question and its answer. Swept areas are shown by many positions of each link.
///
/// # Errors
/// Those of a pose.
pub fn clearance(case: &Case, name: &str, asked: &Question, found: &Clearance) -> Result<String> {
    let [from, to] = found.range;
    let cranks: Vec<f64> = (0..=POSITIONS).map(|k| from + (to - from) * (k as f64 / POSITIONS as f64)).collect();
    let smallest = found.smallest().filter(|pair| pair.smallest.distance.is_finite());
    let shown = found
        .first_collision()
        .map_or_else(|| smallest.map_or(from, |pair| pair.smallest.crank), |(_, meeting)| meeting.cranks[1]);
    let all = poses(case, &cranks)?;
    let here = poses(case, &[shown])?.remove(0);
    let sheet = Sheet::around(asked, &all);
    let mut document = sheet.document(name);
    let mut swept = Group::new();
    for (number, body) in asked.bodies.iter().enumerate().filter(|(_, body)| body.moves()) {
        let mut group = Group::new().set("opacity", 0.22).add(Title::new(clean(&format!("swept by {}", body.name))));
        for pose in &all {
            group = group.add(sheet.outline(&body.outline, &pose[body.link], colour(number + 1)));
        }
        swept = swept.add(group);
    }
    document = document.add(swept);
    for body in asked.bodies.iter().filter(|body| !body.moves()) {
        let title = Title::new(clean(&body.name));
        document = document.add(Group::new().add(title).add(sheet.outline(&body.outline, &Motion::REST, "#555555")));
    }
    for (number, body) in asked.bodies.iter().enumerate().filter(|(_, body)| body.moves()) {
        let own = sheet.outline(&body.outline, &here[body.link], colour(number + 1));
        document = document.add(Group::new().set("opacity", 0.85).add(Title::new(clean(&body.name))).add(own));
    }
    for joint in case.mechanism.joints().iter().filter(|joint| joint.is_pin()) {
        let at = sheet.paper(here[joint.first.link].point(joint.first.local));
        let fill = if joint.on(GROUND).is_some() { BLACK } else { "white" };
        document = document.add(disc(at, 1.1, fill));
    }
    let crank = format!("crank angle {} deg", significant(shown.to_degrees()));
    let words = if let Some((pair, meeting)) = found.first_collision() {
        document = document.add(disc(sheet.paper(meeting.place), 2.2, ALARM));
        let [a, b] = pair.bodies.map(|body| &asked.bodies[body].name);
        [format!("first collision: {a} and {b}"), format!("at {crank}")]
    } else if let Some(pair) = smallest {
        let [one, two] = pair.smallest.points.map(|point| sheet.paper(point));
        let line = Line::new().set("x1", mm(one.x)).set("y1", mm(one.y)).set("x2", mm(two.x)).set("y2", mm(two.y));
        document = document.add(line.set("stroke", ALARM).set("stroke-width", 0.8));
        document = document.add(disc(one, 0.9, ALARM)).add(disc(two, 0.9, ALARM));
        let [a, b] = pair.bodies.map(|body| &asked.bodies[body].name);
        [
            format!("smallest distance {} mm:", significant(1e3 * pair.smallest.distance)),
            format!("{a} and {b} at {crank}"),
        ]
    } else {
        [crank, String::new()]
    };
    for (row, words) in words.iter().enumerate() {
        let y = sheet.size.y - CAPTION + LETTERS * (1.0 + 1.3 * row as f64);
        let text = Text::new(clean(words)).set("x", MARGIN).set("y", mm(y)).set("font-size", LETTERS);
        document = document.add(text.set("fill", BLACK));
    }
    Ok(format!("{document}\n"))
}

/// Where the world lies on the paper.
struct Sheet {
    low: Vec2,
    scale: f64,
    size: Vec2,
}

impl Sheet {
    fn around(asked: &Question, all: &[Vec<Motion>]) -> Self {
        let (mut low, mut high) = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        for body in &asked.bodies {
            let radius = Vec2::repeat(body.outline.radius());
            for pose in all {
                for &corner in body.outline.corners() {
                    let at = pose[body.link].point(corner);
                    (low, high) = (low.inf(&(at - radius)), high.sup(&(at + radius)));
                }
            }
        }
        let extent = (high - low).amax().larger(f64::MIN_POSITIVE);
        let scale = (LONG - 2.0 * MARGIN) / extent;
        let size = (high - low) * scale + Vec2::new(2.0 * MARGIN, 2.0 * MARGIN + CAPTION);
        Sheet { low, scale, size: Vec2::new(size.x.larger(LONG * 0.5), size.y) }
    }

    fn document(&self, name: &str) -> Document {
        let [wide, high] = [mm(self.size.x), mm(self.size.y)];
        Document::new()
            .set("width", format!("{wide}mm"))
            .set("height", format!("{high}mm"))
            .set("viewBox", format!("0 0 {wide} {high}"))
            .set("font-family", "Liberation Sans, Arial, Helvetica, sans-serif")
            .set("stroke-linecap", "round")
            .set("stroke-linejoin", "round")
            .add(Title::new(clean(&format!("{name}: clearance"))))
            .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "white"))
    }

    fn paper(&self, world: Vec2) -> Vec2 {
        let at = (world - self.low) * self.scale;
        Vec2::new(MARGIN + at.x, self.size.y - MARGIN - CAPTION - at.y)
    }

    /// An outline as a path: its rounding is the width of a line with round joins.
    fn outline(&self, outline: &Outline, pose: &Motion, colour: &str) -> Path {
        let corners: Vec<String> = outline
            .corners()
            .iter()
            .map(|&corner| {
                let at = self.paper(pose.point(corner));
                format!("{} {}", mm(at.x), mm(at.y))
            })
            .collect();
        // A single place is a line to itself.
        let line =
            if corners.len() == 1 { [&corners[0], &corners[0]].map(String::from).join("L") } else { corners.join("L") };
        let wide = (2.0 * outline.radius() * self.scale).larger(if outline.is_solid() { 0.0 } else { 0.2 });
        let path = Path::new().set("stroke", colour).set("stroke-width", mm(wide));
        match outline.is_solid() {
            true => path.set("d", format!("M{line}Z")).set("fill", colour),
            false => path.set("d", format!("M{line}")).set("fill", "none"),
        }
    }
}

fn disc(at: Vec2, radius: f64, fill: &str) -> Circle {
    let circle = Circle::new().set("cx", mm(at.x)).set("cy", mm(at.y)).set("r", radius).set("fill", fill);
    circle.set("stroke", BLACK).set("stroke-width", 0.3)
}

/// A length on paper rounded to thousandths of a millimetre; zero has no sign.
fn mm(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0 + 0.0
}
