//! Balance of powers: the balancing moment, computed without reactions.

use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::solver::State;

/// Calls `put` with the powers whose sum is the power of all known forces (W).
fn each(case: &Case, state: &State, mut put: impl FnMut(f64)) {
    for (body, motion) in case.mechanism.links().iter().zip(&state.motions).skip(1) {
        let force = (case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
        put(force.dot(&motion.point_velocity(body.mass_centre)));
        put(-body.inertia * motion.alpha * motion.omega);
    }
    case.each_load(&state.motions, &state.angles, state.reactions(), |action| {
        put(action.power(&state.motions[action.link]));
    });
}

/// Power of gravity, inertia and loads on all links (W): sum of m (g - a) . v - J alpha omega, plus the power of the
/// loads.
#[must_use]
pub fn of_known_forces(case: &Case, state: &State) -> f64 {
    let mut sum = 0.0;
    each(case, state, |power| sum += power);
    sum
}

/// The largest magnitude of the powers that [`of_known_forces`] adds (W). The rounding error of the sum is proportional
/// to this magnitude.
#[must_use]
pub fn largest(case: &Case, state: &State) -> f64 {
    let mut largest: f64 = 0.0;
    each(case, state, |power| largest = largest.larger(power.abs()));
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
