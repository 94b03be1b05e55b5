//! Momentum of the whole mechanism: the shaking force and moment, computed without reactions.

use linkage::case::Case;
use linkage::math::{Vec2, cross};
use linkage::solver::State;

/// Shaking force (N) and shaking moment about the origin (N m) from d'Alembert's principle for all moving links
/// together.
/// Reactions between moving links cancel.
/// Loads between two links cancel as well. The frame counts as a link here.
/// The frame carries F = sum of m (g - a) + loads and M = sum of r x m (g - a) - J alpha + loads.
#[must_use]
pub fn shaking(case: &Case, state: &State) -> (Vec2, f64) {
    let (mut force, mut moment) = (Vec2::zeros(), 0.0);
    for (index, link) in case.mechanism.links().entries().skip(1) {
        let motion = &state.motions[index];
        let own = (case.gravity - motion.point_acceleration(link.mass_centre)) * link.mass;
        force += own;
        moment += cross(motion.point(link.mass_centre), own) - link.inertia * motion.alpha;
    }
    case.each_load(&state.motions, &state.angles, state.reactions(), |action| {
        force += action.force;
        moment += action.about(Vec2::zeros());
    });
    (force, moment)
}
