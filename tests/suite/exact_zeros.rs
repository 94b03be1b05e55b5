//! Channels that are zero throughout: by a constant speed, by guides that forbid a turn, by equal lengths. Their own range
//! is rounding and says nothing; they are measured by a tenth of the size of their quantity, and where that vanishes
//! too, of what the mechanism is built for.

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
    // Zero by its lengths, not by what the mechanism is made of: the sides find rounding.
    assert!(alpha.bound < 1e-3 * alpha.residual.scale, "{alpha:?}");
}

/// A crank at constant speed, and a grid that ends beside a dead point: there is room for small steps only, with much
/// rounding in second differences. The largest of them has least.
#[test]
fn regress_a_crank_at_constant_speed_keeps_no_verdict_open() {
    let mut slow = scenario("zero_alpha.toml");
    slow.case = slow.case.wanting(Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]));
    let proof = proven(&slow);
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
}

#[test]
fn what_only_translates_is_measured_by_what_turns() {
    let proof = proven(&scenario("crane.toml"));
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    for suffix in [".omega_rad_s", ".alpha_rad_s2"] {
        let tenth = 0.1 * natural(&proof, suffix);
        for link in ["trolley", "hook"] {
            let own = of(&proof, &format!("link.{link}{suffix}"));
            // What follows from the crank's own motion may be larger than any value.
            assert!(own.residual.scale >= tenth * (1.0 - 1e-9), "{link}{suffix}: {own:?}");
        }
    }
    // What is small, but not zero, is still measured by a thousandth: an offset of the guide turns nothing to zero.
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

/// Symptom: ten of the numbers of a balanced rotor without gravity were open, "of scale: inf". Cause: all its forces
/// and moments are zero, and nothing in its motion said how large they could be. Its mass and its speed do.
#[test]
fn regress_a_balanced_rotor_agrees_though_it_has_no_force_at_all() {
    let mut spec = alone(Vec2::zeros());
    spec.gravity = Vec2::zeros();
    let proof = proven(&spec.scenario().unwrap());
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    // The nominal 10 rad/s, the arm of 0.3 m, 3 kg.
    let force = 3.0 * 100.0 * 0.3;
    for (channel, natural) in [("joint.O.fx_N", force), ("frame.fy_N", force), ("drive.torque_N_m", 0.3 * force)] {
        let own = of(&proof, channel);
        assert!((own.residual.scale / (0.1 * natural) - 1.0).abs() < 1e-9 && own.bound < 1e-6 * natural, "{own:?}");
    }
}

/// Symptom: 31 of the 54 numbers of pendulums that hang still were open. Cause: what does not move at all gave its
/// motion no scale but rounding. The nominal speed, which the file states, does.
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

/// Symptom: 94 of 122 numbers of a crane disagreed: a jib that is free on a spring, a trolley that a winch pulls along
/// it, and a load that is let go from rest at its tip. Cause: the load started with the speed of the jib. What the
/// trolley's guide has as moment is small beside all others, and keeps nothing open.
#[test]
fn regress_a_crane_with_a_trolley_on_its_jib_agrees() {
    let proof = proven(&scenario("jib_crane.toml"));
    assert_eq!(proof.verdict.word(), "agree", "{:?}", proof.verdict);
    let own = of(&proof, "joint.track.moment_N_m");
    assert!(own.bound < 1e-3 * own.residual.scale, "{own:?}");
}
