//! The last few steps of a run, and the motion between them.

use super::ring::{Place, Ring};
use super::world::World;
use crate::case::Case;
use crate::math::interpolate::POINTS;
use crate::math::{Motion, Vec2, rotated, turned, unit};
use crate::mechanism::{LinkPose, Side};
use crate::solver::State;

/// Numbers a link and step: position of the mass centre and angle, and their rates.
const WIDTH: usize = 6;

/// The motion of the last steps, filled as the run goes on.
#[derive(Debug)]
pub(super) struct Window {
    step: f64,
    /// Whether the engine's velocities are those at the start of a step: so they are where drives turn with constant speeds.
    steady: bool,
    ring: Ring,
    /// Velocity and angular velocity of every link while they are carried along the tree.
    rates: Vec<(Vec2, f64)>,
}

impl Window {
    /// Steps that must lie before the one at or before an instant.
    pub(super) const BEHIND: i64 = 3;
    /// Steps that must lie after it.
    pub(super) const AHEAD: i64 = 4;

    /// An empty window of a run whose first state, pushed next, is that of step `start`.
    pub(super) fn new(case: &Case, step: f64, start: i64) -> Self {
        let links = case.mechanism.links().len();
        Window {
            step,
            steady: case.is_steady(),
            ring: Ring::new(links * WIDTH, start),
            rates: vec![(Vec2::zeros(), 0.0); links],
        }
    }

    /// Number of the newest step.
    pub(super) fn newest(&self) -> i64 {
        self.ring.newest()
    }

    fn place(&self, t: f64) -> Place {
        Place::of(t / self.step)
    }

    /// Whether the window reaches far enough for a sample at `t`.
    pub(super) fn covers(&self, t: f64) -> bool {
        self.newest() >= self.place(t).before + Self::AHEAD
    }

    /// Takes the state after a step. Poses belong to this step, the engine's velocities to the one before.
    pub(super) fn push(&mut self, world: &dyn World, case: &Case) {
        let row = self.ring.push();
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let centre = world.point(Side { link, local: body.mass_centre });
            row[link * WIDTH..link * WIDTH + 3].copy_from_slice(&[centre.x, centre.y, world.angle(link)]);
        }
        self.carry_rates(world, case);
    }

    /// Carries the joints' speeds from the ground along the tree, over the poses of the step they belong to.
    fn carry_rates(&mut self, world: &dyn World, case: &Case) {
        let before = self.ring.row_mut(self.ring.newest() - 1);
        self.rates[0] = (Vec2::zeros(), 0.0);
        for (index, branch) in world.tree().branches.iter().enumerate() {
            let joint = &case.mechanism.joints()[branch.joint];
            let along = |link: usize, local: Vec2| {
                if link == 0 { local } else { rotated(unit(before[link * WIDTH + 2]), local) }
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
                        _ => Vec2::new(before[link * WIDTH], before[link * WIDTH + 1]),
                    };
                    let reach = centre(branch.link) - centre(branch.parent);
                    (velocity + turned(reach) * omega + along(branch.parent, axis) * speed, omega)
                }
            };
        }
        for link in 1..self.rates.len() {
            if let Some(own) = world.velocity(link) {
                self.rates[link] = own;
            }
            let (velocity, omega) = self.rates[link];
            before[link * WIDTH + 3..][..3].copy_from_slice(&[velocity.x, velocity.y, omega]);
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
        let (mut first, mut second) = ([0.0; POINTS + 2], [0.0; POINTS + 2]);
        for (k, weight) in weights.iter().enumerate() {
            first[k] -= 0.5 * weight;
            first[k + 2] += 0.5 * weight;
            second[k] += weight;
            second[k + 1] -= 2.0 * weight;
            second[k + 2] += weight;
        }
        let scale = 1.0 / (self.step * self.step);
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let (mut value, mut rate, mut acceleration) = ([0.0; 3], [0.0; 3], [0.0; 3]);
            for (k, second) in second.iter().enumerate().filter(|(_, second)| **second != 0.0) {
                let row = &self.ring.row(place.before - Self::BEHIND + k as i64)[link * WIDTH..];
                let inner = if (1..=POINTS).contains(&k) { weights[k - 1] } else { 0.0 };
                for c in 0..3 {
                    acceleration[c] += second * row[c];
                    if inner != 0.0 {
                        value[c] += inner * row[c];
                        rate[c] += inner * row[3 + c];
                    }
                }
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
