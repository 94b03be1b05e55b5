//! All real configurations of an Assur group of four links, with any revolute and prismatic pairs.
//!
//! Assur groups of four links are of two kinds.
//! In the class III group of order 3, three leads (binary links) connect a base link with the links before the group.
//! The class IV group of order 2 is a movable quadrilateral of two ternary and two binary links.
//! In class IV, one ternary link is taken as the frame and the second ternary link as the base.
//! Relative to the frame, the base is then also connected by three leads.
//! The three leads are the two binary links and the world (all links before the group, taken as one body).

use super::mode::{AssemblyMode, Configuration};
use super::three_leads::{Conditions, LeadPair, PairEnd, PlatformLead};
use crate::error::{Error, ErrorKind, Result};
use crate::math::angle::wrapped;
use crate::math::{Vec2, rotated, unit};
use crate::mechanism::{Group, JointId, LinkId, LinkPose, Mechanism, Pose};
use crate::sentences;
use std::f64::consts::TAU;

#[cfg(test)]
mod tests;

/// A body of the layout: a link of the group, or the links before the group as one body.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Body {
    Link(LinkId),
    World,
}

/// The group as a base that is connected by three leads.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    frame: Body,
    base: LinkId,
    leads: [(Body, PlatformLead); 3],
}

impl Layout {
    /// Assigns the roles of the links; `None` if the group is of neither kind (class III or class IV).
    pub(super) fn of(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Option<Self> {
        if group.links.len() != 4 {
            return None;
        }
        let joints = mechanism.joints();
        let inner_of = |link: LinkId| group.inner.iter().copied().filter(move |&j| joints[j].on(link).is_some());
        let base_link = group.links.iter().copied().find(|&link| inner_of(link).count() == 3);
        let ends: Vec<LinkId> =
            group.links.iter().copied().filter(|&link| group.outer_on(mechanism, link).is_some()).collect();
        let (frame, base) = match (base_link, &ends[..]) {
            (Some(base), _) => (Body::World, base),
            (None, &[first, last]) => (Body::Link(first), last),
            _ => return None,
        };
        let body_of = |link: LinkId| if group.links.contains(&link) { Body::Link(link) } else { Body::World };
        let end = |joint: JointId, body: Body| {
            let joint = &joints[joint];
            let side = [joint.first, joint.second].into_iter().find(|side| body_of(side.link) == body)?;
            let axis = joint.axis_on(side.link).unwrap_or_else(Vec2::zeros);
            Some(match body {
                Body::Link(_) => PairEnd { place: side.local, axis },
                Body::World => {
                    let hung_on = pose.0[side.link];
                    PairEnd { place: hung_on.point(side.local), axis: rotated(unit(hung_on.angle), axis) }
                }
            })
        };
        // The joint between two bodies, if there is exactly one.
        let between = |a: Body, b: Body| {
            let both = |&&joint: &&JointId| end(joint, a).is_some() && end(joint, b).is_some();
            let mut found = group.inner.iter().chain(&group.outer).filter(both);
            found.next().copied().filter(|_| found.next().is_none())
        };
        let lead = |body: Body| {
            let pair = |other: Body| {
                let joint = between(body, other)?;
                Some(LeadPair { slides: joints[joint].slides(), lead: end(joint, body)?, body: end(joint, other)? })
            };
            Some((body, PlatformLead { near: pair(frame)?, far: pair(Body::Link(base))? }))
        };
        let bodies = group.links.iter().map(|&link| Body::Link(link)).chain([Body::World]);
        let mut bodies = bodies.filter(|&body| body != frame && body != Body::Link(base));
        let leads = [lead(bodies.next()?)?, lead(bodies.next()?)?, lead(bodies.next()?)?];
        Some(Layout { frame, base, leads })
    }

    /// Poses of the four links, in the order of the group, computed from the base's pose in the frame.
    /// `None` if a lead can slide freely.
    fn poses(&self, group: &Group, base: &LinkPose) -> Option<Vec<LinkPose>> {
        let mut in_frame = Vec::with_capacity(3);
        for (body, lead) in &self.leads {
            in_frame.push((*body, lead.near.lead.place, lead.pose(base)?));
        }
        let frame = match in_frame.iter().find(|(body, ..)| *body == Body::World) {
            // The world is one of the leads, so its pose relative to the frame is known.
            // The position of the frame in the world follows from a point with known coordinates in both.
            Some((_, place, world)) => LinkPose::through(world.point(*place), *place, -world.angle),
            None => LinkPose::GROUND,
        };
        in_frame.push((Body::Link(self.base), self.leads[0].1.far.body.place, *base));
        let pose = |&link: &LinkId| {
            if self.frame == Body::Link(link) {
                return LinkPose { angle: wrapped(frame.angle), ..frame };
            }
            let (_, place, own) =
                in_frame.iter().find(|(body, ..)| *body == Body::Link(link)).expect("all links are posed");
            LinkPose::through(*place, frame.point(own.point(*place)), wrapped(own.angle + frame.angle))
        };
        Some(group.links.iter().map(pose).collect())
    }
}

/// All real configurations of the group, sorted by the angle of its base.
/// In class IV the base is the last ternary link.
///
/// # Errors
/// [`ErrorKind::Geometry`] if there is no configuration, or if the group can move while its outer joints are held.
/// [`ErrorKind::Unsupported`] if the group is neither of the two kinds that this module handles.
pub(super) fn configurations(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Result<Vec<Configuration>> {
    let layout = Layout::of(mechanism, group, pose).ok_or_else(|| {
        let (links, class) = (group.links.len(), group.class);
        Error::new(ErrorKind::Unsupported, sentences::the_configurations_of_a_group(&links, &class))
            .help(sentences::START_FROM_A_ROUGH_DRAWING)
    })?;
    let singular = || {
        Error::new(ErrorKind::Geometry, sentences::THE_GROUP_CAN_MOVE_WHILE).help(sentences::CHECK_THE_LENGTHS_AND_AXES)
    };
    let conditions = Conditions::of(&layout.leads.each_ref().map(|(_, lead)| *lead));
    let mut all = Vec::new();
    for base in conditions.base_poses().ok_or_else(singular)? {
        let links = layout.poses(group, &base).ok_or_else(singular)?;
        all.push(Configuration { mode: AssemblyMode::Followed, links });
    }
    if all.is_empty() {
        return Err(Error::new(ErrorKind::Geometry, sentences::THE_GROUP_CANNOT_BE_ASSEMBLED)
            .help(sentences::CHECK_THE_LENGTHS_AND_THE_GROUND));
    }
    let index = group.links.iter().position(|&link| link == layout.base).expect("the base is a link of the group");
    // For the order, each angle is reduced to the interval from just below zero to just below one turn.
    // A rounding error of an angle near zero then does not change the order.
    let rank = |one: &Configuration| (one.links[index].angle + 1e-9).rem_euclid(TAU);
    all.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
    Ok(all)
}
