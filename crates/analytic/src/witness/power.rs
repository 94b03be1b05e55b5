//! Balance of powers: the balancing moment, computed without reactions.

use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::solver::State;

/// Powers of gravity and inertia on each link (W): m (g - a) . v - J alpha omega.
fn of_links(case: &Case, state: &State) -> impl Iterator<Item = f64> {
    case.mechanism.links().iter().zip(&state.motions).skip(1).map(|(body, motion)| {
        let force = (case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
        force.dot(&motion.point_velocity(body.mass_centre)) - body.inertia * motion.alpha * motion.omega
    })
}

/// Power of gravity, inertia and loads on all links (W): sum of m (g - a) . v - J alpha omega, plus the power of the
/// loads.
#[must_use]
pub fn of_known_forces(case: &Case, state: &State) -> f64 {
    let own: f64 = of_links(case, state).sum();
    own + case.load_power(&state.motions, &state.angles, state.reactions())
}

/// The largest magnitude of the powers that [`of_known_forces`] adds (W). The rounding error of the sum is proportional
/// to this magnitude.
#[must_use]
pub fn largest(case: &Case, state: &State) -> f64 {
    let mut largest = of_links(case, state).map(f64::abs).fold(0.0, f64::larger);
    case.each_load(&state.motions, &state.angles, state.reactions(), |action| {
        largest = largest.larger(action.power(&state.motions[action.link]).abs());
    });
    largest
}

/// Balancing moment on the crank (N m), or driving force of the first drive (N), for which the powers of all forces sum
/// to zero.
/// The balancing moments of further drives are reduced to the first drive: the result is the sum of all moments, each
/// multiplied by the speed ratio of its drive to the first drive.
/// Ideal joints do no work, so the calculation does not need reactions. The first drive must move.
#[must_use]
pub fn balancing_moment(case: &Case, state: &State) -> f64 {
    -of_known_forces(case, state) / case.state_in(&state.motions, &state.angles).rate
}
