//! Rapier, in two builds and two precisions.
//!
//! A world takes from the case its geometry, masses, drives and the pose at t = 0, nothing later. It first drives itself
//! backwards to a little before the first instant wanted and then forwards, so that the transient of
//! the first steps has died away before anything is read.

mod double;
mod free;
mod ghost;
mod guard;
mod native;
mod newton_euler;
mod noise;
mod probe;
mod quiet;
mod ring;
mod run;
mod single;
mod window;
pub mod world;

use super::extrapolated::Extrapolated;
use super::{Engine, Route, Settings};
use crate::case::Case;
use crate::error::Result;
pub use crate::mechanism::spanning_tree as tree;
use crate::solver::{Progress, Provision, Solver, Visit};
use crate::trajectory::{Channel, ChannelKind, Stage};
use tree::Tree;
use world::World;

/// How a mechanism is put together in Rapier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Build {
    /// A spanning tree as a multibody, loops closed by impulse joints.
    Multibody,
    /// Bodies of their own, every joint an impulse joint.
    Impulse,
}

/// Length of Rapier's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// f64: the crate `rapier2d-f64`.
    Double,
    /// f32: the crate `rapier2d`.
    Single,
}

impl Precision {
    /// Distance from one to the next number.
    #[must_use]
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::Double => f64::EPSILON,
            Precision::Single => f64::from(f32::EPSILON),
        }
    }
}

/// Rapier.
#[derive(Clone, Copy, Debug)]
pub struct Rapier {
    build: Build,
    precision: Precision,
    settings: Settings,
}

impl Rapier {
    /// Solver sweeps a step. With 256, random chains of three dyads keep a first-order error in their velocities that the ladder of
    /// steps does not see; with 512 one in a hundred channels does, with 1024 none of those tried.
    pub const SWEEPS: usize = 1024;
    /// Sweeps of the impulse build, whose errors go along the chain joint by joint: with 1024 `crank_rocker` keeps a first-order error in
    /// its velocities, with 4096 none.
    pub const IMPULSE_SWEEPS: usize = 4096;

    /// The engine with the time step `step` (s) and else its default settings.
    #[must_use]
    pub fn new(build: Build, precision: Precision, step: f64) -> Self {
        let (substeps, route) = (1, Route::Differences);
        let sweeps = match build {
            Build::Multibody => Self::SWEEPS,
            Build::Impulse => Self::IMPULSE_SWEEPS,
        };
        Rapier {
            build,
            precision,
            settings: Settings { resolution: step, sweeps, substeps, route, extrapolated: false },
        }
    }

    /// The same build and precision with other settings, not extrapolated.
    #[must_use]
    pub fn set(&self, settings: Settings) -> Self {
        Rapier { settings: Settings { extrapolated: false, ..settings }, ..*self }
    }

    /// Both builds in both precisions, the default first.
    #[must_use]
    pub fn all(step: f64) -> [Self; 4] {
        let of = |(build, precision)| Rapier::new(build, precision, step);
        [
            (Build::Multibody, Precision::Double),
            (Build::Multibody, Precision::Single),
            (Build::Impulse, Precision::Double),
            (Build::Impulse, Precision::Single),
        ]
        .map(of)
    }

    /// The bare world of a case in its start pose, at rest, with the tree given; `read` if its reactions will be read. For looking at
    /// what Rapier itself does; a run is [`Solver::sweep`].
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) if Rapier refuses a joint.
    pub fn world(&self, case: &Case, tree: Tree, read: bool) -> Result<Box<dyn World>> {
        Ok(match self.precision {
            Precision::Double => Box::new(double::twins::Twin::new(case, tree, &self.settings, read)?),
            Precision::Single => Box::new(single::twins::Twin::new(case, tree, &self.settings, read)?),
        })
    }
}

impl Engine for Rapier {
    fn version(&self) -> String {
        match self.precision {
            Precision::Double => "rapier2d-f64 0.36.1".into(),
            Precision::Single => "rapier2d 0.36.1".into(),
        }
    }

    fn settings(&self) -> Settings {
        self.settings
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        let plain = self.set(settings);
        if settings.extrapolated { Box::new(Extrapolated::new(Box::new(plain))) } else { Box::new(plain) }
    }

    fn routes(&self) -> &'static [Route] {
        &Route::ALL
    }

    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        let native = self.settings.route == Route::Native && channel.stage >= Stage::Reactions;
        // Under forces each step takes what acts at its beginning for the whole of it.
        if native || case.is_free() { 1.0 } else { 2.0 }
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        noise::bound(case, self, channel)
    }

    fn is_noise_measured(&self) -> bool {
        true
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        let build = match self.build {
            Build::Multibody => "spanning tree as multibody, loops closed by impulse joints",
            Build::Impulse => "bodies of their own, every joint an impulse joint",
        };
        let drive = match self.build {
            Build::Multibody => "ground-crank motor, force-based, damping 1e30",
            Build::Impulse => "ground-crank motor, force-based, damping 1e30, speed tan(omega dt) / dt",
        };
        vec![
            ("build", build.into()),
            ("drive", drive.into()),
            ("flywheel", "on driving links: all masses times the square of the largest length".into()),
            ("sweeps", self.settings.sweeps.to_string()),
            ("substeps", self.settings.substeps.to_string()),
            ("reactions", self.how().into()),
        ]
    }
}

impl Rapier {
    /// How reactions and moments come about.
    fn how(&self) -> &'static str {
        match (self.settings.route, self.build) {
            (Route::Differences, _) => "Newton-Euler on centred second differences of the engine's positions",
            (Route::Native, Build::Multibody) => "the engine's impulses, each joint in a world whose tree is cut there",
            (Route::Native, Build::Impulse) => "the engine's impulses",
            (Route::Probe, Build::Multibody) => {
                "the engine's impulses in tiny steps from its own poses, each joint in a world whose tree is cut there"
            }
            (Route::Probe, Build::Impulse) => "the engine's impulses in tiny steps from its own poses",
        }
    }
}

impl Solver for Rapier {
    fn name(&self) -> &'static str {
        match (self.build, self.precision) {
            (Build::Multibody, Precision::Double) => "rapier",
            (Build::Multibody, Precision::Single) => "rapier-f32",
            (Build::Impulse, Precision::Double) => "impulse",
            (Build::Impulse, Precision::Single) => "impulse-f32",
        }
    }

    fn provides(&self, channel: &Channel) -> Provision {
        match (channel.kind.stage, self.build) {
            (Stage::Positions, _) => Provision::Computed,
            (Stage::Velocities, Build::Multibody) => Provision::Derived(
                "read as generalised velocities, one step old, and carried along the tree; where a drive's speed changes, centred differences of positions",
            ),
            (Stage::Velocities, Build::Impulse) => Provision::Derived(
                "read as the bodies' velocities, one step old; of omega what a step turns by; where a drive's speed changes, centred differences of positions",
            ),
            (Stage::Accelerations, _) => Provision::Derived("centred second differences of the engine's positions"),
            (Stage::Reactions | Stage::BalancingMoment, _) => Provision::Derived(self.how()),
        }
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        run::sweep(self, case, visit, progress)
    }
}
