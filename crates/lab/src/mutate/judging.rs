//! Tests of the judgement, part by part.
//! One quantity at a time is wrong, by an amount that does not depend on bounds.
//! Each test names the checks that must find the fault.
//! A test fails if a bound is a thousand times too wide, or if a comparison is missing.

use super::kinds::kinds;
use super::mutant::FaultyParty;
use super::seen::FaultyProof;
use super::stage::Fault;
use super::stage::Stage;
use fixtures::of_repository;
use linkage::case::Wanted;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, JointId, LinkId};
use linkage::trajectory::Stage as Of;
use prover::bounds::Verdict;
use prover::run::Options;
use scenario::Scenario;

kinds! { Judgement, Answer:
    "a closed loop is open (m)" (1e-12): "", |_, state, size| state.motions[GROUND].origin.y += size;
    "an angle" (1e-10): "", |_, state, size| state.angles[LinkId(2)] += size;
    "an angle at the first instant" (1e-9): "", |at, state, size| if at.row == 0 {
        state.angles[LinkId(2)] += size;
    };
    "an angle at the last instant" (1e-9): "", |at, state, size| if at.row + 1 == at.case.grid.len() {
        state.angles[LinkId(2)] += size;
    };
    "an angular velocity" (1e-8): "", |_, state, size| state.motions[LinkId(3)].omega += size;
    "an angular velocity, by a share" (1e-2): "", |_, state, size| state.motions[LinkId(3)].omega *= 1.0 + size;
    "an angular acceleration" (1e-6): "", |_, state, size| state.motions[LinkId(3)].alpha += size;
    "a place (m)" (1e-4): "", |_, state, size| state.motions[LinkId(3)].origin.x += size;
    "a reaction" (1.0): "", |_, state, size| state.forces[JointId(2)].y += size;
    "a reaction, by the same amount in two joints of the frame: a couple without a force" (1e-4): "",
        |_, state, size| {
            state.forces[JointId(0)].x += size;
            state.forces[JointId(3)].x -= size;
        };
    "a reaction at the origin: a force without a couple" (1e-6): "",
        |_, state, size| state.forces[JointId(0)] += Vec2::new(size, size);
    "the driving moment" (1e-6): "", |_, state, size| state.torques[0] += size;
    "the second drive's moment" (1e-6): "", |_, state, size| state.torques[1] += size;
    "the second drive's moment at one instant" (0.5): "", |at, state, size| if at.row == at.case.grid.len() / 3 {
        state.torques[1] += size;
    };
    "the second drive's moment at the last instant" (1e-6): "",
        |at, state, size| if at.row + 1 == at.case.grid.len() {
            state.torques[1] += size;
        };
    "the moment in a guide" (1e-6): "", |at, state, size| {
        let guide = at.case.mechanism.joints().find(|joint| joint.slides())?;
        state.moments[guide] += size;
        Some(())
    };
}

/// A fault of the default size of its kind.
fn fault(name: &str) -> Fault {
    let kind = KINDS.iter().find(|kind| kind.name == name).unwrap_or_else(|| panic!("{name}"));
    Fault { kind, size: kind.size.expect("these faults have sizes") }
}

fn scenario(name: &str) -> Scenario {
    // The scenario's external reference numbers are removed, because other tests cover them.
    Scenario { oracles: Vec::new(), ..of_repository(&format!("scenarios/{name}.toml")) }
}

const SHAKING: &str = "shaking force and moment from reactions and from momentum (assur)";
const POWERS: &str = "balancing moment from equilibrium and from powers (assur)";
const BETWEEN: &str = "assur against newton";

/// Faults of analytic side 1.
/// The fields are scenario, fault, number of channels in which the sides differ, and families of checks that find the
/// fault. The number 0 means that the channels are not counted.
/// Channels are not counted if further channels depend on the wrong quantity: the channels of the link, its mass centre
/// and its points, and the power.
/// Orders of magnitude: lengths are tenths of a metre, speeds some rad/s, forces hundreds of newtons.
static IN_A_SIDE: [(&str, &str, usize, &[&str]); 12] = [
    ("crank_rocker", "a closed loop is open (m)", 0, &["closure of all joints (assur)"]),
    ("crank_rocker", "an angle at the first instant", 1, &[BETWEEN]),
    ("crank_rocker", "an angle at the last instant", 1, &[BETWEEN]),
    ("crank_rocker", "an angle", 1, &[BETWEEN]),
    ("crank_rocker", "an angular velocity", 0, &[BETWEEN, POWERS]),
    ("crank_rocker", "an angular acceleration", 0, &[BETWEEN, POWERS, SHAKING]),
    (
        "crank_rocker",
        "a reaction, by the same amount in two joints of the frame: a couple without a force",
        0,
        &[BETWEEN, SHAKING],
    ),
    ("crank_rocker", "a reaction at the origin: a force without a couple", 0, &[BETWEEN, SHAKING]),
    // Two channels differ: one of the drive and one of the frame.
    ("crank_rocker", "the driving moment", 2, &[BETWEEN, POWERS, SHAKING]),
    ("five_bar", "the second drive's moment", 2, &[BETWEEN, POWERS, SHAKING]),
    ("five_bar", "the second drive's moment at the last instant", 2, &[BETWEEN, POWERS, SHAKING]),
    ("rotary_engine", "the moment in a guide", 1, &[BETWEEN]),
];

#[test]
fn a_fixed_error_in_a_side_is_found_by_all_expected_checks() {
    let options = Options::default();
    for name in ["crank_rocker", "five_bar", "rotary_engine"] {
        let scenario = scenario(name);
        let stage = Stage::new(&scenario, &options).unwrap();
        assert_eq!(stage.verdict, "agree", "{name}");
        for (_, wrong, channels, must) in IN_A_SIDE.iter().filter(|own| own.0 == name) {
            let outcome = stage.proven(fault(wrong), FaultyParty::Assur);
            let FaultyProof::Detected { first, channels: found, checks, .. } = outcome else {
                panic!("{name}: {wrong}: {outcome:?}")
            };
            let has = |family: &&&str| checks.iter().any(|own| own.starts_with(**family));
            let missing: Vec<_> = must.iter().filter(|family| !has(family)).collect();
            assert!(missing.is_empty(), "{name}: {wrong}: {missing:?} did not see it, but {checks:?}");
            if *channels > 0 {
                assert_eq!(found, *channels, "{name}: {wrong}: {first:?}");
            }
            let times = &scenario.case.grid.times;
            let instants = [("first instant", times.first()), ("last instant", times.last())];
            for (_, time) in instants.iter().filter(|(end, _)| wrong.ends_with(end)) {
                assert_eq!(first.since.map(|(time, _)| time).as_ref(), *time, "{name}: {wrong}");
            }
        }
    }
}

/// A fault in an engine's answer.
/// The fields are scenario, fault, size, channels that must disagree, and families of checks that must disagree.
type InTheEngine = (&'static str, &'static str, f64, &'static [&'static str], &'static [&'static str]);

static IN_THE_ENGINE: [InTheEngine; 8] = [
    ("crank_rocker", "an angle at the first instant", 1e-4, &["link.coupler.angle_rad"], &[]),
    ("crank_rocker", "an angle at the last instant", 1e-4, &["link.coupler.angle_rad"], &[]),
    ("crank_rocker", "an angular velocity", 1e-2, &["link.rocker.omega_rad_s"], &[OF_POWERS]),
    // Forces and powers are computed from the same wrong accelerations, so they may agree with one another.
    // The test therefore names no check.
    ("crank_rocker", "an angular acceleration", 1.0, &["link.rocker.alpha_rad_s2"], &[]),
    ("crank_rocker", "a reaction", 1.0, &["joint.B.fy_N"], &[]),
    ("crank_rocker", "the driving moment", 0.1, &["drive.torque_N_m", "frame.moment_N_m"], &[OF_POWERS]),
    ("five_bar", "the second drive's moment", 0.1, &["torque_N_m", "frame.moment_N_m"], &[OF_POWERS]),
    ("five_bar", "the second drive's moment at one instant", 0.5, &["torque_N_m", "frame.moment_N_m"], &[]),
];
const OF_POWERS: &str = "driving moment from reactions and from powers (rapier)";

#[test]
fn a_fixed_error_in_an_engine_decides_its_verdict() {
    let options = Options::default();
    for name in ["crank_rocker", "five_bar"] {
        let scenario = scenario(name);
        let stage = Stage::new(&scenario, &options).unwrap();
        for (_, wrong, size, must, checked) in IN_THE_ENGINE.iter().filter(|own| own.0 == name) {
            let proof = stage.engine_proof(Fault { size: *size, ..fault(wrong) }).unwrap();
            let disagrees = |verdict: &Verdict| matches!(verdict, Verdict::Disagree { .. });
            let channels = proof.channels.iter().filter(|own| disagrees(&own.verdict));
            let channels: Vec<String> = channels.map(|own| own.residual.channel.to_string()).collect();
            let checks = proof.checks.iter().filter(|own| disagrees(&own.verdict));
            let checks: Vec<&str> = checks.map(|own| own.family.as_str()).collect();
            assert_eq!(proof.verdict.word(), "disagree", "{name}: {wrong}: {channels:?} {:?}", proof.checks);
            for own in *must {
                // For a second drive, only the end of the channel name is given.
                // The first drive's channel `drive.torque_N_m` has the same end, so it is excluded.
                let has = channels
                    .iter()
                    .any(|found| found.ends_with(own) && (own.contains('.') || *found != "drive.torque_N_m"));
                assert!(has, "{name}: {wrong}: {own} agrees; {channels:?}");
            }
            for own in *checked {
                assert!(checks.contains(own), "{name}: {wrong}: {own} agrees; {checks:?}");
            }
        }
    }
}

/// If only the moment is requested, speeds are not compared. Only the balances of power and of momentum use the speeds.
#[test]
fn the_balance_of_powers_finds_a_wrong_unrequested_speed() {
    let wrong = fault("an angular velocity, by a share");
    let whole = scenario("crank_rocker");
    let case = whole.case.wanting(Wanted::of(&[Of::BalancingMoment]));
    let scenario = Scenario { case, ..whole };
    let options = Options::default();
    let stage = Stage::new(&scenario, &options).unwrap();
    let FaultyProof::Detected { channels, checks, .. } = stage.proven(wrong, FaultyParty::Assur) else {
        panic!("it escapes from the sides")
    };
    // The momentum balance also disagrees, because the mass centre's acceleration depends on the square of the speed.
    assert_eq!((channels, checks), (0, vec![POWERS.to_string(), SHAKING.to_string()]));
    let proof = stage.engine_proof(wrong).unwrap();
    assert_eq!(proof.verdict.word(), "disagree", "{:?}", proof.checks);
    let powers = proof.checks.iter().find(|check| check.family.starts_with("driving moment")).unwrap();
    assert_eq!(powers.verdict.word(), "disagree");
}

/// A wrong position opens a joint of the loop, while all velocities stay correct.
/// The closure check alone decides the verdict.
#[test]
fn an_open_loop_decides_the_verdict_without_any_channel() {
    let whole = scenario("crank_rocker");
    let case = whole.case.wanting(Wanted::of(&[Of::Velocities]));
    let scenario = Scenario { case, ..whole };
    let options = Options::default();
    let proof = Stage::new(&scenario, &options).unwrap().engine_proof(fault("a place (m)")).unwrap();
    assert!(proof.channels.iter().all(|own| own.verdict.word() == "agree"), "{:?}", proof.channels);
    assert_eq!(proof.checks.iter().map(|own| own.verdict.word()).collect::<Vec<_>>(), ["disagree"]);
    assert_eq!(proof.verdict.word(), "disagree");
}
