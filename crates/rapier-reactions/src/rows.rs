//! Constraint rows of a joint as Rapier lays them, and the impulse that they transmit together.
//! The types of this module contain plain numbers in double precision, for both precisions of Rapier.

use crate::plane::{Vec2, cross, turned};

/// Index of the rotation among the three coordinates of a joint. The order is: along x, along y, rotation.
pub(crate) const ROTATION: usize = 2;

/// The joints of Rapier 2D that this crate reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointType {
    /// Locks both translations.
    Revolute,
    /// Locks the rotation, and the translation along the y axis of joint frame 1.
    Prismatic,
    /// Locks everything.
    Fixed,
    /// Locks nothing: a joint that has only a motor, or a floating link of a multibody.
    Free,
}

impl JointType {
    /// The locked coordinates, in the order of Rapier's rows.
    pub(crate) fn locked(self) -> &'static [usize] {
        match self {
            JointType::Revolute => &[0, 1],
            JointType::Prismatic => &[ROTATION, 1],
            JointType::Fixed => &[ROTATION, 0, 1],
            JointType::Free => &[],
        }
    }
}

/// Place and direction of a joint's constraint rows.
/// Rapier computes the rows at the START of a substep and keeps them until its end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointRows {
    /// Unit vector of the x axis of joint frame 1, in world axes.
    pub axis: Vec2,
    /// For each body, the vector from its mass centre to the point where the rows act on it (m, world axes).
    /// The row acts on body 2 at the origin of joint frame 2.
    /// The row acts on body 1 at the same point, moved along the locked axes by the gap of the joint.
    pub arms: [Vec2; 2],
}

impl JointRows {
    /// Interpolates between these rows (`share` 0) and the rows `end` (`share` 1).
    ///
    /// With several substeps, the last substep starts between two poses that can be read.
    /// The rows are assumed to move along a straight line between these poses.
    /// The error is of second order in the step.
    pub fn towards(self, end: JointRows, share: f64) -> JointRows {
        let mix = |from: Vec2, to: Vec2| from + (to - from) * share;
        JointRows { axis: mix(self.axis, end.axis).normalize(), arms: [0, 1].map(|k| mix(self.arms[k], end.arms[k])) }
    }

    /// Impulse (N s, world axes) and angular impulse (N m s) that all rows together exert on body 1.
    /// The angular impulse is about the point where the rows act.
    ///
    /// `rows` are the numbers of `ImpulseJoint::impulses`.
    /// For two separate bodies, `separate` contains the inverses of mass (1/kg) and moment of inertia (1/(kg m^2)) of
    /// both bodies. `None` if one of the bodies is a link of a multibody.
    /// The inverses of a body that is not dynamic are 0.
    /// Between two separate bodies, Rapier makes the rows of a joint orthogonal. The impulses of the orthogonal rows
    /// are not components of a force.
    /// This function undoes the orthogonalisation.
    pub fn impulse(&self, joint_type: JointType, rows: [f64; 3], separate: Option<[[f64; 2]; 2]>) -> (Vec2, f64) {
        let rows = separate.map_or(rows, |inverse| self.undone(joint_type, rows, inverse));
        let across = turned(self.axis);
        match joint_type {
            JointType::Revolute => (self.axis * rows[0] + across * rows[1], 0.0),
            JointType::Prismatic => (across * rows[1], rows[ROTATION]),
            JointType::Fixed => (self.axis * rows[0] + across * rows[1], rows[ROTATION]),
            JointType::Free => (Vec2::zeros(), 0.0),
        }
    }

    /// Levers of the three rows about the mass centres of both bodies.
    fn levers(&self) -> [[f64; 2]; 3] {
        let lever = |along: Vec2| self.arms.map(|arm| cross(arm, along));
        [lever(self.axis), lever(turned(self.axis)), [1.0; 2]]
    }

    /// The impulses of the original rows, from the impulses of the rows that Rapier made orthogonal.
    ///
    /// Rapier's modified Gram-Schmidt method (`JointConstraintHelper::finalize_constraints` in version 0.36.1) replaces
    /// the row c_i by c_i - sum over j of k_ij c_j, in the metric of the inverse masses.
    /// The impulse, the sum of lambda_i c_i, is the same for the original rows, so each lambda_j decreases by
    /// k_ij lambda_i. This is computed from the last row back to the first.
    /// The linear parts of the rows along x and y are orthogonal; only their levers change.
    fn undone(&self, joint_type: JointType, mut rows: [f64; 3], inverse: [[f64; 2]; 2]) -> [f64; 3] {
        let turning =
            |of: [f64; 2], other: [f64; 2]| of[0] * other[0] * inverse[0][1] + of[1] * other[1] * inverse[1][1];
        let (order, mut levers) = (joint_type.locked(), self.levers());
        let mut parts = [[[0.0; 2]; 3]; 3];
        for (number, &j) in order.iter().enumerate() {
            let mobility = if j == ROTATION { 0.0 } else { inverse[0][0] + inverse[1][0] };
            let whole = mobility + turning(levers[j], levers[j]);
            for &i in &order[number + 1..] {
                let shared = turning(levers[j], levers[i]);
                parts[i][j] = [shared, whole];
                levers[i] = [0, 1].map(|side| levers[i][side] - levers[j][side] * shared / whole);
            }
        }
        for (number, &i) in order.iter().enumerate().rev() {
            for &j in &order[..number] {
                let [shared, whole] = parts[i][j];
                rows[j] -= rows[i] * shared / whole;
            }
        }
        rows
    }

    /// Effect of a unit force along a coordinate, or of a unit moment, on a body.
    /// The result is a force, and a moment about the mass centre.
    /// Side 1 is the second body, on which the unit force acts with its sign. On the first body, the unit force acts in
    /// the opposite direction.
    pub(crate) fn unit(&self, coordinate: usize, side: usize) -> [f64; 3] {
        let sign = if side == 1 { 1.0 } else { -1.0 };
        let along = [self.axis, turned(self.axis), Vec2::zeros()][coordinate];
        [along.x * sign, along.y * sign, self.levers()[coordinate][side] * sign]
    }
}
