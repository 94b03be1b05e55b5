//! Reactions near a change point.
//!
//! Near a change point, the motion and the power of the drives are smooth, but reactions need not be smooth.
//! In the singular pose a group is movable along a second branch, which the mechanism does not follow.
//! If a load does no work along the second branch, the reactions to this load stay finite.
//! The reactions to all other loads grow with the inverse of the distance from the change point.
//! A reaction is therefore the sum of a first-order pole and a smooth part.
//! The residue of the pole follows from the products of reaction and distance, which are smooth.

use super::window::{Window, at_speed, weights};
use crate::assur::forces::Kinetostatics;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::math::{KeepNan, Motion, Vec2, angle, cross};
use linkage::solver::State;

/// If the residue of a reaction is below a threshold, it counts as zero. The threshold is the sum of two terms.
/// If the innermost nodes are left out, the residue changes. The first term is `NOISE` times this change.
/// The second term is `LEAST` times the largest product of a reaction and the distance from the change point.
const NOISE: f64 = 16.0;
const LEAST: f64 = 1e-12;

/// If a pose is nearer to a change point than this (rad), reactions with a residue are not reported.
/// The position of the change point has an error of some 1e-14 rad.
/// The relative error of these reactions is the error of the position, divided by the distance.
const NEAREST: f64 = 1e-7;

/// Writes the loads that act on the links, for given motions and angles (rad) of the links.
pub(in crate::assur) type Loads<'a> = &'a mut dyn FnMut(&[Motion], &[f64], &mut [Wrench]);

/// Reactions grow without bound, because the pose is the change point itself or next to a change point.
pub(in crate::assur) struct Unbounded;

impl Window {
    /// Writes the reactions and balancing moments to `state`. The motions and angles in `state` must be known.
    /// The driving link is at the angle `place` and has the given angular velocity and acceleration.
    /// `loads` finds the loads from the motions and angles of the links.
    /// In free motion, `shaft` contains the moment on the driving link and the moment of inertia that turns with it.
    /// In free motion, each neighbouring pose has the given angular velocity, and the acceleration that balances the
    /// driving link.
    /// In free motion, the residue of a reaction therefore depends on the angular velocity as well as on the pose.
    pub(in crate::assur) fn reactions(
        &self,
        place: f64,
        [omega, alpha]: [f64; 2],
        shaft: Option<[f64; 2]>,
        (case, statics): (&Case, &mut Kinetostatics),
        loads: Loads,
        state: &mut State,
    ) -> Result<(), Unbounded> {
        let mut beside = state.clone();
        let mut wrenches = vec![Wrench::ZERO; state.motions.len()];
        let mut values: Vec<Vec<f64>> = Vec::with_capacity(self.nodes.len());
        let drive = 2 * state.forces.len() + state.moments.len();
        let other = alpha + alpha.abs().larger(omega * omega).larger(1.0);
        for node in &self.nodes {
            let mut at = |alpha: f64| -> Vec<f64> {
                for (link, unit) in state.motions.ids().zip(&node.motions) {
                    beside.motions[link] = at_speed(unit, [omega, alpha]);
                    let (here, there) = (state.motions[link].direction, unit.direction);
                    let turn = angle::wrapped(cross(here, there).atan2(here.dot(&there)));
                    beside.angles[link] = state.angles[link] + turn;
                }
                loads(&beside.motions, &beside.angles, &mut wrenches);
                statics.solve_under(&wrenches, case, &node.plan, &mut beside);
                let forces = beside.forces.iter().flat_map(|force| [force.x, force.y]);
                forces.chain(beside.moments.iter().copied()).chain(beside.torques.iter().copied()).collect()
            };
            let mut own = at(alpha);
            if let Some([moment, inertia]) = shaft {
                // Reactions are linear in the acceleration: interpolate to the acceleration that balances the driving
                // link.
                let more = at(other);
                let slope = (more[drive] - own[drive]) / (other - alpha) + inertia;
                let share = (moment - inertia * alpha - own[drive]) / slope / (other - alpha);
                own.iter_mut().zip(&more).for_each(|(own, more)| *own += share * (more - *own));
            }
            values.push(own);
        }
        let found = self.with_poles(place - self.at, &values)?;
        let (forces, rest) = found.split_at(2 * state.forces.len());
        let (moments, torques) = rest.split_at(state.moments.len());
        state.forces.iter_mut().zip(forces.chunks(2)).for_each(|(force, own)| *force = Vec2::new(own[0], own[1]));
        state.moments.copy_from_slice(moments);
        state.torques.copy_from_slice(torques);
        Ok(())
    }

    /// Values at the distance `x`, interpolated between the nodes.
    /// Each value is the sum of a polynomial and, if its residue is not zero, a pole of first order.
    fn with_poles(&self, x: f64, values: &[Vec<f64>]) -> Result<Vec<f64>, Unbounded> {
        let offsets = self.offsets();
        let nearest = offsets.iter().fold(f64::INFINITY, |least, offset| least.smaller(offset.abs()));
        let is_inner: Vec<bool> = offsets.iter().map(|offset| offset.abs() < 1.01 * nearest).collect();
        let outer: Vec<f64> = offsets.iter().zip(&is_inner).filter(|(_, inner)| !**inner).map(|(x, _)| *x).collect();
        let (at_zero, without, here) = (weights(&offsets, 0.0), weights(&outer, 0.0), weights(&offsets, x));
        let scaled = |node: usize, index: usize| values[node][index] * offsets[node];
        let nodes = 0..values.len();
        let largest = nodes.clone().fold(0.0f64, |most, node| {
            (0..values[node].len()).fold(most, |most, index| most.larger(scaled(node, index).abs()))
        });
        let one = |index: usize| -> Result<f64, Unbounded> {
            let all: f64 = nodes.clone().map(|node| at_zero[node] * scaled(node, index)).sum();
            let kept = nodes.clone().filter(|&node| !is_inner[node]);
            let some: f64 = kept.zip(&without).map(|(node, weight)| weight * scaled(node, index)).sum();
            let residue = if all.abs() > NOISE * (all - some).abs() + LEAST * largest { all } else { 0.0 };
            if residue != 0.0 && !(x.abs() > NEAREST) {
                return Err(Unbounded);
            }
            let rest = |node: usize| here[node] * (values[node][index] - residue / offsets[node]);
            let pole = if residue == 0.0 { 0.0 } else { residue / x };
            Ok(pole + nodes.clone().map(rest).sum::<f64>())
        };
        (0..values[0].len()).map(one).collect()
    }
}
