//! Richardson extrapolation of any engine with a fixed step to step zero (Richardson 1911).
//! The engine solves at h and at h / 2; both states are combined so that the leading error cancels.

use std::sync::Arc;

use super::shared::Shared;
use super::{Engine, Route, Settings};
use crate::case::Case;
use crate::error::Result;
use crate::math::{Motion, Vec2, unit};
use crate::solver::{Progress, Provision, Solver, State, Visit};
use crate::trajectory::{CHANNELS, Channel, ChannelKind, Stage};

/// An engine and its extrapolation.
pub struct Extrapolated {
    inner: Box<dyn Engine>,
    half: Box<dyn Engine>,
    /// Runs that other extrapolations of the same engine need too.
    shared: Arc<Shared>,
}

impl Extrapolated {
    /// Extrapolates an engine with the step h.
    pub fn new(inner: Box<dyn Engine>) -> Self {
        debug_assert!(!inner.controls_error(), "there is no step to be halved");
        let half = inner.at(0.5 * inner.settings().resolution);
        Extrapolated { inner, half, shared: Arc::default() }
    }
}

/// Weight of the run at h / 2: 2^p / (2^p - 1) for an error proportional to h^p. The weight of the run at h is 1 minus
/// this.
fn share(order: f64) -> f64 {
    1.0 / (1.0 - 0.5f64.powf(order))
}

/// Weights of the run at h / 2 for the quantities of a state that depend on the step.
struct Shares {
    position: f64,
    velocity: f64,
    acceleration: f64,
    force: f64,
}

impl Shares {
    fn of(engine: &dyn Engine, case: &Case) -> Self {
        let of = |stage: Stage| {
            let kind = CHANNELS.iter().find(|kind| kind.stage == stage).expect("every stage has a channel");
            share(engine.formal_order(case, kind))
        };
        Shares {
            position: of(Stage::Positions),
            velocity: of(Stage::Velocities),
            acceleration: of(Stage::Accelerations),
            force: of(Stage::Reactions),
        }
    }

    /// Combines the state at h / 2 with that at h. The result replaces the first.
    fn combine(&self, case: &Case, fine: &mut State, coarse: &State) {
        let mix = |share: f64, fine: f64, coarse: f64| coarse + share * (fine - coarse);
        let mix_pair = |share: f64, fine: Vec2, coarse: Vec2| coarse + (fine - coarse) * share;
        for (index, link) in case.mechanism.links().iter().enumerate().skip(1) {
            // Combines mass centres, as the engine's bodies have them. The frame's origin follows.
            let of = |motion: &Motion| {
                [
                    motion.point(link.mass_centre),
                    motion.point_velocity(link.mass_centre),
                    motion.point_acceleration(link.mass_centre),
                ]
            };
            let (a, b) = (fine.motions[index], coarse.motions[index]);
            let ([p, v, w], [q, u, z]) = (of(&a), of(&b));
            let angle = mix(self.position, fine.angles[index], coarse.angles[index]);
            fine.angles[index] = angle;
            fine.motions[index] = Motion::of_point(
                link.mass_centre,
                [mix_pair(self.position, p, q), mix_pair(self.velocity, v, u), mix_pair(self.acceleration, w, z)],
                unit(angle),
                mix(self.velocity, a.omega, b.omega),
                mix(self.acceleration, a.alpha, b.alpha),
            );
        }
        for (a, b) in fine.forces.iter_mut().zip(&coarse.forces) {
            *a = mix_pair(self.force, *a, *b);
        }
        let moments = fine.moments.iter_mut().zip(&coarse.moments);
        for (a, b) in moments.chain(fine.torques.iter_mut().zip(&coarse.torques)) {
            *a = mix(self.force, *a, *b);
        }
    }
}

impl Solver for Extrapolated {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn provides(&self, channel: &Channel) -> Provision {
        match self.inner.provides(channel) {
            Provision::Computed => Provision::Derived("extrapolated from runs at the step and at half of it"),
            other @ Provision::Derived(_) => other,
        }
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        let mut coarse: Vec<Option<State>> = vec![None; case.grid.len()];
        let mut keep = |row: usize, state: &State| {
            coarse[row] = Some(state.clone());
            Ok(())
        };
        self.shared.sweep(self.inner.as_ref(), case, &mut keep, &mut |part| progress(part / 3.0))?;
        let shares = Shares::of(self.inner.as_ref(), case);
        let mut combined = State::at_rest(case);
        let mut combine = |row: usize, state: &State| {
            combined.clone_from(state);
            shares.combine(case, &mut combined, coarse[row].as_ref().expect("both runs visit the same rows"));
            visit(row, &combined)
        };
        self.shared.sweep(self.half.as_ref(), case, &mut combine, &mut |part| progress((1.0 + 2.0 * part) / 3.0))
    }
}

impl Engine for Extrapolated {
    fn version(&self) -> String {
        self.inner.version()
    }

    fn settings(&self) -> Settings {
        Settings { extrapolated: true, ..self.inner.settings() }
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        self.inner.with(settings)
    }

    fn ladder(&self, rungs: &[Settings]) -> Vec<Box<dyn Engine>> {
        let shared = Arc::new(Shared::default());
        let rung = |&settings: &Settings| -> Box<dyn Engine> {
            if !settings.extrapolated {
                return self.with(settings);
            }
            let plain = Extrapolated::new(self.inner.with(Settings { extrapolated: false, ..settings }));
            shared.expect(plain.inner.settings());
            shared.expect(plain.half.settings());
            Box::new(Extrapolated { shared: Arc::clone(&shared), ..plain })
        };
        rungs.iter().map(rung).collect()
    }

    fn routes(&self) -> &'static [Route] {
        self.inner.routes()
    }

    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        // The errors are proportional to h^p and h^(p+1); the first cancels.
        self.inner.formal_order(case, channel) + 1.0
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        let share = share(self.inner.formal_order(case, channel));
        share * self.half.noise(case, channel) + (share - 1.0) * self.inner.noise(case, channel)
    }

    fn is_noise_measured(&self) -> bool {
        self.inner.is_noise_measured()
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        let mut told = self.inner.told();
        told.push(("extrapolated", "from runs at the step and at half of it".into()));
        told
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use crate::case::Grid;
    use crate::error::{Error, ErrorKind};
    use crate::fixtures;

    /// An engine whose links turn by t + h^2. It records its runs by steps and sweeps.
    /// Runs listed in `fails` stop at the second instant.
    #[derive(Clone, Debug)]
    struct Counted {
        settings: Settings,
        runs: Arc<Mutex<Vec<(f64, usize)>>>,
        fails: Option<(f64, usize)>,
    }

    impl Counted {
        /// The runs recorded so far; the record is cleared.
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
            let plain = Counted { settings: Settings { extrapolated: false, ..settings }, ..self.clone() };
            if settings.extrapolated { Box::new(Extrapolated::new(Box::new(plain))) } else { Box::new(plain) }
        }
        fn routes(&self) -> &'static [Route] {
            &[Route::Native]
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

    const ASKED: Settings =
        Settings { resolution: 0.1, sweeps: 8, substeps: 1, route: Route::Native, extrapolated: true };

    fn counted(fails: Option<(f64, usize)>) -> Counted {
        Counted { settings: Settings { extrapolated: false, ..ASKED }, runs: Arc::default(), fails }
    }

    /// The rungs of a proof, in its order.
    fn rungs() -> [Settings; 4] {
        let at = |factor: f64| Settings { resolution: ASKED.resolution * factor, ..ASKED };
        [ASKED, at(0.5), at(2.0), Settings { sweeps: ASKED.sweeps / 2, ..ASKED }]
    }

    fn case() -> Case {
        let case = fixtures::turning(fixtures::four_bar());
        case.on(Grid::of_times(case.crank(), vec![0.2, 0.0, 0.1])).unwrap()
    }

    /// Rows and angles that an engine delivers, in its order, and how the run ended. Progress must rise from 0 to 1.
    fn run(engine: &dyn Engine, case: &Case) -> (Vec<(usize, f64)>, Result<()>) {
        let (mut seen, mut far) = (Vec::new(), 0.0);
        let mut visit = |row: usize, state: &State| {
            seen.push((row, state.angles[1]));
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
    fn a_ladder_takes_every_step_once_and_changes_no_bit() {
        let (engine, case) = (counted(None), case());
        let alone: Vec<_> = rungs().map(|rung| run(engine.with(rung).as_ref(), &case).0).into();
        assert_eq!(engine.taken().len(), 8);
        let ladder = engine.with(ASKED).ladder(&rungs());
        let together: Vec<_> = ladder.iter().map(|rung| run(rung.as_ref(), &case).0).collect();
        assert_eq!(together, alone);
        assert_eq!(alone[0].len(), 3);
        let once = [(0.1, 8), (0.05, 8), (0.025, 8), (0.2, 8), (0.1, 4), (0.05, 4)];
        assert_eq!(engine.taken(), once);
        // A run that no engine expects any more is not kept: the first rung runs again as if alone.
        assert_eq!(run(ladder[0].as_ref(), &case).0, alone[0]);
        assert_eq!(engine.taken(), once[..2]);
    }

    #[test]
    fn what_is_kept_of_one_case_is_not_given_for_another() {
        let (engine, one) = (counted(None), case());
        let other = one.on(Grid::of_times(one.crank(), vec![0.4, 0.3, 0.5])).unwrap();
        let ladder = engine.with(ASKED).ladder(&rungs());
        for (rung, case) in ladder.iter().zip([&one, &other, &one, &one]) {
            assert_eq!(run(rung.as_ref(), case).0, run(engine.with(rung.settings()).as_ref(), case).0);
        }
    }

    #[test]
    fn a_stopped_rung_hands_over_what_it_hands_over_alone() {
        let case = case();
        for (rung, fails, handed) in [(0, (0.1, 8), 0), (0, (0.05, 8), 1), (1, (0.025, 8), 1), (2, (0.2, 8), 0)] {
            let engine = counted(Some(fails));
            let ladder = engine.with(ASKED).ladder(&rungs());
            assert!(ladder[..rung].iter().all(|before| run(before.as_ref(), &case).1.is_ok()));
            let (together, ended) = run(ladder[rung].as_ref(), &case);
            assert!(ended.is_err() && together.len() == handed, "{fails:?}: {together:?}");
            assert_eq!(together, run(engine.with(rungs()[rung]).as_ref(), &case).0);
        }
    }

    #[test]
    fn a_rung_may_be_plain() {
        let (engine, case) = (counted(None), case());
        let plain = Settings { extrapolated: false, ..ASKED };
        let ladder = engine.with(ASKED).ladder(&[plain, ASKED]);
        assert_eq!(run(ladder[0].as_ref(), &case).0, run(&engine, &case).0);
        assert_eq!(run(ladder[1].as_ref(), &case).0, run(engine.with(ASKED).as_ref(), &case).0);
    }
}
