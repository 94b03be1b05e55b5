//! The last few steps of a run, and the motion between them.

use super::ring::{Place, Ring};
use super::world::World;
use crate::case::Case;
use crate::engine::Settings;
use crate::math::interpolate::{POINTS, lagrange_weights};
use crate::math::{Motion, Vec2, rotated, turned, unit};
use crate::mechanism::{LinkPose, Side};
use crate::solver::State;

/// Numbers a link and step: position of the mass centre and angle, and their rates.
const WIDTH: usize = 6;

/// Steps at the beginning of a free motion whose accelerations are not the motion's. Bodies of their own (`plain`) close the gaps of the first step in the
/// second. In a multibody nothing is seen of that; but links that move at once have no step before the first, only a straight line that leads there, and the
/// first step takes no account of how transfer functions change.
pub(super) fn first_steps(case: &Case, plain: bool) -> i64 {
    let moving = case.drives().any(|drive| drive.initial_speed() != 0.0);
    if plain || moving { 2 } else { 0 }
}

/// The motion of the last steps, filled as the run goes on.
#[derive(Debug)]
pub(super) struct Window {
    step: f64,
    substeps: usize,
    /// Whether the engine's velocities are those at the start of a step: so they are where drives turn with constant speeds.
    steady: bool,
    ring: Ring,
    /// Velocity and angular velocity of every link while they are carried along the tree.
    rates: Vec<(Vec2, f64)>,
    /// Steps before which interpolation between positions and between their second differences may not be centred: it reaches two and three steps
    /// farther back.
    lowest: i64,
    settled: i64,
    /// Mass centre and angle of every link at the instant that the velocities belong to.
    poses: Vec<[f64; 3]>,
}

impl Window {
    /// Steps that must lie before the one at or before an instant.
    pub(super) const BEHIND: i64 = 3;
    /// Steps that must lie after it.
    pub(super) const AHEAD: i64 = 4;

    /// An empty window of a run whose first state, pushed next, is that of step `start`.
    pub(super) fn new(case: &Case, settings: &Settings, start: i64) -> Self {
        let links = case.mechanism.links().len();
        Window {
            step: settings.resolution,
            substeps: settings.substeps,
            steady: case.is_steady(),
            ring: Ring::new(links * WIDTH, start),
            rates: vec![(Vec2::zeros(), 0.0); links],
            lowest: i64::MIN / 2,
            settled: i64::MIN / 2,
            poses: vec![[0.0; 3]; links],
        }
    }

    /// A window of a free motion, which begins at step 0 with the pose and the velocities of `world`. Before it lies one step that leads there
    /// without acceleration.
    pub(super) fn beginning(case: &Case, settings: &Settings, world: &dyn World) -> Self {
        // There is nothing to interpolate before the beginning; of first order the velocities are wherever in the step they belong.
        let mut window = Window::new(case, &Settings { substeps: 1, ..*settings }, -1);
        (window.lowest, window.settled) = (2, 2 + first_steps(case, world.tree().branches.is_empty()));
        // The velocities of a push belong to the step before.
        window.push(world, case);
        window.push(world, case);
        let row = window.ring.row_mut(-1);
        for link in row.chunks_mut(WIDTH).skip(1) {
            (0..3).for_each(|c| link[c] -= settings.resolution * link[3 + c]);
        }
        window
    }

    /// Steps that the start must lie farther back: with several substeps, poses between steps are needed for every step.
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

    /// Whether the window reaches far enough for a sample at `t`.
    pub(super) fn covers(&self, t: f64) -> bool {
        self.newest() >= self.place(t).from(self.settled).before + Self::AHEAD
    }

    /// Takes the state after a step. Poses belong to this step, the engine's velocities to the start of its last substep: without substeps
    /// to the step before.
    pub(super) fn push(&mut self, world: &dyn World, case: &Case) {
        let row = self.ring.push();
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let centre = world.point(Side { link, local: body.mass_centre });
            row[link * WIDTH..link * WIDTH + 3].copy_from_slice(&[centre.x, centre.y, world.angle(link)]);
        }
        self.carry_rates(world, case);
    }

    /// Where all links were at the instant that the engine's velocities belong to.
    fn place_rates(&mut self) {
        let newest = self.ring.newest();
        if self.substeps == 1 {
            let row = self.ring.row(newest - 1);
            for (pose, own) in self.poses.iter_mut().zip(row.chunks_exact(WIDTH)) {
                pose.copy_from_slice(&own[..3]);
            }
            return;
        }
        let first = newest + 1 - POINTS as i64;
        let weights = lagrange_weights((POINTS - 1) as f64 - 1.0 / self.substeps as f64);
        self.poses.fill([0.0; 3]);
        for (k, weight) in weights.iter().enumerate() {
            for (pose, own) in self.poses.iter_mut().zip(self.ring.row(first + k as i64).chunks_exact(WIDTH)) {
                (0..3).for_each(|c| pose[c] += weight * own[c]);
            }
        }
    }

    /// Carries the joints' speeds from the ground along the tree, over the poses of the instant they belong to.
    fn carry_rates(&mut self, world: &dyn World, case: &Case) {
        self.place_rates();
        let poses = &self.poses;
        self.rates[0] = (Vec2::zeros(), 0.0);
        for (index, branch) in world.tree().branches.iter().enumerate() {
            let joint = &case.mechanism.joints()[branch.joint];
            let along = |link: usize, local: Vec2| {
                if link == 0 { local } else { rotated(unit(poses[link][2]), local) }
            };
            let (velocity, omega) = self.rates[branch.parent];
            let speed = world.relative_speed(index);
            self.rates[branch.link] = match joint.axis_on(branch.parent) {
                None => {
                    let arm = |link: usize| {
                        let local = joint.on(link).expect("the joint is on the link");
                        along(link, local - case.mechanism.links()[link].mass_centre)
                    };
                    let spin = omega + speed;
                    (velocity + turned(arm(branch.parent)) * omega - turned(arm(branch.link)) * spin, spin)
                }
                Some(axis) => {
                    let centre = |link: usize| match link {
                        0 => Vec2::zeros(),
                        _ => Vec2::new(poses[link][0], poses[link][1]),
                    };
                    let reach = centre(branch.link) - centre(branch.parent);
                    (velocity + turned(reach) * omega + along(branch.parent, axis) * speed, omega)
                }
            };
        }
        let before = self.ring.row_mut(self.ring.newest() - 1);
        for link in 1..self.rates.len() {
            if let Some(own) = world.velocity(link) {
                self.rates[link] = own;
            }
            let (velocity, omega) = self.rates[link];
            before[link * WIDTH + 3..][..3].copy_from_slice(&[velocity.x, velocity.y, omega]);
        }
    }

    /// The newest pose, with the velocities that led there: differences of positions over a step.
    pub(super) fn newest_motion(&self, case: &Case, state: &mut State) {
        let (now, before) = (self.ring.row(self.newest()), self.ring.row(self.newest() - 1));
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let at = |c: usize| now[link * WIDTH + c];
            let rate = |c: usize| (at(c) - before[link * WIDTH + c]) / self.step;
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

    /// Poses of all links `back` seconds before `t`.
    pub(super) fn poses(&self, case: &Case, t: f64, back: f64, into: &mut Vec<LinkPose>) {
        let place = self.place(t);
        let weights = place.weights(back / self.step);
        into.clear();
        into.push(LinkPose::GROUND);
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let mut sum = [0.0; 3];
            for (k, weight) in weights.iter().enumerate() {
                let row = &self.ring.row(place.before - 2 + k as i64)[link * WIDTH..];
                (0..3).for_each(|c| sum[c] += weight * row[c]);
            }
            into.push(LinkPose::through(body.mass_centre, Vec2::new(sum[0], sum[1]), sum[2]));
        }
    }

    /// The motion of all links at `t`: positions and rates interpolated between steps, accelerations from centred second
    /// differences of the positions. With drives whose speed changes, rates are centred first differences of the positions: the engine drives
    /// through a step with the step's mean speed, but from the pose at its start.
    pub(super) fn sample(&self, case: &Case, t: f64, state: &mut State) {
        let place = self.place(t);
        let weights = place.weights(0.0);
        // The velocities of a row belong to an instant after its step, but for that without substeps.
        let rates = if self.substeps == 1 { weights } else { place.weights(1.0 - 1.0 / self.substeps as f64) };
        // What the first steps of a free motion do to close gaps is left out of the second differences.
        let settled = place.from(self.settled);
        let (mut first, mut second) = ([0.0; POINTS + 2], [0.0; POINTS + 2]);
        for (k, weight) in weights.iter().enumerate() {
            first[k] -= 0.5 * weight;
            first[k + 2] += 0.5 * weight;
        }
        for (k, weight) in settled.weights(0.0).iter().enumerate() {
            second[k] += weight;
            second[k + 1] -= 2.0 * weight;
            second[k + 2] += weight;
        }
        let scale = 1.0 / (self.step * self.step);
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let (mut value, mut rate, mut acceleration) = ([0.0; 3], [0.0; 3], [0.0; 3]);
            for (k, second) in second.iter().enumerate().filter(|(_, second)| **second != 0.0) {
                let row = &self.ring.row(settled.before - Self::BEHIND + k as i64)[link * WIDTH..];
                (0..3).for_each(|c| acceleration[c] += second * row[c]);
            }
            for (k, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                let row = &self.ring.row(place.before - Self::BEHIND + 1 + k as i64)[link * WIDTH..];
                (0..3).for_each(|c| value[c] += weight * row[c]);
            }
            for (k, weight) in rates.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                let row = &self.ring.row(place.before - Self::BEHIND + 1 + k as i64)[link * WIDTH..];
                (0..3).for_each(|c| rate[c] += weight * row[3 + c]);
            }
            let pair = |of: [f64; 3]| Vec2::new(of[0], of[1]);
            if !self.steady {
                rate = [0.0; 3];
                for (k, first) in first.iter().enumerate().filter(|(_, first)| **first != 0.0) {
                    let row = &self.ring.row(place.before - Self::BEHIND + k as i64)[link * WIDTH..];
                    (0..3).for_each(|c| rate[c] += first / self.step * row[c]);
                }
            }
            let acceleration = acceleration.map(|sum| sum * scale);
            state.angles[link] = value[2];
            state.motions[link] = Motion::of_point(
                body.mass_centre,
                [pair(value), pair(rate), pair(acceleration)],
                unit(value[2]),
                rate[2],
                acceleration[2],
            );
        }
    }
}
