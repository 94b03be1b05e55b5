//! Singular Assur point of a class IV group of order 2: its velocities and accelerations without a system of equations.
//!
//! Two base links have the outer joints A and K; two leads BD and CE connect them.
//! The lines of the leads intersect in S, written S = BD x CE. S is treated as a point of either base link.
//! The velocity component of S along a lead equals that of the lead's end, because rotation adds no component along a
//! line through S.
//! Two components determine a vector, so S has equal velocities on both base links:
//! v_S = v_A + omega2 x AS = v_K + omega5 x KS.
//! The directions of omega2 x AS and omega5 x KS are known, so v_S is the intersection of two lines.
//! The accelerations of S on the two base links differ by d.
//! Along the lead BD (unit vector u), d . u = omega5^2 (D - S) . u - omega2^2 (B - S) . u - omega3^2 |BD|.
//! The same equation holds along CE with the quantities of that lead.
//! Then the equation a_A + ... + d = a_K + ... is solved by the construction that gives the velocities.

use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Motion, Vec2, cross, turned};
use linkage::mechanism::{Group, JointId, LinkId, Mechanism};

/// If the sine of the angle between two lines is below this limit, the lines count as parallel.
/// The intersection of such lines would have too few correct digits.
const PARALLEL: f64 = 1e-9;

/// Singular point of a group, with the motion computed through it.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularPoint {
    /// Names of the leads' ends, on the first and on the second base link: S = BD x CE.
    pub leads: [[String; 2]; 2],
    /// World position of the point (m).
    pub at: Vec2,
    /// Velocity of the point, on both base links (m/s).
    pub velocity: Vec2,
    /// Accelerations of the point on the first and on the second base link (m/s^2).
    pub accelerations: [Vec2; 2],
    /// Links with angular velocity (rad/s) and angular acceleration (rad/s^2): the two base links, then the two leads.
    pub links: [(LinkId, f64, f64); 4],
}

/// A lead between the two base links.
struct Lead {
    link: LinkId,
    names: [String; 2],
    ends: [Vec2; 2],
    along: Vec2,
    length: f64,
}

impl SingularPoint {
    /// Computes the singular point of `group`; `None` if the group is not of class IV and order 2.
    /// Of `motions`, only the poses of the group's links and the motions of the links before the group are used.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] at a dead point: the leads are parallel, or the point is in line with the outer joints.
    pub fn of(case: &Case, group: &Group, motions: &[Motion]) -> Result<Option<Self>> {
        let Some((bases, leads)) = parts(&case.mechanism, group, motions) else { return Ok(None) };
        let [first, second] = &leads;
        let slant = cross(first.along, second.along);
        if !(slant.abs() > PARALLEL) {
            return Err(wrong(&leads, " and ", |names| sentences::the_leads_are_parallel_their(&names)));
        }
        let at = first.ends[0] + first.along * (cross(second.ends[0] - first.ends[0], second.along) / slant);
        let outer = bases.map(|(_, known)| known);
        let arms = outer.map(|joint| at - joint[0]);
        let dead = cross(arms[0], arms[1]) / (arms[0].norm() * arms[1].norm());
        if !(dead.abs() > PARALLEL) {
            return Err(wrong(&leads, " x ", |names| sentences::the_singular_point_lies_in_line(&names)));
        }
        // Solves turned(arm1) w1 - turned(arm2) w2 = r for w1 and w2. The dot product with one arm eliminates one
        // unknown.
        let spins = |r: Vec2| {
            let turn = turned(arms[0]).dot(&arms[1]);
            [r.dot(&arms[1]) / turn, r.dot(&arms[0]) / turn]
        };
        let omegas = spins(outer[1][1] - outer[0][1]);
        let field = |side: usize, place: Vec2| turned(place - outer[side][0]) * omegas[side] + outer[side][1];
        let lead_omega = |lead: &Lead| {
            let relative = field(1, lead.ends[1]) - field(0, lead.ends[0]);
            cross(lead.along, relative) / lead.length
        };
        let lead_omegas = [lead_omega(first), lead_omega(second)];
        let along = |lead: &Lead, omega: f64| {
            let [b, d] = lead.ends.map(|end| (end - at).dot(&lead.along));
            omegas[1].powi(2) * d - omegas[0].powi(2) * b - omega.powi(2) * lead.length
        };
        let components = [along(first, lead_omegas[0]), along(second, lead_omegas[1])];
        // Vector whose components along two oblique directions are `components`.
        let step = (turned(first.along) * components[1] - turned(second.along) * components[0]) / slant;
        let centripetal = |side: usize| outer[side][2] - arms[side] * omegas[side].powi(2);
        let alphas = spins(centripetal(1) - centripetal(0) - step);
        let accelerations = [0, 1].map(|side| centripetal(side) + turned(arms[side]) * alphas[side]);
        let acceleration = |side: usize, place: Vec2| {
            let arm = place - outer[side][0];
            outer[side][2] + turned(arm) * alphas[side] - arm * omegas[side].powi(2)
        };
        let lead_alpha = |lead: &Lead| {
            cross(lead.along, acceleration(1, lead.ends[1]) - acceleration(0, lead.ends[0])) / lead.length
        };
        let links = [
            (bases[0].0, omegas[0], alphas[0]),
            (bases[1].0, omegas[1], alphas[1]),
            (first.link, lead_omegas[0], lead_alpha(first)),
            (second.link, lead_omegas[1], lead_alpha(second)),
        ];
        let names = [first.names.clone(), second.names.clone()];
        Ok(Some(SingularPoint { leads: names, at, velocity: field(0, at), accelerations, links }))
    }

    /// Formats the point in the usual notation: `BD x CE`.
    pub fn lines(&self) -> String {
        self.leads.each_ref().map(|[a, b]| super::names::pair(a, b)).join(" x ")
    }
}

type Base = (LinkId, [Vec2; 3]);

/// Returns the base links with position, velocity and acceleration of their outer joints, and the leads between them.
fn parts(mechanism: &Mechanism, group: &Group, motions: &[Motion]) -> Option<([Base; 2], [Lead; 2])> {
    let base = |&joint: &JointId| {
        let joint = &mechanism.joints()[joint];
        let own = [joint.first, joint.second].into_iter().find(|side| group.links.contains(&side.link))?;
        let known = joint.other(own.link);
        let motion = &motions[known.link];
        let place = known.local;
        Some((own.link, [motion.point(place), motion.point_velocity(place), motion.point_acceleration(place)]))
    };
    if group.class != 4 || group.order() != 2 || group.links.len() != 4 {
        return None;
    }
    let bases = [base(&group.outer[0])?, base(&group.outer[1])?];
    let lead = |link: LinkId| {
        let end = |base: LinkId| {
            let joint = group.inner.iter().map(|&j| &mechanism.joints()[j]);
            let joint = joint.into_iter().find(|j| j.on(link).is_some() && j.other(link).link == base)?;
            let local = joint.on(link)?;
            let named = mechanism.links()[link].points.iter().find(|point| point.local == local);
            let name = named.map_or(&joint.name, |point| &point.name).clone();
            Some((name, motions[link].point(local)))
        };
        let ((near, b), (far, d)) = (end(bases[0].0)?, end(bases[1].0)?);
        let length = (d - b).norm();
        Some(Lead { link, names: [near, far], ends: [b, d], along: (d - b) / length, length })
    };
    let mut leads = group.links.iter().filter(|&&link| bases.iter().all(|(base, _)| *base != link)).map(|&l| lead(l));
    Some((bases, [leads.next()??, leads.next()??]))
}

/// Error about the two leads. The message contains both leads, separated by `between`.
fn wrong(leads: &[Lead; 2], between: &str, message: impl FnOnce(String) -> String) -> Error {
    let names = leads.each_ref().map(|lead| super::names::pair(&lead.names[0], &lead.names[1]));
    Error::new(ErrorKind::Geometry, message(names.join(between))).help(sentences::TAKE_A_CRANK_ANGLE_A_LITTLE)
}
