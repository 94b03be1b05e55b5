//! Mechanisms in which all values of a quantity vanish.
//! A proof must not divide by the rounding errors of the vanishing values.
//! The vanishing values alone must not make a proof inconclusive.

use crate::common::spec::{Spec, four_bar};
use crate::common::{from_outside, shipped};
use linkage::math::Vec2;
use prover::run::{Options, Proof, Reference, prove};
use scenario::Scenario;
use std::path::Path;

fn proof_of(what: &str, scenario: &Scenario, options: &Options) -> Proof {
    prove(scenario, options).unwrap_or_else(|error| panic!("{what}: {error}"))
}

fn agrees_by(what: &str, scenario: &Scenario, options: &Options) {
    let proof = proof_of(what, scenario, options);
    assert_eq!(proof.verdict.word(), "agree", "{what}: {:?}", proof.verdict);
}

fn agrees(what: &str, spec: &Spec) {
    agrees_by(what, &spec.scenario().unwrap(), &Options::default());
}

/// A parallelogram between its change points.
/// Crank and rocker rotate at the same constant speed, and the coupler only translates.
/// All angular accelerations therefore vanish.
/// Without gravity, the balancing moment vanishes too.
fn parallelogram() -> Spec {
    let mut spec = four_bar([0.4, 0.1, 0.4, 0.1], true);
    spec.start = 0.5;
    spec.grid = (0.5, 0.1, 20);
    spec
}

fn crank_alone() -> Spec {
    let mut spec = parallelogram();
    spec.links.truncate(1);
    spec.pins.truncate(1);
    spec.ground.truncate(1);
    spec.dyads.clear();
    spec
}

/// Symptom: the analytic sides disagreed by 150 % on a parallelogram. For a crank without other links, the moments of
/// the sides disagreed by 110 %.
/// Cause: differences were divided by the range of the channel, but the range of a vanishing channel is only rounding
/// error.
#[test]
fn regress_channels_that_vanish_by_symmetry_agree() {
    for (name, spec) in [("parallelogram", parallelogram()), ("crank", crank_alone())] {
        agrees(name, &spec);
        let floating = Spec { gravity: Vec2::zeros(), ..spec.clone() };
        agrees(&format!("{name} without gravity"), &floating);
        let mut massless = spec;
        massless.links.iter_mut().for_each(|link| link.mass = None);
        agrees(&format!("{name} without masses"), &massless);
    }
}

/// A shipped scenario from which three parts are removed: the formulas, the published numbers, and all lines for which
/// `is_left_out` returns true.
fn bare(path: &str, is_left_out: impl Fn(&str) -> bool) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let text = std::fs::read_to_string(&path).unwrap();
    let text = text.split("[[formula]]").next().unwrap().split("[[oracle]]").next().unwrap();
    let kept: Vec<&str> = text.lines().filter(|line| !is_left_out(line)).collect();
    Scenario::parse(&kept.join("\n"), &path).unwrap_or_else(|error| panic!("{error}"))
}

/// Symptom: in an unloaded Oldham coupling, the driving moment is zero but disagreed by 83 % with the moment from the
/// powers.
/// Cause: the driving hub has only one point, so no force had a lever arm about the hub.
/// There was therefore no moment that could serve as the scale of the rounding error.
#[test]
fn regress_a_single_point_driving_link_uses_slider_moments() {
    let mut scenario = bare("scenarios/formulas/oldham_coupling.toml", |_| false);
    scenario.case = scenario.case.with(|parts| parts.loads.clear()).unwrap();
    agrees_by("an Oldham coupling without load", &scenario, &Options::default());
}

/// Symptom: the proof of a loaded four-bar without masses was inconclusive.
/// Cause: without masses the shaking force vanishes, so its scale was zero and the ratio of bound to scale was
/// infinite.
#[test]
fn regress_a_zero_shaking_force_takes_its_scale_from_joints() {
    let masses = ["mass_kg", "mass_centre", "inertia_kg_m2"];
    let scenario = bare("scenarios/crank_rocker.toml", |line| masses.iter().any(|mass| line.starts_with(mass)));
    agrees_by("a four-bar without masses", &scenario, &Options::default());
}

/// Symptom: the analytic sides disagree in nearly constant coordinates, and in every mechanism far from the origin.
/// Cause: the rounding error of a coordinate is proportional to the coordinate, not to the coordinate's range.
#[test]
fn regress_a_mechanism_far_from_the_origin_agrees() {
    let spec = four_bar([0.4, 0.1, 0.35, 0.3], true);
    for far in [Vec2::new(10.0, -20.0), Vec2::new(1e3, 1e3)] {
        agrees(&format!("at {}, {}", far.x, far.y), &spec.moved(far, 0.7));
    }
}

/// Symptom: a pendulum whose only point is its hinge ended in one of three errors at t = 0.
/// The three errors were "closure NaN", "step size became too small" and "jumped to another branch".
/// Cause: the mechanism's size came only from distances between points, which are 0 here.
#[test]
fn regress_a_link_of_a_single_point_has_a_size() {
    let text = shipped("pendulum.toml").text;
    let free = without(text.trim_end_matches(from_outside(&text)), "E = {");
    for reference in Reference::ALL {
        agrees_by(reference.name(), &parsed(&free), &Options::default().reference(reference));
    }
    // Two further cases of the pendulum: the link turned at constant speed, and the link driven from rest by a motor.
    // The motor is tried with two positions of the link's mass centre: in the pivot, as in a flywheel, and 1 mm beside
    // the pivot.
    let driven = without(&without(&free, "motion ="), "zero_deg");
    agrees_by("driven", &parsed(&driven), &Options::default());
    let motor = "motion = \"free\"\ninitial_speed_rad_s = 0\n";
    let wheel =
        without(&free, "motion =").replace("zero_deg = -90\n", motor).replace("speed_rad_s = -5", "speed_rad_s = 5");
    let wheel = format!("{wheel}[motor]\nlaw = \"constant\"\ntorque_N_m = 0.4\nratio = 1\n");
    for centre in ["0", "1e-3"] {
        let wheel = wheel.replace("mass_centre = { x_m = 0.5,", &format!("mass_centre = {{ x_m = {centre},"));
        let proof = proof_of("wheel", &parsed(&wheel), &Options::default());
        assert_ne!(proof.verdict.word(), "disagree", "{centre}: {:?}", proof.verdict);
        assert!(proof.checks.iter().all(|check| check.verdict.word() == "agree"), "{centre}: {:?}", proof.checks);
    }
}

/// The text without its lines that begin with `begin`.
fn without(text: &str, begin: &str) -> String {
    let kept: Vec<&str> = text.lines().filter(|line| !line.starts_with(begin)).collect();
    assert!(kept.len() < text.lines().count(), "{begin}");
    kept.join("\n") + "\n"
}

fn parsed(text: &str) -> Scenario {
    Scenario::parse(text, Path::new("degenerate.toml")).unwrap_or_else(|error| panic!("{error}"))
}
