//! The diagnosis states which party disagrees with all remaining parties, since when, and in which channels first.

use linkage::trajectory::{Channel, Trajectory};
use prover::diagnosis::{DiagnosedParty, PartyStanding, SuspectChannel, since, standing};

fn trajectory(rows: &[(&str, Vec<f64>)]) -> Trajectory {
    let times: Vec<f64> = (0..rows[0].1.len()).map(|row| row as f64).collect();
    let channels = rows.iter().map(|(name, _)| Channel::named(name).unwrap()).collect();
    Trajectory::new(times.clone(), times, channels, rows.iter().map(|(_, values)| values.clone()).collect()).unwrap()
}

const FORCE: &str = "joint.A.fx_N";

/// The standing of parties, computed from one channel at one instant; each party is given by its name, its value and
/// its bound.
fn of(parties: &[(&str, f64, f64)]) -> PartyStanding {
    let all: Vec<Trajectory> = parties.iter().map(|(_, value, _)| trajectory(&[(FORCE, vec![*value])])).collect();
    let party = |((name, _, bound), trajectory): (&(&'static str, f64, f64), &'static Trajectory)| DiagnosedParty {
        name,
        trajectory,
        bounds: vec![(Channel::named(FORCE).unwrap(), *bound)],
    };
    let all: &'static [Trajectory] = all.leak();
    let parties: &'static [(&'static str, f64, f64)] = parties
        .iter()
        .map(|(name, value, bound)| (&*name.to_string().leak(), *value, *bound))
        .collect::<Vec<_>>()
        .leak();
    standing(&parties.iter().zip(all).map(party).collect::<Vec<_>>())
}

#[test]
fn the_party_contradicted_by_all_others_is_the_odd_one_out() {
    let alone = |name: &str| PartyStanding::Alone(name.into());
    assert_eq!(of(&[("side 1", 1.0, 1e-9), ("side 2", 1.0, 1e-9), ("engine", 2.0, 0.1)]), alone("engine"));
    assert_eq!(of(&[("side 1", 1.5, 1e-9), ("side 2", 1.0, 1e-9), ("engine", 1.0, 0.1)]), alone("side 1"));
    assert_eq!(of(&[("side 1", 1.0, 1e-9), ("side 2", 1.0, 1e-9), ("engine", 1.05, 0.1)]), PartyStanding::Together);
}

#[test]
fn two_camps_are_found_and_ambiguity_stays_open() {
    let camps = of(&[("a", 1.0, 0.1), ("b", 1.0, 0.1), ("c", 2.0, 0.1), ("d", 2.0, 0.1)]);
    let names = |names: [&str; 2]| names.map(String::from).to_vec();
    assert_eq!(camps, PartyStanding::Camps([names(["a", "b"]), names(["c", "d"])]));
    // The engine's bound is too wide to decide which of the two analytic sides is wrong.
    let open = of(&[("side 1", 1.0, 1e-9), ("side 2", 1.01, 1e-9), ("engine", 1.0, 0.1)]);
    assert_eq!(open, PartyStanding::Open(vec![names(["side 1", "side 2"]).try_into().unwrap()]));
    assert!(matches!(of(&[("a", 1.0, 0.1), ("b", 2.0, 0.1), ("c", 3.0, 0.1)]), PartyStanding::Open(_)));
    assert!(matches!(of(&[("a", 1.0, 0.1), ("b", 2.0, 0.1)]), PartyStanding::Open(_)));
}

#[test]
fn channels_are_ordered_by_when_they_left_their_bounds() {
    let right = trajectory(&[
        (FORCE, vec![0.0; 5]),
        ("joint.B.fx_N", vec![0.0; 5]),
        ("point.A.x_m", vec![0.0; 5]),
        ("point.A.y_m", vec![0.0; 5]),
    ]);
    let wrong = trajectory(&[
        (FORCE, vec![0.0, 0.0, 3.0, 0.0, 3.0]),
        ("joint.B.fx_N", vec![0.0, 0.0, -30.0, 0.0, 0.0]),
        ("point.A.x_m", vec![0.0, 0.0, 2.0, 2.0, 2.0]),
        ("point.A.y_m", vec![0.0, 2.0, 0.0, 0.0, 0.5]),
    ]);
    let judge = |channel: &Channel| SuspectChannel { channel: channel.clone(), bound: 1.0, disagrees: true };
    let judged: Vec<SuspectChannel> = right.channels().iter().map(judge).collect();
    let found = since(&right, &wrong, &judged);
    let told: Vec<(String, f64, usize)> =
        found.iter().map(|one| (one.channel.to_string(), one.time, one.beyond)).collect();
    let expected = [("point.A.y_m", 1.0, 1), ("point.A.x_m", 2.0, 3), ("joint.B.fx_N", 2.0, 1), (FORCE, 2.0, 2)];
    assert_eq!(told, expected.map(|(name, time, beyond)| (name.to_string(), time, beyond)));
    assert_eq!(found[2].difference, -30.0);
}
