//! Sheet of a graphical method with its construction: poles, rays, chords, tangents, strips.

use super::axes::{Room, ValueAxis, per_millimetre, stacked};
use super::motion_sheet::{crank_axis, mark};
use super::plan_sheet::scale_shown;
use crate::diagram::MotionDiagram;
use crate::diagram::construction::{Construction, ConstructionSort, ConstructionStep, LONG, result};
use crate::sentences;
use drawing::paper::document::Drawing;
use drawing::paper::figure::{DrawnFigure, Style, Tint, Type, solid, sub, words};
use drawing::paper::style::{BLACK, COLOURS, GREY, significant};
use linkage::math::statistics::ends;
use linkage::math::{KeepNan, Vec2};

/// Distances between diagrams (mm). The space left of the diagrams grows if a pole needs more space.
const ROOM: Room = Room { gap: 3.4, left: 14.0, between: 9.0 };
const EXACT: Style = solid(GREY, 0.35);
const FOUND: Style = solid(COLOURS[0], 0.45);
const RAY: Style = Style { colour: COLOURS[1], width: 0.25, dash: "" };
const CARRIED: Style = Style { colour: COLOURS[1], width: 0.15, dash: "0.8 0.8" };
/// Tint of every second strip.
const STRIP: Tint = Tint { colour: COLOURS[0], opacity: 0.16 };
/// Font size of numbers (mm). On the ordinate axis, a number closer than `APART` (mm) to another number is left out.
const NUMBER: f64 = 2.5;
const APART: f64 = 2.5;
/// Upper limit of the number of points of a curve on paper.
const POINTS: usize = 361;

/// Returns the construction as a drawing with `title` above it.
pub fn construction(diagram: &MotionDiagram, construction: &Construction, title: &str) -> Drawing {
    let sheet = Sheet { diagram, construction };
    let panels: Vec<DrawnFigure> = match construction.sort {
        ConstructionSort::Chords | ConstructionSort::Tangents => sheet.differentiation(),
        ConstructionSort::Integration | ConstructionSort::Areas => {
            construction.steps.iter().flat_map(|step| sheet.integration(step)).collect()
        }
    };
    let note = sentences::construction_with_divisions(&construction.sort.word(), &diagram.divisions);
    let time = sentences::scale_factor_of_time(&sub("t"), &scale_shown(construction.time));
    let left = panels.iter().map(|panel| -panel.bounds()[0].x).fold(ROOM.left, f64::larger);
    stacked(title, &[note, time], &Room { left, ..ROOM }, panels.into_iter())
}

struct Sheet<'a> {
    diagram: &'a MotionDiagram,
    construction: &'a Construction,
}

impl Sheet<'_> {
    fn x(&self, row: usize) -> f64 {
        LONG * row as f64 / (self.diagram.cranks.len() - 1) as f64
    }

    /// Rows at the ends of the divisions.
    fn rows(&self) -> Vec<usize> {
        (0..self.diagram.cranks.len()).step_by(self.diagram.stride).collect()
    }

    /// A diagram with its axes and the exact curve. `more` are further values that the axis covers.
    fn panel(&self, which: usize, scale: f64, more: &[f64], text: &str) -> (DrawnFigure, ValueAxis) {
        let mut figure = DrawnFigure::default();
        let exact = &self.diagram.exact[which];
        let zero = (which > 0).then_some(0.0);
        let axis = ValueAxis::scaled(ends(exact.iter().chain(more).copied().chain(zero)), scale);
        axis.draw_numbered(&mut figure, LONG, (LONG + 2.0, "start"));
        crank_axis(&mut figure, self.diagram, axis.height());
        let stride = exact.len().div_ceil(POINTS).max(1);
        let curve = (0..exact.len()).step_by(stride).map(|row| Vec2::new(self.x(row), axis.y(exact[row])));
        figure.curve(curve.collect(), None, EXACT);
        let channel = &self.diagram.course.0[which];
        let unit = channel.kind.unit.symbol().replace("s^2", "s²");
        let per = per_millimetre(&unit);
        let symbol = sub(["s", "v", "a"][which]);
        let heading = sentences::scale_factor_2(channel, &symbol, &scale_shown(scale), &per);
        figure.text(Vec2::new(0.0, axis.height() + 7.0), heading, Type { bold: true, ..words(3.8) });
        figure.text(Vec2::new(0.0, axis.height() + 2.4), text, words(3.2));
        (figure, axis)
    }

    /// Draws the points `points` of a diagram (mm), with the chords or tangents.
    /// The numbers of the chords or tangents stand at the positions `at` (mm).
    fn slopes(&self, figure: &mut DrawnFigure, points: &[Vec2], step: &ConstructionStep, at: &[Vec2]) {
        let is_tangent = self.construction.sort == ConstructionSort::Tangents;
        for (number, (middle, ordinate)) in (1..).zip(at.iter().zip(&step.ordinates)) {
            let along = Vec2::new(1.0, ordinate / step.pole);
            let half = 0.4 * LONG / self.diagram.divisions as f64;
            if is_tangent {
                figure.line([middle - along * half, middle + along * half], FOUND);
            }
            figure.text(middle + Vec2::new(0.0, 1.2), number.to_string(), Type { anchor: "middle", ..words(NUMBER) });
        }
        if !is_tangent {
            figure.curve(points.to_vec(), None, FOUND);
        }
        points.iter().for_each(|point| figure.disc(*point, 0.5, BLACK, solid(BLACK, 0.1)));
    }

    /// Draws the pole and the rays left of a diagram. Each ray ends on the ordinate axis.
    /// From there, a horizontal line carries the ordinate to the ray's abscissa in `to` (mm).
    fn rays(&self, figure: &mut DrawnFigure, axis: &ValueAxis, step: &ConstructionStep, to: &[f64], name: &str) {
        let (zero, pole) = (axis.y(0.0), Vec2::new(-step.pole, axis.y(0.0)));
        let mut numbered: Vec<f64> = Vec::new();
        figure.line([pole, Vec2::new(0.0, zero)], solid(BLACK, 0.25));
        for (number, (ordinate, x)) in (1..).zip(step.ordinates.iter().zip(to)) {
            let end = Vec2::new(0.0, zero + ordinate);
            figure.line([pole, end], RAY);
            figure.line([end, Vec2::new(*x, end.y)], CARRIED);
            if numbered.iter().all(|other| (other - end.y).abs() >= APART) {
                let at = end + Vec2::new(0.9, 0.4);
                figure.text(at, number.to_string(), words(NUMBER));
                numbered.push(end.y);
            }
        }
        figure.disc(pole, 0.7, "white", solid(BLACK, 0.35));
        figure.text(pole + Vec2::new(-1.4, -1.2), name, Type { anchor: "end", italic: true, ..words(4.0) });
        let middle = Vec2::new(-step.pole / 2.0, axis.height() + 2.4);
        let length = sentences::pole_distance(&name.replace('P', "H"), &step.pole);
        figure.text(middle, length, Type { anchor: "middle", ..words(3.0) });
    }

    /// The points on paper (mm) that a step has found.
    fn found(&self, step: &ConstructionStep, axis: &ValueAxis) -> Vec<Vec2> {
        let found = result(self.diagram, step.method);
        found.rows.iter().zip(&found.values).map(|(&row, &value)| Vec2::new(self.x(row), axis.y(value))).collect()
    }

    fn differentiation(&self) -> Vec<DrawnFigure> {
        let [first, second] = &self.construction.steps;
        let word = self.construction.sort.word();
        let values = |step: &ConstructionStep| result(self.diagram, step.method).values.clone();
        let (mut top, axis) = self.panel(0, first.scales[0], &[], &sentences::the_curve_and_its(&word));
        let exact = |row: usize| Vec2::new(self.x(row), axis.y(self.diagram.exact[0][row]));
        let points: Vec<Vec2> = self.rows().into_iter().map(exact).collect();
        let at = self.middles(&points, result(self.diagram, first.method).rows.iter().map(|&row| self.x(row)));
        self.slopes(&mut top, &points, first, &at);
        let mut panels = vec![top];
        for (index, step) in [first, second].into_iter().enumerate() {
            let text = self.told(step);
            let (mut figure, axis) = self.panel(step.from + 1, step.scales[1], &values(step), &text);
            let points = self.found(step, &axis);
            let to: Vec<f64> = points.iter().map(|point| point.x).collect();
            self.rays(&mut figure, &axis, step, &to, &format!("P{}", sub(&(index + 1).to_string())));
            if index == 0 {
                let at = self.middles(&points, result(self.diagram, second.method).rows.iter().map(|&row| self.x(row)));
                self.slopes(&mut figure, &points, second, &at);
            } else {
                points.iter().for_each(|point| mark(&mut figure, step.method, *point));
            }
            panels.push(figure);
        }
        panels
    }

    /// Points of the polygon `points` at the abscissas `at` (mm).
    fn middles(&self, points: &[Vec2], at: impl Iterator<Item = f64>) -> Vec<Vec2> {
        let height = |x: f64| {
            let pair = points.windows(2).find(|pair| pair[0].x <= x && x <= pair[1].x)?;
            let share = (x - pair[0].x) / (pair[1].x - pair[0].x);
            Some(pair[0].y + (pair[1].y - pair[0].y) * share)
        };
        at.map(|x| Vec2::new(x, height(x).unwrap_or(points[points.len() - 1].y))).collect()
    }

    /// Two panels: the given derivative with rays or strips, and the integral.
    fn integration(&self, step: &ConstructionStep) -> [DrawnFigure; 2] {
        let given = match self.construction.sort {
            ConstructionSort::Areas => sentences::given_exact_curve_with_areas(&step.pole),
            ConstructionSort::Chords | ConstructionSort::Tangents | ConstructionSort::Integration => {
                sentences::GIVEN_EXACT_CURVE.into()
            }
        };
        let (mut above, axis) = self.panel(step.from, step.scales[0], &[], &given);
        let rows = self.rows();
        let exact = &self.diagram.exact[step.from];
        if self.construction.sort == ConstructionSort::Areas {
            self.strips(&mut above, &axis, &rows, step);
        } else {
            let middles: Vec<f64> = rows[1..].iter().map(|row| self.x(row - self.diagram.stride / 2)).collect();
            let name = format!("P{}", sub(&step.from.to_string()));
            self.rays(&mut above, &axis, step, &middles, &name);
            for (row, x) in rows[1..].iter().zip(&middles) {
                let at = Vec2::new(*x, axis.y(exact[row - self.diagram.stride / 2]));
                above.disc(at, 0.5, BLACK, solid(BLACK, 0.1));
            }
        }
        let values = &result(self.diagram, step.method).values;
        let (mut below, axis) = self.panel(step.from - 1, step.scales[1], values, &self.told(step));
        let points = self.found(step, &axis);
        points.iter().for_each(|point| mark(&mut below, step.method, *point));
        below.curve(points, None, FOUND);
        [above, below]
    }

    /// Draws the trapezoids below a curve, each with its area in square millimetres.
    fn strips(&self, figure: &mut DrawnFigure, axis: &ValueAxis, rows: &[usize], step: &ConstructionStep) {
        let exact = &self.diagram.exact[step.from];
        let is_wide = self.diagram.divisions <= 24;
        for (index, (pair, area)) in rows.windows(2).zip(&step.ordinates).enumerate() {
            let at = |row: usize, value: f64| Vec2::new(self.x(row), axis.y(value));
            let corners =
                vec![at(pair[0], 0.0), at(pair[1], 0.0), at(pair[1], exact[pair[1]]), at(pair[0], exact[pair[0]])];
            figure.area(corners, (index % 2 == 0).then_some(STRIP), solid(COLOURS[0], 0.2));
            if is_wide {
                let middle = (self.x(pair[0]) + self.x(pair[1])) / 2.0;
                let above = if *area < 0.0 { -3.0 } else { 1.0 };
                let set = Type { anchor: "middle", ..words(NUMBER) };
                figure.text(Vec2::new(middle, axis.y(0.0) + above), format!("{area:.0}"), set);
            }
        }
    }

    /// Text with the method of a step and the largest error of this method.
    fn told(&self, step: &ConstructionStep) -> String {
        let found = result(self.diagram, step.method);
        let unit = self.diagram.course.0[step.method.gives()].kind.unit.symbol().replace("s^2", "s²");
        let name = step.method.words();
        sentences::found_with_largest_error(&name, &significant(found.largest), &unit, &(found.share * 100.0))
    }
}
