//! One run: worlds that run in parallel in simulated time, and the values sampled from these worlds.

use super::branch::Branches;
use super::free::{self, Acting};
use super::guard::Guard;
use super::rapier::Rapier;
use super::reactions::Reactions;
use super::window::Window;
use crate::sentences;
use linkage::case::Case;
use linkage::engine::Settings;
use linkage::error::{Advice, Error, ErrorKind, Result, RunReached};
use linkage::math::KeepNan;
use linkage::solver::{Progress, State, Visit, check_instants};

/// Number of steps after which the transient of a start or of a reversal is below rounding error.
/// One step is enough; the additional steps are a margin.
const SETTLING_STEPS: i64 = 3;
/// Upper limit of the number of steps of a run.
/// A case with more steps would run for minutes; most likely, one of its numbers has the wrong unit.
const MAX_STEPS: f64 = 2e7;

/// Solves a case: see [`Solver::sweep`](linkage::solver::Solver::sweep).
pub(super) fn sweep(engine: &Rapier, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
    check_instants(case)?;
    let rows = case.grid.ascending();
    let (Some(&first), Some(&last)) = (rows.first(), rows.last()) else { return Ok(()) };
    let step = engine.settings.resolution;
    let begin = (case.grid.times[first].smaller(0.0) / step).floor();
    let end = (case.grid.times[last] / step).floor();
    check(&engine.settings, end - begin)?;
    let start = if case.is_free() { 0 } else { begin as i64 - overrun(&engine.settings) };
    let total = (end as i64 + Window::AHEAD - start) as f64;
    let mut visited = None;
    let mut run = Run::new(engine, case, start)?;
    run.aim(case.grid.times[first]);
    let go = || {
        run.begin(start)?;
        let (mut state, mut branches) = (State::at_rest(case), Branches::of(case));
        for row in rows {
            let t = case.grid.times[row];
            let last = run.aim(t);
            while run.window.newest() < last {
                run.step()?;
                if run.window.newest() % 256 == 0 {
                    progress((run.window.newest() - start) as f64 / total);
                }
            }
            run.window.sample(case, t, &mut state);
            branches.check(case, &state, t)?;
            run.reactions.solve(case, &run.window, &mut state, t)?;
            visit(row, &state)?;
            visited = Some(row);
        }
        progress(1.0);
        Ok(())
    };
    let Settings { resolution, sweeps, .. } = engine.settings;
    go().map_err(|error: Error| {
        let error = error.map_advice(|advice| advice.from_settings(resolution, false, sweeps));
        reached(error, case, visited)
    })
}

fn check(settings: &Settings, steps: f64) -> Result<()> {
    let wrong = |message: String, help: &str| Err(Error::new(ErrorKind::Input, message).help(help));
    let Settings { resolution: step, sweeps, substeps, route: _, extrapolated: _ } = *settings;
    if !(step > 0.0 && step.is_finite()) {
        return wrong(sentences::the_engine_time_step_is(&step), sentences::GIVE_A_TIME_STEP_GREATER);
    }
    if sweeps == 0 || substeps == 0 {
        return wrong(
            sentences::the_engine_has_sweeps_and_substeps(&sweeps, &substeps),
            sentences::GIVE_AT_LEAST_ONE_OF_EACH,
        );
    }
    if !(steps <= MAX_STEPS) {
        let message = sentences::a_time_step_of_needs_steps(
            &format_args!("{step:e}"),
            &format_args!("{steps:.3e}"),
            &format_args!("{:e}", MAX_STEPS),
        );
        return Err(Error::new(ErrorKind::Input, message)
            .help(Advice::LargerStep { to: None })
            .or_help(sentences::GIVE_A_SHORTER_GRID));
    }
    Ok(())
}

/// Number of steps of a prescribed motion before the first instant. Fewer steps follow the last instant.
pub(super) fn overrun(settings: &Settings) -> i64 {
    Window::BEHIND + SETTLING_STEPS + Window::extra(settings.substeps)
}

struct Run<'a> {
    case: &'a Case,
    settings: Settings,
    /// Whether all drives turn with constant speeds, which need to be set only once.
    steady: bool,
    /// The first world moves the mechanism. The other worlds only report joints that the first world does not report.
    worlds: Vec<Guard<'a>>,
    window: Window,
    /// First step that the window needs for the next sample.
    needed: i64,
    reactions: Reactions<'a>,
    /// Motor and loads, in a free motion.
    acting: Option<Acting>,
}

impl<'a> Run<'a> {
    fn new(engine: &Rapier, case: &'a Case, start: i64) -> Result<Self> {
        let is_free = case.is_free();
        // In a free motion, one step lies before the beginning, so reports begin at `start - 1`.
        let (reactions, worlds) = Reactions::of(engine, case, if is_free { start - 1 } else { start })?;
        let acting = if is_free { Some(Acting::new(case, engine.precision, &worlds)?) } else { None };
        let (settings, steady) = (engine.settings, case.is_steady());
        let window = Window::new(case, &settings, start);
        Ok(Run { case, settings, steady, worlds, window, needed: i64::MIN, reactions, acting })
    }

    /// Prepares for a sample at `t` (s), and returns the number of the last step that the sample needs.
    fn aim(&mut self, t: f64) -> i64 {
        let [first, last] = self.window.needs(t);
        // In a free motion every step is needed to find motor and loads, so no step is skipped.
        self.needed = if self.acting.is_some() { i64::MIN } else { first };
        last
    }

    /// Gives all worlds of a free motion their start velocities.
    /// In a prescribed motion, drives all worlds backwards from t = 0 to step `start`, where the motion reverses.
    fn begin(&mut self, start: i64) -> Result<()> {
        if let Some(acting) = &mut self.acting {
            self.window = free::begin(self.case, acting, &mut self.worlds, &self.settings)?;
            // The first report is for the step before the beginning, the second report is for the beginning itself.
            self.report();
            self.report();
            return Ok(());
        }
        let step = self.settings.resolution;
        for guard in &mut self.worlds {
            guard.drive(|drive| drive.step_speed(0.0, -step));
            for number in (start..0).rev() {
                let (from, to) = ((number + 1) as f64 * step, number as f64 * step);
                if !self.steady {
                    guard.drive(|drive| drive.step_speed(from, to));
                }
                guard.step(to)?;
            }
            guard.drive(|drive| drive.step_speed(0.0, step));
        }
        self.take();
        Ok(())
    }

    fn step(&mut self) -> Result<()> {
        let number = self.window.newest() + 1;
        let [from, to] = [number - 1, number].map(|number| number as f64 * self.settings.resolution);
        if let Some(acting) = &mut self.acting {
            acting.act(self.case, &self.window, &mut self.worlds, [from, to])?;
        }
        for guard in &mut self.worlds {
            if !self.steady && self.acting.is_none() {
                guard.drive(|drive| drive.step_speed(from, to));
            }
            guard.step(to)?;
            if number == 0 {
                guard.check_start()?;
            }
        }
        self.take();
        Ok(())
    }

    /// Stores the worlds' state after a step.
    fn take(&mut self) {
        if self.window.newest() + 1 < self.needed {
            self.window.skip();
        } else {
            self.window.push(&self.worlds[0], self.case);
        }
        self.report();
    }

    fn report(&mut self) {
        self.reactions.keep(&self.worlds, self.acting.as_ref().map_or(0.0, Acting::direct));
    }
}

/// Adds the time or input of the last visited row to an error. The rows visited up to this point are valid.
fn reached(error: Error, case: &Case, visited: Option<usize>) -> Error {
    let (Some(row), ErrorKind::Numeric) = (visited, error.kind()) else { return error };
    let until = match case.is_free() {
        true => RunReached::Time(case.grid.times[row]),
        false => RunReached::Input(case.told(case.grid.inputs[row])),
    };
    error.after(until)
}
