//! Figure of the kinematic diagram.

use crate::plan::names::SINGULAR;
use crate::plan::scheme::{Scheme, SchemeLink};
use crate::plan::singular::{AssurLead, SingularPoint};
use drawing::paper::figure::{DrawnFigure, Style, solid, sub};
use drawing::paper::style::{BLACK, GREY, colour, significant};
use drawing::paper::table::LegendTable;
use drawing::picture::Picture;
use drawing::{Lettering, Mark, MarkRole};
use linkage::math::Vec2;

/// An angular velocity or acceleration below this fraction of its natural scale is rounding error.
const ROUNDING: f64 = 1e-12;
/// A singular point is the intersection of the lines of two links (leads). The point is drawn only if each lead has an
/// end nearer to the point than this (mm).
const NEAR: f64 = 120.0;

/// Style of construction lines.
pub const CONSTRUCTION: Style = Style { colour: GREY, width: 0.25, dash: "4 1 0.5 1" };

/// Draws the mechanism; the world origin is the figure's origin.
pub fn scheme(scheme: &Scheme) -> DrawnFigure {
    let mut picture = Picture::of(&scheme.sketch, &scheme.places, scheme.scale);
    for (at, leads) in scheme.singular.iter().filter_map(|point| lines_through(scheme, point)) {
        for ends in leads {
            picture.figure.line(ends, CONSTRUCTION);
            picture.obstacles.segments.push(ends);
        }
        picture.figure.disc(at, 0.5, BLACK, solid(BLACK, 0.2));
        picture.letters(at, Vec2::zeros(), 0.6, SINGULAR[0].into(), BLACK);
    }
    picture.draw_marks();
    picture.draw_loads(&scheme.acting);
    picture.number_links();
    let unders = || scheme.guides.iter().filter_map(|guide| guide.under.as_ref());
    let point = |(name, at): &(String, Vec2)| {
        let lowered = |under: &str| under.strip_prefix(name.as_str()).map(|number| format!("{name}{}", sub(number)));
        let unders = unders().filter(|[over, _]| over == name).filter_map(|[_, under]| lowered(under));
        (at / scheme.scale, std::iter::once(name.clone()).chain(unders).collect::<Vec<_>>().join(", "))
    };
    let mut names: Vec<(Vec2, String)> = scheme.points.iter().map(point).collect();
    names.extend(picture.names(|what| matches!(what, Lettering::MassCentre | Lettering::Motor)));
    picture.name(names);
    let is_arc = |mark: &&Mark| mark.role == MarkRole::Drive;
    if let Some(arc) = scheme.sketch.bodies[scheme.driver].marks.iter().find(is_arc) {
        let line = arc.shape.points();
        let middle = picture.at(scheme.driver, line[line.len() / 2]);
        let pivot = scheme.links.iter().find(|link| link.number == scheme.driver).and_then(|link| link.pivot);
        if let (Some(middle), Some(pivot)) = (middle, pivot) {
            let text = format!("ω{}", sub(&scheme.driver.to_string()));
            picture.letters(middle, middle - pivot / scheme.scale, 0.3, text, BLACK);
        }
    }
    picture.finish(1)
}

/// Returns a singular point on paper, and the two lines through leads that meet in this point.
/// Each line starts at the lead's end that is farther from the point.
/// `None` if the point is at least `NEAR` away from both ends of a lead.
fn lines_through(scheme: &Scheme, point: &SingularPoint) -> Option<(Vec2, [[Vec2; 2]; 2])> {
    let at = point.at / scheme.scale;
    let line = |lead: &AssurLead| {
        let ends = lead.ends.map(|end| end / scheme.scale);
        let far = ends.into_iter().max_by(|a, b| (a - at).norm().total_cmp(&(b - at).norm()))?;
        (ends.iter().any(|end| (end - at).norm() < NEAR)).then_some([far, at])
    };
    Some((at, [line(&point.leads[0])?, line(&point.leads[1])?]))
}

/// Table of the links with their numbers, angular velocities and angular accelerations.
pub fn table(scheme: &Scheme) -> LegendTable {
    let driver = scheme.links.iter().find(|link| link.number == scheme.driver).map_or(0.0, |link| link.omega.abs());
    // At a dead point some values are only rounding error, so values below the limit are shown as zero.
    // The natural scale of an angular velocity is the crank's speed.
    // The natural scale of an angular acceleration is the square of the crank's speed.
    let shown = |value: f64, scale: f64| significant(if value.abs() > ROUNDING * scale { value } else { 0.0 });
    let row = |link: &SchemeLink| {
        let (omega, alpha) = (shown(link.omega, driver), shown(link.alpha, driver * driver));
        let cells = vec![link.number.to_string(), link.name.clone(), omega, alpha];
        (solid(colour(link.number), 0.9), cells)
    };
    let head = vec!["link", "name", "ω, rad/s", "α, rad/s²"];
    LegendTable { head, rows: scheme.links.iter().map(row).collect(), numbers: &[2, 3] }
}
