//! One chart: legend, axes, curves and marks.

use std::cell::Cell;
use std::rc::Rc;

use plotters::chart::ChartBuilder;
use plotters::prelude::{IntoDrawingArea, IntoFont, LineSeries, RGBColor, ShapeStyle};
use plotters::style::Color;

use super::backend::{PlotPaper, pixels, place};
use super::chart::{GRID, LINE, NAME, NUMBER, PlotChart, PlotCurve};
use super::ticks::{Ticks, step};
use crate::palette::SERIES;
use crate::paper::figure::{DrawnFigure, Style, Type, solid, width, words};
use crate::paper::labels::{self, Obstacles, PlacedLabel};
use crate::paper::style::BLACK;
use crate::paths::rgb;
use crate::sentences;
use crate::sheet::wrapped;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Vec2};

/// Smallest distance between neighbouring ticks of the horizontal and of the vertical axis (mm).
const APART: [f64; 2] = [11.0, 9.0];
/// Length of a tick (mm).
/// The distance of numbers from their axis is twice this length.
const TICK: f64 = 1.0;
/// Space below the horizontal axis, space right of the horizontal axis, and space above the vertical axis (mm).
const BELOW: f64 = 11.0;
const ASIDE: f64 = 5.0;
const ABOVE: f64 = 2.5;
/// Dimensions of the legend (mm): `SAMPLE` is the width of a line sample with the space behind it, `GAP` the space
/// after a name, `ROW` the height of a row.
const SAMPLE: f64 = 11.0;
const GAP: f64 = 5.0;
const ROW: f64 = 5.0;
/// Width of a curve and radius of a marked point (mm).
const CURVE: f64 = 0.45;
const MARK: f64 = 0.7;
/// Strokes and gaps of curves (mm), which distinguish the curves in black and white.
const DASHES: [&str; 7] = ["", "2.6 1.4", "0.1 1.1", "4 1.2 0.1 1.2", "5.5 1.6", "1.2 1.2", "4 1.2 0.1 1.2 0.1 1.2"];
/// Width (mm) of a strip of the chart. If successive points of a curve lie in one strip, only the first, lowest,
/// highest and last of them are drawn.
const CELL: f64 = 0.1;
/// Length of an arrow on a curve (mm).
const ARROW: f64 = 4.0;

/// Colour, width and dashes of the curve with the number `index`.
/// The number of colours and the number of dash patterns have no common divisor. Every pair of colour and dash pattern
/// therefore occurs before a pair is repeated.
fn pen(index: usize) -> Style {
    let (colour, dash) = (SERIES[index % SERIES.len()].light, DASHES[index % DASHES.len()]);
    Style { colour, width: CURVE, dash }
}

/// A chart with its ticks.
pub(super) struct Panel<'a> {
    plot: &'a PlotChart,
    ticks: [Ticks; 2],
    /// Labels of both axes, broken into lines.
    labels: [Vec<String>; 2],
    /// Rows of the legend. An entry contains the index of a curve, and the distance of its line sample from the
    /// vertical axis (mm).
    legend: Vec<Vec<(usize, f64)>>,
}

impl<'a> Panel<'a> {
    pub(super) fn of(plot: &'a PlotChart) -> Panel<'a> {
        let own = |index: usize| {
            let points = plot.curves.iter().flat_map(|curve| curve.points.iter());
            let values = points.filter(|point| is_drawn(point)).map(move |point| point[index]);
            let ends = values.fold(None, |ends: Option<[f64; 2]>, value| {
                let [low, high] = ends.unwrap_or([value; 2]);
                Some([low.smaller(value), high.larger(value)])
            });
            ends.unwrap_or([0.0; 2])
        };
        let noise = plot.curves.iter().map(|curve| curve.noise).fold(0.0, f64::larger);
        let room = [plot.size[0] - 20.0 - ASIDE, plot.size[1] - BELOW - ABOVE].map(|room| room.larger(10.0));
        let ticks = match plot.equal {
            true => equal(plot, [own(0), own(1)], noise, room),
            false => [
                Ticks::of(&plot.axes[0], own(0), 0.0, room[0], APART[0]),
                Ticks::of(&plot.axes[1], own(1), noise, room[1], APART[1]),
            ],
        };
        let label = |index: usize, long: f64| wrapped(&ticks[index].label(&plot.axes[index]), NAME, long);
        let labels = [label(0, plot.size[0]), label(1, room[1] + ABOVE + 0.5 * BELOW)];
        Panel { plot, ticks, labels, legend: if plot.legend { legend(plot) } else { Vec::new() } }
    }

    /// Width of the numbers and the label of the vertical axis (mm).
    pub(super) fn left(&self) -> f64 {
        let ticks = &self.ticks[1];
        let wide = ticks.values.iter().map(|value| width(&ticks.number(*value), NUMBER)).fold(0.0, f64::larger);
        wide + 2.0 * TICK + LINE * NAME * self.labels[1].len() as f64 + 1.2
    }

    /// Height of the chart with its legend (mm).
    pub(super) fn height(&self) -> f64 {
        self.plot.size[1] + ROW * self.legend.len() as f64
    }

    /// The chart, with the space `left` (mm) between its left edge and the vertical axis.
    /// The origin of the figure is the upper left corner of the chart.
    pub(super) fn figure(&self, left: f64) -> Result<DrawnFigure> {
        let mut chart = DrawnFigure::default();
        let curves = self.draw(&mut chart, left)?;
        self.mark(&mut chart, &curves);
        let mut figure = DrawnFigure::default();
        for (row, entries) in self.legend.iter().enumerate() {
            let y = -ROW * (row as f64 + 0.7);
            for &(index, x) in entries {
                let (from, to) =
                    (Vec2::new(left + x, y + 0.35 * NAME), Vec2::new(left + x + SAMPLE - 2.0, y + 0.35 * NAME));
                figure.line([from, to], pen(index));
                figure.text(to + Vec2::new(1.5, -0.35 * NAME), self.plot.curves[index].name.as_str(), words(NAME));
            }
        }
        figure.add(&chart, Vec2::new(0.0, -ROW * self.legend.len() as f64));
        Ok(figure)
    }

    /// The ticks of both axes for a horizontal axis of the length `wide` (mm).
    /// The numbers of the vertical axis take a part of the chart's width. The length `wide` is therefore known only
    /// after [`Panel::of`].
    /// At equal scales, the ends of the horizontal axis are adapted to `wide`.
    fn over_width(&self, wide: f64) -> [Ticks; 2] {
        let [x, y] = self.ticks.clone();
        if !self.plot.equal {
            return [x, y];
        }
        let scale = (y.ends[1] - y.ends[0]) / (self.plot.size[1] - BELOW - ABOVE).larger(10.0);
        let (middle, half) = ((x.ends[0] + x.ends[1]) / 2.0, scale * wide / 2.0);
        [x.over([middle - half, middle + half]), y]
    }

    /// Draws axes and curves with `plotters`. Returns the curves on paper, in pieces without gaps.
    fn draw(&self, figure: &mut DrawnFigure, left: f64) -> Result<Vec<DrawnCurve>> {
        let failed =
            |error: &dyn std::fmt::Display| Error::new(ErrorKind::Input, sentences::the_chart_cannot_be_drawn(&error));
        let pen_now = Rc::new(Cell::new(None));
        let size = self.plot.size.map(|own| pixels(own) as u32);
        let paper = PlotPaper { figure, size: (size[0], size[1]), pen: Rc::clone(&pen_now) };
        let area = paper.into_drawing_area();
        let ticks = self.over_width(self.plot.size[0] - left - ASIDE);
        let [x, y] = ticks.clone();
        let mut chart = ChartBuilder::on(&area)
            .margin_top(pixels(ABOVE))
            .margin_right(pixels(ASIDE))
            .x_label_area_size(pixels(BELOW))
            .y_label_area_size(pixels(left))
            .build_cartesian_2d(x, y)
            .map_err(|error| failed(&error))?;
        let [black, grey] = [BLACK, GRID].map(|own| {
            let [red, green, blue] = rgb(own);
            RGBColor(red, green, blue)
        });
        let line = |colour: RGBColor, width: f64| ShapeStyle {
            color: colour.to_rgba(),
            filled: false,
            stroke_width: pixels(width) as u32,
        };
        let [below, beside] = self.labels.each_ref().map(|lines| lines.join("\n"));
        chart
            .configure_mesh()
            .bold_line_style(line(grey, 0.15))
            .axis_style(line(black, 0.3))
            .label_style(("sans-serif", pixels(NUMBER)).into_font())
            .axis_desc_style(("sans-serif", pixels(NAME)).into_font())
            .x_desc(below)
            .y_desc(beside)
            .set_all_tick_mark_size(pixels(TICK))
            .draw()
            .map_err(|error| failed(&error))?;
        let [[left_end, right_end], [low, high]] = ticks.each_ref().map(|ticks| ticks.ends);
        let frame = [(left_end, high), (right_end, high), (right_end, low)];
        chart.draw_series(LineSeries::new(frame, line(grey, 0.15))).map_err(|error| failed(&error))?;
        for [from, to] in self.zeros() {
            let ends = [(from[0], from[1]), (to[0], to[1])];
            chart.draw_series(LineSeries::new(ends, line(black, 0.2))).map_err(|error| failed(&error))?;
        }
        let at = |point: &[f64; 2]| place(chart.backend_coord(&(point[0], point[1])));
        let kept = |curve: &PlotCurve| -> Vec<Vec<[f64; 2]>> {
            let pieces = curve.points.split(|point| !is_drawn(point)).filter(|piece| !piece.is_empty());
            pieces.map(|piece| thinned(piece, &at)).collect()
        };
        let curves: Vec<Vec<Vec<[f64; 2]>>> = self.plot.curves.iter().map(kept).collect();
        let on_paper = |(curve, pieces): (&PlotCurve, &Vec<Vec<[f64; 2]>>)| DrawnCurve {
            pieces: pieces.iter().map(|piece| piece.iter().map(at).collect()).collect(),
            marks: curve.marks.iter().map(|(point, _)| at(point)).collect(),
        };
        let drawn = self.plot.curves.iter().zip(&curves).map(on_paper).collect();
        for (index, pieces) in curves.iter().enumerate() {
            pen_now.set(Some(pen(index)));
            for piece in pieces.iter().filter(|piece| piece.len() > 1) {
                let points = piece.iter().map(|point| (point[0], point[1]));
                chart.draw_series(LineSeries::new(points, line(black, CURVE))).map_err(|error| failed(&error))?;
            }
        }
        Ok(drawn)
    }

    /// Zero lines inside the chart: at the zero of the vertical axis, and for equal scales also at the zero of the
    /// horizontal axis.
    fn zeros(&self) -> Vec<[[f64; 2]; 2]> {
        let [x, y] = self.ticks.each_ref().map(|ticks| ticks.ends);
        let holds = |[low, high]: [f64; 2]| low < 0.0 && high > 0.0;
        let level = holds(y).then_some([[x[0], 0.0], [x[1], 0.0]]);
        let upright = (self.plot.equal && holds(x)).then_some([[0.0, y[0]], [0.0, y[1]]]);
        level.into_iter().chain(upright).collect()
    }

    /// Draws single points between gaps, arrows along curves, and labelled points.
    fn mark(&self, figure: &mut DrawnFigure, curves: &[DrawnCurve]) {
        let lines = curves.iter().flat_map(|curve| &curve.pieces).flat_map(|piece| piece.windows(2));
        let mut obstacles = Obstacles { segments: lines.map(|pair| [pair[0], pair[1]]).collect(), discs: Vec::new() };
        let (mut placed, mut texts) = (Vec::new(), Vec::new());
        for (index, (curve, drawn)) in self.plot.curves.iter().zip(curves).enumerate() {
            let style = pen(index);
            for piece in &drawn.pieces {
                if let [one] = piece.as_slice() {
                    figure.disc(*one, MARK, style.colour, solid(style.colour, 0.2));
                } else if curve.directed {
                    arrows(figure, piece, style);
                }
            }
            for (&anchor, (_, text)) in drawn.marks.iter().zip(&curve.marks) {
                figure.disc(anchor, MARK, "white", solid(style.colour, 0.35));
                obstacles.discs.push((anchor, MARK));
                let size = Vec2::new(width(text, NUMBER), 1.1 * NUMBER);
                placed.push(PlacedLabel { anchor, away: Vec2::zeros(), size, clear: MARK });
                texts.push(text);
            }
        }
        let places = labels::place_among(&placed, &obstacles, 1);
        for ((label, text), at) in placed.iter().zip(texts).zip(places) {
            let set = Type { anchor: "middle", ..words(NUMBER) };
            figure.text(at - Vec2::new(0.0, 0.36 * NUMBER), text.as_str(), set);
            labels::leader(figure, label, at, labels::LETTER);
        }
    }
}

/// A curve on paper (mm): its pieces between gaps, and its marked points.
struct DrawnCurve {
    pieces: Vec<Vec<Vec2>>,
    marks: Vec<Vec2>,
}

fn is_drawn(point: &[f64; 2]) -> bool {
    point.iter().all(|value| value.is_finite())
}

/// Ticks at equal scales: both axes include zero, have the same step, and show the same number of units per length.
fn equal(plot: &PlotChart, ends: [[f64; 2]; 2], noise: f64, room: [f64; 2]) -> [Ticks; 2] {
    let [x, y] = ends.map(|[low, high]| [low.smaller(0.0), high.larger(0.0)]);
    // If all values are only rounding errors, each axis is at least one unit long. Each curve then looks like a point.
    let size = x.into_iter().chain(y).map(f64::abs).fold(0.0, f64::larger);
    let least = if size <= noise { 1.0 } else { 0.05 * size };
    let spans = [x, y].map(|[low, high]| (high - low).larger(least));
    // The factor 1.16 leaves a margin for labels.
    let scale = 1.16 * (spans[0] / room[0]).larger(spans[1] / room[1]);
    let step = step(&plot.axes[1], scale * APART[0]);
    let axis = |index: usize, [low, high]: [f64; 2]| {
        let (middle, half) = ((low + high) / 2.0, scale * room[index] / 2.0);
        Ticks::between([middle - half, middle + half], step)
    };
    [axis(0, x), axis(1, y)]
}

/// Rows of the legend, not wider than the chart.
fn legend(plot: &PlotChart) -> Vec<Vec<(usize, f64)>> {
    let (mut rows, mut x): (Vec<Vec<(usize, f64)>>, f64) = (vec![Vec::new()], 0.0);
    for (index, curve) in plot.curves.iter().enumerate() {
        let wide = SAMPLE + width(&curve.name, NAME) + GAP;
        if x > 0.0 && x + wide > plot.size[0] - 20.0 {
            rows.push(Vec::new());
            x = 0.0;
        }
        if let Some(row) = rows.last_mut() {
            row.push((index, x));
        }
        x += wide;
    }
    rows
}

/// Selects the points of a curve that are drawn. The curve is divided into groups of successive points, each at most
/// [`CELL`] wide. Of each group, the first, the lowest, the highest and the last point are drawn.
/// All extreme values are therefore drawn.
fn thinned(points: &[[f64; 2]], at: &dyn Fn(&[f64; 2]) -> Vec2) -> Vec<[f64; 2]> {
    let mut kept = Vec::new();
    let mut rest = points;
    while let [first, ..] = rest {
        let left = at(first).x;
        let count = rest.iter().take_while(|point| (at(point).x - left).abs() < CELL).count().max(1);
        let (cell, behind) = rest.split_at(count);
        let by = |a: &&usize, b: &&usize| cell[**a][1].total_cmp(&cell[**b][1]);
        let all: Vec<usize> = (0..count).collect();
        let mut rows = vec![0, count - 1];
        rows.extend(all.iter().min_by(by).into_iter().chain(all.iter().max_by(by)));
        rows.sort_unstable();
        rows.dedup();
        kept.extend(rows.into_iter().map(|row| cell[row]));
        rest = behind;
    }
    kept
}

/// Draws two arrows on a curve, near a quarter and three quarters of its length. A short curve has no arrows.
fn arrows(figure: &mut DrawnFigure, piece: &[Vec2], style: Style) {
    let lengths: Vec<f64> = piece.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    let whole: f64 = lengths.iter().sum();
    if whole < 4.0 * ARROW {
        return;
    }
    for share in [0.28, 0.78] {
        let (mut gone, mut row) = (0.0, 0);
        while row + 1 < lengths.len() && gone + lengths[row] < share * whole {
            gone += lengths[row];
            row += 1;
        }
        let along = piece[row + 1] - piece[row];
        if along.norm() > 0.0 {
            let tip = piece[row] + along.normalize() * (share * whole - gone);
            figure.arrow(
                [tip - along.normalize() * ARROW, tip],
                Style { width: 0.1, dash: "", ..style },
                String::new(),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinned_curves_keep_their_extremes_and_ends() {
        let points: Vec<[f64; 2]> = (0..100_000)
            .map(|k| f64::from(k) / 1e5)
            .map(|x| {
                [
                    x,
                    if x == 0.5 {
                        7.0
                    } else if x == 0.25 {
                        -3.0
                    } else {
                        (3000.0 * x).sin()
                    },
                ]
            })
            .collect();
        let kept = thinned(&points, &|point| Vec2::new(100.0 * point[0], point[1]));
        assert!(kept.len() < 4100, "{}", kept.len());
        assert!(kept.contains(&[0.5, 7.0]) && kept.contains(&[0.25, -3.0]));
        assert_eq!((kept.first(), kept.last()), (points.first(), points.last()));
        let few = &points[..3].iter().map(|p| [1000.0 * p[0], p[1]]).collect::<Vec<_>>();
        assert_eq!(thinned(few, &|point| Vec2::new(100.0 * point[0], point[1])), *few);
    }

    #[test]
    fn pens_differ_in_dashes_and_later_in_colour() {
        let look = |index: usize| (pen(index).colour, pen(index).dash);
        let all: std::collections::BTreeSet<_> = (0..56).map(look).collect();
        assert_eq!(all.len(), 56);
        let dashes: std::collections::BTreeSet<_> = (0..7).map(|index| pen(index).dash).collect();
        assert_eq!(dashes.len(), 7);
    }
}
