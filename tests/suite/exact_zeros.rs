//! Channels that are zero throughout: by a constant speed, by guides that prevent rotation, or by equal lengths.
//! The range of such a channel is only rounding, so its scale is a tenth of the natural size of the quantity.
//! If the natural size vanishes too, the scale comes from the nominal speed, the masses and the gravity of the file.

use std::path::Path;

use linkage::case::Wanted;
use linkage::math::{KeepNan, Vec2, largest_size};
use linkage::trajectory::Stage;
use prover::run::{ChannelProof, Options, Proof, prove};
use scenario::Scenario;

use crate::common::shipped;
use crate::common::spec::{Spec, four_bar};

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/exact_zeros").join(name);
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn proven(scenario: &Scenario) -> Proof {
    prove(scenario, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn of<'a>(proof: &'a Proof, name: &str) -> &'a ChannelProof {
    let found = proof.engine().channels.iter().find(|own| own.residual.channel.to_string() == name);
    found.unwrap_or_else(|| panic!("{name}"))
}

/// The largest value of a quantity in any of its channels.
fn natural(proof: &Proof, suffix: &str) -> f64 {
    let own = proof.reference_trajectory.iter().filter(|(channel, _)| channel.to_string().ends_with(suffix));
    own.map(|(_, values)| largest_size(values)).fold(0.0, f64::larger)
}

#[test]
fn regress_equal_cranks_agree_though_the_rocker_has_no_acceleration() {
    let proof = proven(&scenario("parallel_cranks.toml"));
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    let alpha = of(&proof, "link.rocker.alpha_rad_s2");
    // The acceleration is zero because of the lengths, not because of the structure, so the analytic sides compute
    // rounding errors instead of exact zeros.
    assert!(alpha.bound < 1e-3 * alpha.residual.scale, "{alpha:?}");
}

/// A crank at constant speed, on a grid that ends beside a dead point.
/// Only small steps are possible beside the dead point, so the second differences contain much rounding error.
/// Of the possible small steps, the largest has the least rounding error.
#[test]
fn regress_a_constant_speed_crank_leaves_no_verdict_open() {
    let mut slow = scenario("zero_alpha.toml");
    slow.case = slow.case.wanting(Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]));
    let proof = proven(&slow);
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
}

#[test]
fn translating_links_take_the_scale_of_rotating_ones() {
    let proof = proven(&scenario("crane.toml"));
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    for suffix in [".omega_rad_s", ".alpha_rad_s2"] {
        let tenth = 0.1 * natural(&proof, suffix);
        for link in ["trolley", "hook"] {
            let own = of(&proof, &format!("link.{link}{suffix}"));
            // A scale that follows from the crank's motion may be larger than all values of the quantity.
            assert!(own.residual.scale >= tenth * (1.0 - 1e-9), "{link}{suffix}: {own:?}");
        }
    }
    // A channel that is small, but not zero throughout, keeps its small scale.
    // This scale is at least a thousandth of the natural size.
    let crank = proven(&shipped("crank_rocker.toml"));
    let small = crank.engine().channels.iter().filter(|own| own.residual.scale < 0.05 * natural(&crank, ".ax_m_s2"));
    assert!(small.count() > 0);
}

/// A crank alone on its pin, with its mass centre at `centre`.
fn alone(centre: Vec2) -> Spec {
    let mut spec = four_bar([1.0, 0.3, 1.0, 1.0], true);
    spec.links.truncate(1);
    spec.pins.truncate(1);
    spec.dyads.clear();
    spec.ground.truncate(1);
    spec.links[0].mass = Some((3.0, centre, 0.1));
    spec.dt = None;
    spec
}

/// Symptom: for a balanced rotor without gravity, ten numbers were inconclusive, "of scale: inf".
/// Cause: all forces and moments of the rotor are zero, and the motion gave no scale for them.
/// The mass and the speed of the rotor give the scale.
#[test]
fn regress_a_balanced_rotor_agrees_without_any_force() {
    let mut spec = alone(Vec2::zeros());
    spec.gravity = Vec2::zeros();
    let proof = proven(&spec.scenario().unwrap());
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    // Inertial force of 3 kg at the nominal 10 rad/s on the arm of 0.3 m.
    let force = 3.0 * 100.0 * 0.3;
    for (channel, natural) in [("joint.O.fx_N", force), ("frame.fy_N", force), ("drive.torque_N_m", 0.3 * force)] {
        let own = of(&proof, channel);
        assert!((own.residual.scale / (0.1 * natural) - 1.0).abs() < 1e-9 && own.bound < 1e-6 * natural, "{own:?}");
    }
}

/// Symptom: 31 of the 54 numbers of pendulums hanging at rest were inconclusive.
/// Cause: without any motion, the scale was only rounding.
/// The nominal speed in the file gives the scale.
#[test]
fn regress_a_mechanism_in_equilibrium_agrees_though_nothing_moves() {
    let mut spec = alone(Vec2::new(0.15, 0.0));
    spec.start = -90f64.to_radians();
    spec.other.drive = "motion = \"free\"\nspeed_rad_s = 2\ninitial_speed_rad_s = 0\n".into();
    spec.other.times = Some((1.0, 100));
    let proof = proven(&spec.scenario().unwrap());
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    for (channel, scale) in [
        ("link.crank.angle_rad", 1e-3),
        ("link.crank.omega_rad_s", 0.1 * 2.0),
        ("link.crank.alpha_rad_s2", 0.1 * 4.0),
        ("point.A.x_m", 1e-3 * 0.3),
        ("point.A.vx_m_s", 0.1 * 2.0 * 0.3),
        ("point.A.ax_m_s2", 0.1 * 4.0 * 0.3),
    ] {
        let own = of(&proof, channel);
        assert!((own.residual.scale / scale - 1.0).abs() < 1e-9, "{own:?}");
    }
}

/// Symptom: 94 of 122 numbers of a crane disagreed.
/// The crane's jib moves freely on a torsion spring. A winch pulls a trolley along the jib. A load is released at the
/// jib's tip.
/// Cause: the load, released from rest, started with the speed of the jib.
/// The moment in the trolley's guide is small beside all other moments of the crane. The verdict on this moment is
/// nevertheless conclusive.
#[test]
fn regress_a_crane_with_a_trolley_on_its_jib_agrees() {
    let proof = proven(&scenario("jib_crane.toml"));
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    let own = of(&proof, "joint.track.moment_N_m");
    assert!(own.bound < 1e-3 * own.residual.scale, "{own:?}");
}
