//! Plane motion of a rigid body: position, velocity and acceleration of every point of the body.

use super::{Vec2, rotated, turned};

/// Position, velocity and acceleration of a body-fixed frame; SI units, world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Position of the frame's origin (m).
    pub origin: Vec2,
    /// Unit vector of the frame's x axis: (cos, sin) of its angle.
    pub direction: Vec2,
    /// Velocity of the origin (m/s).
    pub velocity: Vec2,
    /// Angular velocity (rad/s), counter-clockwise positive.
    pub omega: f64,
    /// Acceleration of the origin (m/s^2).
    pub acceleration: Vec2,
    /// Angular acceleration (rad/s^2), counter-clockwise positive.
    pub alpha: f64,
}

impl Motion {
    /// A frame at rest that coincides with the world frame.
    pub const REST: Motion = Motion {
        origin: Vec2::new(0.0, 0.0),
        direction: Vec2::new(1.0, 0.0),
        velocity: Vec2::new(0.0, 0.0),
        omega: 0.0,
        acceleration: Vec2::new(0.0, 0.0),
        alpha: 0.0,
    };

    /// The motion of a body, computed from the motion of one of its points and from its rotation.
    /// The point is given by its body coordinates `local` (m) and its position, velocity and acceleration.
    /// The rotation is given by direction, angular velocity and angular acceleration.
    #[inline]
    #[must_use]
    pub fn of_point(
        local: Vec2,
        [position, velocity, acceleration]: [Vec2; 3],
        direction: Vec2,
        omega: f64,
        alpha: f64,
    ) -> Self {
        let back = rotated(direction, -local);
        Motion {
            origin: position + back,
            direction,
            velocity: velocity + turned(back) * omega,
            omega,
            acceleration: acceleration + turned(back) * alpha - back * (omega * omega),
            alpha,
        }
    }

    /// World vector (m) from the origin to the point with the body coordinates `local` (m).
    #[inline]
    #[must_use]
    pub fn arm(&self, local: Vec2) -> Vec2 {
        rotated(self.direction, local)
    }

    /// World position of a body point (m).
    #[inline]
    #[must_use]
    pub fn point(&self, local: Vec2) -> Vec2 {
        self.origin + self.arm(local)
    }

    /// Velocity of a body point (m/s): v0 + omega x r.
    #[inline]
    #[must_use]
    pub fn point_velocity(&self, local: Vec2) -> Vec2 {
        self.velocity_beyond(self.arm(local))
    }

    /// Velocity (m/s) of the body point at the end of `arm`, a world vector from the origin (m).
    #[inline]
    #[must_use]
    pub fn velocity_beyond(&self, arm: Vec2) -> Vec2 {
        self.velocity + turned(arm) * self.omega
    }

    /// Velocity (m/s) of the body point that coincides with the world point `place` at this instant.
    #[inline]
    #[must_use]
    pub fn velocity_at(&self, place: Vec2) -> Vec2 {
        self.velocity_beyond(place - self.origin)
    }

    /// Acceleration of a body point (m/s^2): a0 + alpha x r - omega^2 r.
    #[inline]
    #[must_use]
    pub fn point_acceleration(&self, local: Vec2) -> Vec2 {
        self.acceleration_beyond(self.arm(local))
    }

    /// Acceleration (m/s^2) of the body point at the end of `arm`, a world vector from the origin (m).
    #[inline]
    #[must_use]
    pub fn acceleration_beyond(&self, arm: Vec2) -> Vec2 {
        self.acceleration + turned(arm) * self.alpha - arm * (self.omega * self.omega)
    }

    /// Acceleration (m/s^2) of the body point that coincides with the world point `place` at this instant.
    #[inline]
    #[must_use]
    pub fn acceleration_at(&self, place: Vec2) -> Vec2 {
        self.acceleration_beyond(place - self.origin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::unit;

    /// A frame whose origin and angle are polynomials in time, so that all derivatives are known.
    fn frame(t: f64) -> Motion {
        Motion {
            origin: Vec2::new(1.0 + 2.0 * t, 3.0 * t * t),
            direction: unit(0.3 + 0.7 * t - 0.4 * t * t),
            velocity: Vec2::new(2.0, 6.0 * t),
            omega: 0.7 - 0.8 * t,
            acceleration: Vec2::new(0.0, 6.0),
            alpha: -0.8,
        }
    }

    #[test]
    fn a_motion_is_determined_by_any_of_its_points() {
        let (local, whole) = (Vec2::new(-0.3, 0.8), frame(0.4));
        let vectors = [whole.point(local), whole.point_velocity(local), whole.point_acceleration(local)];
        let again = Motion::of_point(local, vectors, whole.direction, whole.omega, whole.alpha);
        assert!((again.origin - whole.origin).norm() < 1e-15);
        assert!((again.velocity - whole.velocity).norm() < 1e-15);
        assert!((again.acceleration - whole.acceleration).norm() < 1e-14);
    }

    #[test]
    fn local_point_and_world_position_have_equal_rates() {
        let (local, whole) = (Vec2::new(-0.3, 0.8), frame(0.4));
        let place = whole.point(local);
        assert!((whole.velocity_at(place) - whole.point_velocity(local)).norm() < 1e-15);
        assert!((whole.acceleration_at(place) - whole.point_acceleration(local)).norm() < 1e-14);
    }

    #[test]
    fn velocity_and_acceleration_are_derivatives_of_the_position() {
        let (r, t, h) = (Vec2::new(0.4, -0.2), 0.6, 1e-4);
        let (back, here, ahead) = (frame(t - h).point(r), frame(t).point(r), frame(t + h).point(r));
        let velocity = (ahead - back) / (2.0 * h);
        let acceleration = (ahead - here * 2.0 + back) / (h * h);
        assert!((velocity - frame(t).point_velocity(r)).norm() < 1e-7);
        assert!((acceleration - frame(t).point_acceleration(r)).norm() < 1e-6);
    }
}
