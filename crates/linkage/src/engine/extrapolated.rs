//! Richardson extrapolation of an engine with a fixed time step to the limit of a vanishing step (Richardson 1911).
//! The engine solves at the steps h, h / 2, h / 4, .... The resulting states are combined so that the leading errors
//! cancel.
//! See docs/numerics/twins.md.

use super::{Engine, Settings, StandIn};
use crate::case::Case;
use crate::error::Result;
use crate::math::{Motion, Vec2, unit};
use crate::sentences;
use crate::solver::{Progress, Provision, Solver, State, Visit};
use crate::trajectory::{CHANNELS, Channel, ChannelKind, Stage};

/// An engine with Richardson extrapolation.
pub struct Extrapolated {
    /// The engine at h, h / 2, h / 4, ...
    runs: Vec<Box<dyn Engine>>,
}

impl Extrapolated {
    /// Makes `times` extrapolations of an engine with the step h, from runs at h, h / 2, ..., h / 2^times.
    pub fn new(inner: Box<dyn Engine>, times: usize) -> Self {
        debug_assert!(!inner.controls_error(), "there is no step to be halved");
        let step = inner.settings().resolution;
        let finer = (1..=times as i32).map(|time| inner.at(step * 0.5f64.powi(time))).collect::<Vec<_>>();
        Extrapolated { runs: [inner].into_iter().chain(finer).collect() }
    }

    fn coarsest(&self) -> &dyn Engine {
        self.runs[0].as_ref()
    }

    /// Number of leading error terms that cancel.
    fn times(&self) -> usize {
        self.runs.len() - 1
    }
}

/// Weights of the runs at h, h / 2, ....
/// The terms of the error are proportional to the powers `order`, `order` + 1, ... of the step.
/// Each run after the first cancels one of these terms.
/// T(k, j) denotes the value from run k after j extrapolations.
/// Extrapolation j removes the error term with the power p = `order` + j - 1 by Neville's scheme:
/// T(k, j) = T(k + 1, j - 1) + (T(k + 1, j - 1) - T(k, j - 1)) / (2^p - 1).
fn weights(order: f64, runs: usize) -> Vec<f64> {
    let mut rows: Vec<Vec<f64>> =
        (0..runs).map(|run| (0..runs).map(|k| f64::from(u8::from(k == run))).collect()).collect();
    for time in 1..runs {
        let share = 1.0 / (2f64.powf(order + (time - 1) as f64) - 1.0);
        for run in 0..runs - time {
            let (coarse, fine) = rows.split_at_mut(run + 1);
            for (weight, fine) in coarse[run].iter_mut().zip(&fine[0]) {
                *weight = fine + (fine - *weight) * share;
            }
        }
    }
    rows.swap_remove(0)
}

/// Weights of the runs, for the positions, velocities, accelerations and forces of a state.
struct Weights {
    position: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    force: Vec<f64>,
}

impl Weights {
    fn of(engine: &dyn Engine, case: &Case, runs: usize) -> Self {
        let of = |stage: Stage| {
            let kind = CHANNELS.iter().find(|kind| kind.stage == stage).expect("every stage has a channel");
            weights(engine.formal_order(case, kind), runs)
        };
        Weights {
            position: of(Stage::Positions),
            velocity: of(Stage::Velocities),
            acceleration: of(Stage::Accelerations),
            force: of(Stage::Reactions),
        }
    }

    /// Combines the states of all runs at one instant into `into`. The state of the coarsest run comes first.
    fn combine(&self, case: &Case, states: &[&State], into: &mut State) {
        let mix = |weights: &[f64], of: &dyn Fn(&State) -> f64| -> f64 {
            weights.iter().zip(states).map(|(weight, state)| weight * of(state)).sum()
        };
        let mix_pair = |weights: &[f64], of: &dyn Fn(&State) -> Vec2| {
            weights.iter().zip(states).fold(Vec2::zeros(), |sum, (weight, state)| sum + of(state) * *weight)
        };
        for (index, link) in case.mechanism.links().entries().skip(1) {
            // The motions of the mass centres are combined, because engines integrate these motions.
            // The origin of the link's frame follows from the combined motion.
            let centre = link.mass_centre;
            let angle = mix(&self.position, &|state| state.angles[index]);
            into.angles[index] = angle;
            into.motions[index] = Motion::of_point(
                centre,
                [
                    mix_pair(&self.position, &|state| state.motions[index].point(centre)),
                    mix_pair(&self.velocity, &|state| state.motions[index].point_velocity(centre)),
                    mix_pair(&self.acceleration, &|state| state.motions[index].point_acceleration(centre)),
                ],
                unit(angle),
                mix(&self.velocity, &|state| state.motions[index].omega),
                mix(&self.acceleration, &|state| state.motions[index].alpha),
            );
        }
        for joint in into.forces.ids() {
            into.forces[joint] = mix_pair(&self.force, &|state| state.forces[joint]);
            into.moments[joint] = mix(&self.force, &|state| state.moments[joint]);
        }
        for transmission in into.transmitted.ids() {
            into.transmitted[transmission] = mix(&self.force, &|state| state.transmitted[transmission]);
        }
        for drive in 0..into.torques.len() {
            into.torques[drive] = mix(&self.force, &|state| state.torques[drive]);
        }
    }
}

impl Solver for Extrapolated {
    fn name(&self) -> &'static str {
        self.coarsest().name()
    }

    fn provides(&self, channel: &Channel) -> Provision {
        match self.coarsest().provides(channel) {
            Provision::Computed => Provision::Derived(sentences::EXTRAPOLATED_FROM_RUNS_AT_THE_STEP),
            other @ Provision::Derived(_) => other,
        }
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        let (finest, coarser) = self.runs.split_last().expect("there is the run at the step itself");
        // Each run costs twice as much as the previous run, so all runs cost `whole` times as much as the first run.
        let whole = 2f64.powi(self.runs.len() as i32) - 1.0;
        let mut kept = Vec::with_capacity(coarser.len());
        for (index, run) in coarser.iter().enumerate() {
            let cost = 2f64.powi(index as i32);
            kept.push(run.rows(case, &mut |part| progress((cost - 1.0 + cost * part) / whole))?);
        }
        let weights = Weights::of(self.coarsest(), case, self.runs.len());
        let mut combined = State::at_rest(case);
        let mut statics = self.coarsest().statics(case);
        let mut states = vec![State::at_rest(case); kept.len()];
        let mut combine = |row: usize, state: &State| {
            for (run, state) in kept.iter().zip(&mut states) {
                assert!(run.get(row, state), "all runs visit the same rows");
            }
            let all: Vec<&State> = states.iter().chain([state]).collect();
            weights.combine(case, &all, &mut combined);
            if let Some(statics) = &mut statics {
                statics(case, row, &mut combined)?;
            }
            visit(row, &combined)
        };
        let cost = 2f64.powi(coarser.len() as i32);
        finest.sweep(case, &mut combine, &mut |part| progress((cost - 1.0 + cost * part) / whole))
    }
}

impl StandIn for Extrapolated {
    fn original(&self) -> &dyn Engine {
        self.coarsest()
    }

    fn renewed(&self, settings: Settings) -> Box<dyn Engine> {
        self.coarsest().with(settings)
    }

    fn own_settings(&self) -> Settings {
        Settings { extrapolated: self.times(), ..self.coarsest().settings() }
    }

    fn own_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        // Errors are proportional to h^p, h^(p+1), ... Every extrapolation removes one of these errors.
        self.coarsest().formal_order(case, channel) + self.times() as f64
    }

    fn own_noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        let weights = weights(self.coarsest().formal_order(case, channel), self.runs.len());
        weights.iter().zip(&self.runs).map(|(weight, run)| weight.abs() * run.noise(case, channel)).sum()
    }

    fn own_told(&self) -> Vec<(&'static str, String)> {
        let mut told = self.coarsest().told();
        let halves = (0..=self.times()).map(|time| if time == 0 { "h".into() } else { format!("h/{}", 1 << time) });
        told.push(("extrapolated", sentences::from_runs_at(&(halves.collect::<Vec<String>>().join(", ")))));
        told
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use super::*;
    use crate::case::Grid;
    use crate::engine::{CachedEngine, Route, Statics};
    use crate::error::{Error, ErrorKind};
    use crate::fixtures;
    use crate::mechanism::LinkId;

    /// A test engine. At the time t, all link angles are t + h^2 + 1e-3 / sweeps.
    /// The engine records the step and the sweeps of each run.
    /// A run with the step and the sweeps in `fails` stops with an error at the second instant.
    #[derive(Clone, Debug)]
    struct Counted {
        settings: Settings,
        runs: Arc<Mutex<Vec<(f64, usize)>>>,
        fails: Option<(f64, usize)>,
    }

    impl Counted {
        /// Returns the runs recorded so far and clears the record.
        fn taken(&self) -> Vec<(f64, usize)> {
            std::mem::take(&mut self.runs.lock().unwrap())
        }
    }

    impl Solver for Counted {
        fn name(&self) -> &'static str {
            "counted"
        }
        fn provides(&self, _: &Channel) -> Provision {
            Provision::Computed
        }
        fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
            let (h, sweeps) = (self.settings.resolution, self.settings.sweeps);
            self.runs.lock().unwrap().push((h, sweeps));
            let mut state = State::at_rest(case);
            for (done, row) in case.grid.ascending().into_iter().enumerate() {
                if done == 1 && self.fails == Some((h, sweeps)) {
                    return Err(Error::new(ErrorKind::Numeric, "it stops"));
                }
                state.angles.fill(case.grid.times[row] + h * h + 1e-3 / sweeps as f64);
                visit(row, &state)?;
                progress((done + 1) as f64 / case.grid.len() as f64);
            }
            Ok(())
        }
    }

    impl Engine for Counted {
        fn version(&self) -> String {
            String::new()
        }
        fn settings(&self) -> Settings {
            self.settings
        }
        fn with(&self, settings: Settings) -> Box<dyn Engine> {
            let plain = Counted { settings: Settings { extrapolated: 0, ..settings }, ..self.clone() };
            match settings.extrapolated {
                0 => Box::new(plain),
                times => Box::new(Extrapolated::new(Box::new(plain), times)),
            }
        }
        fn controls_error(&self) -> bool {
            false
        }
        fn routes(&self) -> &'static [Route] {
            &[Route::Native]
        }
        fn own_routes(&self, _: &Case) -> &'static [Route] {
            &[]
        }
        fn statics(&self, _: &Case) -> Option<Statics> {
            None
        }
        fn overrun(&self) -> f64 {
            0.0
        }
        fn sweeps(&self, _: &Case) -> Option<[usize; 2]> {
            None
        }
        fn formal_order(&self, _: &Case, _: &ChannelKind) -> f64 {
            2.0
        }
        fn noise(&self, _: &Case, _: &ChannelKind) -> f64 {
            0.0
        }
        fn is_noise_measured(&self) -> bool {
            true
        }
        fn told(&self) -> Vec<(&'static str, String)> {
            Vec::new()
        }
    }

    const ASKED: Settings = Settings { resolution: 0.1, sweeps: 8, substeps: 1, route: Route::Native, extrapolated: 1 };

    fn counted(fails: Option<(f64, usize)>) -> Counted {
        Counted { settings: Settings { extrapolated: 0, ..ASKED }, runs: Arc::default(), fails }
    }

    /// Four settings as in a convergence study: the original, half the step, twice the step, and half the sweeps.
    fn rungs() -> [Settings; 4] {
        let at = |factor: f64| Settings { resolution: ASKED.resolution * factor, ..ASKED };
        [ASKED, at(0.5), at(2.0), Settings { sweeps: ASKED.sweeps / 2, ..ASKED }]
    }

    fn case() -> Case {
        let case = fixtures::turning(fixtures::four_bar());
        case.on(Grid::of_times(case.crank(), vec![0.2, 0.0, 0.1])).unwrap()
    }

    /// Runs the case. Returns row and angle of each state, in the order in which the engine delivers the states.
    /// The second value tells whether the run failed.
    /// The function asserts that the progress rises from 0 to 1.
    fn run(engine: &dyn Engine, case: &Case) -> (Vec<(usize, f64)>, Result<()>) {
        let (mut seen, mut far) = (Vec::new(), 0.0);
        let mut visit = |row: usize, state: &State| {
            seen.push((row, state.angles[LinkId(1)]));
            Ok(())
        };
        let ended = engine.sweep(case, &mut visit, &mut |part| {
            assert!(part >= far && part <= 1.0, "{part} after {far}");
            far = part;
        });
        assert!(ended.is_err() || far == 1.0, "{far}");
        (seen, ended)
    }

    #[test]
    fn cached_runs_are_computed_once_and_keep_every_bit() {
        let (engine, case) = (counted(None), case());
        let alone: Vec<_> = rungs().map(|rung| run(engine.with(rung).as_ref(), &case).0).into();
        assert_eq!(engine.taken().len(), 8);
        let kept = CachedEngine::new(engine.with(ASKED).as_ref());
        let together: Vec<_> = rungs().map(|rung| run(kept.with(rung).as_ref(), &case).0).into();
        assert_eq!(together, alone);
        assert_eq!(alone[0].len(), 3);
        let once = [(0.1, 8), (0.05, 8), (0.025, 8), (0.2, 8), (0.1, 4), (0.05, 4)];
        assert_eq!(engine.taken(), once);
        // A stored run is not repeated. A run that was dropped from the store is repeated.
        assert_eq!(run(kept.with(ASKED).as_ref(), &case).0, alone[0]);
        assert_eq!(engine.taken(), []);
        kept.retain(|settings| settings.resolution != 0.1);
        assert_eq!(run(kept.with(ASKED).as_ref(), &case).0, alone[0]);
        assert_eq!(engine.taken(), [(0.1, 8)]);
    }

    #[test]
    fn parallel_runs_equal_sequential_runs() {
        let (engine, case) = (counted(None), case());
        let kept = CachedEngine::new(engine.with(ASKED).as_ref());
        let mut far = 0.0;
        kept.prepare(&case, kept.missing(&case, &rungs()), &mut |part| {
            assert!(part >= far && part <= 1.0 + 1e-12, "{part} after {far}");
            far = part;
        });
        assert!(far > 1.0 - 1e-12, "{far}");
        assert_eq!(engine.taken().len(), 6);
        for rung in rungs() {
            assert_eq!(run(kept.with(rung).as_ref(), &case).0, run(engine.with(rung).as_ref(), &case).0);
        }
    }

    #[test]
    fn cached_runs_are_not_reused_for_another_case() {
        let (engine, one) = (counted(None), case());
        let other = one.on(Grid::of_times(one.crank(), vec![0.4, 0.3, 0.5])).unwrap();
        let kept = CachedEngine::new(engine.with(ASKED).as_ref());
        for (rung, case) in rungs().into_iter().zip([&one, &other, &one, &one]) {
            assert_eq!(run(kept.with(rung).as_ref(), case).0, run(engine.with(rung).as_ref(), case).0);
        }
    }

    #[test]
    fn a_stopped_cached_run_delivers_the_same_states() {
        let case = case();
        for (rung, fails, handed) in [(0, (0.1, 8), 0), (0, (0.05, 8), 1), (1, (0.025, 8), 1), (2, (0.2, 8), 0)] {
            let engine = counted(Some(fails));
            let kept = CachedEngine::new(engine.with(ASKED).as_ref());
            for _ in 0..2 {
                let (together, ended) = run(kept.with(rungs()[rung]).as_ref(), &case);
                assert!(ended.is_err() && together.len() == handed, "{fails:?}: {together:?}");
                assert_eq!(together, run(engine.with(rungs()[rung]).as_ref(), &case).0);
            }
        }
    }

    /// After three extrapolations, errors of h^2, h^3 and h^4 cancel up to rounding error.
    #[test]
    fn every_extrapolation_cancels_one_power() {
        let errors = |h: f64| 3.0 * h.powi(2) - 2.0 * h.powi(3) + 5.0 * h.powi(4);
        for (runs, order) in [(1, 2), (2, 3), (3, 4)] {
            let at = |h: f64| -> f64 {
                let weights = weights(2.0, runs);
                weights.iter().enumerate().map(|(k, weight)| weight * errors(h * 0.5f64.powi(k as i32))).sum()
            };
            let observed = (at(1e-3) / at(5e-4)).log2();
            assert!((observed - f64::from(order)).abs() < 0.01, "{runs} runs: {observed}");
        }
        let weights = weights(2.0, 4);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        let left: f64 =
            weights.iter().enumerate().map(|(k, weight)| weight * errors(0.1 * 0.5f64.powi(k as i32))).sum();
        assert!(left.abs() < 1e-16, "{left:e}");
    }
}
