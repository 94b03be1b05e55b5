//! The task as a nonlinear programme: minimise the largest deviation from the required motion, within all limits.
//!
//! The unknowns are the variables of the task (fractions of their ranges), the largest deviation h, the level of every
//! dwell, and every free crank angle of a precision point.
//! The objective is h. All constraints have the form c <= 0.
//! The output is u, a fraction of the stroke from its rearmost position.
//!
//! - Dwell: u stays within h / 2 of its level, so that its motion is at most h.
//! - Moving phase: the rate of u in the wrong sense, times a crank angle of 20 deg, is at most h.
//!   At the crank angle between two opposite motions, the conditions of both phases apply. There, the magnitude of the
//!   rate times 20 deg is at most h.
//! - Known levels: u differs from a level by at most h. If u must follow a curve, it differs from the curve by at most
//!   h over the whole turn.
//! - Precision points: the angle of the output link differs from the required angle by at most h. The coordinates,
//!   divided by the extent of all points, also differ from the required coordinates by at most h.
//!   Free crank angles ascend.
//! - Stroke, acceleration, transmission angles, distances, mass and limited quantities stay within their limits.

use super::rows::{PoseRow, Row, Sampled};
use super::sloped::Sloped;
use crate::synthesize::rating::{LATE, Rater};
use crate::synthesize::task::{Phase, PrecisionPoint, Sense, Task};
use linkage::math::statistics::ends;
use linkage::math::{KeepNan, Vec2};

/// The programme of a task: its unknowns and constraints.
pub(super) struct Wishes<'a> {
    task: &'a Task,
    /// Sense of the output that counts as forward: +1 or -1.
    forward: f64,
    /// Rows at which the phases end, and the required curve. The curve is empty if the output need not follow a curve.
    frame: &'a Rater<'a>,
    /// Indices of the phases that are dwells. Each dwell has an unknown level.
    dwells: Vec<usize>,
    /// For every precision point, the index of the unknown for its crank angle; `None` if the task gives the crank
    /// angle.
    turns: Vec<Option<usize>>,
}

/// The output of a candidate as a fraction of its stroke.
pub(super) struct Output {
    /// Stroke (rad or m).
    stroke: Sloped,
    /// Fraction of the stroke in every row, and its derivative by the crank angle.
    shares: Vec<Sloped>,
    rates: Vec<Sloped>,
}

impl Output {
    /// `forward` is the sense of the output that counts as forward (+1 or -1).
    fn of(rows: &[Row], forward: f64) -> Self {
        let ahead = |row: &Row| forward * row.output.value;
        let by = |a: &&Row, b: &&Row| ahead(a).total_cmp(&ahead(b));
        let ends = rows.iter().min_by(by).zip(rows.iter().max_by(by));
        let (low, high) = ends.map(|(low, high)| (&low.output, &high.output)).expect("there are rows");
        let stroke = high.plus(-1.0, low).scaled(forward, 0.0);
        let share = |row: &Row| row.output.plus(-1.0, low).scaled(forward, 0.0).over(&stroke);
        let rate = |row: &Row| row.rate.scaled(forward, 0.0).over(&stroke);
        Output { shares: rows.iter().map(share).collect(), rates: rows.iter().map(rate).collect(), stroke }
    }
}

/// Collects the constraints at a point of the programme: values, and derivatives by all unknowns.
struct Collected<'a> {
    point: &'a [f64],
    deviation: usize,
    found: Vec<Sloped>,
}

impl Collected<'_> {
    /// Adds `value + sum of (factor * unknown) <= 0`.
    fn add(&mut self, mut value: Sloped, terms: &[(usize, f64)]) {
        let has_slopes = !value.slopes.is_empty();
        if has_slopes {
            value.slopes.resize(self.point.len(), 0.0);
        }
        for &(index, factor) in terms {
            value.value += factor * self.point[index];
            if has_slopes {
                value.slopes[index] += factor;
            }
        }
        self.found.push(value);
    }

    /// Adds `|value - level| <= width * h`, where `level` is an unknown, or zero.
    fn within(&mut self, value: &Sloped, level: Option<usize>, width: f64) {
        for sign in [1.0, -1.0] {
            let level = level.map(|level| (level, -sign));
            let terms: Vec<(usize, f64)> = level.into_iter().chain([(self.deviation, -width)]).collect();
            self.add(value.scaled(sign, 0.0), &terms);
        }
    }
}

impl<'a> Wishes<'a> {
    pub(super) fn of(task: &'a Task, forward: f64, frame: &'a Rater<'a>) -> Self {
        let phases = task.timing.phases().iter().enumerate();
        let dwells: Vec<usize> =
            phases.filter(|(_, phase)| phase.sense == Sense::Dwell).map(|(index, _)| index).collect();
        let mut unknown = task.variables.len() + dwells.len();
        let mut next = |point: &PrecisionPoint| {
            unknown += usize::from(point.turn.is_none());
            point.turn.is_none().then_some(unknown)
        };
        let turns = task.points.all().iter().map(&mut next).collect();
        Wishes { task, forward, frame, dwells, turns }
    }

    /// Whether an unknown is a crank angle (rad).
    pub(super) fn is_turn(&self, unknown: usize) -> bool {
        self.turns.contains(&Some(unknown))
    }

    /// The crank angles (rad) of the precision points: given by the task, or unknowns of the programme's `point`.
    pub(super) fn turns(&self, point: &[f64]) -> Vec<f64> {
        let pairs = self.task.points.all().iter().zip(&self.turns);
        pairs.map(|(own, unknown)| unknown.map_or(own.turn.unwrap_or(0.0), |unknown| point[unknown])).collect()
    }

    /// The task's variables at a point of the programme, as fractions of their ranges.
    pub(super) fn shares<'b>(&self, point: &'b [f64]) -> &'b [f64] {
        &point[..self.task.variables.len()]
    }

    /// The index that the unknown h, the largest deviation, has among the unknowns.
    pub(super) fn deviation(&self) -> usize {
        self.task.variables.len()
    }

    /// The values of the programme's unknowns for a candidate: the variables as fractions `shares` of their ranges,
    /// the smallest deviation with which the candidate keeps all constraints, the candidate's levels in dwells, and
    /// the free crank angles among `turns` (rad).
    pub(super) fn start(&self, found: &Sampled, shares: &[f64], turns: &[f64]) -> Vec<f64> {
        let output = Output::of(&found.rows, self.forward);
        let level = |dwell: &usize| {
            let from = dwell.checked_sub(1).map_or(0, |before| self.frame.ends[before]);
            let [low, high] = ends(output.shares[from..=self.frame.ends[*dwell]].iter().map(|share| share.value));
            0.5 * (low + high)
        };
        let free = turns.iter().zip(&self.turns).filter(|(_, unknown)| unknown.is_some()).map(|(turn, _)| *turn);
        let levels = self.dwells.iter().map(level);
        let mut point: Vec<f64> = shares.iter().copied().chain([0.0]).chain(levels).chain(free).collect();
        point[self.deviation()] = self.needed(found, &point);
        point
    }

    /// The smallest deviation h with which a point keeps all constraints that contain h.
    fn needed(&self, found: &Sampled, point: &[f64]) -> f64 {
        // Such a constraint has the form c - width h <= 0. The values of its left side for h = 0 and h = 1 give c and
        // the width.
        let with = |h: f64| {
            let mut point = point.to_vec();
            point[self.deviation()] = h;
            self.constraints(found, &point)
        };
        let pairs = with(0.0).into_iter().zip(with(1.0));
        let widths = pairs.map(|(zero, one)| (zero.value, zero.value - one.value)).filter(|(_, width)| *width > 0.0);
        widths.map(|(value, width)| value / width).fold(0.0, f64::larger)
    }

    /// All constraints at a point of the programme.
    pub(super) fn constraints(&self, found: &Sampled, point: &[f64]) -> Vec<Sloped> {
        let output = Output::of(&found.rows, self.forward);
        let mut all = Collected { point, deviation: self.deviation(), found: Vec::new() };
        let mut from = 0;
        for (index, (phase, &to)) in self.task.timing.phases().iter().zip(&self.frame.ends).enumerate() {
            let level = self.dwells.iter().position(|dwell| *dwell == index).map(|place| self.deviation() + 1 + place);
            match level {
                Some(level) => {
                    output.shares[from..=to].iter().for_each(|share| all.within(share, Some(level), 0.5));
                }
                None => moving(&mut all, &output, phase, [from, to]),
            }
            if let Some(level) = self.task.timing.level(index) {
                all.within(&output.shares[to].scaled(1.0, -level), None, 1.0);
            }
            from = to;
        }
        for (share, wanted) in output.shares.iter().zip(&self.frame.wanted) {
            all.within(&share.scaled(1.0, -wanted), None, 1.0);
        }
        self.reach(&mut all, &found.poses);
        limits(&mut all, self.task, found, &output);
        all.found
    }

    /// The constraints of the precision points.
    fn reach(&self, all: &mut Collected, poses: &[PoseRow]) {
        let points = &self.task.points;
        for ((wanted, unknown), pose) in points.all().iter().zip(&self.turns).zip(poses) {
            let [x, y, angle] = pose.values.each_ref().map(|own| own.value);
            let apart = points.deviations(wanted, Vec2::new(x, y), angle);
            let scales = [points.extent(), points.extent(), 1.0];
            let is_wanted = [wanted.place.is_some(), wanted.place.is_some(), wanted.angle.is_some()];
            for axis in (0..3).filter(|axis| is_wanted[*axis]) {
                let mut value = pose.values[axis].scaled(1.0 / scales[axis], 0.0);
                value.value = apart[axis];
                if let Some(unknown) = unknown.filter(|_| !value.slopes.is_empty()) {
                    value.slopes.resize(all.point.len(), 0.0);
                    value.slopes[unknown] = pose.rates[axis] / scales[axis];
                }
                all.within(&value, None, 1.0);
            }
        }
        let free: Vec<usize> = self.turns.iter().flatten().copied().collect();
        let slopes = poses.first().map_or(Vec::new(), |pose| vec![0.0; pose.values[0].slopes.len()]);
        for pair in free.windows(2) {
            all.add(Sloped { value: 0.0, slopes: slopes.clone() }, &[(pair[0], 1.0), (pair[1], -1.0)]);
        }
    }
}

/// The constraints of a moving phase between two rows.
fn moving(all: &mut Collected, output: &Output, phase: &Phase, [from, to]: [usize; 2]) {
    let (sign, deviation) = (phase.sense.sign(), all.deviation);
    for rate in &output.rates[from..=to] {
        all.add(rate.scaled(-sign * LATE, 0.0), &[(deviation, -1.0)]);
    }
    let way = output.shares[to].plus(-1.0, &output.shares[from]);
    all.add(way.scaled(-sign, phase.least), &[]);
}

/// The constraints of all limits.
fn limits(all: &mut Collected, task: &Task, found: &Sampled, output: &Output) {
    let [least, most] = task.stroke;
    if least > 0.0 {
        all.add(output.stroke.scaled(-1.0 / least, 1.0), &[]);
    }
    if most.is_finite() {
        all.add(output.stroke.scaled(1.0 / most, -1.0), &[]);
    }
    if task.mass.is_finite() {
        all.add(found.mass.scaled(1.0 / task.mass, -1.0), &[]);
    }
    let flat = task.transmission.sin().powi(2);
    let size = task.case.mechanism.size();
    for row in &found.rows {
        let wanted = task.clearance.as_ref().map_or(0.0, |own| own.wanted);
        row.gaps.iter().for_each(|gap| all.add(gap.scaled(-1.0 / size, wanted / size), &[]));
        row.acceleration.iter().for_each(|square| all.add(square.scaled(0.5, -0.5), &[]));
        row.sines.iter().for_each(|sine| all.add(sine.scaled(-1.0, flat), &[]));
        for (kept, keep) in row.kept.iter().zip(&task.keep) {
            let ([low, high], scale) = (keep.bounds, keep.scale());
            if low.is_finite() {
                all.add(kept.scaled(-1.0 / scale, low / scale), &[]);
            }
            if high.is_finite() {
                all.add(kept.scaled(1.0 / scale, -high / scale), &[]);
            }
        }
    }
}
