//! The kinematic diagram as a figure.

use super::figure::{Figure, Style, Type, solid, sub, words};
use super::guide_figure;
use super::labels::{Label, Obstacles, place};
use super::plan_figure::{LETTER, label_size, letter};
use super::style::{BLACK, GREY, colour, significant};
use super::table::Table;
use crate::diagram::scheme::{Scheme, SchemeLink};
use crate::diagram::singular::SingularPoint;
use linkage::math::{KeepNan, Vec2, cross, turned, unit};

/// Radius (mm) of a joint's mark, of the disc around a link's number, and of a mass centre's mark.
const PIN: f64 = 1.1;
const NUMBER: f64 = 2.1;
const MASS: f64 = 1.0;
/// Radius (mm) of the arrow that shows the crank's sense of rotation, and its angle (rad).
const SENSE: f64 = 8.0;
const SWEEP: f64 = 1.7;
/// Share of the natural scale below which an angular velocity or acceleration is rounding.
const ROUNDING: f64 = 1e-12;
/// A singular point farther than this (mm) from the ends of the leads is not drawn.
const NEAR: f64 = 120.0;

/// The mechanism; the world's origin is the figure's origin.
pub fn scheme(scheme: &Scheme) -> Figure {
    let (mut figure, mut obstacles) = (Figure::default(), Obstacles::default());
    let paper = |at: &Vec2| at / scheme.scale;
    let is_mark = |at: &Vec2| scheme.marks.contains(at);
    let pivots = scheme.points[..scheme.fixed].iter().map(|(_, at)| at).filter(|at| !is_mark(at)).map(paper);
    let pivots: Vec<Vec2> = pivots.collect();
    let taken: Vec<[Vec2; 2]> = pivots.iter().map(|at| [at - Vec2::new(0.0, 2.0), Vec2::new(5.2, 5.0)]).collect();
    guide_figure::rails(&mut figure, scheme, &taken, &mut obstacles);
    for at in pivots {
        ground(&mut figure, at, &mut obstacles);
    }
    let mut labels: Vec<(Label, String, &'static str)> = Vec::new();
    for (at, leads) in scheme.singular.iter().filter_map(|point| lines_through(scheme, point)) {
        for ends in leads {
            figure.line(ends, Style { colour: GREY, width: 0.25, dash: "4 1 0.5 1" });
            obstacles.segments.push(ends);
        }
        figure.disc(at, 0.5, BLACK, solid(BLACK, 0.2));
        labels.push((
            Label { anchor: at, away: Vec2::zeros(), size: Vec2::new(LETTER, LETTER), clear: 0.6 },
            "S".into(),
            BLACK,
        ));
    }
    for link in &scheme.links {
        let corners = hull(link.places.iter().map(paper).collect());
        let paint = colour(link.number);
        let closed = corners.len() > 2;
        let sides = if closed { corners.len() } else { corners.len().saturating_sub(1) };
        let side = |k: usize| [corners[k], corners[(k + 1) % corners.len()]];
        obstacles.segments.extend((0..sides).map(side));
        let longest = (0..sides).map(side).max_by(|a, b| (a[1] - a[0]).norm().total_cmp(&(b[1] - b[0]).norm()));
        let anchor = match longest {
            Some([a, b]) if !closed => (a + b) / 2.0,
            None => link.places.first().map_or_else(Vec2::zeros, paper),
            _ => corners.iter().sum::<Vec2>() / corners.len().max(1) as f64,
        };
        let size = Vec2::new(2.0 * NUMBER, 2.0 * NUMBER);
        labels.push((Label { anchor, away: Vec2::zeros(), size, clear: 0.3 }, link.number.to_string(), paint));
        figure.shape(corners, closed, closed.then_some((paint, 0.14)), solid(paint, 0.9));
        if let Some(at) = link.mass_centre.as_ref().map(paper) {
            obstacles.discs.push((at, MASS));
        }
    }
    guide_figure::slots(&mut figure, scheme, &mut obstacles);
    guide_figure::blocks(&mut figure, scheme, &mut obstacles);
    if let Some(driver) = scheme.links.iter().find(|link| link.number == scheme.driver) {
        labels.extend(rotation(&mut figure, driver, scheme.scale, &mut obstacles));
    }
    for link in &scheme.links {
        if let Some(at) = link.mass_centre.as_ref().map(paper) {
            mass_centre(&mut figure, at);
        }
    }
    let mut named: Vec<(Vec2, String)> = Vec::new();
    for (index, (name, place)) in scheme.points.iter().enumerate() {
        let at = paper(place);
        let guide = scheme.guides.iter().find(|guide| guide.link == 0 && guide.origin == *place);
        match guide.filter(|_| index < scheme.fixed && is_mark(place)) {
            Some(guide) => guide_figure::mark(&mut figure, at, guide.axis),
            None => figure.disc(at, PIN, "white", solid(BLACK, 0.45)),
        }
        obstacles.discs.push((at, PIN));
        let unders = scheme.guides.iter().filter_map(|guide| guide.under.as_ref());
        let lowered = |under: &str| under.strip_prefix(name.as_str()).map(|number| format!("{name}{}", sub(number)));
        let unders = unders.filter(|[over, _]| over == name).filter_map(|[_, under]| lowered(under));
        named.push((at, std::iter::once(name.clone()).chain(unders).collect::<Vec<_>>().join(", ")));
    }
    for link in &scheme.links {
        if let Some(at) = link.mass_centre.as_ref().map(paper) {
            let text = format!("S{}", sub(&link.number.to_string()));
            match named.iter_mut().find(|(place, _)| (*place - at).norm() < MASS) {
                Some((_, names)) => *names += &format!(", {text}"),
                None => named.push((at, text)),
            }
        }
    }
    for (anchor, text) in named {
        let size = label_size(&text);
        labels.push((Label { anchor, away: Vec2::zeros(), size, clear: PIN }, text, BLACK));
    }
    let boxes: Vec<Label> = labels.iter().map(|(label, ..)| *label).collect();
    for ((label, text, paint), at) in labels.iter().zip(place(&boxes, &obstacles)) {
        if *paint == BLACK {
            letter(&mut figure, label, at, text, paint);
        } else {
            figure.disc(at, NUMBER, "white", solid(paint, 0.4));
            let set = Type { anchor: "middle", bold: true, colour: paint, ..words(2.8) };
            figure.text(at - Vec2::new(0.0, 1.0), text.clone(), set);
        }
    }
    figure
}

/// A singular point on paper and the lines that meet in it, each from the lead's farther end.
/// `None` if it lies too far away.
fn lines_through(scheme: &Scheme, point: &SingularPoint) -> Option<(Vec2, [[Vec2; 2]; 2])> {
    let named = |name: &String| scheme.points.iter().find(|(own, _)| own == name).map(|(_, at)| at / scheme.scale);
    let at = point.at / scheme.scale;
    let line = |names: &[String; 2]| {
        let ends = [named(&names[0])?, named(&names[1])?];
        let far = ends.into_iter().max_by(|a, b| (a - at).norm().total_cmp(&(b - at).norm()))?;
        (ends.iter().any(|end| (end - at).norm() < NEAR)).then_some([far, at])
    };
    Some((at, [line(&point.leads[0])?, line(&point.leads[1])?]))
}

/// A ground pivot with hatching.
fn ground(figure: &mut Figure, at: Vec2, obstacles: &mut Obstacles) {
    let corner = |x: f64, y: f64| at + Vec2::new(x, y);
    figure.shape(vec![at, corner(-2.4, -4.4), corner(2.4, -4.4)], true, Some(("#ececec", 1.0)), solid(BLACK, 0.35));
    figure.line([corner(-4.0, -4.4), corner(4.0, -4.4)], solid(BLACK, 0.5));
    for k in 0..6 {
        let x = -2.7 + 1.25 * f64::from(k);
        figure.line([corner(x, -4.4), corner(x - 1.2, -6.0)], solid(BLACK, 0.25));
    }
    obstacles.discs.extend([(corner(0.0, -2.8), 2.2), (corner(-2.4, -5.0), 1.4), (corner(2.4, -5.0), 1.4)]);
}

/// The arrow around the driving link's pivot, and the label of its angular velocity.
fn rotation(
    figure: &mut Figure,
    link: &SchemeLink,
    scale: f64,
    obstacles: &mut Obstacles,
) -> Option<(Label, String, &'static str)> {
    let pivot = link.pivot? / scale;
    let far = link.places.iter().map(|at| at / scale - pivot).max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let start = far.y.atan2(far.x) + link.omega.signum() * 0.35;
    let at = |part: f64| pivot + unit(start + link.omega.signum() * SWEEP * part) * SENSE;
    let arc: Vec<Vec2> = (0..=16).map(|k| at(f64::from(k) / 16.0)).collect();
    obstacles.segments.extend(arc.windows(2).map(|pair| [pair[0], pair[1]]));
    let end = arc[arc.len() - 1];
    let tangent = turned(end - pivot).normalize() * link.omega.signum();
    let corner = |along: f64, aside: f64| end + tangent * along + turned(tangent) * aside;
    figure.shape(arc, false, None, solid(BLACK, 0.35));
    figure.shape(
        vec![corner(2.4, 0.0), corner(-0.2, 0.8), corner(-0.2, -0.8)],
        true,
        Some((BLACK, 1.0)),
        solid(BLACK, 0.1),
    );
    let text = format!("ω{}", sub(&link.number.to_string()));
    let size = label_size(&text);
    Some((Label { anchor: at(0.5), away: at(0.5) - pivot, size, clear: 0.3 }, text, BLACK))
}

fn mass_centre(figure: &mut Figure, at: Vec2) {
    figure.disc(at, MASS, "white", solid(GREY, 0.3));
    for (x, y) in [(1.0, 0.0), (0.0, 1.0)] {
        let half = Vec2::new(x, y) * MASS;
        figure.line([at - half, at + half], solid(GREY, 0.3));
    }
}

/// Convex hull, counter-clockwise; both ends if all points are on one line (Andrew 1979).
fn hull(mut places: Vec<Vec2>) -> Vec<Vec2> {
    places.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let flat = 1e-6 * places.iter().map(Vec2::norm_squared).fold(0.0, f64::larger);
    let half = |order: &mut dyn Iterator<Item = &Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for &place in order {
            while let [.., a, b] = chain[..]
                && cross(b - a, place - b) <= flat
            {
                chain.pop();
            }
            chain.push(place);
        }
        chain.pop();
        chain
    };
    let mut corners = half(&mut places.iter());
    corners.extend(half(&mut places.iter().rev()));
    corners
}

/// The links with their numbers, angular velocities and angular accelerations.
pub fn table(scheme: &Scheme) -> Table {
    let driver = scheme.links.iter().find(|link| link.number == scheme.driver).map_or(0.0, |link| link.omega.abs());
    // At a dead point only rounding is left, relative to the crank's speed and its square.
    let shown = |value: f64, scale: f64| significant(if value.abs() > ROUNDING * scale { value } else { 0.0 });
    let row = |link: &SchemeLink| {
        let (omega, alpha) = (shown(link.omega, driver), shown(link.alpha, driver * driver));
        let cells = vec![link.number.to_string(), link.name.clone(), omega, alpha];
        (solid(colour(link.number), 0.9), cells)
    };
    let head = vec!["link", "name", "ω, rad/s", "α, rad/s²"];
    Table { head, rows: scheme.links.iter().map(row).collect(), numbers: &[2, 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_of_bars_and_plates() {
        let at = |points: &[(f64, f64)]| hull(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).len();
        assert_eq!(at(&[(0.0, 0.0), (2.0, 2.0), (1.0, 1.0)]), 2);
        assert_eq!(at(&[(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (1.0, 0.2)]), 3);
        assert_eq!(at(&[(0.0, 0.0)]), 0);
    }
}
