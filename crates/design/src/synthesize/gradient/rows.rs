//! The quantities of a candidate over a turn of the crank, with their exact derivatives by the variables.
//!
//! Side 1, the analytic solver, computes the pose.
//! From this pose, the crate `precise` solves all equations of the mechanism in dual numbers.

use std::f64::consts::TAU;

use linkage::case::Case;
use linkage::error::Result;
use linkage::math::Motion;
use linkage::math::statistics::ascending;
use linkage::mechanism::{Group, LinkId, PerLink};
use linkage::trajectory::Channel;
use precise::{Dual, Readings, Scalar, Whole};

use super::dimensions::Dimensions;
use super::gaps::Gaps;
use super::sloped::Sloped;
use crate::sensitivity::Quantity;
use crate::synthesize::evaluate::Evaluator;
use crate::synthesize::nearest::nearest;
use crate::synthesize::search::values;
use crate::synthesize::target::at_speed;
use crate::synthesize::task::{OutputQuantity, Task};

/// Number of variables by which one solution in dual numbers differentiates.
const WIDTH: usize = 16;

/// Whether only values are computed, or also their derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    Values,
    Slopes,
}

/// Quantities at one crank angle.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    /// The output (rad or m).
    pub(super) output: Sloped,
    /// Derivative of the output with respect to the crank angle (rad/rad or m/rad). The crank angle is positive in the
    /// sense of rotation.
    pub(super) rate: Sloped,
    /// Square of the working point's acceleration, divided by the square of its limit. `None` without a limit.
    pub(super) acceleration: Option<Sloped>,
    /// Squares of the sines of the dyads' transmission angles. Empty without a limit.
    pub(super) sines: Vec<Sloped>,
    /// The limited quantities of the task, in their units.
    pub(super) kept: Vec<Sloped>,
    /// Distances of all pairs of bodies (m). Empty without a limit.
    pub(super) gaps: Vec<Sloped>,
}

/// Position of the output link at one crank angle.
#[derive(Clone, Debug, Default)]
pub(super) struct PoseRow {
    /// Position of the working point (m), and angle of the link (rad). Values that the task does not need are zero.
    pub(super) values: [Sloped; 3],
    /// Derivatives with respect to the crank angle (m/rad and rad/rad). The crank angle is positive in the sense of
    /// rotation.
    pub(super) rates: [f64; 3],
}

/// The quantities of a candidate.
#[derive(Clone, Debug, Default)]
pub(super) struct Sampled {
    /// Quantities at the crank angles `Rows::turns`.
    pub(super) rows: Vec<Row>,
    /// Positions of the output link at the crank angles of the precision points.
    pub(super) poses: Vec<PoseRow>,
    /// Mass of all moving links (kg).
    pub(super) mass: Sloped,
}

/// A quantity as a sum of channels, each times a factor.
type Terms = Vec<(Channel, f64)>;

/// Computes the rows of one candidate after another.
pub(super) struct Rows<'a> {
    task: &'a Task,
    /// The mechanism with the task's starting dimensions, over one turn at a constant speed of the crank.
    case: Case,
    evaluator: Evaluator<'a>,
    output: Terms,
    rate: Terms,
    acceleration: Vec<Channel>,
    groups: Vec<&'a Group>,
    kept: Vec<Quantity>,
    gaps: Option<Gaps>,
    /// Place of the working point and angle of the output link, and their rates.
    pose: [Terms; 3],
    pose_rates: [Terms; 3],
    /// Crank angles of the rows (rad, from crank angle zero in the sense of rotation).
    pub(super) turns: Vec<f64>,
    /// Number of poses that were solved.
    pub(super) poses: u64,
}

impl<'a> Rows<'a> {
    /// Rows at the crank angles `turns`, which ascend over a whole turn.
    ///
    /// # Errors
    /// The errors of [`at_speed`].
    pub(super) fn new(task: &'a Task, turns: Vec<f64>) -> Result<Self> {
        let case = at_speed(&task.case, task.case.crank().top_speed().abs())?;
        let links = case.mechanism.links();
        let of_point = |link: LinkId, point: usize, suffix: &str| {
            Channel::named(&format!("point.{}.{suffix}", links[link].points[point].name))
        };
        let terms = |suffixes: [&str; 3]| match task.output {
            OutputQuantity::Angle { link, .. } => {
                let channel = Channel::named(&format!("link.{}.{}", links[link].name, suffixes[0]));
                channel.map(|channel| (channel, 1.0)).into_iter().collect()
            }
            OutputQuantity::Coordinate { link, point, along } => {
                let term = |axis: usize| Some((of_point(link, point, suffixes[axis + 1])?, along[axis]));
                [0, 1].into_iter().filter_map(term).collect::<Terms>()
            }
        };
        let acceleration = match task.output.working_point() {
            (link, Some(point)) if task.acceleration.is_finite() => {
                ["ax_m_s2", "ay_m_s2"].into_iter().filter_map(|suffix| of_point(link, point, suffix)).collect()
            }
            _ => Vec::new(),
        };
        let speed = case.crank().top_speed().abs();
        let (link, point) = task.output.working_point();
        let pose = |places: [&str; 2], angle: &str| -> [Terms; 3] {
            let term = |channel: Option<Channel>| channel.map(|channel| (channel, 1.0)).into_iter().collect::<Terms>();
            let place = |suffix: &str| term(point.and_then(|point| of_point(link, point, suffix)));
            let angle = Channel::named(&format!("link.{}.{angle}", links[link].name));
            [place(places[0]), place(places[1]), term(angle)]
        };
        let per_turn = |terms: Terms| terms.into_iter().map(|(channel, factor)| (channel, factor / speed)).collect();
        let is_limited = task.transmission > 0.0;
        Ok(Rows {
            output: terms(["angle_rad", "x_m", "y_m"]),
            rate: per_turn(terms(["omega_rad_s", "vx_m_s", "vy_m_s"])),
            pose: pose(["x_m", "y_m"], "angle_rad"),
            pose_rates: pose(["vx_m_s", "vy_m_s"], "omega_rad_s").map(per_turn),
            acceleration,
            groups: task.case.structure.groups.iter().filter(|_| is_limited).collect(),
            kept: task.keep.iter().filter_map(|keep| Quantity::of(&keep.claim)).collect(),
            gaps: task.clearance.as_ref().map(|own| Gaps::of(&own.question, &task.case)),
            evaluator: Evaluator::recording(task),
            task,
            case,
            turns,
            poses: 0,
        })
    }

    /// Crank angles (rad) at which a candidate comes nearest to the precision points.
    /// `None` if the candidate cannot be assembled over the whole turn.
    pub(super) fn turns_near(&mut self, shares: &[f64]) -> Option<Vec<f64>> {
        let values = values(self.task, shares);
        self.evaluator.run(&values, self.task.zero.value(&values), &self.turns).ok()?;
        self.poses += self.turns.len() as u64;
        Some(nearest(self.task, &self.evaluator, &self.turns))
    }

    /// The quantities of a candidate, with positions of the output link at the crank angles `extra` (rad).
    /// `shares` are the candidate's variables as fractions of their ranges.
    /// `None` if the candidate cannot be assembled over the whole turn, or is singular at one of the crank angles.
    pub(super) fn at(&mut self, shares: &[f64], extra: &[f64], order: Order) -> Option<Sampled> {
        let values = values(self.task, shares);
        let turns: Vec<f64> = self.turns.iter().copied().chain(extra.iter().map(|turn| turn.rem_euclid(TAU))).collect();
        let sorted = ascending(&turns);
        let ascend: Vec<f64> = sorted.iter().map(|row| turns[*row]).collect();
        let before = self.evaluator.poses;
        let placed = self.evaluator.run(&values, self.task.zero.value(&values), &ascend);
        self.poses += self.evaluator.poses - before;
        placed.ok()?;
        match order {
            Order::Values => self.part::<0>(shares, 0, &turns, &sorted),
            Order::Slopes => {
                let count = self.task.variables.len();
                let starts = (0..count).step_by(WIDTH);
                let mut parts = starts.map(|first| self.part::<WIDTH>(shares, first, &turns, &sorted));
                let mut found = parts.next()??;
                for mut part in parts.collect::<Option<Vec<_>>>()? {
                    found.all().zip(part.all()).for_each(|(own, more)| own.slopes.append(&mut more.slopes));
                }
                found.all().for_each(|own| own.slopes.truncate(count));
                Some(found)
            }
        }
    }

    /// The quantities with their derivatives by `N` variables, beginning with the variable `first`.
    /// `sorted` are the indices of the crank angles `turns` in ascending order.
    fn part<const N: usize>(
        &mut self,
        shares: &[f64],
        first: usize,
        turns: &[f64],
        sorted: &[usize],
    ) -> Option<Sampled> {
        let dimensions = Dimensions::<N>::of(self.task, shares, first);
        let numbers = dimensions.lifted(&self.case).ok()?;
        let readings = Readings::of(Whole::new(&self.case, &numbers));
        let crank = self.case.crank();
        let (sense, speed) = (crank.sense(), crank.top_speed().abs());
        let mut angles: Vec<f64> = vec![0.0; self.case.mechanism.links().len()];
        let frame = self.turns.len();
        let mut found = Sampled {
            rows: Vec::with_capacity(frame),
            poses: vec![PoseRow::default(); turns.len() - frame],
            mass: sloped(dimensions.mass()),
        };
        for (&row, motions) in sorted.iter().zip(&self.evaluator.recorded) {
            follow(&mut angles, motions);
            let time = (turns[row] - sense * crank.start) / speed;
            let state = Whole::new(&self.case, &numbers).near(motions, &angles, time, false)?;
            let sum = |terms: &Terms| {
                let term =
                    |(channel, factor): &(Channel, f64)| Some(readings.read(&state, channel)? * Dual::of(*factor));
                terms.iter().map(term).try_fold(Dual::<f64, N>::ZERO, |sum, term| Some(sum + term?))
            };
            if row >= frame {
                let read = |terms: &[Terms; 3]| terms.each_ref().map(|terms| sum(terms).unwrap_or(Dual::ZERO));
                let (values, rates) = (read(&self.pose), read(&self.pose_rates));
                found.poses[row - frame] = PoseRow { values: values.map(sloped), rates: rates.map(|rate| rate.value) };
                continue;
            }
            let squares = self.acceleration.iter().map(|channel| readings.read(&state, channel).map(|own| own * own));
            let squared = squares.flatten().fold(Dual::ZERO, |sum, square| sum + square);
            let limit = self.task.acceleration.powi(2);
            let sine = |group: &&Group| readings.squared_transmission_sine(&state, group);
            found.rows.push(Row {
                output: sloped(sum(&self.output)?),
                rate: sloped(sum(&self.rate)?),
                acceleration: (!self.acceleration.is_empty()).then(|| sloped(squared / Dual::of(limit))),
                sines: self.groups.iter().filter_map(sine).map(sloped).collect(),
                kept: self.kept.iter_mut().map(|own| sloped(own.at(&readings, &state))).collect(),
                gaps: self.gaps.iter().flat_map(|own| own.at(&dimensions, &readings, &state)).map(sloped).collect(),
            });
        }
        self.poses += turns.len() as u64;
        Some(found)
    }
}

impl Sampled {
    /// All quantities with derivatives.
    fn all(&mut self) -> impl Iterator<Item = &mut Sloped> {
        let poses = self.poses.iter_mut().flat_map(|pose| &mut pose.values);
        self.rows.iter_mut().flat_map(Row::all).chain(poses).chain([&mut self.mass])
    }
}

impl Row {
    fn all(&mut self) -> impl Iterator<Item = &mut Sloped> {
        let Row { output, rate, acceleration, sines, kept, gaps } = self;
        [output, rate].into_iter().chain(acceleration).chain(sines).chain(kept).chain(gaps)
    }
}

fn sloped<const N: usize>(number: Dual<f64, N>) -> Sloped {
    Sloped { value: number.value, slopes: number.slopes.to_vec() }
}

/// Continues the angles of all links (rad) to the next pose, without jumps by a full turn.
fn follow(angles: &mut [f64], motions: &PerLink<Motion>) {
    for (angle, motion) in angles.iter_mut().zip(motions) {
        let next = motion.direction.y.atan2(motion.direction.x);
        *angle = next - TAU * ((next - *angle) / TAU).round();
    }
}
