//! Drawings of all shipped mechanisms: labels apart, and dimensions that define every link.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use analytic::AssurSolver;
use drawing::lay::Laid;
use drawing::paper::labels::text_boxes;
use drawing::sheet::{SheetCell, sheet};
use drawing::view::{DrawnSubject, Extras, Shot, ShownMotion, cells};
use drawing::{Dimension, Measure, Travels, dimensions, places};
use linkage::case::{Case, Grid, Wanted};
use linkage::math::{KeepNan, Vec2, cross, turned, unit};
use linkage::mechanism::{GROUND, LinkId, LinkPose, Mechanism};
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;
use linkproof::Scenario;

/// Instants of each mechanism, and widths of pictures in pixels.
const INSTANTS: usize = 24;
const WIDTHS: [f64; 3] = [360.0, 800.0, 1600.0];
/// Size of a picture (mm), as in `linkproof draw`.
const ROOM: [f64; 2] = [150.0, 120.0];

fn mechanisms() -> Vec<(String, Case)> {
    let files = ["scenarios", "crates/scenario/src/templates"].map(|folder| fs::read_dir(folder).unwrap());
    let mut paths: Vec<PathBuf> = files.into_iter().flatten().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    paths.sort();
    assert!(paths.len() > 50, "{}", paths.len());
    paths.iter().map(|path| (path.display().to_string(), Scenario::load(path).unwrap().case.nominal())).collect()
}

/// States over a turn of the crank, or over the grid of the case if the crank cannot make a turn or there are several
/// drives.
fn states(case: &Case) -> Vec<State> {
    let solved = |grid: Grid| -> Option<Vec<State>> {
        let case = case.on(grid).ok()?;
        let mut states = Vec::new();
        let mut keep = |_: usize, state: &State| {
            states.push(state.clone());
            Ok(())
        };
        AssurSolver.each(&case.wanting(Wanted::of(&[Stage::Positions])), &mut keep).ok()?;
        Some(states)
    };
    let crank = case.crank();
    let turn = crank.input.period().map(|(period, _)| period / INSTANTS as f64);
    let inputs = |step: f64| (0..INSTANTS).map(|k| crank.start + crank.sense() * step * k as f64).collect();
    let rows = (0..case.grid.len()).step_by(case.grid.len().div_ceil(INSTANTS));
    let times = || rows.map(|row| case.grid.times[row]).collect();
    let whole =
        turn.filter(|_| case.drives.further().is_empty()).and_then(|step| solved(Grid::of_inputs(crank, inputs(step))));
    whole.unwrap_or_else(|| solved(Grid::of_times(crank, times())).unwrap())
}

fn drawn(case: &Case, states: &[State], extras: Extras) -> Vec<SheetCell> {
    let mut travels = Travels::none(&case.mechanism);
    let pose =
        |state: &State, k: usize| LinkPose { origin: state.motions[LinkId(k)].origin, angle: state.angles[LinkId(k)] };
    let mut shots = Vec::new();
    for state in states {
        travels.take_in(&case.mechanism, |link, local| Some(state.motions[link].point(local)));
        let poses = (0..case.mechanism.links().len()).map(|k| pose(state, k));
        shots.push(Shot { laid: Laid::whole(poses), acting: Vec::new() });
    }
    let subject =
        DrawnSubject { mechanism: &case.mechanism, drives: &case.drives, loads: &case.loads, gravity: case.gravity };
    let motion = ShownMotion { travels: &travels, traces: &[], series: None };
    cells(&subject, &shots, motion, extras, Vec2::from(ROOM))
}

/// A width in pixels scales the whole picture.
/// Labels that are half a pixel apart at the smallest width are therefore apart at every width.
#[test]
fn no_two_labels_meet_in_any_shipped_mechanism() {
    let mut count = 0;
    for (name, case) in mechanisms() {
        let states = states(&case);
        for extras in [false, true].map(|all| Extras { dimensions: all, loads: all, ..Extras::default() }) {
            for (instant, cell) in drawn(&case, &states, extras).iter().enumerate() {
                let boxes = &cell.figure.labels;
                let least = WIDTHS.into_iter().fold(f64::INFINITY, f64::smaller);
                let gap = 0.5 * sheet("", "", std::slice::from_ref(cell), ROOM[0]).1[0] / least;
                for (k, one) in boxes.iter().enumerate() {
                    for other in &boxes[..k] {
                        let apart = (one[0] - other[1]).sup(&(other[0] - one[1]));
                        assert!(apart.x >= gap || apart.y >= gap, "{name}, {instant}, {extras:?}: {one:?} {other:?}");
                    }
                }
                // The boxes are not smaller than the letters in them.
                for text in text_boxes(&cell.figure) {
                    let holds = |own: &[Vec2; 2]| {
                        (text[0] - own[0]).iter().chain((own[1] - text[1]).iter()).all(|margin| *margin >= 0.0)
                    };
                    assert!(boxes.iter().any(holds), "{name}, {instant}: {text:?}");
                }
                count += boxes.len();
            }
        }
    }
    assert!(count > 10_000, "{count}");
}

/// The number in a text such as `12.5 mm` or `30°`, and half a unit of its last digit.
fn number(text: &str) -> (f64, f64) {
    let digits: String = text.chars().filter(|sign| sign.is_ascii_digit() || ".e-".contains(*sign)).collect();
    let value: f64 = digits.parse().unwrap();
    let ulp = 10f64.powf(value.abs().log10().floor() - 3.0);
    (value, 0.5 * ulp)
}

/// Side of the line from point `a` to point `b` on which point `c` lies: 1 for left, -1 for right.
fn side(all: &[Vec2], a: usize, b: usize, c: usize) -> f64 {
    cross(all[b] - all[a], all[c] - all[a]).signum()
}

/// The points of a moving link (mm), reconstructed from the lengths in the drawing, in the order of the lengths.
/// All distances come from `lengths`.
/// `shown` only decides on which side of a line a point lies, or in which direction along the line.
fn rebuilt(shown: &[Vec2], lengths: &[(usize, usize, f64)]) -> BTreeMap<usize, Vec2> {
    let mut built: BTreeMap<usize, Vec2> = BTreeMap::new();
    let Some(&(first, second, length)) = lengths.first() else { return built };
    built.insert(first, Vec2::zeros());
    built.insert(second, Vec2::new(length, 0.0));
    let mut rest = &lengths[1..];
    while let [(from, to, length), ref more @ ..] = *rest {
        match more.first().filter(|own| own.1 == to) {
            Some(&(other, _, second)) => {
                let (a, b) = (built[&from], built[&other]);
                let (apart, along) = ((b - a).norm(), (b - a).normalize());
                let foot = (length * length - second * second + apart * apart) / (2.0 * apart);
                let height = (length * length - foot * foot).larger(0.0).sqrt();
                built.insert(to, a + along * foot + turned(along) * (height * side(shown, from, other, to)));
                rest = &more[1..];
            }
            None => {
                // A point with only one length lies on the line through the first two points.
                let way = (shown[to] - shown[from]).dot(&(shown[second_of(lengths)] - shown[from])).signum();
                built.insert(to, built[&from] + Vec2::new(way * length, 0.0));
                rest = more;
            }
        }
    }
    built
}

fn second_of(lengths: &[(usize, usize, f64)]) -> usize {
    lengths[0].1
}

/// The points of the ground (mm), reconstructed from the numbers in the drawing.
/// If a drawing gives no horizontal or no vertical distance for a point, this distance from the first pivot is zero.
fn rebuilt_ground(count: usize, shown: &[Vec2], drawn: &[(&Dimension, f64)]) -> BTreeMap<usize, Vec2> {
    let mut built: BTreeMap<usize, Vec2> = (0..count).map(|k| (k, Vec2::zeros())).collect();
    for (own, value) in drawn {
        let Measure::Offset { axis, from, to, .. } = &own.measure else { continue };
        for place in to {
            built.get_mut(place).unwrap()[*axis] = value * (shown[*place][*axis] - shown[*from][*axis]).signum();
        }
    }
    built
}

/// Compares all distances of a link with its file.
/// The bound is the sum of the effects of half a unit in the last digit of each number, multiplied by 1.5 because these
/// effects are not exactly linear.
fn compare(name: &str, mechanism: &Mechanism, link: LinkId, all: &[Dimension]) {
    let shown = places(mechanism, link);
    let own: Vec<&Dimension> = all.iter().filter(|own| own.link == link).collect();
    let numbers: Vec<(f64, f64)> = own.iter().map(|own| number(&own.text)).collect();
    let build = |shifted: Option<usize>| {
        let value = |k: usize| numbers[k].0 + if shifted == Some(k) { numbers[k].1 } else { 0.0 };
        let drawn: Vec<(&Dimension, f64)> = own.iter().enumerate().map(|(k, own)| (*own, value(k))).collect();
        let length = |(own, value): &(&Dimension, f64)| match own.measure {
            Measure::Length { from, to, .. } => Some((from, to, *value)),
            Measure::Offset { .. } | Measure::Angle { .. } | Measure::Radius { .. } => None,
        };
        match link == GROUND {
            true => rebuilt_ground(shown.len(), &shown, &drawn),
            false => rebuilt(&shown, &drawn.iter().filter_map(length).collect::<Vec<_>>()),
        }
    };
    let plain = build(None);
    let moved: Vec<_> = (0..own.len()).map(|k| build(Some(k))).collect();
    let size = shown.iter().map(|at| (at - shown[0]).norm()).fold(0.0, f64::larger);
    for a in 0..shown.len() {
        for b in 0..a {
            let wanted = (shown[a] - shown[b]).norm();
            // A point for which the drawing gives no length coincides with a point for which the drawing gives
            // lengths.
            let of = |k: usize| plain.keys().copied().find(|own| (shown[*own] - shown[k]).norm() <= 1e-8 * size);
            if wanted <= 1e-8 * size && of(a).is_none() {
                continue;
            }
            let (a, b) =
                (of(a).unwrap_or_else(|| panic!("{name}: {a}")), of(b).unwrap_or_else(|| panic!("{name}: {b}")));
            let found = (plain[&a] - plain[&b]).norm();
            let change = |other: &BTreeMap<usize, Vec2>| ((other[&a] - other[&b]).norm() - found).abs();
            let bound = 1.5 * moved.iter().map(change).sum::<f64>() + 1e-6 * size * 1e3;
            assert!((found - wanted * 1e3).abs() <= bound, "{name}, link {link}: {found} {wanted} {bound}");
            assert!(bound <= 0.02 * size * 1e3, "{name}, link {link}: the numbers do not define it: {bound}");
        }
    }
}

/// Checks the angle of every guide to its link.
/// If no angle is written, the guide is at a multiple of 90 degrees to a line of the link.
fn compare_guides(name: &str, mechanism: &Mechanism, all: &[Dimension]) {
    for (id, joint) in mechanism.joints().entries() {
        for side in [joint.first, joint.second] {
            let Some(axis) = joint.axis_on(side.link) else { continue };
            let shown = places(mechanism, side.link);
            let written = all.iter().find_map(|own| match own.measure {
                Measure::Angle { joint, sides, .. } if joint == id && own.link == side.link => Some((own, sides)),
                Measure::Angle { at, sides, .. } if at == side.local && own.link == side.link => {
                    (cross(unit(sides[1]), axis).abs() < 1e-9).then_some((own, sides))
                }
                Measure::Angle { .. } | Measure::Length { .. } | Measure::Offset { .. } | Measure::Radius { .. } => {
                    None
                }
            });
            match written {
                Some((own, [from, to])) => {
                    let (degrees, half) = number(&own.text);
                    let guide = unit(from + (to - from).signum() * degrees.to_radians());
                    let miss = cross(guide, axis).abs();
                    assert!(miss <= 1.1 * half.to_radians() + 1e-9, "{name}, {}: {} {miss}", joint.name, own.text);
                }
                None => {
                    let guides = mechanism.joints().iter().filter_map(|other| other.axis_on(side.link));
                    let arms = shown.iter().map(|at| at - side.local).filter(|arm| arm.norm() > 0.0).chain(guides);
                    let fixed = (side.link == GROUND).then(Vec2::x);
                    let is_plain = |line: Vec2| {
                        let line = line.normalize();
                        cross(line, axis).abs().smaller(line.dot(&axis).abs()) < 1e-6
                    };
                    assert!(arms.chain(fixed).any(is_plain), "{name}, {}: an angle is missing", joint.name);
                }
            }
        }
    }
}

/// The numbers in a drawing define the distances of all points of every link, and the directions of the guides.
#[test]
fn every_shipped_mechanism_can_be_rebuilt_from_its_drawing() {
    let mut count = 0;
    for (name, case) in mechanisms() {
        let state = states(&case).swap_remove(0);
        let extras = Extras { dimensions: true, ..Extras::default() };
        let cell = drawn(&case, &[state], extras).swap_remove(0);
        // The numbers of the dimensions occur as texts in the drawing.
        let mut texts: Vec<&str> = cell.figure.texts().map(|own| own.1).collect();
        for own in &cell.dimensions {
            let at = texts.iter().position(|text| *text == own.text);
            texts.swap_remove(at.unwrap_or_else(|| panic!("{name}: {} is not drawn", own.text)));
        }
        for link in case.mechanism.links().ids() {
            compare(&name, &case.mechanism, link, &cell.dimensions);
        }
        compare_guides(&name, &case.mechanism, &cell.dimensions);
        assert_eq!(cell.dimensions, dimensions(&case.mechanism));
        count += cell.dimensions.len();
    }
    assert!(count > 300, "{count}");
}

/// The three points of a rocker are on one line.
/// The drawing of such a rocker has two lengths, and is incomplete if the shorter length is missing.
#[test]
fn a_bar_with_three_points_has_both_of_its_lengths() {
    let case = Scenario::load("scenarios/crank_rocker.toml").unwrap().case;
    let texts: Vec<String> = dimensions(&case.mechanism).into_iter().map(|own| own.text).collect();
    assert!(["250 mm", "333.3 mm"].iter().all(|text| texts.contains(&text.to_string())), "{texts:?}");
}
