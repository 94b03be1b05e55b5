//! The pose at t = 0: the crank at its angle, then group after group in its assembly mode.
//!
//! Dyads are placed by intersecting two circles. The formulas here are the trunk's own: the analytic solvers neither
//! provide nor use them, so that a slip in one of the three shows.

use super::pose::SidePoint;
use super::{Group, GroupKind, LinkPose, Mechanism, Pose, Structure};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Vec2, cross, turned};

/// Which of the two real configurations a dyad takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssemblyMode {
    /// The inner joint lies to the left of the line from the first link's outer joint to the second link's.
    Left,
    /// The inner joint lies to the right of that line.
    Right,
}

impl AssemblyMode {
    /// +1 for left, -1 for right: the sign of the signed area (first outer, second outer, inner joint).
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            AssemblyMode::Left => 1.0,
            AssemblyMode::Right => -1.0,
        }
    }

    /// The same configuration seen with the dyad's links in the other order.
    #[must_use]
    pub fn swapped(self) -> Self {
        match self {
            AssemblyMode::Left => AssemblyMode::Right,
            AssemblyMode::Right => AssemblyMode::Left,
        }
    }
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
/// mode asked for; [`ErrorKind::Unsupported`] for groups above class II; [`ErrorKind::Input`] if a group is asked for nothing.
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
/// the sine of the transmission angle, positive in the mode [`AssemblyMode::Left`].
#[must_use]
pub fn transmission_sine(mechanism: &Mechanism, group: &Group, pose: &Pose) -> f64 {
    let at = |joint: usize| {
        let side = mechanism.joints()[joint].first;
        pose.0[side.link].point(side.local)
    };
    let inner = at(group.inner[0]);
    let (a, b) = (inner - at(group.outer[0]), inner - at(group.outer[1]));
    cross(a, b) / (a.norm() * b.norm())
}

fn place(mechanism: &Mechanism, group: &Group, wanted: &StartGroup, pose: &mut Pose) -> Result<AssemblyMode> {
    if group.kind != GroupKind::Rrr {
        return Err(Error::new(
            ErrorKind::Unsupported,
            format!(
                "the group is of class {} and order {}; only RRR dyads are solved so far",
                group.class,
                group.order()
            ),
        )
        .help("drive another link: that may turn the group into dyads (`linkproof inspect` shows the groups)"));
    }
    let mode = match (wanted.mode, &wanted.near) {
        (None, None) => return Err(nothing_asked()),
        (Some(mode), None) => mode,
        (mode, Some((point, guess))) => {
            let nearest = nearest_mode(mechanism, group, pose, point, *guess)?;
            match mode {
                Some(mode) if mode != nearest => return Err(contradiction(point, mode)),
                _ => nearest,
            }
        }
    };
    place_dyad(mechanism, group, mode, pose)?;
    Ok(mode)
}

fn nothing_asked() -> Error {
    Error::new(ErrorKind::Input, "neither an assembly mode nor a rough place is given for this group")
        .help("add `mode = \"left\"` or `mode = \"right\"`, or `near = { point = \"...\", x_mm = ..., y_mm = ... }`")
}

fn contradiction(point: &SidePoint, mode: AssemblyMode) -> Error {
    Error::new(
        ErrorKind::Geometry,
        format!(
            "the rough place of point \"{}\" lies nearer to the other configuration than to mode {mode:?}",
            point.name
        ),
    )
    .help("correct the mode or the rough place; the wrong branch is never chosen silently")
}

fn nearest_mode(
    mechanism: &Mechanism,
    group: &Group,
    pose: &Pose,
    point: &SidePoint,
    guess: Vec2,
) -> Result<AssemblyMode> {
    let distance = |mode: AssemblyMode| -> Result<f64> {
        let mut trial = pose.clone();
        place_dyad(mechanism, group, mode, &mut trial)?;
        Ok((trial.0[point.side.link].point(point.side.local) - guess).norm())
    };
    let (left, right) = (distance(AssemblyMode::Left)?, distance(AssemblyMode::Right)?);
    // A guess that is less than twice as near to one configuration as to the other does not tell them apart.
    if 2.0 * left.min(right) > left.max(right) {
        return Err(Error::new(
            ErrorKind::Geometry,
            format!(
                "the rough place of point \"{}\" is {left:.4} m from the left and {right:.4} m from the right configuration: it does not tell them apart",
                point.name
            ),
        )
        .help("give a place nearer to the configuration you mean, or its mode"));
    }
    Ok(if left < right { AssemblyMode::Left } else { AssemblyMode::Right })
}

/// Places an RRR dyad: its inner joint is where the circles about its outer joints meet, on the side that `mode` names.
fn place_dyad(mechanism: &Mechanism, group: &Group, mode: AssemblyMode, pose: &mut Pose) -> Result<()> {
    let [first, second] = [0, 1].map(|k| {
        let link = group.links[k];
        let outer = &mechanism.joints()[group.outer[k]];
        let inner = mechanism.joints()[group.inner[0]].on(link).expect("the inner joint is on both links");
        let outer_local = outer.on(link).expect("the outer joint is on its link");
        let base = outer.other(link);
        (link, outer_local, inner, pose.0[base.link].point(base.local))
    });
    let (radius_1, radius_2) = ((first.2 - first.1).norm(), (second.2 - second.1).norm());
    let base = second.3 - first.3;
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
    let inner = first.3 + direction * along + turned(direction) * (mode.sign() * across_squared.sqrt());
    for (link, outer_local, inner_local, outer) in [first, second] {
        let (local, world) = (inner_local - outer_local, inner - outer);
        let angle = cross(local, world).atan2(local.dot(&world));
        pose.0[link] = LinkPose::through(outer_local, outer, angle);
    }
    Ok(())
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
        assert!(error.to_string().contains("nearer to the other configuration"), "{error}");
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
