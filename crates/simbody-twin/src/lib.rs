//! Simbody as an engine: bodies on mobilizers, loops closed by constraints, an integrator that controls its error.
//! This engine shares no code with the other engines. From the case the engine uses only geometry, masses, drive and
//! the pose at t = 0.
//! See docs/numerics/twins.md.

mod free;
mod model;
mod noise;
mod sentences;

use linkproof_simbody::{Failure, LinkageRun};

use linkage::case::Case;
use linkage::drive::{Load, Wrench};
use linkage::engine::{Engine, Route, Settings, Statics};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::{KeepNan, unit};
use linkage::solver::{Progress, Provision, Solver, State, Visit, check_instants};
use linkage::trajectory::{Channel, ChannelKind, Stage};
use linkage::work::{Count, WorkTally};
use model::Linkage;

/// If a joint's opening in the start pose, divided by the mechanism's size, exceeds this limit, the case is rejected.
/// The limit is far above rounding error. An opening below the limit does not affect the results.
const LARGEST_GAP: f64 = 1e-9;
/// Number of internal steps allowed per radian of crank angle at the default accuracy.
/// If two instants are less than a radian apart, this number of steps is allowed between the two instants.
/// `ov7_base` takes 200 steps at the default accuracy, and 14 000 steps at an accuracy of 1e-14.
/// Without a limit the integrator would need hours for tiny steps near a dead point.
const MAX_STEPS: f64 = 2000.0;

/// Simbody 3 as an engine.
#[derive(Clone, Copy, Debug)]
pub struct Simbody {
    accuracy: f64,
}

impl Simbody {
    /// Default accuracy. The default gives steps of about a degree of the crank.
    /// Each projection therefore starts close to the pose in the current assembly mode.
    pub const ACCURACY: f64 = 1e-8;
    /// Constraint tolerance divided by the mechanism's extent from the origin.
    /// Under prescribed motion the pose follows from the constraints alone: a looser tolerance would only add error.
    /// Projections aim at a tenth of the tolerance. Rounding errors prevent a smaller tolerance.
    /// With a tolerance of 1e-14, projections fail on `fourth_class`.
    pub const TOLERANCE: f64 = 1e-12;

    /// The engine with the given accuracy of its integrator, relative to a coordinate of 1 rad or 1 m.
    pub fn new(accuracy: f64) -> Self {
        Simbody { accuracy }
    }

    fn start(self, case: &Case, sense: f64) -> Result<(Linkage, LinkageRun)> {
        if !(self.accuracy > 0.0 && self.accuracy < 1.0) {
            let message = sentences::the_engine_accuracy_is(&self.accuracy);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_AN_ACCURACY_BETWEEN_AND_FOR_ONE));
        }
        if let Some(drive) = case.drives.iter().find(|drive| drive.constant_speed().is_none()) {
            let message = sentences::a_drive_with_the_law_is_not_handed(&drive.law_name());
            return Err(Error::new(ErrorKind::Unsupported, message).help(Advice::OtherEngine));
        }
        if case.has_friction() {
            return Err(Error::new(ErrorKind::Unsupported, sentences::FRICTION_IS_NOT_HANDED));
        }
        if let Some(transmission) = case.mechanism.transmissions().first() {
            let message = sentences::a_transmission_is_not_handed(&transmission.name());
            return Err(Error::new(ErrorKind::Unsupported, message).help(Advice::OtherEngine));
        }
        check_start(case)?;
        let settings = self.settings_for(case);
        if case.is_free() {
            return free::start(case, settings);
        }
        let linkage = Linkage::new(case, sense, None)?;
        let run = linkage.model.run(settings).map_err(|failure| linkage.stopped(case, &failure))?;
        Ok((linkage, run))
    }

    fn settings_for(self, case: &Case) -> linkproof_simbody::IntegrationSettings {
        linkproof_simbody::IntegrationSettings {
            accuracy: self.accuracy,
            tolerance: tolerance(case),
            time_scale: 1.0 / case.drives.top_speed(case.mechanism.size()),
            // The local error is of fourth order in the step. The number of steps is thus proportional to
            // accuracy^(-1/4).
            steps: (MAX_STEPS * (Simbody::ACCURACY / self.accuracy).larger(1.0).powf(0.25)) as usize,
        }
    }
}

impl Engine for Simbody {
    fn version(&self) -> String {
        format!("Simbody {}", linkproof_simbody::version())
    }

    fn settings(&self) -> Settings {
        let (resolution, route) = (self.accuracy, Route::Native);
        Settings { resolution, sweeps: 0, substeps: 1, route, extrapolated: 0 }
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        // Of the settings, only the resolution is used: Simbody has no sweeps, no substeps and no extrapolation, and
        // only one method for reactions.
        let Settings { resolution: accuracy, sweeps: _, substeps: _, route: _, extrapolated: _ } = settings;
        Box::new(Simbody { accuracy })
    }

    fn controls_error(&self) -> bool {
        true
    }

    fn routes(&self) -> &'static [Route] {
        &[Route::Native]
    }

    fn own_routes(&self, _: &Case) -> &'static [Route] {
        // The list is empty, because the default method already reports the forces that act in the simulation.
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
        // The order of convergence is 1, because errors are proportional to the accuracy.
        1.0
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        noise::bound(case, [tolerance(case), self.accuracy], channel)
    }

    fn is_noise_measured(&self) -> bool {
        false
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        vec![
            ("build", sentences::SPANNING_TREE_OF_PINS_AND_SLIDERS.into()),
            ("drive", sentences::PRESCRIBED_COORDINATES_UNDER_FORCES_MOTOR.into()),
            ("integrator", sentences::RUNGE_KUTTA_MERSON_EVERY_STEP.into()),
            ("accuracy", format!("{:e}", self.accuracy)),
            ("constraint tolerance", sentences::of_the_mechanism_reach(&format_args!("{:e}", Simbody::TOLERANCE))),
            ("reactions", sentences::MOBILIZER_REACTIONS_AND_MULTIPLIERS.into()),
        ]
    }
}

impl Solver for Simbody {
    fn name(&self) -> &'static str {
        "simbody"
    }

    fn provides(&self, _: &Channel) -> Provision {
        Provision::Computed
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        check_instants(case)?;
        check_start(case)?;
        let rows = case.grid.ascending();
        let (before, after) = rows.split_at(rows.partition_point(|&row| case.grid.times[row] < 0.0));
        let reactions = case.wanted.deepest() >= Stage::Reactions;
        let ends = [before.first(), after.last()].map(|row| row.map_or(0.0, |&row| case.grid.times[row].abs()));
        let (total, mut done) = (ends[0] + ends[1], 0.0);
        let backwards: Vec<usize> = before.iter().rev().copied().collect();
        let mut state = State::at_rest(case);
        // Resistances are forces inside Simbody. The loads other than resistances are applied when reactions are read.
        let others = case.with(|parts| parts.loads = other_loads(case))?;
        let mut wrenches = vec![Wrench::ZERO; case.mechanism.links().len()];
        let mut tally = WorkTally::default();
        for (sense, rows, end) in [(-1.0, backwards.as_slice(), ends[0]), (1.0, after, ends[1])] {
            if rows.is_empty() {
                continue;
            }
            let (linkage, mut run) = self.start(case, sense)?;
            let stopped = |failure: Failure| linkage.stopped(case, &failure);
            for &row in rows {
                let t = case.grid.times[row];
                let before = run.steps();
                let advanced = run.advance(t.abs());
                tally.many(Count::Steps, run.steps() - before);
                advanced.map_err(stopped)?;
                if reactions && !others.loads.is_empty() {
                    let found = run.read(false).map_err(stopped)?;
                    linkage.motion(&found.bodies, &mut state);
                    others.loads_on(&state.motions, &state.angles, &mut wrenches);
                    let loads: Vec<[f64; 3]> = linkage.loads(&wrenches).collect();
                    run.load(&loads).map_err(stopped)?;
                }
                let found = run.read(reactions).map_err(stopped)?;
                // The condition is written with `!`, so that a gap that is not a number (NaN) also stops the run.
                if !found.loops.iter().all(|closed| closed.gap <= 2.0 * tolerance(case)) {
                    let gaps: Vec<f64> = found.loops.iter().map(|closed| closed.gap).collect();
                    let widest = gaps.iter().copied().fold(0.0, f64::larger);
                    let message = sentences::A_LOOP_IS_OPEN_BY_MORE_THAN_ITS_TOLERANCE.into();
                    let failure = Failure { message, time: Some(t.abs()), gaps };
                    let error = stopped(failure);
                    return Err(error.beyond(widest, 2.0 * tolerance(case), "m"));
                }
                linkage.motion(&found.bodies, &mut state);
                if reactions {
                    linkage.reactions(case, &found.bodies, &found.loops, &mut state);
                }
                visit(row, &state)?;
                if total > 0.0 {
                    progress((done + t.abs()) / total);
                }
            }
            done += end;
        }
        progress(1.0);
        Ok(())
    }
}

/// Loads that are not forces inside Simbody.
fn other_loads(case: &Case) -> Vec<Load> {
    match case.is_free() {
        // In a free motion all loads already act inside Simbody, so no loads remain.
        true => Vec::new(),
        false => case.loads.iter().filter(|load| load.resistance().is_none()).cloned().collect(),
    }
}

/// Largest constraint error (m).
fn tolerance(case: &Case) -> f64 {
    let size = case.mechanism.size();
    Simbody::TOLERANCE * case.start.0.iter().fold(size, |most: f64, pose| most.larger(pose.origin.norm()))
}

/// Checks that the start pose is closed. If the pose were open, Simbody would assemble a nearby pose without a message.
fn check_start(case: &Case) -> Result<()> {
    let closure = case.start.closure(&case.mechanism);
    if closure <= LARGEST_GAP * case.mechanism.size() {
        return Ok(());
    }
    let gap = |joint: &linkage::mechanism::Joint| {
        let places = [joint.first, joint.second].map(|side| case.start.0[side.link].point(side.local));
        joint.opening(places, [joint.first, joint.second].map(|side| unit(case.start.0[side.link].angle))).0
    };
    let widest = case.mechanism.joints().iter().reduce(|a, b| if gap(a) >= gap(b) { a } else { b });
    let name = widest.map_or("", |joint| joint.name.as_str());
    let (at, bound) = (case.told(case.crank().start), LARGEST_GAP * case.mechanism.size());
    let message = sentences::the_pose_at_is_open_by_most(&at, &format_args!("{closure:.3e}"), &name);
    let error = Error::new(ErrorKind::Geometry, message).at_time(0.0).at_input(at).of_joint(name);
    Err(error.beyond(closure, bound, "m").help(sentences::GIVE_A_START_POSE_IN_WHICH_ALL))
}
