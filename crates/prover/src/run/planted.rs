//! Faults planted in solvers. Every check must find a fault that is a little larger than the check's bound, and must
//! accept a fault below this bound.

use crate::sentences;
use std::path::Path;

use super::each_side::{EachSide, Reference};
use super::engine_proof::ChannelProof;
use super::entrants::{ObservedSides, TRUE_SIDES};
use super::figures::Measured;
use super::judge::Judge;
use super::known::Known;
use super::ledger::Ledger;
use super::observe::{Observed, Watch, observe};
use super::options::Chosen;
use super::problem::Problem;
use super::{checks, engines, methods, oracle, settle};
use crate::bounds::{Check, Verdict, magnitudes};
use crate::run::{EngineProof, Options, prove};
use analytic::witness::triad::Triad;
use analytic::{AssurSolver, NewtonSolver};
use lab::specimens::spec::four_bar;

use linkage::case::{Case, Grid, Wanted};
use linkage::engine::{Engine, Hook, Route, Settings, Wrapped};
use linkage::math::{Vec2, turned};
use linkage::mechanism::{GROUND, JointId, LinkId};
use linkage::solver::{Solver, State};
use linkage::trajectory::Channel;
use rapier_twin::Rapier;
use scenario::{EngineSettings, MechanismFigure, Scenario};

/// Step of the engines (s).
const STEP: f64 = 1e-3;

/// Effect of a fault of a given size on every state.
type Fault = fn(&mut State, f64);

fn text(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

fn path(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(format!("{name}.toml"))
}

fn parsed(name: &str, text: &str) -> Scenario {
    Scenario::parse(text, path(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// A fault of the same size in all states.
#[derive(Clone, Copy)]
struct Everywhere {
    fault: Fault,
    size: f64,
    /// Whether the size of the fault is proportional to the engine's step.
    grows: bool,
}

impl Hook for Everywhere {
    fn answer(&self, _: &Case, _: usize, state: &mut State) {
        (self.fault)(state, self.size);
    }

    fn with(&self, from: Settings, to: Settings) -> Self {
        let longer = if self.grows { to.resolution / from.resolution } else { 1.0 };
        Everywhere { size: self.size * longer, ..*self }
    }
}

fn seen(case: &Case, solver: &dyn Solver) -> Observed {
    observe(case, solver, Watch::Side, &mut |_| {}).unwrap_or_else(|stopped| panic!("{}", stopped.error))
}

fn assur(fault: Fault, size: f64) -> Wrapped<Everywhere, dyn Solver> {
    Wrapped { hook: Everywhere { fault, size, grows: false }, inner: Box::new(AssurSolver) }
}

fn knowing(case: &Case) -> Known {
    let [first, second] = [seen(case, &AssurSolver), seen(case, &NewtonSolver)];
    Known::of(case, [&first.trajectory, &second.trajectory]).unwrap()
}

/// The checks of published numbers.
fn by_oracles(scenario: &Scenario, integration: &dyn Fn(Reference, &Channel) -> f64) -> Vec<Check> {
    let problem = Problem::of(scenario, &scenario.case);
    oracle::checks(problem, problem.case, EachSide::of(Reference::solver), integration).unwrap()
}

/// The check whose name begins with `name`.
fn named<'a>(checks: &'a [Check], name: &str) -> &'a Check {
    let names: Vec<String> = checks.iter().map(Check::name).collect();
    checks.iter().find(|check| check.name().starts_with(name)).unwrap_or_else(|| panic!("{name}: {names:?}"))
}

fn nothing(_: &mut State, _: f64) {}

#[test]
fn side_checks_find_three_times_their_bound_and_pass_a_fifth() {
    let case = parsed("crank_rocker", &text("crank_rocker")).case;
    let [truth, other] = [seen(&case, &AssurSolver), seen(&case, &NewtonSolver)];
    let known = knowing(&case);
    let largest = |name: &str| {
        let place = truth.trajectory.channels().iter().position(|channel| channel.to_string() == name).unwrap();
        magnitudes(&truth.trajectory)[place]
    };
    let moved: Fault = |state, size| state.motions[LinkId(3)].origin.x += size;
    let force: Fault = |state, size| state.forces[JointId(0)].x += size;
    let torque: Fault = |state, size| state.torques[0] += size;
    let planted: [(&str, Fault, f64); 8] = [
        (sentences::CLOSURE_OF_ALL_JOINTS_ASSUR, moved, 1e-13 * case.mechanism.size()),
        (
            sentences::ASSUR_AGAINST_NEWTON_POSITIONS,
            |state, size| state.angles[LinkId(2)] += size,
            1e-12 * largest("link.coupler.angle_rad"),
        ),
        (
            sentences::ASSUR_AGAINST_NEWTON_VELOCITIES,
            |state, size| state.motions[LinkId(2)].omega += size,
            1e-11 * largest("link.coupler.omega_rad_s"),
        ),
        (
            sentences::ASSUR_AGAINST_NEWTON_ACCELERATIONS,
            |state, size| state.motions[LinkId(2)].alpha += size,
            1e-11 * largest("link.coupler.alpha_rad_s2"),
        ),
        (sentences::ASSUR_AGAINST_NEWTON_REACTIONS, force, 1e-10 * largest("joint.O.fx_N")),
        (sentences::ASSUR_AGAINST_NEWTON_BALANCING_MOMENT, torque, 1e-10 * largest("drive.torque_N_m")),
        (sentences::BALANCING_MOMENT_FROM_EQUILIBRIUM_AND_FROM_POWERS_ASSUR, torque, 1e-11 * truth.moment),
        // A planted error in the force of the frame's joint causes an equal error in the shaking force.
        (sentences::SHAKING_FORCE_AND_MOMENT_FROM_REACTIONS_AND_FROM_MOMENTUM, force, 1e-11 * largest("joint.O.fx_N")),
    ];
    for (name, fault, bound) in planted {
        for (share, word) in [(3.0, "disagree"), (0.2, "agree")] {
            let wrong = seen(&case, &assur(fault, share * bound));
            let found = checks::of_sides(&case, EachSide::new(&wrong, &other), &known);
            let check = named(&found, name);
            assert_eq!(check.verdict.word(), word, "{name} at {share}: {:e} of {:e}", check.value, check.bound);
        }
    }
}

/// Symptom: 1e-9 deg from a dead centre the crank pin's acceleration was wrong by 176 %, but the check between the
/// sides did not find the error. Cause: the check used the largest acceleration of the mechanism as scale, and the
/// condition number of the worst group. The check must use the numbers from which the channel itself is computed.
#[test]
fn regress_a_driving_link_has_its_own_bound_near_a_dead_point() {
    let folded = [
        ("C = { x_mm = 150, y_mm = 15 }", "C = { x_mm = 400, y_mm = 0 }"),
        ("A = { x_m = 0.025995627740337, y_m = 0 }", "A = { x_mm = 300, y_mm = 0 }"),
        ("B = { x_m = 0.34707193189181, y_m = 0 }", "B = { x_mm = 250, y_mm = 0 }"),
        ("B = { x_mm = 250, y_mm = 0 }\nD", "B = { x_mm = 200, y_mm = 0 }\nD"),
        ("crank_deg = 0\n", "crank_deg = 30\n"),
        ("from_deg = 0\nto_deg = 360", "from_deg = 30\nto_deg = 40"),
    ];
    let swinging = folded.iter().fold(text("crank_rocker"), |text, (from, to)| text.replace(from, to));
    let case = parsed("crank_rocker", &swinging).case;
    let limit = ((0.4f64.powi(2) + 0.3f64.powi(2) - 0.45f64.powi(2)) / (2.0 * 0.4 * 0.3)).acos();
    let cranks = [50.0, 1e-3, 1e-9].map(|off: f64| limit - off.to_radians());
    let times = cranks.map(|crank| case.crank().time_of(crank)).to_vec();
    let case = case.on(Grid::of_times(case.crank(), times)).unwrap();
    let [truth, other] = [seen(&case, &AssurSolver), seen(&case, &NewtonSolver)];
    let mut known = knowing(&case);
    known.measure(&case, &AssurSolver).unwrap();
    let alpha = case.crank().top_speed().powi(2);
    let slower: Fault = |state, size| state.motions[LinkId(1)].alpha -= size;
    for (size, is_found) in [(0.0, false), (0.2e-11 * alpha, false), (3e-11 * alpha, true), (1.76 * alpha, true)] {
        let slow = seen(&case, &assur(slower, size));
        let differ = checks::sides_differ([&truth.trajectory, &slow.trajectory], &known);
        assert_eq!(differ, is_found, "{size:e}");
    }
    // Without a fault, the analytic sides differ at this pose only by rounding.
    assert!(!checks::sides_differ([&truth.trajectory, &other.trajectory], &known));
}

/// A NaN in the observed quantities must reach the check.
#[test]
fn nan_at_one_instant_disagrees() {
    let case = parsed("crank_rocker", &text("crank_rocker")).case;
    let [truth, other] = [seen(&case, &AssurSolver), seen(&case, &NewtonSolver)];
    let known = knowing(&case);
    type Spoil = fn(&mut Observed);
    let spoiled: [(&str, Spoil); 5] = [
        (sentences::CLOSURE_OF_ALL_JOINTS_ASSUR, |side| side.opening[7] = f64::NAN),
        (sentences::CLOSURE_OF_ALL_JOINTS_ASSUR, |side| side.reach = f64::NAN),
        (sentences::BALANCING_MOMENT_FROM_EQUILIBRIUM_AND_FROM_POWERS_ASSUR, |side| side.power[7] = f64::NAN),
        (sentences::BALANCING_MOMENT_FROM_EQUILIBRIUM_AND_FROM_POWERS_ASSUR, |side| side.moment = f64::NAN),
        (sentences::SHAKING_FORCE_AND_MOMENT_FROM_REACTIONS_AND_FROM_MOMENTUM, |side| side.unbalance = Some(f64::NAN)),
    ];
    for (name, spoil) in spoiled {
        let mut side = truth.clone();
        spoil(&mut side);
        let found = checks::of_sides(&case, EachSide::new(&side, &other), &known);
        assert_eq!(named(&found, name).verdict.word(), "disagree", "{name}");
    }
    // A NaN reaches the closure check even if no channel shows the NaN.
    let second: Fault = |state, _| state.motions[LinkId(3)].origin.y = f64::NAN;
    let positions = case.wanting(Wanted::of(&[]));
    assert!(seen(&positions, &assur(second, 0.0)).closure().is_nan());
}

#[test]
fn every_class_three_method_is_in_the_proof_and_finds_faults() {
    let scenario = parsed("class3_group", &text("class3_group"));
    let case = &scenario.case;
    let all = [
        sentences::CLASS_III_BY_CRAMER_RULE,
        sentences::CLASS_III_BY_CLASS_CHANGE,
        sentences::CLASS_III_REACTIONS_BY_THE_SINGULAR,
        sentences::CLASS_III_REACTIONS_BY_THE_GROUP,
    ];
    let right = methods::checks(case, &AssurSolver).unwrap();
    assert_eq!(right.len(), all.len());
    assert!(right.iter().all(|check| check.verdict.word() == "agree"), "{right:?}");
    // Angles, rates and forces of the group's links and joints are changed by 1e-9 of their magnitude: ten times the
    // largest bound.
    // Of the published methods, only the method of class change computes directions.
    let [first, ..] = Triad::all(case)[0].links();
    assert_ne!(first, GROUND);
    let rates: Fault = |state, size| state.motions.iter_mut().skip(2).for_each(|motion| motion.omega *= 1.0 + size);
    let forces: Fault = |state, size| state.forces.iter_mut().for_each(|force| *force *= 1.0 + size);
    let rates_of_rates: Fault =
        |state, size| state.motions.iter_mut().skip(2).for_each(|motion| motion.alpha *= 1.0 + size);
    let angles: Fault = |state, size| {
        state.motions.iter_mut().skip(2).for_each(|motion| motion.direction += size * turned(motion.direction));
    };
    let planted = [(rates, &all[..2]), (rates_of_rates, &all[..2]), (angles, &all[1..2]), (forces, &all[2..])];
    for (fault, wrong) in planted {
        for (size, word) in [(1e-9, "disagree"), (1e-12, "agree")] {
            let found = methods::checks(case, &assur(fault, size)).unwrap();
            for name in wrong {
                let check = named(&found, name);
                assert_eq!(check.verdict.word(), word, "{name} at {size:e}: {:e}", check.value);
            }
        }
    }
    // The methods are not used at a change point, because their equations are singular at a change point.
    let passing: Fault = |state, size| {
        state.passing = Some(1.0);
        state.motions.iter_mut().for_each(|motion| (motion.omega, motion.alpha) = (size, size));
        state.forces.iter_mut().for_each(|force| force.x = size);
    };
    let asked = methods::checks(case, &assur(passing, f64::NAN)).unwrap();
    let agrees = |check: &Check| check.value == 0.0 && check.verdict.word() == "agree";
    assert!(asked.len() == all.len() && asked.iter().all(agrees), "{asked:?}");
    let proof = prove(&scenario, &Options::default()).unwrap();
    for name in all {
        let own = named(&proof.checks, name);
        let direct = named(&right, name);
        assert_eq!((own.value, own.bound), (direct.value, direct.bound), "{name}");
    }
}

/// The settings that the proof searches: none, or all.
#[derive(Clone, Copy, Debug)]
enum Search {
    None,
    Everything,
}

fn engine_proof(scenario: &Scenario, fault: Fault, size: f64) -> EngineProof {
    engine_proven(scenario, Everywhere { fault, size, grows: false }, Search::None)
}

fn engine_proven(scenario: &Scenario, hook: Everywhere, search: Search) -> EngineProof {
    let reference = seen(&scenario.case, &AssurSolver);
    let rapier = Rapier::all(STEP).into_iter().next().unwrap();
    let inner = Box::new(rapier) as Box<dyn Engine>;
    let engine: Box<dyn Engine> = Box::new(Wrapped { hook, inner });
    let given = match search {
        Search::None => EngineSettings::exactly(engine.as_ref()),
        Search::Everything => EngineSettings::default(),
    };
    let chosen = Chosen { engine, given, budget: settle::BUDGET }.by_motion_alone();
    let known = knowing(&scenario.case);
    let judge = Judge::new(Problem::of(scenario, &scenario.case), &reference, &known, chosen.engine.settings());
    engines::prove(&judge, &scenario.case, &chosen, &mut Ledger::default(), &mut |_| {}).unwrap()
}

/// Two faults are planted: an opening that does not tend to zero with the step, and a balancing moment that disagrees
/// with the balance of powers. The opening is far below 1 % of the mechanism's size. The fault of the moment is far
/// below 1 % of the largest moment.
#[test]
fn engine_checks_find_errors_that_do_not_vanish_with_the_step() {
    let scenario = parsed("crank_rocker", &text("crank_rocker"));
    let true_one = engine_proof(&scenario, nothing, 0.0);
    assert_eq!(true_one.verdict.word(), "agree");
    let [closure, powers] =
        [sentences::CLOSURE_OF_ALL_JOINTS_2, "driving moment"].map(|name| named(&true_one.checks, name).clone());
    // The bound from the engine's own runs is at most 30 % larger than the opening.
    assert!(closure.bound <= 1.3 * closure.value && closure.bound < 2e-5, "{closure:?}");
    // The rounding error of a joint's opening is the rounding error of the joint's position on its links.
    let place = true_one.channels.iter().find(|own| own.residual.channel.to_string() == "point.A.x_m").unwrap();
    let rounding = closure.estimate.unwrap().0.rounding * scenario.case.mechanism.size();
    assert!((rounding / place.parts.rounding - 1.0).abs() < 1e-12, "{rounding:e} {:?}", place.parts);
    assert!(powers.bound < 1e-9, "{powers:?}");
    let moved: Fault = |state, size| state.motions[LinkId(3)].origin.x += size;
    let torque: Fault = |state, size| state.torques[0] += size;
    let size = scenario.case.mechanism.size();
    let moment = seen(&scenario.case, &AssurSolver).moment;
    let planted = [
        (sentences::CLOSURE_OF_ALL_JOINTS_2, moved, 2.0 * closure.bound * size),
        ("driving moment", torque, 2.0 * powers.bound * moment),
    ];
    for (name, fault, amount) in planted {
        let wrong = engine_proof(&scenario, fault, amount);
        let check = named(&wrong.checks, name);
        assert_eq!(check.verdict.word(), "disagree", "{name}: {:e} of {:e}", check.value, check.bound);
        let little = engine_proof(&scenario, fault, amount / 100.0);
        assert_eq!(named(&little.checks, name).verdict.word(), "agree", "{name}");
    }
}

/// Velocities that are half a step late converge to the right values with order 1. Accelerations that are a quarter of
/// a step late also converge with order 1.
/// The bound from the engine's own runs always covers the error of a late reading.
#[test]
fn regress_late_readings_converge_with_order_one_and_disagree() {
    let velocities: Fault = |state, late| {
        for motion in &mut state.motions {
            motion.omega -= late * motion.alpha;
            motion.velocity -= late * motion.acceleration;
        }
    };
    let accelerations: Fault = |state, late| {
        // The planted fault is the delay times omega^3: the jerk has the order of magnitude of omega^3.
        state.motions.iter_mut().for_each(|motion| motion.alpha -= late * motion.omega.powi(3));
    };
    // Five runs with steps up to 8e-3 s show the order for the crank-rocker, but not for the faster machine `ov7_base`.
    // `ov7_base` is therefore tested only with free settings.
    for (name, free) in
        [("crank_rocker", Search::None), ("crank_rocker", Search::Everything), ("ov7_base", Search::Everything)]
    {
        let scenario = parsed(name, &text(name));
        for (fault, late, of) in [(velocities, 0.5, "omega"), (accelerations, 0.25, "alpha")] {
            let proof = engine_proven(&scenario, Everywhere { fault, size: late * STEP, grows: true }, free);
            assert_eq!(proof.verdict.word(), "disagree", "{name} {of} {free:?}: {:?}", proof.verdict);
            let told = |own: &ChannelProof| {
                own.residual.channel.to_string().contains(of)
                    && matches!(&own.verdict, Verdict::Disagree { place } if place.contains("with order"))
            };
            assert!(proof.channels.iter().any(told), "{name} {of} {free:?}");
        }
        let right = engine_proven(&scenario, Everywhere { fault: nothing, size: 0.0, grows: true }, free);
        assert_eq!(right.verdict.word(), "agree", "{name}");
    }
}

/// Each analytic side has a separate integration error, which does not depend on the choice of the reference.
#[test]
fn each_side_has_the_error_of_its_own_integration() {
    let plain = text("crank_rocker_runup");
    let short = format!("{}[grid]\nfrom_s = 0\nto_s = 0.1\nstep_s = 0.05\n", &plain[..plain.find("[grid]").unwrap()]);
    let scenario = parsed("crank_rocker_runup", &short);
    let problem = Problem::of(&scenario, &scenario.case);
    let known = |reference: Reference| {
        let sides = ObservedSides::of(problem, &scenario.case, TRUE_SIDES, reference, &mut Ledger::default()).unwrap();
        Reference::ALL.map(|side| sides.on_course(&scenario.case, side, |course| Ok(course.crank(2).error)).unwrap())
    };
    let [by_first, by_second] = [known(Reference::Assur), known(Reference::Newton)];
    assert!((by_first[0] / by_first[1] - 1.0).abs() > 1e-3, "{by_first:?}");
    for side in 0..2 {
        assert!((by_first[side] / by_second[side] - 1.0).abs() < 1e-4, "{by_first:?} {by_second:?}");
    }
}

/// A difference between the sides is reported with the first instant of disagreement, and as a multiple of the allowed
/// difference.
#[test]
fn side_differences_are_reported_as_multiples_of_the_bound() {
    let case = parsed("crank_rocker", &text("crank_rocker")).case;
    let truth = seen(&case, &AssurSolver);
    let place = truth.trajectory.channels().iter().position(|own| own.to_string() == "joint.O.fx_N").unwrap();
    let largest = magnitudes(&truth.trajectory)[place];
    let force: Fault = |state, size| state.forces[JointId(0)].x += size;
    let [wrong, other] = [seen(&case, &assur(force, 3e-10 * largest)), seen(&case, &NewtonSolver)];
    let beyond = checks::beyond(EachSide::new(&wrong, &other), &knowing(&case));
    let own = beyond.iter().find(|own| own.channel.to_string() == "joint.O.fx_N").unwrap();
    assert!((2.0..3.5).contains(&own.margin) && own.since.0 == case.grid.times[0], "{own:?}");
    assert!(
        beyond.iter().all(|own| own.channel.kind.subject != linkage::trajectory::ChannelSubject::Point),
        "{beyond:?}"
    );
}

/// If the drive is reversed, only the sign of the steady speeds changes.
/// A resistance opposes both directions of motion, and over a revolution weights rise as far as they fall.
#[test]
fn a_reversed_drive_has_the_reversed_steady_speed() {
    let speeds = |rpm: &str| {
        let text = text("crank_rocker").replace("speed_rpm = 130", rpm);
        let scenario = parsed("crank_rocker", &text[..text.find("[[oracle]]").unwrap()]);
        let mut measured = Measured::of(&scenario.case, &AssurSolver);
        [MechanismFigure::SteadyCrankSpeed, MechanismFigure::SteadyMotorSpeed]
            .map(|figure| measured.value(figure).unwrap())
    };
    let [forwards, backwards] = [speeds("speed_rpm = 130"), speeds("speed_rpm = -130")];
    for (one, other) in forwards.into_iter().zip(backwards) {
        assert!(one > 1.0 && (one + other).abs() < 1e-9 * one, "{one} {other}");
    }
}

/// Channels and checks of extrapolated runs have the same safety factor: see `Convergence::extrapolated`.
#[test]
fn all_bounds_of_extrapolated_runs_have_the_larger_factor() {
    let scenario = parsed("crank_rocker", &text("crank_rocker"));
    for (extrapolated, least) in [(1, 3.0), (2, 10.0)] {
        let options = Options::default().step(2e-3).sweeps(16).extrapolated(extrapolated).route(Route::Differences);
        let proof = prove(&scenario, &options).unwrap();
        let engine = &proof.engines[0];
        let channels = engine.channels.iter().map(|own| own.convergence.safety);
        let checks = engine.checks.iter().filter_map(|check| Some(check.estimate.as_ref()?.1.safety));
        let all: Vec<f64> = channels.chain(checks).collect();
        assert!(all.len() > 50 && all.iter().all(|safety| *safety >= least), "{extrapolated}: {all:?}");
    }
}

/// The recorded error is the engine's value minus the reference's value: a fault that increases the engine's value
/// gives a positive error.
#[test]
fn errors_of_an_engine_have_the_sign_of_its_fault() {
    let scenario = parsed("crank_rocker", &text("crank_rocker"));
    let far: Fault = |state, size| state.torques[0] += size;
    let proof = engine_proof(&scenario, far, 100.0);
    let torque = Channel::named("drive.torque_N_m").unwrap();
    let errors = proof.errors.unwrap();
    assert!(errors.column(&torque).unwrap().iter().all(|error| (error - 100.0).abs() < 1.0));
}

/// One published number after another is changed by one unit of its last digit. The checks on both sides must then
/// disagree.
#[test]
fn an_oracle_detects_one_unit_of_its_last_digit() {
    let name = "crank_rocker";
    let oracle_checks = |text: &str| by_oracles(&parsed(name, text), &|_, _| 0.0);
    assert!(oracle_checks(&text(name)).iter().all(|check| ["agree", "expected"].contains(&check.verdict.word())));
    let moved = [
        (sentences::VALUE_DIGITS_8, sentences::VALUE_DIGITS_7, "link.rocker.angle_deg"),
        ("value = 0.164846", "value = 0.164847", "reduced_inertia_mean_kg_m2"),
        ("value = 17.7778", "value = 17.7779", "reduced_resistance_mean_N_m"),
        (sentences::VALUE_DIGITS_6, sentences::VALUE_DIGITS_5, "steady_crank_speed_rad_s"),
        (sentences::VALUE_DIGITS_4, sentences::VALUE_DIGITS_3, "steady_motor_speed_rad_s"),
        (sentences::VALUE_DIGITS_2, sentences::VALUE_DIGITS, "distance_m of C B"),
        ("value = 0.025995627740", "value = 0.025995627741", "distance_m of O A"),
        ("value = 0.347071931892", "value = 0.347071931893", "distance_m of A B"),
    ];
    for (from, to, figure) in moved {
        let wrong = text(name).replacen(from, to, 1);
        assert_ne!(wrong, text(name), "{from}");
        let found = oracle_checks(&wrong);
        let missed: Vec<&Check> =
            found.iter().filter(|check| check.detail == figure && check.verdict.word() == "disagree").collect();
        assert_eq!(missed.len(), 2, "{figure}, on both sides");
    }
}

/// The integration error is added to the bound of published numbers at a time. The bounds of numbers at a crank angle
/// do not change.
#[test]
fn integration_error_widens_the_bound_of_numbers_at_a_time() {
    // The oracle has numbers at a crank angle and at a time.
    let both = parsed("five_bar_on_a_spring", &text("five_bar_on_a_spring"));
    let bounds = |left: f64| {
        let found = by_oracles(&both, &|_, _| left);
        found.into_iter().map(|check| (check.family.contains(" s ("), check.bound)).collect::<Vec<_>>()
    };
    let narrow = bounds(0.0);
    assert!([true, false].iter().all(|is_timed| narrow.iter().filter(|own| own.0 == *is_timed).count() > 80));
    for ((is_timed, own), (_, wide)) in narrow.into_iter().zip(bounds(1e-3)) {
        let more = if is_timed { 1e-3 } else { 0.0 };
        assert!((wide - own - more).abs() < 1e-15, "{own:e}, {wide:e}");
    }
}

/// The scale of a channel that is zero throughout is a tenth of the natural size of its quantity. The engine's error
/// in this channel still comes from the engine's runs.
/// For the acceleration of a crank at constant speed, a fault of a millionth of the natural size is detected. For a
/// rocker that rotates with the crank through change points, a fault is detected only if it is at least a hundredth of
/// the natural size.
/// In the rocker's channels, agreement does not exclude a smaller fault.
#[test]
fn a_fault_of_fixed_size_is_found_where_the_reference_is_zero() {
    let cranks = include_str!("../../../../tests/suite/exact_zeros/parallel_cranks.toml");
    let zeros: [(&str, &str, &str, Fault, f64); 2] = [
        ("crank_rocker", &text("crank_rocker"), "crank", |state, size| state.motions[LinkId(1)].alpha += size, 1e-6),
        ("parallel_cranks", cranks, "rocker", |state, size| state.motions[LinkId(3)].alpha += size, 1e-2),
    ];
    for (name, text, link, fault, share) in zeros {
        let scenario = parsed(name, text);
        let own = format!("link.{link}.alpha_rad_s2");
        let truth = seen(&scenario.case, &AssurSolver).trajectory;
        let place = truth.channels().iter().position(|channel| channel.to_string() == own).unwrap();
        let natural = magnitudes(&truth)[place];
        for (size, word) in [(share * natural, "disagree"), (0.0, "agree")] {
            let proof = engine_proven(&scenario, Everywhere { fault, size, grows: false }, Search::Everything);
            let found = proof.channels.iter().find(|channel| channel.residual.channel.to_string() == own).unwrap();
            assert_eq!(found.verdict.word(), word, "{own} at {size:e}: {found:?}");
        }
    }
}

/// If all forces of the mechanism are only rounding errors, their scale is the inertia force that follows from the
/// mechanism's mass, size and speed.
/// In a balanced rotor, a fault of a millionth of a newton is detected.
#[test]
fn a_fault_of_fixed_size_is_found_without_any_scale() {
    let mut rotor = four_bar([1.0, 0.3, 1.0, 1.0], true);
    rotor.links.truncate(1);
    rotor.pins.truncate(1);
    rotor.dyads.clear();
    rotor.links[0].mass = Some((3.0, Vec2::zeros(), 0.1));
    (rotor.gravity, rotor.dt) = (Vec2::zeros(), None);
    let rotor = rotor.scenario().unwrap();
    let zeros: [(&str, Fault); 2] = [
        ("joint.O.fx_N", |state, size| state.forces[JointId(0)].x += size),
        ("drive.torque_N_m", |state, size| state.torques[0] += size),
    ];
    for (own, fault) in zeros {
        for (size, word) in [(1e-6, "disagree"), (0.0, "agree")] {
            let proof = engine_proven(&rotor, Everywhere { fault, size, grows: false }, Search::Everything);
            let found = proof.channels.iter().find(|channel| channel.residual.channel.to_string() == own).unwrap();
            assert_eq!(found.verdict.word(), word, "{own} at {size:e}: {found:?}");
            assert_eq!(proof.verdict.word(), word, "{own} at {size:e}");
        }
    }
}
