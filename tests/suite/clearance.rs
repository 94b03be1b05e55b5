//! Clearance against brute force.
//! Independent formulas compute the distances from the poses of side 2 on a fine grid of crank angles.

use std::collections::BTreeMap;
use std::path::Path;

use analytic::NewtonSolver;
use design::clearance::{ClearanceResult, course, find};
use linkage::case::{Case, Grid};
use linkage::math::{KeepNan, Vec2, cross};
use linkage::mechanism::{GROUND, LinkId};
use linkage::solver::{Solver, State};
use scenario::Scenario;
use scenario::clearance::question::{are_joined, pairs};
use scenario::clearance::{ClearanceBody, ClearanceQuestion, Outline};

use crate::common::sketch::RandomSource;
use crate::common::specimens::specimen;
use crate::common::{assert_within, draws, shipped, states};

/// Number of intervals between the crank angles of the brute-force check.
const FINE: usize = 800;

/// An outline in the world: its corners, and whether its interior belongs to the shape.
type Shape = (Vec<Vec2>, bool);

fn side_count((corners, solid): &Shape) -> usize {
    if *solid { corners.len() } else { (corners.len() - 1).max(1) }
}

fn side((corners, _): &Shape, k: usize) -> [Vec2; 2] {
    [corners[k], corners[(k + 1) % corners.len()]]
}

fn to_segment(p: Vec2, [a, b]: [Vec2; 2]) -> f64 {
    let (along, off) = (b - a, p - a);
    let share = if along.norm_squared() > 0.0 { off.dot(&along) / along.norm_squared() } else { 0.0 };
    (off - along * share.clamp(0.0, 1.0)).norm()
}

fn between(one: [Vec2; 2], two: [Vec2; 2]) -> f64 {
    let splits = |[a, b]: [Vec2; 2], [c, d]: [Vec2; 2]| cross(b - a, c - a) * cross(b - a, d - a) < 0.0;
    if splits(one, two) && splits(two, one) {
        return 0.0;
    }
    let ends = [to_segment(one[0], two), to_segment(one[1], two), to_segment(two[0], one), to_segment(two[1], one)];
    ends.into_iter().fold(f64::INFINITY, f64::smaller)
}

/// Whether a point is inside an outline, by the sum of the angles that the sides of the outline subtend at the point.
fn holds(shape: &Shape, p: Vec2) -> bool {
    let seen = |k: usize| {
        let [a, b] = side(shape, k).map(|corner| corner - p);
        cross(a, b).atan2(a.dot(&b))
    };
    shape.1 && (0..shape.0.len()).map(seen).sum::<f64>().abs() > std::f64::consts::PI
}

fn apart(one: &Shape, two: &Shape) -> f64 {
    if holds(one, two.0[0]) || holds(two, one.0[0]) {
        return 0.0;
    }
    let sides = (0..side_count(one)).flat_map(|i| (0..side_count(two)).map(move |j| (i, j)));
    sides.map(|(i, j)| between(side(one, i), side(two, j))).fold(f64::INFINITY, f64::smaller)
}

/// The distance of a pair of bodies in a state (m).
fn distance(asked: &ClearanceQuestion, state: &State, pair: [usize; 2]) -> f64 {
    let [one, two] = pair.map(|body| {
        let ClearanceBody { link, outline, .. } = &asked.bodies[body];
        let corners = outline.corners().iter().map(|&corner| state.motions[*link].point(corner)).collect();
        (corners, outline.is_solid())
    });
    let radii: f64 = pair.iter().map(|&body| asked.bodies[body].outline.radius()).sum();
    (apart(&one, &two) - radii).larger(0.0)
}

/// States of side 2 at the given crank angles.
/// A drive of constant speed, instead of the law of the case, moves the crank to these angles.
/// If several drives have varying speeds, `cranks` contains times (s).
fn at(case: &Case, cranks: &[f64]) -> Vec<State> {
    if case.goes_by_time() {
        return states(&NewtonSolver, case, cranks).unwrap();
    }
    let case = &case.at_top_speed();
    let times: Vec<f64> = Grid::of_inputs(case.crank(), cranks.to_vec()).times;
    states(&NewtonSolver, case, &times).unwrap()
}

/// A clearance task: all links, and a housing of pins and plates.
/// The outlines of the links have random widths; about every third outline is a random polygon.
fn asked(random: &mut RandomSource, case: &Case) -> ClearanceQuestion {
    let mechanism = &case.mechanism;
    let size = mechanism.size();
    let mut bodies = Vec::new();
    for (link, own) in mechanism.links().entries().skip(1) {
        let places: Vec<Vec2> = own.points.iter().map(|point| point.local).collect();
        let radius = size * random.number(0.005, 0.03);
        let outline = if random.index(3) == 0 {
            // The outline is a star around the link's first point, and is seldom convex.
            let corners = random.index(7) + 3;
            let corner = |k: usize| {
                let angle = std::f64::consts::TAU * (k as f64 + random.number(0.0, 0.6)) / corners as f64;
                places[0] + linkage::math::unit(angle) * (size * random.number(0.02, 0.25))
            };
            let corners: Vec<Vec2> = (0..corners).map(corner).collect();
            Outline::polygon(&corners, if random.yes() { 0.0 } else { radius }).unwrap()
        } else {
            Outline::of_points(&places, radius).unwrap()
        };
        bodies.push(ClearanceBody { name: own.name.clone(), link, outline });
    }
    for part in 0..3 {
        let centre = mechanism.links()[GROUND].points[0].local + random.vector(0.2 * size, 1.2 * size);
        let outline = match part {
            0 => Outline::line(&[centre], size * random.number(0.0, 0.02)).unwrap(),
            1 => Outline::line(&[centre, centre + random.vector(0.05 * size, 0.6 * size)], 0.0).unwrap(),
            _ => {
                let arm = random.vector(0.02 * size, 0.2 * size);
                let turned = linkage::math::turned(arm);
                Outline::polygon(&[centre, centre + arm, centre + turned * 0.7], 0.01 * size).unwrap()
            }
        };
        bodies.push(ClearanceBody { name: format!("part_{part}"), link: GROUND, outline });
    }
    let pairs = pairs(mechanism, &bodies, &[]);
    ClearanceQuestion { bodies, pairs, wanted: Some(0.02 * size), tolerance: None, area: 0.05 }
}

/// Results of the brute-force check.
#[derive(Default, Debug)]
struct Seen {
    pairs: usize,
    collisions: usize,
    /// Number of collisions that lie between two instants of the grid.
    between_instants: usize,
    poses: usize,
    distances: usize,
}

/// Checks that in every sample the bodies are at least as far apart as the proven distance.
/// Also checks that the reported distances and contacts exist, and that no bodies touch before the reported first
/// contact.
fn check(case: &Case, asked: &ClearanceQuestion, found: &ClearanceResult, seen: &mut Seen, name: &str) {
    assert!(found.open.is_empty(), "{name}: {:?}", found.open);
    let ([from, to], size) = (found.range, case.mechanism.size());
    let cranks: Vec<f64> = (0..=FINE).map(|k| from + (to - from) * (k as f64 / FINE as f64)).collect();
    let fine = at(case, &cranks);
    let grid = course(case, asked).unwrap();
    // The tolerance allows for the error of the sides' poses at condition numbers of up to some thousands.
    let rounding = 1e-10 * size;
    for (index, pair) in found.pairs.iter().enumerate() {
        let what = || format!("{name}: {:?}", pair.bodies.map(|body| &asked.bodies[body].name));
        let samples: Vec<f64> = fine.iter().map(|state| distance(asked, state, pair.bodies)).collect();
        let least = samples.iter().copied().fold(f64::INFINITY, f64::smaller);
        assert_within!(pair.smallest.least - least, rounding, "{}: {pair:?}", what());
        let there = distance(asked, &at(case, &[pair.smallest.crank])[0], pair.bodies);
        assert_within!((there - pair.smallest.distance).abs(), rounding, "{}: {there} {pair:?}", what());
        assert_within!(pair.smallest.distance - pair.smallest.least, found.tolerance * (1.0 + 1e-9), "{}", what());
        for (meeting, threshold) in [(pair.collision, 0.0), (pair.too_near, asked.wanted.unwrap())] {
            let gone = |crank: f64| (crank - from).abs();
            let end = meeting.map_or(f64::INFINITY, |meeting| gone(meeting.cranks[0]));
            let before = cranks.iter().zip(&samples).filter(|(crank, _)| gone(**crank) < end);
            let nearest = before.map(|(_, &sample)| sample).fold(f64::INFINITY, f64::smaller);
            assert!(nearest > threshold - rounding, "{}: {nearest} before {meeting:?}", what());
            if let Some(meeting) = meeting {
                let there = distance(asked, &at(case, &[meeting.cranks[1]])[0], pair.bodies);
                assert_within!(there - threshold, 2e-9 * size, "{}: {meeting:?}", what());
                assert_within!(gone(meeting.cranks[1]) - gone(meeting.cranks[0]), 1e-6, "{}: {meeting:?}", what());
            }
        }
        seen.pairs += 1;
        if pair.collision.is_some() {
            seen.collisions += 1;
            seen.between_instants += usize::from(grid.rows.iter().all(|row| row[index] > 0.0));
        }
    }
    for (body, area) in &found.swept {
        assert!(0.0 <= area.least && area.least <= area.value && area.value <= area.most, "{name}: {body} {area:?}");
    }
    seen.poses += found.work.poses;
    seen.distances += found.work.distances;
}

/// Mechanisms with driven slides, with driven joints between moving links, and with transmissions.
const GIVEN: [&str; 6] =
    ["boom_lift", "oldham_ram", "four_bar_relative", "rack_and_pinion", "planetary_train", "geared_five_bar"];

/// Mechanisms with several drives of varying speed.
/// The drives are at cranks, slides and joints between moving links, and their laws are cycloids and a table.
/// Further cases replace two of the laws by a harmonic law and a formula.
#[test]
fn several_drives_with_laws_against_brute_force() {
    let mut seen = Seen::default();
    let laws = |text: &str, law: &str| {
        let (first, rest) = text.split_once("law = \"cycloidal\"").unwrap();
        let (keys, rest) = rest.split_once("\n\n").unwrap();
        let kept = keys.lines().filter(|line| line.starts_with("start_")).collect::<Vec<_>>().join("\n");
        format!("{first}{law}\n{kept}\n\n{rest}")
    };
    for (index, (name, law)) in [
        ("platform_3rpr", None),
        ("robot_arm", None),
        ("belt_arm", None),
        ("platform_3rpr", Some("law = \"harmonic\"\namplitude_mm = 30\nperiod_s = 4\n")),
        ("robot_arm", Some("law = \"formula\"\nformula = \"start1 + 0.3*t^2 - 0.1*t^3\"\ntime_s = 1.6\n")),
    ]
    .into_iter()
    .enumerate()
    {
        let shipped = shipped(&format!("{name}.toml"));
        let text = shipped.text.split("[[formula]]").next().unwrap().split("[[oracle]]").next().unwrap();
        let text = law.map_or_else(|| text.to_string(), |law| laws(text, law));
        let case = Scenario::parse(&text, Path::new("given.toml")).unwrap_or_else(|error| panic!("{text}{error}")).case;
        assert!(case.goes_by_time());
        let mut random = RandomSource::of_sample(12, index as u64);
        let asked = asked(&mut random, &case);
        let found = find(&case, &asked, &mut |_| ()).unwrap_or_else(|error| panic!("{name}: {error}"));
        check(&case, &asked, &found, &mut seen, name);
    }
    println!("{seen:?}");
    assert!(seen.pairs > 50 && seen.collisions > 3, "{seen:?}");
}

#[test]
fn shipped_mechanisms_against_brute_force() {
    let mut seen = Seen::default();
    let names =
        ["crank_rocker", "quick_return", "scotch_yoke", "six_bar_slider", "class3_group", "fourth_class", "ov7_base"];
    for (index, name) in names.into_iter().chain(["five_bar", "cycloidal_start", "tangent"]).chain(GIVEN).enumerate() {
        let case = shipped(&format!("{name}.toml")).case;
        let mut random = RandomSource::of_sample(11, index as u64);
        let asked = asked(&mut random, &case);
        let found = find(&case, &asked, &mut |_| ()).unwrap_or_else(|error| panic!("{name}: {error}"));
        check(&case, &asked, &found, &mut seen, name);
    }
    println!("{seen:?}");
    assert!(seen.pairs > 100 && seen.collisions > 10, "{seen:?}");
}

#[test]
fn random_mechanisms_against_brute_force() {
    let (mut seen, mut used) = (Seen::default(), 0);
    for index in 0..draws(20) as u64 {
        let own = specimen(29, index, &mut BTreeMap::new());
        let text = own.toml(false);
        let case = Scenario::parse(&text, Path::new("specimen.toml")).unwrap_or_else(|error| panic!("{error}")).case;
        if case.is_free() {
            continue;
        }
        used += 1;
        let mut random = RandomSource::of_sample(30, index);
        let asked = asked(&mut random, &case);
        let found = find(&case, &asked, &mut |_| ()).unwrap_or_else(|error| panic!("{index}: {error}"));
        check(&case, &asked, &found, &mut seen, &format!("{index} ({})", own.sort));
    }
    println!("{used} mechanisms: {seen:?}");
    assert!(seen.pairs > 100 && seen.collisions > 10, "{seen:?}");
}

/// In each case, a thin nail beside the path of a point of a random moving link overlaps the path slightly.
/// Sampled poses miss most nails, even on a grid of 7 200 intervals.
#[test]
fn planted_thin_crossings_are_found() {
    let (mut planted, mut missed) = (0, 0);
    for (index, name) in
        ["crank_rocker", "class3_group", "fourth_class", "ov7_base", "boom_lift", "planetary_train"].iter().enumerate()
    {
        let case = shipped(&format!("{name}.toml")).case;
        let size = case.mechanism.size();
        let mut random = RandomSource::of_sample(5, index as u64);
        let [from, to] = [case.grid.inputs[0], case.grid.inputs[case.grid.len() - 1]];
        for _ in 0..4 {
            let crank = from + (to - from) * random.number(0.05, 0.95);
            let link = LinkId(1 + random.index(case.mechanism.links().len() - 1));
            let local = case.mechanism.links()[link].points[0].local + random.vector(0.1 * size, 0.2 * size);
            let motion = at(&case, &[crank])[0].motions[link];
            // The nail overlaps the path by so little that the point passes through the nail within about a millionth
            // of a degree.
            let (place, way) = (motion.point(local), motion.point_velocity(local).normalize());
            let radius = 1e-6 * size;
            let depth = 1e-12 * size;
            let nail = place + linkage::math::turned(way) * (2.0 * radius - depth);
            let bodies = vec![
                ClearanceBody { name: "link".into(), link, outline: Outline::line(&[local], radius).unwrap() },
                ClearanceBody { name: "nail".into(), link: GROUND, outline: Outline::line(&[nail], radius).unwrap() },
            ];
            let asked =
                ClearanceQuestion { bodies, pairs: vec![[0, 1]], wanted: None, tolerance: None, area: f64::INFINITY };
            let found = find(&case, &asked, &mut |_| ()).unwrap();
            let meeting = found.pairs[0].collision.unwrap_or_else(|| panic!("{name}: {crank} {:?}", found.pairs));
            planted += 1;
            let fine: Vec<f64> = (0..=7_200).map(|k| from + (to - from) * (f64::from(k) / 7_200.0)).collect();
            let fine = case.on(Grid::of_inputs(case.crank(), fine)).unwrap();
            missed += usize::from(course(&fine, &asked).unwrap().rows.iter().all(|row| row[0] > 0.0));
            // The path may cross the nail twice.
            // The reported first crossing must not be later than the crossing at `crank`.
            assert!((meeting.cranks[1] - from).abs() <= (crank - from).abs() + 1e-3, "{name}: {meeting:?} {crank}");
        }
    }
    println!("{planted} planted, {missed} missed by 7 200 samples");
    assert!(missed * 10 >= planted * 8, "{missed} of {planted}");
}

/// Almost three revolutions have the same poses as one revolution.
/// Distances and areas therefore equal those of one revolution, to the requested accuracy.
#[test]
fn a_grid_of_several_turns_gives_the_results_of_one() {
    let scenario = shipped("crankcase.toml");
    let asked = scenario.clearance.as_ref().unwrap();
    let over = |turns: f64| {
        let ends = [0.3, 0.3 + turns * std::f64::consts::TAU];
        let case = scenario.case.on(Grid::of_inputs(scenario.case.crank(), ends.to_vec())).unwrap();
        find(&case, asked, &mut |_| ()).unwrap()
    };
    let [one, three] = [over(1.0), over(2.75)];
    for (own, more) in one.pairs.iter().zip(&three.pairs) {
        assert_eq!(own.bodies, more.bodies);
        assert_within!((own.smallest.distance - more.smallest.distance).abs(), 1e-9, "{:?}", own.bodies);
    }
    for ((body, own), (_, more)) in one.swept.iter().zip(&three.swept) {
        let overlap = own.most.smaller(more.most) - own.least.larger(more.least);
        assert!(overlap >= 0.0, "{body}: {own:?} {more:?}");
    }
}

/// The computed area agrees with the closed form to 1e-4, so an area missing at the border would be noticed.
/// The proven interval of the area is wider than the error of the computed area, because the work is limited.
#[test]
fn a_swept_area_matches_its_closed_form_to_1e_4() {
    let scenario = shipped("crankcase.toml");
    let asked = ClearanceQuestion { area: 1e-4, pairs: Vec::new(), ..scenario.clearance.clone().unwrap() };
    let found = find(&scenario.case, &asked, &mut |_| ()).unwrap();
    // The area that the piston's outline sweeps over its stroke; the next test derives it.
    let expected = (70.0 * 130.0 - 44.0 * 32.0) * 1e-6;
    let area = found.swept[2].1;
    assert!((area.least..=area.most).contains(&expected), "{area:?} {expected}");
    assert_within!(area.error(), 4e-3 * expected, "{area:?}");
    assert_within!((area.value - expected).abs(), 1e-4 * expected, "{area:?}");
}

/// The shipped housing, checked by brute force and by areas on a raster.
#[test]
fn the_crankcase_is_clear() {
    let scenario = shipped("crankcase.toml");
    let (case, asked) = (&scenario.case, scenario.clearance.as_ref().unwrap());
    let found = find(case, asked, &mut |_| ()).unwrap();
    let mut seen = Seen::default();
    check(case, asked, &found, &mut seen, "crankcase");
    assert_eq!((seen.pairs, seen.collisions), (13, 0));
    let piston =
        found.pairs.iter().find(|pair| asked.bodies[pair.bodies[1]].name == "head" && pair.bodies[0] == 2).unwrap();
    // The distance at the upper dead centre is 204 - 3 - (40 + 130 + 30) mm.
    assert_within!((piston.smallest.distance - 1e-3).abs(), 1e-12);
    // A piston 70 mm wide with a hollow of 44 x 32 mm below its crown, over a stroke of 80 mm.
    // The part of the hollow that is never covered is subtracted.
    let expected = (70.0 * 130.0 - 44.0 * 32.0) * 1e-6;
    let area = found.swept[2].1;
    assert!((area.least..=area.most).contains(&expected), "{area:?} {expected}");
    assert_within!((area.value - expected).abs(), 5e-4 * expected, "{area:?}");
    assert_within!(area.error(), asked.area * expected, "{area:?}");
    // The area of the rod on a raster of 2 mm, at crank positions 1 deg apart.
    let rod = found.swept[1].1;
    let positions: Vec<Vec<Vec2>> = at(case, &(0..360).map(|k| f64::from(k).to_radians()).collect::<Vec<_>>())
        .iter()
        .map(|state| {
            asked.bodies[1].outline.corners().iter().map(|&corner| state.motions[LinkId(2)].point(corner)).collect()
        })
        .collect();
    let step = 2e-3;
    let mut count = 0;
    for i in -30..30 {
        for k in -30..100 {
            let place = Vec2::new((f64::from(i) + 0.5) * step, (f64::from(k) + 0.5) * step);
            count += usize::from(positions.iter().any(|ends| to_segment(place, [ends[0], ends[1]]) <= 9e-3));
        }
    }
    let raster = f64::from(u32::try_from(count).unwrap()) * step * step;
    assert_within!((raster - rod.value).abs(), 1e-2 * rod.value, "{raster} {rod:?}");
}

/// The clearance of a free motion with one degree of freedom covers the crank angles that the motion reaches, up to one
/// revolution.
/// With several degrees of freedom, no single angle determines the pose, so `[clearance]` is refused.
#[test]
fn motions_under_forces_cover_the_reached_crank_angles() {
    let case = shipped("crank_rocker_runup.toml").case;
    let asked = asked(&mut RandomSource::of_sample(3, 1), &case);
    let found = find(&case, &asked, &mut |_| ()).unwrap();
    let solved = analytic::AssurSolver.solve(&case).unwrap();
    let reached = solved.inputs().iter().copied().fold(f64::NEG_INFINITY, f64::larger);
    let turn = std::f64::consts::TAU;
    let expected = reached.smaller(found.range[0] + turn);
    assert_within!((found.range[1] - expected).abs(), 1e-12, "{:?}", found.range);
    assert_eq!(course(&case, &asked).unwrap().cranks, solved.inputs());
    let case = shipped("double_pendulum.toml").case;
    let error = find(&case, &asked, &mut |_| ()).unwrap_err();
    assert_eq!(error.kind(), linkage::ErrorKind::Unsupported);
}

/// Without the section `[clearance]`, no clearance is computed.
/// The section does not change any bit of the results of a proof.
#[test]
fn a_run_does_not_depend_on_the_clearance_section() {
    let with = shipped("crankcase.toml");
    let text = with.text.split("[clearance]").next().unwrap();
    let without = Scenario::parse(text, Path::new("crankcase.toml")).unwrap();
    assert!(without.clearance.is_none() && with.clearance.is_some());
    assert_eq!(with.case, without.case);
}

/// Three links are on one pin: two of the links have no common joint, but touch at the pin.
#[test]
fn links_on_one_pin_are_joined_without_a_common_joint() {
    let case = shipped("ov7_base.toml").case;
    let mechanism = &case.mechanism;
    let has_joint = |a: LinkId, b: LinkId| mechanism.joints().iter().any(|j| j.on(a).is_some() && j.on(b).is_some());
    let links = mechanism.links().len();
    let pairs = (1..links).flat_map(|a| (a + 1..links).map(move |b| (LinkId(a), LinkId(b))));
    let by_pin: Vec<(LinkId, LinkId)> =
        pairs.filter(|&(a, b)| !has_joint(a, b) && are_joined(mechanism, [a, b])).collect();
    assert!(!by_pin.is_empty());
    // Some pairs of links are joined neither by a joint nor by a common pin.
    assert!(by_pin.len() < links * (links - 1) / 2 - mechanism.joints().len());
}
