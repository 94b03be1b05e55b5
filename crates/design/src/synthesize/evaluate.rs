//! The motion of a candidate: from dimensions to the output over one turn.

use std::f64::consts::{PI, TAU};

use crate::synthesize::task::{OutputQuantity, Task};
use analytic::assur::groups::{SolutionPlan, Step};
use linkage::math::{KeepNan, Motion, Vec2, cross, unit};
use linkage::mechanism::assembly::transmission_sine;
use linkage::mechanism::{LinkPose, Mechanism, PerLink, Pose, first_pose};
use linkage::solver::State;

/// Number of poses, spread over the turn, that are tried before all others. Most candidates that cannot be assembled
/// fail in one of these poses.
const PROBES: usize = 8;
/// Largest step of the crank (rad) from one pose to the next, if a mechanism is followed step by step.
const FOLLOWED: f64 = PI / 90.0;

/// Computes the motion of one candidate after another over a turn. The loop over the poses does not allocate.
pub(super) struct Evaluator<'a> {
    task: &'a Task,
    mechanism: Mechanism,
    motions: PerLink<Motion>,
    /// Poses of the links, copied from `motions`. The transmission angles of dyads with prismatic joints are computed
    /// from them.
    pose: Pose,
    /// Output at the crank angles of the last run. An output angle has no jumps by a full turn.
    pub(super) curve: Vec<f64>,
    /// Smallest sine of the transmission angle of any dyad so far.
    pub(super) sine: f64,
    /// Largest acceleration of the working point so far (m/s^2), at the crank speed of `task.case`; 0 if the task does
    /// not limit the acceleration.
    pub(super) acceleration: f64,
    /// Number of poses that all runs so far have solved.
    pub(super) poses: u64,
    /// Motions of all links at the crank angles of the last run; empty if the motions are not recorded.
    pub(super) recorded: Vec<PerLink<Motion>>,
    records: bool,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(task: &'a Task) -> Self {
        let state = State::at_start(&task.case);
        Evaluator {
            task,
            mechanism: task.case.mechanism.clone(),
            motions: state.motions,
            pose: task.case.start.clone(),
            curve: Vec::new(),
            sine: 1.0,
            acceleration: 0.0,
            poses: 0,
            recorded: Vec::new(),
            records: !task.points.is_empty(),
        }
    }

    /// An evaluator that records the motions of all links, even for a task without precision points.
    pub(super) fn recording(task: &'a Task) -> Self {
        Evaluator { records: true, ..Evaluator::new(task) }
    }

    /// Sets the dimensions.
    fn dimension(&mut self, values: &[f64]) {
        for place in &self.task.places {
            place.apply(values, &mut self.mechanism);
        }
    }

    /// Computes the output at the crank angles `turns` into `curve`.
    /// These crank angles (rad) are measured from crank angle zero in the sense of rotation.
    /// The crank angles ascend over one turn: the last angle is one turn after the first.
    /// At crank angle zero, the crank has the world direction `zero` (rad).
    ///
    /// # Errors
    /// The fraction of poses that are reached, if the mechanism cannot be assembled over the whole turn or if the
    /// output turns fully.
    pub(super) fn run(&mut self, values: &[f64], zero: f64, turns: &[f64]) -> Result<(), f64> {
        self.dimension(values);
        let case = &self.task.case;
        let plan = SolutionPlan::of(&self.mechanism, &case.structure, &case.modes);
        self.curve.clear();
        self.curve.resize(turns.len(), 0.0);
        self.recorded.clear();
        (self.sine, self.acceleration) = (1.0, 0.0);
        let sense = self.task.turning();
        let world = |turn: f64| zero + sense * turn;
        if plan.is_closed_form() {
            self.probe_and_place(plan, &world, turns)?
        } else {
            self.follow(plan, &world, turns, zero)?
        }
        self.unwind()
    }

    /// Computes the output of a mechanism of dyads only. The poses of such a mechanism at different crank angles do not
    /// depend on each other.
    fn probe_and_place(
        &mut self,
        mut plan: SolutionPlan,
        world: &dyn Fn(f64) -> f64,
        turns: &[f64],
    ) -> Result<(), f64> {
        let last = turns.len() - 1;
        for probe in 0..PROBES {
            // Opposite poses are tried first: 0, 4, 2, 6, 1, 5, 3, 7 eighths of the turn.
            let at = probe.reverse_bits() >> (usize::BITS - 3);
            self.poses += 1;
            if plan.positions(&[world(turns[at * last / PROBES])], &mut self.motions).is_err() {
                return Err(probe as f64 / (2 * PROBES) as f64);
            }
        }
        for (row, &turn) in turns.iter().enumerate() {
            self.poses += 1;
            if plan.positions(&[world(turn)], &mut self.motions).is_err() {
                return Err(0.5 + 0.5 * row as f64 / turns.len() as f64);
            }
            self.keep(row);
            self.watch(&plan);
            self.accelerate(&mut plan);
        }
        Ok(())
    }

    /// Computes the output of a mechanism with higher groups, in small steps from the start pose.
    /// After the turn, the output must have the same value as at the start.
    fn follow(
        &mut self,
        mut plan: SolutionPlan,
        world: &dyn Fn(f64) -> f64,
        turns: &[f64],
        zero: f64,
    ) -> Result<(), f64> {
        let case = &self.task.case;
        let start = zero + case.crank().start;
        let (pose, _) = first_pose(&self.mechanism, &case.structure, &[start], &self.task.starts).map_err(|_| 0.0)?;
        for (motion, link) in self.motions.iter_mut().zip(&pose.0) {
            (motion.origin, motion.direction) = (link.origin, unit(link.angle));
        }
        let mut angle = start;
        self.poses += 1;
        plan.positions(&[angle], &mut self.motions).map_err(|_| 0.0)?;
        for (row, &turn) in turns.iter().enumerate() {
            let (from, way) = (angle, world(turn) - angle);
            let steps = (way.abs() / FOLLOWED).ceil().larger(1.0);
            for step in 1..=steps as usize {
                angle = from + way * (step as f64 / steps);
                self.poses += 1;
                plan.positions(&[angle], &mut self.motions).map_err(|_| row as f64 / turns.len() as f64)?;
            }
            self.keep(row);
            self.accelerate(&mut plan);
        }
        Ok(())
    }

    /// Stores the output of a pose, and its motions if they are recorded.
    #[inline]
    fn keep(&mut self, row: usize) {
        self.curve[row] = self.output();
        if self.records {
            self.recorded.push(self.motions.clone());
        }
    }

    /// Position and angle of the output link in a recorded row: world position of its working point (m; the origin if
    /// it has none), and angle (rad).
    pub(super) fn position(&self, row: usize) -> (Vec2, f64) {
        let (link, point) = self.task.output.working_point();
        let motion = &self.recorded[row][link];
        let place = point.map(|point| motion.point(self.mechanism.links()[link].points[point].local));
        (place.unwrap_or_default(), motion.direction.y.atan2(motion.direction.x))
    }

    /// Updates the largest acceleration of the working point, if the task limits the acceleration.
    #[inline]
    fn accelerate(&mut self, plan: &mut SolutionPlan) {
        let (link, Some(point)) = self.task.output.working_point() else { return };
        if self.task.acceleration.is_finite() {
            let speed = [self.task.case.crank().top_speed()];
            plan.velocities(&speed, &mut self.motions);
            plan.accelerations([&speed, &[0.0]], &mut self.motions);
            let local = self.mechanism.links()[link].points[point].local;
            self.acceleration = self.acceleration.larger(self.motions[link].point_acceleration(local).norm());
        }
    }

    #[inline]
    fn output(&self) -> f64 {
        match self.task.output {
            OutputQuantity::Angle { link, .. } => {
                let direction = self.motions[link].direction;
                direction.y.atan2(direction.x)
            }
            OutputQuantity::Coordinate { link, point, along } => {
                self.motions[link].point(self.mechanism.links()[link].points[point].local).dot(&along)
            }
        }
    }

    /// Updates the smallest transmission sine.
    #[inline]
    fn watch(&mut self, plan: &SolutionPlan) {
        let mut placed = false;
        for (group, step) in self.task.case.structure.groups.iter().zip(plan.steps()) {
            let sine = if let Step::Rrr(dyad) = step {
                let ([r1, r2], _) = dyad.spans();
                (cross(r1, r2).powi(2) / (r1.norm_squared() * r2.norm_squared())).sqrt()
            } else {
                if !placed {
                    for (link, motion) in self.pose.0.iter_mut().zip(&self.motions) {
                        *link = LinkPose::of(motion);
                    }
                    placed = true;
                }
                transmission_sine(&self.mechanism, group, &self.pose).map_or(1.0, f64::abs)
            };
            self.sine = self.sine.smaller(sine);
        }
    }

    /// If the output is an angle, removes its jumps of a full turn.
    /// Returns an error if the task has phases, and the output is not periodic over the turn.
    fn unwind(&mut self) -> Result<(), f64> {
        if let OutputQuantity::Angle { .. } = self.task.output {
            for row in 1..self.curve.len() {
                let way = self.curve[row] - self.curve[row - 1];
                self.curve[row] -= TAU * (way / TAU).round();
            }
        }
        let [first, last] = [self.curve[0], self.curve[self.curve.len() - 1]];
        let has_phases = !self.task.timing.phases().is_empty();
        if !has_phases || (last - first).abs() <= 1e-6 * (1.0 + first.abs()) { Ok(()) } else { Err(0.99) }
    }
}
