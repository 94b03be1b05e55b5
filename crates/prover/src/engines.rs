//! All engines of this build. Each engine is one variant of [`EngineName`] and one arm of [`with_step`].

#[cfg(feature = "simbody")]
pub use simbody_twin::Simbody;

use linkage::case::Case;
use linkage::engine::Engine;
use linkage::error::Result;
use linkage::math::KeepNan;
use rapier_twin::{Build, Precision, Rapier};

pub use scenario::EngineName;

/// Whether this build has an engine.
#[must_use]
pub fn is_built(engine: EngineName) -> bool {
    match engine.feature() {
        None => true,
        Some("f32") => cfg!(feature = "f32"),
        Some(_) => cfg!(feature = "simbody"),
    }
}

/// Creates an engine with its default settings.
/// An engine with a fixed step uses the time step `step` (s).
/// An engine with error control uses a preset accuracy instead.
///
/// # Errors
/// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) if this build does not have the engine. The error names
/// the required feature.
pub fn with_step(engine: EngineName, step: f64) -> Result<Box<dyn Engine>> {
    let rapier = |build, precision| -> Result<Box<dyn Engine>> { Ok(Box::new(Rapier::new(build, precision, step))) };
    match engine {
        EngineName::Rapier => rapier(Build::Multibody, Precision::Double),
        EngineName::Impulse => rapier(Build::Impulse, Precision::Double),
        #[cfg(feature = "f32")]
        EngineName::RapierF32 => rapier(Build::Multibody, Precision::Single),
        #[cfg(feature = "f32")]
        EngineName::ImpulseF32 => rapier(Build::Impulse, Precision::Single),
        #[cfg(feature = "simbody")]
        EngineName::Simbody => Ok(Box::new(simbody_twin::Simbody::new(simbody_twin::Simbody::ACCURACY))),
        #[cfg(not(feature = "f32"))]
        EngineName::RapierF32 | EngineName::ImpulseF32 => Err(missing(engine)),
        #[cfg(not(feature = "simbody"))]
        EngineName::Simbody => Err(missing(engine)),
    }
}

#[cfg(not(all(feature = "f32", feature = "simbody")))]
fn missing(engine: EngineName) -> linkage::Error {
    let (name, feature) = (engine.name(), engine.feature().unwrap_or_default());
    let message = crate::sentences::the_engine_is_asked_for_but_this_build(&name);
    linkage::Error::new(linkage::ErrorKind::Unsupported, message)
        .help(crate::sentences::build_with_the_cargo_feature(&feature))
}

/// Usual rotation of the fastest driving link in one step (rad): a quarter of a degree.
const USUAL_TURN: f64 = std::f64::consts::PI / 720.0;
/// Rotation of the fastest driving link (rad) in the coarse time step with which a search for settings begins: two
/// degrees.
const COARSE_TURN: f64 = std::f64::consts::PI / 90.0;

/// In a step, an oscillating law may proceed by an angle of its period that is sixteen times the angle of the fastest
/// driving link.
const OF_PERIOD: f64 = 1.0 / 16.0;

/// A time step (s) at which an engine is accurate to about 1e-4 in most cases.
/// The fastest driving link rotates by a quarter of a degree per step.
/// If forces determine the motion, the step is at most a ten-thousandth of the duration.
#[must_use]
pub fn usual_step(case: &Case) -> f64 {
    step(case, USUAL_TURN, 1e-4)
}

/// The time step (s) with which the search for an engine's settings begins.
pub(crate) fn coarse_step(case: &Case) -> f64 {
    step(case, COARSE_TURN, 4e-3)
}

fn step(case: &Case, turn: f64, share: f64) -> f64 {
    let last = case.grid.times.iter().fold(0.0f64, |last, t| last.larger(t.abs()));
    // A law that oscillates about one position with a small amplitude has a short period although its speed is small.
    let speed = case.drives.top_speed(case.mechanism.size());
    let pace = case.drives.iter().fold(speed, |most: f64, drive| most.larger(OF_PERIOD * drive.pace()));
    let (by_turn, by_time) = (turn / pace, share * if last > 0.0 { last } else { 1.0 });
    // For links at rest, the limit from the rotation is infinite, so the duration limits the step. A motion under
    // forces may become much faster than at its start, so the duration also limits the step of such a motion.
    if case.is_free() || !by_turn.is_finite() { by_turn.smaller(by_time) } else { by_turn }
}

/// All engines of this build, created by [`with_step`]. The default engine comes first.
#[must_use]
pub fn all(step: f64) -> Vec<Box<dyn Engine>> {
    EngineName::ALL.into_iter().filter_map(|engine| with_step(engine, step).ok()).collect()
}

/// The engine called `name`, as created by [`all`].
#[must_use]
pub fn named(name: &str, step: f64) -> Option<Box<dyn Engine>> {
    with_step(EngineName::named(name)?, step).ok()
}
