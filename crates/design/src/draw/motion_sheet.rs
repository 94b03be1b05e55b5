//! Sheet of motion diagrams: displacement, velocity and acceleration over the crank angle, arranged vertically.

use super::axes::{GRID, Room, ValueAxis, frame, per_millimetre, stacked};
use crate::diagram::construction::{ConstructionSort, HIGH, LONG};
use crate::diagram::method::Method;
use crate::diagram::motion::{MethodResult, MotionDiagram};
use crate::sentences;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Style, Type, solid, sub, words};
use drawing::paper::style::{BLACK, COLOURS, GREY, significant};
use linkage::math::Vec2;
use linkage::math::statistics::ends;

/// Distances between diagrams (mm).
const ROOM: Room = Room { gap: 3.4, left: 28.0, between: 10.0 };
/// Chords of the displacement.
const CHORDS: Style = Style { colour: COLOURS[0], width: 0.25, dash: "1.5 1" };
/// Font size and line distance of the legend (mm).
const TEXT: f64 = 3.3;
const LINE: f64 = 5.0;
/// Upper limit of the number of points of a curve on paper. More points would not be visible.
const POINTS: usize = 361;

/// Returns the diagrams as a drawing with `title` above them.
pub fn motion(diagram: &MotionDiagram, title: &str) -> Drawing {
    let note = sentences::chord_method_and_graphical_integration(&diagram.divisions);
    stacked(title, &[note], &ROOM, (0..3).map(|which| panel(diagram, which)))
}

/// Draws one diagram; the lower left corner of its frame is the origin.
fn panel(diagram: &MotionDiagram, which: usize) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let exact = &diagram.exact[which];
    let shown = [ConstructionSort::Chords, ConstructionSort::Integration].map(ConstructionSort::methods).concat();
    let is_shown = |found: &&MethodResult| found.method.gives() == which && shown.contains(&found.method);
    let found: Vec<&MethodResult> = diagram.found.iter().filter(is_shown).collect();
    let axis = ValueAxis::of(ends(exact.iter().chain(found.iter().flat_map(|found| &found.values)).copied()), HIGH);
    let rows = exact.len() - 1;
    let at = |row: usize, value: f64| Vec2::new(LONG * row as f64 / rows as f64, axis.y(value));
    let (height, scale) = (axis.height(), axis.scale);
    axes(&mut figure, diagram, &axis);
    let stride = rows.div_ceil(POINTS - 1).max(1);
    let curve = (0..=rows).filter(|row| row % stride == 0 || *row == rows).map(|row| at(row, exact[row]));
    figure.curve(curve.collect(), None, solid(BLACK, 0.45));
    if which == 0 {
        figure.curve((0..=rows).step_by(diagram.stride).map(|row| at(row, exact[row])).collect(), None, CHORDS);
    }
    for one in &found {
        for (&row, &value) in one.rows.iter().zip(&one.values) {
            mark(&mut figure, one.method, at(row, value));
        }
    }
    let channel = &diagram.course.0[which];
    let symbol = ["s", "v", "a"][which];
    let unit = channel.kind.unit.symbol().replace("s^2", "s²");
    let per = per_millimetre(&unit);
    let heading = sentences::scale_factor_2(&channel, &sub(symbol), &scale, &per);
    figure.text(Vec2::new(0.0, height + 8.0), heading, Type { bold: true, ..words(3.8) });
    let middle = Type { anchor: "middle", ..words(TEXT) };
    let over = format!("{}, {}", diagram.input.noun(), diagram.input.shown_in().0);
    figure.text(Vec2::new(LONG / 2.0, -9.0), over, middle);
    figure.text(Vec2::new(0.0, height + 2.5), format!("{symbol}, {unit}"), Type { anchor: "end", ..middle });
    caption(&mut figure, &found, which, &unit);
    figure
}

/// Draws the legend: the method of each mark and its error relative to the curve.
fn caption(figure: &mut DrawnFigure, found: &[&MethodResult], which: usize, unit: &str) {
    let mut line = -14.5;
    let lines = [
        (solid(BLACK, 0.45), sentences::EXACT_BY_THE_SOLVER),
        (CHORDS, sentences::CHORDS_WHOSE_SLOPES_GIVE_THE_VELOCITY),
    ];
    for (style, text) in lines.into_iter().take(if which == 0 { 2 } else { 1 }) {
        figure.line([Vec2::new(0.0, line + 1.0), Vec2::new(6.0, line + 1.0)], style);
        figure.text(Vec2::new(8.0, line), text, words(TEXT));
        line -= LINE;
    }
    for one in found {
        mark(figure, one.method, Vec2::new(3.0, line + 1.0));
        let orders = one.orders.map(|order| order.map_or_else(|| "–".into(), |order| format!("{order:.2}"))).join(", ");
        let text = sentences::largest_error_rms_observed_order(
            &one.method.words(),
            &significant(one.largest),
            &unit,
            &(one.share * 100.0),
            &significant(one.rms),
            &orders,
        );
        figure.text(Vec2::new(8.0, line), text, words(TEXT));
        line -= LINE;
    }
}

/// Draws the mark of a value that a method has found.
pub(super) fn mark(figure: &mut DrawnFigure, method: Method, at: Vec2) {
    let corner = |x: f64, y: f64| at + Vec2::new(x, y);
    match method {
        Method::ChordVelocity | Method::ChordAcceleration | Method::TangentVelocity | Method::TangentAcceleration => {
            figure.disc(at, 0.95, "white", solid(COLOURS[0], 0.4))
        }
        Method::IntegratedDisplacement
        | Method::IntegratedVelocity
        | Method::AreaDisplacement
        | Method::AreaVelocity => {
            figure.line([corner(-0.9, -0.9), corner(0.9, 0.9)], solid(COLOURS[1], 0.4));
            figure.line([corner(-0.9, 0.9), corner(0.9, -0.9)], solid(COLOURS[1], 0.4));
        }
    }
}

/// Draws the frame, grid lines at round values and at the divisions of the turn, and their numbers.
fn axes(figure: &mut DrawnFigure, diagram: &MotionDiagram, axis: &ValueAxis) {
    axis.draw(figure, LONG);
    crank_axis(figure, diagram, axis.height());
}

/// Draws the frame, the lines at the divisions of the turn, and the values of the input at these lines.
pub(super) fn crank_axis(figure: &mut DrawnFigure, diagram: &MotionDiagram, height: f64) {
    let every = diagram.divisions.div_ceil(24);
    let whole = diagram.divisions;
    let (start, turn) = (diagram.cranks[0], diagram.cranks[diagram.cranks.len() - 1] - diagram.cranks[0]);
    for k in (0..=whole).filter(|k| k % every == 0 || *k == whole) {
        let x = LONG * k as f64 / whole as f64;
        figure.line([Vec2::new(x, 0.0), Vec2::new(x, height)], GRID);
        let labelled = whole.div_ceil(12);
        if k % labelled == 0 || k == whole {
            let shown = diagram.input.shown(start + turn * k as f64 / whole as f64);
            let (shown, sign) = ((shown * 10.0).round() / 10.0 + 0.0, diagram.input.sign());
            figure.text(Vec2::new(x, -4.0), format!("{shown}{sign}"), Type { anchor: "middle", ..words(2.8) });
        }
    }
    frame(figure, Vec2::new(LONG, height), GREY);
}
