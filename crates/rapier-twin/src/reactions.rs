//! Source of reactions and moments in a run.

use super::friction::InverseDynamics;
use super::guard::{Guard, guards};
use super::lines::Lines;
use super::masses::Loading;
use super::native::Native;
use super::probe::{Probe, probe_turn};
use super::rapier::{Build, Rapier};
use super::tree::SpanningTree;
use super::window::Window;
use crate::sentences;
use linkage::case::Case;
use linkage::engine::{Route, Settings};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::solver::State;
use linkage::trajectory::Stage;

/// Reactions and moments of a run.
pub(super) struct Reactions<'a> {
    source: Source<'a>,
    lines: Option<Lines>,
}

/// Source of reactions and moments.
enum Source<'a> {
    /// No reactions are requested.
    Unwanted,
    Differences(Box<InverseDynamics>),
    Native(Native),
    Probe(Probe<'a>),
}

impl<'a> Reactions<'a> {
    /// The source that the engine's settings select, and the worlds of the run.
    /// The first world moves the mechanism.
    /// The other worlds only report the joints that the first world does not report.
    /// Reports begin with step `from`.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the case has friction and the route is not [`Route::Differences`]; if the route is
    /// [`Route::Probe`] and the motion is free; or if Rapier refuses a joint.
    pub(super) fn of(engine: &Rapier, case: &'a Case, from: i64) -> Result<(Self, Vec<Guard<'a>>)> {
        let mechanism = &case.mechanism;
        let moving = || match engine.build {
            Build::Multibody => guards(engine, case, vec![SpanningTree::of(mechanism)], Loading::Moving),
            Build::Impulse => guards(engine, case, vec![SpanningTree::none(mechanism)], Loading::Moving),
        };
        let reporting = |engine: &Rapier| match engine.build {
            Build::Multibody => {
                guards(engine, case, SpanningTree::covering(mechanism, &case.wanted_reactions()), Loading::Read)
            }
            Build::Impulse => guards(engine, case, vec![SpanningTree::none(mechanism)], Loading::Read),
        };
        if case.wanted.deepest() < Stage::Reactions {
            return Ok((Reactions { source: Source::Unwanted, lines: None }, moving()?));
        }
        let (source, worlds) = match engine.settings.route {
            Route::Differences => (Source::Differences(Box::new(InverseDynamics::of(case))), moving()?),
            Route::Native | Route::Probe if case.has_friction() => {
                let help = Advice::OtherRoute { routes: &["differences"] };
                return Err(Error::new(ErrorKind::Unsupported, sentences::THE_ROUTE_KNOWS_NO_FRICTION).help(help));
            }
            Route::Native => {
                let worlds = reporting(engine)?;
                (Source::Native(Native::new(case, &worlds, &engine.settings, from)), worlds)
            }
            Route::Probe if case.is_free() => {
                let message = sentences::THE_MOTION_IS_FREE_BUT_A_PROBE;
                let help = Advice::OtherRoute { routes: &["differences", "native"] };
                return Err(Error::new(ErrorKind::Unsupported, message).help(help));
            }
            Route::Probe => {
                // A world placed in a pose has no gap to correct in its first substep.
                // A second substep would correct the gap that the first substep leaves, and the impulses would contain
                // the whole correction.
                // A tiny step therefore has a single substep.
                let undivided = engine.set(Settings { substeps: 1, ..engine.settings });
                let probe = Probe::new(case, reporting(&undivided)?, probe_turn(engine.precision));
                (Source::Probe(probe), moving()?)
            }
        };
        Ok((Reactions { source, lines: Lines::of(case) }, worlds))
    }

    /// Stores the reports of the worlds after a step.
    /// `direct` is the moment of the crank's motor (N m) that was applied as a load.
    pub(super) fn keep(&mut self, worlds: &[Guard], direct: f64) {
        if let Source::Native(native) = &mut self.source {
            native.push(worlds, direct);
        }
    }

    /// Fills in the reactions and moments of a state. They belong to the window's motion at the time `t` (s).
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] where the equations do not determine the reactions, or if a probe fails.
    pub(super) fn solve(&mut self, case: &Case, window: &Window, state: &mut State, t: f64) -> Result<()> {
        match &mut self.source {
            Source::Unwanted => {}
            Source::Differences(dynamics) => return dynamics.sample(case, state, t),
            Source::Native(native) => native.solve(case, state, t)?,
            Source::Probe(probe) => probe.solve(case, window, state, t)?,
        }
        self.lines.as_mut().map_or(Ok(()), |lines| lines.change(case, state, t))
    }
}
