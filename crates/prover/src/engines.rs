//! All engines: one variant and one line for each.

#[cfg(feature = "simbody")]
pub use simbody_twin::Simbody;

use linkage::case::Case;
use linkage::engine::Engine;
use linkage::error::Result;
use linkage::math::KeepNan;
use rapier_twin::{Build, Precision, Rapier};

/// An engine by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EngineName {
    /// Rapier in f64, the default: a spanning tree as a multibody, loops closed by impulse joints.
    Rapier,
    /// The same in single precision; needs the feature `f32`.
    RapierF32,
    /// Rapier in f64, every link a body of its own.
    Impulse,
    /// The same in single precision; needs the feature `f32`.
    ImpulseF32,
    /// Simbody; needs the feature `simbody`, and the library.
    Simbody,
}

impl EngineName {
    /// All engines, the default first, whether this build has them or not.
    pub const ALL: [EngineName; 5] =
        [EngineName::Rapier, EngineName::RapierF32, EngineName::Impulse, EngineName::ImpulseF32, EngineName::Simbody];

    /// Name of the engine, as on the command line and in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            EngineName::Rapier => "rapier",
            EngineName::RapierF32 => "rapier-f32",
            EngineName::Impulse => "impulse",
            EngineName::ImpulseF32 => "impulse-f32",
            EngineName::Simbody => "simbody",
        }
    }

    /// The engine called `name`.
    #[must_use]
    pub fn named(name: &str) -> Option<EngineName> {
        EngineName::ALL.into_iter().find(|engine| engine.name() == name)
    }

    /// Cargo feature that a build needs to have the engine; `None` if it always has it.
    #[must_use]
    pub fn feature(self) -> Option<&'static str> {
        match self {
            EngineName::Rapier | EngineName::Impulse => None,
            EngineName::RapierF32 | EngineName::ImpulseF32 => Some("f32"),
            EngineName::Simbody => Some("simbody"),
        }
    }

    /// Whether this build has the engine.
    #[must_use]
    pub fn is_built(self) -> bool {
        match self {
            EngineName::Rapier | EngineName::Impulse => true,
            EngineName::RapierF32 | EngineName::ImpulseF32 => cfg!(feature = "f32"),
            EngineName::Simbody => cfg!(feature = "simbody"),
        }
    }

    /// The engine with its own default settings. An engine with a fixed step runs at the time step `step` (s), an
    /// engine that controls its error at an accuracy of its own.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) if this build does not have it, with the feature
    /// that it needs.
    pub fn with_step(self, step: f64) -> Result<Box<dyn Engine>> {
        let rapier =
            |build, precision| -> Result<Box<dyn Engine>> { Ok(Box::new(Rapier::new(build, precision, step))) };
        match self {
            EngineName::Rapier => rapier(Build::Multibody, Precision::Double),
            EngineName::Impulse => rapier(Build::Impulse, Precision::Double),
            #[cfg(feature = "f32")]
            EngineName::RapierF32 => rapier(Build::Multibody, Precision::Single),
            #[cfg(feature = "f32")]
            EngineName::ImpulseF32 => rapier(Build::Impulse, Precision::Single),
            #[cfg(feature = "simbody")]
            EngineName::Simbody => Ok(Box::new(simbody_twin::Simbody::new(simbody_twin::Simbody::ACCURACY))),
            #[cfg(not(feature = "f32"))]
            EngineName::RapierF32 | EngineName::ImpulseF32 => Err(self.missing()),
            #[cfg(not(feature = "simbody"))]
            EngineName::Simbody => Err(self.missing()),
        }
    }

    #[cfg(not(all(feature = "f32", feature = "simbody")))]
    fn missing(self) -> linkage::Error {
        let (name, feature) = (self.name(), self.feature().unwrap_or_default());
        let message = format!("the engine \"{name}\" is asked for, but this build does not have it");
        linkage::Error::new(linkage::ErrorKind::Unsupported, message)
            .help(format!("build with the cargo feature \"{feature}\""))
    }
}

/// Rotation of the fastest driving link in a step that is usual (rad): a quarter of a degree.
const USUAL_TURN: f64 = std::f64::consts::PI / 720.0;
/// The same of the first, coarse step of a search: two degrees.
const COARSE_TURN: f64 = std::f64::consts::PI / 90.0;

/// A time step (s) at which an engine is good to some 1e-4 in most cases: a quarter of a degree of the fastest driving
/// link, or, where forces decide the motion, at most a ten-thousandth of its duration.
#[must_use]
pub fn usual_step(case: &Case) -> f64 {
    step(case, USUAL_TURN, 1e-4)
}

/// The time step (s) that a search of settings begins with.
pub(crate) fn coarse_step(case: &Case) -> f64 {
    step(case, COARSE_TURN, 4e-3)
}

fn step(case: &Case, turn: f64, share: f64) -> f64 {
    let last = case.grid.times.iter().fold(0.0f64, |last, t| last.larger(t.abs()));
    let (by_turn, by_time) = (turn / case.drives.top_speed(), share * if last > 0.0 { last } else { 1.0 });
    // Links at rest turn nowhere, and a motion under forces may become much faster than it begins.
    if case.is_free() || !by_turn.is_finite() { by_turn.smaller(by_time) } else { by_turn }
}

/// Every engine that this build has, the default first, as [`EngineName::with_step`] makes it.
#[must_use]
pub fn all(step: f64) -> Vec<Box<dyn Engine>> {
    EngineName::ALL.into_iter().filter_map(|engine| engine.with_step(step).ok()).collect()
}

/// The engine called `name`, as [`all`] has it.
#[must_use]
pub fn named(name: &str, step: f64) -> Option<Box<dyn Engine>> {
    EngineName::named(name)?.with_step(step).ok()
}

/// Whether the current thread is inside a call whose panic is caught and becomes an error, such as a step of an engine.
/// The panic hook of a program may stay silent then.
#[must_use]
pub fn panic_is_caught() -> bool {
    linkage::quiet::is_guarded()
}
