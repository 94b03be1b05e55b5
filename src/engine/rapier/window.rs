//! The last few steps of a run, and the motion between them.

use super::twin::Twin;
use crate::case::Case;
use crate::math::interpolate::{POINTS, lagrange_weights};
use crate::math::{Motion, Vec2, rotated, turned, unit};
use crate::mechanism::Side;
use crate::solver::State;

/// Steps in the window: six for the interpolation, and one more on either side for second differences.
const NODES: usize = POINTS + 2;
/// Numbers a link and step: position of the mass centre and angle, and their rates.
const WIDTH: usize = 6;

/// Ring of the last steps, filled as the run goes on.
#[derive(Debug)]
pub(super) struct Window {
    step: f64,
    newest: i64,
    links: usize,
    nodes: Vec<f64>,
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
            newest: start - 1,
            links,
            nodes: vec![f64::NAN; NODES * 2 * links * WIDTH],
            rates: vec![(Vec2::zeros(), 0.0); links],
        }
    }

    /// Number of the newest step.
    pub(super) fn newest(&self) -> i64 {
        self.newest
    }

    /// Whether the window reaches far enough for a sample at `t`.
    pub(super) fn covers(&self, t: f64) -> bool {
        self.newest >= self.node_before(t) + Self::AHEAD
    }

    /// The step at or before `t`. Instants within 1e-9 of a step are that step: grids and steps are computed differently.
    fn node_before(&self, t: f64) -> i64 {
        (t / self.step + 1e-9).floor() as i64
    }

    fn slot(&self, node: i64, link: usize) -> usize {
        let ring = node.rem_euclid(2 * NODES as i64) as usize;
        (ring * self.links + link) * WIDTH
    }

    /// Takes the state after a step. Poses belong to this step, the engine's velocities to the one before.
    pub(super) fn push(&mut self, twin: &Twin, case: &Case) {
        self.newest += 1;
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let centre = twin.point(Side { link, local: body.mass_centre });
            let slot = self.slot(self.newest, link);
            self.nodes[slot..slot + 3].copy_from_slice(&[centre.x, centre.y, twin.angle(link)]);
        }
        self.carry_rates(twin, case);
    }

    /// Carries the joints' speeds from the ground along the tree, over the poses of the step they belong to.
    fn carry_rates(&mut self, twin: &Twin, case: &Case) {
        let before = self.newest - 1;
        self.rates[0] = (Vec2::zeros(), 0.0);
        for (index, branch) in twin.tree().branches.iter().enumerate() {
            let joint = &case.mechanism.joints()[branch.joint];
            let along = |link: usize, local: Vec2| {
                if link == 0 { local } else { rotated(unit(self.nodes[self.slot(before, link) + 2]), local) }
            };
            let (velocity, omega) = self.rates[branch.parent];
            let speed = twin.relative_speed(index);
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
                    let centre = |link: usize| {
                        let slot = self.slot(before, link);
                        if link == 0 { Vec2::zeros() } else { Vec2::new(self.nodes[slot], self.nodes[slot + 1]) }
                    };
                    let reach = centre(branch.link) - centre(branch.parent);
                    (velocity + turned(reach) * omega + along(branch.parent, axis) * speed, omega)
                }
            };
        }
        for link in 1..self.links {
            let (velocity, omega) = self.rates[link];
            let slot = self.slot(before, link) + 3;
            self.nodes[slot..slot + 3].copy_from_slice(&[velocity.x, velocity.y, omega]);
        }
    }

    /// The motion of all links at `t`: positions and rates interpolated between steps, accelerations from centred second
    /// differences of the positions.
    pub(super) fn sample(&self, case: &Case, t: f64, state: &mut State) {
        let before = self.node_before(t);
        let place = (t / self.step - before as f64).clamp(0.0, 1.0);
        let weights = lagrange_weights(if place < 1e-9 { 2.0 } else { 2.0 + place });
        let mut second = [0.0; NODES];
        for (k, weight) in weights.iter().enumerate() {
            second[k] += weight;
            second[k + 1] -= 2.0 * weight;
            second[k + 2] += weight;
        }
        let scale = 1.0 / (self.step * self.step);
        for (link, body) in case.mechanism.links().iter().enumerate().skip(1) {
            let (mut value, mut rate, mut acceleration) = ([0.0; 3], [0.0; 3], [0.0; 3]);
            for (k, second) in second.iter().enumerate() {
                let slot = self.slot(before - Self::BEHIND + k as i64, link);
                let inner = if (1..=POINTS).contains(&k) { weights[k - 1] } else { 0.0 };
                for c in 0..3 {
                    let position = self.nodes[slot + c];
                    acceleration[c] += second * position;
                    if inner != 0.0 {
                        value[c] += inner * position;
                        rate[c] += inner * self.nodes[slot + 3 + c];
                    }
                }
            }
            let pair = |of: [f64; 3]| Vec2::new(of[0], of[1]);
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
