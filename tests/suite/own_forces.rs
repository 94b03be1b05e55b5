//! Forces that the engine itself exerts, judged in addition to the forces that follow from the engine's motion.

use analytic::AssurSolver;
use linkage::case::Wanted;
use linkage::engine::{Engine, Route};
use linkage::math::{KeepNan, Vec2};
use linkage::trajectory::{Channel, ChannelSubject, Stage};
use prover::engines::EngineName;
use prover::run::{EngineProof, Options, Proof, prove};
use rapier_twin::{Build, Precision, Rapier};
use scenario::Scenario;

use crate::common::{assert_within, shipped, states};

fn proven(scenario: &Scenario, options: &Options) -> Proof {
    prove(scenario, options).unwrap_or_else(|error| panic!("{error}"))
}

fn own(proof: &Proof) -> &EngineProof {
    proof.engine().own_forces.as_ref().expect("the exerted forces are judged")
}

#[test]
fn every_force_is_judged_twice_and_names_its_origin() {
    for (name, forces) in [("crank_rocker.toml", 9), ("double_pendulum.toml", 4), ("compressor_runup.toml", 17)] {
        let proof = proven(&shipped(name), &Options::default());
        let (engine, own) = (proof.engine(), own(&proof));
        assert_eq!((proof.verdict.word(), own.verdict.word()), ("agree", "agree"), "{name}");
        let wanted: Vec<_> = engine.channels.iter().map(|channel| &channel.residual.channel).collect();
        // Shaking force and moment are sums of the frame's reactions, so they do not count as exerted forces.
        let exerted = |channel: &&Channel| {
            channel.kind.stage >= Stage::Reactions && channel.kind.subject != ChannelSubject::Frame
        };
        let wanted: Vec<_> = wanted.into_iter().filter(exerted).collect();
        let judged: Vec<_> = own.channels.iter().map(|channel| &channel.residual.channel).collect();
        assert_eq!((wanted, judged.len()), (judged.clone(), forces), "{name}");
        assert_eq!(
            [engine.info.settings.route, own.info.settings.route],
            [Route::Differences, Route::Native],
            "{name}"
        );
        assert_ne!(engine.info.provides[3], own.info.provides[3], "{name}");
        // The routes by differences and by native impulses must give different numbers.
        let (ours, theirs) = (engine.trajectory.as_ref().unwrap(), own.trajectory.as_ref().unwrap());
        assert!(ours.column(judged[0]).unwrap() != theirs.column(judged[0]).unwrap(), "{name}");
        let worst = own.channels.iter().fold(0.0f64, |worst, own| worst.larger(own.bound / own.residual.scale));
        assert_within!(worst, 1e-2, "{name}");
    }
}

#[test]
fn exerted_forces_need_a_free_route_and_requested_forces() {
    let scenario = shipped("crank_rocker.toml");
    for route in [Route::Differences, Route::Native] {
        let proof = proven(&scenario, &Options::default().route(route).step(1e-3));
        assert!(proof.engine().own_forces.is_none() && proof.engine().info.settings.route == route);
    }
    let mut still = shipped("crank_rocker.toml");
    still.case = still.case.wanting(Wanted::of(&[Stage::Positions, Stage::Velocities]));
    assert!(proven(&still, &Options::default()).engine().own_forces.is_none());
}

/// The runs for the forces that the engine exerts use steps of at least half of the given step.
/// The proof needs a run with half of the given step in any case, to estimate the error of the given step.
#[test]
fn a_given_step_is_extrapolated_from_coarser_ones_only() {
    let scenario = shipped("crank_rocker.toml");
    for step in [1e-3, 2e-4] {
        let proof = proven(&scenario, &Options::default().step(step));
        let settings = own(&proof).info.settings;
        let finest = settings.resolution * 0.5f64.powi(settings.extrapolated as i32 + 1);
        assert!(finest >= 0.5 * step * (1.0 - 1e-9), "{finest:e} at {step:e}");
        assert_eq!((proof.verdict.word(), own(&proof).verdict.word()), ("agree", "agree"), "{step:e}");
        assert_eq!(proof.engine().info.settings.resolution, step);
    }
    // If step and number of extrapolations are both given, both are used unchanged.
    let proof = proven(&scenario, &Options::default().step(1e-3).extrapolated(2));
    let settings = own(&proof).info.settings;
    assert_eq!((settings.resolution, settings.extrapolated), (1e-3, 2));
}

#[test]
fn every_engine_has_its_own_exerted_forces() {
    let options = Options::default().engine(EngineName::Rapier).engine(EngineName::Impulse);
    let proof = proven(&shipped("scotch_yoke.toml"), &options);
    for engine in &proof.engines {
        let own = engine.own_forces.as_ref().expect("both builds exert forces");
        assert_eq!((own.info.name, own.verdict.word()), (engine.info.name, "agree"));
    }
}

/// In the run with twice the judged step, the sweeps have not yet corrected an error in the impulses of the first five
/// steps.
/// These impulses are left out; all later impulses are judged.
#[test]
fn exerted_forces_omit_only_the_start_of_a_free_motion() {
    let scenario = shipped("double_pendulum.toml");
    let proof = proven(&scenario, &Options::default());
    let own = own(&proof);
    let begin = 10.0 * own.info.settings.resolution;
    let early = scenario.case.grid.times.iter().filter(|time| **time <= begin).count();
    assert!(early > 0 && early < scenario.case.grid.times.len() / 2, "{early}");
    let left_out: Vec<usize> = own.channels.iter().map(|channel| channel.left_out).collect();
    assert_eq!(left_out, vec![early; own.channels.len()]);
}

/// In single precision, second differences over the first steps consist of rounding error, so these accelerations are
/// left out.
/// Later accelerations are judged; in double precision, all accelerations are judged.
#[cfg(feature = "f32")]
#[test]
fn rounded_accelerations_omit_only_the_start_of_free_motion() {
    let scenario = shipped("double_pendulum.toml");
    let left_out = |engine: EngineName| -> Vec<usize> {
        let proof = proven(&scenario, &Options::default().engine(engine).step(2e-3).sweeps(1).extrapolated(0));
        let channels = proof.engine().channels.iter();
        let own = channels.filter(|own| own.residual.channel.kind.stage == Stage::Accelerations);
        let mut all: Vec<usize> = own.map(|own| own.left_out).collect();
        all.dedup();
        all
    };
    let early = scenario.case.grid.times.iter().filter(|time| **time <= 10.0 * 2e-3).count();
    assert_eq!([left_out(EngineName::Rapier), left_out(EngineName::RapierF32)], [vec![0], vec![early]]);
}

/// Returns the largest error of the native reactions, divided by the largest force.
/// Also returns the largest error of the moment on the crank, divided by the largest moment.
/// Both errors are taken at the given times.
fn native_errors(name: &str, build: Build, step: f64, times: &[f64]) -> [f64; 2] {
    let scenario = shipped(name);
    let rapier = Rapier::new(build, Precision::Double, step);
    let settings = linkage::engine::Settings { route: Route::Native, sweeps: 8192, ..rapier.settings() };
    let found = states(&rapier.set(settings), &scenario.case, times).unwrap();
    let truth = states(&AssurSolver, &scenario.case, times).unwrap();
    let (mut error, mut size) = ([0.0f64; 2], [0.0f64; 2]);
    for (found, truth) in found.iter().zip(&truth) {
        for (a, b) in found.forces.iter().zip(&truth.forces) {
            (error[0], size[0]) = (error[0].larger((a - b as &Vec2).norm()), size[0].larger(b.norm()));
        }
        let [a, b] = [found, truth].map(|state| state.torques[0]);
        (error[1], size[1]) = (error[1].larger((a - b).abs()), size[1].larger(b.abs()));
    }
    [error[0] / size[0], error[1] / size[1]]
}

/// If a mechanism starts in motion, its first velocities satisfy the constraints of the first pose, not of an earlier
/// pose.
/// In later steps, the impulses also turn the velocities from the constraints of the previous pose to those of the
/// present pose.
/// Without a correction, the impulses of the first steps lack this part.
/// The missing part is 39 % of the range of a reaction, at any step.
#[test]
fn impulses_at_the_start_of_a_moving_mechanism_converge() {
    for build in [Build::Multibody, Build::Impulse] {
        let [coarse, fine] =
            [4e-4, 1e-4].map(|step| native_errors("five_bar_on_a_spring.toml", build, step, &[0.0, 2e-3])[0]);
        assert_within!(fine, 5e-3, "{build:?}");
        assert!(coarse / fine > 3.0, "{build:?}: {coarse:e} and {fine:e}");
    }
}

/// If a motor's moment does not fall with the speed, Rapier receives the moment as a load.
/// The impulses do not contain the moment, but the moment counts as a force that the drive exerts.
#[test]
fn a_motor_moment_applied_as_a_load_is_an_exerted_force() {
    let errors = native_errors("compressor_runup.toml", Build::Multibody, 1e-4, &[0.0, 0.02, 0.05, 0.1]);
    assert_within!(errors[1], 1e-3, "moment");
    assert_within!(errors[0], 5e-3, "reactions");
}
