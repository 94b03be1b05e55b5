//! Momentum of the whole mechanism: the shaking force and moment, computed without reactions.

use linkage::case::Case;
use linkage::math::{KeepNan, Vec2, cross};
use linkage::solver::State;

/// Calls `put` with the forces (N) whose sum is the shaking force, each with its moment about the origin (N m).
fn each(case: &Case, state: &State, mut put: impl FnMut(Vec2, f64)) {
    for (index, link) in case.mechanism.links().entries().skip(1) {
        let motion = &state.motions[index];
        let own = (case.gravity - motion.point_acceleration(link.mass_centre)) * link.mass;
        put(own, cross(motion.point(link.mass_centre), own) - link.inertia * motion.alpha);
    }
    case.each_load(&state.motions, &state.angles, state.reactions(), |action| {
        put(action.force, action.about(Vec2::zeros()));
    });
}

/// Shaking force (N) and shaking moment about the origin (N m) from d'Alembert's principle for all moving links
/// together.
/// Reactions between moving links cancel.
/// Loads between two links cancel as well. The frame counts as a link here.
/// The frame carries F = sum of m (g - a) + loads and M = sum of r x m (g - a) - J alpha + loads.
#[must_use]
pub fn shaking(case: &Case, state: &State) -> (Vec2, f64) {
    let mut sum = (Vec2::zeros(), 0.0);
    each(case, state, |force, moment| sum = (sum.0 + force, sum.1 + moment));
    sum
}

/// The largest magnitudes of the forces (N) and moments (N m) that [`shaking`] adds. The rounding errors of the sums
/// are proportional to these magnitudes.
#[must_use]
pub fn largest(case: &Case, state: &State) -> (f64, f64) {
    let mut largest: (f64, f64) = (0.0, 0.0);
    each(case, state, |force, moment| {
        largest = (largest.0.larger(force.norm()), largest.1.larger(moment.abs()));
    });
    largest
}
