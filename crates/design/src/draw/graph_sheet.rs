//! Sheet of graphs over the crank angle, arranged vertically.

use super::axes::{GRID, Room, ValueAxis, frame, per_millimetre, stacked};
use crate::diagram::graphs::{CrankGraph, Graphs};
use crate::sentences;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Style, Type, scripted, solid, words};
use drawing::paper::style::{COLOURS, GREY, significant};
use linkage::math::{KeepNan, Vec2};

/// Length of the crank angle axis (mm): two degrees per millimetre for one turn.
const LONG: f64 = 180.0;
/// Upper limit of the height of a graph (mm). `ROOM` contains the distances between graphs (mm).
const HIGH: f64 = 56.0;
const ROOM: Room = Room { gap: 3.0, left: 22.0, between: 6.0 };
/// Space above and below a curve for the labels of its extremes, divided by the curve's range.
const ASIDES: f64 = 0.2;
/// The label of an extreme is centred at the extreme, except within this distance (mm) from an end of the axis.
/// There, the label starts or ends at the extreme.
const ASIDE: f64 = 28.0;
/// Line at the mean.
const MEAN: Style = Style { colour: COLOURS[1], width: 0.3, dash: "2 1.2" };

/// Returns the graphs as a drawing with `title` above them.
pub fn graphs(graphs: &Graphs, title: &str) -> Drawing {
    let panels = graphs.graphs.iter().map(|graph| panel(graph, graphs.period));
    stacked(title, &graphs.notes, &ROOM, panels)
}

/// Draws one graph; the lower left corner of its frame is the origin.
fn panel(graph: &CrankGraph, [start, end]: [f64; 2]) -> DrawnFigure {
    let mut figure = DrawnFigure::default();
    let constant = graph.is_constant();
    // A value of at most a billionth of the graph's reference value is rounding error and is shown as zero.
    let clear = |value: f64| if value.abs() <= 1e-9 * graph.size.abs() { 0.0 } else { value };
    let mean = clear(graph.mean);
    let [low, high] = if constant { [mean.smaller(0.0), mean.larger(0.0)] } else { graph.range() };
    let room = if constant { 0.0 } else { ASIDES * (high - low) };
    let axis = ValueAxis::of([low - room, high + room], HIGH);
    let share = |crank: f64| (crank - start) / (end - start);
    axis.draw(&mut figure, LONG);
    angles(&mut figure, [start, end], axis.height());
    frame(&mut figure, Vec2::new(LONG, axis.height()), GREY);
    let level = axis.y(mean);
    figure.line([Vec2::new(0.0, level), Vec2::new(LONG, level)], MEAN);
    let word = if constant { "constant" } else { graph.mean_word };
    figure.text(Vec2::new(LONG + 2.0, level - 1.0), format!("{word} {}", significant(mean)), words(2.8));
    let curve = graph.points.iter().map(|&[crank, value]| Vec2::new(LONG * share(crank), axis.y(value)));
    figure.curve(curve.collect(), None, solid(COLOURS[0], 0.45));
    for (mark, above) in graph.marks.iter().zip([false, true]).filter(|_| !constant) {
        let [crank, value] = mark.at;
        let share = share(crank).rem_euclid(1.0);
        let at = Vec2::new(LONG * share, axis.y(value));
        figure.disc(at, 0.9, "white", solid(COLOURS[0], 0.4));
        let degrees = (start + share * (end - start)).to_degrees();
        let text = format!("{} {} at {:.1}°", mark.word, significant(clear(value)), degrees + 0.0);
        let anchor = match at.x {
            x if x < ASIDE => "start",
            x if x > LONG - ASIDE => "end",
            _ => "middle",
        };
        let aside = at + Vec2::new(0.0, if above { 1.9 } else { -4.0 });
        figure.text(aside, text, Type { anchor, ..words(2.8) });
    }
    let [symbol, unit] = [graph.symbol, graph.unit].map(scripted);
    let per = per_millimetre(&unit);
    let heading = sentences::scale_factor(&graph.name, &symbol, &unit, &axis.scale, &per);
    figure.text(Vec2::new(0.0, axis.height() + 3.0), heading, Type { bold: true, ..words(3.6) });
    figure
}

/// Draws grid lines at round crank angles, their numbers and the axis title.
fn angles(figure: &mut DrawnFigure, [start, end]: [f64; 2], height: f64) {
    let (from, to) = (start.to_degrees(), end.to_degrees());
    let every = 30.0 * ((to - from).abs() / 360.0).ceil().larger(1.0);
    // A round angle that only a rounding error puts beyond an end of the axis still has a grid line.
    let [first, last] = [(from.smaller(to) / every - 1e-9).ceil(), (from.larger(to) / every + 1e-9).floor()];
    for k in 0..=(last - first).larger(0.0) as u32 {
        let degrees = (first + f64::from(k)) * every + 0.0;
        let x = LONG * (degrees - from) / (to - from);
        figure.line([Vec2::new(x, 0.0), Vec2::new(x, height)], GRID);
        figure.text(Vec2::new(x, -4.0), format!("{degrees}°"), Type { anchor: "middle", ..words(2.8) });
    }
    figure.text(Vec2::new(LONG / 2.0, -8.4), sentences::CRANK_ANGLE_DEG_2, Type { anchor: "middle", ..words(2.8) });
}
