//! Judgement by part: one thing wrong at a time, by a size that no bound decides, and what must see it.
//! A bound that is a thousand times too wide, or a comparison that is left out, fails here.

use super::kinds::{At, Family, Kind, Plant};
use super::mutant::Party;
use super::planted::Fault;
use super::seen::Outcome;
use super::stage::Stage;
use linkage::case::Wanted;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, JointId, LinkId};
use linkage::solver::State;
use linkage::trajectory::Stage as Of;
use prover::compare::Verdict;
use prover::proof::Options;
use scenario::{Scenario, of_repository};

type Change = fn(At, &mut State, f64) -> Option<()>;

const fn wrong(name: &'static str, size: f64, change: Change) -> Kind {
    Kind { name, says: name, family: Family::Force, size: Some(size), plant: Plant::Answer(change) }
}

fn fault(kind: &'static Kind) -> Fault {
    Fault { kind, size: kind.size.expect("these faults have sizes") }
}

fn scenario(name: &str) -> Scenario {
    // Numbers from outside are judged elsewhere.
    Scenario { oracles: Vec::new(), ..of_repository(&format!("scenarios/{name}.toml")) }
}

fn at_row(at: At, row: usize, change: impl FnOnce()) -> Option<()> {
    if at.row == row {
        change();
    }
    Some(())
}

const SHAKING: &str = "shaking force and moment from reactions and from momentum (assur)";
const POWERS: &str = "balancing moment from equilibrium and from powers (assur)";
const BETWEEN: &str = "assur against newton";

/// Faults of side 1: scenario, fault, channels in which the sides part, families of checks that see it.
/// Lengths are tenths of a metre, speeds some rad/s, forces hundreds of newtons.
static IN_A_SIDE: [(&str, Kind, usize, &[&str]); 12] = [
    (
        "crank_rocker",
        wrong("a closed loop is open by 1e-12 m", 1e-12, |_, state, size| {
            state.motions[GROUND].origin.y += size;
            Some(())
        }),
        0,
        &["closure of all joints (assur)"],
    ),
    (
        "crank_rocker",
        wrong("an angle at the first instant", 1e-9, |at, state, size| {
            at_row(at, 0, || state.angles[LinkId(2)] += size)
        }),
        1,
        &[BETWEEN],
    ),
    (
        "crank_rocker",
        wrong("an angle at the last instant", 1e-9, |at, state, size| {
            at_row(at, at.case.grid.len() - 1, || state.angles[LinkId(2)] += size)
        }),
        1,
        &[BETWEEN],
    ),
    (
        "crank_rocker",
        wrong("an angle", 1e-10, |_, state, size| {
            state.angles[LinkId(2)] += size;
            Some(())
        }),
        1,
        &[BETWEEN],
    ),
    (
        "crank_rocker",
        wrong("an angular velocity", 1e-8, |_, state, size| {
            state.motions[LinkId(3)].omega += size;
            Some(())
        }),
        // Those of the link, of its mass centre and of its points hang on it, and the power that it takes.
        0,
        &[BETWEEN, POWERS],
    ),
    (
        "crank_rocker",
        wrong("an angular acceleration", 1e-6, |_, state, size| {
            state.motions[LinkId(3)].alpha += size;
            Some(())
        }),
        0,
        &[BETWEEN, POWERS, SHAKING],
    ),
    (
        "crank_rocker",
        wrong(
            "a reaction, by the same amount in two joints of the frame: a couple without a force",
            1e-4,
            |_, state, size| {
                state.forces[JointId(0)].x += size;
                state.forces[JointId(3)].x -= size;
                Some(())
            },
        ),
        0,
        &[BETWEEN, SHAKING],
    ),
    (
        "crank_rocker",
        wrong("a reaction at the origin: a force without a couple", 1e-6, |_, state, size| {
            state.forces[JointId(0)] += Vec2::new(size, size);
            Some(())
        }),
        0,
        &[BETWEEN, SHAKING],
    ),
    (
        "crank_rocker",
        wrong("the driving moment", 1e-6, |_, state, size| {
            state.torques[0] += size;
            Some(())
        }),
        // On the drive and on the frame.
        2,
        &[BETWEEN, POWERS, SHAKING],
    ),
    (
        "five_bar",
        wrong("the second drive's moment", 1e-6, |_, state, size| {
            state.torques[1] += size;
            Some(())
        }),
        2,
        &[BETWEEN, POWERS, SHAKING],
    ),
    (
        "five_bar",
        wrong("the second drive's moment at the last instant", 1e-6, |at, state, size| {
            at_row(at, at.case.grid.len() - 1, || state.torques[1] += size)
        }),
        2,
        &[BETWEEN, POWERS, SHAKING],
    ),
    (
        "rotary_engine",
        wrong("the moment in a guide", 1e-6, |at, state, size| {
            let guide = at.case.mechanism.joints().find(|joint| joint.slides())?;
            state.moments[guide] += size;
            Some(())
        }),
        1,
        &[BETWEEN],
    ),
];

#[test]
fn what_is_wrong_in_a_side_by_a_fixed_size_is_seen_by_every_check_that_must() {
    let options = Options::default();
    for name in ["crank_rocker", "five_bar", "rotary_engine"] {
        let scenario = scenario(name);
        let stage = Stage::new(&scenario, &options).unwrap();
        assert_eq!(stage.verdict, "agree", "{name}");
        for (_, kind, channels, must) in IN_A_SIDE.iter().filter(|own| own.0 == name) {
            let outcome = stage.proven(fault(kind), Party::Assur);
            let Outcome::Detected { first, channels: found, checks, .. } = outcome else {
                panic!("{name}: {} by {:?}: {outcome:?}", kind.name, kind.size)
            };
            let has = |family: &&&str| checks.iter().any(|own| own.starts_with(**family));
            let missing: Vec<_> = must.iter().filter(|family| !has(family)).collect();
            assert!(missing.is_empty(), "{name}: {}: {missing:?} did not see it, but {checks:?}", kind.name);
            if *channels > 0 {
                assert_eq!(found, *channels, "{name}: {}: {first:?}", kind.name);
            }
            let instant = match kind.name {
                own if own.ends_with("first instant") => Some(0),
                own if own.ends_with("last instant") => Some(scenario.case.grid.len() - 1),
                _ => None,
            };
            if let Some(row) = instant {
                assert_eq!(
                    first.since.map(|(time, _)| time),
                    Some(scenario.case.grid.times[row]),
                    "{name}: {}",
                    kind.name
                );
            }
        }
    }
}

/// Faults of what an engine answers: scenario, fault, channels that must disagree, families of checks that must.
static IN_THE_ENGINE: [(&str, Kind, &[&str], &[&str]); 8] = [
    (
        "crank_rocker",
        wrong("an angle at the first instant", 1e-4, |at, state, size| {
            at_row(at, 0, || state.angles[LinkId(2)] += size)
        }),
        &["link.coupler.angle_rad"],
        &[],
    ),
    (
        "crank_rocker",
        wrong("an angle at the last instant", 1e-4, |at, state, size| {
            at_row(at, at.case.grid.len() - 1, || state.angles[LinkId(2)] += size)
        }),
        &["link.coupler.angle_rad"],
        &[],
    ),
    (
        "crank_rocker",
        wrong("an angular velocity", 1e-2, |_, state, size| {
            state.motions[LinkId(3)].omega += size;
            Some(())
        }),
        &["link.rocker.omega_rad_s"],
        &["driving moment from reactions and from powers (rapier)"],
    ),
    (
        "crank_rocker",
        wrong("an angular acceleration", 1.0, |_, state, size| {
            state.motions[LinkId(3)].alpha += size;
            Some(())
        }),
        &["link.rocker.alpha_rad_s2"],
        // Forces follow from accelerations, right or wrong, and the powers with them.
        &[],
    ),
    (
        "crank_rocker",
        wrong("a reaction", 1.0, |_, state, size| {
            state.forces[JointId(2)].y += size;
            Some(())
        }),
        &["joint.B.fy_N"],
        &[],
    ),
    (
        "crank_rocker",
        wrong("the driving moment", 0.1, |_, state, size| {
            state.torques[0] += size;
            Some(())
        }),
        &["drive.torque_N_m", "frame.moment_N_m"],
        &["driving moment from reactions and from powers (rapier)"],
    ),
    (
        "five_bar",
        wrong("the second drive's moment", 0.1, |_, state, size| {
            state.torques[1] += size;
            Some(())
        }),
        &["torque_N_m", "frame.moment_N_m"],
        &["driving moment from reactions and from powers (rapier)"],
    ),
    (
        "five_bar",
        wrong("the second drive's moment at one instant", 0.5, |at, state, size| {
            at_row(at, at.case.grid.len() / 3, || state.torques[1] += size)
        }),
        &["torque_N_m", "frame.moment_N_m"],
        &[],
    ),
];

#[test]
fn what_is_wrong_in_an_engine_by_a_fixed_size_decides_its_verdict() {
    let options = Options::default();
    for name in ["crank_rocker", "five_bar"] {
        let scenario = scenario(name);
        let stage = Stage::new(&scenario, &options).unwrap();
        for (_, kind, must, checked) in IN_THE_ENGINE.iter().filter(|own| own.0 == name) {
            let proof = stage.engine_proof(fault(kind)).unwrap();
            let disagrees = |verdict: &Verdict| matches!(verdict, Verdict::Disagree { .. });
            let channels = proof.channels.iter().filter(|own| disagrees(&own.verdict));
            let channels: Vec<String> = channels.map(|own| own.residual.channel.to_string()).collect();
            let checks = proof.checks.iter().filter(|own| disagrees(&own.verdict));
            let checks: Vec<&str> = checks.map(|own| own.family.as_str()).collect();
            assert_eq!(proof.verdict.word(), "disagree", "{name}: {}: {channels:?} {:?}", kind.name, proof.checks);
            for own in *must {
                // Of a second drive only the end of the name is given, and the first one's is another.
                let has = channels
                    .iter()
                    .any(|found| found.ends_with(own) && (own.contains('.') || *found != "drive.torque_N_m"));
                assert!(has, "{name}: {}: {own} agrees; {channels:?}", kind.name);
            }
            for own in *checked {
                assert!(checks.contains(own), "{name}: {}: {own} agrees; {checks:?}", kind.name);
            }
        }
    }
}

/// Only the balance of powers has the speeds, where the moment alone is wanted.
#[test]
fn a_wrong_speed_that_no_channel_has_is_seen_by_the_balance_of_powers() {
    static SPEED: Kind = wrong("an angular velocity, by a hundredth of itself", 1e-2, |_, state, size| {
        state.motions[LinkId(3)].omega *= 1.0 + size;
        Some(())
    });
    let whole = scenario("crank_rocker");
    let case = whole.case.wanting(Wanted::of(&[Of::BalancingMoment]));
    let scenario = Scenario { case, ..whole };
    let options = Options::default();
    let stage = Stage::new(&scenario, &options).unwrap();
    let Outcome::Detected { channels, checks, .. } = stage.proven(fault(&SPEED), Party::Assur) else {
        panic!("it escapes from the sides")
    };
    // The centre's acceleration goes with the square of the speed, and momentum with it.
    assert_eq!((channels, checks), (0, vec![POWERS.to_string(), SHAKING.to_string()]));
    let proof = stage.engine_proof(fault(&SPEED)).unwrap();
    assert_eq!(proof.verdict.word(), "disagree", "{:?}", proof.checks);
    let powers = proof.checks.iter().find(|check| check.family.starts_with("driving moment")).unwrap();
    assert_eq!(powers.verdict.word(), "disagree");
}

/// Velocities do not show where a link is, and its loop is open all the same: the check alone decides the verdict.
#[test]
fn an_open_loop_that_no_channel_shows_decides_the_engine_s_verdict() {
    static OPEN: Kind = wrong("a loop is open by a tenth of a millimetre", 1e-4, |_, state, size| {
        state.motions[LinkId(3)].origin.x += size;
        Some(())
    });
    let whole = scenario("crank_rocker");
    let case = whole.case.wanting(Wanted::of(&[Of::Velocities]));
    let scenario = Scenario { case, ..whole };
    let options = Options::default();
    let proof = Stage::new(&scenario, &options).unwrap().engine_proof(fault(&OPEN)).unwrap();
    assert!(proof.channels.iter().all(|own| own.verdict.word() == "agree"), "{:?}", proof.channels);
    assert_eq!(proof.checks.iter().map(|own| own.verdict.word()).collect::<Vec<_>>(), ["disagree"]);
    assert_eq!(proof.verdict.word(), "disagree");
}
