mod scan;

use super::super::random::{Lcg, group, mechanism, size};
use super::*;
use crate::fixtures::class_four;
use crate::math::KeepNan;
use crate::mechanism::{GROUND, GroupId, GroupKind, JointId, LinkId, Structure};
use scan::{Scan, scanned};

/// For each of the three leads: whether the pair with the frame slides, and whether the pair with the base slides.
type Pairs = [[bool; 2]; 3];

const REVOLUTE: Pairs = [[false; 2]; 3];

/// A group of links 2 to 5, attached to the ground and to link 1.
struct Case {
    mechanism: Mechanism,
    group: Group,
    pose: Pose,
}

/// A random case. The joints are closed in the pose of the case if `fitted` is true.
fn case(random: &mut Lcg, pairs: Pairs, triad: bool, fitted: bool) -> Case {
    let hook = |random: &mut Lcg| usize::from(random.yes());
    let ends = if triad {
        // Links 2, 4 and 5 are leads of the base 3.
        [2, 4, 5].map(|lead| [[hook(random), lead], [lead, 3]])
    } else {
        // The frame is link 2 and the base link 5. The leads are links 3 and 4 and the world.
        let (near, far) = (hook(random), hook(random));
        [[[2, 3], [3, 5]], [[2, 4], [4, 5]], [[2, near], [far, 5]]]
    };
    let mut pose = Pose((0..6).map(|_| random.pose()).collect());
    pose.0[LinkId(0)] = LinkPose::GROUND;
    let mut joints = Vec::new();
    for (lead, slides) in ends.iter().flatten().zip(pairs.iter().flatten()) {
        let joint =
            random.joint(["A", "B", "C", "D", "E", "F"][joints.len()], *slides, LinkId(lead[0]), LinkId(lead[1]));
        joints.push(if fitted { random.fitted(joint, &pose) } else { joint });
    }
    let mechanism = mechanism(6, joints);
    let group = group(&mechanism, &[2, 3, 4, 5].map(LinkId), GroupKind::Higher);
    Case { mechanism, group, pose }
}

fn posed(case: &Case, one: &Configuration) -> Pose {
    let mut pose = case.pose.clone();
    case.group.links.iter().zip(&one.links).for_each(|(&link, &place)| pose.0[link] = place);
    pose
}

/// Results of many cases.
#[derive(Debug, Default)]
struct Tally {
    /// Number of cases for each number of configurations.
    counts: [usize; 7],
    /// Largest closure error, as a fraction of the size.
    closure: f64,
    /// Number of cases in which the scan finds a double root, up to 1e-9.
    /// A root that looks double may be two zeros or a near miss. Scan and module cannot distinguish these two cases.
    double: usize,
}

/// Compares the configurations of random groups with a scan.
fn compare(random: &mut Lcg, pairs: Pairs, triad: bool, cases: usize, tally: &mut Tally) {
    for number in 0..cases {
        let fitted = number % 2 == 0;
        let case = case(random, pairs, triad, fitted);
        let what = || format!("{pairs:?}, triad {triad}, case {number}");
        let layout = Layout::of(&case.mechanism, &case.group, &case.pose).expect("it is one of the two groups");
        let all = configurations(&case.mechanism, &case.group, &case.pose).unwrap_or_else(|error| {
            assert!(error.to_string().contains("no real configuration"), "{error}: {}", what());
            Vec::new()
        });
        for one in &all {
            let pose = posed(&case, one);
            tally.closure = tally.closure.larger(pose.closure(&case.mechanism) / size(&case.mechanism, &pose));
        }
        let leads = layout.leads.map(|(_, lead)| lead);
        let scan = scanned(&leads);
        match scan {
            Some(Scan { count, double: false, .. }) => assert_eq!(all.len(), count, "{}", what()),
            Some(_) => tally.double += 1,
            None => assert!(all.len() <= 2, "{}", what()),
        }
        if fitted {
            let same = |one: &Configuration| {
                let pose = posed(&case, one);
                pose.0
                    .iter()
                    .zip(&case.pose.0)
                    .all(|(a, b)| (a.origin - b.origin).norm() < 1e-6 && (unit(a.angle) - unit(b.angle)).norm() < 1e-6)
            };
            let is_double = scan.is_some_and(|scan| scan.double);
            assert!(is_double || all.iter().filter(|one| same(one)).count() == 1, "{}", what());
        }
        tally.counts[all.len()] += 1;
    }
}

/// Asserts two bounds of a tally: a bound on the closure error and a bound on the number of double roots.
/// The bound on the closure error is the same in all tests of closure.
/// A root is double with a probability of some tens times 1e-9^(1/2).
fn check(tally: &Tally, cases: usize) {
    assert!(tally.closure <= 1e-12, "{tally:?}");
    assert!(tally.double <= 1 + cases / 200, "{tally:?}");
}

/// Whether to test more groups than usual. This test takes minutes, so only `.ci/nightly` requests the larger number.
fn many() -> bool {
    std::env::var_os("LINKPROOF_DRAWS").is_some()
}

#[test]
fn as_many_configurations_as_a_scan_finds() {
    let (seed, cases) = if many() { (12, 10_000) } else { (11, 600) };
    for triad in [true, false] {
        let mut tally = Tally::default();
        compare(&mut Lcg(seed), REVOLUTE, triad, cases, &mut tally);
        println!("triad {triad}: {tally:?}");
        check(&tally, cases);
        assert!(tally.counts[2] > 50 && tally.counts[4] > 20, "{tally:?}");
        assert!(tally.counts[6] > 0 || !many(), "{tally:?}");
    }
}

/// All distributions of prismatic pairs over the leads.
/// At most one lead may have two prismatic pairs. If two leads had two prismatic pairs each, links would slide in a
/// loop.
fn sliding() -> impl Iterator<Item = Pairs> {
    let lead = |bits: usize| [bits & 1 == 1, bits & 2 == 2];
    let all = (1..64).map(move |bits: usize| [lead(bits & 3), lead(bits >> 2 & 3), lead(bits >> 4)]);
    all.filter(|pairs: &Pairs| pairs.iter().filter(|pair| **pair == [true; 2]).count() <= 1)
}

#[test]
fn as_many_configurations_as_a_scan_finds_with_prismatic_pairs() {
    let cases = if many() { 1000 } else { 40 };
    let mut patterns = 0;
    for pairs in sliding() {
        for triad in [true, false] {
            let mut tally = Tally::default();
            compare(&mut Lcg(13), pairs, triad, cases, &mut tally);
            println!("{pairs:?}, triad {triad}: {tally:?}");
            check(&tally, cases);
            patterns += 1;
        }
    }
    assert_eq!(patterns, 2 * 53);
}

/// Three parallel leads of equal length let the base move. Every angle of the leads then gives a configuration.
#[test]
fn a_group_that_can_move_is_refused() {
    let mut random = Lcg(3);
    for triad in [true, false] {
        let mut case = case(&mut random, REVOLUTE, triad, true);
        let mut joints = case.mechanism.joints().to_vec();
        for pair in joints.chunks_mut(2) {
            // The world vector between the two joints of a lead is the same for all leads, so the leads are parallel
            // and equally long.
            let Some(lead) =
                [pair[0].first.link, pair[0].second.link].into_iter().find(|&link| pair[1].on(link).is_some())
            else {
                continue;
            };
            let other = pair[1].other(lead);
            let from = case.pose.0[pair[0].other(lead).link].point(pair[0].other(lead).local);
            let place = from + Vec2::new(0.3, 0.4);
            for (link, at) in [(lead, place), (other.link, place)] {
                let own = case.pose.0[link];
                let local = rotated(unit(-own.angle), at - own.origin);
                let side = if pair[1].first.link == link { &mut pair[1].first } else { &mut pair[1].second };
                side.local = local;
            }
        }
        if !triad {
            // The third lead is the world.
            let [a, b] = [4, 5].map(|k: usize| {
                let joint = &joints[k];
                if joint.first.link < LinkId(2) { joint.first } else { joint.second }
            });
            let from = case.pose.0[a.link].point(a.local);
            let place = from + Vec2::new(0.3, 0.4);
            let joint = &mut joints[5];
            for side in [&mut joint.first, &mut joint.second] {
                let own = case.pose.0[side.link];
                side.local = rotated(unit(-own.angle), place - own.origin);
            }
            assert!(b.link < LinkId(2));
        }
        case.mechanism = mechanism(6, joints);
        let error = configurations(&case.mechanism, &case.group, &case.pose).unwrap_err();
        assert!(error.to_string().contains("can move while its outer joints are held"), "{error}");
    }
}

/// `scenarios/fourth_class.toml`: link 2 A-C-B, link 3 BD, link 4 CE, link 5 K-E-D, crank OA at 70 deg.
#[test]
fn val_fourth_class_configurations_at_70_degrees() {
    let mut total = 0;
    for (side_b, side_d) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let mechanism = class_four(side_b, side_d);
        let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
        let mut pose = Pose(vec![LinkPose::GROUND; 6].into());
        pose.0[LinkId(1)].angle = 70f64.to_radians();
        let group = &structure.groups[GroupId(0)];
        let all = configurations(&mechanism, group, &pose).unwrap();
        for one in &all {
            for (&link, &place) in group.links.iter().zip(&one.links) {
                pose.0[link] = place;
            }
            assert!(pose.closure(&mechanism) < 1e-15 && pose.0[GROUND] == LinkPose::GROUND);
        }
        total += all.len();
        // The angles (deg) of AC, BD, CE and KE in the printed configuration.
        let printed = [-53.70258, 2.58635, 20.59796, 151.55247];
        let is_printed = |one: &&Configuration| {
            one.links.iter().zip(printed).all(|(place, angle)| (place.angle.to_degrees() - angle).abs() < 0.5e-5)
        };
        let expected = usize::from(side_b > 0.0 && side_d < 0.0);
        assert_eq!(all.iter().filter(is_printed).count(), expected);
    }
    assert_eq!(total, 8);
}
