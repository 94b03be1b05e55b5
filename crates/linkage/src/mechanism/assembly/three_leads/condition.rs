//! The condition that a lead imposes on the base, and the lead's pose for a given pose of the base.

use super::super::dyads::turn;
use crate::math::angle::wrapped;
use crate::math::{KeepNan, Vec2, cross, rotated, turned, unit};
use crate::mechanism::LinkPose;

/// One element of a pair, in the frame of its body: the position and, if the pair slides, the axis.
#[derive(Clone, Copy, Debug)]
pub struct PairEnd {
    pub place: Vec2,
    pub axis: Vec2,
}

/// A pair of a lead with the frame or the base.
#[derive(Clone, Copy, Debug)]
pub struct LeadPair {
    pub slides: bool,
    /// The pair's element on the lead.
    pub lead: PairEnd,
    /// The pair's element on the frame or on the base.
    pub body: PairEnd,
}

/// A link between frame and base.
#[derive(Clone, Copy, Debug)]
pub struct PlatformLead {
    pub near: LeadPair,
    pub far: LeadPair,
}

/// The condition that a lead imposes on the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition {
    Circle { a: Vec2, w: Vec2, length: f64 },
    FrameLine { axis: Vec2, a: Vec2, w: Vec2, height: f64 },
    BaseLine { axis: Vec2, a: Vec2, height: f64 },
    Angle(f64),
}

/// The possible positions of O that satisfy a condition at a given angle of the base.
#[derive(Clone, Copy, Debug)]
pub enum Locus {
    Circle {
        centre: Vec2,
        radius: f64,
    },
    /// A line: all O with p + q . O = 0.
    Line {
        p: f64,
        q: Vec2,
    },
}

impl Condition {
    /// The condition of a lead. The frame's origin is at `frame`, the base's origin at `base`.
    pub fn of(lead: &PlatformLead, frame: Vec2, base: Vec2) -> Self {
        let (near, far) = (lead.near, lead.far);
        let span = far.lead.place - near.lead.place;
        let (a, w) = (near.body.place - frame, far.body.place - base);
        match (near.slides, far.slides) {
            (false, false) => Condition::Circle { a, w, length: span.norm() },
            (true, false) => Condition::FrameLine { axis: near.body.axis, a, w, height: cross(near.lead.axis, span) },
            (false, true) => {
                let height = cross(far.lead.axis, span) - cross(far.body.axis, w);
                Condition::BaseLine { axis: far.body.axis, a, height }
            }
            (true, true) => Condition::Angle(turn(near.lead.axis, near.body.axis) + turn(far.body.axis, far.lead.axis)),
        }
    }

    /// Possible positions of O for the base's direction `b`; `None` if the condition fixes the base's angle.
    pub fn locus(&self, b: Vec2) -> Option<Locus> {
        Some(match *self {
            Condition::Circle { a, w, length } => Locus::Circle { centre: a - rotated(b, w), radius: length },
            Condition::FrameLine { axis, a, w, height } => {
                Locus::Line { p: cross(axis, rotated(b, w) - a) - height, q: turned(axis) }
            }
            Condition::BaseLine { axis, a, height } => {
                let axis = rotated(b, axis);
                Locus::Line { p: -cross(axis, a) - height, q: turned(axis) }
            }
            Condition::Angle(_) => return None,
        })
    }

    /// Residual of the condition at O and beta (m), and its derivatives with respect to O and beta.
    /// The residual of a circle is a difference of squared lengths, divided by `size`.
    pub fn residual(&self, o: Vec2, beta: f64, size: f64) -> (f64, Vec2, f64) {
        let b = unit(beta);
        match *self {
            Condition::Circle { a, w, length } => {
                let arm = rotated(b, w);
                let span = o + arm - a;
                ((span.norm_squared() - length * length) / size, span * (2.0 / size), 2.0 * cross(arm, span) / size)
            }
            Condition::FrameLine { axis, a, w, height } => {
                let arm = rotated(b, w);
                (cross(axis, o + arm - a) - height, turned(axis), axis.dot(&arm))
            }
            Condition::BaseLine { axis, a, height } => {
                let axis = rotated(b, axis);
                (cross(axis, o - a) - height, turned(axis), -axis.dot(&(o - a)))
            }
            Condition::Angle(angle) => (size * wrapped(beta - angle), Vec2::zeros(), size),
        }
    }

    /// Largest length in the condition (m).
    pub fn size(&self) -> f64 {
        match *self {
            Condition::Circle { a, w, length } => a.norm().larger(w.norm()).larger(length),
            Condition::FrameLine { a, w, height, .. } => a.norm().larger(w.norm()).larger(height.abs()),
            Condition::BaseLine { a, height, .. } => a.norm().larger(height.abs()),
            Condition::Angle(_) => 0.0,
        }
    }
}

impl PlatformLead {
    /// Pose of the lead in the frame, given the base's pose; `None` if the lead can slide freely.
    pub fn pose(&self, base: &LinkPose) -> Option<LinkPose> {
        let (near, far) = (self.near, self.far);
        let by_near = turn(near.lead.axis, near.body.axis);
        let at_far = base.point(far.body.place);
        Some(match (near.slides, far.slides) {
            (false, false) => LinkPose::between(near.lead.place, far.lead.place, near.body.place, at_far),
            (true, false) => LinkPose::through(far.lead.place, at_far, by_near),
            (false, true) => {
                let angle = base.angle + turn(far.lead.axis, far.body.axis);
                LinkPose::through(near.lead.place, near.body.place, angle)
            }
            (true, true) => {
                let far_axis = rotated(unit(base.angle), far.body.axis);
                let still = LinkPose::through(near.lead.place, near.body.place, by_near);
                let sine = cross(far_axis, near.body.axis);
                if !(sine.abs() > 1e-12) {
                    return None;
                }
                let slide = cross(far_axis, at_far - still.point(far.lead.place)) / sine;
                LinkPose { origin: still.origin + near.body.axis * slide, ..still }
            }
        })
    }
}
