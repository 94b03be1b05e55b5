//! The last steps of a run, and the motion between them.

use super::guard::Guard;
use super::ring::{Place, Ring};
use super::world::World;
use linkage::case::Case;
use linkage::engine::Settings;
use linkage::math::interpolate::{POINTS, lagrange_weights};
use linkage::math::{Motion, Vec2, rotated, turned, unit};
use linkage::mechanism::{LinkId, LinkPose};
use linkage::solver::State;
use linkage::trajectory::Stage;

/// Number of values per link: position of the mass centre and angle, or the rates of these quantities.
/// A row has the positions and angles of all links, then the rates of all links.
const WIDTH: usize = 3;

/// Number of steps at the beginning of a free motion in which the engine's accelerations differ from the true
/// accelerations.
/// The causes are:
/// - Separate bodies (`plain`) close the gaps of the first step in the second step.
/// - In a multibody with loops, the first sweeps start without impulses. Later sweeps start from the impulses of the
///   last step.
/// - For links with an initial speed, the artificial step before the first step is only a motion along a straight line.
/// - The first step ignores the change of the transfer functions.
pub(super) fn first_steps(case: &Case, plain: bool) -> i64 {
    let moving = case.drives.iter().any(|drive| drive.initial_speed() != 0.0);
    let closed = case.mechanism.joints().len() + case.mechanism.transmissions().len();
    let has_loops = closed >= case.mechanism.links().len();
    if plain || moving || has_loops { 2 } else { 0 }
}

/// The motion over the last steps, filled as the run proceeds.
#[derive(Debug)]
pub(super) struct Window {
    step: f64,
    substeps: usize,
    /// Whether all drives turn with constant speeds. The engine's velocities then belong to the start of a step.
    steady: bool,
    /// The deepest requested stage; later stages are not computed.
    deepest: Stage,
    /// Whether the engine's velocities are read.
    rated: bool,
    ring: Ring,
    /// Velocity and angular velocity of every link, as workspace for their propagation along the tree.
    rates: Vec<(Vec2, f64)>,
    /// Earliest steps that may be the centre of an interpolation: `lowest` for positions, `settled` for second
    /// differences.
    /// The interpolation uses steps up to two (positions) or three (second differences) before its centre.
    lowest: i64,
    settled: i64,
    /// Mass centre and angle of every link at the instant to which the engine's velocities belong, and the directions
    /// of the tree's links at this instant.
    poses: Vec<[f64; WIDTH]>,
    directions: Vec<Vec2>,
    /// Positions, rates and accelerations of a sample, one row for each link.
    sample: [Vec<[f64; WIDTH]>; 3],
}

impl Window {
    /// A sample at an instant needs this number of steps before the last step that is not later than the instant.
    pub(super) const BEHIND: i64 = 3;
    /// A sample at an instant needs this number of steps after the last step that is not later than the instant.
    pub(super) const AHEAD: i64 = 4;

    /// An empty window of a run. The first state that is pushed belongs to step `start`.
    pub(super) fn new(case: &Case, settings: &Settings, start: i64) -> Self {
        let links = case.mechanism.links().len();
        let (steady, deepest) = (case.is_steady(), case.wanted.deepest());
        let row = || vec![[0.0; WIDTH]; links];
        Window {
            step: settings.resolution,
            substeps: settings.substeps,
            steady,
            deepest,
            rated: steady && deepest >= Stage::Velocities,
            ring: Ring::new(2 * links * WIDTH, start),
            rates: vec![(Vec2::zeros(), 0.0); links],
            lowest: i64::MIN / 2,
            settled: i64::MIN / 2,
            poses: row(),
            directions: vec![Vec2::new(1.0, 0.0); links],
            sample: [row(), row(), row()],
        }
    }

    /// A window of a free motion. The window begins at step 0 with the pose and the velocities of a world.
    /// An artificial step before step 0 leads to this pose without acceleration.
    pub(super) fn beginning(case: &Case, settings: &Settings, guard: &Guard) -> Self {
        // A free motion has no steps before its start, so step 2 is the earliest centre of an interpolation.
        // To first order, it does not matter to which instant of the step the velocities belong. The window therefore
        // has one substep.
        let mut window = Window::new(case, &Settings { substeps: 1, ..*settings }, -1);
        (window.lowest, window.settled) = (2, 2 + first_steps(case, guard.world().tree().branches.is_empty()));
        window.rated = true;
        // `push` stores the velocities at the step before the pushed pose, so the same state is pushed twice.
        window.push(guard, case);
        window.push(guard, case);
        window.rated = false;
        let (positions, rates) = window.ring.row_mut(-1).split_at_mut(window.poses.len() * WIDTH);
        for (position, rate) in positions.iter_mut().zip(rates).skip(WIDTH) {
            *position -= settings.resolution * *rate;
        }
        window
    }

    /// Number of additional steps before the start. With several substeps, the velocities of every step belong to an
    /// instant between two steps; the poses at this instant are interpolated from earlier steps.
    pub(super) fn extra(substeps: usize) -> i64 {
        if substeps > 1 { POINTS as i64 - 2 } else { 0 }
    }

    /// Number of the newest step.
    pub(super) fn newest(&self) -> i64 {
        self.ring.newest()
    }

    fn place(&self, t: f64) -> Place {
        Place::of(t / self.step).from(self.lowest)
    }

    /// The first and the last step that a sample at `t` needs.
    pub(super) fn needs(&self, t: f64) -> [i64; 2] {
        let before = self.place(t).from(self.settled).before;
        [before - Self::BEHIND - Self::extra(self.substeps), before + Self::AHEAD]
    }

    /// Stores the state after a step. The stored poses belong to the end of this step. The stored velocities belong to
    /// the start of the step's last substep. Without substeps, this instant is the end of the previous step.
    pub(super) fn push(&mut self, guard: &Guard, case: &Case) {
        let (row, _) = self.ring.push().as_chunks_mut();
        for (own, (centre, frame)) in row.iter_mut().zip(guard.centres().iter().zip(guard.frames())).skip(1) {
            *own = [centre.x, centre.y, frame.angle()];
        }
        if self.rated {
            self.carry_rates(guard.world(), case);
        }
    }

    /// Skips a step that no sample needs.
    pub(super) fn skip(&mut self) {
        self.ring.skip();
    }

    /// Computes the poses of all links at the instant of the engine's velocities.
    fn place_rates(&mut self) {
        let (newest, part) = (self.ring.newest(), 0..self.poses.len() * WIDTH);
        let poses = self.poses.as_flattened_mut();
        if self.substeps == 1 {
            poses.copy_from_slice(&self.ring.row(newest - 1)[part]);
            return;
        }
        let weights = lagrange_weights((POINTS - 1) as f64 - 1.0 / self.substeps as f64);
        self.ring.weigh(newest + 1 - POINTS as i64, &weights, part, poses);
    }

    /// Propagates the joints' speeds from the ground along the tree, with the poses at the instant of these speeds.
    fn carry_rates(&mut self, world: &dyn World, case: &Case) {
        let branches = &world.tree().branches;
        if !branches.is_empty() {
            self.place_rates();
        }
        let (links, joints) = (case.mechanism.links(), case.mechanism.joints());
        for (index, branch) in branches.iter().enumerate() {
            let joint = &joints[branch.joint];
            self.directions[branch.link] = unit(self.poses[branch.link][2]);
            let along = |link: LinkId, local: Vec2| rotated(self.directions[link], local);
            let (velocity, omega) = self.rates[branch.parent];
            let speed = world.relative_speed(index);
            self.rates[branch.link] = match joint.axis_on(branch.parent) {
                None => {
                    let arm = |link: LinkId| {
                        let local = joint.on(link).expect("the joint is on the link");
                        along(link, local - links[link].mass_centre)
                    };
                    let spin = omega + speed;
                    (velocity + turned(arm(branch.parent)) * omega - turned(arm(branch.link)) * spin, spin)
                }
                Some(axis) => {
                    let centre = |link: LinkId| match link {
                        LinkId(0) => Vec2::zeros(),
                        _ => pair(&self.poses[link]),
                    };
                    let reach = centre(branch.link) - centre(branch.parent);
                    (velocity + turned(reach) * omega + along(branch.parent, axis) * speed, omega)
                }
            };
        }
        let before = self.ring.row_mut(self.ring.newest() - 1)[self.poses.len() * WIDTH..].as_chunks_mut().0;
        for (link, (own, carried)) in before.iter_mut().zip(&self.rates).enumerate().skip(1) {
            let (velocity, omega) = world.velocity(LinkId(link)).unwrap_or(*carried);
            *own = [velocity.x, velocity.y, omega];
        }
    }

    /// The newest pose, with the mean velocities of the last step: differences of positions.
    pub(super) fn newest_motion(&self, case: &Case, state: &mut State) {
        let (now, before) = (self.ring.row(self.newest()), self.ring.row(self.newest() - 1));
        for (link, body) in case.mechanism.links().entries().skip(1) {
            let at = |c: usize| now[link.index() * WIDTH + c];
            let rate = |c: usize| (at(c) - before[link.index() * WIDTH + c]) / self.step;
            state.angles[link] = at(2);
            state.motions[link] = Motion::of_point(
                body.mass_centre,
                [Vec2::new(at(0), at(1)), Vec2::new(rate(0), rate(1)), Vec2::zeros()],
                unit(at(2)),
                rate(2),
                0.0,
            );
        }
    }

    /// Acceleration of a link's mass centre and its angular acceleration (x, y, angle) in the newest step: second
    /// differences of positions.
    pub(super) fn newest_acceleration(&self, link: LinkId) -> [f64; WIDTH] {
        let [now, before, earlier] =
            [0, 1, 2].map(|back| &self.ring.row(self.newest() - back)[link.index() * WIDTH..][..WIDTH]);
        [0, 1, 2].map(|c| (now[c] - 2.0 * before[c] + earlier[c]) / (self.step * self.step))
    }

    /// Acceleration of a link's mass centre and its angular acceleration (x, y, angle).
    /// The acceleration is computed for the step from the newest pose to the pose that `guard` has reached.
    pub(super) fn next_acceleration(&self, guard: &Guard, link: LinkId) -> [f64; WIDTH] {
        let [now, before] = [0, 1].map(|back| &self.ring.row(self.newest() - back)[link.index() * WIDTH..][..WIDTH]);
        let centre = guard.centres()[link];
        let next = [centre.x, centre.y, guard.frames()[link].angle()];
        [0, 1, 2].map(|c| (next[c] - 2.0 * now[c] + before[c]) / (self.step * self.step))
    }

    /// Poses of all links `back` seconds before `t`.
    pub(super) fn poses(&self, case: &Case, t: f64, back: f64, into: &mut Vec<LinkPose>) {
        let place = self.place(t);
        let weights = place.weights(back / self.step);
        into.clear();
        into.push(LinkPose::GROUND);
        for (link, body) in case.mechanism.links().entries().skip(1) {
            let mut sum = [0.0; WIDTH];
            for (k, weight) in weights.iter().enumerate() {
                let row = &self.ring.row(place.first() + k as i64)[link.index() * WIDTH..];
                (0..3).for_each(|c| sum[c] += weight * row[c]);
            }
            into.push(LinkPose::through(body.mass_centre, Vec2::new(sum[0], sum[1]), sum[2]));
        }
    }

    /// The motion of all links at `t` (s), up to the requested stage.
    /// Positions and rates are interpolated between steps.
    /// Accelerations are centred second differences of the positions.
    /// If drive speeds change, rates are centred first differences of the positions.
    /// The reason is that the engine's velocities then combine the pose at the step's start with the step's mean speed.
    pub(super) fn sample(&mut self, case: &Case, t: f64, state: &mut State) {
        let place = self.place(t);
        let weights = place.weights(0.0);
        let [positions, rates, accelerations] = self.sample.each_mut().map(|row| row.as_flattened_mut());
        let part = 0..positions.len();
        self.ring.weigh(place.first(), &weights, part.clone(), positions);
        if self.deepest >= Stage::Velocities && self.steady {
            // With several substeps, the velocities of a row belong to an instant later than the row's step. The
            // interpolation includes this delay.
            let late = 1.0 - 1.0 / self.substeps as f64;
            let weights = if self.substeps == 1 { weights } else { place.weights(late) };
            self.ring.weigh(place.first(), &weights, part.end..2 * part.end, rates);
        } else if self.deepest >= Stage::Velocities {
            let mut first = [0.0; POINTS + 2];
            for (k, weight) in weights.iter().enumerate() {
                first[k] -= 0.5 * weight;
                first[k + 2] += 0.5 * weight;
            }
            self.ring.weigh(place.before - Self::BEHIND, &first.map(|first| first / self.step), part.clone(), rates);
        }
        if self.deepest >= Stage::Accelerations {
            // The first steps of a free motion close gaps, so the interpolation of second differences leaves the first
            // steps out.
            let settled = place.from(self.settled);
            let weights = if settled.before == place.before { weights } else { settled.weights(0.0) };
            let mut second = [0.0; POINTS + 2];
            for (k, weight) in weights.iter().enumerate() {
                second[k] += weight;
                second[k + 1] -= 2.0 * weight;
                second[k + 2] += weight;
            }
            self.ring.weigh(settled.before - Self::BEHIND, &second, part, accelerations);
        }
        let scale = 1.0 / (self.step * self.step);
        let [positions, rates, accelerations] = &self.sample;
        let rows = positions.iter().zip(rates).zip(accelerations);
        let states = state.angles.iter_mut().zip(&mut state.motions);
        let all = case.mechanism.links().iter().zip(rows).zip(states).skip(1);
        for ((body, ((position, rate), acceleration)), (angle, motion)) in all {
            *angle = position[2];
            *motion = Motion::of_point(
                body.mass_centre,
                [pair(position), pair(rate), pair(acceleration) * scale],
                unit(position[2]),
                rate[2],
                acceleration[2] * scale,
            );
        }
    }
}

/// The first two numbers as a vector.
fn pair(of: &[f64; WIDTH]) -> Vec2 {
    Vec2::new(of[0], of[1])
}
