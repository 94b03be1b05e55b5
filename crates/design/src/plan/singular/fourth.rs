//! Groups of class IV and order 2: two base links on the outer joints A and K, and two leads BD and CE between them.
//!
//! S is the intersection of the lines BD and CE. S is regarded as a point of one base link, then of the other.
//! On each base link, S and the end of a lead have the same velocity component along this lead: the line of the lead
//! goes through S, and the rotation of the link changes only the component across this line.
//! Both ends of a rigid lead also have the same velocity component along it.
//! Two components determine a vector, so S has equal velocities on both base links:
//! v_S = v_A + omega2 x AS = v_K + omega5 x KS.
//! The directions of omega2 x AS and omega5 x KS are known, so v_S is the intersection of two lines.
//! The accelerations of S on the two base links differ by d.
//! Along the lead BD (unit vector u), d . u = omega5^2 (D - S) . u - omega2^2 (B - S) . u - omega3^2 |BD|.
//! Along CE, an equation of the same form holds with the quantities of CE. The two equations determine d.
//! The equation a_A + ... + d = a_K + ... of the accelerations is then solved like the equation of the velocities.
//!
//! The drawing uses two false positions instead of this equation.
//! Two values of the angular acceleration of the base link KDE are assumed. Each value determines, by way of the leads,
//! an acceleration of S as a point of the base link ACB.
//! The acceleration of S depends linearly on the assumed value.
//! The ends of these accelerations therefore lie on one line, the line of false positions.
//! As a point of ACB, S has the acceleration a_A + normal part + tangential part.
//! The tangential part is across AS and has an unknown length. The end of the acceleration therefore lies on a second
//! line, the line of true positions.
//! The two lines meet at the end of the true acceleration.

use super::leads::{lead, named};
use super::point::{
    AssurAcceleration, AssurLead, FalsePositions, PARALLEL, SingularPoint, meeting, oblique, trial, wrong,
};
use crate::sentences;
use drawing::paper::scale::round_up;
use linkage::error::Result;
use linkage::math::{KeepNan, Motion, Vec2, cross, turned};
use linkage::mechanism::{GROUND, Group, JointId, LinkId, Mechanism};

/// A base link; position, velocity and acceleration of its outer joint; and the link outside the group at this joint.
struct Base {
    link: LinkId,
    outer: [Vec2; 3],
    beyond: LinkId,
}

/// The singular point of a group of class IV and order 2; `None` for other groups.
///
/// # Errors
/// [`linkage::error::ErrorKind::Geometry`] at a dead point: the leads are parallel, or the point is in line with the
/// outer joints.
pub(super) fn point(mechanism: &Mechanism, group: &Group, motions: &[Motion]) -> Result<Option<SingularPoint>> {
    let Some((bases, mut leads)) = parts(mechanism, group, motions) else { return Ok(None) };
    let both = leads.each_ref();
    if !(cross(both[0].along, both[1].along).abs() > PARALLEL) {
        return Err(wrong(both, " and ", |names| sentences::the_leads_are_parallel_their(&names)));
    }
    let at = meeting(both);
    let arms = bases.each_ref().map(|base| at - base.outer[0]);
    let dead = cross(arms[0], arms[1]) / (arms[0].norm() * arms[1].norm());
    if !(dead.abs() > PARALLEL) {
        return Err(wrong(both, " x ", |names| sentences::the_singular_point_lies_in_line(&names)));
    }
    // Solves turned(arm1) w1 - turned(arm2) w2 = r for w1 and w2. The dot product with an arm eliminates the unknown of
    // this arm.
    let spins = |r: Vec2| {
        let turn = turned(arms[0]).dot(&arms[1]);
        [r.dot(&arms[1]) / turn, r.dot(&arms[0]) / turn]
    };
    let omegas = spins(bases[1].outer[1] - bases[0].outer[1]);
    let field = |side: usize, place: Vec2| turned(place - bases[side].outer[0]) * omegas[side] + bases[side].outer[1];
    for lead in &mut leads {
        lead.velocities = [0, 1].map(|side| field(side, lead.ends[side]));
    }
    let both = leads.each_ref();
    let lead_omegas = both.map(|lead| lead.turning(lead.velocities));
    let along = |index: usize| {
        let lead = both[index];
        let [b, d] = lead.ends.map(|end| (end - at).dot(&lead.along));
        omegas[1].powi(2) * d - omegas[0].powi(2) * b - lead_omegas[index].powi(2) * lead.length()
    };
    let step = oblique(both, [along(0), along(1)]);
    let centripetal = |side: usize| bases[side].outer[2] - arms[side] * omegas[side].powi(2);
    let alphas = spins(centripetal(1) - centripetal(0) - step);
    let accelerations = [0, 1].map(|side| centripetal(side) + turned(arms[side]) * alphas[side]);
    let acceleration = |side: usize, place: Vec2, alpha: f64| {
        let arm = place - bases[side].outer[0];
        bases[side].outer[2] + turned(arm) * alpha - arm * omegas[side].powi(2)
    };
    let lead_alpha =
        |lead: &AssurLead| lead.turning([0, 1].map(|side| acceleration(side, lead.ends[side], alphas[side])));
    let links = vec![
        (bases[0].link, omegas[0], alphas[0]),
        (bases[1].link, omegas[1], alphas[1]),
        (leads[0].link, lead_omegas[0], lead_alpha(&leads[0])),
        (leads[1].link, lead_omegas[1], lead_alpha(&leads[1])),
    ];
    let by_trials = {
        let trials = assumed(omegas[1]).map(|alpha| {
            let far = both.map(|lead| acceleration(1, lead.ends[1], alpha));
            let feet = [0, 1].map(|k| both[k].foot(at, far[k], lead_omegas[k], omegas[0]));
            (alpha, trial(both, far, feet))
        });
        let foot = centripetal(0);
        let [(first, one), (second, other)] = &trials;
        let share = (foot - one.at).dot(&arms[0]) / (other.at - one.at).dot(&arms[0]);
        let found = one.at + (other.at - one.at) * share;
        let turning = cross(arms[0], found - foot) / arms[0].norm_squared();
        let alphas = [first + (second - first) * share, turning];
        FalsePositions { driver: bases[1].link, trials, outer: bases[0].outer[2], foot, at: found, alphas }
    };
    Ok(Some(SingularPoint {
        class: 4,
        at,
        velocity: field(0, at),
        accelerations: accelerations.to_vec(),
        acceleration: AssurAcceleration::FalsePositions(by_trials),
        leads,
        links,
    }))
}

/// Assumed angular accelerations (rad/s^2) of a link with the angular velocity `omega` (rad/s): zero, and the square of
/// `omega`, rounded up.
fn assumed(omega: f64) -> [f64; 2] {
    [0.0, round_up(omega.powi(2).larger(f64::MIN_POSITIVE))]
}

/// The base links and the leads between them. If only one base link is hinged to the ground, this link is the second.
fn parts(mechanism: &Mechanism, group: &Group, motions: &[Motion]) -> Option<([Base; 2], [AssurLead; 2])> {
    let base = |&joint: &JointId| {
        let joint = &mechanism.joints()[joint];
        let own = [joint.first, joint.second].into_iter().find(|side| group.links.contains(&side.link))?;
        let known = joint.other(own.link);
        let (motion, place) = (&motions[known.link], known.local);
        let outer = [motion.point(place), motion.point_velocity(place), motion.point_acceleration(place)];
        Some(Base { link: own.link, outer, beyond: known.link })
    };
    if group.class != 4 || group.order() != 2 || group.links.len() != 4 {
        return None;
    }
    let mut bases = [base(&group.outer[0])?, base(&group.outer[1])?];
    if bases[0].beyond == GROUND && bases[1].beyond != GROUND {
        bases.swap(0, 1);
    }
    let lead = |link: LinkId| {
        let end = |base: LinkId| {
            let joint = group.inner.iter().map(|&j| &mechanism.joints()[j]);
            let joint = joint.into_iter().find(|j| j.on(link).is_some() && j.other(link).link == base)?;
            Some((named(mechanism, link, joint)?, motions[link].point(joint.on(link)?)))
        };
        let ((near, b), (far, d)) = (end(bases[0].link)?, end(bases[1].link)?);
        Some(lead(link, [near, far], [b, d]))
    };
    let mut leads = group.links.iter().filter(|&&link| bases.iter().all(|base| base.link != link)).map(|&l| lead(l));
    let leads = [leads.next()??, leads.next()??];
    Some((bases, leads))
}
