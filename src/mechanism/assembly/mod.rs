//! The pose at t = 0: the crank at its angle, then group after group in its assembly mode.
//!
//! Dyads are placed by intersecting two circles, groups of four links by the zeros of a trigonometric polynomial, which misses
//! none of their configurations. The formulas here are the trunk's own: the analytic solvers neither
//! provide nor use them, so that a slip in one of the three shows.

mod four_link;

use super::pose::SidePoint;
use super::{Group, GroupKind, LinkPose, Mechanism, Pose, Structure};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Vec2, cross, turned};

/// Which of its real configurations a group takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssemblyMode {
    /// Of a dyad: the inner joint lies to the left of the line from the first link's outer joint to the second link's.
    Left,
    /// Of a dyad: the inner joint lies to the right of that line.
    Right,
    /// Of an RRP or RPR dyad: measured along the axis of its prismatic pair, the inner joint lies ahead of the outer pin (RRP), or
    /// the outer pin of the pair's second link ahead of that of its first (RPR).
    Ahead,
    /// Of an RRP or RPR dyad: it lies behind.
    Behind,
    /// Of an RPP or PRP dyad, which has one configuration.
    Only,
    /// Of a higher group: the configuration of the start pose, followed from there.
    Followed,
}

impl AssemblyMode {
    /// The same configuration seen with a dyad's links in the other order.
    #[must_use]
    pub fn swapped(self) -> Self {
        match self {
            AssemblyMode::Left => AssemblyMode::Right,
            AssemblyMode::Right => AssemblyMode::Left,
            other => other,
        }
    }

    /// Name, as in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            AssemblyMode::Left => "left",
            AssemblyMode::Right => "right",
            AssemblyMode::Ahead => "ahead",
            AssemblyMode::Behind => "behind",
            AssemblyMode::Only => "only",
            AssemblyMode::Followed => "followed",
        }
    }
}

/// One real configuration of a group at a given pose of the links it hangs on.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Its mode.
    pub mode: AssemblyMode,
    /// Pose of each of the group's links, in the order of [`Group::links`].
    pub links: Vec<LinkPose>,
}

/// What is asked of one group's first pose. The links stand in the order of [`Group::links`].
#[derive(Clone, Debug, PartialEq, Default)]
pub struct StartGroup {
    /// Assembly mode asked for.
    pub mode: Option<AssemblyMode>,
    /// A point of one of the group's links and where it roughly is (m).
    pub near: Option<(SidePoint, Vec2)>,
}

/// Pose at the start, with the driving links at the world angles `drive_angles` (rad, in the order of
/// [`Structure::drivers`]) and each group as asked in `wanted` (in the order of [`Structure::groups`]); and the
/// assembly mode of each group.
///
/// # Errors
/// [`ErrorKind::Geometry`] if a group's links do not reach each other, if a guess fits both modes or contradicts the
/// mode asked for; [`ErrorKind::Unsupported`] for groups of more than four links; [`ErrorKind::Input`] if a group is asked for nothing.
pub fn first_pose(
    mechanism: &Mechanism,
    structure: &Structure,
    drive_angles: &[f64],
    wanted: &[StartGroup],
) -> Result<(Pose, Vec<AssemblyMode>)> {
    let mut pose = Pose(vec![LinkPose::GROUND; mechanism.links().len()]);
    for (&(link, joint), &angle) in structure.drivers.iter().zip(drive_angles) {
        let joint = &mechanism.joints()[joint];
        let base = joint.other(link);
        let local = joint.on(link).expect("the driven joint is on the driving link");
        pose.0[link] = LinkPose::through(local, pose.0[base.link].point(base.local), angle);
    }
    let mut modes = Vec::with_capacity(structure.groups.len());
    for (group, wanted) in structure.groups.iter().zip(wanted) {
        modes.push(
            place(mechanism, group, wanted, &mut pose)
                .map_err(|error| error.key(format!("start.groups ({})", group.names(mechanism))))?,
        );
    }
    Ok((pose, modes))
}

/// Signed area of a dyad's triangle (first outer, second outer, inner joint) over the product of its two link lengths:
/// the sine of the transmission angle, positive in the mode [`AssemblyMode::Left`]. Higher groups have none.
#[must_use]
pub fn transmission_sine(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Option<f64> {
    if group.kind != GroupKind::Rrr {
        return None;
    }
    let at = |joint: usize| {
        let side = mechanism.joints()[joint].first;
        pose.0[side.link].point(side.local)
    };
    let inner = at(group.inner[0]);
    let (a, b) = (inner - at(group.outer[0]), inner - at(group.outer[1]));
    Some(cross(a, b) / (a.norm() * b.norm()))
}

/// All real configurations of a group, once the links it hangs on are posed in `pose`: up to two of a dyad, up to six
/// of a group of four links.
///
/// # Errors
/// [`ErrorKind::Geometry`] if there is none; [`ErrorKind::Unsupported`] for groups of more than four links.
pub fn configurations(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Result<Vec<Configuration>> {
    match group.kind {
        GroupKind::Rrr => dyad(mechanism, group, pose),
        _ => four_link::configurations(mechanism, group, pose),
    }
}

fn place(mechanism: &Mechanism, group: &Group, wanted: &StartGroup, pose: &mut Pose) -> Result<AssemblyMode> {
    let all = configurations(mechanism, group, pose)?;
    let chosen = match (wanted.mode, &wanted.near) {
        (None, None) => return Err(nothing_asked(group)),
        (Some(mode), None) => all.iter().find(|one| one.mode == mode).ok_or_else(|| nothing_asked(group))?,
        (mode, Some((point, guess))) => {
            let nearest = nearest(mechanism, group, &all, point, *guess)?;
            match mode {
                Some(mode) if mode != nearest.mode => return Err(contradiction(point, mode)),
                _ => nearest,
            }
        }
    };
    for (&link, &place) in group.links.iter().zip(&chosen.links) {
        pose.0[link] = place;
    }
    Ok(chosen.mode)
}

fn nothing_asked(group: &Group) -> Error {
    let near = "`near = { point = \"...\", x_mm = ..., y_mm = ... }`";
    if group.kind == GroupKind::Rrr {
        Error::new(ErrorKind::Input, "neither an assembly mode nor a rough place is given for this group")
            .help(format!("add `mode = \"left\"` or `mode = \"right\"`, or {near}"))
    } else {
        Error::new(ErrorKind::Input, "no rough place is given for this group, which has up to six configurations")
            .help(format!("add {near}"))
    }
}

fn contradiction(point: &SidePoint, mode: AssemblyMode) -> Error {
    Error::new(
        ErrorKind::Geometry,
        format!(
            "the rough place of point \"{}\" lies nearer to another configuration than to mode {}",
            point.name,
            mode.name()
        ),
    )
    .help("correct the mode or the rough place; the wrong branch is never chosen silently")
}

fn nearest<'a>(
    mechanism: &Mechanism,
    group: &Group,
    all: &'a [Configuration],
    point: &SidePoint,
    guess: Vec2,
) -> Result<&'a Configuration> {
    let index =
        group.links.iter().position(|&link| link == point.side.link).expect("the point is on a link of the group");
    let distance = |one: &Configuration| (one.links[index].point(point.side.local) - guess).norm();
    let mut order: Vec<(f64, &Configuration)> = all.iter().map(|one| (distance(one), one)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    // A guess that is less than twice as near to one configuration as to the next does not tell them apart; nor does it
    // if it lies beyond the mechanism from all of them.
    if let [(first, a), (second, b), ..] = order[..]
        && 2.0 * first > second
    {
        return Err(Error::new(
            ErrorKind::Geometry,
            format!(
                "the rough place of point \"{}\" is {first:.4} m from the {} and {second:.4} m from the {} configuration: it does not tell them apart",
                point.name,
                named(a.mode, "nearest"),
                named(b.mode, "next")
            ),
        )
        .help("give a place nearer to the configuration you mean, or its mode"));
    }
    let size = mechanism.size();
    match order[..] {
        [(first, one), ..] if first <= size => Ok(one),
        [(first, _), ..] => Err(Error::new(
            ErrorKind::Geometry,
            format!("the rough place of point \"{}\" is {first:.4} m from the nearest configuration, farther than the longest link", point.name),
        )
        .help("check its coordinates and their unit")),
        [] => unreachable!("a group without configurations is an error before"),
    }
}

/// The mode of a dyad; for higher groups, whose configurations have no names, `rank`.
fn named(mode: AssemblyMode, rank: &'static str) -> &'static str {
    if mode == AssemblyMode::Followed { rank } else { mode.name() }
}

/// Both configurations of an RRR dyad: its inner joint is where the circles about its outer joints meet.
fn dyad(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Result<Vec<Configuration>> {
    let [first, second] = [0, 1].map(|k| {
        let link = group.links[k];
        let outer = &mechanism.joints()[group.outer[k]];
        let inner = mechanism.joints()[group.inner[0]].on(link).expect("the inner joint is on both links");
        let outer_local = outer.on(link).expect("the outer joint is on its link");
        let base = outer.other(link);
        (outer_local, inner, pose.0[base.link].point(base.local))
    });
    let (radius_1, radius_2) = ((first.1 - first.0).norm(), (second.1 - second.0).norm());
    let base = second.2 - first.2;
    let distance = base.norm();
    let along = (distance * distance + radius_1 * radius_1 - radius_2 * radius_2) / (2.0 * distance);
    let across_squared = (radius_1 - along) * (radius_1 + along);
    if !(across_squared >= 0.0 && distance > 0.0) {
        return Err(Error::new(
            ErrorKind::Geometry,
            format!(
                "the dyad cannot be assembled: its outer joints are {distance:.6} m apart, its links span {:.6} to {:.6} m",
                (radius_1 - radius_2).abs(),
                radius_1 + radius_2
            ),
        )
        .help("check the lengths and the ground points, or start at a crank angle that can be reached"));
    }
    let direction = base / distance;
    let across = turned(direction) * across_squared.sqrt();
    let one = |mode: AssemblyMode, across: Vec2| {
        let inner = first.2 + direction * along + across;
        let links = [first, second]
            .map(|(outer_local, inner_local, outer)| LinkPose::between(outer_local, inner_local, outer, inner));
        Configuration { mode, links: links.into() }
    };
    Ok(vec![one(AssemblyMode::Left, across), one(AssemblyMode::Right, -across)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::fixtures::four_bar;
    use approx::assert_relative_eq;

    fn start(wanted: StartGroup) -> Result<(Pose, Vec<AssemblyMode>)> {
        let mechanism = four_bar();
        let structure = Structure::of(&mechanism, &[0]).unwrap();
        first_pose(&mechanism, &structure, &[std::f64::consts::FRAC_PI_2], &[wanted])
    }

    fn point_b(pose: &Pose) -> Vec2 {
        pose.0[2].point(Vec2::new(4.0, 0.0))
    }

    #[test]
    fn both_modes_close_and_mirror_each_other() {
        let mechanism = four_bar();
        let mode = |mode| start(StartGroup { mode: Some(mode), near: None }).unwrap().0;
        let (left, right) = (mode(AssemblyMode::Left), mode(AssemblyMode::Right));
        assert!(left.closure(&mechanism) < 1e-15 && right.closure(&mechanism) < 1e-15);
        // A = (0, 1), C = (4, 0): B of the two modes mirrors at the line AC.
        let (a, axis) = (Vec2::new(0.0, 1.0), Vec2::new(4.0, -1.0).normalize());
        let mirrored = a + axis * (2.0 * axis.dot(&(point_b(&left) - a))) - (point_b(&left) - a);
        assert_relative_eq!(mirrored, point_b(&right), epsilon = 1e-14);
        assert!(cross(Vec2::new(4.0, -1.0), point_b(&left) - a) > 0.0);
    }

    #[test]
    fn a_guess_chooses_only_when_it_is_clear() {
        let near = |x, y| {
            Some((
                SidePoint { name: "B".into(), side: crate::mechanism::Side { link: 3, local: Vec2::new(3.0, 0.0) } },
                Vec2::new(x, y),
            ))
        };
        let left = start(StartGroup { mode: Some(AssemblyMode::Left), near: None }).unwrap().0;
        let b = point_b(&left);
        let (_, modes) = start(StartGroup { mode: None, near: near(b.x + 0.1, b.y) }).unwrap();
        assert_eq!(modes, [AssemblyMode::Left]);
        let error = start(StartGroup { mode: None, near: near(2.0, 0.5) }).unwrap_err();
        assert!(error.to_string().contains("does not tell them apart"), "{error}");
        let error = start(StartGroup { mode: Some(AssemblyMode::Right), near: near(b.x, b.y) }).unwrap_err();
        assert!(error.to_string().contains("nearer to another configuration"), "{error}");
        assert_eq!(start(StartGroup::default()).unwrap_err().kind(), ErrorKind::Input);
    }

    #[test]
    fn links_that_do_not_reach_are_an_error_with_the_distances() {
        let mut mechanism = four_bar();
        mechanism.joints[2].second.local = Vec2::new(0.05, 0.0);
        let structure = Structure::of(&mechanism, &[0]).unwrap();
        let wanted = [StartGroup { mode: Some(AssemblyMode::Left), near: None }];
        let error = first_pose(&mechanism, &structure, &[0.0], &wanted).unwrap_err();
        assert!(error.to_string().contains("3.000000 m apart, its links span 3.950000 to 4.050000 m"), "{error}");
    }
}
