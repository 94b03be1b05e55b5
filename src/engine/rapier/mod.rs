//! Rapier multibody in double precision.
//!
//! The twin takes from the case its geometry, masses, drive and the pose at t = 0, nothing later. It first drives itself
//! backwards to a little before the first instant wanted and then forwards, so that the transient of
//! the first steps has died away before anything is read.

mod joints;
mod newton_euler;
mod noise;
pub mod tree;
pub mod twin;
mod window;

use super::{Engine, Route, Settings};
use crate::case::Case;
use crate::error::{Error, ErrorKind, Result};
use crate::solver::{Progress, Provision, Solver, State};
use crate::trajectory::{Channel, ChannelKind, Stage};
use newton_euler::NewtonEuler;
use twin::Twin;
use window::Window;

/// Steps that the transient of a start or of a turn-about takes to fall below rounding (one does; the rest is margin).
const SETTLING_STEPS: i64 = 3;
/// More steps than this are refused: they would take minutes, and most likely a unit is wrong.
const MAX_STEPS: f64 = 2e7;

/// Rapier multibody, `rapier2d-f64`.
#[derive(Clone, Copy, Debug)]
pub struct Rapier {
    settings: Settings,
}

impl Rapier {
    /// Solver sweeps a step. With 256, random chains of three dyads keep a first-order error in their velocities that the ladder of
    /// steps does not see; with 512 one in a hundred channels does, with 1024 none of those tried.
    pub const SWEEPS: usize = 1024;

    /// The engine with the time step `step` (s).
    #[must_use]
    pub fn new(step: f64) -> Self {
        let (sweeps, substeps, route) = (Self::SWEEPS, 1, Route::Differences);
        Rapier { settings: Settings { resolution: step, sweeps, substeps, route, extrapolated: false } }
    }
}

impl Engine for Rapier {
    fn version(&self) -> String {
        "rapier2d-f64 0.36.1".into()
    }

    fn settings(&self) -> Settings {
        self.settings
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        Box::new(Rapier { settings })
    }

    fn routes(&self) -> &'static [Route] {
        &[Route::Differences]
    }

    fn formal_order(&self, _: &ChannelKind) -> f64 {
        2.0
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        noise::bound(case, self.settings.resolution, channel)
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        vec![
            ("build", "spanning tree as multibody, loops closed by impulse joints".into()),
            ("drive", "ground-crank motor, force-based, damping 1e30".into()),
            ("sweeps", self.settings.sweeps.to_string()),
            ("substeps", "1".into()),
            ("reactions", "Newton-Euler on centred second differences of positions".into()),
        ]
    }
}

impl Solver for Rapier {
    fn name(&self) -> &'static str {
        "rapier"
    }

    fn provides(&self, channel: &Channel) -> Provision {
        match channel.kind.stage {
            Stage::Positions => Provision::Computed,
            Stage::Velocities => {
                Provision::Derived("read as generalised velocities, one step old, and carried along the tree")
            }
            Stage::Accelerations => Provision::Derived("centred second differences of the engine's positions"),
            Stage::Reactions | Stage::BalancingMoment => {
                Provision::Derived("Newton-Euler on centred second differences of the engine's positions")
            }
        }
    }

    fn sweep(&self, case: &Case, visit: &mut dyn FnMut(usize, &State) -> Result<()>, progress: Progress) -> Result<()> {
        let rows = case.grid.ascending();
        let (Some(&first), Some(&last)) = (rows.first(), rows.last()) else { return Ok(()) };
        let step = self.settings.resolution;
        let begin = (case.grid.times[first].min(0.0) / step).floor();
        let end = (case.grid.times[last] / step).floor();
        check_steps(step, end - begin)?;
        let start = begin as i64 - Window::BEHIND - SETTLING_STEPS;
        let total = (end as i64 + Window::AHEAD - start) as f64;

        let mut twin = Twin::new(case, step, self.settings.sweeps)?;
        twin.drive_at(case, -1.0);
        for _ in start..0 {
            twin.step()?;
        }
        twin.drive_at(case, 1.0);
        let mut window = Window::new(case, step, start);
        let mut statics = (case.wanted.deepest() >= Stage::Reactions).then(|| NewtonEuler::new(case));
        let mut state = State::at_rest(case);
        window.push(&twin, case);
        for row in rows {
            let t = case.grid.times[row];
            while !window.covers(t) {
                twin.step()?;
                window.push(&twin, case);
                if window.newest() == 0 {
                    twin.check_start(case)?;
                }
                if window.newest() % 256 == 0 {
                    progress((window.newest() - start) as f64 / total);
                }
            }
            window.sample(case, t, &mut state);
            if let Some(statics) = &mut statics {
                statics.solve(case, &mut state, t)?;
            }
            visit(row, &state)?;
        }
        progress(1.0);
        Ok(())
    }
}

fn check_steps(step: f64, steps: f64) -> Result<()> {
    let wrong = |message: String, help: &str| Err(Error::new(ErrorKind::Input, message).help(help));
    if !(step > 0.0 && step.is_finite()) {
        return wrong(format!("the engine's time step is {step} s"), "give a time step greater than zero");
    }
    if !(steps <= MAX_STEPS) {
        return wrong(
            format!("a time step of {step:e} s needs {steps:.3e} steps for this grid, the limit is {MAX_STEPS:e}"),
            "choose a larger time step or a shorter grid",
        );
    }
    Ok(())
}
