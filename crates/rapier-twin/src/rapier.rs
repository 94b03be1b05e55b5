//! The engine: build of the mechanism, precision, and settings.

use super::masses::Loading;
use super::tree::SpanningTree;
use super::world::World;
use linkage::case::Case;
use linkage::engine::{Route, Settings};
use linkage::error::Result;

/// Method of building a mechanism in Rapier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Build {
    /// The spanning tree is a multibody; impulse joints close the loops.
    Multibody,
    /// Every link is a separate rigid body, and every joint is an impulse joint.
    Impulse,
}

/// Precision of Rapier's floating-point numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// f64: the crate `rapier2d-f64`.
    Double,
    /// f32: the crate `rapier2d`.
    #[cfg(feature = "f32")]
    Single,
}

impl Precision {
    /// Machine epsilon: the distance from 1 to the next number.
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::Double => f64::EPSILON,
            #[cfg(feature = "f32")]
            Precision::Single => f64::from(f32::EPSILON),
        }
    }
}

/// The Rapier engine.
#[derive(Clone, Copy, Debug)]
pub struct Rapier {
    pub(super) build: Build,
    pub(super) precision: Precision,
    pub(super) settings: Settings,
}

impl Rapier {
    /// Solver sweeps per step.
    /// With 256 sweeps, velocities of random chains of three dyads keep a first-order error.
    /// The error estimate does not contain this error: it is the same in all runs and cancels in their differences
    /// (docs/findings.md).
    /// With 512 sweeps, one channel in a hundred keeps this error; with 1024 sweeps, no tested channel keeps it.
    pub const SWEEPS: usize = 1024;
    /// Sweeps per step of the impulse build, where errors propagate along the chain joint by joint.
    /// With 1024 sweeps, `crank_rocker` keeps a first-order error in its velocities; with 4096 sweeps, the error
    /// vanishes.
    pub const IMPULSE_SWEEPS: usize = 4096;

    /// The engine with the time step `step` (s) and otherwise its default settings.
    pub fn new(build: Build, precision: Precision, step: f64) -> Self {
        let (substeps, route) = (1, Route::Differences);
        let sweeps = match build {
            Build::Multibody => Self::SWEEPS,
            Build::Impulse => Self::IMPULSE_SWEEPS,
        };
        Rapier { build, precision, settings: Settings { resolution: step, sweeps, substeps, route, extrapolated: 0 } }
    }

    /// This engine with the given settings, but without extrapolation.
    pub fn set(&self, settings: Settings) -> Self {
        Rapier { settings: Settings { extrapolated: 0, ..settings }, ..*self }
    }

    /// Engines of both builds in every precision, the default engine first. Single precision needs the feature `f32`.
    pub fn all(step: f64) -> Vec<Self> {
        let of = |(build, precision)| Rapier::new(build, precision, step);
        let kinds = [
            (Build::Multibody, Precision::Double),
            #[cfg(feature = "f32")]
            (Build::Multibody, Precision::Single),
            (Build::Impulse, Precision::Double),
            #[cfg(feature = "f32")]
            (Build::Impulse, Precision::Single),
        ];
        kinds.map(of).to_vec()
    }

    /// The bare world of a case in its start pose, at rest, with the given tree.
    /// `read` must be true if the caller reads reactions.
    /// This world serves to study Rapier itself. A run uses [`Solver::sweep`](linkage::solver::Solver::sweep) instead.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) if Rapier refuses a joint.
    pub fn world(&self, case: &Case, tree: SpanningTree, read: bool) -> Result<Box<dyn World>> {
        self.world_for(case, tree, if read { Loading::Bare } else { Loading::Moving })
    }

    /// The world that a run of a case uses.
    pub(super) fn world_for(&self, case: &Case, tree: SpanningTree, loading: Loading) -> Result<Box<dyn World>> {
        Ok(match self.precision {
            Precision::Double => Box::new(crate::double::twins::Twin::new(case, tree, &self.settings, loading)?),
            #[cfg(feature = "f32")]
            Precision::Single => Box::new(crate::single::twins::Twin::new(case, tree, &self.settings, loading)?),
        })
    }
}
