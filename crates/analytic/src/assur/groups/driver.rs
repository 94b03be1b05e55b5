//! A driving link: its pose follows from the pose of its base and the coordinate of its joint.
//!
//! Let p be the joint's point on the base, and w the base's angular velocity. The sign g is +1 if the driving link is
//! the joint's second link, and -1 if it is the first.
//! A crank has the given world angle. A link with a given angle q has the angle of its base plus g q.
//! For a given slide q along the axis e, the joint's point on the link is at P = p + g q e.
//! The velocity of this point is the velocity of the base at P, plus g q' e.
//! The acceleration of this point is the acceleration of the base at P, plus g q'' e + 2 w g q' (z x e).

use linkage::input::Input;
use linkage::math::{Motion, Vec2, rotated, turned, unit};
use linkage::mechanism::{DrivingLink, GROUND, LinkId, Mechanism};

use super::guide::turn_between;

/// How the coordinate of the joint moves the link.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// The world angle is given.
    Angle,
    /// The angle relative to the base is given, counted with this sign.
    Turn(f64),
    /// The slide along an axis of the base is given, counted with this sign. `turn` is the link's direction in the
    /// base's frame.
    Slide { axis: Vec2, turn: Vec2, sign: f64 },
}

/// Driving link on the ground or on an earlier driving link.
#[derive(Clone, Copy, Debug)]
pub(in crate::assur) struct Driver {
    pub(in crate::assur) link: LinkId,
    pub(super) base: LinkId,
    /// Number of the drive.
    pub(in crate::assur) index: usize,
    /// Position of the joint in the link's frame and in the frame of the link's base.
    pub(super) pivot: Vec2,
    pub(super) place: Vec2,
    /// Whether the link is a crank on the ground whose joint is the origin of its frame: the origin then stays at rest.
    is_plain: bool,
    way: Way,
}

impl Driver {
    pub(super) fn of(mechanism: &Mechanism, index: usize, driver: &DrivingLink) -> Self {
        let joint = &mechanism.joints()[driver.joint];
        let pivot = joint.on(driver.link).expect("the driven joint is on its link");
        let base = joint.other(driver.link);
        let sign = if joint.second.link == driver.link { 1.0 } else { -1.0 };
        let way = match driver.input {
            Input::Angle => Way::Angle,
            Input::Turn => Way::Turn(sign),
            Input::Slide => {
                let [axis, own] = [base.link, driver.link].map(|link| joint.axis_on(link).expect("the joint slides"));
                Way::Slide { axis, turn: turn_between(axis, own), sign }
            }
        };
        let is_plain = pivot == Vec2::zeros() && base.link == GROUND && driver.input == Input::Angle;
        Driver { link: driver.link, base: base.link, index, pivot, place: base.local, is_plain, way }
    }

    /// Whether the given coordinate is a slide.
    pub(super) fn slides(&self) -> bool {
        matches!(self.way, Way::Slide { .. })
    }

    /// Whether the link is a crank: its world angle is given.
    pub(super) fn is_crank(&self) -> bool {
        matches!(self.way, Way::Angle)
    }

    /// World direction of the link, and the world position of the joint's point on the link.
    #[inline]
    pub(super) fn position(&self, coordinate: f64, motions: &[Motion]) -> (Vec2, Vec2) {
        let base = &motions[self.base];
        let place = if self.base == GROUND { self.place } else { base.point(self.place) };
        match self.way {
            Way::Angle => (unit(coordinate), place),
            Way::Turn(sign) => (rotated(base.direction, unit(sign * coordinate)), place),
            Way::Slide { axis, turn, sign } => {
                (rotated(base.direction, turn), place + base.arm(axis) * (sign * coordinate))
            }
        }
    }

    /// Angular velocity of the link (rad/s), and the velocity of the joint's point on the link (m/s).
    #[inline]
    pub(super) fn velocity(&self, rate: f64, motions: &[Motion]) -> (f64, Vec2) {
        let base = &motions[self.base];
        let carried = if self.base == GROUND { Vec2::zeros() } else { base.point_velocity(self.place) };
        match self.way {
            Way::Angle => (rate, carried),
            Way::Turn(sign) => (base.omega + sign * rate, carried),
            Way::Slide { axis, sign, .. } => {
                let at = motions[self.link].point(self.pivot);
                (base.omega, base.velocity_at(at) + base.arm(axis) * (sign * rate))
            }
        }
    }

    /// Angular acceleration of the link (rad/s^2), and the acceleration of the joint's point on the link (m/s^2).
    #[inline]
    pub(super) fn acceleration(&self, [rate, second]: [f64; 2], motions: &[Motion]) -> (f64, Vec2) {
        let base = &motions[self.base];
        let carried = if self.base == GROUND { Vec2::zeros() } else { base.point_acceleration(self.place) };
        match self.way {
            Way::Angle => (second, carried),
            Way::Turn(sign) => (base.alpha + sign * second, carried),
            Way::Slide { axis, sign, .. } => {
                let (at, axis) = (motions[self.link].point(self.pivot), base.arm(axis));
                let coriolis = turned(axis) * (2.0 * base.omega * sign * rate);
                (base.alpha, base.acceleration_at(at) + axis * (sign * second) + coriolis)
            }
        }
    }

    /// Position, velocity and acceleration in one pass.
    #[inline(always)]
    pub(super) fn place_at(&self, [coordinate, rate, second]: [f64; 3], motions: &mut [Motion]) {
        if self.is_plain {
            let (direction, omega, alpha) = (unit(coordinate), rate, second);
            motions[self.link] = Motion { origin: self.place, direction, omega, alpha, ..Motion::REST };
        } else {
            self.place_carried([coordinate, rate, second], motions);
        }
    }

    /// The general case of [`Driver::place_at`], for every driving link that is not a plain crank.
    #[inline(never)]
    fn place_carried(&self, [coordinate, rate, second]: [f64; 3], motions: &mut [Motion]) {
        if let Way::Slide { axis, turn, sign } = self.way {
            // The link turns with its base, and its origin moves along the axis relative to the base.
            let base = &motions[self.base];
            let (axis, direction) = (base.arm(axis), rotated(base.direction, turn));
            let arm = base.arm(self.place) + axis * (sign * coordinate) - rotated(direction, self.pivot);
            let (omega, alpha) = (base.omega, base.alpha);
            motions[self.link] = Motion {
                origin: base.origin + arm,
                direction,
                velocity: base.velocity_beyond(arm) + axis * (sign * rate),
                omega,
                acceleration: base.acceleration_beyond(arm)
                    + axis * (sign * second)
                    + turned(axis) * (2.0 * omega * sign * rate),
                alpha,
            };
            return;
        }
        self.put_position(coordinate, motions);
        self.put_velocity(rate, motions);
        self.put_acceleration([rate, second], motions);
    }

    #[inline]
    pub(super) fn put_position(&self, coordinate: f64, motions: &mut [Motion]) {
        let (direction, place) = self.position(coordinate, motions);
        let motion = &mut motions[self.link];
        motion.direction = direction;
        motion.origin = place - rotated(direction, self.pivot);
    }

    #[inline]
    pub(super) fn put_velocity(&self, rate: f64, motions: &mut [Motion]) {
        let (omega, carried) = self.velocity(rate, motions);
        let motion = &mut motions[self.link];
        motion.omega = omega;
        motion.velocity = carried - turned(motion.arm(self.pivot)) * omega;
    }

    #[inline]
    pub(super) fn put_acceleration(&self, rates: [f64; 2], motions: &mut [Motion]) {
        let (alpha, carried) = self.acceleration(rates, motions);
        let motion = &mut motions[self.link];
        let arm = motion.arm(self.pivot);
        motion.alpha = alpha;
        motion.acceleration = carried + arm * (motion.omega * motion.omega) - turned(arm) * alpha;
    }
}
