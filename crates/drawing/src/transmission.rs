//! Transmissions: pitch circles of gears, pitch lines of racks, wheels and strands of belts.

use super::mark::{Mark, MarkRole};
use super::travel::Travels;
use linkage::math::{KeepNan, Vec2, unit};
use linkage::mechanism::{LinkId, Mechanism, Transmission, TransmissionKind};

/// Inner end of the stroke that shows how far a wheel has turned, as a fraction of its radius.
const STROKE: f64 = 0.8;
/// Length of a rack beyond the contact at both ends of its travel, as a fraction of the pinion's radius.
const BEYOND: f64 = 0.6;

/// All marks of transmissions: the link that each mark belongs to, and the mark.
pub fn marks(mechanism: &Mechanism, travels: &Travels) -> Vec<(LinkId, Mark)> {
    mechanism.transmissions().iter().flat_map(|own| of(mechanism, travels, own)).collect()
}

fn of(mechanism: &Mechanism, travels: &Travels, own: &Transmission) -> Vec<(LinkId, Mark)> {
    let mut marks = Vec::new();
    for member in own.members.iter().filter(|member| member.radius > 0.0) {
        let (at, radius) = (member.local, member.radius);
        let stroke = [STROKE, 1.0].map(|share| at + unit(0.0) * (share * radius));
        marks.push((member.link, Mark::circle(MarkRole::Wheel, at, radius)));
        marks.push((member.link, Mark::line(MarkRole::Wheel, stroke)));
    }
    match own.design.kind {
        TransmissionKind::Gears { .. } => {}
        TransmissionKind::Rack { .. } => marks.extend(rack(mechanism, travels, own)),
        TransmissionKind::Belt { .. } => {
            let strands = own.lines.iter().map(|line| Mark::line(MarkRole::Strand, line.feet));
            marks.extend(strands.map(|strand| (own.design.carrier, strand)));
        }
    }
    marks
}

/// The pitch line of a rack over the travel of the contact.
fn rack(mechanism: &Mechanism, travels: &Travels, own: &Transmission) -> Option<(LinkId, Mark)> {
    let [pinion, rack] = &own.members;
    let index = own.terms.iter().find_map(|(of, _)| of.joint())?;
    let (joint, carrier) = (&mechanism.joints()[index], own.design.carrier);
    let (axis, guide) = (joint.axis_on(carrier)?, joint.on(carrier)?);
    let foot = axis.dot(&(rack.place - guide));
    let travel = travels.of(index).unwrap_or([0.0; 2]);
    // The travel is that of the block on the guide.
    let is_guide = mechanism.guide_and_block(joint)?[0].link == rack.link;
    let contact = travel.map(|way| if is_guide { foot + way } else { foot - way });
    let beyond = BEYOND * pinion.radius;
    let ends = [contact[0].smaller(contact[1]) - beyond, contact[0].larger(contact[1]) + beyond];
    let along: Vec2 = joint.axis_on(rack.link)?;
    Some((rack.link, Mark::line(MarkRole::Wheel, ends.map(|end| rack.local + along * end))))
}
