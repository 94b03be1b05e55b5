//! Masses that Rapier needs for a free motion but that the case does not have. Loads compensate these added masses.
//!
//! Rapier divides by the mass and by the moment of inertia of a separate body, so a point mass cannot be a separate
//! body.
//! In a multibody, Rapier accepts a point mass that does not lie at a joint, because the mass matrix of the chain is
//! then regular.
//! A link that lacks mass or inertia gets an added mass or inertia.
//! The link also gets, as loads, the force m (a - g) and the moment J alpha of the added part.
//! If the accelerations in this load are the true ones, the motion is that of the case: (M + M') a = f + M' a reduces
//! to M a = f.
//! The load in a step uses the accelerations of the step before.
//! The resulting error is of first order, as is the error of the engine's step. An error of the accelerations decays
//! from step to step, because the added mass M' is smaller than the total mass: M' / (M + M') is below 1.
//! See docs/numerics/twins.md.

use super::masses::added;
use super::tree::SpanningTree;
use super::window::Window;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::LinkId;

/// Added masses in one world of a free motion, and the accelerations from which the compensating loads follow.
#[derive(Debug)]
pub(super) struct Added {
    masses: Vec<[f64; 2]>,
    /// Accelerations of mass centres and angles in the last step: x, y, angle.
    accelerations: Vec<[f64; 3]>,
}

impl Added {
    /// The added masses in a world with this tree; `None` if no link needs an added mass.
    pub(super) fn of(case: &Case, tree: &SpanningTree) -> Option<Self> {
        let masses: Vec<[f64; 2]> = case.mechanism.links().ids().map(|link| added(case, link, tree)).collect();
        let accelerations = vec![[0.0; 3]; masses.len()];
        masses.iter().flatten().any(|&mass| mass > 0.0).then_some(Added { masses, accelerations })
    }

    /// Stores the accelerations of the window's last step.
    /// Before the first step, the accelerations of the last trial remain.
    pub(super) fn follow(&mut self, window: &Window) {
        if window.newest() > 0 {
            for (link, own) in self.accelerations.iter_mut().enumerate().skip(1) {
                *own = window.newest_acceleration(LinkId(link));
            }
        }
    }

    /// Stores the accelerations of a trial step from the start.
    /// Returns the largest change of a compensating load, divided by the largest compensating load.
    /// For the comparison with forces, a moment is divided by the mechanism's size.
    pub(super) fn guess(&mut self, case: &Case, mut of: impl FnMut(usize) -> [f64; 3]) -> f64 {
        let size = case.mechanism.size();
        let (mut change, mut all) = (0.0f64, 0.0f64);
        for (link, (own, masses)) in self.accelerations.iter_mut().zip(&self.masses).enumerate().skip(1) {
            let now = of(link);
            let load = |of: [f64; 3]| {
                let force = masses[0] * Vec2::new(of[0], of[1]).norm();
                force.larger(masses[1] * of[2].abs() / size)
            };
            change = change.larger(load([0, 1, 2].map(|k| now[k] - own[k])));
            all = all.larger(load(now));
            *own = now;
        }
        if all > 0.0 { change / all } else { 0.0 }
    }

    /// Writes to `relieved` the sum of `loads` and the loads that compensate the added masses.
    pub(super) fn relieve(&self, case: &Case, loads: &[Wrench], relieved: &mut [Wrench]) {
        relieved.copy_from_slice(loads);
        for ((load, [mass, inertia]), [x, y, alpha]) in relieved.iter_mut().zip(&self.masses).zip(&self.accelerations) {
            load.force += (Vec2::new(*x, *y) - case.gravity) * *mass;
            load.moment += inertia * alpha;
        }
    }
}
