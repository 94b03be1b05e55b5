//! Newton-Euler equations of all bodies of a world, with the forces of their joints as unknowns.
//!
//! For every dynamic body, m a is the sum of joint forces and loads, and J alpha is the sum of the moments of these
//! joint forces and loads about the mass centre.
//! A joint has one unknown for each locked coordinate, and for each free coordinate along which it may exert a force.
//! Where bodies can move freely, there are more equations than unknowns.
//! The forces are then chosen by Gauss's principle of least constraint (1829): they minimise the sum of the squared
//! residuals of the equations, each divided by mass or moment of inertia. These forces reproduce the accelerations
//! along the locked coordinates exactly. The residual is the acceleration along the free coordinates that the loads do
//! not explain.

use crate::model::{Group, Model, Stance};
use crate::motion::Motion;
use crate::plane::larger;
use nalgebra::{DMatrix, DVector};

/// Columns, scaled to unit length, count as dependent if a singular value is not above this limit. The gaps of the
/// joints increase the limit.
const SINGULAR: f64 = 1e-9;

/// A gap of a joint changes the directions of the joint's columns by about the ratio of the gap to the size of the
/// mechanism. Dependent columns therefore have singular values up to a few times this ratio.
const GAP_SHARE: f64 = 10.0;

/// A joint takes part in a dependence if its share in the singular vector exceeds this fraction.
const SHARE: f64 = 0.1;

/// Forces and moments that the joints transmit, and the part of the motion that the forces do not explain.
#[derive(Clone, Debug)]
pub(crate) struct Transmitted {
    /// For every joint, force on body 2 along x and y of joint frame 1 (N), and moment (N m).
    pub(crate) components: Vec<[f64; 3]>,
    /// Part of m a - loads that no joint force explains, as a fraction of m a - loads. Numerator and denominator are
    /// root sums of squares, each square divided by the mass or moment of inertia.
    pub(crate) residual: f64,
}

/// The forces and moments that all joints transmit, from motions and loads.
///
/// # Errors
/// The indices of joints whose forces the equations do not determine.
pub(crate) fn balance(model: &Model, stances: &[Stance], motions: &[Motion]) -> Result<Transmitted, Vec<usize>> {
    let (mut components, mut sums) = (vec![[0.0; 3]; model.joints.len()], [0.0; 2]);
    for group in model.groups() {
        let equations = Equations::of(model, stances, &group);
        let undetermined = equations.undetermined();
        if !undetermined.is_empty() {
            return Err(undetermined);
        }
        let (values, squares) = equations.solve(model, motions);
        for (&(joint, coordinate), value) in equations.unknowns.iter().zip(values.iter()) {
            components[joint][coordinate] = *value;
        }
        sums = [sums[0] + squares[0], sums[1] + squares[1]];
    }
    let residual = if sums[1] > 0.0 { (sums[0] / sums[1]).sqrt() } else { 0.0 };
    Ok(Transmitted { components, residual })
}

/// The equations of a group of bodies.
struct Equations<'a> {
    group: &'a Group,
    /// Joint and coordinate of every unknown.
    unknowns: Vec<(usize, usize)>,
    /// Effects of unit forces: three rows for every body, one column for every unknown.
    columns: DMatrix<f64>,
    /// Size of the mechanism (m): the longest arm of a joint.
    size: f64,
    /// Largest violation of a locked coordinate (m).
    violation: f64,
}

impl<'a> Equations<'a> {
    fn of(model: &Model, stances: &[Stance], group: &'a Group) -> Self {
        let coordinates = |&joint: &usize| (0..3).map(move |coordinate| (joint, coordinate));
        let transmits = |&(joint, coordinate): &(usize, usize)| model.joints[joint].transmits(coordinate);
        let unknowns: Vec<(usize, usize)> = group.joints.iter().flat_map(coordinates).filter(transmits).collect();
        let mut columns = DMatrix::zeros(3 * group.bodies.len(), unknowns.len());
        for (column, &(joint, coordinate)) in unknowns.iter().enumerate() {
            for (side, body) in model.joints[joint].bodies.into_iter().enumerate() {
                let Some(number) = group.bodies.iter().position(|&own| own == body) else { continue };
                let effect = stances[joint].rows.unit(coordinate, side);
                (0..3).for_each(|k| columns[(3 * number + k, column)] += effect[k]);
            }
        }
        let arms = group.joints.iter().flat_map(|&joint| {
            [0, 1]
                .into_iter()
                .filter(move |&side| model.bodies[model.joints[joint].bodies[side]].inertia.is_some())
                .map(move |side| stances[joint].rows.arms[side].norm())
        });
        let longest = arms.fold(0.0, larger);
        let size = if longest > 0.0 { longest } else { 1.0 };
        let violation = group.joints.iter().fold(0.0, |most, &joint| larger(most, stances[joint].violation(size)));
        Equations { group, unknowns, columns, size, violation }
    }

    /// The joints whose columns depend on each other, so that their forces are not determined.
    ///
    /// Dependence is a property of the geometry: moments are divided by the size of the mechanism, and every column has
    /// the length 1. Masses do not enter.
    fn undetermined(&self) -> Vec<usize> {
        let (rows, count) = self.columns.shape();
        let mut square = DMatrix::zeros(rows.max(count), count);
        square.rows_mut(0, rows).copy_from(&self.columns);
        (0..self.group.bodies.len()).for_each(|body| square.row_mut(3 * body + 2).scale_mut(self.size.recip()));
        for mut column in square.column_iter_mut() {
            let length = column.norm();
            if length > 0.0 {
                column.unscale_mut(length);
            }
        }
        let least = SINGULAR + GAP_SHARE * self.violation / self.size;
        let decomposed = square.svd(false, true);
        let vectors = decomposed.v_t.expect("the vectors are requested");
        let mut found = Vec::new();
        for (number, _) in decomposed.singular_values.iter().enumerate().filter(|(_, value)| !(**value > least)) {
            let takes_part = |&column: &usize| !(vectors[(number, column)].abs() <= SHARE);
            found.extend((0..count).filter(takes_part).map(|column| self.unknowns[column].0));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The unknowns, and two sums of squares: of the residual, and of m a - loads. Each square is divided by the mass
    /// or moment of inertia.
    fn solve(&self, model: &Model, motions: &[Motion]) -> (DVector<f64>, [f64; 2]) {
        let (mut columns, mut right) = (self.columns.clone(), DVector::zeros(self.columns.nrows()));
        for (number, &body) in self.group.bodies.iter().enumerate() {
            let weights = model.bodies[body].inertia.expect("a group has dynamic bodies only");
            let need = needed(model, motions, body);
            for k in 0..3 {
                let weight = weights[k / 2].sqrt().recip();
                columns.row_mut(3 * number + k).scale_mut(weight);
                right[3 * number + k] = need[k] * weight;
            }
        }
        let (matrix, mut turned) = (columns.clone().qr(), right.clone());
        matrix.q_tr_mul(&mut turned);
        let count = self.unknowns.len();
        let values = matrix.r().solve_upper_triangular(&turned.rows(0, count)).expect("the columns are independent");
        let rest = &right - &columns * &values;
        (values, [rest.norm_squared(), right.norm_squared()])
    }
}

/// Force (N) and moment about the mass centre (N m) that the joints of a body must exert together.
fn needed(model: &Model, motions: &[Motion], body: usize) -> [f64; 3] {
    let (own, motion) = (&model.bodies[body], &motions[body]);
    let [mass, inertia] = own.inertia.expect("a group has dynamic bodies only");
    let force = (motion.acceleration + motion.velocity * own.damping[0]) * mass - own.force;
    let moment = (motion.alpha + motion.omega * own.damping[1]) * inertia - own.moment;
    [force.x, force.y, moment]
}

/// Speed of body 2 relative to body 1 along a coordinate of a joint (m/s or rad/s), at the time `time` (s) after the
/// middle pose.
pub(crate) fn relative_speed(stance: &Stance, motions: [&Motion; 2], coordinate: usize, time: f64) -> f64 {
    [0, 1]
        .iter()
        .map(|&side| {
            let effect = stance.rows.unit(coordinate, side);
            let speeds = motions[side].speeds(time);
            (0..3).map(|k| effect[k] * speeds[k]).sum::<f64>()
        })
        .sum()
}
