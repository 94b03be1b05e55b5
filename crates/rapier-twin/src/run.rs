//! One run: worlds in parallel in simulated time, and what is read from them.

use super::branch::Branches;
use super::build::Build;
use super::free::{self, Acting};
use super::guard::Guard;
use super::native::Native;
use super::newton_euler::NewtonEuler;
use super::probe::Probe;
use super::probe::probe_turn;
use super::rapier::Rapier;
use super::tree::Tree;
use super::window::Window;
use super::world::Loading;
use linkage::case::Case;
use linkage::engine::{Route, Settings};
use linkage::error::{Advice, Error, ErrorKind, Reached, Result};
use linkage::math::KeepNan;
use linkage::solver::{Progress, State, Visit, check_instants};
use linkage::trajectory::Stage;

/// Steps until the transient of a start or of a reversal falls below rounding (one is enough; the rest is margin).
const SETTLING_STEPS: i64 = 3;
/// More steps than this are refused: they would take minutes, and most likely a unit is wrong.
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
    let start = match case.is_free() {
        true => 0,
        false => begin as i64 - overrun(&engine.settings),
    };
    let total = (end as i64 + Window::AHEAD - start) as f64;
    let mut visited = None;
    let mut run = Run::new(engine, case, start)?;
    run.aim(case.grid.times[first]);
    let go = || {
        match run.acting {
            None => run.back_up()?,
            Some(_) => run.begin()?,
        }
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
            run.read(&mut state, t)?;
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
        return wrong(format!("the engine's time step is {step} s"), "give a time step greater than zero");
    }
    if sweeps == 0 || substeps == 0 {
        return wrong(
            format!("the engine has {sweeps} sweeps and {substeps} substeps a step"),
            "give at least one of each",
        );
    }
    if !(steps <= MAX_STEPS) {
        let message =
            format!("a time step of {step:e} s needs {steps:.3e} steps for this grid, the limit is {MAX_STEPS:e}");
        return Err(Error::new(ErrorKind::Input, message)
            .help(Advice::LargerStep { to: None })
            .or_help("give a shorter grid"));
    }
    Ok(())
}

/// Steps of a prescribed motion before the first instant; those after the last one are fewer.
pub(super) fn overrun(settings: &Settings) -> i64 {
    Window::BEHIND + SETTLING_STEPS + Window::extra(settings.substeps)
}

struct Run<'a> {
    case: &'a Case,
    settings: Settings,
    /// Whether all drives turn with constant speeds, which are set only once.
    steady: bool,
    step: f64,
    start: i64,
    /// The first world moves the mechanism. The others only report joints that the first does not.
    worlds: Vec<Guard<'a>>,
    window: Window,
    /// First step that the window needs for the next sample.
    needed: i64,
    reader: Reader<'a>,
    /// Motor and loads, in a free motion.
    acting: Option<Acting>,
}

/// Source of reactions and moments.
enum Reader<'a> {
    Nothing,
    Differences(NewtonEuler),
    Native(Native),
    Probe(Probe<'a>),
}

impl<'a> Run<'a> {
    fn new(engine: &Rapier, case: &'a Case, start: i64) -> Result<Self> {
        let settings = &engine.settings;
        let route = (case.wanted.deepest() >= Stage::Reactions).then_some(settings.route);
        let mechanism = &case.mechanism;
        let moving = || match engine.build {
            Build::Multibody => Tree::of(mechanism),
            Build::Impulse => Tree::none(mechanism),
        };
        let reporting = || match engine.build {
            Build::Multibody => Tree::covering(mechanism, &case.wanted_reactions()),
            Build::Impulse => vec![Tree::none(mechanism)],
        };
        if let (true, Some(Route::Probe)) = (case.is_free(), route) {
            let message = "the motion is free, but a probe needs prescribed speeds";
            return Err(Error::new(ErrorKind::Unsupported, message)
                .help(Advice::OtherRoute { routes: &["differences", "native"] }));
        }
        let native = route == Some(Route::Native);
        let loading = if native { Loading::Read } else { Loading::Moving };
        let trees = if native { reporting() } else { vec![moving()] };
        let worlds = worlds_of(engine, case, trees, loading)?;
        let acting = if case.is_free() { Some(Acting::new(case, engine.precision, &worlds)?) } else { None };
        // One step lies before the beginning of a free motion.
        let reports_from = if acting.is_some() { start - 1 } else { start };
        let reader = match route {
            None => Reader::Nothing,
            Some(Route::Differences) => Reader::Differences(NewtonEuler::new(case)),
            Some(Route::Native) => Reader::Native(Native::new(case, &worlds, settings, reports_from)),
            Some(Route::Probe) => {
                // A world placed in a pose has no gap to correct in its first substep.
                // In the second substep it corrects the gap of the first, and the impulses would contain all of that
                // correction.
                // So a tiny step is not divided.
                let engine = engine.set(Settings { substeps: 1, ..*settings });
                let probed = worlds_of(&engine, case, reporting(), Loading::Read)?;
                Reader::Probe(Probe::new(case, probed, probe_turn(engine.precision)))
            }
        };
        let window = Window::new(case, settings, start);
        Ok(Run {
            case,
            steady: case.is_steady(),
            step: settings.resolution,
            settings: *settings,
            start,
            worlds,
            window,
            needed: i64::MIN,
            reader,
            acting,
        })
    }

    /// Prepares for a sample at `t` (s), and returns the last step that it needs.
    fn aim(&mut self, t: f64) -> i64 {
        let [first, last] = self.window.needs(t);
        // In a free motion every step is needed to find motor and loads.
        self.needed = if self.acting.is_some() { i64::MIN } else { first };
        last
    }

    /// Drives all worlds backwards from the start to where they reverse.
    fn back_up(&mut self) -> Result<()> {
        for guard in &mut self.worlds {
            guard.drive_on(0.0, -self.step);
            for step in (self.start..0).rev() {
                let (from, to) = ((step + 1) as f64 * self.step, step as f64 * self.step);
                if !self.steady {
                    guard.drive_on(from, to);
                }
                guard.step(to)?;
            }
            guard.drive_on(0.0, self.step);
        }
        self.take();
        Ok(())
    }

    /// Gives all worlds of a free motion their start velocities.
    fn begin(&mut self) -> Result<()> {
        let Some(acting) = &mut self.acting else { return Ok(()) };
        self.window = free::begin(self.case, acting, &mut self.worlds, &self.settings)?;
        self.report();
        self.report();
        Ok(())
    }

    fn step(&mut self) -> Result<()> {
        let step = self.window.newest() + 1;
        if let Some(acting) = &mut self.acting {
            acting.act(self.case, &self.window, &mut self.worlds, [step - 1, step].map(|step| step as f64 * self.step));
        }
        for guard in &mut self.worlds {
            let (from, to) = ((step - 1) as f64 * self.step, step as f64 * self.step);
            if !self.steady && self.acting.is_none() {
                guard.drive_on(from, to);
            }
            guard.step(to)?;
            if step == 0 {
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
        if let Reader::Native(native) = &mut self.reader {
            native.push(&self.worlds, self.acting.as_ref().map_or(0.0, Acting::direct));
        }
    }

    /// Fills in the reactions and moments of a state whose motion is known.
    fn read(&mut self, state: &mut State, t: f64) -> Result<()> {
        match &mut self.reader {
            Reader::Nothing => Ok(()),
            Reader::Differences(statics) => statics.solve(self.case, state, t),
            Reader::Native(native) => native.solve(self.case, state, t),
            Reader::Probe(probe) => probe.solve(self.case, &self.window, state, t),
        }
    }
}

/// A world for every tree.
fn worlds_of<'a>(engine: &Rapier, case: &'a Case, trees: Vec<Tree>, loading: Loading) -> Result<Vec<Guard<'a>>> {
    let world = |tree| Ok(Guard::new(case, engine.world_for(case, tree, loading)?, &engine.settings));
    trees.into_iter().map(world).collect()
}

/// Adds how far the run has come; the rows visited so far are valid.
fn reached(error: Error, case: &Case, visited: Option<usize>) -> Error {
    let (Some(row), ErrorKind::Numeric) = (visited, error.kind()) else { return error };
    let until = match case.is_free() {
        true => Reached::Time(case.grid.times[row]),
        false => Reached::Input(case.told(case.grid.inputs[row])),
    };
    error.after(until)
}
