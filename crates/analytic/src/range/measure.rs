//! Distance of a group from a singular pose: its determinant and its condition number.
//!
//! The coordinates x and y of the group's links are eliminated: the columns of the angles are projected onto the
//! orthogonal complement of the columns of x and y. There are then as many equations as angles.
//! The remaining columns are vectors of constant length, one per link. With the columns divided by these lengths, the
//! determinant is a dimensionless number from -1 to 1.
//! For a dyad the columns are the vectors from the outer joints to the inner joint.
//! The determinant of a dyad is the sine of the transmission angle mu (Alt 1932). The condition number of a dyad is
//! cot(mu / 2) for mu up to 90 degrees.
//! Groups with sliders keep all columns.

use linkage::math::{KeepNan, Matrix};
use linkage::mechanism::assembly::transmission_sine;
use linkage::mechanism::{Group, Mechanism, Pose};

/// Determinant and condition number of a group at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupCondition {
    /// Normalised determinant, from -1 to 1; zero in a singular pose.
    pub determinant: f64,
    /// Condition number (2-norm) of the normalised equations.
    /// The condition number is the largest possible ratio of the relative error of the angular velocities to the
    /// relative error of the positions.
    /// [`f64::MAX`] if the equations are singular to working precision.
    pub condition: f64,
}

/// Measures a group at a pose, from its square block of the Jacobian. The columns of x and y come before the columns of
/// the angles.
pub(super) fn of(block: &Matrix, mechanism: &Mechanism, group: &Group, pose: &Pose) -> GroupCondition {
    let mut joints = group.inner.iter().chain(&group.outer);
    if !joints.all(|&joint| mechanism.joints()[joint].is_pin()) {
        return of_sliding(block, transmission_sine(mechanism, group, pose));
    }
    let links = group.links.len();
    let orthonormal = block.columns(0, 2 * links).into_owned().qr().q();
    let angles = block.columns(2 * links, links).into_owned();
    let rest = &angles - &orthonormal * (orthonormal.transpose() * &angles);
    of_columns(rest, block.determinant().signum())
}

/// Measures a group with sliders, in which x and y cannot be eliminated. All columns are divided by their lengths.
/// For a dyad, the determinant is the sine of its transmission angle.
fn of_sliding(block: &Matrix, sine: Option<f64>) -> GroupCondition {
    let sign = block.determinant().signum();
    let measure = of_columns(block.clone(), sign);
    GroupCondition { determinant: sine.map_or(measure.determinant, |sine| sign * sine.abs()), ..measure }
}

fn of_columns(mut matrix: Matrix, sign: f64) -> GroupCondition {
    for mut column in matrix.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column /= norm;
        }
    }
    let values = matrix.singular_values();
    // For a matrix of zeros the quotient is NaN. The result is then `f64::MAX`, the condition number of a singular
    // matrix.
    let condition = (values.max() / values.min()).smaller_number(f64::MAX);
    GroupCondition { determinant: sign * values.product(), condition }
}

#[cfg(test)]
mod tests {
    use super::super::constraints::Constraints;
    use super::*;
    use fixtures::four_bar;
    use linkage::math::Vec2;
    use linkage::mechanism::{AssemblyMode, GroupId, JointId, StartGroup, Structure, first_pose};

    #[test]
    fn dyad_measures_give_the_transmission_angle_in_any_length_unit() {
        let mechanism = four_bar();
        let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
        let group = &structure.groups[GroupId(0)];
        let constraints = Constraints::of(&mechanism, Vec2::new(1.0, -2.0), Vec::new());
        for degrees in (0..360).step_by(5) {
            for mode in [AssemblyMode::Left, AssemblyMode::Right] {
                let wanted = [StartGroup { mode: Some(mode), ..StartGroup::default() }];
                let (pose, _) =
                    first_pose(&mechanism, &structure, &[f64::from(degrees).to_radians()], &wanted).unwrap();
                let jacobian = constraints.at(&constraints.coordinates_of(&pose)).jacobian;
                let measure = of(&constraints.block(&jacobian, group), &mechanism, group, &pose);
                let sine = transmission_sine(&mechanism, group, &pose).unwrap();
                assert!((measure.determinant.abs() - sine.abs()).abs() < 1e-14);
                // cot(mu / 2) = (1 + cos mu) / sin mu.
                let expected = (1.0 + (1.0 - sine * sine).sqrt()) / sine.abs();
                assert!((measure.condition / expected - 1.0).abs() < 1e-12, "{} {expected}", measure.condition);
            }
        }
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_the_residual() {
        let mechanism = four_bar();
        let constraints = Constraints::of(&mechanism, Vec2::zeros(), Vec::new());
        let q = linkage::math::ColumnVector::from_fn(9, |k, _| 0.3 + 0.7 * k as f64);
        let jacobian = constraints.at(&q).jacobian;
        for k in 0..9 {
            let (mut ahead, mut behind) = (q.clone(), q.clone());
            (ahead[k], behind[k]) = (q[k] + 1e-5, q[k] - 1e-5);
            let slope = (constraints.at(&ahead).residual - constraints.at(&behind).residual) / 2e-5;
            assert!((slope - jacobian.column(k)).norm() < 1e-9);
        }
    }
}
