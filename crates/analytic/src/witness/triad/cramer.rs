//! First transfer functions and angular accelerations of the group's links by Cramer's rule.
//!
//! Leads and base link have the two vector contours A_1 B_1 B_k A_k, k = 2, 3:
//! `l_1 e(alpha_1) + b_k e(alpha_4 + beta_k) = A_1 A_k + l_k e(alpha_k)`.
//! The derivatives with respect to the crank angle (or to time) give four linear equations for alpha_1' .. alpha_4'.
//! The right-hand side contains the velocities of the feet.
//! The second derivatives give equations with the same coefficients. Their right-hand side contains the accelerations
//! of the feet and the centripetal accelerations of the links.
//! Each unknown is a quotient of two 4 x 4 determinants (method of the transfer functions).
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::{Triad, singular};
use linkage::error::Result;
use linkage::math::{Motion, Vec2, turned};

/// The two contours in one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contours {
    /// Vectors from foot to head of each lead (m).
    pub leads: [Vec2; 3],
    /// Vectors from the first head to the second head and to the third head (m).
    pub sides: [Vec2; 2],
}

type Matrix = [[f64; 4]; 4];

impl Contours {
    /// The contours of a group in the pose of `motions`. Only the links' directions are used.
    #[must_use]
    pub fn of(triad: &Triad, motions: &[Motion]) -> Self {
        let base = &motions[triad.base];
        Contours {
            leads: triad.leads.map(|lead| motions[lead.link].arm(lead.head - lead.foot)),
            sides: [1, 2].map(|k| base.arm(triad.leads[k].on_base - triad.leads[0].on_base)),
        }
    }

    /// Coefficients: two rows per contour, one column per link.
    fn matrix(&self) -> Matrix {
        let mut matrix = [[0.0; 4]; 4];
        for (k, side) in self.sides.into_iter().enumerate() {
            let columns = [(0, turned(self.leads[0])), (k + 1, -turned(self.leads[k + 1])), (3, turned(side))];
            for (column, vector) in columns {
                matrix[2 * k][column] = vector.x;
                matrix[2 * k + 1][column] = vector.y;
            }
        }
        matrix
    }

    /// Angular velocities of the three leads and the base link (rad/s) from the velocities of the three feet (m/s).
    /// If `feet` contains the feet's derivatives with respect to the crank angle (m), the results are the first
    /// transfer functions alpha_i'.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) at a dead point of the group.
    pub fn first(&self, feet: [Vec2; 3]) -> Result<[f64; 4]> {
        self.solve([feet[1] - feet[0], feet[2] - feet[0]])
    }

    /// Angular accelerations (rad/s^2) from the accelerations of the feet (m/s^2) and the angular velocities `first`
    /// (rad/s).
    /// If the arguments are derivatives with respect to the crank angle, the results are the second transfer functions.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) at a dead point of the group.
    pub fn second(&self, feet: [Vec2; 3], first: [f64; 4]) -> Result<[f64; 4]> {
        let centripetal = |k: usize| {
            self.leads[0] * first[0].powi(2) + self.sides[k - 1] * first[3].powi(2) - self.leads[k] * first[k].powi(2)
        };
        self.solve([1, 2].map(|k| feet[k] - feet[0] + centripetal(k)))
    }

    fn solve(&self, right: [Vec2; 2]) -> Result<[f64; 4]> {
        let matrix = self.matrix();
        let right = [right[0].x, right[0].y, right[1].x, right[1].y];
        let whole = determinant4(&matrix);
        let quotients = [0, 1, 2, 3].map(|column| {
            let mut replaced = matrix;
            replaced.iter_mut().zip(right).for_each(|(row, value)| row[column] = value);
            determinant4(&replaced) / whole
        });
        if quotients.iter().all(|value| value.is_finite()) { Ok(quotients) } else { Err(singular("Cramer's rule")) }
    }
}

/// Angular velocities (rad/s) and angular accelerations (rad/s^2) of leads and base link.
/// `motions` must contain the directions of the group's links, and the complete motion of the links that carry the
/// group's feet.
///
/// # Errors
/// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) at a dead point of the group.
pub fn rates(triad: &Triad, motions: &[Motion]) -> Result<[[f64; 4]; 2]> {
    let contours = Contours::of(triad, motions);
    let support = triad.leads.map(|lead| lead.support);
    let first = contours.first(support.map(|side| motions[side.link].point_velocity(side.local)))?;
    let second = contours.second(support.map(|side| motions[side.link].point_acceleration(side.local)), first)?;
    Ok([first, second])
}

/// Determinant, expanded by cofactors along the first row.
fn determinant4(a: &Matrix) -> f64 {
    let minor = |skipped: usize| {
        let mut rest = [[0.0; 3]; 3];
        for (row, values) in rest.iter_mut().zip(&a[1..]) {
            let kept = (0..4).filter(|&column| column != skipped);
            row.iter_mut().zip(kept).for_each(|(value, column)| *value = values[column]);
        }
        determinant3(&rest)
    };
    a[0][0] * minor(0) - a[0][1] * minor(1) + a[0][2] * minor(2) - a[0][3] * minor(3)
}

fn determinant3(a: &[[f64; 3]; 3]) -> f64 {
    let minor = |i: usize, j: usize| a[1][i] * a[2][j] - a[1][j] * a[2][i];
    a[0][0] * minor(1, 2) - a[0][1] * minor(0, 2) + a[0][2] * minor(0, 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::ErrorKind;

    #[test]
    fn determinants_of_known_matrices() {
        // The determinant of a Vandermonde matrix is the product of all differences of 1, 2, 3, 5.
        let vandermonde = [1.0f64, 2.0, 3.0, 5.0].map(|x| [1.0, x, x * x, x * x * x]);
        assert_eq!(determinant4(&vandermonde), 1.0 * 2.0 * 4.0 * 1.0 * 3.0 * 2.0);
        let mut swapped = vandermonde;
        swapped.swap(0, 3);
        assert_eq!(determinant4(&swapped), -determinant4(&vandermonde));
    }

    #[test]
    fn a_parallelogram_translates_and_three_parallel_leads_fail() {
        let (up, along) = (Vec2::new(0.0, 1.0), Vec2::new(1.0, 0.0));
        let contours = Contours { leads: [up, up, along], sides: [along, along * 2.0] };
        // The third foot moves along its lead; the other feet are at rest. The base link moves along x without turning.
        let rates = contours.first([Vec2::zeros(), Vec2::zeros(), along * 3.0]).unwrap();
        assert_eq!(rates, [-3.0, -3.0, 0.0, 0.0]);
        let parallel = Contours { leads: [up; 3], ..contours };
        assert_eq!(parallel.first([Vec2::zeros(), up, along]).unwrap_err().kind(), ErrorKind::Numeric);
    }
}
