//! Axles, guides and lines of action of transmissions.

use super::super::cam::Follower;
use super::super::contact::LineOfAction;
use super::super::ids::{JointId, LinkId, PerJoint};
use super::super::parts::Joint;
use crate::math::{Vec2, cross, rotated, turned};

/// A member of a transmission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// The link.
    pub link: LinkId,
    /// Axle of a wheel, cam or swinging follower in the frame of the carrier (m). For a rack, the foot of the
    /// perpendicular from the pinion's axle to the pitch line. For a sliding follower, the joint's point on the
    /// carrier.
    pub place: Vec2,
    /// Pitch radius (m); 0 for a rack, cam or follower.
    pub radius: f64,
    /// The axle in the frame of the link (m); for a member that slides, the joint's point on the link.
    pub local: Vec2,
}

/// Two axles coincide if their distance, divided by the mechanism's size, is below this number.
pub(super) const COINCIDE: f64 = 1e-9;

/// Axle of a link in the frame of the carrier and in the frame of the link.
/// The axle is a revolute joint of the link with the carrier, or with a third link.
/// If the axle is a joint with a third link, this third link must also have a revolute joint with the carrier at the
/// same point.
pub(super) fn axle(joints: &PerJoint<Joint>, size: f64, link: LinkId, carrier: LinkId) -> Option<[Vec2; 2]> {
    let pins = |on: LinkId| joints.iter().filter(move |joint| joint.is_pin() && joint.on(on).is_some());
    let near = COINCIDE * size;
    pins(link).find_map(|pin| {
        let (own, other) = (pin.on(link)?, pin.other(link));
        if other.link == carrier {
            return Some([other.local, own]);
        }
        let coaxial = |next: &&Joint| {
            let on = next.other(carrier);
            on.link == other.link && (on.local - other.local).norm() <= near
        };
        Some([pins(carrier).find(coaxial)?.on(carrier)?, own])
    })
}

/// The prismatic joint between a carrier and its rack or follower, with three vectors. The first two vectors are a
/// point and the axis of the guide in the frame of the carrier. The third vector is the joint's point in the frame of
/// the rack or follower.
pub(super) fn guide(joints: &PerJoint<Joint>, rack: LinkId, carrier: LinkId) -> Option<(JointId, [Vec2; 3])> {
    joints.entries().find_map(|(index, joint)| {
        let axis = joint.axis_on(carrier)?;
        Some((index, [joint.on(carrier)?, axis, joint.on(rack)?]))
    })
}

/// Sign of the rate of the joint's coordinate if `link` moves in the positive direction relative to the joint's other
/// link.
pub(super) fn sense(joint: &Joint, link: LinkId) -> f64 {
    if joint.second.link == link { 1.0 } else { -1.0 }
}

/// A follower that slides in a guide. `local` is [`CamContact::point`]; the three vectors of the guide are the result
/// of [`guide`].
pub(super) fn sliding(link: LinkId, joint: &Joint, [at, axis, own]: [Vec2; 3], local: Vec2) -> (Member, Follower) {
    let (own_axis, sign) = (joint.axis_on(link).expect("it slides"), sense(joint, link));
    let turn = Vec2::new(own_axis.dot(&axis), cross(own_axis, axis));
    let follower = Follower::Slides { at: at + rotated(turn, local - own), along: axis * sign };
    (Member { link, place: at, radius: 0.0, local: own }, follower)
}

/// Gears: the lines of action touch the base circles and pass through the pitch point.
pub(super) fn gears(
    [mut one, mut other]: [Member; 2],
    teeth: [f64; 2],
    angle: f64,
) -> ([Member; 2], [LineOfAction; 2]) {
    let between = other.place - one.place;
    // Pitch radii: distances of the pitch point from the axles. Each distance is positive in the direction of the other
    // gear's axle.
    let radii = teeth.map(|own| between.norm() * own / (teeth[0] + teeth[1]));
    let (along, across) = (between.normalize(), turned(between.normalize()));
    [one.radius, other.radius] = radii.map(f64::abs);
    let pitch = one.place + along * radii[0];
    // External teeth push the axles apart; the teeth of a ring gear and its pinion pull the axles together.
    let apart = if radii[0] > 0.0 && radii[1] > 0.0 { 1.0 } else { -1.0 };
    let line = |side: f64| {
        let direction = across * (side * angle.cos()) + along * (apart * angle.sin());
        LineOfAction { direction, feet: [pitch; 2] }
    };
    ([one, other], [line(1.0), line(-1.0)])
}

/// Pinion and rack: the lines of action pass through the foot of the axle on the pitch line.
pub(super) fn rack(
    mut one: Member,
    [_, axis, local]: [Vec2; 3],
    link: LinkId,
    angle: f64,
    foot: Vec2,
) -> ([Member; 2], [LineOfAction; 2]) {
    one.radius = (foot - one.place).norm();
    let away = (foot - one.place).normalize();
    let line = |side: f64| {
        let direction = axis * (side * angle.cos()) + away * angle.sin();
        LineOfAction { direction, feet: [foot; 2] }
    };
    ([one, Member { link, place: foot, radius: 0.0, local }], [line(1.0), line(-1.0)])
}

/// Belt: the lines of action are the strands, from the second wheel to the first.
pub(super) fn belt(
    [mut one, mut other]: [Member; 2],
    radii: [f64; 2],
    crossed: bool,
) -> ([Member; 2], [LineOfAction; 2]) {
    [one.radius, other.radius] = radii;
    let between = other.place - one.place;
    let (distance, along) = (between.norm(), between.normalize());
    let of_second = if crossed { -radii[1] } else { radii[1] };
    // `normal` points from the first axle to the point at which the strand leaves the first wheel.
    let sine = (radii[0] - of_second) / distance;
    let line = |side: f64| {
        let normal = along * sine + turned(along) * (side * (1.0 - sine * sine).sqrt());
        let feet = [one.place + normal * radii[0], other.place + normal * of_second];
        LineOfAction { direction: (feet[0] - feet[1]).normalize(), feet }
    };
    ([one, other], [line(1.0), line(-1.0)])
}
