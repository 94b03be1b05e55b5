//! An engine's runs, from which its error is estimated.

use super::observe::{Observed, Stopped, observe};
use crate::compare::Ladder;
use linkage::case::Case;
use linkage::engine::{Engine, Settings};
use linkage::error::Advice;

/// An engine's runs.
pub(super) struct Runs {
    /// Runs at double, single and half the resolution.
    pub(super) resolutions: [Observed; 3],
    /// Run at the single resolution with half the sweeps; `None` for an engine that does not iterate.
    pub(super) fewer_sweeps: Option<Observed>,
}

impl Runs {
    pub(super) fn single(&self) -> &Observed {
        &self.resolutions[1]
    }

    pub(super) fn ladder(&self) -> Ladder<'_> {
        Ladder {
            resolutions: [0, 1, 2].map(|k| &self.resolutions[k].trajectory),
            fewer_sweeps: self.fewer_sweeps.as_ref().map(|run| &run.trajectory),
        }
    }
}

/// Runs the engine at double, single and half the resolution, and with half the sweeps.
pub(super) fn run_ladder(
    case: &Case,
    engine: &dyn Engine,
    progress: &mut dyn FnMut(f64),
) -> std::result::Result<Runs, Stopped> {
    let settings = engine.settings();
    let iterates = settings.sweeps > 1;
    // The finest run costs twice the single step, the coarsest half of it.
    let whole = if iterates { 4.0 } else { 3.5 };
    let (asked, sweeps) = (settings.resolution, settings.sweeps / 2);
    let at = |factor: f64| Settings { resolution: asked * factor, ..settings };
    // The single step runs first: if it fails, its message is the useful one.
    let mut rungs = vec![settings, at(0.5), at(2.0)];
    if iterates {
        rungs.push(Settings { sweeps, ..settings });
    }
    let rungs = engine.ladder(&rungs);
    let mut done = 0.0;
    let mut run = |rung: usize, cost: f64| {
        let observed = observe(case, rungs[rung].as_ref(), &mut |part| progress((done + cost * part) / whole));
        done += cost;
        observed
    };
    let unit = if engine.controls_error() { "" } else { " s" };
    let of_ladder = |what: String| move |stopped: Stopped| in_ladder(stopped, &what, engine);
    let single = run(0, 1.0)?;
    let half = run(1, 2.0).map_err(of_ladder(format!("at {:e}{unit}", asked / 2.0)))?;
    let double = run(2, 0.5).map_err(of_ladder(format!("at {:e}{unit}", asked * 2.0)))?;
    let fewer_sweeps = match iterates {
        true => Some(run(3, 0.5).map_err(of_ladder(format!("with {sweeps} sweeps")))?),
        false => None,
    };
    Ok(Runs { resolutions: [double, single, half], fewer_sweeps })
}

/// The same failure, with a message that says which auxiliary run failed: the user did not ask for that run.
fn in_ladder(stopped: Stopped, what: &str, engine: &dyn Engine) -> Stopped {
    let Settings { resolution, sweeps, .. } = engine.settings();
    let told = |message: &str| {
        format!("the run {what}, from which the error of the run asked for is estimated, failed: {message}")
    };
    // Values to try start from the settings that the user asked for.
    let advised = |advice: Advice| advice.from_settings(resolution, engine.controls_error(), sweeps);
    Stopped { error: stopped.error.map_message(told).map_advice(advised), kept: None }
}
