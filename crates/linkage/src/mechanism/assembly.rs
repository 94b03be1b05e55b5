//! The pose at t = 0: first the crank at its angle, then each group in its assembly mode, in order of solution.
//!
//! Dyads are placed in closed form.
//! Groups of four links are placed by the zeros of a trigonometric polynomial, which give all configurations of the
//! group.
//! Groups of any other kind are placed by Newton's method from a rough drawing.
//! The formulas of this module are independent of the formulas of the two analytic solvers.
//! If the results of this module and of a solver differ, one of the two codes is therefore wrong.

mod blame;
mod choice;
mod configurations;
mod dyads;
mod four_link;
mod fused;
mod mode;
#[cfg(test)]
mod random;
mod rough;
mod three_leads;

pub use blame::{Blame, blame, blamed, group_of};
pub use configurations::{configurations, transmission_sine};
pub use mode::{AssemblyMode, Configuration, ConfigurationChoice, StartGroup};

use super::{GroupKind, Mechanism, Pose, Structure};
use crate::error::{Error, Result};

/// The start pose, and the assembly mode of each group.
/// The driven joints have the coordinates `drive_angles` (rad or m, in the order of [`Structure::drivers`]).
/// Each group has the configuration that its entry of `wanted` requires.
/// The entries of `wanted` are in the order of the groups of [`Structure::at_start`].
/// The returned assembly modes belong to the groups of `structure`.
///
/// # Errors
/// The errors of [`first_choices`].
pub fn first_pose(
    mechanism: &Mechanism,
    structure: &Structure,
    drive_angles: &[f64],
    wanted: &[StartGroup],
) -> Result<(Pose, Vec<AssemblyMode>)> {
    let (pose, choices) = first_choices(mechanism, structure, drive_angles, wanted)?;
    let modes: Vec<AssemblyMode> = choices.into_iter().map(|choice| choice.mode).collect();
    Ok((pose, structure.modes(&modes)))
}

/// Like [`first_pose`], but returns details of the choice for each group of [`Structure::at_start`].
///
/// # Errors
/// [`ErrorKind::Geometry`](crate::ErrorKind::Geometry) if a group's links do not reach each other.
/// [`ErrorKind::Geometry`](crate::ErrorKind::Geometry) also if approximate positions fit two configurations, contradict
/// the required mode, or lead to no configuration.
/// [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) if the configurations of a group are not all known and no
/// approximate positions are given.
/// [`ErrorKind::Input`](crate::ErrorKind::Input) if the input does not say which configuration of a group is required,
/// or gives a number that does not exist.
pub fn first_choices(
    mechanism: &Mechanism,
    structure: &Structure,
    drive_angles: &[f64],
    wanted: &[StartGroup],
) -> Result<(Pose, Vec<ConfigurationChoice>)> {
    let given = structure.given_at_start(mechanism, drive_angles);
    let structure = structure.at_start();
    let mut pose = structure.driving_pose(mechanism, &given);
    let mut choices = Vec::with_capacity(structure.groups.len());
    for (group, wanted) in structure.groups.iter().zip(wanted) {
        if group.kind == GroupKind::Driven {
            structure.place_driven(mechanism, group, &given, &mut pose);
        }
        let of_group = |error: Error| error.key(group.key(mechanism)).of_group(group.names(mechanism));
        choices.push(choice::place(mechanism, group, wanted, &mut pose).map_err(of_group)?);
    }
    Ok((pose, choices))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use crate::fixtures::four_bar;
    use crate::math::{Vec2, cross};
    use crate::mechanism::pose::SidePoint;
    use crate::mechanism::{JointId, LinkId};
    use approx::assert_relative_eq;

    fn start(wanted: StartGroup) -> Result<(Pose, Vec<AssemblyMode>)> {
        let mechanism = four_bar();
        let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
        first_pose(&mechanism, &structure, &[std::f64::consts::FRAC_PI_2], &[wanted])
    }

    fn point_b(pose: &Pose) -> Vec2 {
        pose.0[LinkId(2)].point(Vec2::new(4.0, 0.0))
    }

    #[test]
    fn both_modes_close_and_mirror_each_other() {
        let mechanism = four_bar();
        let mode = |mode| start(StartGroup { mode: Some(mode), ..StartGroup::default() }).unwrap().0;
        let (left, right) = (mode(AssemblyMode::Left), mode(AssemblyMode::Right));
        assert!(left.closure(&mechanism) < 1e-15 && right.closure(&mechanism) < 1e-15);
        // A = (0, 1), C = (4, 0). The positions of B in the two modes are mirror images about the line AC.
        let (a, axis) = (Vec2::new(0.0, 1.0), Vec2::new(4.0, -1.0).normalize());
        let mirrored = a + axis * (2.0 * axis.dot(&(point_b(&left) - a))) - (point_b(&left) - a);
        assert_relative_eq!(mirrored, point_b(&right), epsilon = 1e-14);
        assert!(cross(Vec2::new(4.0, -1.0), point_b(&left) - a) > 0.0);
    }

    #[test]
    fn a_guess_selects_a_mode_only_if_unambiguous() {
        let near = |x, y| {
            vec![(
                SidePoint {
                    name: "B".into(),
                    side: crate::mechanism::JointSide { link: LinkId(3), local: Vec2::new(3.0, 0.0) },
                },
                Vec2::new(x, y),
            )]
        };
        let left = start(StartGroup { mode: Some(AssemblyMode::Left), ..StartGroup::default() }).unwrap().0;
        let b = point_b(&left);
        let (_, modes) = start(StartGroup { mode: None, near: near(b.x + 0.1, b.y), ..StartGroup::default() }).unwrap();
        assert_eq!(modes, [AssemblyMode::Left]);
        let error = start(StartGroup { mode: None, near: near(2.0, 0.5), ..StartGroup::default() }).unwrap_err();
        assert!(error.to_string().contains("it decides for neither"), "{error}");
        let error =
            start(StartGroup { mode: Some(AssemblyMode::Right), near: near(b.x, b.y), ..StartGroup::default() })
                .unwrap_err();
        assert!(error.to_string().contains("nearer to another configuration"), "{error}");
        assert_eq!(start(StartGroup::default()).unwrap_err().kind(), ErrorKind::Input);
    }

    #[test]
    fn unreachable_links_are_an_error_with_the_distances() {
        let mut mechanism = four_bar();
        mechanism.joints[JointId(2)].second.local = Vec2::new(0.05, 0.0);
        let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
        let wanted = [StartGroup { mode: Some(AssemblyMode::Left), ..StartGroup::default() }];
        let error = first_pose(&mechanism, &structure, &[0.0], &wanted).unwrap_err();
        assert!(error.to_string().contains("3.000000 m apart, but its links span 3.950000 to 4.050000 m"), "{error}");
    }
}
