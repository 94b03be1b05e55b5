//! Numerical stability.
//! The solution in double-double is compared with closed forms, and both analytic sides with this solution.
//! Further tests cover faults that `stress` has found.

mod precise;

use lab::stress::{FAMILIES, PointEnd, named, run};
use linkage::case::Wanted;
use linkage::math::KeepNan;
use linkage::mechanism::AssemblyMode;
use linkage::trajectory::{Stage, Unit};
use linkage::work::Count;
use linkproof::Case;
use prover::bounds::Verdict;
use prover::run::beside::sides;

use crate::common::assert_within;

#[test]
fn family_names_are_unique_and_quick_points_valid() {
    for (index, family) in FAMILIES.iter().enumerate() {
        assert!(FAMILIES[index + 1..].iter().all(|other| other.name != family.name), "{}", family.name);
        assert!(family.points.windows(2).all(|pair| pair[0] < pair[1]), "{}", family.name);
        assert!(
            !family.quick.is_empty() && family.quick.iter().all(|dial| family.points.contains(dial)),
            "{}",
            family.name
        );
    }
}

/// After 1e4 revolutions, rounding the crank angle to a double costs five digits before either analytic side starts.
/// Both sides once agreed without a warning, although their error was 3.6 times the bound.
#[test]
fn the_rounding_of_a_large_crank_angle_is_in_the_bound() {
    let turns = named("turns").unwrap();
    let case = (turns.setup)(1e4, 0, 0).unwrap().case;
    let case = case.wanting(Wanted::of(&[Stage::Positions, Stage::Velocities]));
    let truth = ::precise::solve(&case).unwrap();
    let found = sides(&case, Some(&truth)).unwrap();
    assert!(matches!(found.verdict, Verdict::Agree { .. }), "{:?}", found.verdict);
    assert_eq!(found.silent, 0);
    for side in &found.sides {
        let worst = side.deviations.iter().map(|own| own.used).fold(0.0, f64::larger);
        println!("{}: {worst:.2e} of its bound", side.name);
        assert_within!(worst, 1.0, "{}", side.name);
        // The bound must also stay narrow enough to be useful.
        // Angles are not tested here, because their bound is proportional to the angle including its revolutions.
        for own in side.deviations.iter().filter(|own| own.channel.kind.unit != Unit::Radian) {
            assert_within!(own.bound, 1e-9, "{} {}", side.name, own.channel);
        }
    }
}

/// Symptom: at a gear ratio of 1000, angular accelerations of the analytic sides differed by 5e-9 of their magnitude.
/// The bound was 1e-11.
/// Cause: in a fast wheel, terms of the size omega^2 cancel, and the bound did not contain the rounding error of these
/// terms.
#[test]
fn the_sides_agree_on_gears_friction_cylinders_and_cams() {
    for name in ["gear_ratio", "friction", "ram", "cam"] {
        let family = named(name).unwrap();
        for &dial in family.points {
            let case = (family.setup)(dial, 0, 0).unwrap_or_else(|error| panic!("{name} {dial}: {error}")).case;
            let found = sides(&case, None).unwrap();
            assert!(matches!(found.verdict, Verdict::Agree { .. }), "{name} {dial}: {:?}", found.verdict);
        }
    }
}

/// Symptom: near a change point both analytic sides agreed with the solution in double-double, but not with each other.
/// Cause: the condition number enters the bound between the sides, but it was measured only at poses with an unusually
/// large difference.
#[test]
fn regress_the_condition_of_a_pose_is_in_the_bound_between_the_sides() {
    for gap in [1e-12, 3e-11, 1e-10, 1e-6] {
        let case = (named("change_point").unwrap().setup)(gap, 0, 0).unwrap().case;
        let truth = ::precise::solve(&case).unwrap();
        let found = sides(&case, Some(&truth)).unwrap();
        assert!(matches!(found.verdict, Verdict::Agree { .. }), "{gap}: {:?}", found.verdict);
        assert_eq!(found.silent, 0, "{gap}");
    }
}

/// Both sides solve a chain of 150 four-bars, and agree with the solution in double-double.
/// The case comes from no fault report.
#[test]
fn a_long_chain_keeps_its_digits() {
    let case = (named("chain").unwrap().setup)(150.0, 0, 0).unwrap().case;
    let truth = ::precise::solve(&case).unwrap();
    let found = sides(&case, Some(&truth)).unwrap();
    assert!(matches!(found.verdict, Verdict::Agree { .. }), "{:?}", found.verdict);
    assert_eq!(found.silent, 0);
    for own in found.sides.iter().flat_map(|side| &side.deviations) {
        assert_within!(own.used, 1.0, "{}", own.channel);
    }
}

/// The work of side 1 for a chain is the sum of the work for its four-bars; the test counts operations and uses no
/// clock.
/// Side 2 iterates on blocks, and in a long chain needs at most a fifth more iterations per four-bar.
#[test]
fn work_per_four_bar_does_not_grow_with_the_chain() {
    let work = |count: f64| {
        let case = (named("chain").unwrap().setup)(count, 0, 0).unwrap().case;
        sides(&case.wanting(Wanted::of(&[Stage::Positions])), None).unwrap().sides.map(|side| side.work)
    };
    let (short, long) = (work(20.0), work(200.0));
    for what in [Count::Poses, Count::Iterations] {
        assert!(long[0].of(what) <= short[0].of(what), "side 1, {}", what.name());
    }
    assert!(short[0].of(Count::Groups) > 0 && long[0].of(Count::Groups) <= 10 * short[0].of(Count::Groups));
    let [few, many] = [short, long].map(|work| work[1].of(Count::Iterations));
    println!("side 2: {few} and {many} iterations");
    assert!(few > 0 && many <= 12 * few, "side 2: {few} and {many}");
}

/// If solvers refuse a case, the result of the case contains the reason.
/// At a smallest transmission angle of 0.01 deg, both analytic sides still agree and are accurate.
#[test]
fn refused_points_are_results_with_a_reason() {
    let redundant = run(named("redundant").unwrap(), 2.0, 0, 1);
    assert!(redundant.refused.contains("mobility"), "{redundant:?}");
    let near = run(named("transmission_angle").unwrap(), 0.01, 0, 1);
    for party in &near.parties {
        assert_eq!(party.silent, 0, "{party:?}");
        assert!(party.verdict == PointEnd::Agree || !party.why.is_empty(), "{party:?}");
        if ["assur", "newton"].contains(&party.name.as_str()) {
            assert_eq!((party.verdict, party.reached.len()), (PointEnd::Agree, 3), "{party:?}");
            assert_within!(party.reached[0].error, 1e-9, "{party:?}");
        }
    }
    assert!(near.parties.iter().any(|party| party.verdict == PointEnd::Fails));
}

/// In the reference, one length is wrong by a millionth.
/// Both analytic sides contradict this reference, while they agree with each other.
/// A wrong number that both sides share would show in the same way.
#[test]
fn a_wrong_number_that_both_sides_share_is_counted() {
    let four_bar = |coupler: f64| {
        Case::builder()
            .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.0])])
            .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
            .link("coupler", &[("A", [0.0, 0.0]), ("B", [coupler, 0.0])])
            .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.25, 0.0])])
            .mass("coupler", 2.0, [0.175, 0.0], 0.02)
            .pin("O", "ground", "crank")
            .pin("A", "crank", "coupler")
            .pin("B", "coupler", "rocker")
            .pin("C", "ground", "rocker")
            .crank("O", 10.0)
            .mode(&["coupler", "rocker"], AssemblyMode::Left)
            .instants(12)
            .build()
            .unwrap()
    };
    let truth = ::precise::solve(&four_bar(0.35 * (1.0 + 1e-6))).unwrap();
    let found = sides(&four_bar(0.35), Some(&truth)).unwrap();
    assert!(matches!(found.verdict, Verdict::Agree { .. }));
    assert!(found.silent > 20, "{}", found.silent);
}
