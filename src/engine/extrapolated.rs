//! Any engine with a fixed step, extrapolated to step zero: solved at h and at h / 2, and both states combined so that the leading error
//! drops out (Richardson 1911).

use super::{Engine, Route, Settings};
use crate::case::Case;
use crate::error::Result;
use crate::math::{Motion, Vec2, unit};
use crate::solver::{Progress, Provision, Solver, State};
use crate::trajectory::{CHANNELS, Channel, ChannelKind, Stage};

/// An engine and its extrapolation.
pub(super) struct Extrapolated {
    inner: Box<dyn Engine>,
}

impl Extrapolated {
    /// Extrapolates an engine, whose step is h.
    pub(super) fn new(inner: Box<dyn Engine>) -> Self {
        debug_assert!(!inner.controls_error(), "there is no step to be halved");
        Extrapolated { inner }
    }

    fn half(&self) -> Box<dyn Engine> {
        self.inner.at(0.5 * self.inner.settings().resolution)
    }
}

/// Share of the run at h / 2: 2^p / (2^p - 1) for an error in proportion to h^p. That of the run at h is one less this.
fn share(order: f64) -> f64 {
    1.0 / (1.0 - 0.5f64.powf(order))
}

/// Numbers of a state that depend on the step, and the shares of h / 2 in them.
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

    /// Combines the state at h / 2 with that at h, in the place of the first.
    fn combine(&self, case: &Case, fine: &mut State, coarse: &State) {
        let mix = |share: f64, fine: f64, coarse: f64| coarse + share * (fine - coarse);
        let mix_pair = |share: f64, fine: Vec2, coarse: Vec2| coarse + (fine - coarse) * share;
        for (index, link) in case.mechanism.links().iter().enumerate().skip(1) {
            // Mass centres, as bodies are: the frame's origin follows from them.
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
            other => other,
        }
    }

    fn sweep(&self, case: &Case, visit: &mut dyn FnMut(usize, &State) -> Result<()>, progress: Progress) -> Result<()> {
        let mut coarse: Vec<Option<State>> = vec![None; case.grid.len()];
        let mut keep = |row: usize, state: &State| {
            coarse[row] = Some(state.clone());
            Ok(())
        };
        self.inner.sweep(case, &mut keep, &mut |part| progress(part / 3.0))?;
        let shares = Shares::of(self.inner.as_ref(), case);
        let mut combined = State::at_rest(case);
        let mut combine = |row: usize, state: &State| {
            combined.clone_from(state);
            shares.combine(case, &mut combined, coarse[row].as_ref().expect("both runs visit the same rows"));
            visit(row, &combined)
        };
        self.half().sweep(case, &mut combine, &mut |part| progress((1.0 + 2.0 * part) / 3.0))
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

    fn routes(&self) -> &'static [Route] {
        self.inner.routes()
    }

    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        // Errors in proportion to h^p and h^(p+1), of which the first drops out.
        self.inner.formal_order(case, channel) + 1.0
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        let share = share(self.inner.formal_order(case, channel));
        share * self.half().noise(case, channel) + (share - 1.0) * self.inner.noise(case, channel)
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        let mut told = self.inner.told();
        told.push(("extrapolated", "from runs at the step and at half of it".into()));
        told
    }
}
