//! Planted faults: the reference solves the true case, the engine a slightly wrong case.
//! Every fault must be found in the channels that it affects, and only in these channels.
//! Without a fault, reference and engine must agree.

use std::path::Path;

use linkage::trajectory::Stage;
use prover::engines::EngineName;
use prover::run::{Options, Proof, prove_against};
use scenario::Scenario;

use crate::common::by_night;

const TEXT: &str = include_str!("../../scenarios/crank_rocker.toml");

fn scenario(text: &str) -> Scenario {
    Scenario::parse(text, Path::new("crank_rocker.toml")).unwrap_or_else(|error| panic!("{error}"))
}

/// The scenario's text with one number, or one word, replaced.
fn edited(from: &str, to: &str) -> String {
    assert_eq!(TEXT.matches(from).count(), 1, "`{from}` must stand in the scenario once");
    TEXT.replace(from, to)
}

fn against(wrong: &str) -> Proof {
    let proof = prove_against(&scenario(TEXT), &scenario(wrong).case, &Options::default());
    proof.unwrap_or_else(|error| panic!("{error}"))
}

/// Channels that disagree.
fn found(proof: &Proof) -> Vec<(String, Stage)> {
    let wrong = proof.engine().channels.iter().filter(|channel| channel.verdict.word() == "disagree");
    wrong.map(|channel| (channel.residual.channel.to_string(), channel.residual.channel.kind.stage)).collect()
}

/// Asserts that a fault is found only in channels that `may` allows, and in all channels that `must` names.
fn is_found(wrong: &str, may: impl Fn(&str, Stage) -> bool, must: &[&str]) {
    let proof = against(wrong);
    assert_eq!(proof.verdict.word(), "disagree");
    let found = found(&proof);
    for (name, stage) in &found {
        assert!(may(name, *stage), "this fault must not affect {name}");
    }
    for name in must {
        assert!(
            found.iter().any(|(own, _)| own == name),
            "this fault must be found in {name}, but is found only in {found:?}"
        );
    }
}

fn forces_only(_: &str, stage: Stage) -> bool {
    stage >= Stage::Reactions
}

fn anything(_: &str, _: Stage) -> bool {
    true
}

#[test]
fn without_a_fault_the_sides_agree() {
    let proof = against(TEXT);
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
}

#[test]
fn a_mass_wrong_by_one_percent() {
    is_found(
        &edited("mass_kg = 34.7", "mass_kg = 35.047"),
        forces_only,
        &["joint.A.fy_N", "joint.B.fy_N", "joint.O.fy_N"],
    );
}

/// The crank is light and rotates uniformly.
/// The crank's mass therefore affects only the crank's bearing, the frame and, by its weight, the drive.
/// One percent of the mass changes the bearing's reaction by 0.26 N, while the engine's error in this reaction is 1 N.
/// The shaking force is much smoother than the bearing reaction, so the shaking force shows the fault.
#[test]
fn a_crank_mass_wrong_by_one_percent() {
    let own =
        |name: &str, _: Stage| name.starts_with("joint.O.") || name.starts_with("frame.") || name == "drive.torque_N_m";
    is_found(&edited("mass_kg = 2.6", "mass_kg = 2.626"), own, &["frame.fy_N"]);
}

#[test]
fn an_inertia_wrong_by_two_percent() {
    is_found(&edited("inertia_kg_m2 = 0.8356", "inertia_kg_m2 = 0.8523"), forces_only, &["drive.torque_N_m"]);
    is_found(&edited("inertia_kg_m2 = 0.74", "inertia_kg_m2 = 0.7548"), forces_only, &["drive.torque_N_m"]);
}

#[test]
fn a_mass_centre_wrong_by_a_millimetre() {
    let wrong = edited(
        "mass_centre = { x_m = 0.173535965945905, y_m = 0 }",
        "mass_centre = { x_m = 0.174535965945905, y_m = 0 }",
    );
    let own = |name: &str, stage: Stage| stage >= Stage::Reactions || name.starts_with("link.coupler.");
    is_found(&wrong, own, &["link.coupler.x_m", "link.coupler.ay_m_s2", "joint.A.fy_N", "drive.torque_N_m"]);
}

#[test]
fn a_length_wrong_by_a_tenth_of_a_millimetre() {
    let wrong = edited("B = { x_m = 0.34707193189181, y_m = 0 }", "B = { x_m = 0.34717193189181, y_m = 0 }");
    let not_crank = |name: &str, _: Stage| !name.starts_with("link.crank.") && !name.starts_with("point.A.");
    is_found(&wrong, not_crank, &["link.rocker.angle_rad", "link.rocker.alpha_rad_s2", "point.B.x_m"]);
}

#[test]
fn missing_gravity_and_missing_load() {
    let gravity = edited("y_m_s2 = -9.81", "y_m_s2 = 0");
    is_found(&gravity, forces_only, &["joint.O.fy_N", "joint.A.fy_N", "joint.C.fy_N", "drive.torque_N_m"]);
    let load = edited("moment_N_m = 100", "moment_N_m = 0");
    is_found(&load, forces_only, &["joint.B.fy_N", "drive.torque_N_m"]);
}

#[test]
fn a_speed_wrong_by_a_thousandth() {
    let wrong = edited("speed_rpm = 130", "speed_rpm = 130.13");
    is_found(
        &wrong,
        anything,
        &["link.crank.angle_rad", "link.crank.omega_rad_s", "point.A.x_m", "link.rocker.alpha_rad_s2"],
    );
}

#[test]
fn the_other_assembly_mode() {
    let not_crank = |name: &str, _: Stage| !name.starts_with("link.crank.") && !name.starts_with("point.A.");
    is_found(&edited("mode = \"left\"", "mode = \"right\""), not_crank, &["link.rocker.angle_rad", "point.B.y_m"]);
}

#[test]
fn a_joint_with_its_links_swapped() {
    let wrong =
        edited("links = [\"coupler\", \"rocker\"]\n\n[[joints]]", "links = [\"rocker\", \"coupler\"]\n\n[[joints]]");
    is_found(&wrong, |name, _| name.starts_with("joint.B."), &["joint.B.fx_N", "joint.B.fy_N"]);
}

/// The size of the faults that a proof finds at the settings of an ordinary run.
/// With more draws, each fault is halved until the proof no longer finds the fault.
#[test]
fn small_faults_are_found() {
    type Fault = (&'static str, f64, fn(f64) -> String, f64);
    let faults: [Fault; 8] = [
        ("coupler mass, share", 1e-2, |x| edited("mass_kg = 34.7", &format!("mass_kg = {}", 34.7 * (1.0 + x))), 1e-3),
        ("rocker mass, share", 1e-2, |x| edited("mass_kg = 33.3", &format!("mass_kg = {}", 33.3 * (1.0 + x))), 1e-3),
        (
            "coupler inertia, share",
            2e-2,
            |x| edited("inertia_kg_m2 = 0.8356", &format!("inertia_kg_m2 = {}", 0.8356 * (1.0 + x))),
            1e-2,
        ),
        (
            "coupler mass centre, m",
            1e-3,
            |x| {
                edited(
                    "mass_centre = { x_m = 0.173535965945905",
                    &format!("mass_centre = {{ x_m = {}", 0.173535965945905 + x),
                )
            },
            1e-4,
        ),
        (
            "coupler length, m",
            1e-4,
            |x| edited("B = { x_m = 0.34707193189181", &format!("B = {{ x_m = {}", 0.34707193189181 + x)),
            1e-5,
        ),
        ("gravity, share", 1e-2, |x| edited("y_m_s2 = -9.81", &format!("y_m_s2 = {}", -9.81 * (1.0 + x))), 1e-2),
        ("load, share", 1e-2, |x| edited("moment_N_m = 100", &format!("moment_N_m = {}", 100.0 * (1.0 + x))), 1e-3),
        ("speed, share", 1e-3, |x| edited("speed_rpm = 130", &format!("speed_rpm = {}", 130.0 * (1.0 + x))), 1e-6),
    ];
    for (what, first, wrong, enough) in faults {
        let halvings = if by_night() { 0 } else { (first / enough).log2().ceil() as i32 };
        let (mut size, mut smallest, mut by) = (first / 2f64.powi(halvings), f64::NAN, String::new());
        while size > 1e-12 {
            let found = found(&against(&wrong(size)));
            if found.is_empty() {
                break;
            }
            (smallest, by) = (size, found.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(" "));
            if !by_night() {
                break;
            }
            size /= 2.0;
        }
        println!("{what}: {smallest:.1e} by {by}");
        assert!(smallest <= enough, "{what}: the smallest fault found is {smallest:e}");
    }
}

/// Two builds of the engine get the same fault, so they agree with each other.
/// The reference then disagrees with both builds.
#[test]
fn engines_that_agree_against_the_reference_make_it_the_odd_one_out() {
    let options = Options::default().engine(EngineName::Rapier).engine(EngineName::Impulse);
    let wrong = scenario(&edited("mass_kg = 34.7", "mass_kg = 34.8"));
    let proof = prove_against(&scenario(TEXT), &wrong.case, &options).unwrap();
    assert_eq!(proof.verdict.word(), "disagree");
    let odd: Vec<&str> = proof.disputes.iter().filter_map(|dispute| dispute.odd).collect();
    assert!(odd.len() > 3 && odd.iter().all(|name| *name == "assur"), "{:?}", proof.disputes);

    let right = prove_against(&scenario(TEXT), &scenario(TEXT).case, &options).unwrap();
    assert!(right.disputes.is_empty(), "{:?}", right.disputes);
}
