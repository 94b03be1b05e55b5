//! Distances, collisions and swept areas of simple mechanisms, against closed forms.

use std::f64::consts::{PI, TAU};

use std::sync::Arc;

use linkage::case::Case;
use linkage::drive::MotionLaw;
use linkage::math::{Curve, KeepNan, Vec2};
use linkage::mechanism::{AssemblyMode, GROUND, LinkId};

use super::tube::Tubes;
use super::*;
use scenario::clearance::Outline;
use scenario::clearance::question::{are_joined, pairs};

/// Slider-crank along x: crank 0.1 m, rod 0.3 m.
pub(super) fn slider_crank() -> Case {
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .link("rod", &[("A", [0.0, 0.0]), ("B", [0.3, 0.0])])
        .link("piston", &[("B", [0.0, 0.0])])
        .pin("O", "ground", "crank")
        .pin("A", "crank", "rod")
        .pin("B", "rod", "piston")
        .slider("bore", ("ground", "O"), ("piston", "B"), [0.0, 0.0])
        .crank("O", 10.0)
        .mode(&["rod", "piston"], AssemblyMode::Ahead);
    case.build().unwrap()
}

fn four_bar() -> Case {
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .link("coupler", &[("A", [0.0, 0.0]), ("B", [0.35, 0.0])])
        .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.25, 0.0])])
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .crank("O", 10.0)
        .mode(&["coupler", "rocker"], AssemblyMode::Left);
    case.build().unwrap()
}

/// A crank and a block on a guide, each with a separate law, joined by two rods.
fn crank_and_block() -> Case {
    let harmonic = Curve::Harmonic { amplitude: 0.05, period: 0.7, phase: 0.3 };
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("G", [0.5, 0.1])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .link("rod", &[("A", [0.0, 0.0]), ("B", [0.4, 0.0])])
        .link("arm", &[("B", [0.0, 0.0]), ("Q", [0.35, 0.0])])
        .link("block", &[("Q", [0.0, 0.0])])
        .pin("O", "ground", "crank")
        .pin("A", "crank", "rod")
        .pin("B", "rod", "arm")
        .pin("Q", "arm", "block")
        .slider("guide", ("ground", "G"), ("block", "Q"), [0.0, 0.0])
        .driven("O", MotionLaw::Cycloidal { rise: 2.0, time: 1.0 })
        .driven_from("guide", 0.05, MotionLaw::Curve(Arc::new(harmonic)))
        .times(&[0.0, 0.9])
        .mode(&["rod", "arm"], AssemblyMode::Left);
    case.build().unwrap()
}

/// Clearance question in which every link consists of capsules. `walls` are the parts of the housing.
fn question(case: &Case, radius: f64, walls: &[(&str, Outline)]) -> ClearanceQuestion {
    let links = case.mechanism.links().entries().skip(1);
    let mut bodies: Vec<ClearanceBody> = links
        .map(|(link, own)| {
            let places: Vec<Vec2> = own.points.iter().map(|point| point.local).collect();
            ClearanceBody { name: own.name.clone(), link, outline: Outline::of_points(&places, radius).unwrap() }
        })
        .collect();
    let wall = |(name, outline): &(&str, Outline)| ClearanceBody {
        name: (*name).into(),
        link: GROUND,
        outline: outline.clone(),
    };
    bodies.extend(walls.iter().map(wall));
    let pairs = pairs(&case.mechanism, &bodies, &[]);
    ClearanceQuestion { bodies, pairs, wanted: None, tolerance: None, area: 2e-3 }
}

fn line(places: &[(f64, f64)], radius: f64) -> Outline {
    let places: Vec<Vec2> = places.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
    Outline::line(&places, radius).unwrap()
}

fn of<'a>(asked: &ClearanceQuestion, found: &'a ClearanceResult, names: [&str; 2]) -> &'a PairClearance {
    let is = |pair: &&PairClearance| pair.bodies.map(|body| asked.bodies[body].name.as_str()) == names;
    found.pairs.iter().find(is).unwrap()
}

#[test]
fn smallest_distances_to_a_floor_are_exact() {
    let case = slider_crank();
    let asked = question(&case, 0.01, &[("floor", line(&[(-1.0, -0.15), (1.0, -0.15)], 0.005))]);
    let found = find(&case, &asked, &mut |_| ()).unwrap();
    let crank = of(&asked, &found, ["crank", "floor"]);
    // The pin is lowest at 270 deg. There, the crank's end is nearest to the floor.
    let expected = 0.15 - 0.1 - 0.015;
    assert!((crank.smallest.distance - expected).abs() < 1e-12, "{crank:?}");
    assert!((crank.smallest.crank - 1.5 * PI).abs() < 1e-6, "{crank:?}");
    assert!(crank.smallest.least > expected - 1e-6 && crank.collision.is_none());
    // The slider keeps its distance from the floor during the whole range.
    let piston = of(&asked, &found, ["piston", "floor"]);
    assert!((piston.smallest.distance - 0.135).abs() < 1e-12 && piston.smallest.least > 0.135 - 1e-6, "{piston:?}");
    assert!(found.open.is_empty());
    assert_eq!(found.smallest().unwrap().bodies, crank.bodies);
}

/// The crank's end touches the nail during less than a millionth of a degree.
#[test]
fn a_thin_crossing_between_two_instants_is_found() {
    let (case, radius) = (slider_crank(), 1e-7);
    let at = 77.123_456_f64.to_radians();
    // The near side of the nail lies 1e-13 m inside the circle that the crank's rounded end describes.
    let nail = Vec2::new(at.cos(), at.sin()) * (0.1 + 2.0 * radius - 1e-13);
    let mut asked = question(&case, radius, &[("nail", line(&[(nail.x, nail.y)], radius))]);
    asked.pairs.retain(|pair| *pair == [0, 3]);
    let samples = course(&case, &asked).unwrap();
    assert!(samples.rows.iter().all(|row| row[0] > 0.0));
    let found = find(&case, &asked, &mut |_| ()).unwrap();
    let (pair, meeting) = found.first_collision().unwrap();
    assert_eq!(pair.smallest.distance.max_zero(), 0.0, "{pair:?}");
    assert!((meeting.cranks[1] - at).abs() < 1e-5 && meeting.cranks[0] <= meeting.cranks[1], "{meeting:?}");
}

trait MaxZero {
    fn max_zero(self) -> f64;
}
impl MaxZero for f64 {
    /// Returns the distance, or zero if the distance is below a billionth of the mechanism's size.
    fn max_zero(self) -> f64 {
        if self < 3e-10 { 0.0 } else { self }
    }
}

#[test]
fn a_collision_begins_where_the_distance_reaches_zero() {
    let (case, radius) = (slider_crank(), 0.01);
    let asked = question(&case, radius, &[("post", line(&[(0.0, 0.09)], 0.004))]);
    let found = find(&case, &asked, &mut |_| ()).unwrap();
    let crank = of(&asked, &found, ["crank", "post"]);
    let meeting = crank.collision.unwrap();
    // At the crank angle a of the first contact, the post lies 0.014 m from the crank's line: sin(90 deg - a) = 0.014 /
    // 0.09.
    let expected = (0.014_f64 / 0.09).acos();
    assert!((meeting.cranks[1] - expected).abs() < 1e-7, "{} {expected}", meeting.cranks[1]);
    // The pair is proven clear up to a crank angle just before the contact.
    assert!(meeting.cranks[0] <= expected && expected - meeting.cranks[0] < 1e-5, "{meeting:?}");
    assert_eq!(crank.smallest.distance, 0.0);
    assert_eq!(found.first_collision().unwrap().0.bodies[1], crank.bodies[1]);
    // The contact lies on the border of the post.
    assert!(((meeting.place - Vec2::new(0.0, 0.09)).norm() - 0.004).abs() < 1e-6, "{meeting:?}");
}

/// Of two posts, the post that the crank meets first is reported.
/// The result depends neither on the order of the posts in the question nor on the crank's sense of rotation.
#[test]
fn the_first_collision_is_the_first_in_motion_order() {
    for sense in [1.0, -1.0] {
        let case = slider_crank();
        let law = linkage::drive::MotionLaw::ConstantSpeed(10.0 * sense);
        let motion = linkage::drive::DriveMotion::Prescribed { law, motor: None };
        let case = case.with(|parts| parts.drives.crank_mut().motion = motion).unwrap();
        let cranks = vec![0.0, sense * 3.0 * PI];
        let case = case.on(linkage::case::Grid::of_inputs(case.crank(), cranks)).unwrap();
        let part = linkage::case::Grid::of_inputs(case.crank(), vec![0.2 * sense, sense]);
        assert_eq!(range(&case.on(part).unwrap()).unwrap(), [0.2 * sense, sense], "in the order of the motion");
        let post = |degrees: f64| {
            let at = linkage::math::unit(sense * degrees.to_radians()) * 0.08;
            line(&[(at.x, at.y)], 0.004)
        };
        let mut asked = question(&case, 0.001, &[("late", post(200.0)), ("early", post(90.0))]);
        asked.pairs = vec![[0, 3], [0, 4]];
        asked.area = f64::INFINITY;
        let found = find(&case, &asked, &mut |_| ()).unwrap();
        assert_eq!(found.range, [0.0, sense * TAU], "one turn of a longer grid");
        let (first, meeting) = found.first_collision().unwrap();
        assert!(found.pairs.iter().all(|pair| pair.collision.is_some()));
        assert_eq!(first.bodies, [0, 4]);
        assert!((meeting.cranks[1].abs() - 0.5 * PI).abs() < 0.1, "{meeting:?}");
        // The search for swept areas computes fewer additional poses than the search for distances.
        assert!(found.work.positions < found.work.poses, "{:?}", found.work);
    }
    // If change points are passed, the next turn may follow another branch than the first turn.
    // The range of such a mechanism is therefore not limited to one turn.
    let smooth = slider_crank().with(|parts| parts.drives.crank_mut().through = true).unwrap();
    let grid = linkage::case::Grid::of_inputs(smooth.crank(), vec![0.0, 3.0 * PI]);
    assert_eq!(range(&smooth.on(grid).unwrap()).unwrap(), [0.0, 3.0 * PI]);
}

/// A lever of zero width, ten times as long as the mechanism, passes a point almost instantly.
#[test]
fn the_collision_of_a_long_thin_lever_is_located() {
    let case = slider_crank();
    let mut asked = question(&case, 0.01, &[("post", line(&[(3.9 * 1f64.cos(), 3.9 * 1f64.sin())], 0.0))]);
    asked.bodies[0].outline = line(&[(0.0, 0.0), (4.0, 0.0)], 0.0);
    (asked.pairs, asked.area) = (vec![[0, 3]], f64::INFINITY);
    let found = find(&case, &asked, &mut |_| ()).unwrap();
    let meeting = found.pairs[0].collision.unwrap();
    assert!(found.open.is_empty() && (meeting.cranks[1] - 1.0).abs() < 1e-9, "{meeting:?}");
}

/// The proven bound allows for the rounding errors of the nearest points and of the crank's track.
#[test]
fn a_proven_distance_allows_for_rounding() {
    let case = slider_crank();
    let asked = question(&case, 0.01, &[("post", line(&[(0.0, 0.3)], 0.01))]);
    let mut tubes = Tubes::new(&case, [0.0, TAU], asked.extent()).unwrap();
    let (slice, rounding) = (tubes.slice(0.3, 0.0).unwrap(), tubes.rounding());
    let solids: Vec<Solid> = asked.bodies.iter().map(|own| Solid::new(own.link, &own.outline, 1.0)).collect();
    let [one, two] = [&solids[0], &solids[3]];
    let places = [&one.placed(&slice), &two.placed(&slice)];
    let found = gap::gap([one, two], places, &slice, rounding, f64::INFINITY, &mut 0);
    // Lower limit of the distance: height of the post minus height of the crank's end, minus both rounding radii.
    let expected = 0.3 - 0.1 * 0.3f64.sin() - 0.02;
    assert!(found.now > expected - 0.01 && found.now - found.least >= 1.99 * rounding, "{found:?} {rounding}");
}

/// The corners of a polygon may be given clockwise or counter-clockwise. The corners are stored counter-clockwise.
/// The outlines from both orders are equal: their convex parts cover the same area and have the same distances.
#[test]
fn the_orientation_of_a_polygon_does_not_matter() {
    let angle = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.1), (0.1, 0.1), (0.1, 0.4), (0.0, 0.4)].map(|(x, y)| Vec2::new(x, y));
    let mut back = angle;
    back.reverse();
    let [one, other] = [&angle, &back].map(|corners| Outline::polygon(corners, 0.01).unwrap());
    assert_eq!((one.corners(), one.radius()), (&angle[..], 0.01));
    assert_eq!(one, other);
    let area = |part: &Vec<Vec2>| {
        let around = |k: usize| linkage::math::cross(part[k], part[(k + 1) % part.len()]) / 2.0;
        (0..part.len()).map(around).sum::<f64>()
    };
    assert!((one.parts().iter().map(area).sum::<f64>() - 0.06).abs() < 1e-15);
    for (x, y, wanted) in [(0.05, 0.2, -0.06), (0.2, 0.2, 0.09), (0.2, -0.1, 0.09), (0.25, 0.05, -0.06)] {
        assert!((other.distance(Vec2::new(x, y)).0 - wanted).abs() < 1e-15, "{x} {y}");
    }
}

/// The rounding error of a position grows with the distance from the origin, for the housing and for a link.
/// At a distance of 1000 m, the rounding error is above 1000 m times the epsilon of a double.
#[test]
fn rounding_grows_with_the_farthest_position() {
    let case = slider_crank();
    let near = question(&case, 0.01, &[]);
    let mut far = question(&case, 0.01, &[("post", line(&[(0.0, 1e3)], 0.01))]);
    far.pairs = vec![[0, 3]];
    let rounding =
        |case: &Case, asked: &ClearanceQuestion| Tubes::new(case, [0.0, TAU], asked.extent()).unwrap().rounding();
    let least = 1e3 * f64::EPSILON;
    assert!(rounding(&case, &near) < 0.1 * least && rounding(&case, &far) > least);
    far.bodies.swap_remove(3);
    far.bodies[0].outline = line(&[(0.0, 1e3)], 0.01);
    assert!(rounding(&case, &far) > least);
}

#[test]
fn adjacent_intervals_are_merged_in_motion_order() {
    let open = || vec![[3.0, 4.0], [1.0, 2.0], [2.0, 2.5], [3.0, 3.5]];
    assert_eq!(merged(open(), [0.0, 5.0]), [[1.0, 2.5], [3.0, 4.0]]);
    let back = open().into_iter().map(|[a, b]| [-a, -b]).collect();
    assert_eq!(merged(back, [0.0, -5.0]), [[-1.0, -2.5], [-3.0, -4.0]]);
}

/// Excluded pairs are two parts of the housing, two joined links, and pairs that the question names.
/// Joined links are excluded because they touch at their joint. A named pair may be given in either order.
#[test]
fn pairs_that_need_no_check_are_excluded() {
    let case = four_bar();
    let asked = question(&case, 0.01, &[("floor", line(&[(0.0, -1.0)], 0.0)), ("wall", line(&[(1.0, 0.0)], 0.0))]);
    let all = [[0, 2], [0, 3], [0, 4], [1, 3], [1, 4], [2, 3], [2, 4]];
    assert_eq!(asked.pairs, all);
    let without = |ignored: [usize; 2]| pairs(&case.mechanism, &asked.bodies, &[ignored]);
    assert_eq!([without([0, 2]), without([2, 0])].map(|own| own == all[1..]), [true; 2]);
    // Four links on one pin, each joined to the next.
    let place = |link: LinkId| linkage::mechanism::JointSide { link, local: Vec2::zeros() };
    let links = ["ground", "a", "b", "c", "d", "e"].map(|name| linkage::mechanism::Link {
        name: name.into(),
        points: Vec::new(),
        mass: 1.0,
        mass_centre: Vec2::zeros(),
        inertia: 1.0,
    });
    let joint = |[first, second]: [usize; 2], end: Vec2| linkage::mechanism::Joint {
        name: format!("{first}{second}"),
        kind: linkage::mechanism::JointKind::Revolute,
        first: linkage::mechanism::JointSide { link: LinkId(first), local: end },
        second: place(LinkId(second)),
        drawn: None,
    };
    let joints = vec![
        joint([1, 2], Vec2::zeros()),
        joint([2, 3], Vec2::zeros()),
        joint([3, 4], Vec2::zeros()),
        joint([4, 5], Vec2::new(1.0, 0.0)),
        joint([0, 1], Vec2::new(1.0, 0.0)),
    ];
    let mechanism = linkage::mechanism::Mechanism::new(links.to_vec(), joints).unwrap();
    assert!(are_joined(&mechanism, [1, 4].map(LinkId)) && are_joined(&mechanism, [4, 1].map(LinkId)));
    assert!(!are_joined(&mechanism, [1, 5].map(LinkId)) && !are_joined(&mechanism, [3, 5].map(LinkId)));
}

/// Where two sharp corners come close to each other, the direction between the nearest points is lost in rounding
/// errors.
/// The normals of the sides at these corners remain usable.
#[test]
fn collisions_of_sharp_corners_are_found() {
    let case = slider_crank();
    let corners = |places: &[(f64, f64)]| places.iter().map(|&(x, y)| Vec2::new(x, y)).collect::<Vec<Vec2>>();
    let blade = Outline::polygon(&corners(&[(0.0, -0.01), (0.1, -0.01), (0.12, 0.0), (0.1, 0.01)]), 0.0).unwrap();
    let block = Outline::polygon(&corners(&[(-0.02, 0.11), (0.0, 0.10), (0.3, 0.11), (0.3, 0.3)]), 0.0).unwrap();
    let mut asked = question(&case, 0.01, &[("block", block)]);
    asked.bodies[0].outline = blade;
    asked.pairs = vec![[0, 3]];
    let found = find(&case, &asked, &mut |_| ()).unwrap();
    assert!(found.open.is_empty(), "{:?}", found.open);
    let meeting = found.pairs[0].collision.unwrap();
    // At the contact, the crank's tip at 0.12 m reaches the block's side from (0, 0.1) to (0.3, 0.11).
    let tip = Vec2::new(meeting.cranks[1].cos(), meeting.cranks[1].sin()) * 0.12;
    assert!((tip.y - 0.1 - tip.x * 0.01 / 0.3).abs() < 1e-8, "{meeting:?}");
}

#[test]
fn swept_areas_match_closed_forms() {
    let (case, radius) = (slider_crank(), 0.02);
    let found = find(&case, &question(&case, radius, &[]), &mut |_| ()).unwrap();
    let near = |(_, area): (usize, Area), expected: f64| {
        assert!((area.least..=area.most).contains(&expected), "{area:?} {expected}");
        assert!(area.error() < 3e-3 * expected, "{area:?} {expected}");
        assert!((area.value - expected).abs() < 5e-4 * expected, "{area:?} {expected}");
    };
    // The crank sweeps a disc. The piston is a disc and sweeps a strip with round ends.
    near(found.swept[0], PI * 0.12 * 0.12);
    near(found.swept[2], 0.2 * 0.04 + PI * 0.02 * 0.02);
    // A crank that turns by 70 deg sweeps a sector that is widened by the rounding radius on all sides.
    // The swept area is the sum of the sector's area, the sector's perimeter times the radius, and the area of a disc.
    let part = case.on(linkage::case::Grid::of_inputs(case.crank(), vec![0.3, 0.3 + PI * 70.0 / 180.0])).unwrap();
    let found = find(&part, &question(&case, radius, &[]), &mut |_| ()).unwrap();
    let turn = PI * 70.0 / 180.0;
    near(found.swept[0], turn / 2.0 * 0.01 + (0.2 + 0.1 * turn) * radius + PI * radius * radius);
}

/// A link of practically zero width sweeps the area that its line passes over.
#[test]
fn a_thin_link_sweeps_an_area() {
    let case = slider_crank();
    let found = find(&case, &question(&case, 1e-9, &[]), &mut |_| ()).unwrap();
    let (_, area) = found.swept[0];
    let expected = PI * 0.01;
    assert!((area.least..=area.most).contains(&expected) && area.error() < 6e-3 * expected, "{area:?} {expected}");
    // Half of the border of the rod's swept area is an envelope of the rod's positions. Near an envelope, only small
    // squares are proven covered. With the allowed number of tests, the error bound of this area therefore stays wide.
    let (_, thin) = found.swept[1];
    assert!(thin.error() < 0.05 * thin.value, "{thin:?}");
}

/// A tube contains the true poses at every crank angle of its part of the range, including both ends.
/// Neighbouring tubes therefore overlap.
#[test]
fn tubes_contain_the_motion() {
    for (case, range) in
        [(slider_crank(), [0.2, 0.2 + TAU]), (four_bar(), [0.2, 0.2 + TAU]), (crank_and_block(), [0.0, 1.0])]
    {
        let mut tubes = Tubes::new(&case, range, 0.0).unwrap();
        let parts: Vec<_> = tubes.parts().flat_map(|part| part.halves()).collect();
        let mut widest: f64 = 0.0;
        for part in parts {
            let slice = tubes.at(part).unwrap();
            assert!(slice.sound, "{part:?}");
            let [from, to] = tubes.ends(part);
            let cranks: Vec<f64> = (0..=6).map(|k| from + (to - from) * f64::from(k) / 6.0).collect();
            for (crank, pose) in cranks.iter().zip(poses(&case, &cranks).unwrap()) {
                for (link, tube) in slice.tubes.iter().enumerate().skip(1) {
                    for local in [Vec2::new(0.0, 0.0), Vec2::new(0.3, 0.0), Vec2::new(0.1, -0.2)] {
                        let track = tube.point(local);
                        let even = track.at + track.rate * (crank - slice.crank);
                        let off = (pose[link].point(local) - even).norm();
                        assert!(off <= track.error, "link {link}: {off} {}", track.error);
                        widest = widest.larger(track.error);
                    }
                }
            }
        }
        assert!(widest < 0.005, "{widest}");
    }
}

/// At a singular pose nothing is proven, and the result reports the unproven range.
#[test]
fn a_singular_pose_is_reported_as_unproven() {
    // Parallelogram that passes smoothly through its change point.
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .link("coupler", &[("A", [0.0, 0.0]), ("B", [0.4, 0.0])])
        .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.1, 0.0])])
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .crank("O", 10.0)
        .start(1.0)
        .mode(&["coupler", "rocker"], AssemblyMode::Right)
        .build()
        .unwrap();
    let case = case.with(|parts| parts.drives.crank_mut().through = true).unwrap();
    let grid = linkage::case::Grid::of_inputs(case.crank(), vec![1.0, 4.0]);
    let case = case.on(grid).unwrap();
    let found = find(&case, &question(&case, 0.01, &[]), &mut |_| ()).unwrap();
    let ([from, _], [_, to]) = (found.open[0], found.open[found.open.len() - 1]);
    assert!(from <= PI && PI <= to && to - from < 1e-3, "{:?}", found.open);
}
