//! The crank angles over which mechanisms can be followed, and their singular poses.
//! The angles and poses are compared with closed forms, with the solvers, and with the number of configurations.

use linkage::math::KeepNan;
use std::f64::consts::{PI, TAU};

use crate::common::random;
use crate::common::shipped;
use crate::common::spec::{Dyad, Pin, Spec, four_bar};
use crate::common::{assert_within, four_link};
use analytic::range::{Extent, FourBar, FourBarType, Range, Singularity, SingularityKind, explained};
use analytic::{AssurSolver, NewtonSolver, PoseSolver, all, modes};
use linkage::ErrorKind;
use linkage::case::{Case, Grid, When};
use linkage::error::Advice;
use linkage::math::angle::wrapped;
use linkage::mechanism::assembly::configurations;
use linkage::mechanism::{GroupId, LinkPose, Pose};
use linkage::solver::Solver;
use linkage::trajectory::Stage;

/// Promised accuracy of limits and extreme positions (rad).
const EXACT: f64 = 1e-9;

fn range(spec: &Spec) -> Range {
    Range::of(&spec.scenario().unwrap().case).unwrap()
}

fn limits(range: &Range) -> Option<[Singularity; 2]> {
    match range.extent {
        Extent::Limited(limits) => Some(limits),
        Extent::FullTurn(_) => None,
    }
}

/// Crank angle in the upper half plane at which the distance from A to C is `reach`, by the law of cosines.
/// `None` if no crank angle gives this distance.
/// The formula uses half angles, (reach - |d - a|)(reach + |d - a|) / 4 a d = sin^2(phi / 2), to keep all digits near
/// 0.
fn crank_at(d: f64, a: f64, reach: f64) -> Option<f64> {
    let square = (reach - (d - a).abs()) * (reach + (d - a).abs()) / (4.0 * a * d);
    (0.0..=1.0).contains(&square).then(|| 2.0 * square.sqrt().asin())
}

/// The interval of crank angles around `start` in which |b - c| <= |AC| <= b + c.
/// If the interval contains neither 0 nor 180 deg, it lies in the half plane of `start`.
/// An interval that contains 0 or 180 deg is symmetrical about this angle.
fn closed_form([d, a, b, c]: [f64; 4], start: f64) -> Option<[f64; 2]> {
    let (stretched, folded) = (crank_at(d, a, b + c), crank_at(d, a, (b - c).abs()));
    match (folded, stretched) {
        (None, None) => None,
        (None, Some(to)) => Some([-to, to]),
        (Some(from), None) => Some([from, TAU - from]),
        (Some(from), Some(to)) if start >= 0.0 => Some([from, to]),
        (Some(from), Some(to)) => Some([-to, -from]),
    }
}

/// A crank angle in [0, 180] deg at which the four-bar can be assembled and is far from any dead point.
/// `None` if no angle qualifies.
fn start_of(lengths: [f64; 4]) -> Option<f64> {
    let [d, a, b, c] = lengths;
    let cosine = |phi: f64| (b * b + c * c - a * a - d * d + 2.0 * a * d * phi.cos()) / (2.0 * b * c);
    let best =
        (0..=180).map(|k| f64::from(k).to_radians()).min_by(|x, y| cosine(*x).abs().total_cmp(&cosine(*y).abs()))?;
    (cosine(best).abs() < 0.9).then_some(best)
}

fn started(lengths: [f64; 4], left: bool) -> Option<Spec> {
    let start = start_of(lengths)?;
    Some(Spec { start, grid: (start, 0.1, 1), ..four_bar(lengths, left) })
}

#[test]
fn limits_of_random_four_bars_are_those_of_the_law_of_cosines() {
    let mut random = four_link::RandomSource::from_seed(11);
    let (mut limited, mut full, mut worst) = (0, 0, 0.0f64);
    for _ in 0..400 {
        let lengths = [0; 4].map(|_| random.number(0.1, 1.0));
        let Some(spec) = started(lengths, random.number(0.0, 1.0) < 0.5) else { continue };
        let found = range(&spec);
        match (limits(&found), closed_form(lengths, spec.start)) {
            (None, None) => full += 1,
            (Some(found), Some(expected)) => {
                limited += 1;
                for (limit, expected) in found.iter().zip(expected) {
                    assert_eq!((limit.kind, limit.group), (SingularityKind::DeadPoint, GroupId(0)), "{lengths:?}");
                    worst = worst.larger((limit.crank - expected).abs());
                }
            }
            (found, expected) => panic!("{lengths:?}: {found:?} for {expected:?}"),
        }
    }
    assert!(limited > 150 && full > 30, "{limited} {full}");
    assert_within!(worst, EXACT, "{worst:e}");
}

/// The joints that rotate fully are found by following the linkage, and compared with the Grashof type.
/// Each pair of neighbouring links serves in turn as frame and driving link.
#[test]
fn grashof_types_agree_with_traced_rotations() {
    let mut random = four_link::RandomSource::from_seed(12);
    let mut counts = [0; 5];
    for _ in 0..300 {
        let lengths = [0; 4].map(|_| random.number(0.1, 1.0));
        let turning = (0..4).map(|first| {
            // Order around the linkage: frame, driving link, coupler, output link.
            let rolled = [0, 1, 2, 3].map(|k| lengths[(first + k) % 4]);
            started(rolled, true).map(|spec| range(&spec).extent == Extent::FullTurn(1))
        });
        let Some(turning) = turning.collect::<Option<Vec<bool>>>() else { continue };
        // Joints in order: frame-driver, driver-coupler, coupler-output, output-frame.
        let expected = match turning[..] {
            [true, false, false, true] => FourBarType::DoubleCrank,
            [true, true, false, false] => FourBarType::CrankRocker,
            [false, true, true, false] => FourBarType::DoubleRocker,
            [false, false, true, true] => FourBarType::RockerCrank,
            [false, false, false, false] => FourBarType::TripleRocker,
            _ => panic!("{lengths:?}: {turning:?}"),
        };
        let found = range(&started(lengths, true).unwrap()).four_bar.unwrap();
        assert_eq!(
            (found.lengths.map(|l| (l * 1e12).round()), found.of_type),
            (lengths.map(|l| (l * 1e12).round()), expected)
        );
        let turns_by_name = matches!(found.of_type, FourBarType::CrankRocker | FourBarType::DoubleCrank);
        assert_eq!(turns_by_name, turning[0]);
        counts[found.of_type as usize] += 1;
    }
    assert!(counts.iter().all(|&count| count >= 10), "{counts:?}");
}

#[test]
fn double_crank_and_crank_rocker_turn_as_named() {
    let turns = |lengths: [f64; 4]| {
        let range = range(&started(lengths, true).unwrap());
        range.links.iter().map(|link| link.turns).collect::<Vec<_>>()
    };
    assert_eq!(turns([0.1, 0.35, 0.4, 0.3]), [1, 1, 1]);
    assert_eq!(turns([0.4, 0.1, 0.35, 0.3]), [1, 0, 0]);
}

/// The synthesis (scenarios/crank_rocker.toml) prescribes two angles of the rocker: 50 deg with crank and coupler
/// stretched, and 82 deg with crank and coupler folded.
/// In the stretched pose, the crank points from O to B; in the folded pose, it points away from B.
#[test]
fn val_crank_rocker_extreme_positions() {
    let range = Range::of(&shipped("crank_rocker.toml").case).unwrap();
    assert_eq!(range.extent, Extent::FullTurn(1));
    assert_eq!(range.four_bar.unwrap().of_type, FourBarType::CrankRocker);
    assert!(range.singularities.is_empty());
    let rocker = &range.links[2];
    let line = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        (0.015 + 0.25 * sin).atan2(0.15 + 0.25 * cos)
    };
    let [first, second] = rocker.extremes[..] else { panic!("{:?}", rocker.extremes) };
    for (found, angle, crank, greatest) in [(first, 50.0, line(50.0), false), (second, 82.0, line(82.0) + PI, true)] {
        assert_within!((found.angle - f64::to_radians(angle)).abs(), EXACT, "{}", found.angle.to_degrees());
        assert_within!((found.crank - crank).abs(), EXACT, "{}", found.crank.to_degrees());
        assert_eq!(found.is_greatest, greatest);
    }
    assert_eq!([rocker.angles[0].value, rocker.angles[1].value], [first.angle, second.angle]);
    // Smallest transmission angle of a crank-rocker: where A is on the line of the pivots (Alt 1932).
    let base = 0.015f64.atan2(0.15);
    assert_within!((range.groups[GroupId(0)].determinant.crank - base).abs(), 1e-8, "{:?}", range.groups[GroupId(0)]);
    let mu = range.groups[GroupId(0)].determinant.value.asin();
    assert_within!((range.groups[GroupId(0)].condition.unwrap().value - 1.0 / (mu / 2.0).tan()).abs(), 1e-9);
}

/// Every limit and extreme position of random chains of dyads, checked with the closed forms of the solver.
/// The solver succeeds on the inner side of a limit and fails on the outer side.
/// On the two sides of an extreme position the link rotates in opposite directions.
#[test]
fn limits_and_extremes_of_chains_match_the_solver() {
    let (limited, extremes) = (std::cell::Cell::new(0), std::cell::Cell::new(0));
    random::for_each_of(&random::SORTS[..1], 3, 40, |sample| {
        let case = &sample.scenario.case;
        let range = Range::of(case).unwrap();
        let omegas = |crank: f64| -> linkage::Result<Vec<f64>> {
            let mut poses = PoseSolver::new(case)?;
            let state = poses.solve(crank, 1.0, 0.0, Stage::Velocities)?;
            Ok(state.motions.iter().map(|motion| motion.omega).collect())
        };
        if let Some([from, to]) = limits(&range) {
            limited.set(limited.get() + 1);
            for (limit, outwards) in [(from, -EXACT), (to, EXACT)] {
                assert!(omegas(limit.crank - outwards).is_ok(), "{limit:?} {}", sample.spec.toml());
                assert!(omegas(limit.crank + outwards).is_err(), "{limit:?} {}", sample.spec.toml());
            }
        }
        for link in &range.links {
            for extreme in &link.extremes {
                let [before, after] = [-EXACT, EXACT].map(|d| omegas(extreme.crank + d).unwrap()[link.link]);
                let expected = if extreme.is_greatest { [1.0, -1.0] } else { [-1.0, 1.0] };
                assert_eq!([before.signum(), after.signum()], expected, "{extreme:?} {}", sample.spec.toml());
                extremes.set(extremes.get() + 1);
            }
        }
        Ok(())
    });
    assert!(limited.get() >= 10 && extremes.get() >= 20, "{} {}", limited.get(), extremes.get());
}

/// If `side` is 0.1 m, the links form a parallelogram in the left mode and an antiparallelogram in the right mode.
fn parallelogram(side: f64, left: bool) -> Spec {
    Spec { start: 0.5, grid: (0.5, 0.1, 5), ..four_bar([0.4, 0.1, 0.4, side], left) }
}

#[test]
fn a_parallelogram_has_change_points_at_0_and_180_degrees() {
    for left in [true, false] {
        let range = range(&parallelogram(0.1, left));
        let [from, to] = limits(&range).unwrap();
        assert_eq!([from.kind, to.kind], [SingularityKind::ChangePoint; 2]);
        assert_within!(from.crank.abs(), EXACT, "{:e} {:e}", from.crank, to.crank - PI);
        assert_within!((to.crank - PI).abs(), EXACT, "{:e} {:e}", from.crank, to.crank - PI);
        assert_eq!(range.four_bar.unwrap().of_type, FourBarType::ChangePoint);
        let [coupler, rocker] = [1, 2].map(|k| range.links[k].angles[1].value - range.links[k].angles[0].value);
        // The rocker rotates between its two poses in line with the frame.
        // In the parallelogram the coupler stays parallel to the frame; in the antiparallelogram it swings.
        assert_within!((rocker - PI).abs(), EXACT, "{rocker}");
        assert_eq!(coupler <= EXACT, left, "{coupler}");
        assert_eq!(range.links[1].extremes.len(), usize::from(!left));
    }
}

/// A rocker slightly too long or too short separates the branches that cross in a parallelogram.
/// With the longer rocker, the crank can pass a pose where the branches nearly touch.
/// With the shorter rocker, the crank reaches a limit.
#[test]
fn near_a_parallelogram_branches_touch_or_end() {
    for off in [1e-4, 1e-6, 1e-8] {
        let touching = range(&parallelogram(0.1 + off, true));
        assert_eq!(touching.extent, Extent::FullTurn(1), "{off:e}");
        let contacts: Vec<f64> = touching
            .singularities
            .iter()
            .filter(|s| s.kind == SingularityKind::BranchContact)
            .map(|s| wrapped(s.crank))
            .collect();
        // Sine of the transmission angle at a pose where two branches nearly touch.
        // A is on the line of the pivots, so the law of cosines for the triangle A B C gives the angle.
        let sine = |reach: f64| {
            let (b, c) = (0.4, 0.1 + off);
            let sixteen = (b + c + reach) * (b + c - reach) * (reach + b - c) * (reach - b + c);
            sixteen.larger(0.0).sqrt() / (2.0 * b * c)
        };
        let expected: Vec<f64> = [0.3, 0.5].map(sine).into_iter().filter(|sine| *sine < 1e-3).collect();
        assert_eq!(contacts.len(), expected.len(), "{off:e}: {:?} for {expected:?}", touching.singularities);
        let ended = limits(&range(&parallelogram(0.1 - off, true))).unwrap();
        assert_eq!(ended.map(|limit| limit.kind), [SingularityKind::DeadPoint; 2], "{off:e}");
        let expected = closed_form([0.4, 0.1, 0.4, 0.1 - off], 0.5).unwrap();
        for (limit, expected) in ended.iter().zip(expected) {
            // Accuracy of the closed form itself: the rounding error of the lengths divided by the sine of the crank
            // angle.
            let bound = EXACT.larger(4.0 * f64::EPSILON / expected.sin().abs());
            assert_within!((limit.crank - expected).abs(), bound, "{off:e}: {} for {expected}", limit.crank);
        }
    }
}

/// Two dyads of the same lengths on one crank reach their dead points together: four branches meet, and the crank can
/// go no further.
#[test]
fn two_groups_with_one_dead_point() {
    let lengths = [0.4, 0.35, 0.3, 0.2];
    let mut spec = started(lengths, true).unwrap();
    let copy = |name: &str| format!("{name}_2");
    for k in [1, 2] {
        let mut link = spec.links[k].clone();
        link.name = copy(&link.name);
        link.points.iter_mut().filter(|(point, _)| point == "B").for_each(|(point, _)| *point = copy(point));
        spec.links.push(link);
    }
    spec.pins.push(Pin { name: copy("B"), links: [copy("coupler"), copy("rocker")] });
    // The new joints at A and C lie at points whose names other joints already use.
    // A spec cannot express such joints, so the scenario text is extended.
    let more = "[[joints]]\nname = \"A_2\"\npoint = \"A\"\ntype = \"revolute\"\nlinks = [\"crank\", \"coupler_2\"]\n\
                [[joints]]\nname = \"C_2\"\npoint = \"C\"\ntype = \"revolute\"\nlinks = [\"ground\", \"rocker_2\"]\n";
    spec.dyads.push(Dyad { links: [copy("coupler"), copy("rocker")], left: false });
    let text = spec.toml().replacen("[drive]", &format!("{more}[drive]"), 1);
    let scenario = scenario::Scenario::parse(&text, std::path::Path::new("test.toml")).unwrap();
    let found = Range::of(&scenario.case).unwrap();
    let expected = closed_form(lengths, spec.start).unwrap();
    for (limit, expected) in limits(&found).unwrap().iter().zip(expected) {
        assert_eq!(limit.kind, SingularityKind::DeadPoint);
        assert_within!((limit.crank - expected).abs(), EXACT, "{} for {expected}", limit.crank);
    }
}

/// At a limit of rotation, two real configurations of the group meet.
/// Beyond the limit, the polynomial for all configurations therefore has two fewer real zeros.
#[test]
fn groups_of_four_links_lose_two_configurations_at_their_limits() {
    let mut random = four_link::RandomSource::from_seed(13);
    for triad in [true, false] {
        let (mut limits_seen, mut full) = (0, 0);
        for _ in 0..150 {
            let case = four_link::scenario(&mut random, triad).case;
            let Ok(range) = Range::of(&case) else { panic!("a range") };
            let Some([from, to]) = limits(&range) else {
                full += 1;
                continue;
            };
            let count = |crank: f64| {
                let mut pose = Pose(vec![LinkPose::GROUND; case.mechanism.links().len()].into());
                let joint = &case.mechanism.joints()[case.crank().joint];
                let pivot = joint.other(case.crank().link).local;
                let own = joint.on(case.crank().link).unwrap();
                pose.0[case.crank().link] = LinkPose::through(own, pivot, case.crank().coordinate(crank));
                configurations(&case.mechanism, &case.structure.groups[GroupId(0)], &pose)
                    .map_or(0, |all| all.len() as i32)
            };
            for (limit, outwards) in [(from, -1.0), (to, 1.0)] {
                // Near a double zero, the error of the polynomial's zeros is of the order of the square root of the
                // rounding error.
                // The test therefore counts zeros at 1e-6 rad from the limit.
                let [inside, outside] = [-1e-6, 1e-6].map(|d| count(limit.crank + outwards * d));
                assert_eq!(
                    (limit.kind, inside - outside),
                    (SingularityKind::DeadPoint, 2),
                    "{limit:?}: {inside}, {outside}"
                );
                limits_seen += 1;
            }
        }
        assert!(limits_seen >= 60 && full >= 10, "triad {triad}: {limits_seen} {full}");
    }
}

#[test]
fn a_singular_start_is_refused() {
    // Crank in line with the frame, coupler and rocker stretched: 0.4 - 0.1 = 0.2 + 0.1.
    let spec = Spec { start: 0.0, ..four_bar([0.4, 0.1, 0.2, 0.1], true) };
    let error = Range::of(&spec.scenario().unwrap().case).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Geometry);
    assert!(error.to_string().contains("the start pose at crank angle 0.000000 deg is singular"), "{error}");
    assert!(error.to_string().contains("(coupler, rocker)"), "{error}");
}

fn asked(case: &Case, degrees: f64) -> Case {
    case.on(Grid::of_inputs(case.crank(), vec![degrees.to_radians()])).unwrap()
}

/// Both solvers and the list of configurations refuse an unreachable crank angle.
/// The function `explained` adds the reachable range of crank angles to each error, rounded to 1e-6 deg.
#[test]
fn an_unreachable_angle_is_refused_with_the_reachable_range() {
    let lengths = [0.4, 0.35, 0.3, 0.2];
    let spec = started(lengths, true).unwrap();
    let case = spec.scenario().unwrap().case;
    let [from, to] = closed_form(lengths, spec.start).unwrap().map(f64::to_degrees);
    let check = |error: linkage::Error, who: &str| {
        // The error of the solver does not state the reachable range; `explained` adds the range.
        assert!(error.is_out_of_reach() && !error.to_string().contains("reachable crank angles"), "{who}: {error}");
        assert_eq!(error.advice()[0], Advice::ShortenGrid, "{who}");
        let crank = error.input().unwrap().value.to_degrees();
        assert!(crank < from + 1e-3 || crank > to - 1e-3, "{who}: {crank}");
        let error = explained(&case, error);
        assert!(!error.is_out_of_reach() && explained(&case, error.clone()).message() == error.message());
        let text = error.to_string();
        let (_, found) = text.split_once("reachable crank angles: from ").expect(&text);
        let (found, _) = found.split_once(" deg on this branch").expect(&text);
        let (low, high) = found.split_once(" to ").unwrap();
        let [low, high]: [f64; 2] = [low, high].map(|number| number.parse().unwrap());
        // The limits in the message are rounded inwards at the sixth decimal.
        assert!((0.0..=1.001e-6).contains(&(low - from)) && (0.0..=1.001e-6).contains(&(to - high)), "{who}: {text}");
        for end in [low, high] {
            assert!(AssurSolver.solve(&asked(&case, end)).is_ok(), "{end} is reported as reachable");
        }
    };
    for degrees in [to + 10.0, from - 10.0] {
        for solver in all() {
            check(solver.solve(&asked(&case, degrees)).unwrap_err(), solver.name());
        }
        check(modes::all(&case, When::Crank(degrees.to_radians())).unwrap_err(), "modes");
    }
}

#[test]
fn coinciding_configurations_have_no_velocities() {
    let lengths = [0.4, 0.35, 0.3, 0.2];
    let case = started(lengths, true).unwrap().scenario().unwrap().case;
    let [_, to] = closed_form(lengths, case.crank().start).unwrap();
    let far = modes::all(&case, When::Crank(case.crank().start)).unwrap();
    assert!(
        far[0]
            .modes
            .iter()
            .all(|mode| mode.omegas.as_ref().is_some_and(|all| all.iter().all(|omega| omega.is_finite())))
    );
    // 1e-14 rad before the limit the determinant is of the order of 1e-7, so no angular velocities are reported.
    let near = modes::all(&case, When::Crank(to - 1e-14)).unwrap();
    assert!(near[0].modes.len() == 2 && near[0].modes.iter().all(|mode| mode.omegas.is_none()), "{near:?}");
}

/// Differences of the two analytic sides near a dead point, for the condition number k of the dyad.
/// Rounding error of positions enters the angles with the factor k.
/// Velocities are divided by a determinant of the order of 1 / k; the relative error of this determinant is k times the
/// relative error of the angles.
/// Accelerations are divided by the same determinant again.
/// A second division by the determinant adds a relative error of the same order.
/// The relative errors of velocities and of accelerations therefore both grow with k^2.
/// The angles of the two sides differ by up to 2.5 epsilon k.
/// Relative differences between the two sides are up to 2.1 epsilon k^2 for velocities and 6.4 epsilon k^2 for
/// accelerations.
/// These factors are nearly the same for 30 and for 0.3 degrees between coupler and rocker (0 if stretched).
/// The condition number is therefore the only cause of the loss of digits.
/// The bound allows twice the largest measured factor, for other mathematical libraries.
#[test]
fn loss_of_digits_at_a_dead_point_follows_the_condition_number() {
    let lengths = [0.4, 0.35, 0.3, 0.2];
    let [d, a, b, c] = lengths;
    let spec = started(lengths, true).unwrap();
    let case = spec.scenario().unwrap().case;
    let mut worst = [0.0f64; 3];
    for mu in [30.0, 10.0, 3.0, 1.0, 0.3] {
        let mut of_angle = [0.0f64; 3];
        for k in 0..40 {
            // Coupler and rocker are nearly stretched; the angle between them grows a little with k.
            let angle = f64::to_radians(mu * (1.0 + 0.01 * f64::from(k)));
            let reach = (b * b + c * c + 2.0 * b * c * angle.cos()).sqrt();
            let crank = crank_at(d, a, reach).unwrap();
            let case = asked(&case, crank.to_degrees());
            let (ours, theirs) = (AssurSolver.solve(&case).unwrap(), NewtonSolver.solve(&case).unwrap());
            let condition = 1.0 / (angle / 2.0).tan();
            for (stage, channel) in ["angle_rad", "omega_rad_s", "alpha_rad_s2"].into_iter().enumerate() {
                let values = |t: &linkage::trajectory::Trajectory| {
                    let name = format!("link.rocker.{channel}");
                    t.column(&linkage::trajectory::Channel::named(&name).unwrap()).unwrap()[0]
                };
                let (x, y) = (values(&ours), values(&theirs));
                let size = if stage == 0 { 1.0 } else { y.abs() };
                let power = if stage == 0 { 1 } else { 2 };
                of_angle[stage] = of_angle[stage].larger((x - y).abs() / size / (f64::EPSILON * condition.powi(power)));
            }
        }
        worst = [0, 1, 2].map(|stage| worst[stage].larger(of_angle[stage]));
    }
    worst.iter().for_each(|&factor| assert_within!(factor, 13.0, "{worst:?}"));
}

/// If two sums of link lengths differ by only a millionth, the mechanism has no change point.
/// The shortest link is the frame.
/// If shortest and longest link together are shorter than the other two links, all links rotate fully about the
/// frame.
/// If they are longer, no link rotates fully.
#[test]
fn nearly_equal_sums_of_lengths_are_no_change_point() {
    let of = |more: f64| FourBar::of_lengths([1.0, 2.0, 3.0, 2.0 + more]).of_type;
    let wanted = [FourBarType::ChangePoint, FourBarType::DoubleCrank, FourBarType::TripleRocker];
    assert_eq!([of(0.0), of(1e-6), of(-1e-6)], wanted);
}
