//! Momentum of the whole mechanism: the shaking force and moment, computed without reactions.

use linkage::case::Case;
use linkage::drive::Action;
use linkage::math::{KeepNan, Vec2};
use linkage::solver::State;

/// Calls `put` with the actions whose sum is the shaking force and moment: weights, inertia forces and loads.
fn each(case: &Case, state: &State, mut put: impl FnMut(Action)) {
    for (index, link) in case.mechanism.links().entries().skip(1) {
        let motion = &state.motions[index];
        let force = (case.gravity - motion.point_acceleration(link.mass_centre)) * link.mass;
        let (place, moment) = (motion.point(link.mass_centre), -link.inertia * motion.alpha);
        put(Action { link: index, force, place, moment });
    }
    case.each_load(&state.motions, &state.angles, state.reactions(), put);
}

/// Shaking force (N) and shaking moment about the origin (N m) from d'Alembert's principle for all moving links
/// together.
/// Reactions between moving links cancel.
/// Loads between two links cancel as well. The frame counts as a link here.
/// The frame carries F = sum of m (g - a) + loads and M = sum of r x m (g - a) - J alpha + loads.
#[must_use]
pub fn shaking(case: &Case, state: &State) -> (Vec2, f64) {
    let mut sum = (Vec2::zeros(), 0.0);
    each(case, state, |action| sum = (sum.0 + action.force, sum.1 + action.about(Vec2::zeros())));
    sum
}

/// The largest magnitudes of the forces (N) and moments (N m) that [`shaking`] adds. The rounding errors of the sums
/// are proportional to these magnitudes. The magnitude of a force's moment is the force times the distance of its point
/// from the origin, because the products of coordinates are rounded even where they cancel.
#[must_use]
pub fn largest(case: &Case, state: &State) -> (f64, f64) {
    let mut largest: (f64, f64) = (0.0, 0.0);
    each(case, state, |action| {
        let force = action.force.norm();
        let moment = (force * action.place.norm()).larger(action.moment.abs());
        largest = (largest.0.larger(force), largest.1.larger(moment));
    });
    largest
}
