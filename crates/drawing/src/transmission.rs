//! Transmissions: pitch circles of gears, pitch lines of racks, wheels and strands of belts, profiles of cams and the
//! rollers or faces of their followers.

use super::mark::{Mark, MarkRole};
use super::travel::Travels;
use linkage::math::{KeepNan, Vec2, turned, unit};
use linkage::mechanism::{CamContact, LinkId, Mechanism, Transmission, TransmissionId, TransmissionKind};

/// Inner end of the stroke that shows how far a wheel has turned, as a fraction of the wheel's radius.
const STROKE: f64 = 0.8;
/// At each end of its travel, a rack extends beyond the contact by this fraction of the pinion's radius.
const BEYOND: f64 = 0.6;
/// Number of drawn points of a cam's profile.
const CORNERS: usize = 360;

/// All marks of transmissions: the link that each mark belongs to, and the mark.
pub fn marks(mechanism: &Mechanism, travels: &Travels) -> Vec<(LinkId, Mark)> {
    mechanism.transmissions().ids().flat_map(|index| of(mechanism, travels, index)).collect()
}

/// The marks of one transmission.
pub fn of(mechanism: &Mechanism, travels: &Travels, index: TransmissionId) -> Vec<(LinkId, Mark)> {
    let own = &mechanism.transmissions()[index];
    let mut marks = Vec::new();
    for member in own.members.iter().filter(|member| member.radius > 0.0) {
        let (at, radius) = (member.local, member.radius);
        let stroke = [STROKE, 1.0].map(|share| at + unit(0.0) * (share * radius));
        marks.push((member.link, Mark::circle(MarkRole::Wheel, at, radius)));
        marks.push((member.link, Mark::line(MarkRole::Wheel, stroke)));
    }
    match &own.design.kind {
        TransmissionKind::Gears { .. } => {}
        TransmissionKind::Rack { .. } | TransmissionKind::Screw { .. } => marks.extend(rack(mechanism, travels, own)),
        TransmissionKind::Belt { .. } => {
            let strands = own.contact([0.0; 2]).lines.map(|line| Mark::line(MarkRole::Strand, line.feet));
            marks.extend(strands.into_iter().map(|strand| (own.design.carrier, strand)));
        }
        TransmissionKind::Cam { contact, .. } => {
            let profile = travels
                .members(index)
                .zip(own.cam.as_ref())
                .map_or_else(Vec::new, |(at, cam)| cam.profile(at, CORNERS));
            let reach = profile.iter().map(|at| (at - own.members[0].local).norm()).fold(0.0, KeepNan::larger);
            marks.push((own.members[0].link, Mark::area(MarkRole::Wheel, profile)));
            marks.extend(follower(mechanism, own, *contact, reach));
        }
    }
    marks
}

/// The pitch line of a rack over the travel of the contact, or the spindle of a screw.
fn rack(mechanism: &Mechanism, travels: &Travels, own: &Transmission) -> Option<(LinkId, Mark)> {
    let [pinion, rack] = &own.members;
    let index = own.slide()?;
    let (joint, carrier) = (&mechanism.joints()[index], own.design.carrier);
    let (axis, guide) = (joint.axis_on(carrier)?, joint.on(carrier)?);
    let foot = axis.dot(&(rack.place - guide));
    let travel = travels.of(index).unwrap_or([0.0; 2]);
    // `travel` is the travel of the block on the guide.
    let is_guide = mechanism.guide_and_block(joint)?[0].link == rack.link;
    let contact = travel.map(|way| if is_guide { foot + way } else { foot - way });
    let beyond = BEYOND * pinion.radius;
    let mut ends = [contact[0].smaller(contact[1]) - beyond, contact[0].larger(contact[1]) + beyond];
    // The spindle of a screw reaches from its nut to its axle.
    if matches!(own.design.kind, TransmissionKind::Screw { .. }) {
        ends = [ends[0].smaller(0.0), ends[1].larger(0.0)];
    }
    let along: Vec2 = joint.axis_on(rack.link)?;
    Some((rack.link, Mark::line(MarkRole::Wheel, ends.map(|end| rack.local + along * end))))
}

/// The part of a follower that touches the cam: the roller, or the flat face.
/// The flat face is drawn twice as long as the cam's largest radius `reach`.
fn follower(mechanism: &Mechanism, own: &Transmission, contact: CamContact, reach: f64) -> Option<(LinkId, Mark)> {
    let link = own.members[1].link;
    let mark = match contact {
        CamContact::Roller { centre, radius } => Mark::circle(MarkRole::Wheel, centre, radius),
        CamContact::Flat(at) => {
            let face = turned(mechanism.joints()[own.slide()?].axis_on(link)?) * reach;
            Mark::line(MarkRole::Wheel, [at - face, at + face])
        }
    };
    Some((link, mark))
}
