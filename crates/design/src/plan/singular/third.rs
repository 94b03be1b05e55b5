//! Groups of class III and order 3 with pins only: a base link DEF on three leads AD, BE and CF.
//!
//! S, the intersection of AD and BE, is treated as a point of the base link.
//! Along each of these two leads, S and the lead's outer end have the same velocity component.
//! The two components determine v_S. The third lead then gives the angular velocity omega of the base link.
//! a_S and the angular acceleration alpha follow in the same way, without assumed values.
//! Each pair of leads has such a point S. The program uses the pair whose lines meet at the largest angle.

use super::leads::{lead, named};
use super::point::{AssurAcceleration, AssurLead, PARALLEL, SingularPoint, meeting, oblique, trial, wrong};
use crate::sentences;
use linkage::error::Result;
use linkage::math::{KeepNan, Motion, Vec2, cross, turned};
use linkage::mechanism::{Group, JointId, LinkId, Mechanism};

/// A lead and the motion of its outer end: velocity and acceleration.
type Outer = (AssurLead, [Vec2; 2]);

/// The singular point of a group of class III and order 3 with pins only; `None` for other groups.
///
/// # Errors
/// [`linkage::error::ErrorKind::Geometry`] at a dead point: the leads are parallel, or all three meet in one point.
pub(super) fn point(mechanism: &Mechanism, group: &Group, motions: &[Motion]) -> Result<Option<SingularPoint>> {
    let Some((base, [one, two, three])) = parts(mechanism, group, motions) else { return Ok(None) };
    let slant = |first: &Outer, second: &Outer| cross(first.0.along, second.0.along).abs();
    let slants = [slant(&two, &three), slant(&one, &three), slant(&one, &two)];
    let mut all = if slants[0] > slants[1].larger(slants[2]) {
        [two, three, one]
    } else if slants[1] > slants[2] {
        [one, three, two]
    } else {
        [one, two, three]
    };
    let steep = slant(&all[0], &all[1]);
    let [(first, _), (second, _), (last, _)] = &all;
    let both = [first, second];
    if !(steep > PARALLEL) {
        return Err(wrong(both, " and ", |names| sentences::the_leads_are_parallel_their(&names)));
    }
    let at = meeting(both);
    let across = turned(last.ends[0] - at);
    let lever = across.dot(&last.along);
    if !(lever.abs() > PARALLEL * across.norm()) {
        return Err(wrong(both, " x ", |names| sentences::all_leads_meet_in_the_singular_point(&names)));
    }
    let velocity = oblique(both, [0, 1].map(|k| all[k].1[0].dot(&all[k].0.along)));
    let omega = (all[2].1[0] - velocity).dot(&last.along) / lever;
    for (lead, [far, _]) in &mut all {
        lead.velocities = [velocity + turned(lead.ends[0] - at) * omega, *far];
    }
    let lead_omegas = all.each_ref().map(|(lead, _)| lead.turning(lead.velocities));
    let feet = [0, 1, 2].map(|k| all[k].0.foot(at, all[k].1[1], lead_omegas[k], omega));
    let [(first, [_, one]), (second, [_, other]), (last, _)] = &all;
    let found = trial([first, second], [*one, *other], [feet[0], feet[1]]);
    let alpha = (feet[2] - found.at).dot(&last.along) / lever;
    let acceleration = |place: Vec2| found.at + turned(place - at) * alpha - (place - at) * omega.powi(2);
    let lead_alpha = |(lead, [_, far]): &Outer| lead.turning([acceleration(lead.ends[0]), *far]);
    let leads = [0, 1, 2].map(|k| (all[k].0.link, lead_omegas[k], lead_alpha(&all[k])));
    Ok(Some(SingularPoint {
        class: 3,
        at,
        velocity,
        accelerations: vec![found.at],
        acceleration: AssurAcceleration::Known(found),
        links: std::iter::once((base, omega, alpha)).chain(leads).collect(),
        leads: [first.clone(), second.clone()],
    }))
}

/// The base link, and its three leads.
fn parts(mechanism: &Mechanism, group: &Group, motions: &[Motion]) -> Option<(LinkId, [Outer; 3])> {
    let joints = mechanism.joints();
    let is_inner = |link: LinkId| group.inner.iter().filter(|&&joint| joints[joint].on(link).is_some()).count() == 3;
    let pins = group.inner.iter().chain(&group.outer).all(|&joint| joints[joint].is_pin());
    if group.class != 3 || group.order() != 3 || group.links.len() != 4 || !pins || !group.trains.is_empty() {
        return None;
    }
    let base = *group.links.iter().find(|&&link| is_inner(link))?;
    let lead = |outer: &JointId| {
        let outer = &joints[*outer];
        let own = [outer.first, outer.second].into_iter().find(|side| group.links.contains(&side.link))?;
        let (link, known) = (own.link, outer.other(own.link));
        let inner = joints[mechanism.joint_between(link, base)?].clone();
        let names = [named(mechanism, link, &inner)?, named(mechanism, link, outer)?];
        let far = &motions[known.link];
        let ends = [motions[link].point(inner.on(link)?), far.point(known.local)];
        Some((lead(link, names, ends), [far.point_velocity(known.local), far.point_acceleration(known.local)]))
    };
    Some((base, [lead(&group.outer[0])?, lead(&group.outer[1])?, lead(&group.outer[2])?]))
}
