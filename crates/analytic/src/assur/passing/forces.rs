//! Reactions beside a change point.
//!
//! Motion, and the power of the drives, go on smoothly there. Reactions need not: the pose in which a group's links no
//! longer hold it lets only those loads be carried that do no work along the other branch, and the reactions of all
//! others grow with the inverse of the distance. So a reaction is a pole of first order and a smooth part.
//! The residue is read from the reactions times the distance, which are smooth.

use super::window::{Window, at_speed, weights};
use crate::assur::forces::Kinetostatics;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::math::{KeepNan, Motion, Vec2, angle, cross};
use linkage::solver::State;

/// Residue below which there is none, as a multiple of what leaving out the innermost nodes changes in it, and as a share
/// of the largest reaction times its distance.
const NOISE: f64 = 16.0;
const LEAST: f64 = 1e-12;

/// Reactions that grow without bound: the pose is the change point itself, to rounding.
pub(in crate::assur) struct Unbounded;

impl Window {
    /// Writes to `state`, whose motions and angles are known, the reactions and balancing moments with the driving link
    /// at `place`, from its angular velocity and acceleration. `loads` finds the loads at motions and angles of the links.
    pub(in crate::assur) fn reactions(
        &self,
        place: f64,
        rates: [f64; 2],
        (case, statics): (&Case, &mut Kinetostatics),
        loads: &mut dyn FnMut(&[Motion], &[f64], &mut [Wrench]),
        state: &mut State,
    ) -> Result<(), Unbounded> {
        let mut beside = state.clone();
        let mut wrenches = vec![Wrench::ZERO; state.motions.len()];
        let mut values: Vec<Vec<f64>> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            for (link, unit) in node.motions.iter().enumerate() {
                beside.motions[link] = at_speed(unit, rates);
                let (here, there) = (state.motions[link].direction, unit.direction);
                beside.angles[link] = state.angles[link] + angle::wrapped(cross(here, there).atan2(here.dot(&there)));
            }
            loads(&beside.motions, &beside.angles, &mut wrenches);
            statics.solve_under(&wrenches, case, &node.plan, &mut beside);
            let forces = beside.forces.iter().flat_map(|force| [force.x, force.y]);
            values.push(forces.chain(beside.moments.iter().copied()).chain(beside.torques.iter().copied()).collect());
        }
        let found = self.with_poles(place - self.at, &values)?;
        let (forces, rest) = found.split_at(2 * state.forces.len());
        let (moments, torques) = rest.split_at(state.moments.len());
        state.forces.iter_mut().zip(forces.chunks(2)).for_each(|(force, own)| *force = Vec2::new(own[0], own[1]));
        state.moments.copy_from_slice(moments);
        state.torques.copy_from_slice(torques);
        Ok(())
    }

    /// Values at the distance `x` from those at the nodes: each a pole of first order, if it has one, and a polynomial.
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
        let mut found = Vec::with_capacity(values[0].len());
        for index in 0..values[0].len() {
            let all: f64 = nodes.clone().map(|node| at_zero[node] * scaled(node, index)).sum();
            let kept = nodes.clone().filter(|&node| !is_inner[node]);
            let some: f64 = kept.zip(&without).map(|(node, weight)| weight * scaled(node, index)).sum();
            let residue = if all.abs() > NOISE * (all - some).abs() + LEAST * largest { all } else { 0.0 };
            if residue != 0.0 && !(x.abs() > 8.0 * f64::EPSILON * self.at.abs().larger(1.0)) {
                return Err(Unbounded);
            }
            let rest = |node: usize| here[node] * (values[node][index] - residue / offsets[node]);
            let pole = if residue == 0.0 { 0.0 } else { residue / x };
            found.push(pole + nodes.clone().map(rest).sum::<f64>());
        }
        Ok(found)
    }
}
