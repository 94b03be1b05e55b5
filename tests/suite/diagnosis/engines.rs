//! Faults planted in the engine's case: the complete proof names every fault.

use super::{Tally, edited, parsed, text};
use prover::diagnosis::PartyStanding;
use prover::run::{Options, prove_against};

use crate::common::by_night;

/// Scenario, passage in its text, its replacement, and the words that must name the fault.
type Fault = (&'static str, &'static str, &'static str, &'static str);

/// The faults of `faults.rs`, except those of `small_faults_are_found`.
const CRANK_ROCKER: &[Fault] = &[
    ("crank_rocker", "mass_kg = 34.7", "mass_kg = 35.047", "mass of coupler: 35"),
    ("crank_rocker", "mass_kg = 2.6", "mass_kg = 2.626", "mass of crank: 2.6"),
    ("crank_rocker", "inertia_kg_m2 = 0.8356", "inertia_kg_m2 = 0.8523", "moment of inertia of coupler: 0.85"),
    ("crank_rocker", "inertia_kg_m2 = 0.74", "inertia_kg_m2 = 0.7548", "moment of inertia of rocker: 0.75"),
    (
        "crank_rocker",
        "mass_centre = { x_m = 0.173535965945905",
        "mass_centre = { x_m = 0.174535965945905",
        "mass centre of coupler, x: 0.1745",
    ),
    (
        "crank_rocker",
        "B = { x_m = 0.34707193189181",
        "B = { x_m = 0.34717193189181",
        "position of B on coupler, x: 0.3471",
    ),
    ("crank_rocker", "y_m_s2 = -9.81", "y_m_s2 = 0", "gravity: missing"),
    ("crank_rocker", "moment_N_m = 100", "moment_N_m = 0", "load 1, resistance: missing"),
    ("crank_rocker", "speed_rpm = 130", "speed_rpm = 130.13", "speed of the drive at O: 13.62"),
    ("crank_rocker", "mode = \"left\"", "mode = \"right\"", "another configuration of coupler, rocker: right"),
    (
        "crank_rocker",
        "links = [\"coupler\", \"rocker\"]\n\n[[joints]]",
        "links = [\"rocker\", \"coupler\"]\n\n[[joints]]",
        "the opposite sign of joint.B.fx_N, joint.B.fy_N",
    ),
    ("crank_rocker", "mass_kg = 34.7", "mass_kg = 34.8", "mass of coupler: 34.8 kg"),
];

/// Faults of every kind, in prescribed and in free motions.
const OTHERS: &[Fault] = &[
    ("crank_rocker", "y_m_s2 = -9.81", "y_m_s2 = 9.81", "gravity: of the opposite sign"),
    ("crank_rocker", "x_m_s2 = 0\ny_m_s2 = -9.81", "x_m_s2 = -9.81\ny_m_s2 = 0", "gravity: x and y exchanged"),
    ("crank_rocker", "moment_N_m = 100", "moment_N_m = 200", "load 1, resistance: counted twice"),
    (
        "crank_rocker",
        "moment_N_m = 100",
        "moment_N_m = 4.735883",
        "load 1, resistance: 0.0473588 times as large, divided by",
    ),
    ("crank_rocker", "inertia_kg_m2 = 0.74", "inertia_kg_m2 = 0", "moment of inertia of rocker: missing"),
    (
        "crank_rocker",
        "inertia_kg_m2 = 0.8356",
        "inertia_kg_m2 = 1.8805833",
        "moment of inertia of coupler: taken about joint",
    ),
    ("crank_rocker", "mass_kg = 34.7", "mass_kg = 0.0347", "mass of coupler: 0.001 times"),
    (
        "crank_rocker",
        "mass_centre = { x_m = 0.173535965945905",
        "mass_centre = { x_m = 0",
        "mass centre of coupler: at joint A",
    ),
    (
        "crank_rocker",
        "crank_deg = 0\n[[start.groups]]",
        "crank_deg = 2\n[[start.groups]]",
        "angle of the drive at O at t = 0: 2 deg|all channels",
    ),
    ("crank_rocker", "speed_rpm = 130", "speed_rpm = 65", "speed of the drive at O: counted half"),
    ("loaded_slider", "stiffness_N_m = 1800", "stiffness_N_m = 0", "load 2, spring: missing"),
    ("loaded_slider", "damping_N_s_m = 150", "damping_N_s_m = 300", "load 3, damper: counted twice"),
    ("loaded_slider", "mode = \"ahead\"", "mode = \"behind\"", "another configuration of rod, ram: behind"),
    ("quick_return", "mass_kg = 6.0", "mass_kg = 6.5", "mass of ram: 6.5"),
    (
        "quick_return",
        "O1 = { x_mm = 0, y_mm = 300 }",
        "O1 = { x_mm = 0, y_mm = 301 }",
        "position of O1 on ground, y: 0.301 m",
    ),
    ("class3_group", "mass_kg = 1.8", "mass_kg = 2.1", "mass of base: 2.1 kg"),
    ("pendulum", "y_m_s2 = -9.80665", "y_m_s2 = 9.80665", "gravity: of the opposite sign"),
    (
        "pendulum",
        "inertia_kg_m2 = 0.16666666666666666",
        "inertia_kg_m2 = 0.6666666666666666",
        "moment of inertia of rod: taken about joint O",
    ),
    ("pendulum", "crank_deg = 150", "crank_deg = -150", "angle of the drive at O at t = 0: of the opposite sign"),
    ("pendulum", "mass_centre = { x_m = 0.5", "mass_centre = { x_m = 0.51", "mass centre of rod, x: 0.51"),
    ("crank_rocker_runup", "moment_N_m = 100", "moment_N_m = 0", "load 1, resistance: missing"),
    ("crank_rocker_runup", "y_m_s2 = -9.81", "y_m_s2 = 0", "gravity: missing"),
    (
        "crank_rocker_runup",
        "rotor_inertia_kg_m2 = 9e-4\noutput_inertia_kg_m2 = 1.6",
        "",
        "inertia of rotor and reducer: missing",
    ),
    ("five_bar_on_a_spring", "stiffness_N_m_rad = 4", "stiffness_N_m_rad = 0", "load 1, torsion spring: missing"),
];

/// The fault in `BY_NIGHT` costs more than all remaining faults, so it is tested only at night.
/// An ordinary run tests the same kind of fault in a prescribed motion; `cases.rs` tests it in `five_bar_on_a_spring`.
const BY_NIGHT: &[Fault] =
    &[("five_bar_on_a_spring", "mode = \"left\"", "mode = \"right\"", "another configuration of rod_1, rod_2: right")];

fn tally(faults: &[Fault], what: &str) -> Tally {
    let mut tally = Tally::default();
    for (name, from, to, expected) in faults {
        let right = text(name);
        let wrong = parsed(name, &edited(&right, from, to)).case;
        let what = format!("{name}, {} -> {}", from.replace('\n', " "), to.replace('\n', " "));
        match prove_against(&parsed(name, &right), &wrong, &Options::default()) {
            Ok(proof) => {
                tally.add(&what, proof.diagnosis.as_ref(), expected);
                let alone = proof.diagnosis.map(|found| found.alone);
                assert_eq!(alone, Some(PartyStanding::Alone("rapier".into())), "{what}");
            }
            Err(error) => {
                println!("no proof: {what}: {error}");
                tally.wrong.push(format!("{what}: {error}"));
            }
        }
    }
    tally.told(what);
    tally
}

#[test]
fn faults_in_the_engine_s_case_are_named() {
    let tally = tally(CRANK_ROCKER, "engine, crank_rocker");
    assert!(tally.wrong.is_empty(), "\n{}", tally.wrong.join("\n"));
}

#[test]
fn faults_of_every_kind_in_the_engine_s_case_are_named() {
    let faults = [OTHERS, if by_night() { BY_NIGHT } else { &[] }].concat();
    let tally = tally(&faults, "engine, others");
    assert!(tally.wrong.is_empty(), "\n{}", tally.wrong.join("\n"));
}
