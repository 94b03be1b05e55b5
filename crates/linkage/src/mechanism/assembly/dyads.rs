//! All configurations of the five dyads, and their transmission angles.
//!
//! A dyad has one outer joint on each link and the inner joint between the links. One scalar equation closes the dyad.
//! An RRR dyad closes at the intersections of two circles.
//! An RRP dyad closes at the intersections of a circle and a line. In the frame of its guide,
//! an RPR dyad closes in the same way.
//! RPP and PRP dyads close at the intersection of two lines.
//! A prismatic pair fixes the angle between its two links.
//! Relative to the first link, the joint's point of the second link moves along a line parallel to the axis.
//! This line goes through the joint's point on the first link.

#[cfg(test)]
mod tests;

use super::mode::{AssemblyMode, Configuration};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Vec2, cross, rotated, turned, unit};
use crate::mechanism::{Group, GroupKind, Joint, LinkId, LinkPose, Mechanism, Pose};
use crate::sentences;

/// Axes count as parallel if the sine of the angle between them is below this limit.
/// At this angle, rounding errors of the axes' directions move the links by more than 1e-4 of the mechanism's size.
const PARALLEL: f64 = 1e-12;

/// Angle (rad) that rotates `from` into the direction of `to`.
pub(super) fn turn(from: Vec2, to: Vec2) -> f64 {
    cross(from, to).atan2(from.dot(&to))
}

/// One link of a dyad with its two joints.
struct Member<'a> {
    link: LinkId,
    outer: &'a Joint,
    inner: &'a Joint,
    /// Pose of the link to which the outer joint is attached.
    base: LinkPose,
}

impl<'a> Member<'a> {
    /// Both links of a dyad, in the group's order.
    fn both(mechanism: &'a Mechanism, group: &Group, pose: &Pose) -> [Self; 2] {
        [0, 1].map(|k| {
            let (link, outer) = (group.links[k], &mechanism.joints()[group.outer[k]]);
            Member { link, outer, inner: &mechanism.joints()[group.inner[0]], base: pose.0[outer.other(link).link] }
        })
    }

    /// Position of the outer joint in the link's frame (m).
    fn outer_place(&self) -> Vec2 {
        self.outer.on(self.link).expect("the outer joint is on its link")
    }

    /// Position of the inner joint in the link's frame (m).
    fn inner_place(&self) -> Vec2 {
        self.inner.on(self.link).expect("the inner joint is on both links")
    }

    /// Vector from the outer joint to the inner joint, in the link's frame (m).
    fn span(&self) -> Vec2 {
        self.inner_place() - self.outer_place()
    }

    /// World position (m) of the outer joint, taken at its point on the link to which the dyad is attached.
    fn hook(&self) -> Vec2 {
        self.base.point(self.outer.other(self.link).local)
    }

    /// World direction of the axis of the link's outer joint, a prismatic pair.
    fn guide(&self) -> Vec2 {
        let axis = self.outer.axis_on(self.outer.other(self.link).link).expect("the outer pair is prismatic");
        rotated(unit(self.base.angle), axis)
    }

    /// Axis of a prismatic joint in the link's frame.
    fn axis_of(&self, joint: &Joint) -> Vec2 {
        joint.axis_on(self.link).expect("the pair is prismatic")
    }

    /// The link's angle (rad) at which the axis of the prismatic `joint` on this link has the world direction `axis`.
    fn angle(&self, joint: &Joint, axis: Vec2) -> f64 {
        turn(self.axis_of(joint), axis)
    }
}

/// All configurations of a dyad: `Left` before `Right`, `Ahead` before `Behind`.
///
/// # Errors
/// [`ErrorKind::Geometry`] if there is no configuration.
pub(super) fn configurations(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Result<Vec<Configuration>> {
    let members = Member::both(mechanism, group, pose);
    match group.kind {
        GroupKind::Rrr => rrr(&members),
        GroupKind::Rrp => rrp(&members),
        GroupKind::Rpr => rpr(&members),
        GroupKind::Rpp => rpp(&members),
        GroupKind::Prp => prp(&members),
        GroupKind::Higher | GroupKind::Driven => unreachable!("a dyad has two links"),
    }
}

/// Sine of a dyad's transmission angle, as [`super::transmission_sine`] describes it.
pub(super) fn transmission_sine(mechanism: &Mechanism, group: &Group, pose: &Pose) -> f64 {
    let members = Member::both(mechanism, group, pose);
    let inner = pose.0[members[0].link].point(members[0].inner_place());
    match group.kind {
        GroupKind::Rrr => {
            let [a, b] = members.map(|member| inner - member.hook());
            cross(a, b) / (a.norm() * b.norm())
        }
        GroupKind::Rrp => {
            let [rod, slider] = prismatic_last(&members);
            let arm = inner - rod.hook();
            slider.guide().dot(&arm) / arm.norm()
        }
        GroupKind::Rpr => {
            let [first, second] = in_pair_order(&members);
            let axis = rotated(unit(pose.0[first.link].angle), first.axis_of(first.inner));
            let base = second.hook() - first.hook();
            axis.dot(&base) / base.norm()
        }
        GroupKind::Rpp => {
            let [swivel, slider] = prismatic_last(&members);
            let axis = rotated(unit(pose.0[swivel.link].angle), swivel.axis_of(swivel.inner));
            cross(axis, slider.guide())
        }
        GroupKind::Prp => cross(members[0].guide(), members[1].guide()),
        GroupKind::Higher | GroupKind::Driven => unreachable!("a dyad has two links"),
    }
}

/// The two links of a dyad.
/// The link with the outer revolute pair comes first, the link with the outer prismatic pair second.
fn prismatic_last<'a, 'b>([a, b]: &'b [Member<'a>; 2]) -> [&'b Member<'a>; 2] {
    if a.outer.slides() { [b, a] } else { [a, b] }
}

/// The two links of a dyad in the order of the inner joint: the inner joint's first link comes first.
fn in_pair_order<'a, 'b>([a, b]: &'b [Member<'a>; 2]) -> [&'b Member<'a>; 2] {
    if a.inner.first.link == a.link { [a, b] } else { [b, a] }
}

/// A configuration with the poses of both links in the group's order. The order of the two entries of `poses` does not
/// matter.
fn configuration(members: &[Member; 2], mode: AssemblyMode, poses: [(LinkId, LinkPose); 2]) -> Configuration {
    let pose = |member: &Member| poses.iter().find(|(link, _)| *link == member.link).expect("both links are posed").1;
    Configuration { mode, links: members.iter().map(pose).collect() }
}

fn out_of_reach(what: String) -> Error {
    Error::new(ErrorKind::Geometry, sentences::the_dyad_cannot_be_assembled_2(&what))
        .help(sentences::CHECK_THE_LENGTHS_AND_THE_GROUND)
}

fn parallel(sine: f64) -> Error {
    Error::new(ErrorKind::Geometry, sentences::the_dyad_cannot_be_assembled(&format_args!("{sine:.1e}")))
        .help(sentences::CHECK_THE_AXES_OR_START_AT_A_CRANK)
}

/// The inner joint lies at an intersection of the circles about the outer joints.
fn rrr(members: &[Member; 2]) -> Result<Vec<Configuration>> {
    let [first, second] = members.each_ref().map(Member::hook);
    let [radius_1, radius_2] = members.each_ref().map(|member| member.span().norm());
    let base = second - first;
    let distance = base.norm();
    let along = (distance * distance + radius_1 * radius_1 - radius_2 * radius_2) / (2.0 * distance);
    let across_squared = (radius_1 - along) * (radius_1 + along);
    if !(across_squared >= 0.0 && distance > 0.0) {
        return Err(out_of_reach(sentences::its_outer_joints_are_apart_its_links(
            &distance,
            &(radius_1 - radius_2).abs(),
            &(radius_1 + radius_2),
        )));
    }
    let direction = base / distance;
    let across = turned(direction) * across_squared.sqrt();
    let one = |mode: AssemblyMode, across: Vec2| {
        let inner = first + direction * along + across;
        let pose =
            |member: &Member| LinkPose::between(member.outer_place(), member.inner_place(), member.hook(), inner);
        Configuration { mode, links: members.iter().map(pose).collect() }
    };
    Ok(vec![one(AssemblyMode::Left, across), one(AssemblyMode::Right, -across)])
}

/// The inner joint lies on a line parallel to the guide and on the rod's circle about the outer pin.
fn rrp(members: &[Member; 2]) -> Result<Vec<Configuration>> {
    let [rod, slider] = prismatic_last(members);
    let (axis, pin, length) = (slider.guide(), rod.hook(), rod.span().norm());
    let angle = slider.angle(slider.outer, axis);
    let height = cross(axis, slider.hook() + rotated(unit(angle), slider.span()) - pin);
    let along_squared = (length - height) * (length + height);
    if !(along_squared >= 0.0) {
        return Err(out_of_reach(sentences::its_inner_joint_slides_along(&height.abs(), &length)));
    }
    let one = |mode: AssemblyMode, along: f64| {
        let inner = pin + axis * along + turned(axis) * height;
        let poses = [
            (rod.link, LinkPose::between(rod.outer_place(), rod.inner_place(), pin, inner)),
            (slider.link, LinkPose::through(slider.inner_place(), inner, angle)),
        ];
        configuration(members, mode, poses)
    };
    let along = along_squared.sqrt();
    Ok(vec![one(AssemblyMode::Ahead, along), one(AssemblyMode::Behind, -along)])
}

/// The vector d leads from one outer pin to the other.
/// The component h of d perpendicular to the axis e is the difference of the pins' offsets from the axis: e x d = h.
/// The component along the axis is +sqrt(d^2 - h^2) or -sqrt(d^2 - h^2).
/// The direction e follows from d and these two components.
fn rpr(members: &[Member; 2]) -> Result<Vec<Configuration>> {
    let [first, second] = in_pair_order(members);
    let offset = |member: &Member| cross(member.axis_of(member.inner), member.span());
    let across = offset(first) - offset(second);
    let base = second.hook() - first.hook();
    let distance = base.norm();
    let along_squared = (distance - across) * (distance + across);
    if !(along_squared >= 0.0 && distance > 0.0) {
        return Err(out_of_reach(sentences::its_outer_joints_are_apart(&distance, &across.abs())));
    }
    let one = |mode: AssemblyMode, along: f64| {
        let axis = rotated(Vec2::new(along, -across), base) / (distance * distance);
        let pose = |member: &Member| {
            let angle = member.angle(member.inner, axis);
            (member.link, LinkPose::through(member.outer_place(), member.hook(), angle))
        };
        configuration(members, mode, [pose(first), pose(second)])
    };
    let along = along_squared.sqrt();
    Ok(vec![one(AssemblyMode::Ahead, along), one(AssemblyMode::Behind, -along)])
}

/// The guides determine the angles of the two links.
/// The slider is then moved along the outer axis until the inner joint closes: the line through the joint's two points
/// must be parallel to the inner axis.
fn rpp(members: &[Member; 2]) -> Result<Vec<Configuration>> {
    let [swivel, slider] = prismatic_last(members);
    let outer = slider.guide();
    let slider_angle = slider.angle(slider.outer, outer);
    let inner = rotated(unit(slider_angle), slider.axis_of(slider.inner));
    let sine = cross(inner, outer);
    if !(sine.abs() > PARALLEL) {
        return Err(parallel(sine));
    }
    let swivel_pose = LinkPose::through(swivel.outer_place(), swivel.hook(), swivel.angle(swivel.inner, inner));
    let start = LinkPose::through(slider.outer_place(), slider.hook(), slider_angle);
    let gap = swivel_pose.point(swivel.inner_place()) - start.point(slider.inner_place());
    let slide = cross(inner, gap) / sine;
    let slider_pose = LinkPose { origin: start.origin + outer * slide, angle: slider_angle };
    let poses = [(swivel.link, swivel_pose), (slider.link, slider_pose)];
    Ok(vec![configuration(members, AssemblyMode::Only, poses)])
}

/// The inner pin lies at the intersection of two lines: each slider moves the pin along a line.
fn prp(members: &[Member; 2]) -> Result<Vec<Configuration>> {
    let axes = members.each_ref().map(Member::guide);
    let sine = cross(axes[0], axes[1]);
    if !(sine.abs() > PARALLEL) {
        return Err(parallel(sine));
    }
    let angles = [0, 1].map(|k| members[k].angle(members[k].outer, axes[k]));
    let [first, second] = [0, 1].map(|k| members[k].hook() + rotated(unit(angles[k]), members[k].span()));
    let inner = first + axes[0] * (cross(second - first, axes[1]) / sine);
    let pose = |k: usize| (members[k].link, LinkPose::through(members[k].inner_place(), inner, angles[k]));
    Ok(vec![configuration(members, AssemblyMode::Only, [pose(0), pose(1)])])
}
