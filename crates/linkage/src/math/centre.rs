//! Centres of plane motion: the body point that has no velocity, and the body point that has no acceleration.
//!
//! With the angular velocity omega, the angular acceleration alpha and J = rotation by 90 deg, a point at r from the
//! frame's origin has v = v0 + omega J r and a = a0 + alpha J r - omega^2 r.
//! v = 0 at r = J v0 / omega; a = 0 at r = (omega^2 a0 + alpha J a0) / (omega^4 + alpha^2).
//! The instant centre of two links is the velocity centre of one link's motion relative to the other link.
//! Both links have the same velocity at the instant centre, so either link may be the observer.
//! The acceleration centre depends on the observer: observers with different angular motions find different points
//! without acceleration.

use super::{Motion, Vec2, turned};

/// The point at which a plane motion has no velocity, or no acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionCentre {
    /// At this world position (m).
    At(Vec2),
    /// At infinity, along this unit vector. The body translates perpendicular to the unit vector.
    AtInfinity(Vec2),
    /// Nowhere: all points have the same acceleration, which is not zero.
    Nowhere,
    /// Everywhere: the velocities, or the accelerations, of all points are zero.
    Everywhere,
}

/// Limits below which velocities or accelerations count as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionNoise {
    /// For a velocity centre: limit of the angular velocity (rad/s).
    /// For an acceleration centre: limit of the angular acceleration and of the squared angular velocity (rad/s^2).
    pub turning: f64,
    /// Limit of the velocity (m/s) for a velocity centre, or of the acceleration (m/s^2) for an acceleration centre.
    pub shift: f64,
}

impl Motion {
    /// The motion relative to an observer on a body with the motion `base`, in components along world axes.
    /// The relative acceleration does not include the Coriolis part 2 omega x v of the absolute acceleration.
    #[must_use]
    pub fn relative_to(&self, base: &Motion) -> Motion {
        let velocity = self.velocity - base.velocity_at(self.origin);
        let coriolis = turned(velocity) * (2.0 * base.omega);
        Motion {
            velocity,
            omega: self.omega - base.omega,
            acceleration: self.acceleration - base.acceleration_at(self.origin) - coriolis,
            alpha: self.alpha - base.alpha,
            ..*self
        }
    }

    /// Velocity centre: the body point without velocity. Velocities below `noise` count as zero.
    #[must_use]
    pub fn velocity_centre(&self, noise: MotionNoise) -> MotionCentre {
        if self.omega.abs() > noise.turning {
            MotionCentre::At(self.origin + turned(self.velocity) / self.omega)
        } else if self.velocity.norm() > noise.shift {
            MotionCentre::AtInfinity(turned(self.velocity).normalize())
        } else {
            MotionCentre::Everywhere
        }
    }

    /// Acceleration centre (pole of accelerations): the body point without acceleration. Accelerations below `noise`
    /// count as zero. An accelerated body in translation has no acceleration centre, not even at infinity.
    #[must_use]
    pub fn acceleration_centre(&self, noise: MotionNoise) -> MotionCentre {
        let (square, alpha) = (self.omega * self.omega, self.alpha);
        let size = square.hypot(alpha);
        if size > noise.turning {
            let [along, across] = [square / size, alpha / size];
            MotionCentre::At(self.origin + (self.acceleration * along + turned(self.acceleration) * across) / size)
        } else if self.acceleration.norm() > noise.shift {
            MotionCentre::Nowhere
        } else {
            MotionCentre::Everywhere
        }
    }
}

/// Instant centre of two bodies: the point at which the two bodies have the same velocity.
/// Velocities below `noise` count as zero.
#[must_use]
pub fn instant_centre(first: &Motion, second: &Motion, noise: MotionNoise) -> MotionCentre {
    second.relative_to(first).velocity_centre(noise)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{rotated, unit};

    const NOISE: MotionNoise = MotionNoise { turning: 1e-12, shift: 1e-12 };

    fn turning(origin: Vec2, velocity: Vec2, omega: f64, acceleration: Vec2, alpha: f64) -> Motion {
        Motion { origin, direction: unit(0.4), velocity, omega, acceleration, alpha }
    }

    fn place(centre: MotionCentre) -> Vec2 {
        match centre {
            MotionCentre::At(at) => at,
            other @ (MotionCentre::AtInfinity(_) | MotionCentre::Nowhere | MotionCentre::Everywhere) => {
                panic!("{other:?}")
            }
        }
    }

    #[test]
    fn a_wheel_rolls_about_its_contact_and_its_hub_has_no_acceleration() {
        // A wheel of radius 0.5 m rolls to the right at 2 m/s. The wheel's hub is at (3, 0.5).
        let wheel = turning(Vec2::new(3.0, 0.5), Vec2::new(2.0, 0.0), -4.0, Vec2::zeros(), 0.0);
        assert!((place(wheel.velocity_centre(NOISE)) - Vec2::new(3.0, 0.0)).norm() < 1e-15);
        assert_eq!(place(wheel.acceleration_centre(NOISE)), Vec2::new(3.0, 0.5));
    }

    #[test]
    fn centres_have_no_velocity_and_no_acceleration() {
        let first = turning(Vec2::new(0.1, 0.7), Vec2::new(2.0, -1.0), 3.0, Vec2::new(5.0, 8.0), -7.0);
        let second = turning(Vec2::new(-1.0, 0.2), Vec2::new(0.3, 0.9), -1.5, Vec2::new(-2.0, 4.0), 6.0);
        let common = place(instant_centre(&first, &second, NOISE));
        assert!((first.velocity_at(common) - second.velocity_at(common)).norm() < 1e-14);
        assert!((place(instant_centre(&second, &first, NOISE)) - common).norm() < 1e-14);
        let still = place(first.acceleration_centre(NOISE));
        assert!(first.acceleration_at(still).norm() < 1e-14);
    }

    #[test]
    fn translation_has_its_centre_at_infinity_and_rest_everywhere() {
        let slides = turning(Vec2::zeros(), Vec2::new(0.0, 2.0), 0.0, Vec2::new(1.0, 0.0), 0.0);
        assert_eq!(slides.velocity_centre(NOISE), MotionCentre::AtInfinity(Vec2::new(-1.0, 0.0)));
        assert_eq!(slides.acceleration_centre(NOISE), MotionCentre::Nowhere);
        assert_eq!(Motion::REST.velocity_centre(NOISE), MotionCentre::Everywhere);
        assert_eq!(Motion::REST.acceleration_centre(NOISE), MotionCentre::Everywhere);
    }

    /// The relative motion is compared with numerical derivatives of the body's position in the frame of the observer.
    #[test]
    fn a_relative_motion_is_the_derivative_in_the_frame_of_the_observer() {
        let frame = |t: f64, k: f64| {
            let at =
                turning(Vec2::new(k * t, 1.0 - t * t), Vec2::new(k, -2.0 * t), k + 0.6 * t, Vec2::new(0.0, -2.0), 0.6);
            Motion { direction: unit(k * t + 0.3 * t * t), ..at }
        };
        let local = Vec2::new(0.3, -0.5);
        let seen = |t: f64| {
            let (base, body) = (frame(t, 1.3), frame(t, -0.7));
            rotated(Vec2::new(base.direction.x, -base.direction.y), body.point(local) - base.origin)
        };
        let (t, h) = (0.8, 1e-3);
        let (base, body) = (frame(t, 1.3), frame(t, -0.7));
        let relative = body.relative_to(&base);
        let velocity = base.arm((seen(t + h) - seen(t - h)) / (2.0 * h));
        let acceleration = base.arm((seen(t + h) - seen(t) * 2.0 + seen(t - h)) / (h * h));
        // The truncation error is about h^2 times a third or fourth derivative, and these derivatives are about 10.
        assert!((relative.point_velocity(local) - velocity).norm() < 1e-4);
        assert!((relative.point_acceleration(local) - acceleration).norm() < 1e-4);
    }
}
