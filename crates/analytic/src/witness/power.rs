//! Balance of powers: the balancing moment, computed without reactions.

use linkage::case::Case;
use linkage::math::Motion;
use linkage::mechanism::Link;
use linkage::solver::State;

/// Power of gravity, inertia and loads on all links (W): sum of m (g - a) . v - J alpha omega, plus the power of the
/// loads.
#[must_use]
pub fn of_known_forces(case: &Case, state: &State) -> f64 {
    let power = |(body, motion): (&Link, &Motion)| {
        let force = (case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
        force.dot(&motion.point_velocity(body.mass_centre)) - body.inertia * motion.alpha * motion.omega
    };
    let own: f64 = case.mechanism.links().iter().zip(&state.motions).skip(1).map(power).sum();
    own + case.load_power(&state.motions, &state.angles, state.reactions())
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
