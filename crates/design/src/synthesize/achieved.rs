//! The achieved motion of a mechanism, compared with the required motion of its output at many crank angles.

use crate::sentences;
use linkage::math::statistics::ends;
use linkage::math::{KeepNan, Vec2};
use std::f64::consts::TAU;

use super::evaluate::Evaluator;
use super::reached::{ReachedPoint, reached};
use crate::synthesize::task::{Phase, Sense, Task};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::mechanism::GroupKind;

/// Rows per turn.
const ROWS: usize = 7200;
/// Number of rows from one stored position of a path to the next.
pub const PATH: usize = 10;
/// Half width of the band of outputs that count as a dwell (fraction of the stroke). The dwell ends where the output
/// leaves the band.
pub const BAND: f64 = 0.01;

/// The crank angles at which a motion is measured (rad), over one turn.
pub(super) fn fine_turns() -> Vec<f64> {
    (0..=ROWS).map(|row| TAU * (row as f64 / ROWS as f64)).collect()
}

/// Achieved motion in one phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseDone {
    /// Displacement from the beginning of the phase to its end, forward positive (fraction of the stroke).
    pub displacement: f64,
    /// Largest minus smallest position of the output in the phase (fraction of the stroke). In a dwell, this difference
    /// should be zero.
    pub motion: f64,
    /// Distance travelled in the wrong sense (fraction of the stroke); 0 in a dwell.
    pub wrong: f64,
    /// Position of the output at the end of the phase (fraction of the stroke).
    pub level: f64,
    /// Crank angle (rad) at which the phase ends in the achieved motion.
    /// Between two motions in opposite senses, `end` is the crank angle of the extreme position.
    /// If this phase or the next phase is a dwell, `end` is the crank angle at which the output leaves or enters the
    /// band.
    /// The band has the half width [`BAND`] about the mean of the dwell's largest and smallest output.
    /// `end` is `None` between two phases of the same sense, or if the extreme position or the edge of the band is not
    /// found within a quarter of a turn.
    pub end: Option<f64>,
}

/// The motion of a mechanism, compared with the required timing.
#[derive(Clone, Debug, PartialEq)]
pub struct Achieved {
    /// Stroke of the output (rad or m).
    pub stroke: f64,
    /// Smallest transmission angle of any dyad over the turn (rad).
    /// `None` if the mechanism has higher groups, for which no transmission angle is defined.
    pub transmission: Option<f64>,
    /// The phases, in their order.
    pub phases: Vec<PhaseDone>,
    /// Crank angles of the curve (rad from crank angle zero in the sense of rotation).
    pub turns: Vec<f64>,
    /// Output at the crank angles of `turns` (fraction of the stroke; 0 is the rearmost position).
    pub shares: Vec<f64>,
    /// Sense of the output that counts as forward: +1 or -1.
    pub forward: f64,
    /// Positions at the precision points of the task.
    pub points: Vec<ReachedPoint>,
    /// World positions of the working point (m) and angles of the output link (rad), at every tenth crank angle of
    /// `turns`. Empty for a task without precision points.
    pub path: Vec<(Vec2, f64)>,
}

impl Achieved {
    /// Achieved motion of the mechanism of `task.case` with its present dimensions.
    /// `forward` is the sense of the output that counts as forward (+1 or -1).
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the mechanism cannot be assembled over the whole turn, or if the task has phases and
    /// the output turns fully.
    pub fn of(task: &Task, forward: f64) -> Result<Self> {
        let turns = fine_turns();
        let as_drawn = Task { places: Vec::new(), ..task.clone() };
        let mut evaluator = Evaluator::new(&as_drawn);
        evaluator.run(&[], task.case.crank().zero, &turns).map_err(|_| {
            Error::new(ErrorKind::Geometry, sentences::THE_MECHANISM_CANNOT_BE_ASSEMBLED).help(Advice::LookAtRange)
        })?;
        let curve = &evaluator.curve;
        let [low, high] = ends(curve.iter().copied());
        let dyads = task.case.structure.groups.iter().all(|group| group.kind != GroupKind::Higher);
        let share =
            |&value: &f64| if forward > 0.0 { (value - low) / (high - low) } else { (high - value) / (high - low) };
        let mut found = Achieved {
            stroke: high - low,
            transmission: dyads.then(|| evaluator.sine.clamp(0.0, 1.0).asin()),
            phases: Vec::new(),
            shares: curve.iter().map(share).collect(),
            turns,
            forward,
            points: reached(task)?,
            path: (0..evaluator.recorded.len()).step_by(PATH).map(|row| evaluator.position(row)).collect(),
        };
        found.phases = (0..task.timing.phases().len()).map(|phase| found.phase(task, phase)).collect();
        Ok(found)
    }

    /// Achieved motion as in [`Achieved::of`].
    /// If the task leaves the forward sense open, both senses are tried.
    /// The result is the sense for which the output travels the smaller total distance in the wrong sense.
    ///
    /// # Errors
    /// The errors of [`Achieved::of`].
    pub fn of_either(task: &Task) -> Result<Self> {
        if let Some(forward) = task.forward {
            return Achieved::of(task, forward);
        }
        let [ahead, back] = [Achieved::of(task, 1.0)?, Achieved::of(task, -1.0)?];
        let wrong = |found: &Achieved| found.phases.iter().map(|phase| phase.wrong).sum::<f64>();
        Ok(if wrong(&ahead) <= wrong(&back) { ahead } else { back })
    }

    /// For every phase: its achieved motion, its required motion, and the required sense of the next phase.
    fn with_next<'a>(&'a self, task: &'a Task) -> impl Iterator<Item = (&'a PhaseDone, &'a Phase, Sense)> {
        let phases = task.timing.phases();
        let next = phases.iter().cycle().skip(1).map(|phase| phase.sense);
        self.phases.iter().zip(phases).zip(next).map(|((done, phase), next)| (done, phase, next))
    }

    /// Largest motion in any dwell (fraction of the stroke).
    pub fn unrest(&self, task: &Task) -> f64 {
        let dwells = self.with_next(task).filter(|(_, phase, _)| phase.sense == Sense::Dwell);
        dwells.map(|(done, ..)| done.motion).fold(0.0, f64::larger)
    }

    /// Largest distance travelled in the wrong sense in any phase (fraction of the stroke).
    pub fn wrong(&self) -> f64 {
        self.phases.iter().map(|phase| phase.wrong).fold(0.0, f64::larger)
    }

    /// Largest deviation (rad) of an extreme position from its required crank angle: the crank angle at which the task
    /// changes from one sense of motion to the other.
    pub fn late(&self, task: &Task) -> f64 {
        let turns = self.with_next(task).filter(|(_, phase, next)| phase.sense.sign() * next.sign() < 0.0);
        let apart = turns.map(|(done, phase, _)| done.end.map_or(TAU, |end| (end - phase.to).abs()));
        apart.fold(0.0, f64::larger)
    }

    /// Largest crank angle (rad) by which a dwell begins too late or ends too early.
    /// During this crank angle, the output should dwell but is outside the band of half width [`BAND`]. Dwells that are
    /// too long have no effect on the result.
    pub fn short(&self, task: &Task) -> f64 {
        let missing = |(done, phase, next): (&PhaseDone, &Phase, Sense)| match (phase.sense, next) {
            (Sense::Dwell, Sense::Dwell) => None,
            (Sense::Dwell, _) => Some(phase.to - done.end?),
            (_, Sense::Dwell) => Some(done.end? - phase.to),
            _ => None,
        };
        self.with_next(task).filter_map(missing).fold(0.0, f64::larger)
    }

    /// The output at the crank angle `crank` (rad, 0 to a turn), as a fraction of the stroke.
    /// The result is the output at the first measured crank angle that is not before `crank`.
    pub fn share(&self, crank: f64) -> f64 {
        let row = self.turns.partition_point(|&turn| turn < crank - 1e-9);
        self.shares[row.min(self.shares.len() - 1)]
    }

    /// The output at any row (fraction of the stroke). Row numbers continue over several turns.
    fn at(&self, row: i64) -> f64 {
        self.shares[row.rem_euclid(ROWS as i64) as usize]
    }

    /// The smallest and the largest output between the rows `from` and `to` (fraction of the stroke).
    fn ends(&self, from: i64, to: i64) -> [f64; 2] {
        ends((from..=to).map(|row| self.at(row)))
    }

    fn row(&self, turn: f64) -> i64 {
        (turn / TAU * ROWS as f64).round() as i64
    }

    fn phase(&self, task: &Task, index: usize) -> PhaseDone {
        let phases = task.timing.phases();
        let (phase, next) = (&phases[index], &phases[(index + 1) % phases.len()]);
        let (from, to) = (self.row(phase.from), self.row(phase.to));
        let [low, high] = self.ends(from, to);
        let sign = phase.sense.sign();
        let end = match (phase.sense, next.sense) {
            (Sense::Dwell, Sense::Dwell) => None,
            (Sense::Dwell, _) => self.leaves(from, to, 1).map(|row| self.turn_near(row, phase.to)),
            (_, Sense::Dwell) => {
                let far = self.row(next.to) - self.row(next.from);
                self.leaves(to + far, to, -1).map(|row| self.turn_near(row, phase.to))
            }
            (own, other) if own != other => self.extreme(to, sign).map(|row| self.turn_near(row, phase.to)),
            _ => None,
        };
        PhaseDone {
            displacement: self.at(to) - self.at(from),
            motion: high - low,
            wrong: (from..to).map(|row| (-sign * (self.at(row + 1) - self.at(row))).larger(0.0)).sum(),
            level: self.at(to),
            end,
        }
    }

    /// Crank angle (rad) of a row, in the turn in which this angle is closest to `to`.
    fn turn_near(&self, row: f64, to: f64) -> f64 {
        let turn = row * TAU / ROWS as f64;
        turn + TAU * ((to - turn) / TAU).round()
    }

    /// Row at which the output leaves the band of a dwell.
    /// The middle of the band is the mean of the smallest and the largest output between the rows `from` and `to`.
    /// The search begins in the middle between these rows and proceeds towards `to` and beyond.
    fn leaves(&self, from: i64, to: i64, way: i64) -> Option<f64> {
        let (first, last) = (from.min(to), from.max(to));
        let [low, high] = self.ends(first, last);
        let middle = (high + low) / 2.0;
        let mut row = (first + last) / 2;
        let outside = to + way * (ROWS as i64 / 4);
        while row != outside && (self.at(row) - middle).abs() <= BAND {
            row += way;
        }
        (row != outside).then_some(row as f64)
    }

    /// The row of the extreme position nearest to the row `to`, within a quarter of a turn: a maximum for `sign` +1, a
    /// minimum for -1.
    /// A parabola through three neighbouring rows gives the fraction of the row.
    fn extreme(&self, to: i64, sign: f64) -> Option<f64> {
        let value = |row: i64| sign * self.at(row);
        let is_top = |row: &i64| value(*row) >= value(row - 1) && value(*row) > value(row + 1);
        let row = (0..ROWS as i64 / 4).flat_map(|off| [to - off, to + off]).find(is_top)?;
        let [a, b, c] = [row - 1, row, row + 1].map(value);
        Some(row as f64 + 0.5 * (a - c) / (a - 2.0 * b + c))
    }
}
