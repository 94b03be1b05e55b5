//! Channels that are zero throughout: by a constant speed, by guides that forbid a turn, by equal lengths. Their own range
//! is rounding and says nothing; they are measured by a tenth of the size of their quantity.

use std::path::Path;

use linkage::case::Wanted;
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::Stage;
use linkproof::proof::{ChannelProof, Options, Proof, prove};
use linkproof::scenario::Scenario;

use crate::common::shipped;

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
