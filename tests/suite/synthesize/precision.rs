//! Four-bars through precision points: known four-bars are found again, and every result is followed by both sides.

use std::path::Path;

use analytic::{AssurSolver, NewtonSolver};
use design::synthesize::DraftContents;
use design::synthesize::precision::{
    CouplerPose, CrankTravel, FunctionSpec, FunctionStart, MotionSpec, PathSpec, PrecisionFourBar, TimedPoint,
};
use linkage::math::{Complex, KeepNan, Vec2};
use linkage::mechanism::LinkId;
use linkage::solver::State;
use proptest::prelude::*;
use scenario::Scenario;

use crate::common::{assert_within, shipped, states};

/// Largest error of a position, relative to the largest length.
const PASSED: f64 = 1e-9;

fn sheet() -> DraftContents {
    DraftContents { name: "found".into(), title: "Found".into(), comment: "a test".into(), speed: 6.0, bar: 2.0 }
}

/// Writes the four-bar as a scenario. Returns its states at the precision positions, by side 1 and by side 2.
fn followed(own: &PrecisionFourBar) -> [Vec<State>; 2] {
    let text = own.scenario(&sheet());
    let case = Scenario::parse(&text, Path::new("found.toml")).unwrap_or_else(|error| panic!("{error}\n{text}")).case;
    let cranks = own.crank_turns.iter().map(|turn| own.frames[0].angle + turn);
    let times: Vec<f64> = cranks.map(|crank| case.crank().time_of(crank)).collect();
    let by = |solved: linkage::Result<Vec<State>>| solved.unwrap_or_else(|error| panic!("{error}\n{text}"));
    [by(states(&AssurSolver, &case, &times)), by(states(&NewtonSolver, &case, &times))]
}

const CRANK: LinkId = LinkId(1);
const COUPLER: LinkId = LinkId(2);
const ROCKER: LinkId = LinkId(3);

fn complex(vector: Vec2) -> Complex {
    Complex::new(vector.x, vector.y)
}

fn direction(state: &State, link: LinkId) -> Complex {
    complex(state.motions[link].direction)
}

fn turned(angle: f64) -> Complex {
    Complex::from_polar(1.0, angle)
}

fn size(own: &PrecisionFourBar) -> f64 {
    own.checks.lengths.into_iter().fold(0.0, f64::larger)
}

/// Checks, at every position, each four-bar that keeps its branch and has a large enough transmission angle.
/// Returns the number of checked four-bars.
fn assert_passed(all: &[PrecisionFourBar], error: impl Fn(&PrecisionFourBar, usize, &State) -> f64) -> usize {
    let sound = all.iter().filter(|own| own.checks.keeps_branch && own.checks.transmission > 0.02);
    let check = |own: &PrecisionFourBar| {
        for solved in followed(own) {
            for (position, state) in solved.iter().enumerate() {
                let error = error(own, position, state);
                assert_within!(error, PASSED * (1.0 + own.checks.ratio / 100.0), "{position} {own:?}");
            }
        }
    };
    sound.inspect(|own| check(own)).count()
}

fn assert_guided(spec: &MotionSpec, all: &[PrecisionFourBar]) -> usize {
    assert_passed(all, |own, position, state| {
        let pose = spec.poses[position];
        let turn = (direction(state, COUPLER) - turned(pose.angle)).norm();
        turn.larger((complex(state.motions[COUPLER].origin) - pose.point).norm() / size(own))
    })
}

/// A four-bar with a coupler point, at crank angles.
#[derive(Clone, Debug)]
struct Known {
    /// Frame along x, crank, coupler, rocker.
    lengths: [f64; 4],
    /// Coupler point in the frame of the coupler from A to B.
    point: Complex,
    /// +1 if B lies to the left of the line from A to C, otherwise -1.
    side: f64,
    cranks: Vec<f64>,
}

impl Known {
    /// Coupler poses and rocker angles at the crank angles.
    /// `None` if the four-bar cannot be assembled, or is close to a dead point.
    fn poses(&self) -> Option<Vec<(CouplerPose, f64)>> {
        let [frame, crank, coupler, rocker] = self.lengths;
        let pose = |&angle: &f64| {
            let pin = crank * turned(angle);
            let diagonal = frame - pin;
            let d = diagonal.norm();
            let cos = (coupler * coupler + d * d - rocker * rocker) / (2.0 * coupler * d);
            let transmission = (coupler * coupler + rocker * rocker - d * d) / (2.0 * coupler * rocker);
            let along = diagonal / d * turned(self.side * cos.acos());
            let pose = CouplerPose { point: pin + self.point * along, angle: along.arg() };
            (transmission.abs() < 0.95 && cos.abs() < 1.0).then(|| (pose, (pin + coupler * along - frame).arg()))
        };
        self.cranks.iter().map(pose).collect()
    }

    /// The pivots and the pins in position 1.
    fn joints(&self, first: CouplerPose) -> [Complex; 4] {
        let along = turned(first.angle);
        let pin = first.point - self.point * along;
        [Complex::default(), self.lengths[0].into(), pin, pin + self.lengths[2] * along]
    }
}

fn joints(own: &PrecisionFourBar) -> [Complex; 4] {
    let ([o, c], [a, b]) = (own.pivots, own.pins);
    [o, c, a, b]
}

/// Distance of the known four-bar from the nearest four-bar of `all`: the largest distance between corresponding
/// joints, divided by the size of the known four-bar.
fn distance(all: &[PrecisionFourBar], known: &[Complex; 4]) -> f64 {
    let size = known.iter().map(|joint| joint.norm()).fold(0.0, f64::larger);
    let apart = |own: &PrecisionFourBar| {
        joints(own).iter().zip(known).map(|(a, b)| (a - b).norm()).fold(0.0, f64::larger) / size
    };
    all.iter().map(apart).fold(f64::INFINITY, f64::smaller)
}

/// Four-bars whose five crank angles are at least a third of a radian apart.
fn known() -> impl Strategy<Value = Known> {
    let length = 0.3f64..2.0;
    let steps = prop::collection::vec(0.35f64..1.2, 5);
    (prop::array::uniform4(length), (-1.0f64..1.0, 0.3f64..1.5), any::<bool>(), steps).prop_map(
        |(lengths, (x, y), is_left, steps)| {
            let cranks = steps.iter().scan(0.0, |angle, step| {
                *angle += step;
                Some(*angle)
            });
            let side = if is_left { 1.0 } else { -1.0 };
            Known { lengths, point: Complex::new(x, y), side, cranks: cranks.collect() }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 100_000, ..ProptestConfig::with_cases(300) })]

    /// Five poses of a random four-bar: this four-bar is among the results, and every result passes all poses.
    #[test]
    fn five_poses_give_the_four_bar_back(known in known()) {
        let Some(poses) = known.poses() else { return Err(TestCaseError::reject("not assembled")) };
        let poses: Vec<CouplerPose> = poses.into_iter().map(|(pose, _)| pose).collect();
        let spec = MotionSpec { poses, ..MotionSpec::default() };
        let found = spec.four_bars(100).unwrap();
        let apart = distance(&found.best, &known.joints(spec.poses[0]));
        prop_assert!(apart <= 1e-9, "{apart:e} {:?}", found.best);
        assert_guided(&spec, &found.best);
    }

    /// Five points and their crank angles are taken from a random four-bar: this four-bar is among the results.
    #[test]
    fn five_timed_points_give_the_four_bar_back(known in known()) {
        let Some(poses) = known.poses() else { return Err(TestCaseError::reject("not assembled")) };
        let point = |((pose, _), crank): (&(CouplerPose, f64), &f64)| TimedPoint { point: pose.point, crank: *crank };
        let spec = PathSpec { points: poses.iter().zip(&known.cranks).map(point).collect() };
        let found = spec.four_bars(100).unwrap();
        let apart = distance(&found.best, &known.joints(poses[0].0));
        prop_assert!(apart <= 1e-9, "{apart:e} {:?}", found.best);
        assert_traced(&spec, &found.best);
    }

    /// Five pairs of angles, and three pairs of world angles: the four-bar is among the results.
    #[test]
    fn pairs_of_angles_give_the_four_bar_back(known in known()) {
        let Some(poses) = known.poses() else { return Err(TestCaseError::reject("not assembled")) };
        let pairs: Vec<[f64; 2]> = poses.iter().zip(&known.cranks).map(|((_, rocker), crank)| [*crank, *rocker]).collect();
        let joints = known.joints(poses[0].0);
        for (count, start) in [(5, FunctionStart::Free), (3, FunctionStart::World)] {
            let spec = FunctionSpec { pivots: [joints[0], joints[1]], pairs: pairs[..count].to_vec(), start };
            let found = spec.four_bars(100).unwrap();
            let apart = distance(&found.best, &joints);
            prop_assert!(apart <= 1e-9, "{apart:e} {:?}", found.best);
            assert_coupled(&spec, &found.best);
        }
    }
}

fn assert_traced(spec: &PathSpec, all: &[PrecisionFourBar]) -> usize {
    assert_passed(all, |own, position, state| {
        let place = own.frames[1].local(own.point.unwrap());
        let point = complex(state.motions[COUPLER].point(Vec2::new(place.re, place.im)));
        let crank = (direction(state, CRANK) - turned(spec.points[position].crank)).norm();
        crank.larger((point - spec.points[position].point).norm() / size(own))
    })
}

fn assert_coupled(spec: &FunctionSpec, all: &[PrecisionFourBar]) -> usize {
    assert_passed(all, |_, position, state| {
        let [crank, rocker] = spec.pairs[position].map(turned);
        (direction(state, CRANK) - crank).norm().larger((direction(state, ROCKER) - rocker).norm())
    })
}

/// Five poses that the analytic solver computes for the published crank-rocker give this crank-rocker back.
#[test]
fn the_published_crank_rocker_is_found_from_five_poses() {
    let case = shipped("crank_rocker.toml").case;
    let times: Vec<f64> = [20.0f64, 80.0, 150.0, 220.0, 300.0].map(|deg| case.crank().time_of(deg.to_radians())).into();
    let middle = Vec2::new(0.1, 0.08);
    let pose = |state: &State| CouplerPose {
        point: complex(state.motions[COUPLER].point(middle)),
        angle: direction(state, COUPLER).arg(),
    };
    let poses = states(&AssurSolver, &case, &times).unwrap().iter().map(pose).collect();
    let found = MotionSpec { poses, ..MotionSpec::default() }.four_bars(10).unwrap();
    let lengths = [0.15f64.hypot(0.015), 0.025_995_627_740_337, 0.347_071_931_891_81, 0.25];
    let is_published = |own: &&PrecisionFourBar| {
        own.checks.lengths.iter().zip(lengths).all(|(length, published)| (length - published).abs() < 1e-10)
    };
    let own = found.best.iter().find(is_published).unwrap_or_else(|| panic!("{found:?}"));
    assert!(own.checks.turns_fully() && own.checks.keeps_order && own.checks.keeps_branch, "{own:?}");
    assert_within!((own.checks.transmission.to_degrees() - 15.2871).abs(), 1e-4);
}

fn motion(poses: &[[f64; 3]]) -> MotionSpec {
    let pose = |&[x, y, deg]: &[f64; 3]| CouplerPose { point: Complex::new(x, y), angle: deg.to_radians() };
    MotionSpec { poses: poses.iter().map(pose).collect(), ..MotionSpec::default() }
}

const POSES: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [0.1, 0.04, 20.0], [0.2, 0.05, 45.0], [0.28, 0.02, 70.0], [0.33, -0.05, 100.0]];

/// With fewer than five positions, the best four-bars found are followed through all positions.
#[test]
fn scanned_four_bars_pass_all_positions() {
    let mut passed = 0;
    for count in 3..=5 {
        let spec = motion(&POSES[..count]);
        if let Ok(found) = spec.four_bars(20) {
            passed += assert_guided(&spec, &found.best);
        }
        let cranks = [0.0f64, 30.0, 70.0, 100.0, 150.0].map(f64::to_radians);
        let point = |(pose, crank): (&CouplerPose, f64)| TimedPoint { point: pose.point, crank };
        let spec = PathSpec { points: spec.poses.iter().zip(cranks).map(point).collect() };
        if let Ok(found) = spec.four_bars(20) {
            passed += assert_traced(&spec, &found.best);
        }
        // y = x^2 for x from 0 to 1, over 90 deg of the crank and 60 deg of the rocker.
        let pairs = (0..count).map(|k| {
            let x = (k as f64 + 0.3) / (count as f64 - 0.4);
            [(90.0 * x).to_radians(), (60.0 * x * x).to_radians()]
        });
        let pivots = [Complex::default(), Complex::new(0.3, 0.1)];
        let spec = FunctionSpec { pivots, pairs: pairs.collect(), start: FunctionStart::Free };
        if let Ok(found) = spec.four_bars(20) {
            passed += assert_coupled(&spec, &found.best);
        }
    }
    assert!(passed > 60, "{passed}");
}

/// Two pivots, two pins, or one of each determine the four-bar of three poses.
#[test]
fn given_pivots_and_pins_are_kept() {
    let mut spec = motion(&POSES[..3]);
    spec.pivots = vec![Complex::new(0.05, -0.2), Complex::new(0.2, -0.25)];
    let found = spec.four_bars(10).unwrap();
    assert_eq!(found.found, 2, "either link may be the crank");
    for own in &found.best {
        let apart = |a: Complex, b: Complex| (own.pivots[0] - a).norm() + (own.pivots[1] - b).norm();
        let [a, b] = [spec.pivots[0], spec.pivots[1]];
        assert!(apart(a, b) == 0.0 || apart(b, a) == 0.0);
    }
    assert_guided(&spec, &found.best);
    // The pins of this four-bar, given instead of the pivots, lead back to the pivots.
    let pins: Vec<Complex> = found.best[0].pins.iter().map(|pin| found.best[0].frames[1].local(*pin)).collect();
    let again = MotionSpec { pivots: vec![], pins: pins.clone(), ..spec.clone() }.four_bars(10).unwrap();
    assert_within!(distance(&again.best, &joints(&found.best[0])), 1e-12);
    let mixed = MotionSpec { pivots: vec![found.best[0].pivots[0]], pins: vec![pins[1]], ..spec.clone() };
    assert_within!(distance(&mixed.four_bars(10).unwrap().best, &joints(&found.best[0])), 1e-12);
    let one = MotionSpec { pins: vec![], pivots: vec![spec.pivots[0]], ..spec }.four_bars(10).unwrap();
    assert!(one.best.len() == 10 && one.is_scanned);
}

/// The results of a scan are sorted, and the first results do not depend on the number of requested results.
#[test]
fn the_best_comes_first() {
    let few = motion(&POSES[..4]).four_bars(3).unwrap();
    let many = motion(&POSES[..4]).four_bars(30).unwrap();
    assert_eq!(few.best[0], many.best[0]);
    let angles: Vec<f64> = many
        .best
        .iter()
        .filter(|own| {
            own.checks.keeps_order && own.checks.keeps_branch && own.checks.turns_fully() && own.checks.ratio < 10.0
        })
        .map(|own| own.checks.transmission)
        .collect();
    assert!(angles.is_sorted_by(|a, b| a >= b), "{angles:?}");
    assert!(many.keep_order <= many.keep_branch && many.keep_branch <= many.found);
}

/// Reversed positions reverse the sense of a crank that turns fully.
#[test]
fn the_sense_of_the_crank_follows_the_order() {
    let mut poses = [[0.0, 0.0, 0.0], [40.0, 25.0, 15.0], [80.0, 30.0, 35.0], [115.0, 20.0, 60.0], [140.0, 0.0, 80.0]];
    let forwards = motion(&poses).four_bars(1).unwrap().best.remove(0);
    poses.reverse();
    let back = motion(&poses).four_bars(1).unwrap().best.remove(0);
    assert_within!((forwards.pivots[0] - back.pivots[0]).norm(), 1e-9 * size(&back));
    let senses = [forwards, back].map(|own| own.checks.travel);
    assert_eq!(senses, [-1.0, 1.0].map(|sense| CrankTravel::FullTurn { sense }));
}

/// Degenerate and absurd input ends in a result or in a message with a way out, never in a panic.
#[test]
fn absurd_positions_are_answered() {
    let nan = f64::NAN;
    let far = [[0.0, 0.0, 0.0], [1e300, 0.0, 20.0], [1e300, 1e300, 45.0]];
    for (poses, words) in [
        (&POSES[..2], "found 2 positions"),
        (&[POSES[0], POSES[1], POSES[2], POSES[3], POSES[4], [0.5, 0.0, 1.0]], "found 6 positions"),
        (&[POSES[0], POSES[1], POSES[1]], "positions 2 and 3 coincide"),
        (&[POSES[0], POSES[1], [0.1, 0.04, 380.0]], "positions 2 and 3 coincide"),
        (&[POSES[0], POSES[1], [nan, 0.0, 0.0]], "not finite"),
        (&[POSES[0], POSES[1], [0.0, f64::INFINITY, 0.0]], "not finite"),
        // Translations, and rotations about the working point or another point.
        (&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "one point, or translations"),
        (&[[0.0, 0.0, 0.0], [0.0, 0.0, 20.0], [0.0, 0.0, 40.0]], "one point, or translations"),
        (&[[1.0, 0.0, 0.0], [0.0, 1.0, 90.0], [-1.0, 0.0, 180.0]], "one point, or translations"),
    ] as [(&[[f64; 3]], &str); 9]
    {
        let error = motion(poses).four_bars(5).unwrap_err();
        assert!(error.message().contains(words) && error.way_out().is_some(), "{poses:?}: {error}");
    }
    for scale in [1e-12, 1e9] {
        let poses = POSES.map(|[x, y, deg]| [x * scale, y * scale, deg]);
        for count in 3..=5 {
            let (spec, plain) = (motion(&poses[..count]), motion(&POSES[..count]));
            let [found, same] = [&spec, &plain].map(|spec| spec.four_bars(5).map_or(0, |own| own.best.len()));
            assert_eq!(found, same);
        }
    }
    // Opposite poses, and points on a line.
    let line = [[0.0, 0.0, 0.0], [1.0, 0.0, 180.0], [2.0, 0.0, 0.0], [3.0, 0.0, 180.0], [4.0, 0.0, 90.0]];
    for count in 3..=5 {
        let _ = motion(&line[..count]).four_bars(5);
    }
    let _ = motion(&far).four_bars(5);
    let mut given = motion(&POSES[..3]);
    given.pins = vec![Complex::new(0.0, 0.0); 3];
    assert!(given.four_bars(5).unwrap_err().message().contains("3 pivots and pins"));
    let mut straight = motion(&[[0.0, 0.0, 0.0], [1.0, 0.0, 10.0], [2.0, 0.0, 30.0]]);
    straight.pins = vec![Complex::default()];
    assert!(straight.four_bars(5).unwrap_err().message().contains("on a line"));
}

#[test]
fn absurd_angles_are_answered() {
    let pivots = [Complex::default(), Complex::new(0.1, 0.0)];
    let function = |pairs: &[[f64; 2]], start| {
        FunctionSpec { pivots, pairs: pairs.iter().map(|pair| pair.map(f64::to_radians)).collect(), start }.four_bars(5)
    };
    for (pairs, start, words) in [
        (&[[0.0, 0.0], [10.0, 10.0], [20.0, 20.0]], FunctionStart::Free, "turns like the crank"),
        (&[[0.0, 5.0], [10.0, 5.0], [20.0, 5.0]], FunctionStart::Free, "or not at all"),
        (&[[0.0, 5.0], [0.0, 6.0], [20.0, 7.0]], FunctionStart::Free, "positions 1 and 2 coincide"),
        (&[[0.0, 5.0], [10.0, 6.0], [20.0, 7.0], [30.0, 8.0]], FunctionStart::World, "three unknowns"),
        (&[[10.0, 10.0], [20.0, 20.0], [40.0, 40.0]], FunctionStart::World, "no unique solution"),
        (&[[f64::NAN, 10.0], [20.0, 20.0], [40.0, 40.0]], FunctionStart::World, "not finite"),
    ] as [(&[[f64; 2]], FunctionStart, &str); 6]
    {
        let error = function(pairs, start).unwrap_err();
        let told = format!("{error}");
        assert!(told.contains(words) && error.way_out().is_some(), "{pairs:?}: {told}");
    }
    let same = FunctionSpec {
        pivots: [pivots[0]; 2],
        pairs: vec![[0.0, 0.1], [0.2, 0.4], [0.5, 0.6]],
        start: FunctionStart::World,
    };
    assert!(same.four_bars(1).unwrap_err().message().contains("two pivots coincide"));
    let point = |x: f64, y: f64, crank: f64| TimedPoint { point: Complex::new(x, y), crank };
    let circle = |angle: f64| point(angle.cos(), angle.sin(), angle);
    for (points, words) in [
        (vec![circle(0.0), circle(1.0), circle(2.0)], "crank alone"),
        (vec![point(0.0, 0.0, 0.0), point(1.0, 0.0, 0.0), point(2.0, 0.0, 1.0)], "positions 1 and 2 coincide"),
        (vec![point(0.0, 0.0, 0.0), point(1.0, f64::NAN, 0.3), point(2.0, 0.0, 1.0)], "not finite"),
    ] {
        let error = PathSpec { points }.four_bars(5).unwrap_err();
        assert!(error.message().contains(words) && error.way_out().is_some(), "{error}");
    }
    let straight = PathSpec { points: (0..5).map(|k| point(f64::from(k), 0.0, 0.4 * f64::from(k))).collect() };
    let _ = straight.four_bars(5);
}
