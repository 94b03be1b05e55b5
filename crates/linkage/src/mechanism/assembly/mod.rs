//! The pose at t = 0: the crank at its angle, then group after group in its assembly mode.
//!
//! Dyads are placed in closed form, groups of four links by the zeros of a trigonometric polynomial, which misses
//! none of their configurations, all other groups by Newton's method from a rough drawing. The formulas here are the trunk's own: the
//! analytic solvers neither provide nor use them, so that a slip in one of the three shows.

mod choice;
mod dyads;
mod four_link;
#[cfg(test)]
mod random;
mod rough;
mod three_leads;

use super::pose::SidePoint;
use super::{Group, GroupKind, LinkPose, Mechanism, Pose, Structure};
use crate::error::Result;
use crate::math::Vec2;

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
    /// Place of the configuration asked for in the list of [`configurations`], counted from 1.
    pub rank: Option<usize>,
    /// Points of the group's links and where each roughly is (m).
    pub near: Vec<(SidePoint, Vec2)>,
}

/// Which configuration a group has taken at the start, and how clear that was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Its assembly mode.
    pub mode: AssemblyMode,
    /// Largest distance of its points from their rough places (m), if such were given.
    pub nearest_m: Option<f64>,
    /// The same of the next configuration (m), if there is one and all are known.
    pub next_m: Option<f64>,
}

/// Pose at the start, with the driving links at the world angles `drive_angles` (rad, in the order of
/// [`Structure::drivers`]) and each group as asked in `wanted` (in the order of [`Structure::groups`]); and the
/// assembly mode of each group.
///
/// # Errors
/// Those of [`first_choices`].
pub fn first_pose(
    mechanism: &Mechanism,
    structure: &Structure,
    drive_angles: &[f64],
    wanted: &[StartGroup],
) -> Result<(Pose, Vec<AssemblyMode>)> {
    let (pose, choices) = first_choices(mechanism, structure, drive_angles, wanted)?;
    Ok((pose, choices.into_iter().map(|choice| choice.mode).collect()))
}

/// As [`first_pose`], with what is known of each group's choice.
///
/// # Errors
/// [`ErrorKind::Geometry`](crate::ErrorKind::Geometry) if a group's links do not reach each other, if rough places fit two configurations,
/// contradict the mode asked for, or lead to none; [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) for a group whose
/// configurations are not all known and that is given no rough places; [`ErrorKind::Input`](crate::ErrorKind::Input) if a group is asked for
/// nothing, or for more configurations than it has.
pub fn first_choices(
    mechanism: &Mechanism,
    structure: &Structure,
    drive_angles: &[f64],
    wanted: &[StartGroup],
) -> Result<(Pose, Vec<Choice>)> {
    let mut pose = Pose(vec![LinkPose::GROUND; mechanism.links().len()]);
    for (&(link, joint), &angle) in structure.drivers.iter().zip(drive_angles) {
        let joint = &mechanism.joints()[joint];
        let base = joint.other(link);
        let local = joint.on(link).expect("the driven joint is on the driving link");
        pose.0[link] = LinkPose::through(local, pose.0[base.link].point(base.local), angle);
    }
    let mut choices = Vec::with_capacity(structure.groups.len());
    for (group, wanted) in structure.groups.iter().zip(wanted) {
        choices.push(
            choice::place(mechanism, group, wanted, &mut pose)
                .map_err(|error| error.key(format!("start.groups ({})", group.names(mechanism))))?,
        );
    }
    Ok((pose, choices))
}

/// Sine of a dyad's transmission angle in the given pose; higher groups have none. At zero the dyad is at a dead point.
///
/// - RRR: signed area of its triangle (first outer, second outer, inner joint) over the product of its two link lengths,
///   positive in the mode [`AssemblyMode::Left`].
/// - RRP: share of the rod along the guide, e . r / |r| with r from the outer pin to the inner joint: the sine of the angle between the
///   rod and the normal to the guide, positive in the mode [`AssemblyMode::Ahead`].
/// - RPR: share of the outer pins' distance along the guide, e . d / |d| with d from the outer pin of the pair's first link
///   to that of its second, positive in the mode [`AssemblyMode::Ahead`].
/// - RPP: e1 x e2 of the inner and the outer axis; PRP: of the outer axes, in the order of the group's links.
#[must_use]
pub fn transmission_sine(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Option<f64> {
    (group.kind != GroupKind::Higher).then(|| dyads::transmission_sine(mechanism, group, pose))
}

/// All real configurations of a group, once the links it hangs on are posed in `pose`: up to two of a dyad, up to six
/// of a group of four links.
///
/// # Errors
/// [`ErrorKind::Geometry`](crate::ErrorKind::Geometry) if there is none; [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) for
/// groups whose configurations are not all known: those of more than four links.
pub fn configurations(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Result<Vec<Configuration>> {
    match group.kind {
        GroupKind::Higher => four_link::configurations(mechanism, group, pose),
        _ => dyads::configurations(mechanism, group, pose),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use crate::fixtures::four_bar;
    use crate::math::cross;
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
        let mode = |mode| start(StartGroup { mode: Some(mode), ..StartGroup::default() }).unwrap().0;
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
            vec![(
                SidePoint { name: "B".into(), side: crate::mechanism::Side { link: 3, local: Vec2::new(3.0, 0.0) } },
                Vec2::new(x, y),
            )]
        };
        let left = start(StartGroup { mode: Some(AssemblyMode::Left), ..StartGroup::default() }).unwrap().0;
        let b = point_b(&left);
        let (_, modes) = start(StartGroup { mode: None, near: near(b.x + 0.1, b.y), ..StartGroup::default() }).unwrap();
        assert_eq!(modes, [AssemblyMode::Left]);
        let error = start(StartGroup { mode: None, near: near(2.0, 0.5), ..StartGroup::default() }).unwrap_err();
        assert!(error.to_string().contains("does not tell them apart"), "{error}");
        let error =
            start(StartGroup { mode: Some(AssemblyMode::Right), near: near(b.x, b.y), ..StartGroup::default() })
                .unwrap_err();
        assert!(error.to_string().contains("nearer to another configuration"), "{error}");
        assert_eq!(start(StartGroup::default()).unwrap_err().kind(), ErrorKind::Input);
    }

    #[test]
    fn links_that_do_not_reach_are_an_error_with_the_distances() {
        let mut mechanism = four_bar();
        mechanism.joints[2].second.local = Vec2::new(0.05, 0.0);
        let structure = Structure::of(&mechanism, &[0]).unwrap();
        let wanted = [StartGroup { mode: Some(AssemblyMode::Left), ..StartGroup::default() }];
        let error = first_pose(&mechanism, &structure, &[0.0], &wanted).unwrap_err();
        assert!(error.to_string().contains("3.000000 m apart, its links span 3.950000 to 4.050000 m"), "{error}");
    }
}
