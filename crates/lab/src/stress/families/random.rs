//! Random mechanisms of dyads of all five kinds.

use linkage::error::{Error, ErrorKind, Result};

use crate::specimens::dyads::{SORTS, chain, sample};
use crate::specimens::sketch::RandomSource;
use crate::stress::{Setup, StressFamily};

/// Largest number of random mechanisms that are tried in the search for one that stays away from dead points.
const MOST_DRAWN: usize = 100_000;
/// Step of the grid (rad) and number of steps.
const STEP: f64 = 0.05;
const STEPS: usize = 12;

/// Family of random mechanisms that varies the number of links.
pub(super) const RANDOM: StressFamily = StressFamily {
    name: "random",
    dial: "number of links, including the ground",
    title: "random mechanisms of dyads with revolute and prismatic joints, at least 10 deg from dead points",
    points: &[4.0, 6.0, 8.0, 10.0, 12.0, 14.0],
    quick: &[4.0, 8.0],
    samples: 4,
    setup: |links, number, seed| drawn((links as usize - 2) / 2, number, seed),
};

/// The mechanism of `dyads` dyads with this sample number and seed.
fn drawn(dyads: usize, number: u64, seed: u64) -> Result<Setup> {
    let mut random = RandomSource::of_sample(seed, 1000 * dyads as u64 + number);
    for _ in 0..MOST_DRAWN {
        let (mut spec, _) = chain(&mut random, &SORTS, dyads);
        // The double-double reference does not support moments that jump where a link reverses, so all loads are
        // removed.
        // The tests in `tests/suite/loads/jumps.rs` cover moments that jump.
        spec.loads.clear();
        spec.dt = None;
        // The grid begins at the start pose and follows the crank's direction.
        spec.grid = (spec.start, STEP.copysign(spec.speed), STEPS);
        if let Some(found) = sample(spec) {
            return Ok(Setup::usual(found.scenario.case));
        }
    }
    let message = format!("none of {MOST_DRAWN} random mechanisms of {dyads} dyads stays away from dead points");
    Err(Error::new(ErrorKind::Geometry, message))
}
