//! A cam and its follower: contact, profile and main dimensions.
//!
//! Relative to the carrier, the cam turns about its axle A by the angle q1, and the follower has the coordinate q2.
//! With the lift f, q2 - f(q1) is constant.
//! R(q2) is the centre of the roller, the knife edge, or a point of the flat face.
//! The derivatives are R' = dR / dq2 and f' = df / dq1.
//! Relative to the cam, R has the velocity T = R' f' - z x (R - A) for a unit rate of the cam.
//! The contact of a roller or knife edge lies on the line through R perpendicular to T.
//! A flat face has a fixed normal n. At the contact, face and cam have the same speed along n.
//! The distance of the contact from the line through A along n is therefore f' n . R'.
//! Norton, Cam Design and Manufacturing Handbook, 2nd ed., Industrial Press 2009, chapter 7.

mod law;

use std::f64::consts::TAU;

pub use law::{CamCurve, CamLaw, CamSegment};

use super::contact::{Contact, LineOfAction};
use crate::math::{KeepNan, Vec2, cross, rotated, turned, unit};

/// Number of cam angles from which the [`CamFigures`] of a cam are computed.
const INSTANTS: usize = 720;

/// The part of a follower that touches the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CamContact {
    /// A roller, or a knife edge if its radius is 0.
    Roller {
        /// Centre of the roller in the follower's frame (m).
        centre: Vec2,
        /// Radius of the roller (m), not negative.
        radius: f64,
    },
    /// A flat face of a sliding follower, perpendicular to the follower's axis.
    /// The face goes through this point of the follower's frame (m).
    Flat(Vec2),
}

impl CamContact {
    /// The centre of the roller, or the point of the face, in the follower's frame (m).
    #[must_use]
    pub fn point(self) -> Vec2 {
        match self {
            CamContact::Roller { centre, .. } | CamContact::Flat(centre) => centre,
        }
    }

    /// Radius of the roller (m), otherwise 0.
    #[must_use]
    pub fn radius(self) -> f64 {
        match self {
            CamContact::Roller { radius, .. } => radius,
            CamContact::Flat(_) => 0.0,
        }
    }
}

/// Motion of the follower's point R in the frame of the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Follower {
    /// At coordinate 0, R is at `at`. R moves by `along` per unit of the coordinate.
    Slides { at: Vec2, along: Vec2 },
    /// R turns about `pivot`; `arm` is the vector from the pivot to R at angle 0.
    Swings { pivot: Vec2, arm: Vec2 },
}

impl Follower {
    /// R, and its first two derivatives with respect to the coordinate of the follower.
    fn at(self, q: f64) -> [Vec2; 3] {
        match self {
            Follower::Slides { at, along } => [at + along * q, along, Vec2::zeros()],
            Follower::Swings { pivot, arm } => {
                let arm = rotated(unit(q), arm);
                [pivot + arm, turned(arm), -arm]
            }
        }
    }
}

/// A cam and its follower in the frame of their carrier.
#[derive(Clone, Debug, PartialEq)]
pub struct Cam {
    pub(super) law: CamLaw,
    pub(super) contact: CamContact,
    pub(super) follower: Follower,
    /// Axle of the cam in the frame of the carrier and in the frame of the cam (m).
    pub(super) axle: [Vec2; 2],
}

/// Main dimensions and extreme values of a cam over one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamFigures {
    /// Largest minus least lift (m, or rad for a swinging follower).
    pub lift: f64,
    /// Radius of the base circle (m): the least distance of the profile, or of a flat face, from the axle.
    pub base: f64,
    /// Largest pressure angle (rad).
    /// The pressure angle is the angle between the force on the follower and the velocity of [`CamContact::point`].
    pub pressure_angle: f64,
    /// Least radius of curvature of the convex parts of the profile (m). If this radius is negative, the profile is
    /// undercut.
    pub curvature: f64,
}

impl Cam {
    /// Lift at an angle of the cam (rad), and its first two derivatives with respect to the angle.
    #[must_use]
    pub fn lift(&self, angle: f64) -> [f64; 3] {
        self.law.at(angle)
    }

    /// Angular distance (rad) from the given cam angle to the nearest end of a piece of the cam's law.
    #[must_use]
    pub fn to_knot(&self, angle: f64) -> f64 {
        self.law.to_knot(angle)
    }

    /// The contact at the coordinates of cam (rad) and follower (rad or m).
    pub fn contact(&self, [q1, q2]: [f64; 2]) -> Contact {
        let ([_, rate, second], [at, along, bend]) = (self.law.at(q1), self.follower.at(q2));
        let reach = at - self.axle[0];
        let (direction, foot, turn, drift) = match self.contact {
            CamContact::Roller { .. } => {
                let tangent = along * rate - turned(reach);
                let change = bend * (rate * rate) + along * second - turned(along * rate);
                let normal = turned(tangent).normalize();
                let outwards = if normal.dot(&reach) < 0.0 { -normal } else { normal };
                (outwards, at, cross(tangent, change) / tangent.norm_squared(), along * rate)
            }
            CamContact::Flat(_) => {
                let normal = if along.dot(&reach) < 0.0 { -along } else { along };
                let (speed, aside) = (normal.dot(&along), turned(normal));
                let foot = self.axle[0] + normal * normal.dot(&reach) - aside * (rate * speed);
                (normal, foot, 0.0, along * rate - aside * (second * speed))
            }
        };
        let line = |direction| LineOfAction { direction, feet: [foot; 2] };
        Contact { lines: [line(direction), line(-direction)], factor: direction.dot(&along), turn, drift }
    }

    /// Coordinates of cam and follower at `count` angles of one turn. `[q1, q2]` are the coordinates of cam and
    /// follower in one arbitrary pose.
    fn turn(&self, [q1, q2]: [f64; 2], count: usize) -> impl Iterator<Item = [f64; 2]> {
        let phase = q2 - self.law.at(q1)[0];
        (0..count).map(move |index| {
            let angle = TAU * index as f64 / count as f64;
            [angle, self.law.at(angle)[0] + phase]
        })
    }

    /// The profile in the frame of the cam (m): `count` points at which the cam touches the follower in one turn.
    /// `at` contains the coordinates of cam and follower in one arbitrary pose.
    #[must_use]
    pub fn profile(&self, at: [f64; 2], count: usize) -> Vec<Vec2> {
        let point = |q: [f64; 2]| {
            let line = self.contact(q).lines[0];
            let reach = line.feet[0] - line.direction * self.contact.radius() - self.axle[0];
            self.axle[1] + rotated(unit(-q[0]), reach)
        };
        self.turn(at, count).map(point).collect()
    }

    /// Figures over one turn. `at` contains the coordinates of cam and follower in one arbitrary pose.
    #[must_use]
    pub fn figures(&self, at: [f64; 2]) -> CamFigures {
        let (lift, width) = (self.law.range(), self.contact.radius());
        let mut found = CamFigures { lift, base: f64::INFINITY, pressure_angle: 0.0, curvature: f64::INFINITY };
        for [angle, q2] in self.turn(at, INSTANTS) {
            let ([_, rate, second], [at, along, _]) = (self.law.at(angle), self.follower.at(q2));
            let (reach, contact) = (at - self.axle[0], self.contact([angle, q2]));
            let direction = contact.lines[0].direction;
            let (distance, curvature) = match self.contact {
                CamContact::Roller { .. } => {
                    let path = (along * rate - turned(reach)).norm() / (1.0 - contact.turn);
                    // Only convex parts of the profile count.
                    (reach.norm() - width, if path > 0.0 { path - width } else { f64::INFINITY })
                }
                CamContact::Flat(_) => {
                    let distance = direction.dot(&reach);
                    (distance, distance + second * contact.factor)
                }
            };
            let sine = cross(direction, along).abs() / along.norm();
            found.base = found.base.smaller(distance);
            found.curvature = found.curvature.smaller(curvature);
            found.pressure_angle = found.pressure_angle.larger(sine.smaller(1.0).asin());
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    /// A cam about the origin with a rise up to the angle `to`.
    /// The follower slides along y at a distance `e` from the axle. The follower's point is at the height q2.
    fn cam(contact: CamContact, e: f64, curve: CamCurve, to: f64) -> Cam {
        let law = vec![CamSegment { to, lift: 0.02, curve }, CamSegment { to: TAU, lift: 0.0, curve }];
        let follower = Follower::Slides { at: Vec2::new(e, 0.0), along: Vec2::new(0.0, 1.0) };
        Cam { law: CamLaw::of(law).unwrap(), contact, follower, axle: [Vec2::zeros(); 2] }
    }

    const ROLLER: CamContact = CamContact::Roller { centre: Vec2::new(0.0, 0.0), radius: 0.01 };

    /// Pressure angle of an offset follower: tan = (f' - e) / height, Norton, chapter 7.
    #[test]
    fn the_force_passes_through_the_instant_centre() {
        let own = cam(ROLLER, 0.008, CamCurve::Polynomial345, PI);
        for angle in [0.4, 1.0, 2.2, 4.0, 5.5] {
            let [lift, rate, _] = own.lift(angle);
            let direction = own.contact([angle, 0.05 + lift]).lines[0].direction;
            let tangent = -direction.x / direction.y;
            assert_relative_eq!(tangent, (rate - 0.008) / (0.05 + lift), epsilon = 1e-14);
        }
    }

    /// The profile touches the follower in all positions: the roller's centre is at the distance `radius` from the
    /// profile, and the flat face is at the distance zero.
    /// The radius of curvature agrees with the curvature of the polyline through the profile's points.
    #[test]
    fn the_profile_touches_the_follower_in_all_positions() {
        for (contact, e) in [(ROLLER, 0.008), (CamContact::Flat(Vec2::zeros()), 0.0)] {
            let own = cam(contact, e, CamCurve::ModifiedSine, PI);
            let points = own.profile([0.0, 0.05], 7200);
            for angle in [0.3, 1.0, 2.8, 3.6, 5.0] {
                let height = 0.05 + own.lift(angle)[0];
                let world = points.iter().map(|point| rotated(unit(angle), *point));
                let gap = match contact {
                    CamContact::Roller { radius, .. } => {
                        world.map(|at| (at - Vec2::new(e, height)).norm()).fold(1.0, f64::smaller) - radius
                    }
                    CamContact::Flat(_) => height - world.map(|at| at.y).fold(0.0, f64::larger),
                };
                assert_relative_eq!(gap, 0.0, epsilon = 1e-7);
            }
            let bends = (0..points.len()).map(|k| {
                let [a, b, c] = [0, 1, 2].map(|d| points[(k + d) % points.len()]);
                let (u, v) = (b - a, c - b);
                // The cam turns counter-clockwise, so the points follow each other clockwise.
                -cross(u, v).atan2(u.dot(&v)) / (0.5 * (u.norm() + v.norm()))
            });
            let least = bends.fold(0.0, f64::larger).recip();
            assert_relative_eq!(own.figures([0.0, 0.05]).curvature, least, max_relative = 2e-3);
        }
    }

    #[test]
    fn a_small_base_circle_is_undercut() {
        let own = cam(CamContact::Flat(Vec2::zeros()), 0.0, CamCurve::Cycloidal, 0.5 * PI);
        assert!(own.figures([0.0, 0.05]).curvature > 0.0 && own.figures([0.0, 0.005]).curvature < 0.0);
    }
}
