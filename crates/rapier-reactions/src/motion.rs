//! Velocities and accelerations of a body from three of its poses.

use crate::model::ModelBody;
use crate::plane::{Placement, Vec2, cross, rotated};

/// Motion of a body at the middle of three poses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// Mass centre (m).
    pub(crate) centre: Vec2,
    /// Direction of the body's x axis.
    pub(crate) direction: Vec2,
    /// Velocity of the mass centre (m/s), and angular velocity (rad/s).
    pub(crate) velocity: Vec2,
    pub(crate) omega: f64,
    /// Acceleration of the mass centre (m/s^2), and angular acceleration (rad/s^2).
    pub(crate) acceleration: Vec2,
    pub(crate) alpha: f64,
}

impl Motion {
    /// Centred differences of three poses that are `step` (s) apart. The error is of second order in the step.
    /// The body must turn by less than half a turn per step.
    pub(crate) fn of(body: &ModelBody, poses: [Placement; 3], step: f64) -> Motion {
        let [before, centre, after] = poses.map(|pose| pose.point(body.centre));
        let turn = |from: Placement, to: Placement| {
            cross(from.direction, to.direction).atan2(from.direction.dot(&to.direction))
        };
        let (back, forth) = (turn(poses[0], poses[1]), turn(poses[1], poses[2]));
        Motion {
            centre,
            direction: poses[1].direction,
            velocity: (after - before) / (2.0 * step),
            omega: (forth + back) / (2.0 * step),
            acceleration: ((after - centre) - (centre - before)) / (step * step),
            alpha: (forth - back) / (step * step),
        }
    }

    /// The body's frame at the time `time` (s) after the middle pose, by the parabola through the three poses.
    pub(crate) fn placement(&self, body: &ModelBody, time: f64) -> Placement {
        let angle = (self.omega + 0.5 * self.alpha * time) * time;
        let direction = rotated(Vec2::new(angle.cos(), angle.sin()), self.direction);
        let centre = self.centre + (self.velocity + self.acceleration * (0.5 * time)) * time;
        Placement { origin: centre - rotated(direction, body.centre), direction }
    }

    /// Velocity of the mass centre (m/s) and angular velocity (rad/s) at the time `time` (s) after the middle pose.
    pub(crate) fn speeds(&self, time: f64) -> [f64; 3] {
        let velocity = self.velocity + self.acceleration * time;
        [velocity.x, velocity.y, self.omega + self.alpha * time]
    }
}
