//! How far a group is from a singular pose: its determinant and its condition number.
//!
//! With x and y of its links eliminated (projection on the complement of their columns), as many equations as angles are left. Their columns
//! are vectors of constant length, one a link; divided by these lengths, the determinant is a pure number from -1 to 1. For a
//! dyad the columns are the vectors from the outer joints to the inner one: the determinant is the sine of the transmission
//! angle mu (Alt 1932), and the condition number is cot(mu / 2) for mu up to 90 degrees.

use crate::math::Matrix;
use crate::mechanism::Group;

/// Determinant and condition number of a group at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Normalised determinant, from -1 to 1; zero in a singular pose.
    pub determinant: f64,
    /// Condition number (2-norm) of the normalised equations: factor by which relative errors of position pass into angular velocities.
    /// [`f64::MAX`] where the equations are singular to the last digit.
    pub condition: f64,
}

/// Measures the square block of a group, x and y before the angles.
pub(super) fn of(block: &Matrix, group: &Group) -> Measure {
    let links = group.links.len();
    let orthonormal = block.columns(0, 2 * links).into_owned().qr().q();
    let angles = block.columns(2 * links, links).into_owned();
    let mut rest = &angles - &orthonormal * (orthonormal.transpose() * &angles);
    for mut column in rest.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column /= norm;
        }
    }
    let values = rest.singular_values();
    let sign = block.determinant().signum();
    let condition = (values.max() / values.min()).min(f64::MAX);
    Measure { determinant: sign * values.product(), condition }
}
