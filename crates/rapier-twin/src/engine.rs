//! Rapier as an `Engine` and as a `Solver`.

use super::friction::InverseDynamics;
use super::rapier::{Build, Precision, Rapier};
use super::tree::SpanningTree;
use super::{noise, run};
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Drive;
use linkage::engine::{Engine, Extrapolated, Route, Settings, Statics};
use linkage::error::Result;
use linkage::input::Input;
use linkage::mechanism::GROUND;
use linkage::solver::{Progress, Provision, Solver, Visit};
use linkage::trajectory::{Channel, ChannelKind, Stage};

/// Upper limit of the number of sweeps. If a loop stays open even with this number of sweeps, the cause is not the
/// number of sweeps.
const MOST_SWEEPS: usize = 65_536;

impl Engine for Rapier {
    fn version(&self) -> String {
        match self.precision {
            Precision::Double => "rapier2d-f64 0.36.1".into(),
            #[cfg(feature = "f32")]
            Precision::Single => "rapier2d 0.36.1".into(),
        }
    }

    fn settings(&self) -> Settings {
        self.settings
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        let plain = self.set(settings);
        match settings.extrapolated {
            0 => Box::new(plain),
            times => Box::new(Extrapolated::new(Box::new(plain), times)),
        }
    }

    fn controls_error(&self) -> bool {
        false
    }

    fn routes(&self) -> &'static [Route] {
        &Route::ALL
    }

    fn own_routes(&self, _: &Case) -> &'static [Route] {
        // Probes are not tried by default, because they cost more than the default route and need many more sweeps at
        // coarse steps.
        // The tiny steps of a probe also cause an error that a comparison of runs does not reveal.
        &[Route::Native]
    }

    fn sweeps(&self, case: &Case) -> Option<[usize; 2]> {
        let is_tree = SpanningTree::of(&case.mechanism).cut.is_empty() && case.mechanism.transmissions().is_empty();
        let alone = case.drives.len() == 1 && is_tree;
        let reports = self.settings.route == Route::Native;
        let begins = case.is_free() && case.drives.iter().any(|drive| drive.initial_speed() != 0.0);
        match self.build {
            // A tree whose forces are read needs at least two sweeps, because the worlds that report these forces have
            // cut joints.
            // With one sweep, the links would not get their start velocities, and later steps would not correct this
            // error.
            Build::Multibody if alone && reports && begins => Some([2, MOST_SWEEPS]),
            // A tree with one motor is solved exactly in one sweep.
            Build::Multibody if alone => Some([1, 1]),
            Build::Multibody => Some([16, MOST_SWEEPS]),
            Build::Impulse => Some([64, MOST_SWEEPS]),
        }
    }

    fn statics(&self, case: &Case) -> Option<Statics> {
        if self.settings.route != Route::Differences || case.wanted.deepest() < Stage::Reactions {
            return None;
        }
        let mut dynamics = InverseDynamics::of(case);
        Some(Box::new(move |case, row, state| dynamics.sample(case, state, case.grid.times[row])))
    }

    fn overrun(&self) -> f64 {
        run::overrun(&self.settings) as f64
    }

    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        let native = self.settings.route == Route::Native && channel.stage >= Stage::Reactions;
        // During a whole step, the motor of a slide between separate moving bodies acts in the direction that the axis
        // has at the start of the step. The order is then 1.
        let is_moving = |drive: &Drive| case.mechanism.joints()[drive.joint].on(GROUND).is_none();
        let turns_axis =
            self.build == Build::Impulse && case.drives.iter().any(|own| own.input == Input::Slide && is_moving(own));
        // A free motion has order 1, because the loads at the start of a step act during the whole step.
        if native || turns_axis || case.is_free() { 1.0 } else { 2.0 }
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        noise::bound(case, self, channel)
    }

    fn is_noise_measured(&self) -> bool {
        true
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        // Three settings are not listed here: reports state the step size separately, and `how` states the route.
        // `Extrapolated`, which combines runs of this engine, lists the extrapolation.
        let Settings { resolution: _, sweeps, substeps, route: _, extrapolated: _ } = self.settings;
        let build = match self.build {
            Build::Multibody => sentences::SPANNING_TREE_AS_MULTIBODY_LOOPS,
            Build::Impulse => sentences::BODIES_OF_THEIR_OWN_EVERY_JOINT,
        };
        let drive = match self.build {
            Build::Multibody => sentences::GROUND_CRANK_MOTOR_FORCE_BASED_DAMPING,
            Build::Impulse => sentences::GROUND_CRANK_MOTOR_FORCE_BASED,
        };
        vec![
            ("build", build.into()),
            ("drive", drive.into()),
            ("flywheel", sentences::ON_DRIVING_LINKS_ALL_MASSES.into()),
            ("sweeps", sweeps.to_string()),
            ("substeps", substeps.to_string()),
            ("reactions", self.how().into()),
        ]
    }
}

impl Rapier {
    /// Describes the source of reactions and moments.
    fn how(&self) -> &'static str {
        match (self.settings.route, self.build) {
            (Route::Differences, _) => sentences::NEWTON_EULER_ON_CENTRED_SECOND,
            (Route::Native, Build::Multibody) => sentences::THE_ENGINE_IMPULSES_EACH_JOINT,
            (Route::Native, Build::Impulse) => sentences::THE_ENGINE_IMPULSES,
            (Route::Probe, Build::Multibody) => sentences::THE_ENGINE_IMPULSES_IN_TINY_STEPS,
            (Route::Probe, Build::Impulse) => sentences::THE_ENGINE_IMPULSES_IN_TINY,
        }
    }
}

impl Solver for Rapier {
    fn name(&self) -> &'static str {
        match (self.build, self.precision) {
            (Build::Multibody, Precision::Double) => "rapier",
            #[cfg(feature = "f32")]
            (Build::Multibody, Precision::Single) => "rapier-f32",
            (Build::Impulse, Precision::Double) => "impulse",
            #[cfg(feature = "f32")]
            (Build::Impulse, Precision::Single) => "impulse-f32",
        }
    }

    fn provides(&self, channel: &Channel) -> Provision {
        match (channel.kind.stage, self.build) {
            (Stage::Positions, _) => Provision::Computed,
            (Stage::Velocities, Build::Multibody) => {
                Provision::Derived(sentences::READ_AS_GENERALISED_VELOCITIES_ONE_STEP)
            }
            (Stage::Velocities, Build::Impulse) => Provision::Derived(sentences::READ_AS_THE_BODIES_VELOCITIES),
            (Stage::Accelerations, _) => Provision::Derived(sentences::CENTRED_SECOND_DIFFERENCES_OF_THE_ENGINE),
            (Stage::Reactions | Stage::BalancingMoment, _) => Provision::Derived(self.how()),
        }
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        run::sweep(self, case, visit, progress)
    }
}
