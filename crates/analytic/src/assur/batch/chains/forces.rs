//! Joint reactions of higher groups on pins, for several poses at once.

use super::Chain;
use crate::assur::batch::elimination::Factors;
use crate::assur::batch::lanes::{Columns, Lanes, Plane, Tile, Window};
use crate::assur::batch::loads::LoadColumns;
use crate::assur::groups::Hangs;
use linkage::math::Vec2;
use pulp::Simd;

impl Chain {
    /// Computes the known forces on all links.
    #[inline(always)]
    pub(in crate::assur::batch) fn load<S: Simd>(&self, gravity: Vec2, tile: Tile<S>, work: Columns<S>) {
        for (index, node) in self.nodes.iter().enumerate() {
            node.body.load_about(node.own, gravity, tile, LoadColumns::of(work, index));
        }
    }

    /// Computes the reactions in all joints from the known forces.
    #[inline(always)]
    pub(in crate::assur::batch) fn hold<S: Simd>(&self, tile: Window<S>, work: Window<S>, first: usize) {
        match self.nodes.len() {
            4 => self.hold_by::<S, 4>(tile, work, first),
            _ => self.hold_by::<S, 6>(tile, work, first),
        }
    }

    #[inline(always)]
    fn hold_by<S: Simd, const N: usize>(&self, tile: Window<S>, work: Window<S>, first: usize) {
        let (zero, none) = (Lanes::splat(tile.on, 0.0), Plane::splat(tile.on, Vec2::zeros()));
        let (mut forces, mut moments) = ([none; N], [zero; N]);
        for index in 0..N {
            (forces[index], moments[index]) = LoadColumns::of(work.columns, index).get(work.part);
        }
        self.gather(&mut forces);
        // Adds the moments of the forces at the arrows' ends. Each moment is about the pole of the link that carries
        // the arrow.
        for (index, node) in self.nodes.iter().enumerate().rev() {
            if let Hangs::Arrow(arrow) = node.hangs {
                let parent = self.arrows[arrow].node;
                moments[parent] = moments[parent] + work.vector(self.arrow(first, arrow)).cross(forces[index]);
            }
        }
        let factors = Factors::<S, N>::kept(work, self.first_factor(first));
        let multipliers = factors.solve_transposed(moments.map(|moment| -moment));
        let mut cut = [none; N];
        for (index, closing) in self.closings.iter().enumerate() {
            let force = Plane { x: multipliers[2 * index], y: multipliers[2 * index + 1] };
            tile.put_vector(closing.force, force);
            for (node, sign) in closing.nodes.into_iter().zip([-1.0, 1.0]) {
                if let Some(node) = node {
                    cut[node] = cut[node] + force * sign;
                }
            }
        }
        self.gather(&mut cut);
        for (index, node) in self.nodes.iter().enumerate() {
            tile.put_vector(node.reaction.force, (forces[index] + cut[index]).signed(-node.reaction.sign));
        }
    }

    /// Sums the forces from the outermost link inwards. Moments are not passed on, because a pin transmits only a
    /// force.
    #[inline(always)]
    fn gather<S: Simd>(&self, forces: &mut [Plane<S>]) {
        for (index, node) in self.nodes.iter().enumerate().rev() {
            if let Hangs::Arrow(arrow) = node.hangs {
                let parent = self.arrows[arrow].node;
                forces[parent] = forces[parent] + forces[index];
            }
        }
    }
}
